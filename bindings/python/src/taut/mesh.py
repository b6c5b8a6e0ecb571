"""Meshes, and what is known about them."""

from __future__ import annotations

import ctypes
import os
from typing import Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._buffers import (
    AnyArray,
    Indices,
    Reals,
    filled,
    indices,
    input_indices,
    input_reals,
    output,
    real_output,
)
from ._errors import InvalidArgument, check
from ._handle import Handle, Owner, made
from ._native import Finding, Format, Reason, TimeFormula, TimeScale, library
from ._options import choice


class TimeStep:
    """The time step t of the heat flow: a formula times a factor, or a value. C: ``taut_time_step``.

    Wherever a time step is asked for, a number stands for t itself and a string for a formula.

    Parameters
    ----------
    formula : str
        From the mean e and the standard deviation s of the edge lengths: "mean_edge", t = e² (Crane, Weischedel and
        Wardetzky, Geodesics in Heat, 2013); and of "Wave propagation time optimization for geodesic distances calculation
        using the Heat Method" (2019) "sigma", t = s (Eq. 2); "mean_sigma", t = (e² + s) / 2 (Eq. 3); "median_fit",
        t = 1.01204 s - 0.0001 (Eq. 4); "median_mean", t = (e² + 1.01204 s - 0.0001) / 2 (Eq. 5).
    scale : str
        The size that the formula is evaluated at, which matters because Eq. 2 to 5 set an area to lengths: "paper", a
        bounding box with the diagonal 24.976, or "raw", the mesh's own units. t itself is always in mesh units squared.
    factor : float
        Multiplies what the formula gives; positive.
    """

    __slots__ = ("factor", "formula", "scale", "t")

    def __init__(self, formula: str = "mean_edge", scale: str = "paper", factor: float = 1.0) -> None:
        choice(TimeFormula, formula, "formula")
        choice(TimeScale, scale, "scale")
        self.formula: str | None = formula
        self.scale: str | None = scale
        self.factor = _positive(factor, "factor")
        self.t: float | None = None

    @classmethod
    def value(cls, t: float) -> TimeStep:
        """t itself, positive, in mesh units squared."""
        step = cls()
        step.formula = step.scale = None
        step.t = _positive(t, "time step")
        return step

    def _key(self) -> tuple[Any, ...]:
        return self.formula, self.scale, self.factor, self.t

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TimeStep) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __reduce__(self) -> Any:
        if self.t is not None:
            return TimeStep.value, (self.t,)
        return TimeStep, (self.formula, self.scale, self.factor)

    def __repr__(self) -> str:
        if self.t is not None:
            return f"TimeStep.value({self.t!r})"
        return f"TimeStep({self.formula!r}, {self.scale!r}, {self.factor!r})"

    def _c(self) -> _native.taut_time_step:
        if self.t is not None:
            return _native.taut_time_step(value=self.t)
        formula = choice(TimeFormula, self.formula, "formula")
        return _native.taut_time_step(formula, choice(TimeScale, self.scale, "scale"), self.factor)


TimeStepLike = Union[TimeStep, float, str, None]


def _positive(number: float, name: str) -> float:
    # 0 would be the default to C.
    if not number > 0:
        raise InvalidArgument(f"the {name} {number} is not positive", reason=Reason.BAD_TIME_STEP)
    return float(number)


def time_step_of(step: TimeStepLike) -> TimeStep:
    """What stands for a time step."""
    if step is None:
        return TimeStep()
    if isinstance(step, TimeStep):
        return step
    return TimeStep(step) if isinstance(step, str) else TimeStep.value(step)


class Properties(NamedTuple):
    """Statistics of a mesh's edges and angles, those of the paper of 2019 that `TimeStep` names.

    Each edge counts once; lengths in mesh units, angles in radians.
    """

    vertices: int
    edges: int
    faces: int
    mean_edge: float
    variance_edge: float
    sigma_edge: float
    mean_absolute_deviation: float
    median_absolute_deviation: float
    min_edge: float
    max_edge: float
    edge_ratio: float
    q1: float
    q2: float
    q3: float
    quartile_deviation: float
    min_angle: float
    max_angle: float
    anisotropy: float
    paper_scale: float


class Component(NamedTuple):
    """A connected part of a mesh. V - E + F is its Euler characteristic."""

    vertices: int
    edges: int
    faces: int
    first_vertex: int
    boundary_loops: int
    manifold: bool
    orientable: bool
    genus: int


