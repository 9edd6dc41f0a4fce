#include "render/gpu/device.h"

#include <algorithm>
#include <cstring>
#include <set>

#include <vk_mem_alloc.h>

#include "base/error.h"
#include "base/log.h"

namespace foveray::gpu {
namespace {

constexpr std::array required_extensions = {
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
    VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
};
constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

using Features = vk::StructureChain<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features,
                                    vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features,
                                    vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                                    vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>;

struct NeededFeature {
    const char* name;
    vk::Bool32& (*get)(Features&);
};

#define FOVERAY_FEATURE(Struct, member)                                             \
    NeededFeature {                                                                 \
#member, [](Features & f) -> vk::Bool32& { return f.get<Struct>().member; } \
    }
constexpr std::array needed_features = {
    NeededFeature{
        "shaderInt64",
        [](Features& f) -> vk::Bool32& { return f.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64; }},
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, bufferDeviceAddress),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, scalarBlockLayout),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, descriptorIndexing),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, runtimeDescriptorArray),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, descriptorBindingPartiallyBound),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, descriptorBindingSampledImageUpdateAfterBind),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, descriptorBindingUpdateUnusedWhilePending),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, shaderSampledImageArrayNonUniformIndexing),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, timelineSemaphore),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan12Features, hostQueryReset),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan13Features, synchronization2),
    FOVERAY_FEATURE(vk::PhysicalDeviceVulkan13Features, maintenance4),
    FOVERAY_FEATURE(vk::PhysicalDeviceAccelerationStructureFeaturesKHR, accelerationStructure),
    FOVERAY_FEATURE(vk::PhysicalDeviceRayTracingPipelineFeaturesKHR, rayTracingPipeline),
    FOVERAY_FEATURE(vk::PhysicalDeviceRayTracingPipelineFeaturesKHR, rayTracingPipelineTraceRaysIndirect),
};
#undef FOVERAY_FEATURE

Features query_features(const vk::raii::PhysicalDevice& physical) {
    Features features;
    auto& head = features.get<vk::PhysicalDeviceFeatures2>();
    physical.getDispatcher()->vkGetPhysicalDeviceFeatures2(
        *physical, reinterpret_cast<VkPhysicalDeviceFeatures2*>(&head));
    return features;
}

std::optional<std::uint32_t> find_queue_family(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    const auto needed = vk::QueueFlagBits::eCompute | vk::QueueFlagBits::eGraphics;
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        if ((families[i].queueFlags & needed) == needed && families[i].timestampValidBits >= 36) return i;
    }
    return std::nullopt;
}

std::vector<std::string> missing_extensions(const vk::raii::PhysicalDevice& physical) {
    std::set<std::string> offered;
    for (const auto& e : physical.enumerateDeviceExtensionProperties()) offered.insert(e.extensionName);
    std::vector<std::string> missing;
    for (const char* e : required_extensions) {
        if (!offered.contains(e)) missing.emplace_back(e);
    }
    return missing;
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<Device::Messages*>(user)->add(data->pMessage);
    log::error("Vulkan validation: {}", data->pMessage);
    return VK_FALSE;
}

