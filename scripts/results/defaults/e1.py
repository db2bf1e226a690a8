"""E1: a shock tube of 10 bar against a steel wall, in every dimension, along each axis, turned, the wall anywhere in a cell."""
import math

from rows import run

GAMMA, P4, P1, T, R = 1.4, 10e5, 1e5, 300.0, 0.4 * 717.5
WINDOW = (1.7e-3, 2.4e-3)


def exact():
    """Pressures behind the shock and behind the one that comes back, speeds of both, and the density behind each."""
    def velocity(p):
        c = math.sqrt(GAMMA * R * T)
        left = 2.0 * c / (GAMMA - 1.0) * (1.0 - (p / P4) ** ((GAMMA - 1.0) / (2.0 * GAMMA)))
        rho = P1 / (R * T)
        right = (p - P1) * math.sqrt(2.0 / ((GAMMA + 1.0) * rho) / (p + (GAMMA - 1.0) / (GAMMA + 1.0) * P1))
        return left - right
    low, high = P1, P4
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if velocity(middle) > 0.0 else (low, middle)
    z = low / P1
    p5 = low * ((3.0 * GAMMA - 1.0) * z - (GAMMA - 1.0)) / ((GAMMA - 1.0) * z + GAMMA + 1.0)
    speed = math.sqrt(GAMMA * R * T * (1.0 + (GAMMA + 1.0) / (2.0 * GAMMA) * (z - 1.0)))
    return low, p5, speed


def mean(history, name, window=WINDOW):
    rows = [k for k, t in enumerate(history["time"]) if window[0] <= t <= window[1]]
    return sum(history[name][k] for k in rows) / len(rows)


def vector(*x):
    return "[" + ", ".join("%.12g" % y for y in x) + "]" if len(x) > 1 else "%.12g" % x[0]


def box(dim, axis, low, high, width):
    a, b = [0.0] * dim, [width] * dim
    a[axis], b[axis] = low, high
    return "{box: {lower: %s, upper: %s}}" % (vector(*a), vector(*b))


def tube(dim, axis=0, h=0.01, wall=1.5, cells=4):
    """Settings of the tube along an axis, `cells` wide, with the wall's surface at a place (m), and probes in the last four
    cells that the wall leaves whole."""
    width, length = cells * h, math.ceil((wall + 0.1199) / h) * h
    upper = [width] * dim
    upper[axis] = length
    sides = {"xyz"[a]: ("symmetry" if a == axis else "slip") for a in range(dim)}
    last = math.floor(wall / h + 1e-9)
    probes = {}
    for k, name in enumerate(("first", "second", "third", "fourth")):
        x = [1.5 * h] * dim
        x[axis] = (last - k - 0.5) * h
        probes[name] = vector(*x)
    return ["domain={dim: %d, lower: %s, upper: %s, cell: %g}" % (dim, vector(*[0.0] * dim), vector(*upper), h),
            "boundaries={" + ", ".join(f"{a}: {s}" for a, s in sides.items()) + "}",
            "bodies.driver.shape=" + box(dim, axis, 0.0, 0.7, width),
            "bodies.driven.shape=" + box(dim, axis, 0.7, wall, width),
            "bodies.wall.shape=" + box(dim, axis, wall, length, width),
            "output.probes={" + ", ".join(f"{n}: {p}" for n, p in probes.items()) + "}"]


def turned(h, degrees):
    """The tube turned, ten cells wide, between walls of points that are heavy so that they stay (10 m/s2)."""
    c, s, w, t = math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 5.0 * h, 4.5 * h

    def place(a, b):
        return vector(0.12 + a * c - b * s, 0.12 + a * s + b * c)

    def quad(a0, a1, b0, b1):
        return "{quadrilateral: {a: %s, b: %s, c: %s, d: %s}}" % (place(a0, b0), place(a1, b0), place(a1, b1), place(a0, b1))
    heavy = "material: heavy, shape: "
    size = [math.ceil((0.24 + 1.62 * x + 2 * (w + t)) / (10 * h)) * 10 * h for x in (c, s)]
    return ["domain={dim: 2, lower: [0, 0], upper: %s, cell: %g}" % (vector(*size), h), "boundaries={x: free, y: free}",
            "materials.heavy={density: 1e6, specific_heat: 460, law: {linear_elastic: {bulk_modulus: 160e9, shear_modulus: 80e9}}}",
            "bodies.driver.shape=" + quad(0, 0.7, -w, w), "bodies.driven.shape=" + quad(0.7, 1.5, -w, w),
            "bodies.wall.shape=" + quad(1.5, 1.7, -w, w),
            "bodies.upper={%s%s}" % (heavy, quad(-t, 1.7, w, w + t)), "bodies.lower={%s%s}" % (heavy, quad(-t, 1.7, -w - t, -w)),
            "bodies.left={%s%s}" % (heavy, quad(-t, 0, -w, w)),
            "output.probes={first: %s, second: %s, third: %s, fourth: %s}" % tuple(
                place(1.5 - (k + 0.5) * h, x * w) for k, x in ((0, 0.0), (1, 0.7), (2, -0.7), (3, 0.0)))]


