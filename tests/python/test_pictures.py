"""test_pictures.py SOD RING AXIS SPACE: pictures, figures and their files, of a comparison in 1-D and of runs in the plane, about an axis and in 3-D."""
import hashlib
import io
import math
import os
import pathlib
import re
import shutil
import sys
import tempfile
import types

import h5py
import numpy
import PIL.Image

import floe
from floe import colours, fields, figures, files, histories, pictures, planes, raster, snapshots, svg, units
from floe.files import Refused
from floe.pictures import Options, Scale

SOD, RING, AXIS, SPACE = (pathlib.Path(name).resolve() for name in sys.argv[1:])


def refused(words, function, *arguments, status=None):
    try:
        function(*arguments)
    except Refused as error:
        assert words in str(error), str(error)
        assert status in (None, error.status), error.status
        return
    raise AssertionError(f"{words}: not refused")


def last(folder):
    return snapshots.snapshots(folder, warn=fail_on_warning, most=1)[0]


def fail_on_warning(text):
    raise AssertionError(text)


def test_numbers():
    """Prefixes, powers of ten, offsets, as people write them."""
    for value, unit, wanted in ((1.4e-3, "s", "1.4 ms"), (101325, "Pa", "101.3 kPa"), (0.5, "m", "0.5 m"), (1000, "J/kg", "1 kJ/kg"), (2e-7, "kg/m3", "200 10⁻⁹ kg/m³"),
                                (-3.0, "1", "−3"), (0, "Pa", "0 Pa"), (99.0, "K", "99 K"), (math.nan, "1", "–"), (5e5, "1", "500 10³"), (1.2e-6, "m", "1.2 µm")):
        assert units.number(value, unit) == wanted, (value, unit, units.number(value, unit))
    narrow = units.shown(101324.0, 101326.0, "Pa")
    assert narrow == units.Shown(1.0, "Pa", 101320.0, " − 101.32 kPa") and narrow.of(101326.0) == 6, narrow
    assert units.label("pressure", narrow) == "pressure − 101.32 kPa (Pa)"
    assert units.seconds(125) == "2 min 05 s" and units.seconds(7800) == "2 h 10 min" and units.count(1234567) == "1\u202f234\u202f567"
    assert units.metric_unit("l1_sigma_r") == "Pa" and units.metric_unit("eq13") == "%" and units.metric_unit("l1_density", True) == ""
    assert units.metric_unit("hend_strain") == "%" and units.metric_unit("linf_velocity_x") == "m/s"
    assert units.error_text("eq13", 0.021) == "2.1 %" and units.error_text("l1_pressure", 30500.0) == "30.5 kPa"


def lightness(rgb):
    """CIE lightness L* of a colour, 0 to 100."""
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in rgb[:3]]
    y = sum(a * b for a, b in zip((0.2126, 0.7152, 0.0722), linear))
    return 116 * y ** (1 / 3) - 16 if y > 216 / 24389 else y * 24389 / 27


def test_colours_keep_the_order():
    """Lightness is one-to-one with the value (of signed ones with its size), over a wide range; curves differ in each palette."""
    for kind in ("single", "warm", "cool", "grey", "signed"):
        for dark in (False, True):
            one = colours.field_map(kind, dark)
            values = [lightness(one(k / 64)) for k in range(32 if kind == "signed" else 0, 65)]
            sign = 1 if values[-1] > values[0] else -1
            assert abs(values[-1] - values[0]) > 45, (kind, dark)
            assert all(sign * (b - a) > 0 for a, b in zip(values, values[4:])), (kind, dark, values)
    assert len(set(colours.SERIES)) == len(set(colours.SERIES_DARK)) == 8 and len(colours.EXCHANGED) == 10


def test_ranges():
    """All values, rounded outwards; few far ones are left out; signed ones about zero; one value alone has a range about it."""
    def of(values, signed=False):
        return pictures.range_of(Scale("a", "Pa", signed, [numpy.asarray(values, dtype=float)]))

    assert of(numpy.linspace(0.3, 9.7, 100)) == (0.2, 9.8)
    low, high = of(numpy.concatenate([numpy.linspace(0, 1, 1000), [500.0, -200.0]]))
    assert -0.1 < low < 0.1 and 0.95 < high < 1.1
    low, high = of([-1.0, 0.0, 3.0], signed=True)
    assert low == -high and 3 <= high < 3.3
    assert of([4.0, math.nan, math.inf]) == (3.6, 4.4) and of([]) == (0.0, 1.0) and of([0.0]) == (0.0, 1.0)
    given = pictures.range_of(Scale("a", "Pa", False, [numpy.array([1.0])], given=(2.0, 3.0)))
    assert given == (2.0, 3.0)


