#include "tests/fuzz/caller.h"

namespace foveray::fuzz {
namespace {

void create_session(Caller& c) {
    auto& info = c.structure<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
    info.systemId = c.system();
    info.createFlags = c.random.chance(98) ? 0 : c.random.bits();
    if (c.random.chance(50)) {
        auto& binding = *c.array<XrGraphicsBindingVulkanKHR>(1);
        binding.type = XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR;  // otherwise empty
        if (c.vulkan && c.random.chance(95)) binding = *c.vulkan;
        info.next = &binding;
    }
    XrSession session = XR_NULL_HANDLE;
    if (c.call.xrCreateSession(c.handle<XrInstance>(), c.maybe(info), c.maybe(session)) == XR_SUCCESS)
        c.handles.add(session);
}

void destroy_session(Caller& c) {
    const auto session = c.handle<XrSession>();
    if (c.call.xrDestroySession(session) == XR_SUCCESS) c.handles.remember_dead(session);
}

void begin_session(Caller& c) {
    auto& info = c.structure<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
    info.primaryViewConfigurationType = c.view_configuration();
    c.call.xrBeginSession(c.handle<XrSession>(), c.maybe(info));
}

void end_session(Caller& c) { c.call.xrEndSession(c.handle<XrSession>()); }
void request_exit(Caller& c) { c.call.xrRequestExitSession(c.handle<XrSession>()); }

void wait_frame(Caller& c) {
    auto& info = c.structure<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
    auto& state = c.structure<XrFrameState>(XR_TYPE_FRAME_STATE);
    const XrResult result =
        c.call.xrWaitFrame(c.handle<XrSession>(), c.random.chance(50) ? &info : nullptr, c.maybe(state));
    if (result == XR_SUCCESS) c.last_time = state.predictedDisplayTime;
}

void begin_frame(Caller& c) {
    auto& info = c.structure<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
    c.call.xrBeginFrame(c.handle<XrSession>(), c.random.chance(50) ? &info : nullptr);
}

XrSwapchainSubImage sub_image(Caller& c) {
    const auto edge = [&] { return static_cast<std::int32_t>(c.random.below(140)) - 5; };
    return {c.handle<XrSwapchain>(), {{edge(), edge()}, {edge(), edge()}}, c.small_count()};
}

XrFovf fov(Caller& c) {
    return {-c.random.number(), c.random.number(), c.random.number(), -c.random.number()};
}

template <typename Surface>
void fill_surface(Caller& c, Surface& layer) {
    layer.layerFlags = c.flags(7);
    layer.space = c.handle<XrSpace>();
    layer.eyeVisibility = c.enumerant<XrEyeVisibility>(3);
    layer.subImage = sub_image(c);
    layer.pose = c.pose();
}

const XrCompositionLayerBaseHeader* layer(Caller& c) {
    switch (c.random.below(5)) {
        case 0: {
            auto& quad = *c.array<XrCompositionLayerQuad>(1);
            quad.type = XR_TYPE_COMPOSITION_LAYER_QUAD;
            fill_surface(c, quad);
            quad.size = {c.random.number(), c.random.number()};
            return reinterpret_cast<const XrCompositionLayerBaseHeader*>(&quad);
        }
        case 1: {
            auto& cylinder = *c.array<XrCompositionLayerCylinderKHR>(1);
            cylinder.type = XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR;
            fill_surface(c, cylinder);
            cylinder.radius = c.random.number();
            cylinder.centralAngle = c.random.number();
            cylinder.aspectRatio = c.random.number();
            return reinterpret_cast<const XrCompositionLayerBaseHeader*>(&cylinder);
        }
        case 2: {
            auto& equirect = *c.array<XrCompositionLayerEquirect2KHR>(1);
            equirect.type = XR_TYPE_COMPOSITION_LAYER_EQUIRECT2_KHR;
            fill_surface(c, equirect);
            equirect.radius = c.random.number();
            return reinterpret_cast<const XrCompositionLayerBaseHeader*>(&equirect);
        }
        case 3: {
            auto& projection = *c.array<XrCompositionLayerProjection>(1);
            projection.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION;
            projection.layerFlags = c.flags(7);
            projection.space = c.handle<XrSpace>();
            projection.viewCount = c.random.chance(80) ? 2 : c.small_count();
            auto* views = c.array<XrCompositionLayerProjectionView>(4);
            for (std::size_t i = 0; i < 4; ++i) {
                if (c.random.chance(98)) views[i].type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW;
                views[i].pose = c.pose();
                views[i].fov = fov(c);
                views[i].subImage = sub_image(c);
                if (!c.random.chance(20)) continue;
                auto& depth = *c.array<XrCompositionLayerDepthInfoKHR>(1);
                depth.type = XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR;
                depth.subImage = sub_image(c);
                depth.maxDepth = c.random.number();
                depth.farZ = c.random.number();
                views[i].next = &depth;
            }
            projection.views = c.maybe(*views);
            return reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection);
        }
        default: {
            auto& other = *c.array<XrCompositionLayerBaseHeader>(1);
            other.type =
                c.random.pick({XR_TYPE_UNKNOWN, XR_TYPE_FRAME_STATE, XR_TYPE_COMPOSITION_LAYER_CUBE_KHR});
            return c.maybe(other);
        }
    }
}

void end_frame(Caller& c) {
    auto& info = c.structure<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
    info.displayTime = c.time();
    info.environmentBlendMode =
        c.random.chance(90) ? XR_ENVIRONMENT_BLEND_MODE_OPAQUE : c.enumerant<XrEnvironmentBlendMode>(5);
    const std::size_t count = c.random.chance(60) ? 0 : c.random.below(20);
    auto** layers = c.array<const XrCompositionLayerBaseHeader*>(count);
    for (std::size_t i = 0; i < count; ++i) layers[i] = layer(c);
    info.layerCount = static_cast<std::uint32_t>(count);
    info.layers = c.maybe(*layers);
    c.call.xrEndFrame(c.handle<XrSession>(), c.maybe(info));
}

void run_frame(Caller& c) {
    const auto session = c.handle<XrSession>();
    XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
    if (c.call.xrWaitFrame(session, nullptr, &state) != XR_SUCCESS) return;
    c.last_time = state.predictedDisplayTime;
    c.call.xrBeginFrame(session, nullptr);
    const XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO,           nullptr, state.predictedDisplayTime,
                              XR_ENVIRONMENT_BLEND_MODE_OPAQUE, 0,       nullptr};
    c.call.xrEndFrame(session, &info);
}

