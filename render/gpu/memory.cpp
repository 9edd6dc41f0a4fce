#include "render/gpu/memory.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include <vk_mem_alloc.h>

#include "base/error.h"

namespace foveray::gpu {
namespace {

VmaAllocationCreateInfo allocation_info(Residence residence) {
    VmaAllocationCreateInfo info{};
    info.usage = VMA_MEMORY_USAGE_AUTO;
    switch (residence) {
        case Residence::Device:
            info.usage = VMA_MEMORY_USAGE_AUTO_PREFER_DEVICE;
            break;
        case Residence::Upload:
            info.flags =
                VMA_ALLOCATION_CREATE_MAPPED_BIT | VMA_ALLOCATION_CREATE_HOST_ACCESS_SEQUENTIAL_WRITE_BIT;
            break;
        case Residence::Readback:
            info.flags = VMA_ALLOCATION_CREATE_MAPPED_BIT | VMA_ALLOCATION_CREATE_HOST_ACCESS_RANDOM_BIT;
            break;
    }
    return info;
}

[[noreturn]] void throw_out_of_memory(const std::string& name, vk::DeviceSize size) {
    throw_missing("GPU memory", "no " + std::to_string(size >> 20) + " MiB left for " + name,
                  "use a smaller scene, or lower foveation.resolution_scale");
}

}  // namespace

Buffer::Buffer(const Device& device, const std::string& name, vk::DeviceSize size, Residence residence,
               vk::BufferUsageFlags extra)
    : allocator_(device.allocator()), size_(std::max<vk::DeviceSize>(size, 16)) {
    using Usage = vk::BufferUsageFlagBits;
    const vk::BufferCreateInfo info({}, size_,
                                    Usage::eStorageBuffer | Usage::eShaderDeviceAddress | Usage::eIndirectBuffer |
                                        Usage::eTransferSrc | Usage::eTransferDst | extra);
    const VmaAllocationCreateInfo allocation = allocation_info(residence);
    VkBuffer buffer = VK_NULL_HANDLE;
    VmaAllocationInfo result{};
    // Scratch memory and shader tables need up to 256-byte alignment.
    if (vmaCreateBufferWithAlignment(allocator_, reinterpret_cast<const VkBufferCreateInfo*>(&info),
                                     &allocation, 256, &buffer, &allocation_, &result) != VK_SUCCESS) {
        throw_out_of_memory(name, size_);
    }
    buffer_ = buffer;
    mapped_ = result.pMappedData;
    device.set_name(buffer_, name);
    address_ = device.vk().getBufferAddress({buffer_});
}

Buffer::~Buffer() {
    if (allocation_) vmaDestroyBuffer(allocator_, buffer_, allocation_);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(allocator_, other.allocator_);
    std::swap(allocation_, other.allocation_);
    std::swap(buffer_, other.buffer_);
    std::swap(size_, other.size_);
    std::swap(address_, other.address_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

void Buffer::write(std::span<const std::byte> data, vk::DeviceSize offset) {
    assert(mapped_ && offset + data.size() <= size_);
    std::memcpy(static_cast<std::byte*>(mapped_) + offset, data.data(), data.size());
    vmaFlushAllocation(allocator_, allocation_, offset, data.size());
}

void Buffer::invalidate() const { vmaInvalidateAllocation(allocator_, allocation_, 0, VK_WHOLE_SIZE); }

Image::Image(const Device& device, const std::string& name, const ImageInfo& info)
    : allocator_(device.allocator()), info_(info) {
    const vk::ImageCreateInfo create({}, vk::ImageType::e2D, info.format,
                                     {info.extent.width, info.extent.height, 1}, info.mip_levels, 1,
                                     vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, info.usage);
    const VmaAllocationCreateInfo allocation = allocation_info(Residence::Device);
    VkImage image = VK_NULL_HANDLE;
    if (vmaCreateImage(allocator_, reinterpret_cast<const VkImageCreateInfo*>(&create), &allocation, &image,
                       &allocation_, nullptr) != VK_SUCCESS) {
        throw_out_of_memory(name, vk::DeviceSize{4} * info.extent.width * info.extent.height);
    }
    image_ = image;
    device.set_name(image_, name);
    const bool depth = info.format == vk::Format::eD32Sfloat;
    view_ = vk::raii::ImageView(
        device.vk(), {{},
                      image_,
                      vk::ImageViewType::e2D,
                      info.format,
                      {},
                      {depth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor, 0,
                       info.mip_levels, 0, 1}});
    device.set_name(*view_, name + " view");
}

Image::~Image() {
    view_ = nullptr;
    if (allocation_) vmaDestroyImage(allocator_, image_, allocation_);
}

Image& Image::operator=(Image&& other) noexcept {
    std::swap(allocator_, other.allocator_);
    std::swap(allocation_, other.allocation_);
    std::swap(image_, other.image_);
    std::swap(view_, other.view_);
    std::swap(info_, other.info_);
    return *this;
}

vk::DeviceSize used_memory(const Device& device) {
    VmaTotalStatistics statistics{};
    vmaCalculateStatistics(device.allocator(), &statistics);
    return statistics.total.statistics.allocationBytes;
}

}  // namespace foveray::gpu
