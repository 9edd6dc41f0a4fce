#include "render/shadows.h"

#include <algorithm>

#include "render/blue_noise.h"
#include "render/grow.h"
#include "shaders/shared/lighting.h"
#include "shaders/shared/shadows.h"

namespace foveray::render {
namespace {

constexpr int fewest_adaptive = 16;  // samples a light, from which on it pays to look first

}  // namespace

ShadowStage::ShadowStage(const gpu::Device& device, const gpu::TextureTable& textures,
                         const engine::SceneRayTracer& tracer, Entries entries)
    : device_(device),
      tracer_(tracer),
      entries_(entries),
      select_(device, "render/penumbras.comp", textures, sizeof(shared::ShadowPush)) {
    static const std::vector<std::uint32_t> noise = make_blue_noise(shared::BLUE_NOISE_SIZE);
    gpu::Uploader uploader(device);
    noise_ = uploader.buffer("blue noise", gpu::range_bytes(noise));
    uploader.flush();
}

Shadows ShadowStage::record(const gpu::Commands& cmd, const ShadowInput& input, std::uint32_t sub_sample) {
    using gpu::Access;
    const auto stage = cmd.stage("shadows");
    const Settings& settings = input.settings;
    const vk::DeviceSize samples = input.grid.sample_count;
    const std::uint32_t lights = std::min(input.light_count, shared::MOST_KNOWN_LIGHTS);
    const bool adaptive = lights > 0 && settings.shadows && settings.adaptive_shadows &&
                          settings.shadow_samples >= fewest_adaptive;
    grow(device_, visibility_, "light visibility", 4 * std::max<vk::DeviceSize>(lights * samples, 1));
    grow(device_, openness_, "openness", 4 * samples);
    if (adaptive) grow(device_, penumbras_, "penumbras", 4 * (1 + lights * samples));

    shared::ShadowPush push{};
    push.surfaces = input.surfaces.surfaces;
    push.scene = input.scene;
    push.noise = noise_.address();
    push.visibility = visibility_.address();
    push.openness = openness_.address();
    push.penumbras = adaptive ? penumbras_.address() : 0;
    push.counters = input.counters;
    push.flags = (settings.shadows ? shared::LIGHTING_SHADOWS : 0u) |
                 (adaptive ? shared::LIGHTING_ADAPTIVE_SHADOWS : 0u);
    push.samples = static_cast<std::uint32_t>(settings.shadow_samples);
    push.occlusion_samples = static_cast<std::uint32_t>(settings.ambient_occlusion_samples);
    push.occlusion_radius = settings.ambient_occlusion_m;
    push.sample_count = input.grid.sample_count;
    push.light_count = lights;
    push.wraps = input.grid.kind == shared::GRID_POLAR;
    push.sub_sample = sub_sample;

    cmd.barrier(Access::RayTracingRead, Access::RayTracingWrite);  // earlier frames and sub-samples
    for (const SampleBlock& block : input.grid.blocks) {
        push.first_sample = block.first;
        push.width = block.width;
        push.height = block.height;
        tracer_.trace(cmd, entries_.shadows, push, {block.width, block.height, 1});
        if (!adaptive) continue;
        // One block at a time: the list is as long as all of them could make it, but read per block.
        cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
        cmd.barrier(Access::RayTracingRead, Access::TransferWrite);
        cmd->fillBuffer(penumbras_.vk(), 0, sizeof(std::uint32_t), 0);
        cmd.barrier(Access::TransferWrite, Access::ComputeWrite);
        select_.dispatch(cmd, push, {block.width, block.height, 1}, {8, 8, 1});
        cmd.barrier(Access::ComputeWrite, Access::RayTracingRead);
        cmd.barrier(Access::ComputeRead, Access::RayTracingWrite);
        tracer_.trace(cmd, entries_.penumbras, push, {lights * block.width * block.height, 1, 1});
    }
    cmd.barrier(Access::RayTracingWrite, Access::RayTracingRead);
    cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
    return {visibility_.address(), openness_.address(), lights};
}

}  // namespace foveray::render
