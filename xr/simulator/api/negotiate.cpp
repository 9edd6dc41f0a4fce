#include "xr/simulator/api/functions.h"
#include "xr/simulator/api/loader_interface.h"
#include "xr/simulator/instance.h"

namespace foveray::simulator {
namespace {

bool is_loader_info(const NegotiateLoaderInfo* info) {
    return info && info->struct_type == loader_info_struct && info->struct_version == 1 &&
           info->struct_size == sizeof *info && info->min_interface_version <= interface_version &&
           interface_version <= info->max_interface_version &&
           info->min_api_version <= supported_api_version &&
           XR_MAKE_VERSION(1, 0, 0) <= info->max_api_version;
}

bool is_runtime_request(const NegotiateRuntimeRequest* request) {
    return request && request->struct_type == runtime_request_struct && request->struct_version == 1 &&
           request->struct_size == sizeof *request;
}

}  // namespace
}  // namespace foveray::simulator

extern "C" XRAPI_ATTR XrResult XRAPI_CALL
xrNegotiateLoaderRuntimeInterface(const foveray::simulator::NegotiateLoaderInfo* loader,
                                  foveray::simulator::NegotiateRuntimeRequest* runtime) {
    using namespace foveray::simulator;
    if (!is_loader_info(loader) || !is_runtime_request(runtime)) return XR_ERROR_INITIALIZATION_FAILED;
    runtime->runtime_interface_version = interface_version;
    runtime->runtime_api_version = supported_api_version;
    runtime->get_instance_proc_addr =
        reinterpret_cast<PFN_xrGetInstanceProcAddr>(find_function("xrGetInstanceProcAddr")->function);
    return XR_SUCCESS;
}
