#include "xr/simulator/instance.h"

#include <unistd.h>
#include <utility>

#include "base/error.h"
#include "xr/simulator/api/openxr_vulkan.h"
#include "xr/simulator/control/control_commands.h"
#include "xr/simulator/control/control_path.h"
#include "xr/simulator/display/optics.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {
namespace {

HeadsetProfile read_profile(const Options& options) {
    if (!options.profile.empty()) return read_headset_profile(options.profile);
    return read_headset_profile(options.session.empty() ? "ci" : read_session(options.session).headset);
}

Script make_script(const Options& options) {
    std::optional<foveray::Session> session;
    if (!options.session.empty()) session = read_session(options.session);
    const std::string headset = session ? session->headset : "ci";
    return Script(read_headset_profile(options.profile.empty() ? headset : options.profile),
                  {std::move(session), options.pattern, options.gaze, options.faults});
}

/// Where an instance with a loss left the script.
struct Continuation {
    std::filesystem::path session, faults;
    FrameClock::Position clock;
    Nanoseconds played_until;
    std::shared_ptr<FailingCalls> failing_calls;
};
std::mutex continuation_mutex;
std::optional<Continuation> continuation;

std::optional<Continuation> take_continuation(const Options& options) {
    const std::lock_guard lock(continuation_mutex);
    auto found = std::exchange(continuation, std::nullopt);
    const bool same = found && found->session == options.session && found->faults == options.faults;
    return same ? found : std::nullopt;
}

bool has_focus_display(const HeadsetProfile& profile) { return profile.views.size() == 4; }

}  // namespace

std::vector<Extension> supported_extensions() {
    std::vector<Extension> extensions{
        {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME, XR_KHR_vulkan_enable2_SPEC_VERSION},
        {XR_KHR_VULKAN_ENABLE_EXTENSION_NAME, XR_KHR_vulkan_enable_SPEC_VERSION},
        {XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME, XR_KHR_composition_layer_depth_SPEC_VERSION},
        {XR_KHR_COMPOSITION_LAYER_CYLINDER_EXTENSION_NAME, XR_KHR_composition_layer_cylinder_SPEC_VERSION},
        {XR_KHR_COMPOSITION_LAYER_EQUIRECT2_EXTENSION_NAME, XR_KHR_composition_layer_equirect2_SPEC_VERSION},
        {XR_KHR_COMPOSITION_LAYER_COLOR_SCALE_BIAS_EXTENSION_NAME,
         XR_KHR_composition_layer_color_scale_bias_SPEC_VERSION},
        {XR_KHR_VISIBILITY_MASK_EXTENSION_NAME, XR_KHR_visibility_mask_SPEC_VERSION},
        {XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME, XR_EXT_conformance_automation_SPEC_VERSION},
        {XR_EXT_DEBUG_UTILS_EXTENSION_NAME, XR_EXT_debug_utils_SPEC_VERSION},
        {XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME, XR_EXT_eye_gaze_interaction_SPEC_VERSION},
        {XR_EXT_HAND_TRACKING_EXTENSION_NAME, XR_EXT_hand_tracking_SPEC_VERSION},
        {XR_MND_HEADLESS_EXTENSION_NAME, XR_MND_headless_SPEC_VERSION},
    };
    const Options options = read_options();
    if (options.time == TimeMode::Real) {
        extensions.push_back(
            {XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME, XR_KHR_convert_timespec_time_SPEC_VERSION});
    }
    if (has_focus_display(read_profile(options))) {
        extensions.push_back({XR_VARJO_QUAD_VIEWS_EXTENSION_NAME, XR_VARJO_quad_views_SPEC_VERSION});
        extensions.push_back(
            {XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME, XR_VARJO_foveated_rendering_SPEC_VERSION});
    }
    if (has_openxr_1_1) {
        extensions.push_back({XR_KHR_LOCATE_SPACES_EXTENSION_NAME, XR_KHR_locate_spaces_SPEC_VERSION});
        extensions.push_back({XR_KHR_MAINTENANCE1_EXTENSION_NAME, XR_KHR_maintenance1_SPEC_VERSION});
        extensions.push_back({XR_EXT_LOCAL_FLOOR_EXTENSION_NAME, XR_EXT_local_floor_SPEC_VERSION});
        extensions.push_back({XR_EXT_USER_PRESENCE_EXTENSION_NAME, XR_EXT_user_presence_SPEC_VERSION});
    }
    return extensions;
}