def free_wall(dim, h):
    """The strip or the line with the wall free, gas of 1 bar behind it: what it has of momentum is the impulse."""
    settings = tube(dim, 0, h)
    upper = [math.ceil(2.0 / h) * h, 4 * h][:dim]
    settings[0] = "domain={dim: %d, lower: %s, upper: %s, cell: %g}" % (dim, vector(*[0.0] * dim), vector(*upper), h)
    return settings + ["bodies.wall.shape=" + box(dim, 0, 1.5, 1.62, 4 * h)]


def rigid(h):
    """In `ice` a rigid side takes the place of the wall."""
    settings = [s for s in tube(1, 0, h) if not s.startswith(("bodies.wall", "domain"))]
    return settings + ["domain={dim: 1, lower: 0, upper: 1.5, cell: %g}" % h, "bodies.wall=null", "runs_as=[ice]"]


def measure(page):
    p2, p5, speed = exact()
    page.write("## E1: a shock tube against a steel wall", "",
               f"Exact: {p2 / 1e3:.1f} kPa behind the shock, {p5 / 1e3:.2f} kPa behind the one that comes back; means from 1.7 to 2.4 ms.", "")
    cells = ("first", "second", "third", "fourth")
    rows = []

    def case(name, label, coupling, settings, held, cells_held=2):
        r = run("e1_shock_tube", "e1/" + name, coupling=coupling, settings=settings)
        if r.status != 0:
            rows.append([label, coupling, "-"] + ["status %d" % r.status] + ["-"] * 3 + ["%.1f" % r.cpu, "-"])
            if held:
                page.bar(f"E1 {label}: runs", r.status, 0, 0)
            return
        history = r.history()
        found = [mean(history, c + "_pressure") for c in cells]
        told = r.summary().get("interface", "")
        warned = "yes" if any("smeared" in w for w in r.warnings()) or "smeared" in told else "no"
        rows.append([label, coupling, told.split(",")[0] or "-"] + ["%.1f" % (x / 1e3) for x in found] + ["%.1f" % r.cpu, warned])
        if held == "cells":
            for c, x in list(zip(cells, found))[:cells_held]:
                page.bar(f"E1 {label}, {coupling}: {c} cell, error", abs(x / p5 - 1.0), None, 0.01)
        if held == "four":
            page.bar(f"E1 {label}, {coupling}: mean of four cells, error", abs(sum(found) / 4.0 / p5 - 1.0), None, 0.05)

    for h in (0.02, 0.01, 0.005):
        case(f"2d-{h}", f"strip, h = {h}", "ice-mpm", tube(2, 0, h), "cells")
    for k, offset in enumerate((0.0013, 0.0037, 0.0062, 0.0088)):
        case(f"offset-{k}", f"strip, wall {offset * 100:.2f} of a cell into it", "ice-mpm", tube(2, 0, 0.01, 1.5 + offset), "cells")
    case("2d-y", "strip along y", "ice-mpm", tube(2, 1), "cells")
    case("turned", "turned by 30 degrees", "ice-mpm", turned(0.01, 30.0), "cells", 4)
    case("1d", "line, h = 0.01", "ice-mpm", tube(1), "cells", 4)
    case("1d-fine", "line, h = 0.0025", "ice-mpm", tube(1, 0, 0.0025), "cells", 4)
    case("1d-offset", "line, wall 0.62 of a cell into it", "ice-mpm", tube(1, 0, 0.01, 1.5062), "cells", 4)
    for axis in range(3):
        case(f"3d-{axis}", f"column along {'xyz'[axis]}, h = 0.02", "ice-mpm", tube(3, axis, 0.02), "cells")
    case("mpm", "strip", "mpm", tube(2), "four")
    case("mpm-1d", "line", "mpm", tube(1), "four")
    case("ice", "line, rigid side", "ice", rigid(0.01), "cells")
    page.table(("tube", "coupling", "interface", "first cell, kPa", "second", "third", "fourth", "CPU, s", "smeared, and warned of"), rows)
    arrival = 0.8 / speed
    rows = []
    for dim, h in ((2, 0.02), (2, 0.01), (1, 0.02), (1, 0.01)):
        name = ("line", "strip")[dim - 1]
        r = run("e1_shock_tube", f"e1/impulse-{dim}d-{h}", coupling="ice-mpm", settings=free_wall(dim, h))
        history = r.history()
        found = history["velocity_wall_x"][-1] * history["mass_steel"][-1] / (4.0 * h if dim == 2 else 1.0)
        wanted = (p5 - P1) * (history["time"][-1] - arrival)
        rows.append([name, "%g" % h, "%.2f" % found, "%.2f" % wanted, "%+.2f %%" % (100.0 * (found / wanted - 1.0)), "%.1f" % r.cpu])
        page.bar(f"E1 {name}, wall free, h = {h}: impulse, error", abs(found / wanted - 1.0), None, 0.01)
    page.write("", f"The wall free, with gas behind it: its impulse until 2.4 ms, {1e3 * (2.4e-3 - arrival):.3f} ms after the shock has come "
               "(a wall that stays; this one's motion takes 0.15 % off).")
    page.table(("tube", "h, m", "impulse, N s/m2", "exact", "error", "CPU, s"), rows)
