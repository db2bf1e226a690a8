"""E7: solids that are all but incompressible."""
import glob

from rows import run

RATIOS = ((0.33, 1.0), (0.49, 18.625), (0.4999, 1874.625))  # Poisson's ratio, bulk modulus beside a shear modulus of 0.375
STATIC = ("time.solver=static", "time.end=1", "output.interval=1", "damping=null")
COOK = (("plane strain, 0.4999", (), 1e-6, (("middle", 52.0, 7.40), ("corner", 60.0, 7.77))),
        ("plane stress, 1/3", ("domain.stress_state=plane_stress", "materials.rubber.law={linear_elastic: {bulk_modulus: 1, shear_modulus: 0.375}}",
                               "loads.shear.body_force.acceleration=[0, 2.4886584575502268e-7]"), 1e-6, (("middle", 52.0, 23.96), ("corner", 60.0, 25.14))))


def error(done, name):
    value = done.summary()["errors"][name]
    return value["value"] if isinstance(value, dict) else value


def cylinders(page, how, extra):
    rows = []
    for h in (0.1, 0.05):
        plain = {}
        for nu, bulk in RATIOS:
            done = run("e7_cylinder", f"e7/{how}-{nu}-{h}", settings=(f"domain.cell={h}", f"materials.rubber.law.linear_elastic.bulk_modulus={bulk}",
                                                                      f"verify.exact.lame.bulk_modulus={bulk}", *extra))
            found = {name: error(done, name) for name in ("l1rel_sigma_r", "l1rel_sigma_theta", "l1rel_displacement_x")}
            plain = plain or found
            rows.append((how, h, nu, *(f"{100 * value:.2f} %" for value in found.values()), f"{done.cpu:.1f}"))
            if found is plain:
                continue
            for name, what in (("l1rel_sigma_r", "radial"), ("l1rel_sigma_theta", "hoop")):
                page.bar(f"E7 cylinder, {how}, h = {h}, Poisson's ratio {nu}: error of the {what} stress over that at 0.33", found[name] / plain[name], None, 1.5)
    return rows


def rise(folder, height):
    """How far the loaded side has gone up at a height: a cubic through the points of the strip."""
    import h5py
    import numpy
    places = []
    for name in (min, max):
        with h5py.File(name(glob.glob(str(folder / "fields/*.h5")))) as file:
            group = file["points/strip"]
            places.append(group["position"][...][group["id"][...].argsort()][:, 1])
    return float(numpy.polyval(numpy.polyfit(places[0], places[1] - places[0], 3), height))


def measure(page):
    page.write("## E7: solids that are all but incompressible", "",
               "Lamé's thick cylinder, damped to rest in explicit steps and in static balance; means over the points of a norm, relative.", "")
    page.table(("solver", "h", "Poisson's ratio", "radial stress", "hoop stress", "displacement", "CPU, s"), cylinders(page, "dynamic", ()) + cylinders(page, "static", STATIC))
    page.write("", "Cook's membrane in static balance (`inputs/defaults/e7_cook.yaml`), over published values.", "")
    rows = []
    for name, settings, load, places in COOK:
        for h in (2, 1):
            done = run("e7_cook", f"e7/cook-{name[6:12]}-{h}".replace(" ", "-"), settings=(f"domain.cell={h}", *settings))
            for place, height, published in places:
                found = rise(done.folder, height) / load
                rows.append((name, h, place, f"{found:.3f}", published, f"{done.cpu:.1f}"))
                if h == 1:
                    page.bar(f"E7 Cook's membrane, {name}, h = 1: {place} of the loaded side over that published", found / published, 0.98, 1.02)
    page.table(("state and Poisson's ratio", "h", "where", "rise", "published", "CPU, s"), rows)
