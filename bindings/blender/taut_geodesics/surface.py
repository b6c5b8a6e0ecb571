"""Reads meshes of Blender as numpy arrays: triangles, selection, cursor. Main thread only."""

from contextlib import contextmanager
from dataclasses import dataclass
from typing import NamedTuple

import bmesh
import bpy
import numpy as np

_CARRIER = ".taut_selected"


class Problem(Exception):
    """What keeps an operator from its work, told to the user as it is."""


@dataclass(frozen=True)
class Surface:
    """A copy of a mesh: the triangles that Blender shows, so that concave faces are cut as they are seen.

    Attributes
    ----------
    positions : (V, 3) float32
        In the object's own space.
    triangles : (F, 3) uint32
    faces : (F,) uint32
        The face of Blender that each triangle is a part of, ascending.
    linear : (3, 3) float64
        Rotation, scale and shear of the object: with it positions are those of the world, but for a translation.
    is_object : bool
        Whether vertex v is vertex v of the object: not if modifiers make others.
    """

    positions: np.ndarray
    triangles: np.ndarray
    faces: np.ndarray
    linear: np.ndarray
    is_object: bool

    @property
    def face_count(self):
        return int(self.faces[-1]) + 1 if len(self.faces) else 0

    def world(self, points):
        """Points of the object's space in the world, but for the translation: (n, 3)."""
        if np.array_equal(self.linear, np.eye(3)):
            return points
        x, y, z = np.ascontiguousarray(points.T, np.float64)
        out = np.empty((len(points), 3))
        for i, (a, b, c) in enumerate(self.linear):
            out[:, i] = a * x + b * y + c * z
        return out

    def same_as(self, other):
        return all(
            np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
            for a, b in (
                (self.positions, other.positions),
                (self.triangles, other.triangles),
                (self.faces, other.faces),
                (self.linear, other.linear),
            )
        )


class Places(NamedTuple):
    """Where to measure from: vertices, faces with their centres, points."""

    vertices: np.ndarray = np.empty(0, np.int64)
    faces: np.ndarray = np.empty(0, np.int64)
    face_centres: np.ndarray = np.empty((0, 3), np.float32)  # in the object's space
    points: np.ndarray = np.empty((0, 3))  # in the world, less the object's translation

    @property
    def total(self):
        return len(self.vertices) + len(self.faces) + len(self.points)


@contextmanager
def object_mode(target):
    """Leaves edit mode, in which neither attributes nor modifiers can be had, for a while."""
    mode = target.mode
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)


@contextmanager
def _mesh_of(target, evaluated):
    """The mesh as it is now, or as modifiers and shape keys make it."""
    if not evaluated:
        target.update_from_editmode()
        yield target.data
        return
    with object_mode(target):
        result = target.evaluated_get(bpy.context.evaluated_depsgraph_get())
        try:
            yield result.to_mesh()
        finally:
            result.to_mesh_clear()


def read(target, evaluated):
    """The surface of an object."""
    with _mesh_of(target, evaluated) as mesh:
        if len(mesh.polygons) == 0:
            raise Problem(f"{target.name} has no faces")
        triangles, faces = _triangles(mesh)
        return Surface(
            _positions(mesh),
            triangles,
            faces,
            np.array(target.matrix_world.to_3x3(), np.float64),
            not evaluated or len(mesh.vertices) == len(target.data.vertices),
        )


def _filled(items, name, dtype, width=1):
    out = np.empty(len(items) * width, dtype)
    items.foreach_get(name, out)
    return out if width == 1 else out.reshape(-1, width)


def _generic(mesh, name):
    """The data of a built-in attribute, which newer versions copy at once; None in edit mode and in older versions."""
    attribute = None if mesh.is_editmode else mesh.attributes.get(name)
    return attribute and attribute.data


def _positions(mesh):
    data = _generic(mesh, "position")
    return _filled(data, "vector", np.float32, 3) if data else _filled(mesh.vertices, "co", np.float32, 3)


