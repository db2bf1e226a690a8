#!/usr/bin/env python3
"""The pages of docs/results, and what they are made with.

    scripts/results.sh [NAME...]           makes pages, each by scripts/results/NAME.py, which has a TITLE and a function make(page); without a name all, in some hours
    scripts/results.sh list                says which there are
    scripts/results.sh stale [--strict]    lists those that no longer agree with sources, decks and scripts; with --strict it fails if there is any
    scripts/results.sh index               writes the index, docs/results/README.md, which lists every bar, met or missed

FLOE is the program, build/release/floe.

A page runs decks by `page.run`, one at a time, each on one thread. Every case is measured: processor time of its steps, wall time, and how
much the rest of the machine was used meanwhile. A case of less than 50 ms is run again until 0.5 s of processor time are spent.
"""
import csv
import dataclasses
import fcntl
import importlib
import math
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys
import time
import traceback

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scripts/lib"), str(ROOT / "scripts/results")]
sys.path.append(str(ROOT / "scripts/results/defaults"))

import floe  # noqa: E402
import pages_index  # noqa: E402
import stamp  # noqa: E402

FLOE = pathlib.Path(os.environ.get("FLOE", ROOT / "build/release/floe")).resolve()
RESULTS = ROOT / "docs/results"
SHORT, SPENT = 0.05, 0.5          # s: a case of less processor time than SHORT is repeated until SPENT
OFTEN, FEW, SOME = 2.0, 10.0, 60.0  # s: below OFTEN a case is run three times at least, below FEW twice
MOST_REPEATS = 50
OTHERS, SWITCHES = 0.1, 100.0     # beyond so many cores of others, or involuntary switches a second, a time is disturbed


def machine_busy():
    """Processor seconds that everything on the machine has used; NaN where the system does not tell (/proc/stat is Linux's)."""
    try:
        with open("/proc/stat", encoding="ascii") as file:
            ticks = [int(word) for word in file.readline().split()[1:9]]
    except (OSError, ValueError):
        return math.nan
    return (sum(ticks) - ticks[3] - ticks[4]) / os.sysconf("SC_CLK_TCK")


@dataclasses.dataclass
class Measure:
    """What a command took."""
    cpu: float       # s of processor time, of the command and its children
    wall: float      # s
    others: float    # cores that others used meanwhile; NaN: unknown
    switches: float  # involuntary context switches a second

    @property
    def disturbed(self):
        return self.others > OTHERS or self.switches > SWITCHES


def measured(command, **options):
    """Runs a command: subprocess's result, and its Measure."""
    busy, wall, before = machine_busy(), time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, **{"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "check": False, **options})
    after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), max(time.monotonic() - wall, 1e-9)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    others = max(0.0, machine_busy() - busy - cpu) / wall
    return done, Measure(cpu, wall, others, (after.ru_nivcsw - before.ru_nivcsw) / wall)


@dataclasses.dataclass
class Run:
    """One case: how its run ended, and what the fastest of its repeats took."""
    status: int               # exit status
    text: str                 # what it printed
    folder: pathlib.Path
    cpu: float = math.nan     # s: processor time of the steps, without outputs
    wall: float = math.nan    # s: wall time of the same
    scatter: float = math.nan  # (median - least)/least of the repeats' processor times; NaN of a single run
    repeats: int = 1
    others: float = math.nan  # cores that others used while it ran
    switches: float = 0.0     # involuntary context switches a second

    @property
    def result(self):
        return floe.Result(self.folder)

    @property
    def disturbed(self):
        return self.others > OTHERS or self.switches > SWITCHES

    def error(self, metric):
        """An error of the deck's verify section; NaN if the run has none."""
        value = self.result.summary["errors"].get(metric) if self.status == 0 else None
        return math.nan if value is None else value


def enough(cpu, spent, repeats):
    """Whether a case has been run often enough."""
    if repeats >= MOST_REPEATS or cpu > SOME:
        return True
    if cpu < SHORT:
        return spent >= SPENT
    return repeats >= (3 if cpu < OFTEN else 2 if cpu < FEW else 1)


def word_of(text):
    return f"'{text}'" if re.search(r"[][*?{};\s]", text) else text


