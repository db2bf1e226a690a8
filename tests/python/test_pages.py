"""What pages are made with: scripts/lib/pages.py on runs of a fraction of a second. FLOE is the program."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts/lib"))
import pages  # noqa: E402
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
    """Tables, bars and the stamp; a bar is missed by what is no number; bars of other pages stay."""
    page = a_page()
    cases = page.cases("compare", "cases", "inputs/sod.yaml", "--axis", "domain.cell=0.04,0.02", "--set", "time.end=0.02", "--repeat", 0)
    order_table(page, cases, "ice", ("l1_density",))
    assert any(line.startswith("| **order** |") for line in page.lines) and "Sod" in page.said
    page.bar("low", 1.0, "<=", 2)
    page.bar("high", 1.0, ">=", 2)
    page.bar("none", math.nan, "<=", 2)
    assert [bar[3] for bar in page.bars] == ["met", "missed", "missed"]
    (pages.RESULTS / "bars.csv").write_text("page,what,measured,bar,met\nsod,\"old\",1,<= 2,met\nother,\"x\",1,<= 2,met\n")
    page.finish()
    text = (pages.RESULTS / "sod.md").read_text()
    assert text.startswith("# A page\n") and "floe compare inputs/sod.yaml" in text
    found = stamp.stamp_in(text)
    assert found and found["names"] == "inputs/sod.yaml" and "report" in found["without"]
    rows = (pages.RESULTS / "bars.csv").read_text().splitlines()
    assert rows[1].startswith("other,") and len(rows) == 5 and "old" not in "".join(rows)


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("passed:", name)
