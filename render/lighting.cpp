#include "render/lighting.h"

#include <map>

#include "render/grow.h"
#include "shaders/shared/lighting.h"

namespace foveray::render {
namespace {

/// Tiles and samples are drawn by resolve, over the light.
std::uint32_t debug_view(const Settings& settings) {
    static const std::map<std::string, std::uint32_t> views = {{"normal", shared::LIGHTING_DEBUG_NORMAL},
                                                               {"albedo", shared::LIGHTING_DEBUG_ALBEDO},
                                                               {"shadow", shared::LIGHTING_DEBUG_SHADOW},
                                                               {"depth", shared::LIGHTING_DEBUG_DEPTH},
                                                               {"probes", shared::LIGHTING_DEBUG_PROBES}};
    const auto it = views.find(settings.debug_view);
    return it == views.end() ? shared::LIGHTING_DEBUG_NONE : it->second;
}

}  // namespace

LightingStage::LightingStage(const engine::SceneRayTracer& tracer, engine::RayGeneration lighting)
    : tracer_(tracer), lighting_(lighting) {}

LightLayers LightingStage::accumulate(const gpu::Commands& cmd, const LightingInput& input,
                                      std::uint32_t sub_sample) {
    using gpu::Access;
    const auto stage = cmd.stage("lighting");
    const Settings& settings = input.settings;
    const vk::DeviceSize bytes = vk::DeviceSize{input.grid.sample_count} * sizeof(shared::LightSample);
    grow(cmd, samples_, "light samples", bytes);
    const bool polar = input.grid.kind == shared::GRID_POLAR;
    const vk::DeviceSize shadowed_bytes =
        vk::DeviceSize{input.grid.sample_count} * sizeof(shared::ShadowedLight);
    if (polar) grow(cmd, shadowed_, "shadowed light", shadowed_bytes);

    shared::LightingPush push{};
    push.grid = input.grid.at(sub_sample);
    push.surfaces = input.surfaces;
    push.samples = samples_.address();
    push.shadowed = polar ? shadowed_.address() : 0;
    push.scene = input.scene;
    push.room = input.room;
    push.counters = input.counters;
    push.probes = input.probes;
    push.flags = (settings.shadows ? shared::LIGHTING_SHADOWS : 0u) |
                 (settings.reflections ? shared::LIGHTING_REFLECTIONS : 0u);
    push.noise = input.noise;
    push.visibility = input.shadows.visibility;
    push.openness = input.shadows.openness;
    push.known_lights = input.shadows.light_count;
    push.sample_count = input.grid.sample_count;
    push.second_ray_depth = static_cast<std::uint32_t>(settings.second_ray_depth);
    push.shadow_samples = static_cast<std::uint32_t>(settings.shadow_samples);
    push.max_transparent_layers = static_cast<std::uint32_t>(settings.max_transparent_layers);
    push.debug_view = debug_view(settings);
    push.reflection_max_roughness = settings.reflection_max_roughness;
    push.environment_intensity = settings.environment_intensity;

    // Earlier frames may still read the samples; earlier sub-samples wrote them.
    cmd.barrier(Access::ComputeRead, Access::RayTracingWrite);
    cmd.barrier(Access::RayTracingWrite, Access::RayTracingWrite);
    for (const SampleBlock& block : input.grid.blocks) {
        push.first_sample = block.first;
        tracer_.trace(cmd, lighting_, push, {block.width, block.height, 1});
    }
    cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
    cmd.barrier(Access::RayTracingWrite, Access::RayTracingRead);
    return {samples_.address(), &samples_, push.shadowed};
}

}  // namespace foveray::render
