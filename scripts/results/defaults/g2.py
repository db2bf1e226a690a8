"""G2: the Hugoniot curve of bubbly water, which runs against a wall."""
import math

import h5py
import numpy

from rows import run

P0, T0 = 1e5, 300.0
WATER, AIR = (4.4, 6e8, 588.3333), (1.4, 0.0, 717.5)  # gamma, p_inf, c_v


def volume0(law):
    g, stiff, cv = law
    return (g - 1.0) * cv * T0 / (P0 + stiff)


def volume(law, p):
    """On the Hugoniot curve from p_0 of a stiffened gas by itself."""
    g, stiff, _ = law
    a, b = P0 + stiff, p + stiff
    return volume0(law) * ((g + 1.0) * a + (g - 1.0) * b) / ((g - 1.0) * a + (g + 1.0) * b)


def exact(theta, speed):
    """Pressure at the wall, speed of the shock that runs away from it, and how much hotter the air is."""
    water, air = (1.0 - theta) / volume0(WATER), theta / volume0(AIR)
    v0 = 1.0 / (water + air)

    def mean(p):
        return v0 * (water * volume(WATER, p) + air * volume(AIR, p))
    low, high = P0 * (1.0 + 1e-12), 1e13
    for _ in range(400):
        p = math.sqrt(low * high)
        low, high = (low, p) if (p - P0) * (v0 - mean(p)) > speed * speed else (p, high)
    return p, speed * mean(p) / (v0 - mean(p)), p * volume(AIR, p) / (P0 * volume0(AIR))


def measured(theta, speed, n):
    p, shock, hot = exact(theta, speed)
    end = 0.6 / shock
    result = run("g2_bubbly", "g2/%g-%g-%d" % (theta, speed, n), settings=[
        "domain.cell=%r" % (1.0 / n), "time.end=%r" % end, "bodies.water.fraction=%r" % (1.0 - theta), "bodies.water.velocity=[%r]" % -speed,
        "bodies.air.velocity=[%r]" % -speed])
    last = sorted((result.folder / "fields").glob("*.h5"))[-1]
    with h5py.File(last, "r") as file:
        pressure = numpy.array(file["cells/pressure"]).ravel()
        T = numpy.array(file["cells/temperature_air"]).ravel()
    behind = slice(int(0.15 * n), int(0.45 * n))
    found = float(pressure[behind].mean())
    half = 0.5 * (found + P0)
    i = int(numpy.nonzero(pressure > half)[0].max())
    place = (i + 0.5 + (pressure[i] - half) / (pressure[i] - pressure[i + 1])) / n
    return (p, hot, 100.0 * (found / p - 1.0), 100.0 * (place / end / shock - 1.0), float(T[behind].mean()) / T0,
            result.summary()["conservation"]["energy"])


def measure(page):
    rows, worst = [], 0.0
    for theta, speed in ((0.3, 50.0), (0.1, 50.0), (0.01, 50.0), (0.001, 50.0), (0.1, 200.0), (0.5, 20.0), (0.01, 5.0)):
        p, hot, dp, ds, T, drift = measured(theta, speed, 400)
        if speed > 5.0:
            worst = max(worst, abs(dp), abs(ds))
        rows.append(("%g" % theta, "%g" % speed, "%.0f" % (p / P0), "%+.2f" % dp, "%+.2f" % ds, "%.1f" % hot, "%.1f" % T, "%.0e" % drift))
    page.write("", "### G2: bubbly water against a wall", "",
               "Water with air by a share of the volume runs against a wall, 400 cells. Exact: each material on its own Hugoniot curve. At 5 m/s the sensor "
               "of shocks hardly sees it.")
    page.table(("air", "speed, m/s", "p/p0, exact", "p, % off", "shock, % off", "T of the air over T0, exact", "measured", "energy"), rows)
    page.bar("G2 bubbly water, 20 m/s and more: pressure and speed off by at most, %", worst, None, 2.0)
