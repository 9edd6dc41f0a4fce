#include "render/scene/made_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "render/scene/made_surfaces.h"
#include "render/scene/noise.h"
#include "render/scene/smooth_normals.h"

namespace foveray::scene {
namespace {

ShapeParameter length(std::string_view name, float otherwise, float least = smallest_shape) {
    return {name, 1, vec4(otherwise), least, 1e3f};
}
ShapeParameter number(std::string_view name, float otherwise, float least, float most) {
    return {name, 1, vec4(otherwise), least, most};
}
ShapeParameter color(std::string_view name) { return {name, 3, vec4(1.0f), 0.0f, 1.0f}; }

/// Every kind has these at the end.
const std::vector<ShapeParameter> common = {
    number("crease_degrees", 40.0f, 0.0f, 180.0f),
    color("ground_color"),
    color("vein_color"),
    number("vein_size", 0.0f, 0.0f, 1e3f),
    number("vein_width", 0.12f, 0.001f, 1.0f),
};

std::vector<MadeMeshKind> make_table() {
    std::vector<MadeMeshKind> kinds = {
        {.name = "lathe",
         .parameters = {number("segments", 64, 3, 2048), number("rings", 64, 1, 2048),
                        number("flutes", 0, 0, 512), number("flute_depth", 0.08f, 0, 0.9f),
                        number("flutes_from", 0, 0, 1), number("flutes_to", 1, 0, 1),
                        number("twist", 0, -10, 10)},
         .point_width = 2,
         .make = make_lathe},
        {.name = "tube",
         .parameters = {number("segments", 24, 3, 512), number("rings", 64, 1, 4096)},
         .point_width = 4,
         .make = make_tube},
        {.name = "torus_knot",
         .parameters = {number("turns", 2, 1, 32), number("windings", 3, 0, 32), length("radius", 0.3f),
                        length("swing", 0.12f), length("tube_radius", 0.05f), number("segments", 24, 3, 512),
                        number("rings", 256, 3, 8192), number("strands", 0, 0, 64),
                        number("strand_depth", 0.25f, 0, 0.9f), number("twist", 0, -1000, 1000)},
         .make = make_torus_knot},
        {.name = "box",
         .parameters = {{"half_size", 3, vec4(0.5f), smallest_shape, 1e3f},
                        length("bevel", 0.01f, 0.0f),
                        number("steps", 3, 1, 64),
                        number("subdivisions", 1, 1, 512)},
         .make = make_rounded_box},
        {.name = "boulder",
         .parameters = {length("radius", 0.5f), number("relief", 0.08f, 0, 0.5f),
                        number("facets", 24, 0, 256), number("seed", 0, 0, 1e6f),
                        number("subdivisions", 32, 1, 512)},
         .make = make_boulder},
        {.name = "panels",
         .parameters = {{"size", 2, vec4(1.0f), smallest_shape, 1e3f},
                        number("columns", 4, 1, 512),
                        number("rows", 2, 1, 512),
                        number("bend_degrees", 0, 0, 350),
                        number("depth", 0.04f, 0, 10),
                        number("frame", 0.2f, 0.01f, 0.6f),
                        number("rosette", 0, 0, 1),
                        number("subdivisions", 2, 1, 128)},
         .make = make_panels},
        {.name = "tiles",
         .parameters = {{"size", 2, vec4(1.0f), smallest_shape, 1e3f},
                        number("columns", 4, 1, 512),
                        number("rows", 4, 1, 512),
                        length("bevel", 0.003f),
                        number("subdivisions", 2, 1, 128),
                        color("second_color")},
         .make = make_tiles},
        {.name = "blend",
         .parameters = {length("smoothness", 0.1f, 0.0f), number("resolution", 64, 8, 256)},
         .has_parts = true,
         .make = make_blend_surface},
        {.name = "gyroid",
         .parameters = {length("radius", 0.3f), length("cell", 0.2f), length("thickness", 0.03f),
                        number("resolution", 64, 8, 256)},
         .make = make_gyroid},
        {.name = "acuity_patches",
         .parameters = {length("distance", 2.0f), number("a", 200, 1, 1e4f), number("b", 1, 0.01f, 90),
                        number("cap_ppd", 60, 0.1f, 1e4f), number("frequency", 0.25f, 0.001f, 100),
                        number("periods", 10, 0.1f, 1000)},
         .point_width = 3,
         .make = make_acuity_patches},
        {.name = "digits",
         .parameters = {number("value", 0, 0, 999999), length("height", 0.1f)},
         .make = make_digits},
    };
    for (MadeMeshKind& kind : kinds) {
        kind.parameters.insert(kind.parameters.end(), common.begin(), common.end());
    }
    return kinds;
}

/// Marble: bands of a warped wave, thin where they are darkest.
float vein(vec3 p, float width) {
    const vec3 warped = p + 0.9f * vec3(fractal_noise(p, 4), fractal_noise(p + vec3(31.4f), 4),
                                        fractal_noise(p - vec3(27.1f), 4));
    const float coarse = std::abs(fractal_noise(0.8f * warped + vec3(4.7f), 3));
    const float fine = std::abs(fractal_noise(2.1f * warped + vec3(11.9f), 3));
    const auto line = [&](float away, float w) { return 1.0f - glm::smoothstep(0.0f, w, away); };
    return std::max(line(coarse, width), 0.5f * line(fine, 0.6f * width));
}

void add_veins(Primitive& p, const MadeMesh& mesh) {
    const vec3 ground = mesh.triple("ground_color"), veins = mesh.triple("vein_color");
    const float size = mesh.number("vein_size"), width = mesh.number("vein_width");
    p.colors.resize(p.positions.size(), vec4(1.0f));
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        const float part = vein(p.positions[i] / size + vec3(3.3f), width);
        p.colors[i] *= vec4(glm::mix(ground, veins, part), 1.0f);
    }
}

void drop_degenerate(Primitive& p) {
    std::vector<std::uint32_t> kept;
    for (std::size_t t = 0; t + 2 < p.indices.size(); t += 3) {
        const vec3 a = p.positions[p.indices[t]], b = p.positions[p.indices[t + 1]],
                   c = p.positions[p.indices[t + 2]];
        if (glm::length(glm::cross(b - a, c - a)) > 1e-12f) {
            kept.insert(kept.end(), {p.indices[t], p.indices[t + 1], p.indices[t + 2]});
        }
    }
    p.indices = std::move(kept);
}

}  // namespace

