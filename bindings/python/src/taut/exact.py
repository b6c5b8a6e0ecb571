"""Exact distances and shortest paths over the flat triangles."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _native
from ._buffers import AnyArray, Indices, Reals, filled, frozen, input_indices, input_reals, output, real_output
from ._control import Control, Progress, watched
from ._errors import Error, check, error_of
from ._handle import Handle, Owner, made
from ._native import Status, library
from ._options import counted
from ._solver import DistanceSolver
from .curves import Curves, curves_made
from .mesh import Mesh, pointer_of
from .sources import SourcesLike, TargetsLike, pointer_to, sources_of, targets_of


class SparseDistances(NamedTuple):
    """The distances of what lies within a radius of each source: a sparse matrix in compressed rows.

    Attributes
    ----------
    offsets : (S + 1,) int64
        Row i, of source i, has the entries from ``offsets[i]`` up to, not including, ``offsets[i + 1]``.
    vertices : (n,) int64
        Which vertex each entry is about, ascending in each row.
    values : (n,) float64
        Its distance, in mesh units.
    shape : (int, int)
        S and V.
    """

    offsets: Indices
    vertices: Indices
    values: Reals
    shape: tuple[int, int]

    def to_scipy(self) -> Any:
        """The same as a `scipy.sparse.csr_array`. A source's own distance is an explicit 0."""
        from scipy.sparse import csr_array

        return csr_array((self.values, self.vertices, self.offsets), shape=self.shape)


