"""What `floe` calls: `python3 DIR picture|report|plots|diff ...`, DIR the folder of this package. `floe` has looked at the arguments before.

Exit status: 0 done; 2 bad input; 4 input or output failed; 5 interrupted; 69 a package is missing.
"""
import argparse
import logging
import math
import pathlib
import sys

#: A package is missing: floe says what to install.
MISSING = 69


def _say(kind: str, text: str) -> None:
    colour = {"error": "31", "warning": "33"}[kind]
    word = f"\033[1;{colour}m{kind}:\033[0m" if sys.stderr.isatty() else f"{kind}:"
    print(f"floe: {word} {text}", file=sys.stderr)


def _warn(text: str) -> None:
    _say("warning", text)


def _range(text: str) -> tuple[float, float]:
    low, high = (float(one) for one in text.split(":"))
    return low, high


def _plane(text: str) -> tuple[str | tuple[float, ...], float]:
    axis, at = text.split("=")
    return axis if axis in ("x", "y", "z") else tuple(float(one) for one in axis.split(",")), float(at)


def _view(text: str) -> tuple[float, float]:
    azimuth, elevation = (float(one) for one in text.split(","))
    return azimuth, elevation


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="floe", description="Pictures, pages and plots of floe's results.")
    commands = parser.add_subparsers(dest="command", required=True)
    picture = commands.add_parser("picture")
    picture.add_argument("folder")
    picture.add_argument("--time", type=float, default=math.nan)
    picture.add_argument("--all", action="store_true")
    picture.add_argument("--points")
    picture.add_argument("--cells")
    picture.add_argument("--range", type=_range, action="append", default=[])
    picture.add_argument("--plane", type=_plane)
    picture.add_argument("--view", type=_view)
    picture.add_argument("--mirror", default="")
    picture.add_argument("--dark", action="store_true")
    picture.add_argument("--width", type=int, default=720)
    picture.add_argument("--output")
    report = commands.add_parser("report")
    report.add_argument("folders", nargs="+")
    report.add_argument("--output", required=True)
    report.add_argument("--time", type=float, action="append", default=[])
    report.add_argument("--title")
    report.add_argument("--version", default="")
    report.add_argument("--quiet", action="store_true")
    diff = commands.add_parser("diff")
    diff.add_argument("folders", nargs=2)
    diff.add_argument("--tolerance", type=float, default=math.nan)
    diff.add_argument("--all", action="store_true")
    plots = commands.add_parser("plots")
    plots.add_argument("folder")
    plots.add_argument("names", nargs="+")
    return parser


def _picture_name(a: argparse.Namespace, stem: str) -> pathlib.Path:
    """"DIR/pictures/000004-sigma_r-dark.png": what was asked for tells pictures of one snapshot apart."""
    parts = [stem, a.points, a.cells, f"{a.plane[0] if isinstance(a.plane[0], str) else '_'.join(format(one, 'g') for one in a.plane[0]) + '_at_'}{a.plane[1]:g}" if a.plane else None, "view_{:g}_{:g}".format(*a.view) if a.view else None, f"mirror_{a.mirror}" if a.mirror else None, "dark" if a.dark else None]
    return pathlib.Path(a.folder) / "pictures" / ("-".join(one.replace("/", "_") for one in parts if one) + ".png")


def _picture(a: argparse.Namespace) -> None:
    from . import files, snapshots
    found = snapshots.snapshots(a.folder, _warn, None if a.all or not math.isnan(a.time) else 1)
    from . import pictures  # and matplotlib, once there is something to draw
    options = pictures.Options(a.points, a.cells, a.range, a.dark, a.width, a.plane, a.mirror, a.view)
    if not a.all and not math.isnan(a.time):
        if not found[0].time * (1 - 1e-9) <= a.time <= found[-1].time * (1 + 1e-9):
            _warn(f"there are snapshots from {found[0].time:g} to {found[-1].time:g} {found[0].time_unit}, and none at {a.time:g}: the nearest is shown")
        found = [min(found, key=lambda one: abs(one.time - a.time))]
    ranges = pictures.common_ranges(pictures.make_sheet(one, options) for one in found) if a.all else None
    for one in found:
        path = pathlib.Path(a.output) if a.output else _picture_name(a, one.path.stem)
        if not a.output:
            files.make_folder(path.parent)
        pictures.write_png(one, path, options, ranges)
        print(path, flush=True)


def _report(a: argparse.Namespace) -> None:
    from . import report
    report.write(report.Request(a.folders, a.output, a.title, a.time, a.version), _warn)
    if not a.quiet:
        print(f"report: {a.output}")


def _diff(a: argparse.Namespace) -> int:
    """6: more apart than was asked for."""
    from . import differences
    found = differences.between(*a.folders, _warn)
    apart = sum(one.share > 0 for one in found.quantities)
    print(f"{found.rows} rows of history and {found.snapshots} snapshots at the same times: {len(found.quantities)} quantities, {apart} of them differ")
    for run, folder in enumerate(a.folders):
        if found.lone(run):
            print(f"only in {folder}: {found.lone(run, None if a.all else 8)}")
    if apart:
        print(found.table(None if a.all else 20))
    return 0 if math.isnan(a.tolerance) or found.share <= a.tolerance else 6


def _plots(a: argparse.Namespace) -> None:
    from . import figures
    figures.draw_files(a.folder, a.names)


def main(arguments: list[str] | None = None) -> int:
    """Runs a command; returns its exit status."""
    a = _parser().parse_args(arguments)
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # that it keeps its list of fonts elsewhere is of no interest here
    try:
        from .files import Refused
        try:
            return {"picture": _picture, "report": _report, "plots": _plots, "diff": _diff}[a.command](a) or 0
        except Refused as error:
            _say("error", str(error))
            return error.status
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] == "floe":
            raise
        return MISSING
    except KeyboardInterrupt:
        return 5
    except BrokenPipeError:
        return 4