Instance::Instance(std::set<std::string, std::less<>> features)
    : features_(std::move(features)),
      options_(read_options()),
      script_(make_script(options_)),
      clock_(options_.time, script_.rate_hz()) {
    if (!options_.timing.empty()) timing_.emplace(options_.timing);
    if (auto before = take_continuation(options_)) {
        clock_.go_on(before->clock);
        failing_calls_ = std::move(before->failing_calls);
        played_until_ = before->played_until;
    } else {
        failing_calls_ = std::make_shared<FailingCalls>();
        played_until_ = ScriptedFault::start - 1;
        play_faults(ScriptedFault::start);
    }
    if (options_.control.empty()) return;
    try {
        control_ = std::make_unique<ControlSocket>(
            options_.control, [this](const std::string& line) { return run_command(*this, line); });
    } catch (const Fault&) {
        if (options_.control != control_socket_path(getpid()) || !is_listening(options_.control)) throw;
        static std::atomic<bool> reported = false;
        if (!reported.exchange(true))
            report(options_.control.string() + ": this program's second headset has no control socket");
    }
}

void Instance::stage(Change change) {
    {
        const std::lock_guard lock(staged_mutex_);
        staged_.push_back(std::move(change));
    }
    if (!status_.running) make_staged_changes(clock_.session_time(clock_.now()));
}

void Instance::stage(ScriptedFault fault) {
    stage([this, fault](Nanoseconds time) mutable {
        Nanoseconds played_until;
        {
            const std::lock_guard lock(mutex_);
            played_until = played_until_;
        }
        fault.time = time;
        const bool waits_for_no_frame = time <= played_until || !status_.running;
        if (is_of_instance(fault.kind) && waits_for_no_frame) return play(fault);
        if (is_of_session(fault.kind)) fault.time = std::max(time, played_until + 1);
        script_.faults().add(fault);
    });
}

void Instance::make_staged_changes(Nanoseconds time) {
    std::vector<Change> changes;
    {
        const std::lock_guard lock(staged_mutex_);
        changes.swap(staged_);
    }
    for (const Change& change : changes) change(time);
}

void Instance::wake_control() {
    const std::lock_guard lock(control_mutex_);
    if (control_) control_->wake();
}

std::vector<ScriptedFault> Instance::play_faults(Nanoseconds time) {
    make_staged_changes(time);
    Nanoseconds after;
    {
        const std::lock_guard lock(mutex_);
        after = played_until_;
        played_until_ = std::max(time, played_until_);
    }
    const auto faults = script_.faults().between(after, time);
    for (const ScriptedFault& fault : faults) play(fault);
    return faults;
}

void Instance::play(const ScriptedFault& fault) {
    switch (fault.kind) {
        case FaultKind::InstanceLoss:
            lost_at_ = ScriptedFault::start;
            break;
        case FaultKind::InstanceLossPending: {
            const Nanoseconds loss = fault.time + fault.span;
            lost_at_ = std::min(lost_at_.load(), loss);
            events_.push(XrEventDataInstanceLossPending{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING, nullptr,
                                                        clock_.time_of(loss)});
            break;
        }
        case FaultKind::SwapchainTimeout:
            swapchain_timeouts_ = fault.count;
            return;
        case FaultKind::FailingCall: {
            const bool of_process = fault.call.function->owner == Owner::None;
            // Those from the start have been armed before there was an instance.
            if (of_process && fault.time == ScriptedFault::start) return;
            (of_process ? failing_calls_of_process() : *failing_calls_).add(fault.call);
            calls_may_fail = true;
            return;
        }
        case FaultKind::SessionLoss:
        case FaultKind::SessionLossPending:
            break;
        default:
            return;
    }
    calls_may_fail = true;
    note_loss();
}

void Instance::note_loss() {
    const std::lock_guard lock(mutex_);
    loses_ = true;
}

bool Instance::lost() const { return clock_.session_time(clock_.now()) >= lost_at_; }

