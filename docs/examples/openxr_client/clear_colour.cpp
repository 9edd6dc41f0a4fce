// A small OpenXR program with Vulkan: clears what each eye sees to a colour, for so many frames or until its
// session ends; with "quad" what focus displays show, too.
//   clear_colour [FRAMES [quad]]
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

// clang-format off
#include <vulkan/vulkan.h>
#define XR_USE_GRAPHICS_API_VULKAN
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
// clang-format on

namespace {

void check(XrResult result, const char* call) {
    if (XR_FAILED(result))
        throw std::runtime_error(std::string(call) + ": XrResult " + std::to_string(result));
}
void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string(call) + ": VkResult " + std::to_string(result));
}
#define CHECK(call) check(call, #call)

template <typename Function>
Function load(XrInstance instance, const char* name) {
    PFN_xrVoidFunction function = nullptr;
    check(xrGetInstanceProcAddr(instance, name, &function), name);
    return reinterpret_cast<Function>(function);
}

class ClearColour {
  public:
    explicit ClearColour(bool quad)
        : views_(quad ? XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO
                      : XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
        create_instance(quad);
        create_device();
        create_session();
        create_swapchains();
    }
    ~ClearColour() {
        if (device_) vkDeviceWaitIdle(device_);
        if (instance_) xrDestroyInstance(instance_);  // the session, its space and its swapchains with it
        if (device_) vkDestroyFence(device_, fence_, nullptr);
        if (device_) vkDestroyCommandPool(device_, pool_, nullptr);
        if (device_) vkDestroyDevice(device_, nullptr);
        if (vulkan_) vkDestroyInstance(vulkan_, nullptr);
    }
    ClearColour(const ClearColour&) = delete;
    ClearColour& operator=(const ClearColour&) = delete;

    void run(std::uint64_t frames) {
        std::uint64_t shown = 0;
        while (poll_events()) {
            if (!running_) continue;
            show_frame();
            if (++shown == frames) CHECK(xrRequestExitSession(session_));
        }
        std::printf("%llu frames\n", static_cast<unsigned long long>(shown));
    }

  private:
    struct Swapchain {
        XrSwapchain handle = XR_NULL_HANDLE;
        XrExtent2Di size{};
        std::vector<XrSwapchainImageVulkan2KHR> images;
    };