class ExactField(Owner):
    """The exact distances from one set of sources, and the shortest paths to them. C: ``taut_exact_field``.

    Targets are vertices; points as well if the field was made with `keep_windows`. None means every vertex.
    """

    _kind = _native.taut_exact_field

    def __init__(self, handle: Handle, mesh: Mesh) -> None:
        self._handle = handle
        self._vertex_count = mesh.vertex_count

    def _count(self, targets: Any) -> int:
        return self._vertex_count if targets is None else len(targets)

    def distances(self, targets: TargetsLike = None, out: AnyArray | None = None) -> AnyArray:
        """The distance of each target.

        Parameters
        ----------
        targets : int, array_like of integers, or Targets, optional
        out : (n,) float64 or float32 array, optional
            Is filled and returned.

        Returns
        -------
        (n,) float64
            In mesh units; inf where no source reaches, and beyond `final_radius`.

        Raises
        ------
        InvalidArgument
            Naming the target that is no place on the mesh, or no vertex where the field keeps no windows.
        """
        places = targets_of(targets)
        result = real_output(out, (self._count(places),))
        check(library.taut_exact_field_distances(self._pointer, pointer_to(places), output(result)))
        return result

    def nearest_sources(self, targets: TargetsLike = None) -> Indices:
        """The nearest source of each target: (n,) int64, -1 where no source reaches, and beyond `final_radius`."""
        places = targets_of(targets)
        fill = library.taut_exact_field_nearest_sources
        return filled(fill, (self._count(places),), np.int64, self._pointer, pointer_to(places))

    def paths(
        self,
        targets: TargetsLike = None,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> Curves:
        """The shortest path from each target back to its nearest source. C: ``taut_exact_field_paths``.

        Returns
        -------
        Curves
            One for each target, from the target to the source, as long as the distance less the start distance. Without
            points where no source reaches.
        """
        places = pointer_to(targets_of(targets))
        with watched(progress, time_limit, control) as watch:
            return curves_made(library.taut_exact_field_paths, self._pointer, places, watch)

    @property
    def final_radius(self) -> float:
        """Up to which distance the field is complete; inf unless it stopped at targets or a radius, or was interrupted."""
        return float(library.taut_exact_field_final_radius(self._pointer))

    @property
    def interruption(self) -> Error | None:
        """What interrupted the work, where `allow_partial` let it succeed all the same; else None."""
        detail = _native.taut_error()
        status = library.taut_exact_field_interruption(self._pointer, ctypes.byref(detail))
        if status == Status.OK:
            return None
        return error_of(detail, library.taut_status_name(status).decode())

    @property
    def windows(self) -> int:
        """How many windows crossed a triangle: a measure of the work that does not depend on the machine."""
        return int(library.taut_exact_field_windows(self._pointer))

    def __repr__(self) -> str:
        return f"ExactField(vertices={self._vertex_count}, final_radius={self.final_radius:g})"


class ExactSolver(DistanceSolver):
    """A mesh prepared for exact distances; serves any number of calls, also at once. C: ``taut_exact``.

    Windows as by Mitchell, Mount and Papadimitriou (1987), in lists as by Qin et al. (2016).

    Parameters
    ----------
    mesh : Mesh

    Notes
    -----
    O(V + F) time, 0.1 kB for each triangle. It pickles by its mesh, and is prepared again on load.
    """

    _kind = _native.taut_exact
    _rows = library.taut_exact_distance_rows

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self._handle = made(self._kind, library.taut_exact_new, pointer_of(mesh))

    def field(
        self,
        sources: SourcesLike,
        *,
        targets: TargetsLike = None,
        radius: float | None = None,
        allow_partial: bool = False,
        keep_windows: bool = False,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> ExactField:
        """The exact distances from a set of sources. C: ``taut_exact_field_new``.

        Parameters
        ----------
        sources : int, array_like of integers, or Sources
            At least one.
        targets : int, array_like of integers, or Targets, optional
            The work stops when the distances of all of these are final.
        radius : float, optional
            The largest distance wanted, in mesh units; vertices that are farther get inf.
        allow_partial : bool
            Work that is cancelled or reaches a limit succeeds with what is final by then, and `ExactField.interruption`
            tells why.
        keep_windows : bool
            The field also answers for points that are no vertices; 1 to 2 kB for a triangle of a scan.

        Raises
        ------
        InvalidArgument
            Naming the source or target that is no place on the mesh.

        Notes
        -----
        About 20 windows for each triangle of a scan, O(V^2) at worst.
        """
        wanted = pointer_to(targets_of(targets))
        options = _native.taut_exact_options(
            targets=wanted, radius=_radius(radius), allow_partial=allow_partial, keep_windows=keep_windows
        )
        from_ = pointer_to(sources_of(sources))
        make = library.taut_exact_field_new
        with watched(progress, time_limit, control) as watch:
            handle = made(ExactField._kind, make, self._pointer, from_, ctypes.byref(options), watch)
        return ExactField(handle, self.mesh)

    def distances_within(
        self,
        sources: SourcesLike,
        radius: float,
        threads: int = 0,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> SparseDistances:
        """The distances up to `radius` from each of several sources. C: ``taut_exact_distances_within``.

        Time and memory are in proportion to what is reached.
        """
        from_ = pointer_to(sources_of(sources))
        make = library.taut_exact_distances_within
        limit, workers = ctypes.c_double(radius), counted(threads, "threads")
        with watched(progress, time_limit, control) as watch:
            handle = made(_native.taut_sparse_distances, make, self._pointer, from_, limit, workers, watch)
        sparse = handle.pointer
        rows, count = library.taut_sparse_distances_row_count(sparse), library.taut_sparse_distances_count(sparse)
        return SparseDistances(
            filled(library.taut_sparse_distances_offsets, (rows + 1,), np.int64, sparse),
            filled(library.taut_sparse_distances_vertices, (count,), np.int64, sparse),
            filled(library.taut_sparse_distances_values, (count,), np.float64, sparse),
            (rows, self.mesh.vertex_count),
        )

    def farthest_points(
        self,
        sources: SourcesLike,
        count: int,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> tuple[Indices, Reals]:
        """Vertices spread evenly over the surface: each the farthest from the sources and all before it.

        C: ``taut_exact_farthest_points``.

        Returns
        -------
        vertices : (count,) int64
            -1 once no vertex is farther than 0.
        distances : (count,) float64
            How far each was when it was taken.
        """
        count = counted(count, "count")
        vertices, distances = np.empty(count, np.int64), np.empty(count)
        from_ = pointer_to(sources_of(sources))
        with watched(progress, time_limit, control) as watch:
            sample = library.taut_exact_farthest_points
            check(sample(self._pointer, from_, count, watch, output(vertices), output(distances)))
        return frozen(vertices), frozen(distances)

    def curve_through(
        self,
        faces: npt.ArrayLike,
        barycentrics: npt.ArrayLike,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> Curves:
        """The open curve through points in their order, along shortest paths. C: ``taut_exact_curve_through``.

        Parameters
        ----------
        faces : (n,) array_like of integers
            The triangle of each point.
        barycentrics : (n, 3) array_like of real numbers
            The weights of its corners.

        Raises
        ------
        InvalidArgument
            Naming the point that is no place on the mesh, or that cannot be reached from the one before it.
        """
        triangles, weights = input_indices(faces, "faces"), input_reals(barycentrics, "barycentrics", 3)
        with watched(progress, time_limit, control) as watch:
            return curves_made(library.taut_exact_curve_through, self._pointer, triangles, weights, watch)

    def find_geodesic_path(self, start: TargetsLike, end: SourcesLike) -> Reals:
        """The shortest path from `start` to `end`, or to the nearest of several ends.

        Returns
        -------
        (k, 3) float64
            Its points, from start to end; none where no way leads there.
        """
        begin = targets_of(start)
        if begin is None or len(begin) != 1:
            raise ValueError("start must be one place")
        field = self.field(end, targets=begin, keep_windows=len(begin.faces) > 0)
        return field.paths(begin)[0].positions

    def __reduce__(self) -> Any:
        return ExactSolver, (self.mesh,)

    def __repr__(self) -> str:
        return f"ExactSolver({self.mesh!r})"


def _radius(radius: float | None) -> float:
    if radius is None:
        return np.inf
    # 0 would be no limit to C: no distance lies between it and the least number above.
    return radius if radius != 0 else float(np.nextafter(0.0, 1.0))
