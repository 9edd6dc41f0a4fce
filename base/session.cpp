#include "base/session.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/csv.h"
#include "base/error.h"
#include "base/json.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

constexpr int format_version = 1;

vec3 read_vec3(const CsvTable& t, std::size_t row, const std::string& prefix) {
    return {t.number(row, t.column(prefix + "x")), t.number(row, t.column(prefix + "y")),
            t.number(row, t.column(prefix + "z"))};
}

Pose read_pose(const CsvTable& t, std::size_t row) {
    Pose pose;
    pose.position = read_vec3(t, row, "p");
    const vec3 q = read_vec3(t, row, "q");
    pose.orientation = quat(static_cast<float>(t.number(row, t.column("qw"))), q.x, q.y, q.z);
    if (!is_usable(pose)) {
        throw_bad_input(t.where(row), "the quaternion qx..qw has no length", "use 0,0,0,1 for no rotation");
    }
    pose.orientation = glm::normalize(pose.orientation);
    return pose;
}

template <typename Sample, typename ReadRow>
std::vector<Sample> read_stream(const fs::path& file, ReadRow read_row) {
    const CsvTable table = CsvTable::read(file);
    const std::size_t time = table.column("time_ns");
    std::vector<Sample> samples(table.row_count());
    for (std::size_t row = 0; row < samples.size(); ++row) {
        samples[row] = read_row(table, row);
        samples[row].time = table.integer(row, time);
        if (row > 0 && samples[row].time < samples[row - 1].time) {
            throw_bad_input(table.where(row), "time_ns goes backwards", "sort the rows by time_ns");
        }
    }
    return samples;
}

Session::HeadSample read_head(const CsvTable& t, std::size_t row) { return {0, read_pose(t, row)}; }

GazeSample read_gaze(const CsvTable& t, std::size_t row) {
    GazeSample gaze;
    gaze.valid = t.boolean(row, t.column("valid"));
    gaze.origin = read_vec3(t, row, "o");
    gaze.direction = read_vec3(t, row, "d");
    const float length = glm::length(gaze.direction);
    if (gaze.valid && length < 1e-3f) {
        throw_bad_input(t.where(row), "a valid gaze direction has no length",
                        "set valid to 0, or correct dx,dy,dz");
    }
    gaze.direction = length < 1e-3f ? vec3(0, 0, -1) : gaze.direction / length;
    return gaze;
}

Session::ControllerSample read_controller(const CsvTable& t, std::size_t row) {
    Session::ControllerSample sample;
    const std::string& hand = t.text(row, t.column("hand"));
    if (hand != "left" && hand != "right") {
        throw_bad_input(t.where(row), "'" + hand + "' is no hand", "use left or right");
    }
    sample.hand = hand == "right" ? 1 : 0;
    ControllerState& state = sample.state;
    state.valid = t.boolean(row, t.column("valid"));
    state.stage_from_grip = read_pose(t, row);
    state.stage_from_aim = state.stage_from_grip;
    state.trigger = static_cast<float>(t.number(row, t.column("trigger")));
    state.squeeze = static_cast<float>(t.number(row, t.column("squeeze")));
    state.thumbstick = {t.number(row, t.column("stick_x")), t.number(row, t.column("stick_y"))};
    state.primary_button = t.boolean(row, t.column("primary"));
    state.secondary_button = t.boolean(row, t.column("secondary"));
    return sample;
}

Session::Event read_event(const CsvTable& t, std::size_t row) {
    return {0, t.text(row, t.column("event")), t.text(row, t.column("value"))};
}

/// The whole number in `column`, which the setting of that name takes.
int read_count(const CsvTable& t, std::size_t row, const std::string& column, int least, int most) {
    const std::int64_t count = t.integer(row, t.column(column));
    if (count < least || count > most) {
        throw_bad_input(t.where(row), column + " is " + std::to_string(count),
                        "use " + std::to_string(least) + " to " + std::to_string(most));
    }
    return static_cast<int>(count);
}

Session::QualitySample read_quality(const CsvTable& t, std::size_t row) {
    Session::QualitySample sample;
    sample.resolution_scale = static_cast<float>(t.number(row, t.column("resolution_scale")));
    if (!(sample.resolution_scale > 0.0f && sample.resolution_scale <= 4.0f))
        throw_bad_input(t.where(row), "resolution_scale is out of its range", "use above 0, at most 4");
    sample.shadow_samples = read_count(t, row, "shadow_samples", 1, 256);
    sample.ambient_occlusion_samples = read_count(t, row, "ambient_occlusion_samples", 0, 64);
    sample.probe_rays = read_count(t, row, "probe_rays", 16, 256);
    sample.second_ray_depth = read_count(t, row, "second_ray_depth", 1, 8);
    return sample;
}

