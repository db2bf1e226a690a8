"""Viscosity, conduction, walls and open sides of the cells; the lid-driven cavity."""
import math

import numpy
from floe import plots
from ghia_1982 import LINES
from order_table import order_bar, order_table, time_column

TITLE = "Viscosity, conduction and sides, on the cells"
HALVES = ["--axis", "domain.cell=0.125,0.0625,0.03125"]
PIPE = ["domain.geometry=axisymmetric", "domain.upper=[1, 0.5]", "boundaries={r: {upper: no_slip}, z: periodic}", "bodies.liquid.shape={box: {lower: [0, 0], upper: [1, 0.5]}}",
        "loads.drive.gravity.acceleration=[0, 0.4]", "verify.exact={pipe_flow: {radius: 1, force: 0.4, density: 1, viscosity: 0.1, pressure: 1}}",
        "verify.metrics=[l1_velocity_y, linf_velocity_y]"]
ANNULUS = ["domain.geometry=axisymmetric", "domain.lower=[0.5, 0]", "domain.upper=[1.5, 0.5]", "bodies.gas.shape={box: {lower: [0.5, 0], upper: [1.5, 0.5]}}",
           "boundaries={r: {lower: {no_slip: {velocity: [0, 0.8], temperature: 1.2}}, upper: {no_slip: {temperature: 1}}}, z: periodic}",
           "verify.exact={annulus_hot: {inner_radius: 0.5, outer_radius: 1.5, speed: 0.8, pressure: 1, heat_capacity: 2.5, viscosity: 0.16, conductivity: 0.6, "
           "inner_temperature: 1.2, outer_temperature: 1}}", "verify.metrics=[l1_velocity_y, l1_temperature, l1_density, l1_pressure]"]
SOUND_SPEED = "materials.liquid.eos.acoustic.sound_speed"
THOUSAND = ["materials.liquid.viscosity.shear=0.001", "time.end=100"]


def compared(page, folder, deck, settings=(), more=()):
    """A comparison along the deck's axis or another one."""
    return page.cases("compare", folder, f"inputs/{deck}.yaml", *(word for one in settings for word in ("--set", one)), *more)


def shown(page, cases, *metrics):
    order_table(page, cases, "ice", metrics, last=[time_column(cases, "ice")])


def flows(page):
    """Every comparison with its bars; their tables come later."""
    all_cases = {}

    def case(name, deck, bars, settings=(), more=()):
        all_cases[name] = compared(page, name, deck, settings, more)
        for what, metric, limit in bars:
            order_bar(page, what, all_cases[name], "ice", metric, limit)

    case("couette", "couette", [("Couette between hot and cold plates, Mach 0.6: order of temperature", "l1_temperature", 1.9)], (), HALVES)
    case("poiseuille", "poiseuille", [("Poiseuille: order of velocity", "l1_velocity_x", 1.9)], (), HALVES)
    case("pipe", "poiseuille", [("Pipe, about its axis: order of velocity", "l1_velocity_y", 1.9)], PIPE, HALVES)
    case("annulus", "couette", [("Annulus, hot core that slides, Mach 0.6: order of temperature", "l1_temperature", 1.9),
                                ("Annulus, hot core that slides, Mach 0.6: order of velocity", "l1_velocity_y", 1.9)], ANNULUS, HALVES)
    case("green-sound", "taylor_green", [("Taylor-Green, Mach 1/80, 16 to 64 cells: order of velocity", "l1_velocity_x", 1.9)], [f"{SOUND_SPEED}=80"])
    case("green", "taylor_green", [("Taylor-Green, Mach 1/320, 32 to 128 cells: order of velocity", "l1_velocity_x", 1.9)],
         ["method.pressure=implicit", "method.centring=half", f"{SOUND_SPEED}=320"], ["--axis", "domain.cell=0.03125,0.015625,0.0078125"])
    case("green-slow", "taylor_green", [], [f"{SOUND_SPEED}=8", "verify.exact.taylor_green.speed=0.1"])
    case("green-mach", "taylor_green", [], (), ["--axis", f"{SOUND_SPEED}=10,20,40"])
    case("heat", "heat_wave", [("heat that diffuses in a gas: order of temperature", "l1_temperature", 1.9)])
    case("sound", "heat_wave", [("damped sound: order of velocity", "l1_velocity_x", 1.9)], ["verify.exact.damped_wave.thermal=0"])
    case("mms", "flow_mms", [("manufactured flow, Mach 0.5: order of velocity", "l1_velocity_x", 1.9), ("manufactured flow, Mach 0.5: order of temperature", "l1_temperature", 1.9)])
    case("piston", "piston_wave", [("side that draws at 0.3 c: order of density", "l1_density", 1.8)])
    return all_cases


