"""test_space.py SPACE BAGS FIXED: scenes in 3-D seen from a side, pressures that membranes part, bodies without stress."""
import io
import math
import pathlib
import sys

import numpy
import PIL.Image

import floe
from floe import fields, pictures, snapshots, space
from floe.files import Refused
from floe.pictures import Options

SPACE, BAGS, FIXED = (pathlib.Path(name).resolve() for name in sys.argv[1:])
UNIT = numpy.zeros(3), numpy.ones(3)


def last(folder):
    return snapshots.SealedSnapshot(snapshots.snapshot_files(folder)[-1])


def refused(words, function, *arguments):
    try:
        function(*arguments)
    except Refused as error:
        assert words in str(error) and error.status == 2, (str(error), error.status)
        return
    raise AssertionError(f"{words}: not refused")


def test_camera():
    """From +x one sees y to the right and z upwards; from above, at azimuth -90, x to the right and y upwards; frames are right-handed rotations."""
    for view, right, up, towards in (((0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0)), ((-90, 90), (1, 0, 0), (0, 1, 0), (0, 0, 1)), ((90, 0), (-1, 0, 0), (0, 0, 1), (0, 1, 0))):
        assert abs(space.Camera(view, *UNIT).frame - [right, up, towards]).max() < 1e-12, view
    camera = space.Camera((33, 21), *UNIT)
    assert abs(camera.frame @ camera.frame.T - numpy.eye(3)).max() < 1e-12 and abs(numpy.linalg.det(camera.frame) - 1) < 1e-12
    assert [camera.far_side(k) for k in range(3)] == [0, 0, 0] and [space.Camera((200, -10), *UNIT).far_side(k) for k in range(3)] == [1, 1, 1]
    behind, front = space.edges(camera)
    assert len(behind) + len(front) == 12 and len(front) == 3  # three edges meet in the corner that is nearest


def test_a_ball_is_a_disc():
    """Points of a ball cover the disc of its radius, in its place, the nearest in front; the middle is lighter than the rim below."""
    camera, n, radius, centre = space.Camera((0, 0), *UNIT), 24, 0.3, numpy.array([0.5, 0.4, 0.55])
    lattice = (numpy.stack(numpy.meshgrid(*3 * [numpy.arange(n)], indexing="ij"), -1).reshape(-1, 3) + 0.5) / n
    place = lattice[numpy.linalg.norm(lattice - centre, axis=1) < radius]
    canvas = space.Canvas(camera, 200)
    half = numpy.where(place[:, :1] > 0.5, [[1.0, 0, 0]], [[0, 0, 1.0]])  # red towards who looks
    canvas.paint_surface(place, numpy.full(len(place), 1 / n), half)
    image = canvas.image()
    there = image[..., 3] > 127
    rows, columns = numpy.nonzero(there)
    assert abs(there.sum() / (math.pi * (radius * 200) ** 2) - 1) < 0.12, there.sum() / (math.pi * (radius * 200) ** 2)
    assert abs(columns.mean() / 200 - centre[1]) < 0.01 and abs(rows.mean() / 200 - centre[2]) < 0.01  # y to the right, z upwards, row 0 below
    middle, low = image[110, 80], image[60, 80]
    assert middle[0] > middle[2] and middle[0] > 1.2 * low[0], (middle, low)
    kept = space.outermost(place, 1 / n)
    distance = numpy.linalg.norm(place - centre, axis=1)
    assert kept[distance > radius - 1 / n].all() and not kept[distance < radius / 2].any()


def test_planes():
    """A plane hides what lies behind it and is hidden by what lies in front; its colours are in their places."""
    camera = space.Camera((0, 0), *UNIT)
    for x, shown in ((0.8, False), (0.2, True)):
        canvas = space.Canvas(camera, 100)
        canvas.paint_plane(numpy.array([1.0, 0, 0]), x, lambda place: numpy.column_stack([place[:, 1], place[:, 2], 0 * place[:, 1], 0 * place[:, 1] + 1]))
        middle = numpy.array([[0.5, 0.5, 0.5]])
        canvas.paint_surface(middle, numpy.array([0.2]), numpy.array([[0.0, 0.0, 1.0]]))
        image = canvas.image()
        assert (image[50, 50, 2] > 100) == shown
        assert abs(image[10, 80, :3] - numpy.array([205, 27, 0])).max() <= 3  # at y = 0.805, z = 0.105


def test_sheets():
    """All points stand in a view, none in a plane beside them; a mirror doubles the domain; what cannot be seen so is refused."""
    snapshot = last(SPACE)
    sheet = pictures.make_sheet(snapshot, Options(view=(30, 20), mirror="xy"))
    assert {one.name: one.place.shape for one in sheet.bodies} == {body: (len(snapshot.points(body, "id").values), 3) for body in snapshot.bodies}
    assert "domain of 0.6 × 0.6 × 0.6" in sheet.note and " in the plane" not in sheet.caption
    wide, narrow = space.camera_of(sheet), space.camera_of(pictures.make_sheet(snapshot, Options(view=(30, 20))))
    assert abs((wide.corners[7] - wide.corners[0]) - [1.2, 1.2, 0.6]).max() < 1e-12 and abs((narrow.corners[7] - narrow.corners[0]) - 0.6).max() < 1e-12
    images = [numpy.asarray(PIL.Image.open(io.BytesIO(pictures.png(floe.picture(SPACE, view=(30, 20), width=240, **more))))) for more in ({}, {}, {"points": "velocity_x"}, {"dark": True})]
    assert (images[0] == images[1]).all() and not (images[0] == images[2]).all() and images[0].shape[1] == 240
    refused("--view is for scenes in 3-D", pictures.make_sheet, last(BAGS), Options(view=(30, 20)))
    refused("lies outside the domain", pictures.make_sheet, snapshot, Options(view=(30, 20), plane=("x", 7.0)))


def test_parted_pressure():
    """Of gases that membranes keep apart, in each cell the pressure of the one that has most of it; what holds nothing is clear."""
    snapshot = last(BAGS)
    choice = fields.usual_of_cells(snapshot)
    values, unit = fields.values(snapshot, choice)
    assert choice.label == "pressure" and unit == "1"
    x, y = numpy.meshgrid(snapshot.centres(0).values, snapshot.centres(1).values, indexing="ij")
    for at, gas in ((numpy.hypot(x - 0.5, y - 0.5) < 0.2, "gas"), (numpy.hypot(x - 1.14, y - 0.5) < 0.2, "other"), (y > 0.9, "air")):
        assert at.any() and (values[at] == snapshot.field("pressure_" + gas).values[at]).all(), gas
    assert fields.find(snapshot, None, "pressure_gas").field == "pressure_gas" and fields.find(last(FIXED), None, "pressure").field == "pressure"


def test_bodies_without_stress():
    """A body that is held is grey: no scale from 0 to 1 for what it does not have; what is asked for is shown."""
    snapshot = last(FIXED)
    assert snapshot.undeformed == {"cylinder"} and last(BAGS).undeformed == set()
    sheet = pictures.make_sheet(snapshot, Options())
    assert [one.label for one in sheet.scales] == ["pressure"] and sheet.bodies[0].values is None
    assert [one.label for one in pictures.make_sheet(snapshot, Options(points="velocity")).scales] == ["speed", "pressure"]


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print(name, "ok")
