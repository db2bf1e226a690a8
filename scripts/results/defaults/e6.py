"""E6: a cantilever under its weight against the elastica, stepped and static, and its first frequency."""
import glob
import math

from rows import run

THICK, LENGTH, LOAD = 0.1, 2.0, 4.0


def elastica(load=LOAD, steps=4000):
    """Tip (x, y)/L of E I theta'' = -w (L - s) cos theta, theta(0) = 0, theta'(L) = 0, by shooting on theta'(0); downwards is positive."""
    def shoot(slope):
        h, theta, bend, x, y = 1.0 / steps, 0.0, slope, 0.0, 0.0
        def rate(s, a, b):
            return b, -load * (1.0 - s) * math.cos(a)
        for k in range(steps):
            s = k * h
            a1, b1 = rate(s, theta, bend)
            a2, b2 = rate(s + h / 2, theta + h / 2 * a1, bend + h / 2 * b1)
            a3, b3 = rate(s + h / 2, theta + h / 2 * a2, bend + h / 2 * b2)
            a4, b4 = rate(s + h, theta + h * a3, bend + h * b3)
            new = theta + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
            middle = theta + h / 2 * a2
            x += h / 6 * (math.cos(theta) + 4 * math.cos(middle) + math.cos(new))
            y += h / 6 * (math.sin(theta) + 4 * math.sin(middle) + math.sin(new))
            theta, bend = new, bend + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
        return bend, x, y
    low, high = 0.0, load
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if shoot(middle)[0] < 0.0 else (low, middle)
    return shoot(low)[1:]


def points(folder, which):
    import h5py
    with h5py.File(sorted(glob.glob(str(folder / "fields/*.h5")))[which]) as file:
        group = file["points/beam"]
        order = group["id"][...].argsort()
        return group["position"][...][order]


def tip(folder):
    """Where the end of the middle line is: from the last two columns of points, in lengths from where the root is."""
    first, last = points(folder, 0), points(folder, -1)
    columns = sorted({round(x, 9) for x in first[:, 0]})[-2:]
    middle = [last[abs(first[:, 0] - c) < 1e-6].mean(axis=0) for c in columns]
    root = first[:, 1].mean()
    end = middle[1] + (middle[1] - middle[0]) * (LENGTH - columns[1]) / (columns[1] - columns[0])
    return end[0] / LENGTH, (root - end[1]) / LENGTH


def timoshenko(length=1.0, thick=0.1, modulus=1e9, density=1000.0, factor=5.0 / 6.0):
    """First circular frequency of a cantilever (Huang 1961), and Euler and Bernoulli's."""
    inertia, area = thick**3 / 12.0, thick
    r2, s2 = inertia / (area * length**2), modulus * inertia / (factor * area * 0.5 * modulus * length**2)
    unit = math.sqrt(modulus * inertia / (density * area * length**4))
    def equation(w):
        b = w / unit
        root = math.sqrt((r2 - s2) ** 2 + 4.0 / b**2)
        alpha, beta = math.sqrt(0.5 * (root - (r2 + s2))), math.sqrt(0.5 * (root + (r2 + s2)))
        return (2.0 + (b * b * (r2 - s2) ** 2 + 2.0) * math.cosh(b * alpha) * math.cos(b * beta)
                - b * (r2 + s2) / math.sqrt(1.0 - b * b * r2 * s2) * math.sinh(b * alpha) * math.sin(b * beta))
    low, high = unit, 3.6 * unit
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if equation(middle) > 0.0 else (low, middle)
    return low, 1.8751040687**2 * unit


def frequency(history):
    """From the crossings of the mean height with its mean over them, of which there are some."""
    t, y = history["time"], history["centre_beam_y"]
    level = y[0]
    at = [t[k] + (t[k + 1] - t[k]) * (level - y[k]) / (y[k + 1] - y[k]) for k in range(1, len(t) - 1) if (y[k] - level) * (y[k + 1] - level) < 0.0]
    return math.pi * (len(at) - 1) / (at[-1] - at[0])


def measure(page):
    page.write("", "## E6: cantilever under its weight, w L^3/(E I) = 4")
    exact_x, exact_y = elastica()
    rows = []
    for cells, bar in ((2, 5.0), (4, 1.5)):
        for solver in ("static", "stepped"):
            settings = ["domain.cell=%g" % (THICK / cells)]
            settings += ["time.solver=static", "time.increments=10"] if solver == "static" else []
            done = run("e6_cantilever", "e6_%s_%d" % (solver, cells), settings=settings)
            x, y = tip(done.folder) if done.status == 0 else (math.nan, math.nan)
            error = 100.0 * math.hypot(x - exact_x, y - exact_y) / math.hypot(exact_x - 1.0, exact_y)
            rows.append((cells, solver, "(%.4f, -%.4f)" % (x, y), "%.2f" % error, "%.1f" % done.cpu))
            page.bar("E6: tip, %d cells thick, %s, %% of its way" % (cells, solver), error, None, bar)
    page.table(("cells thick", "solver", "tip/L (exact (%.4f, -%.4f))" % (exact_x, exact_y), "error, % of its way", "CPU, s"), rows)
    exact, slender = timoshenko()
    rows = []
    for cells in (2, 4):
        done = run("e6_frequency", "e6_frequency_%d" % cells, settings=["domain.cell=%g" % (THICK / cells)])
        found = frequency(done.history()) if done.status == 0 else math.nan
        rows.append((cells, "%.2f" % found, "%.2f" % (100.0 * (found / exact - 1.0)), "%.1f" % done.cpu))
        page.bar("E6: first frequency, %d cells thick, %% off" % cells, abs(100.0 * (found / exact - 1.0)), None, 3.0)
    page.table(("cells thick", "omega, 1/s (Timoshenko %.2f, Euler and Bernoulli %.2f)" % (exact, slender), "off, %", "CPU, s"), rows)
