"""The page of what survived."""
import os
import subprocess

import stamp
from mutation.draw import DRAWN, ROOT, entries, module_of
from mutation.tests import source_hash

SITES = """
Sites are the binary operators, `+=` and its kind, unary minus and `!`, numbers, and calls of `fmin`, `fmax`, `most`, `least` in the bodies of functions
and in the values of tables. A mutant takes one of: the neighbouring or the opposite comparison; `+` for `-`, or the second term dropped; `*` for `/`;
`&&` for `||`; the minimum for the maximum; a number 3 % larger or a sixth smaller (below 0.001, where numbers are tolerances and floors, a million times
larger; whole numbers one more or less; 1 for 0). Not sites: preprocessor lines; sizes of arrays in declarations and constants of enums, which are such
sizes or names of choices (one more changes no value); `{0}`, which is C's word for "all zero"; `++` and `--`, which step through loops. A mutant that does not compile is passed over for the next.

Which tests could see a mutant is found by a build in which each site notes whether its mutant's value has ever differed from its own: where it never
has, the run of that test would be the same to the bit. Those tests are run with the mutant in force, the cheapest first, each under a limit of three
times its CPU time, and the first that fails ends it. An index beyond an array of known size ends a run, too: the nightly tests with sanitizers see it.
Left out are `source_rules`, `cli_install` and `cli_widths`, and the nightly tests.
"""


def of_module(sites, module):
    return [s for s in sites if module_of(s.path) == module]


class Count:
    """Of some mutants: those run, killed, proved equivalent since, and alive."""

    def __init__(self, sites, known, proofs):
        self.drawn = len(sites)
        self.run = [s for s in sites if known[s.order]]
        survived = [s for s in self.run if known[s.order]["status"] == "survived"]
        self.equal = [s for s in survived if s.key() in proofs]
        self.alive = [s for s in survived if s.key() not in proofs]
        self.killed = len(self.run) - len(survived)
        self.first = sum(1 for s in self.run if known[s.order]["status"] == "killed" and known[s.order].get("unlooked", True))

    @property
    def share(self):
        return self.killed / max(1, self.killed + len(self.alive))

    def told_first(self):
        """What is seen by tests that were there, as they are, when it was drawn."""
        share = self.first / max(1, self.killed + len(self.alive))
        return f"**{self.first}**, {100.0 * share:.1f} % of those that are not equivalent"


def table_of_modules(draw, mutants, known, proofs):
    lines = ["| module | sites | drawn | run | killed | alive, or so far | equivalent |", "|---|---|---|---|---|---|---|"]
    for module in DRAWN:
        c = Count(of_module(mutants, module), known, proofs)
        lines.append(f"| {module} | {draw.total[module]} | {c.drawn} | {len(c.run)} | {c.killed} | {len(c.alive)} | {len(c.equal)} |")
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


def counts_of(s, known, tests):
    """How many tests have been run with a survivor, and how many could see it."""
    passed = set(known.get("passed", {}))
    could = {name for name, t in tests.items() if s.rebuild or s.key() in t["seen"] or s.key() not in t["asked"]}
    return len(passed), len(could | passed)


def alive_of(s, known, why, tests):
    ran, could = counts_of(s, known, tests)
    return (f"* {s.order}: `{s.path}`, line {s.line}: {change_of(s)} in `{s.source}`. {ran} of {could} tests. {why.get(s.key(), '')}").rstrip()


