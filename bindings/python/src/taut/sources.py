"""Where distances are measured from, and the places that are asked about."""

from __future__ import annotations

import ctypes
import operator
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._buffers import AnyArray, frozen, indices, input_indices, input_reals, reals
from .curves import Curves


def _vertices(data: Any) -> AnyArray:
    """One vertex or many."""
    try:
        return indices([operator.index(data)], "vertices")
    except TypeError:
        return indices(data, "vertices")


def _same(one: tuple[AnyArray, ...], other: tuple[AnyArray, ...]) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(one, other))


def _set_places(structure: Any, places: Sources | Targets) -> None:
    """Let C see the vertices and points of `places`."""
    if len(places.vertices):
        structure.vertices = input_indices(places.vertices, "vertices")
    if len(places.faces) or len(places.barycentrics):
        structure.faces = input_indices(places.faces, "faces")
        structure.barycentrics = input_reals(places.barycentrics, "barycentrics", 3)


def _view(array: AnyArray) -> AnyArray:
    """The caller's array where it lies, but read-only."""
    return frozen(array.view())


class Sources:
    """Where distances are measured from: vertices, points of the surface and curves on it. C: ``taut_sources``.

    Sources are numbered from 0, the vertices first, then the points, then the curves: nearest sources are told and errors
    named by this number. Wherever sources are asked for, a vertex or an array of vertices will do. Arrays are kept as they
    are, not copied.

    Parameters
    ----------
    vertices : int or (n,) array_like of integers
    faces : (p,) array_like of integers, optional
        The triangles of points.
    barycentrics : (p, 3) array_like of real numbers, optional
        The weights of their corners: not negative, their sum 1 up to 1e-6.
    curves : Curves, optional
        Curves on the mesh, such as isolines.
    offsets : array_like of real numbers, optional
        The start distance of each source of all kinds, in mesh units, of any sign; none mean 0 for all.

    Examples
    --------
    >>> len(taut.Sources([3, 7], faces=[5], barycentrics=[(0.2, 0.3, 0.5)], offsets=[0, 1.5, 0]))
    3
    """

    __slots__ = ("barycentrics", "curves", "faces", "offsets", "vertices")

    def __init__(
        self,
        vertices: int | npt.ArrayLike = (),
        *,
        faces: npt.ArrayLike = (),
        barycentrics: npt.ArrayLike = (),
        curves: Curves | None = None,
        offsets: npt.ArrayLike = (),
    ) -> None:
        if curves is not None and not isinstance(curves, Curves):
            raise TypeError(f"curves must be a Curves, not {type(curves).__name__}")
        self.vertices = _view(_vertices(vertices))
        self.faces = _view(indices(faces, "faces"))
        self.barycentrics = _view(reals(barycentrics, "barycentrics", 3))
        self.curves = curves
        self.offsets = _view(reals(offsets, "offsets"))

    def _arrays(self) -> tuple[AnyArray, ...]:
        return self.vertices, self.faces, self.barycentrics, self.offsets

    def __len__(self) -> int:
        return len(self.vertices) + len(self.faces) + (0 if self.curves is None else len(self.curves))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sources):
            return NotImplemented
        return self.curves == other.curves and _same(self._arrays(), other._arrays())

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        return _sources, (*self._arrays(), self.curves)

    def __repr__(self) -> str:
        curves = 0 if self.curves is None else len(self.curves)
        return f"Sources(vertices={len(self.vertices)}, points={len(self.faces)}, curves={curves})"

    def _c(self) -> _native.taut_sources:
        sources = _native.taut_sources()
        _set_places(sources, self)
        if len(self.offsets):
            sources.offsets = input_reals(self.offsets, "offsets")
        if self.curves is not None:
            sources.curve_offsets = input_indices(self.curves.offsets, "offsets")
            sources.curve_faces = input_indices(self.curves.faces, "faces")
            sources.curve_barycentrics = input_reals(self.curves.barycentrics, "barycentrics", 3)
            sources.closed = self.curves.closed.astype(np.int32)
            sources.curve_closed = input_indices(sources.closed, "closed")
        sources.owner = self  # what C points to lives as long
        return sources


def _sources(
    vertices: AnyArray, faces: AnyArray, barycentrics: AnyArray, offsets: AnyArray, curves: Curves | None
) -> Sources:
    return Sources(vertices, faces=faces, barycentrics=barycentrics, curves=curves, offsets=offsets)


class Targets:
    """Places that are asked about: vertices, then points of the surface, numbered in this order. C: ``taut_targets``.

    Wherever targets are asked for, a vertex or an array of vertices will do.

    Parameters
    ----------
    vertices : int or (n,) array_like of integers
    faces : (p,) array_like of integers, optional
        The triangles of points.
    barycentrics : (p, 3) array_like of real numbers, optional
        The weights of their corners: not negative, their sum 1 up to 1e-6.
    """

    __slots__ = ("barycentrics", "faces", "vertices")

    def __init__(
        self,
        vertices: int | npt.ArrayLike = (),
        *,
        faces: npt.ArrayLike = (),
        barycentrics: npt.ArrayLike = (),
    ) -> None:
        self.vertices = _view(_vertices(vertices))
        self.faces = _view(indices(faces, "faces"))
        self.barycentrics = _view(reals(barycentrics, "barycentrics", 3))

    def _arrays(self) -> tuple[AnyArray, ...]:
        return self.vertices, self.faces, self.barycentrics

    def __len__(self) -> int:
        return len(self.vertices) + len(self.faces)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Targets):
            return NotImplemented
        return _same(self._arrays(), other._arrays())

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        return _targets, self._arrays()

    def __repr__(self) -> str:
        return f"Targets(vertices={len(self.vertices)}, points={len(self.faces)})"

    def _c(self) -> _native.taut_targets:
        targets = _native.taut_targets()
        _set_places(targets, self)
        targets.owner = self
        return targets


def _targets(vertices: AnyArray, faces: AnyArray, barycentrics: AnyArray) -> Targets:
    return Targets(vertices, faces=faces, barycentrics=barycentrics)


SourcesLike = Union[Sources, int, "npt.ArrayLike"]
TargetsLike = Union[Targets, int, "npt.ArrayLike", None]


def sources_of(data: SourcesLike) -> Sources:
    """What stands for sources."""
    return data if isinstance(data, Sources) else Sources(data)


def targets_of(data: TargetsLike) -> Targets | None:
    """What stands for targets; None for every vertex."""
    return data if data is None or isinstance(data, Targets) else Targets(data)


def pointer_to(structure: Any) -> Any:
    """A pointer to what an object is to C, or NULL for None. It keeps what it points to."""
    return None if structure is None else ctypes.pointer(structure._c())
