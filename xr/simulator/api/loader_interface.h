#pragma once

#include <cstddef>
#include <cstdint>

#include <openxr/openxr.h>

/// The loader's side of the contract, from the OpenXR loader design document, "Loader-runtime interface".
/// Debian's packages do not ship the header that declares it.
namespace foveray::simulator {

constexpr std::uint32_t loader_info_struct = 1;
constexpr std::uint32_t runtime_request_struct = 3;
constexpr std::uint32_t interface_version = 1;

struct NegotiateLoaderInfo {
    std::uint32_t struct_type;  // loader_info_struct
    std::uint32_t struct_version;
    std::size_t struct_size;
    std::uint32_t min_interface_version;
    std::uint32_t max_interface_version;
    XrVersion min_api_version;
    XrVersion max_api_version;
};

struct NegotiateRuntimeRequest {
    std::uint32_t struct_type;  // runtime_request_struct
    std::uint32_t struct_version;
    std::size_t struct_size;
    std::uint32_t runtime_interface_version;           // out
    XrVersion runtime_api_version;                     // out
    PFN_xrGetInstanceProcAddr get_instance_proc_addr;  // out
};

}  // namespace foveray::simulator

extern "C" __attribute__((visibility("default"))) XRAPI_ATTR XrResult XRAPI_CALL
xrNegotiateLoaderRuntimeInterface(const foveray::simulator::NegotiateLoaderInfo* loader,
                                  foveray::simulator::NegotiateRuntimeRequest* runtime);
