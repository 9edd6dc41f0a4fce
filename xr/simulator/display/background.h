#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "base/math.h"

namespace foveray::simulator {

/// What the wearer sees where the layers let the world through.
struct Background {
    enum class Kind { Color, Environment, Sequence };
    Kind kind = Kind::Color;
    vec3 color{0.0f};                          // linear
    std::vector<std::filesystem::path> files;  // one environment, or the pictures of a sequence in order

    /// The sequence starts again after its last picture.
    const std::filesystem::path& file_of(std::uint64_t frame) const { return files[frame % files.size()]; }
};

/// FOVERAY_SIMULATOR_BACKGROUND: black, #rrggbb, the file of an environment, a folder of pictures or a
/// pattern with
/// *. Throws Fault(BadInput).
Background parse_background(const std::string& text);

/// Pixels as the format has them: halves for .hdr, else sRGB bytes.
struct BackgroundPicture {
    uvec2 size{1};
    VkFormat format = VK_FORMAT_R8G8B8A8_SRGB;
    std::vector<std::uint8_t> pixels;
};
/// Throws Fault(BadInput).
BackgroundPicture read_background_picture(const std::filesystem::path& file);

}  // namespace foveray::simulator
