"""Pixels of a plane picture: cells, and points of bodies as squares that close up to a solid. An image is RGBA bytes (height,
width, 4), the lowest row first."""
from collections.abc import Iterable

import numpy

from . import colours

CLOSED = 10  # pixels: gaps between points of a body of up to twice as much are closed


def colour(values: numpy.ndarray, scale: tuple[float, float], kind: str, dark: bool) -> numpy.ndarray:
    """RGBA bytes of values; what is no number is clear."""
    low, high = scale
    part = numpy.clip((values - low) / (high - low), 0, 1)
    rgba = colours.field_map(kind, dark)(numpy.nan_to_num(part), bytes=True)
    rgba[~numpy.isfinite(part)] = 0
    return rgba


def paint_cells(image: numpy.ndarray, rgba: numpy.ndarray) -> None:
    """`rgba`: colours of cells (n, m, 4), the first along the first axis, that fill the image."""
    height, width = image.shape[:2]
    n, m = rgba.shape[:2]
    i = numpy.minimum(((numpy.arange(width) + 0.5) * n / width).astype(int), n - 1)
    j = numpy.minimum(((numpy.arange(height) + 0.5) * m / height).astype(int), m - 1)
    image[:] = rgba[i[None, :], j[:, None]]


def _spread(filled: numpy.ndarray) -> Iterable[tuple[numpy.ndarray, tuple, tuple]]:
    """For each of the four neighbours of pixels: where that one is filled, and slices to write and to read."""
    for axis in (0, 1):
        for to, of in ((slice(1, None), slice(None, -1)), (slice(None, -1), slice(1, None))):
            write, read = ((to, slice(None)), (of, slice(None))) if axis == 0 else ((slice(None), to), (slice(None), of))
            yield filled[read], write, read


def close_gaps(layer: numpy.ndarray, reach: int) -> None:
    """Fills gaps of up to twice `reach` pixels between points of a body, which stretch and are squares in the picture, with the colour beside them:
    what is painted grows by `reach` and shrinks by as much again."""
    painted = layer[..., 3] > 0
    grown = painted.copy()
    for _ in range(reach):
        before = grown.copy()
        for there, write, read in _spread(before):
            new = there & ~grown[write]
            layer[write][new] = layer[read][new]
            grown[write] |= new
    for _ in range(reach):
        before = grown.copy()
        for there, write, _read in _spread(before):
            grown[write] &= there
    layer[~(grown | painted)] = 0


def _stamp_squares(layer: numpy.ndarray, corner: numpy.ndarray, edge: int, rgba: numpy.ndarray, first: list[int]) -> None:
    """Squares of one size, those of later points over those of earlier ones; none on pixels before `first`."""
    if len(corner) < edge * edge:  # few large ones
        for at, its in zip(corner, rgba):
            x, y = numpy.maximum(at, first)
            layer[y:max(at[1] + edge, 0), x:max(at[0] + edge, 0)] = its
        return
    for dy in range(edge):
        for dx in range(edge):
            x, y = corner[:, 0] + dx, corner[:, 1] + dy
            inside = (x >= first[0]) & (x < layer.shape[1]) & (y >= first[1]) & (y < layer.shape[0])
            layer[y[inside], x[inside]] = rgba[inside]


def _mirror_below(layer: numpy.ndarray, first: list[int]) -> None:
    """Images of the first columns and rows in those before them: a body goes on beyond an axis and a mirror."""
    if first[0]:
        layer[:, :first[0]] = layer[:, 2 * first[0] - 1:first[0] - 1:-1]
    if first[1]:
        layer[:first[1]] = layer[2 * first[1] - 1:first[1] - 1:-1]


def paint_points(image: numpy.ndarray, at: numpy.ndarray, side: numpy.ndarray, rgba: numpy.ndarray, goes_on: list[bool]) -> None:
    """Squares as large as the points and half a pixel more on each side, and what lies between them: points close up to a
    solid. `at` (n, 2) and `side` (n,) are in pixels; `goes_on`: along which axes the body has an image before the first pixel."""
    height, width = image.shape[:2]
    seen = numpy.isfinite(at).all(axis=1) & numpy.isfinite(side)
    with numpy.errstate(invalid="ignore"):
        side = numpy.clip(numpy.where(seen, side, 0) + 1, 2, max(width, height))
        seen &= ((at > -side[:, None]) & (at < [width, height] + side[:, None])).all(axis=1)
    if not seen.any():
        return
    at, side, rgba = at[seen], side[seen], rgba[seen]

    reach = int(numpy.clip(numpy.median(side) // 2, 0, CLOSED))
    first = [reach + 1 if on else 0 for on in goes_on]
    layer = numpy.zeros((height + first[1], width + first[0], 4), dtype=numpy.uint8)
    corner = numpy.rint(at - 0.5 * side[:, None]).astype(int) + first
    size = numpy.rint(side).astype(int)
    for edge in numpy.unique(size):
        _stamp_squares(layer, corner[size == edge], edge, rgba[size == edge], first)

    _mirror_below(layer, first)
    close_gaps(layer, reach)
    shown = layer[first[1]:, first[0]:]
    image[shown[..., 3] > 0] = shown[shown[..., 3] > 0]
