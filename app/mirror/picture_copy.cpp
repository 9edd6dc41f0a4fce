#include "app/mirror/picture_copy.h"

#include <algorithm>
#include <array>
#include <bit>

namespace foveray::app {
namespace {

using Layout = vk::ImageLayout;
using gpu::Access;

constexpr auto aspect = vk::ImageAspectFlagBits::eColor;

std::array<vk::Offset3D, 2> region(vec2 min, vec2 max) {
    const auto corner = [](vec2 p, int z) {
        return vk::Offset3D(static_cast<int>(p.x + 0.5f), static_cast<int>(p.y + 0.5f), z);
    };
    return {corner(min, 0), corner(max, 1)};
}

}  // namespace

void PictureCopy::record(const gpu::Commands& cmd, vk::Buffer source, vk::DeviceSize offset, uvec2 size,
                         vk::Image target, vk::Extent2D bounds, const Rect& place) {
    if (!image_ || image_.info().extent != vk::Extent2D(size.x, size.y)) {
        gpu::ImageInfo info;
        info.extent = vk::Extent2D(size.x, size.y);
        info.mip_levels = static_cast<std::uint32_t>(std::bit_width(std::min(size.x, size.y)));
        info.usage = vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst |
                     vk::ImageUsageFlagBits::eSampled;  // gpu::Image has a view, which needs a use
        image_ = gpu::Image(cmd.device(), "mirror picture", info);
    }
    gpu::transition(cmd.vk(), image_.vk(), Access::TransferRead, Layout::eUndefined, Access::TransferWrite,
                    Layout::eTransferDstOptimal);
    cmd->copyBufferToImage(source, image_.vk(), Layout::eTransferDstOptimal,
                           vk::BufferImageCopy(offset, 0, 0, {aspect, 0, 0, 1}, {}, {size.x, size.y, 1}));
    const auto finish_level = [&](std::uint32_t level) {
        gpu::transition(cmd.vk(), image_.vk(), Access::TransferWrite, Layout::eTransferDstOptimal,
                        Access::TransferRead, Layout::eTransferSrcOptimal, aspect, level, 1);
    };
    finish_level(0);

    // Halve it until the last step, which is linear, skips no pixels.
    std::uint32_t level = 0;
    const auto size_at = [&](std::uint32_t l) { return glm::max(size >> l, uvec2(1)); };
    while (level + 1 < image_.info().mip_levels &&
           static_cast<float>(size_at(level).x) > 2.0f * place.size().x) {
        const std::array from = region({0, 0}, size_at(level)), to = region({0, 0}, size_at(level + 1));
        cmd->blitImage(image_.vk(), Layout::eTransferSrcOptimal, image_.vk(), Layout::eTransferDstOptimal,
                       vk::ImageBlit({aspect, level, 0, 1}, from, {aspect, level + 1, 0, 1}, to),
                       vk::Filter::eLinear);
        finish_level(++level);
    }

    const vec2 limit(bounds.width, bounds.height);
    const Rect seen{glm::max(place.min, vec2(0.0f)), glm::min(place.max, limit)};
    if (seen.size().x < 1.0f || seen.size().y < 1.0f) return;
    const vec2 scale = vec2(size_at(level)) / place.size();
    const std::array from = region((seen.min - place.min) * scale, (seen.max - place.min) * scale);
    cmd->blitImage(image_.vk(), Layout::eTransferSrcOptimal, target, Layout::eTransferDstOptimal,
                   vk::ImageBlit({aspect, level, 0, 1}, from, {aspect, 0, 0, 1}, region(seen.min, seen.max)),
                   vk::Filter::eLinear);
}

}  // namespace foveray::app
