#!/usr/bin/python3
"""same_bits.py: does a change of the sources change a bit of a result?

    scripts/same_bits.py keep DIR [DECK...]      runs decks for a few steps and keeps their histories and snapshots in DIR
    scripts/same_bits.py compare DIR [DECK...]   runs them again and names every deck with another bit, and by how much its fields differ
    scripts/same_bits.py record [DIR]            runs them, the settings and the commands of scripts/lib/variants.py, and writes hashes of what came of them to
                                                 docs/results/bits, or DIR, by which pages are known to be fresh (scripts/lib/bits.py)

Decks are all of inputs, inputs/extreme and inputs/defaults, each in every coupling that it names; FLOE is the program (build/release/floe),
STEPS the steps of a run (40), which all together take about a minute, as does a record. What is kept belongs to one machine and one compiler: keep before the change,
compare after it. Exit status 1 where a bit differs. A record is of the sources that lie here (or in FLOE_SOURCE), and FLOE has to be made of them; where it is there
already only what is missing is run, or of other decks. Records that no page names go, but for that of now, that which others are written by, and all in a DIR."""
import csv
import hashlib
import json
import os
import pathlib
import platform
import re
import resource
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "scripts/lib"))

import bits as records_of  # noqa: E402
import stamp  # noqa: E402
from variants import COMMANDS, VARIANTS  # noqa: E402

FLOE = os.environ.get("FLOE", str(ROOT / "build/release/floe"))
STEPS = os.environ.get("STEPS", "40")
LONGEST = 60  # s of processor time: a run that takes longer is left out, and said so
TIMES = ("wall_seconds", "run_seconds", "cpu_seconds", "scatter", "timed_runs", "disturbed")  # columns of cases that no two runs share
KEPT = ("time", "steps", "rejected_steps", "status", "conservation", "errors", "counters")    # of a summary
SETS = ("inputs", "inputs/extreme", "inputs/defaults")


def all_decks(root=ROOT):
    return [path for name in SETS for path in sorted((root / name).glob("*.yaml"))]


def couplings(deck):
    return records_of.couplings_of(deck.read_text(encoding="utf-8"))


def least_time():
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST + 1))


def floe(*words, **options):
    """Runs floe on one thread, without plots; its exit status is negative where it took too long."""
    return subprocess.run([FLOE, *map(str, words)], check=False, preexec_fn=least_time, env=dict(os.environ, OMP_NUM_THREADS="1", **({} if words[0] == "picture" else {"FLOE_PYTHON": "true"})), **options)


