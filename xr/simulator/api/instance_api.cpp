#include <cstdio>
#include <string>

#include "xr/simulator/api/functions.h"
#include "xr/simulator/api/names.h"
#include "xr/simulator/instance.h"

namespace foveray::simulator {
namespace {

constexpr char runtime_name[] = "foveray simulator";
constexpr XrVersion runtime_version = XR_MAKE_VERSION(0, 1, 0);

/// Texts of xrResultToString and xrStructureTypeToString have a fixed room, XR_MAX_RESULT_STRING_SIZE.
void name_value(char* buffer, const char* known, const char* unknown_prefix, int value) {
    if (known) {
        std::snprintf(buffer, XR_MAX_RESULT_STRING_SIZE, "%s", known);
    } else {
        std::snprintf(buffer, XR_MAX_RESULT_STRING_SIZE, "%s%d", unknown_prefix, value);
    }
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrGetInstanceProcAddr(XrInstance instance, const char* name,
                                                     PFN_xrVoidFunction* function) {
    return guarded([&] {
        verify(function != nullptr);
        *function = nullptr;
        verify(name != nullptr);
        const FunctionEntry* entry = find_function(name);
        if (instance == XR_NULL_HANDLE) {
            const std::string_view text = name;
            verify(text == "xrEnumerateInstanceExtensionProperties" ||
                       text == "xrEnumerateApiLayerProperties" || text == "xrCreateInstance" ||
                       text == "xrGetInstanceProcAddr",
                   XR_ERROR_HANDLE_INVALID);
        } else {
            const auto object = get<Instance>(instance);
            verify(entry && object->has(entry->feature), XR_ERROR_FUNCTION_UNSUPPORTED);
        }
        *function = entry->function;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrEnumerateApiLayerProperties(std::uint32_t capacity, std::uint32_t* count,
                                                             XrApiLayerProperties* properties) {
    return guarded([&] { enumerate(0, capacity, count, properties, [](auto&, std::uint32_t) {}); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrEnumerateInstanceExtensionProperties(const char* layer,
                                                                      std::uint32_t capacity,
                                                                      std::uint32_t* count,
                                                                      XrExtensionProperties* properties) {
    return guarded([&] {
        verify(layer == nullptr, XR_ERROR_API_LAYER_NOT_PRESENT);
        const auto extensions = supported_extensions();
        enumerate(static_cast<std::uint32_t>(extensions.size()), capacity, count, properties,
                  [&](XrExtensionProperties& target, std::uint32_t i) {
                      verify_structure(&target, XR_TYPE_EXTENSION_PROPERTIES);
                      copy_text(target.extensionName, extensions[i].name);
                      target.extensionVersion = extensions[i].version;
                  });
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrCreateInstance(const XrInstanceCreateInfo* info, XrInstance* instance) {
    return guarded([&] {
        verify_structure(info, XR_TYPE_INSTANCE_CREATE_INFO);
        verify(instance != nullptr && info->createFlags == 0);
        const XrApplicationInfo& application = info->applicationInfo;
        verify(XR_VERSION_MAJOR(application.apiVersion) == XR_VERSION_MAJOR(supported_api_version) &&
                   XR_VERSION_MINOR(application.apiVersion) <= XR_VERSION_MINOR(supported_api_version),
               XR_ERROR_API_VERSION_UNSUPPORTED);
        verify(!fixed_text(application.applicationName, XR_ERROR_NAME_INVALID).empty(),
               XR_ERROR_NAME_INVALID);
        fixed_text(application.engineName, XR_ERROR_NAME_INVALID);
        verify(info->enabledApiLayerCount == 0, XR_ERROR_API_LAYER_NOT_PRESENT);
        verify(info->enabledExtensionCount == 0 || info->enabledExtensionNames != nullptr);
        const auto supported = supported_extensions();
        std::set<std::string, std::less<>> features;
        for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
            const char* const name = info->enabledExtensionNames[i];
            verify(name != nullptr);
            verify(std::ranges::find(supported, name, &Extension::name) != supported.end(),
                   XR_ERROR_EXTENSION_NOT_PRESENT);
            features.emplace(name);
        }
        if (XR_VERSION_MINOR(application.apiVersion) >= 1) {
            features.emplace(openxr_1_1);
            features.insert(std::begin(promoted_to_1_1), std::end(promoted_to_1_1));
        }
        verify(!features.contains(XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME) ||
                   features.contains(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME),
               has_openxr_1_1 ? XR_ERROR_EXTENSION_DEPENDENCY_NOT_ENABLED : XR_ERROR_VALIDATION_FAILURE);
        *instance = add_object(std::make_shared<Instance>(std::move(features)), 0);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrDestroyInstance(XrInstance instance) {
    return guarded([&] { destroy<Instance>(instance); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetInstanceProperties(XrInstance instance,
                                                       XrInstanceProperties* properties) {
    return guarded([&] {
        get<Instance>(instance);
        verify_structure(properties, XR_TYPE_INSTANCE_PROPERTIES);
        properties->runtimeVersion = runtime_version;
        copy_text(properties->runtimeName, runtime_name);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrPollEvent(XrInstance instance, XrEventDataBuffer* event) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify_structure(event, XR_TYPE_EVENT_DATA_BUFFER);
        return object->events().pop(*event) ? XR_SUCCESS : XR_EVENT_UNAVAILABLE;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrResultToString(XrInstance instance, XrResult value, char* buffer) {
    return guarded([&] {
        get<Instance>(instance);
        verify(buffer != nullptr);
        name_value(buffer, name_of(value), value < 0 ? "XR_UNKNOWN_FAILURE_" : "XR_UNKNOWN_SUCCESS_", value);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrStructureTypeToString(XrInstance instance, XrStructureType value,
                                                       char* buffer) {
    return guarded([&] {
        get<Instance>(instance);
        verify(buffer != nullptr);
        name_value(buffer, name_of(value), "XR_UNKNOWN_STRUCTURE_TYPE_", value);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrStringToPath(XrInstance instance, const char* text, XrPath* path) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify(text != nullptr && path != nullptr);
        *path = object->paths().atom(text);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrPathToString(XrInstance instance, XrPath path, std::uint32_t capacity,
                                              std::uint32_t* count, char* buffer) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        enumerate_text(object->paths().text(path), capacity, count, buffer);
    });
}

}  // namespace foveray::simulator
