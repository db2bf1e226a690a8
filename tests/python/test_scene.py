"""test_scene.py SOD: decks stepped from Python, against what the deck says, formulas, the run of the program (to the bit), and each other."""
import _thread
import gc
import logging
import math
import pathlib
import signal
import sys
import tempfile
import threading
import weakref

import numpy

import floe
from floe import library

SOD = pathlib.Path(sys.argv[1]).resolve()
INPUTS = pathlib.Path(__file__).resolve().parents[2] / "inputs"
TUBE = {"coupling": "ice", "domain.cell": 0.02}

SPACE = """
floe: 1
coupling: ice
domain: {dim: 3, lower: [0, 1, 2], upper: [0.3, 1.8, 2.5], cell: 0.1 m}
boundaries: {x: slip, y: slip, z: slip}
materials: {air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}}
bodies:
  air: {material: air, shape: {box: {lower: [0, 1, 2], upper: [0.3, 1.8, 2.5]}}, temperature: 300 K,
        pressure: 1 bar + 1 kPa * (x / 1 m) + 20 kPa * (y / 1 m) + 300 kPa * (z / 1 m), velocity: [1 m/s, 2 m/s, 3 m/s]}
time: {end: 1 ms}
"""

TURNED = """
floe: 1
coupling: mpm
domain: {dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [1, 0.6], cell: 0.1 m}
boundaries: {r: {lower: symmetry, upper: free}, z: free}
materials: {steel: {density: 7800 kg/m^3, law: {neo_hookean: {bulk_modulus: 160 GPa, shear_modulus: 80 GPa}}}}
bodies: {ring: {material: steel, shape: {box: {lower: [0.2, 0.1], upper: [0.5, 0.3]}}, velocity: [0, 4 m/s]}}
time: {end: 10 us}
"""


def close(a, b, most=1e-12):
    assert abs(a - b) <= most * max(abs(a), abs(b), 1e-300), (a, b)


def refused(kind, words, function, *arguments, **more):
    try:
        function(*arguments, **more)
    except kind as error:
        assert words in str(error), str(error)
        return error
    raise AssertionError(f"{words}: not refused")


def address(array):
    return array.__array_interface__["data"][0]


def test_steps_to_the_bits_of_a_run():
    """Sod's tube, stopped where the program has written snapshots."""
    result = floe.Result(SOD)
    with floe.Scene(INPUTS / "sod.yaml", settings=TUBE) as scene:
        assert scene.coupling == "ice" and scene.title == "Sod's shock tube" and scene.warnings == [] and scene.mesh.axes == "x"
        assert scene.step_count == 0 and scene.time_step == 0 and not scene.finished
        for snapshot in result.snapshots:
            if snapshot.time > 0:
                assert scene.advance(snapshot.time) and scene.time == snapshot.time
            for name in ("density_gas", "pressure"):
                assert (scene.cells[name] == snapshot.field(name).values).all(), (name, snapshot.time)
            assert (scene.cells["velocity_gas"] == snapshot.field("velocity_gas").values[:, 0]).all()
        assert scene.finished and scene.step_count == result.summary["steps"] and scene.time == scene.end
        assert scene.error("l1_density") == result.summary["errors"]["l1_density"]
        close(scene.mesh.centres()[0], 0.01)
        # What the deck says: 0.5 (1 + 0.125) kg/m2 and 0.5 (1 + 0.1) / 0.4 J/m2; the walls press with 1 and with 0.1.
        totals, energy = scene.totals(), scene.balance("energy")
        close(totals.mass, 0.5625)
        close(totals.kinetic_energy + totals.internal_energy, 1.375)
        close(totals.momentum[0], 0.9 * scene.time, 2e-3)  # the fan is at the wall by a trace
        close(energy.start, 1.375)
        assert energy.conserved and abs(energy.drift) < 1e-14 and not scene.balance("momentum_y").now
        assert scene.probe(0.99).pressure == scene.cells["pressure"][-1] and math.isnan(scene.probe(3).pressure)
        refused(floe.InputError, "the simulation has ended", scene.step)
        refused(floe.InputError, "do not name 'l1_x'", scene.error, "l1_x")
        refused(KeyError, "mass, momentum_x", scene.balance, "charge")


