#include "embedded/report_page.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "app/report/run_report.h"
#include "base/error.h"

namespace foveray::app {
namespace {

namespace fs = std::filesystem;

Json rounded(double value) { return std::round(value * 1e4) / 1e4; }

template <typename Get>
Json column(std::span<const FrameMetrics> frames, Get get) {
    Json values = Json::array();
    for (const FrameMetrics& frame : frames) values.push_back(get(frame));
    return values;
}

Json frame_columns(std::span<const FrameMetrics> frames) {
    Json stages = Json::array();
    for (const std::string& name : stage_names(frames)) {
        stages.push_back({{"name", name}, {"ms", column(frames, [&](const FrameMetrics& f) -> Json {
                                               double sum = 0.0;
                                               for (const auto& [stage, ms] : f.stages)
                                                   sum += stage == name ? ms : 0.0;
                                               return rounded(sum);
                                           })}});
    }
    const auto mark = [&](std::size_t eye) {
        return column(frames, [eye](const FrameMetrics& f) -> Json {
            if (!f.gaze_mark[eye]) return nullptr;
            return Json::array({rounded(f.gaze_mark[eye]->x), rounded(f.gaze_mark[eye]->y)});
        });
    };
    const Nanoseconds start = frames.empty() ? 0 : frames.front().display_time;
    return {
        {"index", column(frames, [](const FrameMetrics& f) { return f.index; })},
        {"seconds",
         column(frames, [&](const FrameMetrics& f) { return rounded(to_seconds(f.display_time - start)); })},
        {"yaw", column(frames,
                       [](const FrameMetrics& f) -> Json {
                           return f.gaze_valid ? rounded(f.gaze_yaw_degrees) : Json();
                       })},
        {"pitch", column(frames,
                         [](const FrameMetrics& f) -> Json {
                             return f.gaze_valid ? rounded(f.gaze_pitch_degrees) : Json();
                         })},
        {"marks", {{"left", mark(0)}, {"right", mark(1)}}},
        {"cpu", column(frames, [](const FrameMetrics& f) { return rounded(f.cpu_ms); })},
        {"stages", stages},
        {"rays",
         {{{"name", "primary"},
           {"count", column(frames, [](const FrameMetrics& f) { return f.rays.primary; })}},
          {{"name", "shadow"},
           {"count", column(frames, [](const FrameMetrics& f) { return f.rays.shadow; })}},
          {{"name", "reflection"},
           {"count", column(frames, [](const FrameMetrics& f) { return f.rays.reflection; })}},
          {{"name", "transparent"},
           {"count", column(frames, [](const FrameMetrics& f) { return f.rays.transparent; })}},
          {{"name", "probe"},
           {"count", column(frames, [](const FrameMetrics& f) { return f.rays.probe; })}},
          {{"name", "occlusion"},
           {"count", column(frames, [](const FrameMetrics& f) { return f.rays.occlusion; })}}}},
    };
}

/// Settings with help and whether they differ from the default, in the table's order.
Json settings_rows(const Settings& settings) {
    Json rows = Json::array();
    for (const SettingInfo& info : settings_table()) {
        const std::string value = value_text(settings, info), usual = value_text(Settings{}, info);
        rows.push_back(
            {{"key", info.key}, {"value", value}, {"changed", value != usual}, {"help", info.help}});
    }
    return rows;
}

/// For each eye a list, as long as `frames`, of picture paths or null.
Json find_pictures(const fs::path& folder, std::span<const FrameMetrics> frames) {
    Json pictures = Json::object();
    for (const char* eye : {"left", "right"}) {
        bool any = false;
        Json list = column(frames, [&](const FrameMetrics& f) -> Json {
            char name[64];
            std::snprintf(name, sizeof name, "frames/frame_%05llu_%s.png",
                          static_cast<unsigned long long>(f.index), eye);
            if (!fs::exists(folder / name)) return nullptr;
            any = true;
            return name;
        });
        if (any) pictures[eye] = std::move(list);
    }
    return pictures;
}

void replace_all(std::string& text, std::string_view mark, std::string_view value) {
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size())) {
        text.replace(at, mark.size(), value);
    }
}

/// JSON that may stand inside an HTML script element.
std::string script_text(const Json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
        if (c == '<') {
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return text;
}

/// Text between tags; braces too, so that it holds no placeholder.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool plain = std::string_view("&<>{").find(c) == std::string_view::npos;
        result += plain ? std::string(1, c) : "&#" + std::to_string(static_cast<int>(c)) + ";";
    }
    return result;
}

}  // namespace

void write_report(const fs::path& folder, const RunInfo& run, std::span<const FrameMetrics> frames) {
    const Json summary = summarize(run, frames);
    write_metrics(folder / "metrics.csv", frames);
    write_json(folder / "summary.json", summary);

    const Json data = {{"summary", summary},
                       {"settings", settings_rows(run.settings)},
                       {"frames", frame_columns(frames)},
                       {"pictures", find_pictures(folder, frames)},
                       {"video", fs::exists(folder / "video.mp4") ? Json("video.mp4") : Json()}};
    std::string page(report_page);
    replace_all(page, "{{title}}", escaped(run.title));
    replace_all(page, "{{data}}", script_text(data));
    const fs::path file = folder / "report.html";
    std::ofstream out(file);
    out << page;
    if (!out.flush())
        throw_bad_input(file.string(), "cannot be written", "check the folder's rights and free space");
}

}  // namespace foveray::app
