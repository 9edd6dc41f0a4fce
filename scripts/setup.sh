#!/usr/bin/env bash
# Installs what foveray is built with and runs on, on Debian 12 and 13: only what is missing, from the mirror that apt
# is already configured with. Does nothing, quickly, when all is there.
set -euo pipefail

say() { printf 'setup: %s\n' "$*"; }
die() { printf 'setup: error: %s\n' "$*" >&2; exit 3; }
as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"
    elif command -v sudo >/dev/null; then sudo env DEBIAN_FRONTEND=noninteractive "$@"
    else die "packages are missing and this is neither root nor sudo; run scripts/setup.sh as root once"
    fi
}

[ -r /etc/os-release ] || die "this is no Debian; install by hand what the list in scripts/setup.sh names"
# shellcheck disable=SC1091
. /etc/os-release
case "${VERSION_CODENAME:-}" in
    bookworm | trixie) ;;
    *) die "Debian 12 or 13 is needed, this is ${PRETTY_NAME:-unknown}; install by hand what the list in scripts/setup.sh names" ;;
esac

packages=(
    build-essential cmake ninja-build pkg-config
    libvulkan-dev libvulkan1 vulkan-validationlayers glslang-tools glslang-dev libvulkan-memory-allocator-dev mesa-vulkan-drivers
    libopenxr-dev libopenxr-loader1
    libglm-dev nlohmann-json3-dev libvalijson-dev libspdlog-dev libcli11-dev libtinygltf-dev libstb-dev libpng-dev
    libmeshoptimizer-dev
    libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev libopencv-calib3d-dev
    libglfw3-dev libimgui-dev
    libgtest-dev
)
[ "${FOVERAY_SETUP_TESTS:-}" = 1 ] && packages+=(xvfb)

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }
mesa_is_new_enough() {
    local version
    version=$(dpkg-query -W -f='${Version}' mesa-vulkan-drivers 2>/dev/null) || return 1
    dpkg --compare-versions "$version" ge 24.3
}

missing=()
for package in "${packages[@]}"; do is_installed "$package" || missing+=("$package"); done
upgrade_mesa=no
if ! mesa_is_new_enough; then upgrade_mesa=yes; fi
[ "${#missing[@]}" = 0 ] && [ "$upgrade_mesa" = no ] && exit 0

export DEBIAN_FRONTEND=noninteractive

# On Debian 12 Mesa's software Vulkan has ray tracing only in bookworm-backports, and Vulkan Memory Allocator is
# packaged (as a header) only in trixie: that one package is let through, nothing else of trixie. Suites that apt knows
# already are left as they are.
knows_suite() { [ -n "$(apt-get indextargets --format '$(REPO_URI)' "Codename: $1")" ]; }
has_candidate() { apt-cache policy "$1" | grep 'Candidate: [0-9]' >/dev/null; }
add_suites() {
    local uri suites=()
    has_candidate libvulkan-memory-allocator-dev || knows_suite trixie || suites+=(trixie)
    knows_suite bookworm-backports || suites+=(bookworm-backports)
    [ "${#suites[@]}" -gt 0 ] || return 0
    uri=$(apt-get indextargets --format '$(REPO_URI)' 'Codename: bookworm' 'Origin: Debian' | awk '/^http/ && !n++')
    [ -n "$uri" ] || die "apt has no Debian mirror configured for bookworm"
    say "adding ${suites[*]} from the mirror that apt uses"
    as_root tee /etc/apt/sources.list.d/foveray.sources >/dev/null <<SOURCES
Types: deb
URIs: $uri
Suites: ${suites[*]}
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
SOURCES
    if [[ " ${suites[*]} " == *" trixie "* ]]; then
        as_root tee /etc/apt/preferences.d/foveray >/dev/null <<PINS
Package: *
Pin: release n=trixie
Pin-Priority: -10

Package: libvulkan-memory-allocator-dev
Pin: release n=trixie
Pin-Priority: 100
PINS
    fi
    as_root apt-get update -qq
}

say "updating the package lists"
as_root apt-get update -qq
if [ "$VERSION_CODENAME" = bookworm ]; then add_suites; fi

install() { as_root apt-get install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 "$@" >/dev/null; }
others=()
for package in "${missing[@]}"; do [ "$package" = mesa-vulkan-drivers ] || others+=("$package"); done
if [ "${#others[@]}" -gt 0 ]; then
    say "installing ${others[*]}"
    install "${others[@]}"
fi
if [ "$upgrade_mesa" = yes ]; then
    say "installing mesa-vulkan-drivers with ray tracing"
    if [ "$VERSION_CODENAME" = bookworm ]; then install -t bookworm-backports mesa-vulkan-drivers
    else install mesa-vulkan-drivers
    fi
fi
say "done"
