"""Every deck with its picture. With GALLERY_KEEP=1 a picture that is there is kept, so that a new deck costs its own run alone."""
import os

from places import ROOT

TITLE = "Gallery: every deck and its picture"

# What a deck needs for a short run and a telling picture, by its name: words of `floe run`, words of `floe picture`, what is seen. A deck
# that is not here is run as it stands.
PICTURES = {
    "acoustic_pulse": ("", "", "pressure"),
    "airbag_200": ("--set time.end=0.04", "-w 300", "stress of the bag and the cylinder at 40 ms"),
    "airbag_500": ("--set time.end=0.02", "-w 300", "stress of the bag and the cylinder at 20 ms"),
    "airbag_inflator": ("", "-t 0.03 -c pressure", "the bag filled, and the pressure in it and about it, at 30 ms"),
    "annulus_traction": ("--set domain.cell=0.05", "", "von Mises stress under an outward traction"),
    "ball_net": ("", "-t 2.5 -r 0:200", "the net throws the ball back, t = 2.5"),
    "bar_mms": ("", "-p stress_xx -c none", "stress of the driven bar"),
    "bar_vibration": ("", "-p velocity_x -c none", "velocity"),
    "burning_block": ("", "-t 9e-4 -p mass_share -c pressure", "share of the points that is left, and the pressure, when half is burnt"),
    "cell_crossing": ("", "-p velocity_x -c none", "velocity"),
    "closed_box": ("", "", "pressure"),
    "closed_vessel_burn": ("", "-c pressure", "pressure, the same everywhere"),
    "couette": ("", "-c velocity_gas_x", "velocity"),
    "cylinder_channel": ("", "-c velocity_liquid_x", "velocity along the channel"),
    "double_mach": ("--set constants.h=0.00833333333333333333", "-c density_gas", "density at t = 0.2"),
    "flow_mms": ("", "", "pressure"),
    "fluid_stream": ("", "-c density_water", "density of water"),
    "fluid_tube": ("", "", "pressure"),
    "foam_wall": ("", "--view -60,25 --mirror y -t 4e-3", "stress of the wall, and pressure on the sides of the domain, after 4 ms"),
    "free_stream": ("", "", "pressure: what is even stays even"),
    "gas_expansion": ("", "-c none", "pressure of the points"),
    "heat_wave": ("", "-c density_gas", "density"),
    "heated_vessel": ("", "-c density_air", "density: the hot air in the middle is thin"),
    "hydrostatic_column": ("", "", "pressure"),
    "isentropic_vortex": ("", "-c density_gas", "density"),
    "lid_cavity": ("", "-c velocity_liquid", "speed"),
    "low_mach_channel": ("", "-c velocity_gas_x", "velocity along x"),
    "low_mach_vortex": ("", "-c velocity_gas_x", "velocity along x"),
    "membrane_balloon": ("--coupling ice-mpm", "", "a balloon about its axis at rest: stress of the membrane and pressure of the gas"),
    "membrane_circle": ("", "", "stress of the membrane and pressure of the gas"),
    "membrane_dogbone": ("--set domain.cell=0.1 --set time.end=1", "-w 260", "the slack contour fills"),
    "membrane_patch": ("", "-p velocity_x -c none", "velocity of a taut sheet drawn out between two supports"),
    "membrane_revolved": ("", "", "a dog-bone of revolution at rest: stress of the membrane and pressure of the gas"),
    "membrane_sphere": ("", "", "an eighth of a balloon: stress of the membrane and pressure of the gas"),
    "membrane_tube": ("", "", "a quarter of a tube: stress of the membrane and pressure of the gas"),
    "moving_walls": ("", "-p velocity_x -c pressure", "pressure of the gas between the walls"),
    "natural_convection": ("--set domain.cell=0.07", "--mirror x -c density_air", "density: air rises from the warm rod and sinks along the case"),
    "noh": ("", "-c density_gas", "density"),
    "pendulum": ("", "-t 0.5 -c none", "tension of the string, t = 0.5"),
    "piston_container": ("", "-p pressure -c none", "pressure"),
    "piston_membrane": ("", "-c density_fluid", "density of the fluid behind the sheet"),
    "piston_wave": ("", "", "pressure"),
    "poiseuille": ("--set domain.cell=0.125", "-c velocity_liquid_x", "velocity"),
    "pressed_cylinder": ("--set domain.cell=0.025", "-p stress_yy -c none -r -14000:0", "stress across the contact of a cylinder on a block"),
    "pressurized_cylinder": ("--coupling ice-mpm", "-p sigma_theta -c pressure", "hoop stress of the steel, pressure of the gas"),
    "pressurized_sphere": ("", "-p stress_tt -c pressure", "hoop stress of the steel, pressure of the gas"),
    "pulse_leaves": ("", "-t 0.4", "pressure, t = 0.4"),
    "relaxation": ("", "-c velocity_light_x", "velocity of one of two gases, the same everywhere"),
    "riemann": ("", "-c density_gas", "density"),
    "ring_mms": ("--set domain.cell=0.05", "-p velocity_x -c none", "velocity along x of the driven ring"),
    "sedov": ("", "-c density_gas", "density"),
    "shock_plate": ("", "-p stress_xx -c pressure", "the shock that comes back, and the wave in the plate"),
    "slip_wall": ("", "-c velocity_air_x", "velocity of the gas along an oblique wall"),
    "sod": ("--coupling ice", "-c density_gas", "density"),
    "spring_mass": ("", "-t 0.0101 -c none", "tension at the lowest point"),
    "stability_line": ("", "-p velocity_x -c none", "velocity"),
    "stiff_cylinder": ("", "-p sigma_theta -c pressure", "hoop stress of a ring a hundred times as stiff as steel, sub-stepped"),
    "string_mass": ("", "-t 0.0202 -c none", "tension of the string, t = 0.02"),
    "taylor_bar": ("", "", "von Mises stress"),
    "taylor_green": ("", "-c velocity_liquid_x", "velocity along x"),
    "turek_hron_csm": ("", "-c none", "von Mises stress of a flag that hangs from a clamp by its own weight"),
    "turek_hron_fsi": ("", "-c velocity_liquid_x -p none", "velocity along the channel, at rest about the flag that has bent"),
    "two_bags": ("", "", "stress of two bags at rest, and the density of the air about them"),
    "two_bars": ("", "-t 0.25", "von Mises stress while they touch"),
    "water_impact": ("", "-p velocity_x -c pressure", "pressure of the water before and behind the block"),
}