def test_steps_one_by_one():
    """A step at a time has the bits of all at once, whichever way they are asked for; two scenes do not know of each other."""
    with floe.Scene(INPUTS / "sod.yaml", settings=TUBE) as one, floe.Scene(INPUTS / "sod.yaml", settings=[f"{k}={v}" for k, v in TUBE.items()]) as other:
        assert other.advance(0.1)
        times = []
        for time in one.steps(0.1):
            times.append(time)
            assert time == one.time and len(times) == one.step_count
        assert times == sorted(set(times)) and times[-1] == 0.1 and one.step_count == other.step_count
        assert (one.cells["pressure"] == other.cells["pressure"]).all()
        before = one.time
        assert before < one.step(until=0.11) <= 0.11 and one.time_step > 0
        refused(floe.InputError, "cannot step to t = 0.05", one.advance, 0.05)


def test_cells_are_where_they_are():
    """A field that the deck gives by place: value[i, j, k] is that at the centre of cell (i, j, k), views are of floe's own numbers."""
    with floe.Scene(text=SPACE) as scene:
        assert scene.mesh.cells == (3, 8, 5) and scene.mesh.lower == (0, 1, 2) and scene.mesh.axes == "xyz"
        x, y, z = numpy.meshgrid(*(scene.mesh.centres(k) for k in range(3)), indexing="ij")
        exact = 1e5 + 1e3 * x + 2e4 * y + 3e5 * z
        pressure = scene.cells["pressure"]
        assert pressure.shape == (3, 8, 5) and abs(pressure / exact - 1).max() < 1e-9, abs(pressure / exact - 1).max()
        assert abs(scene.cells.copy("pressure") / exact - 1).max() < 1e-9
        assert scene.cells.unit("pressure") == "Pa" and "pressure" in scene.cells.meaning("pressure") and scene.cells.scale("pressure") == 1
        parts = scene.cells["velocity_air"]
        assert len(parts) == 3 and all(abs(one - k - 1).max() < 1e-12 for k, one in enumerate(parts))
        assert [address(scene.cells["velocity_air_" + axis]) for axis in "xyz"] == [address(one) for one in parts]
        assert scene.cells.copy("velocity_air").shape == (3, 8, 5, 3) and abs(scene.cells.copy("velocity_air_y") - 2).max() < 1e-12
        close(scene.probe([0.25, 1.15, 2.35]).pressure, exact[2, 1, 3], 1e-9)
        assert abs(scene.probe([0.25, 1.15, 2.35]).velocity - [1, 2, 3]).max() < 1e-12 and abs(scene.at("velocity_air", [0, 1, 2]) - [1, 2, 3]).max() < 1e-12
        close(scene.at("velocity_air_z", [0, 1, 2]), 3)
        close(scene.at("pressure", [0.05, 1.35, 2.05]), exact[0, 3, 0], 1e-9)
        assert address(pressure) == address(scene.cells["pressure"]) and not pressure.flags.writeable and pressure.strides != scene.cells.copy("pressure").strides
        refused(ValueError, "read-only", pressure.__setitem__, (0, 0, 0), 1.0)
        assert "pressure" in scene.cells and "nothing" not in scene.cells and len(scene.cells) == len(list(scene.cells)) and len(scene.points) == 0
        refused(KeyError, "there is no field 'nothing' of cells; there are:", scene.cells.__getitem__, "nothing")
        refused(KeyError, "no field 'pressure_x'", scene.cells.__getitem__, "pressure_x")
        refused(floe.InputError, "outside the mesh", scene.at, "pressure", [5, 1, 2])
        refused(floe.InputError, "has 3 coordinates, not 2", scene.probe, [5, 1])
        refused(KeyError, "there is no body 'ball' of points; there are: none", scene.points.__getitem__, "ball")