def run(deck, coupling, folder):
    """A line on what came of it; the folder holds history and snapshots alone."""
    words = ["run", deck, "--set", f"time.max_steps={STEPS}", "-o", folder, "--quiet"] + (["--coupling", coupling] if coupling else [])
    status = floe(*words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    if status < 0:
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


# ---- records ----

def hashed(parts):
    """Of pairs of a name and bytes."""
    digest = hashlib.sha256()
    for name, data in parts:
        digest.update(f"{name}\0{len(data)}\0".encode() + data)
    return digest.hexdigest()[:12]


def said(done):
    """Of a run that ended with an error: the status, and a hash of what was said."""
    return f"exit status {done.returncode} {hashed([('', re.sub(rb'/[^ ]*/', b'', done.stderr))])}"


def of_run(deck, coupling, settings, folder):
    """What came of a run, for a record."""
    words = ["run", deck, "--set", f"time.max_steps={STEPS}", "-o", folder, "--quiet"] + (["--coupling", coupling] if coupling else [])
    done = floe(*words, *(word for one in settings for word in ("--set", one)), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, cwd=stamp.ROOT)
    if done.returncode < 0:
        return "not run: too long"
    if done.returncode == 2 or not (folder / "summary.json").exists():
        return said(done)
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    if not summary.get("steps"):
        return "not run: no steps"
    parts = [("summary", json.dumps({name: summary.get(name) for name in KEPT}, sort_keys=True).encode())]
    if (folder / "profile.csv").exists():
        parts.append(("profile", (folder / "profile.csv").read_bytes()))
    for name, array in sorted(values(folder).items()):
        text = array.dtype.kind in "OU"
        parts.append((f"{name} {'' if text else array.dtype.str} {array.shape}", "\n".join(map(str, array.ravel().tolist())).encode() if text else array.tobytes()))
    return hashed(parts)


def without_times(path):
    """A table of cases, without the columns that are times and the cases' folders."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    kept = [k for k, name in enumerate(rows[0]) if name.split(" ")[0] not in TIMES]
    return "\n".join(",".join(row[k] for k in kept) for row in rows).encode()


def of_command(command, deck, settings, folder):
    """What came of a study, a comparison, a search for a limit, or a picture, for a record."""
    if command == "picture":
        floe("run", deck, *settings, "-o", folder, "--quiet", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=stamp.ROOT)
        done = floe("picture", folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=stamp.ROOT)
    else:
        done = floe(command, deck, *settings, "-o", folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=stamp.ROOT)
    if done.returncode < 0:
        return "not run: too long"
    tables = [path for stem in ("compare", "study", "stability", "limits") for path in [folder / f"{stem}.csv"] if path.exists()]
    pictures = sorted(folder.glob("pictures/*.png")) if command == "picture" else []
    if done.returncode not in (0, 6) or not tables + pictures:
        return said(done)
    orders = b"\n".join(line for line in done.stdout.splitlines() if line.startswith(b"order"))
    return hashed([("orders", orders), *((path.name, without_times(path)) for path in tables), *((path.name, path.read_bytes()) for path in pictures)])


def of_test(source):
    """What a test program prints, for a record."""
    program = pathlib.Path(FLOE).parent / "tests" / re.sub(r".*/(\w+)/test_(\w+)\.c$", r"\1_\2", source)
    if not program.exists():
        return "not run: not built"
    done = subprocess.run([program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False, preexec_fn=least_time, cwd=stamp.ROOT)
    return "not run: too long" if done.returncode < 0 else hashed([("said", done.stdout)]) if done.returncode == 0 else f"exit status {done.returncode}"


def of_row(key, folder):
    what, deck, coupling, settings = key
    shutil.rmtree(folder, ignore_errors=True)
    if what == "test":
        return of_test(deck)
    return of_run(deck, coupling, settings.split(), folder) if what == "run" else of_command(what, deck, settings.split(), folder)


def all_rows(tree, others):
    """Every row of a record, as (what, deck or test, coupling, settings); `others`: sets of files that pages hang on."""
    yield from sorted({("test", name, "", "") for files in others for name in files if re.search(r"/test_\w+\.c$", name)})
    for deck in all_decks(stamp.ROOT):
        yield from (("run", str(deck.relative_to(stamp.ROOT)), coupling, "") for coupling in couplings(deck))
    yield from (("run", deck, coupling, " ".join(settings)) for deck, coupling, settings in VARIANTS if tree.has(deck))
    yield from ((command, deck, coupling, " ".join(settings)) for command, deck, coupling, settings in COMMANDS if tree.has(deck))


def machine():
    model = re.search(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="ascii"), re.MULTILINE)
    return f"{model.group(1) if model else platform.machine()}, {'-'.join(platform.libc_ver())}"


def record(place):
    """Writes the record of the sources that lie here into a folder, or completes it; None: into that of the pages, where what no page names goes."""
    version = floe("--version", stdout=subprocess.PIPE, text=True).stdout
    if not stamp.built_from(version, (), ()):
        sys.exit("same_bits.py: the program was not built from the sources that lie here")
    tree, folder = stamp.Tree(), pathlib.Path(place) if place else stamp.ROOT / records_of.FOLDER
    stamps = [found for path in (stamp.ROOT / "docs/results").glob("*.md") if (found := stamp.stamp_in(path.read_text(encoding="utf-8")))]
    others = sorted({tuple(one["also"].split()) for one in stamps if one["also"]})
    names = stamp.sources_names(tree, others)
    made = f"{version.splitlines()[1]}; {machine()}; {STEPS} steps"
    records = records_of.read(folder)
    own = records.get(names[""])
    if not own or own.made != made:
        own = records_of.Record(names[""], made)
    own.names = names
    wanted, rows, ran = list(all_rows(tree, others)), {}, 0
    with tempfile.TemporaryDirectory() as work:
        for key in wanted:
            of = stamp.file_hash(tree, key[1]) if key[0] == "test" else stamp.decks_hash(tree, [key[1]])
            if own.rows.get(key, ("", ""))[0] == of and own.rows[key][1] != "not run: not built":
                rows[key] = own.rows[key]
                continue
            rows[key] = (of, of_row(key, pathlib.Path(work) / "run"))
            ran += 1
            if not re.fullmatch("[0-9a-f]{12}", rows[key][1]):
                print(f"{' '.join(filter(None, key))}: {rows[key][1]}")
    own.rows = rows
    named = {one["sources"] for one in stamps}
    records[own.sources] = own
    records_of.write(folder, records, {name for name, one in records.items() if one is own or place or named & set(one.names.values())})
    print(f"{ran} of {len(wanted)} runs made; {len(list(folder.glob('*.csv')))} records in {folder}")
    return 0


def main():
    if sys.argv[1:2] == ["record"] and len(sys.argv) <= 3:
        return record(sys.argv[2] if len(sys.argv) > 2 else None)
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
