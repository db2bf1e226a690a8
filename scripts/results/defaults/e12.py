"""E12: Taylor's bar of copper about the axis and in three dimensions, beside finite elements of its own (e12_elements.py)."""
import glob
import math

from rows import run

RADIUS, LENGTH = 3.2, 32.4  # mm
# Length and largest radius (mm) and largest plastic strain by `e12_elements.py 4 8 16`, elements in the radius; on a wall that lets go, and on one that holds.
ELEMENTS = {True: {4: (21.47, 7.19, 3.4), 8: (21.47, 7.30, 4.1), 16: (21.46, 7.35, 4.6)},
            False: {4: (21.43, 7.10, 3.0), 8: (21.42, 7.17, 3.2)}}


def shape(folder, axis):
    """Length along an axis and radius of the edge of the foot (mm), and the largest plastic strain.

    Points lie inside of the edge, which has not moved with the stretch of the circles there (2.2) but with that of the radius (0.8): radii of the points near the
    edge are continued to it, as a polynomial of second degree of where they were."""
    import h5py
    import numpy as np
    with h5py.File(sorted(glob.glob(str(folder / "fields/*.h5")))[-1]) as file, \
            h5py.File(sorted(glob.glob(str(folder / "fields/*.h5")))[0]) as start:
        last, first = file["points/bar"], start["points/bar"]
        x, x0 = 1e3 * last["position"][...][last["id"][...].argsort()], 1e3 * first["position"][...][first["id"][...].argsort()]
        plastic = last["plastic_strain"][...].max()
    def radius(p):
        return abs(p[:, 0]) if axis == 1 else (p[:, 0] ** 2 + p[:, 1] ** 2) ** 0.5
    top = x0[:, axis].argsort()[-1]  # half a spacing inside, where nothing is strained
    length = x[top, axis] + (LENGTH - x0[top, axis])
    inward, up = radius(x0) - RADIUS, x0[:, axis]
    near = (inward > -1.2) & (up < 1.2)
    terms = np.stack((up**0, inward, up, inward**2, up**2, inward * up), axis=1)
    return length, np.linalg.lstsq(terms[near], radius(x)[near], rcond=None)[0][0], plastic


def measure(page):
    page.write("", "## E12: Taylor's bar, 227 m/s, 80 us",
               "", "Elements are bilinear, about the axis, and share nothing with floe but the law (`scripts/results/defaults/e12_elements.py`). The foot's edge lifts off a wall that "
               "lets go; most published programs hold it.", "")
    rows, radii = [], {}
    for name, deck, axis, holds, cells, settings in (
            ("(r, z), h = 0.8 mm", "e12_taylor_rz", 1, False, 4, ["domain.cell=0.8 mm"]),
            ("(r, z), h = 0.4 mm", "e12_taylor_rz", 1, False, 8, []),
            ("3-D, h = 0.8 mm", "e12_taylor_3d", 2, False, 4, []),
            ("(r, z), h = 0.4 mm, wall holds", "e12_taylor_rz", 1, True, 8, ["boundaries.z.lower=symmetry"])):
        done = run(deck, "e12_%d_%d_%d" % (axis, cells, holds), settings=settings)
        length, radius, plastic = shape(done.folder, axis) if done.status == 0 else (math.nan, math.nan, math.nan)
        rows.append((name, "%.2f" % length, "%.2f" % radius, "%.1f" % plastic, "%.1f" % done.cpu))
        if name != "(r, z), h = 0.8 mm":
            page.bar("E12: length, %s, mm" % name, length, 21.2, 21.7)
            page.bar("E12: largest radius, %s, mm" % name, radius, 6.9, 7.25)
        radii[axis, cells, holds] = radius
        if axis == 1:
            page.bar("E12: largest radius, %s, over that of as many elements" % name, radius / ELEMENTS[not holds][cells][1], 0.98, 1.02)
    page.bar("E12: largest radius, h = 0.8 mm, 3-D over (r, z)", radii[2, 4, False] / radii[1, 4, False], 0.99, 1.01)
    for lets_go, by_number in ELEMENTS.items():
        for number, (length, radius, plastic) in by_number.items():
            rows.append(("elements, %d in the radius%s" % (number, "" if lets_go else ", wall holds"), "%.2f" % length, "%.2f" % radius, "%.1f" % plastic, "-"))
    page.table(("mesh", "length, mm", "largest radius, mm", "largest plastic strain", "CPU, s"), rows)
