#!/usr/bin/env python3
"""before_after.py OLD_TREE [NEW_TREE]: every deck of inputs/ as each coupling, by the program and the decks of two source trees.

Prints a page in Markdown: status, the error whose ratio after to before is largest, and wall seconds of single runs (two at a
time, so only ratios beyond 1.5 mean anything). A tree is built by `scripts/build.sh release floe`.
"""
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys
import tempfile

LIMIT = "25"  # wall seconds of a run; what takes longer is left out and named


def couplings(deck):
    named = re.search(r"^runs_as: *\[([^\]]*)\]", deck.read_text(), re.MULTILINE)
    return [name.strip() for name in named.group(1).split(",")] if named else [None]


def run(tree, deck, coupling, folder):
    command = [str(tree / "build/release/floe"), "run", str(tree / "inputs" / deck), "-o", str(folder), "--threads", "1", "--quiet",
               "--max-wall", LIMIT] + (["--coupling", coupling] if coupling else [])
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    summary = folder / "summary.json"
    return json.loads(summary.read_text()) if summary.exists() else {"status": f"exit {done.returncode}", "errors": {}, "wall_seconds": 0}


def row(trees, deck, coupling, folder):
    before = run(trees[0], deck, coupling, folder / "before")
    after = run(trees[1], deck, coupling, folder / "after") if before["status"] != "interrupted" else before
    pairs = [(after["errors"][name] / value, name, value, after["errors"][name]) for name, value in before["errors"].items()
             if isinstance(value, (int, float)) and isinstance(after["errors"].get(name), (int, float)) and value > 1e-9]
    worst = max(pairs, default=None)
    errors = f"{worst[1]} {worst[2]:.3g} to {worst[3]:.3g}" if worst else "-"
    mark = "**worse**" if worst and not worst[0] <= 1.1 else ""
    status = before["status"] if before["status"] == after["status"] else f"{before['status']} to {after['status']}"
    return f"| {deck[:-5]} | {coupling or '-'} | {status} | {errors} | {mark} | {before['wall_seconds']:.2f} | {after['wall_seconds']:.2f} |"


def main():
    trees = [pathlib.Path(name).resolve() for name in (sys.argv[1:] + ["."])[:2]]
    jobs = [(deck.name, name) for deck in sorted((trees[0] / "inputs").glob("*.yaml")) for name in couplings(deck)]
    print("# Every deck before and after the new defaults\n\n*Written by `scripts/results/before_after.py OLD_TREE`; do not edit.*\n")
    for tree, word in zip(trees, ("Before", "After")):
        version = subprocess.run([str(tree / "build/release/floe"), "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
        print(f"{word}: {version.splitlines()[0]}\n")
    print("Of the errors that a deck measures, the one whose ratio is largest; a mark where it has grown by more than a tenth.\n")
    print("| deck | coupling | status | largest ratio of an error | | wall before, s | wall after, s |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as place, concurrent.futures.ThreadPoolExecutor(2) as pool:
        work = [pool.submit(row, trees, deck, name, pathlib.Path(place) / f"{deck}-{name}") for deck, name in jobs]
        for one in work:
            print(one.result(), flush=True)


if __name__ == "__main__":
    main()