bool is_layer_present(const vk::raii::Context& context, const char* name) {
    const auto layers = context.enumerateInstanceLayerProperties();
    return std::any_of(layers.begin(), layers.end(),
                       [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool is_extension_present(const vk::raii::Context& context, const char* name) {
    const auto extensions = context.enumerateInstanceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(), [&](const auto& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

int preference(const vk::raii::PhysicalDevice& physical) {
    switch (physical.getProperties().deviceType) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return 0;
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return 1;
        case vk::PhysicalDeviceType::eVirtualGpu:
            return 2;
        default:
            return 3;
    }
}

constexpr const char* remedy_no_device =
    "install a driver with ray-tracing pipelines: the GPU maker's, or mesa-vulkan-drivers 25 "
    "(on Debian 12 from bookworm-backports) for the CPU; `foveray doctor` tells more";

std::string joined(const std::vector<std::string>& parts, const char* separator) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
    return text;
}

vk::raii::PhysicalDevice choose_physical_device(const vk::raii::Instance& instance,
                                                std::optional<std::uint32_t> index) {
    auto all = instance.enumeratePhysicalDevices();
    if (all.empty()) throw_missing("Vulkan", "no device found", remedy_no_device);
    if (index) {
        if (*index >= all.size()) {
            throw_bad_input("--gpu " + std::to_string(*index),
                            "there are only " + std::to_string(all.size()) + " Vulkan devices",
                            "`foveray doctor` lists them");
        }
        std::swap(all[0], all[*index]);
        all.erase(all.begin() + 1, all.end());
    } else {
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return preference(a) < preference(b); });
    }
    std::vector<std::string> refused;
    for (auto& physical : all) {
        const auto why = refusals(physical);
        if (why.empty()) return std::move(physical);
        refused.push_back(std::string(physical.getProperties().deviceName) + " lacks " + joined(why, ", "));
    }
    throw_missing("Vulkan", joined(refused, "; "), remedy_no_device);
}

}  // namespace

std::vector<std::string> refusals(const vk::raii::PhysicalDevice& physical) {
    if (physical.getProperties().apiVersion < VK_API_VERSION_1_3) return {"Vulkan 1.3"};
    std::vector<std::string> missing = missing_extensions(physical);
    if (!missing.empty()) return missing;
    Features features = query_features(physical);
    for (const NeededFeature& needed : needed_features) {
        if (!needed.get(features)) missing.emplace_back(needed.name);
    }
    if (!find_queue_family(physical)) missing.emplace_back("a graphics and compute queue with timestamps");
    return missing;
}

