#include "render/gpu/acceleration.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "base/error.h"

namespace foveray::gpu {
namespace {

using BuildFlag = vk::BuildAccelerationStructureFlagBitsKHR;

constexpr vk::DeviceSize batch_limit = 256ull
                                       << 20;  // bytes of scratch memory, and of structures before compaction
constexpr auto structure_usage = vk::BufferUsageFlagBits::eAccelerationStructureStorageKHR;

vk::GeometryFlagsKHR geometry_flags(bool opaque) {
    return opaque ? vk::GeometryFlagBitsKHR::eOpaque : vk::GeometryFlagBitsKHR::eNoDuplicateAnyHitInvocation;
}

vk::AccelerationStructureGeometryKHR describe(const TriangleGeometry& g) {
    const vk::AccelerationStructureGeometryTrianglesDataKHR triangles(
        vk::Format::eR32G32B32Sfloat, vk::DeviceOrHostAddressConstKHR(g.positions), g.position_stride,
        std::max(g.position_count, 1u) - 1, vk::IndexType::eUint32,
        vk::DeviceOrHostAddressConstKHR(g.indices));
    return {vk::GeometryTypeKHR::eTriangles, triangles, geometry_flags(g.opaque)};
}

vk::AccelerationStructureGeometryKHR describe(const BoxGeometry& g) {
    const vk::AccelerationStructureGeometryAabbsDataKHR boxes(vk::DeviceOrHostAddressConstKHR(g.boxes),
                                                              g.box_stride);
    return {vk::GeometryTypeKHR::eAabbs, boxes, geometry_flags(g.opaque)};
}

std::uint32_t primitive_count(const TriangleGeometry& g) { return g.triangle_count; }
std::uint32_t primitive_count(const BoxGeometry& g) { return g.box_count; }

/// A build in the terms of Vulkan. Keeps the arrays that `info` points to, so it stays where it is made.
struct Build {
    std::vector<vk::AccelerationStructureGeometryKHR> geometries;
    std::vector<vk::AccelerationStructureBuildRangeInfoKHR> ranges;
    vk::AccelerationStructureBuildGeometryInfoKHR info;

    Build(std::span<const AccelerationGeometry> all, bool deforms) {
        for (const AccelerationGeometry& one : all) {
            assert(one.index() == all.front().index());
            geometries.push_back(std::visit([](const auto& g) { return describe(g); }, one));
            ranges.emplace_back(std::visit([](const auto& g) { return primitive_count(g); }, one), 0, 0, 0);
        }
        info.type = vk::AccelerationStructureTypeKHR::eBottomLevel;
        info.flags = deforms ? BuildFlag::ePreferFastBuild | BuildFlag::eAllowUpdate
                             : BuildFlag::ePreferFastTrace | BuildFlag::eAllowCompaction;
        info.setGeometries(geometries);
    }
    Build(Build&&) = default;  // vectors keep their memory when moved

