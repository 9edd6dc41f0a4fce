#include "render/engine/table_layout.h"

#include <string>

#include "base/error.h"
#include "shaders/shared/ray_types.h"

namespace foveray::engine {
namespace {

std::uint64_t align_up(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

}  // namespace

TableLayout lay_out_table(const gpu::RayTracingLimits& limits, const TableCounts& counts,
                          std::uint32_t record_size) {
    const auto stride = [&](std::uint64_t size, std::uint64_t alignment) {
        const std::uint64_t aligned = align_up(size, alignment);
        if (aligned > limits.max_record_stride) {
            throw_missing("shader table",
                          "a record takes " + std::to_string(aligned) + " bytes, but the device allows " +
                              std::to_string(limits.max_record_stride),
                          "use another GPU (--gpu), or fewer parameters in the largest record");
        }
        return static_cast<std::uint32_t>(aligned);
    };
    TableLayout layout;
    const auto add = [&](std::uint32_t record_stride, std::uint32_t count) {
        const TableRegion region{align_up(layout.size, limits.base_alignment), record_stride, count};
        layout.size = region.offset + region.size();
        return region;
    };
    const std::uint64_t region_alignment = align_up(limits.base_alignment, limits.handle_alignment);
    layout.ray_generation = add(stride(limits.handle_size, region_alignment), counts.ray_generation);
    layout.miss = add(stride(limits.handle_size, limits.handle_alignment), counts.miss);
    layout.hit =
        add(stride(std::uint64_t{limits.handle_size} + record_size, limits.handle_alignment), counts.hit);
    return layout;
}

std::vector<std::uint32_t> record_offsets(std::span<const std::uint32_t> geometry_counts,
                                          std::uint32_t ray_type_count) {
    std::vector<std::uint32_t> offsets;
    std::uint64_t geometries = 0;
    for (const std::uint32_t count : geometry_counts) {
        offsets.push_back(
            shared::instance_record_offset(static_cast<std::uint32_t>(geometries), ray_type_count));
        geometries += count;
        if (geometries * ray_type_count > 1u << 24) {
            throw_bad_input("shader table", "the scene has more geometries than a shader table holds",
                            "join meshes that share a material");
        }
    }
    return offsets;
}

}  // namespace foveray::engine