bool Instance::is_plugged_in() {
    const std::lock_guard plug_lock(plug_mutex_);
    const auto available_at = [&](XrTime time) {
        return script_.faults().at(clock_.session_time(time)).form_factor_available;
    };
    if (available_at(clock_.now())) return true;
    {
        const std::lock_guard lock(mutex_);
        if (has_session_) return false;  // it plays the script
    }
    const XrTime time = clock_.tick().display_time;
    play_faults(clock_.session_time(time));
    return available_at(time);
}

bool Instance::take_swapchain_timeout() {
    std::uint32_t left = swapchain_timeouts_;
    while (left > 0 && !swapchain_timeouts_.compare_exchange_weak(left, left - 1)) {
    }
    return left > 0;
}

std::vector<XrViewConfigurationType> Instance::view_configurations() const {
    std::vector<XrViewConfigurationType> types;
    if (has(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME) && has_focus_display(profile())) {
        types.push_back(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO);
    }
    types.push_back(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    return types;
}

bool Instance::supports(XrViewConfigurationType type) const {
    const auto types = view_configurations();
    return std::ranges::find(types, type) != types.end();
}

std::vector<XrEnvironmentBlendMode> Instance::blend_modes() const {
    std::vector<XrEnvironmentBlendMode> modes;
    for (const BlendMode mode : profile().blend_modes) {
        switch (mode) {
            case BlendMode::Opaque:
                modes.push_back(XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
                break;
            case BlendMode::Additive:
                modes.push_back(XR_ENVIRONMENT_BLEND_MODE_ADDITIVE);
                break;
            case BlendMode::AlphaBlend:
                modes.push_back(XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
                break;
        }
    }
    return modes;
}

void Instance::remember_vulkan(VkInstance instance, VulkanLoader loader) {
    const std::lock_guard lock(mutex_);
    vulkan_[instance] = loader;
}

VulkanLoader Instance::vulkan_loader(VkInstance instance) const {
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = vulkan_.find(instance); found != vulkan_.end()) return found->second;
    }
    return {system_vulkan(), false};
}

VkPhysicalDevice Instance::gpu(VkInstance instance) {
    const VkPhysicalDevice device =
        choose_gpu(instance, VulkanInstanceFunctions(instance, vulkan_loader(instance).get), options_.gpu);
    const std::lock_guard lock(mutex_);
    gpus_[device] = instance;
    return device;
}

VkInstance Instance::vulkan_instance_of(VkPhysicalDevice device) const {
    const std::lock_guard lock(mutex_);
    const auto found = gpus_.find(device);
    return found != gpus_.end() ? found->second : VK_NULL_HANDLE;
}

void Instance::on_destroy() {
    {
        std::unique_lock control_lock(control_mutex_);
        const auto closing = std::move(control_);
        control_lock.unlock();
    }
    const std::lock_guard lock(mutex_);
    destroyed_ = true;
    suggestions_.clear();
    if (!loses_) return;
    const std::lock_guard continuation_lock(continuation_mutex);
    continuation = {options_.session, options_.faults, clock_.position(), played_until_, failing_calls_};
}

void Instance::suggest(const std::string& interaction_profile, std::vector<SuggestedBinding> bindings) {
    const std::lock_guard lock(mutex_);
    if (!destroyed_) suggestions_[interaction_profile] = std::move(bindings);
}

std::map<std::string, std::vector<SuggestedBinding>> Instance::suggestions() const {
    const std::lock_guard lock(mutex_);
    return suggestions_;
}

bool Instance::claim_name(const std::string& name, bool localized) {
    const std::lock_guard lock(mutex_);
    return names_.emplace(localized, name).second;
}

void Instance::release_name(const std::string& name, bool localized) {
    const std::lock_guard lock(mutex_);
    names_.erase({localized, name});
}

bool Instance::claim_session() {
    const std::lock_guard lock(mutex_);
    return !std::exchange(has_session_, true);
}

void Instance::release_session() {
    const std::lock_guard lock(mutex_);
    has_session_ = false;
}

std::shared_ptr<Instance> get_system(XrInstance instance, XrSystemId system) {
    auto object = get<Instance>(instance);
    verify(system == Instance::system_id, XR_ERROR_SYSTEM_INVALID);
    return object;
}

}  // namespace foveray::simulator
