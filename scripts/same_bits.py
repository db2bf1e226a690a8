#!/usr/bin/env python3
"""same_bits.py: does a change of the sources change a bit of a result?

    scripts/same_bits.py keep DIR [DECK...]      runs decks for a few steps and keeps their histories and snapshots in DIR
    scripts/same_bits.py compare DIR [DECK...]   runs them again and names every deck with another bit, and by how much its fields differ

Decks are all of inputs, inputs/extreme and inputs/defaults, each in every coupling that it names; FLOE is the program (build/release/floe),
STEPS the steps of a run (40), which all together take about a minute. What is kept belongs to one machine and one compiler: keep before the change,
compare after it. Exit status 1 where a bit differs."""
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
FLOE = os.environ.get("FLOE", str(ROOT / "build/release/floe"))
STEPS = os.environ.get("STEPS", "40")
LONGEST = 60.0  # s: a run that takes longer is left out, and said so
SETS = ("inputs", "inputs/extreme", "inputs/defaults")


def all_decks():
    return [path for name in SETS for path in sorted((ROOT / name).glob("*.yaml"))]


def couplings(deck):
    found = re.search(r"^runs_as: \[(.*)\]", deck.read_text(encoding="utf-8"), re.MULTILINE)
    return [name.strip() for name in found.group(1).split(",")] if found else [""]


def run(deck, coupling, folder):
    """A line on what came of it; the folder holds history and snapshots alone."""
    command = [FLOE, "run", str(deck), "--set", f"time.max_steps={STEPS}", "-o", str(folder), "--quiet"]
    if coupling:
        command += ["--coupling", coupling]
    try:
        status = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=LONGEST, check=False,
                                env=dict(os.environ, OMP_NUM_THREADS="1")).returncode
    except subprocess.TimeoutExpired:
        shutil.rmtree(folder, ignore_errors=True)
        return "took too long"
    for path in folder.iterdir() if folder.exists() else ():
        if path.is_file() and path.name != "history.csv":
            path.unlink()
    return f"exit status {status}"


def values(folder):
    """Every column of the history and every data set of the snapshots, by name."""
    found = {}
    history = folder / "history.csv"
    if history.exists():
        with open(history, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        for k, name in enumerate(rows[0]):
            found[f"history.csv: {name}"] = np.array([row[k] for row in rows[1:] if k < len(row)])
    for path in sorted(folder.glob("fields/*.h5")):
        with h5py.File(path) as file:
            def note(name, item, of=path.name):
                if isinstance(item, h5py.Dataset) and name != "xdmf":
                    found[f"{of}: {name}"] = np.array(item[()])
            file.visititems(note)
    return found


def bits(array):
    return str(array.dtype), array.shape, array.tobytes()


def distance(a, b):
    """The largest difference over the largest value; infinite where that has no meaning."""
    try:
        a, b = a.astype(float), b.astype(float)
    except ValueError:
        return np.inf
    if a.shape != b.shape or not np.array_equal(np.isfinite(a), np.isfinite(b)):
        return np.inf
    of = np.isfinite(a)
    largest = np.max(np.abs(a[of]), initial=0.0)
    return np.max(np.abs(a[of] - b[of]), initial=0.0) / (largest if largest > 0.0 else 1.0)


def difference(old, new):
    """What differs most, as text; '' where all bits are the same."""
    a, b = values(old), values(new)
    only, both = sorted(a.keys() ^ b.keys()), sorted(a.keys() & b.keys())
    other = {name: distance(a[name], b[name]) for name in both if bits(a[name]) != bits(b[name])}
    said = ["in one of them alone: " + ", ".join(only[:3])] if only else []
    if other:
        worst = max(other, key=other.get)
        said.append(f"{len(other)} of {len(both)} columns and fields; most: {worst}, {other[worst]:.2g} of its largest value")
    return "; ".join(said)


def main():
    if len(sys.argv) < 3 or sys.argv[1] not in ("keep", "compare"):
        sys.exit(__doc__)
    kept = pathlib.Path(sys.argv[2]).resolve()
    decks = [pathlib.Path(name).resolve() for name in sys.argv[3:]] or all_decks()
    differ = runs = 0
    with tempfile.TemporaryDirectory() as work:
        for deck in decks:
            for coupling in couplings(deck):
                name = "-".join(filter(None, (deck.parent.name, deck.stem, coupling)))
                old, new = kept / name, pathlib.Path(work) / name
                if sys.argv[1] == "keep":
                    shutil.rmtree(old, ignore_errors=True)
                    end = run(deck, coupling, old)
                    old.mkdir(parents=True, exist_ok=True)
                    (old / "end").write_text(end)
                    if end != "exit status 0":
                        print(f"{name}: {end}")
                    runs += 1
                    continue
                if not old.exists():
                    print(f"{name}: nothing is kept of it")
                    continue
                was = (old / "end").read_text()
                end = run(deck, coupling, new)
                text = difference(old, new) if end == was else f"{end}, before {was}"
                shutil.rmtree(new, ignore_errors=True)
                runs += 1
                if text:
                    differ += 1
                    print(f"{name}: {text}")
    print(f"{runs} runs kept" if sys.argv[1] == "keep" else f"{differ} of {runs} runs differ")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
