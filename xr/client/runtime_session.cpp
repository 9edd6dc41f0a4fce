#include "xr/client/runtime_session.h"

#include <algorithm>
#include <atomic>

#include "base/error.h"
#include "base/log.h"

namespace foveray::xr {
namespace {

XrEnvironmentBlendMode to_xr_blend_mode(BlendMode mode) {
    switch (mode) {
        case BlendMode::Additive:
            return XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
        case BlendMode::AlphaBlend:
            return XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
        case BlendMode::Opaque:
            break;
    }
    return XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
}

SpaceHandle make_reference_space(XrSession session, XrReferenceSpaceType type, const Pose& pose) {
    const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, type, to_xr(pose)};
    SpaceHandle space;
    check(xrCreateReferenceSpace(session, &info, space.put()), "xrCreateReferenceSpace");
    return space;
}

std::atomic<std::uint64_t> last_mesh_version = 0;  // over all sessions

constexpr float standing_eye_height = 1.6f;  // metres, where the runtime knows no floor

}  // namespace

RuntimeSession::RuntimeSession(const Instance& instance, const gpu::Device& device,
                               const Presentation& presentation)
    : instance_(instance), device_(device), presentation_(presentation) {
    const auto& modes = instance.blend_modes();
    if (std::ranges::find(modes, presentation.blend) == modes.end()) presentation_.blend = modes.front();

    XrGraphicsBindingVulkan2KHR binding{XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR};
    binding.instance = *device.instance();
    binding.physicalDevice = *device.physical();
    binding.device = *device.vk();
    binding.queueFamilyIndex = device.queue_family();
    binding.queueIndex = 0;
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding, 0, instance.system()};
    check(xrCreateSession(instance.get(), &info, session_.put()), "xrCreateSession");
    make_spaces();
    make_swapchains();
    input_ = Input(instance, session_.get());
    if (instance.has(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME)) {
        hidden_meshes_.assign(sizes_.size(), {});
        for (std::uint32_t view = 0; view < sizes_.size(); ++view) read_hidden_mesh(view);
    }
}

RuntimeSession::~RuntimeSession() {
    if (!open_frame_) return;
    XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
    info.displayTime = *open_frame_;
    info.environmentBlendMode = to_xr_blend_mode(presentation_.blend);
    const auto lock = device_.lock_queue();
    xrEndFrame(session_.get(), &info);  // if even that fails, the session ends all the same
}

void RuntimeSession::make_spaces() {
    std::uint32_t count = 0;
    check(xrEnumerateReferenceSpaces(session_.get(), 0, &count, nullptr), "xrEnumerateReferenceSpaces");
    std::vector<XrReferenceSpaceType> types(count);
    check(xrEnumerateReferenceSpaces(session_.get(), count, &count, types.data()),
          "xrEnumerateReferenceSpaces");
    const auto offers = [&](auto type) { return std::find(types.begin(), types.end(), type) != types.end(); };
    if (offers(XR_REFERENCE_SPACE_TYPE_STAGE)) {
        stage_ = make_reference_space(session_.get(), XR_REFERENCE_SPACE_TYPE_STAGE, Pose{});
    } else {
        log::info("{} knows no floor: taken to be {} m below the head", instance_.runtime_name(),
                  standing_eye_height);
        stage_ = make_reference_space(session_.get(), XR_REFERENCE_SPACE_TYPE_LOCAL,
                                      {quat(1, 0, 0, 0), vec3(0, -standing_eye_height, 0)});
    }
    head_ = make_reference_space(session_.get(), XR_REFERENCE_SPACE_TYPE_VIEW, Pose{});
    if (instance_.can_foveate() && offers(XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO)) {
        rendering_gaze_ =
            make_reference_space(session_.get(), XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO, Pose{});
    }
}

void RuntimeSession::make_swapchains() {
    sizes_ = instance_.view_sizes(false);
    foveated_sizes_ = instance_.can_foveate() ? instance_.view_sizes(true) : sizes_;
    const bool with_depth = instance_.has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) &&
                            Swapchain::offers(session_.get(), Swapchain::Kind::Depth);
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const uvec2 size = glm::max(sizes_[i], foveated_sizes_[i]);
        const std::string name = "view " + std::to_string(i);
        color_.emplace_back(session_.get(), Swapchain::Kind::Color, size, name.c_str());
        if (with_depth) depth_.emplace_back(session_.get(), Swapchain::Kind::Depth, size, name.c_str());
    }
}

void RuntimeSession::read_hidden_mesh(std::uint32_t view) {
    const auto get_mask = instance_.function<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR");
    XrVisibilityMaskKHR mask{XR_TYPE_VISIBILITY_MASK_KHR};
    const auto read = [&] {
        check(get_mask(session_.get(), instance_.view_configuration(), view,
                       XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, &mask),
              "xrGetVisibilityMaskKHR");
    };
    read();
    HiddenMesh mesh;
    mesh.version = ++last_mesh_version;
    if (mask.vertexCountOutput > 0 && mask.indexCountOutput > 0) {
        std::vector<XrVector2f> vertices(mask.vertexCountOutput);
        mesh.indices.resize(mask.indexCountOutput);
        mask.vertexCapacityInput = mask.vertexCountOutput;
        mask.indexCapacityInput = mask.indexCountOutput;
        mask.vertices = vertices.data();
        mask.indices = mesh.indices.data();
        read();
        for (const XrVector2f& v : vertices) mesh.vertices.emplace_back(v.x, v.y);
    }
    hidden_meshes_[view] = std::move(mesh);
}

