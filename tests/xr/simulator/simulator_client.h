#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/session.h"
#include "tests/xr/simulator/vulkan_client.h"

namespace foveray::simulator_tests {

#define ASSERT_XR_SUCCESS(call) ASSERT_EQ(XR_SUCCESS, call)

/// Sets the runtime and the simulator's variables for the next instance: virtual time and the given ones.
void set_environment(const std::map<std::string, std::string>& variables);

inline const std::vector<const char*> all_extensions = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME,
                                                        XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
                                                        XR_KHR_VISIBILITY_MASK_EXTENSION_NAME,
                                                        XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME,
                                                        XR_VARJO_QUAD_VIEWS_EXTENSION_NAME,
                                                        XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME,
                                                        XR_EXT_HAND_TRACKING_EXTENSION_NAME,
                                                        XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME,
                                                        XR_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                        XR_KHR_COMPOSITION_LAYER_CYLINDER_EXTENSION_NAME,
                                                        XR_KHR_COMPOSITION_LAYER_EQUIRECT2_EXTENSION_NAME};
/// Those of all_extensions that the runtime offers: it depends on the headset.
std::vector<const char*> offered_extensions();
/// For sessions without graphics.
inline const std::vector<const char*> headless_extensions = {
    XR_MND_HEADLESS_EXTENSION_NAME, XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME,
    XR_EXT_HAND_TRACKING_EXTENSION_NAME, XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME,
    XR_EXT_DEBUG_UTILS_EXTENSION_NAME};

/// A client of the simulator behind the real loader, one call a step.
class SimulatorClient {
  public:
    static constexpr XrSystemId system = 1;

    explicit SimulatorClient(const std::vector<const char*>& extensions = offered_extensions(),
                             XrVersion version = XR_MAKE_VERSION(1, 0, 0));
    ~SimulatorClient();
    SimulatorClient(const SimulatorClient&) = delete;
    SimulatorClient& operator=(const SimulatorClient&) = delete;

    void create_session(VulkanEnable enable = VulkanEnable::Second);
    void create_headless_session();
    void begin_session(XrViewConfigurationType type = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO);
    XrFrameState wait_frame();
    XrResult end_frame(XrTime time, const std::vector<const XrCompositionLayerBaseHeader*>& layers = {},
                       XrEnvironmentBlendMode mode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
    /// Wait, begin, end with no layers.
    XrFrameState empty_frame();
    /// States announced since the last call.
    std::vector<XrSessionState> take_states();
    /// All other events since the last call to take_states.
    std::vector<XrEventDataBuffer> other_events;

    XrSpace reference_space(XrReferenceSpaceType type, XrPosef pose = {{0, 0, 0, 1}, {0, 0, 0}});
    XrPath path(const std::string& text);
    /// Located with whatever is chained to `next`.
    XrSpaceLocation locate(XrSpace space, XrSpace base, XrTime time, void* next = nullptr);
    std::vector<XrView> locate_views(XrSpace base, XrTime time, XrViewConfigurationType type, bool foveated,
                                     XrViewStateFlags* flags = nullptr);
    template <typename Function>
    Function function(const char* name) {
        PFN_xrVoidFunction found = nullptr;
        EXPECT_EQ(xrGetInstanceProcAddr(instance, name, &found), XR_SUCCESS) << name;
        return reinterpret_cast<Function>(found);
    }

    XrInstance instance = XR_NULL_HANDLE;
    XrSession session = XR_NULL_HANDLE;
    std::unique_ptr<VulkanClient> vulkan;
};

/// A session of `frames` frames at 30 Hz on the ci headset, without samples.
Session make_session(std::uint64_t frames);

}  // namespace foveray::simulator_tests
