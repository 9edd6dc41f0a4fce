#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/fakes/temporary_folder.h"

namespace foveray::fakes {

struct ProgramResult {
    int exit_code = -1;  // 128 + signal for a crash
    std::string out, err;
};

/// Runs the built foveray with validation layers on, as a user would, and waits.
ProgramResult run_foveray(const std::vector<std::string>& arguments);

/// Replays the demo into `folder`/`name`, expects success without a validation message, and returns that
/// path.
std::filesystem::path replay_demo(const TemporaryFolder& folder, const std::string& name,
                                  const std::vector<std::string>& more);

std::string file_bytes(const std::filesystem::path& file);

}  // namespace foveray::fakes
