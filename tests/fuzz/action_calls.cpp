#include "tests/fuzz/caller.h"

namespace foveray::fuzz {
namespace {

void create_action_set(Caller& c) {
    auto& info = c.structure<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
    c.write_name(info.actionSetName);
    c.write_name(info.localizedActionSetName);
    info.priority = c.small_count();
    XrActionSet set = XR_NULL_HANDLE;
    if (c.call.xrCreateActionSet(c.handle<XrInstance>(), c.maybe(info), c.maybe(set)) == XR_SUCCESS)
        c.handles.add(set);
}

void destroy_action_set(Caller& c) {
    const auto set = c.handle<XrActionSet>();
    if (c.call.xrDestroyActionSet(set) == XR_SUCCESS) c.handles.remember_dead(set);
}

void create_action(Caller& c) {
    auto& info = c.structure<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
    c.write_name(info.actionName);
    c.write_name(info.localizedActionName);
    info.actionType = c.random.chance(95)
                          ? c.random.pick({XR_ACTION_TYPE_BOOLEAN_INPUT, XR_ACTION_TYPE_FLOAT_INPUT,
                                           XR_ACTION_TYPE_VECTOR2F_INPUT, XR_ACTION_TYPE_POSE_INPUT,
                                           XR_ACTION_TYPE_VIBRATION_OUTPUT})
                          : c.enumerant<XrActionType>(6);
    auto* paths = c.array<XrPath>(3);
    for (int i = 0; i < 3; ++i) paths[i] = c.path();
    info.countSubactionPaths = c.random.chance(60) ? 0 : static_cast<std::uint32_t>(c.random.below(4));
    info.subactionPaths = c.maybe(*paths);
    XrAction action = XR_NULL_HANDLE;
    if (c.call.xrCreateAction(c.handle<XrActionSet>(), c.maybe(info), c.maybe(action)) == XR_SUCCESS)
        c.handles.add(action);
}

void destroy_action(Caller& c) {
    const auto action = c.handle<XrAction>();
    if (c.call.xrDestroyAction(action) == XR_SUCCESS) c.handles.remember_dead(action);
}

void suggest(Caller& c) {
    auto& info =
        c.structure<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    info.interactionProfile = c.path();
    auto* bindings = c.array<XrActionSuggestedBinding>(3);
    for (int i = 0; i < 3; ++i) bindings[i] = {c.handle<XrAction>(), c.path()};
    info.countSuggestedBindings = static_cast<std::uint32_t>(c.random.below(4));
    info.suggestedBindings = c.maybe(*bindings);
    c.call.xrSuggestInteractionProfileBindings(c.handle<XrInstance>(), c.maybe(info));
}

void attach(Caller& c) {
    auto& info = c.structure<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
    auto* sets = c.array<XrActionSet>(3);
    for (int i = 0; i < 3; ++i) sets[i] = c.handle<XrActionSet>();
    info.countActionSets = static_cast<std::uint32_t>(c.random.below(4));
    info.actionSets = c.maybe(*sets);
    c.call.xrAttachSessionActionSets(c.handle<XrSession>(), c.maybe(info));
}

void get_profile(Caller& c) {
    auto& state = c.structure<XrInteractionProfileState>(XR_TYPE_INTERACTION_PROFILE_STATE);
    c.call.xrGetCurrentInteractionProfile(c.handle<XrSession>(), c.path(), c.maybe(state));
}

template <typename State, typename Get>
void get_state(Caller& c, Get get, XrStructureType type) {
    auto& info = c.structure<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
    info.action = c.handle<XrAction>();
    info.subactionPath = c.random.chance(50) ? XR_NULL_PATH : c.path();
    get(c.handle<XrSession>(), c.maybe(info), c.maybe(c.structure<State>(type)));
}

void get_states(Caller& c) {
    get_state<XrActionStateBoolean>(c, c.call.xrGetActionStateBoolean, XR_TYPE_ACTION_STATE_BOOLEAN);
    get_state<XrActionStateFloat>(c, c.call.xrGetActionStateFloat, XR_TYPE_ACTION_STATE_FLOAT);
    get_state<XrActionStateVector2f>(c, c.call.xrGetActionStateVector2f, XR_TYPE_ACTION_STATE_VECTOR2F);
    get_state<XrActionStatePose>(c, c.call.xrGetActionStatePose, XR_TYPE_ACTION_STATE_POSE);
}

void sync(Caller& c) {
    auto& info = c.structure<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
    auto* active = c.array<XrActiveActionSet>(3);
    for (int i = 0; i < 3; ++i)
        active[i] = {c.handle<XrActionSet>(), c.random.chance(80) ? XR_NULL_PATH : c.path()};
    info.countActiveActionSets = static_cast<std::uint32_t>(c.random.below(4));
    info.activeActionSets = c.maybe(*active);
    c.call.xrSyncActions(c.handle<XrSession>(), c.maybe(info));
}

void ask_for_sources(Caller& c) {
    auto& info =
        c.structure<XrBoundSourcesForActionEnumerateInfo>(XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO);
    info.action = c.handle<XrAction>();
    std::uint32_t capacity = c.capacity();
    c.call.xrEnumerateBoundSourcesForAction(c.handle<XrSession>(), c.maybe(info), capacity,
                                            c.out<std::uint32_t>(), c.maybe(*c.array<XrPath>(64)));
    auto& name = c.structure<XrInputSourceLocalizedNameGetInfo>(XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO);
    name.sourcePath = c.path();
    name.whichComponents = c.flags(7);
    capacity = c.capacity();
    c.call.xrGetInputSourceLocalizedName(c.handle<XrSession>(), c.maybe(name), capacity,
                                         c.out<std::uint32_t>(), c.maybe(*c.array<char>(64)));
}

void vibrate(Caller& c) {
    auto& info = c.structure<XrHapticActionInfo>(XR_TYPE_HAPTIC_ACTION_INFO);
    info.action = c.handle<XrAction>();
    info.subactionPath = c.random.chance(50) ? XR_NULL_PATH : c.path();
    auto& vibration = c.structure<XrHapticVibration>(XR_TYPE_HAPTIC_VIBRATION);
    vibration.duration = static_cast<XrDuration>(c.random.bits());
    vibration.amplitude = c.random.number();
    c.call.xrApplyHapticFeedback(c.handle<XrSession>(), c.maybe(info),
                                 reinterpret_cast<const XrHapticBaseHeader*>(c.maybe(vibration)));
    c.call.xrStopHapticFeedback(c.handle<XrSession>(), c.maybe(info));
}

}  // namespace

std::vector<Call> action_calls() {
    return {{"xrCreateActionSet", 15, create_action_set},
            {"xrDestroyActionSet", 3, destroy_action_set},
            {"xrCreateAction", 20, create_action},
            {"xrDestroyAction", 5, destroy_action},
            {"xrSuggestInteractionProfileBindings", 20, suggest},
            {"xrAttachSessionActionSets", 10, attach},
            {"xrGetCurrentInteractionProfile", 10, get_profile},
            {"xrGetActionStateBoolean", 20, get_states},
            {"xrSyncActions", 25, sync},
            {"xrEnumerateBoundSourcesForAction", 10, ask_for_sources},
            {"xrApplyHapticFeedback", 5, vibrate}};
}

}  // namespace foveray::fuzz