    vk::AccelerationStructureBuildSizesInfoKHR sizes(const Device& device) const {
        std::vector<std::uint32_t> counts;
        for (const auto& range : ranges) counts.push_back(range.primitiveCount);
        return device.vk().getAccelerationStructureBuildSizesKHR(
            vk::AccelerationStructureBuildTypeKHR::eDevice, info, counts);
    }
};

void record_builds(const Commands& cmd, std::span<const Build> builds) {
    std::vector<vk::AccelerationStructureBuildGeometryInfoKHR> infos;
    std::vector<const vk::AccelerationStructureBuildRangeInfoKHR*> ranges;
    for (const Build& build : builds) {
        infos.push_back(build.info);
        ranges.push_back(build.ranges.data());
    }
    cmd->buildAccelerationStructuresKHR(infos, ranges);
}

/// Later builds and traces see what was built or copied.
void order_after_builds(const Commands& cmd) {
    cmd.barrier(Access::AccelerationBuildWrite, Access::AccelerationBuildRead);
    cmd.barrier(Access::AccelerationBuildWrite, Access::RayTracingRead);
}

vk::DeviceSize align_up(vk::DeviceSize value, vk::DeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

vk::raii::AccelerationStructureKHR make_structure(const Device& device, const std::string& name,
                                                  const Buffer& memory,
                                                  vk::AccelerationStructureTypeKHR type) {
    vk::raii::AccelerationStructureKHR structure(device.vk(), {{}, memory.vk(), 0, memory.size(), type});
    device.set_name(*structure, name);
    return structure;
}

/// Sizes of structures after compaction, in the order given.
std::vector<vk::DeviceSize> compacted_sizes(const Device& device,
                                            std::span<const vk::AccelerationStructureKHR> structures) {
    const auto count = static_cast<std::uint32_t>(structures.size());
    vk::raii::QueryPool pool(device.vk(), {{}, vk::QueryType::eAccelerationStructureCompactedSizeKHR, count});
    device.set_name(*pool, "compacted sizes");
    pool.reset(0, count);
    submit_and_wait(device, [&](const Commands& cmd) {
        cmd->writeAccelerationStructuresPropertiesKHR(
            vk::ArrayProxy<const vk::AccelerationStructureKHR>(count, structures.data()),
            vk::QueryType::eAccelerationStructureCompactedSizeKHR, *pool, 0);
    });
    return pool
        .getResults<vk::DeviceSize>(0, count, count * sizeof(vk::DeviceSize), sizeof(vk::DeviceSize),
                                    vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
        .second;
}

}  // namespace

BottomLevel::BottomLevel(const Device& device, const std::string& name, vk::DeviceSize size)
    : buffer_(device, name + " memory", size, Residence::Device, structure_usage),
      structure_(make_structure(device, name, buffer_, vk::AccelerationStructureTypeKHR::eBottomLevel)),
      address_(device.vk().getAccelerationStructureAddressKHR({*structure_})) {}

/// Builds structures batch by batch.
class BottomLevelBuilder {
  public:
    BottomLevelBuilder(const Device& device, std::span<const BottomLevelInfo> infos,
                       vk::DeviceSize batch_limit)
        : device_(device), infos_(infos), batch_limit_(batch_limit) {}

    std::vector<BottomLevel> run() {
        levels_.reserve(infos_.size());
        while (levels_.size() < infos_.size()) {
            const std::size_t first = levels_.size();
            build_batch();
            compact(first);
        }
        return std::move(levels_);
    }

  private:
    /// Appends as many structures as the limit allows.
    void build_batch() {
        std::vector<Build> builds;
        std::vector<vk::DeviceSize> scratch_offsets;
        vk::DeviceSize scratch_used = 0, structures_used = 0;
        for (std::size_t i = levels_.size(); i < infos_.size(); ++i) {
            const BottomLevelInfo& info = infos_[i];
            Build build(info.geometries, info.deforms);
            const auto sizes = build.sizes(device_);
            const vk::DeviceSize scratch =
                align_up(sizes.buildScratchSize, device_.limits().scratch_alignment);
            const bool full = scratch_used + scratch > batch_limit_ ||
                              structures_used + sizes.accelerationStructureSize > batch_limit_;
            if (full && !builds.empty()) break;
            BottomLevel& level =
                levels_.emplace_back(BottomLevel(device_, info.name, sizes.accelerationStructureSize));
            if (info.deforms) {
                level.scratch_ =
                    Buffer(device_, info.name + " scratch",
                           std::max(sizes.buildScratchSize, sizes.updateScratchSize), Residence::Device);
            }
            build.info.dstAccelerationStructure = *level.structure_;
            builds.push_back(std::move(build));
            scratch_offsets.push_back(scratch_used);
            scratch_used += scratch;
            structures_used += sizes.accelerationStructureSize;
        }
        const Buffer scratch(device_, "bottom level build scratch", scratch_used, Residence::Device);
        for (std::size_t i = 0; i < builds.size(); ++i) {
            builds[i].info.scratchData.deviceAddress = scratch.address() + scratch_offsets[i];
        }
        submit_and_wait(device_, [&](const Commands& cmd) {
            record_builds(cmd, builds);
            order_after_builds(cmd);
        });
    }

    /// Replaces the structures from `first` on that do not deform by compact copies.
    void compact(std::size_t first) {
        std::vector<std::size_t> indices;
        std::vector<vk::AccelerationStructureKHR> structures;
        for (std::size_t i = first; i < levels_.size(); ++i) {
            if (infos_[i].deforms) continue;
            indices.push_back(i);
            structures.push_back(*levels_[i].structure_);
        }
        if (indices.empty()) return;
        const auto sizes = compacted_sizes(device_, structures);
        std::vector<BottomLevel> copies;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            copies.push_back(BottomLevel(device_, infos_[indices[i]].name, sizes[i]));
        }
        submit_and_wait(device_, [&](const Commands& cmd) {
            for (std::size_t i = 0; i < indices.size(); ++i) {
                cmd->copyAccelerationStructureKHR(
                    {structures[i], *copies[i].structure_, vk::CopyAccelerationStructureModeKHR::eCompact});
            }
            order_after_builds(cmd);
        });
        for (std::size_t i = 0; i < indices.size(); ++i) levels_[indices[i]] = std::move(copies[i]);
    }

    const Device& device_;
    std::span<const BottomLevelInfo> infos_;
    vk::DeviceSize batch_limit_;
    std::vector<BottomLevel> levels_;
};

std::vector<BottomLevel> build_bottom_levels(const Device& device, std::span<const BottomLevelInfo> infos,
                                             vk::DeviceSize batch_limit) {
    return BottomLevelBuilder(device, infos, batch_limit).run();
}

void update_bottom_levels(const Commands& cmd, std::span<const BottomLevelUpdate> updates) {
    if (updates.empty()) return;
    std::vector<Build> builds;
    for (const BottomLevelUpdate& update : updates) {
        assert(update.target->deforms());
        Build build(update.geometries, true);
        build.info.mode = update.refit ? vk::BuildAccelerationStructureModeKHR::eUpdate
                                       : vk::BuildAccelerationStructureModeKHR::eBuild;
        build.info.dstAccelerationStructure = *update.target->structure_;
        if (update.refit) build.info.srcAccelerationStructure = *update.target->structure_;
        build.info.scratchData.deviceAddress = update.target->scratch_.address();
        builds.push_back(std::move(build));
    }
    cmd.barrier(Access::RayTracingRead, Access::AccelerationBuildWrite);
    cmd.barrier(Access::AccelerationBuildWrite, Access::AccelerationBuildWrite);
    record_builds(cmd, builds);
    order_after_builds(cmd);
}

namespace {

vk::AccelerationStructureInstanceKHR describe(const TopLevelInstance& instance) {
    vk::AccelerationStructureInstanceKHR out;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            out.transform.matrix[row][column] = instance.world_from_object[column][row];
        }
    }
    assert(instance.custom_index < 1u << 24 && instance.record_offset < 1u << 24);
    out.instanceCustomIndex = instance.custom_index & 0xFFFFFFu;
    out.mask = instance.mask;
    out.instanceShaderBindingTableRecordOffset = instance.record_offset & 0xFFFFFFu;
    out.flags = static_cast<std::uint8_t>(static_cast<VkGeometryInstanceFlagsKHR>(instance.flags));
    out.accelerationStructureReference = instance.bottom_level;
    return out;
}

/// A top-level build of the instances at an address.
struct TopLevelBuild {
    vk::AccelerationStructureGeometryKHR geometry;
    vk::AccelerationStructureBuildGeometryInfoKHR info;

