#include "tests/render/light/light_rig.h"

#include <cstring>

namespace foveray::render {
namespace {

template <typename T>
std::vector<T> as(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

Pixel unpack(const shared::ResolvedPixel& resolved, const shared::ResolvedRealPixel& real, float depth) {
    const vec4 radiance = shared::unpack_halves(resolved.radiance);
    return {vec3(radiance),
            std::max(radiance.w, 0.0f),
            vec3(shared::unpack_halves(real.transmittance)),
            radiance.w >= 0,
            vec3(shared::unpack_halves(real.added)),
            depth};
}

const glm::uvec2 halves_of_one = shared::pack_halves(vec4(1.0f));

}  // namespace

LightRig::LightRig(const gpu::Device& device, const scene::Scene& scene)
    : device_(device),
      ring_(device, 1),
      textures_(device),
      pipeline_(device, textures_, 1, scene),
      animator_(scene),
      gpu_scene_(device, textures_, scene, 1),
      accel_(device, gpu_scene_, pipeline_, 1),
      probes_(device, textures_, scene, pipeline_.tracer(), pipeline_.probes()),
      sampling_(device, 1, pipeline_.tracer(), pipeline_.fixation()),
      primary_(pipeline_.tracer(), pipeline_.primary()),
      shadows_(device, textures_, pipeline_.tracer(), pipeline_.shadows()),
      lighting_(pipeline_.tracer(), pipeline_.lighting()),
      history_(device, textures_),
      resolve_(device, textures_),
      counters_(device, 1) {
    accel_.fill_table(pipeline_);
}

std::vector<std::byte> LightRig::read(const gpu::Buffer& source, vk::DeviceSize size) {
    gpu::Buffer target(device_, "test readback", size, gpu::Residence::Readback);
    gpu::submit_and_wait(device_, [&](const gpu::Commands& cmd) {
        cmd.barrier(gpu::Access::RayTracingWrite, gpu::Access::TransferRead);
        cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::TransferRead);
        cmd->copyBuffer(source.vk(), target.vk(), vk::BufferCopy(0, 0, size));
        cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
    });
    target.invalidate();
    const auto mapped = target.mapped();
    return {mapped.begin(), mapped.begin() + static_cast<std::ptrdiff_t>(size)};
}

LightLayers LightRig::paint(const Shot& shot, const Rendered& rendered) {
    std::vector<shared::LightSample> samples(rendered.grid.sample_count);
    const auto& map = rendered.grid.polar;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        if (rendered.surfaces[i].kind == shared::SURFACE_CULLED) continue;
        const auto& gaze = rendered.gaze[i / (map.width * map.height)];
        const float e =
            radians(shared::polar_eccentricity(map, (static_cast<float>(i % map.width) + 0.5f) *
                                                        map.radius_outer / static_cast<float>(map.width)));
        const float angle =
            2.0f * pi *
            (static_cast<float>(i / map.width % map.height) + shared::polar_ring_start(i % map.width)) /
            static_cast<float>(map.height);
        samples[i] = shot.paint(std::cos(e) * gaze.forward +
                                    std::sin(e) * (std::cos(angle) * gaze.right + std::sin(angle) * gaze.up),
                                rendered.surfaces[i].distance);
    }
    painted_ = gpu::Buffer(device_, "painted samples", samples.size() * sizeof(shared::LightSample),
                           gpu::Residence::Upload);
    painted_.write(gpu::range_bytes(samples));
    return {painted_.address(), &painted_};
}