void locate_views(Caller& c) {
    auto& info = c.structure<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
    info.viewConfigurationType = c.view_configuration();
    info.displayTime = c.time();
    info.space = c.handle<XrSpace>();
    auto& state = c.structure<XrViewState>(XR_TYPE_VIEW_STATE);
    auto* views = c.array<XrView>(64);
    for (std::size_t i = 0; i < 64; ++i)
        if (c.random.chance(99)) views[i].type = XR_TYPE_VIEW;
    const std::uint32_t capacity = c.capacity();
    c.call.xrLocateViews(c.handle<XrSession>(), c.maybe(info), c.maybe(state), capacity,
                         c.out<std::uint32_t>(), c.maybe(*views));
}

void create_reference_space(Caller& c) {
    auto& info = c.structure<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
    info.referenceSpaceType = c.random.chance(5) ? XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO
                                                 : static_cast<XrReferenceSpaceType>(1 + c.random.below(4));
    info.poseInReferenceSpace = c.pose();
    XrSpace space = XR_NULL_HANDLE;
    const XrResult result =
        c.call.xrCreateReferenceSpace(c.handle<XrSession>(), c.maybe(info), c.maybe(space));
    if (result == XR_SUCCESS) c.handles.add(space);
    const std::uint32_t capacity = c.capacity();
    c.call.xrEnumerateReferenceSpaces(c.handle<XrSession>(), capacity, c.out<std::uint32_t>(),
                                      c.maybe(*c.array<XrReferenceSpaceType>(64)));
    c.call.xrGetReferenceSpaceBoundsRect(c.handle<XrSession>(), info.referenceSpaceType,
                                         c.out<XrExtent2Df>());
}

void create_action_space(Caller& c) {
    auto& info = c.structure<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
    info.action = c.handle<XrAction>();
    info.subactionPath = c.random.chance(50) ? XR_NULL_PATH : c.path();
    info.poseInActionSpace = c.pose();
    XrSpace space = XR_NULL_HANDLE;
    if (c.call.xrCreateActionSpace(c.handle<XrSession>(), c.maybe(info), c.maybe(space)) == XR_SUCCESS)
        c.handles.add(space);
}

void locate_space(Caller& c) {
    auto& location = c.structure<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
    auto& velocity = *c.array<XrSpaceVelocity>(1);
    velocity.type = XR_TYPE_SPACE_VELOCITY;
    if (c.random.chance(50)) location.next = &velocity;
    c.call.xrLocateSpace(c.handle<XrSpace>(), c.handle<XrSpace>(), c.time(), c.maybe(location));
}

#ifdef XR_VERSION_1_1
void locate_spaces(Caller& c) {
    constexpr std::size_t most = 8;
    auto* spaces = c.array<XrSpace>(most);
    for (std::size_t i = 0; i < most; ++i) spaces[i] = c.handle<XrSpace>();
    const auto count = [&] {
        return static_cast<std::uint32_t>(c.random.chance(80) ? 3 : c.random.below(most));
    };
    auto& info = c.structure<XrSpacesLocateInfo>(XR_TYPE_SPACES_LOCATE_INFO);
    info.baseSpace = c.handle<XrSpace>();
    info.time = c.time();
    info.spaceCount = count();
    info.spaces = c.maybe(*spaces);
    auto& velocities = *c.array<XrSpaceVelocities>(1);
    velocities = {XR_TYPE_SPACE_VELOCITIES, nullptr, count(), c.maybe(*c.array<XrSpaceVelocityData>(most))};
    auto& locations = c.structure<XrSpaceLocations>(XR_TYPE_SPACE_LOCATIONS);
    if (c.random.chance(50)) locations.next = &velocities;
    locations.locationCount = count();
    locations.locations = c.maybe(*c.array<XrSpaceLocationData>(most));
    c.call.xrLocateSpacesKHR(c.handle<XrSession>(), c.maybe(info), c.maybe(locations));
}
#endif