void RuntimeSession::poll() {
    while (!ended_) {
        XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
        if (check(xrPollEvent(instance_.get(), &event), "xrPollEvent") == XR_EVENT_UNAVAILABLE) break;
        switch (event.type) {
            case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED: {
                const auto& change = reinterpret_cast<const XrEventDataSessionStateChanged&>(event);
                if (change.session == session_.get()) on_state(change.state);
                break;
            }
            case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
                throw Lost(Lost::What::Instance, "is shutting down");
            case XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR: {
                const auto& change = reinterpret_cast<const XrEventDataVisibilityMaskChangedKHR&>(event);
                if (change.viewConfigurationType == instance_.view_configuration() &&
                    change.viewIndex < hidden_meshes_.size()) {
                    read_hidden_mesh(change.viewIndex);
                }
                break;
            }
            default:
                break;
        }
    }
}

void RuntimeSession::on_state(XrSessionState state) {
    log::debug("the session is in {}", state_name(state));
    switch (state) {
        case XR_SESSION_STATE_READY: {
            const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr,
                                          instance_.view_configuration()};
            check(xrBeginSession(session_.get(), &info), "xrBeginSession");
            begun_ = true;
            break;
        }
        case XR_SESSION_STATE_STOPPING:
            check(xrEndSession(session_.get()), "xrEndSession");
            begun_ = false;
            break;
        case XR_SESSION_STATE_LOSS_PENDING:
            throw Lost(Lost::What::Session, "is losing the headset's session");
        case XR_SESSION_STATE_EXITING:
            ended_ = true;
            break;
        default:
            break;
    }
}

void RuntimeSession::wake() const { xrRequestExitSession(session_.get()); }

void RuntimeSession::request_exit() { check(xrRequestExitSession(session_.get()), "xrRequestExitSession"); }

bool RuntimeSession::rendering_gaze_is_available(XrTime time) const {
    if (!rendering_gaze_) return false;
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
    check(xrLocateSpace(rendering_gaze_.get(), head_.get(), time, &location), "xrLocateSpace");
    return (location.locationFlags & XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT) != 0;
}

Frame RuntimeSession::begin_frame() {
    const XrFrameWaitInfo wait_info{XR_TYPE_FRAME_WAIT_INFO};
    XrFrameState frame_state{XR_TYPE_FRAME_STATE};
    check(xrWaitFrame(session_.get(), &wait_info, &frame_state), "xrWaitFrame");
    const XrFrameBeginInfo begin_info{XR_TYPE_FRAME_BEGIN_INFO};
    auto lock = device_.lock_queue();
    const XrResult begun = check(xrBeginFrame(session_.get(), &begin_info), "xrBeginFrame");
    lock.unlock();
    if (begun == XR_FRAME_DISCARDED) {
        release_images();  // of the frame that was begun before and never ended
    }
    open_frame_ = frame_state.predictedDisplayTime;
    submission_recorded_ = false;

    Frame frame;
    frame.display_time = frame_state.predictedDisplayTime;
    frame.period = frame_state.predictedDisplayPeriod;
    frame.should_render = frame_state.shouldRender == XR_TRUE;
    frame.has_eye_tracking = instance_.has_eye_tracking();
    frame.blend = presentation_.blend;

    const bool foveated = rendering_gaze_is_available(frame.display_time);
    LocatedViews located_views = locate_views(frame.display_time, foveated);
    frame.views = std::move(located_views.views);
    if (foveated && fixed_views_.empty()) fixed_views_ = locate_views(frame.display_time, false).views;
    XrSpaceLocation head{XR_TYPE_SPACE_LOCATION};
    check(xrLocateSpace(head_.get(), stage_.get(), frame.display_time, &head), "xrLocateSpace");
    const XrSpaceLocationFlags located =
        XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
    frame.stage_from_head = to_pose(head.pose);
    frame.head_valid =
        located_views.valid && (head.locationFlags & located) == located && is_usable(frame.stage_from_head);
    frame.head_position_tracked = head.locationFlags & XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
    frame.head_orientation_tracked = head.locationFlags & XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
    input_.update(session_.get(), stage_.get(), frame);
    return frame;
}

