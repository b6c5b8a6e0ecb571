"""Distances by the heat method: approximate, smooth, fast for many calls."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from . import _native
from ._buffers import AnyArray, Indices, filled, output, real_output
from ._control import Control, Progress, watched
from ._errors import check
from ._handle import Handle, Owner, made
from ._native import Laplacian, Shift, Solver, library
from ._options import choice
from ._solver import DistanceSolver
from .mesh import Mesh, TimeStep, TimeStepLike, pointer_of, time_step_of
from .sources import SourcesLike, pointer_to, sources_of


class HeatReport(NamedTuple):
    """What preparing the heat method did to the triangulation, and how long its stages took, in seconds.

    0 seconds for stages that another solver had done; C: ``taut_heat_report``, which describes each number.
    """

    flips: int
    doubled_triangles: int
    stuck_edges: int
    flip_bound_reached: int
    mollified: int
    delaunay_seconds: float
    assembly_seconds: float
    order_seconds: float
    symbolic_seconds: float
    poisson_seconds: float
    heat_seconds: float


class HeatResiduals(NamedTuple):
    """How well the two systems of a field are solved: max |b - A x| / max |b|, of the heat and of the distances."""

    heat: float
    poisson: float


class HeatField(Owner):
    """The distances from one set of sources by the heat method. C: ``taut_heat_field``."""

    _kind = _native.taut_heat_field

    def __init__(self, handle: Handle, mesh: Mesh) -> None:
        self._handle = handle
        self._vertex_count = mesh.vertex_count

    def distances(self, out: AnyArray | None = None) -> AnyArray:
        """The distance of every vertex.

        Parameters
        ----------
        out : (V,) float64 or float32 array, optional
            Is filled and returned.

        Returns
        -------
        (V,) float64
            In mesh units; inf where no source reaches.
        """
        result = real_output(out, (self._vertex_count,))
        check(library.taut_heat_field_distances(self._pointer, output(result)))
        return result

    def nearest_sources(self) -> Indices:
        """The source to which steepest descent leads from each vertex: (V,) int64, -1 where no source reaches."""
        fill = library.taut_heat_field_nearest_sources
        return filled(fill, (self._vertex_count,), np.int64, self._pointer)

    @property
    def nonpositive_heat(self) -> int:
        """At how many vertices heat was not positive, so that the direction there is doubtful."""
        return int(library.taut_heat_field_nonpositive_heat(self._pointer))

    @property
    def restarts(self) -> int:
        """How often heat had to start anew, because it had faded below the numbers that there are."""
        return int(library.taut_heat_field_restarts(self._pointer))

    def __repr__(self) -> str:
        return f"HeatField(vertices={self._vertex_count})"


class HeatSolver(DistanceSolver):
    """The heat method prepared for a mesh and a time step; serves any number of calls, also at once. C: ``taut_heat``.

    Crane, Weischedel and Wardetzky, Geodesics in Heat, 2013; on intrinsic Delaunay triangles, Sharp and Crane, 2020.

    Parameters
    ----------
    mesh : Mesh
    time_step : TimeStep, float or str, optional
        t itself in mesh units squared, a formula, or a `TimeStep`; by default the square of the mean edge length.
    boundary : float
        Heat at the mesh's boundary: from 0, no flow across (Neumann), to 1, kept at zero (Dirichlet).
    laplacian : str
        "intrinsic": cotangents of the intrinsic Delaunay triangulation; "plain": of the mesh's own triangles.
    shift : str
        "pinned": each source has its start distance, unless another reaches it sooner; "min": the least distance of each
        component is moved to the least start distance.
    solver : str
        "supernodal", or "ldl" where the library was built with it.
    progress, time_limit, control
        As for every long call: True for a bar or a function that is told the share that is done; seconds; a `Control`.

    Raises
    ------
    InvalidArgument
        Naming the option; the time step where it is not positive and finite.
    NumericError
        Where a factorisation breaks down.

    Notes
    -----
    About O(V^1.5) time and O(V log V) memory. It pickles by its mesh and options, and is prepared again on load: the same to
    the bit or, if `with_mesh` made it, to rounding, as the order of the matrices then follows from all meshes before.

    Examples
    --------
    >>> mesh = taut.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 3), (1, 2, 3)])
    >>> heat = taut.HeatSolver(mesh)
    >>> heat.compute_distance([0, 2])[[0, 2]]
    array([0., 0.])
    """

    _kind = _native.taut_heat
    _rows = library.taut_heat_distance_rows

    def __init__(
        self,
        mesh: Mesh,
        *,
        time_step: TimeStepLike = None,
        boundary: float = 0.0,
        laplacian: str = "intrinsic",
        shift: str = "pinned",
        solver: str = "supernodal",
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> None:
        step = time_step_of(time_step)
        options = _native.taut_heat_options(
            time_step=step._c(),
            boundary=boundary,
            laplacian=choice(Laplacian, laplacian, "laplacian"),
            shift=choice(Shift, shift, "shift"),
            solver=choice(Solver, solver, "solver"),
        )
        words = {"time_step": step, "boundary": boundary, "laplacian": laplacian, "shift": shift, "solver": solver}
        with watched(progress, time_limit, control) as watch:
            handle = made(self._kind, library.taut_heat_new, pointer_of(mesh), ctypes.byref(options), watch)
        self._set(handle, mesh, step, words)

    def _set(self, handle: Handle, mesh: Mesh, step: TimeStep, words: dict[str, Any]) -> HeatSolver:
        self._handle = handle
        self.mesh = mesh
        self._step = step
        self._words = words
        return self

    @property
    def time_step(self) -> float:
        """The time step t, in mesh units squared."""
        return float(library.taut_heat_time_step(self._pointer))

    @property
    def report(self) -> HeatReport:
        """What the preparation did, and how long it took."""
        report = _native.taut_heat_report()
        check(library.taut_heat_report_of(self._pointer, ctypes.byref(report)))
        return HeatReport(*(getattr(report, name) for name in HeatReport._fields))

    def with_time_step(
        self,
        step: TimeStepLike,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> HeatSolver:
        """The solver of another time step, sharing all else: about a quarter of a preparation.

        C: ``taut_heat_with_time_step``.
        """
        wanted = time_step_of(step)
        make = library.taut_heat_with_time_step
        with watched(progress, time_limit, control) as watch:
            handle = made(self._kind, make, self._pointer, wanted._c(), watch)
        return HeatSolver.__new__(HeatSolver)._set(handle, self.mesh, wanted, self._words)

    def with_mesh(
        self,
        mesh: Mesh,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> HeatSolver:
        """The solver of the same triangles in another place, as `Mesh.with_positions` makes them.

        It keeps the options of the first solver, whose time step is that of `HeatSolver`, not of `with_time_step`, and the
        ordering of the matrices. C: ``taut_heat_with_mesh``.

        Raises
        ------
        InvalidArgument
            Where the mesh has other triangles.
        """
        with watched(progress, time_limit, control) as watch:
            handle = made(self._kind, library.taut_heat_with_mesh, self._pointer, pointer_of(mesh), watch)
        return HeatSolver.__new__(HeatSolver)._set(handle, mesh, self._words["time_step"], self._words)

    def field(
        self,
        sources: SourcesLike,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> HeatField:
        """The distances from a set of sources, and more about them. C: ``taut_heat_field_new``.

        Parameters
        ----------
        sources : int, array_like of integers, or Sources
            At least one.

        Raises
        ------
        InvalidArgument
            Naming the source that is no place on the mesh or, with `boundary` 1, lies on the boundary.

        Notes
        -----
        A few sparse triangular solves, about O(V log V).
        """
        from_ = pointer_to(sources_of(sources))
        with watched(progress, time_limit, control) as watch:
            handle = made(HeatField._kind, library.taut_heat_field_new, self._pointer, from_, watch)
        return HeatField(handle, self.mesh)

    def residuals(
        self,
        sources: SourcesLike,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> HeatResiduals:
        """How well the systems of a field are solved, by computing it once more. C: ``taut_heat_residuals_of``."""
        residuals = _native.taut_heat_residuals()
        from_ = pointer_to(sources_of(sources))
        with watched(progress, time_limit, control) as watch:
            check(library.taut_heat_residuals_of(self._pointer, from_, watch, ctypes.byref(residuals)))
        return HeatResiduals(residuals.heat, residuals.poisson)

    def __reduce__(self) -> Any:
        return _prepared, (self.mesh, self._step, self._words)

    def __repr__(self) -> str:
        return f"HeatSolver({self.mesh!r}, time_step={self.time_step:.6g})"


def _prepared(mesh: Mesh, step: TimeStep, words: dict[str, Any]) -> HeatSolver:
    solver = HeatSolver(mesh, **words)
    return solver if step == words["time_step"] else solver.with_time_step(step)
