"""CPDI: domains that deform with their points, beside the other bases."""
import re

import floe
from order_table import order_of
from pages import RESULTS, write_csv

TITLE = "CPDI: domains that deform with their points"
BASES = ("linear", "gimp", "cpdi", "quadratic")
SCHEMES = ("usl", "usf", "musl")
CYLINDER, BAR, CROSSING = (f"inputs/{name}.yaml" for name in ("pressurized_cylinder", "bar_vibration", "cell_crossing"))
LIMITS = ["--set", "output.interval=null", "--set", "output.history_interval=0.01", "--set", "time.end=100", "--relative-to", 0.00197642354]


def blocks(page):
    said = page.test("verification_mpm_domains", "tests/verification/test_mpm_domains.c")
    found = re.findall(r"^(.-D), (.*): cpdi (.*), gimp (.*)$", said, re.MULTILINE)
    page.bar("uniform stress in deformed blocks: largest force inside, of the stress times a face", max(float(row[2]) for row in found), "<=", 2e-13, "{:.1e}")
    page.write("## Blocks under uniform stress", "", "A block of 4 by 2 (by 2) points a cell is mapped; then every point has the same stress. The largest force on a node inside, over stress times face, should vanish.")
    page.table(("block", "cpdi", "gimp"), [(f"{dim}, {block}", cpdi, gimp) for dim, block, cpdi, gimp in found])


def bar(page):
    page.write("## A vibrating bar", "", f"`{BAR}`: L1 errors from h = 1/16 to 1/64, two points a cell, and orders. Points that tile their cells make of GIMP and CPDI the linear basis.")
    rows = []
    for basis in BASES:
        cases = page.cases("compare", f"bar-{basis}", BAR, "--set", f"method.basis={basis}")
        row = [basis]
        for metric in ("l1_velocity_x", "l1_stress_xx"):
            errors, (slope, _) = cases.numbers(metric, coupling="mpm"), order_of(cases, "mpm", metric)
            row += [f"{errors[0]:.2e} to {errors[-1]:.2e}", f"{slope:.2f}"]
            if (basis, metric) == ("cpdi", "l1_velocity_x"):
                page.bar("vibrating bar, cpdi: order of velocity", slope, ">=", 1.8, "{:.2f}")
        rows.append(row)
    page.table(("basis", "velocity (m/s)", "order", "stress (Pa)", "order"), rows)


def crossing(page):
    said = page.test("verification_mpm_force", "tests/verification/test_mpm_force.c")
    page.write("## Points that cross cells", "", "Jump of the force (N) at York's nodes as a point crosses a face (A.2 of his thesis), and drift of the energy of a mass on a spring of points in 1 s",
               f"(`{CROSSING}`).")
    rows = []
    for basis in BASES:
        run = page.run(CROSSING, f"crossing-{basis}", None, ["domain.cell=0.1", f"method.basis={basis}"], once=True)
        jump = re.search(rf"^{basis}: .*largest jump (\S+)$", said, re.MULTILINE)
        rows.append((basis, jump.group(1) if jump else "-", f"{run.result.summary['conservation']['energy']:.1e}" if run.status == 0 else f"status {run.status}"))
    page.table(("basis", "jump", "drift of energy"), rows)


def steps(page):
    page.write("## Steps", "", "The clamped bar, as on the page [stability](stability.md): largest stable step over h/c.")
    flip = page.limits("steps", BAR, *LIMITS, "--set", "time.max_steps=4000", "--over", "time.fixed_step=0.0005:0.008", "--each", "method.basis=linear,gimp,cpdi",
                       "--each", "method.stress=usl,usf,musl", "--tolerance", 0.005)
    others = page.limits("steps-transfers", BAR, *LIMITS, "--set", "time.max_steps=2000", "--set", "method.flip=null", "--set", "method.basis=cpdi", "--over", "time.fixed_step=0.0005:0.012",
                         "--each", "method.transfer=pic,xpic,apic,tpic", "--each", "method.stress=usl,usf,musl", "--tolerance", 0.01)

    def of(rows, key, value):
        found = {row["method.stress"]: row for row in rows if row[key] == value}
        return [f"{float(found[scheme]['stable_over_reference']):.2f}" if found[scheme]["outcome"] == "found" else found[scheme]["outcome"] for scheme in SCHEMES]

    page.table(("transfer", "basis", *SCHEMES), [*(("flip", basis, *of(flip, "method.basis", basis)) for basis in BASES[:3]),
                                                 *((transfer, "cpdi", *of(others, "method.transfer", transfer)) for transfer in ("pic", "xpic", "apic", "tpic"))])


