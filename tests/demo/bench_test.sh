#!/usr/bin/env bash
# foveray-bench: a row of a table, as small and short as may be, has times above 0; a bad name is refused.
set -euo pipefail
bench=$1
assets=$2

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export FOVERAY_ASSETS=$assets
measure() { # TABLE ROW ASSIGNMENTS...: one row of the table
    local table=$1 row=$2
    shift 2
    "$bench" "$table" --rows "$row" --quick --seconds 0.1 --json --out "$work/$table" "$@" >"$work/$table.json" 2>"$work/log" ||
        { echo "exit code $?"; cat "$work/log"; exit 1; }
    python3 - "$work/$table.json" "$row" <<'PYTHON'
import json, sys
tables = json.load(open(sys.argv[1]))["tables"]
rows = [row for table in tables for row in table["rows"]]
assert rows, "no rows"
for row in rows:
    assert sys.argv[2] in row["row"], row["row"]
    assert row["frames"] > 0 and row["gpu_ms"]["median"] > 0 and row["rays"]["primary"] > 0, row
    assert row["memory_bytes"] > 0 and row["bare_ms"]["median"] > 0 and row["stages_ms"]["primary"]["median"] > 0, row
    if sys.argv[2].startswith("polar"):  # of the paper: all its rays
        assert all(row["rays"][kind] > 0 for kind in ("shadow", "reflection", "occlusion", "probe")), row["rays"]
PYTHON
    [ -s "$work/$table/bench.json" ] || { echo "no bench.json"; exit 1; }
    ls "$work/$table"/*.png >/dev/null || { echo "no picture"; exit 1; }
}
measure procedural "sphere, "
measure herr "polar 1576 x 768, 64" --set probes.rays=16 --set foveation.resolution_scale=0.6

code=0
"$bench" procedurel >/dev/null 2>"$work/error" || code=$?
[ "$code" = 2 ] || { echo "exit code $code for a table that there is not"; cat "$work/error"; exit 1; }
