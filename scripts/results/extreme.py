"""extreme: every deck of inputs/extreme as a study with verdicts, and what comes of each case.

Hours. The studies are kept deck by deck and, since `floe study` goes on with what has been stopped, case by case in out/results/extreme. What was made of other sources
or of another deck is made anew, unless a record shows the same bits of the deck under both; the sources of a deck are those that its couplings enter (scripts/lib/stamp.py).
"""
import collections
import json
import math
import pathlib
import re
import shutil

import bits
import pages
import stamp

TITLE = "Extreme scenes: right, refused or wrong"
DECKS = "inputs/extreme"
KINDS = ("solution", "bound", "blind", "refused", "wrong")
ROUND_OFF = 1e-9  # of the largest value; a tolerance for round-off is no measured error


# ---- what was made of what ----

def made_of(deck, without):
    """What a deck's study hangs on."""
    tree = stamp.Tree()
    return {"without": without, "sources": stamp.sources_hash(tree, without), "deck": stamp.decks_hash(tree, [deck])}


def is_kept(note, deck):
    """Whether the runs that lie there are of this deck, and of these sources or of others that give the same bits."""
    try:
        found = json.loads(note.read_text(encoding="utf-8"))
        without, sources = found["without"], found["sources"]
    except (OSError, ValueError, KeyError):
        return False
    if found["deck"] != stamp.decks_hash(stamp.Tree(), [deck]):
        return False
    records = bits.read(stamp.ROOT / bits.FOLDER).values()
    made = {"without": " ".join(without), "also": None, "sources": sources, "names": deck}
    return not stamp.why_other_sources(stamp.Tree(), made, f"\n## How\n    floe study {deck} --spoil\n", records)


def study_of(page, deck):
    """The study of a deck; one that was stopped goes on, one that has ended stands."""
    stem = pathlib.Path(deck).stem
    note = page.runs / f"{stem}.made"
    if not is_kept(note, deck):
        shutil.rmtree(page.runs / stem, ignore_errors=True)
        note.write_text(json.dumps(made_of(deck, [])), encoding="utf-8")
    couplings = set(page.cases("study", stem, deck, "--spoil", kept=True).texts("coupling"))
    tree = stamp.Tree()
    note.write_text(json.dumps(made_of(deck, sorted(stamp.left_out(tree, couplings, {"study"}, tree.text(deck))))), encoding="utf-8")
    return json.loads((page.runs / stem / "study.json").read_text(encoding="utf-8"))


# ---- what came of it ----

def text_of(check):
    at = "" if check["at"] is None else f", at {check['at']:g} of the time"
    where = ", ".join(f"{key}={value}" for key, value in check["where"].items())
    return f"{'change of ' if check['change'] else ''}{check['of']}{at}{' where ' + where if where else ''}"


def is_loose(check):
    """Whether a tolerance is more than twice what was measured: of an error, or of values about the middle of their bounds."""
    least, most, small, large = (check[key] for key in ("least", "most", "smallest", "largest"))
    if large is None or small is None or not math.isfinite(large):
        return False
    if least is None and most is not None and not check["of"].startswith(("kinetic", "strain", "internal", "drift")):
        return most > 2.05 * large and most > ROUND_OFF
    return False


class Table:
    """What the studies have come to: counts, rows and lines of the page."""

    def __init__(self):
        self.total, self.unforeseen, self.unwarned = collections.Counter(), 0, 0
        self.rows, self.failures, self.blind, self.loose = [], [], [], []

    def add_run(self, stem, run):
        verdict = run["verdict"]
        name, warned = f"{stem}, {run['directory']}", [word for word in run.get("warnings", []) if "does not read this key" not in word]
        if verdict["judged_by"] == "blind":
            self.blind.append(f"* {name}: {verdict['unnoticed']}")
        if verdict["judged_by"] == "wrong":
            self.unwarned += not warned
            told = f" `check` warns: \"{warned[0][:200]}...\"" if warned else " `check` says nothing."
            self.failures.append(f"* {name}: wrong: {verdict['why'][:160]}.{told}")
        elif verdict["is"] == "refused" and not verdict["reason"]:
            self.unforeseen += 1
            self.failures.append(f"* {name}: refused: {verdict['why'][:160]}")

    def add(self, deck, study):
        stem = pathlib.Path(deck).stem
        title = re.sub("^# ", "", (pages.ROOT / deck).read_text(encoding="utf-8").split("\n", 1)[0])
        count = collections.Counter(run["verdict"]["judged_by"] for run in study["runs"])
        count["cases"] = len(study["runs"])
        self.total.update(count)
        couplings = ", ".join(sorted({run["coupling"] for run in study["runs"]}))
        self.rows.append((f"[{stem}](../../{deck})", title, couplings, count["cases"], *[count[kind] for kind in KINDS]))
        for run in study["runs"]:
            self.add_run(stem, run)
        self.loose += [f"* {stem}: {text_of(check)}: {check['most']:g}, measured {check['largest']:.3g}" for check in study["verdicts"]["checks"] if is_loose(check)]