class BoundaryLoop(NamedTuple):
    """A chain of edges with one triangle, and whether it ends where it begins."""

    vertices: Indices
    closed: bool


class Angle(NamedTuple):
    """An interior angle of a triangle, in radians; NaN where the mesh has no triangle."""

    radians: float
    face: int
    vertex: int


class MeshReport(NamedTuple):
    """What is unusual about a mesh. Nothing of it is an error. C: ``taut_report``.

    Attributes
    ----------
    components : list of Component
        Connected parts, by their smallest vertex.
    component_of : (V,) int64
        The component of each vertex, -1 for one that no triangle uses.
    nonorientable_components : (n,) int64
        Places among the components.
    boundary_loops : list of BoundaryLoop
        Chains of edges with one triangle.
    nonmanifold_edges : (n, 2) int64
        Edges of more than two triangles.
    nonmanifold_vertices : (n,) int64
        Vertices whose triangles fall into several fans.
    inconsistent_edges : (n, 2) int64
        Edges between two triangles of which one is turned over.
    zero_area_faces, repeated_index_faces : (n,) int64
        Triangles without area; triangles that repeat a vertex, which are ignored.
    duplicate_faces, duplicate_vertices : (n, 2) int64
        Triangles with the vertices of an earlier one, vertices at the place of an earlier one; each with that one.
    unreferenced_vertices : (n,) int64
        Vertices that no triangle uses.
    smallest_angle, largest_angle : Angle
        The extreme interior angles.
    """

    components: list[Component]
    component_of: Indices
    nonorientable_components: Indices
    boundary_loops: list[BoundaryLoop]
    nonmanifold_edges: Indices
    nonmanifold_vertices: Indices
    inconsistent_edges: Indices
    zero_area_faces: Indices
    repeated_index_faces: Indices
    duplicate_faces: Indices
    duplicate_vertices: Indices
    unreferenced_vertices: Indices
    smallest_angle: Angle
    largest_angle: Angle


