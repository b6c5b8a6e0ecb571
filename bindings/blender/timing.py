"""Tells how long a distance takes in Blender, and how much of that is the library's.

blender -b --factory-startup --python-exit-code 3 --python timing.py -- ZIP MESH [RUNS]

ZIP is the add-on, MESH an OBJ of triangles, gzipped or not. Each run is one call of the operator, from one selected vertex, until
all is written; the time within calls of the library is measured in the same run, and what is left is the add-on's and Blender's.
Beside it stands the time with Blender's update of the scene, before and after. Prints medians.
"""

import gzip
import os
import pathlib
import statistics
import sys
import tempfile
import time

import bpy
import numpy as np


def install(archive):
    """The add-on of the zip, not the folder beside this file."""
    sys.path[:] = [folder for folder in sys.path if pathlib.Path(folder).resolve() != pathlib.Path(__file__).resolve().parent]
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module="taut_geodesics")
    return sys.modules["taut_geodesics"]


def load(path):
    opened = gzip.open(path, "rb") if path.endswith(".gz") else open(path, "rb")
    with opened as source, tempfile.NamedTemporaryFile(suffix=".obj") as plain:
        plain.write(source.read())
        plain.flush()
        bpy.ops.wm.obj_import(filepath=plain.name)
    target = bpy.context.selected_objects[0]
    bpy.context.view_layer.objects.active = target
    mesh = target.data
    flags = np.zeros(len(mesh.vertices), bool)
    flags[mesh.loops[0].vertex_index] = True
    mesh.vertices.foreach_set("select", flags)
    return target


class Clock:
    """Adds up the time within functions of the library."""

    def __init__(self, library):
        self.seconds = 0.0
        for name in ("taut_mesh_new", "taut_exact_new", "taut_exact_field_new", "taut_exact_field_distances", "taut_heat_new",
                     "taut_heat_field_new", "taut_heat_field_distances", "taut_mesh_free", "taut_exact_free",
                     "taut_exact_field_free", "taut_heat_free", "taut_heat_field_free"):
            setattr(library, name, self.timed(getattr(library, name)))

    def timed(self, function):
        def called(*arguments):
            start = time.perf_counter()
            try:
                return function(*arguments)
            finally:
                self.seconds += time.perf_counter() - start

        return called


def timed_execute(cls, seconds):
    """Lets an operator note how long it works."""
    execute = cls.execute

    def noted(self, context):
        start = time.perf_counter()
        try:
            return execute(self, context)
        finally:
            seconds.append(time.perf_counter() - start)

    cls.execute = noted


def median(clock, seconds, runs, **properties):
    """Seconds until all is written, the share of them that is not the library's, and seconds with the scene's update."""
    samples = []
    for _ in range(runs):
        clock.seconds, start = 0.0, time.perf_counter()
        bpy.ops.taut.distance(**properties)
        written = seconds.pop()
        samples.append((written, 1 - clock.seconds / written, time.perf_counter() - start))
    return [statistics.median(column) for column in zip(*samples)]


def main(archive, path, runs="9"):
    addon = install(archive)
    target = load(path)
    clock, seconds = Clock(addon.taut._native.library), []
    timed_execute(addon.operators.TAUT_OT_distance, seconds)
    everything = {"group": True, "material": True}
    print(f"Blender {bpy.app.version_string}, {pathlib.Path(path).name}, {len(target.data.polygons)} faces")
    for method in ("HEAT", "EXACT"):
        for what, outputs in (("attribute", {"colours": False}), ("all outputs", everything)):
            written, rest, updated = median(clock, seconds, int(runs), method=method, **outputs)
            print(f"{method:6} {what:12} {1000 * written:4.0f} ms, not the library's: {rest:5.1%};"
                  f" with the update of the scene {1000 * updated:4.0f} ms")


main(*sys.argv[sys.argv.index("--") + 1 :])
sys.stdout.flush()
os._exit(0)  # the module bpy may wait for ever where Python ends by itself