def _triangles(mesh):
    """The triangles, and the face of each. A face has three corners at least: as many times three as faces are triangles.

    Blender copies such indices at once into unsigned numbers, one by one into signed ones.
    """
    if len(mesh.loops) == 3 * len(mesh.polygons):
        data = _generic(mesh, ".corner_vert")
        corners = _filled(data, "value", np.int32) if data else _filled(mesh.loops, "vertex_index", np.uint32)
        return corners.view(np.uint32).reshape(-1, 3), np.arange(len(mesh.polygons), dtype=np.uint32)
    mesh.calc_loop_triangles()
    triangles = mesh.loop_triangles
    return _filled(triangles, "vertices", np.uint32, 3), _filled(triangles, "polygon_index", np.uint32)


def selected_vertices(target, evaluated=False):
    """The selected vertices, ascending. Of vertices that modifiers make, those that are copies of selected ones alone."""
    target.update_from_editmode()
    selected = _filled(target.data.vertices, "select", bool)
    if not evaluated:
        return np.flatnonzero(selected)
    with object_mode(target):
        return _selected_of_evaluated(target, selected)


def _selected_of_evaluated(target, selected):
    """Each selected vertex gets a random vector. Modifiers hand it on to copies, and blend it elsewhere."""
    vectors = np.zeros((len(selected), 3), np.float32)
    vectors[selected] = np.random.default_rng(0).random((np.count_nonzero(selected), 3), np.float32)
    attributes = target.data.attributes
    carrier = attributes.new(_CARRIER, "FLOAT_VECTOR", "POINT")
    try:
        carrier.data.foreach_set("vector", vectors.ravel())
        target.data.update()
        with _mesh_of(target, True) as mesh:
            carried = mesh.attributes.get(_CARRIER)
            if carried is None:
                raise Problem(f"the modifiers of {target.name} do not tell which vertices were selected; use the 3D cursor")
            found = _filled(carried.data, "vector", np.float32, 3)
    finally:
        attributes.remove(attributes[_CARRIER])
    bits = [array.view("V12")[:, 0] for array in (found, vectors[selected])]
    return np.flatnonzero(np.isin(*bits))


def selected_faces(target, evaluated):
    """The selected faces, ascending; of the faces that modifiers make, those that come from selected ones."""
    with _mesh_of(target, evaluated) as mesh:
        return np.flatnonzero(_filled(mesh.polygons, "select", bool))


def face_centres(target, evaluated):
    """The centre of each face in the object's space, the mean of its corners: (P, 3)."""
    with _mesh_of(target, evaluated) as mesh:
        return _filled(mesh.polygons, "center", np.float32, 3)


def selection_history(target):
    """The selected vertices in the order in which they were selected; None where Blender does not have it of all."""
    if target.mode != "EDIT":
        return None
    history = bmesh.from_edit_mesh(target.data).select_history
    vertices = [element.index for element in history if isinstance(element, bmesh.types.BMVert)]
    return np.array(vertices) if set(vertices) == set(selected_vertices(target)) else None


def attribute(target, name, evaluated):
    """The numbers that an attribute has at the vertices: (V,) float32."""
    with object_mode(target), _mesh_of(target, evaluated) as mesh:
        found = mesh.attributes.get(name)
        if found is None or (found.data_type, found.domain) != ("FLOAT", "POINT"):
            raise Problem(f"{target.name} has no attribute {name or 'without a name'} of numbers at its vertices")
        return _filled(found.data, "value", np.float32)


def cursor(context, target):
    """The 3D cursor in the world, less the object's translation: (1, 3)."""
    return np.array([context.scene.cursor.location - target.matrix_world.translation], np.float64)


def places(context, target, surface, source, evaluated):
    """What an operator's property `source` stands for."""
    if source == "CURSOR":
        return Places(points=cursor(context, target))
    if source == "FACES":
        found = selected_faces(target, evaluated)
        places = Places(faces=found, face_centres=face_centres(target, evaluated)[found])
    else:
        found = selected_vertices(target, not surface.is_object)
        places = Places(vertices=found)
    if len(found) == 0:
        raise Problem(f"no {'face' if source == 'FACES' else 'vertex'} of {target.name} is selected")
    return places