class Mesh(Owner):
    """A mesh, checked once and then immutable: any soup of triangles. C: ``taut_mesh``.

    Vertex v of the mesh is vertex v of its input. What no triangle joins is not connected: equal positions are not merged.

    Parameters
    ----------
    positions : (V, 3) array_like of real numbers
        The vertices, in mesh units. A vertex that a triangle uses must be finite.
    triangles : (F, 3) array_like of integers, (F, k) array_like, or sequence of polygons
        Vertex indices. Polygons become fans of triangles from their first corner. A triangle that repeats an index is kept
        but ignored: nothing travels over it.

    Raises
    ------
    InvalidMesh
        Naming the face with a bad index, or the vertex that is not finite.

    Notes
    -----
    O(V + F) time and memory. Arrays of float32, float64, uint16, int32, uint32, int64 and uint64 are read where they are.

    Examples
    --------
    >>> square = taut.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 3), (1, 2, 3)])
    >>> square
    Mesh(vertices=4, triangles=2)
    >>> taut.ExactSolver(square).compute_distance(0).round(3)
    array([0.   , 1.   , 1.414, 1.   ])
    """

    _kind = _native.taut_mesh

    def __init__(self, positions: npt.ArrayLike, triangles: Any) -> None:
        places = input_reals(positions, "positions", 3)
        faces = _as_array(triangles)
        if faces is not None and (faces.shape == (0,) or faces.shape[1:] == (3,)):
            corners = input_indices(faces, "triangles", 3)
            self._handle = made(self._kind, library.taut_mesh_new, places, corners)
        else:
            self._handle = _polygons(places, *_fans(triangles if faces is None else faces))

    @classmethod
    def _of(cls, handle: Handle) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._handle = handle
        return mesh

    @classmethod
    def polygons(cls, positions: npt.ArrayLike, offsets: npt.ArrayLike, corners: npt.ArrayLike) -> Mesh:
        """A mesh of polygons; each becomes a fan of triangles from its first corner. C: ``taut_mesh_new_polygons``.

        Parameters
        ----------
        positions : (V, 3) array_like of real numbers
        offsets : (P + 1,) array_like of integers
            Face f has the corners from ``offsets[f]`` up to, not including, ``offsets[f + 1]``: at least three.
        corners : (n,) array_like of integers
            The vertices of all faces, one face after another.

        Raises
        ------
        InvalidMesh
            Naming the face whose offsets, corners or indices are wrong, or the vertex that is not finite.
        """
        return cls._of(_polygons(input_reals(positions, "positions", 3), offsets, corners))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Mesh:
        """Read an OBJ, OFF, PLY, STL or GLB file, by its suffix; .gz as well. C: ``taut_mesh_read``.

        Raises
        ------
        IoError
            Where the file cannot be read.
        FormatError
            Naming the line, vertex or face where it does not follow its format.
        """
        return cls._of(made(cls._kind, library.taut_mesh_read, os.fspath(path).encode()))

    @classmethod
    def read_bytes(cls, data: bytes, format: str) -> Mesh:
        """Read the content of a file: `format` is "obj", "off", "ply", "stl" or "glb". C: ``taut_mesh_read_bytes``."""
        kind = choice(Format, format, "format")
        view = np.frombuffer(data, np.uint8)
        return cls._of(made(cls._kind, library.taut_mesh_read_bytes, view.ctypes.data, view.size, kind))

    @property
    def vertex_count(self) -> int:
        """How many vertices there are, those that no triangle uses included."""
        return int(library.taut_mesh_vertex_count(self._pointer))

    @property
    def triangle_count(self) -> int:
        """How many triangles there are, ignored ones included; a polygon of n corners counts n - 2."""
        return int(library.taut_mesh_triangle_count(self._pointer))

    @property
    def positions(self) -> Reals:
        """(V, 3) float64, read-only: a copy, made when asked for."""
        return filled(library.taut_mesh_positions, (self.vertex_count, 3), np.float64, self._pointer)

    @property
    def triangles(self) -> Indices:
        """(F, 3) int64, read-only: a copy, made when asked for."""
        return filled(library.taut_mesh_triangles, (self.triangle_count, 3), np.int64, self._pointer)

    @property
    def ignored_triangles(self) -> Indices:
        """The triangles that repeat a vertex index, ascending; int64, read-only."""
        count = library.taut_mesh_ignored_count(self._pointer)
        return filled(library.taut_mesh_ignored_triangles, (count,), np.int64, self._pointer)

    def with_positions(self, positions: npt.ArrayLike) -> Mesh:
        """The same triangles with the vertices in other places: a mesh that moves. C: ``taut_mesh_with_positions``.

        `HeatSolver.with_mesh` then saves most of a solver's preparation.
        """
        places = input_reals(positions, "positions", 3)
        return Mesh._of(made(self._kind, library.taut_mesh_with_positions, self._pointer, places))

    def point_positions(
        self, faces: npt.ArrayLike, barycentrics: npt.ArrayLike, out: AnyArray | None = None
    ) -> AnyArray:
        """Where points of the surface lie in space. C: ``taut_mesh_point_positions``.

        Parameters
        ----------
        faces : (n,) array_like of integers
            The triangle of each point.
        barycentrics : (n, 3) array_like of real numbers
            The weights of its corners: not negative, their sum 1 up to 1e-6.
        out : (n, 3) float64 or float32 array, optional
            Is filled and returned.

        Raises
        ------
        InvalidArgument
            Naming the point, or the face that the mesh does not have.
        """
        triangles = indices(faces, "faces")
        result = real_output(out, (triangles.shape[0], 3))
        weights = input_reals(barycentrics, "barycentrics", 3)
        points = input_indices(triangles, "faces")
        check(library.taut_mesh_point_positions(self._pointer, points, weights, output(result)))
        return result

    def time_step(self, step: TimeStepLike = None) -> float:
        """The time step t that the heat method would get, in mesh units squared. C: ``taut_time_step_value``."""
        t = ctypes.c_double()
        check(library.taut_time_step_value(self._pointer, time_step_of(step)._c(), ctypes.byref(t)))
        return t.value

    def properties(self) -> Properties:
        """Statistics of edges and angles. O(E log E). C: ``taut_mesh_properties``.

        Raises
        ------
        InvalidArgument
            Where the mesh has no edge.
        """
        properties = _native.taut_properties()
        check(library.taut_mesh_properties(self._pointer, ctypes.byref(properties)))
        return Properties(*(getattr(properties, name) for name in Properties._fields))

    def report(self) -> MeshReport:
        """What is unusual about the mesh. O(V log V + F log F). C: ``taut_report_new``."""
        return _report(made(_native.taut_report, library.taut_report_new, self._pointer), self.vertex_count)

    def __repr__(self) -> str:
        return f"Mesh(vertices={self.vertex_count}, triangles={self.triangle_count})"

    def __eq__(self, other: object) -> bool:
        """Whether `other` is a mesh of the same triangles and the same positions, to the bit."""
        if not isinstance(other, Mesh):
            return NotImplemented
        return self is other or (
            np.array_equal(self.triangles, other.triangles)
            and self.positions.tobytes() == other.positions.tobytes()
        )

    def __hash__(self) -> int:
        return hash((self.vertex_count, self.triangle_count))

    def __reduce__(self) -> Any:
        return Mesh, (self.positions, self.triangles)


