"""Membranes and strings of York's thesis: mass on a spring, mass on a slack string, pendulum; ball and net as printed."""
import re

import numpy
from floe import figure, percent

TITLE = "Membranes of York's thesis"
SPRING, STRING, PENDULUM, NET = (f"inputs/{name}.yaml" for name in ("spring_mass", "string_mass", "pendulum", "ball_net"))
IN_CELLS = ["bodies.string.membrane.curve={points: {at: [[0.05, 1.99], [0.05, 1.98], [0.05, 1.97], [0.05, 1.89], [0.05, 1.88], [0.05, 1.87], [0.05, 1.79], [0.05, 1.78], [0.05, 1.77], [0.05, 1.69]]}}"]
SMALL = ["verify.reference.hanging_mass.slack=0.02", "verify.reference.hanging_mass.small_strain=1", "verify.reference.hanging_mass.constant_volume=0"]
BY_RATE = ["bodies.string.membrane.strain=rate", "bodies.string.membrane.smoothing=0"]


def column(run, name):
    return run.result.history[name].values


def share(value, digits=2):
    return percent(value, digits)


def spring(page):
    page.write("## Mass on a spring (York 1997, section 5.5, boxes 3 and 4)", "", f"`{SPRING}`, as printed: linear functions, ten points, constant point volume, step 1.8e-6.")
    run = page.run(SPRING, "spring", None, [], once=True)
    depth = 1.69 - column(run, "last_spring_y").min()
    page.table(("", "published", "exact", "ours", "error"), [
        ("period (`hperiod_position`)", "agrees with theory", "0.019859", "", share(run.error("hperiod_position"))),
        ("turning points, worst (`hturns_position`)", "", "", "", share(run.error("hturns_position"))),
        ("place, worst, over the amplitude (`hmax_position`)", "", "", "", share(run.error("hmax_position"))),
        ("largest depth", "about 0.005", "0.004995", f"{depth:.6f}", f"{100 * (depth / 0.004995 - 1):+.2f} %")])
    page.write("Exact: y = -(m g/k)(1 - cos omega t), omega = sqrt(E A/(L m)) = 316.39, L = 0.3. What else the deck may be run with:")
    rows = []
    for said, settings in (("volume by thickness", ["bodies.spring.membrane.section=thickness"]), ("quadratic splines", ["method.basis=quadratic"])):
        other = page.run(SPRING, "spring-" + said.split()[0], None, settings, once=True)
        rows.append((said, share(other.error("hperiod_position")), share(other.error("hturns_position"))))
    page.table(("", "period", "turning points"), rows)
    page.write("While no point crosses a cell, what a cell holds of the spring should shrink as 1/stretch, and only constant point volumes make it so. Quadratic splines are of no use here: the mass of 3.33 is",
               "smeared over three nodes, holds them together, and shortens the spring by a share of a cell. Refined with the deck's pattern of points there is no order to see, for no point crosses a cell, and",
               "the spring is linear to round-off; in a continuum the deck's law (logarithmic strain, constant volume) has a period that is 1.24 % longer.", "")
    page.bar("mass on a spring: period", 100 * run.error("hperiod_position"), "<=", 0.5, "{:.2g}", " %")


def crossings(run):
    """Times at which the energy of the string passes 5 % of its largest, up and down."""
    time, energy = column(run, "time"), column(run, "strain")
    above = energy > 0.05 * energy.max()
    change = numpy.flatnonzero(numpy.diff(above.astype(int)))
    return [float(time[k] + (0.05 * energy.max() - energy[k]) / (energy[k + 1] - energy[k]) * (time[k + 1] - time[k])) for k in change]