def cylinder(page):
    page.write("## The pressurised cylinder", "", f"`{CYLINDER}`: eq. 13, L1 of sigma_r and sigma_theta; fitted points, 2 by 2 a cell, edges not held; as `mpm` the gas is points too, of the same basis. *: others used",
               "the machine meanwhile.")
    found, rows = {}, []
    for basis in BASES:
        found[basis] = page.cases("compare", f"cylinder-{basis}", CYLINDER, "--set", f"method.basis={basis}", "--set", "method.edge_penalty=0")
        table = found[basis]
        kept = [name for name in ("coupling", "h", "status", "steps", "eq13", "l1_sigma_r", "l1_sigma_theta", "cpu_seconds") if name in table.units]
        write_csv(RESULTS / f"cpdi-cylinder-{basis}.csv", kept, [[row[name] for name in kept] for row in table.rows])
    for coupling in ("mpm", "ice-mpm"):
        for k, h in enumerate(found["linear"].numbers("h", coupling=coupling)):
            for basis in BASES:
                row = [one for one in found[basis].rows if one["coupling"] == coupling][k]
                rows.append((coupling, f"{h:g}", basis, floe.percent(float(row["eq13"] or "nan")), *(f"{float(row[name] or 'nan') / 1e6:.3f} MPa" for name in ("l1_sigma_r", "l1_sigma_theta")),
                             row["status"].replace("_", " "), row["steps"], f"{float(row['cpu_seconds']):.2g}" + (" *" if row["disturbed"] == "yes" else "")))
    page.table(("coupling", "h (m)", "basis", "eq. 13", "sigma_r", "sigma_theta", "end", "steps", "CPU, s"), rows)
    moving = sum(status != "at_rest" for status in found["cpdi"].texts("status", coupling="mpm"))
    page.bar("pressurised cylinder as mpm, cpdi: spacings at which the gas of points does not come to rest", moving, "<=", 0, "{:d}")


def finest(page):
    page.write("As `mpm` with h = 0.0125 m:", "")
    for basis in ("cpdi", "gimp"):
        run = page.run(CYLINDER, f"fine-{basis}", "mpm", [f"method.basis={basis}", "method.edge_penalty=0", "domain.cell=0.0125"], once=True)
        page.write(f"* {basis}: eq. 13 is {floe.percent(run.error('eq13'))} ({run.result.summary['status'].replace('_', ' ')})." if run.status == 0
                   else f"* {basis}: the run ends with status {run.status} ({run.text.strip().splitlines()[-1][:200]}).")
    page.write("", "The error of the stress is that of the other bases that are linear between nodes: it lies in the edges of the solid and in one stress a cell, which domains do not change.", "",
               "## Tried", "",
               "* Domains of whole sub-cells for the points that fitted seeding cuts at surfaces: eq. 13 of 19.5, 10.0 and 6.15 % (ice-mpm) and 19.3, 10.3 and 6.8 % (mpm) where domains with the volumes of",
               "  their points have what the table says (by a program that is not kept).",
               "* Domains that reach over walls, folded as other bases are: corners of leaning domains may give nodes negative weights; they are squeezed to the wall instead. At mirrors they are folded, and",
               "  half a body moves as the half of a whole one.")


def make(page):
    page.write("The domain of a point is a parallelogram (in space a parallelepiped) that stretches, shears and turns with it; its corners carry the linear basis ([theory](../theory/README.md)). Beside it",
               "the linear basis, GIMP, whose boxes keep their shape (those of fluids swell), and the default, quadratic splines.")
    for part in (blocks, bar, crossing, steps, cylinder, finest):
        part(page)
    page.write("", "## Bars")
    page.show_bars()