def _size(face: Any) -> int:
    return len(face) if hasattr(face, "__len__") else 0


def _as_array(faces: Any) -> AnyArray | None:
    """An array of integers, or None where faces have different numbers of corners."""
    if isinstance(faces, (list, tuple)) and len({_size(face) for face in faces}) > 1:
        return None
    array = np.asarray(faces)
    return None if array.dtype == object else array


def _fans(polygons: Any) -> tuple[AnyArray, AnyArray]:
    """Offsets and corners of polygons."""
    if isinstance(polygons, np.ndarray) and polygons.dtype != object:
        if polygons.ndim != 2:
            raise InvalidArgument(f"triangles must have the shape (n, 3), not {polygons.shape}")
        return np.arange(polygons.shape[0] + 1) * polygons.shape[1], polygons.reshape(-1)
    offsets = np.zeros(len(polygons) + 1, np.int64)
    np.cumsum([len(face) for face in polygons], out=offsets[1:])
    return offsets, np.concatenate([np.asarray(face) for face in polygons if len(face)])


def _polygons(places: Any, offsets: npt.ArrayLike, corners: npt.ArrayLike) -> Handle:
    starts, vertices = input_indices(offsets, "offsets"), input_indices(corners, "corners")
    return made(Mesh._kind, library.taut_mesh_new_polygons, places, starts, vertices)


def _report(handle: Handle, vertex_count: int) -> MeshReport:
    pointer = handle.pointer

    def listed(finding: Finding, width: int | None = None) -> AnyArray:
        count = library.taut_report_count(pointer, finding)
        shape = (count,) if width is None else (count, width)
        return filled(library.taut_report_list, shape, np.int64, pointer, finding)

    smallest, largest = _native.taut_angle(), _native.taut_angle()
    check(library.taut_report_angles(pointer, ctypes.byref(smallest), ctypes.byref(largest)))
    return MeshReport(
        components=[_component(pointer, i) for i in range(library.taut_report_count(pointer, Finding.COMPONENTS))],
        component_of=filled(library.taut_report_component_of, (vertex_count,), np.int64, pointer),
        nonorientable_components=listed(Finding.NONORIENTABLE_COMPONENTS),
        boundary_loops=_boundary_loops(pointer, listed(Finding.BOUNDARY_LOOPS, 2)),
        nonmanifold_edges=listed(Finding.NONMANIFOLD_EDGES, 2),
        nonmanifold_vertices=listed(Finding.NONMANIFOLD_VERTICES),
        inconsistent_edges=listed(Finding.INCONSISTENT_EDGES, 2),
        zero_area_faces=listed(Finding.ZERO_AREA_FACES),
        repeated_index_faces=listed(Finding.REPEATED_INDEX_FACES),
        duplicate_faces=listed(Finding.DUPLICATE_FACES, 2),
        duplicate_vertices=listed(Finding.DUPLICATE_VERTICES, 2),
        unreferenced_vertices=listed(Finding.UNREFERENCED_VERTICES),
        smallest_angle=Angle(smallest.radians, smallest.face, smallest.vertex),
        largest_angle=Angle(largest.radians, largest.face, largest.vertex),
    )


def _component(report: Any, place: int) -> Component:
    c = _native.taut_component()
    check(library.taut_report_component(report, place, ctypes.byref(c)))
    counts = c.vertices, c.edges, c.faces, c.first_vertex, c.boundary_loops
    return Component(*counts, manifold=bool(c.manifold), orientable=bool(c.orientable), genus=c.genus)


def _boundary_loops(report: Any, loops: AnyArray) -> list[BoundaryLoop]:
    """The loops, from rows of their number of vertices and whether they are closed."""
    ends = np.cumsum(loops[:, 0])
    count = int(ends[-1]) if len(ends) else 0
    vertices = filled(library.taut_report_boundary_vertices, (count,), np.int64, report)
    return [
        BoundaryLoop(vertices[end - size : end], bool(closed))
        for end, (size, closed) in zip(ends.tolist(), loops.tolist())
    ]
