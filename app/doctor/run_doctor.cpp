#include <algorithm>
#include <array>
#include <iostream>

#include "app/commands.h"
#include "app/doctor/finding.h"
#include "base/json.h"

namespace foveray::app {
namespace {

const char* state_name(Finding::State state) {
    switch (state) {
        case Finding::State::Good:
            return "ok";
        case Finding::State::Optional:
            return "optional";
        case Finding::State::Missing:
            return "missing";
        case Finding::State::Note:
            return "note";
    }
    return "";
}

void print(const std::vector<Finding>& findings, bool can_run) {
    const std::string indent(10, ' ');
    for (const Finding& finding : findings) {
        std::string state = state_name(finding.state);
        state.resize(indent.size(), ' ');
        std::cout << state << finding.subject << ": " << finding.what << '\n';
        if (!finding.remedy.empty()) std::cout << indent << "to get it: " << finding.remedy << '\n';
    }
    std::cout << (can_run ? "foveray can run here.\n"
                          : "foveray cannot run here yet: see what is missing above.\n");
}

void print_json(const std::vector<Finding>& findings, bool can_run) {
    Json json = {{"can_run", can_run}, {"findings", Json::array()}};
    for (const Finding& finding : findings) {
        Json item = {
            {"subject", finding.subject}, {"state", state_name(finding.state)}, {"what", finding.what}};
        if (!finding.remedy.empty()) item["remedy"] = finding.remedy;
        json["findings"].push_back(std::move(item));
    }
    std::cout << json.dump(2) << '\n';
}

}  // namespace

ExitCode run_doctor(const DoctorOptions& options) {
    std::vector<Finding> findings;
    for (auto& part : std::array{find_vulkan(), find_openxr(), find_cameras("/dev", "/sys/class/video4linux"),
                                 find_video_encoder()}) {
        findings.insert(findings.end(), part.begin(), part.end());
    }
    const bool can_run = std::none_of(findings.begin(), findings.end(),
                                      [](const Finding& f) { return f.state == Finding::State::Missing; });
    options.json ? print_json(findings, can_run) : print(findings, can_run);
    return can_run ? ExitCode::Done : ExitCode::Missing;
}

}  // namespace foveray::app
