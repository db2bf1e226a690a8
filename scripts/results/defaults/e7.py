"""E7: solids that are all but incompressible."""
from rows import run

RATIOS = ((0.33, 1.0), (0.49, 18.625), (0.4999, 1874.625))  # Poisson's ratio, bulk modulus beside a shear modulus of 0.375


def error(done, name):
    value = done.summary()["errors"][name]
    return value["value"] if isinstance(value, dict) else value


def measure(page):
    page.write("## E7: solids that are all but incompressible", "",
               "Lamé's thick cylinder, damped to rest in explicit steps; means over the points of a norm, relative.", "")
    rows = []
    for h in (0.1, 0.05):
        plain = {}
        for nu, bulk in RATIOS[:3 if h == 0.1 else 2]:
            done = run("e7_cylinder", f"e7/{nu}-{h}", settings=(f"domain.cell={h}", f"materials.rubber.law.linear_elastic.bulk_modulus={bulk}",
                                                                f"verify.exact.lame.bulk_modulus={bulk}"))
            found = {name: error(done, name) for name in ("l1rel_sigma_r", "l1rel_sigma_theta", "l1rel_displacement_x")}
            plain = plain or found
            rows.append((h, nu, *(f"{100 * value:.2f} %" for value in found.values()), f"{done.cpu:.1f}"))
            if found is plain:
                continue
            for name, what in (("l1rel_sigma_r", "radial"), ("l1rel_sigma_theta", "hoop")):
                page.bar(f"E7 cylinder, h = {h}, Poisson's ratio {nu}: error of the {what} stress over that at 0.33", found[name] / plain[name], None, 1.5)
    page.table(("h", "Poisson's ratio", "radial stress", "hoop stress", "displacement", "CPU, s"), rows)
