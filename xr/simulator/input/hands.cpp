#include "xr/simulator/input/hands.h"

#include <algorithm>

#include "base/csv.h"
#include "base/error.h"

namespace foveray::simulator {
namespace {

constexpr vec3 towards_tip(0.0f, 0.0f, -1.0f);

/// A finger from its first joint on; lengths of the bones between its joints in metres.
struct Finger {
    XrHandJointEXT first;
    vec3 base;   // in the palm's frame of a left hand; a right one mirrors x
    float turn;  // of its first bone to the thumb's side, radians
    std::vector<float> bones;
    float radius;
};

const std::vector<Finger>& fingers() {
    static const std::vector<Finger> made{
        {XR_HAND_JOINT_THUMB_METACARPAL_EXT, {0.02f, -0.01f, 0.05f}, 0.7f, {0.045f, 0.03f, 0.025f}, 0.01f},
        {XR_HAND_JOINT_INDEX_METACARPAL_EXT,
         {0.02f, 0.0f, 0.04f},
         0.05f,
         {0.07f, 0.04f, 0.025f, 0.02f},
         0.009f},
        {XR_HAND_JOINT_MIDDLE_METACARPAL_EXT,
         {0.005f, 0.0f, 0.04f},
         0.0f,
         {0.07f, 0.045f, 0.028f, 0.02f},
         0.009f},
        {XR_HAND_JOINT_RING_METACARPAL_EXT,
         {-0.01f, 0.0f, 0.04f},
         -0.05f,
         {0.065f, 0.04f, 0.026f, 0.02f},
         0.008f},
        {XR_HAND_JOINT_LITTLE_METACARPAL_EXT,
         {-0.025f, 0.0f, 0.04f},
         -0.1f,
         {0.06f, 0.03f, 0.018f, 0.018f},
         0.007f},
    };
    return made;
}

Pose turned(vec3 axis, float angle) { return {glm::angleAxis(angle, axis), vec3(0.0f)}; }

/// OpenXR 1.0, section 6.3.1: the grip's -y runs along open fingers, its -z to the thumb, and its x out of
/// the left palm and into the right one.
quat grip_from_palm(int hand) {
    const float side = hand == 0 ? -1.0f : 1.0f;
    return glm::quat_cast(glm::mat3(vec3(0.0f, 0.0f, side), vec3(side, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f)));
}

HandJoint read_joint(const CsvTable& csv, std::size_t row) {
    const auto number = [&](const char* column) {
        return static_cast<float>(csv.number(row, csv.column(column)));
    };
    const quat orientation(number("qw"), number("qx"), number("qy"), number("qz"));
    const float radius = number("radius");
    if (glm::length(orientation) < 1e-6f || radius <= 0.0f) {
        throw_bad_input(csv.where(row), "is no joint",
                        "give a quaternion that is not zero and a radius above zero");
    }
    return {{glm::normalize(orientation), vec3(number("px"), number("py"), number("pz"))}, radius};
}

}  // namespace

HandJoints hand_round_controller(int hand, const ControllerState& controller) {
    const Pose stage_from_palm = controller.stage_from_grip * Pose{grip_from_palm(hand), vec3(0.0f)};
    const float thumb_side = hand == 0 ? 1.0f : -1.0f;
    const vec3 x_axis(1.0f, 0.0f, 0.0f), y_axis(0.0f, 1.0f, 0.0f);
    HandJoints joints;
    joints[XR_HAND_JOINT_PALM_EXT] = {stage_from_palm, 0.02f};
    joints[XR_HAND_JOINT_WRIST_EXT] = {
        stage_from_palm * Pose{quat(1.0f, 0.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 0.08f)}, 0.025f};
    for (const Finger& finger : fingers()) {
        const bool pulls = finger.first == XR_HAND_JOINT_INDEX_METACARPAL_EXT;
        const float bend = 0.2f + 1.1f * (pulls ? controller.trigger : controller.squeeze);
        Pose joint = stage_from_palm *
                     Pose{quat(1.0f, 0.0f, 0.0f, 0.0f), finger.base * vec3(thumb_side, 1, 1)} *
                     turned(y_axis, -finger.turn * thumb_side);
        std::size_t index = finger.first;
        joints[index++] = {joint, finger.radius};
        for (const float length : finger.bones) {
            joint = joint * Pose{quat(1.0f, 0.0f, 0.0f, 0.0f), length * towards_tip} * turned(x_axis, -bend);
            joints[index++] = {joint, finger.radius};
        }
    }
    return joints;
}

HandStream::HandStream(const std::filesystem::path& session_folder) {
    const std::filesystem::path file = session_folder / "hands.csv";
    if (!std::filesystem::exists(file)) return;
    const CsvTable csv = CsvTable::read(file);
    for (std::size_t row = 0; row < csv.row_count(); ++row) {
        const std::string& name = csv.text(row, csv.column("hand"));
        if (name != "left" && name != "right")
            throw_bad_input(csv.where(row), "unknown hand '" + name + "'", "use left or right");
        auto& samples = samples_[name == "left" ? 0 : 1];
        const std::int64_t time = csv.integer(row, csv.column("time_ns"));
        const std::int64_t joint = csv.integer(row, csv.column("joint"));
        const bool starts = joint == 0;
        if (starts ? !samples.empty() && time <= samples.back().time
                   : samples.empty() || time != samples.back().time) {
            throw_bad_input(csv.where(row), "is out of order",
                            "give each hand's joints 0 to 25 one after another, at times that grow");
        }
        if (starts) samples.push_back({time, true, {}});
        if (joint < 0 || joint >= XR_HAND_JOINT_COUNT_EXT)
            throw_bad_input(csv.where(row), "has no such joint", "count joints from 0 to 25");
        const bool valid = csv.boolean(row, csv.column("valid"));
        samples.back().valid = samples.back().valid && valid;
        if (valid) samples.back().joints[static_cast<std::size_t>(joint)] = read_joint(csv, row);
    }
    for (auto& samples : samples_) {
        for (Sample& sample : samples) {
            const auto is_missing = [](const HandJoint& joint) { return joint.radius <= 0.0f; };
            if (sample.valid && std::ranges::any_of(sample.joints, is_missing)) {
                throw_bad_input(file.string(),
                                "a hand at " + std::to_string(sample.time) + " ns lacks joints",
                                "give all 26, or valid 0");
            }
        }
    }
}

const HandJoints* HandStream::at(int hand, Nanoseconds time) const {
    const auto& samples = samples_[static_cast<std::size_t>(hand)];
    const auto end = std::ranges::upper_bound(samples, time, {}, &Sample::time);
    if (end == samples.begin() || !std::prev(end)->valid) return nullptr;
    return &std::prev(end)->joints;
}

}  // namespace foveray::simulator
