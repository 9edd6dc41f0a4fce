#include "xr/simulator/debug_utils.h"

#include <algorithm>
#include <span>

#include "xr/simulator/api/names.h"
#include "xr/simulator/instance.h"
#include "xr/simulator/session.h"

namespace foveray::simulator {

void DebugMessenger::on_destroy() { instance_->debug().remove(*this); }

void DebugMessenger::tell(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
                          const XrDebugUtilsMessengerCallbackDataEXT& data) const {
    if ((info_.messageSeverities & severity) && (info_.messageTypes & types))
        info_.userCallback(severity, types, &data, info_.userData);
}

void DebugLabels::begin_region(std::string name) {
    const std::lock_guard lock(mutex_);
    inserted_.clear();
    regions_.push_back(std::move(name));
}

void DebugLabels::end_region() {
    const std::lock_guard lock(mutex_);
    inserted_.clear();
    if (!regions_.empty()) regions_.pop_back();
}

void DebugLabels::insert(std::string name) {
    const std::lock_guard lock(mutex_);
    inserted_ = std::move(name);
}

std::vector<std::string> DebugLabels::names() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> names(regions_.rbegin(), regions_.rend());
    if (!inserted_.empty()) names.insert(names.begin(), inserted_);
    return names;
}

void DebugUtils::add(const std::shared_ptr<DebugMessenger>& messenger) {
    const std::lock_guard lock(mutex_);
    messengers_.push_back(messenger);
}

void DebugUtils::remove(const DebugMessenger& messenger) {
    const std::lock_guard lock(mutex_);
    std::erase_if(messengers_, [&](const auto& weak) {
        const auto other = weak.lock();
        return !other || other.get() == &messenger;
    });
}

void DebugUtils::set_name(XrObjectType type, std::uint64_t object, std::string name) {
    const std::lock_guard lock(mutex_);
    if (name.empty()) {
        names_.erase({type, object});
    } else {
        names_[{type, object}] = std::move(name);
    }
}

void DebugUtils::submit(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
                        XrDebugUtilsMessengerCallbackDataEXT data) const {
    std::vector<std::shared_ptr<DebugMessenger>> messengers;
    std::vector<XrDebugUtilsObjectNameInfoEXT> objects(data.objects, data.objects + data.objectCount);
    std::vector<std::string> names(objects.size()), label_names;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& weak : messengers_) {
            if (auto messenger = weak.lock()) messengers.push_back(std::move(messenger));
        }
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const auto found = names_.find({objects[i].objectType, objects[i].objectHandle});
            if (found != names_.end()) names[i] = found->second;
        }
    }
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (!objects[i].objectName && !names[i].empty()) objects[i].objectName = names[i].c_str();
        if (objects[i].objectType != XR_OBJECT_TYPE_SESSION || !label_names.empty()) continue;
        const auto session = find_object(objects[i].objectHandle, XR_OBJECT_TYPE_SESSION);
        if (session) label_names = static_cast<const Session&>(*session).labels().names();
    }
    data.objects = objects.data();
    std::vector<XrDebugUtilsLabelEXT> labels;
    for (const std::string& name : label_names)
        labels.push_back({XR_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name.c_str()});
    if (data.sessionLabelCount == 0) {
        data.sessionLabelCount = static_cast<std::uint32_t>(labels.size());
        data.sessionLabels = labels.data();
    }
    for (const auto& messenger : messengers) messenger->tell(severity, types, data);
}

void tell_refusal(const char* signature, XrResult result) noexcept {
    try {
        const auto instance = find_root(object_of_call);
        const char* const name = name_of(result);
        if (!instance || !name) return;
        std::string function(signature);  // XrResult foveray::simulator::xrEndFrame(XrSession, …)
        function.erase(std::min(function.find('('), function.size()));
        function.erase(0, function.find_last_of(": ") + 1);
        const std::string message = function + " answers " + name;
        XrDebugUtilsMessengerCallbackDataEXT data{};
        data.type = XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT;
        data.messageId = name;
        data.functionName = function.c_str();
        data.message = message.c_str();
        static_cast<Instance&>(*instance).debug().submit(XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
                                                         XR_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
                                                         data);
    } catch (const std::bad_alloc&) {
        // The call itself still answers.
    }
}

}  // namespace foveray::simulator
