#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/frame.h"
#include "base/headset_profile.h"
#include "render/gpu/commands.h"
#include "xr/client/input.h"
#include "xr/client/instance.h"
#include "xr/client/runtime_choice.h"
#include "xr/client/swapchain.h"

namespace foveray::xr {

/// Finished pictures of one view, tightly packed, written by compute shaders.
struct ViewPicture {
    vk::Buffer color;  // sRGB-encoded premultiplied RGBA8
    vk::DeviceSize color_offset = 0;
    vk::Buffer depth;  // float, 0 near … 1 far
    vk::DeviceSize depth_offset = 0;
};

/// The headset through OpenXR: one instance, one session, from first event to exit.
///
///     Headset headset(RuntimeChoice::Auto, simulator_options);
///     gpu::Device device(options, headset.device_source());
///     headset.start(device);
///     while (headset.poll() != Headset::State::Ended) {
///         Frame frame = headset.begin_frame();   // only in State::Running
///         …record…, headset.record_submission(cmd, frame, pictures), submit
///         headset.end_frame(frame);
///     }
class Headset {
  public:
    enum class State {
        Waiting,  // the runtime does not want frames yet: poll again in a while
        Running,
        Ended,
    };

    /// Auto takes the system's runtime if one answers and has a headset; else it says why and takes the
    /// simulator.
    Headset(RuntimeChoice choice, const SimulatorOptions& simulator);
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

    State poll();
    /// Asks the runtime to end the session; poll() gets there.
    void request_exit();

    /// Blocks until the runtime wants the next frame.
    Frame begin_frame();
    /// Records the copies into the runtime's images; call once between begin_frame and submitting the
    /// commands.
    void record_submission(const gpu::Commands& cmd, const Frame& frame,
                           const std::vector<ViewPicture>& pictures);
    /// Always called after begin_frame, unless an exception ends the session; shows nothing when nothing was
    /// recorded.
    void end_frame(const Frame& frame);

    /// Per view of Frame::views; the vector stays empty where the runtime has no mask.
    const std::vector<HiddenMesh>& hidden_meshes() const { return hidden_meshes_; }
    /// The headset as the runtime tells it at `frame`, after begin_frame: for sessions recorded with it.
    /// Acuity is not the runtime's to tell.
    HeadsetProfile profile(const Frame& frame) const;

  private:
    void on_state(XrSessionState state);
    void make_spaces();
    void make_swapchains();
    void read_hidden_mesh(std::uint32_t view);
    struct LocatedViews {
        std::vector<View> views;
        bool valid = false;
    };
    LocatedViews locate_views(XrTime time, bool foveated) const;
    void abandon_frame();
    void release_images();
    bool rendering_gaze_is_available(XrTime time) const;

    std::unique_ptr<Instance> instance_;
    bool is_simulator_ = false;
    std::optional<std::uint32_t> simulator_gpu_;
    const gpu::Device* device_ = nullptr;  // while there is a session
    SessionHandle session_;
    State state_ = State::Waiting;
    bool begun_ = false;
    BlendMode blend_ = BlendMode::Opaque;
    float near_z_ = 0.05f, far_z_ = 100.0f;

    SpaceHandle stage_, head_, rendering_gaze_;
    Input input_;
    std::vector<uvec2> sizes_, foveated_sizes_;
    std::vector<Swapchain> color_, depth_;
    std::vector<HiddenMesh> hidden_meshes_;
    std::uint64_t hidden_mesh_version_ = 0;
    std::uint64_t frame_index_ = 0;
    std::optional<XrTime> open_frame_;  // begun and not ended: its display time
    Nanoseconds first_display_time_ = 0;
    bool submission_recorded_ = false;
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
