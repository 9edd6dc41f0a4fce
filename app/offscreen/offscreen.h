#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/headset_profile.h"
#include "base/image.h"
#include "base/settings.h"
#include "passthrough/compositor.h"
#include "render/history.h"
#include "render/lighting.h"
#include "render/live_scene.h"
#include "render/primary.h"
#include "render/probes.h"
#include "render/ray_counters.h"
#include "render/resolve.h"
#include "render/sampling.h"
#include "render/shadows.h"

namespace foveray::app {

/// A frame without a headset. World and stage are the same.
struct Shot {
    std::vector<View> views;
    std::vector<HiddenMesh> hidden;  // by view; empty: everything is seen
    bool every_pixel = true;         // else polar images round `gaze`, an eye each
    Acuity acuity;
    vec3 gaze_origin{0.0f};
    vec3 gaze_direction{0.0f, 0.0f, -1.0f};
    Nanoseconds time = 0;
    Settings settings;
    // Not 0: so many of the frame's rays are kept, and traced once more at its end without shading: stage
    // "bare". The other stages' times are not to be trusted then.
    std::uint32_t bare_rays = 0;
};

/// What a frame cost.
struct ShotCost {
    std::vector<gpu::StageTime> stages;
    render::RayCounts rays{};
    double cpu_ms = 0.0;  // recording and submission
};

/// The stages of a picture over one scene, without headset and camera: for benchmarks, golden pictures and
/// tests of the whole. The frame that a wearer sees is FrameLoop's.
class Offscreen {
  public:
    /// The scene must outlive this. `user_shaders`: of the scene's user shapes.
    Offscreen(const gpu::Device& device, const scene::Scene& scene, std::uint32_t frames_in_flight = 2,
              const render::UserShaders& user_shaders = {});
    Offscreen(const gpu::Device& device, std::shared_ptr<const scene::Scene> scene,
              std::uint32_t frames_in_flight = 2, const render::UserShaders& user_shaders = {});
    ~Offscreen() { ring_.wait(); }

    /// Another scene, in this one's place from the next draw() on: LiveScene says on which threads.
    render::LiveScene::Next prepare(std::shared_ptr<const scene::Scene> scene,
                                    const render::UserShaders& user_shaders = {}) const {
        return live_.prepare(std::move(scene), user_shaders);
    }
    void show(render::LiveScene::Next next);

    /// Records and submits a frame. Empty until a frame in the same slot has finished, then that frame's
    /// cost.
    std::optional<ShotCost> draw(const Shot& shot);
    /// Waits for everything, and returns the cost of what draw() has not told of yet, oldest first.
    std::vector<ShotCost> finish();
    /// A view of the last frame as the compositor leaves it, over the scene's environment; RGBA, sRGB. Waits.
    Image picture(std::size_t view);

  private:
    std::optional<ShotCost> collect(std::uint32_t slot);
    void empty_log(const gpu::Commands& cmd, std::uint32_t most);
    void trace_bare(const gpu::Commands& cmd);

    const gpu::Device& device_;
    gpu::TextureTable textures_;
    gpu::FrameRing ring_;  // what it releases has entries in the table
    render::RayCounters counters_;
    render::LiveScene live_;
    passthrough::RoomStage room_;
    render::ProbeStage probes_;
    render::SamplingStage sampling_;
    render::PrimaryStage primary_;
    render::ShadowStage shadows_;
    render::LightingStage lighting_;
    render::HistoryStage history_;
    render::ResolveStage resolve_;
    passthrough::Compositor compositor_;
    render::ViewImages images_;
    gpu::Buffer ray_log_;
    std::uint64_t frame_ = 0;
    std::vector<std::optional<double>> pending_cpu_ms_;  // by slot: its frame's cost is not told yet
};

/// Where the scene's first camera stands at time 0. Empty: it has none.
std::optional<Pose> camera_pose(const scene::Scene& scene);
/// One view of that camera; of a scene without one, from the origin along -z with 50 degrees of height.
View camera_view(const scene::Scene& scene, uvec2 size);
/// The views of a headset whose head is at that camera, or at the origin.
std::vector<View> headset_views(const scene::Scene& scene, const HeadsetProfile& profile);

/// Makes the polar images so many samples wide (radial) and high (angular), whatever the acuity.
void set_polar_size(Shot& shot, uvec2 size);

}  // namespace foveray::app
