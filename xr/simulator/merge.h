#pragma once

#include "base/image.h"
#include "base/math.h"
#include "base/view.h"

namespace foveray::simulator {

/// What one view shows: four channels, linear light, colour premultiplied with alpha.
struct ViewPicture {
    FloatImage pixels;
    Fov fov;
};

/// Pixels of the merged picture of an eye over the context's field of view: the focus's density, or the
/// context's own without a focus; at most 2048 a side, and even.
uvec2 merged_size(const ViewPicture& context, const ViewPicture* focus);

/// The context stretched to `size` with the focus at its place, its outer tenth blended in softly. Linear,
/// premultiplied.
FloatImage merge(const ViewPicture& context, const ViewPicture* focus, uvec2 size);

/// `front` over `back`, both premultiplied and of one size; the result is in `back`.
void blend_over(FloatImage& back, const FloatImage& front);

}  // namespace foveray::simulator
