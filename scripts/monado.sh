#!/usr/bin/env bash
# monado.sh [--folder DIR] [STEP…]: foveray on Debian 13 and against a real OpenXR runtime, Monado with its simulated
# headset. All of it happens in DIR, a Debian 13 of its own (made where it is missing; without --folder in the user's
# cache). The steps, all in this order without a list:
#   prepare   Debian 13, foveray's dependencies, Monado
#   build     everything
#   test      ctest without the long tests; the simulated headset is OpenXR 1.1 there
#   run       foveray view and foveray replay on Monado, to FOCUSED and 100 frames without an error
# Ends with 3 where it cannot run: it wants to be root on a Debian, and to be allowed to mount and chroot.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)

say() { printf 'monado: %s\n' "$*"; }
cannot() { printf 'monado: cannot run: %s\n' "$*" >&2; exit 3; }

folder=${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/foveray/debian13
if [ "${1:-}" = --folder ]; then
    folder=$(realpath -m "${2:?--folder wants a name}")
    shift 2
fi
steps=("$@")
[ $# -gt 0 ] || steps=(prepare build test run)
for step in "${steps[@]}"; do
    case "$step" in
        prepare | build | test | run) ;;
        *) echo "monado.sh: unknown step '$step'; there are prepare, build, test and run" >&2; exit 2 ;;
    esac
done

[ "$(id -u)" = 0 ] || cannot "it has to be root, for debootstrap and chroot"
command -v apt-get >/dev/null || cannot "this is no Debian"
mkdir -p "$folder"
unshare --mount chroot / true 2>/dev/null || cannot "mounts and chroot are not allowed here"

# The Debian mirror that apt is configured with.
mirror() {
    # shellcheck disable=SC1091
    local codename=$(. /etc/os-release && echo "$VERSION_CODENAME")
    apt-get indextargets --format '$(REPO_URI)' "Codename: $codename" 'Origin: Debian' | awk '/^http/ && !n++'
}

# Runs a shell script as that user in Debian 13. The source tree is /foveray there and read only, /build keeps what is built.
# Mounts and processes end with it.
inside() {
    local user=$1 script=$2
    folder=$folder here=$here user=$user script=$script unshare --mount --pid --fork --kill-child bash -c '
        set -e
        mkdir -p "$folder"/{foveray,build,proc,dev}
        mount --bind "$here" "$folder/foveray"
        mount -o remount,bind,ro "$folder/foveray"
        mount -t proc proc "$folder/proc"
        mount --rbind /dev "$folder/dev"
        exec chroot "$folder" /usr/bin/env -i HOME=/build USER="$user" LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
            PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
            /usr/bin/setpriv --reuid "$user" --regid "$user" --clear-groups bash -euo pipefail -c "cd /build; $script"'
}

prepare() {
    if [ ! -e "$folder/etc/os-release" ]; then
        local uri
        uri=$(mirror)
        [ -n "$uri" ] || cannot "apt has no Debian mirror configured"
        command -v debootstrap >/dev/null || apt-get install -y -qq debootstrap >/dev/null
        say "making a Debian 13 in $folder"
        debootstrap --variant=minbase trixie "$folder.part" "$uri" >"$folder.log" 2>&1 || { tail -n 5 "$folder.log" >&2; exit 1; }
        rmdir "$folder"
        mv "$folder.part" "$folder"
        apt-config dump | grep -i '^Acquire::.*Proxy' >"$folder/etc/apt/apt.conf.d/proxy" || true
    fi
    say "installing what foveray needs, and Monado"
    inside root '
        FOVERAY_SETUP_TESTS=1 /foveray/scripts/setup.sh
        dpkg -s monado-service libopenxr1-monado >/dev/null 2>&1 ||
            apt-get install -y -qq --no-install-recommends monado-service libopenxr1-monado >/dev/null
        id foveray >/dev/null 2>&1 || useradd --no-create-home --home-dir /build foveray
        chown foveray: /build'
}

build() {
    say "building"
    inside foveray '
        cmake -S /foveray -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release >configure.log || { cat configure.log; exit 1; }
        ninja'
}

test_() {
    say "testing"
    inside foveray 'ctest --output-on-failure -j "$(nproc)" --label-exclude long'
}

run() {
    say "running foveray on Monado"
    inside foveray "$(cat <<'SCRIPT'
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
export XDG_RUNTIME_DIR=$dir XRT_COMPOSITOR_NULL=1 SIMULATED_ENABLE=1
# Without validation layers: Monado 25 chains a second structure for timeline semaphores to the device, which they report.
export XR_RUNTIME_JSON=/usr/share/openxr/1/openxr_monado.json
foveray=/build/app/foveray
fail() { echo "monado: $1" >&2; tail -n 40 "$dir"/*.log >&2; exit 1; }

mkfifo "$dir/input"   # Monado ends when its standard input does
exec 9<>"$dir/input"
monado-service <&9 >"$dir/monado.log" 2>&1 &
for _ in $(seq 100); do [ -S "$dir/monado_comp_ipc" ] && break; sleep 0.1; done
[ -S "$dir/monado_comp_ipc" ] || fail "monado-service does not start"

# view goes on until it is interrupted; what it recorded tells how many frames it showed.
frames() { tail -n +2 "$dir/session/head.csv" | wc -l; }
quick=(--set foveation.resolution_scale=0.2 --set lighting.shadows=0 --set lighting.reflections=0)  # the GPU may be none
for seconds in 20 80 320; do
    rm -rf "$dir/session"
    code=0
    timeout --preserve-status -s INT "$seconds" "$foveray" view /foveray/assets/scenes/primitives.json --runtime system "${quick[@]}" \
        --log-level debug --record "$dir/session" >"$dir/view.log" 2>&1 || code=$?
    [ "$code" = 0 ] || [ "$code" = 130 ] || fail "view ended with $code"
    [ "$(frames)" -lt 100 ] || break
done
[ "$(frames)" -ge 100 ] || fail "view showed $(frames) frames instead of 100 in $seconds s"
grep -q XR_SESSION_STATE_FOCUSED "$dir/view.log" || fail "view was never focused"

"$foveray" replay "$dir/session" --frames 0:100 --runtime system "${quick[@]}" --out "$dir/replayed" \
    >"$dir/replay.log" 2>&1 || fail "replay ended with $?"
! grep -E '\bERROR\b|error:' "$dir"/{view,replay}.log || fail "messages"
echo "monado: view and replay ran on Monado"
SCRIPT
)"
}

for step in "${steps[@]}"; do
    if [ "$step" = test ]; then test_; else "$step"; fi
done
