"""Errors of a comparison at each spacing, and their orders."""
import math

import floe


def order_of(cases, coupling, metric):
    """(slope, standard error) of log(error) over log(h)."""
    return floe.order(cases.numbers("h", coupling=coupling), cases.numbers(metric, coupling=coupling))


def order_text(slope, error):
    return f"**{slope:.2f}**" + ("" if math.isnan(error) else f" ± {error:.2f}")


def order_table(page, cases, coupling, metrics, rejected=False, last=()):
    """A row a spacing, one of orders below; `rejected`: how many steps were; `last`: more columns, as (title, format of the row's index)."""
    spacing, steps = cases.numbers("h", coupling=coupling), cases.texts("steps", coupling=coupling)
    columns = [cases.numbers(metric, coupling=coupling) for metric in metrics]
    lost = cases.texts("rejected_steps", coupling=coupling)
    rows = [(floe.figure(h, 9), steps[k], *([lost[k]] if rejected else []), *(f"{column[k]:.3e}" for column in columns), *(form(k) for _, form in last))
            for k, h in enumerate(spacing)]
    rows.append(("**order**", "", *([""] if rejected else []), *(order_text(*order_of(cases, coupling, metric)) for metric in metrics), *("" for _ in last)))
    page.table(("h", "steps", *(["rejected"] if rejected else []), *metrics, *(title for title, _ in last)), rows)


def time_column(cases, coupling):
    """Processor time of each case, * where others have disturbed it."""
    seconds, disturbed = cases.numbers("cpu_seconds", coupling=coupling), cases.texts("disturbed", coupling=coupling)
    return "CPU, s", lambda k: floe.figure(seconds[k]) + (" *" if disturbed[k] == "yes" else "")


def order_bar(page, what, cases, coupling, metric, limit):
    slope, error = order_of(cases, coupling, metric)
    page.bar(f"{what} (± {error:.2f})", slope, ">=", limit, "{:.2f}")
