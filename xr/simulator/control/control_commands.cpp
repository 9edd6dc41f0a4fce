#include "xr/simulator/control/control_commands.h"

#include <charconv>
#include <cmath>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "xr/simulator/api/names.h"
#include "xr/simulator/instance.h"

namespace foveray::simulator {
namespace {

using Words = std::span<const std::string>;

[[noreturn]] void refuse(const std::string& what) {
    throw_bad_input("command", what, "see docs/simulator.md");
}

/// Text from elsewhere, fit for a line.
std::string printable(std::string_view text) {
    std::string shown;
    for (const char c : text.substr(0, 60)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown;
}

void expect_words(Words words, std::size_t least, std::size_t most, const std::string& usage) {
    if (words.size() < least || words.size() > most) refuse("use " + usage);
}

float read_number(const std::string& word) {
    float number = 0.0f;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(number))
        refuse("'" + printable(word) + "' is no number");
    return number;
}

/// PX PY PZ QX QY QZ QW
Pose read_pose(Words words) {
    float v[7];
    for (std::size_t i = 0; i < 7; ++i) v[i] = read_number(words[i]);
    const Pose pose{quat(v[6], v[3], v[4], v[5]), vec3(v[0], v[1], v[2])};
    if (!is_usable(pose)) refuse("the quaternion has no length; use 0 0 0 1 for no rotation");
    return {glm::normalize(pose.orientation), pose.position};
}

int read_hand(std::string_view word) {
    if (word != "left" && word != "right") refuse("'" + printable(word) + "' is no hand; use left or right");
    return word == "right" ? 1 : 0;
}

void run_head(Instance& instance, Words words) {
    const std::string usage = "head PX PY PZ QX QY QZ QW, or head script";
    expect_words(words, 2, 8, usage);
    std::optional<Pose> pose;
    if (words[1] != "script") {
        expect_words(words, 8, 8, usage);
        pose = read_pose(words.subspan(1));
    }
    instance.stage(
        [&instance, pose](Nanoseconds time) { instance.script().overrides().set_head(time, pose); });
}

void run_gaze(Instance& instance, Words words) {
    const std::string usage = "gaze DX DY DZ, gaze invalid, or gaze script";
    expect_words(words, 2, 4, usage);
    std::optional<GazeSample> gaze;
    if (words[1] == "invalid") {
        gaze.emplace();
    } else if (words[1] != "script") {
        expect_words(words, 4, 4, usage);
        const vec3 direction(read_number(words[1]), read_number(words[2]), read_number(words[3]));
        const float length = glm::length(direction);
        if (!(length > 1e-6f && std::isfinite(length))) refuse("the direction has no length");
        gaze = GazeSample{0, true, vec3(0.0f), direction / length};
    }
    instance.stage(
        [&instance, gaze](Nanoseconds time) { instance.script().overrides().set_gaze(time, gaze); });
}

void run_controller(Instance& instance, Words words) {
    const std::string usage =
        "controller left|right PX PY PZ QX QY QZ QW, controller left|right invalid, or controller left|right "
        "script";
    expect_words(words, 3, 9, usage);
    const int hand = read_hand(words[1]);
    Overrides& overrides = instance.script().overrides();
    if (words[2] == "script")
        return instance.stage([&overrides, hand](Nanoseconds t) { overrides.release_controller(t, hand); });
    const bool valid = words[2] != "invalid";
    Pose pose;
    if (valid) {
        expect_words(words, 9, 9, usage);
        pose = read_pose(words.subspan(2));
    }
    instance.stage([=, &overrides](Nanoseconds t) { overrides.set_controller(t, hand, valid, pose); });
}

/// press, release, set
void run_input(Instance& instance, Words words) {
    const bool sets = words[0] == "set";
    expect_words(words, sets ? 3 : 2, sets ? 3 : 2,
                 sets ? "set HAND/INPUT VALUE" : words[0] + " HAND/INPUT, such as left/trigger");
    const std::string_view name = words[1];
    const std::size_t slash = name.find('/');
    if (slash == std::string_view::npos) refuse("'" + printable(name) + "' is no input; use left/trigger");
    const int hand = read_hand(name.substr(0, slash));
    const auto& names = Overrides::input_names;
    const auto input = std::ranges::find(names, name.substr(slash + 1));
    if (input == names.end())
        refuse("'" + printable(name) +
               "' is no input; use trigger, squeeze, stick_x, stick_y, primary or secondary");
    const float value = sets ? read_number(words[2]) : words[0] == "press" ? 1.0f : 0.0f;
    const float least = input->starts_with("stick") ? -1.0f : 0.0f;
    if (value < least || value > 1.0f) refuse("'" + words[2] + "' is out of the input's range");
    const auto index = static_cast<std::size_t>(input - names.begin());
    Overrides& overrides = instance.script().overrides();
    instance.stage([=, &overrides](Nanoseconds t) { overrides.set_input(t, hand, index, value); });
}

void run_fault(Instance& instance, Words words) {
    expect_words(words, 2, 4, "fault NAME [VALUE]");
    std::string value;
    for (const std::string& word : words.subspan(2)) value += (value.empty() ? "" : " ") + printable(word);
    instance.stage(parse_fault(0, printable(words[1]), value, "fault"));
}

ControlSocket::Reply run_step(Instance& instance, Words words) {
    expect_words(words, 1, 2, "step [N]");
    if (instance.clock().mode() != TimeMode::Stepped)
        refuse("time is not stepped; start with FOVERAY_SIMULATOR_TIME=stepped");
    const float frames = words.size() > 1 ? read_number(words[1]) : 1.0f;
    if (!(frames >= 1.0f && frames <= 1e6f && frames == std::floor(frames)))
        refuse("'" + printable(words[1]) + "' is no number of frames");
    const std::uint64_t ends = instance.status().session_ends;
    instance.clock().step(static_cast<std::uint64_t>(frames));
    return [&instance, ends]() -> std::optional<std::string> {
        if (instance.clock().steps_done()) return "ok frame=" + std::to_string(instance.status().frame);
        if (instance.status().session_ends == ends) return std::nullopt;
        instance.clock().drop_steps();
        return "error the session ended";
    };
}

/// "FOCUSED"; "none" without a session.
std::string name_of_state(XrSessionState state) {
    if (state == XR_SESSION_STATE_UNKNOWN) return "none";
    const std::string_view prefix = "XR_SESSION_STATE_";
    const std::string_view name = name_of(state);
    return std::string(name.substr(prefix.size()));
}

std::string describe(Instance& instance) {
    const Status& status = instance.status();
    std::ostringstream text;
    text << "ok state=" << name_of_state(status.state) << " frame=" << status.frame
         << " time_ns=" << instance.clock().session_time(instance.clock().now())
         << " waited=" << status.waited_frames << " ended=" << status.ended_frames
         << " missed=" << instance.clock().missed_frames();
    return text.str();
}

ControlSocket::Reply say(std::string text) {
    return [text = std::move(text)] { return std::optional(text); };
}

ControlSocket::Reply run_words(Instance& instance, Words words) {
    const std::string& name = words[0];
    if (name == "step") return run_step(instance, words);
    if (name == "state") return say(describe(instance));
    if (name == "head") {
        run_head(instance, words);
    } else if (name == "gaze") {
        run_gaze(instance, words);
    } else if (name == "controller") {
        run_controller(instance, words);
    } else if (name == "press" || name == "release" || name == "set") {
        run_input(instance, words);
    } else if (name == "fault") {
        run_fault(instance, words);
    } else if (name == "exit") {
        instance.stage(parse_fault(0, "exit", "", "exit"));
    } else {
        refuse("'" + printable(name) +
               "' is unknown; use head, gaze, controller, press, release, set, fault, step, state or exit");
    }
    return say("ok");
}

}  // namespace

ControlSocket::Reply run_command(Instance& instance, const std::string& line) {
    try {
        std::istringstream in(line);
        std::vector<std::string> words;
        for (std::string word; in >> word;) words.push_back(word);
        if (words.empty()) refuse("the line is empty");
        return run_words(instance, words);
    } catch (const std::exception& e) {
        return say(std::string("error ") + e.what());
    }
}

}  // namespace foveray::simulator
