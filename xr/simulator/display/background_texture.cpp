#include "xr/simulator/display/background_texture.h"

#include <cstring>

#include "base/error.h"

namespace foveray::simulator {
namespace {

VkImageCreateInfo image_info(const BackgroundPicture& picture) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = picture.format;
    info.extent = {picture.size.x, picture.size.y, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    return info;
}

VkImageMemoryBarrier layout_barrier(VkImage image, VkImageLayout from, VkAccessFlags written,
                                    VkImageLayout to, VkAccessFlags next) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = written;
    barrier.dstAccessMask = next;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    return barrier;
}

}  // namespace

BackgroundTexture::BackgroundTexture(const VulkanDevice& device, const Background& background)
    : device_(device), background_(background) {
    if (background.kind == Background::Kind::Color) {
        upload({uvec2(1), VK_FORMAT_R8G8B8A8_SRGB, {0, 0, 0, 255}});
    } else {
        prepare(0);
    }
}

void BackgroundTexture::prepare(std::uint64_t frame) {
    if (background_.kind == Background::Kind::Color || background_.file_of(frame) == shown_) return;
    shown_ = background_.file_of(frame);
    upload(read_background_picture(shown_));
}

void BackgroundTexture::upload(const BackgroundPicture& picture) {
    const VkImageCreateInfo info = image_info(picture);
    if (!device_.supports(info)) {
        throw_bad_input(shown_.string(), "the GPU has no pictures of this size", "use a smaller one");
    }
    if (picture.size != size_ || picture.format != format_) {
        view_ = {};
        image_ = device_.create_image(info, "simulator background");
        view_ = device_.create_view(*image_.image, info.format, VK_IMAGE_ASPECT_COLOR_BIT, 0,
                                    "simulator background view");
        size_ = picture.size;
        format_ = picture.format;
    }
    if (staging_.size < picture.pixels.size()) {
        staging_ = device_.create_buffer(picture.pixels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                         VulkanDevice::Place::Upload, "simulator background upload");
    }
    std::memcpy(staging_.mapped, picture.pixels.data(), picture.pixels.size());
    is_changed_ = true;
}

void BackgroundTexture::record(VkCommandBuffer commands) {
    if (!is_changed_) return;
    is_changed_ = false;
    const auto& f = device_.functions();
    constexpr auto target = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    const VkImageMemoryBarrier before =
        layout_barrier(*image_.image, VK_IMAGE_LAYOUT_UNDEFINED, 0, target, VK_ACCESS_TRANSFER_WRITE_BIT);
    f.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0,
                           0, nullptr, 0, nullptr, 1, &before);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {size_.x, size_.y, 1};
    f.vkCmdCopyBufferToImage(commands, *staging_.buffer, *image_.image, target, 1, &region);
    const VkImageMemoryBarrier after =
        layout_barrier(*image_.image, target, VK_ACCESS_TRANSFER_WRITE_BIT,
                       VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT);
    f.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0,
                           0, nullptr, 0, nullptr, 1, &after);
}

}  // namespace foveray::simulator
