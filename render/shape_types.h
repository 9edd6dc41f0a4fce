#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "render/engine/scene_types.h"
#include "render/gpu_shapes.h"
#include "render/scene/scene.h"

namespace foveray::render {

/// SPIR-V of a user's own shape; render/user_shapes makes it.
struct UserShader {
    std::vector<std::uint32_t> intersection, closest_hit;
    bool uses_time = false;

    auto operator<=>(const UserShader&) const = default;
};
using UserShaders = std::vector<UserShader>;  // by scene::UserShapeId

/// The record of a user's shape whose parameters have these values.
shared::UserRecord user_record(const scene::Shape& shape, std::span<const float> values,
                               const shared::ShapeHeader& header, float seconds);

/// The geometry types of shapes: which shaders a kind of shape runs, and what their records hold. Only the
/// kinds that the scene has are declared, because every shader of a pipeline may slow all of it.
class ShapeTypes {
  public:
    using Geometry = engine::SceneProgram::Geometry;

    ShapeTypes(engine::SceneProgram& program, const scene::Scene& scene, const UserShaders& users);

    /// The record of a shape whose parameters have these values. `uploaded`: of the scene that it is in.
    /// `seconds`: session time.
    Geometry geometry(const scene::Shape& shape, std::span<const float> values,
                      const shared::ShapeHeader& header, const GpuShapes& uploaded, float seconds) const;
    /// The record changes with session time, whether its values do or not.
    bool uses_time(const scene::Shape& shape) const;
    /// Some of the scene's shapes change with the session's time, though none of their values does.
    bool follow_time(const scene::Scene& scene) const;

  private:
    struct Declared {
        engine::GeometryType<shared::SphereRecord> sphere;
        engine::GeometryType<shared::BoxRecord> box;
        engine::GeometryType<shared::OrientedBoxRecord> oriented_box;
        engine::GeometryType<shared::PlaneRecord> plane;
        engine::GeometryType<shared::CsgRecord> csg;
        engine::GeometryType<shared::VoxelRecord> voxels;
        engine::GeometryType<shared::JuliaRecord> julia;
        engine::GeometryType<shared::MandelbulbRecord> mandelbulb;
        engine::GeometryType<shared::BlendRecord> blend;
        std::vector<engine::GeometryType<shared::UserRecord>> users;  // by scene::UserShapeId
    } types_;
    std::vector<bool> user_uses_time_;  // by scene::UserShapeId
};

}  // namespace foveray::render