void destroy_space(Caller& c) {
    const auto space = c.handle<XrSpace>();
    if (c.call.xrDestroySpace(space) == XR_SUCCESS) c.handles.remember_dead(space);
}

void create_swapchain(Caller& c) {
    const std::uint32_t capacity = c.capacity();
    c.call.xrEnumerateSwapchainFormats(c.handle<XrSession>(), capacity, c.out<std::uint32_t>(),
                                       c.maybe(*c.array<std::int64_t>(64)));
    auto& info = c.structure<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
    const auto size = [&] {
        return c.random.chance(95) ? static_cast<std::uint32_t>(c.random.below(129))
                                   : std::uint32_t{1u << 31};
    };
    info.createFlags = c.flags(XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT);
    info.usageFlags = c.flags(0x7f);
    info.format = VK_FORMAT_R8G8B8A8_SRGB;
    if (c.random.chance(5)) info.format = static_cast<std::int64_t>(c.random.bits());
    info.width = size(), info.height = size();
    info.sampleCount = c.random.chance(95) ? 1 : c.small_count();
    info.faceCount = c.random.chance(90) ? 1 : 6;
    info.arraySize = c.random.chance(90) ? 1 : size();
    info.mipCount = c.random.chance(90) ? 1 : c.small_count();
    XrSwapchain swapchain = XR_NULL_HANDLE;
    if (c.call.xrCreateSwapchain(c.handle<XrSession>(), c.maybe(info), c.maybe(swapchain)) == XR_SUCCESS)
        c.handles.add(swapchain);
}

void destroy_swapchain(Caller& c) {
    const auto swapchain = c.handle<XrSwapchain>();
    if (c.call.xrDestroySwapchain(swapchain) == XR_SUCCESS) c.handles.remember_dead(swapchain);
}

void use_swapchain(Caller& c) {
    auto* images = c.array<XrSwapchainImageVulkanKHR>(64);
    for (std::size_t i = 0; i < 64; ++i)
        if (c.random.chance(99)) images[i].type = XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR;
    const std::uint32_t capacity = c.capacity();
    c.call.xrEnumerateSwapchainImages(c.handle<XrSwapchain>(), capacity, c.out<std::uint32_t>(),
                                      reinterpret_cast<XrSwapchainImageBaseHeader*>(c.maybe(*images)));
    auto& acquire = c.structure<XrSwapchainImageAcquireInfo>(XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
    {
        const std::lock_guard lock(queue_mutex);
        c.call.xrAcquireSwapchainImage(c.handle<XrSwapchain>(), c.maybe(acquire), c.out<std::uint32_t>());
    }
    auto& wait = c.structure<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
    wait.timeout = c.random.pick<XrDuration>({0, -1, 1'000'000, XR_INFINITE_DURATION});
    c.call.xrWaitSwapchainImage(c.handle<XrSwapchain>(), c.maybe(wait));
    auto& release = c.structure<XrSwapchainImageReleaseInfo>(XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
    c.call.xrReleaseSwapchainImage(c.handle<XrSwapchain>(), c.maybe(release));
}

}  // namespace

std::vector<Call> session_calls() {
    return {{"xrCreateSession", 20, create_session},
            {"xrDestroySession", 3, destroy_session},
            {"xrBeginSession", 20, begin_session},
            {"xrEndSession", 8, end_session},
            {"xrRequestExitSession", 2, request_exit},
            {"xrWaitFrame", 10, wait_frame},
            {"xrBeginFrame", 10, begin_frame},
            {"xrEndFrame", 20, end_frame},
            {"a whole frame", 30, run_frame},
            {"xrLocateViews", 20, locate_views},
            {"xrCreateReferenceSpace", 15, create_reference_space},
            {"xrCreateActionSpace", 10, create_action_space},
            {"xrLocateSpace", 30, locate_space},
#ifdef XR_VERSION_1_1
            {"xrLocateSpacesKHR", 10, locate_spaces},
#endif
            {"xrDestroySpace", 10, destroy_space},
            {"xrCreateSwapchain", 10, create_swapchain},
            {"xrDestroySwapchain", 5, destroy_swapchain},
            {"xrAcquireSwapchainImage", 15, use_swapchain}};
}

}  // namespace foveray::fuzz
