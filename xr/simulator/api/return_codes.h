#pragma once

#include <string_view>
#include <vector>

#include <openxr/openxr.h>

#include "xr/simulator/api/functions.h"

namespace foveray::simulator {

/// The errors that the specification lists for a function, without "XR_ERROR_".
std::vector<std::string_view> error_codes(const FunctionEntry& function);
bool may_answer(const FunctionEntry& function, XrResult error);

}  // namespace foveray::simulator
