#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/engine/table_layout.h"
#include "render/gpu/acceleration.h"
#include "render/gpu/ray_tracing_pipeline.h"

namespace foveray::engine {

/// A hit record whose type is forgotten.
struct RawEntry {
    std::uint32_t hit_group = 0;
    std::span<const std::byte> record;
};

/// The part of RayTracer that knows no record types: pipeline, descriptor sets, and the shader table's
/// memory.
class TableTracer {
  public:
    TableTracer(const gpu::Device& device, const gpu::TextureTable& textures, std::uint32_t slots,
                const gpu::RayTracingPipelineInfo& info, std::uint32_t record_size);

    void set_entries(std::span<const RawEntry> entries);
    void prepare(const gpu::Commands& cmd, std::uint32_t slot, const gpu::TopLevel& scene);
    void trace(const gpu::Commands& cmd, std::uint32_t ray_generation, std::span<const std::byte> push,
               vk::Extent3D rays) const;
    void trace_indirect(const gpu::Commands& cmd, std::uint32_t ray_generation,
                        std::span<const std::byte> push, vk::DeviceAddress rays) const;

    const TableLayout& layout() const { return layout_; }

  private:
    /// The regions of the slot's table, in traceRaysKHR's order.
    struct Regions {
        vk::StridedDeviceAddressRegionKHR generation, miss, hit, callable;
    };
    Regions bind(const gpu::Commands& cmd, std::uint32_t ray_generation,
                 std::span<const std::byte> push) const;

    struct Slot {
        vk::raii::DescriptorSet set = nullptr;
        gpu::Buffer staging, table;
        std::uint64_t version = 0;  // of the bytes in table
    };

    const gpu::Device* device_;
    std::string name_;
    TableCounts counts_;
    std::uint32_t record_size_;
    vk::DescriptorSet textures_;
    vk::raii::DescriptorSetLayout set_layout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    gpu::RayTracingPipeline pipeline_;
    TableLayout layout_;
    std::vector<std::byte> bytes_;  // the table as it should be
    std::uint64_t version_ = 0;     // of bytes_
    std::vector<Slot> slots_;
    std::uint32_t current_ = 0;
};

}  // namespace foveray::engine
