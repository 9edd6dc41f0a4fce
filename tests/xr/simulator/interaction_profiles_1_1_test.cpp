// The interaction profiles and inputs that came with OpenXR 1.1.
#include <map>
#include <sstream>

#include "tests/xr/simulator/action_client.h"

#ifdef XR_VERSION_1_1
namespace foveray::simulator_tests {
namespace {

constexpr auto boolean = XR_ACTION_TYPE_BOOLEAN_INPUT;
constexpr auto number = XR_ACTION_TYPE_FLOAT_INPUT;
constexpr auto vector = XR_ACTION_TYPE_VECTOR2F_INPUT;
constexpr auto pose = XR_ACTION_TYPE_POSE_INPUT;
constexpr auto haptic = XR_ACTION_TYPE_VIBRATION_OUTPUT;
constexpr auto left = "/user/hand/left", right = "/user/hand/right",
               both = "/user/hand/left /user/hand/right";

struct Inputs {
    const char *profile, *users;
    XrActionType type;
    const char* inputs;
};

/// The Khronos registry's xr.xml, version 1.1.
const Inputs specified_inputs[] = {
    {"ml/ml2_controller", both, boolean,
     "input/menu/click input/home/click input/trigger/click input/trackpad/click input/trackpad/touch "
     "input/shoulder/click"},
    {"ml/ml2_controller", both, number,
     "input/trigger/value input/trackpad/x input/trackpad/y input/trackpad/force"},
    {"ml/ml2_controller", both, vector, "input/trackpad"},
    {"ml/ml2_controller", both, pose, "input/grip/pose input/aim/pose input/grip_surface/pose"},
    {"ml/ml2_controller", both, haptic, "output/haptic"},
    {"bytedance/pico_neo3_controller", left, boolean,
     "input/x/click input/x/touch input/y/click input/y/touch"},
    {"bytedance/pico_neo3_controller", right, boolean,
     "input/a/click input/a/touch input/b/click input/b/touch"},
    {"bytedance/pico_neo3_controller", both, boolean,
     "input/system/click input/menu/click input/squeeze/click input/trigger/click input/trigger/touch "
     "input/thumbstick/click input/thumbstick/touch"},
    {"bytedance/pico_neo3_controller", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y"},
    {"bytedance/pico_neo3_controller", both, vector, "input/thumbstick"},
    {"bytedance/pico_neo3_controller", both, pose, "input/grip/pose input/aim/pose input/grip_surface/pose"},
    {"bytedance/pico_neo3_controller", both, haptic, "output/haptic"},
    {"bytedance/pico4_controller", left, boolean,
     "input/x/click input/x/touch input/y/click input/menu/click input/y/touch"},
    {"bytedance/pico4_controller", right, boolean, "input/a/click input/a/touch input/b/click input/b/touch"},
    {"bytedance/pico4_controller", both, boolean,
     "input/system/click input/squeeze/click input/trigger/click input/trigger/touch input/thumbstick/click "
     "input/thumbstick/touch"},
    {"bytedance/pico4_controller", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y"},
    {"bytedance/pico4_controller", both, vector, "input/thumbstick"},
    {"bytedance/pico4_controller", both, pose, "input/grip/pose input/aim/pose input/grip_surface/pose"},
    {"bytedance/pico4_controller", both, haptic, "output/haptic"},
    {"bytedance/pico_g3_controller", both, boolean,
     "input/trigger/click input/menu/click input/thumbstick/click"},
    {"bytedance/pico_g3_controller", both, number, "input/trigger/value"},
    {"bytedance/pico_g3_controller", both, pose, "input/grip/pose input/aim/pose input/grip_surface/pose"},
    {"bytedance/pico_g3_controller", both, vector, "input/thumbstick"},
    {"htc/vive_cosmos_controller", left, boolean, "input/x/click input/y/click input/menu/click"},
    {"htc/vive_cosmos_controller", right, boolean, "input/a/click input/b/click input/system/click"},
    {"htc/vive_cosmos_controller", both, boolean,
     "input/shoulder/click input/squeeze/click input/trigger/click input/thumbstick/click "
     "input/thumbstick/touch"},
    {"htc/vive_cosmos_controller", both, number, "input/trigger/value input/thumbstick/x input/thumbstick/y"},
    {"htc/vive_cosmos_controller", both, vector, "input/thumbstick"},
    {"htc/vive_cosmos_controller", both, pose, "input/grip/pose input/aim/pose input/grip_surface/pose"},
    {"htc/vive_cosmos_controller", both, haptic, "output/haptic"},
    {"htc/vive_focus3_controller", left, boolean, "input/x/click input/y/click input/menu/click"},
    {"htc/vive_focus3_controller", right, boolean, "input/a/click input/b/click input/system/click"},
    {"htc/vive_focus3_controller", both, boolean,
     "input/squeeze/click input/squeeze/touch input/trigger/click input/trigger/touch input/thumbstick/click "
     "input/thumbstick/touch input/thumbrest/touch"},
    {"htc/vive_focus3_controller", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y"},
    {"htc/vive_focus3_controller", both, vector, "input/thumbstick"},
    {"htc/vive_focus3_controller", both, pose, "input/grip/pose input/aim/pose input/grip_surface/pose"},
    {"htc/vive_focus3_controller", both, haptic, "output/haptic"},
    {"samsung/odyssey_controller", both, boolean,
     "input/menu/click input/squeeze/click input/thumbstick/click input/trackpad/click input/trackpad/touch"},
    {"samsung/odyssey_controller", both, number,
     "input/trigger/value input/thumbstick/x input/thumbstick/y input/trackpad/x input/trackpad/y"},
    {"samsung/odyssey_controller", both, vector, "input/thumbstick input/trackpad"},
    {"samsung/odyssey_controller", both, pose, "input/grip/pose input/aim/pose input/grip_surface/pose"},
    {"samsung/odyssey_controller", both, haptic, "output/haptic"},
    {"hp/mixed_reality_controller", left, boolean, "input/x/click input/y/click"},
    {"hp/mixed_reality_controller", right, boolean, "input/a/click input/b/click"},
    {"hp/mixed_reality_controller", both, boolean, "input/menu/click input/thumbstick/click"},
    {"hp/mixed_reality_controller", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y"},
    {"hp/mixed_reality_controller", both, vector, "input/thumbstick"},
    {"hp/mixed_reality_controller", both, pose, "input/grip/pose input/aim/pose input/grip_surface/pose"},
    {"hp/mixed_reality_controller", both, haptic, "output/haptic"},
    {"meta/touch_pro_controller", left, boolean,
     "input/x/click input/x/touch input/y/click input/y/touch input/menu/click"},
    {"meta/touch_pro_controller", right, boolean,
     "input/a/click input/a/touch input/b/click input/b/touch input/system/click"},
    {"meta/touch_pro_controller", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y input/thumbrest/force "
     "input/stylus/force input/trigger_curl/value input/trigger_slide/value"},
    {"meta/touch_pro_controller", both, boolean,
     "input/trigger/touch input/thumbstick/click input/thumbstick/touch input/thumbrest/touch "
     "input/thumb_resting_surfaces/proximity input/trigger/proximity"},
    {"meta/touch_pro_controller", both, vector, "input/thumbstick"},
    {"meta/touch_pro_controller", both, pose, "input/grip_surface/pose input/grip/pose input/aim/pose"},
    {"meta/touch_pro_controller", both, haptic, "output/haptic output/haptic_trigger output/haptic_thumb"},
    {"meta/touch_plus_controller", left, boolean,
     "input/x/click input/x/touch input/y/click input/y/touch input/menu/click"},
    {"meta/touch_plus_controller", right, boolean,
     "input/a/click input/a/touch input/b/click input/b/touch input/system/click"},
    {"meta/touch_plus_controller", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y input/trigger_curl/value "
     "input/trigger_slide/value input/trigger/force"},
    {"meta/touch_plus_controller", both, boolean,
     "input/trigger/touch input/thumbstick/click input/thumbstick/touch input/thumbrest/touch "
     "input/thumb_resting_surfaces/proximity input/trigger/proximity"},
    {"meta/touch_plus_controller", both, vector, "input/thumbstick"},
    {"meta/touch_plus_controller", both, pose, "input/grip_surface/pose input/grip/pose input/aim/pose"},
    {"meta/touch_plus_controller", both, haptic, "output/haptic"},
    {"meta/touch_controller_rift_cv1", left, boolean,
     "input/x/click input/x/touch input/y/click input/y/touch input/menu/click"},
    {"meta/touch_controller_rift_cv1", right, boolean,
     "input/a/click input/a/touch input/b/click input/b/touch input/system/click"},
    {"meta/touch_controller_rift_cv1", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y"},
    {"meta/touch_controller_rift_cv1", both, boolean,
     "input/trigger/touch input/trigger/proximity input/thumb_resting_surfaces/proximity "
     "input/thumbstick/click input/thumbstick/touch input/thumbrest/touch"},
    {"meta/touch_controller_rift_cv1", both, vector, "input/thumbstick"},
    {"meta/touch_controller_rift_cv1", both, pose, "input/grip_surface/pose input/grip/pose input/aim/pose"},
    {"meta/touch_controller_rift_cv1", both, haptic, "output/haptic"},
    {"meta/touch_controller_quest_1_rift_s", left, boolean,
     "input/x/click input/x/touch input/y/click input/y/touch input/menu/click"},
    {"meta/touch_controller_quest_1_rift_s", right, boolean,
     "input/a/click input/a/touch input/b/click input/b/touch input/system/click"},
    {"meta/touch_controller_quest_1_rift_s", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y"},
    {"meta/touch_controller_quest_1_rift_s", both, boolean,
     "input/trigger/touch input/trigger/proximity input/thumb_resting_surfaces/proximity "
     "input/thumbstick/click input/thumbstick/touch"},
    {"meta/touch_controller_quest_1_rift_s", both, vector, "input/thumbstick"},
    {"meta/touch_controller_quest_1_rift_s", both, pose,
     "input/grip_surface/pose input/grip/pose input/aim/pose"},
    {"meta/touch_controller_quest_1_rift_s", both, haptic, "output/haptic"},
    {"meta/touch_controller_quest_2", left, boolean,
     "input/x/click input/x/touch input/y/click input/y/touch input/menu/click"},
    {"meta/touch_controller_quest_2", right, boolean,
     "input/a/click input/a/touch input/b/click input/b/touch input/system/click"},
    {"meta/touch_controller_quest_2", both, number,
     "input/squeeze/value input/trigger/value input/thumbstick/x input/thumbstick/y"},
    {"meta/touch_controller_quest_2", both, boolean,
     "input/trigger/touch input/trigger/proximity input/thumb_resting_surfaces/proximity "
     "input/thumbstick/click input/thumbstick/touch input/thumbrest/touch"},
    {"meta/touch_controller_quest_2", both, vector, "input/thumbstick"},
    {"meta/touch_controller_quest_2", both, pose, "input/grip_surface/pose input/grip/pose input/aim/pose"},
    {"meta/touch_controller_quest_2", both, haptic, "output/haptic"},
    {"khr/simple_controller", both, pose, "input/grip_surface/pose"},
    {"google/daydream_controller", both, pose, "input/grip_surface/pose"},
    {"htc/vive_controller", both, pose, "input/grip_surface/pose"},
    {"microsoft/motion_controller", both, pose, "input/grip_surface/pose"},
    {"oculus/go_controller", both, pose, "input/grip_surface/pose"},
    {"oculus/touch_controller", both, pose, "input/grip_surface/pose"},
    {"oculus/touch_controller", both, boolean,
     "input/trigger/proximity input/thumb_resting_surfaces/proximity"},
    {"valve/index_controller", both, pose, "input/grip_surface/pose"},
};

class Profiles1_1 : public testing::Test {
  protected:
    /// Suggests each input alone and calls `check` with its name and the result.
    template <typename Check>
    void suggest_all(const std::vector<const char*>& extensions, XrVersion version, Check check) {
        set_environment({});
        ActionClient client(std::make_unique<SimulatorClient>(extensions, version));
        const XrActionSet set = client.create_set("set");
        std::map<XrActionType, XrAction> by_type;
        for (const auto& [type, name] : {std::pair{boolean, "boolean"},
                                         {number, "number"},
                                         {vector, "vector"},
                                         {pose, "pose"},
                                         {haptic, "haptic"}}) {
            by_type[type] = client.create(set, name, type);
        }
        for (const Inputs& row : specified_inputs) {
            std::istringstream users(row.users);
            for (std::string user; users >> user;) {
                std::istringstream inputs(row.inputs);
                for (std::string input; inputs >> input;) {
                    const std::string path = user + "/" + input;
                    const XrResult result = client.suggest(row.profile, {{by_type[row.type], path}});
                    check(std::string(row.profile) + " " + path, result);
                }
            }
        }
    }
};

TEST_F(Profiles1_1, EveryInputCanBeSuggested) {
    suggest_all({XR_MND_HEADLESS_EXTENSION_NAME}, XR_API_VERSION_1_1,
                [](const std::string& input, XrResult result) { EXPECT_EQ(result, XR_SUCCESS) << input; });
}

TEST_F(Profiles1_1, NoneIsThereInOpenXR1_0) {
    suggest_all({XR_MND_HEADLESS_EXTENSION_NAME}, XR_API_VERSION_1_0,
                [](const std::string& input, XrResult result) {
                    EXPECT_EQ(result, XR_ERROR_PATH_UNSUPPORTED) << input;
                });
}

TEST_F(Profiles1_1, GripSurfacesComeWithMaintenance1) {
    const std::string old_profiles =
        "khr/simple_controller google/daydream_controller htc/vive_controller "
        "microsoft/motion_controller oculus/go_controller oculus/touch_controller "
        "valve/index_controller";
    suggest_all({XR_MND_HEADLESS_EXTENSION_NAME, XR_KHR_MAINTENANCE1_EXTENSION_NAME}, XR_API_VERSION_1_0,
                [&](const std::string& input, XrResult result) {
                    const bool is_old =
                        old_profiles.find(input.substr(0, input.find(' '))) != std::string::npos;
                    const bool is_surface = input.ends_with("/input/grip_surface/pose");
                    EXPECT_EQ(result, is_old && is_surface ? XR_SUCCESS : XR_ERROR_PATH_UNSUPPORTED) << input;
                });
}

}  // namespace
}  // namespace foveray::simulator_tests
#endif
