#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/xr/simulator/vulkan_client.h"

namespace foveray::simulator_tests {

// As in the loader design document.
struct LoaderInfo {
    std::uint32_t type = 1, version = 1;
    std::size_t size = sizeof(LoaderInfo);
    std::uint32_t min_interface = 1, max_interface = 1;
    XrVersion min_api = XR_MAKE_VERSION(1, 0, 0), max_api = XR_MAKE_VERSION(1, 0x3ff, 0xfff);
};
struct RuntimeRequest {
    std::uint32_t type = 3, version = 1;
    std::size_t size = sizeof(RuntimeRequest);
    std::uint32_t interface = 0;
    XrVersion api = 0;
    PFN_xrGetInstanceProcAddr get = nullptr;
};

/// The simulator's library without the loader, which would not pass garbage on.
class DirectRuntime {
  public:
    /// Ends the program with a message when the library cannot be loaded.
    DirectRuntime();

    XrResult negotiate(const LoaderInfo* loader, RuntimeRequest* request) const {
        return negotiate_(loader, request);
    }
    XrResult get_proc_addr(XrInstance instance, const char* name, PFN_xrVoidFunction* function) const {
        return get_(instance, name, function);
    }
    /// nullptr when there is none.
    template <typename Function>
    Function load(XrInstance instance, const char* name) const {
        PFN_xrVoidFunction found = nullptr;
        get_(instance, name, &found);
        return reinterpret_cast<Function>(found);
    }
    XrInstance create_instance(const std::vector<const char*>& extensions) const;
    /// An exported symbol.
    void* symbol(const char* name) const;

  private:
    void* library_ = nullptr;
    XrResult (*negotiate_)(const LoaderInfo*, RuntimeRequest*) = nullptr;
    PFN_xrGetInstanceProcAddr get_ = nullptr;
};

}  // namespace foveray::simulator_tests
