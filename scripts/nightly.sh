#!/usr/bin/env bash
# nightly.sh [PART...]: what takes too long for scripts/test.sh. Each part says its totals in out/nightly/PART.txt, and fails if it finds
# anything; docs/results/robustness.md is made of these totals (scripts/results.sh robustness). Without a name: all, in some hours.
#   killed        runs of five scenes killed by SIGKILL at random moments and resumed (FLOE_KILLS of each, 50)
#   faults        every allocation and every write of whole runs fails once
#   combinations  decks with a few keys set at random (FLOE_COMBINATIONS, 1000): each runs, or is refused with its place
#   metamorphic   every deck in other units with every method; and mirrored, turned, moved, told in another order
#   meshes        tests of the solvers on finer meshes than every day's, in more places, and checkpoints with more damages
#   fuzz          libFuzzer on decks and checkpoints (FLOE_SECONDS each, 1800), with the address and undefined-behaviour sanitizers
#   sanitize      the tests with the address and undefined-behaviour sanitizers
#   decks         every deck of inputs/ in every coupling: some steps, and as many more from its checkpoint, with the address and
#                 undefined-behaviour sanitizers of gcc and of clang (FLOE_STEPS, 3)
#   thread        the tests with the thread sanitizer, two threads (clang, libarcher)
#   valgrind      the tests under valgrind
#   coverage      lines that the tests run, by module
# FLOE_TESTS: a regular expression of ctest that chooses the tests of sanitize, thread, valgrind and coverage (all). Which of them have passed is
# in out/nightly/PART.passed; with FLOE_CONTINUE=1 these four do the others only. FLOE_LIMIT: the longest that one test may take, in seconds (3600).
set -uo pipefail
cd "$(dirname "$0")/.." || exit
export OMP_WAIT_POLICY=passive
totals=out/nightly
tests=${FLOE_TESTS:-.}
limit=${FLOE_LIMIT:-3600}
seconds=${FLOE_SECONDS:-1800}
jobs=${FLOE_JOBS:-$(nproc)}
mkdir -p "$totals"

note() {
    printf '%s\n' "$*" | tee -a "$totals/$part.txt"
}

# Names of the tests of a build that are to be run.
list_tests() { # BUILD
    ctest --test-dir "build/$1" -N -L quick -R "$tests" | sed -n 's/^ *Test *#[0-9]*: //p'
}

# The names that have passed are forgotten unless a part goes on.
start_passed() {
    passed=$totals/$part.passed
    failed_here=$totals/$part.failed
    : >"$failed_here"
    [ -n "${FLOE_CONTINUE:-}" ] || : >"$passed"
    touch "$passed"
}

# How many of the tests to be run have passed, which failed, and which did not end or were not come to; fails unless all have passed.
note_passed() { # BUILD
    local all wrong missing
    all=$(list_tests "$1" | sort)
    wrong=$(comm -12 <(printf '%s\n' "$all") <(grep -vxFf "$passed" "$failed_here" | sort -u) | paste -sd' ')
    missing=$(comm -23 <(printf '%s\n' "$all") <(sort -u "$passed" "$failed_here") | paste -sd' ')
    note "$(comm -12 <(printf '%s\n' "$all") <(sort -u "$passed") | wc -l) of $(printf '%s\n' "$all" | wc -l) tests passed," \
        "$(wc -w <<<"$wrong") failed${wrong:+: $wrong}; $(wc -w <<<"$missing") not ended${missing:+: $missing};" \
        "floe $("build/$1/floe" --version | sed -n '1s/.*(\(.*\)).*/\1/p')"
    [ -z "$wrong$missing" ]
}

# Tests of a build, and how they ended.
run_tests() { # BUILD
    local log=$totals/$part.log
    start_passed
    ctest --test-dir "build/$1" -L quick -R "$tests" -E "^($(paste -sd'|' "$passed"))$" -j "$jobs" --timeout "$limit" --output-on-failure >"$log" 2>&1
    sed -nE 's/.*Test +#[0-9]+: ([a-z0-9_]+) .*Passed.*/\1/p' "$log" >>"$passed"
    sed -nE '/Timeout/d; s/.*Test +#[0-9]+: ([a-z0-9_]+) .*\*\*\*.*/\1/p' "$log" >>"$failed_here"
    grep -E '\(Failed\)|\(Timeout\)|SEGFAULT' "$log"
    note_passed "$1"
}

