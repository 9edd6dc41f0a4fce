#include "render/gpu/shader_library.h"

#include <cassert>
#include <utility>

namespace foveray::gpu {

std::span<const std::pair<std::string_view, std::span<const std::uint32_t>>> embedded_shaders();

std::span<const std::uint32_t> shader(std::string_view name) {
    for (const auto& [key, code] : embedded_shaders()) {
        if (key == name) return code;
    }
    assert(!"no such shader was built");
    return {};
}

}  // namespace foveray::gpu
