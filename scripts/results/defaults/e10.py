"""Row E10: water hammer in a rigid and in elastic tubes with air outside, about the axis."""
import math

import h5py
import numpy
import rows

SPEED, DENSITY, GAMMA, P_INF, BORE = 0.02, 1000.0, 4.4, 5e8, 0.05


def wave_speed(young, outer, pressure):
    """Korteweg's, of a thick wall with nu = 0; young None: rigid."""
    square = GAMMA * (pressure + P_INF) / DENSITY
    if young is None:
        return math.sqrt(square)
    return math.sqrt(square / (1 + 2 * DENSITY * square / young * (outer**2 + BORE**2) / (outer**2 - BORE**2)))


def plateau(run, speed, pressure):
    """Section mean of p - p0 over rho c u from 1/4 to 2/3 of the way to the front, in the last snapshot."""
    with h5py.File(sorted((run.folder / "fields").glob("*.h5"))[-1]) as file:
        cells = file["cells"]
        p = numpy.squeeze(cells["pressure_water" if "pressure_water" in cells else "pressure"][...])
        time = float(file.attrs["time"])
        h = file.attrs["cell"]
    r, z = (numpy.arange(p.shape[1]) + 0.5) * h[0], (numpy.arange(p.shape[0]) + 0.5) * h[1]
    weight = numpy.where(r < BORE, r, 0.0)
    section = (p - pressure) @ weight / weight.sum() / (DENSITY * speed * SPEED)
    return section[(z > speed * time / 4) & (z < 2 * speed * time / 3)].mean()


def measure(page):
    page.write("", "## E10: water hammer in tubes of points", "",
               "Section mean of the pressure behind the front over rho c u (Joukowsky, Korteweg). Tubes of 0.05 m bore, h = 5 mm; the rigid one has a modulus of 2e13 Pa. "
               "The softest is 2 m long and looked at after 0.8 ms: Korteweg's plateau is that of a tube in balance, and the tube breathes about it (0.98, 0.96, 0.99 at 0.3, 0.5, 0.7 ms).")
    cases = [("rigid, 4 cells", None, 0.07, 1e5, 1e-4, 1), ("200 GPa, 4 cells", 2e11, 0.07, 1e5, 2e-4, 1), ("200 GPa, 2 cells", 2e11, 0.06, 1e5, 2e-4, 1),
             ("200 GPa, 4 cells", 2e11, 0.07, 1.01325e7, 2e-4, 1), ("70 GPa, 4 cells", 7e10, 0.07, 1e5, 8e-4, 2)]
    table = []
    for number, (name, young, outer, pressure, end, length) in enumerate(cases):
        modulus = young or 2e13
        done = rows.run("e10_hammer", f"e10_{number}", settings=[
            f"materials.wall.law.linear_elastic.bulk_modulus={modulus / 3!r}", f"materials.wall.law.linear_elastic.shear_modulus={modulus / 2!r}",
            f"domain.upper=[0.1, {length}]", f"bodies.tube.shape.box.upper=[{outer}, {length}]", f"bodies.water.shape.box.upper=[0.05, {length}]",
            f"ambient.pressure={pressure!r}", f"bodies.water.pressure={pressure!r}",
            f"reference_pressure={pressure!r}", f"time.end={end!r}"])
        share = plateau(done, wave_speed(young, outer, pressure), pressure) if done.status == 0 else math.nan
        table.append((name, f"{pressure / 1e5:g}", f"{share:.4f}", f"{done.cpu:.1f}"))
        page.bar(f"E10 {name}, {pressure / 1e5:g} bar: plateau over rho c u", share, 0.97, 1.03)
    page.table(("tube", "reference, bar", "plateau / (rho c u)", "CPU, s"), table)
