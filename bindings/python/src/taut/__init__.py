"""Geodesic distances and shortest paths on triangle meshes: the heat method and exact distances.

>>> import taut
>>> mesh = taut.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 3), (1, 2, 3)])
>>> taut.ExactSolver(mesh).find_geodesic_path(2, 0)
array([[1. , 1. , 0. ],
       [0.5, 0.5, 0. ],
       [0. , 0. , 0. ]])
"""

from ._buffers import none
from ._control import Control
from ._errors import (
    Cancelled,
    Error,
    FormatError,
    InternalError,
    InvalidArgument,
    InvalidMesh,
    IoError,
    LimitReached,
    NumericError,
    TooLarge,
    Unsupported,
)
from ._native import Reason, Status, library
from .curves import Curve, Curves
from .exact import ExactField, ExactSolver, SparseDistances
from .heat import HeatField, HeatReport, HeatResiduals, HeatSolver
from .mesh import Angle, BoundaryLoop, Component, Mesh, MeshReport, Properties, TimeStep
from .sources import Sources, Targets
from .surface import Closest, ClosestPoints, descent_paths, even_levels, isolines, spaced_levels


def library_version() -> str:
    """The version of the library that runs, for example "0.1.0"."""
    version: bytes = library.taut_version()
    return version.decode()


__version__ = library_version()

__all__ = [
    "Angle",
    "BoundaryLoop",
    "Cancelled",
    "Closest",
    "ClosestPoints",
    "Component",
    "Control",
    "Curve",
    "Curves",
    "Error",
    "ExactField",
    "ExactSolver",
    "FormatError",
    "HeatField",
    "HeatReport",
    "HeatResiduals",
    "HeatSolver",
    "InternalError",
    "InvalidArgument",
    "InvalidMesh",
    "IoError",
    "LimitReached",
    "Mesh",
    "MeshReport",
    "NumericError",
    "Properties",
    "Reason",
    "Sources",
    "SparseDistances",
    "Status",
    "Targets",
    "TimeStep",
    "TooLarge",
    "Unsupported",
    "descent_paths",
    "even_levels",
    "isolines",
    "library_version",
    "none",
    "spaced_levels",
]
