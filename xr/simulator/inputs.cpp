#include "xr/simulator/inputs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace foveray::simulator {

void Inputs::attach(std::vector<std::shared_ptr<ActionSet>> sets) {
    const std::lock_guard lock(mutex_);
    verify(!attached_, XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    for (const auto& set : sets) {
        verify(!set->attached(), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
        set->attach();
    }
    attached_ = true;
    sets_ = std::move(sets);

    const auto suggestions = instance_.suggestions();
    const auto bind_if_suggested = [&](const InteractionProfile& profile) {
        const auto found = suggestions.find(profile.path);
        if (found == suggestions.end()) return false;
        bind(profile, found->second);
        return true;
    };
    const InteractionProfile* own = find_interaction_profile(instance_.profile().interaction_profile);
    if (!own || !bind_if_suggested(*own)) {
        for (const InteractionProfile& profile : interaction_profiles()) {
            if (hand_of(profile.sources.front().user) && bind_if_suggested(profile)) break;
        }
    }
    if (instance_.profile().eye_tracking) bind_if_suggested(*find_interaction_profile(eye_gaze_profile_path));
    profile_changed_ = !current_.empty();
}

void Inputs::bind(const InteractionProfile& profile, std::span<const SuggestedBinding> suggestions) {
    for (const SuggestedBinding& suggestion : suggestions) {
        const Action& action = *suggestion.action;
        const auto is_set = [&](const auto& set) { return set.get() == &action.set(); };
        if (std::ranges::none_of(sets_, is_set)) continue;
        const InputSource* source = profile.find(instance_.paths().text(suggestion.path), action.type());
        if (!source) continue;
        bindings_.push_back({suggestion.action, source, instance_.paths().atom(source->user)});
    }
    for (const InputSource& source : profile.sources) current_[source.user] = &profile;
}

bool Inputs::attached() const {
    const std::lock_guard lock(mutex_);
    return attached_;
}

bool Inputs::is_attached(const ActionSet& set) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(sets_, [&](const auto& own) { return own.get() == &set; });
}

std::optional<vec2> Inputs::read(const InputSource& source, Nanoseconds session_time) const {
    const Script& script = instance_.script();
    if (source.user == eyes_path) return vec2(0.0f);
    const auto hand = hand_of(source.user);
    if (!hand) return std::nullopt;
    const ControllerState state = script.controller_at(*hand, session_time);
    if (!state.valid) return std::nullopt;
    return input_value(source, state);
}

/// OpenXR 1.0, section 11.4.2: of several sources the largest deflection wins, for Boolean any pressed one.
Inputs::State Inputs::combine(const Action& action, XrPath subaction_path, Nanoseconds session_time) const {
    State state;
    for (const Binding& binding : bindings_) {
        if (binding.action.get() != &action) continue;
        if (subaction_path != XR_NULL_PATH && binding.user != subaction_path) continue;
        const auto value = read(*binding.source, session_time);
        if (!value) continue;
        if (state.active && glm::length(*value) <= glm::length(state.value)) continue;
        state.active = true;
        state.value = *value;
        state.source = binding.source;
    }
    if (action.type() == XR_ACTION_TYPE_BOOLEAN_INPUT) state.value.x = state.value.x > 0.5f ? 1.0f : 0.0f;
    return state;
}

void Inputs::sync(std::span<const ActiveSet> active, Nanoseconds session_time, XrTime now) {
    const std::lock_guard lock(mutex_);
    for (const ActiveSet& entry : active) {
        verify(std::ranges::any_of(sets_, [&](const auto& own) { return own.get() == entry.set; }),
               XR_ERROR_ACTIONSET_NOT_ATTACHED);
    }
    std::map<Key, State> next;
    for (const auto& set : sets_) {
        for (const auto& action : set->actions()) {
            std::vector<XrPath> paths = action->subaction_paths();
            paths.push_back(XR_NULL_PATH);
            for (const XrPath path : paths) {
                const bool is_active = std::ranges::any_of(active, [&](const ActiveSet& entry) {
                    return entry.set == set.get() && (entry.subaction_path == XR_NULL_PATH ||
                                                      path == XR_NULL_PATH || entry.subaction_path == path);
                });
                if (!is_active) continue;
                State state = combine(*action, path, session_time);
                const auto before = states_.find({action.get(), path});
                if (state.active && before != states_.end() && before->second.active) {
                    state.changed = before->second.value != state.value;
                    state.changed_at = state.changed ? now : before->second.changed_at;
                }
                next[{action.get(), path}] = state;
            }
        }
    }
    states_ = std::move(next);
}

Inputs::State Inputs::state(const Action& action, XrPath subaction_path) const {
    const std::lock_guard lock(mutex_);
    const auto found = states_.find({&action, subaction_path});
    return found != states_.end() ? found->second : State{};
}

std::vector<const InputSource*> Inputs::bound_sources(const Action& action) const {
    const std::lock_guard lock(mutex_);
    std::vector<const InputSource*> sources;
    for (const Binding& binding : bindings_) {
        if (binding.action.get() == &action) sources.push_back(binding.source);
    }
    return sources;
}

XrPath Inputs::current_profile(std::string_view user_path) const {
    const std::lock_guard lock(mutex_);
    const auto found = current_.find(user_path);
    return found != current_.end() ? instance_.paths().atom(found->second->path) : XR_NULL_PATH;
}

bool Inputs::take_profile_change() {
    const std::lock_guard lock(mutex_);
    return std::exchange(profile_changed_, false);
}

}  // namespace foveray::simulator