Rendered LightRig::render(const Shot& shot) {
    Frame frame;
    frame.time = shot.time;
    frame.views = shot.views;
    Rendered result;
    LightLayers settled;
    Settings settings = shot.settings;
    settings.history_temporal = settings.history_temporal && shot.history;
    const bool real = shot.paint || gpu_scene_.scene().changes_what_is_behind;
    Surfaces hits;
    {
        const gpu::Commands cmd = ring_.begin();
        counters_.clear(cmd);
        const scene::SceneChanges& changes = animator_.advance(shot.time);
        const GpuSceneFrame scene = gpu_scene_.record(cmd, 0, changes, {});
        accel_.record(cmd, 0, scene, pipeline_,
                      {frame, {}, shot.fovea, shot.acuity, shot.settings, shot.every_pixel});
        result.triangles = accel_.triangle_count();
        const ProbeField probes =
            probes_.record(cmd, {changes, scene.scene_data, counters_.address(), shot.settings});
        result.grid = sampling_.record(
            cmd, 0, {frame, {}, shot.fovea, shot.hidden, shot.acuity, shot.settings, shot.every_pixel});
        LightLayers light;
        for (std::uint32_t s = 0; s < result.grid.sub_sample_count; ++s) {
            hits = primary_.record(cmd, result.grid, s, counters_.address());
            const Shadows shadows = shadows_.record(
                cmd,
                {result.grid, hits, scene.scene_data, scene.light_count, counters_.address(), shot.settings},
                s);
            light = lighting_.accumulate(cmd,
                                         {result.grid, hits.surfaces, shadows, scene.scene_data, shot.room,
                                          counters_.address(), shadows_.noise(), probes.field, shot.settings},
                                         s);
        }
        counters_.read_back(cmd, 0);
        if (!shot.paint)
            settled = history_.record(cmd, {result.grid, hits, light, real, shot.time, settings});
        ring_.submit();
        ring_.wait();
        result.gaze = sampling_.gaze_frames(0);
        result.rays = counters_.counts(0);
        if (shot.read_samples) {
            for (const auto& stored :
                 as<shared::StoredSurface>(read(*hits.buffer, hits.count * sizeof(shared::StoredSurface)))) {
                result.surfaces.push_back(shared::surface_of(stored));
            }
            result.light =
                as<shared::LightSample>(read(*light.buffer, hits.count * sizeof(shared::LightSample)));
        }
    }
    if (shot.paint) {
        const LightLayers light = paint(shot, result);
        const gpu::Commands cmd = ring_.begin();
        settled = history_.record(cmd, {result.grid, hits, light, real, shot.time, settings});
        ring_.submit();
        ring_.wait();
    }
    resolve(shot, settled, real, result);
    return result;
}

void LightRig::resolve(const Shot& shot, const LightLayers& light, bool real, Rendered& rendered) {
    for (std::size_t i = 0; i < shot.views.size(); ++i) {
        const gpu::Commands cmd = ring_.begin();
        const ViewImages images = resolve_.images(cmd, shot.views, real);
        resolve_.record(cmd, light, rendered.grid, images, i, shot.settings);
        ring_.submit();
        ring_.wait();

        Picture picture{shot.views[i].size, {}};
        const std::size_t count = std::size_t{picture.size.x} * picture.size.y;
        const auto resolved =
            as<shared::ResolvedPixel>(read(*images.resolved, count * sizeof(shared::ResolvedPixel)));
        const auto depth = as<float>(read(*images.buffers[i].depth, count * sizeof(float)));
        std::vector<shared::ResolvedRealPixel> reals(count, {halves_of_one, uvec2(0)});
        if (images.real) {
            reals =
                as<shared::ResolvedRealPixel>(read(*images.real, count * sizeof(shared::ResolvedRealPixel)));
        }
        for (std::size_t p = 0; p < count; ++p)
            picture.pixels.push_back(unpack(resolved[p], reals[p], depth[p]));
        rendered.views.push_back(std::move(picture));
    }
}

FloatImage radiance_of(const Picture& picture) {
    FloatImage image(picture.size.x, picture.size.y, 3);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = picture.at(x, y).radiance[c];
    return image;
}

View square_view(float half_angle_degrees, std::uint32_t pixels, Pose stage_from_eye) {
    const float a = radians(half_angle_degrees);
    return {Eye::Left, ViewRole::Context, stage_from_eye, {-a, a, a, -a}, {pixels, pixels}};
}

Pose look_at(vec3 eye, vec3 target) {
    const vec3 forward = glm::normalize(target - eye);
    const vec3 up = std::abs(forward.y) > 0.99f ? vec3(0.0f, 0.0f, -1.0f) : vec3(0.0f, 1.0f, 0.0f);
    return {glm::quatLookAt(forward, up), eye};
}

vec3 direction_of(const View& view, std::uint32_t x, std::uint32_t y) {
    const vec2 uv = (vec2(x, y) + 0.5f) / vec2(view.size);
    return glm::normalize(view.stage_from_eye.orientation * direction_at(view.fov, uv));
}

}  // namespace foveray::render
