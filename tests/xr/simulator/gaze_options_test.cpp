// FOVERAY_SIMULATOR_GAZE: noise, latency and blinks of the eye tracker.
#include "tests/xr/simulator/gaze_client.h"

namespace foveray::simulator_tests {
namespace {

constexpr vec3 ahead(0.0f, 0.0f, -1.0f);

TEST(GazeOptions, NoiseHasTheGivenSizeAndComesFromItsSeed) {
    const auto directions = [](const std::string& options) {
        set_environment({{"GAZE", options}});
        GazeClient client;
        std::vector<vec3> found;
        for (const auto& look : client.frames(2000)) found.push_back(look.direction);
        return found;
    };
    const auto noisy = directions("noise=2,seed=5");
    double squares = 0.0;
    vec3 mean(0.0f);
    for (const vec3 direction : noisy) {
        squares += std::pow(degrees_between(direction, ahead), 2.0);
        mean += direction;
    }
    // Both within five standard errors of the mean.
    EXPECT_NEAR(std::sqrt(squares / 2000.0), 2.0, 0.11);
    EXPECT_LT(degrees_between(mean, ahead), 0.23f);
    EXPECT_EQ(directions("noise=2,seed=5"), noisy) << "every run is the same";
    EXPECT_NE(directions("noise=2,seed=6"), noisy);
}

TEST(GazeOptions, LatencyShowsOldMeasurements) {
    fakes::TemporaryFolder folder;
    Session session = make_session(100);
    for (int i = 0; i < 100; ++i) {
        GazeSample sample;
        sample.time = from_seconds(i / 30.0);
        sample.valid = true;
        sample.direction = glm::normalize(vec3(0.01f * static_cast<float>(i), 0.0f, -1.0f));
        session.gaze.push_back(sample);
    }
    write_session(folder.path() / "s", session);
    set_environment({{"SESSION", folder.path() / "s"}, {"GAZE", "latency=100"}});
    GazeClient client;
    const auto looks = client.frames(10);
    EXPECT_FALSE(looks[0].valid) << "frame 2 is at 67 ms";
    for (int i = 2; i < 10; ++i) {
        const auto& look = looks[static_cast<std::size_t>(i)];  // frame i + 2
        EXPECT_NEAR(look.direction.x / -look.direction.z, 0.01f * static_cast<float>(i - 1), 1e-5f);
        EXPECT_NEAR(static_cast<double>(look.frame - look.sample), 1e8, 1e3);
    }
}

TEST(GazeOptions, BlinksComeAtTheirRateAndLast) {
    set_environment({{"GAZE", "blinks=30,blink=200,seed=3"}});
    GazeClient client;
    const XrTime first = client.client().empty_frame().predictedDisplayTime;
    int blinks = 0, closed = 0;
    bool was_valid = true;
    for (int ms = 0; ms < 60'000; ms += 5) {
        const bool valid = client.at(first + ms * nanoseconds_per_millisecond).valid;
        blinks += was_valid && !valid;
        closed += !valid;
        was_valid = valid;
    }
    EXPECT_NEAR(blinks, 30, 1);
    EXPECT_NEAR(closed * 5, 30 * 200, 200);
}

TEST(GazeOptions, FocusViewsStayThroughBlinks) {
    set_environment({{"GAZE", "noise=5,blinks=60,blink=400"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrSpace gaze = client.reference_space(XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO),
                  head = client.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    int held = 0;
    float last = 0.0f;
    for (int i = 0; i < 60; ++i) {
        const XrSpaceLocation found = client.locate(gaze, head, client.empty_frame().predictedDisplayTime);
        EXPECT_NE(found.locationFlags, 0u);
        held += found.pose.orientation.y == last;
        last = found.pose.orientation.y;
    }
    EXPECT_GT(held, 15) << "two fifths of the frames lie in blinks";
    EXPECT_LT(held, 30);
}

TEST(GazeOptions, MistakesFailTheInstance) {
    for (const char* wrong : {"noise", "noise=", "noise=-1", "noise=nan", "latency=1000", "blinks=x",
                              "blink=5", "seed=-1", "sound=3", "noise=1;latency=2"}) {
        set_environment({{"GAZE", wrong}});
        XrInstance instance = XR_NULL_HANDLE;
        EXPECT_TRUE(XR_FAILED(create_instance(&instance))) << wrong;
    }
}

}  // namespace
}  // namespace foveray::simulator_tests
