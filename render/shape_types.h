#pragma once

#include <map>
#include <span>

#include "render/engine/scene_types.h"
#include "render/scene/scene.h"

namespace foveray::render {

/// The geometry types of shapes: which shaders a kind of shape runs, and what their records hold. Only the
/// kinds that the scene has are declared, because every shader of a pipeline may slow all of it.
class ShapeTypes {
  public:
    using Geometry = engine::SceneProgram::Geometry;

    ShapeTypes(engine::SceneProgram& program, const scene::Scene& scene);

    /// The record of a shape whose parameters have these values.
    Geometry geometry(const scene::Shape& shape, std::span<const float> values,
                      const shared::ShapeHeader& header) const;

  private:
    struct Declared {
        engine::GeometryType<shared::SphereRecord> sphere;
        engine::GeometryType<shared::BoxRecord> box;
    } types_;
};

}  // namespace foveray::render
