#!/usr/bin/env bash
# setup.sh [nightly]: installs what floe needs on Debian 12 (scripts/packages.txt; with `nightly` also scripts/packages-nightly.txt).
# With nothing missing it only looks; elsewhere, or without the right to install, it says what is missing and fails.
set -euo pipefail
cd "$(dirname "$0")/.."

lists=(scripts/packages.txt)
[ "${1:-}" = nightly ] && lists+=(scripts/packages-nightly.txt)
packages=$(cat "${lists[@]}" | sed -e 's/#.*//' | awk 'NF { print $1 }')

# The packages of the list that dpkg does not have installed.
missing_packages() {
    local package
    for package in $packages; do
        dpkg-query -W -f='${Status}\n' "$package" 2>/dev/null | grep -q 'install ok installed' || echo "$package"
    done
}

# Commands, pkg-config modules and CMake packages: the same needs, in the words of any system.
missing_elsewhere() {
    local name
    for name in cc cmake ninja pkg-config git python3 clang-format clang-tidy; do
        command -v "$name" >/dev/null || echo "command $name"
    done
    command -v pkg-config >/dev/null || return 0
    for name in gsl libfyaml udunits jansson cmocka; do
        pkg-config --exists "$name" || echo "library $name (pkg-config)"
    done
    pkg-config --exists hdf5-serial || pkg-config --exists hdf5 || echo "library hdf5 (pkg-config)"
    python3 -c 'import numpy, h5py, matplotlib, jinja2' 2>/dev/null || echo 'Python packages numpy, h5py, matplotlib, jinja2'
    [ -n "$(find /usr/lib /usr/local/lib /opt -name SUNDIALSConfig.cmake -print -quit 2>/dev/null)" ] ||
        echo "library SUNDIALS 6.4 or later (CMake package)"
}

if ! command -v dpkg-query >/dev/null; then
    missing=$(missing_elsewhere)
    if [ -n "$missing" ]; then
        printf 'floe: this is not a Debian system; please install:\n%s\n' "$missing" >&2
        exit 1
    fi
    exit 0
fi

missing=$(missing_packages | tr '\n' ' ')
[ -z "$missing" ] && exit 0

install=(env DEBIAN_FRONTEND=noninteractive apt-get)
if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
        install=(sudo "${install[@]}")
    else
        printf 'floe: no right to install packages; please install: %s\n' "$missing" >&2
        exit 1
    fi
fi
echo "floe: installing $missing"
# shellcheck disable=SC2086 # a list of words
"${install[@]}" install -y --no-install-recommends $missing ||
    { "${install[@]}" update && "${install[@]}" install -y --no-install-recommends $missing; }
