#!/usr/bin/env bash
# The installed simulator: another project finds it, and tests its OpenXR program on it.
set -euo pipefail
build=$1
example=$2
shift 2

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; exit 1; }
unset FOVERAY_ASSETS XR_RUNTIME_JSON

quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; fail "failed: $*"; }; }

quietly cmake --install "$build" --component simulator --prefix "$work/prefix"
mv "$work/prefix" "$work/moved"  # it may stand anywhere
quietly cmake -S "$example" -B "$work/project" -DCMAKE_PREFIX_PATH="$work/moved" "$@"
quietly cmake --build "$work/project"
# It asks its own headsets: neither those that it was built with nor a program's folder of the same name.
mkdir "$work/project/assets"
headsets=$(find "$work/moved" -type d -name headsets)
mv "$headsets/ci.json" "$headsets/only-here.json"
quietly "$work/moved/bin/foveray-openxr-simulator" --profile only-here --time virtual -- "$work/project/clear_colour" 3
grep -qx '3 frames' "$work/log" || fail "not 3 frames: $(cat "$work/log")"
mv "$headsets/only-here.json" "$headsets/ci.json"

ctest --test-dir "$work/project" --output-on-failure
[ -f "$work/project/shown/frame_00001_right.png" ] || fail "no pictures"

rows() { tail -n +2 "$work/project/shown/timing.csv"; }
[ "$(rows | wc -l)" = 100 ] || fail "$(rows | wc -l) rows of times instead of 100"
# Frames in order, each waited for, begun and ended in this order; one layer when it may be seen; virtual time misses none.
rows | awk -F, '
    NF != 12 || $1 != NR - 1 || $9 != 0 || $11 <= 0 || ($12 != "") != (NR <= 2) { bad = 1 }
    !($4 <= $5 && $5 <= $6 && $6 <= $7 && $7 <= $8 && $4 >= ended) { bad = 1 }
    $2 != (NR - 1) * period && NR > 2 { bad = 1 }
    NR == 2 { period = $2 }
    $10 == 1 { layers++ }
    { ended = $8 }
    END { exit bad || layers < 95 }' || fail "odd times: $(head -n 5 "$work/project/shown/timing.csv")"
