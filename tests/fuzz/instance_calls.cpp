#include "tests/fuzz/caller.h"

namespace foveray::fuzz {
namespace {

constexpr std::size_t most_instances = 4;

void create_instance(Caller& c) {
    if (c.handles.all<XrInstance>().size() >= most_instances) return;
    auto& info = c.structure<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
    c.write_name(info.applicationInfo.applicationName);
    info.applicationInfo.apiVersion = c.random.chance(45)   ? XR_MAKE_VERSION(1, 0, 0)
                                      : c.random.chance(90) ? XR_CURRENT_API_VERSION
                                                            : c.random.bits();
    info.createFlags = c.random.chance(98) ? 0 : c.random.bits();
    if (c.random.chance(90)) {
        info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
        info.enabledExtensionNames = extensions.data();
    } else {
        const char** names = c.array<const char*>(3);
        info.enabledExtensionCount = static_cast<std::uint32_t>(c.random.below(4));
        for (std::size_t i = 0; i < 3; ++i)
            names[i] = c.random.chance(80)   ? c.random.pick(extensions)
                       : c.random.chance(50) ? "XR_no"
                                             : nullptr;
        info.enabledExtensionNames = c.maybe(*names);
    }
    XrInstance instance = XR_NULL_HANDLE;
    if (c.call.xrCreateInstance(c.maybe(info), c.maybe(instance)) != XR_SUCCESS) return;
    c.handles.add(instance);
    // Atoms in one order, so that they mean the same everywhere.
    for (const std::string& text : path_texts) {
        XrPath path = XR_NULL_PATH;
        c.call.xrStringToPath(instance, text.c_str(), &path);
    }
}

void destroy_instance(Caller& c) {
    if (c.random.chance(70)) return;  // all that it has goes with it
    const auto instance = c.handle<XrInstance>();
    if (c.call.xrDestroyInstance(instance) == XR_SUCCESS) c.handles.remember_dead(instance);
}

void enumerate_extensions(Caller& c) {
    const std::uint32_t capacity = c.capacity();
    auto* properties = c.array<XrExtensionProperties>(64);
    for (std::size_t i = 0; i < 64; ++i)
        if (c.random.chance(99)) properties[i].type = XR_TYPE_EXTENSION_PROPERTIES;
    c.call.xrEnumerateInstanceExtensionProperties(c.random.chance(90) ? nullptr : "layer", capacity,
                                                  c.out<std::uint32_t>(), c.maybe(*properties));
    c.call.xrEnumerateApiLayerProperties(capacity, c.out<std::uint32_t>(), c.out<XrApiLayerProperties>());
}

void get_function(Caller& c) {
    const char* name = c.random.pick({"xrCreateInstance", "xrPollEvent", "xrLocateHandJointsEXT", "xr", ""});
    c.call.xrGetInstanceProcAddr(c.handle<XrInstance>(), c.maybe(*name), c.out<PFN_xrVoidFunction>());
}

void get_instance_properties(Caller& c) {
    auto& properties = c.structure<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
    c.call.xrGetInstanceProperties(c.handle<XrInstance>(), c.maybe(properties));
}

void poll_event(Caller& c) {
    auto& event = c.structure<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    c.call.xrPollEvent(c.handle<XrInstance>(), c.maybe(event));
}

void name_values(Caller& c) {
    char* text = c.array<char>(XR_MAX_RESULT_STRING_SIZE);
    c.call.xrResultToString(c.handle<XrInstance>(), static_cast<XrResult>(c.random.bits()), c.maybe(*text));
    c.call.xrStructureTypeToString(c.handle<XrInstance>(), static_cast<XrStructureType>(c.random.below(100)),
                                   c.maybe(*text));
}

void convert_paths(Caller& c) {
    const std::string text = c.random.chance(50) ? c.random.pick(path_texts) : "/" + c.name();
    c.call.xrStringToPath(c.handle<XrInstance>(), text.c_str(), c.out<XrPath>());
    const std::uint32_t capacity = c.capacity();
    c.call.xrPathToString(c.handle<XrInstance>(), c.path(), capacity, c.out<std::uint32_t>(),
                          c.maybe(*c.array<char>(64)));
}

void get_system(Caller& c) {
    auto& info = c.structure<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
    info.formFactor = c.enumerant<XrFormFactor>(3);
    c.call.xrGetSystem(c.handle<XrInstance>(), c.maybe(info), c.out<XrSystemId>());
    auto& properties = c.structure<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
    auto& hands = *c.array<XrSystemHandTrackingPropertiesEXT>(1);
    hands.type = XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT;
    auto& gaze = *c.array<XrSystemEyeGazeInteractionPropertiesEXT>(1);
    gaze.type = XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT;
    hands.next = &gaze;
    if (c.random.chance(30)) properties.next = &hands;
    c.call.xrGetSystemProperties(c.handle<XrInstance>(), c.system(), c.maybe(properties));
}

void enumerate_views(Caller& c) {
    const auto instance = c.handle<XrInstance>();
    const std::uint32_t capacity = c.capacity();
    c.call.xrEnumerateEnvironmentBlendModes(instance, c.system(), c.view_configuration(), capacity,
                                            c.out<std::uint32_t>(),
                                            c.maybe(*c.array<XrEnvironmentBlendMode>(64)));
    c.call.xrEnumerateViewConfigurations(instance, c.system(), capacity, c.out<std::uint32_t>(),
                                         c.maybe(*c.array<XrViewConfigurationType>(64)));
    auto& properties = c.structure<XrViewConfigurationProperties>(XR_TYPE_VIEW_CONFIGURATION_PROPERTIES);
    c.call.xrGetViewConfigurationProperties(instance, c.system(), c.view_configuration(),
                                            c.maybe(properties));
    auto* views = c.array<XrViewConfigurationView>(64);
    for (std::size_t i = 0; i < 64; ++i)
        if (c.random.chance(99)) views[i].type = XR_TYPE_VIEW_CONFIGURATION_VIEW;
    c.call.xrEnumerateViewConfigurationViews(instance, c.system(), c.view_configuration(), capacity,
                                             c.out<std::uint32_t>(), c.maybe(*views));
}

void vulkan_questions(Caller& c) {
    const auto instance = c.handle<XrInstance>();
    const std::uint32_t capacity = c.capacity();
    char* text = c.array<char>(64);
    c.call.xrGetVulkanInstanceExtensionsKHR(instance, c.system(), capacity, c.out<std::uint32_t>(),
                                            c.maybe(*text));
    c.call.xrGetVulkanDeviceExtensionsKHR(instance, c.system(), capacity, c.out<std::uint32_t>(),
                                          c.maybe(*text));
    c.call.xrGetVulkanGraphicsDeviceKHR(instance, c.system(), VK_NULL_HANDLE, c.out<VkPhysicalDevice>());
    auto& needs = c.structure<XrGraphicsRequirementsVulkanKHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN_KHR);
    c.call.xrGetVulkanGraphicsRequirementsKHR(instance, c.system(), c.maybe(needs));
    c.call.xrGetVulkanGraphicsRequirements2KHR(instance, c.system(), c.maybe(needs));
}

}  // namespace

std::vector<Call> instance_calls() {
    return {{"xrCreateInstance", 10, create_instance},
            {"xrDestroyInstance", 1, destroy_instance},
            {"xrEnumerateInstanceExtensionProperties", 2, enumerate_extensions},
            {"xrGetInstanceProcAddr", 2, get_function},
            {"xrGetInstanceProperties", 2, get_instance_properties},
            {"xrPollEvent", 30, poll_event},
            {"xrResultToString", 3, name_values},
            {"xrPathToString", 10, convert_paths},
            {"xrGetSystem", 5, get_system},
            {"xrEnumerateViewConfigurationViews", 5, enumerate_views},
            {"xrGetVulkanGraphicsRequirementsKHR", 3, vulkan_questions}};
}

}  // namespace foveray::fuzz