def test_points():
    """Of a ring about the axis: places, masses per radian and their scale, components by the names of the axes."""
    with floe.Scene(text=TURNED) as scene:
        ring = scene.points["ring"]
        assert list(scene.points) == ["ring"] and scene.mesh.axes == "rz"
        scale = ring.scale("mass")
        close(scale, 2 * math.pi)
        mass = 7800 * math.pi * (0.5 ** 2 - 0.2 ** 2) * 0.2
        close(ring["mass"].sum() * scale, mass, 1e-10)
        close(ring.copy("mass").sum(), mass, 1e-10)
        close(scene.totals().mass, mass, 1e-10)
        close(scene.totals().momentum[1], 4 * mass, 1e-10)
        assert 0.2 < ring["position_r"].min() and ring["position_r"].max() < 0.5 and ring["position_z"].max() < 0.3 and (ring["velocity_z"] == 4).all()
        scene.advance()
        assert (numpy.diff(ring.copy("id")) > 0).all() and ring.copy("position").shape == (len(ring["id"]), 2)
        close(float(ring["mass"] @ ring["velocity_z"]) * scale, 4 * mass, 1e-10)
        assert scene.nodes["node_mass"].shape == (11, 7)
        assert scene.nodes.copy("node_mass").shape == (11, 7) and (scene.nodes.copy("node_mass") == scene.nodes["node_mass"] * scene.nodes.scale("node_mass")).all()


def test_blocks():
    """Of a mesh in several pieces: fields whole as copies, with the bits of one piece; pieces as views."""
    whole = floe.Scene(text=SPACE)
    with floe.Scene(text=SPACE, settings={"domain.blocks": [1, 2, 1]}) as scene:
        assert scene.mesh.blocks == 2
        refused(floe.InputError, "the deck asks for 2 blocks", scene.cells.__getitem__, "pressure")
        scene.step(), whole.step()
        assert (scene.cells.copy("pressure") == whole.cells["pressure"]).all()
        parts = [scene.cells.view("pressure", block) for block in range(2)]
        assert (numpy.concatenate(parts, axis=1) == whole.cells["pressure"]).all()
        refused(floe.InputError, "there is no block 2", scene.cells.view, "pressure", 2)


