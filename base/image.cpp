#include "base/image.h"

#include <cmath>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_GIF
#define STBI_NO_PSD
#define STBI_NO_PIC
#define STBI_NO_PNM
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "base/error.h"

namespace foveray {
namespace {

using StbPixels = std::unique_ptr<void, decltype(&stbi_image_free)>;

[[noreturn]] void throw_not_an_image(const std::string& name) {
    throw_bad_input(name, std::string("not a readable image: ") + stbi_failure_reason(),
                    "use a PNG or JPEG file, or .hdr for an environment");
}

}  // namespace

Image read_image(const std::filesystem::path& file, std::uint32_t channels) {
    int w = 0, h = 0, n = 0;
    StbPixels pixels(stbi_load(file.c_str(), &w, &h, &n, static_cast<int>(channels)), stbi_image_free);
    if (!pixels) throw_not_an_image(file.string());
    Image image(w, h, channels);
    const auto* first = static_cast<const std::uint8_t*>(pixels.get());
    image.pixels.assign(first, first + image.pixels.size());
    return image;
}

Image decode_image(std::span<const std::uint8_t> bytes, std::uint32_t channels, const std::string& name) {
    int w = 0, h = 0, n = 0;
    StbPixels pixels(stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &w, &h, &n,
                                           static_cast<int>(channels)),
                     stbi_image_free);
    if (!pixels) throw_not_an_image(name);
    Image image(w, h, channels);
    const auto* first = static_cast<const std::uint8_t*>(pixels.get());
    image.pixels.assign(first, first + image.pixels.size());
    return image;
}

FloatImage read_hdr(const std::filesystem::path& file) {
    int w = 0, h = 0, n = 0;
    StbPixels pixels(stbi_loadf(file.c_str(), &w, &h, &n, 3), stbi_image_free);
    if (!pixels) throw_not_an_image(file.string());
    FloatImage image(w, h, 3);
    const auto* first = static_cast<const float*>(pixels.get());
    image.pixels.assign(first, first + image.pixels.size());
    return image;
}

float linear_from_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

float srgb_from_linear(float v) {
    return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

}  // namespace foveray