class FakeSnapshot:
    """A square domain of 4 x 2 cells, 2 x 1 m."""
    dim, geometry, time, time_unit, title, coupling, length_unit = 2, "cartesian", 1e-3, "s", "A picture", "ice-mpm", "m"
    path = pathlib.Path("no/fields/000000.h5")


def fake_sheet(**options):
    sheet = pictures.Sheet(FakeSnapshot(), Options(**options), "xy", numpy.zeros(2), numpy.array([2.0, 1.0]), "ice-mpm")
    sheet.scales = [Scale("pressure", "Pa", False)]
    return sheet


def test_cells_and_points_have_their_colours_and_places():
    """Each cell is a rectangle of its colour, the first along x, the lowest row first; a point covers its area; what has no value is grey, or clear."""
    sheet = fake_sheet()
    sheet.cells = numpy.arange(8.0).reshape(2, 4).T
    image = pictures.raster(sheet, [(0.0, 7.0)], 400, 200)
    wanted = colours.field_map("single")(numpy.arange(8) / 7, bytes=True)
    for j in range(2):
        for i in range(4):
            assert (image[100 * j:100 * j + 100, 100 * i:100 * i + 100] == wanted[4 * j + i]).all(), (i, j)
    sheet.cells[1, 0] = math.nan
    assert (pictures.raster(sheet, [(0.0, 7.0)], 400, 200)[:100, 100:200, 3] == 0).all()
    sheet = fake_sheet()
    place = numpy.array([[0.5, 0.25], [1.5, 0.25], [math.nan, 0], [1e300, 0], [-1e300, 0.5]])
    edge = numpy.array([0.2, 0.2, 0.1, 0.1, 0.1])
    sheet.bodies = [pictures.Points("a", place, edge, numpy.array([7.0, math.nan, 1, 1, 1]), 0)]
    image = pictures.raster(sheet, [(0.0, 7.0)], 400, 200)
    full = (image == colours.field_map("single")(1.0, bytes=True)).all(axis=2)
    grey = (image[:, :, 0] == int(colours.POINT[1:3], 16)) & (image[:, :, 3] == 255)
    for mask, x in ((full, 100), (grey, 300)):
        rows, columns = numpy.nonzero(mask)
        assert 40 <= numpy.ptp(rows) + 1 <= 42 and 40 <= numpy.ptp(columns) + 1 <= 42 and mask.sum() == (numpy.ptp(rows) + 1) * (numpy.ptp(columns) + 1)
        assert abs(columns.mean() - x) <= 1 and abs(rows.mean() - 50) <= 1
    assert full.sum() + grey.sum() == (image[:, :, 3] > 0).sum()
    mirrored = fake_sheet(mirror="xy")
    mirrored.cells = numpy.arange(8.0).reshape(2, 4).T
    image = pictures.raster(mirrored, [(0.0, 7.0)], 40, 20)
    assert image.shape == (40, 80, 4) and (image == image[::-1]).all() and (image == image[:, ::-1]).all()


def test_pictures_of_every_dimension():
    """What is chosen where nothing is asked for, in words; the width that is asked for; the same bytes twice."""
    for folder, words, options in (
            (SOD / "ice-0.01", "pressure of cells at t = 0.143", {}),
            (RING, "von Mises stress of points over pressure of cells at t = 100 µs", {}),
            (AXIS, "von Mises stress of points over pressure of cells at t = ", {"mirror": "x", "dark": True}),
            (SPACE, "pressure and von Mises stress of points in the plane z = 0.35 at t = ", {}),
            (SPACE, "pressure and von Mises stress of points in the plane x = 0.1 at t = ", {"plane": ("x", 0.1)}),
            (RING, "hoop stress of points over density gas of cells at t = ", {"points": "sigma_theta", "cells": "density_gas"})):
        sheet = pictures.make_sheet(last(folder), Options(width=300, **options))
        assert sheet.caption.startswith(words), sheet.caption
        drawn = pictures.png(pictures.sheet_figure(sheet))
        image = PIL.Image.open(io.BytesIO(drawn))
        assert image.width == 300 and len(numpy.unique(numpy.asarray(image.convert("L")))) > 20
    assert drawn == pictures.png(pictures.sheet_figure(sheet))
    assert "density" in pictures.exact_curves(last(SOD / "ice-0.01"))
    snapshot = last(SPACE)
    for axis, at in ((2, 0.35), (0, 0.1)):
        sheet = pictures.make_sheet(snapshot, Options(plane=("xyz"[axis], at)))
        near = {body: abs(snapshot.points(body, "position").values[:, axis] - at) <= 0.5 * snapshot.spacing[axis] for body in snapshot.bodies}
        assert {one.name: len(one.place) for one in sheet.bodies} == {body: mask.sum() for body, mask in near.items()}
        assert 0 < sum(mask.sum() for mask in near.values()) < sum(len(mask) for mask in near.values())


