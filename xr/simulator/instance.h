#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <openxr/openxr.h>
#include <vulkan/vulkan.h>

#include "xr/simulator/api/failing_calls.h"
#include "xr/simulator/api/openxr_1_1.h"
#include "xr/simulator/control/control_socket.h"
#include "xr/simulator/debug_utils.h"
#include "xr/simulator/events.h"
#include "xr/simulator/frame_clock.h"
#include "xr/simulator/handles.h"
#include "xr/simulator/options.h"
#include "xr/simulator/paths.h"
#include "xr/simulator/script/script.h"
#include "xr/simulator/timing_file.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

class Action;

struct Extension {
    std::string_view name;
    std::uint32_t version;
};
/// All that the runtime offers; it depends on the variables: the kind of time, and the headset.
std::vector<Extension> supported_extensions();

/// OpenXR 1.1 where the headers have it, else 1.0, with the patch number of the headers.
constexpr XrVersion supported_api_version =
    XR_MAKE_VERSION(1, has_openxr_1_1 ? 1 : 0, XR_VERSION_PATCH(XR_CURRENT_API_VERSION));

/// What an instance's session is at; its newest one's. Safe to use from any thread.
struct Status {
    std::atomic<XrSessionState> state = XR_SESSION_STATE_UNKNOWN;  // unknown: there is no session
    std::atomic<bool> running = false;
    std::atomic<std::uint64_t> frame = 0;  // the newest one's index
    std::atomic<std::uint64_t> waited_frames = 0, ended_frames = 0, session_ends = 0;  // of all sessions
};

struct SuggestedBinding {
    std::shared_ptr<Action> action;
    XrPath path;
};

/// A client's connection to one simulated headset. Its environment variables are read when it is made. After
/// a loss the next one of the process goes on where the script was, if it has the same.
class Instance : public Object {
  public:
    using Handle = XrInstance;
    static constexpr XrObjectType object_type = XR_OBJECT_TYPE_INSTANCE;
    static constexpr XrSystemId system_id = 1;

    /// Throws Fault when the variables, the profile or the session are at fault.
    explicit Instance(std::set<std::string, std::less<>> features);
    /// Lets go of the suggested actions, which hold the instance.
    void on_destroy() override;

    /// Features are extensions and `openxr_1_1`; "" is the core of 1.0, which every instance has.
    bool has(std::string_view feature) const { return feature.empty() || features_.contains(feature); }
    const Options& options() const { return options_; }
    const Script& script() const { return script_; }
    Script& script() { return script_; }
    const HeadsetProfile& profile() const { return script_.profile(); }
    FrameClock& clock() { return clock_; }
    /// nullptr where none is kept.
    TimingFile* timing() { return timing_ ? &*timing_ : nullptr; }
    PathTable& paths() { return paths_; }

    std::vector<XrViewConfigurationType> view_configurations() const;
    std::vector<XrEnvironmentBlendMode> blend_modes() const;
    bool supports(XrViewConfigurationType type) const;

    Status& status() { return status_; }
    /// Does it when the script is played next, that is with the next frame; at once while no session runs.
    using Change = std::function<void(Nanoseconds session_time)>;
    void stage(Change change);
    void stage(ScriptedFault fault);
    /// The script was played, or a frame or session ended.
    void wake_control();

    /// Plays the script's faults up to a session time. Those that concern a session are the caller's.
    std::vector<ScriptedFault> play_faults(Nanoseconds time);
    /// Every call but the destruction answers XR_ERROR_INSTANCE_LOST.
    bool lost() const;
    /// The process's next instance goes on where this one leaves the script.
    void note_loss();
    FailingCalls& failing_calls() { return *failing_calls_; }
    /// The form factor is available. While it is not and there is no session, each question plays the script:
    /// in virtual time one period further, in real time up to now.
    bool is_plugged_in();
    /// The next wait for a swapchain's image runs out of time.
    bool take_swapchain_timeout();

    EventQueue& events() { return events_; }
    DebugUtils& debug() { return debug_; }

    /// The client made that Vulkan instance through the runtime.
    void remember_vulkan(VkInstance instance, VulkanLoader loader);
    VulkanLoader vulkan_loader(VkInstance instance) const;
    void graphics_requirements_asked() { graphics_requirements_asked_ = true; }
    bool were_graphics_requirements_asked() const { return graphics_requirements_asked_; }
    VkPhysicalDevice gpu(VkInstance instance);
    /// VK_NULL_HANDLE when `gpu` never gave that device.
    VkInstance vulkan_instance_of(VkPhysicalDevice device) const;

    /// By interaction profile path. Later suggestions for a profile replace earlier ones.
    void suggest(const std::string& interaction_profile, std::vector<SuggestedBinding> bindings);
    std::map<std::string, std::vector<SuggestedBinding>> suggestions() const;
    /// Names of living action sets: an atom of the API, unlike their handles.
    bool claim_name(const std::string& name, bool localized);
    void release_name(const std::string& name, bool localized);

    /// One session at a time.
    bool claim_session();
    void release_session();

  private:
    void play(const ScriptedFault& fault);
    void make_staged_changes(Nanoseconds time);

    std::set<std::string, std::less<>> features_;
    Options options_;
    Script script_;
    FrameClock clock_;
    std::optional<TimingFile> timing_;
    PathTable paths_;

    std::shared_ptr<FailingCalls> failing_calls_;
    std::atomic<Nanoseconds> lost_at_ = std::numeric_limits<Nanoseconds>::max();  // session time
    std::atomic<std::uint32_t> swapchain_timeouts_ = 0;

    std::mutex plug_mutex_;  // taken before mutex_
    Status status_;
    std::mutex staged_mutex_;
    std::vector<Change> staged_;

    EventQueue events_;
    DebugUtils debug_;
    std::atomic<bool> graphics_requirements_asked_ = false;
    mutable std::mutex mutex_;  // what follows
    std::map<VkInstance, VulkanLoader> vulkan_;
    std::map<VkPhysicalDevice, VkInstance> gpus_;
    bool destroyed_ = false;
    std::map<std::string, std::vector<SuggestedBinding>> suggestions_;
    std::set<std::pair<bool, std::string>> names_;
    bool has_session_ = false;
    Nanoseconds played_until_;  // session time
    bool loses_ = false;        // a loss was played or told

    std::mutex control_mutex_;
    std::unique_ptr<ControlSocket> control_;  // its thread uses all of the above
};

/// Refuses with XR_ERROR_HANDLE_INVALID or XR_ERROR_SYSTEM_INVALID.
std::shared_ptr<Instance> get_system(XrInstance instance, XrSystemId system);

}  // namespace foveray::simulator
