#include "render/shape_types.h"

#include <algorithm>

namespace foveray::render {
namespace {

using engine::HitGroup;
using engine::SceneProgram;
using scene::ShapeKind;

/// Shapes whose intersection shader finds the normal too.
template <class Record>
engine::GeometryType<Record> declare_analytic(SceneProgram& program, const std::string& name) {
    const std::string intersection = "render/shapes/" + name + ".rint";
    return program.add_geometry_type<Record>(
        name, HitGroup{"render/shapes/analytic.rchit", "", intersection},
        HitGroup{"render/shadow.rchit", "render/shapes/shadow.rahit", intersection});
}

}  // namespace

ShapeTypes::ShapeTypes(SceneProgram& program, const scene::Scene& scene) {
    const auto has = [&](ShapeKind kind) {
        return std::ranges::find(scene.shapes, kind, &scene::Shape::kind) != scene.shapes.end();
    };
    if (has(ShapeKind::Sphere)) types_.sphere = declare_analytic<shared::SphereRecord>(program, "sphere");
    if (has(ShapeKind::Box)) types_.box = declare_analytic<shared::BoxRecord>(program, "box");
}

ShapeTypes::Geometry ShapeTypes::geometry(const scene::Shape& shape, std::span<const float> v,
                                          const shared::ShapeHeader& header) const {
    switch (shape.kind) {
        case ShapeKind::Box:
            return SceneProgram::geometry(types_.box, {header, vec3(v[0], v[1], v[2]), 0});
        case ShapeKind::Sphere:
            break;
    }
    return SceneProgram::geometry(types_.sphere, {header, v[0], 0});
}

}  // namespace foveray::render
