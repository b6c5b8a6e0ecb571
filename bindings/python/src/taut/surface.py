"""What is done with a value at each vertex, or a point in space: isolines, paths of steepest descent, closest points."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _native
from ._buffers import Indices, Reals, frozen, input_reals, output
from ._control import Control, Progress, watched
from ._errors import check
from ._handle import Owner, made
from ._native import TAUT_MAX_LEVELS, library
from ._options import counted
from .curves import Curves, curves_made
from .mesh import Mesh, pointer_of
from .sources import SourcesLike, TargetsLike, pointer_to, sources_of, targets_of


class ClosestPoints(NamedTuple):
    """The places on the surface nearest to n points in space.

    Attributes
    ----------
    faces : (n,) int64
        The triangle of each place.
    barycentrics : (n, 3) float64
        The weights of its corners.
    distances : (n,) float64
        The straight distance from the point, in mesh units.
    """

    faces: Indices
    barycentrics: Reals
    distances: Reals


class Closest(Owner):
    """A mesh prepared for questions of what is nearest to a point in space, such as a click. C: ``taut_closest``.

    Parameters
    ----------
    mesh : Mesh

    Raises
    ------
    InvalidArgument
        Where the mesh has no triangles, or only ignored ones.

    Notes
    -----
    O(F log F) time, 0.1 kB for each triangle; about O(log F) for a point.
    """

    _kind = _native.taut_closest

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self._handle = made(self._kind, library.taut_closest_new, pointer_of(mesh))

    def points(
        self,
        positions: npt.ArrayLike,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> ClosestPoints:
        """The place nearest to each of some points; of equally near ones that inside a triangle, then the least triangle.

        Parameters
        ----------
        positions : (n, 3) array_like of real numbers
            In mesh units, finite.

        Raises
        ------
        InvalidArgument
            Naming the point that is not finite.
        """
        points = input_reals(positions, "positions", 3)
        faces, barycentrics = np.empty(points.count, np.int64), np.empty((points.count, 3))
        distances = np.empty(points.count)
        outputs = output(faces), output(barycentrics), output(distances)
        with watched(progress, time_limit, control) as watch:
            check(library.taut_closest_points(self._pointer, points, watch, *outputs))
        return ClosestPoints(frozen(faces), frozen(barycentrics), frozen(distances))

    def __reduce__(self) -> Any:
        return Closest, (self.mesh,)

    def __repr__(self) -> str:
        return f"Closest({self.mesh!r})"


def isolines(mesh: Mesh, values: npt.ArrayLike, levels: npt.ArrayLike) -> Curves:
    """The lines along which a field takes given values. C: ``taut_isolines_new``.

    Parameters
    ----------
    mesh : Mesh
    values : (V,) array_like of real numbers
        Linear in each triangle; not finite where there is no value, so that there are no lines beside it.
    levels : float or (n,) array_like of real numbers
        Finite, in any order.

    Returns
    -------
    Curves
        Those of the first level first; ``levels`` of them tells which each belongs to.

    Raises
    ------
    InvalidArgument
        Where there are more or fewer values than vertices, or naming the level that is not finite.

    Notes
    -----
    O(F log n) time and what comes out.
    """
    wanted = input_reals(np.atleast_1d(np.asarray(levels)), "levels")
    return curves_made(library.taut_isolines_new, pointer_of(mesh), input_reals(values, "values"), wanted)


def _levels(fill: Any, mesh: Mesh, values: npt.ArrayLike, how: Any, room: int) -> Reals:
    levels, written = np.empty(room), ctypes.c_size_t()
    check(fill(pointer_of(mesh), input_reals(values, "values"), how, output(levels), ctypes.byref(written)))
    return frozen(levels[: written.value].copy())


def even_levels(mesh: Mesh, values: npt.ArrayLike, count: int) -> Reals:
    """`count` levels spread evenly between the least and the greatest value, for `isolines`; 10,000 at most.

    Fewer where so many numbers do not fit in between, none where the field is constant. C: ``taut_even_levels``.
    """
    count = counted(count, "count")
    return _levels(library.taut_even_levels, mesh, values, count, min(count, TAUT_MAX_LEVELS))


def spaced_levels(mesh: Mesh, values: npt.ArrayLike, spacing: float) -> Reals:
    """The multiples of `spacing` between the least and the greatest value, for `isolines`. C: ``taut_spaced_levels``."""
    return _levels(library.taut_spaced_levels, mesh, values, ctypes.c_double(spacing), TAUT_MAX_LEVELS)


def descent_paths(
    mesh: Mesh,
    values: npt.ArrayLike,
    sources: SourcesLike | None = None,
    targets: TargetsLike = None,
    *,
    progress: Progress | None = None,
    time_limit: float | None = None,
    control: Control | None = None,
) -> Curves:
    """The paths along which a field falls steepest, one from each of some places. C: ``taut_descent_paths_new``.

    Parameters
    ----------
    mesh : Mesh
    values : (V,) array_like of real numbers
        Linear in each triangle; of distances the paths lead back to the sources.
    sources : int, array_like of integers, or Sources, optional
        What the values are the distances from; None for a field that is no distance.
    targets : int, array_like of integers, or Targets, optional
        Where the paths begin; by default at every vertex.

    Returns
    -------
    Curves
        One for each target; without points where the field is not finite.
    """
    field = input_reals(values, "values")
    from_, places = None if sources is None else pointer_to(sources_of(sources)), pointer_to(targets_of(targets))
    with watched(progress, time_limit, control) as watch:
        make = library.taut_descent_paths_new
        return curves_made(make, pointer_of(mesh), field, from_, places, watch)
