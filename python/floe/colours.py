"""Colours: of curves, which colour-blind readers can tell apart, and of fields, whose lightness tells the order."""
import matplotlib
from matplotlib.colors import Colormap, LinearSegmentedColormap

#: Of curves, on light paper and on dark (after M. Okabe and K. Ito 2008); a page exchanges one for the other.
SERIES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#444b55", "#56a0d3", "#a03020"]
SERIES_DARK = ["#56b4e9", "#ff8a3d", "#2fc79a", "#e9a3c9", "#f0e442", "#c3c9d1", "#8cc4f0", "#ff9d8f"]
MARKERS = "os^Dv<>PX*"

INK, PAPER, GRID, POINT = "#1f2328", "#ffffff", "#d8dee4", "#9aa2ac"
INK_DARK, PAPER_DARK, GRID_DARK, POINT_DARK = "#e6edf3", "#15181d", "#30363d", "#7d8590"

#: What a page, or a drawing that stands alone, exchanges for dark readers.
EXCHANGED = dict(zip([INK, GRID, *SERIES], [INK_DARK, GRID_DARK, *SERIES_DARK]))

_MAPS = {"single": "viridis", "warm": "YlOrRd", "cool": "PuBu", "grey": "Greys", "signed": "RdBu_r"}
_DARK_SIGNED = ["#bfe4ff", "#3f97d6", "#1c1f24", "#d8741f", "#ffe0b8"]


def field_map(kind: str, dark: bool = False) -> Colormap:
    """A map for fields: `single`, `warm` and `cool` for two in one picture, `grey` beside a `signed` one. On dark paper low
    values are dark."""
    if kind == "signed" and dark:
        return LinearSegmentedColormap.from_list("floe", _DARK_SIGNED)
    name = _MAPS[kind]
    return matplotlib.colormaps[name + ("_r" if dark and kind in ("warm", "cool", "grey") else "")]
