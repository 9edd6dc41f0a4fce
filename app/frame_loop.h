#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "app/head_history.h"
#include "app/report/run_report.h"
#include "base/frame.h"
#include "base/headset_profile.h"
#include "passthrough/camera_source.h"
#include "passthrough/compositor.h"
#include "render/accel_scene.h"
#include "render/foveation.h"
#include "render/gpu_scene.h"
#include "render/history.h"
#include "render/lighting.h"
#include "render/primary.h"
#include "render/probes.h"
#include "render/ray_counters.h"
#include "render/ray_pipeline.h"
#include "render/resolve.h"
#include "render/sampling.h"
#include "render/shadows.h"
#include "xr/client/headset.h"

namespace foveray::app {

struct FrameLoopSetup {
    const gpu::Device& device;
    xr::Headset& headset;  // started
    const scene::Scene& scene;
    passthrough::CameraSource* camera = nullptr;  // null: none
    std::optional<passthrough::Calibration> calibration;
    std::optional<Acuity> acuity;  // empty: made from the first frame's views
    bool every_pixel = false;      // --reference
    std::uint32_t frames_in_flight = 1;
    render::UserShaders user_shaders = {};  // of the scene's user shapes
};

/// The stages of a frame and the order they run in: docs/architecture.md, "A frame". Replay and view share
/// it.
class FrameLoop {
  public:
    explicit FrameLoop(const FrameLoopSetup& setup);
    ~FrameLoop() { wait(); }  // the stages' buffers may still be in use

    struct Step {
        Frame frame;
        bool rendered = false;
        render::ViewImages images;  // good until the next step
    };
    using SettingsOf = std::function<Settings(const Frame&)>;
    /// One frame, from the runtime's wait to its end. A frame that is rendered gets its settings once it is
    /// known. `pointer` (0..1 over the left eye's context view, from the top left) stands in for the gaze
    /// where the headset has no eye tracking. Throws Fault.
    Step step(const SettingsOf& settings_of, std::optional<vec2> pointer = {});
    Step step(const Settings& settings) {
        return step([&](const Frame&) { return settings; });
    }

    /// What the frames could trace with if users' shapes were these. May be called on any thread.
    render::RayPipeline make_pipeline(const render::UserShaders& user_shaders) const;
    /// Frames trace with such a pipeline from here on. Waits for those that trace with the old one.
    void use(render::RayPipeline pipeline);

    /// Waits until the GPU has finished everything.
    void wait();
    /// Of the newest frame known to be finished on the GPU; after wait(), of the last step that rendered.
    /// Empty before the first.
    const std::optional<FrameMetrics>& metrics() const { return finished_; }

  private:
    passthrough::RoomMoment room_moment(const Frame& frame);
    void collect_metrics(std::uint32_t slot);

    const gpu::Device& device_;
    xr::Headset& headset_;
    const scene::Scene& scene_;
    passthrough::CameraSource* camera_;
    bool every_pixel_;
    std::optional<Acuity> acuity_;
    Pose world_from_stage_;
    HeadHistory head_history_;

    gpu::FrameRing ring_;
    gpu::TextureTable textures_;
    render::RayCounters counters_;
    render::RayPipeline pipeline_;
    scene::SceneAnimator animator_;
    render::GpuScene gpu_scene_;
    render::AccelScene accel_scene_;
    passthrough::RoomStage room_;
    render::Foveation foveation_;
    render::ProbeStage probes_;
    render::SamplingStage sampling_;
    render::PrimaryStage primary_;
    render::ShadowStage shadows_;
    render::LightingStage lighting_;
    render::HistoryStage history_;
    render::ResolveStage resolve_;
    passthrough::Compositor compositor_;

    struct Submitted {
        Frame frame;
        uvec2 polar_size{0};
        double cpu_ms = 0.0;
    };
    std::vector<std::optional<Submitted>> submitted_;  // by slot, until their metrics are collected
    std::optional<FrameMetrics> finished_;
};

/// What to take a headset of unknown make to resolve: HERR's acuity, capped at the density of its views.
Acuity acuity_for(const std::vector<View>& views);

}  // namespace foveray::app
