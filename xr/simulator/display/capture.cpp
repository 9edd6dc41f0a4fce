#include "xr/simulator/display/capture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <future>
#include <string>

#include "base/error.h"

namespace foveray::simulator {
namespace {

bool is_linear(VkFormat format) {
    return format == VK_FORMAT_R8G8B8A8_UNORM || format == VK_FORMAT_B8G8R8A8_UNORM;
}

bool is_blue_first(VkFormat format) {
    return format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM;
}

std::uint8_t srgb_from_linear_byte(std::uint8_t linear) {
    static const auto table = [] {
        std::array<std::uint8_t, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            const float value = srgb_from_linear(static_cast<float>(i) / 255.0f);
            made[i] = static_cast<std::uint8_t>(std::lround(value * 255.0f));
        }
        return made;
    }();
    return table[linear];
}

VkImageMemoryBarrier layout_barrier(const SubImage& part, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = part.swapchain->image(part.image);
    barrier.subresourceRange = {part.swapchain->aspect(), 0, 1, part.array_index, 1};
    return barrier;
}

VkDeviceSize byte_count(const SubImage& part) {
    return VkDeviceSize{4} * static_cast<VkDeviceSize>(part.rect.extent.width) *
           static_cast<VkDeviceSize>(part.rect.extent.height);
}

/// Records the copy of the part's pixels into the buffer, rows without gaps.
void record_copy(const VulkanDevice& device, VkCommandBuffer commands, const SubImage& part, VkBuffer target,
                 VkDeviceSize offset) {
    const auto& f = device.functions();
    const VkImageLayout layout = part.swapchain->layout();
    constexpr auto source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    const VkImageMemoryBarrier to_source = layout_barrier(part, layout, source);
    f.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                           nullptr, 0, nullptr, 1, &to_source);
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {part.swapchain->aspect(), 0, part.array_index, 1};
    region.imageOffset = {part.rect.offset.x, part.rect.offset.y, 0};
    region.imageExtent = {static_cast<std::uint32_t>(part.rect.extent.width),
                          static_cast<std::uint32_t>(part.rect.extent.height), 1};
    f.vkCmdCopyImageToBuffer(commands, part.swapchain->image(part.image), source, target, 1, &region);

    const VkImageMemoryBarrier back = layout_barrier(part, source, layout);
    const VkMemoryBarrier to_host{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                                  VK_ACCESS_HOST_READ_BIT};
    f.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                           VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0,
                           nullptr, 1, &back);
}

/// Red first, sRGB, alpha as it is.
Image as_srgb(const SubImage& part, const std::uint8_t* bytes) {
    Image image(static_cast<std::uint32_t>(part.rect.extent.width),
                static_cast<std::uint32_t>(part.rect.extent.height), 4);
    std::copy_n(bytes, image.pixels.size(), image.pixels.begin());
    const VkFormat format = part.swapchain->format();
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        std::uint8_t* const pixel = &image.pixels[i];
        if (is_blue_first(format)) std::swap(pixel[0], pixel[2]);
        if (is_linear(format)) std::transform(pixel, pixel + 3, pixel, srgb_from_linear_byte);
    }
    return image;
}

Image without_alpha(const Image& image) {
    Image result(image.width, image.height, 3);
    for (std::size_t i = 0, n = std::size_t{image.width} * image.height; i < n; ++i) {
        std::copy_n(&image.pixels[4 * i], 3, &result.pixels[3 * i]);
    }
    return result;
}

Image to_image(const EyePicture& picture) {
    Image image(picture.size.x, picture.size.y, 4);
    std::ranges::copy(picture.bytes, image.pixels.begin());
    return image;
}

void write_raw(const std::filesystem::path& file, const Image& image) {
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(image.pixels.data()),
              static_cast<std::streamsize>(image.pixels.size()));
    if (!out.flush()) {
        throw_bad_input(file.string(), "cannot write the picture",
                        "check the folder's rights and free space");
    }
}

void write_picture(const Options& options, std::uint64_t frame, const std::string& what, const Image& image) {
    const std::string number = std::to_string(frame);
    const std::string name =
        "frame_" + std::string(number.size() < 5 ? 5 - number.size() : 0, '0') + number + "_" + what;
    if (options.capture_format == CaptureFormat::Png) {
        write_png(options.capture / (name + ".png"), without_alpha(image));
    } else {
        const std::string size = std::to_string(image.width) + "x" + std::to_string(image.height);
        write_raw(options.capture / (name + "_" + size + ".rgba"), image);
    }
}

}  // namespace

std::vector<Image> Capture::read_views(const Projection& projection) {
    VkDeviceSize size = 0;
    for (const ProjectionView& view : projection.views) size += byte_count(view.image);
    if (buffer_.size < size) {
        buffer_ = device_.create_buffer(size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, VulkanDevice::Place::Readback,
                                        "simulator capture");
    }
    device_.submit([&](VkCommandBuffer commands) {
        VkDeviceSize offset = 0;
        for (const ProjectionView& view : projection.views) {
            record_copy(device_, commands, view.image, *buffer_.buffer, offset);
            offset += byte_count(view.image);
        }
    });
    std::vector<Image> images;
    const auto* bytes = static_cast<const std::uint8_t*>(buffer_.mapped);
    for (const ProjectionView& view : projection.views) {
        images.push_back(as_srgb(view.image, bytes));
        bytes += byte_count(view.image);
    }
    return images;
}

void Capture::write(std::uint64_t frame, const std::vector<Layer>& layers, const EyePictures& shown) {
    std::vector<Image> images{to_image(shown[0]), to_image(shown[1])};
    std::vector<std::string> names{"left", "right"};
    if (const Projection* projection = rearmost_projection(layers)) {
        for (Image& view : read_views(*projection)) {
            names.push_back("view" + std::to_string(images.size() - 2));
            images.push_back(std::move(view));
        }
    }
    std::vector<std::future<void>> written;  // at once: compressing takes longer than all the rest
    for (std::size_t i = 0; i < images.size(); ++i) {
        written.push_back(
            std::async(std::launch::async, [&, i] { write_picture(options_, frame, names[i], images[i]); }));
    }
    for (std::future<void>& one : written) one.get();
}

}  // namespace foveray::simulator
