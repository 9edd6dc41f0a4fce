#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <openxr/openxr.h>

#include "xr/simulator/actions.h"
#include "xr/simulator/input_sources.h"

namespace foveray::simulator {

/// The actions attached to a session: which sources they are bound to and what the last xrSyncActions read.
class Inputs {
  public:
    explicit Inputs(Instance& instance) : instance_(instance) {}

    /// What an action, seen through one subaction path or all, read. Boolean and Float values stand in
    /// `value.x`.
    struct State {
        bool active = false;
        vec2 value{0.0f};
        bool changed = false;
        XrTime changed_at = 0;
        const InputSource* source = nullptr;  // that it comes from
    };

    struct ActiveSet {
        const ActionSet* set;
        XrPath subaction_path;
    };

    /// Binds to the headset's own controllers if the client suggested bindings for them, or else to the first
    /// other interaction profile that it did. Refuses with XR_ERROR_ACTIONSETS_ALREADY_ATTACHED.
    void attach(std::vector<std::shared_ptr<ActionSet>> sets);
    bool attached() const;
    bool is_attached(const ActionSet& set) const;

    /// Reads the sources of the active sets at a session time; everything else becomes inactive.
    /// Refuses with XR_ERROR_ACTIONSET_NOT_ATTACHED.
    void sync(std::span<const ActiveSet> active, Nanoseconds session_time, XrTime now);

    State state(const Action& action, XrPath subaction_path) const;
    std::vector<const InputSource*> bound_sources(const Action& action) const;

    /// XR_NULL_PATH when nothing is bound.
    XrPath current_profile(std::string_view user_path) const;
    /// Once after each change of a profile.
    bool take_profile_change();

  private:
    struct Binding {
        std::shared_ptr<Action> action;
        const InputSource* source;
        XrPath user;  // atom of the source's user path
    };
    struct Key {
        const Action* action;
        XrPath subaction_path;
        auto operator<=>(const Key&) const = default;
    };

    void bind(const InteractionProfile& profile, std::span<const SuggestedBinding> suggestions);
    std::optional<vec2> read(const InputSource& source, Nanoseconds session_time) const;
    State combine(const Action& action, XrPath subaction_path, Nanoseconds session_time) const;

    Instance& instance_;
    mutable std::mutex mutex_;
    bool attached_ = false, profile_changed_ = false;
    std::vector<std::shared_ptr<ActionSet>> sets_;
    std::vector<Binding> bindings_;
    std::map<std::string, const InteractionProfile*, std::less<>> current_;  // by user path
    std::map<Key, State> states_;
};

}  // namespace foveray::simulator
