#pragma once

#include <span>
#include <string_view>
#include <utility>

namespace foveray::user_shapes {

/// The GLSL of foveray that a user's shape is compiled with, by its path from the repository's root.
std::span<const std::pair<std::string_view, std::string_view>> snippets();

}  // namespace foveray::user_shapes
