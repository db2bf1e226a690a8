"""The pictures of the README: hoop stress of the steel and pressure of the gas at rest, the gas as points and on cells; a blast in space that moves."""
import floe

from places import ROOT

TITLE = "The pressurised cylinder at rest, in pictures"
DECK = "inputs/pressurized_cylinder.yaml"
WALL = "inputs/foam_wall.yaml"
WORDS = ("--points", "sigma_theta", "--cells", "pressure", "--range", "10e6:35e6", "--range", "0:20e6")


def make(page):
    page.write("Hoop stress of the steel and pressure of the gas, both in Pa; the exact hoop stress falls from 32.3 MPa at the bore to 12.9 MPa outside. Errors are on the page [a1](a1.md).", "")
    for coupling, said in (("mpm", "The gas as material points"), ("ice-mpm", "The gas on cells")):
        run = page.run(DECK, coupling, coupling, once=True)
        page.write(f"## {said} (`{coupling}`, eq. 13: {floe.percent(run.error('eq13'))})")
        page.drawn(run, f"cylinder-{coupling}", said, *WORDS)
    run = page.run(WALL, "wall", once=True)
    view = {"view": (-60, 25), "mirror": "y", "width": 480, "ranges": [(0, 150e3), (50e3, 200e3)]}
    floe.movie(floe.Result(run.folder), "von_mises", cells="pressure", path=ROOT / "docs/results/foam-wall.webp", **view)
    page.write("## A wall of foam in a blast", "", "Stress of the wall, and pressure on the sides of the domain, half of which is computed.", "", "![A wall of foam in a blast](foam-wall.webp)")
