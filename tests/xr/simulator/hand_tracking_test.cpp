// XR_EXT_hand_tracking: hands round the controllers, scripted joints, arguments.
#include <cmath>
#include <fstream>

#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

struct Hand {
    bool active = false;
    std::vector<XrHandJointLocationEXT> joints;
    std::vector<XrHandJointVelocityEXT> velocities;

    vec3 at(XrHandJointEXT joint) const {
        const XrVector3f& p = joints[joint].pose.position;
        return {p.x, p.y, p.z};
    }
};

class HandTracking : public testing::Test {
  protected:
    void play(const Session& script, const std::string& hands_csv = "") {
        write_session(folder_.path() / "s", script);
        if (!hands_csv.empty()) std::ofstream(folder_.path() / "s" / "hands.csv") << hands_csv;
        set_environment({{"SESSION", folder_.path() / "s"}});
        client_ = std::make_unique<SimulatorClient>(headless_extensions);
        client_->create_headless_session();
        client_->begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
        stage_ = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    }

    XrHandTrackerEXT track(XrHandEXT hand) {
        const XrHandTrackerCreateInfoEXT info{XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT, nullptr, hand,
                                              XR_HAND_JOINT_SET_DEFAULT_EXT};
        XrHandTrackerEXT tracker = XR_NULL_HANDLE;
        EXPECT_EQ(client_->function<PFN_xrCreateHandTrackerEXT>("xrCreateHandTrackerEXT")(client_->session,
                                                                                          &info, &tracker),
                  XR_SUCCESS);
        return tracker;
    }

    XrResult locate(XrHandTrackerEXT tracker, XrTime time, Hand& hand, std::uint32_t count,
                    std::uint32_t velocity_count) {
        hand.joints.resize(XR_HAND_JOINT_COUNT_EXT);
        hand.velocities.resize(XR_HAND_JOINT_COUNT_EXT);
        XrHandJointVelocitiesEXT velocities{XR_TYPE_HAND_JOINT_VELOCITIES_EXT, nullptr, velocity_count,
                                            hand.velocities.data()};
        XrHandJointLocationsEXT locations{XR_TYPE_HAND_JOINT_LOCATIONS_EXT, &velocities, XR_FALSE, count,
                                          hand.joints.data()};
        const XrHandJointsLocateInfoEXT info{XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT, nullptr, stage_, time};
        const XrResult result =
            client_->function<PFN_xrLocateHandJointsEXT>("xrLocateHandJointsEXT")(tracker, &info, &locations);
        hand.active = locations.isActive;
        return result;
    }
    Hand locate(XrHandTrackerEXT tracker, XrTime time) {
        Hand hand;
        EXPECT_EQ(locate(tracker, time, hand, XR_HAND_JOINT_COUNT_EXT, XR_HAND_JOINT_COUNT_EXT), XR_SUCCESS);
        return hand;
    }

    fakes::TemporaryFolder folder_;
    std::unique_ptr<SimulatorClient> client_;
    XrSpace stage_ = XR_NULL_HANDLE;
};

Session with_controllers() {
    Session script = make_session(100);
    ControllerState state;
    state.valid = true;
    // The palms face each other, thumbs up, fingers ahead: the grip's -z points up.
    for (const int hand : {0, 1}) {
        state.stage_from_grip = {glm::angleAxis(radians(90.0f), vec3(1, 0, 0)),
                                 vec3(hand == 0 ? -0.2f : 0.2f, 1.2f, -0.3f)};
        state.stage_from_aim = state.stage_from_grip;
        script.controllers.push_back({0, hand, state});
    }
    return script;
}

