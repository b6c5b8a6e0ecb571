"""Curves on the surface of a mesh: isolines, shortest paths, paths of steepest descent."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, overload

import numpy as np
import numpy.typing as npt

from . import _native
from ._buffers import AnyArray, Indices, Reals, filled, frozen
from ._handle import Handle, made
from ._native import library


class Curve(NamedTuple):
    """A polyline on the surface: n points, and from each to the next a segment in the triangle that the point names.

    Attributes
    ----------
    positions : (n, 3) float64
        In mesh units.
    faces : (n,) int64
        The triangle of each point; the last point of an open curve names that of the last segment.
    barycentrics : (n, 3) float64
        The weights of the triangle's corners.
    closed : bool
        Whether one more segment leads from the last point to the first, which is not repeated.
    level : int
        Which level an isoline belongs to, which target a path is from.
    source : int
        At which source a path ends, -1 if it is no path or ends at none.
    """

    positions: Reals
    faces: Indices
    barycentrics: Reals
    closed: bool
    level: int
    source: int

    @property
    def length(self) -> float:
        """The length of all segments, in mesh units."""
        points = np.concatenate([self.positions, self.positions[:1]]) if self.closed else self.positions
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


class Curves(Sequence[Curve]):
    """A read-only sequence of `Curve`, and all of them as arrays. C: ``taut_curves``.

    A slice is a `Curves` as well. ``Sources(curves=...)`` measures distances from them.

    Attributes
    ----------
    offsets : (C + 1,) int64
        Curve i has the points from ``offsets[i]`` up to, not including, ``offsets[i + 1]``. A path that does not exist has
        none, one of length 0 has one.
    positions : (P, 3) float64
        The points of all curves, in mesh units.
    faces : (P,) int64
        Their triangles.
    barycentrics : (P, 3) float64
        The weights of the triangles' corners.
    closed : (C,) bool
        Which curves are closed.
    levels : (C,) int64
        The level of each isoline, the target of each path.
    sources : (C,) int64
        At which source each path ends, -1 for none.
    """

    def __init__(
        self,
        offsets: npt.ArrayLike,
        positions: npt.ArrayLike,
        faces: npt.ArrayLike,
        barycentrics: npt.ArrayLike,
        closed: npt.ArrayLike,
        levels: npt.ArrayLike,
        sources: npt.ArrayLike,
    ) -> None:
        self.offsets: Indices = _read_only(offsets, np.int64)
        self.positions: Reals = _read_only(positions, np.float64)
        self.faces: Indices = _read_only(faces, np.int64)
        self.barycentrics: Reals = _read_only(barycentrics, np.float64)
        self.closed: npt.NDArray[np.bool_] = _read_only(closed, np.bool_)
        self.levels: Indices = _read_only(levels, np.int64)
        self.sources: Indices = _read_only(sources, np.int64)

    def _arrays(self) -> tuple[AnyArray, ...]:
        return self.offsets, self.positions, self.faces, self.barycentrics, self.closed, self.levels, self.sources

    def __len__(self) -> int:
        return len(self.closed)

    @overload
    def __getitem__(self, index: int) -> Curve: ...
    @overload
    def __getitem__(self, index: slice) -> Curves: ...
    def __getitem__(self, index: int | slice) -> Curve | Curves:
        if isinstance(index, slice):
            return self._chosen(np.arange(len(self))[index])
        place = range(len(self))[index]
        points = slice(self.offsets[place], self.offsets[place + 1])
        return Curve(
            self.positions[points],
            self.faces[points],
            self.barycentrics[points],
            bool(self.closed[place]),
            int(self.levels[place]),
            int(self.sources[place]),
        )

    def _chosen(self, places: Indices) -> Curves:
        sizes = np.diff(self.offsets)[places]
        offsets = np.concatenate([[0], np.cumsum(sizes)])
        points = np.arange(offsets[-1]) + np.repeat(self.offsets[places] - offsets[:-1], sizes)
        return Curves(
            offsets,
            self.positions[points],
            self.faces[points],
            self.barycentrics[points],
            self.closed[places],
            self.levels[places],
            self.sources[places],
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Curves):
            return NotImplemented
        return all(np.array_equal(a, b) for a, b in zip(self._arrays(), other._arrays()))

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        return Curves, self._arrays()

    def __repr__(self) -> str:
        return f"Curves(curves={len(self)}, points={len(self.faces)})"


def _read_only(data: npt.ArrayLike, dtype: Any) -> AnyArray:
    return frozen(np.asarray(data, dtype).view())


def curves_made(make: Any, *arguments: Any) -> Curves:
    """The curves that a function of C makes of `arguments`, copied out."""
    return _copied(made(_native.taut_curves, make, *arguments))


def _copied(handle: Handle) -> Curves:
    curves = handle.pointer
    count, points = library.taut_curves_count(curves), library.taut_curves_point_count(curves)
    return Curves(
        filled(library.taut_curves_offsets, (count + 1,), np.int64, curves),
        filled(library.taut_curves_positions, (points, 3), np.float64, curves),
        filled(library.taut_curves_faces, (points,), np.int64, curves),
        filled(library.taut_curves_barycentrics, (points, 3), np.float64, curves),
        filled(library.taut_curves_closed, (count,), np.int32, curves),
        filled(library.taut_curves_levels, (count,), np.int64, curves),
        filled(library.taut_curves_sources, (count,), np.int64, curves),
    )