def test_memory():
    """An array holds what it shows; a closed scene whose arrays have gone is gone, callbacks or not; no array is torn away by restore."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "state.h5"
        seen = []
        scene = floe.Scene(INPUTS / "sod.yaml", settings=TUBE, after_step=lambda one: seen.append(one.step_count) and None)
        simulation = weakref.ref(scene._simulation)
        first = scene.cells["pressure"]
        kept = first.copy()
        scene.save(path)
        scene.step()
        later = scene.cells["pressure"].copy()
        scene.restore(path)
        assert scene.step_count == 0 and scene.time == 0 and (scene.cells["pressure"] == kept).all() and simulation() is not None
        scene.step()
        assert (scene.cells["pressure"] == later).all() and seen == [1, 1]
        refused(floe.FileError, "/dev/null", scene.restore, "/dev/null")
        refused(floe.FileError, "nowhere", scene.save, folder + "/nowhere/state.h5")
        assert scene.step_count == 1
        scene.close()
        refused(floe.InputError, "the scene is closed", scene.step)
        refused(floe.InputError, "the scene is closed", lambda: scene.cells["pressure"])
        assert simulation() is not None and math.isfinite(first.sum())  # of the first simulation
        del first
        gc.collect()
        assert simulation() is None
        other = floe.Scene(INPUTS / "sod.yaml", settings=TUBE)
        gone = weakref.ref(other), weakref.ref(other._simulation)
        del other
        assert gone[0]() is None and gone[1]() is None  # at once: nothing goes in circles


def test_callbacks():
    """They see every step, stop in order, may not step; what they raise comes out, and the scene goes on from there."""
    def early(scene):
        return scene.cells["pressure"].min() < 0.0999 or scene.step_count == 5

    calls = []
    with floe.Scene(INPUTS / "sod.yaml", settings=TUBE, before_step=lambda s: calls.append(s.step_count), after_step=early) as scene:
        assert scene.advance() is False and scene.step_count == 5 and calls == [0, 1, 2, 3, 4]
        assert scene.advance() is True and scene.finished

    def steps(scene):
        scene.step()

    def divides(scene):
        return 1 / (3 - scene.step_count)

    with floe.Scene(INPUTS / "sod.yaml", settings=TUBE, after_step=steps) as scene:
        refused(floe.InputError, "a callback must not step", scene.advance)
    for name, words in (("close", "a callback must not close"), ("restore", "a callback must not restore")):
        with floe.Scene(INPUTS / "sod.yaml", settings=TUBE, after_step=lambda s, name=name: getattr(s, name)(*(["x"] if name == "restore" else []))) as scene:
            refused(floe.InputError, words, scene.step)
    with floe.Scene(INPUTS / "sod.yaml", settings=TUBE, after_step=lambda s: divides(s) and None) as scene:
        refused(ZeroDivisionError, "division", scene.advance)
        assert scene.step_count == 3
        assert scene.advance() is True


def test_interrupt():
    """Ctrl-C ends `advance` after a step, and `run` with a checkpoint to go on from, to the same bits."""
    fine = {**TUBE, "domain.cell": 0.0005, "output.interval": None}
    with floe.Scene(INPUTS / "sod.yaml", settings=fine) as scene:
        timer = threading.Timer(0.05, _thread.interrupt_main, (signal.SIGINT,))
        timer.start()
        try:
            scene.advance()
        except KeyboardInterrupt:
            assert 0 < scene.step_count and not scene.finished
        else:
            raise AssertionError("not interrupted")
        timer.join()
    with tempfile.TemporaryDirectory() as folder:
        timer = threading.Timer(0.1, _thread.interrupt_main, (signal.SIGINT,))
        timer.start()
        try:
            floe.run(INPUTS / "sod.yaml", folder + "/stopped", settings=fine)
        except KeyboardInterrupt:
            timer.join()
            stopped = floe.run(INPUTS / "sod.yaml", folder + "/stopped", settings=fine, resume=True)
            whole = floe.run(INPUTS / "sod.yaml", folder + "/whole", settings=fine)
            assert (stopped.at(math.inf).field("pressure").values == whole.at(math.inf).field("pressure").values).all()
        else:
            raise AssertionError("not interrupted")


def test_runs():
    """`run` writes what the program writes."""
    with tempfile.TemporaryDirectory() as folder:
        result = floe.run(INPUTS / "sod.yaml", pathlib.Path(folder) / "sod", settings=TUBE)
        assert result.summary["status"] == "done" and (result.at(math.inf).field("pressure").values == floe.Result(SOD).at(math.inf).field("pressure").values).all()
        refused(floe.Interrupted, "", floe.run, INPUTS / "sod.yaml", folder + "/short", settings={**TUBE, "domain.cell": 0.0005}, max_wall=1e-6)


def test_errors():
    """Refused decks are exceptions with floe's text, every error with its place; settings are those of --set."""
    error = refused(floe.InputError, "unknown key 'cel' (did you mean 'cell'?)", floe.Scene, INPUTS / "sod.yaml", settings={"domain.cel": 1})
    assert isinstance(error, ValueError) and isinstance(error, floe.Error)
    refused(floe.FileError, "nowhere.yaml", floe.Scene, "nowhere.yaml")
    refused(floe.InputError, "deck:1:", floe.Scene, text="floe: 1\n")
    refused(TypeError, "file, or of its text", floe.Scene)
    refused(floe.InputError, "1 error", floe.Scene, text=SPACE, settings={"time.end": "1 kg"})
    with floe.Scene(text=SPACE, settings={"time.end": "2 ms", "domain.upper": numpy.array([0.3, 1.8, 2.4]), "domain.blocks": numpy.int64(1), "title": "x y"}) as scene:
        assert scene.end == 2e-3 and scene.mesh.cells == (3, 8, 4) and scene.title == "x y"
    assert library.load().version().decode().startswith(library.RELEASE + ".")


def test_warnings():
    """What will not be right is in `warnings`, and in the log of the name floe."""
    heard = []

    class Listener(logging.Handler):
        def emit(self, record):
            heard.append(record.getMessage())

    listener, log = Listener(), logging.getLogger("floe")
    log.addHandler(listener)
    log.propagate = False
    try:
        with floe.Scene(text=SPACE, settings={"output.probes": {"p": [0.1, 1.1, 2.1]}, "method.limiter": "none"}) as scene:
            for one in scene.warnings:
                assert any(one in line for line in heard), (one, heard)
        with floe.Scene(text=TURNED, settings={"method.limiter": "none"}) as scene:
            assert len(scene.warnings) > 0 and any(scene.warnings[0] in line for line in heard), (scene.warnings, heard)
    finally:
        log.removeHandler(listener)


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print(name, "ok")
