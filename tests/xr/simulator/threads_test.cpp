// Threads that call at once. The sanitizers look on.
#include <atomic>
#include <functional>
#include <thread>

#include "tests/xr/simulator/action_client.h"

namespace foveray::simulator_tests {
namespace {

/// Runs all at once, each again and again until `rounds` are done.
void run_together(int rounds, const std::vector<std::function<void(int)>>& bodies) {
    std::vector<std::thread> threads;
    for (const auto& body : bodies) {
        threads.emplace_back([&body, rounds] {
            for (int i = 0; i < rounds; ++i) body(i);
        });
    }
    for (std::thread& thread : threads) thread.join();
}

TEST(Threads, QueriesRunBesideTheFrameLoop) {
    set_environment({});
    auto made = std::make_unique<SimulatorClient>(headless_extensions);
    made->create_headless_session();
    made->begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    ActionClient actions(std::move(made));
    SimulatorClient& client = *actions.client;
    const XrActionSet set = actions.create_set("set");
    const XrAction hand = actions.create(set, "hand", XR_ACTION_TYPE_POSE_INPUT),
                   fire = actions.create(set, "fire", XR_ACTION_TYPE_BOOLEAN_INPUT);
    ASSERT_XR_SUCCESS(actions.suggest(
        "khr/simple_controller",
        {{hand, "/user/hand/left/input/grip/pose"}, {fire, "/user/hand/left/input/select/click"}}));
    ASSERT_XR_SUCCESS(actions.attach({set}));
    const XrSpace grip = actions.create_space(hand),
                  stage = client.reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    const auto set_active = client.function<PFN_xrSetInputDeviceActiveEXT>("xrSetInputDeviceActiveEXT");
    const XrPath simple = client.path("/interaction_profiles/khr/simple_controller");
    run_together(300, {[&](int) { client.empty_frame(); },
                       [&](int) {
                           EXPECT_GE(actions.sync({{set, XR_NULL_PATH}}), 0);
                       },
                       [&](int) { client.locate(grip, stage, nanoseconds_per_second); },
                       [&](int i) {
                           EXPECT_EQ(set_active(client.session, simple, actions.hands[0], i % 2 == 0),
                                     XR_SUCCESS);
                       },
                       [&](int) {
                           actions.read_boolean(fire);
                           actions.current_profile(actions.hands[0]);
                       },
                       [&](int i) { client.path("/thread/" + std::to_string(i)); },
                       [&](int) {
                           XrEventDataBuffer event{};
                           event.type = XR_TYPE_EVENT_DATA_BUFFER;
                           EXPECT_GE(xrPollEvent(client.instance, &event), 0);
                       }});
}

TEST(Threads, ObjectsAreMadeAndDestroyedAtOnce) {
    set_environment({});
    auto made = std::make_unique<SimulatorClient>(headless_extensions);
    made->create_headless_session();
    ActionClient actions(std::move(made));
    SimulatorClient& client = *actions.client;
    const auto sets = [&](const std::string& name) {
        return [&actions, name](int i) {
            const XrActionSet set = actions.create_set((name + std::to_string(i)).c_str());
            actions.create(set, "action", XR_ACTION_TYPE_FLOAT_INPUT);
            EXPECT_EQ(xrDestroyActionSet(set), XR_SUCCESS);
        };
    };
    const auto spaces = [&](int) {
        EXPECT_EQ(xrDestroySpace(client.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW)), XR_SUCCESS);
    };
    run_together(200, {sets("a"), sets("b"), spaces, spaces});
}

TEST(Threads, ASessionGoesWhileItIsUsed) {
    set_environment({});
    SimulatorClient client(headless_extensions);
    std::atomic<XrSession> session = XR_NULL_HANDLE;
    std::atomic<bool> done = false;
    std::thread user([&] {
        while (!done) {
            XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
            if (XR_FAILED(xrWaitFrame(session, nullptr, &state))) continue;
            xrBeginFrame(session, nullptr);
            const XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO,           nullptr, state.predictedDisplayTime,
                                      XR_ENVIRONMENT_BLEND_MODE_OPAQUE, 0,       nullptr};
            xrEndFrame(session, &info);
        }
    });
    for (int i = 0; i < 100; ++i) {
        client.create_headless_session();
        client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
        session = client.session;
        std::this_thread::yield();
        EXPECT_EQ(xrDestroySession(client.session), XR_SUCCESS);
    }
    client.session = XR_NULL_HANDLE;
    done = true;
    user.join();
}

}  // namespace
}  // namespace foveray::simulator_tests
