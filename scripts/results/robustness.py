"""Kills, faults, bad input, sanitizers, coverage: the totals of scripts/nightly.sh."""
import math
import re
import subprocess

from places import ROOT

TITLE = "What cannot be: kills, faults, bad input"
NIGHTLY = ROOT / "out/nightly"
PARTS = ("killed", "faults", "combinations", "metamorphic", "meshes", "fuzz", "sanitize", "decks", "thread", "valgrind", "coverage")


def said(part):
    """What scripts/nightly.sh PART has said; "" where it has not been run."""
    path = NIGHTLY / f"{part}.txt"
    return path.read_text(encoding="utf-8") if path.exists() else ""


def total(page, *parts):
    """Totals of these parts as blocks."""
    for part in parts:
        page.write("", *("    " + line for line in (said(part).splitlines() or [f"not run: scripts/nightly.sh {part}"])), "")


def found(part, pattern):
    """The number of the pattern's group; NaN without it, which misses any bar."""
    match = re.search(pattern, said(part), re.MULTILINE)
    return float(match.group(1)) if match else math.nan


def counted(part, what):
    """The sum of the numbers before these words; NaN where the part has not been run or does not have them."""
    numbers = [float(number) for number in re.findall(rf"(\d+) {what}", said(part))]
    return sum(numbers) if numbers else math.nan


def least_covered():
    shares = [float(share) for share in re.findall(r"^(?:mpm|ice|coupling) +([0-9.]+) %", said("coverage"), re.MULTILINE)]
    return min(shares) if len(shares) == 3 else math.nan


def bars(page):
    for what, value, relation, limit in (
            ("kills by SIGKILL of five scenes, all resumed to the bits of the undisturbed run", found("killed", r"^kills: (\d+) "), ">=", 250),
            ("kills while a checkpoint was being written", found("killed", r" (\d+) while a checkpoint"), ">=", 50),
            ("decks spoiled in one key that were not refused at their place", counted("faults", "not refused"), "<=", 0),
            ("allocations of whole runs that were made to fail", counted("faults", "faults up to"), ">=", 1000),
            ("writes, syncs and renames of whole runs that were made to fail", counted("faults", "faults of calls"), ">=", 300),
            ("changes of the decks that must change nothing: runs that differ without a reason", counted("metamorphic", "wrong"), "<=", 0),
            ("stages after which a step was rejected", counted("faults", "stages"), ">=", 200)):
        page.bar(what, value, relation, limit, "{:.0f}")
    for part, what in (("sanitize", "the address and undefined-behaviour sanitizers"), ("thread", "the thread sanitizer"), ("valgrind", "valgrind")):
        tests = re.findall(r"^(\d+) of (\d+) tests passed, (\d+) failed", said(part), re.MULTILINE)
        passed, of_all, failed = map(float, tests[-1]) if tests else 3 * (math.nan,)
        page.bar(f"tests with findings of {what}", failed, "<=", 0, "{:.0f}")
        page.bar(f"tests that have passed under {what}" + (f", of {of_all:.0f}" if tests else ""), passed, ">=", of_all, "{:.0f}")
    page.bar("lines of the modules mpm, ice and coupling that tests run, least of the three (%)", least_covered(), ">=", 90, "{:.1f}")