def test_planes_that_lean():
    """What a plane across a direction has of a box, where it lies, and the cells and points there."""
    lower, upper = numpy.zeros(3), numpy.ones(3)
    plane = planes.Plane.across((1, 1, 0), math.sqrt(0.5))
    low, high = plane.extent(lower, upper)
    assert numpy.allclose(high - low, [math.sqrt(2.0), 1.0]) and plane.names == ("(-0.707, 0.707, 0)", "z", "(1, 1, 0)")
    flat = numpy.array([[0.3, 0.2], [-0.6, 0.9], [0.0, 1.5]])
    place = plane.place(flat)
    assert numpy.allclose(plane.flat(place), flat) and numpy.allclose(place[:, 0] + place[:, 1], 1.0) and numpy.allclose(place[:, 2], flat[:, 1])
    assert numpy.linalg.det([plane.right, plane.up, plane.normal]) > 0.999  # seen from where the normal points
    corner = planes.Plane.across((2, 2, 2), math.sqrt(3.0)).extent(lower, upper)  # touches one
    assert numpy.allclose(corner[0], corner[1]) and planes.Plane.across((1, 1, 1), 1.8).extent(lower, upper) is None
    values = numpy.arange(24.0).reshape(2, 3, 4)
    shown = planes.cells_at(values, lower, upper / values.shape, place)
    assert shown[0] == values[tuple((place[0] * values.shape).astype(int))] and math.isnan(shown[2])
    snapshot = last(SPACE)
    straight, leaning = (pictures.make_sheet(snapshot, Options(plane=(axis, 0.1))) for axis in ("x", (3, 0, 0)))
    assert [len(one.place) for one in straight.bodies] == [len(one.place) for one in leaning.bodies]
    assert numpy.allclose(straight.bodies[0].place, leaning.bodies[0].place) and "plane (3, 0, 0) at " in leaning.note, leaning.note


def test_points_close_up():
    """Gaps of less than a point are closed, wider ones are not; those beside an axis and a mirror are closed as the body goes on there."""
    layer = numpy.zeros((20, 40, 4), dtype=numpy.uint8)
    layer[4:16, 5:10] = layer[4:16, 13:20] = layer[4:16, 27:33] = [9, 8, 7, 255]
    raster.close_gaps(layer, 2)
    assert (layer[6:14, 5:20] == [9, 8, 7, 255]).all() and not layer[4:16, 20:27].any() and not layer[:, :5].any() and not layer[:4].any() and not layer[16:].any()


def test_values_of_vectors():
    """A vector by its magnitude or a component; what has a sign is known."""
    ring = last(RING)
    velocity = ring.points("cylinder", "velocity").values
    assert abs(velocity[:, :2]).min(axis=0).max() > 0
    for name, wanted, signed in (("velocity", numpy.sqrt((velocity ** 2).sum(axis=1)), False), ("velocity_x", velocity[:, 0], True), ("velocity_y", velocity[:, 1], True)):
        choice = fields.find(ring, "cylinder", name)
        values, unit = fields.values(ring, choice)
        assert unit == "m/s" and choice.signed == signed and abs(values - wanted).max() <= 1e-15 * abs(wanted).max(), name
    assert fields.find(ring, "cylinder", "velocity_z") is None and fields.find(ring, None, "velocity_gas_y").component == 1


