#include "render/shadows.h"

#include <algorithm>

#include "render/blue_noise.h"
#include "render/grow.h"
#include "shaders/shared/lighting.h"
#include "shaders/shared/shadows.h"

namespace foveray::render {
namespace {

constexpr int fewest_adaptive = 16;  // samples a light, from which on it pays to look first
// What every device allows of a launch and of a dispatch.
constexpr std::uint64_t most_rays = 1u << 30;
constexpr std::uint32_t most_groups = 65535, group_size = 64;

}  // namespace

struct ShadowStage::Penumbras {
    std::uint32_t most;  // in a list
    std::uint32_t samples;

    /// A ray a thread, some first. False: a penumbra's samples are taken in one go, by one thread.
    bool in_cells() const {
        return shared::penumbra_first_level(samples) > 0 && std::uint64_t{most} * samples <= most_rays &&
               most <= group_size * most_groups;
    }
    vk::DeviceSize list_bytes() const { return sizeof(shared::PenumbraList) + 4 * vk::DeviceSize{most}; }
    vk::DeviceSize word_bytes() const { return 4 * vk::DeviceSize{most} * shared::penumbra_words(samples); }
};

ShadowStage::ShadowStage(const gpu::Device& device, const gpu::TextureTable& textures,
                         const engine::SceneRayTracer& tracer, Entries entries)
    : tracer_(tracer),
      entries_(entries),
      select_(device, "render/penumbras.comp", textures, sizeof(shared::ShadowPush)),
      cells_(device, "render/penumbra_cells.comp", textures, sizeof(shared::ShadowPush)),
      sums_(device, "render/penumbra_sums.comp", textures, sizeof(shared::ShadowPush)) {
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
    grow(cmd, visibility_, "light visibility", 4 * std::max<vk::DeviceSize>(lights * samples, 1));
    grow(cmd, openness_, "openness", 4 * samples);
    std::uint32_t largest_block = 0;
    for (const SampleBlock& block : input.grid.blocks)
        largest_block = std::max(largest_block, block.width * block.height);
    const Penumbras penumbras{adaptive ? lights * largest_block : 0,
                              static_cast<std::uint32_t>(settings.shadow_samples)};
    if (adaptive) {
        grow(cmd, lists_, "penumbra lists", 3 * penumbras.list_bytes());
        if (penumbras.in_cells()) grow(cmd, words_, "penumbra cells", penumbras.word_bytes());
    }

    shared::ShadowPush push{};
    push.surfaces = input.surfaces.surfaces;
    push.scene = input.scene;
    push.noise = noise_.address();
    push.visibility = visibility_.address();
    push.openness = openness_.address();
    if (adaptive) {
        push.found = lists_.address();
        push.undecided = push.found + penumbras.list_bytes();
        push.whole = push.undecided + penumbras.list_bytes();
        if (penumbras.in_cells()) push.cells = words_.address();
    }
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
        // One block at a time: the lists are as long as a block could make them.
        if (adaptive) trace_penumbras(cmd, push, penumbras);
    }
    cmd.barrier(Access::RayTracingWrite, Access::RayTracingRead);
    cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
    return {visibility_.address(), openness_.address(), lights};
}

void ShadowStage::trace_penumbras(const gpu::Commands& cmd, const shared::ShadowPush& push,
                                  const Penumbras& penumbras) const {
    using gpu::Access;
    const std::uint32_t first = 1u << shared::penumbra_first_level(push.samples);
    const vk::Extent3D groups{group_size, 1, 1}, places{push.light_count * push.width * push.height, 1, 1};
    cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
    cmd.barrier(Access::RayTracingWrite, Access::TransferWrite);
    cmd.barrier(Access::IndirectRead, Access::TransferWrite);
    for (const auto& [list, height] :
         {std::pair{0u, first}, std::pair{1u, push.samples - first}, std::pair{2u, 1u}}) {
        const std::array<shared::PenumbraList, 1> empty{{{0, height, 1, 0}}};
        cmd->updateBuffer<shared::PenumbraList>(lists_.vk(), list * penumbras.list_bytes(), empty);
    }
    if (penumbras.in_cells()) cmd->fillBuffer(words_.vk(), 0, penumbras.word_bytes(), 0);
    cmd.barrier(Access::TransferWrite, Access::ComputeWrite);
    const auto compute_to_rays = [&] {
        cmd.barrier(Access::ComputeWrite, Access::IndirectRead);
        cmd.barrier(Access::ComputeWrite, Access::RayTracingWrite);
    };

    select_.dispatch(cmd, push, {push.width, push.height, 1}, {8, 8, 1});
    compute_to_rays();
    if (penumbras.in_cells()) {
        tracer_.trace_indirect(cmd, entries_.penumbra_rays, push, push.found);
        cmd.barrier(Access::RayTracingWrite, Access::ComputeWrite);
        cells_.dispatch(cmd, push, places, groups);
        compute_to_rays();
        shared::ShadowPush later = push;
        later.flags |= shared::SHADOWS_LATER_SAMPLES;
        tracer_.trace_indirect(cmd, entries_.penumbra_rays, later, push.undecided);
        cmd.barrier(Access::RayTracingWrite, Access::ComputeWrite);
        sums_.dispatch(cmd, push, places, groups);
        compute_to_rays();
    }
    tracer_.trace_indirect(cmd, entries_.penumbras, push, push.whole);
}

}  // namespace foveray::render
