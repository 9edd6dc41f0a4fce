#pragma once

#include <openxr/openxr.h>

namespace foveray::simulator {

// nullptr for values that the headers do not have.
const char* name_of(XrResult value);
const char* name_of(XrStructureType value);

}  // namespace foveray::simulator
