#!/usr/bin/env bash
# The whole test suite: installs what is missing, builds everything, runs ctest. --long adds the long tests, the simulated
# headset under the sanitizers with ten minutes of random calls each, and Debian 13 with Monado where that can run.
set -euo pipefail
cd "$(dirname "$0")"

long=no
exclude=(--label-exclude long)
for argument in "$@"; do
    case "$argument" in
        --long) long=yes exclude=() ;;
        *) echo "test.sh: unknown option '$argument'; there is only --long" >&2; exit 2 ;;
    esac
done

FOVERAY_SETUP_TESTS=1 scripts/setup.sh
scripts/build.sh all
ctest --test-dir build/release --output-on-failure -j "$(nproc)" "${exclude[@]}"
[ "$long" = yes ] || exit 0

# Frames are counted only: the sanitizers slow the software renderer down too much, and it is not built with them.
composing='Backgrounds.*:Blending.*:Captures.*:Reprojection.*:SurfaceLayers.*'
export FOVERAY_ASSETS=$PWD/assets
for preset in asan tsan; do
    echo "test.sh: the simulated headset, $preset"
    cmake --preset "$preset" >/dev/null
    cmake --build "build/$preset" --target foveray_simulator_tests foveray_simulator_fuzzer
    "build/$preset/tests/xr/simulator/foveray_simulator_tests" --gtest_brief=1 --gtest_filter="-$composing"
    "build/$preset/tests/fuzz/foveray_simulator_fuzzer" --seconds 600
done
unset FOVERAY_ASSETS

code=0
scripts/monado.sh || code=$?
case $code in
    0) ;;
    3) echo "test.sh: Debian 13 and Monado are left out; the line above says why" ;;
    *) exit $code ;;
esac
