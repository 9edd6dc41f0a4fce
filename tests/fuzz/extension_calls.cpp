#include "tests/fuzz/caller.h"

namespace foveray::fuzz {
namespace {

void get_visibility_mask(Caller& c) {
    auto& mask = c.structure<XrVisibilityMaskKHR>(XR_TYPE_VISIBILITY_MASK_KHR);
    mask.vertexCapacityInput = c.capacity();
    mask.vertices = c.maybe(*c.array<XrVector2f>(64));
    mask.indexCapacityInput = c.capacity();
    mask.indices = c.maybe(*c.array<std::uint32_t>(64));
    c.call.xrGetVisibilityMaskKHR(c.handle<XrSession>(), c.view_configuration(), c.small_count(),
                                  c.enumerant<XrVisibilityMaskTypeKHR>(5), c.maybe(mask));
}

XRAPI_ATTR XrBool32 XRAPI_CALL read_message(XrDebugUtilsMessageSeverityFlagsEXT,
                                            XrDebugUtilsMessageTypeFlagsEXT,
                                            const XrDebugUtilsMessengerCallbackDataEXT* data, void*) {
    std::size_t read = std::strlen(data->message);
    for (std::uint32_t i = 0; i < data->objectCount; ++i)
        read += data->objects[i].objectName ? std::strlen(data->objects[i].objectName) : 0;
    for (std::uint32_t i = 0; i < data->sessionLabelCount; ++i)
        read += std::strlen(data->sessionLabels[i].labelName);
    return read == 0;
}

void create_messenger(Caller& c) {
    auto& info =
        c.structure<XrDebugUtilsMessengerCreateInfoEXT>(XR_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverities = c.flags(0x1111);
    info.messageTypes = c.flags(0xf);
    info.userCallback = c.random.chance(97) ? read_message : nullptr;
    XrDebugUtilsMessengerEXT messenger = XR_NULL_HANDLE;
    const XrResult result =
        c.call.xrCreateDebugUtilsMessengerEXT(c.handle<XrInstance>(), c.maybe(info), c.maybe(messenger));
    if (result == XR_SUCCESS) c.handles.add(messenger);
}

void destroy_messenger(Caller& c) {
    const auto messenger = c.handle<XrDebugUtilsMessengerEXT>();
    if (c.call.xrDestroyDebugUtilsMessengerEXT(messenger) == XR_SUCCESS) c.handles.remember_dead(messenger);
}

XrDebugUtilsObjectNameInfoEXT object_name(Caller& c) {
    const bool is_session = c.random.chance(60);
    return {XR_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr,
            is_session ? XR_OBJECT_TYPE_SESSION : c.enumerant<XrObjectType>(7),
            reinterpret_cast<std::uint64_t>(c.handle<XrSession>()), c.random.chance(80) ? "name" : nullptr};
}

void submit_message(Caller& c) {
    auto& data =
        c.structure<XrDebugUtilsMessengerCallbackDataEXT>(XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT);
    data.message = c.random.chance(97) ? "message" : nullptr;
    auto* objects = c.array<XrDebugUtilsObjectNameInfoEXT>(3);
    for (int i = 0; i < 3; ++i) objects[i] = object_name(c);
    data.objectCount = c.small_count();
    data.objects = c.maybe(*objects);
    c.call.xrSubmitDebugUtilsMessageEXT(c.handle<XrInstance>(), c.flags(0x1111), c.flags(0xf), c.maybe(data));
    auto& named = *c.array<XrDebugUtilsObjectNameInfoEXT>(1);
    named = object_name(c);
    c.call.xrSetDebugUtilsObjectNameEXT(c.handle<XrInstance>(), c.maybe(named));
}

void label_session(Caller& c) {
    auto& label = c.structure<XrDebugUtilsLabelEXT>(XR_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.labelName = c.random.chance(97) ? "label" : nullptr;
    const auto session = c.handle<XrSession>();
    if (c.random.chance(33)) c.call.xrSessionBeginDebugUtilsLabelRegionEXT(session, c.maybe(label));
    if (c.random.chance(33)) c.call.xrSessionInsertDebugUtilsLabelEXT(session, c.maybe(label));
    if (c.random.chance(50)) c.call.xrSessionEndDebugUtilsLabelRegionEXT(session);
}

void create_hand_tracker(Caller& c) {
    auto& info = c.structure<XrHandTrackerCreateInfoEXT>(XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT);
    info.hand = c.enumerant<XrHandEXT>(4);
    info.handJointSet =
        c.random.chance(95) ? XR_HAND_JOINT_SET_DEFAULT_EXT : c.enumerant<XrHandJointSetEXT>(3);
    XrHandTrackerEXT tracker = XR_NULL_HANDLE;
    if (c.call.xrCreateHandTrackerEXT(c.handle<XrSession>(), c.maybe(info), c.maybe(tracker)) == XR_SUCCESS)
        c.handles.add(tracker);
}

void destroy_hand_tracker(Caller& c) {
    const auto tracker = c.handle<XrHandTrackerEXT>();
    if (c.call.xrDestroyHandTrackerEXT(tracker) == XR_SUCCESS) c.handles.remember_dead(tracker);
}

void locate_hand(Caller& c) {
    auto& info = c.structure<XrHandJointsLocateInfoEXT>(XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT);
    info.baseSpace = c.handle<XrSpace>();
    info.time = c.time();
    const auto count = [&] { return c.random.chance(95) ? XR_HAND_JOINT_COUNT_EXT : c.small_count(); };
    auto& locations = c.structure<XrHandJointLocationsEXT>(XR_TYPE_HAND_JOINT_LOCATIONS_EXT);
    locations.jointCount = count();
    locations.jointLocations = c.maybe(*c.array<XrHandJointLocationEXT>(XR_HAND_JOINT_COUNT_EXT));
    auto& velocities = *c.array<XrHandJointVelocitiesEXT>(1);
    velocities.type = XR_TYPE_HAND_JOINT_VELOCITIES_EXT;
    velocities.jointCount = count();
    velocities.jointVelocities = c.maybe(*c.array<XrHandJointVelocityEXT>(XR_HAND_JOINT_COUNT_EXT));
    if (c.random.chance(50)) locations.next = &velocities;
    c.call.xrLocateHandJointsEXT(c.handle<XrHandTrackerEXT>(), c.maybe(info), c.maybe(locations));
}

void set_inputs(Caller& c) {
    const auto session = c.handle<XrSession>();
    switch (c.random.below(5)) {
        case 0:
            c.call.xrSetInputDeviceActiveEXT(session, c.path(), c.path(), c.small_count());
            break;
        case 1:
            c.call.xrSetInputDeviceStateBoolEXT(session, c.path(), c.path(), c.small_count());
            break;
        case 2:
            c.call.xrSetInputDeviceStateFloatEXT(session, c.path(), c.path(), c.random.number());
            break;
        case 3:
            c.call.xrSetInputDeviceStateVector2fEXT(session, c.path(), c.path(),
                                                    {c.random.number(), c.random.number()});
            break;
        default:
            c.call.xrSetInputDeviceLocationEXT(session, c.path(), c.path(), c.handle<XrSpace>(), c.pose());
    }
}

}  // namespace

std::vector<Call> extension_calls() {
    return {{"xrGetVisibilityMaskKHR", 5, get_visibility_mask},
            {"xrCreateDebugUtilsMessengerEXT", 2, create_messenger},
            {"xrDestroyDebugUtilsMessengerEXT", 2, destroy_messenger},
            {"xrSubmitDebugUtilsMessageEXT", 5, submit_message},
            {"xrSessionBeginDebugUtilsLabelRegionEXT", 5, label_session},
            {"xrCreateHandTrackerEXT", 5, create_hand_tracker},
            {"xrDestroyHandTrackerEXT", 2, destroy_hand_tracker},
            {"xrLocateHandJointsEXT", 15, locate_hand},
            {"xrSetInputDeviceActiveEXT", 10, set_inputs}};
}

}  // namespace foveray::fuzz
