#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

#include <openxr/openxr.h>

#include "xr/simulator/display/display.h"
#include "xr/simulator/handles.h"
#include "xr/simulator/input/devices.h"
#include "xr/simulator/input/inputs.h"
#include "xr/simulator/instance.h"
#include "xr/simulator/lifecycle.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

class Session : public Object {
  public:
    using Handle = XrSession;
    static constexpr XrObjectType object_type = XR_OBJECT_TYPE_SESSION;

    /// Without a device it is headless. Refuses with XR_ERROR_LIMIT_REACHED while the instance has another,
    /// and with XR_ERROR_GRAPHICS_DEVICE_INVALID when frames are captured and the client's queue cannot
    /// compose them.
    Session(std::shared_ptr<Instance> instance, std::unique_ptr<VulkanDevice> device);
    void on_destroy() override;
    /// Announces IDLE and READY; once, after the handle exists.
    void start();

    Instance& instance() const { return *instance_; }
    bool headless() const { return !device_; }
    /// Not of headless sessions.
    VulkanDevice& device() const { return *device_; }
    DebugLabels& labels() { return labels_; }
    const DebugLabels& labels() const { return labels_; }
    Inputs& inputs() { return inputs_; }
    const Inputs& inputs() const { return inputs_; }
    Devices& devices() { return devices_; }
    const Devices& devices() const { return devices_; }
    bool running() const;
    bool focused() const;
    /// Views of the configuration that the session was begun with.
    std::uint32_t view_count() const { return view_count_; }
    /// The script may take the visibility mask away.
    bool has_visibility_mask() const { return has_visibility_mask_; }
    /// Every call but the destruction answers XR_ERROR_SESSION_LOST.
    bool lost() const { return lost_; }
    /// It will be lost in a while: calls that succeed answer XR_SESSION_LOSS_PENDING.
    bool gives_notice() const { return gives_notice_; }

    void begin(XrViewConfigurationType configuration);
    void end();
    void request_exit();

    struct WaitedFrame {
        FrameTime time;
        bool should_render = false;
    };
    /// Blocks until the frame before was begun. Plays the script up to the new frame.
    WaitedFrame wait_frame();
    /// Plays the script up to now in a running headless session whose client waits for no frames.
    void play_without_frames();
    /// XR_SUCCESS, or XR_FRAME_DISCARDED when a begun frame was not ended.
    XrResult begin_frame();
    void end_frame(const XrFrameEndInfo& info);
    /// Waits until nobody reads the swapchain's images but the client.
    void release_images(const Swapchain& swapchain);

  private:
    void announce(XrSessionState state);
    void note_running(bool running);
    void play_script(const FrameTime& frame);
    void play(const ScriptedFault& fault);
    void lose(Nanoseconds at);
    void verify_not_lost();
    void change_visibility_mask(bool has_mask);
    void announce_recentring(XrReferenceSpaceType type, Nanoseconds time, const Pose& previous_from_next);
    void announce_presence();

    std::shared_ptr<Instance> instance_;
    std::unique_ptr<VulkanDevice> device_;
    DebugLabels labels_;
    Devices devices_;
    Inputs inputs_;
    std::optional<Display> display_;  // not of headless sessions

    std::mutex end_mutex_;  // one xrEndFrame at a time; taken before mutex_
    std::atomic<std::uint32_t> view_count_ = 0;
    std::atomic<bool> has_visibility_mask_ = true, lost_ = false, gives_notice_ = false;
    mutable std::mutex mutex_;  // what follows
    std::condition_variable frame_taken_;
    Lifecycle lifecycle_;
    XrViewConfigurationType configuration_ = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    bool destroyed_ = false, waiting_ = false, has_frames_ = false;
    std::optional<FrameTime> waited_, begun_;
    std::optional<Nanoseconds> lost_at_;  // session time
    Nanoseconds compositor_frame_ = 0;
    std::stop_source no_wait_;  // a session that ends needs no steps
    bool user_present_ = true;
};

}  // namespace foveray::simulator
