"""Tells how long a distance takes in Blender, and how much of that is the library's.

blender -b --factory-startup --python-exit-code 3 --python timing.py -- ZIP MESH [RUNS]

ZIP is the add-on, MESH an OBJ of triangles, gzipped or not. Each run is one call of the operator, from one selected vertex, until
the attribute is written; the time within calls of the library is measured in the same run, and what is left is the add-on's and
Blender's. Prints medians.
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
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module="taut_geodesics")
    return sys.modules["taut_geodesics"].taut


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


def median(clock, runs, **properties):
    """Seconds of a call, and the share of it that is not the library's."""
    samples = []
    for _ in range(runs):
        clock.seconds, start = 0.0, time.perf_counter()
        bpy.ops.taut.distance(**properties)
        whole = time.perf_counter() - start
        samples.append((whole, (whole - clock.seconds) / whole))
    return [statistics.median(column) for column in zip(*samples)]


def main(archive, path, runs="9"):
    taut = install(archive)
    target = load(path)
    clock = Clock(sys.modules[taut.__name__ + "._native"].library)
    everything = {"group": True, "material": True}
    print(f"Blender {bpy.app.version_string}, {pathlib.Path(path).name}, {len(target.data.polygons)} faces")
    for method in ("HEAT", "EXACT"):
        for what, outputs in (("attribute", {"colours": False}), ("all outputs", everything)):
            seconds, rest = median(clock, int(runs), method=method, **outputs)
            print(f"{method:6} {what:12} {1000 * seconds:6.0f} ms, not the library's: {rest:5.1%}")


main(*sys.argv[sys.argv.index("--") + 1 :])
sys.stdout.flush()
os._exit(0)