TEST_F(HandTracking, HandsHoldTheControllers) {
    play(with_controllers());
    const XrTime time = client_->empty_frame().predictedDisplayTime;
    for (const XrHandEXT which : {XR_HAND_LEFT_EXT, XR_HAND_RIGHT_EXT}) {
        const float inwards = which == XR_HAND_LEFT_EXT ? 1.0f : -1.0f;
        const Hand hand = locate(track(which), time);
        ASSERT_TRUE(hand.active);
        for (const XrHandJointLocationEXT& joint : hand.joints) {
            EXPECT_EQ(joint.locationFlags, XrSpaceLocationFlags{15});
            EXPECT_GT(joint.radius, 0.0f);
        }
        for (const XrHandJointVelocityEXT& velocity : hand.velocities) {
            EXPECT_EQ(velocity.velocityFlags, XrSpaceVelocityFlags{3});
            EXPECT_FLOAT_EQ(velocity.linearVelocity.x, 0.0f);
        }
        const vec3 palm = hand.at(XR_HAND_JOINT_PALM_EXT);
        EXPECT_NEAR(glm::distance(palm, vec3(-0.2f * inwards, 1.2f, -0.3f)), 0.0f, 1e-5f);
        EXPECT_GT(hand.at(XR_HAND_JOINT_WRIST_EXT).z, palm.z + 0.05f) << "the wrist is behind";
        EXPECT_LT(hand.at(XR_HAND_JOINT_MIDDLE_TIP_EXT).z, palm.z - 0.05f) << "the fingers point ahead";
        EXPECT_GT(hand.at(XR_HAND_JOINT_THUMB_TIP_EXT).y, hand.at(XR_HAND_JOINT_LITTLE_TIP_EXT).y + 0.03f)
            << "the thumb is on top";
        EXPECT_GT((hand.at(XR_HAND_JOINT_MIDDLE_TIP_EXT).x - palm.x) * inwards, 0.01f)
            << "fingers bend to the palm's side";
    }
}

TEST_F(HandTracking, SqueezingBendsTheFingers) {
    Session script = with_controllers();
    Session::ControllerSample squeezed = script.controllers[0];
    squeezed.time = from_seconds(1.0);
    squeezed.state.squeeze = 1.0f;
    script.controllers.push_back(squeezed);
    play(script);
    const XrTime time = client_->empty_frame().predictedDisplayTime;
    const XrHandTrackerEXT tracker = track(XR_HAND_LEFT_EXT);
    const auto reach = [&](XrHandJointEXT tip, double seconds) {
        const Hand hand = locate(tracker, time + from_seconds(seconds));
        return glm::distance(hand.at(tip), hand.at(XR_HAND_JOINT_PALM_EXT));
    };
    EXPECT_LT(reach(XR_HAND_JOINT_RING_TIP_EXT, 1.5), reach(XR_HAND_JOINT_RING_TIP_EXT, 0.5) - 0.03f);
    EXPECT_FLOAT_EQ(reach(XR_HAND_JOINT_INDEX_TIP_EXT, 1.5), reach(XR_HAND_JOINT_INDEX_TIP_EXT, 0.5))
        << "that one is the trigger's";
}

TEST_F(HandTracking, ScriptedJointsArePlayed) {
    std::string csv = "time_ns,hand,joint,valid,px,py,pz,qx,qy,qz,qw,radius\n";
    const auto add = [&](std::int64_t time, int valid, float x) {
        for (int joint = 0; joint < XR_HAND_JOINT_COUNT_EXT; ++joint) {
            csv += std::to_string(time) + ",right," + std::to_string(joint) + "," + std::to_string(valid) +
                   "," + std::to_string(x + 0.01f * static_cast<float>(joint)) + ",1,0,0,0,0,1,0.01\n";
        }
    };
    add(0, 1, 0.0f), add(1'000'000'000, 1, 0.5f), add(2'000'000'000, 0, 0.0f);
    play(with_controllers(), csv);
    const XrTime time = client_->empty_frame().predictedDisplayTime;
    const XrHandTrackerEXT right = track(XR_HAND_RIGHT_EXT);
    EXPECT_NEAR(locate(right, time).at(XR_HAND_JOINT_LITTLE_TIP_EXT).x, 0.25f, 1e-5f);
    EXPECT_NEAR(locate(right, time + from_seconds(1.5)).at(XR_HAND_JOINT_PALM_EXT).x, 0.5f, 1e-5f);
    const Hand lost = locate(right, time + from_seconds(2.5));
    EXPECT_FALSE(lost.active);
    for (const XrHandJointLocationEXT& joint : lost.joints) EXPECT_EQ(joint.locationFlags, 0u);
    for (const XrHandJointVelocityEXT& velocity : lost.velocities) EXPECT_EQ(velocity.velocityFlags, 0u);
    EXPECT_FALSE(locate(track(XR_HAND_LEFT_EXT), time).active) << "the stream has no left hand";
}

