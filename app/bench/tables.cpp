#include "app/bench/tables.h"

namespace foveray::app {

const std::vector<BenchTable>& bench_tables() {
    static const std::vector<BenchTable> tables = {
        {"herr", "HERR's table 1: light samples and polar sizes, beside full resolution", herr_rows},
        {"procedural", "each procedural shape alone, the paper's scene, voxels beside their triangles",
         procedural_rows},
        {"changes", "a thousand instances that stand still, move, come and go", changes_rows},
    };
    return tables;
}

}  // namespace foveray::app
