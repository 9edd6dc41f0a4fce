#!/usr/bin/env bash
# bundle.sh FOLDER [PROGRAM…]: foveray-bench (or other built programs without OpenCV) with the libraries that it needs and the assets
# that it measures, to be copied to another x86-64 Linux machine with a Vulkan driver and glibc no older than here:
#   scripts/bundle.sh bundle && scp -r bundle other: && ssh other bundle/foveray-bench
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
[ $# -ge 1 ] || { echo "usage: scripts/bundle.sh FOLDER [PROGRAM…]" >&2; exit 2; }
folder=$1
shift
programs=("$@")
if [ ${#programs[@]} = 0 ]; then
    "$here/scripts/build.sh" foveray-bench >&2
    programs=("$here/build/release/app/foveray-bench")
fi

rm -rf "$folder"
mkdir -p "$folder/lib" "$folder/assets/models" "$folder/assets/scenes"
for program in "${programs[@]}"; do
    strip -o "$folder/$(basename "$program")" "$program"
    # All but the C library, which belongs to the machine.
    ldd "$program" | awk '$3 ~ /^\// {print $3}' |
        { grep -vE '/(libc|libm|libdl|libpthread|librt|ld-linux[^/]*)\.so' || true; } |
        xargs -r cp -Lt "$folder/lib"
done
# The Vulkan loader is opened at run time; a machine with a driver may still lack it.
loader=$(ldconfig -p | awk '/libvulkan\.so\.1 / && /x86-64/ && !n++ {print $NF}')
cp -L "$loader" "$folder/lib/"

cp -r "$here/assets/headsets" "$folder/assets/"
cp -r "$here/assets/scenes/." "$folder/assets/scenes/"
cp "$here"/assets/models/* "$folder/assets/models/"
for optional in shapes environments; do
    if [ -d "$here/assets/$optional" ]; then cp -r "$here/assets/$optional" "$folder/assets/"; fi
done
echo "$(du -sh "$folder" | cut -f1)	$folder"
