#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>
#include <thread>

#include "app/commands.h"
#include "app/frame_loop.h"
#include "app/gaze_mark.h"
#include "app/inputs.h"
#include "app/interrupt.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/quality_control.h"
#include "app/wake_on_interrupt.h"
#include "base/log.h"
#include "base/staged_folder.h"
#include "passthrough/capture/video_writer.h"

namespace foveray::app {
namespace {

namespace fs = std::filesystem;

FrameRange written_frames(const ReplayOptions& options, const Session& session) {
    const FrameRange all{0, session.frames};
    if (!options.frames) return all;
    if (options.frames->first >= options.frames->end || options.frames->end > all.end) {
        throw_bad_input("--frames", "the session has frames 0 to " + std::to_string(all.end),
                        "write A:B with 0 <= A < B <= " + std::to_string(all.end));
    }
    return *options.frames;
}

/// Collects the left eye's captured pictures into a video, with a ring round the gaze.
class Video {
  public:
    Video(const fs::path& folder, double rate_hz) : folder_(folder), rate_hz_(rate_hz) {}

    void add(const FrameMetrics& metrics) {
        char name[40];
        std::snprintf(name, sizeof name, "frame_%05llu_left.png",
                      static_cast<unsigned long long>(metrics.index));
        Image picture = read_image(folder_ / "frames" / name, 3);
        if (metrics.gaze_mark[0]) draw_gaze_mark(picture, *metrics.gaze_mark[0], metrics.gaze_valid);
        if (!writer_) writer_.emplace(folder_ / "video.mp4", picture.width, picture.height, rate_hz_);
        writer_->write(picture);
    }
    void finish() {
        if (writer_) writer_->finish();
    }

  private:
    fs::path folder_;
    double rate_hz_;
    std::optional<passthrough::VideoWriter> writer_;
};

void warn_of_edits(const Session& session) {
    const auto edits = std::ranges::count(session.events, scene_changed_event, &Session::Event::name);
    if (edits == 0) return;
    log::warn("{}: the scene was edited {} times while this was recorded; the replay shows it as it is now",
              session.folder.string(), edits);
}

}  // namespace

ExitCode run_replay(const ReplayOptions& options) {
    const Session session = read_session(options.session);
    const HeadsetProfile profile = read_headset_profile(options.headset.value_or(session.headset));
    const FrameRange range = written_frames(options, session);
    Inputs inputs = load_inputs(options, &session);
    warn_of_edits(session);
    StagedFolder out(options.out, "report.html");

    xr::SimulatorOptions simulator;
    simulator.profile = options.headset.value_or(session.headset);
    simulator.session = session.folder;
    simulator.virtual_time = true;
    simulator.capture = out.path() / "frames";
    simulator.capture_frames = {range.first, range.end};
    simulator.gpu = options.gpu;
    const bool simulated = options.runtime == xr::RuntimeChoice::Simulator;
    xr::Headset headset(options.runtime, simulator);
    gpu::DeviceOptions device_options;
    device_options.validation = validation_wanted();
    const gpu::Device device(device_options, headset.device_source());
    const xr::StopAtEnd stop_at_end(headset);
    const bool over_camera = inputs.camera || !options.settings.camera_blend;
    headset.start(device, over_camera ? BlendMode::Opaque : BlendMode::AlphaBlend, options.settings.near_m,
                  options.settings.far_m);

    FrameLoop loop({device, headset, inputs.scene, inputs.camera ? inputs.camera->source.get() : nullptr,
                    inputs.camera ? std::optional(inputs.camera->calibration) : std::nullopt,
                    simulated ? std::optional(profile.acuity) : std::nullopt, options.reference, 1,
                    inputs.user_shaders});
    std::vector<FrameMetrics> frames;
    std::vector<uvec2> view_sizes;
    Video video(out.path(), session.rate_hz);
    Progress progress(std::cerr, Progress::style_for(options.json), "frames", range.end);
    catch_interrupts();
    const WakeOnInterrupt wake_on_interrupt(headset);
    std::uint64_t done = 0;
    while (done < range.end && !interrupted()) {
        const auto state = headset.poll();
        if (state == xr::Headset::State::Ended || state == xr::Headset::State::Lost) break;
        if (state == xr::Headset::State::Waiting) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            continue;
        }
        const auto step = loop.step(
            [&](const Frame& frame) { return replay_settings(options.settings, session, frame.time); });
        loop.wait();
        if (!step) continue;
        done = step->frame.index + 1;
        if (step->rendered && step->frame.index >= range.first) {
            frames.push_back(*loop.metrics());
            if (simulated) video.add(frames.back());
            for (std::size_t i = view_sizes.size(); i < step->frame.views.size(); ++i) {
                view_sizes.push_back(step->frame.views[i].size);
            }
        }
        progress.update(done);
    }
    progress.finish();
    headset.stop();
    if (interrupted()) {
        log::warn("interrupted: nothing was written");
        return ExitCode::Interrupted;
    }
    if (frames.empty()) {
        throw_bad_input(options.session.string(), "the headset showed none of its frames",
                        "do its events end or hide the session before them?");
    }
    if (done < range.end) log::warn("the session ended after frame {} of {}", done, range.end);
    video.finish();

    RunInfo run;
    run.title = fs::absolute(options.session).lexically_normal().filename().string();
    run.session = options.session.string();
    run.scene = inputs.scene_file.string();
    run.camera = inputs.camera_name;
    run.headset = profile.name;
    run.rate_hz = session.rate_hz;
    run.view_sizes = view_sizes;
    run.reference = options.reference;
    run.device = device.name();
    run.driver = device.driver();
    run.openxr_runtime = headset.instance().runtime_name();
    run.settings = options.settings;
    write_report(out.path(), run, frames);
    out.commit();

    if (options.json) {
        std::cout << summarize(run, frames).dump(2) << '\n';
    } else {
        std::cout << (out.target() / "report.html").string() << '\n';
    }
    return device.validation_messages().empty() ? ExitCode::Done : ExitCode::Internal;
}

}  // namespace foveray::app