part_killed() {
    scripts/build.sh release floe || return
    FLOE=$PWD/build/release/floe FLOE_SOURCE=$PWD FLOE_KILLS=${FLOE_KILLS:-50} FLOE_TOTALS=$PWD/$totals/killed.txt \
        FLOE_SCENES='points coupled sealed reaction contact' bash tests/cli/killed.sh
}

part_metamorphic() {
    scripts/build.sh release verification_sim_units verification_sim_symmetry || return
    local test status=0
    for test in verification_sim_units verification_sim_symmetry; do
        FLOE_EVERY=1 OMP_NUM_THREADS=1 "build/release/tests/$test" >"$totals/$test.txt" 2>&1 || status=1
        grep -E 'runs,| of [a-z/_]+, | at most: |differ|apart' "$totals/$test.txt" | tee -a "$totals/$part.txt"
    done
    return $status
}

part_meshes() {
    local tests=(unit_io_checkpoint verification_coupled_{cylinder,embedded_space,touch} verification_ice_smooth
        verification_mpm_{annulus,limit,normals,soft,states}) test status=0
    scripts/build.sh release "${tests[@]}" || return
    for test in "${tests[@]}"; do
        FLOE_EVERY=1 OMP_NUM_THREADS=1 "build/release/tests/$test" >"$totals/$test.txt" 2>&1 || status=1
        note "$test: $(grep -cE '^\[ +OK ' "$totals/$test.txt") passed"
    done
    return $status
}

part_faults() {
    scripts/build.sh release fault_run_faults fault_sim_reject unit_deck_keys || return
    local test status=0
    for test in fault_run_faults fault_sim_reject unit_deck_keys; do
        FLOE_EVERY=1 OMP_NUM_THREADS=2 "build/release/tests/$test" >"$totals/$test.txt" 2>&1 || status=1
        grep -E 'faults|stages|keys,' "$totals/$test.txt" | tee -a "$totals/$part.txt"
    done
    return $status
}

part_combinations() {
    scripts/build.sh release floe || return
    FLOE=$PWD/build/release/floe FLOE_SOURCE=$PWD FLOE_COMBINATIONS=${FLOE_COMBINATIONS:-1000} FLOE_SEED=${FLOE_SEED:-$RANDOM} \
        FLOE_TOTALS=$PWD/$totals/combinations.txt bash tests/cli/combinations.sh
}

# What is found goes into tests/fuzz only by hand: the smallest inputs that say something new.
part_fuzz() {
    scripts/build.sh fuzz fuzz_deck fuzz_checkpoint || return
    local name status=0 found corpus
    for name in deck checkpoint; do
        found=out/fuzz/$name
        corpus=("$found" "tests/fuzz/$name")
        [ $name = deck ] && corpus+=(inputs tests/cli/decks)
        mkdir -p "$found"
        LSAN_OPTIONS=suppressions=tests/fuzz/libfyaml.supp OMP_NUM_THREADS=1 "build/fuzz/tests/fuzz/fuzz_$name" \
            -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -max_len=16384 -print_final_stats=1 \
            -artifact_prefix="$totals/fuzz_$name-" "${corpus[@]}" >"$totals/fuzz_$name.log" 2>&1 || status=1
        note "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$totals/fuzz_$name.log") inputs in" \
            "$(sed -n 's/^Done [0-9]* runs in \([0-9]*\) second.*/\1/p' "$totals/fuzz_$name.log") s," \
            "$(grep -oE 'cov: [0-9]+' "$totals/fuzz_$name.log" | tail -n 1 | cut -d' ' -f2) edges," \
            "$(find "$found" -type f | wc -l) inputs kept," \
            "$(find "$totals" -name "fuzz_$name-*" | wc -l) crashes, leaks or timeouts"
    done
    return $status
}

