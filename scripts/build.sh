#!/usr/bin/env bash
# build.sh PRESET [TARGET...]: configures and builds build/PRESET (a preset of CMakePresets.json: release, debug, sanitize ...).
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:?usage: scripts/build.sh PRESET [TARGET...]: release, debug, sanitize, thread, fuzz, coverage or native}
shift
# A build folder that came along with a moved or copied source tree is of no use.
cache=build/$preset/CMakeCache.txt
if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$cache"; then
    rm -rf "build/$preset"
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! cmake --preset "$preset" >"$log" 2>&1; then
    cat "$log" >&2
    exit 1
fi
cmake --build --preset "$preset" ${1:+--target "$@"}
