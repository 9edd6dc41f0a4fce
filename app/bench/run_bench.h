#pragma once

#include "app/bench/table.h"
#include "base/error.h"

namespace foveray::app {

/// Measures the rows of the tables on one device and prints them; with `out`, also writes bench.json and a
/// picture a row. GPU time is the sum of the stages' timestamps.
ExitCode run_bench(const BenchOptions& options);

}  // namespace foveray::app
