#pragma once

#include "app/bench/table.h"

namespace CLI {
class App;
}

namespace foveray::app {

/// The options of `foveray bench` and foveray-bench.
void add_bench_options(CLI::App& app, BenchOptions& options);

}  // namespace foveray::app