    explicit TopLevelBuild(vk::DeviceAddress instances)
        : geometry(vk::GeometryTypeKHR::eInstances,
                   vk::AccelerationStructureGeometryInstancesDataKHR(
                       VK_FALSE, vk::DeviceOrHostAddressConstKHR(instances))) {
        info.type = vk::AccelerationStructureTypeKHR::eTopLevel;
        info.flags = BuildFlag::ePreferFastTrace;
        info.setGeometries(geometry);
    }
    TopLevelBuild(const TopLevelBuild&) = delete;
};

}  // namespace

TopLevel::TopLevel(const Device& device, std::string name, std::uint32_t slots)
    : device_(device), name_(std::move(name)), slots_(slots) {}

void TopLevel::reserve(Slot& slot, std::uint32_t index, std::uint32_t count) {
    if (*slot.structure && count <= slot.capacity) return;
    const std::string name = name_ + " " + std::to_string(index);
    slot.structure = nullptr;
    slot.capacity = std::bit_ceil(std::max(count, 16u));
    const TopLevelBuild build(0);
    const auto sizes = device_.vk().getAccelerationStructureBuildSizesKHR(
        vk::AccelerationStructureBuildTypeKHR::eDevice, build.info, slot.capacity);
    slot.instances =
        Buffer(device_, name + " instances", slot.capacity * sizeof(VkAccelerationStructureInstanceKHR),
               Residence::Upload, build_input);
    slot.memory = Buffer(device_, name + " memory", sizes.accelerationStructureSize, Residence::Device,
                         structure_usage);
    slot.scratch = Buffer(device_, name + " scratch", sizes.buildScratchSize, Residence::Device);
    slot.structure = make_structure(device_, name, slot.memory, vk::AccelerationStructureTypeKHR::eTopLevel);
}

void TopLevel::build(const Commands& cmd, std::uint32_t slot_index,
                     std::span<const TopLevelInstance> instances) {
    if (instances.size() > device_.limits().max_instances) {
        throw_bad_input(
            name_, std::to_string(instances.size()) + " instances are more than " + device_.name() + " takes",
            "use at most " + std::to_string(device_.limits().max_instances));
    }
    const auto count = static_cast<std::uint32_t>(instances.size());
    Slot& slot = slots_[slot_index];
    reserve(slot, slot_index, count);
    std::vector<vk::AccelerationStructureInstanceKHR> data;
    data.reserve(count);
    for (const TopLevelInstance& instance : instances) data.push_back(describe(instance));
    slot.instances.write(range_bytes(data));
    TopLevelBuild build(slot.instances.address());
    build.info.dstAccelerationStructure = *slot.structure;
    build.info.scratchData.deviceAddress = slot.scratch.address();
    const vk::AccelerationStructureBuildRangeInfoKHR range(count, 0, 0, 0);
    cmd->buildAccelerationStructuresKHR(build.info, &range);
    cmd.barrier(Access::AccelerationBuildWrite, Access::RayTracingRead);
}

}  // namespace foveray::gpu
