#pragma once

#include <spdlog/spdlog.h>

namespace foveray::log {

/// Messages go to standard error, so that standard output stays clean for --json.
/// level: trace, debug, info, warn, error, off.
void init(const std::string& level = "info");

using spdlog::debug;
using spdlog::error;
using spdlog::info;
using spdlog::warn;

}  // namespace foveray::log
