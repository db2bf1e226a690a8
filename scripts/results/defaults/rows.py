"""What the rows of the page `defaults` are measured with: runs of a deck in each coupling, tables and bars in Markdown.

A row is a module of this folder with a function `measure(page)`. It runs decks of inputs/defaults with defaults only, and
compares them with exact or published values. `python3 scripts/results/defaults/rows.py e4 e5` prints the named rows;
without names, all of them.
"""
import csv
import dataclasses
import importlib
import json
import math
import os
import pathlib
import resource
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
FLOE = pathlib.Path(os.environ.get("FLOE", ROOT / "build/release/floe")).resolve()
OUT = pathlib.Path(os.environ.get("FLOE_OUT", ROOT / "out/results/defaults")).resolve()


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


@dataclasses.dataclass
class Run:
    """One run of a deck: exit status, CPU seconds, what it printed, and its result folder."""
    status: int
    cpu: float
    text: str
    folder: pathlib.Path

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    def history(self):
        """Columns of history.csv by name without unit, as lists of numbers; those of words are NaN."""
        with open(self.folder / "history.csv", newline="") as file:
            rows = list(csv.reader(file))
        names = [name.split(" (")[0] for name in rows[0]]
        return {name: [number(row[k]) for row in rows[1:]] for k, name in enumerate(names)}

    def warnings(self):
        """Of the log, since a quiet run prints none; of what it printed where it made no log."""
        log = self.folder / "run.log"
        text = log.read_text() if log.exists() else self.text
        return [line for line in text.splitlines() if "warning" in line]


def run(deck, name, coupling=None, settings=(), threads=1):
    """Runs inputs/defaults/DECK.yaml into a folder of its own. `settings` are KEY=VALUE of the scene, never of the method."""
    folder = OUT / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    command = [str(FLOE), "run", str(ROOT / "inputs/defaults" / (deck + ".yaml")), "-o", str(folder), "--threads", str(threads), "--quiet"]
    if coupling:
        command += ["--coupling", coupling]
    for setting in settings:
        command += ["--set", setting]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return Run(done.returncode, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout, folder)


class Page:
    """Collects Markdown and bars."""

    def __init__(self):
        self.lines = []
        self.bars = []

    def write(self, *lines):
        self.lines += lines

    def table(self, head, rows):
        self.lines += ["", "| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
        self.lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
        self.lines.append("")

    def bar(self, what, measured, low, high, form="{:.4g}"):
        """A bar: `measured` lies within low..high (either may be None). NaN misses."""
        met = (low is None or measured >= low) and (high is None or measured <= high) and not math.isnan(measured)
        wanted = " to ".join(form.format(x) for x in (low, high) if x is not None)
        if low is None:
            wanted = "at most " + wanted
        elif high is None:
            wanted = "at least " + wanted
        self.bars.append((what, form.format(measured), wanted, "met" if met else "**missed**"))


def measured(names=()):
    """The page of the named rows, or of all."""
    sys.path.insert(0, str(HERE))
    page = Page()
    for name in names or sorted(path.stem for path in HERE.glob("[a-z][0-9]*.py") if "_" not in path.stem):  # e12_elements: a reference
        importlib.import_module(name).measure(page)
    if page.bars:
        page.write("", "## Bars")
        page.table(("what", "measured", "bar", ""), page.bars)
    return page


if __name__ == "__main__":
    # The rows import this file as a module; both names must mean one Page.
    sys.modules["rows"] = sys.modules["__main__"]
    print("\n".join(measured(sys.argv[1:]).lines))
