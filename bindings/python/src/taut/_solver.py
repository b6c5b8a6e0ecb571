"""What both solvers do alike: distances from a set of sources, and from many sets at once."""

from __future__ import annotations

from typing import Any

import numpy.typing as npt

from ._buffers import AnyArray, input_indices, output, real_output
from ._control import Control, Progress, watched
from ._errors import check
from ._handle import Owner
from ._options import counted
from .mesh import Mesh
from .sources import SourcesLike, pointer_to, sources_of


class DistanceSolver(Owner):
    """A mesh prepared for distances by one of the methods."""

    mesh: Mesh
    #: The field of a set of sources, which tells its distances.
    field: Any
    #: The function of C that computes rows.
    _rows: Any

    def compute_distance(
        self,
        sources: SourcesLike,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> AnyArray:
        """The distance of every vertex from the nearest of the sources: (V,) float64, inf where none reaches."""
        field = self.field(sources, progress=progress, time_limit=time_limit, control=control)
        distances: AnyArray = field.distances()
        return distances

    def distance_rows(
        self,
        sources: SourcesLike,
        sets: npt.ArrayLike | None = None,
        threads: int = 0,
        out: AnyArray | None = None,
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
        control: Control | None = None,
    ) -> AnyArray:
        """The distances of every vertex from each of several sources, or sets of them.

        C: ``taut_exact_distance_rows``, ``taut_heat_distance_rows``.

        Parameters
        ----------
        sources : int, array_like of integers, or Sources
        sets : (S + 1,) array_like of integers, optional
            Row i is about the sources from ``sets[i]`` up to, not including, ``sets[i + 1]``. By default each source is a
            set.
        threads : int
            How many threads compute rows; 0 for as many as the machine has. The distances are the same for any number.
        out : (S, V) float64 or float32 array, optional
            Is filled and returned; its rows may be any distance apart.

        Returns
        -------
        (S, V) float64
            The same, to the bit, as those of `field`; by heat at half of its cost for each set.
        """
        places = sources_of(sources)
        starts = input_indices(() if sets is None else sets, "sets")
        rows = len(places) if starts.count == 0 else starts.count - 1
        result = real_output(out, (rows, self.mesh.vertex_count))
        workers = counted(threads, "threads")
        with watched(progress, time_limit, control) as watch:
            check(self._rows(self._pointer, pointer_to(places), starts, workers, watch, output(result)))
        return result
