#!/usr/bin/env bash
# simulator_bench.sh [--json FILE] [LAUNCHER CLIENT]: what the simulated headset costs by itself, without a display:
# its CPU time a frame when frames are only counted, how exactly it keeps real time, its GPU time for composing. Builds
# both programs unless they are named: foveray-openxr-simulator, and clear_colour of docs/examples/openxr_client.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)

json=
if [ "${1:-}" = --json ]; then
    json=${2:?--json wants a file}
    shift 2
fi
if [ $# = 0 ]; then
    "$here/scripts/build.sh" foveray_openxr_simulator clear_colour >&2
    set -- "$here/build/release/xr/simulator/foveray-openxr-simulator" "$here/build/release/docs/examples/clear_colour"
fi
[ $# = 2 ] || { echo "usage: scripts/simulator_bench.sh [--json FILE] [LAUNCHER CLIENT]" >&2; exit 2; }
launcher=$1
client=$2

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
results=()
printf '%-44s %10s %10s  %s\n' '' median 'p99' unit

# measure NAME KEY UNIT FRAMES AWK_EXPRESSION LAUNCHER_OPTIONS…: the expression over the columns of the timing file, "" leaves
# a line out; the first lines are the warm-up.
measure() {
    local name=$1 key=$2 unit=$3 frames=$4 expression=$5 values median p99
    shift 5
    "$launcher" "$@" --timing "$work/timing.csv" -- "$client" "$frames" quad >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
    values=$(awk -F, "NR > 11 { v = $expression; if (v != \"\") print v < 0 ? -v : v }" "$work/timing.csv" | sort -g)
    read -r median p99 <<<"$(awk '{ a[NR] = $1 }
        END { if (NR) print a[int((NR + 1) / 2)], a[int(NR * 0.99 + 0.999)]; else print "null", "null" }' <<<"$values")"
    printf '%-44s %10s %10s  %s\n' "$name" "$median" "$p99" "$unit"
    results+=("\"$key\": {\"median\": $median, \"p99\": $p99, \"unit\": \"$unit\"}")
}

# Frame i may begin a period before it is shown; of a headset with 90 Hz that has focus views, too.
sed 's/"rate_hz": *[0-9.]*/"rate_hz": 90/' "$here/assets/headsets/ci.json" >"$work/ci-90.json"
# With small pictures, so that the client's work on a software renderer leaves the caches alone.
measure 'CPU a frame, counting only' cpu_us us 2000 '$11' --profile ci --time virtual
measure 'pacing error at 90 Hz' pacing_error_ms ms 900 '($5 - $3) * 1e-6 + 1000 / 90' --profile "$work/ci-90.json" --time real
measure 'GPU a frame, composing (varjo-xr1)' composition_ms ms 22 '$12' --profile varjo-xr1 --time virtual \
    --capture "$work/shown" --capture-format raw --frames 6:20

[ -z "$json" ] || { IFS=,; printf '{%s}\n' "${results[*]}" >"$json"; }
