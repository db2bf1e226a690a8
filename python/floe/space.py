"""Scenes in 3-D as they are seen from a side: points as one shaded surface, cells on a plane or on the far sides of the domain.

Points are drawn as balls of their size into a map of depths; the map is smoothed where it has no jump, so that the balls of a body close to a
surface, and shaded by its slope. Parallel lines stay parallel (orthographic): lengths may be compared. Called by floe.pictures.
"""
import math

import numpy
import PIL.Image

from . import colours, planes

_LIGHT = numpy.array([-0.45, 0.55, 0.70]) / numpy.linalg.norm([-0.45, 0.55, 0.70])  # from the left, above, in front of the paper
_RADIUS = 4                                                                        # of a point, in pixels of the map of depths, at most
_BALL = 0.75                                                                       # radius of a point over its edge: stretched bodies stay closed
_MANY = 60000                                                                      # points, of which those within are left out
_ROUNDS = 24                                                                       # of the mean over neighbours that closes balls to a surface


class Camera:
    """Where from: azimuth (from x towards y) and elevation in degrees. Pictures have u to the right, v upwards, and a depth towards who looks."""

    def __init__(self, view: tuple[float, float], lower: numpy.ndarray, upper: numpy.ndarray):
        a, e = math.radians(view[0]), math.radians(view[1])
        self.frame = numpy.array([[-math.sin(a), math.cos(a), 0.0], [-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e)],
                                  [math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)]])
        self.corners = numpy.array([[(lower, upper)[i >> k & 1][k] for k in range(3)] for i in range(8)])
        seen = self.corners @ self.frame.T
        self.low, self.high = seen.min(axis=0), seen.max(axis=0)

    @property
    def aspect(self) -> float:
        """Width over height of what is seen."""
        return float((self.high[0] - self.low[0]) / (self.high[1] - self.low[1]))

    def far_side(self, axis: int) -> int:
        """Of the two sides across an axis the one behind: 0 the lower, 1 the upper."""
        return 0 if self.frame[2][axis] > 0 else 1


class Map:
    """Depths and colours of a surface, in pixels of its own; row 0 is the lowest. Points have a radius of some pixels in it, whatever the picture's."""

    def __init__(self, camera: Camera, most: int, edge: float):
        self.camera = camera
        self.scale = min(most / (camera.high[0] - camera.low[0]), _RADIUS / (_BALL * edge))
        size = (camera.high - camera.low) * self.scale
        self.width, self.height = max(2, round(size[0])), max(2, round(size[1]))
        self.depth = numpy.full((self.height, self.width), -numpy.inf, dtype=numpy.float32)
        self.colour = numpy.zeros((self.height, self.width, 3), dtype=numpy.float32)

    def add_balls(self, position: numpy.ndarray, edge: numpy.ndarray, rgb: numpy.ndarray) -> None:
        """The nearest ball in each pixel."""
        at = (position @ self.camera.frame.T - self.camera.low) * self.scale
        order = numpy.argsort(at[:, 2], kind="stable")  # far ones first: of several in one pixel the last one stays
        at, rgb = at[order], rgb[order]
        radius = numpy.maximum(_BALL * edge[order] * self.scale, 1.0)
        reach = math.ceil(min(float(radius.max()), 3 * _RADIUS))
        column, row = numpy.rint(at[:, 0]).astype(int), numpy.rint(at[:, 1]).astype(int)
        for dy in range(-reach, reach + 1):
            for dx in range(-reach, reach + 1):
                inside = radius ** 2 - dx * dx - dy * dy
                kept = (inside >= 0) & (column + dx >= 0) & (column + dx < self.width) & (row + dy >= 0) & (row + dy < self.height)
                z, x, y = (at[kept, 2] + numpy.sqrt(inside[kept])).astype(numpy.float32), column[kept] + dx, row[kept] + dy
                nearer = z > self.depth[y, x]
                self.depth[y[nearer], x[nearer]], self.colour[y[nearer], x[nearer]] = z[nearer], rgb[kept][nearer]

    def shaded(self, jump: float, light: float) -> tuple[numpy.ndarray, numpy.ndarray]:
        """RGBA (0 to 1) of the surface as light falls on it, and its depth in lengths. `jump` (a length) is a step to another surface; `light` is
        what is not shaded."""
        there, jump = numpy.isfinite(self.depth), jump * self.scale
        z, colour = numpy.where(there, self.depth, 0), self.colour
        for k in range(_ROUNDS):
            z, mean = self._mean(z, colour, there, jump)
            colour = mean if k < _ROUNDS // 3 else colour  # values are not spread over more than a point
        slope = [self._slope(z, there, axis, jump) for axis in (1, 0)]
        facing = (_LIGHT[2] - slope[0] * _LIGHT[0] - slope[1] * _LIGHT[1]) / numpy.sqrt(1 + slope[0] ** 2 + slope[1] ** 2)
        shade = light + (1.12 - light) * numpy.clip(facing, 0, 1)
        return numpy.concatenate([numpy.clip(colour * shade[..., None], 0, 1), there[..., None]], axis=-1), numpy.where(there, z / self.scale, -1e30)

    @staticmethod
    def _beside(z, there, axis, jump):
        """Neighbours along an axis on either side: (their index shift, whether they are of the same surface, their depth)."""
        for shift in (1, -1):
            other = numpy.roll(z, shift, axis)
            yield shift, there & numpy.roll(there, shift, axis) & (abs(other - z) < jump), other

    def _mean(self, z, colour, there, jump):
        total, total_colour, weight = z.copy(), colour.copy(), numpy.ones_like(z)
        for axis in (0, 1):
            for shift, same, other in self._beside(z, there, axis, jump):
                total += same * other
                total_colour += same[..., None] * numpy.roll(colour, shift, axis)
                weight += same
        return total / weight, total_colour / weight[..., None]

    def _slope(self, z, there, axis, jump):
        total, count = numpy.zeros_like(z), numpy.zeros_like(z)
        for shift, same, other in self._beside(z, there, axis, jump):
            total += same * (z - other) * shift
            count += same
        return total / numpy.maximum(count, 1)


