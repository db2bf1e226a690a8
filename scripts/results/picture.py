"""The pictures of the README: hoop stress of the steel and pressure of the gas at rest, the gas as points and on cells."""
import floe

TITLE = "The pressurised cylinder at rest, in pictures"
DECK = "inputs/pressurized_cylinder.yaml"
WORDS = ("--points", "sigma_theta", "--cells", "pressure", "--range", "10e6:35e6", "--range", "0:20e6")


def make(page):
    page.write("Hoop stress of the steel and pressure of the gas, both in Pa; the exact hoop stress falls from 32.3 MPa at the bore to 12.9 MPa outside. Errors are on the page [a1](a1.md).", "")
    for coupling, said in (("mpm", "The gas as material points"), ("ice-mpm", "The gas on cells")):
        run = page.run(DECK, coupling, coupling, once=True)
        page.write(f"## {said} (`{coupling}`, eq. 13: {floe.percent(run.error('eq13'))})")
        page.drawn(run, f"cylinder-{coupling}", said, *WORDS)