def string(page):
    page.write("## Mass on a slack string (York 1997, section 5.6, box 5)", "",
               f"`{STRING}`: as printed, with `method.stress: musl`. Exact for what floe states (logarithmic strain, constant volume, L = 0.3, slack 6 x 0.0333 (exp(0.1) - 1) = 0.02103); in brackets for small",
               "strains and a slack of 0.02. *5 %*: the string's energy passes 5 % of its largest.")
    run = page.run(STRING, "string", None, [], once=True)
    time, place = column(run, "time"), column(run, "last_string_y")
    early = time < 0.03
    taut, free = (crossings(run) + [float("nan")] * 2)[:2]
    lowest = time[early][place[early].argmin()]
    later = (time > lowest) & (time < 0.05)
    depth, highest = 1.69 - place[early].min(), time[later][place[later].argmax()]
    rows = [("`hperiod_position`", "", "", "", share(run.error("hperiod_position"))), ("`hturns_position`, worst of five", "", "", "", share(run.error("hturns_position")))]
    for said, published, exact, brackets, own in (("taut, 5 %", "0.013", 0.01386, " (0.01353)", taut), ("free again, 5 %", "0.023", 0.02390, " (0.02324)", free),
                                                  ("lowest, time", "", 0.01888, " (0.01839)", lowest), ("lowest, depth", "about 0.034", 0.03444, " (0.03280)", depth),
                                                  ("highest, time", "0.0375", 0.03776, " (0.03678)", highest)):
        rows.append((said, published, f"{exact:.5f}{brackets}", f"{own:.5f}", f"{100 * (own / exact - 1):+.1f} %"))
    rows.append(("energy drift", "", "0", share(run.result.summary["conservation"]["energy"]), ""))
    page.table(("", "published", "exact", "ours", "error"), rows)
    page.bar("mass on a slack string: period", 100 * run.error("hperiod_position"), "<=", 0.5, "{:.2g}", " %")
    page.bar("mass on a slack string: turning points", 100 * run.error("hturns_position"), "<=", 0.5, "{:.2g}", " %")
    page.write("Why depth and times of tension are off, one thing at a time (steps are those of the deck, 1.8e-6, unless said; period, turning points, energy drift):")
    rows = []
    for said, settings in (("as printed", []), ("steps of 4.5e-7", ["time.fixed_step=4.5e-7"]), ("points that stay in their cells", IN_CELLS), ("the same against small strains, slack 0.02", IN_CELLS + SMALL),
                           ("the same in steps of 4.5e-7", [*IN_CELLS, *SMALL, "time.fixed_step=4.5e-7"])):
        cells = []
        for stress in ("usl", "musl"):
            other = page.run(STRING, "string-" + re.sub("[^a-z0-9]+", "-", said) + "-" + stress, None, [f"method.stress={stress}", *settings], once=True)
            cells.append(", ".join(figure(100 * value, 2) for value in (other.error("hperiod_position"), other.error("hturns_position"), other.result.summary["conservation"]["energy"])) + " %"
                         if other.status == 0 else f"status {other.status}")
        rows.append((said, *cells))
    page.table(("", "USL", "MUSL"), rows)
    page.write("So the steps' error is USL's. The rest is the law: as long as no point leaves its cell, the strain of a cell is its elongation over h, not over what it has become, so that three cells are a string",
               "of *small* strain with a slack of 0.02. With each cell's points a tenth to three tenths of a cell under its upper node none leaves, and that law's exact motion is met. As printed the string",
               "becomes taut by that law, and is softened and held longer by a point that crosses into the cell of the mass, which ends the swing near where the logarithmic law does. The published 0.013 and",
               "0.0375 lie between both laws. Refining does not bring the logarithmic law: string points that cross cells flutter, and energy goes there.", "")