def reasons_of(deck, part):
    """Why the deck expects a refusal (`refuse`), or lets a spoiled result be right (`unchanged`)."""
    text = (pages.ROOT / deck).read_text(encoding="utf-8")
    found = re.search(rf"^  {part}:\n((?:    .*\n?)*)", text, re.MULTILINE)
    stem, reasons = pathlib.Path(deck).stem, set()
    for line in found.group(1).splitlines() if found else []:
        by, why = re.search(r"by: ([a-z ]*),", line), re.search(r"why: ([^{}]*?)(?:, where.*)?\}$", line)
        reasons.add(f"* {stem}: {by.group(1) + ': ' if by else ''}{why.group(1)}.")
    return sorted(reasons)


# ---- the page ----

def enter_bars(page, table):
    total = table.total
    page.bar("cases", total["cases"], ">=", 150, "{:d}")
    page.bar("right, share of all", 100 * (total["solution"] + total["bound"] + total["blind"]) / total["cases"], ">=", 90, "{:.1f}", " %")
    page.bar("wrong", total["wrong"], "<=", 0, "{:d}")
    page.bar("wrong without a warning by check", table.unwarned, "<=", 0, "{:d}")
    page.bar("checked blindly", total["blind"], "<=", 0, "{:d}")
    page.bar("ended without a reason in the deck", table.unforeseen, "<=", 0, "{:d}")
    page.bar("tolerances above twice the measured error", len(table.loose), "<=", 0, "{:d}")


def show_list(page, title, lines, about=()):
    if lines:
        page.write("", f"## {title}", "", *about, *lines)


def decks_of_page():
    return sorted(str(path.relative_to(pages.ROOT)) for path in (pages.ROOT / DECKS).glob("*.yaml"))


def make(page):
    decks, table = decks_of_page(), Table()
    for deck in decks:
        table.add(deck, study_of(page, deck))
    page.write("Each deck is a study whose axes are crossed, and says in its head what is checked of each case, and by what: an exact or published solution, that of an independent solver",
               "(`scripts/results/extreme`), or a bound. A case is *right* if it comes to its end and keeps to all checks, *refused* if floe ends it with the reason, else *wrong*.", "",
               "Of those that are right, a *solution* is compared in norms or over histories, or values in a *bound*, unless they are *blind*: each is judged again as if it had been frozen, not begun,",
               "doubled, halved or mirrored (`floe study --spoil`, [guide](../guide.md)), and one that all of its checks let pass with any of the five, but where that is the right answer, is blind.",
               "", "## Bars")
    enter_bars(page, table)
    page.show_bars()
    page.write("## Decks")
    total = ("all", "", "", table.total["cases"], *[table.total[kind] for kind in KINDS])
    page.table(("deck", "scene", "couplings", "cases", *KINDS), [*table.rows, total])
    show_list(page, "Not right", table.failures)
    show_list(page, "Blind", table.blind)
    show_list(page, "Tolerances above twice the measured error", table.loose)
    show_list(page, "Refused", [line for deck in decks for line in reasons_of(deck, "refuse")],
              ("floe ends these with a reason, before they start or on the way; the decks say which, and why:", ""))
    show_list(page, "Unchanged", [line for deck in decks for line in reasons_of(deck, "unchanged")],
              ("What leaves the right answer as it is, by the decks; that it does is checked too:", ""))
