#include <algorithm>
#include <cstdio>
#include <fstream>

#include "app/report/run_report.h"
#include "app/version.h"
#include "base/error.h"

namespace foveray::app {
namespace {

std::string number_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

double stage_ms(const FrameMetrics& frame, const std::string& name) {
    double sum = 0.0;
    for (const auto& [stage, ms] : frame.stages) sum += stage == name ? ms : 0.0;
    return sum;
}

/// The smallest value that `share` of the values do not exceed.
double quantile(const std::vector<double>& sorted, double share) {
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(sorted.size()) + 0.999999);
    return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

template <typename Get>
Json statistics(std::span<const FrameMetrics> frames, Get get) {
    std::vector<double> values;
    for (const FrameMetrics& frame : frames) values.push_back(static_cast<double>(get(frame)));
    if (values.empty()) return nullptr;
    double sum = 0.0;
    for (double value : values) sum += value;
    std::sort(values.begin(), values.end());
    return {{"median", quantile(values, 0.5)},
            {"p99", quantile(values, 0.99)},
            {"max", values.back()},
            {"mean", sum / static_cast<double>(values.size())}};
}

Json settings_json(const Settings& settings) {
    Json json = Json::object();
    for (const SettingInfo& info : settings_table()) {
        json[std::string(info.key)] = value_json(settings, info);
    }
    return json;
}

}  // namespace

double FrameMetrics::gpu_ms() const {
    double sum = 0.0;
    for (const auto& [name, ms] : stages) sum += ms;
    return sum;
}

std::vector<std::string> stage_names(std::span<const FrameMetrics> frames) {
    std::vector<std::string> names;
    for (const FrameMetrics& frame : frames) {
        for (const auto& [name, ms] : frame.stages) {
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    }
    return names;
}

void write_metrics(const std::filesystem::path& file, std::span<const FrameMetrics> frames) {
    const std::vector<std::string> stages = stage_names(frames);
    std::ofstream out(file);
    out << "frame,display_time_ns,gaze_valid,gaze_yaw_degrees,gaze_pitch_degrees,rays_primary,rays_shadow,"
           "rays_reflection,rays_transparent,rays_probe,rays_occlusion,polar_width,polar_height,cpu_ms,gpu_ms";
    for (const std::string& stage : stages) out << ',' << stage << "_ms";
    out << '\n';
    for (const FrameMetrics& f : frames) {
        out << f.index << ',' << f.display_time << ',' << (f.gaze_valid ? 1 : 0) << ','
            << number_text(f.gaze_yaw_degrees) << ',' << number_text(f.gaze_pitch_degrees) << ','
            << f.rays.primary << ',' << f.rays.shadow << ',' << f.rays.reflection << ',' << f.rays.transparent
            << ',' << f.rays.probe << ',' << f.rays.occlusion << ',' << f.polar_size.x << ',' << f.polar_size.y << ','
            << number_text(f.cpu_ms) << ',' << number_text(f.gpu_ms());
        for (const std::string& stage : stages) out << ',' << number_text(stage_ms(f, stage));
        out << '\n';
    }
    if (!out.flush())
        throw_bad_input(file.string(), "cannot be written", "check the folder's rights and free space");
}

Json summarize(const RunInfo& run, std::span<const FrameMetrics> frames) {
    Json views = Json::array();
    for (const uvec2 size : run.view_sizes) views.push_back({{"width", size.x}, {"height", size.y}});
    Json stages = Json::object();
    for (const std::string& name : stage_names(frames)) {
        stages[name] = statistics(frames, [&](const FrameMetrics& f) { return stage_ms(f, name); });
    }
    const auto valid =
        std::count_if(frames.begin(), frames.end(), [](const FrameMetrics& f) { return f.gaze_valid; });
    const uvec2 polar = frames.empty() ? uvec2(0) : frames.back().polar_size;
    return {
        {"format", "foveray-summary"},
        {"version", 1},
        {"foveray", version},
        {"run",
         {{"title", run.title},
          {"session", run.session},
          {"scene", run.scene},
          {"camera", run.camera},
          {"reference", run.reference}}},
        {"headset", {{"name", run.headset}, {"rate_hz", run.rate_hz}, {"views", views}}},
        {"environment",
         {{"device", run.device}, {"driver", run.driver}, {"openxr_runtime", run.openxr_runtime}}},
        {"settings", settings_json(run.settings)},
        {"frames", frames.size()},
        {"frames_with_gaze", valid},
        {"polar", {{"width", polar.x}, {"height", polar.y}}},
        {"gpu_ms", statistics(frames, [](const FrameMetrics& f) { return f.gpu_ms(); })},
        {"cpu_ms", statistics(frames, [](const FrameMetrics& f) { return f.cpu_ms; })},
        {"stages_gpu_ms", stages},
        {"rays",
         {{"primary", statistics(frames, [](const FrameMetrics& f) { return f.rays.primary; })},
          {"shadow", statistics(frames, [](const FrameMetrics& f) { return f.rays.shadow; })},
          {"reflection", statistics(frames, [](const FrameMetrics& f) { return f.rays.reflection; })},
          {"transparent", statistics(frames, [](const FrameMetrics& f) { return f.rays.transparent; })},
          {"probe", statistics(frames, [](const FrameMetrics& f) { return f.rays.probe; })},
          {"occlusion", statistics(frames, [](const FrameMetrics& f) { return f.rays.occlusion; })},
          {"total", statistics(frames, [](const FrameMetrics& f) { return f.rays.total(); })}}},
    };
}

}  // namespace foveray::app
