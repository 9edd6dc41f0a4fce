#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <openxr/openxr.h>

#include "xr/simulator/handles.h"
#include "xr/simulator/instance.h"

namespace foveray::simulator {

class Action;

class ActionSet : public Object {
  public:
    using Handle = XrActionSet;
    static constexpr XrObjectType object_type = XR_OBJECT_TYPE_ACTION_SET;

    /// Refuses names that a living set of the instance has (XR_ERROR_NAME_DUPLICATED,
    /// _LOCALIZED_NAME_DUPLICATED).
    ActionSet(std::shared_ptr<Instance> instance, std::string name, std::string localized_name,
              std::uint32_t priority);
    void on_destroy() override;

    Instance& instance() const { return *instance_; }
    std::uint32_t priority() const { return priority_; }
    /// Attached sets cannot change any more.
    bool attached() const { return attached_; }
    void attach() { attached_ = true; }

    /// Refuses names that a living action of the set has.
    std::shared_ptr<Action> create_action(const std::shared_ptr<ActionSet>& self,
                                          const XrActionCreateInfo& info);
    /// Destroyed ones too, as long as something uses them.
    std::vector<std::shared_ptr<Action>> actions() const;

  private:
    std::shared_ptr<Instance> instance_;
    std::string name_, localized_name_;
    std::uint32_t priority_;
    std::atomic<bool> attached_ = false;
    mutable std::mutex mutex_;
    std::vector<std::weak_ptr<Action>> actions_;  // by age
};

class Action : public Object {
  public:
    using Handle = XrAction;
    static constexpr XrObjectType object_type = XR_OBJECT_TYPE_ACTION;

    Action(std::shared_ptr<ActionSet> set, const XrActionCreateInfo& info);
    /// Its names are free again.
    void on_destroy() override { destroyed_ = true; }

    bool destroyed() const { return destroyed_; }
    ActionSet& set() const { return *set_; }
    XrActionType type() const { return type_; }
    const std::string& name() const { return name_; }
    const std::string& localized_name() const { return localized_name_; }
    /// Declared when the action was made; empty for one without.
    const std::vector<XrPath>& subaction_paths() const { return subaction_paths_; }
    bool has_subaction_path(XrPath path) const;

  private:
    std::shared_ptr<ActionSet> set_;
    std::string name_, localized_name_;
    XrActionType type_;
    std::vector<XrPath> subaction_paths_;
    std::atomic<bool> destroyed_ = false;
};

}  // namespace foveray::simulator
