"""G1: one gas under one, two and three names in shock tubes; mirrored, along each axis, in a stream; products into air; a bubble."""
import csv
import math

from rows import run

RATIOS = (10.0, 100.0, 1e3, 1e5, 1e6)
CELLS = (200, 400, 800)
WAY = 0.3  # of the shock, in lengths of the tube


def star(left, right):
    """Pressure and velocity between the waves, speed of the right shock: states are density, velocity, pressure, gamma."""
    def change(p, state):
        rho, _, p0, g = state
        c = math.sqrt(g * p0 / rho)
        if p > p0:
            return (p - p0) * math.sqrt(2.0 / ((g + 1.0) * rho) / (p + (g - 1.0) / (g + 1.0) * p0))
        return 2.0 * c / (g - 1.0) * ((p / p0) ** ((g - 1.0) / (2.0 * g)) - 1.0)
    low, high = 1e-9 * min(left[2], right[2]), 10.0 * max(left[2], right[2])
    for _ in range(300):
        p = math.sqrt(low * high)
        low, high = (low, p) if change(p, left) + change(p, right) + right[1] - left[1] > 0.0 else (p, high)
    rho, u, p0, g = right
    shock = u + math.sqrt(g * p0 / rho * (1.0 + (g + 1.0) / (2.0 * g) * (p / p0 - 1.0)))
    return p, u + change(p, right), shock


def tube(ratio, n, gamma=1.4, right_gamma=None, dense=1.0, stream=0.0, mirror=False):
    """Settings of a tube, and the velocity between the waves and the time."""
    right_gamma = right_gamma or gamma
    _, u, shock = star((1.0, stream, ratio, gamma), (dense, stream, 1.0, right_gamma))
    end = WAY / (shock - stream)
    place = 0.5 - 0.5 * stream * end
    sides = [("left", 1.0, ratio, gamma, stream), ("right", dense, 1.0, right_gamma, stream)]
    if mirror:
        place = 1.0 - place
        sides = [("left",) + sides[1][1:4] + (-stream,), ("right",) + sides[0][1:4] + (-stream,)]
    riemann = ", ".join("%s_density: %r, %s_pressure: %r, %s_gamma: %r, %s_velocity: %r" % (s, d, s, p, s, g, s, v)
                        for s, d, p, g, v in sides)
    settings = ["domain.cell=%r" % (1.0 / n), "time.end=%r" % end, "verify.exact={riemann: {%s, position: %r}}" % (riemann, place)]
    return settings + (["boundaries={x: free}"] if stream else []), u, end, place, sides


def bodies(names, edges):
    return ["bodies={" + ", ".join("%s: {material: %s, shape: {box: {lower: %r, upper: %r}}, state: exact}" % (name, name, low, high)
                                   for name, low, high in zip(names, edges, edges[1:])) + "}"]


def gases(names, gammas):
    return ["materials={" + ", ".join("%s: {eos: {ideal: {gamma: %r, specific_heat: 1}}}" % pair for pair in zip(names, gammas)) + "}"]


def errors(result):
    """Relative L1 of density and velocity (%), steps, drift of energy."""
    s = result.summary()
    e = s.get("errors") or {}
    return (100.0 * e.get("l1rel_density", math.nan), 100.0 * e.get("l1rel_velocity_x", math.nan), s["steps"], s["conservation"]["energy"],
            s["rejected_steps"])


def one(label, ratio, n, **k):
    settings, *_ = tube(ratio, n, **k)
    return errors(run("g1_one", "g1/%s-one" % label, settings=settings + gases(["gas"], [k.get("gamma", 1.4)])))


