#pragma once

#include "app/bench/table.h"

/// The rows of each table.
namespace foveray::app {

std::vector<BenchRow> herr_rows();
std::vector<BenchRow> procedural_rows();
std::vector<BenchRow> changes_rows();

}  // namespace foveray::app