def title_of(path):
    return next(line.split(":", 1)[1].strip() for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("title:"))


def picture(page, path):
    name, deck = path.stem, str(path.relative_to(ROOT))
    running, drawing, seen = PICTURES.get(name, ("", "", ""))
    page.write(f"## {title_of(path)}", "", f"`{deck}`{': ' + seen if seen else ''}.", "",
               "    " + " ".join(["floe run", deck, *running.split(), "-o", f"out/{name}"]), "    " + " ".join(["floe picture", f"out/{name}", "--width 400", *drawing.split()]))
    if os.environ.get("GALLERY_KEEP") and (ROOT / f"docs/results/gallery-{name}.png").is_file():
        page.kept = True
        page.write("", f"![{name}](gallery-{name}.png)", "")
        return
    run = page.run(deck, name, once=True, more=running.split())
    if run.status != 0:
        raise RuntimeError(f"{deck}: exit status {run.status}")
    page.drawn(run, f"gallery-{name}", name, "--width", 400, *drawing.split(), said=False)


def make(page):
    page.beside = True
    page.write("Each deck of `inputs/`, run from a cold start by the command beside it, on one thread; what lasts long is run to an earlier end or on a",
               "coarser mesh than the deck says.", "")
    decks = sorted((ROOT / "inputs").glob("*.yaml"))
    for path in decks:
        picture(page, path)
    for old in (ROOT / "docs/results").glob("gallery-*.png"):
        if old.stem.partition("-")[2] not in {path.stem for path in decks}:
            old.unlink()
