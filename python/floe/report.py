"""Results as one page of HTML that holds all it shows and needs no network.

    floe.report.write(["out/sod-compare"], "sod.html")
"""
import dataclasses
import datetime
import math
import os
import pathlib

import jinja2
import numpy

from . import figures as figures_module
from . import files, histories, svg, units
from .cases_page import CaseList, is_done, number_of
from .files import Refused
from .page import Page, Section
from .snapshots import Run, json_file

_HERE = pathlib.Path(__file__).parent / "templates"
_GOOD = ("done", "at_rest", "passed", "stable", "met", "found")
_BAD = ("diverged", "failed", "missed", "unstable", "timed_out", "rejected steps", "energy grows", "not finite")


@dataclasses.dataclass
class Request:
    folders: list[str]
    file: str
    title: str | None = None
    times: list[float] = dataclasses.field(default_factory=list)
    version: str = ""


# ---- which folders ----

def kind_of(folder: str) -> str | None:
    """What a folder holds, by the file that tells; of several, the first."""
    for kind in ("stability", "study", "compare", "summary"):
        if os.path.exists(os.path.join(folder, kind + ".json")):
            return kind
    return None


def check_folders(folders: list[str]) -> None:
    """That each holds results; nothing is written before."""
    for folder in folders:
        if kind_of(folder):
            continue
        if not os.path.exists(folder):
            raise Refused(f"there is no folder '{folder}': name one that floe run, compare, study or stability has written")
        if any(os.path.exists(os.path.join(folder, name)) for name in ("checkpoint.h5", "history.csv")):
            raise Refused(f"the run in '{folder}' has not ended, so it has no summary.json: wait for it, or go on with floe run --resume")
        raise Refused(f"'{folder}' holds no results (no summary.json, compare.json, study.json or stability.json): name a folder that floe run, compare, study or "
                      "stability has written")


def beside(file: str) -> pathlib.Path:
    """The folder of the page's figures: "a/b.html" gives "a/b_files"."""
    return pathlib.Path((file[:-5] if file.endswith(".html") and len(file) > 5 else file) + "_files")


# ---- what runs share ----

def cause_of(run: Run) -> str:
    """Why a run has not come to its end, by its summary or, of older runs, the last line of its log; "" when it has, or neither says."""
    cause, status = str(run.summary.get("message") or ""), str(run.summary.get("status", ""))
    if cause or is_done(status):
        return cause
    lines = run.text("run.log").strip().splitlines()
    _, found, said = (lines[-1] if lines else "").partition(" s  ")
    if not found:
        return ""
    said = said.partition(" ")[2].strip()
    return said[len(status):].strip() if status and said.startswith(status) else said


def provenance(build: dict, folder: pathlib.Path, name: str, deck: str) -> list[tuple[str, str]]:
    """With what results were made."""
    facts = [("Deck", deck)]
    if math.isfinite(number_of(build.get("threads"))):
        facts.append(("Threads", units.count(number_of(build["threads"]))))
    facts.append(("Machine", str(build.get("machine", ""))))
    if build.get("version"):
        facts.append(("floe", f"{build['version']} ({build.get('git', '')})"))
        facts.append(("Compiler", f"{build.get('compiler', '')}, {build.get('flags', '')}"))
    try:
        moment = datetime.datetime.fromtimestamp(os.stat(folder / name).st_mtime, datetime.timezone.utc)
        facts.append(("Finished", f"{moment:%Y-%m-%d %H:%M} UTC"))
    except OSError:
        pass
    return [(title, text) for title, text in facts if text]


def run_facts(run: Run) -> list[tuple[str, str]]:
    s = run.summary
    time, rejected = number_of(s.get("time")), number_of(s.get("rejected_steps"))
    updates = sum(one for one in (number_of(s.get("point_updates")), number_of(s.get("cell_updates"))) if one > 0)
    seconds, rss = number_of(s.get("wall_seconds")), number_of((s.get("memory") or {}).get("peak_rss_bytes"))
    facts = [("Coupling", str(s.get("coupling", ""))), ("Time reached", units.number(time, "1" if run.dimensionless else "s")),
             ("Steps", units.count(number_of(s.get("steps"))) + (f", and {units.count(rejected)} rejected" if rejected > 0 else "")),
             ("Run time", units.seconds(seconds)), ("Processor time of the steps", units.seconds(number_of(s.get("cpu_seconds"))))]
    facts += [(title, units.count(number_of(s.get(key)))) for key, title in (("points", "Points"), ("cells", "Cells")) if number_of(s.get(key)) > 0]
    if updates > 0 and seconds > 0:
        facts.append(("Updates a second", units.digits(updates / seconds, 3)))
    if rss > 0:
        facts.append(("Memory, at most", units.bytes_text(rss)))
    return [(title, text) for title, text in facts if text not in ("", "–")]