std::span<const MadeMeshKind> made_mesh_kinds() {
    static const std::vector<MadeMeshKind> kinds = make_table();
    return kinds;
}

float MadeMesh::number(std::string_view parameter) const {
    const auto offset = parameter_offset(kind->parameters, parameter);
    assert(offset);
    return values[*offset];
}

std::uint32_t MadeMesh::count(std::string_view parameter) const {
    return static_cast<std::uint32_t>(std::lround(number(parameter)));
}

vec2 MadeMesh::pair(std::string_view parameter) const {
    const auto offset = parameter_offset(kind->parameters, parameter);
    assert(offset);
    return {values[*offset], values[*offset + 1]};
}

vec3 MadeMesh::triple(std::string_view parameter) const {
    const auto offset = parameter_offset(kind->parameters, parameter);
    assert(offset);
    return {values[*offset], values[*offset + 1], values[*offset + 2]};
}

Primitive make_mesh(const MadeMesh& mesh) {
    assert(mesh.values.size() == default_values(mesh.kind->parameters).size());
    Primitive p = mesh.kind->make(mesh);
    if (p.normals.empty()) {
        make_smooth_normals(p, radians(mesh.number("crease_degrees")));
    } else {
        drop_degenerate(p);
    }
    if (mesh.number("vein_size") > 0.0f) {
        add_veins(p, mesh);
    }
    return p;
}

}  // namespace foveray::scene
