#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "xr/client/runtime_choice.h"
#include "xr/client/runtime_session.h"

namespace foveray::xr {

/// The headset through OpenXR, from first event to exit, over as many sessions and instances as the runtime
/// makes of it.
///
///     Headset headset(RuntimeChoice::Auto, simulator_options);
///     gpu::Device device(options, headset.device_source());
///     headset.start(device, blend, near_z, far_z);
///     for (auto state = headset.poll(); state != Headset::State::Ended; state = headset.poll()) {
///         if (state == Headset::State::Waiting) …sleep a little, continue…
///         if (state == Headset::State::Lost) …wait for the GPU, headset.reconnect(), continue…
///         if (auto frame = headset.begin_frame()) {
///             …record…, headset.record_submission(cmd, *frame, pictures), submit
///             headset.end_frame(*frame);
///         }
///     }
class Headset {
  public:
    enum class State {
        Waiting,  // nothing to do yet: poll again in a while
        Running,  // the runtime wants frames
        Lost,     // the runtime lost the session: reconnect() once the GPU is done with its images
        Ended,
    };
    using Clock = std::chrono::steady_clock;
    /// How long a headset is waited for that is away at the start (but not by Auto), or was lost.
    struct Patience {
        std::chrono::milliseconds in_all{10'000}, between_attempts{200};
    };

    /// Auto takes the system's runtime if one answers and has a headset; else it says why and takes the
    /// simulator.
    Headset(RuntimeChoice choice, const SimulatorOptions& simulator)
        : Headset(choice, simulator, Patience()) {}
    Headset(RuntimeChoice choice, const SimulatorOptions& simulator, const Patience& patience);
    ~Headset();

    const Instance& instance() const { return *instance_; }
    bool is_simulator() const { return is_simulator_; }
    gpu::DeviceSource device_source() const;

    /// The device must come from device_source() and outlive the session. `blend`: how the runtime should mix
    /// our picture with the world; falls back to what it offers.
    void start(const gpu::Device& device, BlendMode blend, float near_z, float far_z);
    /// Ends the session, and first, showing nothing, a frame that was begun and not ended. The GPU must be
    /// done with the runtime's images. Does nothing a second time.
    void stop();

    /// Throws Fault(Missing) when the runtime fails, or a lost headset does not come back.
    State poll();
    /// In State::Lost. The same headset is looked for by later poll()s: State::Waiting, until it shows frames
    /// again. The device stays; session time goes on where a new instance begins.
    void reconnect();
    /// Asks the runtime to end the session; poll() gets there, within a second whatever the runtime does.
    void request_exit();
    /// From another thread, while begin_frame() waits for a frame that does not come: asks the runtime to end
    /// the session, which is to bring it back.
    void wake();

    /// Blocks until the runtime wants the next frame. Empty: it lost the session instead.
    std::optional<Frame> begin_frame();
    /// Records the copies into the runtime's images; call once between begin_frame and submitting the
    /// commands.
    void record_submission(const gpu::Commands& cmd, const Frame& frame,
                           const std::vector<ViewPicture>& pictures);
    /// Always called after begin_frame, unless an exception ends the session; shows nothing when nothing was
    /// recorded, or the runtime had no image free.
    void end_frame(const Frame& frame);

    /// Per view of Frame::views; the vector stays empty where the runtime has no mask.
    const std::vector<HiddenMesh>& hidden_meshes() const { return session_->hidden_meshes(); }
    /// The headset as the runtime tells it at `frame`, the last one begun: for sessions recorded with it.
    /// Acuity is not the runtime's to tell.
    HeadsetProfile profile(const Frame& frame) const { return session_->profile(frame); }

  private:
    void wait_for_headset();
    void connect();
    void require_same_headset() const;
    void take_session(std::unique_ptr<RuntimeSession> session);
    template <typename Call>
    void unless_lost(Call&& call);

    Patience patience_;
    std::unique_ptr<Instance> instance_;
    bool is_simulator_ = false;
    std::optional<std::uint32_t> simulator_gpu_;
    const gpu::Device* device_ = nullptr;  // once started
    Presentation presentation_;
    std::string system_name_;
    XrViewConfigurationType view_configuration_ = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    std::mutex session_mutex_;                 // between wake() and what changes the pointer
    std::unique_ptr<RuntimeSession> session_;  // null while there is none

    std::optional<Lost> loss_;  // of the session, until reconnect()
    bool instance_is_lost_ = false;
    std::optional<Clock::time_point> away_since_;  // the first loss since a frame was shown
    Clock::time_point next_attempt_{};
    std::string last_refusal_;
    std::optional<Clock::time_point> leave_by_;  // once the exit was requested

    std::uint64_t frame_index_ = 0;
    std::optional<Nanoseconds> clock_start_;  // the instance's time of the session time 0
    Nanoseconds next_time_ = 0;               // session time after the last frame
    bool image_is_late_ = false;
    // Held while tracking is lost.
    std::vector<View> last_views_;
    Pose last_head_;
};

/// Stops the headset at the end of its scope, whatever ends it. Declare it after the device and before what
/// works on the GPU, so that it goes between them.
class StopAtEnd {
  public:
    explicit StopAtEnd(Headset& headset) : headset_(headset) {}
    ~StopAtEnd() { headset_.stop(); }
    StopAtEnd(const StopAtEnd&) = delete;
    StopAtEnd& operator=(const StopAtEnd&) = delete;

  private:
    Headset& headset_;
};

}  // namespace foveray::xr