def errors_of(run: Run) -> list[tuple[str, str]]:
    return [(name, units.error_text(name, number_of(value), run.dimensionless)) for name, value in (run.summary.get("errors") or {}).items()]


def stage_times(run: Run) -> list[tuple[str, str, float, float]]:
    """Stages in falling order of their times: (name, time, share, share of the longest)."""
    found = sorted(((name, number_of(value)) for name, value in (run.summary.get("seconds_by_stage") or {}).items() if number_of(value) > 0), key=lambda one: -one[1])
    total = sum(value for _, value in found)
    return [(name, units.seconds(value), value / total, value / found[0][1]) for name, value in found]


def _warn_of(page: Page, whose: str, run: Run) -> None:
    """What stands on top of the page: that a run has not ended well, and what floe warned of."""
    status = str(run.summary.get("status", ""))
    if not is_done(status):
        page.warning(whose, f"{status.replace('_', ' ')}: {cause_of(run)}".rstrip(": "))
    for text in run.summary.get("warnings") or []:
        page.warning(whose, str(text))


# ---- sections ----

def add_run(page: Page, folder: pathlib.Path) -> None:
    """The folder of `floe run`."""
    run = Run(folder)
    title = f"{run.title}, {run.summary.get('coupling', '')}".rstrip(", ")
    section = page.section(title, "run")
    stem = page.stem(folder)
    _warn_of(page, run.title, run)
    profile = folder / "profile.csv"
    drawn = page.draw(histories.profile_figures(profile, stem)) if profile.exists() else []
    counters = [(name.replace("_", " "), units.count(number_of(value))) for name, value in (run.summary.get("counters") or {}).items() if number_of(value) != 0]
    section.data = {"run": run, "status": run.summary.get("status", ""), "cause": cause_of(run), "errors": errors_of(run), "frames": page.film(run, stem),
                    "profiles": drawn, "histories": page.draw(histories.history_figures(run, stem)), "ledger": histories.ledger(run), "limits": histories.step_limits(run),
                    "stages": stage_times(run), "counters": counters, "facts": run_facts(run), "log": run.text("run.log"),
                    "provenance": provenance(run.summary.get("floe") or {}, folder, "summary.json", str(run.summary.get("deck", "")))}
    page.cards.append({"section": section, "title": title, "status": run.summary.get("status", ""), "lines": [cause_of(run)] if cause_of(run) else [],
                       "errors": errors_of(run), "seconds": units.seconds(number_of(run.summary.get("wall_seconds")))})


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + "."


def _answer(one: dict, cases: CaseList) -> str:
    """What to choose for a level of error, which is named in the unit of the errors beside it: 50 kPa, not 50000 Pa."""
    target = number_of(one.get("target"))
    text, metric = str(one.get("text", "")), str(one.get("metric", ""))
    level, words, rest = text.partition(f" in {metric} ")
    return _sentence(f"for {cases.error_text(metric, target)}{words}{rest}" if words and level.startswith("for ") and math.isfinite(target) else text)


def _verdicts(told: dict, cases: CaseList) -> list[dict]:
    """What a person wants first, of each metric: the least error, and what to choose for a level of error."""
    answers, out = (told.get("timing") or {}).get("answers") or [], []
    for metric in cases.metrics:
        best = cases.least(metric)
        own = [one for one in answers if one.get("metric") == metric]
        reached = [one for one in own if isinstance(one.get("best"), str)]
        out.append({"metric": metric, "least": cases.error_text(metric, best.error(metric)) if best else "",
                    "by": cases.title(best) if best else "", "time": units.seconds(best.cpu) if best else "",
                    "answers": [_answer(one, cases) for one in own], "short": [_answer(one, cases) for one in reached[-1:]]})
    return out


def _orders(told: dict, cases: CaseList) -> list[dict]:
    out = []
    for metric in cases.metrics:
        for group, fits in (told.get("orders") or {}).items():
            fit = fits.get(metric) or {}
            if math.isfinite(number_of(fit.get("order"))):
                out.append({"metric": metric, "group": group, "order": number_of(fit["order"]), "stderr": number_of(fit.get("stderr")),
                            "pairs": [number_of(one) for one in fit.get("pairs") or []]})
    return out