def _resized(image: numpy.ndarray, width: int, height: int) -> numpy.ndarray:
    """An image of one or more channels in another size."""
    layers = image if image.ndim == 3 else image[..., None]
    made = [numpy.asarray(PIL.Image.fromarray(layers[..., k].astype(numpy.float32)).resize((width, height), PIL.Image.Resampling.BILINEAR)) for k in range(layers.shape[2])]
    return numpy.stack(made, axis=-1) if image.ndim == 3 else made[0]


class Canvas:
    """What is painted, nearest on top; row 0 is the lowest."""

    def __init__(self, camera: Camera, width: int):
        self.camera, self.width, self.height = camera, width, max(2, round(width / camera.aspect))
        self.depth = numpy.full((self.height, self.width), -numpy.inf)
        self.rgba = numpy.zeros((self.height, self.width, 4))

    def _lay(self, rgba: numpy.ndarray, depth: numpy.ndarray) -> None:
        """Colours over what lies behind them, by how much of a pixel they fill."""
        share = numpy.where(depth > self.depth, rgba[..., 3], 0.0)[..., None]
        alpha = share + self.rgba[..., 3:] * (1 - share)
        mixed = rgba[..., :3] * share + self.rgba[..., :3] * self.rgba[..., 3:] * (1 - share)
        self.rgba = numpy.concatenate([mixed / numpy.maximum(alpha, 1e-9), alpha], axis=-1)
        self.depth = numpy.where(share[..., 0] > 0.5, depth, self.depth)

    def paint_plane(self, normal: numpy.ndarray, at: float, colour_of) -> None:
        """The plane normal . x = at: colour_of(places (n, 3)) gives its RGBA there, clear where there is nothing."""
        frame, low, high = self.camera.frame, self.camera.low, self.camera.high
        across = frame @ normal
        if abs(across[2]) < 1e-6:  # seen from its edge
            return
        u, v = numpy.meshgrid(low[0] + (numpy.arange(self.width) + 0.5) / self.width * (high[0] - low[0]), low[1] + (numpy.arange(self.height) + 0.5) / self.height * (high[1] - low[1]))
        depth = (at - u * across[0] - v * across[1]) / across[2]
        place = u[..., None] * frame[0] + v[..., None] * frame[1] + depth[..., None] * frame[2]
        self._lay(colour_of(place.reshape(-1, 3)).reshape(self.height, self.width, 4), depth - low[2])

    def paint_surface(self, position: numpy.ndarray, edge: numpy.ndarray, rgb: numpy.ndarray) -> None:
        """Points as one shaded surface; rgb (n, 3)."""
        usual = float(numpy.median(edge))
        kept = outermost(position, usual) if len(position) > _MANY else slice(None)
        surface = Map(self.camera, 2 * self.width, usual)
        surface.add_balls(position[kept], edge[kept], rgb[kept])
        rgba, depth = surface.shaded(2 * usual, 0.45)
        alpha = _resized(rgba[..., 3], self.width, self.height)
        colour = _resized(rgba[..., :3] * rgba[..., 3:], self.width, self.height) / numpy.maximum(alpha, 1e-9)[..., None]
        near = _resized(numpy.where(rgba[..., 3] > 0, depth, 0), self.width, self.height) / numpy.maximum(alpha, 1e-9)
        self._lay(numpy.concatenate([colour, alpha[..., None]], axis=-1), numpy.where(alpha > 0, near, -1e30))

    def image(self) -> numpy.ndarray:
        return numpy.rint(255 * numpy.clip(self.rgba, 0, 1)).astype(numpy.uint8)