def merged(commands):
    """Commands that differ in few words as one, with their values in braces, as a shell would take them."""
    out = []
    for words in commands:
        last = out[-1] if out else None
        if last and len(last) == len(words):
            differ = [k for k in range(len(words)) if words[k] not in last[k]]
            ways = [k for k in range(len(words)) if len(last[k]) > 1 or k in differ]
            if len(ways) == 1 and words[ways[0]].split("=")[0] == last[ways[0]][0].split("=")[0] and "=" in words[ways[0]]:
                last[ways[0]].append(words[ways[0]]) if differ else None
                continue
        out.append([[word] for word in words])
    lines = []
    for words in out:
        parts = []
        for values in words:
            if len(values) == 1:
                parts.append(word_of(values[0]))
            else:
                key = values[0].rpartition("=")[0]
                parts.append(word_of(key) + "={" + ",".join(word_of(value[len(key) + 1:]) for value in values) + "}")
        lines.append(" ".join(parts))
    return lines


def program_version():
    return subprocess.run([str(FLOE), "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout


class Page:
    """A page of docs/results while it is made: its Markdown, its bars, the commands that it has run."""

    def __init__(self, name, title):
        self.name, self.title = name, title
        self.runs = ROOT / "out/results" / name
        self.lines, self.bars, self.commands, self.measures, self.also = [], [], [], [], []
        self.couplings, self.said = set(), ""
        self.beside = False  # whether the page shows its commands where it shows what they have made
        self.kept = False    # whether something on it is of an earlier making: the page then keeps its earlier stamp
        self.version = program_version()
        self.runs.mkdir(parents=True, exist_ok=True)
        for old in RESULTS.glob(f"{name}-*"):
            if old.suffix in (".svg", ".csv"):
                old.unlink()

    # -- text

    def write(self, *lines):
        self.lines += lines

    def table(self, header, rows):
        self.lines += ["", *floe.markdown(header, rows), ""]

    def picture(self, name, text):
        """The path of a plot of the page, which the page shows from here on."""
        self.lines += ["", f"![{text}]({self.name}-{name}.svg)", ""]
        return RESULTS / f"{self.name}-{name}.svg"

    def bar(self, what, measured_value, relation, limit, form="{:.3g}", unit=""):
        """A bar, set before anything was measured: `relation` is "<=" or ">=". What is no number misses it."""
        met = measured_value <= limit if relation == "<=" else measured_value >= limit
        self.bars.append((what, form.format(measured_value) + unit, f"{relation} {limit:g}{unit}", "met" if met else "missed"))
        if not met:
            print(f"  missed: {what}: {form.format(measured_value)}{unit} instead of {relation} {limit:g}{unit}", file=sys.stderr)

    def show_bars(self):
        self.table(("what", "measured", "bar", ""), [(a, b, c, d if d == "met" else "**missed**") for a, b, c, d in self.bars])

    # -- runs

    def note(self, words):
        self.commands.append(["floe"] + [str(word) for word in words])
        print("  " + " ".join(self.commands[-1]), file=sys.stderr, flush=True)

    def run(self, deck, folder, coupling=None, settings=(), once=False, more=()):
        """`floe run` of a deck (its path from the root), measured; `settings` are KEY=VALUE. `once`: its time is of no interest, nor whether others have disturbed it."""
        words = ["run", deck] + (["--coupling", coupling] if coupling else []) + [part for one in settings for part in ("--set", one)] + list(more)
        self.note(words)
        place = self.runs / folder
        command = [str(FLOE), *words, "-o", str(place), "--threads", "1", "--quiet"]
        runs, steps = [], []
        while not runs or (runs[-1][0].returncode == 0 and not once and not enough(min(steps), sum(one[1].cpu for one in runs), len(runs))):
            shutil.rmtree(place, ignore_errors=True)
            place.parent.mkdir(parents=True, exist_ok=True)
            runs.append(measured(command, cwd=ROOT))
            if runs[-1][0].returncode < 0:
                raise RuntimeError(f"{' '.join(words)}: ended by signal {-runs[-1][0].returncode}")
            if runs[-1][0].returncode != 0:
                break
            summary = floe.Result(place).summary
            steps.append(summary["cpu_seconds"])
            if len(steps) > 1 and summary["errors"] != errors:
                raise RuntimeError(f"{' '.join(words)}: another result when run again")
            errors = summary["errors"]
            self.couplings.add(summary["coupling"])
        done, wall = runs[-1][0], sum(one[1].wall for one in runs)
        case = Run(done.returncode, done.stdout, place, repeats=len(runs), others=sum(one[1].others * one[1].wall for one in runs) / wall,
                   switches=sum(one[1].switches * one[1].wall for one in runs) / wall)
        if done.returncode == 0:
            case.cpu = min(steps)
            case.scatter = statistics.median(steps) / case.cpu - 1 if len(steps) > 1 and case.cpu > 0 else math.nan
            case.wall = summary["wall_seconds"] - summary["output_seconds"]
        else:
            print(f"    exit status {done.returncode}: {done.stdout.strip()[-300:]}", file=sys.stderr)
        if not once:
            self.measures.append(case)
        return case

    def cases(self, command, folder, *words, kept=False):
        """`floe study` or `floe compare`: the table of its cases. What it has said is in `page.said`, without the line that names the folder. `kept`: goes on
        with what lies there."""
        self.note([command, *words])
        place = self.runs / folder
        if not kept:
            shutil.rmtree(place, ignore_errors=True)
        done, _ = measured([str(FLOE), command, *map(str, words), "-o", str(place), "--threads", "1"], cwd=ROOT, stderr=subprocess.PIPE)
        if done.returncode not in (0, 6):
            raise RuntimeError(f"floe {command} {' '.join(map(str, words))}: exit status {done.returncode}: {done.stderr[-2000:]}")
        self.said = "\n".join(line for line in done.stdout.splitlines() if not line.startswith("results: "))
        found = floe.Cases(place)
        self.couplings |= set(found.texts("coupling"))
        return found

    def limits(self, folder, *words):
        """`floe stability`: the rows of its limits.csv, as {column: text}."""
        self.note(["stability", *words])
        place = self.runs / folder
        shutil.rmtree(place, ignore_errors=True)
        done, _ = measured([str(FLOE), "stability", *map(str, words), "-o", str(place), "--threads", "1"], cwd=ROOT)
        if done.returncode != 0:
            raise RuntimeError(f"floe stability {' '.join(map(str, words))}: exit status {done.returncode}: {done.stdout[-2000:]}")
        self.couplings |= stamp.couplings_under(place)
        with open(place / "limits.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def gather(self):
        """Takes note of the couplings of all runs in the page's folder, whoever has made them."""
        self.couplings |= stamp.couplings_under(self.runs)

    def drawn(self, run, name, text, *words, said=True):
        """`floe picture` of a run, as NAME.png beside the page, which shows it from here on (`said`: the command is among those of the page)."""
        if said:
            self.note(["picture", *words])
        else:
            self.commands.append(["floe", "picture"])
        done, _ = measured([str(FLOE), "picture", str(run.folder), *map(str, words), "-o", str(RESULTS / f"{name}.png")], cwd=ROOT)
        if done.returncode != 0:
            raise RuntimeError(f"floe picture {run.folder}: exit status {done.returncode}: {done.stdout[-2000:]}")
        self.lines += ["", f"![{text}]({name}.png)", ""]

    def data(self, name, path):
        """Copies a file of numbers beside the page."""
        shutil.copyfile(path, RESULTS / f"{self.name}-{name}.csv")

    def test(self, name, source, folder="tests"):
        """What a test program of the build prints (of bench/: a benchmark); the page then hangs on its source too."""
        self.commands.append([f"build/release/{folder}/{name}"])
        self.also.append(source)
        done, _ = measured([str(FLOE.parent / folder / name)], cwd=ROOT)
        if done.returncode != 0:
            raise RuntimeError(f"{name}: exit status {done.returncode}: {done.stdout[-2000:]}")
        return done.stdout

    # -- the end

    def disturbance(self):
        """In words: how many times of the page others have disturbed."""
        disturbed = [one for one in self.measures if one.disturbed]
        if not disturbed:
            return f"None of {len(self.measures)} times was disturbed: others used at most {OTHERS:g} of a core."
        return (f"{len(disturbed)} of {len(self.measures)} times were disturbed, marked *: others used {max(one.others for one in self.measures):.1f} cores at most, "
                f"with up to {max(one.switches for one in self.measures):.0f} involuntary switches a second. Processor times bear that better than wall times; errors do not feel it.")

    def earlier_stamp(self):
        """The last line of the page as it lies there; "" where it has no stamp."""
        path = RESULTS / f"{self.name}.md"
        last = path.read_text(encoding="utf-8").rstrip().splitlines()[-1] if path.is_file() else ""
        return last if stamp.STAMP.match(last) else ""

    def finish(self):
        version = program_version()
        if version != self.version:
            raise RuntimeError("the program was built again while the page was made")
        model = re.search(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="ascii"), re.MULTILINE)
        lines = [f"# {self.title}", "", f"*Written by `scripts/results.sh {self.name}`; do not edit.*", "", *self.lines, "", "## How", ""]
        named = re.sub(r" \([0-9a-f]+\)", "", version)  # a commit may vanish, and the stamp names the sources
        if self.beside:
            lines += ["Each run has one thread; the commands stand above, with `build/release/floe` as `floe`."]
        else:
            lines += ["Each run has one thread. The commands, with `build/release/floe` as `floe`:", "", *("    " + command for command in merged(self.commands))]
        lines += ["", "Made with", "", *["    " + line for line in named.splitlines()],
                  f"    {model.group(1) if model else os.uname().machine}, {os.cpu_count()} cores"]
        if self.measures:
            lines += ["", self.disturbance()]
        text = "\n".join("    " + " ".join(words) for words in self.commands)
        lines += ["", self.earlier_stamp() if self.kept else stamp.line(self.name, self.couplings, text, version, tuple(self.also))]
        (RESULTS / f"{self.name}.md").write_text(re.sub(r"\n{3,}", "\n\n", "\n".join(lines)) + "\n", encoding="utf-8")
        if self.kept:
            return
        listed = ROOT / "scripts/results/unstamped.txt"
        kept = [line for line in listed.read_text(encoding="utf-8").splitlines() if line != self.name]
        if len(kept) < len(listed.read_text(encoding="utf-8").splitlines()):
            listed.write_text("\n".join(kept) + "\n", encoding="utf-8")


def write_csv(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def make_page(name):
    module = importlib.import_module(name)
    page = Page(name, module.TITLE)
    module.make(page)
    page.finish()


def make_pages(names):
    """Makes pages one after the other; one that fails is told, and the others are made. Then the record of bits of their sources, and the index."""
    (ROOT / "out/results").mkdir(parents=True, exist_ok=True)
    failed = []
    with open(ROOT / "out/results/.alone", "w", encoding="ascii") as alone:
        fcntl.flock(alone, fcntl.LOCK_EX)  # two pages at a time would measure each other
        for name in names:
            print(name, file=sys.stderr, flush=True)
            try:
                make_page(name)
            except Exception:  # pylint: disable=broad-except  # whatever it is, hours of other pages are not lost
                traceback.print_exc()
                failed.append(name)
    pages_index.write_index()
    if failed:
        print(f"not made: {', '.join(failed)}", file=sys.stderr)
    recorded = subprocess.run([sys.executable, str(ROOT / "scripts/same_bits.py"), "record"], env=dict(os.environ, FLOE=str(FLOE)), check=False).returncode
    return 1 if failed else recorded


def main(words):
    known = dict(pages_index.described())
    if words[:1] in (["-h"], ["--help"]):
        print(__doc__)
    elif words[:1] == ["list"]:
        print("\n".join(f"{name:14} {said}" for name, said in known.items()))
    elif words[:1] == ["stale"]:
        return stamp.list_stale("--strict" in words, RESULTS)
    elif words[:1] == ["index"]:
        pages_index.write_index()
    elif unknown := [name for name in words if name not in known]:
        print(f"results.sh: unknown result '{unknown[0]}'; there are: {', '.join(known)}", file=sys.stderr)
        return 2
    else:
        return make_pages(words or [name for name in pages_index.ORDER if name in known])
    return 0


if __name__ == "__main__":
    sys.modules["pages"] = sys.modules["__main__"]
    sys.exit(main(sys.argv[1:]))
