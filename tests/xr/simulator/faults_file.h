#pragma once

#include <fstream>

#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {

/// A file of faults that the next instance plays.
class FaultsFile {
  public:
    /// Lines without the header. Sets the environment.
    explicit FaultsFile(const std::string& lines, std::map<std::string, std::string> variables = {}) {
        std::ofstream(path()) << "at,fault,value\n" << lines;
        variables["FAULTS"] = path();
        set_environment(variables);
    }

    std::string path() const { return folder_.path() / "faults.csv"; }

  private:
    fakes::TemporaryFolder folder_;
};

/// A headless session that was begun, which plays frame 0.
inline void begin_headless(SimulatorClient& client) {
    client.create_headless_session();
    client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
}

inline XrResult create_instance(XrInstance* instance) {
    const char* const extension = XR_MND_HEADLESS_EXTENSION_NAME;
    XrInstanceCreateInfo info{};
    info.type = XR_TYPE_INSTANCE_CREATE_INFO;
    info.applicationInfo = {"faults", 0, "", 0, XR_MAKE_VERSION(1, 0, 0)};
    info.enabledExtensionCount = 1;
    info.enabledExtensionNames = &extension;
    return xrCreateInstance(&info, instance);
}

inline XrResult try_wait_frame(const SimulatorClient& client) {
    XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
    return xrWaitFrame(client.session, nullptr, &state);
}

inline XrResult try_get_system(XrInstance instance) {
    const XrSystemGetInfo info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    XrSystemId system = XR_NULL_SYSTEM_ID;
    return xrGetSystem(instance, &info, &system);
}

}  // namespace foveray::simulator_tests
