#pragma once

#include <atomic>
#include <filesystem>

#include "tests/fuzz/random.h"

namespace foveray::fuzz {

/// A faults.csv in which much goes wrong.
void write_faults(const std::filesystem::path& file, Random& random);
/// Sends commands and garbage to the control socket of whatever instance listens at `socket`.
void send_commands(const std::atomic<bool>& done, const std::filesystem::path& socket, Random random);

}  // namespace foveray::fuzz
