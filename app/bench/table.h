#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/offscreen/offscreen.h"
#include "base/json.h"

namespace foveray::app {

/// One line of a benchmark's table: a scene looked at in one way.
struct BenchRow {
    std::string name;
    std::function<scene::Scene()> scene;  // made when the row runs, gone when it has run
    std::function<Shot(const scene::Scene&)> shot;
    double frame_ms = 1000.0 / 60.0;  // session time from frame to frame
};

/// A table of the papers or of our own.
struct BenchTable {
    std::string name, help;
    std::function<std::vector<BenchRow>()> rows;
};

const std::vector<BenchTable>& bench_tables();

struct BenchOptions {
    std::vector<std::string> tables;       // empty: all
    std::string rows;                      // only rows whose name contains it
    std::filesystem::path out;             // bench.json and a picture a row; empty: none
    std::optional<std::uint32_t> gpu;      // index into vkEnumeratePhysicalDevices
    std::vector<std::string> assignments;  // KEY=VALUE, over the rows' own settings
    double seconds = 3.0;                  // measured a row
    bool quick = false;                    // a sixteenth of the pixels, three frames
    bool json = false;
};

/// Milliseconds, sorted: the middle and the 99th percentile.
struct Spread {
    double median = 0.0, p99 = 0.0;
};
Spread spread_of(std::vector<double> values);

}  // namespace foveray::app
