#include "tests/xr/simulator/action_client.h"

#include <cstring>

namespace foveray::simulator_tests {

ActionClient::ActionClient(std::unique_ptr<SimulatorClient> made) : client(std::move(made)) {
    hands = {client->path("/user/hand/left"), client->path("/user/hand/right")};
}

XrActionSet ActionClient::create_set(const char* name, std::uint32_t priority) {
    XrActionSetCreateInfo info{};
    info.type = XR_TYPE_ACTION_SET_CREATE_INFO;
    std::strcpy(info.actionSetName, name);
    std::strcpy(info.localizedActionSetName, name);
    info.priority = priority;
    XrActionSet set = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateActionSet(client->instance, &info, &set), XR_SUCCESS) << name;
    return set;
}

XrAction ActionClient::create(XrActionSet set, const char* name, XrActionType type) {
    XrActionCreateInfo info{};
    info.type = XR_TYPE_ACTION_CREATE_INFO;
    std::strcpy(info.actionName, name);
    std::strcpy(info.localizedActionName, name);
    info.actionType = type;
    info.countSubactionPaths = 2;
    info.subactionPaths = hands.data();
    XrAction action = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateAction(set, &info, &action), XR_SUCCESS) << name;
    return action;
}

XrResult ActionClient::suggest(const std::string& profile,
                               const std::vector<std::pair<XrAction, std::string>>& list) {
    std::vector<XrActionSuggestedBinding> bindings;
    for (const auto& [action, path] : list) bindings.push_back({action, client->path(path)});
    const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
                                                    client->path("/interaction_profiles/" + profile),
                                                    static_cast<std::uint32_t>(bindings.size()),
                                                    bindings.data()};
    return xrSuggestInteractionProfileBindings(client->instance, &info);
}

XrResult ActionClient::attach(const std::vector<XrActionSet>& sets) {
    const XrSessionActionSetsAttachInfo info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr,
                                             static_cast<std::uint32_t>(sets.size()), sets.data()};
    return xrAttachSessionActionSets(client->session, &info);
}

XrResult ActionClient::sync(const std::vector<XrActiveActionSet>& active) {
    const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr,
                                 static_cast<std::uint32_t>(active.size()), active.data()};
    return xrSyncActions(client->session, &info);
}

XrPath ActionClient::current_profile(XrPath user) {
    XrInteractionProfileState state{XR_TYPE_INTERACTION_PROFILE_STATE, nullptr, XR_NULL_PATH};
    EXPECT_EQ(xrGetCurrentInteractionProfile(client->session, user, &state), XR_SUCCESS);
    return state.interactionProfile;
}

XrActionStateBoolean ActionClient::read_boolean(XrAction action, XrPath subaction) {
    return read<XrActionStateBoolean>(xrGetActionStateBoolean, XR_TYPE_ACTION_STATE_BOOLEAN, action,
                                      subaction);
}

XrActionStateFloat ActionClient::read_float(XrAction action, XrPath subaction) {
    return read<XrActionStateFloat>(xrGetActionStateFloat, XR_TYPE_ACTION_STATE_FLOAT, action, subaction);
}

XrActionStateVector2f ActionClient::read_vector(XrAction action, XrPath subaction) {
    return read<XrActionStateVector2f>(xrGetActionStateVector2f, XR_TYPE_ACTION_STATE_VECTOR2F, action,
                                       subaction);
}

bool ActionClient::is_pose_active(XrAction action, XrPath subaction) {
    return read<XrActionStatePose>(xrGetActionStatePose, XR_TYPE_ACTION_STATE_POSE, action, subaction)
        .isActive;
}

XrSpace ActionClient::create_space(XrAction action, XrPath subaction) {
    const XrActionSpaceCreateInfo info{
        XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, action, subaction, {{0, 0, 0, 1}, {0, 0, 0}}};
    XrSpace space = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateActionSpace(client->session, &info, &space), XR_SUCCESS);
    return space;
}

}  // namespace foveray::simulator_tests
