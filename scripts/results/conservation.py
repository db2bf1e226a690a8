"""What must stay as it is: free stream, closed box, column at rest."""
import math

TITLE = "What must stay as it is"


def rows_of(scene, cases, metrics=()):
    for row in cases.rows:
        errors = ", ".join(f"{metric} {float(row[metric]):.1e}" for metric in metrics)
        yield (scene, row["coupling"], row["steps"], *(f"{float(row['drift_' + q]):.1e}" for q in ("mass", "momentum", "energy")), errors)


def make(page):
    stream = page.cases("compare", "stream", "inputs/free_stream.yaml", "--repeat", 0)
    box = page.cases("compare", "box", "inputs/closed_box.yaml", "--repeat", 0)
    column = page.cases("compare", "column", "inputs/hydrostatic_column.yaml", "--repeat", 0)
    sound = math.sqrt(1.4 * 101325 / 1.2)

    def of(cases, name):
        return float(cases.numbers(name, coupling="ice")[0])

    page.bar("free stream, ice: largest change of velocity over the speed", of(stream, "linf_velocity_x") / math.hypot(30, 20), "<=", 1e-14, "{:.1e}")
    page.bar("free stream, ice: largest change of pressure, relative", of(stream, "linf_pressure") / 101325, "<=", 1e-14, "{:.1e}")
    page.bar("closed box, ice: drift of mass", of(box, "drift_mass"), "<=", 1e-12, "{:.1e}")
    page.bar("closed box, ice: drift of energy", of(box, "drift_energy"), "<=", 1e-12, "{:.1e}")
    page.bar("column at rest, ice: max abs(u) / c after 1000 steps", of(column, "linf_velocity_x") / sound, "<=", 1e-12, "{:.1e}")
    page.write("Constants must stay constant, closed boxes closed, and columns at rest. A drift is |Q - Q0 - what the ledger says| over the",
               "largest sum of |q|.", "", "## Bars")
    page.show_bars()
    page.write("## Figures")
    page.table(("scene", "coupling", "steps", "drift of mass", "drift of momentum", "drift of energy", "errors (SI)"),
               [*rows_of("free stream (36 m/s, 0.1 MPa)", stream, ("linf_velocity_x", "linf_velocity_y", "linf_density", "linf_pressure")),
                *rows_of("closed box (3:1 in pressure)", box), *rows_of("column at rest (1000 m of air)", column, ("linf_velocity_x", "linf_pressure"))])
    page.write("The column starts from the discrete balance, whose pressure differs from the exact atmosphere by the truncation error shown;",
               "what counts is that it does not move. Its momentum is round-off of round-off, hence its relative drift. Points keep mass and momentum to round-off; "
               "their energy drifts, most where shocks run,", "as in the box, whose deck gives points no artificial viscosity.", "",
               "Exchange between materials (K up to 1e20), numbers of blocks and threads, and resumed runs are held to round-off or to the",
               "same bits by the tests (`unit_exchange`, `verification_*_bits`, `cli_resume`).")