def test_closed_cells_have_no_colour():
    """Beside sharp surfaces a fluid's field is nothing where no part of a cell is open to it, which would be the end of its range."""
    numbers = {"density_air": numpy.array([0.0, 2.0, 3.0]), "open_fraction_air": numpy.array([0.0, 0.5, 1.0])}

    class Cells:
        fields = numbers

        @staticmethod
        def read(body, name):
            return types.SimpleNamespace(values=numbers[name], unit="kg/m3")

        @staticmethod
        def components(body, name):
            return 1

    shown, _ = fields.values(Cells, fields.Choice("density_air", None, "density", False, None))
    assert math.isnan(shown[0]) and list(shown[1:]) == [2.0, 3.0]


def test_what_is_not_there_is_refused():
    ring = last(RING)
    for words, options in (("there is no field 'stress' of points", {"points": "stress"}), ("sigma_r, sigma_theta, stress_xx", {"points": "stress"}),
                           ("velocity (_x, _y)", {"points": "velocity_z"}), ("density_gas", {"cells": "temperature"}),
                           ("nothing to draw", {"points": "none", "cells": "none"}), ("in 3-D", {"plane": ("z", 0.5)})):
        refused(words, pictures.make_sheet, ring, Options(**options), status=2)
    refused("outside the domain", pictures.make_sheet, last(SPACE), Options(plane=("y", 5.0)), status=2)
    refused("outside the domain", pictures.make_sheet, last(SPACE), Options(plane=((1, 1, 0), 5.0)), status=2)
    refused("not all of them nothing", pictures.make_sheet, last(SPACE), Options(plane=((0, 0, 0), 5.0)), status=2)
    refused("planes across an axis", pictures.make_sheet, last(SPACE), Options(plane=((1, 1, 0), 0.3), mirror="x"), status=2)


def test_damaged_snapshots():
    """A broken seal is said, whatever is broken; the others are read."""
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / "run"
        shutil.copytree(RING, copy)
        every = snapshots.snapshot_files(copy)
        whole = every[-1].read_bytes()
        for words, data in (("damaged", whole[:4000] + b"x" + whole[4001:]), ("cut short", whole[:-1]), ("cut short", whole[:100]), ("too long", whole + b"x"),
                            ("not a file of floe's", b"x" + whole[1:]), ("damaged", whole[:500] + b"xy" + whole[502:])):
            every[-1].write_bytes(data)
            refused(words, snapshots.SealedSnapshot, every[-1])
        said = []
        assert snapshots.snapshots(copy, said.append, 1)[0].path == every[-2] and len(said) == 1 and "passed over" in said[0]
        for path in every:
            path.write_bytes(b"")
        refused("no readable snapshot", snapshots.snapshots, copy, said.append, status=4)


def sealed(path):
    """Puts floe's seal on a file of HDF5 with a user block of 512 bytes: anyone can."""
    data = bytearray(path.read_bytes())
    data[:480] = (b"\x89floe\r\n\x1a" + (2).to_bytes(4, "little") + (1).to_bytes(4, "little") + (len(data) - 512).to_bytes(8, "little")).ljust(480, b"\0")
    data[480:512] = hashlib.sha256(data[:480] + data[512:]).digest()
    path.write_bytes(data)


def test_snapshots_of_strangers():
    """What leads out of a file is not followed, though the seal is whole; nor are filters, which may load plug-ins."""
    with tempfile.TemporaryDirectory() as folder:
        for words, change in ((None, lambda file: None),
                              ("a link out of it", lambda file: file.__setitem__("cells/other", h5py.ExternalLink("/etc/passwd", "/"))),
                              ("a link out of it", lambda file: file.__setitem__("points/other", h5py.SoftLink("/cells"))),
                              ("not stored as floe does", lambda file: file["cells"].create_dataset("z", data=numpy.zeros((9, 9)), compression="gzip")),
                              ("not stored as floe does", lambda file: file.create_dataset("e", (4,), "f8", external=[("/etc/passwd", 0, 32)])),
                              ("no snapshot", lambda file: file.attrs.__setitem__("domain_upper", [-1.0, 1.0]))):
            path = pathlib.Path(folder) / "000000.h5"
            with h5py.File(snapshots.snapshot_files(RING)[0]) as source, h5py.File(path, "w", userblock_size=512) as file:
                for name, value in source.attrs.items():
                    file.attrs[name] = value
                for name in source:
                    source.copy(name, file)
                change(file)
            sealed(path)
            if words:
                refused(words, snapshots.SealedSnapshot, path, status=4)
            else:
                assert snapshots.SealedSnapshot(path).dim == 2


