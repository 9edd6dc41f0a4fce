// Reference spaces, tracking loss, recentring, gaze.
#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

constexpr XrSpaceLocationFlags all_flags = 15;

class ScriptedSpaces : public testing::Test {
  protected:
    void play(const Session& script) {
        write_session(folder_.path() / "s", script);
        set_environment({{"SESSION", folder_.path() / "s"}});
        client_ = std::make_unique<SimulatorClient>();
        client_->create_session();
        client_->begin_session();
        stage_ = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
        view_ = client_->reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
        local_ = client_->reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
    }

    fakes::TemporaryFolder folder_;
    std::unique_ptr<SimulatorClient> client_;
    XrSpace stage_ = XR_NULL_HANDLE, view_ = XR_NULL_HANDLE, local_ = XR_NULL_HANDLE;
};

TEST_F(ScriptedSpaces, HeadFollowsTheScriptWithItsVelocity) {
    Session script = make_session(60);
    const quat turned = glm::angleAxis(radians(90.0f), vec3(0, 1, 0));
    script.head = {{0, {quat(1, 0, 0, 0), vec3(0, 1.6f, 0)}},
                   {from_seconds(1.0), {turned, vec3(1, 1.6f, 0)}}};
    play(script);
    const XrTime start = client_->empty_frame().predictedDisplayTime;
    XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY, nullptr, 0, {}, {}};
    const XrSpaceLocation half = client_->locate(view_, stage_, start + from_seconds(0.5), &velocity);
    EXPECT_EQ(half.locationFlags, all_flags);
    EXPECT_NEAR(half.pose.position.x, 0.5f, 1e-5f);
    EXPECT_NEAR(half.pose.orientation.y, std::sin(radians(22.5f)), 1e-5f);
    EXPECT_EQ(velocity.velocityFlags, XrSpaceVelocityFlags{3});
    EXPECT_NEAR(velocity.linearVelocity.x, 1.0f, 1e-3f);
    EXPECT_NEAR(velocity.angularVelocity.y, pi / 2, 1e-2f);

    // A metre ahead of the turned head is a metre along -x of the stage.
    const XrSpace ahead = client_->reference_space(XR_REFERENCE_SPACE_TYPE_VIEW, {{0, 0, 0, 1}, {0, 0, -1}});
    const XrSpaceLocation end = client_->locate(ahead, stage_, start + from_seconds(1.0));
    EXPECT_NEAR(end.pose.position.x, 0.0f, 1e-5f);
    EXPECT_NEAR(end.pose.position.z, 0.0f, 1e-5f);

    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, nullptr, 0, {}};
    EXPECT_EQ(xrLocateSpace(view_, stage_, 0, &location), XR_ERROR_TIME_INVALID);
    const XrReferenceSpaceCreateInfo no_rotation{XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                                 nullptr,
                                                 XR_REFERENCE_SPACE_TYPE_VIEW,
                                                 {{0, 0, 0, 0}, {0, 0, 0}}};
    XrSpace space = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateReferenceSpace(client_->session, &no_rotation, &space), XR_ERROR_POSE_INVALID);
}

TEST_F(ScriptedSpaces, LostTrackingClearsTheFlags) {
    Session script = make_session(60);
    script.events = {{from_seconds(0.5), "head_tracking_lost", ""},
                     {from_seconds(1.0), "head_tracking_gained", ""}};
    play(script);
    const XrTime start = client_->empty_frame().predictedDisplayTime;
    for (const auto& [seconds, flags] :
         {std::pair{0.4, all_flags}, {0.6, XrSpaceLocationFlags{0}}, {1.1, all_flags}}) {
        const XrTime time = start + from_seconds(seconds);
        EXPECT_EQ(client_->locate(view_, stage_, time).locationFlags, flags) << seconds;
        XrViewStateFlags view_flags = 0;
        client_->locate_views(stage_, time, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, false, &view_flags);
        EXPECT_EQ(view_flags, flags) << seconds;
    }
    EXPECT_EQ(client_->locate(view_, view_, start + from_seconds(0.6)).locationFlags, all_flags);
}

