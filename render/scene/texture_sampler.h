#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/material.h"
#include "render/scene/scene.h"

namespace foveray::scene {

/// The texel that stands for one that may lie outside of `size` texels.
std::uint32_t wrapped(std::int64_t texel, std::uint32_t size, Wrap wrap);

/// A colour texture read on the CPU, averaged over any footprint: linear RGBA in levels halved with a box
/// filter, bilinear in the nearest two. The scene must outlive it.
class TextureSampler {
  public:
    TextureSampler(const Scene& scene, TextureId texture);

    /// `footprint`: width of what is averaged, as a part of the whole picture's width and height.
    vec4 sample(vec2 uv, vec2 footprint) const;

  private:
    vec4 texel(std::size_t level, std::uint32_t x, std::uint32_t y) const;
    vec4 bilinear(std::size_t level, vec2 uv) const;
    uvec2 size_of(std::size_t level) const;

    Sampler sampler_;
    const Image& full_;               // level 0
    std::vector<FloatImage> halved_;  // level 1 and on
};

}  // namespace foveray::scene
