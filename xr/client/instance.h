#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/frame.h"
#include "render/gpu/device.h"
#include "xr/client/openxr.h"

namespace foveray::xr {

/// A connection to a runtime, and what the runtime's headset offers.
class Instance {
  public:
    /// Throws Fault(Missing) when no runtime answers or it lacks XR_KHR_vulkan_enable2.
    Instance() { connect(); }
    /// Connects anew after the runtime lost the instance; everything made from that must be gone. Throws as
    /// the constructor; what the headset offered stays until `find_headset`.
    void reconnect();
    /// Looks for the headset and reads what it offers. False: it is away for now. Throws Fault(Missing) when
    /// the runtime never has one.
    bool find_headset();

    XrInstance get() const { return instance_.get(); }
    XrSystemId system() const { return system_; }
    bool has(const char* extension) const { return enabled_.contains(extension); }
    const std::string& runtime_name() const { return runtime_name_; }
    const std::string& system_name() const { return system_name_; }
    bool has_eye_tracking() const { return has_eye_tracking_; }
    bool can_foveate() const { return can_foveate_; }
    /// Quad views where the runtime has them, else stereo.
    XrViewConfigurationType view_configuration() const { return view_configuration_; }
    const std::vector<BlendMode>& blend_modes() const { return blend_modes_; }
    /// Recommended sizes, one a view; `foveated` as in XR_VARJO_foveated_rendering.
    std::vector<uvec2> view_sizes(bool foveated) const;

    XrPath path(const char* text) const;
    template <typename Function>
    Function function(const char* name) const {
        PFN_xrVoidFunction pointer = nullptr;
        check(xrGetInstanceProcAddr(get(), name, &pointer), name);
        return reinterpret_cast<Function>(pointer);
    }

    /// The runtime dictates the physical device and adds what it needs to instance and device.
    gpu::DeviceSource device_source() const;

  private:
    void connect();
    void read_properties();
    void read_view_configuration();

    InstanceHandle instance_;
    std::set<std::string> enabled_;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
    std::string runtime_name_, system_name_;
    bool has_eye_tracking_ = false, can_foveate_ = false;
    XrViewConfigurationType view_configuration_ = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    std::vector<BlendMode> blend_modes_;
};

}  // namespace foveray::xr
