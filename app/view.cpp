#include <chrono>
#include <thread>
#include <utility>

#include "app/commands.h"
#include "app/frame_loop.h"
#include "app/inputs.h"
#include "app/interrupt.h"
#include "app/mirror/mirror.h"
#include "app/program.h"
#include "app/quality_control.h"
#include "app/scene_reload.h"
#include "app/session_recorder.h"
#include "app/wake_on_interrupt.h"
#include "base/log.h"

namespace foveray::app {
namespace {

/// What is known of the headset before its first frame; a runtime's own headset tells no acuity.
std::optional<HeadsetProfile> profile_of(const ViewOptions& options, const xr::Headset& headset,
                                         const std::string& simulated) {
    if (options.headset) return read_headset_profile(*options.headset);
    if (headset.is_simulator()) return read_headset_profile(simulated);
    return std::nullopt;
}

/// `headset`: empty for a runtime's own, which tells its views with the first frame.
Session recording_header(const ViewOptions& options, const Inputs& inputs, const std::string& headset) {
    Session header;
    header.headset = headset;
    header.scene = std::filesystem::absolute(inputs.scene_file);
    if (inputs.camera) header.camera = std::filesystem::absolute(inputs.camera_name);
    if (options.calibration) header.calibration = std::filesystem::absolute(*options.calibration);
    return header;
}

std::vector<Mirror::Picture> mirror_pictures(const FrameLoop::Step& step) {
    std::vector<Mirror::Picture> pictures;
    for (std::size_t i = 0; i < step.images.buffers.size(); ++i) {
        pictures.push_back({step.frame.views[i], step.images.buffers[i].color->vk()});
    }
    return pictures;
}

void record(SessionRecorder& recorder, const xr::Headset& headset, const Frame& frame,
            const std::optional<HeadsetProfile>& known) {
    if (!recorder.knows_headset() && frame.head_valid) {
        HeadsetProfile profile = headset.profile(frame);
        profile.acuity = known ? known->acuity : acuity_for(frame.views);
        recorder.set_headset(profile);
    }
    recorder.add(frame);
}

}  // namespace

ExitCode run_view(const ViewOptions& options) {
    Inputs inputs = load_inputs(options, nullptr);
    xr::SimulatorOptions simulator;
    simulator.profile = options.headset.value_or("ci");
    simulator.gpu = options.gpu;
    xr::Headset headset(options.runtime, simulator);
    const auto profile = profile_of(options, headset, simulator.profile);
    if (options.record) SessionRecorder::require_place(*options.record);

    std::optional<DesktopWindow> window;
    if (options.mirror) window.emplace("foveray");
    gpu::DeviceOptions device_options;
    if (window) {
        device_options.presentation = true;
        device_options.instance_extensions = window->instance_extensions();
    }
    device_options.validation = validation_wanted();
    const gpu::Device device(device_options, headset.device_source());
    const xr::StopAtEnd stop_at_end(headset);
    Settings settings = options.settings;
    const bool over_camera = inputs.camera || !settings.camera_blend;
    headset.start(device, over_camera ? BlendMode::Opaque : BlendMode::AlphaBlend, settings.near_m,
                  settings.far_m);
    FrameLoop loop({device, headset, inputs.scene, inputs.camera ? inputs.camera->source.get() : nullptr,
                    inputs.camera ? std::optional(inputs.camera->calibration) : std::nullopt,
                    profile ? std::optional(profile->acuity) : std::nullopt, false, 2, inputs.user_shaders});
    SceneReload reload(inputs, loop);
    std::optional<Mirror> mirror;
    if (window) mirror.emplace(device, *window);
    catch_interrupts();  // from here on there is a recording to finish
    std::optional<SessionRecorder> recorder;
    if (options.record) {
        recorder.emplace(*options.record,
                         recording_header(options, inputs, headset.is_simulator() ? simulator.profile : ""));
    }
    log::info("{} on {}; Ctrl-C ends", headset.instance().system_name(), device.name());
    bool exit_requested = false, scene_changed = false;
    QualityControl quality;
    const auto show_frames = [&] {
        for (auto state = headset.poll(); state != xr::Headset::State::Ended; state = headset.poll()) {
            if ((interrupted() || (mirror && mirror->wants_close())) && !exit_requested) {
                headset.request_exit();
                exit_requested = true;
                continue;
            }
            if (state == xr::Headset::State::Lost) {
                loop.wait();
                headset.reconnect();
                continue;
            }
            if (state == xr::Headset::State::Waiting) {
                if (mirror) mirror->show({}, {}, false, settings);
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
                continue;
            }
            scene_changed = reload.show() || scene_changed;
            std::optional<Session::QualitySample> traced_with;
            const auto settings_of = [&](const Frame& frame) {
                const Settings used = quality.choose(settings, frame, loop.metrics());
                traced_with = quality_sample(used, frame.time);
                return used;
            };
            const auto step = loop.step(settings_of, mirror ? mirror->pointer() : std::nullopt);
            if (!step) continue;
            if (mirror && step->rendered) {
                mirror->show(mirror_pictures(*step), loop.metrics().value_or(FrameMetrics{}),
                             headset.instance().has_eye_tracking(), settings);
            }
            if (recorder) record(*recorder, headset, step->frame, profile);
            if (recorder && std::exchange(scene_changed, false)) recorder->add_scene_change(step->frame);
            if (recorder && traced_with) recorder->add(*traced_with);
        }
    };
    try {
        const WakeOnInterrupt wake_on_interrupt(headset);
        show_frames();
    } catch (...) {
        // What was recorded until then is worth keeping.
        if (recorder) recorder->finish();
        throw;
    }
    loop.wait();
    headset.stop();
    if (recorder) recorder->finish();
    return device.validation_messages().empty() ? ExitCode::Done : ExitCode::Internal;
}

}  // namespace foveray::app
