"""E12: Taylor's bar of copper about the axis and in three dimensions."""
import glob
import math

from rows import run


def shape(folder, axis):
    """Length along an axis and largest radius across it (mm), to the edges of the points' volumes."""
    import h5py
    with h5py.File(sorted(glob.glob(str(folder / "fields/*.h5")))[-1]) as file, \
            h5py.File(sorted(glob.glob(str(folder / "fields/*.h5")))[0]) as start:
        last, first = file["points/bar"], start["points/bar"]
        x, x0 = last["position"][...][last["id"][...].argsort()], first["position"][...][first["id"][...].argsort()]
    def radius(p):
        return abs(p[:, 0]) if axis == 1 else (p[:, 0] ** 2 + p[:, 1] ** 2) ** 0.5
    # A point beside the surface lies half a spacing inside at the start; it is moved with the stretch there.
    top = x0[:, axis].argsort()[-1]
    length = x[top, axis] + (32.4e-3 - x0[top, axis])
    rim = radius(x).argsort()[-1]
    return 1e3 * length, 1e3 * radius(x)[rim] * 3.2e-3 / radius(x0)[rim] if radius(x0)[rim] > 2.4e-3 else math.nan


def measure(page):
    page.write("", "## E12: Taylor's bar, 227 m/s, 80 us")
    rows = []
    for name, deck, axis, settings in (("(r, z), h = 0.8 mm", "e12_taylor_rz", 1, ["domain.cell=0.8 mm"]), ("(r, z), h = 0.4 mm", "e12_taylor_rz", 1, []),
                                       ("3-D, h = 0.8 mm", "e12_taylor_3d", 2, [])):
        done = run(deck, "e12_%d_%d" % (axis, len(settings)), settings=settings)
        length, radius = shape(done.folder, axis) if done.status == 0 else (math.nan, math.nan)
        rows.append((name, "%.2f" % length, "%.2f" % radius, "%.1f" % done.cpu))
        if name.endswith("0.4 mm") or axis == 2:
            page.bar("E12: length, %s, mm" % name, length, 21.2, 21.7)
            page.bar("E12: largest radius, %s, mm" % name, radius, 6.9, 7.25)
    page.table(("mesh", "length, mm", "largest radius, mm", "CPU, s"), rows)
