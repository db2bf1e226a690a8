"""test_laws.py: laws in Python against floe's own, which are the same formulas, and what they do wrong."""
import math
import pathlib

import numpy

import floe

INPUTS = pathlib.Path(__file__).resolve().parents[2] / "inputs"


class Rubber(floe.SolidLaw):
    """Compressible neo-Hookean in Young's modulus and Poisson's ratio (as examples/own_law.c)."""
    name = "my_rubber"
    doc = "neo-Hookean, by Young's modulus and Poisson's ratio"
    needs_F = True
    parameters = {"youngs_modulus": floe.Parameter("Pa", above=0, doc="E at rest"), "poissons_ratio": floe.Parameter(least=-0.9, most=0.495, default=0.3)}

    def bulk_modulus(self, par):
        return par.youngs_modulus / (3 * (1 - 2 * par.poissons_ratio))

    def shear_modulus(self, par):
        return par.youngs_modulus / (2 * (1 + par.poissons_ratio))

    def lame(self, par):
        return self.shear_modulus(par), self.bulk_modulus(par) - 2 / 3 * self.shear_modulus(par)

    def stress(self, par, batch):
        mu, lame = self.lame(par)
        b = numpy.einsum("ikn,jkn->ijn", batch.F, batch.F)
        for c, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))):
            batch.stress[c] = (mu * (b[i, j] - (i == j)) + (i == j) * lame * numpy.log(batch.J)) / batch.J

    def wave_speed(self, par, batch):
        mu, lame = self.lame(par)
        b = numpy.einsum("ikn,jkn->ijn", batch.F, batch.F)
        stretch = numpy.linalg.eigvalsh(b.transpose(2, 0, 1))[:, -1]
        return numpy.sqrt((mu * stretch + numpy.maximum(mu + lame * (1 - numpy.log(batch.J)), 0)) / batch.rho0)

    def strain_energy(self, par, batch):
        mu, lame = self.lame(par)
        log = numpy.log(batch.J)
        return 0.5 * mu * ((batch.F ** 2).sum(axis=(0, 1)) - 3) - mu * log + 0.5 * lame * log ** 2


class Metal(floe.SolidLaw):
    """Linear elastic in rates of strain without rotation, and the greatest pressure that a point has seen."""
    name = "my_metal"
    parameters = {"bulk_modulus": floe.Parameter("Pa", above=0), "shear_modulus": floe.Parameter("Pa", least=0)}
    history = {"greatest_pressure": ("Pa", "the greatest so far")}

    def bulk_modulus(self, par):
        return par.bulk_modulus

    def shear_modulus(self, par):
        return par.shear_modulus

    def stress(self, par, batch):
        rate = 0.5 * (batch.L + batch.L.transpose(1, 0, 2))
        volume = numpy.trace(rate)
        for c, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))):
            batch.stress[c] += batch.dt * (2 * par.shear_modulus * rate[i, j] + (i == j) * (par.bulk_modulus - 2 / 3 * par.shear_modulus) * volume)
        batch.history[0] = numpy.maximum(batch.history[0], -batch.stress[:3].mean(axis=0))

    def wave_speed(self, par, batch):
        return numpy.full(batch.n, math.sqrt((par.bulk_modulus + 4 / 3 * par.shear_modulus) / batch.rho0.min()))


class Gas(floe.EquationOfState):
    """The ideal gas."""
    name = "my_gas"
    parameters = {"gamma": floe.Parameter(least=1.001, most=20, default=1.4), "specific_heat": floe.Parameter("J/kg/K", above=0)}

    def pressure(self, par, rho, e):
        p = (par.gamma - 1) * rho * e
        return p, par.gamma * p / rho

    def temperature(self, par, rho, e):
        return e / par.specific_heat

    def energy(self, par, rho, T):
        return par.specific_heat * T

    def volume(self, par, p, T):
        v = (par.gamma - 1) * par.specific_heat * T / p
        return v, -v / p

    def dpde(self, par, rho, e):
        return (par.gamma - 1) * rho

    def heat(self, par, rho, e):
        return par.specific_heat, par.specific_heat / e

    def pressure_floor(self, par):
        return 0

    def energy_floor(self, par, rho):
        return 0

    def check(self, par):
        return "a gamma of 3 is of no gas" if par.gamma == 3 else None


