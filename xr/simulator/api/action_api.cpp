#include <set>

#include "xr/simulator/api/functions.h"
#include "xr/simulator/session.h"

namespace foveray::simulator {
namespace {

/// The text of a top level user path.
std::string read_user_path(Instance& instance, XrPath path) {
    std::string text = instance.paths().text(path);
    verify(is_user_path(text, instance.has(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME)),
           XR_ERROR_PATH_UNSUPPORTED);
    return text;
}

template <std::size_t Size>
std::string read_name(const char (&array)[Size]) {
    const std::string_view name = fixed_text(array, XR_ERROR_NAME_INVALID);
    verify(!name.empty(), XR_ERROR_NAME_INVALID);
    verify(is_well_formed_name(name), XR_ERROR_PATH_FORMAT_INVALID);
    return std::string(name);
}

template <std::size_t Size>
std::string read_localized_name(const char (&array)[Size]) {
    const std::string_view name = fixed_text(array, XR_ERROR_LOCALIZED_NAME_INVALID);
    verify(!name.empty(), XR_ERROR_LOCALIZED_NAME_INVALID);
    return std::string(name);
}

/// An action of the session's attached sets.
std::shared_ptr<Action> attached_action(const Session& session, XrAction handle) {
    auto action = get<Action>(handle);
    verify(&action->set().instance() == &session.instance(), XR_ERROR_HANDLE_INVALID);
    verify(session.inputs().is_attached(action->set()), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    return action;
}

void verify_subaction_path(const Action& action, XrPath path) {
    if (path == XR_NULL_PATH) return;
    action.set().instance().paths().text(path);
    verify(action.has_subaction_path(path), XR_ERROR_PATH_UNSUPPORTED);
}

template <typename State>
Inputs::State read_state(XrSession session, const XrActionStateGetInfo* info, State* state,
                         XrStructureType type, XrActionType action_type) {
    const auto object = get<Session>(session);
    verify_structure(info, XR_TYPE_ACTION_STATE_GET_INFO);
    verify_structure(state, type);
    const auto action = attached_action(*object, info->action);
    verify(action->type() == action_type, XR_ERROR_ACTION_TYPE_MISMATCH);
    verify_subaction_path(*action, info->subactionPath);
    const Inputs::State read = object->inputs().state(*action, info->subactionPath);
    state->isActive = read.active;
    return read;
}

template <typename State>
void copy_change(const Inputs::State& read, State& state) {
    state.changedSinceLastSync = read.changed;
    state.lastChangeTime = read.changed_at;
}

void verify_haptic_action(XrSession session, const XrHapticActionInfo* info) {
    const auto object = get<Session>(session);
    verify_structure(info, XR_TYPE_HAPTIC_ACTION_INFO);
    const auto action = attached_action(*object, info->action);
    verify(action->type() == XR_ACTION_TYPE_VIBRATION_OUTPUT, XR_ERROR_ACTION_TYPE_MISMATCH);
    verify_subaction_path(*action, info->subactionPath);
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrCreateActionSet(XrInstance instance, const XrActionSetCreateInfo* info,
                                                 XrActionSet* set) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify_structure(info, XR_TYPE_ACTION_SET_CREATE_INFO);
        verify(set != nullptr);
        *set = add_object(
            std::make_shared<ActionSet>(object, read_name(info->actionSetName),
                                        read_localized_name(info->localizedActionSetName), info->priority),
            object->id());
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrDestroyActionSet(XrActionSet set) {
    return guarded([&] { destroy<ActionSet>(set); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrCreateAction(XrActionSet set, const XrActionCreateInfo* info,
                                              XrAction* action) {
    return guarded([&] {
        const auto object = get<ActionSet>(set);
        verify_structure(info, XR_TYPE_ACTION_CREATE_INFO);
        verify(action != nullptr);
        read_name(info->actionName);
        read_localized_name(info->localizedActionName);
        verify((info->actionType >= XR_ACTION_TYPE_BOOLEAN_INPUT &&
                info->actionType <= XR_ACTION_TYPE_POSE_INPUT) ||
               info->actionType == XR_ACTION_TYPE_VIBRATION_OUTPUT);
        verify(info->countSubactionPaths == 0 || info->subactionPaths != nullptr);
        std::set<XrPath> unique;
        for (std::uint32_t i = 0; i < info->countSubactionPaths; ++i) {
            const XrPath path = info->subactionPaths[i];
            read_user_path(object->instance(), path);
            verify(unique.insert(path).second, XR_ERROR_PATH_UNSUPPORTED);
        }
        *action = add_object(object->create_action(object, *info), object->id());
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrDestroyAction(XrAction action) {
    return guarded([&] { destroy<Action>(action); });
}

XRAPI_ATTR XrResult XRAPI_CALL
xrSuggestInteractionProfileBindings(XrInstance instance, const XrInteractionProfileSuggestedBinding* info) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify_structure(info, XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
        verify(info->countSuggestedBindings > 0 && info->suggestedBindings != nullptr);
        const std::string path = object->paths().text(info->interactionProfile);
        const InteractionProfile* profile = find_interaction_profile(path);
        verify(profile != nullptr && object->has(profile->feature), XR_ERROR_PATH_UNSUPPORTED);
        std::vector<SuggestedBinding> bindings;
        for (std::uint32_t i = 0; i < info->countSuggestedBindings; ++i) {
            const XrActionSuggestedBinding& binding = info->suggestedBindings[i];
            const auto action = get<Action>(binding.action);
            verify(&action->set().instance() == object.get(), XR_ERROR_HANDLE_INVALID);
            verify(!action->set().attached(), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
            const std::string source_path = object->paths().text(binding.binding);
            verify(std::ranges::any_of(profile->sources,
                                       [&](const InputSource& source) {
                                           return object->has(source.feature) &&
                                                  source.answers_to(source_path);
                                       }),
                   XR_ERROR_PATH_UNSUPPORTED);
            bindings.push_back({action, binding.binding});
        }
        object->suggest(path, std::move(bindings));
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrAttachSessionActionSets(XrSession session,
                                                         const XrSessionActionSetsAttachInfo* info) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
        verify(info->countActionSets > 0 && info->actionSets != nullptr);
        std::vector<std::shared_ptr<ActionSet>> sets;
        for (std::uint32_t i = 0; i < info->countActionSets; ++i) {
            sets.push_back(get<ActionSet>(info->actionSets[i]));
            verify(&sets.back()->instance() == &object->instance(), XR_ERROR_HANDLE_INVALID);
        }
        object->inputs().attach(std::move(sets));
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetCurrentInteractionProfile(XrSession session, XrPath user_path,
                                                              XrInteractionProfileState* state) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(state, XR_TYPE_INTERACTION_PROFILE_STATE);
        const std::string text = read_user_path(object->instance(), user_path);
        verify(object->inputs().attached(), XR_ERROR_ACTIONSET_NOT_ATTACHED);
        state->interactionProfile = object->inputs().current_profile(text);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetActionStateBoolean(XrSession session, const XrActionStateGetInfo* info,
                                                       XrActionStateBoolean* state) {
    return guarded([&] {
        const auto read =
            read_state(session, info, state, XR_TYPE_ACTION_STATE_BOOLEAN, XR_ACTION_TYPE_BOOLEAN_INPUT);
        state->currentState = read.value.x > 0.5f;
        copy_change(read, *state);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetActionStateFloat(XrSession session, const XrActionStateGetInfo* info,
                                                     XrActionStateFloat* state) {
    return guarded([&] {
        const auto read =
            read_state(session, info, state, XR_TYPE_ACTION_STATE_FLOAT, XR_ACTION_TYPE_FLOAT_INPUT);
        state->currentState = read.value.x;
        copy_change(read, *state);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetActionStateVector2f(XrSession session, const XrActionStateGetInfo* info,
                                                        XrActionStateVector2f* state) {
    return guarded([&] {
        const auto read =
            read_state(session, info, state, XR_TYPE_ACTION_STATE_VECTOR2F, XR_ACTION_TYPE_VECTOR2F_INPUT);
        state->currentState = {read.value.x, read.value.y};
        copy_change(read, *state);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetActionStatePose(XrSession session, const XrActionStateGetInfo* info,
                                                    XrActionStatePose* state) {
    return guarded(
        [&] { read_state(session, info, state, XR_TYPE_ACTION_STATE_POSE, XR_ACTION_TYPE_POSE_INPUT); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSyncActions(XrSession session, const XrActionsSyncInfo* info) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_ACTIONS_SYNC_INFO);
        verify(info->countActiveActionSets == 0 || info->activeActionSets != nullptr);
        Instance& instance = object->instance();
        Inputs& inputs = object->inputs();
        std::vector<std::shared_ptr<ActionSet>> sets;  // alive while `active` points at them
        std::vector<Inputs::ActiveSet> active;
        for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i) {
            const auto& [set_handle, subaction_path] = info->activeActionSets[i];
            const auto& set = sets.emplace_back(get<ActionSet>(set_handle));
            verify(inputs.is_attached(*set), XR_ERROR_ACTIONSET_NOT_ATTACHED);
            if (subaction_path != XR_NULL_PATH) {
                instance.paths().text(subaction_path);
                const auto actions = set->actions();
                verify(std::ranges::any_of(
                           actions,
                           [&](const auto& action) { return action->has_subaction_path(subaction_path); }),
                       XR_ERROR_PATH_UNSUPPORTED);
            }
            active.push_back({set.get(), subaction_path});
        }
        object->play_without_frames();
        const bool focused = object->focused();
        if (!focused) active.clear();
        const XrTime now = instance.clock().now();
        if (inputs.sync(active, instance.clock().session_time(now), now)) {
            instance.events().push(XrEventDataInteractionProfileChanged{
                XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED, nullptr, handle_of(*object)});
        }
        return focused ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL
xrEnumerateBoundSourcesForAction(XrSession session, const XrBoundSourcesForActionEnumerateInfo* info,
                                 std::uint32_t capacity, std::uint32_t* count, XrPath* sources) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO);
        const auto bound = object->inputs().bound_sources(*attached_action(*object, info->action));
        enumerate(static_cast<std::uint32_t>(bound.size()), capacity, count, sources,
                  [&](XrPath& target, std::uint32_t i) {
                      target = object->instance().paths().atom(bound[i]->path);
                  });
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetInputSourceLocalizedName(XrSession session,
                                                             const XrInputSourceLocalizedNameGetInfo* info,
                                                             std::uint32_t capacity, std::uint32_t* count,
                                                             char* buffer) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO);
        verify(info->whichComponents != 0 && (info->whichComponents & ~XrFlags64{7}) == 0);
        Instance& instance = object->instance();
        const std::string path = instance.paths().text(info->sourcePath);
        verify(object->inputs().attached(), XR_ERROR_ACTIONSET_NOT_ATTACHED);
        for (const InteractionProfile& profile : interaction_profiles()) {
            for (const InputSource& source : profile.sources) {
                if (source.path != path) continue;
                const XrPath current = object->inputs().current_profile(source.user);
                if (current == XR_NULL_PATH || instance.paths().text(current) != profile.path) continue;
                return enumerate_text(localized_name(profile, source, info->whichComponents), capacity, count,
                                      buffer);
            }
        }
        throw Refusal{XR_ERROR_PATH_UNSUPPORTED};
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrApplyHapticFeedback(XrSession session, const XrHapticActionInfo* info,
                                                     const XrHapticBaseHeader* feedback) {
    return guarded([&] {
        verify_haptic_action(session, info);
        verify(feedback != nullptr && feedback->type == XR_TYPE_HAPTIC_VIBRATION);
        return get<Session>(session)->focused() ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrStopHapticFeedback(XrSession session, const XrHapticActionInfo* info) {
    return guarded([&] {
        verify_haptic_action(session, info);
        return get<Session>(session)->focused() ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
    });
}

}  // namespace foveray::simulator
