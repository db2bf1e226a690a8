"""Results of floe in Python: result folders, tables of cases, Markdown, and plots of one style.

    import floe
    result = floe.Result("out/sod-ice")
    result.summary["errors"]["l1_density"]
    snapshot = result.at(0.1)
    density = snapshot.field("density_gas")   # density.values[i, j, k], density.unit
    stress = snapshot.points("ring", "stress_xx")
    cases = floe.Cases("out/sod-compare")
    floe.order(cases.numbers("h", coupling="ice"), cases.numbers("l1_density", coupling="ice"))

Needs numpy and h5py; `floe.plots` needs matplotlib as well and is imported on its own.
"""
from .results import Quantity, Result, Snapshot
from .cases import Cases, order
from .tables import figure, markdown, percent

__all__ = ["Cases", "Quantity", "Result", "Snapshot", "figure", "markdown", "order", "percent"]
