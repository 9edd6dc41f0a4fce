#!/usr/bin/env bash
# `foveray view` with its desktop window on a virtual display: runs, ends on Ctrl-C, and its recording replays.
set -euo pipefail
program=$1
assets=$2

work=$(mktemp -d)
Xvfb -displayfd 3 -screen 0 1400x900x24 3>"$work/display" 2>"$work/xvfb.log" &
server=$!
trap 'kill "$server" 2>/dev/null || true; rm -rf "$work"' EXIT
for _ in $(seq 100); do [ -s "$work/display" ] && break; sleep 0.1; done
[ -s "$work/display" ] || { echo "no virtual display"; cat "$work/xvfb.log"; exit 1; }

export FOVERAY_VALIDATION=1 FOVERAY_ASSETS=$assets
DISPLAY=:$(cat "$work/display") timeout --preserve-status -s INT 8 \
    "$program" view "$assets/scenes/primitives.json" --runtime simulator --headset ci --mirror --record "$work/recording"
[ -s "$work/recording/head.csv" ] || { echo "nothing was recorded"; exit 1; }
"$program" replay "$work/recording" --frames 0:1 --out "$work/out" --set camera.blend=off
[ -s "$work/out/frames/frame_00000_left.png" ] || { echo "the recording shows nothing"; exit 1; }

# Without a display: a clear word and exit code 3.
code=0
env -u DISPLAY -u WAYLAND_DISPLAY "$program" view --runtime simulator --mirror 2>"$work/error" || code=$?
[ "$code" = 3 ] || { echo "exit code $code without a display"; cat "$work/error"; exit 1; }
