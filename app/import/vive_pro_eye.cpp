#include "app/import/vive_pro_eye.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/csv.h"
#include "base/error.h"

namespace foveray::app {
namespace {

namespace fs = std::filesystem;

constexpr double rate_hz = 90.0;

struct Columns {
    std::size_t x, y, z;
    Columns(const CsvTable& table, const std::string& prefix)
        : x(table.column(prefix + "_x")), y(table.column(prefix + "_y")), z(table.column(prefix + "_z")) {}
    dvec3 at(const CsvTable& table, std::size_t row) const {
        return {table.number(row, x), table.number(row, y), table.number(row, z)};
    }
};

struct PoseColumns {
    Columns position, rotation;
    PoseColumns(const CsvTable& table, const std::string& name)
        : position(table, name + "_pos"), rotation(table, name + "_rot") {}
    Pose at(const CsvTable& table, std::size_t row) const {
        const dvec3 p = position.at(table, row);
        return {from_unity_euler(rotation.at(table, row)), vec3(p.x, p.y, -p.z)};
    }
};

/// Row times in nanoseconds after `start` seconds. Throws when they go backwards.
std::vector<Nanoseconds> times(const CsvTable& table, double start) {
    const std::size_t column = table.column("time");
    std::vector<Nanoseconds> result(table.row_count());
    for (std::size_t row = 0; row < result.size(); ++row) {
        result[row] = from_seconds(table.number(row, column) - start);
        if (row > 0 && result[row] < result[row - 1]) {
            throw_bad_input(table.where(row), "time goes backwards",
                            "sort the rows, or split the log by trial");
        }
    }
    return result;
}

std::vector<Session::HeadSample> read_head(const CsvTable& table, const std::vector<Nanoseconds>& time) {
    const PoseColumns pose(table, "head");
    std::vector<Session::HeadSample> samples;
    for (std::size_t row = 0; row < table.row_count(); ++row)
        samples.push_back({time[row], pose.at(table, row)});
    return samples;
}

std::vector<GazeSample> read_gaze(const CsvTable& table, const std::vector<Nanoseconds>& time) {
    const Columns origin(table, "ori"), direction(table, "dir");
    const std::size_t left_pupil = table.column("pupil_l"), right_pupil = table.column("pupil_r");
    std::vector<GazeSample> samples;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const dvec3 o = origin.at(table, row), d = direction.at(table, row);
        const double length = glm::length(d);
        const bool no_data = o == dvec3(0.0) && (d == dvec3(0.0) || d == dvec3(0.0, 0.0, 1.0));
        const bool no_pupils = table.number(row, left_pupil) <= 0.0 && table.number(row, right_pupil) <= 0.0;

        GazeSample sample{.time = time[row], .valid = !no_data && !no_pupils && length > 0.5};
        if (sample.valid) {
            sample.origin = vec3(o.x, o.y, -o.z);
            sample.direction = vec3(d.x, d.y, -d.z) / static_cast<float>(length);
        }
        const bool repeats = !samples.empty() && samples.back().valid == sample.valid &&
                             samples.back().origin == sample.origin &&
                             samples.back().direction == sample.direction;
        if (!repeats) samples.push_back(sample);
    }
    return samples;
}

struct Hand {
    int index;
    PoseColumns pose;
    bool tracked_at(const CsvTable& table, std::size_t row) const {
        return pose.position.at(table, row) != dvec3(0.0);
    }
};

std::vector<Session::ControllerSample> read_controllers(const CsvTable& table,
                                                        const std::vector<Nanoseconds>& time) {
    std::vector<Hand> hands;
    for (const Hand& hand : {Hand{0, PoseColumns(table, "left")}, Hand{1, PoseColumns(table, "right")}}) {
        for (std::size_t row = 0; row < table.row_count(); ++row) {
            if (!hand.tracked_at(table, row)) continue;
            hands.push_back(hand);
            break;
        }
    }
    const std::size_t squeeze = table.column("grab_force"), trigger = table.column("trigger");
    std::vector<Session::ControllerSample> samples;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        for (const Hand& hand : hands) {
            Session::ControllerSample sample{.time = time[row], .hand = hand.index, .state = {}};
            ControllerState& state = sample.state;
            state.valid = hand.tracked_at(table, row);
            if (state.valid) state.stage_from_grip = hand.pose.at(table, row);
            state.stage_from_aim = state.stage_from_grip;
            if (hand.index == hands.back().index) {
                state.squeeze = static_cast<float>(std::clamp(table.number(row, squeeze), 0.0, 1.0));
                state.trigger = table.boolean(row, trigger) ? 1.0f : 0.0f;
            }
            samples.push_back(sample);
        }
    }
    return samples;
}

}  // namespace

quat from_unity_euler(dvec3 degrees) {
    const dvec3 half = glm::radians(degrees) * 0.5;
    const glm::dquat x(std::cos(half.x), std::sin(half.x), 0.0, 0.0);
    const glm::dquat y(std::cos(half.y), 0.0, std::sin(half.y), 0.0);
    const glm::dquat z(std::cos(half.z), 0.0, 0.0, std::sin(half.z));
    const glm::dquat q = y * x * z;
    // Mirroring z turns the axis (x, y, z) into (-x, -y, z) when the angle keeps its sign.
    return glm::normalize(quat(static_cast<float>(q.w), static_cast<float>(-q.x), static_cast<float>(-q.y),
                               static_cast<float>(q.z)));
}

Session read_vive_pro_eye(const std::vector<fs::path>& files) {
    std::optional<CsvTable> gaze, move;
    for (const fs::path& file : files) {
        CsvTable table = CsvTable::read(file);
        const bool is_gaze = table.has_column("dir_x"), is_move = table.has_column("head_pos_x");
        if (is_gaze == is_move) {
            throw_bad_input(file.string() + ":1", "is neither an Eye_gaze nor a VR_move log",
                            "it needs the columns dir_x … or head_pos_x …");
        }
        std::optional<CsvTable>& slot = is_gaze ? gaze : move;
        if (slot) {
            throw_bad_input(file.string(),
                            std::string("is a second ") + (is_gaze ? "Eye_gaze" : "VR_move") + " log",
                            "import one trial at a time: one Eye_gaze and one VR_move file");
        }
        if (table.row_count() == 0)
            throw_bad_input(file.string(), "has no rows", "import a trial with samples");
        slot = std::move(table);
    }
    if (!gaze || !move) {
        throw_bad_input(files.empty() ? "foveray import" : files.front().string(),
                        std::string("the trial's ") + (gaze ? "VR_move" : "Eye_gaze") + " log is missing",
                        "name both files of a trial: Eye_gaze_*.csv and VR_move_*.csv");
    }
    const double start =
        std::min(gaze->number(0, gaze->column("time")), move->number(0, move->column("time")));
    const std::vector<Nanoseconds> gaze_time = times(*gaze, start), move_time = times(*move, start);

    Session session;
    session.headset = "vive-pro-eye";
    session.rate_hz = rate_hz;
    session.frames = static_cast<std::uint64_t>(to_seconds(move_time.back()) * rate_hz) + 1;
    session.head = read_head(*move, move_time);
    session.gaze = read_gaze(*gaze, gaze_time);
    session.controllers = read_controllers(*move, move_time);
    return session;
}

}  // namespace foveray::app
