#include "xr/simulator/api/functions.h"
#include "xr/simulator/debug_utils.h"
#include "xr/simulator/session.h"

namespace foveray::simulator {
namespace {

constexpr XrDebugUtilsMessageSeverityFlagsEXT all_severities =
    XR_DEBUG_UTILS_MESSAGE_SEVERITY_VERBOSE_BIT_EXT | XR_DEBUG_UTILS_MESSAGE_SEVERITY_INFO_BIT_EXT |
    XR_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
constexpr XrDebugUtilsMessageTypeFlagsEXT all_types =
    XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | XR_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
    XR_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT | XR_DEBUG_UTILS_MESSAGE_TYPE_CONFORMANCE_BIT_EXT;

void verify_flags(XrFlags64 flags, XrFlags64 known) { verify(flags != 0 && (flags & ~known) == 0); }

std::string read_label(const XrDebugUtilsLabelEXT* label) {
    verify_structure(label, XR_TYPE_DEBUG_UTILS_LABEL_EXT);
    verify(label->labelName != nullptr);
    return label->labelName;
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrSetDebugUtilsObjectNameEXT(XrInstance instance,
                                                            const XrDebugUtilsObjectNameInfoEXT* info) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify_structure(info, XR_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
        verify(info->objectType != XR_OBJECT_TYPE_UNKNOWN || info->objectHandle != 0);
        verify(info->objectName != nullptr);
        object->debug().set_name(info->objectType, info->objectHandle, info->objectName);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrCreateDebugUtilsMessengerEXT(XrInstance instance,
                                                              const XrDebugUtilsMessengerCreateInfoEXT* info,
                                                              XrDebugUtilsMessengerEXT* messenger) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify_structure(info, XR_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
        verify(messenger != nullptr && info->userCallback != nullptr);
        verify_flags(info->messageSeverities, all_severities);
        verify_flags(info->messageTypes, all_types);
        const auto made = std::make_shared<DebugMessenger>(object, *info);
        *messenger = add_object(made, object->id());
        object->debug().add(made);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrDestroyDebugUtilsMessengerEXT(XrDebugUtilsMessengerEXT messenger) {
    return guarded([&] { destroy<DebugMessenger>(messenger); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSubmitDebugUtilsMessageEXT(
    XrInstance instance, XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
    const XrDebugUtilsMessengerCallbackDataEXT* data) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify_flags(severity, all_severities);
        verify_flags(types, all_types);
        verify_structure(data, XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT);
        verify(data->message != nullptr);
        verify(data->objectCount == 0 || data->objects != nullptr);
        verify(data->sessionLabelCount == 0 || data->sessionLabels != nullptr);
        object->debug().submit(severity, types, *data);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSessionBeginDebugUtilsLabelRegionEXT(XrSession session,
                                                                      const XrDebugUtilsLabelEXT* label) {
    return guarded([&] { get<Session>(session)->labels().begin_region(read_label(label)); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSessionEndDebugUtilsLabelRegionEXT(XrSession session) {
    return guarded([&] { get<Session>(session)->labels().end_region(); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSessionInsertDebugUtilsLabelEXT(XrSession session,
                                                                 const XrDebugUtilsLabelEXT* label) {
    return guarded([&] { get<Session>(session)->labels().insert(read_label(label)); });
}

}  // namespace foveray::simulator
