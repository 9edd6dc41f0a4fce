#pragma once

#include "render/scene/mesh.h"

namespace foveray::scene {

/// Appends (columns + 1) x (rows + 1) vertices point(column, row) with uv0 in 0..1 and two triangles a cell,
/// whose front is where +column x +row points to.
template <typename Point>
void append_grid(Primitive& p, std::uint32_t columns, std::uint32_t rows, const Point& point) {
    const auto first = static_cast<std::uint32_t>(p.positions.size());
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            p.positions.push_back(point(column, row));
            p.uv0.push_back({static_cast<float>(column) / static_cast<float>(columns),
                             1.0f - static_cast<float>(row) / static_cast<float>(rows)});
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = first + row * (columns + 1) + column, b = a + columns + 1;
            p.indices.insert(p.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
}

}  // namespace foveray::scene
