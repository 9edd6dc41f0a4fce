#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.h"
#include "render/gpu/ray_tracing_pipeline.h"

/// Proceduray's entities in Vulkan's terms: ray types, hit groups, geometry types, records, table entries
/// (Proceduray sections 3 and 4). Users declare them in a Program; a RayTracer is made of it and derives the
/// shader table.
namespace foveray::engine {

using gpu::HitGroup;

/// What a ray asks. Its index is the ray type of shaders/shared/ray_types.h, its payload the location of that
/// index.
struct RayType {
    std::string name;
    std::string miss_shader;
};

/// A kind of geometry: its hit group for each ray type and the struct that its shaders find in their record
/// (shaderRecordEXT). Made by Program::add_geometry_type.
template <class Record>
struct GeometryType {
    std::uint32_t index = 0;
};

struct RayGeneration {
    std::uint32_t index = 0;
};

/// Everything that can run: declared before the first ray, by every stage that traces, then fixed.
/// `ray_type_count` is R of docs/architecture.md, "A shader table"; `Records` are the declared record
/// structs.
template <std::uint32_t ray_type_count, class... Records>
class Program {
  public:
    static_assert(ray_type_count >= 1 && ray_type_count <= 15, "traceRayEXT's sbtRecordStride has four bits");
    static_assert((std::is_trivially_copyable_v<Records> && ...), "records are copied to the GPU as bytes");
    static_assert(((alignof(Records) <= 8) && ...),
                  "records follow a handle, which aligns to 8 bytes at least");

    template <class Record>
    static constexpr bool is_declared = (std::is_same_v<Record, Records> || ...);

    /// The values of one geometry, of any type. Made by `geometry`, so that type and record always fit.
    class Geometry {
      public:
        std::uint32_t type() const { return type_; }
        const std::variant<Records...>& record() const { return record_; }

      private:
        friend class Program;
        Geometry(std::uint32_t type, std::variant<Records...> record)
            : type_(type), record_(std::move(record)) {}

        std::uint32_t type_;
        std::variant<Records...> record_;
    };

    /// An entry of the shader table: ⟨ray type, hit group, record⟩.
    struct Entry {
        std::uint32_t ray_type = 0;
        std::uint32_t hit_group = 0;  // index into hit_groups()
        std::variant<Records...> record;
    };

    /// The ray types in the order of shaders/shared/ray_types.h: exactly `ray_type_count` of them.
    template <class... RayTypes>
    requires(sizeof...(RayTypes) == ray_type_count) explicit Program(std::string name, RayTypes... ray_types)
        : name_(std::move(name)), ray_types_{std::move(ray_types)...} {}

    /// One hit group for each ray type, in their order. Throws Fault(Internal) when the name is taken, or
    /// when only some of the groups have an intersection shader: then rays of the others would look for
    /// triangles.
    template <class Record, class... HitGroups>
    requires(is_declared<Record> && sizeof...(HitGroups) == ray_type_count)
        GeometryType<Record> add_geometry_type(std::string name, HitGroups... hit_groups) {
        check_new_type(name, {hit_groups.intersection.empty()...});
        geometry_types_.push_back(
            {std::move(name), record_type<Record>, {add_hit_group(std::move(hit_groups))...}});
        return {static_cast<std::uint32_t>(geometry_types_.size() - 1)};
    }

    RayGeneration add_ray_generation(std::string shader) {
        ray_generation_.push_back(std::move(shader));
        return {static_cast<std::uint32_t>(ray_generation_.size() - 1)};
    }

    /// SPIR-V made at run time, for hit groups that name it.
    void add_shader(std::string name, std::vector<std::uint32_t> code) {
        own_shaders_.insert_or_assign(std::move(name), std::move(code));
    }

    /// A record of another type than the geometry type's does not compile.
    template <class Record>
    requires is_declared<Record>
    static Geometry geometry(GeometryType<Record> type, const std::type_identity_t<Record>& record) {
        return Geometry(type.index, record);
    }