BLOCKS = """
floe: 1
coupling: mpm
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.1 m}
boundaries: {x: symmetry, y: symmetry}
materials: {block: {density: 1100 kg/m^3, law: {my_rubber: {youngs_modulus: 1.2 MPa, poissons_ratio: 0.2}}}}
bodies:
  left: {material: block, shape: {box: {lower: [0.2, 0.3], upper: [0.5, 0.7]}}, velocity: [8 m/s, 3 m/s]}
  right: {material: block, shape: {box: {lower: [0.5, 0.3], upper: [0.8, 0.7]}}, velocity: [-4 m/s, 0 m/s]}
time: {end: 20 ms, fixed_step: 0.4 ms}
"""
# K = E / (3 (1 - 2 nu)), G = E / (2 (1 + nu))
FLOES = {"materials.block.law": "{neo_hookean: {bulk_modulus: 666666.66666666663 Pa, shear_modulus: 0.5 MPa}}"}

BAR = """
floe: 1
coupling: mpm
domain: {dim: 1, stress_state: uniaxial_strain, lower: 0 m, upper: 1 m, cell: 0.05 m}
boundaries: {x: free}
materials: {metal: {density: 8000 kg/m^3, law: {my_metal: {bulk_modulus: 140 GPa, shear_modulus: 80 GPa}}}}
bodies:
  left: {material: metal, shape: {box: {lower: 0.2 m, upper: 0.5 m}}, velocity: 60 m/s}
  right: {material: metal, shape: {box: {lower: 0.5 m, upper: 0.8 m}}}
time: {end: 20 us}
"""


def refused(kind, words, function, *arguments, **more):
    try:
        function(*arguments, **more)
    except kind as error:
        assert words in str(error), str(error)
        return
    raise AssertionError(f"{words}: not refused")


def test_solid():
    """Two blocks that meet move as with floe's law of the same formula (8e-15 of the largest stress was measured)."""
    found = []
    for settings, laws in ((FLOES, ()), (None, [Rubber()])):
        with floe.Scene(text=BLOCKS, settings=settings, laws=laws) as scene:
            scene.advance()
            found.append((scene.points["left"].copy("stress_xx"), scene.totals().strain_energy))
    (floes, energy), (own, own_energy) = found
    assert abs(floes).max() > 1e3 and abs(own - floes).max() <= 1e-12 * abs(floes).max(), abs(own - floes).max() / abs(floes).max()
    assert abs(own_energy - energy) <= 1e-12 * energy


def test_history():
    """A wave in a bar: the greatest pressure of a plane wave is that of both impedances, rho c U / 2, here with K as the stress is -(K + 4/3 G) strain."""
    with floe.Scene(text=BAR, laws=[Metal()]) as scene:
        scene.advance()
        left = scene.points["left"]
        greatest, unit = left.copy("greatest_pressure"), left.unit("greatest_pressure")
        modulus = 140e9 + 4 / 3 * 80e9
        front = math.sqrt(8000 * modulus) * 30 * 140e9 / modulus  # the pressure in it
        middle = abs(left.copy("position") - 0.45) < 0.03
        assert unit == "Pa" and abs(greatest[middle].mean() / front - 1) < 0.1, greatest[middle] / front


class Warm(Metal):
    """Stress by the temperature alone, which its points remember, and the step."""
    name = "my_warm"
    needs_temperature = True
    history = {"met": ("K", "the temperature that the law was told"), "step": ("s", "the step that the law was told")}

    def stress(self, par, batch):
        batch.stress[:3] = -1e4 * (batch.temperature - 300)
        batch.stress[3:] = 0
        batch.history[0], batch.history[1] = batch.temperature, batch.dt


def test_temperature():
    """A law that needs the temperature is told that of its points, which the deck gives; without the word it is told none."""
    settings = {"materials.metal": {"density": 8000, "specific_heat": 400, "law": {"my_warm": {"bulk_modulus": 1.4e11, "shear_modulus": 8e10}}},
                "bodies.left.temperature": 310, "bodies.right.temperature": 290}
    with floe.Scene(text=BAR, settings=settings, laws=[Warm()]) as scene:
        scene.step()
        for name, temperature in (("left", 310), ("right", 290)):
            points = scene.points[name]
            assert abs(points.copy("met") - temperature).max() < 1e-9 and abs(points.copy("stress_xx") + 1e4 * (temperature - 300)).max() < 1e-3
    refused(floe.InputError, "specific_heat", floe.Scene, text=BAR, settings={"materials.metal.law": settings["materials.metal"]["law"]}, laws=[Warm()])


