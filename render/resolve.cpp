#include "render/resolve.h"

#include "render/grow.h"
#include "shaders/shared/resolve.h"

namespace foveray::render {
namespace {

std::uint32_t debug_view(const Settings& settings) {
    if (settings.debug_view == "tiles") return shared::RESOLVE_DEBUG_TILES;
    if (settings.debug_view == "samples") return shared::RESOLVE_DEBUG_SAMPLES;
    return shared::RESOLVE_DEBUG_NONE;
}

}  // namespace

ResolveStage::ResolveStage(const gpu::Device& device, const gpu::TextureTable& textures)
    : pipeline_(device, "render/resolve.comp", textures, sizeof(shared::ResolvePush)) {}

ViewImages ResolveStage::record(const gpu::Commands& cmd, const LightLayers& light, const SampleGrid& grid,
                                std::span<const View> views, bool layers, const Settings& settings) {
    using gpu::Access;
    const auto stage = cmd.stage("resolve");
    // Whoever made and read the pictures of the frame before.
    cmd.barrier(Access::ComputeWrite, Access::ComputeWrite);
    cmd.barrier(Access::TransferRead, Access::ComputeWrite);
    ViewImages result;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const uvec2 size = views[i].size;
        const vk::DeviceSize pixels = vk::DeviceSize{size.x} * size.y;
        Buffers& buffers = buffers_[i];
        grow(cmd, buffers.resolved, "resolved pixels", pixels * sizeof(shared::ResolvedPixel));
        grow(cmd, buffers.color, "colour", pixels * sizeof(std::uint32_t));
        grow(cmd, buffers.depth, "depth", pixels * sizeof(float));
        if (layers)
            grow(cmd, buffers.real, "resolved real pixels", pixels * sizeof(shared::ResolvedRealPixel));
        result.images.push_back({buffers.resolved.address(), layers ? buffers.real.address() : 0,
                                 buffers.color.address(), buffers.depth.address(), size});
        result.buffers.push_back(
            {&buffers.resolved, layers ? &buffers.real : nullptr, &buffers.color, &buffers.depth});

        shared::ResolvePush push{};
        push.grid = grid.at(0);
        push.samples = light.samples;
        push.packed = light.packed;
        push.guides = light.guides;
        push.layers = light.packed_layers;
        push.resolved = buffers.resolved.address();
        push.real = result.images.back().real;
        push.depth = buffers.depth.address();
        push.view = static_cast<std::uint32_t>(i);
        push.filter_kind =
            settings.resolve_filter == "bilinear" ? shared::RESOLVE_BILINEAR : shared::RESOLVE_BICUBIC;
        push.debug_view = debug_view(settings);
        pipeline_.dispatch(cmd, push, {size.x, size.y, 1}, {8, 8, 1});
    }
    cmd.barrier(Access::ComputeWrite, Access::ComputeRead);
    return result;
}

}  // namespace foveray::render
