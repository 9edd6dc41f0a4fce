#pragma once

#include <openxr/openxr.h>

// OpenXR 1.1 and what came shortly before it. Headers that lack it (Debian 12 has 1.0.20) get the
// declarations that the code needs to compile; nothing of it is offered there.
#ifdef XR_VERSION_1_1
namespace foveray::simulator {
inline constexpr bool has_openxr_1_1 = true;
}
#else
namespace foveray::simulator {
inline constexpr bool has_openxr_1_1 = false;
}

#define XR_KHR_locate_spaces_SPEC_VERSION 1
#define XR_KHR_LOCATE_SPACES_EXTENSION_NAME "XR_KHR_locate_spaces"
#define XR_KHR_maintenance1_SPEC_VERSION 1
#define XR_KHR_MAINTENANCE1_EXTENSION_NAME "XR_KHR_maintenance1"
#define XR_EXT_local_floor_SPEC_VERSION 1
#define XR_EXT_LOCAL_FLOOR_EXTENSION_NAME "XR_EXT_local_floor"
#define XR_EXT_user_presence_SPEC_VERSION 1
#define XR_EXT_USER_PRESENCE_EXTENSION_NAME "XR_EXT_user_presence"

inline constexpr auto XR_TYPE_SPACES_LOCATE_INFO = static_cast<XrStructureType>(1000471000);
inline constexpr auto XR_TYPE_SPACE_LOCATIONS = static_cast<XrStructureType>(1000471001);
inline constexpr auto XR_TYPE_SPACE_VELOCITIES = static_cast<XrStructureType>(1000471002);
inline constexpr auto XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT = static_cast<XrStructureType>(1000470000);
inline constexpr auto XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT = static_cast<XrStructureType>(1000470001);
inline constexpr auto XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR = static_cast<XrReferenceSpaceType>(1000426000);

inline constexpr auto XR_ERROR_EXTENSION_DEPENDENCY_NOT_ENABLED = static_cast<XrResult>(-1000710001);

struct XrSpacesLocateInfo {
    XrStructureType type;
    const void* next;
    XrSpace baseSpace;
    XrTime time;
    std::uint32_t spaceCount;
    const XrSpace* spaces;
};
struct XrSpaceLocationData {
    XrSpaceLocationFlags locationFlags;
    XrPosef pose;
};
struct XrSpaceLocations {
    XrStructureType type;
    void* next;
    std::uint32_t locationCount;
    XrSpaceLocationData* locations;
};
struct XrSpaceVelocityData {
    XrSpaceVelocityFlags velocityFlags;
    XrVector3f linearVelocity;
    XrVector3f angularVelocity;
};
struct XrSpaceVelocities {
    XrStructureType type;
    void* next;
    std::uint32_t velocityCount;
    XrSpaceVelocityData* velocities;
};
using PFN_xrLocateSpaces = XrResult(XRAPI_PTR*)(XrSession, const XrSpacesLocateInfo*, XrSpaceLocations*);
using PFN_xrLocateSpacesKHR = PFN_xrLocateSpaces;

struct XrEventDataUserPresenceChangedEXT {
    XrStructureType type;
    const void* next;
    XrSession session;
    XrBool32 isUserPresent;
};
struct XrSystemUserPresencePropertiesEXT {
    XrStructureType type;
    void* next;
    XrBool32 supportsUserPresence;
};
#endif

namespace foveray::simulator {

/// Stands among the features of an instance that asked for OpenXR 1.1.
inline constexpr char openxr_1_1[] = "XR_VERSION_1_1";

/// In the core of 1.1; instances of 1.1 have them without asking. None has functions.
inline constexpr const char* promoted_to_1_1[] = {XR_KHR_MAINTENANCE1_EXTENSION_NAME,
                                                  XR_EXT_LOCAL_FLOOR_EXTENSION_NAME,
                                                  XR_VARJO_QUAD_VIEWS_EXTENSION_NAME};

}  // namespace foveray::simulator
