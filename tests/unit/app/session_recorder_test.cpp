#include "app/session_recorder.h"

#include <gtest/gtest.h>

#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray::app {
namespace {

Frame frame_at(std::uint64_t index, Nanoseconds time) {
    Frame frame;
    frame.index = index;
    frame.time = time;
    frame.display_time = time + 5'000'000'000;
    frame.period = 10'000'000;
    frame.head_valid = true;
    frame.stage_from_head = {glm::angleAxis(0.5f, vec3(0, 1, 0)), {1, 1.5f, 0}};
    frame.has_eye_tracking = true;
    frame.gaze.valid = true;
    frame.gaze.time = frame.display_time - 3'000'000;
    frame.gaze.direction = transform_direction(frame.stage_from_head, {0, 0, -1});
    frame.gaze.origin = frame.stage_from_head.position;
    return frame;
}

TEST(SessionRecorder, KeepsTimeWhenFramesAreSkippedAndGazeInTheHeadsFrame) {
    const fakes::TemporaryFolder folder;
    SessionRecorder recorder(folder.path() / "session", Session{});
    recorder.add(frame_at(0, 0));
    Frame late = frame_at(1, 40'000'000);
    late.period *= 4;  // the runtime is slow
    recorder.add(late);
    recorder.finish();
    const Session session = read_session(folder.path() / "session");
    EXPECT_EQ(session.frames, 5u);
    EXPECT_DOUBLE_EQ(session.rate_hz, 100.0);
    ASSERT_EQ(session.gaze.size(), 2u);
    EXPECT_EQ(session.gaze[1].time, 37'000'000);
    EXPECT_LT(glm::length(session.gaze[1].direction - vec3(0, 0, -1)), 1e-5f);
    EXPECT_LT(glm::length(session.gaze[1].origin), 1e-5f);
}

TEST(SessionRecorder, KeepsQualityWhereItChanges) {
    const fakes::TemporaryFolder folder;
    SessionRecorder recorder(folder.path() / "session", Session{});
    const Session::QualitySample first{0, 1.0f, 4, 1, 64, 1}, second{30, 0.5f, 4, 1, 64, 1};
    recorder.add(frame_at(0, 0));
    for (const Nanoseconds time : {0, 10, 20}) {
        Session::QualitySample sample = first;
        sample.time = time;
        recorder.add(sample);
    }
    recorder.add(second);
    recorder.finish();
    EXPECT_EQ(read_session(folder.path() / "session").quality, (std::vector{first, second}));
}

TEST(SessionRecorder, TellsWhereTheHeadIsNotTracked) {
    const fakes::TemporaryFolder folder;
    SessionRecorder recorder(folder.path() / "session", Session{});
    for (std::uint64_t i = 0; i < 6; ++i) {
        Frame frame = frame_at(i, static_cast<Nanoseconds>(i) * 10'000'000);
        frame.head_valid = i < 2 || i > 3;
        frame.head_position_tracked = i < 1;
        frame.head_orientation_tracked = frame.head_valid;
        recorder.add(frame);
    }
    recorder.finish();
    const Session session = read_session(folder.path() / "session");
    EXPECT_EQ(session.frames, 6u);
    EXPECT_EQ(session.head.size(), 4u);
    std::vector<std::pair<Nanoseconds, std::string>> events;
    for (const Session::Event& event : session.events) events.emplace_back(event.time, event.name);
    EXPECT_EQ(events,
              (std::vector<std::pair<Nanoseconds, std::string>>{{10'000'000, "position_tracking_lost"},
                                                                {20'000'000, "head_tracking_lost"},
                                                                {40'000'000, "head_tracking_gained"}}));
}

TEST(SessionRecorder, NeverReplacesARecording) {
    const fakes::TemporaryFolder folder;
    folder.write("session/session.json", "{}");
    fakes::expect_fault([&] { SessionRecorder recorder(folder.path() / "session", Session{}); },
                        ExitCode::BadInput, "not an earlier result");
}

}  // namespace
}  // namespace foveray::app