def outermost(position: numpy.ndarray, edge: float) -> numpy.ndarray:
    """The points that have no others on some side: those within a body are not seen."""
    place = numpy.floor(position / (1.3 * edge)).astype(numpy.int64)
    place -= place.min(axis=0) - 1
    size = place.max(axis=0) + 2
    if float(size[0]) * float(size[1]) * float(size[2]) > 5e7:  # thin and far apart: none is hidden
        return numpy.ones(len(position), dtype=bool)
    full = numpy.zeros(size, dtype=bool)
    full[tuple(place.T)] = True
    within = full.copy()
    for axis in range(3):
        within = within & numpy.roll(within, 1, axis) & numpy.roll(within, -1, axis)  # in the end of all 26 places around
    return ~within[tuple(place.T)]


def mirrored(position: numpy.ndarray, lower: numpy.ndarray, axes: str) -> list[numpy.ndarray]:
    """Places with their mirror images at the lower sides."""
    out = [position]
    for axis in axes:
        k = "xyz".index(axis)
        out += [numpy.where(numpy.arange(3) == k, 2 * lower[k] - one, one) for one in out]
    return out


def _cell_colours(sheet, colour):
    """RGBA of the cells at places, clear outside the domain; mirror images included."""
    rgba, n = colour / 255.0, numpy.array(sheet.cells.shape)
    spacing = (sheet.upper - sheet.lower) / n

    def at(place):
        place = place.copy()
        for axis in sheet.options.mirror:
            k = "xyz".index(axis)
            place[:, k] = sheet.lower[k] + abs(place[:, k] - sheet.lower[k])
        index = numpy.floor((place - sheet.lower) / spacing + 1e-9).astype(int)
        beyond = ((place < sheet.lower - 1e-6 * spacing) | (place > sheet.upper + 1e-6 * spacing)).any(axis=1)
        index = numpy.clip(index, 0, n - 1)
        found = rgba[index[:, 0], index[:, 1], index[:, 2]]
        found[beyond] = 0
        return found
    return at


def camera_of(sheet) -> Camera:
    lower = sheet.lower.copy()
    for axis in sheet.options.mirror:
        k = "xyz".index(axis)
        lower[k] = 2 * sheet.lower[k] - sheet.upper[k]
    return Camera(sheet.options.view, lower, sheet.upper)


def raster(sheet, camera: Camera, colour, width: int) -> numpy.ndarray:
    """What is seen as RGBA bytes, the lowest row first; colour(values, scale) gives RGBA bytes."""
    canvas, dark = Canvas(camera, width), sheet.options.dark
    if sheet.cells is not None:
        paint = _cell_colours(sheet, colour(sheet.cells, sheet.cell_scale))
        if sheet.options.plane:
            plane = planes.Plane.across(*sheet.options.plane)
            canvas.paint_plane(plane.normal, plane.at, paint)
        else:
            for k in range(3):
                canvas.paint_plane(numpy.eye(3)[k], camera.corners[7 if camera.far_side(k) else 0][k], paint)
    none = colours.POINT_DARK if dark else colours.POINT
    grey = numpy.array([int(none[k:k + 2], 16) for k in (1, 3, 5)]) / 255
    for body in sheet.bodies:
        rgb = numpy.tile(grey, (len(body.place), 1))
        if body.values is not None:
            rgba = colour(body.values, body.scale)
            rgb = numpy.where(rgba[:, 3:] > 0, rgba[:, :3] / 255, rgb)
        fine = numpy.isfinite(body.place).all(axis=1) & numpy.isfinite(body.edge)
        images = mirrored(body.place[fine], sheet.lower, sheet.options.mirror)
        canvas.paint_surface(numpy.concatenate(images), numpy.tile(body.edge[fine], len(images)), numpy.tile(rgb[fine], (len(images), 1)))
    return canvas.image()


def edges(camera: Camera) -> tuple[list, list]:
    """The edges of the domain in the plane of the picture, ((u, v), (u, v)): those behind, and those in front of what is in it."""
    far = sum((camera.far_side(k) << k) for k in range(3))
    behind, front = [], []
    for i in range(8):
        for k in range(3):
            j = i | 1 << k
            if j == i:
                continue
            ends = [tuple((camera.corners[c] @ camera.frame.T)[:2]) for c in (i, j)]
            hidden = sum(((c ^ far) & ~(1 << k)).bit_count() for c in (i,)) < 2  # on two far sides or one
            (behind if hidden else front).append(ends)
    return behind, front
