"""The pages of docs/results, their order, and the index of all of them with every bar."""
import ast
import re

from places import ROOT

RESULTS = ROOT / "docs/results"
SCRIPTS = ROOT / "scripts/results"

#: The pages, in the order of the index; those that are made only when they are named stand apart.
ORDER = ("defaults", "a1", "edges", "studies", "couplings", "sod", "shocks", "waves", "bases", "cpdi", "transport", "conservation", "exchange", "statics", "implicit", "stability", "extreme",
         "robustness", "contact", "normals", "axis", "membrane-3d", "membrane-rest", "embedded", "interface", "substeps", "ball-net", "airbag", "york-points", "york-membranes", "streams", "speed",
         "cost_accuracy", "picture", "gallery")
ONLY_NAMED = ("mutants",)  # of scripts/mutants.py (hours)

ABOUT = """
The last line of a page names what it was made from: a hash of `include`, the CMake files and the modules of `src` that its runs entered
(cells alone: all but `mpm` and `surface`; points alone: all but `ice`; single runs: all but `study`, `batch` and `plot`),
one of its decks, one of its script; comments and blanks do not count. Where the sources alone are other ones, a page is fresh all the same if a record shows the same
bits under both (`bits/`, one file for each recorded state of the sources, by `scripts/same_bits.py record`): of each of its decks in each of its couplings, in 40 steps, of every
recorded choice of a key that it sets (bases, transfers, solvers, interfaces, ...; `scripts/lib/variants.py`), on a small deck each, of the commands that it uses and of the tests whose figures it shows. That is good evidence and
no proof: it sees 40 steps of the decks as they are, no finer mesh and nothing that begins later. What was not run counts as changed, and so does what a page
has from benchmarks. Another machine or compiler proves as much where its bits are the same, and its own differences count as changes. Times on a page are those of the program that it was made with. `scripts/results.sh stale` lists the pages that no longer agree and why, and those
of before there were stamps (`scripts/results/unstamped.txt`). A page is made anew for its figures, and never to mark it.
"""


def described():
    """(name, what its script says that it is about) of every page that a script makes."""
    for name in (*ORDER, *ONLY_NAMED):
        path = SCRIPTS / f"{name}.py"
        if path.is_file():
            yield name, (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").split("\n\n")[0].replace("\n", " ")


def title_of(text):
    return text.splitlines()[0].removeprefix("# ")


def bars_of(text):
    """The bars of a page, as [what, measured, bar, met or missed]: rows of its tables that begin with these names."""
    inside = False
    for line in text.splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] if line.startswith("|") else []
        if cells[:3] == ["what", "measured", "bar"]:
            inside = True
        elif not cells:
            inside = False
        elif inside and len(cells) == 4 and cells[3].strip("*") in ("met", "missed"):
            yield cells


def index_of(pages):
    """The index of {name: text}, as lines."""
    rows = [(name, *cells) for name, text in pages.items() for cells in bars_of(text)]
    missed = sum("missed" in row[-1] for row in rows)
    return ["# Results", "", "*Written by `scripts/results.sh`; do not edit.*", "",
            "From runs that anyone can repeat: `scripts/results.sh`, or `scripts/results.sh NAME` for one page. Bars were set before anything was measured.", "",
            "| page | |", "|---|---|", *(f"| [{name}]({name}.md) | {title_of(text)} |" for name, text in pages.items()), *ABOUT.splitlines(), "",
            f"{len(rows)} bars, {missed} of them missed:", "", "| page | what | measured | bar | |", "|---|---|---|---|---|",
            *(f"| [{name}]({name}.md) | " + " | ".join(cells) + " |" for name, *cells in rows)]


def write_index():
    """docs/results/README.md, from the pages as they lie there."""
    found = {name: RESULTS / f"{name}.md" for name in (*ORDER, *ONLY_NAMED)}
    lines = index_of({name: path.read_text(encoding="utf-8") for name, path in found.items() if path.is_file()})
    (RESULTS / "README.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
