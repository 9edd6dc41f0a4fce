#pragma once

#include <cstdint>

namespace foveray::simulator {

constexpr std::uint32_t max_swapchain_size = 8192;  // pixels a side
constexpr std::uint32_t max_view_size = 4096;       // of one view, pixels a side
constexpr std::uint32_t max_array_size = 2048;
constexpr std::uint32_t max_layers = 16;  // of a frame; OpenXR's least allowed maximum

}  // namespace foveray::simulator