    /// First pass: one entry for each geometry and ray type, in the order of shared::hit_record_index.
    std::vector<Entry> entries(const std::vector<std::vector<Geometry>>& ranges) const {
        std::vector<Entry> entries;
        for (const auto& range : ranges) {
            for (const Geometry& geometry : range) {
                const auto& groups = geometry_types_[geometry.type()].hit_groups;
                for (std::uint32_t ray_type = 0; ray_type < ray_type_count; ++ray_type) {
                    entries.push_back({ray_type, groups[ray_type], geometry.record()});
                }
            }
        }
        return entries;
    }

    /// The geometry type of that name. Throws Fault(Internal) when there is none, or when its records are not
    /// `Record`s.
    template <class Record>
    requires is_declared<Record> GeometryType<Record> geometry_type(std::string_view name)
    const {
        for (std::uint32_t i = 0; i < geometry_types_.size(); ++i) {
            if (geometry_types_[i].name != name) continue;
            if (geometry_types_[i].record_type != record_type<Record>) {
                fault("the records of geometry type \"" + std::string(name) + "\" are of another type",
                      "ask for the type that it was added with");
            }
            return {i};
        }
        fault("there is no geometry type \"" + std::string(name) + "\"", "add it first");
    }
    std::uint32_t geometry_type_count() const { return static_cast<std::uint32_t>(geometry_types_.size()); }
    const std::string& name() const { return name_; }
    const std::array<RayType, ray_type_count>& ray_types() const { return ray_types_; }
    const std::vector<HitGroup>& hit_groups() const { return hit_groups_; }
    const std::vector<std::string>& ray_generation() const { return ray_generation_; }
    const std::map<std::string, std::vector<std::uint32_t>>& own_shaders() const { return own_shaders_; }
    const std::string& geometry_type_name(std::uint32_t index) const { return geometry_types_[index].name; }
    const HitGroup& hit_group(std::uint32_t geometry_type, std::uint32_t ray_type) const {
        return hit_groups_[geometry_types_[geometry_type].hit_groups[ray_type]];
    }

  private:
    struct Type {
        std::string name;
        std::size_t record_type;  // index into Records
        std::array<std::uint32_t, ray_type_count> hit_groups;
    };

    template <class Record>
    static constexpr std::size_t record_type = [] {
        std::size_t index = 0;
        (void)((std::is_same_v<Record, Records> || (++index, false)) || ...);
        return index;
    }();

    [[noreturn]] void fault(const std::string& what, const std::string& remedy) const {
        throw Fault(ExitCode::Internal, "program \"" + name_ + "\"", what, remedy);
    }

    void check_new_type(const std::string& name,
                        const std::array<bool, ray_type_count>& for_triangles) const {
        for (const Type& type : geometry_types_) {
            if (type.name == name) fault("geometry type \"" + name + "\" is added twice", "rename one");
        }
        for (const bool triangles : for_triangles) {
            if (triangles != for_triangles[0]) {
                fault("geometry type \"" + name + "\" has an intersection shader for some ray types only",
                      "name it in every hit group, also where it has no other shader");
            }
        }
    }

    std::uint32_t add_hit_group(HitGroup group) {
        for (std::uint32_t i = 0; i < hit_groups_.size(); ++i) {
            if (hit_groups_[i] == group) return i;
        }
        hit_groups_.push_back(std::move(group));
        return static_cast<std::uint32_t>(hit_groups_.size() - 1);
    }

    std::string name_;
    std::array<RayType, ray_type_count> ray_types_;
    std::vector<HitGroup> hit_groups_;
    std::vector<Type> geometry_types_;
    std::vector<std::string> ray_generation_;
    std::map<std::string, std::vector<std::uint32_t>> own_shaders_;
};

}  // namespace foveray::engine
