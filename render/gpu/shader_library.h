#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace foveray::gpu {

/// SPIR-V of a shader that the build compiled and embedded, by its path below shaders/, as in
/// "render/resolve.comp". A name that was not built is a bug and asserts.
std::span<const std::uint32_t> shader(std::string_view name);

}  // namespace foveray::gpu
