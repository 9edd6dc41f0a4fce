#include "render/mip_levels.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/math.h"

namespace foveray::render {
namespace {

using scene::Wrap;

/// Grey `shade(x, y)` of 0 to 1, opaque.
template <typename Shade>
Image picture(std::uint32_t width, std::uint32_t height, Shade shade) {
    Image image(width, height, 4);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const float value = shade(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            std::fill_n(image.at(x, y), 3, static_cast<std::uint8_t>(255.0f * value + 0.5f));
            image.at(x, y)[3] = 255;
        }
    }
    return image;
}

Image level(const Image& from, std::uint32_t wanted, bool srgb = false, Wrap wrap = Wrap::Repeat) {
    const std::vector<std::uint8_t> texels = mip_levels(from, srgb, wrap, wrap);
    std::uint32_t width = from.width, height = from.height;
    std::size_t start = 0;
    for (std::uint32_t i = 0; i < wanted; ++i) {
        start += std::size_t{4} * width * height;
        width = std::max(1u, width / 2), height = std::max(1u, height / 2);
    }
    Image result(width, height, 4);
    std::copy_n(texels.begin() + static_cast<std::ptrdiff_t>(start), result.pixels.size(),
                result.pixels.begin());
    return result;
}

/// Amplitude of `periods` waves across a level's rows, part of that of waves().
double amplitude(const Image& image, double periods) {
    double sine = 0.0, cosine = 0.0;
    for (std::uint32_t x = 0; x < image.width; ++x) {
        const double phase = 2.0 * pi * periods * (x + 0.5) / image.width;
        sine += image.at(x, 0)[0] * std::sin(phase), cosine += image.at(x, 0)[0] * std::cos(phase);
    }
    return 8.0 / 255.0 * std::hypot(sine, cosine) / image.width;
}

Image waves(float periods) {
    return picture(256, 4, [&](float x, float) {
        return 0.5f + 0.25f * std::sin(2.0f * pi * periods * x / 256.0f + 1.0f);
    });
}

TEST(MipLevels, EndAtOneTexelWhateverTheSize) {
    for (const auto& [width, height] : {std::pair{7u, 5u}, {1u, 9u}, {256u, 1u}, {1u, 1u}, {12u, 100u}}) {
        const Image flat = picture(width, height, [](float, float) { return 0.6f; });
        std::size_t texels = 0;
        std::uint32_t last = 0;
        std::uint32_t w = width, h = height;
        for (std::uint32_t i = 0; i < mip_level_count(width, height); ++i) {
            texels += std::size_t{w} * h;
            last = w * h;
            w = std::max(1u, w / 2), h = std::max(1u, h / 2);
        }
        EXPECT_EQ(last, 1u);
        for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
            for (const bool srgb : {false, true}) {
                const auto all = mip_levels(flat, srgb, wrap, wrap);
                ASSERT_EQ(all.size(), 4 * texels);
                for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(all[i], i % 4 == 3 ? 255 : 153) << i;
            }
        }
    }
}

TEST(MipLevels, KeepWhatTheyCanShowOnceItIsInterpolated) {
    // A quarter and an eighth of a wave a texel of level 3; linear interpolation leaves sinc^2 of it.
    for (const double part : {0.25, 0.125}) {
        const double sinc = std::sin(pi * part) / (pi * part);
        const double seen =
            amplitude(level(waves(static_cast<float>(32.0 * part)), 3), 32.0 * part) * sinc * sinc;
        EXPECT_NEAR(seen, 1.0, 0.07) << part;
    }
}

TEST(MipLevels, LeaveOutWhatTheyCannotShow) {
    // 0.69 and 0.81 waves a texel would come back as 0.31 and 0.19; halving by means lets 38 and 23 %
    // through.
    EXPECT_LT(amplitude(level(waves(22.0f), 3), 10.0), 0.08);
    EXPECT_LT(amplitude(level(waves(26.0f), 3), 6.0), 0.05);
    EXPECT_LT(amplitude(level(waves(60.0f), 3), 4.0), 0.03);
}

TEST(MipLevels, AverageColorsAsLightAndAlphaAsItIs) {
    Image columns = picture(16, 16, [](float x, float) { return std::fmod(x, 2.0f) < 1.0f ? 1.0f : 0.0f; });
    for (std::uint32_t i = 0; i < 16 * 16; ++i) columns.pixels[4 * i + 3] = columns.pixels[4 * i];
    const Image light = level(columns, 1, true), data = level(columns, 1, false);
    EXPECT_NEAR(light.at(3, 3)[0], 255.0f * srgb_from_linear(0.5f), 1.0f);
    EXPECT_NEAR(light.at(3, 3)[3], 127.5f, 1.0f);
    EXPECT_NEAR(data.at(3, 3)[0], 127.5f, 1.0f);
}

TEST(MipLevels, GoOnBeyondTheEdgesAsTheSamplerDoes) {
    // A bright line at the right edge: repeated, it lies beyond the left one too.
    const Image line = picture(64, 4, [](float x, float) { return x < 63.0f ? 0.2f : 0.8f; });
    EXPECT_EQ(level(line, 1, false, Wrap::ClampToEdge).at(0, 0)[0], 51);
    EXPECT_EQ(level(line, 1, false, Wrap::MirroredRepeat).at(0, 0)[0], 51);
    EXPECT_GT(level(line, 1, false, Wrap::Repeat).at(0, 0)[0], 60);
}

}  // namespace
}  // namespace foveray::render