part_sanitize() {
    scripts/build.sh sanitize && run_tests sanitize
}

part_decks() {
    local preset status=0
    for preset in sanitize sanitize-clang; do
        scripts/build.sh "$preset" floe || return
        FLOE=$PWD/build/$preset/floe FLOE_SOURCE=$PWD FLOE_EVERY=1 FLOE_STEPS=${FLOE_STEPS:-3} FLOE_TOTALS=$PWD/$totals/decks_one.txt \
            UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0" \
            bash tests/cli/same_verdict.sh >"$totals/decks_$preset.log" 2>&1 || status=1
        note "$("build/$preset/floe" --version | sed -nE '2s/,.*//p'): $(cat "$totals/decks_one.txt")"
        rm -f "$totals/decks_one.txt"
    done
    return $status
}

part_thread() {
    local archer
    archer=$(find /usr/lib/llvm-*/lib -name libarcher.so 2>/dev/null | head -n 1)
    [ -n "$archer" ] || { echo 'nightly.sh: no libarcher.so: install libomp-dev' >&2; return 1; }
    scripts/build.sh thread || return
    # The libraries below floe are not instrumented; cmocka and HDF5 run on one thread.
    OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS="ignore_noninstrumented_modules=1 history_size=5" run_tests thread
}

# Programs under valgrind; scripts of the command line have it around floe.
part_valgrind() {
    scripts/build.sh release || return
    local test command checker="valgrind -q --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite --suppressions=$PWD/tests/valgrind.supp"
    printf '#!/bin/sh\nexec %s "%s" "$@"\n' "$checker" "$PWD/build/release/floe" >"$totals/valgrind_floe"
    chmod +x "$totals/valgrind_floe"
    start_passed
    for test in $(list_tests release | grep -vxFf "$passed"); do
        command=$(ctest --test-dir build/release -V -N -R "^$test\$" | sed -nE 's/^[0-9]+: Test command: //p')
        case $test in cli_* | source_rules) ;; *) command="$checker $command" ;; esac
        local got=0
        FLOE=$PWD/$totals/valgrind_floe FLOE_SOURCE=$PWD FLOE_NO_GUARD=1 OMP_NUM_THREADS=1 timeout "$limit" bash -c "$command" >"$totals/valgrind_$test.log" 2>&1 || got=$?
        case $got in
            0) echo "$test" >>"$passed" ;;
            124) ;; # out of time
            *) echo "$test" >>"$failed_here" ;;
        esac
    done
    note_passed release
}

part_coverage() {
    scripts/build.sh coverage || return
    local module file status=0
    [ -n "${FLOE_CONTINUE:-}" ] || find build/coverage -name '*.gcda' -delete
    run_tests coverage || status=1
    for module in src/*/; do
        module=$(basename "$module")
        find "build/coverage/src/$module" -name '*.gcda' 2>/dev/null | while read -r file; do
            gcov -n -o "$(dirname "$file")" "$file" 2>/dev/null
        done | awk -v module="$module" -v source="src/$module/" '/^File / { mine = index($0, source) && /\.c\x27$/ }
            mine && /^Lines executed/ { split($0, part, /[:% ]+/); n = $NF; all += n; run += part[3] / 100 * n; mine = 0 }
            END { if (all) printf "%-9s %5.1f %% of %5d lines\n", module, 100 * run / all, all }'
    done | tee -a "$totals/coverage.txt"
    return $status
}

scripts/setup.sh nightly || exit
[ $# -gt 0 ] || set -- killed faults combinations metamorphic meshes fuzz sanitize decks thread valgrind coverage
failed=()
for part in "$@"; do
    declare -F "part_$part" >/dev/null || { echo "nightly.sh: unknown part '$part'" >&2; exit 2; }
    echo "== $part"
    rm -f "$totals/$part.txt"
    "part_$part" || failed+=("$part")
done
[ ${#failed[@]} -eq 0 ] || { echo "FAILED: ${failed[*]}" >&2; exit 1; }
