#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "render/gpu/commands.h"

/// Acceleration structures. Buffers that a build reads need the usage `build_input`.
namespace foveray::gpu {

constexpr vk::BufferUsageFlags build_input =
    vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR;

struct TriangleGeometry {
    vk::DeviceAddress positions = 0;  // three floats each; at least 4-byte aligned
    std::uint32_t position_count = 0;
    std::uint32_t position_stride = 12;  // bytes
    vk::DeviceAddress indices = 0;       // uint32, three a triangle, each below position_count
    std::uint32_t triangle_count = 0;
    bool opaque = true;  // true: any-hit shaders are not called
};

struct BoxGeometry {
    vk::DeviceAddress boxes = 0;  // VkAabbPositionsKHR; 8-byte aligned
    std::uint32_t box_count = 0;
    std::uint32_t box_stride = 24;  // bytes, a multiple of 8
    bool opaque = true;
};

using AccelerationGeometry = std::variant<TriangleGeometry, BoxGeometry>;

struct BottomLevelInfo {
    std::string name;
    /// All triangles or all boxes. The order is gl_GeometryIndexEXT.
    std::vector<AccelerationGeometry> geometries;
    /// True: its vertices move, so it can be updated; false: built once, for fast tracing, and compacted.
    bool deforms = false;
};

struct BottomLevelUpdate;

/// A mesh's or a procedural object's structure. Move-only; must outlive every trace through it.
class BottomLevel {
  public:
    BottomLevel() = default;
    BottomLevel(BottomLevel&&) = default;
    BottomLevel& operator=(BottomLevel&&) = default;

    vk::DeviceAddress address() const { return address_; }
    vk::DeviceSize size() const { return buffer_.size(); }  // bytes
    bool deforms() const { return static_cast<bool>(scratch_); }

  private:
    friend class BottomLevelBuilder;
    friend void update_bottom_levels(const Commands&, std::span<const BottomLevelUpdate>);

    BottomLevel(const Device& device, const std::string& name, vk::DeviceSize size);

    Buffer buffer_;
    Buffer scratch_;  // of structures that deform
    vk::raii::AccelerationStructureKHR structure_ = nullptr;
    vk::DeviceAddress address_ = 0;
};

/// Builds all of them and waits: set-up work. The result has the order of `infos`. What the builds read must
/// be on the GPU (Uploader::flush). As many are built at once as `batch_limit` bytes of scratch memory hold,
/// and of structures before compaction, but at least one.
std::vector<BottomLevel> build_bottom_levels(const Device& device, std::span<const BottomLevelInfo> infos,
                                             vk::DeviceSize batch_limit = 256ull << 20);

struct BottomLevelUpdate {
    BottomLevel* target = nullptr;  // made with `deforms`
    /// As it was built, but for the addresses: same kinds and counts, same index values.
    std::span<const AccelerationGeometry> geometries;
    bool refit = true;  // false: rebuild, slower, and traced faster after large movements
};

/// Records into the frame. Orders itself after earlier traces, and before later builds and traces; the caller
/// orders it after whatever wrote the vertices (to Access::AccelerationBuildInput).
void update_bottom_levels(const Commands& cmd, std::span<const BottomLevelUpdate> updates);

struct TopLevelInstance {
    glm::mat4x3 world_from_object{1.0f};  // four columns of three
    std::uint32_t custom_index = 0;       // gl_InstanceCustomIndexEXT, 24 bits
    std::uint32_t record_offset = 0;      // hit records before this instance's, 24 bits: RayTracer::set_table
    std::uint8_t mask = 0xFF;
    vk::GeometryInstanceFlagsKHR flags{};
    vk::DeviceAddress bottom_level = 0;
};

/// The structure that rays are traced into, made anew each frame. Each frame slot has its own memory, which
/// grows.
class TopLevel {
  public:
    TopLevel(const Device& device, std::string name, std::uint32_t slots);

    /// Records the build; gl_InstanceID is the index into `instances`. Orders itself after earlier builds,
    /// and before later traces. The slot's earlier frame must be done (FrameRing::begin sees to it). Throws
    /// Fault(BadInput) when there are more instances than the device takes.
    void build(const Commands& cmd, std::uint32_t slot, std::span<const TopLevelInstance> instances);

    vk::AccelerationStructureKHR vk(std::uint32_t slot) const { return *slots_[slot].structure; }

  private:
    struct Slot {
        Buffer instances, memory, scratch;
        vk::raii::AccelerationStructureKHR structure = nullptr;
        std::uint32_t capacity = 0;
    };
    void reserve(Slot& slot, std::uint32_t index, std::uint32_t count);

    const Device& device_;
    std::string name_;
    std::vector<Slot> slots_;
};

}  // namespace foveray::gpu