TEST_F(ScriptedSpaces, RecentringMovesTheLocalSpaceAndSaysSo) {
    Session script = make_session(60);
    const Pose later{glm::angleAxis(radians(90.0f), vec3(0, 1, 0)), vec3(2, 1.5f, 1)};
    script.head = {{0, {quat(1, 0, 0, 0), vec3(0, 1.6f, 0)}}, {from_seconds(1 / 30.0), later}};
    script.events = {{from_seconds(2 / 30.0), "recenter", ""}};
    play(script);
    const XrTime start = client_->empty_frame().predictedDisplayTime;
    client_->empty_frame();
    client_->take_states();
    EXPECT_TRUE(client_->other_events.empty());
    const XrTime time = client_->empty_frame().predictedDisplayTime;
    client_->take_states();
    ASSERT_EQ(client_->other_events.size(), 1u);
    const auto& change =
        reinterpret_cast<const XrEventDataReferenceSpaceChangePending&>(client_->other_events[0]);
    ASSERT_EQ(change.type, XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING);
    EXPECT_EQ(change.referenceSpaceType, XR_REFERENCE_SPACE_TYPE_LOCAL);
    EXPECT_LE(change.changeTime, time);
    EXPECT_NEAR(change.poseInPreviousSpace.position.x, 2.0f, 1e-5f);
    EXPECT_NEAR(change.poseInPreviousSpace.position.y, -0.1f, 1e-5f);

    EXPECT_NEAR(client_->locate(local_, stage_, start).pose.position.y, 1.6f, 1e-6f);
    const XrPosef now = client_->locate(local_, stage_, time).pose;
    EXPECT_NEAR(now.position.x, 2.0f, 1e-6f);
    EXPECT_NEAR(now.orientation.y, std::sin(radians(45.0f)), 1e-6f);
}

TEST_F(ScriptedSpaces, StageHasBoundsAndUnknownSpacesAreRefused) {
    play(make_session(5));
    XrExtent2Df bounds{};
    EXPECT_EQ(xrGetReferenceSpaceBoundsRect(client_->session, XR_REFERENCE_SPACE_TYPE_STAGE, &bounds),
              XR_SUCCESS);
    EXPECT_GT(bounds.width, 0.0f);
    EXPECT_EQ(xrGetReferenceSpaceBoundsRect(client_->session, XR_REFERENCE_SPACE_TYPE_LOCAL, &bounds),
              XR_SPACE_BOUNDS_UNAVAILABLE);
    EXPECT_EQ(bounds.width, 0.0f);
    EXPECT_EQ(
        xrGetReferenceSpaceBoundsRect(client_->session, XR_REFERENCE_SPACE_TYPE_UNBOUNDED_MSFT, &bounds),
        XR_ERROR_REFERENCE_SPACE_UNSUPPORTED);
}

class Gaze : public ScriptedSpaces {
  protected:
    /// The gaze action bound, attached and focused.
    void play_with_gaze(const Session& script) {
        play(script);
        XrActionSetCreateInfo set_info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "gaze", "Gaze", 0};
        ASSERT_XR_SUCCESS(xrCreateActionSet(client_->instance, &set_info, &set_));
        XrActionCreateInfo info{
            XR_TYPE_ACTION_CREATE_INFO, nullptr, "gaze", XR_ACTION_TYPE_POSE_INPUT, 0, nullptr, "Gaze"};
        ASSERT_XR_SUCCESS(xrCreateAction(set_, &info, &action_));
        const XrActionSuggestedBinding binding{action_, client_->path("/user/eyes_ext/input/gaze_ext/pose")};
        const XrInteractionProfileSuggestedBinding suggestion{
            XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
            client_->path("/interaction_profiles/ext/eye_gaze_interaction"), 1, &binding};
        ASSERT_XR_SUCCESS(xrSuggestInteractionProfileBindings(client_->instance, &suggestion));
        const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1,
                                                   &set_};
        ASSERT_XR_SUCCESS(xrAttachSessionActionSets(client_->session, &attach));
        const XrActionSpaceCreateInfo space_info{
            XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, action_, XR_NULL_PATH, {{0, 0, 0, 1}, {0, 0, 0}}};
        ASSERT_XR_SUCCESS(xrCreateActionSpace(client_->session, &space_info, &space_));
        start_ = client_->empty_frame().predictedDisplayTime;
        const XrActiveActionSet active{set_, XR_NULL_PATH};
        const XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
        ASSERT_XR_SUCCESS(xrSyncActions(client_->session, &sync));
    }

    XrActionSet set_ = XR_NULL_HANDLE;
    XrAction action_ = XR_NULL_HANDLE;
    XrSpace space_ = XR_NULL_HANDLE;
    XrTime start_ = 0;
};

