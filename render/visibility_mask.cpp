#include "render/visibility_mask.h"

#include <algorithm>
#include <cmath>

namespace foveray::render {
namespace {

using Polygon = std::vector<vec2>;  // convex, counter-clockwise

float cross(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

float area(const Polygon& polygon) {
    float twice = 0.0f;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return 0.5f * twice;
}

/// The part of a polygon on the left (side 1) or right (side -1) of the line from a to b.
Polygon clip(const Polygon& polygon, vec2 a, vec2 b, float side) {
    Polygon kept;
    const auto distance = [&](vec2 p) { return side * cross(b - a, p - a); };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const float dp = distance(p), dq = distance(q);
        if (dp >= 0.0f) kept.push_back(p);
        if ((dp > 0.0f && dq < 0.0f) || (dp < 0.0f && dq > 0.0f))
            kept.push_back(p + (q - p) * (dp / (dp - dq)));
    }
    return kept;
}

constexpr float negligible = 1e-4f;  // of a cell's area

void keep(std::vector<Polygon>& pieces, Polygon piece) {
    if (piece.size() >= 3 && area(piece) > negligible) pieces.push_back(std::move(piece));
}

/// What a triangle leaves uncovered of the pieces.
std::vector<Polygon> subtract(const std::vector<Polygon>& pieces, const Polygon& triangle) {
    std::vector<Polygon> left;
    for (Polygon inside : pieces) {
        for (std::size_t i = 0; i < 3 && inside.size() >= 3; ++i) {
            const vec2 a = triangle[i], b = triangle[(i + 1) % 3];
            keep(left, clip(inside, a, b, -1.0f));
            inside = clip(inside, a, b, 1.0f);
        }
    }
    return left;
}

}  // namespace

std::vector<std::uint32_t> hidden_cells(const HiddenMesh& mesh, const Fov& fov) {
    constexpr std::uint32_t size = shared::HIDDEN_MASK_SIZE;
    // In units of cells, from the top left corner.
    std::vector<vec2> vertices;
    for (vec2 v : mesh.vertices) vertices.push_back(uv_of(fov, vec3(v, -1.0f)) * static_cast<float>(size));

    std::vector<std::vector<Polygon>> triangles_of(std::size_t{size} * size);
    const auto cells = [](float low, float high) {
        const float last = static_cast<float>(size) - 1.0f;
        return std::pair(static_cast<std::uint32_t>(std::clamp(std::floor(low), 0.0f, last)),
                         static_cast<std::uint32_t>(std::clamp(std::floor(high), 0.0f, last)));
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Polygon triangle;
        for (std::size_t k = 0; k < 3; ++k) triangle.push_back(vertices.at(mesh.indices[i + k]));
        if (area(triangle) < 0.0f) std::swap(triangle[1], triangle[2]);
        if (area(triangle) <= 0.0f) continue;
        const auto [x0, x1] = cells(std::min({triangle[0].x, triangle[1].x, triangle[2].x}),
                                    std::max({triangle[0].x, triangle[1].x, triangle[2].x}));
        const auto [y0, y1] = cells(std::min({triangle[0].y, triangle[1].y, triangle[2].y}),
                                    std::max({triangle[0].y, triangle[1].y, triangle[2].y}));
        for (std::uint32_t y = y0; y <= y1; ++y)
            for (std::uint32_t x = x0; x <= x1; ++x)
                triangles_of[std::size_t{y} * size + x].push_back(triangle);
    }

    std::vector<std::uint32_t> words;
    for (std::uint32_t cell = 0; cell < size * size; ++cell) {
        const vec2 corner(cell % size, cell / size);
        std::vector<Polygon> uncovered{
            {corner, corner + vec2(1, 0), corner + vec2(1, 1), corner + vec2(0, 1)}};
        for (const Polygon& triangle : triangles_of[cell]) uncovered = subtract(uncovered, triangle);
        if (!uncovered.empty()) continue;
        if (words.empty()) words.resize(hidden_mask_words);
        words[cell / 32] |= 1u << (cell % 32);
    }
    return words;
}

}  // namespace foveray::render
