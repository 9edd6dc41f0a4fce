#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/gpu/device.h"

namespace foveray::engine {

/// Records of one kind, one after the other. Bytes.
struct TableRegion {
    std::uint64_t offset = 0;  // from the start of the table
    std::uint32_t stride = 0;
    std::uint32_t count = 0;

    std::uint64_t size() const { return std::uint64_t{stride} * count; }
    std::uint64_t record(std::uint32_t index) const { return offset + std::uint64_t{stride} * index; }
    bool operator==(const TableRegion&) const = default;
};

struct TableLayout {
    /// A trace takes one ray-generation record as a region of its own, so that each is aligned as a region.
    TableRegion ray_generation;
    TableRegion miss;  // by ray type
    TableRegion hit;   // by shared::hit_record_index
    std::uint64_t size = 0;

    bool operator==(const TableLayout&) const = default;
};

struct TableCounts {
    std::uint32_t ray_generation = 0, miss = 0, hit = 0;
};

/// Where everything lies in a shader table whose hit records carry up to `record_size` bytes each after their
/// handle. Throws Fault(Missing) when the device allows no record of that size.
TableLayout lay_out_table(const gpu::RayTracingLimits& limits, const TableCounts& counts,
                          std::uint32_t record_size);

/// What the instances of each range of geometries put into instanceShaderBindingTableRecordOffset, given how
/// many geometries each range has. Throws Fault(BadInput) when the table outgrows the 24 bits there.
std::vector<std::uint32_t> record_offsets(std::span<const std::uint32_t> geometry_counts,
                                          std::uint32_t ray_type_count);

}  // namespace foveray::engine