TEST_F(Gaze, HasItsSampleTimeAndIsInvalidInABlink) {
    Session script = make_session(60);
    script.head = {{0, {quat(1, 0, 0, 0), vec3(0, 1.7f, 0)}}};
    const vec3 right = glm::normalize(vec3(1, 0, -1));
    script.gaze = {{from_seconds(0.1), true, vec3(0.01f, 0, 0.02f), right},
                   {from_seconds(0.5), false, vec3(0), vec3(0, 0, -1)},
                   {from_seconds(0.8), true, vec3(0), vec3(0, 0, -1)}};
    play_with_gaze(script);

    XrEyeGazeSampleTimeEXT sample{XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT, nullptr, 0};
    const XrSpaceLocation looking = client_->locate(space_, stage_, start_ + from_seconds(0.3), &sample);
    EXPECT_EQ(looking.locationFlags, all_flags);
    EXPECT_EQ(sample.time, start_ + from_seconds(0.1));
    EXPECT_NEAR(looking.pose.position.x, 0.01f, 1e-6f);
    EXPECT_NEAR(looking.pose.position.y, 1.7f, 1e-6f);
    const XrQuaternionf q = looking.pose.orientation;
    const vec3 direction = quat(q.w, q.x, q.y, q.z) * vec3(0, 0, -1);
    EXPECT_NEAR(glm::distance(direction, right), 0.0f, 1e-5f);

    EXPECT_EQ(client_->locate(space_, view_, start_ + from_seconds(0.6), &sample).locationFlags, 0u);
    EXPECT_EQ(sample.time, 0);
    EXPECT_EQ(client_->locate(space_, view_, start_ + from_seconds(0.9), &sample).locationFlags, all_flags);

    // The gaze that XR_VARJO_foveated_rendering renders for is held through the blink, as the focus views
    // are.
    const XrSpace eye = client_->reference_space(XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO);
    EXPECT_EQ(client_->locate(eye, view_, start_ + from_seconds(0.05)).locationFlags, 0u) << "none yet";
    for (const double seconds : {0.3, 0.6}) {
        const XrSpaceLocation held = client_->locate(eye, view_, start_ + from_seconds(seconds));
        EXPECT_EQ(held.locationFlags, all_flags) << seconds;
        EXPECT_NEAR(held.pose.orientation.y, -std::sin(radians(22.5f)), 1e-5f) << seconds;
    }
}

TEST_F(Gaze, LooksAheadWithoutRecordedGaze) {
    play_with_gaze(make_session(60));
    const XrTime time = start_ + from_seconds(0.5);
    XrEyeGazeSampleTimeEXT sample{XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT, nullptr, 0};
    const XrSpaceLocation location = client_->locate(space_, view_, time, &sample);
    EXPECT_EQ(location.locationFlags, all_flags);
    EXPECT_EQ(sample.time, time);
    EXPECT_FLOAT_EQ(location.pose.orientation.w, 1.0f);
}

TEST(EyeTracking, IsAPropertyOfTheProfile) {
    for (const auto& [profile, tracks] : {std::pair{"ci", XR_TRUE}, {"valve-index", XR_FALSE}}) {
        set_environment({{"PROFILE", profile}});
        SimulatorClient client;
        XrSystemFoveatedRenderingPropertiesVARJO foveated{XR_TYPE_SYSTEM_FOVEATED_RENDERING_PROPERTIES_VARJO,
                                                          nullptr, 2};
        XrSystemEyeGazeInteractionPropertiesEXT gaze{XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT,
                                                     &foveated, 2};
        XrSystemProperties properties{};
        properties.type = XR_TYPE_SYSTEM_PROPERTIES;
        properties.next = &gaze;
        ASSERT_XR_SUCCESS(xrGetSystemProperties(client.instance, client.system, &properties));
        EXPECT_EQ(gaze.supportsEyeGazeInteraction, tracks);
        EXPECT_EQ(foveated.supportsFoveatedRendering, tracks == XR_TRUE ? 1u : 2u)
            << "not offered without a focus display, so left as it is";
        EXPECT_GE(properties.graphicsProperties.maxLayerCount,
                  std::uint32_t{XR_MIN_COMPOSITION_LAYERS_SUPPORTED});
    }
}

}  // namespace
}  // namespace foveray::simulator_tests
