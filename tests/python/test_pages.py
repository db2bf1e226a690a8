"""What pages are made with: scripts/lib/pages.py on runs of a fraction of a second. FLOE is the program."""
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts/lib"))
import pages  # noqa: E402
import pages_index  # noqa: E402
import stamp  # noqa: E402
from order_table import order_table  # noqa: E402

WORK = pathlib.Path(tempfile.mkdtemp())
pages.RESULTS = WORK / "results"
pages.RESULTS.mkdir()


def a_page():
    page = pages.Page("sod", "A page")
    page.runs = WORK / "runs"
    return page


def test_commands():
    """Commands that differ in one value are one, and stay ones that a shell takes."""
    run = ["floe", "run", "a.yaml", "--set"]
    assert pages.merged([run + ["h=1"], run + ["h=2"], run + ["x=[1, 2]"]]) == ["floe run a.yaml --set h={1,2}", "floe run a.yaml --set 'x=[1, 2]'"]
    assert pages.merged([run + ["h=1", "k=1"], run + ["h=2", "k=2"]]) == ["floe run a.yaml --set h=1 k=1", "floe run a.yaml --set h=2 k=2"]


def test_repeats():
    """A short case until half a second is spent, a longer one three times, a long one once."""
    assert not pages.enough(0.01, 0.4, 10) and pages.enough(0.01, 0.5, 10) and pages.enough(0.01, 0.1, pages.MOST_REPEATS)
    assert not pages.enough(0.1, 0.2, 2) and pages.enough(0.1, 0.3, 3) and not pages.enough(5, 5, 1) and pages.enough(5, 10, 2) and pages.enough(20, 20, 1)


def test_run():
    """Times of a case are of the processor and of the wall, of several runs; what it ends with counts."""
    page = a_page()
    run = page.run("inputs/sod.yaml", "ice", "ice", ["time.end=0.02"])
    assert run.status == 0 and run.repeats >= 3 and 0 < run.cpu < 0.5 and 0 < run.wall and run.scatter >= 0 and run.error("l1_density") > 0
    assert page.couplings == {"ice"} and math.isnan(run.error("none"))
    wrong = page.run("inputs/sod.yaml", "wrong", "ice", ["time.end=-1"])
    assert wrong.status == 2 and math.isnan(wrong.cpu) and math.isnan(wrong.error("l1_density")) and "time.end" in wrong.text


def test_disturbance():
    """What others do meanwhile is seen; what the command itself does is not taken for that of others."""
    burn = [sys.executable, "-c", "import time\nend = time.process_time() + 0.5\nwhile time.process_time() < end: pass"]
    _, alone = pages.measured(burn)
    assert 0.45 < alone.cpu < 1 and alone.others < os.cpu_count()
    beside = [subprocess.Popen(burn) for _ in range(2)]
    _, crowded = pages.measured(burn)
    for one in beside:
        one.wait()
    assert crowded.disturbed and crowded.others > 0.1 and abs(crowded.cpu - alone.cpu) < 0.3


def test_page():
    """Tables, bars and the stamp; a bar is missed by what is no number; the index has them all, and those of other pages."""
    page = a_page()
    cases = page.cases("compare", "cases", "inputs/sod.yaml", "--axis", "domain.cell=0.04,0.02", "--set", "time.end=0.02", "--repeat", 0)
    order_table(page, cases, "ice", ("l1_density",))
    assert any(line.startswith("| **order** |") for line in page.lines) and "Sod" in page.said
    page.bar("low", 1.0, "<=", 2)
    page.bar("high", 1.0, ">=", 2)
    page.bar("none", math.nan, "<=", 2)
    assert [bar[3] for bar in page.bars] == ["met", "missed", "missed"]
    page.show_bars()
    page.finish()
    text = (pages.RESULTS / "sod.md").read_text()
    assert text.startswith("# A page\n") and "floe compare inputs/sod.yaml" in text
    found = stamp.stamp_in(text)
    assert found and found["names"] == "inputs/sod.yaml"
    assert list(pages_index.bars_of(text)) == [["low", "1", "<= 2", "met"], ["high", "1", ">= 2", "**missed**"], ["none", "nan", "<= 2", "**missed**"]]
    other = "# Another\n\n| what | measured | bar | |\n|---|---|---|---|\n| a \\| b | 2 % | <= 1 % | **missed** |\n\n| met |\n|---|\n| met |\n"
    index = pages_index.index_of({"sod": text, "other": other})
    assert "4 bars, 3 of them missed:" in index and "| [other](other.md) | a \\| b | 2 % | <= 1 % | **missed** |" in index and "| [other](other.md) | Another |" in index


def test_every_page_is_listed():
    """A script that makes a page is made by `results.sh` without a name, or named as one that is not."""
    scripts = {path.stem for path in (ROOT / "scripts/results").glob("*.py") if "def make(page)" in path.read_text()}
    assert scripts <= set(pages_index.ORDER) | set(pages_index.ONLY_NAMED), scripts


def test_rows_of_the_defaults():
    """The stamp of the page of the defaults knows all its rows: its script names them."""
    rows = {path.stem for path in (ROOT / "scripts/results/defaults").glob("[a-z][0-9]*.py") if "_" not in path.stem}
    assert rows < set(re.findall(r"\w+", (ROOT / "scripts/results/defaults.py").read_text())), rows


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("passed:", name)