def make(page):
    page.also += ["tests", "scripts/nightly.sh"]
    page.commands += [["scripts/nightly.sh", part] for part in PARTS]
    for part in ("killed", "faults", "metamorphic"):
        if not said(part):
            subprocess.run([str(ROOT / "scripts/nightly.sh"), part], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False, cwd=ROOT)
    bars(page)
    page.write("Totals of `scripts/nightly.sh`, on this machine, until now; the quick tests take a sample of each. What a part finds makes it fail; what has not been run misses its bar.", "", "## Bars")
    page.show_bars()
    page.write("## Kills", "", "Five scenes (points; points in gas on cells; a membrane that holds gas; a reaction with the implicit pressure; bodies in contact), killed at random",
               "moments, every second time while a checkpoint was half written, and resumed from what was left (`tests/cli/killed.sh`). Every byte of the header of",
               "a checkpoint and a thousand bytes of its body are changed one at a time in `tests/unit/test_io_checkpoint.c`: each is refused, in words.")
    total(page, "killed")
    page.write("## Faults", "", "Whole runs in which one allocation and all after it fail; in which one write, sync or rename fails, for good (the disk is full) or once; what is left",
               "is whole, and a run goes on from it to the bits of an undisturbed one (`tests/fault/test_run_faults.c`). Steps rejected after each of their stages",
               "(`tests/fault/test_sim_reject.c`). Decks in which one key is wrong, made from the tables of the schema (`tests/unit/test_deck_keys.c`).")
    total(page, "faults")
    page.write("Decks of `inputs` with one to three keys set at random, two steps of each (`tests/cli/combinations.sh`):")
    total(page, "combinations")
    page.write("## The same scene in other words", "",
               "Every deck of `inputs/`, on a coarse mesh and for some steps. In other units, lengths, masses, times and temperatures by powers of two, with",
               "every basis, transfer, limiter, solver and contact that it bears, to the same bits (`tests/verification/test_sim_units.c`, 60 steps, two sets of units). Mirrored,",
               "its axes exchanged, moved by whole cells, its bodies or its materials in another order, a body told as two, with a fluid of which there is nothing, as a slab of one",
               "cell in space, to round-off (`tests/verification/test_sim_symmetry.c`, 20 steps; a new deck is asked as well). What differs has its reason in the test:")
    total(page, "metamorphic")
    page.write("Found so, and mended: on cells that are no squares the bulk viscosity and the shock sensor took the length V^(1/d), too much along the finer axis: a tube",
               "of cells 1 x 8 had 23 % less kinetic energy than one of a single row (now the same to round-off; the error of the tube of Sod was 52 % larger, now the same), and in slabs of one cell the density was off by 6 % after 20 steps where the depth was 16 times the side, and no step was right where it was a million times; the state of a fluid given by",
               "pressure and density was searched from 300 K, and a cell without a guess at its pressure from 1e5 Pa; a reference and an exact solution knew a unit.", "",
               "## Fuzzing", "", "libFuzzer with the address and undefined-behaviour sanitizers and with checks between stages: any bytes as a deck and `--set`; changes of the",
               "arrays, numbers and texts of a checkpoint past its seal, after which a step is made if it is taken. What is written of a deck that loads must",
               "load again to the same text. Found so far in decks, mended, and among the quick tests since (`tests/fuzz/deck`): a material that no one knows beside `supports` and",
               "a sharp interface, which became an index of -1; a surface of 1e19 points; bytes that are no text behind a `%`, from which libfyaml does not come back.")
    total(page, "fuzz")
    page.write("## Sanitizers and valgrind", "", "Address and undefined behaviour:")
    total(page, "sanitize")
    page.write("The same sanitizers of both compilers over every deck of `inputs/` in every coupling, the mistakes of `tests/mistakes`, and going on from a checkpoint",
               "(`scripts/nightly.sh decks`, `tests/cli/same_verdict.sh`):")
    total(page, "decks")
    page.write("Threads, two of them, with what OpenMP orders known by libarcher:")
    total(page, "thread")
    page.write("Valgrind, invalid reads and writes, use of what is not set, definite leaks:")
    total(page, "valgrind")
    page.write("## Finer meshes", "", "Tests of the solvers on finer meshes than every day's:")
    total(page, "meshes")
    page.write("## Lines that tests run", "", "Of the `.c` files of each module, by the tests named:")
    total(page, "coverage")
    page.write("`scripts/nightly.sh` makes the totals. `FLOE_SECONDS` sets how long each fuzzer runs, `FLOE_TESTS` which tests the sanitizers,",
               "valgrind and coverage see; with `FLOE_CONTINUE=1` these go on with the tests that have not passed.")
