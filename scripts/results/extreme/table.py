#!/usr/bin/env python3
"""table.py RUNS DECK...: what the studies of the extreme decks have come to, from RUNS/STEM/study.json, for scripts/results/extreme.bash.

Prints lines of `key<TAB>value`: counts, and rows of Markdown tables.
"""
import collections
import json
import math
import pathlib
import re
import sys

KINDS = ("solution", "bound", "blind", "refused", "wrong")
ROUND_OFF = 1e-9  # of the largest value; a tolerance for round-off is no measured error


def text(check):
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


def main(runs, decks):
    total, loose = collections.Counter(), []
    for deck in decks:
        stem = pathlib.Path(deck).stem
        title = re.sub("^# ", "", pathlib.Path(deck).read_text(encoding="utf-8").split("\n", 1)[0])
        study = json.loads((pathlib.Path(runs) / stem / "study.json").read_text(encoding="utf-8"))
        count = collections.Counter(run["verdict"]["judged_by"] for run in study["runs"])
        count["cases"] = len(study["runs"])
        couplings = sorted({run["coupling"] for run in study["runs"]})
        builds = sorted({run["floe"]["git"] for run in study["runs"] if run.get("floe")})
        total.update(count)
        print(f"row\t| [{stem}](../../{deck}) | {title} | {', '.join(couplings)} | {count['cases']} | "
              + " | ".join(str(count[kind]) for kind in KINDS) + f" | {', '.join(builds)} |")
        for run in study["runs"]:
            verdict = run["verdict"]
            if verdict["judged_by"] == "blind":
                print(f"blind_case\t* {stem}, {run['directory']}: {verdict['unnoticed']}")
            if verdict["judged_by"] == "wrong" or (verdict["is"] == "refused" and not verdict["reason"]):
                total["unforeseen"] += verdict["is"] == "refused"
                print(f"failure\t* {stem}, {run['directory']}: {verdict['is']}: {verdict['why'][:160]}")
        loose += [f"loose\t* {stem}: {text(check)}: {check['most']:g}, measured {check['largest']:.3g}"
                  for check in study["verdicts"]["checks"] if is_loose(check)]
    print("\n".join(loose))
    print(f"row\t| all | | | {total['cases']} | " + " | ".join(str(total[kind]) for kind in KINDS) + " | |")
    for key in ("cases", "unforeseen") + KINDS:
        print(f"{key}\t{total[key]}")
    print(f"loose_checks\t{len(loose)}")


main(sys.argv[1], sys.argv[2:])