def odd_figure():
    x, y = numpy.array([0.1, 0.05, 0.025, 0.0125]), numpy.array([0.04, 0.0, math.nan, 6.3e-4])
    one = figures.Panel("it's an error", "h (m)", "error (%)", True, True, slopes=[1.0, 2.0])
    one.series = [figures.Series("ice-mpm's \"best\" <50%> $a_b", x, y, "linespoints", 1, labels=["a \"quoted\" one", "", "", ""]), figures.Series("nothing", x[:0], y[:0], "points", 2),
                  figures.Series("front", x, x, "points", emphasis=True)]
    two = figures.Panel("nothing here", log_y=True, series=[figures.Series("zero", x, 0 * x)])
    three = figures.Panel(x_label="time (s)", series=[figures.Series("steps", x, x, "steps", 9), figures.Series("same", x, 0 * x + 1e-300), figures.Series("huge", x, 1e300 * x)])
    return figures.Figure("01-it's a/figure.x", "O'Hara & <co>", [one, two, three], 2)


def test_figures():
    """Every number is in the data, drawn or not; drawings are well-formed, have names of their own, and give the same bytes twice."""
    with tempfile.TemporaryDirectory() as folder:
        figure = odd_figure()
        element = figures.write(folder, figure)
        rows = (pathlib.Path(folder) / "01-it_s_a_figure.x.csv").read_text().splitlines()
        assert rows[0] == "panel,series,x,y,label" and len(rows) == 1 + 4 + 4 + 4 + 12
        assert rows[1] == 'it\'s an error,"ice-mpm\'s ""best"" <50%> $a_b",0.1,0.04,"a ""quoted"" one"' and ",0.025,nan," in rows[3]
        from xml.dom import minidom
        minidom.parseString((pathlib.Path(folder) / "01-it_s_a_figure.x.svg").read_text())
        assert "no data" in element and "slope 2" in element and "O'Hara &amp; &lt;co&gt;" in element and "ice-mpm's" in element
        names = re.findall(r' id="([^"]*)"', element)
        assert names and len(set(names)) == len(names) and all(one.startswith("01-it_s_a_figure.x-") for one in names)
        assert set(re.findall(r'href="#([^"]*)"', element)) <= set(names) and set(re.findall(r"url\(#([^)]*)\)", element)) <= set(names)
        assert figures.draw(figure) == element
        alone = svg.alone(element)
        assert "prefers-color-scheme: dark" in alone and all(f'[stroke="{light}"]{{stroke:{dark}}}' in alone for light, dark in colours.EXCHANGED.items())


def test_figures_of_files():
    """What `floe compare` describes is what is drawn: curves, labels, slopes."""
    with tempfile.TemporaryDirectory() as folder:
        for name in ("errors", "profile"):
            for kind in ("csv", "json"):
                shutil.copy(SOD / f"{name}.{kind}", folder)
        figures.draw_files(folder, ["errors", "profile"])
        read = figures.read(folder, "errors")
        assert read.columns == 3 and read.panels[0].slopes == [1.0, 2.0] and read.panels[0].log_x
        for panel in read.panels[::3]:  # over the spacing; then come updates and time
            assert panel.y_label.startswith("l1_") and {one.name for one in panel.series} == {"ice", "mpm"}
            for one in panel.series:
                wanted = sorted(floe.Cases(SOD).numbers(panel.y_label, coupling=one.name))
                assert one.style == "linespoints" and sorted(one.x) == [0.01, 0.02]
                assert all(abs(a - b) <= 1e-4 * b for a, b in zip(sorted(one.y), wanted)), (panel.y_label, wanted, one.y)
        assert "slope 1" in (pathlib.Path(folder) / "errors.svg").read_text()


def test_slopes():
    """Lines for reference have the slopes that stand beside them, within the panel."""
    from matplotlib.figure import Figure
    axes = Figure().subplots()
    axes.set(xscale="log", yscale="log", xlim=(0.01, 0.3), ylim=(1e-5, 1e-1))
    figures._slopes(axes, [1.0, 2.0])
    for line, slope in zip(axes.lines, (1.0, 2.0)):
        x, y = numpy.log10(line.get_xdata()), numpy.log10(line.get_ydata())
        assert abs((y[1] - y[0]) / (x[1] - x[0]) - slope) < 1e-9 and -2 < x[0] < x[1] < math.log10(0.3) and -5 < y[0] < y[1] < -1


