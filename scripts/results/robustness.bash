# robustness: kills, faults, bad input, sanitizers, coverage. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# total PART: what scripts/nightly.sh PART has said, as a block.
total() {
    if [ -s "out/nightly/$1.txt" ]; then
        sed 's/^/    /' "out/nightly/$1.txt" >>"$page"
    else
        write "    not run: scripts/nightly.sh $1"
    fi
    write ''
}

# counted PART PATTERN: the sum of the first numbers of the lines with the pattern.
counted() {
    grep -E "$2" "out/nightly/$1.txt" 2>/dev/null | grep -oE "[0-9]+ $2" | awk '{ n += $1 } END { print n + 0 }'
}

# tests_of PART: "PASSED ALL FAILED" of "P of A tests passed, F failed", the last time that was said.
tests_of() {
    sed -nE 's/^([0-9]+) of ([0-9]+) tests passed, ([0-9]+) failed.*/\1 \2 \3/p' "out/nightly/$1.txt" 2>/dev/null | tail -n 1
}

result_robustness() {
    begin robustness 'What cannot be: kills, faults, bad input'
    made_also=(tests scripts/nightly.sh)
    local part passed all failed
    for part in killed faults metamorphic; do
        [ -s "out/nightly/$part.txt" ] || scripts/nightly.sh "$part" >"$runs/$part.log" 2>&1 || true
    done
    bar 'kills by SIGKILL of five scenes, all resumed to the bits of the undisturbed run' "$(sed -n 's/^kills: \([0-9]*\) .*/\1/p' out/nightly/killed.txt)" '>=' 250 %d
    bar 'kills while a checkpoint was being written' "$(sed -n 's/.* \([0-9]*\) while a checkpoint.*/\1/p' out/nightly/killed.txt)" '>=' 50 %d
    bar 'decks spoiled in one key that were not refused at their place' "$(counted faults 'not refused')" '<=' 0 %d
    bar 'allocations of whole runs that were made to fail' "$(counted faults 'faults up to')" '>=' 1000 %d
    bar 'writes, syncs and renames of whole runs that were made to fail' "$(counted faults 'faults of calls')" '>=' 300 %d
    bar 'changes of the decks that must change nothing: runs that differ without a reason' "$(grep -oE '[0-9]+ wrong' out/nightly/metamorphic.txt | awk '{ n += $1 } END { print NR ? n : "nan" }')" '<=' 0 %d
    bar 'stages after which a step was rejected' "$(counted faults 'stages')" '>=' 200 %d
    for part in sanitize:'the address and undefined-behaviour sanitizers' thread:'the thread sanitizer' valgrind:'valgrind'; do
        read -r passed all failed < <(tests_of "${part%%:*}") || continue
        bar "tests with findings of ${part#*:}" "$failed" '<=' 0 %d
        bar "tests that have passed under ${part#*:}, of $all" "$passed" '>=' "$all" %d
    done
    bar 'lines of the modules mpm, ice and coupling that tests run, least of the three (%)' \
        "$(sed -nE 's/^(mpm|ice|coupling) +([0-9.]+) %.*/\2/p' out/nightly/coverage.txt 2>/dev/null | sort -g | head -n 1)" '>=' 90 %.1f
    write 'Totals of `scripts/nightly.sh`; the quick tests take a sample of each. What a part finds makes it fail.' '' '## Bars' ''
    show_bars
    write '' '## Kills' '' 'Five scenes (points; points in gas on cells; a membrane that holds gas; a reaction with the implicit pressure; bodies in contact), killed at random' \
        'moments, every second time while a checkpoint was half written, and resumed from what was left (`tests/cli/killed.sh`). Every byte of the header of' \
        'a checkpoint and a thousand bytes of its body are changed one at a time in `tests/unit/test_io_checkpoint.c`: each is refused, in words.' ''
    total killed
    write '## Faults' '' 'Whole runs in which one allocation and all after it fail; in which one write, sync or rename fails, for good (the disk is full) or once; what is left' \
        'is whole, and a run goes on from it to the bits of an undisturbed one (`tests/fault/test_run_faults.c`). Steps rejected after each of their stages' \
        '(`tests/fault/test_sim_reject.c`). Decks in which one key is wrong, made from the tables of the schema (`tests/unit/test_deck_keys.c`).' ''
    total faults
    write 'Decks of `inputs` with one to three keys set at random, two steps of each (`tests/cli/combinations.sh`):' ''
    total combinations
    write '## The same scene in other words' '' 'Every deck of `inputs/`, on a coarse mesh and for some steps. In other units, lengths, masses, times and temperatures by powers of two, with' \
        'every basis, transfer, limiter, solver and contact that it bears, to the same bits (`tests/verification/test_sim_units.c`, 60 steps, two sets of units). Mirrored,' \
        'its axes exchanged, moved by whole cells, its bodies or its materials in another order, a body told as two, with a fluid of which there is nothing, as a slab of one' \
        'cell in space, to round-off (`tests/verification/test_sim_symmetry.c`, 20 steps; a new deck is asked as well). What differs has its reason in the test:' ''
    total metamorphic
    write 'Found so, and mended: on cells that are no squares the bulk viscosity and the shock sensor took the length V^(1/d), too much along the finer axis: a tube' \
        'of cells 1 x 8 had 23 % less kinetic energy than one of a single row (now the same to round-off; the error of the tube of Sod was 52 % larger, now the same), and in slabs of one cell the density was off by 6 % after 20 steps where the depth was 16 times the side, and no step was right where it was a million times; the state of a fluid given by' \
        'pressure and density was searched from 300 K, and a cell without a guess at its pressure from 1e5 Pa; a reference and an exact solution knew a unit.' ''
    write '## Fuzzing' '' 'libFuzzer with the address and undefined-behaviour sanitizers and with checks between stages: any bytes as a deck and `--set`; changes of the' \
        'arrays, numbers and texts of a checkpoint past its seal, after which a step is made if it is taken. What is written of a deck that loads must' \
        'load again to the same text. Found so far in decks, mended, and among the quick tests since (`tests/fuzz/deck`): a material that no one knows beside `supports` and' \
        'a sharp interface, which became an index of -1; a surface of 1e19 points; bytes that are no text behind a `%`, from which libfyaml does not come back.' ''
    total fuzz
    write '## Sanitizers and valgrind' '' 'Address and undefined behaviour:' ''
    total sanitize
    write 'The same sanitizers of both compilers over every deck of `inputs/` in every coupling, the mistakes of `tests/mistakes`, and going on from a checkpoint' \
        '(`scripts/nightly.sh decks`, `tests/cli/same_verdict.sh`):' ''
    total decks
    write 'Threads, two of them, with what OpenMP orders known by libarcher:' ''
    total thread
    write 'Valgrind, invalid reads and writes, use of what is not set, definite leaks:' ''
    total valgrind
    write '## Lines that tests run' '' 'Of the `.c` files of each room, by the tests named:' ''
    total coverage
    write '## How' '' '    scripts/nightly.sh [killed|faults|combinations|metamorphic|meshes|fuzz|sanitize|decks|thread|valgrind|coverage]...' '    scripts/results.sh robustness' '' \
        '`FLOE_SECONDS` sets how long each fuzzer runs, `FLOE_TESTS` which tests the sanitizers, valgrind and coverage see; with `FLOE_CONTINUE=1` these' 'go on with the tests that have not passed.' '' 'Made with' ''
    "$floe" --version | sed 's/^/    /' >>"$page"
    write "    $(machine)"
}
