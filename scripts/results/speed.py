"""Rates of the solvers on one core."""
TITLE = "Speed on one core"


def make(page):
    page.write("Whole steps, on one core, each rate the best of several repeats: what else a machine does only makes it slower. The bars that the",
               "programs print are budgets for later work. Rates differ by some ten per cent from run to run, and by far more on a machine that is shared: one binary made 6 to 17 million",
               "cell updates a second of one gas within ten minutes.", "")
    for name in ("ice_gas", "mpm_rate"):
        said = page.test(f"bench_{name}", f"bench/{name}.c", "bench")
        page.write(f"## bench_{name}", "", *("    " + line for line in said.splitlines()), "")
    page.write("## Pressurised cylinder, h = 0.025 m")
    rows = []
    for coupling in ("mpm", "ice-mpm"):
        run = page.run("inputs/pressurized_cylinder.yaml", coupling, coupling, ["domain.cell=0.025"])
        summary = run.result.summary
        per_cell = f"{1e6 * run.cpu / summary['cell_updates']:.2f}" if summary["cell_updates"] else "-"
        rows.append((coupling, summary["steps"], f"{run.cpu:.2f}" + (" *" if run.disturbed else ""), f"{run.wall:.2f}", per_cell, f"{1e6 * run.cpu / summary['point_updates']:.2f}"))
    page.table(("coupling", "steps", "CPU, s", "wall, s", "us a cell and step", "us a point and step"), rows)
    page.write("Processor time of the steps, outputs left out; *: others used the machine meanwhile. Uintah, of July 2026, took 5.8 us a cell and step for this problem on one core of a 2-vCPU x86-64",
               "machine (gcc 12; [a1](a1.md)); the budget for floe's later work is 0.5.")
