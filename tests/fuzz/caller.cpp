#include "tests/fuzz/caller.h"

#include <cstdio>
#include <cstdlib>

namespace foveray::fuzz {

const std::vector<const char*> extensions{
    XR_MND_HEADLESS_EXTENSION_NAME,
    XR_KHR_VULKAN_ENABLE_EXTENSION_NAME,
    XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME,
    XR_KHR_VISIBILITY_MASK_EXTENSION_NAME,
    XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
    XR_KHR_COMPOSITION_LAYER_CYLINDER_EXTENSION_NAME,
    XR_KHR_COMPOSITION_LAYER_EQUIRECT2_EXTENSION_NAME,
    XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME,
    XR_EXT_DEBUG_UTILS_EXTENSION_NAME,
    XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME,
    XR_EXT_HAND_TRACKING_EXTENSION_NAME,
    XR_VARJO_QUAD_VIEWS_EXTENSION_NAME,
    XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME,
#ifdef XR_VERSION_1_1
    XR_KHR_LOCATE_SPACES_EXTENSION_NAME,
    XR_EXT_LOCAL_FLOOR_EXTENSION_NAME,
    XR_EXT_USER_PRESENCE_EXTENSION_NAME,
#endif
};

const std::vector<std::string> path_texts{
    "/user/hand/left",
    "/user/hand/right",
    "/user/head",
    "/user/gamepad",
    "/user/eyes_ext",
    "/user/invalid",
    "/interaction_profiles/khr/simple_controller",
    "/interaction_profiles/valve/index_controller",
    "/interaction_profiles/oculus/touch_controller",
    "/interaction_profiles/microsoft/xbox_controller",
    "/interaction_profiles/ext/eye_gaze_interaction",
    "/user/hand/left/input/select/click",
    "/user/hand/right/input/select/click",
    "/user/hand/left/input/trigger/value",
    "/user/hand/left/input/trigger",
    "/user/hand/left/input/thumbstick",
    "/user/hand/left/input/thumbstick/x",
    "/user/hand/left/input/grip/pose",
    "/user/hand/right/input/aim/pose",
    "/user/hand/left/input/grip_surface/pose",
    "/user/hand/left/output/haptic",
    "/user/eyes_ext/input/gaze_ext/pose",
    "/user/gamepad/input/a/click",
    "/x",
};

Functions::Functions(const simulator_tests::DirectRuntime& runtime) {
    const XrInstance instance = runtime.create_instance(extensions);
#define FOVERAY_LOAD(name, feature) name = runtime.load<PFN_##name>(instance, #name);
    FOVERAY_SIMULATOR_FUNCTIONS(FOVERAY_LOAD)
#undef FOVERAY_LOAD
    xrDestroyInstance(instance);
}

XrPath Caller::path() {
    if (random.chance(5)) return random.chance(50) ? XR_NULL_PATH : random.bits();
    XrPath made = XR_NULL_PATH;
    // Atoms are the same in every instance that was asked in the same order; others are worth a try too.
    call.xrStringToPath(handles.pick<XrInstance>(random), random.pick(path_texts).c_str(), &made);
    return made;
}

XrTime Caller::time() {
    if (random.chance(85)) return last_time + static_cast<XrTime>(random.below(200'000'000)) - 100'000'000;
    return random.pick(
        {XrTime{0}, XrTime{-1}, XrTime{1}, INT64_MAX, INT64_MIN, static_cast<XrTime>(random.bits())});
}

XrPosef Caller::pose() {
    if (random.chance(90)) return {{0, 0, 0, 1}, {random.number(), random.number(), random.number()}};
    return {{random.number(), random.number(), random.number(), random.number()},
            {random.number(), random.number(), random.number()}};
}

XrViewConfigurationType Caller::view_configuration() {
    return random.pick({XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO,
                        XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO,
                        XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO, XR_VIEW_CONFIGURATION_TYPE_MAX_ENUM});
}

std::string Caller::name() {
    if (random.chance(90)) return "n" + std::to_string(random.below(50));
    return random.pick({std::string(), std::string("Not A Path"), std::string(500, 'x'), std::string("..."),
                        std::string("\xff\xfe")});
}

void* Caller::chain() {
    void* made = nullptr;
    switch (random.below(5)) {
        case 0: {
            auto& velocity = *array<XrSpaceVelocity>(1);
            velocity.type = XR_TYPE_SPACE_VELOCITY;
            made = &velocity;
            break;
        }
        case 1: {
            auto& follow = *array<XrViewLocateFoveatedRenderingVARJO>(1);
            follow.type = XR_TYPE_VIEW_LOCATE_FOVEATED_RENDERING_VARJO;
            follow.foveatedRenderingActive = static_cast<XrBool32>(random.below(3));
            made = &follow;
            break;
        }
        case 2: {
            auto& sample = *array<XrEyeGazeSampleTimeEXT>(1);
            sample.type = XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT;
            made = &sample;
            break;
        }
        default: {
            auto& unknown = *array<XrBaseOutStructure>(1);
            unknown.type = static_cast<XrStructureType>(0x7000'0000 + random.below(100));
            made = &unknown;
        }
    }
    return made;
}

}  // namespace foveray::fuzz
