#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <openxr/openxr.h>

#include "xr/simulator/handles.h"

namespace foveray::simulator {

class Instance;

/// XR_EXT_debug_utils: a client's callback with the messages that it wants.
class DebugMessenger : public Object {
  public:
    using Handle = XrDebugUtilsMessengerEXT;
    static constexpr XrObjectType object_type = XR_OBJECT_TYPE_DEBUG_UTILS_MESSENGER_EXT;

    DebugMessenger(std::shared_ptr<Instance> instance, const XrDebugUtilsMessengerCreateInfoEXT& info)
        : instance_(std::move(instance)), info_(info) {}
    void on_destroy() override;

    void tell(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
              const XrDebugUtilsMessengerCallbackDataEXT& data) const;

  private:
    std::shared_ptr<Instance> instance_;
    XrDebugUtilsMessengerCreateInfoEXT info_;
};

/// The labels of a session: regions that were begun and not ended, and the one inserted last. Safe to use
/// from any thread.
class DebugLabels {
  public:
    void begin_region(std::string name);
    void end_region();
    void insert(std::string name);
    /// The newest first.
    std::vector<std::string> names() const;

  private:
    mutable std::mutex mutex_;
    std::vector<std::string> regions_;
    std::string inserted_;  // empty: none since the last region began or ended
};

/// An instance's messengers and the names of its objects. Safe to use from any thread.
class DebugUtils {
  public:
    void add(const std::shared_ptr<DebugMessenger>& messenger);
    void remove(const DebugMessenger& messenger);
    /// An empty name removes the one given before.
    void set_name(XrObjectType type, std::uint64_t object, std::string name);

    /// Tells all messengers that want it. Objects that have a name and come without one get it, and the
    /// message the labels of the first session among them.
    void submit(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
                XrDebugUtilsMessengerCallbackDataEXT data) const;

  private:
    mutable std::mutex mutex_;
    std::vector<std::weak_ptr<DebugMessenger>> messengers_;
    std::map<std::pair<XrObjectType, std::uint64_t>, std::string> names_;
};

}  // namespace foveray::simulator
