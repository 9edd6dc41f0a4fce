#pragma once

#include <optional>
#include <vector>

#include "base/frame.h"
#include "base/headset_profile.h"
#include "render/gpu/commands.h"
#include "xr/client/input.h"
#include "xr/client/instance.h"
#include "xr/client/swapchain.h"

namespace foveray::xr {

/// Finished pictures of one view, tightly packed, written by compute shaders.
struct ViewPicture {
    vk::Buffer color;  // sRGB-encoded premultiplied RGBA8
    vk::DeviceSize color_offset = 0;
    vk::Buffer depth;  // float, 0 near … 1 far
    vk::DeviceSize depth_offset = 0;
};

/// How the runtime should show our pictures.
struct Presentation {
    BlendMode blend = BlendMode::Opaque;  // falls back to what the runtime offers
    float near_z = 0.05f, far_z = 100.0f;
};

/// One XrSession with everything that lives and dies with it: spaces, swapchains, actions, hidden meshes. All
/// calls may throw Lost, and other Faults; the object is good for nothing then but to be destroyed.
class RuntimeSession {
  public:
    /// Instance and device outlive the session; the device is the runtime's choice.
    RuntimeSession(const Instance& instance, const gpu::Device& device, const Presentation& presentation);
    /// Ends a frame that was begun and not ended, showing nothing. The GPU must be done with the images.
    ~RuntimeSession();
    RuntimeSession(const RuntimeSession&) = delete;
    RuntimeSession& operator=(const RuntimeSession&) = delete;

    /// Takes the runtime's events in.
    void poll();
    /// The runtime wants frames.
    bool is_running() const { return begun_; }
    /// The runtime has no more use for the session.
    bool has_ended() const { return ended_; }
    /// Asks a running session to end; poll() gets there.
    void request_exit();
    /// The same, as far as it goes, from any thread.
    void wake() const;

    /// Blocks until the runtime wants a frame. Without index and session time; poses that are not tracked are
    /// left as the runtime gives them, and head_valid is false.
    Frame begin_frame();
    /// False, and nothing is recorded, when the runtime has no image free for too long.
    bool record_submission(const gpu::Commands& cmd, const Frame& frame,
                           const std::vector<ViewPicture>& pictures);
    void end_frame(const Frame& frame);

    const std::vector<HiddenMesh>& hidden_meshes() const { return hidden_meshes_; }
    HeadsetProfile profile(const Frame& frame) const;

  private:
    void on_state(XrSessionState state);
    void make_spaces();
    void make_swapchains();
    void read_hidden_mesh(std::uint32_t view);
    bool rendering_gaze_is_available(XrTime time) const;
    struct LocatedViews {
        std::vector<View> views;
        bool valid = false;
    };
    LocatedViews locate_views(XrTime time, bool foveated) const;
    void release_images();

    const Instance& instance_;
    const gpu::Device& device_;
    Presentation presentation_;
    SessionHandle session_;
    bool begun_ = false, ended_ = false;

    SpaceHandle stage_, head_, rendering_gaze_;
    Input input_;
    std::vector<uvec2> sizes_, foveated_sizes_;
    std::vector<View> fixed_views_;  // as they are when they do not follow the gaze, of one frame
    std::vector<Swapchain> color_, depth_;
    std::vector<HiddenMesh> hidden_meshes_;
    std::optional<XrTime> open_frame_;  // begun and not ended: its display time
    bool submission_recorded_ = false;
};

}  // namespace foveray::xr
