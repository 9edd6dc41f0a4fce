#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/fakes/temporary_folder.h"

namespace foveray::fakes {

struct ProgramResult {
    int exit_code = -1;  // 128 + signal for a crash, or for the end of its time
    std::string out, err;
};

/// Runs the built foveray with validation layers on, as a user would, and waits. It is killed when it takes
/// longer than `limit`.
ProgramResult run_foveray(const std::vector<std::string>& arguments,
                          std::chrono::seconds limit = std::chrono::hours(1));

/// Replays the demo into `folder`/`name`, expects success without a validation message, and returns that
/// path.
std::filesystem::path replay_demo(const TemporaryFolder& folder, const std::string& name,
                                  const std::vector<std::string>& more);

std::string file_bytes(const std::filesystem::path& file);

}  // namespace foveray::fakes
