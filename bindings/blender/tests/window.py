"""Drives the operators in Blender's window: the thread, progress, Esc, and meshes that change while it works.

Steps run from a timer, so that Blender's own loop goes on between them.
"""

import os
import pathlib
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import bpy
import host
import numpy as np

addon = host.install()
job = addon.job


def window():
    return bpy.context.window_manager.windows[0]


def press(key):
    for value in ("PRESS", "RELEASE"):
        window().event_simulate(type=key, value=value, x=400, y=400)


def invoke(operator, **properties):
    """As a button of the panel does."""
    area = next(area for area in window().screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window(), area=area, region=region):
        return operator("INVOKE_DEFAULT", **properties)


def sphere(subdivisions):
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    target = bpy.context.object
    host.select(target, [0])
    target.display_type = "BOUNDS"  # without a graphics card a frame of many triangles takes seconds
    return target


def wait(condition, seconds=60):
    """Yields until it holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it took too long"
        yield


def settle():
    """Lets the window draw itself, which takes long the first time."""
    for _ in range(50):
        yield


def running():
    return job._running


def begun():
    """The work has told some progress."""
    return running() is not None and running().watch.control.progress > 0


_refusals = []


def noting_refusals(function):
    """Runs a test, and notes why operators wrote nothing meanwhile."""
    refused = job.Operation._refused

    def noted(self, error):
        _refusals.append((type(error).__name__, str(error)))
        return refused(self, error)

    _refusals.clear()
    job.Operation._refused = noted
    try:
        yield from function()
    finally:
        job.Operation._refused = refused


class Gate:
    """Keeps the work from starting until the test opens it."""

    def __enter__(self):
        self._opened = threading.Event()
        self._field = field = addon.work.Solver.field

        def later(solver, *arguments):
            assert self._opened.wait(60)
            return field(solver, *arguments)

        addon.work.Solver.field = later
        return self

    def open(self):
        self._opened.set()

    def __exit__(self, *_):
        self.open()
        addon.work.Solver.field = self._field


def test_a_button_writes_and_the_window_lives():
    target = sphere(7)
    yield from settle()
    beats = []
    assert invoke(bpy.ops.taut.distance, method="EXACT") == {"RUNNING_MODAL"}
    shown = set()
    while running() is not None:
        beats.append(time.monotonic())
        shown.add(str(running()))
        yield
    assert not _refusals, _refusals
    assert len(shown) > 3, shown
    print(f"the longest of {len(beats)} beats of the window: {1000 * max(np.diff(beats)):.0f} ms")
    by_button = host.values(target)
    target.data.attributes.remove(target.data.attributes["geodesic_distance"])
    bpy.ops.taut.distance(method="EXACT")
    np.testing.assert_array_equal(host.values(target), by_button)


def test_undo_takes_back_what_a_button_wrote():
    sphere(4)
    bpy.ops.ed.undo_push(message="before")
    before = host.state()
    invoke(bpy.ops.taut.distance, group=True, material=True)
    yield from wait(lambda: running() is None)
    assert host.state() != before
    bpy.ops.ed.undo()
    assert host.state() == before, (host.state(), before)


def test_esc_cancels():
    sphere(8)
    yield from settle()
    before = host.state()
    invoke(bpy.ops.taut.distance, method="EXACT")
    yield from wait(begun)
    start = time.monotonic()
    press("ESC")
    yield from wait(lambda: running() is None, 5)
    print(f"cancelled {1000 * (time.monotonic() - start):.0f} ms after Esc")
    assert [kind for kind, _ in _refusals] == ["Cancelled"], _refusals
    assert host.state() == before


def test_a_second_button_waits_for_its_turn():
    sphere(2)
    with Gate() as gate:
        invoke(bpy.ops.taut.distance)
        first = running()
        try:
            invoke(bpy.ops.taut.voronoi)
            raise AssertionError("a second one ran")
        except RuntimeError as error:
            assert "Taut is still at work" in str(error), error
        assert running() is first
        gate.open()
        yield from wait(lambda: running() is None)
    assert not _refusals, _refusals


def _changed(change, message, prepare=lambda target: None):
    target = sphere(2)
    prepare(target)
    with Gate() as gate:
        invoke(bpy.ops.taut.distance)
        yield
        change(target)
        gate.open()
        yield from wait(lambda: running() is None)
    assert len(_refusals) == 1 and message in _refusals[0][1], _refusals
    assert not any("geodesic_distance" in mesh.attributes for mesh in bpy.data.meshes)


def test_a_moved_vertex_is_noticed():
    def change(target):
        target.data.vertices[5].co.x += 1

    yield from _changed(change, "has changed meanwhile")


def test_another_scale_is_noticed():
    def change(target):
        target.scale.x = 2
        bpy.context.view_layer.update()

    yield from _changed(change, "has changed meanwhile")


def test_another_mesh_is_noticed():
    def change(target):
        target.data = bpy.data.meshes.new("None")

    yield from _changed(change, "has no faces")


def test_a_deleted_object_is_noticed():
    yield from _changed(bpy.data.objects.remove, "is gone")


def test_undo_meanwhile_is_noticed():
    def prepare(target):
        bpy.ops.ed.undo_push(message="as it was")
        target.scale.x = 2
        bpy.ops.ed.undo_push(message="scaled")

    yield from _changed(lambda target: bpy.ops.ed.undo(), "has changed meanwhile", prepare)


def test_edit_mode_may_be_entered_meanwhile():
    target = sphere(2)
    with Gate() as gate:
        invoke(bpy.ops.taut.distance)
        bpy.ops.object.mode_set(mode="EDIT")
        gate.open()
        yield from wait(lambda: running() is None)
    assert not _refusals, _refusals
    assert target.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.isfinite(host.values(target)).all()


def test_another_file_may_be_opened_meanwhile():
    sphere(8)
    invoke(bpy.ops.taut.distance, method="EXACT")
    yield from wait(begun)
    work = running()
    bpy.ops.wm.read_homefile(use_empty=False)
    yield
    assert running() is None and work.is_done
    assert not any("geodesic_distance" in mesh.attributes for mesh in bpy.data.meshes)


def test_the_panel_draws():
    sphere(3)
    area = next(area for area in window().screen.areas if area.type == "VIEW_3D")
    area.spaces.active.show_region_ui = True
    drawn, errors = set(), []
    for cls in addon.panel.classes:
        cls.draw = noting(cls.draw, drawn, errors)
    sidebar = next(region for region in area.regions if region.type == "UI")
    for down in range(20, sidebar.height, 20):  # where the tab is
        x, y = sidebar.x + sidebar.width - 10, sidebar.y + sidebar.height - down
        for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
            window().event_simulate(type=kind, value=value, x=x, y=y)
            yield
        area.tag_redraw()
        for _ in range(10):
            yield
        if drawn:
            break
    assert not errors, errors
    assert drawn >= {"TAUT_PT_main", "TAUT_PT_distance", "TAUT_PT_isolines", "TAUT_PT_path"}, drawn


def noting(draw, drawn, errors):
    """The draw function of a panel, which notes that it has drawn, or why not."""

    def noted(self, context):
        try:
            draw(self, context)
            drawn.add(type(self).__name__)
        except Exception as error:
            errors.append(error)

    return noted


tests = [function for name, function in list(globals().items()) if name.startswith("test_")]
counts = {"ok": 0, "FAIL": 0}


def steps():
    """All tests, one after the other."""
    for test in tests:
        try:
            yield from noting_refusals(test)
            verdict = "ok"
        except Exception:
            host.traceback.print_exc(file=sys.stdout)
            job.stop()
            yield from wait(lambda: running() is None)
            verdict = "FAIL"
        counts[verdict] += 1
        print(f"{test.__name__} ... {verdict}", flush=True)
    print(f"counts: {counts['ok']} {counts['FAIL']}", flush=True)
    os._exit(1 if counts["FAIL"] else 0)


script = steps()
bpy.app.timers.register(host.guarded(lambda: next(script) or 0.01), first_interval=0.5, persistent=True)