def pendulum(page):
    page.write("## Pendulum (York 1997, section 5.7, boxes 6 and 7)", "",
               f"`{PENDULUM}`: linear functions, `musl`, strain by the positions of the points (`strain: positions`, `smoothing: 0.05`) and `flip: 0.999`. Against the chain of bars (`bar_chain`, ten points), which",
               "loses nothing; errors are worst over the amplitude to t = 1.75, *energy* is the largest drift in the ledger. The thesis shows curves without numbers. The finest of the deck's study, 320 points,",
               "takes a quarter of an hour and is not run here.")
    rows = []
    for said, settings in (("the deck", []), ("strain by its rate, as in the thesis, and GIMP", [*BY_RATE, "method.basis=gimp", "method.flip=1"]),
                           ("as printed but for the steps: linear, USL", [*BY_RATE, "method.flip=1", "method.stress=usl"])):
        for wrinkles in ("true", "false"):
            cases = page.cases("study", "pendulum-" + re.sub("[^a-z]+", "-", said) + wrinkles, PENDULUM, "--axis", "domain.cell=0.2,0.1,0.05", "--set", f"materials.string.one_way={wrinkles}",
                               *(word for one in settings for word in ("--set", one)), "--repeat", 0)
            for row in cases.rows:
                rows.append((said, "yes" if wrinkles == "true" else "no", f"{float(row['h']):g}", *(share(float(row[name] or "nan")) for name in ("hperiod_x", "hmax_x", "hrms_x")),
                             share(float(row["drift_energy"] or "nan")), row["status"].replace("_", " ")))
    page.table(("", "wrinkle law", "cell", "`hperiod_x`", "`hmax_x`", "`hrms_x`", "energy", "end"), rows)
    page.write("The string stays taut in the deck, so that the wrinkle law has nothing to do there. With strain by its rate what the swing loses is in the flutter of the string, and falls with h; as printed USL",
               "takes much of the energy at every size. The error of the period is then that of the heavy point, which is spread over its nodes. With linear functions and FLIP alone the heavy point is where it",
               "should be, but the points of the string shake along it: what nodes work by the rate at the points is not what positions store. A thousandth of PIC a step takes that, and nothing of the swing.",
               "The domain is wider than printed: a heavy point within a cell of a slip wall is held by it. Against run time: [cost_accuracy](cost_accuracy.md).", "")


def net(page):
    page.write("## Ball and net (York 1997, section 5.9, box 8)", "", "On a page of its own: [ball and net](ball-net.md), with a net of the section h = 0.25, which fits the published release. Here with the section 0.0125 that Table 11",
               f"prints (`{NET}`, quadratic splines, to t = 7):")
    settings = ["bodies.net.membrane.thickness=0.0125", "bodies.net.points=4", "materials.net.one_way=true", "method.basis=quadratic", "time.fixed_step=1e-4", "time.end=7"]
    rows = []
    for said, published, more in (("with release", "about -0.7; free of the net at 2.8 (A.1.6: 0.8)", []), ("without", "about -0.1", ["contact=null"])):
        run = page.run(NET, "net-" + said.replace(" ", "-"), None, [*settings, *more], once=True)
        velocity, energy = column(run, "velocity_ball_x"), column(run, "kinetic") + column(run, "strain")
        changing = numpy.flatnonzero(abs(velocity - velocity[-1]) >= 1e-6)
        free = column(run, "time")[min(changing[-1] + 1, len(velocity) - 1)] if len(changing) else 0.0
        rows.append((said, published, f"{velocity[-1]:.2f}", f"{velocity.min():.2f}", f"{free:.2f}" if free < 0.95 * column(run, "time")[-1] else "-", share(1 - energy[-1] / energy[0]),
                     f"{column(run, 'drift_momentum_x').max():.1e}"))
    page.table(("", "published speed", "speed at t = 7", "largest speed to the left", "free of the net at", "energy lost", "momentum drift"), rows)


def make(page):
    page.write("Published, reference and ours side by side (York 1997; Sulsky and York 2000). Decks: `inputs/`.", "")
    for part in (spring, string, pendulum, net):
        part(page)
    page.write("## Slack circle (Sulsky and York 2000, section 8) and dog-bone (York 1997, section 6.2, box 9)", "",
               "On a page of their own: [membranes that gas blows up](membrane-rest.md). With strain by its rate and without heat, as the papers have it: [normals](normals.md); [deviations](../deviations.md) says why",
               "floe's decks differ. The published runs end 0.4 to 4.7 % short in radius and 3 to 20 % low in pressure.", "", "## Bars")
    page.show_bars()
