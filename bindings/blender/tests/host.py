"""What the tests share inside Blender: the add-on installed from its zip, meshes, and the library called outside Blender.

The environment says where things are; `test` sets it.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import traceback
import unittest

import bmesh
import bpy
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
MESHES = pathlib.Path(os.environ["TAUT_MESHES"])
CORPUS = pathlib.Path(os.environ["TAUT_CORPUS"]) if os.environ.get("TAUT_CORPUS") else None


def install():
    """Installs the add-on as a user does; the module of the add-on."""
    archive = os.environ["TAUT_ZIP"]
    if os.environ["TAUT_INSTALL"] == "extension":
        bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
        return sys.modules["bl_ext.user_default.taut_geodesics"]
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module="taut_geodesics")
    return sys.modules["taut_geodesics"]


def outside(expression, **arrays):
    """The value of an expression over `taut`, `np` and these arrays, computed by another process."""
    with tempfile.TemporaryDirectory() as folder:
        given, out = os.path.join(folder, "in.npz"), os.path.join(folder, "out.npy")
        np.savez(given, **arrays)
        env = {**os.environ, "PYTHONPATH": os.environ["TAUT_PACKAGE"], "TAUT_LIBRARY": os.environ["TAUT_OUTSIDE"]}
        subprocess.run([os.environ["TAUT_PYTHON"], HERE / "outside.py", expression, given, out], check=True, env=env)
        return np.load(out)


def read(path):
    """Positions, as float32, and triangles of a file."""
    positions = outside("taut.Mesh.read(str(path)).positions", path=str(path))
    return positions.astype(np.float32), outside("taut.Mesh.read(str(path)).triangles", path=str(path))


def empty_scene():
    bpy.ops.wm.read_homefile(use_empty=True)


def add(positions, faces, name="Thing"):
    """An active object with this mesh, nothing of it selected."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.asarray(positions).tolist(), [], [list(map(int, face)) for face in faces])
    target = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(target)
    bpy.context.view_layer.objects.active = target
    target.select_set(True)
    select(target)
    return target


def select(target, vertices=(), faces=()):
    """Selects these vertices and faces alone, in object mode."""
    for items, chosen in ((target.data.vertices, vertices), (target.data.edges, ()), (target.data.polygons, faces)):
        flags = np.zeros(len(items), bool)
        flags[list(chosen)] = True
        items.foreach_set("select", flags)


def select_in_order(target, vertices):
    """In edit mode, one after the other."""
    edited = bmesh.from_edit_mesh(target.data)
    edited.verts.ensure_lookup_table()
    for vertex in edited.verts:
        vertex.select = False
    edited.select_history.clear()
    for v in vertices:
        edited.verts[v].select = True
        edited.select_history.add(edited.verts[v])
    bmesh.update_edit_mesh(target.data)


def storing(name, kind):
    """Geometry nodes that give the vertices an attribute."""
    group = bpy.data.node_groups.new("Store", "GeometryNodeTree")
    if hasattr(group, "interface"):
        group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    store = group.nodes.new("GeometryNodeStoreNamedAttribute")
    store.data_type = kind
    store.inputs["Name"].default_value = name
    group.links.new(group.nodes.new("NodeGroupInput").outputs[0], store.inputs["Geometry"])
    group.links.new(store.outputs["Geometry"], group.nodes.new("NodeGroupOutput").inputs[0])
    return group


def values(target, name="geodesic_distance", dtype=np.float32):
    data = target.data.attributes[name].data
    out = np.empty(len(data), dtype)
    data.foreach_get("value", out)
    return out


def splines(target):
    """The points of each spline, and whether it is closed."""
    found = []
    for spline in target.data.splines:
        points = np.empty(4 * len(spline.points), np.float32)
        spline.points.foreach_get("co", points)
        found.append((points.reshape(-1, 4)[:, :3], spline.use_cyclic_u))
    return found


def state():
    """What undo must restore: objects, meshes, materials, attributes, groups, modes, selections."""
    data = {
        target.name: (
            target.mode,
            sorted(a.name for a in target.data.attributes if not a.name.startswith(".") and a.name != "material_index"),
            [group.name for group in target.vertex_groups],
            [material.name for material in target.data.materials],
            [v.index for v in target.data.vertices if v.select] if target.mode == "OBJECT" else None,
        )
        for target in bpy.data.objects
        if target.type == "MESH"
    }
    return data, sorted(o.name for o in bpy.data.objects), sorted(m.name for m in bpy.data.materials)


def main(module):
    """Runs the tests of a module, and ends the process: 0, or 1 after failures."""
    suite = unittest.defaultTestLoader.loadTestsFromModule(module)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
    failed = len({getattr(case, "test_case", case).id() for case, _ in result.failures + result.errors})
    print(f"counts: {result.testsRun - failed} {failed}", flush=True)
    # The module bpy may wait for ever where Python ends by itself.
    os._exit(1 if failed else 0)


def guarded(function):
    """Runs a step outside unittest; what it raises ends the process."""

    def run(*arguments):
        try:
            return function(*arguments)
        except Exception:
            traceback.print_exc()
            sys.stdout.flush()
            os._exit(1)

    return run
