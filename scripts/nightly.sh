#!/usr/bin/env bash
# nightly.sh [PART...]: what takes too long for scripts/test.sh. Each part says its totals in out/nightly/PART.txt, and fails if it finds
# anything; docs/results/robustness.md is made of these totals (scripts/results.sh robustness). Without a name: all, in some hours.
#   killed     runs of five scenes killed by SIGKILL at random moments and resumed (FLOE_KILLS of each, 50)
#   faults     every allocation and every write of whole runs fails once
#   fuzz       libFuzzer on decks and checkpoints (FLOE_SECONDS each, 1800), with the address and undefined-behaviour sanitizers
#   sanitize   the tests with the address and undefined-behaviour sanitizers
#   thread     the tests with the thread sanitizer, two threads (clang, libarcher)
#   valgrind   the tests under valgrind
#   coverage   lines that the tests run, by room
# FLOE_TESTS: a regular expression of ctest that chooses the tests of sanitize, thread, valgrind and coverage (unit, conformance, fault).
set -uo pipefail
cd "$(dirname "$0")/.." || exit
export OMP_WAIT_POLICY=passive
totals=out/nightly
tests=${FLOE_TESTS:-^(unit|conformance|fault)_}
seconds=${FLOE_SECONDS:-1800}
jobs=${FLOE_JOBS:-$(nproc)}
mkdir -p "$totals"

note() {
    printf '%s\n' "$*" | tee -a "$totals/$part.txt"
}

# Tests of a build, and how they ended.
run_tests() { # BUILD
    local log=$totals/$part.log status=0 start=$SECONDS
    ctest --test-dir "build/$1" -R "$tests" -j "$jobs" --output-on-failure --no-tests=error >"$log" 2>&1 || status=1
    note "$(sed -n 's/^\([0-9]*% tests passed, .*\)$/\1/p' "$log"); $((SECONDS - start)) s; tests $tests"
    [ $status -eq 0 ] || grep -E '\(Failed\)|\(Timeout\)|SEGFAULT' "$log"
    return $status
}

part_killed() {
    scripts/build.sh release floe || return
    FLOE=$PWD/build/release/floe FLOE_SOURCE=$PWD FLOE_KILLS=${FLOE_KILLS:-50} FLOE_TOTALS=$PWD/$totals/killed.txt \
        FLOE_SCENES='points coupled sealed reaction contact' bash tests/cli/killed.sh
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

part_thread() {
    local archer
    archer=$(find /usr/lib/llvm-*/lib -name libarcher.so 2>/dev/null | head -n 1)
    [ -n "$archer" ] || { echo 'nightly.sh: no libarcher.so: install libomp-dev' >&2; return 1; }
    scripts/build.sh thread || return
    # The libraries below floe are not instrumented; cmocka and HDF5 run on one thread.
    OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS="ignore_noninstrumented_modules=1 history_size=5" run_tests thread
}

part_valgrind() {
    scripts/build.sh release || return
    local test status=0 n=0 start=$SECONDS bad=()
    for test in $(ctest --test-dir build/release -N -R "$tests" | sed -n 's/^ *Test *#[0-9]*: //p'); do
        [ -x "build/release/tests/$test" ] || continue
        n=$((n + 1))
        OMP_NUM_THREADS=1 timeout "${FLOE_LIMIT:-1200}" valgrind -q --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite \
            --suppressions=tests/valgrind.supp "build/release/tests/$test" >"$totals/valgrind_$test.log" 2>&1 || bad+=("$test:$?")
    done
    note "$n tests, ${#bad[@]} with findings or out of time${bad[*]:+: ${bad[*]}}; $((SECONDS - start)) s; tests $tests"
    [ ${#bad[@]} -eq 0 ]
}

part_coverage() {
    scripts/build.sh coverage || return
    find build/coverage -name '*.gcda' -delete
    run_tests coverage || return
    local room file
    for room in src/*/; do
        room=$(basename "$room")
        find "build/coverage/src/$room" -name '*.gcda' 2>/dev/null | while read -r file; do
            gcov -n -o "$(dirname "$file")" "$file" 2>/dev/null
        done | awk -v room="$room" -v source="src/$room/" '/^File / { mine = index($0, source) && /\.c\x27$/ }
            mine && /^Lines executed/ { split($0, part, /[:% ]+/); n = $NF; all += n; run += part[3] / 100 * n; mine = 0 }
            END { if (all) printf "%-9s %5.1f %% of %5d lines\n", room, 100 * run / all, all }'
    done | tee -a "$totals/coverage.txt"
}

scripts/setup.sh nightly || exit
[ $# -gt 0 ] || set -- killed faults fuzz sanitize thread valgrind coverage
failed=()
for part in "$@"; do
    declare -F "part_$part" >/dev/null || { echo "nightly.sh: unknown part '$part'" >&2; exit 2; }
    echo "== $part"
    rm -f "$totals/$part.txt"
    "part_$part" || failed+=("$part")
done
[ ${#failed[@]} -eq 0 ] || { echo "FAILED: ${failed[*]}" >&2; exit 1; }
