#include "app/bench/tables.h"

namespace foveray::app {

const std::vector<BenchTable>& bench_tables() {
    static const std::vector<BenchTable> tables = {
        {"procedural", "each procedural shape alone, the paper's scene, voxels beside their triangles",
         procedural_rows},
    };
    return tables;
}

}  // namespace foveray::app
