#include "render/shape_types.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "render/scene/fractal.h"

namespace foveray::render {
namespace {

using engine::HitGroup;
using engine::SceneProgram;
using scene::ShapeKind;

shared::JuliaRecord julia_record(std::span<const float> v, const shared::ShapeHeader& header) {
    const scene::Julia julia(v);
    shared::JuliaRecord record{};
    record.shape = header;
    record.c = julia.c;
    record.cut = vec4(julia.cut_normal, julia.cut_offset);
    record.orbit_color = julia.orbit_color;
    record.radius = julia.radius();
    record.iterations = julia.iterations;
    return record;
}

shared::MandelbulbRecord mandelbulb_record(std::span<const float> v, const shared::ShapeHeader& header) {
    const scene::Mandelbulb mandelbulb(v);
    shared::MandelbulbRecord record{};
    record.shape = header;
    record.orbit_color = mandelbulb.orbit_color;
    record.power = mandelbulb.power;
    record.radius = mandelbulb.radius();
    // So far that one more power is 10 000: the error of the potential is then as little.
    record.far_2 = std::pow(10.0f, 8.0f / mandelbulb.power);
    record.iterations = mandelbulb.iterations;
    return record;
}

engine::GeometryType<shared::UserRecord> declare_user(SceneProgram& program, const scene::UserShape& shape,
                                                      const UserShader& shader, std::size_t id) {
    const std::string name = "user " + std::to_string(id) + " " + shape.code.file.filename().string();
    const std::string intersection = name + " intersection", closest_hit = name + " closest hit";
    program.add_shader(intersection, shader.intersection);
    program.add_shader(closest_hit, shader.closest_hit);
    return program.add_geometry_type<shared::UserRecord>(
        name, HitGroup{closest_hit, "", intersection},
        HitGroup{"", "render/shapes/shadow.rahit", intersection});
}

}  // namespace

shared::UserRecord user_record(const scene::Shape& shape, std::span<const float> v,
                               const shared::ShapeHeader& header, float seconds) {
    shared::UserRecord record{};
    record.shape = header;
    std::ranges::copy(shape.user_time ? v.first(v.size() - 1) : v, record.values);
    record.bounds_min = shape.user_bounds.min;
    record.bounds_max = shape.user_bounds.max;
    record.time = shape.user_time ? v.back() : seconds;
    return record;
}

ShapeTypes::ShapeTypes(SceneProgram& program, const scene::Scene& scene, const UserShaders& users) {
    assert(users.size() == scene.user_shapes.size());
    for (std::size_t id = 0; id < users.size(); ++id) {
        types_.users.push_back(declare_user(program, scene.user_shapes[id], users[id], id));
        user_uses_time_.push_back(users[id].uses_time);
    }
    // Type and intersection shader have the same name.
    const auto declare = [&]<class Record>(ShapeKind kind, engine::GeometryType<Record>& type,
                                           const std::string& name, const std::string& closest_hit,
                                           const std::string& shadow = "shadow") {
        if (std::ranges::find(scene.shapes, kind, &scene::Shape::kind) == scene.shapes.end()) return;
        const std::string folder = "render/shapes/", intersection = folder + name + ".rint";
        type = program.add_geometry_type<Record>(name,
                                                 HitGroup{folder + closest_hit + ".rchit", "", intersection},
                                                 HitGroup{"", folder + shadow + ".rahit", intersection});
    };
    declare(ShapeKind::Sphere, types_.sphere, "sphere", "analytic");
    declare(ShapeKind::Box, types_.box, "box", "analytic");
    declare(ShapeKind::OrientedBox, types_.oriented_box, "oriented_box", "analytic");
    declare(ShapeKind::Plane, types_.plane, "plane", "plane");
    declare(ShapeKind::Julia, types_.julia, "julia", "julia");
    declare(ShapeKind::Mandelbulb, types_.mandelbulb, "mandelbulb", "mandelbulb");
    declare(ShapeKind::Voxels, types_.voxels, "voxels", "voxels", "voxels_shadow");
    declare(ShapeKind::Blend, types_.blend, "blend", "blend");
    declare(ShapeKind::Csg, types_.csg, "csg", "csg", "csg_shadow");
}

ShapeTypes::Geometry ShapeTypes::geometry(const scene::Shape& shape, std::span<const float> v,
                                          const shared::ShapeHeader& header, const GpuShapes& uploaded,
                                          float seconds) const {
    switch (shape.kind) {
        case ShapeKind::Box:
            return SceneProgram::geometry(types_.box, {header, vec3(v[0], v[1], v[2]), 0});
        case ShapeKind::OrientedBox: {
            const quat q = scene::rotation_of(v.subspan(3));
            return SceneProgram::geometry(types_.oriented_box,
                                          {header, vec3(v[0], v[1], v[2]), 0, vec4(q.x, q.y, q.z, q.w)});
        }
        case ShapeKind::Plane:
            return SceneProgram::geometry(types_.plane,
                                          {header, vec2(v[0], v[1]), v[2], vec3(v[3], v[4], v[5])});
        case ShapeKind::Julia:
            return SceneProgram::geometry(types_.julia, julia_record(v, header));
        case ShapeKind::Mandelbulb:
            return SceneProgram::geometry(types_.mandelbulb, mandelbulb_record(v, header));
        case ShapeKind::Voxels:
            return SceneProgram::geometry(types_.voxels, uploaded.voxels().record(header, *shape.voxels));
        case ShapeKind::Blend:
            return SceneProgram::geometry(types_.blend,
                                          uploaded.blends().record(header, v[0], bounds_of(shape, v)));
        case ShapeKind::Csg:
            return SceneProgram::geometry(types_.csg, uploaded.solids().record(header));
        case ShapeKind::User:
            return SceneProgram::geometry(types_.users[shape.user], user_record(shape, v, header, seconds));
        case ShapeKind::Sphere:
            break;
    }
    return SceneProgram::geometry(types_.sphere, {header, v[0], 0});
}

bool ShapeTypes::follow_time(const scene::Scene& scene) const {
    return std::ranges::any_of(
        scene.shapes, [&](const scene::Shape& shape) { return uses_time(shape) && !shape.user_time; });
}

bool ShapeTypes::uses_time(const scene::Shape& shape) const {
    return shape.kind == ShapeKind::User && user_uses_time_[shape.user];
}

}  // namespace foveray::render