    void create_instance(bool quad) {
        const char* const extensions[] = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME,
                                          XR_VARJO_QUAD_VIEWS_EXTENSION_NAME};
        XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
        std::strcpy(info.applicationInfo.applicationName, "clear_colour");
        info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
        info.enabledExtensionCount = quad ? 2 : 1;
        info.enabledExtensionNames = extensions;
        CHECK(xrCreateInstance(&info, &instance_));
        const XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
        CHECK(xrGetSystem(instance_, &wanted, &system_));
    }

    /// The runtime chooses the GPU and adds what it needs itself.
    void create_device() {
        XrGraphicsRequirementsVulkan2KHR requirements{XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
        CHECK(load<PFN_xrGetVulkanGraphicsRequirements2KHR>(instance_, "xrGetVulkanGraphicsRequirements2KHR")(
            instance_, system_, &requirements));

        VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
        application.apiVersion = VK_API_VERSION_1_1;
        VkInstanceCreateInfo vulkan_info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
        vulkan_info.pApplicationInfo = &application;
        XrVulkanInstanceCreateInfoKHR instance_info{XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
        instance_info.systemId = system_;
        instance_info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
        instance_info.vulkanCreateInfo = &vulkan_info;
        VkResult result = VK_SUCCESS;
        CHECK(load<PFN_xrCreateVulkanInstanceKHR>(instance_, "xrCreateVulkanInstanceKHR")(
            instance_, &instance_info, &vulkan_, &result));
        check(result, "vkCreateInstance");

        XrVulkanGraphicsDeviceGetInfoKHR gpu_info{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR};
        gpu_info.systemId = system_;
        gpu_info.vulkanInstance = vulkan_;
        CHECK(load<PFN_xrGetVulkanGraphicsDevice2KHR>(instance_, "xrGetVulkanGraphicsDevice2KHR")(
            instance_, &gpu_info, &gpu_));
        std::uint32_t count = 0;
        vkGetPhysicalDeviceQueueFamilyProperties(gpu_, &count, nullptr);
        std::vector<VkQueueFamilyProperties> families(count);
        vkGetPhysicalDeviceQueueFamilyProperties(gpu_, &count, families.data());
        while (family_ < count && !(families[family_].queueFlags & VK_QUEUE_GRAPHICS_BIT)) ++family_;

        const float priority = 1.0f;
        VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
        queue.queueFamilyIndex = family_;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        VkDeviceCreateInfo device{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
        device.queueCreateInfoCount = 1;
        device.pQueueCreateInfos = &queue;
        XrVulkanDeviceCreateInfoKHR device_info{XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR};
        device_info.systemId = system_;
        device_info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
        device_info.vulkanPhysicalDevice = gpu_;
        device_info.vulkanCreateInfo = &device;
        CHECK(load<PFN_xrCreateVulkanDeviceKHR>(instance_, "xrCreateVulkanDeviceKHR")(instance_, &device_info,
                                                                                      &device_, &result));
        check(result, "vkCreateDevice");
        vkGetDeviceQueue(device_, family_, 0, &queue_);

        VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        pool.queueFamilyIndex = family_;
        CHECK(vkCreateCommandPool(device_, &pool, nullptr, &pool_));
        VkCommandBufferAllocateInfo buffers{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        buffers.commandPool = pool_;
        buffers.commandBufferCount = 1;
        CHECK(vkAllocateCommandBuffers(device_, &buffers, &commands_));
        const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
        CHECK(vkCreateFence(device_, &fence, nullptr, &fence_));
    }

    void create_session() {
        const XrGraphicsBindingVulkan2KHR binding{
            XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR, nullptr, vulkan_, gpu_, device_, family_, 0};
        const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding, 0, system_};
        CHECK(xrCreateSession(instance_, &info, &session_));
        const XrReferenceSpaceCreateInfo space{XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                               nullptr,
                                               XR_REFERENCE_SPACE_TYPE_LOCAL,
                                               {{0, 0, 0, 1}, {0, 0, 0}}};
        CHECK(xrCreateReferenceSpace(session_, &space, &space_));
    }

    void create_swapchains() {
        std::uint32_t count = 0;
        CHECK(xrEnumerateSwapchainFormats(session_, 0, &count, nullptr));
        std::vector<std::int64_t> formats(count);
        CHECK(xrEnumerateSwapchainFormats(session_, count, &count, formats.data()));

        CHECK(xrEnumerateViewConfigurationViews(instance_, system_, views_, 0, &count, nullptr));
        std::vector<XrViewConfigurationView> views(count, {XR_TYPE_VIEW_CONFIGURATION_VIEW});
        CHECK(xrEnumerateViewConfigurationViews(instance_, system_, views_, count, &count, views.data()));
        for (const XrViewConfigurationView& view : views) {
            XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
            info.usageFlags = XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT | XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
            info.format = formats.front();  // the runtime's favourite
            info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
            info.width = view.recommendedImageRectWidth;
            info.height = view.recommendedImageRectHeight;
            Swapchain swapchain;
            swapchain.size = {static_cast<std::int32_t>(info.width), static_cast<std::int32_t>(info.height)};
            CHECK(xrCreateSwapchain(session_, &info, &swapchain.handle));
            CHECK(xrEnumerateSwapchainImages(swapchain.handle, 0, &count, nullptr));
            swapchain.images.resize(count, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR});
            CHECK(xrEnumerateSwapchainImages(
                swapchain.handle, count, &count,
                reinterpret_cast<XrSwapchainImageBaseHeader*>(swapchain.images.data())));
            swapchains_.push_back(swapchain);
        }
    }

    /// False when the program shall end.
    bool poll_events() {
        while (true) {
            XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
            const XrResult result = xrPollEvent(instance_, &event);
            check(result, "xrPollEvent");
            if (result == XR_EVENT_UNAVAILABLE) return true;
            if (event.type != XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) continue;
            switch (reinterpret_cast<const XrEventDataSessionStateChanged&>(event).state) {
                case XR_SESSION_STATE_READY: {
                    const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, views_};
                    CHECK(xrBeginSession(session_, &info));
                    running_ = true;
                    break;
                }
                case XR_SESSION_STATE_STOPPING:
                    running_ = false;
                    CHECK(xrEndSession(session_));
                    break;
                case XR_SESSION_STATE_EXITING:
                case XR_SESSION_STATE_LOSS_PENDING:
                    return false;
                default:
                    break;
            }
        }
    }

    void show_frame() {
        XrFrameState frame{XR_TYPE_FRAME_STATE};
        CHECK(xrWaitFrame(session_, nullptr, &frame));
        CHECK(xrBeginFrame(session_, nullptr));

        std::vector<XrCompositionLayerProjectionView> views;
        if (frame.shouldRender) views = draw_views(frame.predictedDisplayTime);
        XrCompositionLayerProjection layer{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
        layer.space = space_;
        layer.viewCount = static_cast<std::uint32_t>(views.size());
        layer.views = views.data();
        const auto* const layers = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
        const XrFrameEndInfo end{XR_TYPE_FRAME_END_INFO,     nullptr,
                                 frame.predictedDisplayTime, XR_ENVIRONMENT_BLEND_MODE_OPAQUE,
                                 views.empty() ? 0u : 1u,    &layers};
        CHECK(xrEndFrame(session_, &end));
    }

    std::vector<XrCompositionLayerProjectionView> draw_views(XrTime time) {
        const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, views_, time, space_};
        XrViewState state{XR_TYPE_VIEW_STATE};
        std::uint32_t count = static_cast<std::uint32_t>(swapchains_.size());
        std::vector<XrView> eyes(count, {XR_TYPE_VIEW});
        CHECK(xrLocateViews(session_, &info, &state, count, &count, eyes.data()));

        std::vector<XrCompositionLayerProjectionView> views;
        for (std::size_t i = 0; i < swapchains_.size(); ++i) {
            const Swapchain& swapchain = swapchains_[i];
            std::uint32_t image = 0;
            CHECK(xrAcquireSwapchainImage(swapchain.handle, nullptr, &image));
            const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr,
                                                XR_INFINITE_DURATION};
            CHECK(xrWaitSwapchainImage(swapchain.handle, &wait));
            clear(swapchain.images[image].image, i % 2 == 0 ? VkClearColorValue{{0.8f, 0.1f, 0.1f, 1.0f}}
                                                            : VkClearColorValue{{0.1f, 0.1f, 0.8f, 1.0f}});
            CHECK(xrReleaseSwapchainImage(swapchain.handle, nullptr));
            XrCompositionLayerProjectionView view{XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
            view.pose = eyes[i].pose;
            view.fov = eyes[i].fov;
            view.subImage = {swapchain.handle, {{0, 0}, swapchain.size}, 0};
            views.push_back(view);
        }
        return views;
    }

    /// The runtime hands images out, and wants them back, as colour attachments.
    void clear(VkImage image, VkClearColorValue colour) {
        const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        const auto change_layout = [&](VkImageLayout from, VkImageLayout to) {
            VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
            barrier.srcAccessMask = barrier.dstAccessMask =
                VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
            barrier.oldLayout = from;
            barrier.newLayout = to;
            barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.image = image;
            barrier.subresourceRange = whole;
            vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                 VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
        };
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        CHECK(vkBeginCommandBuffer(commands_, &begin));
        change_layout(VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        vkCmdClearColorImage(commands_, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &colour, 1, &whole);
        change_layout(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        CHECK(vkEndCommandBuffer(commands_));
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands_;
        CHECK(vkQueueSubmit(queue_, 1, &submit, fence_));
        CHECK(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX));
        CHECK(vkResetFences(device_, 1, &fence_));
    }

    const XrViewConfigurationType views_;
    XrInstance instance_ = XR_NULL_HANDLE;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
    VkInstance vulkan_ = VK_NULL_HANDLE;
    VkPhysicalDevice gpu_ = VK_NULL_HANDLE;
    std::uint32_t family_ = 0;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    XrSession session_ = XR_NULL_HANDLE;
    XrSpace space_ = XR_NULL_HANDLE;
    std::vector<Swapchain> swapchains_;
    bool running_ = false;
};

}  // namespace

int main(int argc, char** argv) {
    try {
        ClearColour(argc > 2 && std::strcmp(argv[2], "quad") == 0)
            .run(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 0);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "clear_colour: %s\n", error.what());
        return 1;
    }
}
