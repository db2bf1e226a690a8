"""Orders on smooth flow and on a vibrating bar."""
from order_table import order_bar, order_table, time_column

TITLE = "Smooth flow and a vibrating bar: orders"


def make(page):
    pulse = page.cases("compare", "pulse", "inputs/acoustic_pulse.yaml", "--axis", "domain.cell=0.02,0.01,0.005,0.0025")
    order_bar(page, "ice: acoustic pulse, order of density", pulse, "ice", "l1_density", 1.9)
    vortex = page.cases("compare", "vortex", "inputs/isentropic_vortex.yaml")
    order_bar(page, "ice: isentropic vortex, 64 to 256 cells, unlimited, order of density", vortex, "ice", "l1_density", 1.9)
    limited = page.cases("compare", "vortex-limited", "inputs/isentropic_vortex.yaml", "--set", "method.limiter=default")
    order_bar(page, "ice: isentropic vortex, 64 to 256 cells, default limiter, order of density", limited, "ice", "l1_density", 1.7)
    bars = {}
    for basis in ("quadratic", "gimp", "linear"):
        bars[basis] = page.cases("compare", f"bar-{basis}", "inputs/bar_vibration.yaml", "--set", f"method.basis={basis}")
        if basis != "linear":
            order_bar(page, f"mpm: vibrating bar, {basis}, order of velocity", bars[basis], "mpm", "l1_velocity_x", 1.8)
            order_bar(page, f"mpm: vibrating bar, {basis}, order of stress", bars[basis], "mpm", "l1_stress_xx", 1.8)
    page.write("Errors against exact solutions under refinement in space and time together. L1 is the mean of |x - x_exact|, of cell",
               "averages (ice) or at points (mpm); orders are slopes in log-log, with their standard errors. CPU: processor time of the steps; *: others used",
               "the machine meanwhile.", "", "## Bars")
    page.show_bars()
    page.write("## Acoustic pulse, by ICE", "", "A pulse of amplitude 1e-6 runs once around a periodic line; unlimited.")
    order_table(page, pulse, "ice", ("l1_density", "l1_velocity_x", "l1_pressure"), last=[time_column(pulse, "ice")])
    page.write("## Isentropic vortex, by ICE", "", "Carried along the diagonal of a periodic square of 64, 128 and 256 cells a side. Unlimited:")
    fields = ("l1_density", "l1_velocity_x", "l1_velocity_y", "l1_pressure")
    order_table(page, vortex, "ice", fields, last=[time_column(vortex, "ice")])
    page.write("With the default limiter:")
    order_table(page, limited, "ice", fields, last=[time_column(limited, "ice")])
    page.write("## Clamped bar, by points", "",
               "The first mode of a bar held at both ends, at a strain of 3e-6, two points a cell. As long as points tile their cells, as they",
               "do at this strain, the GIMP weights of points at the quarters of a cell are those of the linear basis. Its gradient is",
               "constant in a cell and so second order at the cell centre only; read off at the points, stress is first order.", "")
    for basis, cases in bars.items():
        page.write(f"{basis}:")
        order_table(page, cases, "mpm", ("l1_velocity_x", "l1_stress_xx"), last=[time_column(cases, "mpm")])