def _bars(told: dict, cases: CaseList) -> list[dict]:
    """What the deck requires, and whether it is met."""
    out = []
    for bar in told.get("bars") or []:
        metric, order = str(bar.get("metric", "")), bar.get("of") == "order"
        required, value = (units.digits(number_of(bar.get(key)), 3) if order else cases.error_text(metric, number_of(bar.get(key))) for key in ("required", "value"))
        out.append({"met": bar.get("met") is True, "what": f"{'order of' if order else 'error'} {metric}", "where": str(bar.get("where", "")),
                    "required": ("at least " if order else "at most ") + required, "value": value})
    return out


def _limits(told: dict, cases: CaseList) -> list[dict]:
    """Quantities for ever finer cases."""
    out = []
    for name in cases.quantities:
        for group, found in (told.get("limits") or {}).items():
            limit = found.get(name)
            if isinstance(limit, dict):
                out.append({"quantity": units.words(name), "group": group, "value": number_of(limit.get("value")), "order": number_of(limit.get("order")),
                            "gci": 100 * number_of(limit.get("gci_relative")), "kind": str(limit.get("kind", ""))})
    return out


def _each_case(section: Section, folder: pathlib.Path, cases: CaseList) -> list[dict]:
    out = []
    for k, case in enumerate(cases.cases):
        run = Run(folder / case.directory, case.run)
        out.append({"id": f"{section.id}-case{k + 1}", "case": case, "title": cases.title(case), "run": run, "cause": cause_of(run), "errors": errors_of(run),
                    "facts": run_facts(run), "stages": stage_times(run), "ledger": histories.ledger(run)})
    return out


def add_cases(page: Page, folder: pathlib.Path, name: str) -> None:
    """The folder of `floe study` or `floe compare`."""
    told = json_file(folder / name)
    cases = CaseList(told)
    title = str(told.get("title") or folder.resolve().name)
    section = page.section(title, "study")
    stem, each = page.stem(folder), _each_case(section, folder, cases)
    for one in each:
        _warn_of(page, f"{title}, {one['title']}", one["run"])
    finest = cases.finest()
    shown = cases.cases if len(cases.cases) <= 8 else finest
    runs = [(cases.title(case), Run(folder / case.directory, case.run)) for case in shown if is_done(case.status)]
    bars, profile = _bars(told, cases), folder / "profiles.csv"
    missed = sum(not one["met"] for one in bars)
    if missed:
        page.warning(title, f"{missed} of {len(bars)} requirements of the deck missed")
    timing = number_of((told.get("timing") or {}).get("repeat"))
    facts = provenance(cases.cases[0].run.get("floe") or {} if cases.cases else {}, folder, name, str(told.get("deck", "")))
    if math.isfinite(timing):
        facts.append(("Times", f"the best of {timing:.0f}, alone on one thread" if timing > 0 else "of one run each, beside whatever else ran"))
    compared = [(cases.title(case), cases.cases.index(case), Run(folder / case.directory, case.run)) for case in finest[:8]]
    section.data = {"cases": cases, "each": each, "verdicts": _verdicts(told, cases), "bars": bars, "orders": _orders(told, cases), "limits": _limits(told, cases),
                    "frames": page.side_by_side(runs, stem), "errors": page.draw(cases.error_figures(stem)), "quantities": page.draw(cases.quantity_figures(stem)),
                    "profiles": page.draw(histories.profile_figures(profile, stem, "group")) if profile.exists() else [],
                    "histories": page.draw(histories.compared_histories([(name, k, run) for k, (name, _, run) in enumerate(compared)], stem)),
                    "provenance": facts, "disturbed": any(case.disturbed for case in cases.cases)}
    bad = sum(not is_done(case.status) for case in cases.cases)
    line = f"{len(cases.cases)} cases" + (f", of which {bad} did not come to an end" if bad else "") + (f"; {len(bars) - missed} of {len(bars)} requirements met" if bars else "")
    page.cards.append({"section": section, "title": title, "status": ("missed" if missed else "met") if bars else "", "lines": [line], "verdicts": section.data["verdicts"][:1]})


def _settings(found: dict, keys: bool = True) -> str:
    return ", ".join(f"{key} = {value}" if keys else str(value) for key, value in found.items())


