#include <algorithm>

#include "app/doctor/finding.h"
#include "base/error.h"
#include "xr/client/instance.h"
#include "xr/client/runtime_choice.h"

namespace foveray::app {
namespace {

using State = Finding::State;

/// Asks the runtime that XR_RUNTIME_JSON or the usual folders name.
std::string describe_headset() {
    const xr::Instance instance;
    const auto sizes = instance.view_sizes(false);
    std::string text = instance.runtime_name() + ", headset " + instance.system_name() + ", " +
                       std::to_string(sizes.size()) + " views of";
    for (std::size_t i = 0; i < sizes.size(); i += 2) {
        text +=
            std::string(i ? " and " : " ") + std::to_string(sizes[i].x) + " × " + std::to_string(sizes[i].y);
    }
    text += instance.has_eye_tracking() ? ", eye tracking" : ", no eye tracking";
    const auto& modes = instance.blend_modes();
    if (std::find(modes.begin(), modes.end(), BlendMode::AlphaBlend) != modes.end()) text += ", see-through";
    return text;
}

Finding find_system_runtime() {
    const std::string subject = "OpenXR runtime";
    const std::filesystem::path manifest = xr::system_runtime_manifest();
    if (manifest.empty()) {
        return {State::Optional, subject, "none is active; foveray uses its simulated headset",
                "install your headset's runtime, or Monado (Debian 13: apt-get install libopenxr1-monado "
                "monado-service)"};
    }
    try {
        return {State::Good, subject, describe_headset() + " (" + manifest.string() + ")", ""};
    } catch (const Fault& fault) {
        return {State::Optional, subject, manifest.string() + ": " + fault.what(), ""};
    }
}

Finding find_simulator() {
    const std::string subject = "Simulated headset";
    try {
        const std::filesystem::path manifest = xr::simulator_manifest();
        xr::use_simulator({});
        return {State::Good, subject, describe_headset() + " (" + manifest.string() + ")", ""};
    } catch (const Fault& fault) {
        return {State::Optional, subject, fault.what(), ""};
    }
}

}  // namespace

std::vector<Finding> find_openxr() {
    std::vector<Finding> findings = {find_system_runtime(), find_simulator()};
    if (std::none_of(findings.begin(), findings.end(),
                     [](const Finding& f) { return f.state == State::Good; })) {
        findings.push_back({State::Missing, "Headset", "neither a real nor the simulated one answers",
                            "build the whole of foveray with ./run.sh"});
    }
    return findings;
}

}  // namespace foveray::app
