#include "xr/simulator/api/names.h"

#include <openxr/openxr_reflection.h>

namespace foveray::simulator {

const char* name_of(XrResult value) {
    switch (value) {
#define FOVERAY_CASE(name, number) \
    case name:                     \
        return #name;
        XR_LIST_ENUM_XrResult(FOVERAY_CASE) default : return nullptr;
    }
}

const char* name_of(XrStructureType value) {
    switch (value) { XR_LIST_ENUM_XrStructureType(FOVERAY_CASE) default : return nullptr; }
}

const char* name_of(XrSessionState value) {
    switch (value) {
        XR_LIST_ENUM_XrSessionState(FOVERAY_CASE)
#undef FOVERAY_CASE
            default : return nullptr;
    }
}

std::optional<XrResult> result_of_name(std::string_view name) {
#define FOVERAY_COMPARE(known, number) \
    if (name == #known) return known;
    XR_LIST_ENUM_XrResult(FOVERAY_COMPARE)
#undef FOVERAY_COMPARE
        return std::nullopt;
}

}  // namespace foveray::simulator
