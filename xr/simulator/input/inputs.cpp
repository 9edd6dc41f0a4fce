#include "xr/simulator/input/inputs.h"

#include <algorithm>
#include <utility>

namespace foveray::simulator {

void Inputs::attach(std::vector<std::shared_ptr<ActionSet>> sets) {
    const std::lock_guard lock(mutex_);
    verify(!attached_, XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    for (const auto& set : sets) set->attach();
    attached_ = true;
    sets_ = std::move(sets);
    suggestions_ = instance_.suggestions();
}

bool Inputs::attached() const {
    const std::lock_guard lock(mutex_);
    return attached_;
}

bool Inputs::is_attached(const ActionSet& set) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(sets_, [&](const auto& own) { return own.get() == &set; });
}

Inputs::Profiles Inputs::choose_profiles() const {
    Profiles chosen;
    for (const std::string_view user : user_paths) {
        const auto device = devices_.connected(user);
        if (!device) continue;
        std::vector<const InteractionProfile*> candidates{
            device->profile, find_interaction_profile(instance_.profile().interaction_profile)};
        for (const InteractionProfile& profile : interaction_profiles()) candidates.push_back(&profile);
        const auto fits = [&](const InteractionProfile* profile) {
            return profile && profile->has_user(user) && suggestions_.contains(profile->path);
        };
        const auto found = std::ranges::find_if(candidates, fits);
        if (found != candidates.end()) chosen.emplace(user, *found);
    }
    return chosen;
}

void Inputs::bind() {
    bindings_.clear();
    for (const auto& [user, profile] : profiles_) {
        const XrPath user_atom = instance_.paths().atom(user);
        for (const SuggestedBinding& suggestion : suggestions_.at(profile->path)) {
            const Action& action = *suggestion.action;
            const auto is_set = [&](const auto& set) { return set.get() == &action.set(); };
            if (std::ranges::none_of(sets_, is_set)) continue;
            const InputSource* source = profile->find(instance_.paths().text(suggestion.path), action.type());
            if (!source || source->user != user) continue;
            const auto is_same = [&](const Binding& other) {
                return other.action == suggestion.action && other.source == source;
            };
            if (std::ranges::none_of(bindings_, is_same))
                bindings_.push_back({suggestion.action, source, user_atom});
        }
    }
}

/// OpenXR 1.0, XrActionSetCreateInfo: a source that an active action of a higher priority uses is not there
/// for sets of a lower one.
std::vector<const Inputs::Binding*> Inputs::live_bindings(std::span<const ActiveSet> active) const {
    std::vector<const Binding*> live;
    std::map<const InputSource*, std::uint32_t> highest;
    for (const Binding& binding : bindings_) {
        const ActionSet& set = binding.action->set();
        const auto covers = [&](const ActiveSet& entry) {
            return entry.set == &set &&
                   (entry.subaction_path == XR_NULL_PATH || entry.subaction_path == binding.user);
        };
        if (std::ranges::none_of(active, covers)) continue;
        live.push_back(&binding);
        std::uint32_t& priority = highest.emplace(binding.source, set.priority()).first->second;
        priority = std::max(priority, set.priority());
    }
    std::erase_if(live, [&](const Binding* binding) {
        return binding->action->set().priority() < highest.at(binding->source);
    });
    return live;
}

/// OpenXR 1.0, section 11.4.2: of several sources the largest deflection wins, for Boolean any pressed one.
/// A pose comes from one of them only, and stays with its hand.
Inputs::State Inputs::combine(const Key& key, std::span<const Binding* const> live,
                              Nanoseconds session_time) {
    const XrActionType type = key.action->type();
    State state;
    for (const Binding* binding : live) {
        if (binding->action.get() != key.action) continue;
        if (key.subaction_path != XR_NULL_PATH && binding->user != key.subaction_path) continue;
        if (type == XR_ACTION_TYPE_POSE_INPUT) {
            const auto chosen = pose_users_.find(key);
            if (chosen != pose_users_.end() && chosen->second != binding->user) continue;
        }
        const auto value = devices_.value(*binding->source, session_time);
        if (!value) continue;
        if (type == XR_ACTION_TYPE_POSE_INPUT) pose_users_.emplace(key, binding->user);
        if (state.active && glm::length(*value) <= glm::length(state.value)) continue;
        state.active = true;
        state.value = *value;
        state.source = binding->source;
    }
    if (type == XR_ACTION_TYPE_BOOLEAN_INPUT) state.value.x = state.value.x > 0.5f ? 1.0f : 0.0f;
    return state;
}

bool Inputs::sync(std::span<const ActiveSet> active, Nanoseconds session_time, XrTime now) {
    const std::lock_guard lock(mutex_);
    for (const ActiveSet& entry : active) {
        verify(std::ranges::any_of(sets_, [&](const auto& own) { return own.get() == entry.set; }),
               XR_ERROR_ACTIONSET_NOT_ATTACHED);
    }
    Profiles profiles = choose_profiles();
    const bool changed = profiles != profiles_;
    if (changed) {
        profiles_ = std::move(profiles);
        bind();
    }
    const auto live = live_bindings(active);
    std::map<Key, State> next;
    for (const auto& set : sets_) {
        for (const auto& action : set->actions()) {
            std::vector<XrPath> paths = action->subaction_paths();
            paths.push_back(XR_NULL_PATH);
            for (const XrPath path : paths) {
                const Key key{action.get(), path};
                State state = combine(key, live, session_time);
                if (!state.active) continue;
                const auto before = states_.find(key);
                if (before != states_.end()) {
                    state.changed = before->second.value != state.value;
                    state.changed_at = state.changed ? now : before->second.changed_at;
                }
                next[key] = state;
            }
        }
    }
    states_ = std::move(next);
    return changed;
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
    const auto found = profiles_.find(user_path);
    return found != profiles_.end() ? instance_.paths().atom(found->second->path) : XR_NULL_PATH;
}

}  // namespace foveray::simulator