template <typename Sample>
auto last_at_or_before(const std::vector<Sample>& samples, Nanoseconds time) {
    auto it = std::upper_bound(samples.begin(), samples.end(), time,
                               [](Nanoseconds t, const Sample& s) { return t < s.time; });
    return it == samples.begin() ? samples.end() : it - 1;
}

/// A session's headset is a profile's name or file.
bool is_file(const std::string& headset) { return fs::path(headset).extension() == ".json"; }

class CsvWriter {
  public:
    CsvWriter(const fs::path& file, std::string_view header) : file_(file), out_(file) {
        out_ << header << '\n';
    }
    template <typename... Values>
    void row(const Values&... values) {
        bool first = true;
        ((out_ << (first ? "" : ","), first = false, put(values)), ...);
        out_ << '\n';
    }
    void close() {
        if (!out_.flush())
            throw_bad_input(file_.string(), "cannot be written", "check rights and free space");
    }

  private:
    void put(const std::string& s) { out_ << s; }
    void put(Nanoseconds v) { out_ << v; }
    void put(int v) { out_ << v; }
    void put(bool v) { out_ << (v ? 1 : 0); }
    void put(float v) {
        char text[32];
        std::snprintf(text, sizeof text, "%.9g", static_cast<double>(v));
        out_ << text;
    }
    fs::path file_;
    std::ofstream out_;
};

}  // namespace

Nanoseconds Session::duration() const {
    if (frames > 0 && rate_hz > 0) return from_seconds(static_cast<double>(frames) / rate_hz);
    return head.empty() ? 0 : head.back().time;
}

Pose Session::head_at(Nanoseconds time) const {
    if (head.empty()) return {quat(1, 0, 0, 0), vec3(0, 1.6f, 0)};
    const auto before = last_at_or_before(head, time);
    if (before == head.end()) return head.front().stage_from_head;
    const auto after = before + 1;
    if (after == head.end() || after->time == before->time) return before->stage_from_head;
    const float t = static_cast<float>(static_cast<double>(time - before->time) /
                                       static_cast<double>(after->time - before->time));
    return interpolate(before->stage_from_head, after->stage_from_head, t);
}

GazeSample Session::gaze_at(Nanoseconds time) const {
    const auto it = last_at_or_before(gaze, time);
    return it == gaze.end() ? GazeSample{} : *it;
}

ControllerState Session::controller_at(int hand, Nanoseconds time) const {
    ControllerState state;
    for (const ControllerSample& sample : controllers) {
        if (sample.time > time) break;
        if (sample.hand == hand) state = sample.state;
    }
    return state;
}

std::optional<Session::QualitySample> Session::quality_at(Nanoseconds time) const {
    const auto it = last_at_or_before(quality, time);
    return it == quality.end() ? std::nullopt : std::optional(*it);
}