RuntimeSession::LocatedViews RuntimeSession::locate_views(XrTime time, bool foveated) const {
    const XrViewLocateFoveatedRenderingVARJO foveation{XR_TYPE_VIEW_LOCATE_FOVEATED_RENDERING_VARJO, nullptr,
                                                       foveated};
    XrViewLocateInfo locate{XR_TYPE_VIEW_LOCATE_INFO};
    locate.next = rendering_gaze_ ? &foveation : nullptr;
    locate.viewConfigurationType = instance_.view_configuration();
    locate.displayTime = time;
    locate.space = stage_.get();
    XrViewState view_state{XR_TYPE_VIEW_STATE};
    std::uint32_t count = static_cast<std::uint32_t>(sizes_.size());
    std::vector<XrView> views(count, {XR_TYPE_VIEW});
    check(xrLocateViews(session_.get(), &locate, &view_state, count, &count, views.data()), "xrLocateViews");
    const XrViewStateFlags needed = XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
    LocatedViews located;
    located.valid = (view_state.viewStateFlags & needed) == needed;
    for (std::uint32_t i = 0; i < count; ++i) {
        View view;
        view.eye = i % 2 == 0 ? Eye::Left : Eye::Right;
        view.role = i < 2 ? ViewRole::Context : ViewRole::Focus;
        view.stage_from_eye = to_pose(views[i].pose);
        view.fov = to_fov(views[i].fov);
        view.size = foveated ? foveated_sizes_[i] : sizes_[i];
        located.valid = located.valid && is_usable(view.stage_from_eye);
        located.views.push_back(view);
    }
    return located;
}

HeadsetProfile RuntimeSession::profile(const Frame& frame) const {
    HeadsetProfile profile;
    profile.name = profile.display_name = instance_.system_name();
    profile.source = "What " + instance_.runtime_name() + " told foveray while a session was recorded.";
    profile.rate_hz = static_cast<double>(nanoseconds_per_second) / static_cast<double>(frame.period);
    profile.eye_tracking = instance_.has_eye_tracking();
    const std::vector<View>& views = fixed_views_.empty() ? frame.views : fixed_views_;
    profile.ipd = glm::distance(views[0].stage_from_eye.position, views[1].stage_from_eye.position);
    for (const View& view : views)
        profile.views.push_back(
            {view.eye, view.role, view.size, view.fov, centre_ppd(view.fov, view.size.x)});
    profile.blend_modes = instance_.blend_modes();
    // Its controllers have every input that a session keeps; which ones were held is not recorded.
    profile.interaction_profile = "/interaction_profiles/oculus/touch_controller";
    if (views.size() > 2) {
        profile.foveated_focus_scale =
            std::min(1.0f, static_cast<float>(foveated_sizes_[2].x) / static_cast<float>(sizes_[2].x));
    }
    return profile;
}

void RuntimeSession::release_images() {
    for (Swapchain& swapchain : color_) swapchain.release(device_);
    for (Swapchain& swapchain : depth_) swapchain.release(device_);
}

bool RuntimeSession::record_submission(const gpu::Commands& cmd, const Frame& frame,
                                       const std::vector<ViewPicture>& pictures) {
    const auto acquire = [&](Swapchain& swapchain) { return swapchain.acquire(device_); };
    if (!std::ranges::all_of(color_, acquire) || !std::ranges::all_of(depth_, acquire)) return false;
    cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::TransferRead);
    for (std::size_t i = 0; i < frame.views.size(); ++i) {
        color_[i].record_copy(cmd, pictures[i].color, pictures[i].color_offset, frame.views[i].size);
        if (!depth_.empty()) {
            depth_[i].record_copy(cmd, pictures[i].depth, pictures[i].depth_offset, frame.views[i].size);
        }
    }
    submission_recorded_ = true;
    return true;
}

void RuntimeSession::end_frame(const Frame& frame) {
    std::vector<XrCompositionLayerProjectionView> views(frame.views.size(),
                                                        {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW});
    std::vector<XrCompositionLayerDepthInfoKHR> depths(frame.views.size(),
                                                       {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR});
    XrCompositionLayerProjection layer{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
    const XrCompositionLayerBaseHeader* layers[] = {reinterpret_cast<XrCompositionLayerBaseHeader*>(&layer)};
    XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
    info.displayTime = frame.display_time;
    info.environmentBlendMode = to_xr_blend_mode(presentation_.blend);
    if (submission_recorded_) {
        release_images();
        for (std::size_t i = 0; i < views.size(); ++i) {
            const View& view = frame.views[i];
            const XrRect2Di rect{{0, 0}, {static_cast<int>(view.size.x), static_cast<int>(view.size.y)}};
            views[i].pose = to_xr(view.stage_from_eye);
            views[i].fov = to_xr(view.fov);
            views[i].subImage = {color_[i].get(), rect, 0};
            if (depth_.empty()) continue;
            depths[i].subImage = {depth_[i].get(), rect, 0};
            depths[i].minDepth = 0.0f;
            depths[i].maxDepth = 1.0f;
            depths[i].nearZ = presentation_.near_z;
            depths[i].farZ = presentation_.far_z;
            views[i].next = &depths[i];
        }
        layer.layerFlags = presentation_.blend == BlendMode::AlphaBlend
                               ? XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT
                               : 0;
        layer.space = stage_.get();
        layer.viewCount = static_cast<std::uint32_t>(views.size());
        layer.views = views.data();
        info.layerCount = 1;
        info.layers = layers;
    }
    open_frame_.reset();
    const auto lock = device_.lock_queue();
    check(xrEndFrame(session_.get(), &info), "xrEndFrame");
}

}  // namespace foveray::xr
