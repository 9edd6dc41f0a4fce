#include <array>
#include <cmath>
#include <string>

#include "render/scene/made_surfaces.h"

namespace foveray::scene {
namespace {

/// The way at an eccentricity and an angle round the axis -z, counter-clockwise from +x as the seat sees it.
vec3 direction_at(float eccentricity, float meridian) {
    return {std::sin(eccentricity) * std::cos(meridian), std::sin(eccentricity) * std::sin(meridian),
            -std::cos(eccentricity)};
}

void append_quad(Primitive& p, vec3 corner, vec3 u, vec3 v, vec2 uv_from, vec2 uv_to) {
    const auto first = static_cast<std::uint32_t>(p.positions.size());
    for (const vec2 at : {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)}) {
        p.positions.push_back(corner + at.x * u + at.y * v);
        p.normals.push_back(glm::normalize(glm::cross(u, v)));
        p.uv0.push_back(glm::mix(uv_from, uv_to, at));
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
}

}  // namespace

Primitive make_acuity_patches(const MadeMesh& mesh) {
    const float distance = mesh.number("distance"), periods = mesh.number("periods");
    Primitive p;
    for (const vec4& point : mesh.points) {
        const float e = point.x, meridian = radians(point.y), turn = radians(point.z);
        const float ppd = std::min(mesh.number("cap_ppd"), mesh.number("a") / (e + mesh.number("b")));
        // As wide as its periods are at a quarter of the acuity, whatever the frequency: charts of several
        // frequencies then have patches of one size.
        const float half = distance * std::tan(0.5f * radians(4.0f * periods / ppd));
        const vec3 way = direction_at(radians(e), meridian);
        const vec3 outwards = e > 0.0f ? direction_at(radians(e) + 0.5f * pi, meridian) : vec3(1, 0, 0);
        const vec3 round = glm::cross(outwards, -way);
        const vec3 right = std::cos(turn) * outwards - std::sin(turn) * round;
        const vec3 up = glm::cross(-way, right);
        const float half_periods = 0.5f * periods * 4.0f * mesh.number("frequency");
        append_quad(p, distance * way - half * (right + up), 2.0f * half * right, 2.0f * half * up,
                    vec2(-half_periods), vec2(half_periods));
    }
    return p;
}

Primitive make_digits(const MadeMesh& mesh) {
    // Seven strokes: top, upper left, upper right, middle, lower left, lower right, bottom.
    constexpr std::array<unsigned, 10> strokes = {0b1110111, 0b0100100, 0b1011101, 0b1101101, 0b0101110,
                                                  0b1101011, 0b1111011, 0b0100101, 0b1111111, 0b1101111};
    constexpr float w = 0.1f;  // of a stroke, in heights; a digit is half as wide as high
    struct Box {
        vec2 from, to;
    };
    constexpr float h = 0.5f;
    const std::array<Box, 7> boxes = {{{{0, 1 - w}, {h, 1}},
                                       {{0, h}, {w, 1 - w}},
                                       {{h - w, h}, {h, 1 - w}},
                                       {{w, h - 0.5f * w}, {h - w, h + 0.5f * w}},
                                       {{0, w}, {w, h}},
                                       {{h - w, w}, {h, h}},
                                       {{0, 0}, {h, w}}}};
    const std::string text = std::to_string(mesh.count("value"));
    const float height = mesh.number("height"), step = h + 0.2f;
    const float width = step * static_cast<float>(text.size()) - 0.2f;
    Primitive p;
    for (std::size_t i = 0; i < text.size(); ++i) {
        for (std::size_t stroke = 0; stroke < boxes.size(); ++stroke) {
            if ((strokes[static_cast<std::size_t>(text[i] - '0')] >> stroke & 1) == 0) continue;
            const vec2 origin(static_cast<float>(i) * step - 0.5f * width, -0.5f);
            const vec2 from = height * (origin + boxes[stroke].from),
                       to = height * (origin + boxes[stroke].to);
            append_quad(p, vec3(from, 0), {to.x - from.x, 0, 0}, {0, to.y - from.y, 0}, vec2(0), vec2(1));
        }
    }
    return p;
}

}  // namespace foveray::scene
