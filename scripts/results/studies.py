"""The studies that stand in the decks: every coupling and basis, error against processor time."""
from floe import plots

TITLE = "Studies: error against run time"
STUDIES = (
    ("cylinder", "inputs/pressurized_cylinder.yaml", "Both couplings, three bases, four spacings: eq. 13 and stresses against Lamé (row A1 of Guilkey et al. 2003)."),
    ("sod", "inputs/sod.yaml", "The gas on cells, and as points, nine a cell (row B1; York has 100 cells and linear functions, `--set method.basis=linear`)."),
    ("vortex", "inputs/isentropic_vortex.yaml", "Smooth flow in two dimensions: what the limiter costs."),
    ("pulse", "inputs/acoustic_pulse.yaml", "Smooth flow in one dimension: both time centrings."),
)
NUMBERS = ("h", "status", "time", "steps")


def groups_of(cases):
    """{name: rows}: the cases that differ in the mesh alone, by the values of the other axes."""
    axes = [name for name in cases.units if name not in NUMBERS][:next(k for k, name in enumerate(cases.units) if name == "h")]
    found = {}
    for row in cases.rows:
        found.setdefault(", ".join(row[axis] for axis in axes if axis != "domain.cell"), []).append(row)
    return found


def figure_of(page, short, cases):
    """The first two errors over spacing and over processor time."""
    names = list(cases.units)
    metrics = names[names.index("drift_energy") + 1:names.index("run_seconds")][:2]
    groups = groups_of(cases)
    colours = plots.colours(list(groups))
    axes_of = [("h", "h"), ("cpu_seconds", "processor time (s)")]

    def draw(axes, k):
        (column, label), metric = axes_of[k % 2], metrics[k // 2]
        for name, rows in groups.items():
            axes.plot([float(row[column]) for row in rows], [float(row[metric]) for row in rows], marker="o", color=colours[name], label=name)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(label)
        axes.set_ylabel(plots.label(metric, cases.units[metric]))
        if k == 0:
            axes.legend(fontsize="small")

    plots.panels(page.picture(short, "error against spacing and processor time"), draw, [""] * (2 * len(metrics)))


def make(page):
    page.write("What `floe study` says of the studies that stand in the decks. Each case is a process; timed runs are alone on one thread, and the best counts.",
               "`floe report` makes a page of each, with the pictures, ledgers and times by stage of every case.", "")
    for short, deck, text in STUDIES:
        cases = page.cases("study", short, deck)
        said = page.said.splitlines()
        page.write(f"## {said[0]}", "", text, "", f"    floe study {deck}", "", "```", *said[1:], "```")
        figure_of(page, short, cases)
        page.bar(f"{deck}: required orders and errors that were missed", sum(line.startswith("MISSED") for line in said), "<=", 0, "{:d}")
        page.bar(f"{deck}: cases that did not come to their end", sum(text not in ("done", "at_rest") for text in cases.texts("status")), "<=", 0, "{:d}")
    page.write("Up to which time step York's line of points is stable, in each placement and scheme, is on the page [stability](stability.md).", "", "## Bars")
    page.show_bars()
