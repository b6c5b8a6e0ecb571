"""Drives the operators in Blender's window: the thread, progress, Esc, and meshes that change while it works.

Steps run from a timer, so that Blender's own loop goes on between them.
"""

import os
import pathlib
import sys
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
    for target in list(bpy.data.objects):
        bpy.data.objects.remove(target)
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    target = bpy.context.object
    host.select(target, [0])
    return target


def wait(condition, seconds=60):
    """Yields until it holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it took too long"
        yield


def running():
    return job._running


def begun():
    """The work has told some progress."""
    return running() is not None and running().watch.control.progress > 0


# What operators report goes to the window's log; the tests read it there.
_reports = []
_report = bpy.types.Operator.report


def reports(function):
    """Notes what the operators report."""
    for cls in addon.operators.classes:
        cls.report = lambda self, kind, message: _reports.append((*kind, message))
    try:
        yield from function()
    finally:
        for cls in addon.operators.classes:
            del cls.report


def test_a_button_writes_and_the_window_lives():
    target = sphere(6)
    beats = []
    bpy.ops.ed.undo_push(message="before")
    assert invoke(bpy.ops.taut.distance, method="EXACT") == {"RUNNING_MODAL"}
    shown = set()
    while running() is not None:
        beats.append(time.monotonic())
        shown.add(str(running()))
        yield
    assert _reports[-1][0] == "INFO", _reports
    assert len(shown) > 3, shown
    print(f"longest time between two beats of the window: {1000 * max(np.diff(beats)):.0f} ms, of {len(beats)} beats")
    by_button = host.values(target)
    target.data.attributes.remove(target.data.attributes["geodesic_distance"])
    bpy.ops.taut.distance(method="EXACT")
    np.testing.assert_array_equal(host.values(target), by_button)


def test_undo_takes_back_what_a_button_wrote():
    target = sphere(4)
    bpy.ops.ed.undo_push(message="before")
    before = host.state()
    invoke(bpy.ops.taut.distance, group=True, material=True)
    yield from wait(lambda: running() is None)
    assert host.state() != before
    bpy.ops.ed.undo()
    assert host.state() == before, (host.state(), before)


def test_esc_cancels():
    target = sphere(8)
    before = host.state()
    invoke(bpy.ops.taut.distance, method="EXACT")
    yield from wait(begun)
    start = time.monotonic()
    press("ESC")
    yield from wait(lambda: running() is None, 5)
    print(f"cancelled {1000 * (time.monotonic() - start):.0f} ms after Esc")
    assert _reports[-1] == ("WARNING", "Cancelled; nothing was written"), _reports
    assert host.state() == before


def test_a_second_button_waits_for_its_turn():
    sphere(8)
    invoke(bpy.ops.taut.distance, method="EXACT")
    yield from wait(begun)
    first = running()
    try:
        invoke(bpy.ops.taut.voronoi)
    except RuntimeError:
        pass  # as scripts see a refusal
    assert _reports[-1] == ("ERROR", "Taut is still at work; Esc cancels it"), _reports
    assert running() is first
    press("ESC")
    yield from wait(lambda: running() is None, 5)


def _changed(change, message):
    target = sphere(6)
    invoke(bpy.ops.taut.distance, method="EXACT")
    yield from wait(begun)
    assert not running().is_done
    change(target)
    yield from wait(lambda: running() is None)
    assert _reports[-1][0] == "ERROR" and message in _reports[-1][1], _reports
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


def test_edit_mode_may_be_entered_meanwhile():
    target = sphere(6)
    invoke(bpy.ops.taut.distance, method="EXACT")
    yield from wait(begun)
    bpy.ops.object.mode_set(mode="EDIT")
    yield from wait(lambda: running() is None)
    assert _reports[-1][0] == "INFO", _reports
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
    for area in window().screen.areas:
        if area.type == "VIEW_3D":
            area.spaces.active.show_region_ui = True
    bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)
    drawn = []
    for cls in addon.panel.classes:
        draw = cls.draw
        cls.draw = lambda self, context, draw=draw: (draw(self, context), drawn.append(type(self)))
    yield


tests = [function for name, function in list(globals().items()) if name.startswith("test_")]
counts = {"ok": 0, "FAIL": 0}


def steps():
    """All tests, one after the other."""
    for test in tests:
        _reports.clear()
        try:
            yield from reports(test)
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
