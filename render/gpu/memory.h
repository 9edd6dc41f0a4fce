#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "render/gpu/device.h"

struct VmaAllocation_T;

namespace foveray::gpu {

enum class Residence {
    Device,    // fastest for the GPU; filled by copies and shaders
    Upload,    // written by the CPU in order, read by the GPU
    Readback,  // written by the GPU, read by the CPU
};

/// A buffer that shaders reach by its address; also source and target of copies. Move-only.
class Buffer {
  public:
    Buffer() = default;
    /// `extra` adds usages to storage, device address and transfers. A size of 0 becomes 16 bytes, so that
    /// every buffer has an address.
    Buffer(const Device& device, const std::string& name, vk::DeviceSize size, Residence residence,
           vk::BufferUsageFlags extra = {});
    ~Buffer();
    Buffer(Buffer&& other) noexcept { *this = std::move(other); }
    Buffer& operator=(Buffer&& other) noexcept;

    explicit operator bool() const { return allocation_ != nullptr; }
    vk::Buffer vk() const { return buffer_; }
    vk::DeviceSize size() const { return size_; }
    vk::DeviceAddress address() const { return address_; }

    /// Upload and Readback only. Readback: call invalidate() before reading what the GPU wrote.
    std::span<std::byte> mapped() const {
        return {static_cast<std::byte*>(mapped_), static_cast<std::size_t>(size_)};
    }
    template <typename T>
    std::span<T> mapped_as() const {
        return {static_cast<T*>(mapped_), static_cast<std::size_t>(size_) / sizeof(T)};
    }
    /// Copies to mapped memory at a byte offset and makes it visible to the GPU.
    void write(std::span<const std::byte> data, vk::DeviceSize offset = 0);
    void invalidate() const;

  private:
    VmaAllocator_T* allocator_ = nullptr;
    VmaAllocation_T* allocation_ = nullptr;
    vk::Buffer buffer_;
    vk::DeviceSize size_ = 0;
    vk::DeviceAddress address_ = 0;
    void* mapped_ = nullptr;
};

struct ImageInfo {
    vk::Extent2D extent;
    vk::Format format = vk::Format::eR8G8B8A8Unorm;
    std::uint32_t mip_levels = 1;
    vk::ImageUsageFlags usage;
};

/// A 2D image with a view of all its levels. Move-only.
class Image {
  public:
    Image() = default;
    Image(const Device& device, const std::string& name, const ImageInfo& info);
    ~Image();
    Image(Image&& other) noexcept { *this = std::move(other); }
    Image& operator=(Image&& other) noexcept;

    explicit operator bool() const { return allocation_ != nullptr; }
    vk::Image vk() const { return image_; }
    vk::ImageView view() const { return *view_; }
    const ImageInfo& info() const { return info_; }

  private:
    VmaAllocator_T* allocator_ = nullptr;
    VmaAllocation_T* allocation_ = nullptr;
    vk::Image image_;
    vk::raii::ImageView view_ = nullptr;
    ImageInfo info_;
};

/// Bytes of device memory that foveray holds.
vk::DeviceSize used_memory(const Device& device);

template <typename T>
std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span<const T>(&value, 1));
}
template <typename Range>
std::span<const std::byte> range_bytes(const Range& range) {
    return std::as_bytes(std::span(range));
}

}  // namespace foveray::gpu
