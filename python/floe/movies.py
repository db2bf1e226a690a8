"""Movies of a run: its pictures through time, all with the same ranges.

    floe.movie(floe.Result("out/cylinder-ice-mpm"), "von_mises")                        # pictures/von_mises.gif in the run's folder
    floe.movie(result, cells="density_air", points="none", path="air.webp", seconds=6)

GIF and WebP are written by Pillow; .mp4 needs ffmpeg.
"""
import io
import pathlib
import shutil
import subprocess

import PIL.Image

from . import files, pictures, snapshots
from .files import Refused
from .results import Result


def _with_ffmpeg(frames: list[bytes], rate: float) -> bytes:
    """MP4 (H.264) of PNGs. Its width and height have to be even."""
    if not shutil.which("ffmpeg"):
        raise Refused("a movie as .mp4 needs ffmpeg; .gif and .webp do not", 2)
    import tempfile
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "movie.mp4"
        command = ["ffmpeg", "-loglevel", "error", "-f", "image2pipe", "-framerate", f"{rate:g}", "-i", "-", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                   "-pix_fmt", "yuv420p", str(out)]
        done = subprocess.run(command, input=b"".join(frames), stderr=subprocess.PIPE, check=False)
        if done.returncode != 0:
            raise Refused(f"ffmpeg has failed: {done.stderr.decode(errors='replace').strip()}")
        return out.read_bytes()


def _with_pillow(frames: list[bytes], kind: str, rate: float) -> bytes:
    images = [PIL.Image.open(io.BytesIO(one)).convert("RGB") for one in frames]
    if kind == "gif":
        images = [one.quantize(256, dither=PIL.Image.Dither.NONE) for one in images]
    out = io.BytesIO()
    images[0].save(out, format=kind, save_all=True, append_images=images[1:], duration=round(1000 / rate), loop=0)
    return out.getvalue()


def movie(result: Result, points: str | None = None, cells: str | None = None, path: pathlib.Path | str | None = None, seconds: float = 5.0, **more) -> pathlib.Path:
    """Writes a movie of `seconds` (at most 30 pictures a second), and returns its path. `points` and `cells` are fields as of `floe picture`,
    `more` any other of `pictures.Options`; without a path it goes to the run's `pictures`, as GIF."""
    options = pictures.Options(points, cells, **more)
    found = snapshots.snapshots(result.folder, lambda text: None)
    target = pathlib.Path(path) if path else result.folder / "pictures" / f"{points or cells or 'movie'}.gif"
    kind = target.suffix.lstrip(".").lower()
    if kind not in ("gif", "webp", "mp4"):
        raise Refused(f"'{target}': a movie is .gif, .webp or .mp4", 2)
    ranges = pictures.common_ranges(pictures.make_sheet(one, options) for one in found)
    frames = [pictures.png(pictures.sheet_figure(pictures.make_sheet(one, options), ranges)) for one in found]
    rate = min(30.0, max(1.0, len(frames) / seconds))
    if not path:
        files.make_folder(target.parent)
    files.replace(target, _with_ffmpeg(frames, rate) if kind == "mp4" else _with_pillow(frames, kind, rate))
    return target
