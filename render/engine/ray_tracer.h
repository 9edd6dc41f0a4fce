#pragma once

#include <algorithm>
#include <cstdint>
#include <variant>
#include <vector>

#include "render/engine/program.h"
#include "render/engine/table_tracer.h"

namespace foveray::engine {

/// A Program made ready to trace. Its shader table is derived in two passes, entries then layout, and kept
/// once a frame slot, so that records may change while an earlier frame still uses theirs.
///
/// In a frame: set_table (only when records changed), prepare, then trace as often as wished.
template <std::uint32_t ray_type_count, class... Records>
class RayTracer {
  public:
    using Program = engine::Program<ray_type_count, Records...>;
    using Geometry = typename Program::Geometry;
    /// The geometries of one bottom-level structure, in its order. Instances that share records share a
    /// range.
    using Range = std::vector<Geometry>;

    /// `slots`: frames in flight.
    RayTracer(const gpu::Device& device, const gpu::TextureTable& textures, std::uint32_t slots,
              Program program)
        : program_(std::move(program)),
          tracer_(device, textures, slots, pipeline_info(program_),
                  static_cast<std::uint32_t>(std::max({sizeof(Records)...}))) {}

    const Program& program() const { return program_; }

    /// Says what every hit record holds from the next prepare() on. Returns for each range what its instances
    /// put into gpu::TopLevelInstance::record_offset; it changes only when the number of geometries in a
    /// range does. Throws Fault(BadInput) when the table outgrows the 24 bits that an instance has for it.
    std::vector<std::uint32_t> set_table(const std::vector<Range>& ranges) {
        std::vector<std::uint32_t> counts;
        for (const Range& range : ranges) counts.push_back(static_cast<std::uint32_t>(range.size()));
        auto offsets = record_offsets(counts, ray_type_count);
        entries_ = program_.entries(ranges);
        std::vector<RawEntry> raw;
        raw.reserve(entries_.size());
        for (const auto& entry : entries_) {
            raw.push_back(
                {entry.hit_group, std::visit([](const auto& r) { return gpu::bytes_of(r); }, entry.record)});
        }
        tracer_.set_entries(raw);
        return offsets;
    }

    /// Once a frame, after scene.build(cmd, slot, …) and before the traces: makes the slot's table current
    /// and binds the slot's acceleration structure. The slot's earlier frame must be done (FrameRing::begin
    /// sees to it).
    void prepare(const gpu::Commands& cmd, std::uint32_t slot, const gpu::TopLevel& scene) {
        tracer_.prepare(cmd, slot, scene);
    }

    /// Runs the ray-generation shader `rays.width × height × depth` times. `push` has up to 128 bytes, mostly
    /// addresses. The caller orders it against what it reads and writes (Access::RayTracingRead,
    /// RayTracingWrite).
    template <class Push>
    void trace(const gpu::Commands& cmd, RayGeneration ray_generation, const Push& push,
               vk::Extent3D rays) const {
        static_assert(sizeof(Push) <= gpu::RayTracingPipeline::push_size && sizeof(Push) % 4 == 0);
        tracer_.trace(cmd, ray_generation.index, gpu::bytes_of(push), rays);
    }

    /// The same for as many rays as stand at the address, in a buffer: VkTraceRaysIndirectCommandKHR
    /// (Access::IndirectRead). A size of 0 is allowed.
    template <class Push>
    void trace_indirect(const gpu::Commands& cmd, RayGeneration ray_generation, const Push& push,
                        vk::DeviceAddress rays) const {
        static_assert(sizeof(Push) <= gpu::RayTracingPipeline::push_size && sizeof(Push) % 4 == 0);
        tracer_.trace_indirect(cmd, ray_generation.index, gpu::bytes_of(push), rays);
    }

    const TableLayout& layout() const { return tracer_.layout(); }

    /// What a ray of that type finds at a geometry of an instance with that record offset: the entry of the
    /// newest table by the formula that shaders use. Throws Fault(Internal) when there is none.
    const typename Program::Entry& entry(std::uint32_t record_offset, std::uint32_t geometry,
                                         std::uint32_t ray_type) const {
        const std::uint64_t index =
            std::uint64_t{record_offset} + std::uint64_t{ray_type_count} * geometry + ray_type;
        if (ray_type >= ray_type_count || index >= entries_.size() || record_offset % ray_type_count != 0) {
            throw Fault(ExitCode::Internal, "program \"" + program_.name() + "\"",
                        "the shader table has " + std::to_string(entries_.size()) + " hit records for " +
                            std::to_string(ray_type_count) + " ray types, none for record offset " +
                            std::to_string(record_offset) + ", geometry " + std::to_string(geometry) +
                            ", ray type " + std::to_string(ray_type),
                        "take the offset from set_table");
        }
        return entries_[index];
    }

  private:
    static gpu::RayTracingPipelineInfo pipeline_info(const Program& program) {
        gpu::RayTracingPipelineInfo info{
            program.name(), program.ray_generation(), {}, program.hit_groups(), program.own_shaders()};
        for (const RayType& type : program.ray_types()) info.miss.push_back(type.miss_shader);
        return info;
    }

    Program program_;
    TableTracer tracer_;
    std::vector<typename Program::Entry> entries_;
};

}  // namespace foveray::engine
