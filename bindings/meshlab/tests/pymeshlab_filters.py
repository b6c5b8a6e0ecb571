# Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
"""The filters in pymeshlab, that is in MeshLab since 2022.02: results are those of the library from outside.

    pymeshlab_filters.py PLUGIN REFERENCE FOLDER MESH...
"""

import math
import pathlib
import subprocess
import sys

import numpy as np
import pymeshlab

plugin, reference, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
folder.mkdir(parents=True, exist_ok=True)
pymeshlab.load_plugin(plugin)


def distances(mesh, *arguments):
    floats = np.frombuffer(subprocess.check_output([reference, mesh, *map(str, arguments)]), np.float32)
    return np.where(np.isinf(floats), np.float32(-1), floats)


def number_of_layers(meshes):
    return meshes.mesh_number() if hasattr(meshes, "mesh_number") else meshes.number_meshes()  # the latter in 2022.2


def refuses(meshes, filter_name, message, **parameters):
    before = meshes.current_mesh().vertex_scalar_array().copy()
    layers = number_of_layers(meshes)
    try:
        meshes.apply_filter(filter_name, **parameters)
    except pymeshlab.PyMeshLabException as error:
        assert message in str(error), error
        assert np.array_equal(before, meshes.current_mesh().vertex_scalar_array()) and number_of_layers(meshes) == layers
        return
    raise AssertionError(f"{filter_name} did not refuse: {message}")


# Once any filter of pymeshlab has failed, the next file crashes it if the MeshSet is gone.
alive = []


def test(path):
    meshes = pymeshlab.MeshSet()
    alive.append(meshes)
    meshes.load_new_mesh(path)
    surface = meshes.current_mesh()
    # What MeshLab has read, in all its digits.
    mesh = str(folder / "mesh.ply")
    meshes.save_current_mesh(mesh)
    start = int(surface.face_matrix()[0, 0])
    selection = np.zeros(surface.vertex_number(), bool)
    selection[start] = True
    refuses(meshes, "taut_distance", "no vertex is selected")
    meshes.compute_selection_by_condition_per_vertex(condselect=f"(vi == {start})")

    for method, name in enumerate(["exact", "heat"]):
        told = meshes.apply_filter("taut_distance", method=method)
        found = surface.vertex_scalar_array()
        wanted = distances(mesh, name, "vertices", start)
        assert np.array_equal(found.astype(np.float32), wanted), name
        assert told["farthest"] == found.max() and told["unreached"] == (found == -1).sum()
    meshes.apply_filter("taut_distance")
    found = surface.vertex_scalar_array()
    meshes.apply_filter("taut_isolines", count=5)
    lines = meshes.mesh(1)
    assert lines.edge_number() > 0 and len(np.unique(lines.vertex_scalar_array())) == 5

    end = int(found.argmax())
    to = [float(x) for x in surface.vertex_matrix()[end]]
    told = meshes.apply_filter("taut_shortest_path", sources="Selected vertices", targetpoint=to)
    line = meshes.mesh(2).vertex_matrix()
    length = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
    # MeshLab's parameters hold points as floats.
    assert math.isclose(told["length"], found[end], rel_tol=1e-6) and math.isclose(length, told["length"], rel_tol=1e-9)

    told = meshes.apply_filter("taut_voronoi_cells")
    assert told["seeds"] == 1 and set(surface.vertex_scalar_array()) <= {0, -1}
    refuses(meshes, "taut_distance", "not positive", method=1, timefactor=-1.0)
    print(path, surface.vertex_number(), "vertices")


for path in sys.argv[4:]:
    test(path)
