#include "render/scene/made_surfaces.h"

#include <algorithm>
#include <cmath>

#include "render/scene/noise.h"
#include "render/scene/spline.h"
#include "render/scene/surface_grid.h"

namespace foveray::scene {
namespace {

float part_of(std::uint32_t i, std::uint32_t count) {
    return static_cast<float>(i) / static_cast<float>(count);
}

vec3 any_perpendicular(vec3 n) {
    return glm::normalize(glm::cross(n, std::abs(n.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0)));
}

struct Station {
    vec3 center{0.0f}, across{1, 0, 0}, up{0, 1, 0};
    float radius = 0.0f;
};

/// Frames along a curve that turn no more than it does.
std::vector<Station> stations_along(std::span<const vec4> path) {
    std::vector<Station> stations;
    vec3 across(0.0f);
    for (std::size_t i = 0; i < path.size(); ++i) {
        const vec3 before(path[i > 0 ? i - 1 : 0]), after(path[std::min(i + 1, path.size() - 1)]);
        const vec3 along = glm::normalize(after - before + vec3(0.0f, 1e-9f, 0.0f));
        if (i == 0) across = any_perpendicular(along);
        across = glm::normalize(across - along * glm::dot(across, along));
        stations.push_back({vec3(path[i]), across, glm::cross(along, across), path[i].w});
    }
    return stations;
}

vec3 round_tube(const Station& s, float turn, float swell) {
    const float angle = 2.0f * pi * turn;
    return s.center + s.radius * swell * (std::cos(angle) * s.across + std::sin(angle) * s.up);
}

/// A strand's ridges across a tube.
float ridges(float turn, std::uint32_t count, float depth) {
    if (count == 0) return 1.0f;
    return 1.0f - depth * (1.0f - std::abs(std::sin(pi * static_cast<float>(count) * turn)));
}

}  // namespace

Primitive make_lathe(const MadeMesh& mesh) {
    const std::vector<vec4> profile = sample_spline(mesh.points, mesh.count("rings"));
    const std::uint32_t columns = mesh.count("segments"), flutes = mesh.count("flutes");
    const auto rows = static_cast<std::uint32_t>(profile.size()) - 1;
    float low = profile[0].y, high = low;
    for (const vec4& p : profile) low = std::min(low, p.y), high = std::max(high, p.y);
    const float from = glm::mix(low, high, mesh.number("flutes_from"));
    const float to = glm::mix(low, high, mesh.number("flutes_to"));
    Primitive p;
    append_grid(p, columns, rows, [&](std::uint32_t column, std::uint32_t row) {
        const vec4 at = profile[row];
        const float turn = part_of(column % columns, columns);
        const float height = (at.y - low) / std::max(high - low, 1e-6f);
        float radius = at.x;
        if (flutes > 0) {
            const float edge = 0.03f * (high - low);
            const float fade =
                glm::smoothstep(from, from + edge, at.y) * (1.0f - glm::smoothstep(to - edge, to, at.y));
            const float phase = static_cast<float>(flutes) * (turn + mesh.number("twist") * height);
            radius *= 1.0f - fade * mesh.number("flute_depth") * std::abs(std::cos(pi * phase));
        }
        const float angle = -2.0f * pi * turn;
        return vec3(radius * std::cos(angle), at.y, radius * std::sin(angle));
    });
    return p;
}

Primitive make_tube(const MadeMesh& mesh) {
    const std::vector<Station> stations = stations_along(sample_spline(mesh.points, mesh.count("rings")));
    const std::uint32_t columns = mesh.count("segments");
    const auto last = static_cast<std::uint32_t>(stations.size()) - 1;
    Primitive p;
    append_grid(p, columns, last + 2, [&](std::uint32_t column, std::uint32_t row) {
        if (row == 0) return stations.front().center;  // the caps
        if (row == last + 2) return stations.back().center;
        return round_tube(stations[row - 1], part_of(column % columns, columns), 1.0f);
    });
    return p;
}

Primitive make_torus_knot(const MadeMesh& mesh) {
    const float p_turns = mesh.number("turns"), q_turns = mesh.number("windings");
    const float radius = mesh.number("radius"), tube = mesh.number("tube_radius");
    const float swing = q_turns > 0.0f ? mesh.number("swing") : 0.0f;
    const std::uint32_t columns = mesh.count("segments"), rows = mesh.count("rings");
    const auto curve = [&](float t) {
        const float phi = 2.0f * pi * p_turns * t, psi = 2.0f * pi * q_turns * t;
        const float r = radius + swing * std::cos(psi);
        return vec3(r * std::cos(phi), swing * std::sin(psi), r * std::sin(phi));
    };
    Primitive p;
    append_grid(p, columns, rows, [&](std::uint32_t column, std::uint32_t row) {
        const float t = part_of(row % rows, rows);
        const vec3 center = curve(t);
        const vec3 along = glm::normalize(curve(t + 1e-3f) - curve(t - 1e-3f));
        // A frame that closes: away from the ring's axis and centre line.
        const vec3 spine = radius * glm::normalize(vec3(center.x, 0.0f, center.z));
        const vec3 away = swing > 0.0f ? center - spine : spine;
        const vec3 across = glm::normalize(away - along * glm::dot(away, along));
        const float turn = part_of(column % columns, columns);
        const float strand = turn + mesh.number("twist") * t;
        const float swell = ridges(strand, mesh.count("strands"), mesh.number("strand_depth"));
        return round_tube({center, across, glm::cross(along, across), tube}, turn, swell);
    });
    return p;
}

Primitive make_rounded_box(const MadeMesh& mesh) {
    const vec3 half = mesh.triple("half_size");
    const float bevel = std::min(mesh.number("bevel"), std::min({half.x, half.y, half.z}));
    const std::uint32_t steps = mesh.count("steps"), flat = mesh.count("subdivisions");
    // Lines over one axis: dense over the bevels, even between.
    std::vector<vec2> lines;  // part of the flat half-size, part of the bevel
    for (std::uint32_t i = 0; i <= steps; ++i) {
        lines.push_back({-1.0f, -std::tan(0.25f * pi * (1.0f - part_of(i, steps)))});
    }
    for (std::uint32_t i = 1; i < flat; ++i) lines.push_back({2.0f * part_of(i, flat) - 1.0f, 0.0f});
    for (std::uint32_t i = 0; i <= steps; ++i)
        lines.push_back({1.0f, std::tan(0.25f * pi * part_of(i, steps))});
    const auto last = static_cast<std::uint32_t>(lines.size()) - 1;
    Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const int u = (axis + (side > 0.0f ? 1 : 2)) % 3, v = (axis + (side > 0.0f ? 2 : 1)) % 3;
            append_grid(p, last, last, [&](std::uint32_t column, std::uint32_t row) {
                vec3 inner, outer;
                inner[axis] = outer[axis] = side;
                inner[u] = lines[column].x, outer[u] = lines[column].y;
                inner[v] = lines[row].x, outer[v] = lines[row].y;
                return inner * (half - bevel) + bevel * glm::normalize(outer);
            });
        }
    }
    return p;
}

