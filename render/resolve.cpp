#include "render/resolve.h"

#include <algorithm>
#include <cmath>

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

ViewImages ResolveStage::images(const gpu::Commands& cmd, std::span<const View> views, bool layers) {
    vk::DeviceSize most = 0;
    for (const View& view : views) most = std::max(most, vk::DeviceSize{view.size.x} * view.size.y);
    grow(cmd, resolved_, "resolved pixels", most * sizeof(shared::ResolvedPixel));
    if (layers) grow(cmd, real_, "resolved real pixels", most * sizeof(shared::ResolvedRealPixel));

    ViewImages result;
    result.resolved = &resolved_;
    result.real = layers ? &real_ : nullptr;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const uvec2 size = views[i].size;
        const vk::DeviceSize pixels = vk::DeviceSize{size.x} * size.y;
        Buffers& buffers = buffers_[i];
        grow(cmd, buffers.color, "colour", pixels * sizeof(std::uint32_t));
        grow(cmd, buffers.depth, "depth", pixels * sizeof(float));
        result.images.push_back({resolved_.address(), layers ? real_.address() : 0, buffers.color.address(),
                                 buffers.depth.address(), size});
        result.buffers.push_back({&buffers.color, &buffers.depth});
    }
    return result;
}

void ResolveStage::record(const gpu::Commands& cmd, const LightLayers& light, const SampleGrid& grid,
                          const ViewImages& images, std::size_t view, const Settings& settings) {
    using gpu::Access;
    const auto stage = cmd.stage("resolve");
    // Whoever made and read the pictures before.
    for (const Access before : {Access::ComputeWrite, Access::ComputeRead, Access::TransferRead})
        cmd.barrier(before, Access::ComputeWrite);

    const shared::ViewImage& image = images.images[view];
    shared::ResolvePush push{};
    push.grid = grid.at(0);
    push.samples = light.samples;
    push.packed = light.packed;
    push.guides = light.guides;
    push.layers = light.packed_layers;
    push.resolved = image.resolved;
    push.real = image.real;
    push.depth = image.depth;
    push.view = static_cast<std::uint32_t>(view);
    push.filter_kind =
        settings.resolve_filter == "bilinear" ? shared::RESOLVE_BILINEAR : shared::RESOLVE_BICUBIC;
    push.debug_view = debug_view(settings);
    push.white = std::exp2(-settings.exposure_ev);
    pipeline_.dispatch(cmd, push, {image.size.x, image.size.y, 1}, {8, 8, 1});
    cmd.barrier(Access::ComputeWrite, Access::ComputeRead);
}

}  // namespace foveray::render
