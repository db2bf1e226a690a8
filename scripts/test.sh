#!/usr/bin/env bash
# Everything that must hold before a change is kept: builds without warnings, the format, static analysis, the quick
# tests with debug checks, and the quick tests as users run them. All parts run even if one fails; a failure of any
# is the exit status.
set -uo pipefail
cd "$(dirname "$0")/.." || exit

failed=()

# part NAME COMMAND...: runs the command under a heading, and remembers a failure.
part() {
    local name=$1 start=$SECONDS
    shift
    printf '\n== %s\n' "$name"
    "$@" || failed+=("$name")
    printf -- '-- %s: %d s\n' "$name" $((SECONDS - start))
}

sources() {
    find src include tests bench -name '*.[ch]' "$@" 2>/dev/null
}

# The result depends on the version: only that of Debian 12 is the judge.
check_format() {
    if ! clang-format --version | grep -q 'version 14\.'; then
        echo "skipped: needs clang-format 14, found $(clang-format --version)"
        return 0
    fi
    sources -print0 | xargs -0 clang-format --dry-run --Werror
}

check_analysis() {
    local log status
    log=$(mktemp)
    # Of the point kernels, which are one source compiled forty times, one.
    run-clang-tidy -quiet -p build/debug -j "$(nproc)" "$PWD/src/" 'kernels_plane_linear_pairs\.c' >"$log" 2>&1
    status=$?
    # One line a file is run-clang-tidy's echo of its command; it also always asks for colours.
    sed 's/\x1b\[[0-9;]*m//g' "$log" | grep -vE '^clang-tidy|warnings? generated|^Suppressed|^Use -header-filter|treated as error'
    rm -f "$log"
    return $status
}

quick_tests() { # PRESET [ctest arguments]
    local preset=$1
    shift
    ctest --preset "$preset" -L quick -j "$(nproc)" --no-tests=error "$@"
}

scripts/setup.sh || exit
scripts/build.sh debug || exit
scripts/build.sh release || exit
part 'format' check_format
part 'static analysis' check_analysis
part 'quick tests, debug build' quick_tests debug -R '^(unit|conformance|fault)_'
part 'quick tests, release build' quick_tests release

if [ ${#failed[@]} -gt 0 ]; then
    printf 'FAILED:%s\n' "$(printf ' [%s]' "${failed[@]}")" >&2
    exit 1
fi
