// All interaction profiles with all their inputs.
#include <map>

#include "tests/xr/simulator/action_client.h"

namespace foveray::simulator_tests {
namespace {

struct ProfileInputs {
    const char* profile;
    std::vector<const char*> users;
    std::vector<std::pair<XrActionType, const char*>> inputs;
};

constexpr auto boolean = XR_ACTION_TYPE_BOOLEAN_INPUT;
constexpr auto number = XR_ACTION_TYPE_FLOAT_INPUT;
constexpr auto vector = XR_ACTION_TYPE_VECTOR2F_INPUT;
constexpr auto pose = XR_ACTION_TYPE_POSE_INPUT;
constexpr auto haptic = XR_ACTION_TYPE_VIBRATION_OUTPUT;

/// OpenXR 1.0, section 6.4, and XR_EXT_eye_gaze_interaction.
const std::vector<ProfileInputs>& specified_profiles() {
    static const char *const left = "/user/hand/left", *const right = "/user/hand/right";
    static const std::vector<ProfileInputs> list{
        {"khr/simple_controller",
         {left, right},
         {{boolean, "input/select/click"},
          {boolean, "input/menu/click"},
          {pose, "input/grip/pose"},
          {pose, "input/aim/pose"},
          {haptic, "output/haptic"}}},
        {"google/daydream_controller",
         {left, right},
         {{boolean, "input/select/click"},
          {vector, "input/trackpad"},
          {number, "input/trackpad/x"},
          {number, "input/trackpad/y"},
          {boolean, "input/trackpad/click"},
          {boolean, "input/trackpad/touch"},
          {pose, "input/grip/pose"},
          {pose, "input/aim/pose"}}},
        {"htc/vive_controller",
         {left, right},
         {{boolean, "input/system/click"},
          {boolean, "input/squeeze/click"},
          {boolean, "input/menu/click"},
          {boolean, "input/trigger/click"},
          {number, "input/trigger/value"},
          {vector, "input/trackpad"},
          {number, "input/trackpad/x"},
          {number, "input/trackpad/y"},
          {boolean, "input/trackpad/click"},
          {boolean, "input/trackpad/touch"},
          {pose, "input/grip/pose"},
          {pose, "input/aim/pose"},
          {haptic, "output/haptic"}}},
        {"htc/vive_pro",
         {"/user/head"},
         {{boolean, "input/system/click"},
          {boolean, "input/volume_up/click"},
          {boolean, "input/volume_down/click"},
          {boolean, "input/mute_mic/click"}}},
        {"microsoft/motion_controller",
         {left, right},
         {{boolean, "input/menu/click"},
          {boolean, "input/squeeze/click"},
          {number, "input/trigger/value"},
          {vector, "input/thumbstick"},
          {number, "input/thumbstick/x"},
          {number, "input/thumbstick/y"},
          {boolean, "input/thumbstick/click"},
          {vector, "input/trackpad"},
          {number, "input/trackpad/x"},
          {number, "input/trackpad/y"},
          {boolean, "input/trackpad/click"},
          {boolean, "input/trackpad/touch"},
          {pose, "input/grip/pose"},
          {pose, "input/aim/pose"},
          {haptic, "output/haptic"}}},
        {"microsoft/xbox_controller",
         {"/user/gamepad"},
         {{boolean, "input/menu/click"},
          {boolean, "input/view/click"},
          {boolean, "input/a/click"},
          {boolean, "input/b/click"},
          {boolean, "input/x/click"},
          {boolean, "input/y/click"},
          {boolean, "input/dpad_down/click"},
          {boolean, "input/dpad_right/click"},
          {boolean, "input/dpad_up/click"},
          {boolean, "input/dpad_left/click"},
          {boolean, "input/shoulder_left/click"},
          {boolean, "input/shoulder_right/click"},
          {boolean, "input/thumbstick_left/click"},
          {boolean, "input/thumbstick_right/click"},
          {number, "input/trigger_left/value"},
          {number, "input/trigger_right/value"},
          {vector, "input/thumbstick_left"},
          {number, "input/thumbstick_left/x"},
          {number, "input/thumbstick_left/y"},
          {vector, "input/thumbstick_right"},
          {number, "input/thumbstick_right/x"},
          {number, "input/thumbstick_right/y"},
          {haptic, "output/haptic_left"},
          {haptic, "output/haptic_right"},
          {haptic, "output/haptic_left_trigger"},
          {haptic, "output/haptic_right_trigger"}}},
        {"oculus/go_controller",
         {left, right},
         {{boolean, "input/system/click"},
          {boolean, "input/trigger/click"},
          {boolean, "input/back/click"},
          {vector, "input/trackpad"},
          {number, "input/trackpad/x"},
          {number, "input/trackpad/y"},
          {boolean, "input/trackpad/click"},
          {boolean, "input/trackpad/touch"},
          {pose, "input/grip/pose"},
          {pose, "input/aim/pose"}}},
        {"oculus/touch_controller",
         {left, right},
         {{number, "input/squeeze/value"},
          {number, "input/trigger/value"},
          {boolean, "input/trigger/touch"},
          {vector, "input/thumbstick"},
          {number, "input/thumbstick/x"},
          {number, "input/thumbstick/y"},
          {boolean, "input/thumbstick/click"},
          {boolean, "input/thumbstick/touch"},
          {boolean, "input/thumbrest/touch"},
          {pose, "input/grip/pose"},
          {pose, "input/aim/pose"},
          {haptic, "output/haptic"}}},
        {"oculus/touch_controller",
         {left},
         {{boolean, "input/x/click"},
          {boolean, "input/x/touch"},
          {boolean, "input/y/click"},
          {boolean, "input/y/touch"},
          {boolean, "input/menu/click"}}},
        {"oculus/touch_controller",
         {right},
         {{boolean, "input/a/click"},
          {boolean, "input/a/touch"},
          {boolean, "input/b/click"},
          {boolean, "input/b/touch"},
          {boolean, "input/system/click"}}},
        {"valve/index_controller", {left, right}, {{boolean, "input/system/click"},
                                                   {boolean, "input/system/touch"},
                                                   {boolean, "input/a/click"},
                                                   {boolean, "input/a/touch"},
                                                   {boolean, "input/b/click"},
                                                   {boolean, "input/b/touch"},
                                                   {number, "input/squeeze/value"},
                                                   {number, "input/squeeze/force"},
                                                   {boolean, "input/trigger/click"},
                                                   {number, "input/trigger/value"},
                                                   {boolean, "input/trigger/touch"},
                                                   {vector, "input/thumbstick"},
                                                   {number, "input/thumbstick/x"},
                                                   {number, "input/thumbstick/y"},
                                                   {boolean, "input/thumbstick/click"},
                                                   {boolean, "input/thumbstick/touch"},
                                                   {vector, "input/trackpad"},
                                                   {number, "input/trackpad/x"},
                                                   {number, "input/trackpad/y"},
                                                   {number, "input/trackpad/force"},
                                                   {boolean, "input/trackpad/touch"},
                                                   {pose, "input/grip/pose"},
                                                   {pose, "input/aim/pose"},
                                                   {haptic, "output/haptic"}}},
        {"ext/eye_gaze_interaction", {"/user/eyes_ext"}, {{pose, "input/gaze_ext/pose"}}},
    };
    return list;
}

TEST(InteractionProfiles, EveryInputCanBeSuggested) {
    set_environment({});
    ActionClient client(std::make_unique<SimulatorClient>(headless_extensions));
    const XrActionSet set = client.create_set("set");
    std::map<XrActionType, XrAction> by_type;
    for (const auto& [type, name] : {std::pair{boolean, "boolean"},
                                     {number, "number"},
                                     {vector, "vector"},
                                     {pose, "pose"},
                                     {haptic, "haptic"}}) {
        by_type[type] = client.create(set, name, type);
    }
    for (const ProfileInputs& profile : specified_profiles()) {
        for (const char* user : profile.users) {
            for (const auto& [type, input] : profile.inputs) {
                const std::string path = std::string(user) + "/" + input;
                EXPECT_EQ(client.suggest(profile.profile, {{by_type[type], path}}), XR_SUCCESS)
                    << profile.profile << ' ' << path;
                const XrAction other = by_type[type == pose ? haptic : pose];
                EXPECT_EQ(client.suggest(profile.profile, {{other, path}}), XR_SUCCESS)
                    << "an action of another type is not bound, but no error";
            }
        }
    }
}

}  // namespace
}  // namespace foveray::simulator_tests
