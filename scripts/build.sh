#!/usr/bin/env bash
# Builds the named targets (default: the program and the simulated headset) in build/release.
set -euo pipefail
cd "$(dirname "$0")/.."

[ -f build/release/build.ninja ] || cmake --preset release >/dev/null
cmake --build build/release --target "${@:-foveray}"
