#!/usr/bin/env bash
# The whole test suite: installs what is missing, builds everything, runs ctest. --long adds the long tests.
set -euo pipefail
cd "$(dirname "$0")"

exclude=(--label-exclude long)
for argument in "$@"; do
    case "$argument" in
        --long) exclude=() ;;
        *) echo "test.sh: unknown option '$argument'; there is only --long" >&2; exit 2 ;;
    esac
done

FOVERAY_SETUP_TESTS=1 scripts/setup.sh
scripts/build.sh all
ctest --test-dir build/release --output-on-failure -j "$(nproc)" "${exclude[@]}"