def _energy_figure(runs: list[dict], key: str, stem: str) -> figures_module.Figure:
    """The largest ratio of energy over the value, a curve for each combination."""
    series: dict[str, list[tuple[float, float]]] = {}
    for run in runs:
        try:
            place = float((run.get("over") or {}).get(key, ""))
        except ValueError:
            continue
        series.setdefault(_settings(run.get("each") or {}, keys=False) or key, []).append((place, number_of(run.get("energy_ratio"))))
    panel = figures_module.Panel(x_label=key, y_label="energy over what there can be", log_y=True)
    for k, (name, points) in enumerate(series.items()):
        x, y = numpy.array(sorted(points)).T
        panel.series.append(figures_module.Series(name, x, y, "linespoints", k))
    return figures_module.Figure(f"{stem}-energy", "Growth of energy", [panel])


def _maps(told: dict) -> list[dict]:
    """A table of verdicts for each combination of the other keys."""
    keys = list(told["over"])[:2]
    out: list[dict] = []
    for each in [run.get("each") or {} for run in told["runs"]]:
        if any(one["each"] == each for one in out):
            continue
        verdicts = {tuple((run.get("over") or {}).get(key) for key in keys): run.get("verdict", "") for run in told["runs"] if (run.get("each") or {}) == each}
        rows = [(row, [verdicts.get((row, column), "") for column in told["over"][keys[1]]]) for row in told["over"][keys[0]]]
        out.append({"each": each, "title": _settings(each), "keys": keys, "columns": told["over"][keys[1]], "rows": rows})
    return out


def add_stability(page: Page, folder: pathlib.Path) -> None:
    """The folder of `floe stability`."""
    told = json_file(folder / "stability.json")
    for key, empty in (("runs", []), ("limits", []), ("each", {}), ("over", {})):
        told[key] = told.get(key) or empty
    title = str(told.get("title") or folder.resolve().name)
    section = page.section(title, "stability")
    is_map, over = len(told["over"]) > 1, next(iter(told["over"]), "")
    drawn = page.draw([_energy_figure(told["runs"], over, page.stem(folder))]) if not is_map and told["runs"] else []
    section.data = {"told": told, "is_map": is_map, "maps": _maps(told) if is_map else [], "energy": drawn, "relative": number_of(told.get("relative_to")),
                    "provenance": provenance({}, folder, "stability.json", str(told.get("deck", "")))}
    line = f"{len(told['runs'])} runs" + (", a map of two keys" if is_map else "") + (f", {len(told['limits'])} limits" if len(told["limits"]) > 1 else "")
    if len(told["limits"]) == 1 and math.isfinite(number_of(told["limits"][0].get("stable"))):
        limit = told["limits"][0]
        line += f"; stable at {over} = {units.digits(number_of(limit['stable']), 5)}, unstable at {units.digits(number_of(limit.get('unstable')), 5)}"
    page.cards.append({"section": section, "title": title, "status": "", "lines": [line]})


# ---- the page ----

def status_class(status: str) -> str:
    return "good" if status in _GOOD else "bad" if status in _BAD else "neutral"


def _environment() -> jinja2.Environment:
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(_HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters |= {"digits": lambda value, figures=4: units.digits(number_of(value), figures), "count": lambda value: units.count(number_of(value)),
                            "seconds": units.seconds, "status": status_class, "clean": clean, "words": units.words}
    return environment


def clean(text: object) -> str:
    """Text without control characters, which no page may have."""
    return "".join(c if c in "\n\t" or ord(c) >= 32 else " " for c in str(text))


def _add(page: Page, folder: str) -> None:
    kind, path = kind_of(folder), pathlib.Path(folder)
    if kind == "stability":
        add_stability(page, path)
    elif kind == "summary":
        add_run(page, path)
    else:
        add_cases(page, path, f"{kind}.json")


def write(request: Request, warn=lambda text: None) -> None:
    """Writes the page, and its figures beside it. `files.Refused` for a folder without results, before anything is written; what a
    folder lacks (an older version's, an unfinished run's) is left out of the page."""
    check_folders(request.folders)
    page = Page(beside(request.file), request.times, warn)
    for folder in request.folders:
        _add(page, folder)
    title = request.title or (page.sections[0].title if len(page.sections) == 1 else f"{len(page.sections)} results of floe")
    now = datetime.datetime.now(datetime.timezone.utc)
    text = _environment().get_template("report.html").render(
        page=page, title=title, style=(_HERE / "report.css").read_text(), script=(_HERE / "film.js").read_text(), version=request.version, date=f"{now:%Y-%m-%d %H:%M} UTC",
        dark=svg.dark_rules(".floe-plot "), most=figures_module.MOST)
    files.replace(request.file, text)
