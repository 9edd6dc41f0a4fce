#pragma once

#include "tests/xr/simulator/action_client.h"
#include "tests/xr/simulator/faults_file.h"

namespace foveray::simulator_tests {

/// Reads the gaze of frame after frame, as XR_EXT_eye_gaze_interaction has it.
class GazeClient {
  public:
    struct Look {
        bool valid = false;
        XrTime frame = 0, sample = 0;
        vec3 direction{0.0f};  // in the head's frame
        XrPosef stage_from_head{};
    };

    GazeClient() : actions_(begin()) {
        const XrActionSet set = actions_.create_set("set");
        const XrAction look = actions_.create(set, "look", XR_ACTION_TYPE_POSE_INPUT);
        EXPECT_EQ(
            actions_.suggest("ext/eye_gaze_interaction", {{look, "/user/eyes_ext/input/gaze_ext/pose"}}),
            XR_SUCCESS);
        EXPECT_EQ(actions_.attach({set}), XR_SUCCESS);
        client().empty_frame();
        EXPECT_EQ(actions_.sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
        gaze_ = actions_.create_space(look);
        head_ = client().reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
        stage_ = client().reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    }

    SimulatorClient& client() { return *actions_.client; }
    Look at(XrTime time) {
        XrEyeGazeSampleTimeEXT sample{XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT, nullptr, 0};
        const XrSpaceLocation found = client().locate(gaze_, head_, time, &sample);
        const XrQuaternionf& q = found.pose.orientation;
        return {found.locationFlags != 0, time, sample.time,
                quat(q.w, q.x, q.y, q.z) * vec3(0.0f, 0.0f, -1.0f),
                client().locate(head_, stage_, time).pose};
    }
    std::vector<Look> frames(int count) {
        std::vector<Look> looks;
        for (int i = 0; i < count; ++i) looks.push_back(at(client().empty_frame().predictedDisplayTime));
        return looks;
    }

  private:
    static std::unique_ptr<SimulatorClient> begin() {
        auto client = std::make_unique<SimulatorClient>(headless_extensions);
        begin_headless(*client);
        return client;
    }

    ActionClient actions_;
    XrSpace gaze_ = XR_NULL_HANDLE, head_ = XR_NULL_HANDLE, stage_ = XR_NULL_HANDLE;
};

inline float degrees_between(vec3 a, vec3 b) {
    return degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

}  // namespace foveray::simulator_tests
