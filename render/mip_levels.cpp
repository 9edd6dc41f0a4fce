#include "render/mip_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/math.h"
#include "render/scene/texture_sampler.h"

namespace foveray::render {
namespace {

/// Half the kernel's width, in texels of the smaller level.
constexpr float reach = 2.0f;

/// Of Kaiser's window. Smaller sharpens more than the texture unit's linear filter blurs, and rings; larger
/// blurs.
constexpr float window_shape = 1.5f;

/// Modified Bessel function of the first kind, order 0.
float bessel(float x) {
    float sum = 1.0f, root = 1.0f;
    for (int k = 1; k <= 8; ++k) {
        root *= x / (2.0f * static_cast<float>(k));
        sum += root * root;
    }
    return sum;
}

/// A sinc in Kaiser's window. Crochiere and Rabiner 1983, "Multirate Digital Signal Processing", 4.3.
float kernel(float x) {
    if (std::abs(x) >= reach) return 0.0f;
    const float sinc = x == 0.0f ? 1.0f : std::sin(pi * x) / (pi * x);
    return sinc * bessel(window_shape * std::sqrt(1.0f - x * x / (reach * reach)));
}

/// Which texels of a row make each texel of the row of half the size, and how much of each.
struct Halving {
    std::uint32_t taps;                 // a texel of the result
    std::vector<std::uint32_t> texels;  // [size of the result][taps]
    std::vector<float> weights;
};

Halving halving(std::uint32_t from, std::uint32_t to, scene::Wrap wrap) {
    if (from == to) {
        Halving same{1, {}, std::vector<float>(to, 1.0f)};
        for (std::uint32_t i = 0; i < to; ++i) same.texels.push_back(i);
        return same;
    }
    const float ratio = static_cast<float>(from) / static_cast<float>(to);
    Halving h{static_cast<std::uint32_t>(std::ceil(2.0f * reach * ratio)), {}, {}};
    for (std::uint32_t i = 0; i < to; ++i) {
        const float center = (static_cast<float>(i) + 0.5f) * ratio;
        const auto first = static_cast<std::int64_t>(std::ceil(center - reach * ratio - 0.5f));
        float sum = 0.0f;
        for (std::uint32_t tap = 0; tap < h.taps; ++tap) {
            h.texels.push_back(scene::wrapped(first + tap, from, wrap));
            h.weights.push_back(kernel((static_cast<float>(first + tap) + 0.5f - center) / ratio));
            sum += h.weights.back();
        }
        for (std::uint32_t tap = 0; tap < h.taps; ++tap) h.weights[i * h.taps + tap] /= sum;
    }
    return h;
}

FloatImage halved(const FloatImage& from, scene::Wrap u, scene::Wrap v) {
    const std::uint32_t width = std::max(1u, from.width / 2), height = std::max(1u, from.height / 2);
    const Halving along = halving(from.width, width, u), down = halving(from.height, height, v);
    FloatImage narrow(width, from.height, 4), result(width, height, 4);
    for (std::uint32_t y = 0; y < from.height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            vec4 sum(0.0f);
            for (std::uint32_t tap = x * along.taps; tap < (x + 1) * along.taps; ++tap) {
                const float* texel = from.at(along.texels[tap], y);
                sum += along.weights[tap] * vec4(texel[0], texel[1], texel[2], texel[3]);
            }
            std::copy_n(&sum[0], 4, narrow.at(x, y));
        }
    }
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t tap = y * down.taps; tap < (y + 1) * down.taps; ++tap) {
            const float* row = narrow.at(0, down.texels[tap]);
            float* sum = result.at(0, y);
            for (std::uint32_t i = 0; i < 4 * width; ++i) sum[i] += down.weights[tap] * row[i];
        }
    }
    return result;
}

}  // namespace

std::uint32_t mip_level_count(std::uint32_t width, std::uint32_t height) {
    return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

std::vector<std::uint8_t> mip_levels(const Image& picture, bool srgb, scene::Wrap u, scene::Wrap v) {
    assert(picture.channels == 4);
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const float value = static_cast<float>(i) / 255.0f;
        linear[i] = srgb ? linear_from_srgb(value) : value;
    }
    FloatImage level(picture.width, picture.height, 4);
    for (std::size_t i = 0; i < level.pixels.size(); ++i) {
        const std::uint8_t value = picture.pixels[i];
        level.pixels[i] = i % 4 == 3 ? static_cast<float>(value) / 255.0f : linear[value];
    }
    std::vector<std::uint8_t> texels = picture.pixels;
    for (std::uint32_t i = 1; i < mip_level_count(picture.width, picture.height); ++i) {
        level = halved(level, u, v);
        for (std::size_t j = 0; j < level.pixels.size(); ++j) {
            float value = std::clamp(level.pixels[j], 0.0f, 1.0f);
            if (srgb && j % 4 != 3) value = srgb_from_linear(value);
            texels.push_back(static_cast<std::uint8_t>(255.0f * value + 0.5f));
        }
    }
    return texels;
}

}  // namespace foveray::render