def sent_back(cases, amplitude):
    """What comes back of a pulse, over its amplitude in pressure, at each spacing."""
    return [error / (1.4 * amplitude) for error in cases.numbers("linf_pressure", coupling="ice")]


def sides(page):
    shares = {said: sent_back(compared(page, folder, "pulse_leaves", settings), amplitude) for said, folder, amplitude, settings in (
        ("`non_reflecting`, pulse of 0.001 c", "pulse-weak", 0.001, []),
        ("`non_reflecting`, pulse of 0.05 c", "pulse-strong", 0.05, ["verify.exact.simple_wave.amplitude=0.05"]),
        ("`free`", "pulse-free", 0.001, ["boundaries.x.upper=free"]),
        ("`outlet`", "pulse-outlet", 0.001, ["boundaries.x.upper={outlet: {pressure: 1}}"]))}
    page.bar("pulse of sound out of a tube, eight cells a standard deviation: share sent back", 100 * shares["`non_reflecting`, pulse of 0.001 c"][1], "<=", 1, "{:.2g}", " %")
    return shares


def centre_lines(run, cells):
    """{"u": (y, velocity along x on x = 1/2), "v": (x, velocity along y on y = 1/2)}, walls and lid included."""
    velocity, half = run.result.at(math.inf).field("velocity_liquid").values, cells // 2
    place = numpy.concatenate(([0], (numpy.arange(cells) + 0.5) / cells, [1]))
    u, v = (velocity[half - 1, :, 0] + velocity[half, :, 0]) / 2, (velocity[:, half - 1, 1] + velocity[:, half, 1]) / 2
    return {"u": (place, numpy.concatenate(([0], u, [1]))), "v": (place, numpy.concatenate(([0], v, [0])))}


def ghia(reynolds):
    """Ghia's velocities on both lines: {line: (places, velocities)}."""
    return {name: (numpy.array(line["place"]), numpy.array(line[reynolds])) for name, line in LINES.items()}


def deviation(lines, published, line):
    """The largest one from Ghia, inside."""
    place, value = published[line]
    inside = (place > 0) & (place < 1)
    return float(abs(numpy.interp(place[inside], *lines[line]) - value[inside]).max())


def cavity(page):
    rows, finest = [], {}
    for reynolds, settings in ((100, []), (1000, THOUSAND)):
        for cells in (32, 64):
            run = page.run("inputs/lid_cavity.yaml", f"re_{reynolds}-{cells}", None, [f"domain.cell={1 / cells:g}", *settings], once=True)
            finest[reynolds] = centre_lines(run, cells)
            apart = [deviation(finest[reynolds], ghia(reynolds), line) for line in ("u", "v")]
            rows.append((reynolds, f"{cells} x {cells}", *(f"{value:.4f}" for value in apart)))
        page.bar(f"cavity, Reynolds number {reynolds}, 64 x 64: largest deviation of u from Ghia et al.", apart[0], "<=", {100: 0.01, 1000: 0.03}[reynolds], "{:.4f}")
    return rows, finest


def cavity_figures(page, finest):
    dots = {"linestyle": "", "fillstyle": "none"}
    for reynolds, lines in finest.items():
        said, series = ghia(reynolds), {}
        for line, colour, name in (("u", "#1060b0", "u over y"), ("v", "#c03020", "v over x")):
            series[f"{name}, floe"] = (*lines[line], {"marker": "", "color": colour})
            series[f"{name}, Ghia et al."] = (*said[line], {**dots, "marker": "o" if line == "u" else "s", "color": colour})
        plots.lines(page.picture(f"re_{reynolds}", f"Reynolds number {reynolds}"), series, "place on the centre line", "velocity over that of the lid",
                    f"Reynolds number {reynolds}, 64 x 64 cells")