def lines_of(seed, draw, mutants, state, names):
    """The page without its title and its stamp, and the share that is killed."""
    known, proofs, why = {s.order: state.data["mutants"].get(s.key()) for s in mutants}, entries("equivalent.txt"), entries("survivors.txt")
    all_of, cpu = Count(mutants, known, proofs), state.data["cpu"]
    open_ones = [s for s in all_of.alive if len(set(counts_of(s, known[s.order], state.data["tests"]))) == 2]
    alive = [s for s in all_of.alive if s not in open_ones]
    lines = [f"Faults put into the sources one at a time, and whether the quick tests see them: `scripts/mutants.py --seed {seed} "
             f"--mutants {len(mutants)}`, then the same with `--page`.", "",
             f"* Drawn: {len(mutants)} by seed {seed}, {len(mutants) // len(DRAWN)} a module; run: **{len(all_of.run)}**; killed: **{all_of.killed}**; "
             f"proved equivalent afterwards: {len(all_of.equal)}; alive after all tests that could see them: **{len(alive)}**; "
             f"alive so far, with the longer tests still to be run: **{len(open_ones)}**.",
             f"* Killed by tests that were there when it was drawn, and have not changed since: {all_of.told_first()}.",
             f"* Killed, of those that are not equivalent: **{100.0 * all_of.share:.1f} %** at least; the bar is 95 %.",
             f"* Sources: commit {base_commit()}{', with changes after it' if base_commit() != head() else ''}. Hash of `src`, `tests` and `inputs` when they were run: {', '.join(sorted({k['commit'] for k in known.values() if k}))}.",
             f"* CPU time: {cpu['build'] / 60:.0f} min of building, {cpu['look'] / 60:.0f} min of looking which tests see which, {cpu['run'] / 60:.0f} min of running; "
             "a mutant that is run again is counted each time.",
             f"* {sum(1 for s in mutants if s.rebuild)} of them by rebuilding their file (what the compiler must know), the others by a switch in one build.", ""]
    lines += table_of_modules(draw, mutants, known, proofs)
    for title, sites in (("Alive", alive), ("Alive so far", open_ones)):
        lines += ["", "## " + title, ""] + ([alive_of(s, known[s.order], why, state.data["tests"]) for s in sites] or ["None."])
    not_run = [str(s.order) for s in mutants if not known[s.order]]
    lines += ["", f"Not run: {', '.join(not_run)}."] if not_run else []
    lines += ["", "## Equivalent", "", "The next draw leaves them out.", ""]
    lines += [f"* `{k}`: {proofs[k]}" for k in proofs] or ["None."]
    lines += ["", "## What is a site, and how it is run", "", SITES.strip(), "", "## All", ""] + table_of_all(mutants, known)
    return lines, all_of.share


def lines_of_fresh(seed, mutants, state):
    """Another draw: how many are killed that nobody looked for."""
    known, proofs, why = {s.order: state.data["mutants"].get(s.key()) for s in mutants}, entries("equivalent.txt"), entries("survivors.txt")
    c = Count(mutants, known, proofs)
    lines = ["", f"## Another draw, seed {seed}", "", f"What is seen of faults that nobody looked for: killed by tests that were there when it was drawn, and have not changed since: "
             f"{c.told_first()}. Drawn: {c.drawn}; run: {len(c.run)}; killed: **{c.killed}**; proved equivalent: {len(c.equal)}; alive so far: {len(c.alive)}. "
             f"Killed, of those that are not equivalent: **{100.0 * c.share:.1f} %** at least.", ""]
    return lines + [alive_of(s, known[s.order], why, state.data["tests"]) for s in c.alive]


def git(*words):
    return subprocess.run(("git", "-C", ROOT) + words, capture_output=True, text=True, check=False).stdout.strip()


def head():
    return git("rev-parse", "--short=12", "HEAD")


def base_commit():
    """The last commit that is on main too."""
    return git("rev-parse", "--short=12", git("merge-base", "HEAD", "main") or "HEAD")


def version():
    """As floe would say it that was built here."""
    changed = git("status", "--porcelain", "--", "src", "include", "cmake", "tests")
    return f"floe ({head()}{'-modified' if changed else ''})"


def write(seed, draw, mutants, state, names, fresh):
    """`fresh`: more draws, as (seed, mutants)."""
    lines, _ = lines_of(seed, draw, mutants, state, names)
    at = lines.index("## Equivalent") - 1
    lines[at:at] = [line for other, drawn in fresh for line in lines_of_fresh(other, drawn, state)]
    text = ["# Mutants: faults that the quick tests see, and those that they do not", "", "*Written by `scripts/mutants.py --page`; do not edit.*", ""]
    text += lines + ["", stamp.line("mutants", set(), "", version(), ("tests",))]
    with open(os.path.join(ROOT, "docs/results/mutants.md"), "w", encoding="utf-8") as f:
        f.write("\n".join(text) + "\n")
