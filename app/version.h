#pragma once

#include <string_view>

namespace foveray::app {

constexpr std::string_view version = FOVERAY_VERSION;

}  // namespace foveray::app