def two(label, ratio, n, mirror=False, **k):
    settings, u, end, place, sides = tube(ratio, n, mirror=mirror, **k)
    result = run("g1_two", "g1/%s-two" % label, settings=settings + gases(["left", "right"], [s[3] for s in sides])
                 + bodies(["left", "right"], [0.0, place, 1.0]))
    with open(result.folder / "profile.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    column = next(name for name in rows[0] if name.startswith("volume_fraction"))
    share = sum(float(row[column]) for row in rows) / len(rows)
    exact = place + (-u if mirror else u) * end
    return errors(result) + (abs(share - exact) / abs(u * end),)


def three(label, ratio, n, edges):
    settings, *_ = tube(ratio, n)
    return errors(run("g1_three", "g1/%s-three" % label, settings=settings + bodies(["left", "middle", "right"], edges)))


def percent(x):
    return "%.2f" % x


def names(page):
    """One, two and three names."""
    table, worst = [], {"two": (0.0, ""), "middle driver": (0.0, ""), "middle driven": (0.0, ""), "interface": (0.0, ""), "steps": (0.0, "")}
    for ratio in RATIOS:
        for n in CELLS:
            at = "%g-%d" % (ratio, n)
            a, b = one(at, ratio, n), two(at, ratio, n)
            c = three(at + "-driver", ratio, n, [0.0, 0.45, 0.5, 1.0])
            d = three(at + "-driven", ratio, n, [0.0, 0.5, 0.62, 1.0])
            place = "ratio %g, %d cells" % (ratio, n)
            for name, x in (("two", b), ("middle driver", c), ("middle driven", d)):
                for q in (0, 1):
                    worst[name] = max(worst[name], (x[q] / a[q], place + (", density" if q == 0 else ", velocity")))
            worst["interface"] = max(worst["interface"], (b[5], place))
            worst["steps"] = max(worst["steps"], (b[2] / a[2], place))
            table.append(("%g" % ratio, n) + tuple("%s, %s" % (percent(x[0]), percent(x[1])) for x in (a, b, c, d))
                         + (a[2], b[2], "%.2f" % (100.0 * b[5]), "%.0e" % b[3]))
    page.write("", "### G1: one gas under one, two and three names", "",
               "L1 of density and of velocity, % of the exact ones; gamma 1.4. Of three names the middle one lies in the driver, where the fan passes it, or "
               "ahead of the shock, which passes its end.")
    page.table(("ratio", "cells", "one name", "two", "three, in the driver", "three, ahead", "steps, one", "two", "interface off by % of its way",
                "energy"), table)
    for name in ("two", "middle driver", "middle driven"):
        page.bar("G1 %s: largest error over that of one name (%s)" % (name + (" names" if name == "two" else ", three names"), worst[name][1]),
                 worst[name][0], None, 1.1)
    page.bar("G1 interface off by, share of its way, at most (%s)" % worst["interface"][1], worst["interface"][0], None, 0.02)
    page.bar("G1 steps of two names over those of one, at most (%s)" % worst["steps"][1], worst["steps"][0], None, 1.1)


def others(page):
    """Scenes that nobody named: other gammas, densities, streams."""
    table = []
    for label, ratio, settings in (("gamma 1.2", 1e3, {"gamma": 1.2}), ("gamma 5/3", 1e5, {"gamma": 5.0 / 3.0}), ("gamma 3", 1e4, {"gamma": 3.0}),
                                   ("10 times the density ahead", 100.0, {"dense": 10.0}), ("a tenth of it", 1e3, {"dense": 0.1}),
                                   ("a hundredth of it", 1e3, {"dense": 0.01}), ("in a stream of 10", 100.0, {"stream": 10.0}),
                                   ("against one of -5", 100.0, {"stream": -5.0})):
        a, b = one(label.replace(" ", "-").replace("/", "_"), ratio, 400, **settings), two(label.replace(" ", "-").replace("/", "_"), ratio, 400, **settings)
        table.append((label, "%g" % ratio, "%s, %s" % (percent(a[0]), percent(a[1])), "%s, %s" % (percent(b[0]), percent(b[1])),
                      "%.2f" % (100.0 * b[5]), b[4], "%.0e" % b[3]))
    page.write("", "The same, 400 cells: other gammas, densities and streams.")
    page.table(("what", "ratio", "one name", "two", "interface off by %", "rejected", "energy"), table)
    plain, mirrored = two("plain", 1e3, 400), two("mirrored", 1e3, 400, mirror=True)
    page.bar("G1 mirrored: error of density over that of the scene", mirrored[0] / plain[0], 0.999, 1.001, "{:.6f}")


def strip(dim, axis, n, ratio=1e3):
    """The tube of two names as a strip of four cells across."""
    settings, *_ = tube(ratio, n)
    h = 1.0 / n
    upper = [4.0 * h] * dim
    upper[axis] = 1.0
    low, high = [0.0] * dim, list(upper)
    low[axis] = high[axis] = 0.5
    settings = [s for s in settings if not s.startswith("domain")]
    settings[-1] = settings[-1].replace("position", "axis: %d, position" % axis)
    sides = "boundaries={" + ", ".join("%s: slip" % "xyz"[a] for a in range(dim)) + "}"
    box = "{material: %s, shape: {box: {lower: %r, upper: %r}}, state: exact}"
    return errors(run("g1_two", "g1/strip-%d-%d" % (dim, axis), settings=settings + [
        "domain={dim: %d, lower: %r, upper: %r, cell: %r}" % (dim, [0.0] * dim, upper, h), sides,
        "bodies={left: %s, right: %s}" % (box % ("left", [0.0] * dim, high), box % ("right", low, upper)),
        "verify.metrics=[l1rel_density, l1rel_velocity_%s]" % "xyz"[axis]]))


def strips(page):
    line = two("line", 1e3, 200)
    rows = [("a line", percent(line[0]), line[2], "%.0e" % line[3])]
    worst = 0.0
    for dim, axis in ((2, 0), (2, 1), (3, 2)):
        s = strip(dim, axis, 200)
        worst = max(worst, abs(s[0] / line[0] - 1.0))
        rows.append(("a strip in %d-D along %s" % (dim, "xyz"[axis]), percent(s[0]), s[2], "%.0e" % s[3]))
    page.write("", "Two names at a ratio of 1e3, 200 cells, as strips of four cells across.")
    page.table(("tube", "L1 of density, %", "steps", "energy"), rows)
    page.bar("G1 strips: error of density off that of a line (steps are shorter), at most", worst, None, 0.1)


def shock_place(result, level):
    with open(result.folder / "profile.csv", newline="") as file:
        rows = [{name.split(" (")[0]: float(x) for name, x in row.items()} for row in csv.DictReader(file)]
    return max(row["x"] for row in rows if row["pressure"] > level)


def products(page):
    left, end, place = (1630.0, 0.0, 1e10), 6e-5, 0.3
    table, off = [], {}
    for right_gamma, names_of in ((1.4, 2), (3.0, 2), (3.0, 1)):
        _, _, speed = star(left + (3.0,), (1.2, 0.0, 1e5, right_gamma))
        row = ["%d, gamma 3 and %g" % (names_of, right_gamma)]
        for n in (200, 800):
            settings = ["domain.cell=%r" % (1.0 / n), "time.end=%r" % end, "verify.exact.riemann.right_gamma=%r" % right_gamma,
                        "materials.air={eos: {ideal: {gamma: %r, specific_heat: 1}}}" % right_gamma]
            if names_of == 1:
                settings += ["bodies={all: {material: products, shape: {box: {lower: 0, upper: 1}}, state: exact}}", "materials.air=null",
                             "verify.metrics=[l1rel_density, l1rel_pressure]"]
            result = run("g1_products", "g1/products-%g-%d-%d" % (right_gamma, names_of, n), settings=settings)
            off[right_gamma, names_of, n] = 100.0 * ((shock_place(result, 1e6) - place) / (speed * end) - 1.0)
            row.append("%+.1f" % off[right_gamma, names_of, n])
        table.append(row)
    page.write("", "Products into air: how much too far the shock has run, %. What is left with two names is what one gas has: a fan into next to nothing.")
    page.table(("names", "200 cells", "800 cells"), table)
    page.bar("G1 products into air, 800 cells: too far, over that of one name of gamma 3", off[1.4, 2, 800] / off[3.0, 1, 800], None, 1.1)


def bubble(page):
    result = run("g1_bubble", "g1/bubble")
    s = result.summary()
    drift = max(s["conservation"][name] for name in ("mass", "momentum", "energy"))
    page.write("", "A shock of Mach 1.22 over a bubble of helium, 160 x 40 cells, %d steps: %d rejected, largest drift of mass, momentum and energy %.0e." %
               (s["steps"], s["rejected_steps"], drift))
    page.bar("G1 bubble: largest drift", drift, None, 1e-12)
    page.bar("G1 bubble: rejected steps", s["rejected_steps"], None, 0, "{:.0f}")


def measure(page):
    names(page)
    others(page)
    strips(page)
    products(page)
    bubble(page)
