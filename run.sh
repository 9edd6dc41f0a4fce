#!/usr/bin/env bash
# First use: installs what is missing, builds, plays the demo session on the simulated headset.
# With arguments: the same set-up, then `foveray ARGS…`.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

"$here/scripts/setup.sh" >&2
echo "build: foveray (the first time takes some minutes)" >&2
"$here/scripts/build.sh" foveray >&2

if [ $# -gt 0 ]; then exec "$here/build/release/app/foveray" "$@"; fi
exec "$here/build/release/app/foveray" replay "$here/assets/sessions/demo" --out "$here/out/demo"