def test_thinned_curves():
    """Of a long line with a jump, a peak and a gap these stay, and both ends; of a cloud an even part; a short or labelled curve is whole."""
    n, most = 20000, 100
    x = numpy.arange(n, dtype=float)
    y = numpy.where(x < 7003, 0.0, 1.0)
    y[15001] = 5.0
    y[9500:10500] = math.nan
    panel = figures.Panel()
    thin = figures.thinned(panel, figures.Series("a", x, y), most)
    assert len(thin.x) <= most + 4 and thin.x[0] == 0 and thin.x[-1] == n - 1 and 15001 in thin.x
    below, above = thin.x[thin.y == 0].max(), thin.x[thin.y == 1].min()
    assert below <= 7002 < above and above - below <= 2 * n / most
    assert numpy.isnan(thin.y).any()
    cloud = figures.thinned(panel, figures.Series("a", x, x, "points"), most)
    assert len(cloud.x) == most and max(numpy.diff(cloud.x)) <= 2.2 * n / most
    labelled = figures.Series("a", x, x, labels=[""] * n)
    assert figures.thinned(panel, labelled, most) is labelled


def test_files():
    """Written whole, in the place of ordinary files only; no link is followed; a folder that is not there is said."""
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        (place / "mine").write_text("mine")
        os.symlink("mine", place / "link")
        os.mkfifo(place / "pipe")
        (place / "sub").mkdir()
        for one in (place / "link", place / "pipe", place / "sub", pathlib.Path("/dev/null")):
            refused("not an ordinary file", files.replace, one, b"x", status=4)
        refused("no/such", files.replace, place / "no/such/a", b"x", status=4)
        os.symlink(place / "mine", place / "a.tmp")
        files.replace(place / "a", "first")
        files.replace(place / "a", b"second")
        assert (place / "a").read_bytes() == b"second" and (place / "mine").read_text() == "mine" and not (place / "a.tmp").is_symlink()
        refused("a named pipe", files.read, place / "pipe")
        refused("cannot read", files.read, place / "nothing")
        assert files.read_text(place / "link") == "mine" and sorted(one.name for one in place.iterdir()) == ["a", "link", "mine", "pipe", "sub"]
    assert files.stem("a b/c") == "a_b_c" and files.stem(".x") == "_x" and files.stem("") == "plot"


def test_histories():
    """A ledger that adds up, by floe's own columns; a figure a subject, with people's units; half a row is left out."""
    run = snapshots.Run(RING)
    wanted = {row[0]: row for row in histories.ledger(run)}
    name, unit, start, kinds, end, drift = wanted["energy"]
    assert unit == "J" and abs(end - start - sum(kinds)) <= 1e-9 * max(abs(end), abs(start)) + 1e-6 * abs(end) and 0 <= drift < 1e-3
    parts = [run.history[one].values for one in ("kinetic", "strain", "internal")]
    assert all(one[-1] > 0 for one in parts) and end == sum(one[-1] for one in parts) and start == sum(one[0] for one in parts)
    found = {one.name.partition("-")[2]: one for one in histories.history_figures(run, "x")}
    assert {"energies", "pressure", "step"} <= set(found)
    assert found["energies"].panels[0].x_label == "time (µs)"
    assert abs(sum(share for _, share in histories.step_limits(run)) - 1) < 1e-12
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "history.csv").write_text('time (s),steps,dt_limit\n0,0,"a"\n1,2,"a"\n2,5,"b"\n3,10,"a"\n')
        assert histories.step_limits(snapshots.Run(folder, {})) == [("a", 0.7), ("b", 0.3)]
        (pathlib.Path(folder) / "history.csv").write_text("time (s),kinetic (J)\n0,nan\n1,2\n2")
        cut = snapshots.Run(folder, {})
        assert len(cut.history["time"].values) == 2 and math.isnan(cut.history["kinetic"].values[0])
        assert histories.history_figures(cut, "x")


def test_movie():
    """A GIF with a picture a snapshot, as large as the pictures."""
    with tempfile.TemporaryDirectory() as folder:
        path = floe.movie(floe.Result(RING), "sigma_theta", path=pathlib.Path(folder) / "a.gif", width=240)
        image = PIL.Image.open(path)
        assert image.n_frames == len(snapshots.snapshot_files(RING)) and image.width == 240
        refused("a movie is", floe.movie, floe.Result(RING), None, None, pathlib.Path(folder) / "a.avi", status=2)


for test in [value for key, value in sorted(globals().items()) if key.startswith("test_")]:
    test()
    print("passed:", test.__name__)
