"""Planes through scenes in 3-D, across an axis or any other direction: what lies in them, and where in a picture."""
import dataclasses
import math

import numpy


@dataclasses.dataclass(frozen=True)
class Plane:
    """The places x of which normal . x is `at`, a distance from the origin. A picture has `right` and `up` along its sides."""
    normal: numpy.ndarray  # of length one
    at: float
    right: numpy.ndarray
    up: numpy.ndarray
    axis: int | None       # that the plane is across; None: it leans
    names: tuple[str, str, str]  # of the directions to the right and up, and of the normal

    @classmethod
    def across(cls, direction, at: float) -> "Plane":
        """Across an axis, "x", "y" or "z", or three components of a normal of any length."""
        if isinstance(direction, str):
            axis = "xyz".index(direction)
            right, up = (k for k in range(3) if k != axis)
            one = numpy.eye(3)
            return cls(one[axis], at, one[right], one[up], axis, ("xyz"[right], "xyz"[up], direction))
        normal = numpy.array(direction, dtype=float)
        size = numpy.linalg.norm(normal)
        if normal.shape != (3,) or not (math.isfinite(size) and size > 0):
            raise ValueError("a plane's normal has three components, not all of them nothing")
        normal /= size
        # Upwards along z as far as the plane goes there; of a plane across z along y.
        other = numpy.eye(3)[2 if abs(normal[2]) < 1 - 1e-9 else 1]
        up = other - normal * (other @ normal)
        up /= numpy.linalg.norm(up)
        right = numpy.cross(up, normal)
        return cls(normal, at, right, up, None, (_told(right), _told(up), _told(direction)))

    def distance(self, place: numpy.ndarray) -> numpy.ndarray:
        """Of places (n, 3) from the plane."""
        return place @ self.normal - self.at

    def flat(self, place: numpy.ndarray) -> numpy.ndarray:
        """Places (n, 3) in the picture (n, 2)."""
        return place @ numpy.column_stack([self.right, self.up])

    def place(self, flat: numpy.ndarray) -> numpy.ndarray:
        """Places (n, 3) of the plane of those in the picture (n, 2)."""
        return flat @ numpy.stack([self.right, self.up]) + self.at * self.normal

    def extent(self, lower: numpy.ndarray, upper: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray] | None:
        """Corners of the picture that holds what a box has of the plane; None where the plane passes the box by."""
        corner = numpy.array([[(lower, upper)[i >> k & 1][k] for k in range(3)] for i in range(8)])
        beyond, slack, found = self.distance(corner), 1e-9 * float(numpy.linalg.norm(upper - lower)), []
        for i in range(8):
            if abs(beyond[i]) <= slack:
                found.append(corner[i])
            for j in (i | 1 << k for k in range(3)):
                if j != i and beyond[i] * beyond[j] < 0:
                    found.append(corner[i] + (corner[j] - corner[i]) * beyond[i] / (beyond[i] - beyond[j]))
        if not found:
            return None
        flat = self.flat(numpy.array(found))
        return flat.min(axis=0), flat.max(axis=0)


def _told(direction) -> str:
    """The letter of an axis, or components."""
    for k in range(3):
        if abs(direction[k] - 1) < 1e-9 and sum(abs(one) for one in direction) < 1 + 1e-9:
            return "xyz"[k]
    return "(" + ", ".join(f"{one:.3g}" for one in numpy.round(direction, 6) + 0.0) + ")"


def cells_at(values: numpy.ndarray, lower: numpy.ndarray, spacing: numpy.ndarray, place: numpy.ndarray) -> numpy.ndarray:
    """Values of the cells that hold places (n, 3); NaN outside the mesh."""
    index = numpy.floor((place - lower) / spacing).astype(int)
    there = ((index >= 0) & (index < values.shape)).all(axis=1)
    out = numpy.full(len(place), math.nan)
    out[there] = values[tuple(index[there].T)]
    return out
