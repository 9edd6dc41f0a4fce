#pragma once

#include <string>
#include <vector>

namespace foveray::fakes {

struct ProgramResult {
    int exit_code = -1;  // 128 + signal for a crash
    std::string out, err;
};

/// Runs the built foveray with validation layers on, as a user would, and waits.
ProgramResult run_foveray(const std::vector<std::string>& arguments);

}  // namespace foveray::fakes
