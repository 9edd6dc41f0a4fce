#include "render/engine/table_tracer.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace foveray::engine {
namespace {

vk::raii::DescriptorSetLayout make_set_layout(const gpu::Device& device, const std::string& name) {
    const vk::DescriptorSetLayoutBinding binding(0, vk::DescriptorType::eAccelerationStructureKHR, 1,
                                                 vk::ShaderStageFlagBits::eRaygenKHR);
    vk::raii::DescriptorSetLayout layout(device.vk(), vk::DescriptorSetLayoutCreateInfo({}, binding));
    device.set_name(*layout, name + " scene layout");
    return layout;
}

vk::raii::DescriptorPool make_pool(const gpu::Device& device, const std::string& name, std::uint32_t slots) {
    const vk::DescriptorPoolSize size(vk::DescriptorType::eAccelerationStructureKHR, slots);
    vk::raii::DescriptorPool pool(
        device.vk(),
        vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, slots, size));
    device.set_name(*pool, name + " scene pool");
    return pool;
}

TableCounts counts_of(const gpu::RayTracingPipelineInfo& info) {
    return {static_cast<std::uint32_t>(info.ray_generation.size()),
            static_cast<std::uint32_t>(info.miss.size()), 0};
}

}  // namespace

TableTracer::TableTracer(const gpu::Device& device, const gpu::TextureTable& textures, std::uint32_t slots,
                         const gpu::RayTracingPipelineInfo& info, std::uint32_t record_size)
    : device_(&device),
      name_(info.name),
      counts_(counts_of(info)),
      record_size_(record_size),
      textures_(textures.set()),
      set_layout_(make_set_layout(device, info.name)),
      pool_(make_pool(device, info.name, slots)),
      pipeline_(device, info, textures, *set_layout_),
      slots_(slots) {
    for (std::uint32_t i = 0; i < slots; ++i) {
        vk::raii::DescriptorSets sets(device.vk(), vk::DescriptorSetAllocateInfo(*pool_, *set_layout_));
        slots_[i].set = std::move(sets.front());
        device.set_name(*slots_[i].set, name_ + " scene " + std::to_string(i));
    }
    set_entries({});
}

void TableTracer::set_entries(std::span<const RawEntry> entries) {
    counts_.hit = static_cast<std::uint32_t>(entries.size());
    layout_ = lay_out_table(device_->limits(), counts_, record_size_);
    bytes_.assign(layout_.size, std::byte{0});
    const auto put = [&](std::uint64_t offset, std::span<const std::byte> data) {
        std::copy(data.begin(), data.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(offset));
        return offset + data.size();
    };
    for (std::uint32_t i = 0; i < counts_.ray_generation; ++i) {
        put(layout_.ray_generation.record(i), pipeline_.ray_generation_handle(i));
    }
    for (std::uint32_t i = 0; i < counts_.miss; ++i) put(layout_.miss.record(i), pipeline_.miss_handle(i));
    for (std::uint32_t i = 0; i < counts_.hit; ++i) {
        assert(entries[i].record.size() <= record_size_);
        put(put(layout_.hit.record(i), pipeline_.hit_handle(entries[i].hit_group)), entries[i].record);
    }
    ++version_;
}

void TableTracer::prepare(const gpu::Commands& cmd, std::uint32_t slot_index, const gpu::TopLevel& scene) {
    current_ = slot_index;
    Slot& slot = slots_[slot_index];
    const vk::AccelerationStructureKHR structure = scene.vk(slot_index);
    const vk::WriteDescriptorSetAccelerationStructureKHR structures(structure);
    vk::WriteDescriptorSet write(*slot.set, 0, 0, 1, vk::DescriptorType::eAccelerationStructureKHR);
    write.pNext = &structures;
    device_->vk().updateDescriptorSets(write, {});

    if (slot.version == version_) return;
    if (slot.table.size() < bytes_.size()) {
        const std::string name = name_ + " shader table " + std::to_string(slot_index);
        slot.staging = gpu::Buffer(*device_, "staging for " + name, bytes_.size(), gpu::Residence::Upload);
        slot.table = gpu::Buffer(*device_, name, bytes_.size(), gpu::Residence::Device,
                                 vk::BufferUsageFlagBits::eShaderBindingTableKHR);
    }
    slot.staging.write(bytes_);
    cmd->copyBuffer(slot.staging.vk(), slot.table.vk(), vk::BufferCopy(0, 0, bytes_.size()));
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::RayTracingRead);
    slot.version = version_;
}

TableTracer::Regions TableTracer::bind(const gpu::Commands& cmd, std::uint32_t ray_generation,
                                       std::span<const std::byte> push) const {
    const Slot& slot = slots_[current_];
    assert(slot.version == version_ && ray_generation < counts_.ray_generation);
    const std::array sets = {textures_, *slot.set};
    constexpr auto point = vk::PipelineBindPoint::eRayTracingKHR;
    cmd->bindPipeline(point, pipeline_.vk());
    cmd->bindDescriptorSets(point, pipeline_.layout(), 0, sets, {});
    cmd->pushConstants<std::byte>(
        pipeline_.layout(), gpu::RayTracingPipeline::stages, 0,
        vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    const auto region = [&](std::uint64_t offset, std::uint32_t stride, std::uint64_t size) {
        return vk::StridedDeviceAddressRegionKHR(size == 0 ? 0 : slot.table.address() + offset, stride, size);
    };
    const auto whole = [&](const TableRegion& r) { return region(r.offset, r.stride, r.size()); };
    const TableRegion& generation = layout_.ray_generation;
    return {region(generation.record(ray_generation), generation.stride, generation.stride),
            whole(layout_.miss),
            whole(layout_.hit),
            {}};
}

void TableTracer::trace(const gpu::Commands& cmd, std::uint32_t ray_generation,
                        std::span<const std::byte> push, vk::Extent3D rays) const {
    if (rays.width == 0 || rays.height == 0 || rays.depth == 0) return;
    const Regions table = bind(cmd, ray_generation, push);
    cmd->traceRaysKHR(table.generation, table.miss, table.hit, table.callable, rays.width, rays.height,
                      rays.depth);
}

void TableTracer::trace_indirect(const gpu::Commands& cmd, std::uint32_t ray_generation,
                                 std::span<const std::byte> push, vk::DeviceAddress rays) const {
    const Regions table = bind(cmd, ray_generation, push);
    cmd->traceRaysIndirectKHR(table.generation, table.miss, table.hit, table.callable, rays);
}

}  // namespace foveray::engine
