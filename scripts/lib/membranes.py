"""Rows of membranes that gas blows up to their exact rest: errors of means over the last tenth of the time."""
import floe

HEADER = ("h", "r at 0, 90 degrees", "error, %", "area, %", "roundness, %", "p", "error, %", "hoop stress", "error, %", "gas outside", "energy, %", "drift, %")
EXPLAINED = ("Errors are those of means over the last tenth of the time. Pressure: what all gas holds, over the area inside. *Roundness*: r at 0 degrees over that at 90. *Energy*: its change from",
             "start to end.")


def late(run, name):
    """Mean of a column of the history over the last tenth of the time."""
    history = run.result.history
    time = history["time"].values
    return float(history[name].values[time >= 0.9 * time[-1]].mean())


def largest(run, name, offset=0.0):
    """The largest |value - offset| of a column."""
    return float(abs(run.result.history[name].values - offset).max())


class Rest:
    """What a run leaves of the rest; shares in per cent."""

    def __init__(self, run):
        history = run.result.history
        energy = sum(history[name].values for name in ("kinetic", "strain", "internal"))
        self.radii = late(run, "first_skin_x"), late(run, "last_skin_y")
        self.pressure, self.stress, self.outside = late(run, "pressure_in_skin"), late(run, "stress_skin"), late(run, "outside_skin")
        self.radius_errors = tuple(100 * run.error(f"hlate_{name}") for name in ("radius", "radius_last"))
        self.area_error, self.pressure_error, self.stress_error = (100 * run.error(f"hlate_{name}") for name in ("area", "pressure", "hoop_stress"))
        self.roundness = 100 * abs(self.radii[0] / self.radii[1] - 1)
        self.change, self.drift = 100 * float(energy[-1] / energy[0] - 1), 100 * largest(run, "drift_energy")

    @property
    def worst(self):
        """The largest error of radii, pressure and stress."""
        return max(*self.radius_errors, self.pressure_error, self.stress_error)

    def row(self, h):
        return (h, ", ".join(f"{r:.5g}" for r in self.radii), ", ".join(floe.figure(e) for e in self.radius_errors), floe.figure(self.area_error), f"{self.roundness:.3f}",
                f"{self.pressure:.5g}", floe.figure(self.pressure_error), f"{self.stress:.5g}", floe.figure(self.stress_error), floe.figure(self.outside), f"{self.change:.3f}",
                f"{self.drift:.3f}")
