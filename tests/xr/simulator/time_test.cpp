// XR_KHR_convert_timespec_time, which virtual time cannot have.
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

TEST(TimespecTime, IsTheMonotonicClock) {
    set_environment({{"TIME", "real"}});
    SimulatorClient client({XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME, XR_MND_HEADLESS_EXTENSION_NAME});
    const auto to_time =
        client.function<PFN_xrConvertTimespecTimeToTimeKHR>("xrConvertTimespecTimeToTimeKHR");
    const auto to_clock =
        client.function<PFN_xrConvertTimeToTimespecTimeKHR>("xrConvertTimeToTimespecTimeKHR");
    timespec clock{}, back{};
    clock_gettime(CLOCK_MONOTONIC, &clock);
    XrTime time = 0;
    ASSERT_XR_SUCCESS(to_time(client.instance, &clock, &time));
    ASSERT_XR_SUCCESS(to_clock(client.instance, time, &back));
    EXPECT_EQ(back.tv_sec, clock.tv_sec);
    EXPECT_EQ(back.tv_nsec, clock.tv_nsec);

    client.create_headless_session();
    client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    const XrFrameState frame = client.empty_frame();
    EXPECT_GE(frame.predictedDisplayTime, time) << "frames lie ahead of a clock read before";
    EXPECT_LT(frame.predictedDisplayTime, time + 10 * nanoseconds_per_second);
}

TEST(TimespecTime, ImpossibleTimesAreRefused) {
    set_environment({{"TIME", "real"}});
    SimulatorClient client({XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME});
    const auto to_time =
        client.function<PFN_xrConvertTimespecTimeToTimeKHR>("xrConvertTimespecTimeToTimeKHR");
    const auto to_clock =
        client.function<PFN_xrConvertTimeToTimespecTimeKHR>("xrConvertTimeToTimespecTimeKHR");
    timespec clock{};
    XrTime time = 0;
    EXPECT_EQ(to_clock(client.instance, 0, &clock), XR_ERROR_TIME_INVALID);
    EXPECT_EQ(to_clock(client.instance, -1, &clock), XR_ERROR_TIME_INVALID);
    EXPECT_EQ(to_clock(client.instance, 1, nullptr), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(to_time(client.instance, nullptr, &time), XR_ERROR_VALIDATION_FAILURE);
    clock.tv_nsec = 1'000'000'000;
    EXPECT_EQ(to_time(client.instance, &clock, &time), XR_ERROR_VALIDATION_FAILURE);
    clock = {INT64_MAX, 0};
    EXPECT_EQ(to_time(client.instance, &clock, &time), XR_ERROR_TIME_INVALID);
    clock = {0, 0};
    EXPECT_EQ(to_time(client.instance, &clock, &time), XR_ERROR_TIME_INVALID);
    clock = {-5, 0};
    EXPECT_EQ(to_time(client.instance, &clock, &time), XR_ERROR_TIME_INVALID);
}

TEST(TimespecTime, IsNotOfferedInVirtualTime) {
    set_environment({{"TIME", "virtual"}});
    XrInstanceCreateInfo info{};
    info.type = XR_TYPE_INSTANCE_CREATE_INFO;
    info.applicationInfo = {"virtual", 0, "", 0, XR_MAKE_VERSION(1, 0, 0)};
    const char* const name = XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME;
    info.enabledExtensionCount = 1;
    info.enabledExtensionNames = &name;
    XrInstance instance = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateInstance(&info, &instance), XR_ERROR_EXTENSION_NOT_PRESENT);
}

}  // namespace
}  // namespace foveray::simulator_tests
