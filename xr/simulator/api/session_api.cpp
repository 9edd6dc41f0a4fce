
#include "xr/simulator/api/functions.h"
#include "xr/simulator/api/openxr_vulkan.h"
#include "xr/simulator/convert.h"
#include "xr/simulator/display/optics.h"
#include "xr/simulator/session.h"
#include "xr/simulator/space.h"

namespace foveray::simulator {
namespace {

/// nullptr for a headless session.
std::unique_ptr<VulkanDevice> take_device(Instance& instance, const void* next) {
    const auto* found = find_input<XrGraphicsBindingVulkanKHR>(next, XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR);
    if (!found && instance.has(XR_MND_HEADLESS_EXTENSION_NAME)) return nullptr;
    verify(found && (instance.has(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME) ||
                     instance.has(XR_KHR_VULKAN_ENABLE_EXTENSION_NAME)),
           XR_ERROR_GRAPHICS_DEVICE_INVALID);
    const XrGraphicsBindingVulkanKHR& binding = *found;
    verify(instance.were_graphics_requirements_asked(), XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
    verify(binding.instance && binding.physicalDevice && binding.device, XR_ERROR_GRAPHICS_DEVICE_INVALID);
    verify(instance.gpu(binding.instance) == binding.physicalDevice, XR_ERROR_GRAPHICS_DEVICE_INVALID);
    return std::make_unique<VulkanDevice>(binding.instance, binding.physicalDevice, binding.device,
                                          binding.queueFamilyIndex, binding.queueIndex,
                                          instance.vulkan_loader(binding.instance));
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrCreateSession(XrInstance instance, const XrSessionCreateInfo* info,
                                               XrSession* session) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify_structure(info, XR_TYPE_SESSION_CREATE_INFO);
        verify(session != nullptr && info->createFlags == 0);
        get_system(instance, info->systemId);
        const auto made = std::make_shared<Session>(object, take_device(*object, info->next));
        *session = add_object(made, object->id());
        made->start();
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrDestroySession(XrSession session) {
    return guarded([&] { destroy<Session>(session); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrBeginSession(XrSession session, const XrSessionBeginInfo* info) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_SESSION_BEGIN_INFO);
        const bool supported = object->instance().supports(info->primaryViewConfigurationType);
        verify(supported || object->headless(), XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
        object->begin(supported ? info->primaryViewConfigurationType
                                : XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrEndSession(XrSession session) {
    return guarded([&] { get<Session>(session)->end(); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrRequestExitSession(XrSession session) {
    return guarded([&] { get<Session>(session)->request_exit(); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrWaitFrame(XrSession session, const XrFrameWaitInfo* info,
                                           XrFrameState* state) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_optional_structure(info, XR_TYPE_FRAME_WAIT_INFO);
        verify_structure(state, XR_TYPE_FRAME_STATE);
        const Session::WaitedFrame frame = object->wait_frame();
        state->predictedDisplayTime = frame.time.display_time;
        state->predictedDisplayPeriod = frame.time.period;
        state->shouldRender = frame.should_render;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrBeginFrame(XrSession session, const XrFrameBeginInfo* info) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_optional_structure(info, XR_TYPE_FRAME_BEGIN_INFO);
        return object->begin_frame();
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrEndFrame(XrSession session, const XrFrameEndInfo* info) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_FRAME_END_INFO);
        verify(object->running(), XR_ERROR_SESSION_NOT_RUNNING);
        verify(info->displayTime > 0, XR_ERROR_TIME_INVALID);
        const auto modes = object->instance().blend_modes();
        verify(info->environmentBlendMode >= XR_ENVIRONMENT_BLEND_MODE_OPAQUE &&
               info->environmentBlendMode <= XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
        verify(std::ranges::find(modes, info->environmentBlendMode) != modes.end(),
               XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
        object->end_frame(*info);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrLocateViews(XrSession session, const XrViewLocateInfo* info,
                                             XrViewState* state, std::uint32_t capacity, std::uint32_t* count,
                                             XrView* views) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_VIEW_LOCATE_INFO);
        verify_structure(state, XR_TYPE_VIEW_STATE);
        Instance& instance = object->instance();
        verify(instance.supports(info->viewConfigurationType), XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
        verify(info->displayTime > 0, XR_ERROR_TIME_INVALID);
        const auto base = get<Space>(info->space);
        verify(&base->session() == object.get());

        const HeadsetProfile& profile = instance.profile();
        const auto profiles = views_of(profile, info->viewConfigurationType);
        const auto* foveated = find_input<XrViewLocateFoveatedRenderingVARJO>(
            info->next, XR_TYPE_VIEW_LOCATE_FOVEATED_RENDERING_VARJO);
        const bool follows_gaze = foveated && foveated->foveatedRenderingActive &&
                                  instance.has(XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME);
        const auto gaze =
            instance.script().rendering_gaze_at(instance.clock().session_time(info->displayTime));
        const vec3 direction = gaze ? gaze->direction : vec3(0.0f, 0.0f, -1.0f);
        const HeadLocation head = locate_head(*base, info->displayTime);
        state->viewStateFlags = head.flags;
        enumerate(static_cast<std::uint32_t>(profiles.size()), capacity, count, views,
                  [&](XrView& view, std::uint32_t i) {
                      verify_structure(&view, XR_TYPE_VIEW);
                      view.pose = to_xr(head.base_from_head * head_from_eye(profile, profiles[i].eye));
                      view.fov = to_xr(follows_gaze ? foveated_fov(profile, profiles[i], direction)
                                                    : profiles[i].fov);
                  });
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetVisibilityMaskKHR(XrSession session, XrViewConfigurationType type,
                                                      std::uint32_t view, XrVisibilityMaskTypeKHR mask_type,
                                                      XrVisibilityMaskKHR* mask) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(mask, XR_TYPE_VISIBILITY_MASK_KHR);
        verify(object->instance().supports(type), XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
        verify(mask_type >= XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR &&
               mask_type <= XR_VISIBILITY_MASK_TYPE_LINE_LOOP_KHR);
        const HeadsetProfile& profile = object->instance().profile();
        const auto profiles = views_of(profile, type);
        verify(view < profiles.size());
        const VisibilityMask made = object->has_visibility_mask()
                                        ? visibility_mask(profile, profiles[view], mask_type)
                                        : VisibilityMask{};
        enumerate(static_cast<std::uint32_t>(made.vertices.size()), mask->vertexCapacityInput,
                  &mask->vertexCountOutput, mask->vertices, [&](XrVector2f& target, std::uint32_t i) {
                      target = {made.vertices[i].x, made.vertices[i].y};
                  });
        enumerate_values<std::uint32_t>(made.indices, mask->indexCapacityInput, &mask->indexCountOutput,
                                        mask->indices);
    });
}

}  // namespace foveray::simulator
