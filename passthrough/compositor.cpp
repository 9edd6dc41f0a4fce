#include "passthrough/compositor.h"

#include <cassert>
#include <cmath>

#include "shaders/shared/compositor.h"

namespace foveray::passthrough {

static_assert(static_cast<std::uint32_t>(Background::Camera) == shared::BACKGROUND_CAMERA);
static_assert(static_cast<std::uint32_t>(Background::Environment) == shared::BACKGROUND_ENVIRONMENT);
static_assert(static_cast<std::uint32_t>(Background::Runtime) == shared::BACKGROUND_RUNTIME);

Background choose_background(bool has_camera, BlendMode blend, const Settings& settings) {
    if (has_camera && settings.camera_blend) return Background::Camera;
    return blend == BlendMode::Opaque ? Background::Environment : Background::Runtime;
}

Compositor::Compositor(const gpu::Device& device, const gpu::TextureTable& textures)
    : pipeline_(device, "passthrough/compositor.comp", textures, sizeof(shared::CompositorPush)) {}

void Compositor::record(const gpu::Commands& cmd, const View& view, const shared::ViewImage& image,
                        const Room& room, vk::DeviceAddress scene_data, Background background,
                        const Settings& settings) const {
    assert(image.size == view.size);
    const auto stage = cmd.stage("compositor");
    cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::ComputeWrite);
    const quat& q = view.stage_from_eye.orientation;
    shared::CompositorPush push{};
    push.resolved = image.resolved;
    push.real = image.real;
    push.color = image.color;
    push.depth = image.depth;
    push.room = room.params;
    push.scene = scene_data;
    push.stage_from_eye = {q.x, q.y, q.z, q.w};
    push.origin = view.stage_from_eye.position;
    push.background = static_cast<std::uint32_t>(background);
    push.tangents = {std::tan(view.fov.left), std::tan(view.fov.right), std::tan(view.fov.up),
                     std::tan(view.fov.down)};
    push.size = view.size;
    push.exposure = std::exp2(settings.exposure_ev);
    push.tone_mapping =
        settings.tone_mapping == "neutral" ? shared::TONE_MAPPING_NEUTRAL : shared::TONE_MAPPING_NONE;
    push.near_m = settings.near_m;
    push.far_m = settings.far_m;
    push.environment_intensity = settings.environment_intensity;
    pipeline_.dispatch(cmd, push, {view.size.x, view.size.y, 1}, {8, 8, 1});
}

}  // namespace foveray::passthrough
