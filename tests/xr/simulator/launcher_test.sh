#!/usr/bin/env bash
# foveray-openxr-simulator: a program runs on the simulated headset, leaves its pictures, and its exit code is passed on.
set -euo pipefail
launcher=$1
foveray=$2
export FOVERAY_ASSETS=$3

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; cat "$work"/log; exit 1; }

"$launcher" --profile quest-pro --session "$FOVERAY_ASSETS/sessions/demo" --time virtual --frames 0:2 --capture "$work/frames" \
    -- env >"$work/log" || fail "exit code $?"
for line in FOVERAY_SIMULATOR_PROFILE=quest-pro FOVERAY_SIMULATOR_TIME=virtual FOVERAY_SIMULATOR_CAPTURE_FRAMES=0:2; do
    grep -qx "$line" "$work/log" || fail "no $line"
done

# A program that goes elsewhere before it makes its instance finds what was named from here.
(cd "$work" && "$launcher" --profile own.json --session s --faults f.csv --capture 'my frames' --timing t.csv --background 'c/*_left.png' \
    -- sh -c 'cd / && env' >"$work/log") || fail "exit code $?"
for line in PROFILE=$work/own.json SESSION=$work/s FAULTS=$work/f.csv "CAPTURE=$work/my frames" TIMING=$work/t.csv \
    "BACKGROUND=$work/c/*_left.png"; do
    grep -qxF "FOVERAY_SIMULATOR_$line" "$work/log" || fail "no $line"
done
"$launcher" --profile ci --background '#102030' -- env >"$work/log" || fail "exit code $?"
for line in PROFILE=ci 'BACKGROUND=#102030'; do
    grep -qxF "FOVERAY_SIMULATOR_$line" "$work/log" || fail "no $line"
done

# A program that ends when the script does.
mkdir "$work/session"
cat >"$work/session/session.json" <<'SESSION'
{"format": "foveray-session", "version": 1, "units": {"time": "ns", "length": "m", "rotation": "unit quaternion"},
 "headset": "ci", "rate_hz": 30, "frames": 3, "recorded": []}
SESSION
"$launcher" --session "$work/session" --time virtual --frames 0:2 --capture "$work/frames" -- \
    "$foveray" view "$FOVERAY_ASSETS/scenes/primitives.json" --runtime system >"$work/log" 2>&1 || fail "exit code $?"
[ -f "$work/frames/frame_00001_left.png" ] || fail "no pictures"
[ ! -e "$work/frames/frame_00002_left.png" ] || fail "a picture too many"

# Stepped from outside: three frames, and then the session and the program end.
XDG_RUNTIME_DIR=$work "$launcher" --session "$work/session" --time stepped -- \
    "$foveray" view "$FOVERAY_ASSETS/scenes/primitives.json" --runtime system >"$work/log" 2>&1 &
program=$!
control() { XDG_RUNTIME_DIR=$work "$launcher" --control "$program" "$@"; }
[ "$(control step 2)" = "ok frame=1" ] || fail "step 2 was not done"
control state | grep -q "^ok state=FOCUSED frame=1 " || fail "no state"
code=0
printf 'press left/trigger\nfly\n' | control >"$work/replies" || code=$?
[ "$code" = 1 ] && grep -qx ok "$work/replies" && grep -q "^error .*'fly'" "$work/replies" || fail "wrong replies"
[ "$(control step)" = "ok frame=2" ] || fail "the last step was not done"
wait "$program" || fail "exit code $?"
code=0
control state 2>/dev/null || code=$?
[ "$code" = 2 ] || fail "a program that ended still listens: $code"

code=0
"$launcher" -- sh -c 'exit 7' || code=$?
[ "$code" = 7 ] || { echo "exit code $code instead of 7"; exit 1; }
code=0
"$launcher" --timing "$work/no/such/folder.csv" -- "$foveray" view "$FOVERAY_ASSETS/scenes/primitives.json" --runtime system \
    2>"$work/log" || code=$?
[ "$code" != 0 ] && grep -q "FOVERAY_SIMULATOR_TIMING=$work/no/such/folder.csv" "$work/log" || fail "a timing file without a folder"
for wrong in "--headset ci -- true" "--profile" "--profile --" "true" "--"; do
    code=0
    # shellcheck disable=SC2086
    "$launcher" $wrong 2>"$work/log" || code=$?
    [ "$code" = 2 ] || fail "'$wrong': exit code $code instead of 2"
done
