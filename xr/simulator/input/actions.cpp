#include "xr/simulator/input/actions.h"

namespace foveray::simulator {

ActionSet::ActionSet(std::shared_ptr<Instance> instance, std::string name, std::string localized_name,
                     std::uint32_t priority)
    : instance_(std::move(instance)),
      name_(std::move(name)),
      localized_name_(std::move(localized_name)),
      priority_(priority) {
    verify(instance_->claim_name(name_, false), XR_ERROR_NAME_DUPLICATED);
    if (!instance_->claim_name(localized_name_, true)) {
        instance_->release_name(name_, false);
        throw Refusal{XR_ERROR_LOCALIZED_NAME_DUPLICATED};
    }
}

void ActionSet::on_destroy() {
    instance_->release_name(name_, false);
    instance_->release_name(localized_name_, true);
}

std::shared_ptr<Action> ActionSet::create_action(const std::shared_ptr<ActionSet>& self,
                                                 const XrActionCreateInfo& info) {
    verify(!attached_, XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    auto action = std::make_shared<Action>(self, info);
    const std::lock_guard lock(mutex_);
    for (const auto& weak : actions_) {
        const auto other = weak.lock();
        if (!other || other->destroyed()) continue;
        verify(other->name() != action->name(), XR_ERROR_NAME_DUPLICATED);
        verify(other->localized_name() != action->localized_name(), XR_ERROR_LOCALIZED_NAME_DUPLICATED);
    }
    std::erase_if(actions_, [](const auto& weak) { return weak.expired(); });
    actions_.push_back(action);
    return action;
}

std::vector<std::shared_ptr<Action>> ActionSet::actions() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::shared_ptr<Action>> alive;
    for (const auto& action : actions_) {
        if (auto shared = action.lock()) alive.push_back(std::move(shared));
    }
    return alive;
}

Action::Action(std::shared_ptr<ActionSet> set, const XrActionCreateInfo& info)
    : set_(std::move(set)),
      name_(info.actionName),
      localized_name_(info.localizedActionName),
      type_(info.actionType),
      subaction_paths_(info.subactionPaths, info.subactionPaths + info.countSubactionPaths) {}

bool Action::has_subaction_path(XrPath path) const {
    return std::ranges::find(subaction_paths_, path) != subaction_paths_.end();
}

}  // namespace foveray::simulator
