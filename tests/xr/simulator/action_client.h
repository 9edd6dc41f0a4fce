#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {

/// Makes, binds and reads actions.
class ActionClient {
  public:
    explicit ActionClient(std::unique_ptr<SimulatorClient> made);

    XrActionSet create_set(const char* name, std::uint32_t priority = 0);
    /// With both hands as subaction paths.
    XrAction create(XrActionSet set, const char* name, XrActionType type);
    /// Paths of inputs by action, for an interaction profile such as "khr/simple_controller".
    XrResult suggest(const std::string& profile, const std::vector<std::pair<XrAction, std::string>>& list);
    XrResult attach(const std::vector<XrActionSet>& sets);
    XrResult sync(const std::vector<XrActiveActionSet>& active);
    XrPath current_profile(XrPath user);

    template <typename State, typename Get>
    State read(Get get, XrStructureType type, XrAction action, XrPath subaction = XR_NULL_PATH) {
        const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, subaction};
        State state{};
        state.type = type;
        EXPECT_EQ(get(client->session, &info, &state), XR_SUCCESS);
        return state;
    }
    XrActionStateBoolean read_boolean(XrAction action, XrPath subaction = XR_NULL_PATH);
    XrActionStateFloat read_float(XrAction action, XrPath subaction = XR_NULL_PATH);
    XrActionStateVector2f read_vector(XrAction action, XrPath subaction = XR_NULL_PATH);
    bool is_pose_active(XrAction action, XrPath subaction = XR_NULL_PATH);
    XrSpace create_space(XrAction action, XrPath subaction = XR_NULL_PATH);

    std::unique_ptr<SimulatorClient> client;
    std::array<XrPath, 2> hands{};
};

}  // namespace foveray::simulator_tests
