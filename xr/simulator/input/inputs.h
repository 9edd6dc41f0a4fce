#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include <openxr/openxr.h>

#include "xr/simulator/input/actions.h"
#include "xr/simulator/input/devices.h"
#include "xr/simulator/input/input_sources.h"

namespace foveray::simulator {

/// The actions attached to a session: which sources they are bound to and what the last xrSyncActions read.
/// Nothing changes between two xrSyncActions. Safe to use from any thread.
class Inputs {
  public:
    Inputs(Instance& instance, const Devices& devices) : instance_(instance), devices_(devices) {}

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

    /// Refuses with XR_ERROR_ACTIONSETS_ALREADY_ATTACHED.
    void attach(std::vector<std::shared_ptr<ActionSet>> sets);
    bool attached() const;
    bool is_attached(const ActionSet& set) const;

    /// Chooses interaction profiles for the connected devices: a device's own where the client suggested
    /// bindings for it, else the headset's own, else another one that has them. Then reads the sources of the
    /// active sets; everything else becomes inactive. True when a profile changed. Refuses with
    /// XR_ERROR_ACTIONSET_NOT_ATTACHED.
    bool sync(std::span<const ActiveSet> active, Nanoseconds session_time, XrTime now);

    State state(const Action& action, XrPath subaction_path) const;
    std::vector<const InputSource*> bound_sources(const Action& action) const;
    /// XR_NULL_PATH when nothing is bound.
    XrPath current_profile(std::string_view user_path) const;

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
    using Profiles = std::map<std::string, const InteractionProfile*, std::less<>>;  // by user path

    Profiles choose_profiles() const;
    void bind();
    std::vector<const Binding*> live_bindings(std::span<const ActiveSet> active) const;
    State combine(const Key& key, std::span<const Binding* const> live, Nanoseconds session_time);

    Instance& instance_;
    const Devices& devices_;
    mutable std::mutex mutex_;  // what follows
    bool attached_ = false;
    std::vector<std::shared_ptr<ActionSet>> sets_;
    std::map<std::string, std::vector<SuggestedBinding>> suggestions_;  // by interaction profile
    Profiles profiles_;
    std::vector<Binding> bindings_;
    std::map<Key, XrPath> pose_users_;  // whose pose it was first: it stays with that hand
    std::map<Key, State> states_;
};

}  // namespace foveray::simulator
