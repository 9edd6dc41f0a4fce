#include "tests/xr/client/headset_fixture.h"

#include <chrono>
#include <cstdlib>
#include <thread>

namespace foveray::xr {

void HeadsetTest::SetUp() {
    session_.headset = "ci";
    session_.rate_hz = 10;
    session_.frames = 6;
    session_.head = {{0, {quat(1, 0, 0, 0), {0, 1.5f, 0}}},
                     {5 * period, {glm::angleAxis(0.5f, vec3(0, 1, 0)), {0.5f, 1.5f, 0}}}};
    const vec3 aside = glm::normalize(vec3(0.2f, -0.1f, -1));
    session_.gaze = {{0, true, {}, aside}, {3 * period, false, {}, aside}, {4 * period, true, {}, aside}};
    ControllerState hand;
    hand.valid = true;
    hand.trigger = 1.0f;  // the profile's controller has only select, which the trigger presses
    hand.stage_from_grip.position = {0.3f, 1.0f, -0.4f};
    hand.stage_from_aim = hand.stage_from_grip;
    session_.controllers = {{0, 1, hand}};
}

void HeadsetTest::TearDown() { ::unsetenv("XR_RUNTIME_JSON"); }

SimulatorOptions HeadsetTest::options() {
    write_session(folder_.path() / "session", session_);
    SimulatorOptions simulator;
    simulator.session = folder_.path() / "session";
    simulator.virtual_time = true;
    return simulator;
}

HeadsetTest::Played HeadsetTest::play(const SimulatorOptions& simulator, BlendMode blend, const Each& each) {
    Played played;
    Headset headset(RuntimeChoice::Simulator, simulator, patience_);
    const gpu::Device device({.validation = true}, headset.device_source());
    const StopAtEnd stop_at_end(headset);
    headset.start(device, blend, 0.1f, 50.0f);
    std::vector<gpu::Buffer> buffers;  // the submission's
    gpu::FrameRing ring(device, 1);
    for (int turns = 0; turns < 1000; ++turns) {
        const Headset::State state = headset.poll();
        played.ended = state == Headset::State::Ended;
        if (played.ended) break;
        if (state == Headset::State::Lost) {
            ring.wait();
            headset.reconnect();
        } else if (state == Headset::State::Waiting) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } else if (const auto frame = headset.begin_frame()) {
            if (frame->should_render) each(headset, device, ring, *frame, buffers);
            headset.end_frame(*frame);
            played.frames.push_back(*frame);
        }
    }
    ring.wait();
    headset.stop();
    played.messages = device.validation_messages();
    return played;
}

}  // namespace foveray::xr
