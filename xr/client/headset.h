#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/frame.h"
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
    /// Always called after begin_frame; shows nothing when nothing was recorded.
    void end_frame(const Frame& frame);

    /// Per view of Frame::views; the vector stays empty where the runtime has no mask.
    const std::vector<HiddenMesh>& hidden_meshes() const { return hidden_meshes_; }
    /// The size of each view's largest picture.
    const std::vector<uvec2>& largest_sizes() const { return largest_sizes_; }

  private:
    void on_state(XrSessionState state);
    void make_spaces();
    void make_swapchains();
    void read_hidden_meshes();
    bool rendering_gaze_is_available(XrTime time) const;

    std::unique_ptr<Instance> instance_;
    bool is_simulator_ = false;
    std::optional<std::uint32_t> simulator_gpu_;
    SessionHandle session_;
    State state_ = State::Waiting;
    bool begun_ = false;
    BlendMode blend_ = BlendMode::Opaque;
    float near_z_ = 0.05f, far_z_ = 100.0f;

    SpaceHandle stage_, head_, rendering_gaze_;
    Input input_;
    std::vector<uvec2> sizes_, foveated_sizes_, largest_sizes_;
    std::vector<Swapchain> color_, depth_;
    std::vector<HiddenMesh> hidden_meshes_;
    std::uint64_t frame_index_ = 0;
    Nanoseconds first_display_time_ = 0;
    bool submission_recorded_ = false;
    // Held while tracking is lost.
    std::vector<View> last_views_;
    Pose last_head_;
};

}  // namespace foveray::xr
