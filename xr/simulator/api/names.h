#pragma once

#include <optional>
#include <string_view>

#include <openxr/openxr.h>

namespace foveray::simulator {

// nullptr for values that the headers do not have.
const char* name_of(XrResult value);
const char* name_of(XrStructureType value);
const char* name_of(XrSessionState value);
/// The value of "XR_ERROR_HANDLE_INVALID"; nothing for names that the headers do not have.
std::optional<XrResult> result_of_name(std::string_view name);

}  // namespace foveray::simulator