class Creep(Metal):
    """Metal, which remembers the step that it was told."""
    name = "my_creep"
    needs_time = True
    history = {"step": ("s", "the step that the law was told")}

    def stress(self, par, batch):
        met = batch.dt
        super().stress(par, batch)
        batch.history[0] = met


def test_time():
    """A law that needs the time has that of the deck's increments in static steps; without the word it has 1 s."""
    for needs, step in ((True, 5e-6), (False, 1)):
        law = type("Asked", (Creep,), {"needs_time": needs})()
        settings = {"materials.metal.law": {"my_creep": {"bulk_modulus": 1.4e11, "shear_modulus": 8e10}}, "boundaries.x": "symmetry", "bodies.right": None,
                    "bodies.left": {"material": "metal", "shape": {"box": {"lower": 0, "upper": 1}}}, "time": {"end": "20 us", "solver": "static", "increments": 4}}
        with floe.Scene(text=BAR, settings=settings, laws=[law]) as scene:
            scene.advance()
            assert abs(scene.points["left"].copy("step") / step - 1).max() < 1e-9, scene.points["left"].copy("step")


def test_fluid():
    """Sod's tube on cells and as points, as with floe's ideal gas (8e-15 was measured)."""
    for coupling, read in (("ice", lambda s: s.cells.copy("density_gas")), ("mpm", lambda s: s.points["left"].copy("stress_xx"))):
        found = []
        for law in ({}, {"materials.gas.eos": {"my_gas": {"specific_heat": 1}}}):
            with floe.Scene(INPUTS / "sod.yaml", settings={**law, "coupling": coupling, "verify": None, "domain.cell": 0.02}, laws=[Gas()]) as scene:
                scene.advance()
                found.append(read(scene))
        assert abs(found[0] - found[1]).max() < 1e-13, abs(found[0] - found[1]).max()


def test_refusals():
    """Parameters out of range, names that are taken, what `check` says, and what is no law."""
    rubber = {"materials.block.law": {"my_rubber": {"youngs_modulus": -1}}}
    refused(floe.InputError, "youngs_modulus", floe.Scene, text=BLOCKS, settings=rubber, laws=[Rubber()])
    refused(floe.InputError, "0.495", floe.Scene, text=BLOCKS, settings={"materials.block.law.my_rubber.poissons_ratio": 0.5}, laws=[Rubber()])
    refused(floe.InputError, "my_rubber", floe.Scene, text=BLOCKS)
    refused(floe.InputError, "already", floe.Scene, text=BLOCKS, laws=[type("Taken", (Rubber,), {"name": "neo_hookean"})()])
    refused(floe.InputError, "letters", floe.Scene, text=BLOCKS, laws=[type("Odd", (Rubber,), {"parameters": {"a b": floe.Parameter()}})()])
    refused(floe.InputError, "a gamma of 3 is of no gas", floe.Scene, INPUTS / "sod.yaml", laws=[Gas()],
            settings={"materials.gas.eos": {"my_gas": {"specific_heat": 1, "gamma": 3}}, "verify": None})
    refused(TypeError, "neither a floe.SolidLaw nor", floe.Scene, text=BLOCKS, laws=[object()])
    refused(ValueError, "stands alone", floe.Scene, text=BLOCKS, laws=[type("Range", (Rubber,), {"parameters": {"a": floe.Parameter(above=1)}})()])


def test_failures():
    """What a law raises comes out of the call; a law that is beyond a point has the step repeated, and in vain it diverges."""
    def broken(**functions):
        return [type("Broken", (Rubber,), functions)()]

    def fails(*_):
        raise KeyError("mine")

    for name in ("stress", "wave_speed", "bulk_modulus", "shear_modulus", "strain_energy"):
        def whole(name=name):
            with floe.Scene(text=BLOCKS, settings={"time.fixed_step": None}, laws=broken(**{name: fails})) as scene:
                scene.step()
                scene.totals()
        refused(KeyError, "mine", whole)
    with floe.Scene(text=BLOCKS, laws=broken(stress=lambda law, par, batch: 0)) as scene:
        refused(floe.Diverged, "", scene.step)
    with floe.Scene(text=BLOCKS, laws=broken(stress=lambda law, par, batch: 3 / 0)) as scene:
        refused(ZeroDivisionError, "division", scene.step)
    refused(KeyError, "mine", floe.Scene, INPUTS / "sod.yaml", laws=[type("Bad", (Gas,), {"pressure": fails})()],
            settings={"materials.gas.eos": {"my_gas": {"specific_heat": 1}}, "verify": None})


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print(name, "ok")
