#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "render/scene/material.h"

namespace foveray::render {

/// Levels of detail of a picture of that size, down to one texel.
std::uint32_t mip_level_count(std::uint32_t width, std::uint32_t height);

/// RGBA texels of all levels, level 0 (the picture) first, rows tightly packed. Each is half as wide and high
/// as the one before, rounded down, at least 1. Halving is by a windowed sinc: what a smaller level cannot
/// show is left out instead of coming back as a false pattern, and what it can show keeps its contrast once
/// texture units have interpolated. `srgb`: colours are averaged as light; alpha is linear anyway. `u`, `v`:
/// what lies beyond the edges.
std::vector<std::uint8_t> mip_levels(const Image& picture, bool srgb, scene::Wrap u, scene::Wrap v);

}  // namespace foveray::render
