#pragma once

#include <functional>
#include <iosfwd>

#include "base/error.h"

namespace foveray::app {

/// Runs a program and turns what it throws into one line on `errors` and an exit code; every error of foveray
/// ends here.
int run_guarded(std::ostream& errors, const std::function<ExitCode()>& program);

/// FOVERAY_VALIDATION=1: Vulkan's validation layer watches, and one message makes the exit code Internal.
bool validation_wanted();

}  // namespace foveray::app
