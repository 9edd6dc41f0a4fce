// The event queue: order, what is lost, and sessions that are gone.
#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

XrResult poll(const SimulatorClient& client, XrEventDataBuffer& event) {
    event = {};
    event.type = XR_TYPE_EVENT_DATA_BUFFER;
    return xrPollEvent(client.instance, &event);
}

TEST(Events, OnesOfADestroyedSessionAreNotDelivered) {
    set_environment({});
    SimulatorClient client(headless_extensions);
    client.create_headless_session();
    client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    ASSERT_XR_SUCCESS(xrDestroySession(client.session));
    client.create_headless_session();
    EXPECT_EQ(client.take_states(),
              (std::vector{XR_SESSION_STATE_IDLE, XR_SESSION_STATE_READY}));  // of the second one only
}

TEST(Events, ABufferOfAnotherTypeIsRefusedAndNothingIsLost) {
    set_environment({});
    SimulatorClient client(headless_extensions);
    client.create_headless_session();
    XrEventDataBuffer event{};
    event.type = XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
    EXPECT_EQ(xrPollEvent(client.instance, &event), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(client.take_states().size(), 2u);
    EXPECT_EQ(poll(client, event), XR_EVENT_UNAVAILABLE);
}

TEST(Events, AClientThatNeverPollsIsToldHowManyItLost) {
    fakes::TemporaryFolder folder;
    constexpr int frames = 700;  // each with two events
    Session script = make_session(frames + 1);
    for (int i = 1; i < frames; ++i) {
        const bool odd = i % 2;
        script.events.push_back({from_seconds(i / 30.0), odd ? "visibility_lost" : "visibility_gained", ""});
    }
    write_session(folder.path() / "s", script);
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client(headless_extensions);
    client.create_headless_session();
    client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    for (int i = 1; i < frames; ++i) client.empty_frame();
    XrEventDataBuffer event{};
    ASSERT_XR_SUCCESS(poll(client, event));
    ASSERT_EQ(event.type, XR_TYPE_EVENT_DATA_EVENTS_LOST);
    const std::uint32_t lost = reinterpret_cast<const XrEventDataEventsLost&>(event).lostEventCount;
    EXPECT_EQ(lost + client.take_states().size(), 5u + 2 * (frames - 1)) << "five up to FOCUSED";
}

}  // namespace
}  // namespace foveray::simulator_tests
