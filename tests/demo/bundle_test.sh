#!/usr/bin/env bash
# scripts/bundle.sh: the folder holds the program, its libraries and assets, is small, and runs by itself.
set -euo pipefail
script=$1
bench=$2

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$script" "$work/bundle" "$bench"
mebibytes=$(du -sm "$work/bundle" | cut -f1)
[ "$mebibytes" -lt 60 ] || { echo "$mebibytes MiB are too many"; exit 1; }
for file in foveray-bench lib/libvulkan.so.1 assets/scenes/proceduray.json; do
    [ -s "$work/bundle/$file" ] || { echo "no $file"; exit 1; }
done
# From another place, and with no library from elsewhere but the C library's.
mv "$work/bundle" "$work/moved"
cd /
(unset LD_LIBRARY_PATH FOVERAY_ASSETS; "$work/moved/foveray-bench" --help) | grep -q -- --rows
elsewhere=$(ldd "$work/moved/foveray-bench" | awk -v own="$work/moved/lib/" '$3 ~ /^\// && index($3, own) != 1 {print $1}' |
    { grep -vE '^(libc|libm|libdl|libpthread|librt)\.so' || true; })
[ -z "$elsewhere" ] || { echo "not from the bundle: $elsewhere"; exit 1; }
