#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/head_history.h"
#include "app/report/run_report.h"
#include "base/frame.h"
#include "base/headset_profile.h"
#include "passthrough/camera_source.h"
#include "passthrough/compositor.h"
#include "render/foveation.h"
#include "render/history.h"
#include "render/lighting.h"
#include "render/live_scene.h"
#include "render/primary.h"
#include "render/probes.h"
#include "render/ray_counters.h"
#include "render/resolve.h"
#include "render/sampling.h"
#include "render/shadows.h"
#include "xr/client/headset.h"

namespace foveray::app {

struct FrameLoopSetup {
    const gpu::Device& device;
    xr::Headset& headset;  // started
    std::shared_ptr<const scene::Scene> scene;
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
    FrameLoop(const FrameLoop&) = delete;
    FrameLoop& operator=(const FrameLoop&) = delete;

    struct Step {
        Frame frame;
        bool rendered = false;
        render::ViewImages images;  // good until the next step
    };
    using SettingsOf = std::function<Settings(const Frame&)>;
    /// One frame, from the runtime's wait to its end. A frame that is rendered gets its settings once it is
    /// known. `pointer` (0..1 over the left eye's context view, from the top left) stands in for the gaze
    /// where the headset has no eye tracking. Empty: the runtime lost the session before. Throws Fault.
    std::optional<Step> step(const SettingsOf& settings_of, std::optional<vec2> pointer = {});
    std::optional<Step> step(const Settings& settings) {
        return step([&](const Frame&) { return settings; });
    }

    /// Another scene, or the same with other users' shapes, for show(): on any thread, but not beside it.
    render::LiveScene::Next prepare(std::shared_ptr<const scene::Scene> scene,
                                    const render::UserShaders& user_shaders) const {
        return live_.prepare(std::move(scene), user_shaders);
    }
    /// Steps from the next one on show it. Time goes on, and so does what is the same: probes that stay where
    /// they were, what earlier frames saw of things that are still there.
    void show(render::LiveScene::Next next);
    /// As LiveScene::content().
    std::shared_ptr<const void> content() const { return live_.content(); }

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
    passthrough::CameraSource* camera_;
    bool every_pixel_;
    std::optional<Acuity> acuity_;
    Pose world_from_stage_;
    HeadHistory head_history_;

    gpu::TextureTable textures_;
    gpu::FrameRing ring_;  // what it releases has entries in the table
    render::RayCounters counters_;
    render::LiveScene live_;
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
