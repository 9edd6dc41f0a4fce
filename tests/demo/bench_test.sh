#!/usr/bin/env bash
# foveray-bench: one row of a table, as small and short as may be, has times above 0; a bad name is refused.
set -euo pipefail
bench=$1
assets=$2

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export FOVERAY_ASSETS=$assets
"$bench" procedural --rows "sphere, " --quick --seconds 0.1 --json --out "$work/out" >"$work/result.json" 2>"$work/log" ||
    { echo "exit code $?"; cat "$work/log"; exit 1; }
python3 - "$work/result.json" <<'PYTHON'
import json, sys
tables = json.load(open(sys.argv[1]))["tables"]
rows = [row for table in tables for row in table["rows"]]
assert rows, "no rows"
for row in rows:
    assert "sphere, " in row["row"], row["row"]
    assert row["frames"] > 0 and row["gpu_ms"]["median"] > 0 and row["rays"]["primary"] > 0, row
    assert row["memory_bytes"] > 0 and row["bare_ms"]["median"] > 0 and row["stages_ms"]["primary"]["median"] > 0, row
PYTHON
[ -s "$work/out/bench.json" ] || { echo "no bench.json"; exit 1; }
ls "$work"/out/*.png >/dev/null || { echo "no picture"; exit 1; }

code=0
"$bench" procedurel >/dev/null 2>"$work/error" || code=$?
[ "$code" = 2 ] || { echo "exit code $code for a table that there is not"; cat "$work/error"; exit 1; }
