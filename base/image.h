#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/math.h"

namespace foveray {

/// Interleaved rows, top row first; T is std::uint8_t or float.
template <typename T>
struct BasicImage {
    std::uint32_t width = 0, height = 0, channels = 0;
    std::vector<T> pixels;

    BasicImage() = default;
    BasicImage(std::uint32_t w, std::uint32_t h, std::uint32_t c)
        : width(w), height(h), channels(c), pixels(std::size_t{w} * h * c) {}

    bool empty() const { return pixels.empty(); }
    T* at(std::uint32_t x, std::uint32_t y) { return &pixels[(std::size_t{y} * width + x) * channels]; }
    const T* at(std::uint32_t x, std::uint32_t y) const {
        return &pixels[(std::size_t{y} * width + x) * channels];
    }
    bool operator==(const BasicImage&) const = default;
};

using Image = BasicImage<std::uint8_t>;  // sRGB unless its user says otherwise
using FloatImage = BasicImage<float>;    // linear

/// PNG, JPEG, BMP or TGA, converted to `channels`. Throws Fault(BadInput) naming the file.
Image read_image(const std::filesystem::path& file, std::uint32_t channels);
/// The same from memory; `name` stands for the file in messages.
Image decode_image(std::span<const std::uint8_t> bytes, std::uint32_t channels, const std::string& name);
/// Radiance .hdr, three linear channels. Throws Fault(BadInput).
FloatImage read_hdr(const std::filesystem::path& file);
/// Creates missing parent folders. Throws Fault(BadInput) when the file cannot be written.
void write_png(const std::filesystem::path& file, const Image& image);

float linear_from_srgb(float value);
float srgb_from_linear(float value);

}  // namespace foveray
