#include <algorithm>
#include <array>
#include <cmath>

#include "render/scene/made_surfaces.h"
#include "render/scene/noise.h"
#include "render/scene/surface_grid.h"

namespace foveray::scene {
namespace {

/// Where lines are drawn across one panel, 0..1, and how deep the frame's steps lie there. Doubled places
/// make upright steps.
struct PanelLine {
    float place, depth;
};

std::vector<PanelLine> panel_lines(float frame, std::uint32_t subdivisions) {
    // Half a rib, a step down, a ledge, a second step, the field; and back.
    const float a = 0.5f * frame, b = a + 0.35f * frame;
    const std::array<PanelLine, 6> rise = {{{0.0f, 0.0f},
                                            {0.8f * a, 0.0f},
                                            {a, 0.5f},
                                            {0.8f * b + 0.2f * a, 0.5f},
                                            {b, 1.0f},
                                            {b + 0.1f * frame, 1.0f}}};
    std::vector<PanelLine> lines(rise.begin(), rise.end());
    const float from = rise.back().place;
    for (std::uint32_t i = 1; i < subdivisions; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(subdivisions);
        lines.push_back({glm::mix(from, 1.0f - from, t), 1.0f});
    }
    for (auto line = rise.rbegin(); line != rise.rend(); ++line)
        lines.push_back({1.0f - line->place, line->depth});
    return lines;
}

/// A flower of eight petals round a button, 0..1 high, in a square of -1..1.
float rosette(vec2 p) {
    const float r = glm::length(p), angle = std::atan2(p.y, p.x);
    const float reach = 0.55f + 0.3f * std::abs(std::cos(4.0f * angle));
    const float petal = glm::smoothstep(0.0f, 0.35f, (reach - r) / reach) * (0.45f + 0.4f * r);
    const float button = std::sqrt(std::max(0.0f, 1.0f - r * r / 0.05f));
    return std::max(petal, button);
}

}  // namespace

Primitive make_panels(const MadeMesh& mesh) {
    const vec2 size = mesh.pair("size");
    const std::uint32_t across = mesh.count("columns"), up = mesh.count("rows");
    const float bend = radians(mesh.number("bend_degrees")), depth = mesh.number("depth");
    const float flower = mesh.number("rosette");
    const std::vector<PanelLine> lines = panel_lines(mesh.number("frame"), mesh.count("subdivisions"));
    const auto cells = static_cast<std::uint32_t>(lines.size()) - 1;
    const float field = 1.0f - 2.0f * lines[5].place;

    // `down`: behind the surface.
    const auto bent = [&](vec2 p, float down) {
        if (bend < 1e-4f) return vec3(p, -down);
        const float radius = size.y / bend, angle = p.y / radius;
        return vec3(p.x, (radius + down) * std::sin(angle), radius - (radius + down) * std::cos(angle));
    };
    Primitive p;
    append_grid(p, across * cells, up * cells, [&](std::uint32_t column, std::uint32_t row) {
        const std::uint32_t panel_x = std::min(column / cells, across - 1),
                            panel_y = std::min(row / cells, up - 1);
        const PanelLine u = lines[column - panel_x * cells], v = lines[row - panel_y * cells];
        const vec2 place((static_cast<float>(panel_x) + u.place) / static_cast<float>(across),
                         (static_cast<float>(panel_y) + v.place) / static_cast<float>(up));
        float down = depth * std::min(u.depth, v.depth);
        const vec2 panel_size(size.x / static_cast<float>(across), size.y / static_cast<float>(up));
        const vec2 from_middle = (vec2(u.place, v.place) - 0.5f) * panel_size;
        const float half = 0.5f * field * std::min(panel_size.x, panel_size.y);
        if (flower > 0.0f) down -= flower * rosette(from_middle / (0.95f * half));
        return bent((place - 0.5f) * size, down);
    });
    return p;
}

Primitive make_tiles(const MadeMesh& mesh) {
    const vec2 size = mesh.pair("size");
    const std::uint32_t across = mesh.count("columns"), along = mesh.count("rows");
    const float bevel = mesh.number("bevel");
    const std::uint32_t inner = mesh.count("subdivisions");
    const vec3 second = mesh.triple("second_color");
    Primitive p;
    const vec2 tile(size.x / static_cast<float>(across), size.y / static_cast<float>(along));
    for (std::uint32_t z = 0; z < along; ++z) {
        for (std::uint32_t x = 0; x < across; ++x) {
            const std::uint32_t cells = inner + 2;
            const auto place = [&](std::uint32_t i) {
                return i == 0       ? 0.0f
                       : i == cells ? 1.0f
                                    : static_cast<float>(i - 1) / static_cast<float>(inner);
            };
            append_grid(p, cells, cells, [&](std::uint32_t column, std::uint32_t row) {
                const bool edge = column == 0 || row == 0 || column == cells || row == cells;
                const vec2 at(place(column), place(row));
                const vec2 flat = edge ? at * tile : bevel + at * (tile - 2.0f * bevel);
                return vec3(static_cast<float>(x) * tile.x + flat.x - 0.5f * size.x, edge ? -bevel : 0.0f,
                            0.5f * size.y - static_cast<float>(z) * tile.y - flat.y);
            });
            const float shade = 0.9f + 0.2f * random_number(x, z);
            const vec3 color = shade * ((x + z) % 2 == 0 ? vec3(1.0f) : second);
            p.colors.resize(p.positions.size(), vec4(glm::min(color, vec3(1.0f)), 1.0f));
        }
    }
    return p;
}

}  // namespace foveray::scene
