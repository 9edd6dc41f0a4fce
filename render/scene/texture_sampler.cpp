#include "render/scene/texture_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace foveray::scene {
namespace {

float linear_of(std::uint8_t srgb) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i) t[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
        return t;
    }();
    return table[srgb];
}

}  // namespace

std::uint32_t wrapped(std::int64_t texel, std::uint32_t size, Wrap wrap) {
    const std::int64_t n = size;
    if (wrap == Wrap::ClampToEdge)
        return static_cast<std::uint32_t>(std::clamp<std::int64_t>(texel, 0, n - 1));
    const std::int64_t period = wrap == Wrap::Repeat ? n : 2 * n;
    const std::int64_t m = (texel % period + period) % period;
    return static_cast<std::uint32_t>(m < n ? m : 2 * n - 1 - m);
}

TextureSampler::TextureSampler(const Scene& scene, TextureId texture)
    : sampler_(scene.textures[texture].sampler), full_(scene.images[scene.textures[texture].image].pixels) {
    for (uvec2 size = size_of(0); size.x > 1 || size.y > 1;) {
        const std::size_t level = halved_.size();
        const uvec2 last = size - 1u;
        size = glm::max(size / 2u, 1u);
        FloatImage half(size.x, size.y, 4);
        for (std::uint32_t y = 0; y < size.y; ++y) {
            for (std::uint32_t x = 0; x < size.x; ++x) {
                const uvec2 a = glm::min(2u * uvec2(x, y), last), b = glm::min(2u * uvec2(x, y) + 1u, last);
                const vec4 mean = 0.25f * (texel(level, a.x, a.y) + texel(level, b.x, a.y) +
                                           texel(level, a.x, b.y) + texel(level, b.x, b.y));
                for (int c = 0; c < 4; ++c) half.at(x, y)[c] = mean[c];
            }
        }
        halved_.push_back(std::move(half));
    }
}

uvec2 TextureSampler::size_of(std::size_t level) const {
    return level == 0 ? uvec2(full_.width, full_.height)
                      : uvec2(halved_[level - 1].width, halved_[level - 1].height);
}

vec4 TextureSampler::texel(std::size_t level, std::uint32_t x, std::uint32_t y) const {
    if (level > 0) {
        const float* t = halved_[level - 1].at(x, y);
        return {t[0], t[1], t[2], t[3]};
    }
    const std::uint8_t* t = full_.at(x, y);
    return {linear_of(t[0]), linear_of(t[1]), linear_of(t[2]), static_cast<float>(t[3]) / 255.0f};
}

vec4 TextureSampler::bilinear(std::size_t level, vec2 uv) const {
    const uvec2 size = size_of(level);
    const vec2 p = uv * vec2(size) - 0.5f;
    const vec2 corner = glm::floor(p), part = p - corner;
    const auto at = [&](int dx, int dy) {
        return texel(level, wrapped(static_cast<std::int64_t>(corner.x) + dx, size.x, sampler_.wrap_u),
                     wrapped(static_cast<std::int64_t>(corner.y) + dy, size.y, sampler_.wrap_v));
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), part.x), glm::mix(at(0, 1), at(1, 1), part.x), part.y);
}

vec4 TextureSampler::sample(vec2 uv, vec2 footprint) const {
    const vec2 texels = footprint * vec2(size_of(0));
    const float last = static_cast<float>(halved_.size());
    const float level = std::clamp(0.5f * std::log2(std::max(texels.x * texels.y, 1e-12f)), 0.0f, last);
    const auto lower = static_cast<std::size_t>(level);
    const std::size_t upper = std::min(lower + 1, halved_.size());
    // Far from the picture a float tells texels apart no more; a fraction repeats as well.
    const vec2 period(2.0f);
    const vec2 near = uv - period * glm::floor(uv / period);
    const vec2 place(sampler_.wrap_u == Wrap::ClampToEdge ? std::clamp(uv.x, -1.0f, 2.0f) : near.x,
                     sampler_.wrap_v == Wrap::ClampToEdge ? std::clamp(uv.y, -1.0f, 2.0f) : near.y);
    return glm::mix(bilinear(lower, place), bilinear(upper, place), level - static_cast<float>(lower));
}

}  // namespace foveray::scene
