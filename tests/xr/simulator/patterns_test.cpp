// FOVERAY_SIMULATOR_PATTERN: generated wearers.
#include "tests/xr/simulator/gaze_client.h"

namespace foveray::simulator_tests {
namespace {

quat rotation_of(const XrPosef& pose) {
    return {pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z};
}

std::vector<GazeClient::Look> play(const std::string& pattern, double seconds, Nanoseconds step) {
    set_environment({{"PATTERN", pattern}});
    GazeClient client;
    const XrTime first = client.client().empty_frame().predictedDisplayTime;
    std::vector<GazeClient::Look> looks;
    for (Nanoseconds t = 0; t < from_seconds(seconds); t += step) looks.push_back(client.at(first + t));
    return looks;
}

constexpr Nanoseconds sample_step = 5 * nanoseconds_per_millisecond;

TEST(Patterns, StaticStandsStill) {
    for (const auto& look : play("static", 0.5, sample_step)) {
        EXPECT_FLOAT_EQ(look.stage_from_head.position.y, 1.6f);
        EXPECT_FLOAT_EQ(look.stage_from_head.orientation.w, 1.0f);
        EXPECT_FLOAT_EQ(look.direction.z, -1.0f);
    }
}

TEST(Patterns, SweepTurnsTheHeadSmoothly) {
    const auto looks = play("sweep", 8.0, sample_step);
    float most = 0.0f;
    for (std::size_t i = 1; i < looks.size(); ++i) {
        const vec3 before = rotation_of(looks[i - 1].stage_from_head) * vec3(0.0f, 0.0f, -1.0f);
        const vec3 now = rotation_of(looks[i].stage_from_head) * vec3(0.0f, 0.0f, -1.0f);
        EXPECT_LT(degrees_between(before, now), 0.2f) << "at most 37 degrees a second";
        most = std::max(most, std::abs(degrees(std::atan2(now.x, -now.z))));
    }
    EXPECT_NEAR(most, 40.0f, 0.5f);
}

TEST(Patterns, SaccadesKeepTheMainSequence) {
    const auto looks = play("saccades:1", 60.0, sample_step);
    int saccades = 0, fixations = 0;
    float head_speed = 0.0f;
    vec3 start(0.0f);
    std::size_t began = 0;
    const auto in_stage = [&](std::size_t i) {
        return rotation_of(looks[i].stage_from_head) * looks[i].direction;
    };
    for (std::size_t i = 1; i < looks.size(); ++i) {
        const float moved = degrees_between(in_stage(i - 1), in_stage(i));
        const quat turn =
            rotation_of(looks[i].stage_from_head) * glm::conjugate(rotation_of(looks[i - 1].stage_from_head));
        head_speed = std::max(head_speed,
                              2.0f * degrees(std::asin(glm::length(vec3(turn.x, turn.y, turn.z)))) / 0.005f);
        const bool moves = moved > 0.02f;
        if (moves && began == 0) {
            began = i;
            start = in_stage(i - 1);
        } else if (!moves && began != 0) {
            ++saccades;
            const float amplitude = degrees_between(start, in_stage(i));
            const double duration = 0.005 * static_cast<double>(i - began);
            // Sampled, and slow at both ends.
            EXPECT_NEAR(duration, 0.021 + 0.0022 * amplitude, 0.016) << amplitude << " degrees";
            began = 0;
        }
        fixations += !moves;
    }
    EXPECT_GT(saccades, 120);
    EXPECT_LT(saccades, 151) << "two and a half a second";
    EXPECT_GT(fixations, 8000) << "eyes rest most of the time";
    EXPECT_LT(head_speed, 200.0f);
    EXPECT_GT(head_speed, 20.0f) << "degrees a second; the head follows";
}

TEST(Patterns, SeedsMakeTheDifferenceAndRunsDoNot) {
    const auto directions = [](const std::string& pattern) {
        std::vector<vec3> found;
        for (const auto& look : play(pattern, 3.0, 100 * nanoseconds_per_millisecond))
            found.push_back(look.direction);
        return found;
    };
    const auto first = directions("saccades:1");
    EXPECT_EQ(directions("saccades:1"), first);
    EXPECT_NE(directions("saccades:2"), first);
}

TEST(Patterns, MistakesFailTheInstance) {
    fakes::TemporaryFolder folder;
    write_session(folder.path() / "s", make_session(10));
    const std::map<std::string, std::string> cases[] = {
        {{"PATTERN", "dance"}},
        {{"PATTERN", "sweep:"}},
        {{"PATTERN", "sweep:fast"}},
        {{"PATTERN", "static"}, {"SESSION", folder.path() / "s"}},
    };
    for (const auto& variables : cases) {
        set_environment(variables);
        XrInstance instance = XR_NULL_HANDLE;
        EXPECT_TRUE(XR_FAILED(create_instance(&instance)));
    }
}

}  // namespace
}  // namespace foveray::simulator_tests
