#include "xr/simulator/display/background.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <glob.h>

#include <glm/gtc/packing.hpp>

#include "base/error.h"
#include "base/image.h"

namespace foveray::simulator {
namespace {

namespace fs = std::filesystem;

constexpr const char* variable = "FOVERAY_SIMULATOR_BACKGROUND=";

std::vector<fs::path> matches_of(const std::string& pattern) {
    std::vector<fs::path> files;
    glob_t found{};
    if (glob(pattern.c_str(), 0, nullptr, &found) == 0) {
        for (std::size_t i = 0; i < found.gl_pathc; ++i) files.emplace_back(found.gl_pathv[i]);
    }
    globfree(&found);
    return files;
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    return files;
}

vec3 parse_color(const std::string& text) {
    std::uint32_t bytes = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + 1, end, bytes, 16);
    if (text.size() != 7 || stop != end || error != std::errc{}) {
        throw_bad_input(variable + text, "is no colour", "write #rrggbb in hexadecimal digits");
    }
    const auto linear = [&](int shift) {
        return linear_from_srgb(static_cast<float>((bytes >> shift) & 255u) / 255.0f);
    };
    return {linear(16), linear(8), linear(0)};
}

}  // namespace

Background parse_background(const std::string& text) {
    Background background;
    if (text.empty() || text == "black") return background;
    if (text.front() == '#') {
        background.color = parse_color(text);
        return background;
    }
    std::error_code ignored;
    const bool is_pattern = text.find('*') != std::string::npos;
    if (is_pattern || fs::is_directory(text, ignored)) {
        background.kind = Background::Kind::Sequence;
        background.files = is_pattern ? matches_of(text) : files_in(text);
        std::ranges::sort(background.files);
        if (background.files.empty()) {
            throw_bad_input(variable + text, "there are no pictures",
                            "name a folder of PNG or JPEG files, or a pattern with *");
        }
        return background;
    }
    if (!fs::is_regular_file(text, ignored)) {
        throw_bad_input(
            variable + text, "there is no such file",
            "use black, #rrggbb, an equirectangular picture, a folder of pictures or a pattern with *");
    }
    background.kind = Background::Kind::Environment;
    background.files.emplace_back(text);
    return background;
}

BackgroundPicture read_background_picture(const fs::path& file) {
    BackgroundPicture picture;
    if (file.extension() != ".hdr") {
        Image image = read_image(file, 4);
        picture.size = {image.width, image.height};
        picture.pixels = std::move(image.pixels);
        return picture;
    }
    const FloatImage image = read_hdr(file);
    picture.size = {image.width, image.height};
    picture.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    const std::size_t count = std::size_t{image.width} * image.height;
    picture.pixels.resize(8 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const float* in = &image.pixels[3 * i];
        const glm::uint64 halves =
            glm::packHalf4x16(glm::min(vec4(in[0], in[1], in[2], 1.0f), vec4(65504.0f)));
        std::memcpy(&picture.pixels[8 * i], &halves, 8);
    }
    return picture;
}

}  // namespace foveray::simulator
