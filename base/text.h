#pragma once

#include <span>
#include <string>
#include <string_view>

namespace foveray {

/// The candidate with the smallest edit distance to `word`, for "did you mean"; empty without candidates.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// Line ends become spaces, those at the end go.
std::string one_line(std::string text);

}  // namespace foveray
