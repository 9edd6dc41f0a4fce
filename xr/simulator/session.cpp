#include "xr/simulator/session.h"

#include <utility>

#include "xr/simulator/convert.h"
#include "xr/simulator/display/layers.h"
#include "xr/simulator/display/optics.h"

namespace foveray::simulator {

Session::Session(std::shared_ptr<Instance> instance, std::unique_ptr<VulkanDevice> device)
    : instance_(std::move(instance)),
      device_(std::move(device)),
      devices_(*instance_),
      inputs_(*instance_, devices_),
      lifecycle_([this](XrSessionState state) { announce(state); }) {
    verify(instance_->claim_session(), XR_ERROR_LIMIT_REACHED);
    try {
        if (device_) display_.emplace(*instance_, *device_);
    } catch (...) {
        instance_->release_session();
        throw;
    }
}

void Session::on_destroy() {
    const std::lock_guard end_lock(end_mutex_);
    {
        const std::lock_guard lock(mutex_);
        destroyed_ = true;
        note_running(false);
        instance_->status().state = XR_SESSION_STATE_UNKNOWN;
        instance_->events().forget(handle_of(*this));
        instance_->release_session();
        no_wait_.request_stop();
        frame_taken_.notify_all();
    }
    if (display_) display_->settle();
}

void Session::release_images(const Swapchain& swapchain) {
    if (display_) display_->release(swapchain);
}

void Session::start() {
    const std::lock_guard lock(mutex_);
    lifecycle_.start();
}

bool Session::running() const {
    const std::lock_guard lock(mutex_);
    return lifecycle_.running();
}

bool Session::focused() const {
    const std::lock_guard lock(mutex_);
    return lifecycle_.focused();
}

void Session::note_running(bool running) {
    Status& status = instance_->status();
    if (status.running.exchange(running) && !running) {
        ++status.session_ends;
        instance_->wake_control();
    }
}

void Session::announce(XrSessionState state) {
    instance_->status().state = state;
    instance_->events().push(XrEventDataSessionStateChanged{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr,
                                                            handle_of(*this), state,
                                                            instance_->clock().now()});
}

void Session::begin(XrViewConfigurationType configuration) {
    const std::lock_guard lock(mutex_);
    lifecycle_.begin();
    const FrameClock& clock = instance_->clock();
    user_present_ = instance_->script().faults().at(clock.session_time(clock.now())).user_present;
    announce_presence();
    note_running(true);
    no_wait_ = {};
    instance_->clock().pause();
    configuration_ = configuration;
    view_count_ = static_cast<std::uint32_t>(views_of(instance_->profile(), configuration).size());
    waited_.reset();
    begun_.reset();
    has_frames_ = false;
    if (headless()) play_script(instance_->clock().tick());
}

void Session::play_without_frames() {
    const std::lock_guard lock(mutex_);
    verify_not_lost();
    if (headless() && lifecycle_.running() && !has_frames_) play_script(instance_->clock().tick());
}

void Session::end() {
    const std::lock_guard lock(mutex_);
    lifecycle_.end();
    note_running(false);
    frame_taken_.notify_all();
}

void Session::request_exit() {
    const std::lock_guard lock(mutex_);
    verify_not_lost();
    lifecycle_.ask_to_stop(Lifecycle::Stop::ForGood);
    no_wait_.request_stop();
}

void Session::lose(Nanoseconds at) {
    lifecycle_.lose();
    lost_at_ = std::min(lost_at_.value_or(at), at);
}

void Session::verify_not_lost() {
    const FrameClock& clock = instance_->clock();
    if (lost_at_ && clock.session_time(clock.now()) >= *lost_at_) lost_ = true;
    verify(!lost_, XR_ERROR_SESSION_LOST);
}

void Session::change_visibility_mask(bool has_mask) {
    if (has_visibility_mask_.exchange(has_mask) == has_mask) return;
    if (!instance_->has(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME)) return;
    for (std::uint32_t view = 0; view < view_count_; ++view) {
        instance_->events().push(XrEventDataVisibilityMaskChangedKHR{
            XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR, nullptr, handle_of(*this), configuration_, view});
    }
}

void Session::announce_recentring(XrReferenceSpaceType type, Nanoseconds time,
                                  const Pose& previous_from_next) {
    instance_->events().push(XrEventDataReferenceSpaceChangePending{
        XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING, nullptr, handle_of(*this), type,
        instance_->clock().time_of(time), XR_TRUE, to_xr(previous_from_next)});
}

/// XR_EXT_user_presence: when a session begins, and at each change while it runs.
void Session::announce_presence() {
    if (!instance_->has(XR_EXT_USER_PRESENCE_EXTENSION_NAME)) return;
    instance_->events().push(XrEventDataUserPresenceChangedEXT{XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT,
                                                               nullptr, handle_of(*this), user_present_});
}

void Session::play(const ScriptedFault& fault) {
    switch (fault.kind) {
        case FaultKind::Recentre: {
            const Script& script = instance_->script();
            announce_recentring(
                XR_REFERENCE_SPACE_TYPE_LOCAL, fault.time,
                inverse(script.stage_from_local_at(fault.time - 1)) * script.stage_from_local_at(fault.time));
            if (!instance_->has(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME)) break;
            announce_recentring(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR, fault.time,
                                inverse(script.stage_from_local_floor_at(fault.time - 1)) *
                                    script.stage_from_local_floor_at(fault.time));
            break;
        }
        case FaultKind::SessionLoss:
            lose(0);
            break;
        case FaultKind::SessionLossPending:
            lose(fault.time + fault.span);
            gives_notice_ = true;
            break;
        case FaultKind::Exit:
            if (lifecycle_.running()) lifecycle_.ask_to_stop(Lifecycle::Stop::ForGood);
            break;
        case FaultKind::SessionPause:
            if (lifecycle_.running()) lifecycle_.ask_to_stop(Lifecycle::Stop::Pause);
            break;
        default:
            break;
    }
}

void Session::play_script(const FrameTime& frame) {
    const Script& script = instance_->script();
    const Nanoseconds time = instance_->clock().session_time(frame.display_time);
    instance_->status().frame = frame.index;
    for (const ScriptedFault& fault : instance_->play_faults(time)) play(fault);
    const Condition condition = script.faults().at(time);
    compositor_frame_ = condition.compositor_frame;
    change_visibility_mask(condition.has_visibility_mask);
    if (condition.user_present != user_present_) {
        user_present_ = condition.user_present;
        if (lifecycle_.running()) announce_presence();
    }
    if (!lifecycle_.running()) return;
    if (script.ended(frame.index)) lifecycle_.ask_to_stop(Lifecycle::Stop::ForGood);
    lifecycle_.show(script.presence_at(time));
    if (lifecycle_.stopping() || lifecycle_.lost()) no_wait_.request_stop();
}

Session::WaitedFrame Session::wait_frame() {
    const Nanoseconds called = TimingFile::now();
    std::unique_lock lock(mutex_);
    const auto verify_running = [&] {
        verify(!destroyed_, XR_ERROR_HANDLE_INVALID);
        verify(lifecycle_.running(), XR_ERROR_SESSION_NOT_RUNNING);
        verify_not_lost();
    };
    verify_running();
    frame_taken_.wait(lock, [&] { return destroyed_ || !lifecycle_.running() || (!waiting_ && !waited_); });
    verify_running();

    waiting_ = true;
    has_frames_ = true;
    const Nanoseconds compositor_frame = compositor_frame_;
    const std::stop_token no_wait = no_wait_.get_token();
    lock.unlock();
    const FrameTime frame = instance_->clock().next_frame(compositor_frame, no_wait);
    lock.lock();
    waiting_ = false;
    frame_taken_.notify_all();
    verify_running();
    waited_ = frame;
    ++instance_->status().waited_frames;
    play_script(frame);
    if (TimingFile* timing = instance_->timing()) {
        timing->waited(frame, instance_->clock().session_time(frame.display_time), called);
    }
    return {frame, lifecycle_.visible() && !headless()};
}

XrResult Session::begin_frame() {
    const std::lock_guard lock(mutex_);
    verify(lifecycle_.running(), XR_ERROR_SESSION_NOT_RUNNING);
    verify(waited_.has_value(), XR_ERROR_CALL_ORDER_INVALID);
    const bool discarded = begun_.has_value();
    begun_ = std::exchange(waited_, std::nullopt);
    if (TimingFile* timing = instance_->timing()) timing->begun(*begun_);
    frame_taken_.notify_all();
    return discarded ? XR_FRAME_DISCARDED : XR_SUCCESS;
}

void Session::end_frame(const XrFrameEndInfo& info) {
    const std::lock_guard end_lock(end_mutex_);
    std::unique_lock lock(mutex_);
    verify(!destroyed_, XR_ERROR_HANDLE_INVALID);
    verify(lifecycle_.running(), XR_ERROR_SESSION_NOT_RUNNING);
    verify(begun_.has_value(), XR_ERROR_CALL_ORDER_INVALID);
    const FrameTime frame = *begun_;
    const XrViewConfigurationType configuration = configuration_;
    lock.unlock();

    TimingFile::End end{TimingFile::now(), info.layerCount, 0, {}};
    if (display_) {
        end.composition_ms =
            display_->show(frame, configuration, info.environmentBlendMode, read_layers(*this, info));
    }

    const Script& script = instance_->script();
    lock.lock();
    // Another thread may have begun the next frame meanwhile.
    if (begun_ && begun_->index == frame.index) begun_.reset();
    // The last frame of the script is on display: stop before the client waits for another.
    if (script.ended(frame.index + 1) && lifecycle_.running())
        lifecycle_.ask_to_stop(Lifecycle::Stop::ForGood);
    ++instance_->status().ended_frames;
    instance_->clock().end_frame(frame);
    instance_->wake_control();
    lock.unlock();
    end.missed_frames = instance_->clock().missed_frames();
    if (TimingFile* timing = instance_->timing()) timing->ended(frame, end);
}

}  // namespace foveray::simulator
