#!/usr/bin/env python3
"""mutants.py: what do the quick tests not see? Faults are put into the sources one at a time, drawn by a seed from every operator and constant of
src/mpm, src/ice, src/coupling and src/study in equal shares, and the quick tests that could see one are run until the first fails.

    scripts/mutants.py [--seed S] [--mutants N] [--first K]   builds and runs; goes on where it was stopped
    scripts/mutants.py --again                                what has survived once more (with new tests, say)
    scripts/mutants.py --list                                 the draw, and what is known of each
    scripts/mutants.py --only N                               number N of the draw alone, with what its tests say
    scripts/mutants.py --page [--fresh S N]                   docs/results/mutants.md from what is known, with N mutants of another seed
Equivalent mutants are in scripts/lib/mutation/equivalent.txt, each with its proof; why others may live in survivors.txt beside it."""
import argparse
import os
import shutil
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scripts", "lib"))
sys.dont_write_bytecode = True
from mutation import page  # noqa: E402
from mutation.draw import plan, module_of  # noqa: E402
from mutation.tests import Runner, State, build, candidates, look, marks_of_draw, source_hash, try_mutant  # noqa: E402


def show(mutants, state):
    for s in mutants:
        known = state.data["mutants"].get(s.key(), {"status": "not run", "by": ""})
        print(f"{s.order:4d} {known['status']:9s} {s.path}:{s.line}: `{s.token}` -> `{s.changed}`{' (rebuilt)' if s.rebuild else ''}: "
              f"{s.source[:110]}   {known['by']}")


def in_order(state, runner, mutants, arguments):
    """By the seed; with --most those first whose next tests are the cheapest."""
    def cost(s):
        passed = state.data["mutants"].get(s.key(), {}).get("passed", {})
        left = [n for n in candidates(state, runner, s, None, arguments.longest) if n not in passed]
        return state.data["tests"][left[0]]["cpu"] if left else 0.0
    return sorted(mutants, key=cost) if arguments.again and arguments.most < 10**6 else mutants


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=18)
    parser.add_argument("--mutants", type=int, default=200)
    parser.add_argument("--first", type=int)
    parser.add_argument("--hours", type=float, default=8.0, help="CPU hours, all together")
    parser.add_argument("--longest", type=float, default=1e9, help="seconds: leave longer tests for a later call (--again runs what is new)")
    parser.add_argument("--most", type=int, default=10**6, help="tests of one mutant in this call; --again goes on with the rest")
    parser.add_argument("--module", help="mutants of this module alone")
    parser.add_argument("--no-look", action="store_true", help="what is new is asked of the tests of its own part alone")
    parser.add_argument("--folder", default=os.path.join(ROOT, "build", "mutants"))
    for flag in ("again", "list", "page", "no-build"):
        parser.add_argument("--" + flag, action="store_true")
    parser.add_argument("--only", type=int, action="append")
    parser.add_argument("--fresh", type=int, nargs=2, action="append", default=[], metavar=("SEED", "MUTANTS"), help="another draw on the page")
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    os.environ.setdefault("CMAKE_C_COMPILER_LAUNCHER", "ccache" if shutil.which("ccache") else "")
    state = State(arguments.folder)
    names, draw, mutants, trees = plan(arguments.seed, arguments.mutants, arguments.folder, state)
    if arguments.list:
        return show(mutants, state)
    if arguments.page:
        fresh = [(seed, plan(seed, count, arguments.folder, state)[2]) for seed, count in arguments.fresh]
        return page.write(arguments.seed, draw, mutants, state, names, fresh)
    print(f"seed {arguments.seed}: {len(mutants)} mutants of {sum(draw.total.values())} sites", flush=True)
    if not arguments.no_build:
        build(names, draw, mutants, {k: tree for k, tree in trees.items() if k == "switch" or not arguments.no_look}, state)
    if not arguments.no_look:
        look(state, trees["note"], mutants, arguments.longest)
    runner = Runner(trees["switch"])
    commit, marks = state.data.get("built") or source_hash(names), marks_of_draw(state, runner, arguments.seed)
    started = time.monotonic()
    for s in in_order(state, runner, mutants[:arguments.first], arguments):
        known = state.data["mutants"].get(s.key())
        wanted = not known or (arguments.again and known["status"] == "survived")
        if arguments.module and module_of(s.path) != arguments.module:
            continue
        if arguments.only:
            wanted = s.order in arguments.only
        if not wanted:
            continue
        if sum(state.data["cpu"].values()) > 3600.0 * arguments.hours:
            print("the CPU hours are spent", flush=True)
            break
        r = try_mutant(state, runner, s, commit, marks, arguments.longest, arguments.most)
        print(f"{s.order:4d} {r['status']} {s.path}:{s.line} `{s.token}` -> `{s.changed}` {r['by']} {r['said']} ({r['ran']} tests, {r['cpu']:.1f} s)",
              flush=True)
    print(f"{time.monotonic() - started:.0f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