def taylor_green(page, flow):
    page.write("## Taylor-Green vortices", "", "Against the exact solution of incompressible flow. At Mach 1/320, by the implicit pressure at the midpoint of the step:")
    shown(page, flow["green"], "l1_velocity_x", "l1_velocity_y")
    page.write("Explicit, at Mach 1/80:")
    shown(page, flow["green-sound"], "l1_velocity_x")
    page.write("A tenth of the speed at the same Mach number, where viscosity is all there is:")
    shown(page, flow["green-slow"], "l1_velocity_x")
    page.write("The order of the coarse meshes is not the one of the step, nor of a limiter (there is none): slow vortices have order 2, and at",
               "full speed the damping of advection, of third order and of the other sign, hides part of the error of viscosity while cells",
               "are large. At Mach 1/80 the difference of compressible and incompressible flow, 2e-6, then hides part of the fall on fine meshes.", "",
               "On 32 x 32 cells, by the sound speed over the greatest speed: what is left falls with the square of the Mach number to the error of the mesh.")
    page.table(("sound speed", "l1_velocity_x"), list(zip(flow["green-mach"].texts(SOUND_SPEED), (f"{error:.3e}" for error in flow["green-mach"].numbers("l1_velocity_x")))))


def make(page):
    flow, shares = flows(page), sides(page)
    rows, finest = cavity(page)
    page.write("Errors against exact solutions of the equations that are solved, under refinement in space and time together; L1 of cell averages. CPU: processor time of the",
               "steps; *: others used the machine meanwhile.", "", "## Bars")
    page.show_bars()
    page.write("## Couette flow between a cold plate and a hot one that moves", "", "Ideal gas at Mach 0.6, heated by its own shear, from the exact flow to the discrete one.")
    shown(page, flow["couette"], "l1_velocity_x", "l1_temperature", "l1_density", "l1_pressure")
    page.write("## Poiseuille flow", "", "Off by a constant, h^2/4 of the curvature at the walls.")
    shown(page, flow["poiseuille"], "l1_velocity_x", "linf_velocity_x")
    page.write("## About an axis", "", "Along a pipe of radius 1:")
    shown(page, flow["pipe"], "l1_velocity_y", "linf_velocity_y")
    page.write("An ideal gas between a hot core of radius 0.5 that slides and a cold tube of radius 1.5:")
    shown(page, flow["annulus"], "l1_velocity_y", "l1_temperature", "l1_density", "l1_pressure")
    taylor_green(page, flow)
    page.write("## Heat that diffuses in a gas, and sound that it damps", "", "Small plane waves, roots of the dispersion relation. Heat:")
    shown(page, flow["heat"], "l1_temperature", "l1_density", "l1_velocity_x", "l1_pressure")
    page.write("Sound:")
    shown(page, flow["sound"], "l1_temperature", "l1_density", "l1_velocity_x", "l1_pressure")
    page.write("## Manufactured flow", "", "Viscous, heat-conducting, unsteady, compressible, held by a force and a heat source.")
    shown(page, flow["mms"], "l1_density", "l1_velocity_x", "l1_velocity_y", "l1_pressure", "l1_temperature")
    page.write("## Lid-driven cavity", "", "Largest deviation from the velocities of Ghia, Ghia and Shin (1982) on the centre lines, over that of the lid:")
    page.table(("Reynolds number", "cells", "u over y", "v over x"), rows)
    cavity_figures(page, finest)
    page.write("## Sides", "", "What comes back of a pulse that leaves a tube, in per cent of it, with 4, 8 and 16 cells a standard deviation:")
    page.table(("side", "h = 0.02", "0.01", "0.005"), [(said, *(f"{100 * share:.3g} %" for share in values)) for said, values in shares.items()])
    page.write("A round wave that leaves a square sends back up to 15 % of what meets the sides near the corners, at 45 degrees",
               "(`verification_ice_sides`): the condition is one-dimensional, and (1 - cos a)/(1 + cos a) is 17 % there.", "",
               "A side whose velocity follows time, drawing at 0.3 c, against the simple wave:")
    shown(page, flow["piston"], "l1_density", "l1_velocity_x", "l1_pressure")
