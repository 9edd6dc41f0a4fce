#include "xr/simulator/merge.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace foveray::simulator {
namespace {

constexpr float max_side = 2048.0f;
constexpr float soft_border = 0.1f;  // part of the focus's width or height

/// One image axis in tangents: pixel 0 begins at `begin`, pixel `count` ends at `end`.
struct Axis {
    float begin, end;
    std::uint32_t count;

    float tangent_of(std::uint32_t pixel) const {
        return begin + (end - begin) * (static_cast<float>(pixel) + 0.5f) / static_cast<float>(count);
    }
    float part_of(float tangent) const { return (tangent - begin) / (end - begin); }
};

Axis x_axis(const Fov& fov, std::uint32_t count) { return {std::tan(fov.left), std::tan(fov.right), count}; }
Axis y_axis(const Fov& fov, std::uint32_t count) { return {std::tan(fov.up), std::tan(fov.down), count}; }

/// The source pixels that make one target pixel.
struct Taps {
    std::uint32_t first = 0;
    std::vector<float> weights;  // sum 1; none where the source has nothing
};

/// A tent as wide as a pixel of the coarser axis: bilinear when stretching, without aliasing when shrinking.
std::vector<Taps> make_taps(const Axis& target, const Axis& source) {
    const float step = std::abs((target.end - target.begin) / static_cast<float>(target.count) /
                                ((source.end - source.begin) / static_cast<float>(source.count)));
    const float radius = std::max(step, 1.0f);
    std::vector<Taps> taps(target.count);
    for (std::uint32_t i = 0; i < target.count; ++i) {
        const float part = source.part_of(target.tangent_of(i));
        if (part < 0.0f || part > 1.0f) continue;
        const float centre = part * static_cast<float>(source.count) - 0.5f;
        const float last = static_cast<float>(source.count) - 1.0f;
        const float from = std::clamp(std::ceil(centre - radius), 0.0f, last);
        const float to = std::clamp(std::floor(centre + radius), from, last);
        taps[i].first = static_cast<std::uint32_t>(from);
        float sum = 0.0f;
        for (float pixel = from; pixel <= to; pixel += 1.0f) {
            sum += taps[i].weights.emplace_back(std::max(1.0f - std::abs(pixel - centre) / radius, 0.0f));
        }
        if (sum <= 0.0f) taps[i].weights.assign(1, sum = 1.0f);
        for (float& weight : taps[i].weights) weight /= sum;
    }
    return taps;
}

/// 0 at the edges of the focus, 1 inside its border.
float border_weight(float part) {
    const float t = std::clamp(std::min(part, 1.0f - part) / soft_border, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Resamples `source` over `target`, mixing by `weight_x` times `weight_y` (part of the source's extent).
template <typename Weight>
void draw(FloatImage& target, const Fov& target_fov, const ViewPicture& source, Weight weight) {
    const Axis tx = x_axis(target_fov, target.width), ty = y_axis(target_fov, target.height);
    const Axis sx = x_axis(source.fov, source.pixels.width), sy = y_axis(source.fov, source.pixels.height);
    const std::vector<Taps> columns = make_taps(tx, sx), rows = make_taps(ty, sy);

    FloatImage narrow(target.width, source.pixels.height, 4);  // resampled along x only
    for (std::uint32_t y = 0; y < narrow.height; ++y) {
        for (std::uint32_t x = 0; x < narrow.width; ++x) {
            float* out = narrow.at(x, y);
            for (std::size_t k = 0; k < columns[x].weights.size(); ++k) {
                const float* in = source.pixels.at(columns[x].first + static_cast<std::uint32_t>(k), y);
                for (int c = 0; c < 4; ++c) out[c] += columns[x].weights[k] * in[c];
            }
        }
    }
    for (std::uint32_t y = 0; y < target.height; ++y) {
        if (rows[y].weights.empty()) continue;
        const float weight_y = weight(sy.part_of(ty.tangent_of(y)));
        for (std::uint32_t x = 0; x < target.width; ++x) {
            if (columns[x].weights.empty()) continue;
            vec4 sum(0.0f);
            for (std::size_t k = 0; k < rows[y].weights.size(); ++k) {
                const float* in = narrow.at(x, rows[y].first + static_cast<std::uint32_t>(k));
                sum += rows[y].weights[k] * vec4(in[0], in[1], in[2], in[3]);
            }
            const float mix = weight_y * weight(sx.part_of(tx.tangent_of(x)));
            float* out = target.at(x, y);
            for (int c = 0; c < 4; ++c) out[c] += mix * (sum[c] - out[c]);
        }
    }
}

std::uint32_t even(float size) {
    return std::max(2u, 2u * static_cast<std::uint32_t>(std::lround(size / 2.0f)));
}

}  // namespace

uvec2 merged_size(const ViewPicture& context, const ViewPicture* focus) {
    vec2 size(context.pixels.width, context.pixels.height);
    if (focus) {
        const auto density = [](const ViewPicture& view) {
            const vec2 extent(std::tan(view.fov.right) - std::tan(view.fov.left),
                              std::tan(view.fov.up) - std::tan(view.fov.down));
            return vec2(view.pixels.width, view.pixels.height) / glm::abs(extent);
        };
        const vec2 ratio = density(*focus) / density(context);
        size *= std::max({1.0f, ratio.x, ratio.y});  // one factor, so that pixels keep their shape
    }
    size *= std::min(1.0f, max_side / std::max(size.x, size.y));
    return {even(size.x), even(size.y)};
}

FloatImage merge(const ViewPicture& context, const ViewPicture* focus, uvec2 size) {
    FloatImage merged(size.x, size.y, 4);
    draw(merged, context.fov, context, [](float) { return 1.0f; });
    if (focus) draw(merged, context.fov, *focus, border_weight);
    return merged;
}

void blend_over(FloatImage& back, const FloatImage& front) {
    for (std::size_t i = 0; i < back.pixels.size(); i += 4) {
        const float behind = 1.0f - front.pixels[i + 3];
        for (std::size_t c = 0; c < 4; ++c)
            back.pixels[i + c] = front.pixels[i + c] + behind * back.pixels[i + c];
    }
}

}  // namespace foveray::simulator