TEST_F(HandTracking, BrokenStreamsNameTheirLine) {
    const std::string header = "time_ns,hand,joint,valid,px,py,pz,qx,qy,qz,qw,radius\n";
    for (const std::string row : {"0,right,3,1,0,0,0,0,0,0,1,0.01\n", "0,middle,0,1,0,0,0,0,0,0,1,0.01\n",
                                  "0,right,0,1,0,0,0,0,0,0,0,0.01\n", "0,right,0,1,0,0,0,0,0,0,1,0.01\n"}) {
        write_session(folder_.path() / "s", make_session(3));
        std::ofstream(folder_.path() / "s" / "hands.csv") << header << row;
        set_environment({{"SESSION", folder_.path() / "s"}});
        XrInstanceCreateInfo info{};
        info.type = XR_TYPE_INSTANCE_CREATE_INFO;
        info.applicationInfo = {"broken", 0, "", 0, XR_MAKE_VERSION(1, 0, 0)};
        XrInstance instance = XR_NULL_HANDLE;
        testing::internal::CaptureStderr();
        EXPECT_NE(xrCreateInstance(&info, &instance), XR_SUCCESS) << row;
        EXPECT_NE(testing::internal::GetCapturedStderr().find("hands.csv"), std::string::npos) << row;
    }
}

TEST_F(HandTracking, ArgumentsAreVerified) {
    play(with_controllers());
    const XrTime time = client_->empty_frame().predictedDisplayTime;
    const auto create = client_->function<PFN_xrCreateHandTrackerEXT>("xrCreateHandTrackerEXT");
    XrHandTrackerEXT tracker = XR_NULL_HANDLE;
    XrHandTrackerCreateInfoEXT info{XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT, nullptr, XR_HAND_MAX_ENUM_EXT,
                                    XR_HAND_JOINT_SET_DEFAULT_EXT};
    EXPECT_EQ(create(client_->session, &info, &tracker), XR_ERROR_VALIDATION_FAILURE);
    info.hand = XR_HAND_LEFT_EXT;
    info.handJointSet = XR_HAND_JOINT_SET_MAX_ENUM_EXT;
    EXPECT_EQ(create(client_->session, &info, &tracker), XR_ERROR_VALIDATION_FAILURE);
    const XrHandTrackerEXT left = track(XR_HAND_LEFT_EXT);
    Hand hand;
    EXPECT_EQ(locate(left, time, hand, 25, 26), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(locate(left, time, hand, 26, 25), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(locate(left, 0, hand, 26, 26), XR_ERROR_TIME_INVALID);
}

TEST_F(HandTracking, IsPromisedToThoseWhoAskForIt) {
    set_environment({});
    for (const bool enabled : {false, true}) {
        SimulatorClient client(enabled ? headless_extensions
                                       : std::vector<const char*>{XR_MND_HEADLESS_EXTENSION_NAME});
        XrSystemHandTrackingPropertiesEXT hands{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT, nullptr,
                                                XR_FALSE};
        XrSystemProperties properties{};
        properties.type = XR_TYPE_SYSTEM_PROPERTIES;
        properties.next = &hands;
        ASSERT_XR_SUCCESS(xrGetSystemProperties(client.instance, client.system, &properties));
        EXPECT_EQ(bool(hands.supportsHandTracking), enabled);
    }
}

}  // namespace
}  // namespace foveray::simulator_tests