Session read_session(const fs::path& folder) {
    const fs::path file = folder / "session.json";
    if (!fs::is_directory(folder)) {
        throw_bad_input(folder.string(), "is not a session folder", "name a folder that holds session.json");
    }
    const Json json = read_json(file);
    Session session;
    session.folder = folder;
    try {
        if (json.value("format", "") != "foveray-session") {
            throw_bad_input(file.string() + ": /format", "is not 'foveray-session'",
                            "is this a session folder?");
        }
        if (const int version = json.at("version"); version != format_version) {
            throw_bad_input(file.string() + ": /version",
                            "is " + std::to_string(version) + ", this program reads 1",
                            "use the foveray that wrote it");
        }
        session.headset = json.at("headset");
        if (is_file(session.headset))
            session.headset = fs::absolute(folder / session.headset).lexically_normal().string();
        session.rate_hz = json.at("rate_hz");
        session.frames = json.at("frames");
        if (!(session.rate_hz > 0.0 && session.rate_hz <= 1000.0)) {
            throw_bad_input(file.string() + ": /rate_hz", "must be above 0 and at most 1000",
                            "correct the value");
        }
        if (session.frames == 0 || session.frames > 10'000'000) {
            throw_bad_input(file.string() + ": /frames", "must be between 1 and 10 million",
                            "correct the value");
        }
        const auto path = [&](const char* key) -> std::optional<fs::path> {
            if (!json.contains(key)) return std::nullopt;
            return fs::absolute(folder / fs::path(json.at(key).get<std::string>())).lexically_normal();
        };
        session.scene = path("scene");
        session.camera = path("camera");
        session.calibration = path("calibration");
        for (const std::string stream : json.at("recorded")) {
            const fs::path csv = folder / (stream + ".csv");
            if (stream == "head") {
                session.head = read_stream<Session::HeadSample>(csv, read_head);
            } else if (stream == "gaze") {
                session.gaze = read_stream<GazeSample>(csv, read_gaze);
            } else if (stream == "controllers") {
                session.controllers = read_stream<Session::ControllerSample>(csv, read_controller);
            } else if (stream == "events") {
                session.events = read_stream<Session::Event>(csv, read_event);
            } else if (stream == "quality") {
                session.quality = read_stream<Session::QualitySample>(csv, read_quality);
            } else {
                throw_bad_input(file.string() + ": /recorded", "names an unknown stream '" + stream + "'",
                                "use head, gaze, controllers, events or quality");
            }
        }
    } catch (const Json::exception& e) {
        throw_bad_input(file.string(), e.what(), "see docs/session-format.md");
    }
    return session;
}

void write_session(const fs::path& folder, const Session& session) {
    fs::create_directories(folder);
    Json json = {
        {"format", "foveray-session"},
        {"version", format_version},
        {"units", {{"time", "ns"}, {"length", "m"}, {"rotation", "unit quaternion"}}},
        {"headset", is_file(session.headset) ? fs::proximate(session.headset, folder).generic_string()
                                             : session.headset},
        {"rate_hz", session.rate_hz},
        {"frames", session.frames},
        {"recorded", Json::array()}};
    const auto put_path = [&](const char* key, const std::optional<fs::path>& path) {
        if (path) json[key] = fs::proximate(*path, folder).generic_string();
    };
    put_path("scene", session.scene);
    put_path("camera", session.camera);
    put_path("calibration", session.calibration);

    const auto stream = [&](const std::string& name, std::string_view header, const auto& samples, auto put) {
        if (samples.empty()) return;
        json["recorded"].push_back(name);
        CsvWriter csv(folder / (name + ".csv"), header);
        for (const auto& sample : samples) put(csv, sample);
        csv.close();
    };
    stream("head", "time_ns,px,py,pz,qx,qy,qz,qw", session.head, [](CsvWriter& csv, const auto& s) {
        const auto& [q, p] = s.stage_from_head;
        csv.row(s.time, p.x, p.y, p.z, q.x, q.y, q.z, q.w);
    });
    stream("gaze", "time_ns,valid,ox,oy,oz,dx,dy,dz", session.gaze, [](CsvWriter& csv, const auto& s) {
        csv.row(s.time, s.valid, s.origin.x, s.origin.y, s.origin.z, s.direction.x, s.direction.y,
                s.direction.z);
    });
    stream("controllers",
           "time_ns,hand,valid,px,py,pz,qx,qy,qz,qw,trigger,squeeze,stick_x,stick_y,primary,secondary",
           session.controllers, [](CsvWriter& csv, const auto& s) {
               const ControllerState& c = s.state;
               const auto& [q, p] = c.stage_from_grip;
               csv.row(s.time, std::string(s.hand == 1 ? "right" : "left"), c.valid, p.x, p.y, p.z, q.x, q.y,
                       q.z, q.w, c.trigger, c.squeeze, c.thumbstick.x, c.thumbstick.y, c.primary_button,
                       c.secondary_button);
           });
    stream("events", "time_ns,event,value", session.events,
           [](CsvWriter& csv, const auto& s) { csv.row(s.time, s.name, s.value); });
    stream("quality",
           "time_ns,resolution_scale,shadow_samples,ambient_occlusion_samples,probe_rays,second_ray_depth",
           session.quality, [](CsvWriter& csv, const auto& s) {
               csv.row(s.time, s.resolution_scale, s.shadow_samples, s.ambient_occlusion_samples,
                       s.probe_rays, s.second_ray_depth);
           });
    write_json(folder / "session.json", json);
}

}  // namespace foveray
