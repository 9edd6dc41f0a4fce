#include "tests/xr/simulator/direct_runtime.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>

namespace foveray::simulator_tests {

DirectRuntime::DirectRuntime() : library_(dlopen(SIMULATOR_LIBRARY, RTLD_NOW | RTLD_LOCAL)) {
    if (library_)
        negotiate_ = reinterpret_cast<decltype(negotiate_)>(symbol("xrNegotiateLoaderRuntimeInterface"));
    const LoaderInfo loader;
    RuntimeRequest request;
    if (!negotiate_ || negotiate_(&loader, &request) != XR_SUCCESS) {
        std::fprintf(stderr, "cannot use %s\n", SIMULATOR_LIBRARY);
        std::abort();
    }
    get_ = request.get;
}

void* DirectRuntime::symbol(const char* name) const { return dlsym(library_, name); }

XrInstance DirectRuntime::create_instance(const std::vector<const char*>& extensions) const {
    XrInstanceCreateInfo info{};
    info.type = XR_TYPE_INSTANCE_CREATE_INFO;
    std::strcpy(info.applicationInfo.applicationName, "direct");
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.enabledExtensionNames = extensions.data();
    XrInstance instance = XR_NULL_HANDLE;
    load<PFN_xrCreateInstance>(XR_NULL_HANDLE, "xrCreateInstance")(&info, &instance);
    return instance;
}

}  // namespace foveray::simulator_tests
