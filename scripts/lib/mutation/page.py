"""The page of what survived."""
import os
import subprocess

import stamp
from mutation.draw import ROOMS, ROOT, entries
from mutation.tests import source_hash

SITES = """
Sites are the binary operators, `+=` and its kind, unary minus and `!`, numbers, and calls of `fmin`, `fmax`, `most`, `least` in the bodies of functions
and in the values of tables. A mutant takes one of: the neighbouring or the opposite comparison; `+` for `-`, or the second term dropped; `*` for `/`;
`&&` for `||`; the minimum for the maximum; a number 3 % larger or a sixth smaller (below 0.001, where numbers are tolerances and floors, a million times
larger; whole numbers one more or less; 1 for 0). Not sites: preprocessor lines; sizes of arrays in declarations and constants of enums, which are such
sizes or names of choices (one more changes no value); `{0}`, which is C's word for "all zero"; `++` and `--`, which step through loops. A mutant that does not compile is passed over for the next.

Which tests could see a mutant is found by a build in which each site notes whether its mutant's value has ever differed from its own: where it never
has, the run of that test would be the same to the bit. Those tests are run with the mutant in force, the cheapest first, each under a limit of three
times its CPU time, and the first that fails ends it. Left out are `source_rules`, `cli_install` and `cli_widths`, and the nightly tests.
"""


def of_room(sites, room):
    return [s for s in sites if s.path.startswith(f"src/{room}/")]


def table_of_rooms(draw, mutants, run, live):
    lines = ["| room | sites | drawn | run | killed | alive | proved equivalent |", "|---|---|---|---|---|---|---|"]
    for room in ROOMS:
        counts = [len(of_room(sites, room)) for sites in (mutants, run, live)]
        proved = sum(1 for k in draw.excluded_used if k.startswith(f"src/{room}/"))
        lines.append(f"| {room} | {draw.total[room]} | {counts[0]} | {counts[1]} | {counts[1] - counts[2]} | {counts[2]} | {proved} |")
    return lines


def change_of(s):
    return f"`{s.token}` -> `{s.changed}`".replace("|", "\\|")


def table_of_all(mutants, known):
    lines = ["| n | where | mutant | seen by |", "|---|---|---|---|"]
    for s in mutants:
        k = known[s.order]
        by = "not run" if not k else k["by"] if k["status"] == "killed" else "**nothing**"
        lines.append(f"| {s.order} | {s.path}:{s.line} | {change_of(s)} | {by} |")
    return lines


def alive_of(s, known, why):
    never = "No quick test gives it another value. " if known["ran"] == 0 else ""
    return f"* {s.order}: `{s.path}`, line {s.line}: {change_of(s)} in `{s.source}`. {never}{why.get(s.key(), '')}"


def lines_of(seed, draw, mutants, state, names):
    """The page without its title and its stamp, and the share that is killed."""
    known = {s.order: state.data["mutants"].get(s.key()) for s in mutants}
    run = [s for s in mutants if known[s.order]]
    live = [s for s in run if known[s.order]["status"] == "survived"]
    killed, cpu = len(run) - len(live), state.data["cpu"]
    share = killed / max(1, len(run))
    lines = [f"Faults put into the sources one at a time, and whether the quick tests see them: `scripts/mutants.py --seed {seed} "
             f"--mutants {len(mutants)}`, then `scripts/mutants.py --seed {seed} --mutants {len(mutants)} --page`.", "",
             f"* Drawn: {len(mutants)} by seed {seed}, {len(mutants) // len(ROOMS)} a room; run: **{len(run)}**; killed: **{killed}**, {100.0 * share:.1f} %; "
             f"alive: **{len(live)}**.",
             f"* Hash of `src`, `tests` and `inputs` at the last run: {', '.join(sorted({k['commit'] for k in known.values() if k}))}"
             f"; now: {source_hash(names)}.",
             f"* CPU time: {cpu['build'] / 60:.0f} min of building, {cpu['look'] / 60:.0f} min of looking which tests see which, {cpu['run'] / 60:.0f} min of running; "
             "a mutant that is run again is counted each time.",
             f"* {sum(1 for s in mutants if s.rebuild)} of them by rebuilding their file (what the compiler must know), the others by a switch in one build.", ""]
    lines += table_of_rooms(draw, mutants, run, live)
    why = entries("survivors.txt")
    lines += ["", "## Alive", ""] + ([alive_of(s, known[s.order], why) for s in live] or ["None."])
    not_run = [str(s.order) for s in mutants if not known[s.order]]
    lines += ["", f"Not run: {', '.join(not_run)}."] if not_run else []
    lines += ["", "## What is a site, and how it is run", "", SITES.strip(), "", "## Proved equivalent, and so not drawn", ""]
    proofs = entries("equivalent.txt")
    lines += [f"* `{k}`: {proofs[k]}" for k in draw.excluded_used] or ["None."]
    lines += ["", "## All", ""] + table_of_all(mutants, known)
    return lines, share


def version():
    """As floe would say it that was built here."""
    def git(*words):
        return subprocess.run(("git", "-C", ROOT) + words, capture_output=True, text=True, check=True).stdout.strip()
    changed = git("status", "--porcelain", "--", "src", "include", "cmake", "tests")
    return f"floe ({git('rev-parse', '--short=12', 'HEAD')}{'-modified' if changed else ''})"


def write(seed, draw, mutants, state, names):
    lines, _ = lines_of(seed, draw, mutants, state, names)
    text = ["# Mutants: faults that the quick tests see, and those that they do not", "", "*Written by `scripts/mutants.py --page`; do not edit.*", ""]
    text += lines + ["", stamp.line("mutants", set(), "", version(), ("tests",))]
    with open(os.path.join(ROOT, "docs/results/mutants.md"), "w", encoding="utf-8") as f:
        f.write("\n".join(text) + "\n")
