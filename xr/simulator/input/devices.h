#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include <openxr/openxr.h>

#include "base/math.h"
#include "base/time.h"
#include "xr/simulator/input/input_sources.h"
#include "xr/simulator/instance.h"
#include "xr/simulator/placement.h"

namespace foveray::simulator {

/// What a session's actions read: the script's controllers and eye tracker. From the first call of
/// XR_EXT_conformance_automation on, the controllers are those that the client sets. Safe to use from any
/// thread.
class Devices {
  public:
    explicit Devices(Instance& instance) : instance_(instance) {}

    struct Device {
        const InteractionProfile* profile = nullptr;  // nullptr: any that the client knows
    };
    /// The device of a user path, if one is connected.
    std::optional<Device> connected(std::string_view user_path) const;
    /// A Boolean or Float source's value in x, a Vector2 source's in both; nothing while the device is off.
    std::optional<vec2> value(const InputSource& source, Nanoseconds session_time) const;
    /// Of a pose source.
    Placement place(const InputSource& source, XrTime time) const;
    /// The eye tracker's, as gaze-contingent views use it: the last valid one.
    Placement place_rendering_gaze(XrTime time) const;

    // XR_EXT_conformance_automation
    void set_active(const std::string& user_path, const InteractionProfile& profile, bool active);
    void set_value(const InputSource& source, vec2 value);
    void set_placement(const InputSource& source, const Placement& placement);

  private:
    struct Automated {
        const InteractionProfile* profile = nullptr;
        bool active = false;
    };
    bool automates(std::string_view user_path) const;

    Instance& instance_;
    mutable std::mutex mutex_;  // what follows
    bool automated_ = false;
    std::map<std::string, Automated, std::less<>> devices_;  // by user path
    std::map<std::string, vec2, std::less<>> values_;  // by source path; x and y stand with their parent
    std::map<std::string, Placement, std::less<>> placements_;
};

}  // namespace foveray::simulator
