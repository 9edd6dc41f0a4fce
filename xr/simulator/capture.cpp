#include "xr/simulator/capture.h"

#include <cmath>
#include <string>

#include "base/image.h"

namespace foveray::simulator {
namespace {

/// Linear light of each 8-bit value of the format.
using Decoding = std::array<float, 256>;

const Decoding& decoding_of(VkFormat format) {
    static const auto tables = [] {
        std::array<Decoding, 2> made{};
        for (std::size_t i = 0; i < 256; ++i) {
            made[0][i] = static_cast<float>(i) / 255.0f;
            made[1][i] = linear_from_srgb(made[0][i]);
        }
        return made;
    }();
    return tables[format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB];
}

bool is_blue_first(VkFormat format) {
    return format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM;
}

std::uint8_t srgb_byte(float linear) {
    constexpr std::size_t steps = 1 << 16;
    static const auto table = [] {
        std::vector<std::uint8_t> made(steps + 1);
        for (std::size_t i = 0; i <= steps; ++i) {
            const float value = srgb_from_linear(static_cast<float>(i) / static_cast<float>(steps));
            made[i] = static_cast<std::uint8_t>(std::lround(value * 255.0f));
        }
        return made;
    }();
    return table[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * static_cast<float>(steps) + 0.5f)];
}

Image as_displayed(const FloatImage& picture) {
    Image image(picture.width, picture.height, 3);
    for (std::size_t i = 0, n = std::size_t{picture.width} * picture.height; i < n; ++i) {
        for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = srgb_byte(picture.pixels[4 * i + c]);
    }
    return image;
}

std::string file_name(std::uint64_t frame, const std::string& what) {
    const std::string number = std::to_string(frame);
    return "frame_" + std::string(number.size() < 5 ? 5 - number.size() : 0, '0') + number + "_" + what +
           ".png";
}

VkImageMemoryBarrier layout_barrier(const SubImage& part, VkImage image, VkImageLayout from,
                                    VkImageLayout to) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {part.swapchain->aspect(), 0, 1, part.array_index, 1};
    return barrier;
}

/// Records the copy of the part's pixels into the buffer, rows without gaps.
void record_copy(const VulkanDevice& device, VkCommandBuffer commands, const SubImage& part,
                 VkBuffer target) {
    const auto& f = device.functions();
    const VkImage image = part.swapchain->shown();
    const VkImageLayout layout = part.swapchain->layout();
    constexpr auto source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    const VkImageMemoryBarrier to_source = layout_barrier(part, image, layout, source);
    f.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                           nullptr, 0, nullptr, 1, &to_source);
    VkBufferImageCopy region{};
    region.imageSubresource = {part.swapchain->aspect(), 0, part.array_index, 1};
    region.imageOffset = {part.rect.offset.x, part.rect.offset.y, 0};
    region.imageExtent = {static_cast<std::uint32_t>(part.rect.extent.width),
                          static_cast<std::uint32_t>(part.rect.extent.height), 1};
    f.vkCmdCopyImageToBuffer(commands, image, source, target, 1, &region);

    const VkImageMemoryBarrier back = layout_barrier(part, image, source, layout);
    VkMemoryBarrier to_host{};
    to_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    f.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                           VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0,
                           nullptr, 1, &back);
}

}  // namespace

ViewPicture Capture::read(const ProjectionLayer& layer, const ProjectionView& view) {
    const SubImage& part = view.image;
    const auto width = static_cast<std::uint32_t>(part.rect.extent.width);
    const auto height = static_cast<std::uint32_t>(part.rect.extent.height);
    const VkDeviceSize size = VkDeviceSize{4} * width * height;
    if (buffer_.size < size) buffer_ = device_.create_readback_buffer(size, "simulator capture");
    device_.submit([&](VkCommandBuffer commands) { record_copy(device_, commands, part, *buffer_.buffer); });

    const VkFormat format = part.swapchain->format();
    const Decoding& decoding = decoding_of(format);
    const int red = is_blue_first(format) ? 2 : 0;
    const bool has_alpha = layer.flags & XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
    const bool multiply = has_alpha && (layer.flags & XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT);
    ViewPicture picture{FloatImage(width, height, 4), view.fov};
    const auto* bytes = static_cast<const std::uint8_t*>(buffer_.mapped);
    for (float* out = picture.pixels.pixels.data(); out != picture.pixels.pixels.data() + size;
         out += 4, bytes += 4) {
        const float alpha = has_alpha ? static_cast<float>(bytes[3]) / 255.0f : 1.0f;
        const float factor = multiply ? alpha : 1.0f;
        out[0] = factor * decoding[bytes[red]];
        out[1] = factor * decoding[bytes[1]];
        out[2] = factor * decoding[bytes[2 - red]];
        out[3] = alpha;
    }
    return picture;
}

FloatImage Capture::show(std::span<const std::vector<ViewPicture>> layers, std::size_t eye) const {
    if (layers.empty()) return FloatImage(profile_.views[eye].size.x, profile_.views[eye].size.y, 4);
    const auto focus_of = [&](const std::vector<ViewPicture>& views) {
        return views.size() == 4 ? &views[2 + eye] : nullptr;
    };
    const uvec2 size = merged_size(layers.front()[eye], focus_of(layers.front()));
    FloatImage shown(size.x, size.y, 4);
    for (const auto& views : layers) blend_over(shown, merge(views[eye], focus_of(views), size));
    return shown;
}

void Capture::write(std::uint64_t frame, std::span<const ProjectionLayer> layers) {
    std::vector<std::vector<ViewPicture>> pictures;
    for (const ProjectionLayer& layer : layers) {
        auto& views = pictures.emplace_back();
        for (const ProjectionView& view : layer.views) views.push_back(read(layer, view));
    }
    if (!pictures.empty()) {
        for (std::size_t i = 0; i < pictures.front().size(); ++i) {
            write_png(options_.capture / file_name(frame, "view" + std::to_string(i)),
                      as_displayed(pictures.front()[i].pixels));
        }
    }
    write_png(options_.capture / file_name(frame, "left"), as_displayed(show(pictures, 0)));
    write_png(options_.capture / file_name(frame, "right"), as_displayed(show(pictures, 1)));
}

}  // namespace foveray::simulator
