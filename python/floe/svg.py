"""Figures of matplotlib as SVG that stands in a page: names of its own, few bytes, colours that a page exchanges for dark readers."""
import io
import re

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from . import colours

#: Settings under which figures are made and written: text stays text, the same numbers give the same bytes.
STYLE = {"svg.fonttype": "none", "svg.hashsalt": "floe", "font.size": 12, "axes.edgecolor": colours.INK, "text.color": colours.INK,
         "axes.labelcolor": colours.INK, "xtick.color": colours.INK, "ytick.color": colours.INK, "axes.spines.top": False,
         "axes.spines.right": False, "axes.grid": True, "grid.color": colours.GRID, "grid.linewidth": 0.7, "axes.axisbelow": True,
         "axes.facecolor": "none", "figure.facecolor": "none", "legend.frameon": False, "lines.linewidth": 1.5, "lines.markersize": 5,
         "axes.linewidth": 0.8, "figure.dpi": 72, "mathtext.default": "regular", "axes.formatter.use_mathtext": True}

_HEAD = re.compile(r"<\?xml.*?\?>|<!DOCTYPE.*?>|<!--.*?-->|<metadata>.*?</metadata>|<style type=\"text/css\">.*?</style>", re.DOTALL)
_FONT = re.compile(r"font:((?: \w+)*) ([\d.]+)px [^;\"]*")
_COLOUR = re.compile(r"\b(fill|stroke): (#[0-9a-f]{6});? ?")


def _own_names(text: str, name: str) -> str:
    """Names that are referred to become the figure's own; the others go."""
    used = set(re.findall(r"(?:href=\"#|url\(#)([\w.-]+)", text))
    kept = {one: f"{name}-{k}" for k, one in enumerate(sorted(used))}
    text = re.sub(r" id=\"([\w.-]+)\"", lambda m: f' id="{kept[m[1]]}"' if m[1] in kept else "", text)
    text = re.sub(r"href=\"#([\w.-]+)\"", lambda m: f'href="#{kept[m[1]]}"', text)
    return re.sub(r"url\(#([\w.-]+)\)", lambda m: f"url(#{kept[m[1]]})", text)


def _free_colours(found: re.Match) -> str:
    """style="fill: #123456; ..." as fill="#123456" style="...", so that rules of a page can exchange it."""
    style = found[1]
    out = "".join(f' {key}="{value}"' for key, value in _COLOUR.findall(style))
    rest = _COLOUR.sub("", style).strip()
    return f'{out} style="{rest}"' if rest else out


def _shortened(found: re.Match) -> str:
    return f"{float(found[0]):.2f}".rstrip("0").rstrip(".").replace("-0", "-0" if float(found[0]) <= -0.005 else "0")


def dark_rules(selector: str) -> str:
    """Rules of CSS that exchange the colours of drawings within `selector`."""
    return "".join(f'{selector}[{what}="{light}"]{{{what}:{dark}}}' for light, dark in colours.EXCHANGED.items() for what in ("fill", "stroke"))


def inline(figure: Figure, name: str, title: str) -> str:
    """A figure as an <svg> element for a page: of class floe-plot, its names beginning with `name`."""
    out = io.BytesIO()
    FigureCanvasSVG(figure)
    with matplotlib.rc_context(STYLE):
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    text = _HEAD.sub("", out.getvalue().decode())
    head, images = text, []
    # Pictures within are left as they are.
    head = re.sub(r"\"data:image/png;base64,[^\"]*\"", lambda m: images.append(m[0].replace("\n", "")) or f'"image{len(images) - 1}"', head)
    head = _own_names(head, name)
    head = re.sub(r"<[^>]*>", lambda tag: re.sub(r"-?\d+\.\d{3,}", _shortened, tag[0]), head)  # not in texts
    head = _FONT.sub(r"font-size: \2px;\1", head).replace("; bold", "; font-weight: bold")
    head = re.sub(r" style=\"([^\"]*)\"", _free_colours, head)
    head = re.sub(r"<defs>\s*</defs>", "", head)
    head = re.sub(r"\s*\n\s*", "\n", head).strip()
    size = re.search(r"<svg [^>]*?viewBox=\"([^\"]*)\"", head)
    escaped = title.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")
    start = f'<svg class="floe-plot" role="img" viewBox="{size[1]}" xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">\n<title>{escaped}</title>'
    head = re.sub(r"<svg [^>]*>", lambda _: start, head, count=1)
    return re.sub(r"\"image(\d+)\"", lambda m: images[int(m[1])], head)


def alone(element: str) -> str:
    """The element as a file of its own: on white paper, which dark readers see dark."""
    box = re.search(r"viewBox=\"0 0 ([\d.]+) ([\d.]+)\"", element)
    rules = (f".paper{{fill:{colours.PAPER}}}.floe-plot{{font-family:sans-serif}}@media (prefers-color-scheme: dark)"
             f"{{.paper{{fill:{colours.PAPER_DARK}}}{dark_rules('')}}}")
    end = element.index("</title>") + len("</title>")
    head = element[:end].replace("<svg ", f'<svg width="{box[1]}" height="{box[2]}" ', 1)
    return f'{head}\n<style>{rules}</style><rect class="paper" width="100%" height="100%" />{element[end:]}\n'