Primitive make_boulder(const MadeMesh& mesh) {
    const std::uint32_t steps = mesh.count("subdivisions"), seed = mesh.count("seed");
    const float radius = mesh.number("radius"), relief = mesh.number("relief");
    std::vector<vec4> planes;  // normal, distance: what is beyond them is chipped off
    for (std::uint32_t i = 0; i < mesh.count("facets"); ++i) {
        const float y = 2.0f * random_number(seed, 3 * i) - 1.0f,
                    angle = 2.0f * pi * random_number(seed, 3 * i + 1);
        const float r = std::sqrt(std::max(0.0f, 1.0f - y * y));
        planes.push_back(
            {r * std::cos(angle), y, r * std::sin(angle), 0.72f + 0.25f * random_number(seed, 3 * i + 2)});
    }
    const vec3 place(7.0f * random_number(seed, 9001), 7.0f * random_number(seed, 9002),
                     7.0f * random_number(seed, 9003));
    const auto on_sphere = [&](vec3 d) {
        float reach = 1.0f;
        for (const vec4& plane : planes) {
            const float facing = glm::dot(d, vec3(plane));
            if (facing > 0.1f) reach = std::min(reach, plane.w / facing);
        }
        const float rough = fractal_noise(2.3f * d + place, 6);
        return radius * (reach + relief * rough) * d;
    };
    Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const int u = (axis + (side > 0.0f ? 1 : 2)) % 3, v = (axis + (side > 0.0f ? 2 : 1)) % 3;
            append_grid(p, steps, steps, [&](std::uint32_t column, std::uint32_t row) {
                // From the middle, so that both faces at an edge compute the same numbers.
                const auto spread = [&](std::uint32_t i) {
                    return std::tan(0.25f * pi * (2.0f * part_of(i, steps) - 1.0f));
                };
                vec3 d;
                d[axis] = side;
                d[u] = column == 0 ? -1.0f : column == steps ? 1.0f : spread(column);
                d[v] = row == 0 ? -1.0f : row == steps ? 1.0f : spread(row);
                return on_sphere(glm::normalize(d));
            });
        }
    }
    return p;
}

}  // namespace foveray::scene
