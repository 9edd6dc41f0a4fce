#include "tests/xr/simulator/simulator_client.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace foveray::simulator_tests {

void set_environment(const std::map<std::string, std::string>& variables) {
    setenv("XR_RUNTIME_JSON", SIMULATOR_MANIFEST, 1);
    setenv("FOVERAY_SIMULATOR_TIME", "virtual", 1);
    for (const char* name :
         {"PROFILE", "SESSION", "CAPTURE", "CAPTURE_FRAMES", "CAPTURE_FORMAT", "BACKGROUND", "WINDOW", "GPU",
          "TIMING", "FAULTS", "CONTROL", "PATTERN", "GAZE"}) {
        unsetenv((std::string("FOVERAY_SIMULATOR_") + name).c_str());
    }
    for (const auto& [name, value] : variables)
        setenv(("FOVERAY_SIMULATOR_" + name).c_str(), value.c_str(), 1);
}

std::vector<const char*> offered_extensions() {
    std::uint32_t count = 0;
    EXPECT_EQ(xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr), XR_SUCCESS);
    XrExtensionProperties blank{};
    blank.type = XR_TYPE_EXTENSION_PROPERTIES;
    std::vector<XrExtensionProperties> list(count, blank);
    EXPECT_EQ(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, list.data()), XR_SUCCESS);
    std::vector<const char*> names = all_extensions;
    std::erase_if(names, [&](const std::string& name) {
        return std::ranges::none_of(list, [&](const auto& offered) { return name == offered.extensionName; });
    });
    return names;
}

SimulatorClient::SimulatorClient(const std::vector<const char*>& extensions, XrVersion version) {
    XrInstanceCreateInfo info{};
    info.type = XR_TYPE_INSTANCE_CREATE_INFO;
    std::strcpy(info.applicationInfo.applicationName, "simulator tests");
    info.applicationInfo.apiVersion = version;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.enabledExtensionNames = extensions.data();
    EXPECT_EQ(xrCreateInstance(&info, &instance), XR_SUCCESS);
}

SimulatorClient::~SimulatorClient() {
    if (session) xrDestroySession(session);
    vulkan.reset();
    if (instance) xrDestroyInstance(instance);
}

void SimulatorClient::create_session(VulkanEnable enable) {
    vulkan = std::make_unique<VulkanClient>(instance, enable);
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &vulkan->binding(), 0, system};
    ASSERT_XR_SUCCESS(xrCreateSession(instance, &info, &session));
}

void SimulatorClient::create_headless_session() {
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, nullptr, 0, system};
    ASSERT_XR_SUCCESS(xrCreateSession(instance, &info, &session));
}

void SimulatorClient::begin_session(XrViewConfigurationType type) {
    const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, type};
    ASSERT_XR_SUCCESS(xrBeginSession(session, &info));
}

XrFrameState SimulatorClient::wait_frame() {
    XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
    EXPECT_EQ(xrWaitFrame(session, nullptr, &state), XR_SUCCESS);
    return state;
}

XrResult SimulatorClient::end_frame(XrTime time,
                                    const std::vector<const XrCompositionLayerBaseHeader*>& layers,
                                    XrEnvironmentBlendMode mode) {
    const XrFrameEndInfo info{
        XR_TYPE_FRAME_END_INFO, nullptr, time, mode, static_cast<std::uint32_t>(layers.size()),
        layers.data()};
    return xrEndFrame(session, &info);
}

XrFrameState SimulatorClient::empty_frame() {
    const XrFrameState state = wait_frame();
    EXPECT_EQ(xrBeginFrame(session, nullptr), XR_SUCCESS);
    EXPECT_EQ(end_frame(state.predictedDisplayTime), XR_SUCCESS);
    return state;
}

std::vector<XrSessionState> SimulatorClient::take_states() {
    other_events.clear();
    std::vector<XrSessionState> states;
    while (true) {
        XrEventDataBuffer event{};
        event.type = XR_TYPE_EVENT_DATA_BUFFER;
        const XrResult result = xrPollEvent(instance, &event);
        if (result == XR_EVENT_UNAVAILABLE) return states;
        EXPECT_EQ(result, XR_SUCCESS);
        if (result != XR_SUCCESS) return states;
        if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
            const auto& change = reinterpret_cast<const XrEventDataSessionStateChanged&>(event);
            EXPECT_EQ(change.session, session);
            states.push_back(change.state);
        } else {
            other_events.push_back(event);
        }
    }
}

XrSpace SimulatorClient::reference_space(XrReferenceSpaceType type, XrPosef pose) {
    const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, type, pose};
    XrSpace space = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateReferenceSpace(session, &info, &space), XR_SUCCESS);
    return space;
}

XrPath SimulatorClient::path(const std::string& text) {
    XrPath result = XR_NULL_PATH;
    EXPECT_EQ(xrStringToPath(instance, text.c_str(), &result), XR_SUCCESS);
    return result;
}

XrSpaceLocation SimulatorClient::locate(XrSpace space, XrSpace base, XrTime time, void* next) {
    XrSpaceLocation location{};
    location.type = XR_TYPE_SPACE_LOCATION;
    location.next = next;
    EXPECT_EQ(xrLocateSpace(space, base, time, &location), XR_SUCCESS);
    return location;
}

std::vector<XrView> SimulatorClient::locate_views(XrSpace base, XrTime time, XrViewConfigurationType type,
                                                  bool foveated, XrViewStateFlags* flags) {
    const XrViewLocateFoveatedRenderingVARJO follow{XR_TYPE_VIEW_LOCATE_FOVEATED_RENDERING_VARJO, nullptr,
                                                    XR_TRUE};
    const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, foveated ? &follow : nullptr, type, time, base};
    XrViewState state{XR_TYPE_VIEW_STATE, nullptr, 0};
    std::uint32_t count = 0;
    EXPECT_EQ(xrLocateViews(session, &info, &state, 0, &count, nullptr), XR_SUCCESS);
    std::vector<XrView> views(count, XrView{XR_TYPE_VIEW, nullptr, {}, {}});
    EXPECT_EQ(xrLocateViews(session, &info, &state, count, &count, views.data()), XR_SUCCESS);
    if (flags) *flags = state.viewStateFlags;
    return views;
}

Session make_session(std::uint64_t frames) {
    Session session;
    session.headset = "ci";
    session.rate_hz = 30.0;
    session.frames = frames;
    return session;
}

}  // namespace foveray::simulator_tests