Device::Device(const DeviceOptions& options, const DeviceSource& source)
    : messages_(std::make_unique<Messages>()) {
    const vk::ApplicationInfo application("foveray", 1, "foveray", 1, VK_API_VERSION_1_3);
    std::vector<const char*> layers, extensions;
    for (const auto& e : options.instance_extensions) extensions.push_back(e.c_str());
    debug_utils_ = is_extension_present(context_, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    bool validation = options.validation;
    if (validation && !is_layer_present(context_, validation_layer)) {
        throw_missing("Vulkan", "the validation layer is not installed", "install vulkan-validationlayers");
    }
    if (validation) {
        layers.push_back(validation_layer);
        debug_utils_ = true;  // the layer brings it
    }
    if (debug_utils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    using Enable = vk::ValidationFeatureEnableEXT;
    const std::array checks = {Enable::eSynchronizationValidation};
    vk::ValidationFeaturesEXT validation_features(checks);
    // As C's struct, because the callback's type differs between versions of Vulkan-Hpp.
    const vk::DebugUtilsMessengerCreateInfoEXT messenger_info(VkDebugUtilsMessengerCreateInfoEXT{
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT, nullptr, 0,
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT,
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT, on_message, messages_.get()});
    vk::InstanceCreateInfo instance_info({}, &application, layers, extensions);
    if (validation) {
        instance_info.pNext = &validation_features;
        validation_features.pNext = &messenger_info;  // for what is said while the instance is made and freed
    }

    const auto get_proc = context_.getDispatcher()->vkGetInstanceProcAddr;
    if (source.create_instance) {
        VkInstance handle = VK_NULL_HANDLE;
        const auto result = static_cast<vk::Result>(source.create_instance(
            get_proc, static_cast<const VkInstanceCreateInfo&>(instance_info), &handle));
        if (result != vk::Result::eSuccess)
            throw_missing("OpenXR", "cannot make a Vulkan instance", remedy_no_device);
        instance_ = vk::raii::Instance(context_, handle);
    } else {
        try {
            instance_ = vk::raii::Instance(context_, instance_info);
        } catch (const vk::SystemError& e) {
            throw_missing("Vulkan", std::string("cannot make an instance: ") + e.what(), remedy_no_device);
        }
    }
    if (validation) messenger_ = vk::raii::DebugUtilsMessengerEXT(instance_, messenger_info);

    if (source.choose_physical_device) {
        physical_ = vk::raii::PhysicalDevice(instance_, source.choose_physical_device(*instance_));
        if (const auto why = refusals(physical_); !why.empty()) {
            throw_missing(std::string(physical_.getProperties().deviceName),
                          "the headset's graphics device lacks " + joined(why, ", "), remedy_no_device);
        }
    } else {
        physical_ = choose_physical_device(instance_, options.index);
    }
    queue_family_ = *find_queue_family(physical_);

    Features features;
    for (const NeededFeature& needed : needed_features) needed.get(features) = VK_TRUE;
    std::vector<const char*> device_extensions(required_extensions.begin(), required_extensions.end());
    if (options.presentation) device_extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue_info({}, queue_family_, 1, &priority);
    const vk::DeviceCreateInfo device_info({}, queue_info, {}, device_extensions, nullptr,
                                           &features.get<vk::PhysicalDeviceFeatures2>());
    if (source.create_device) {
        VkDevice handle = VK_NULL_HANDLE;
        const auto result = static_cast<vk::Result>(source.create_device(
            get_proc, *physical_, static_cast<const VkDeviceCreateInfo&>(device_info), &handle));
        if (result != vk::Result::eSuccess)
            throw_missing("OpenXR", "cannot make a Vulkan device", remedy_no_device);
        device_ = vk::raii::Device(physical_, handle);
    } else {
        device_ = vk::raii::Device(physical_, device_info);
    }
    queue_ = device_.getQueue(queue_family_, 0);

    VmaVulkanFunctions functions{};
    functions.vkGetInstanceProcAddr = get_proc;
    functions.vkGetDeviceProcAddr = instance_.getDispatcher()->vkGetDeviceProcAddr;
    VmaAllocatorCreateInfo allocator_info{};
    allocator_info.flags = VMA_ALLOCATOR_CREATE_BUFFER_DEVICE_ADDRESS_BIT;
    allocator_info.physicalDevice = *physical_;
    allocator_info.device = *device_;
    allocator_info.instance = *instance_;
    allocator_info.vulkanApiVersion = VK_API_VERSION_1_3;
    allocator_info.pVulkanFunctions = &functions;
    if (vmaCreateAllocator(&allocator_info, &allocator_) != VK_SUCCESS) {
        throw_missing("Vulkan", "no memory allocator", remedy_no_device);
    }

    const auto properties =
        physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties,
                                 vk::PhysicalDeviceRayTracingPipelinePropertiesKHR,
                                 vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
    const auto& core = properties.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = properties.get<vk::PhysicalDeviceDriverProperties>();
    const auto& rt = properties.get<vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>();
    const auto& as = properties.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
    limits_ = {rt.shaderGroupHandleSize,    rt.shaderGroupHandleAlignment,
               rt.shaderGroupBaseAlignment, rt.maxShaderGroupStride,
               rt.maxRayRecursionDepth,     as.minAccelerationStructureScratchOffsetAlignment,
               as.maxInstanceCount};
    timestamp_period_ns_ = core.limits.timestampPeriod;
    timestamp_valid_bits_ = physical_.getQueueFamilyProperties()[queue_family_].timestampValidBits;
    name_ = std::string(core.deviceName);
    driver_ = std::string(driver.driverName) + " " + std::string(driver.driverInfo);
}

void Device::submit(const vk::SubmitInfo2& info, vk::Fence fence) const {
    const auto lock = lock_queue();
    queue_.submit2(info, fence);
}

void Device::Messages::add(const char* message) {
    const std::lock_guard lock(mutex_);
    messages_.emplace_back(message);
}

std::vector<std::string> Device::Messages::all() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

Device::~Device() {
    if (*device_) device_.waitIdle();
    if (allocator_) vmaDestroyAllocator(allocator_);
}

void Device::set_name(vk::ObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!debug_utils_) return;
    device_.setDebugUtilsObjectNameEXT({type, handle, name.c_str()});
}

}  // namespace foveray::gpu
