"""The C interface as ctypes sees it: constants, structs and functions of ``taut.h``, with the header's names.

This is the only file that declares anything of C. ``tests/test_native.py`` holds it to the header.
"""

import ctypes
import os
import pathlib
import re
from ctypes import (
    CFUNCTYPE,
    POINTER,
    Structure,
    c_bool,
    c_char_p,
    c_double,
    c_int,
    c_int32,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
)
from enum import IntEnum
from typing import Any

TAUT_ABI = 1

# ------------------------------------------------------------------------------------------------------------- Enums


class Status(IntEnum):
    """Coarse classes of failure; each has an exception. C: ``taut_status``."""

    OK = 0
    INVALID_ARGUMENT = 1
    INVALID_MESH = 2
    IO = 3
    FORMAT = 4
    UNSUPPORTED = 5
    NUMERIC = 6
    CANCELLED = 7
    TOO_LARGE = 8
    INTERNAL = 9
    LIMIT_REACHED = 10


class Reason(IntEnum):
    """What went wrong, finer than the status. C: ``taut_reason``, which describes each."""

    NULL_POINTER = 1
    BAD_ARGUMENT = 2
    NO_SOURCE = 3
    VERTEX_OUT_OF_RANGE = 4
    BUFFER_TOO_SMALL = 5
    BAD_TIME_STEP = 6
    SOURCE_ON_BOUNDARY = 7
    INDEX_OUT_OF_RANGE = 20
    NON_FINITE_COORDINATE = 21
    BAD_OFFSETS = 22
    FACE_TOO_SMALL = 23
    IO = 40
    MALFORMED = 41
    TRUNCATED = 42
    UNKNOWN_FORMAT = 43
    MISSING_FEATURE = 50
    NOT_POSITIVE_DEFINITE = 60
    PATH_LOST = 61
    CANCELLED = 70
    TIME_LIMIT = 71
    MEMORY_LIMIT = 72
    TOO_MANY_ELEMENTS = 80
    OUT_OF_MEMORY = 81
    PANIC = 90


class Element(IntEnum):
    """What kind of element an error is about. C: ``taut_element``."""

    NONE = 0
    VERTEX = 1
    FACE = 2
    SOURCE = 3
    TARGET = 4
    LINE = 5
    LEVEL = 6
    POINT = 7


class Type(IntEnum):
    """Element type of a buffer. C: ``taut_type``."""

    F32 = 1
    F64 = 2
    U16 = 3
    U32 = 4
    U64 = 5
    I32 = 6
    I64 = 7


class Format(IntEnum):
    """A mesh file format. C: ``taut_format``."""

    GLB = 1
    OBJ = 2
    OFF = 3
    PLY = 4
    STL = 5


class TimeFormula(IntEnum):
    """A formula for the time step. C: ``taut_time_formula``."""

    MEAN_EDGE = 1
    SIGMA = 2
    MEAN_SIGMA = 3
    MEDIAN_FIT = 4
    MEDIAN_MEAN = 5


class TimeScale(IntEnum):
    """The size that a formula is evaluated at. C: ``taut_time_scale``."""

    PAPER = 1
    RAW = 2


class Laplacian(IntEnum):
    """Which Laplacian diffuses the heat. C: ``taut_laplacian``."""

    INTRINSIC = 1
    PLAIN = 2


class Shift(IntEnum):
    """How the distances get their zero. C: ``taut_shift``."""

    PINNED = 1
    MIN = 2


class Solver(IntEnum):
    """Which code factors the matrices. C: ``taut_solver``."""

    SUPERNODAL = 1
    LDL = 2


class Finding(IntEnum):
    """A kind of findings about a mesh. C: ``taut_finding``."""

    COMPONENTS = 1
    NONORIENTABLE_COMPONENTS = 2
    BOUNDARY_LOOPS = 3
    NONMANIFOLD_EDGES = 4
    NONMANIFOLD_VERTICES = 5
    INCONSISTENT_EDGES = 6
    ZERO_AREA_FACES = 7
    REPEATED_INDEX_FACES = 8
    DUPLICATE_FACES = 9
    DUPLICATE_VERTICES = 10
    UNREFERENCED_VERTICES = 11


TAUT_MAX_LEVELS = 10000

# The enums of results are int32_t, those of parameters uint32_t.
taut_status = taut_reason = taut_element = c_int32
taut_type = taut_format = taut_time_formula = taut_time_scale = taut_laplacian = taut_shift = taut_solver = c_uint32
taut_finding = c_uint32

# ----------------------------------------------------------------------------------------------------------- Handles


class taut_control(Structure):
    """Opaque."""


class taut_mesh(Structure):
    """Opaque."""


class taut_closest(Structure):
    """Opaque."""


class taut_exact(Structure):
    """Opaque."""


class taut_exact_field(Structure):
    """Opaque."""


class taut_sparse_distances(Structure):
    """Opaque."""


class taut_heat(Structure):
    """Opaque."""


class taut_heat_field(Structure):
    """Opaque."""


class taut_curves(Structure):
    """Opaque."""


class taut_report(Structure):
    """Opaque."""


# ----------------------------------------------------------------------------------------------------------- Structs


class taut_input(Structure):
    """A buffer that a call reads."""

    _fields_ = [
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("type", taut_type),
        ("reserved", c_uint32),
    ]


class taut_output(Structure):
    """A buffer that a call fills."""

    _fields_ = taut_input._fields_


class Sized(Structure):
    """A struct that starts with its size, which is set here."""

    def __init__(self, **fields: Any) -> None:
        super().__init__(ctypes.sizeof(type(self)), **fields)


class taut_error(Sized):
    """The last failure in detail."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("status", taut_status),
        ("reason", taut_reason),
        ("element", taut_element),
        ("reserved", c_uint32),
        ("index", c_uint64),
    ]


class taut_sources(Sized):
    """Where distances are measured from."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", taut_input),
        ("offsets", taut_input),
        ("faces", taut_input),
        ("barycentrics", taut_input),
        ("curve_offsets", taut_input),
        ("curve_faces", taut_input),
        ("curve_barycentrics", taut_input),
        ("curve_closed", taut_input),
    ]


class taut_targets(Sized):
    """Places that are asked about."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", taut_input),
        ("faces", taut_input),
        ("barycentrics", taut_input),
    ]


class taut_exact_options(Sized):
    """Options of an exact field."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("targets", POINTER(taut_targets)),
        ("radius", c_double),
        ("allow_partial", c_uint32),
        ("keep_windows", c_uint32),
    ]


class taut_time_step(Structure):
    """The time step of the heat flow."""

    _fields_ = [
        ("formula", taut_time_formula),
        ("scale", taut_time_scale),
        ("factor", c_double),
        ("value", c_double),
    ]


class taut_heat_options(Sized):
    """Options of the heat method."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("time_step", taut_time_step),
        ("boundary", c_double),
        ("laplacian", taut_laplacian),
        ("shift", taut_shift),
        ("solver", taut_solver),
        ("reserved", c_uint32),
    ]


class taut_heat_report(Sized):
    """What preparing the heat method did."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("flips", c_uint64),
        ("doubled_triangles", c_uint64),
        ("stuck_edges", c_uint64),
        ("flip_bound_reached", c_uint32),
        ("mollified", c_uint32),
        ("delaunay_seconds", c_double),
        ("assembly_seconds", c_double),
        ("order_seconds", c_double),
        ("symbolic_seconds", c_double),
        ("poisson_seconds", c_double),
        ("heat_seconds", c_double),
    ]


class taut_heat_residuals(Sized):
    """How well the systems of a field are solved."""

    _fields_ = [("struct_size", c_size_t), ("heat", c_double), ("poisson", c_double)]


class taut_component(Sized):
    """A connected part of a mesh."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_uint32),
        ("edges", c_uint32),
        ("faces", c_uint32),
        ("first_vertex", c_uint32),
        ("boundary_loops", c_uint32),
        ("manifold", c_uint32),
        ("orientable", c_uint32),
        ("genus", c_uint32),
    ]


class taut_angle(Structure):
    """An interior angle of a triangle."""

    _fields_ = [("radians", c_double), ("face", c_uint32), ("vertex", c_uint32)]


class taut_properties(Sized):
    """Statistics of a mesh's edges and angles."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_uint64),
        ("edges", c_uint64),
        ("faces", c_uint64),
        ("mean_edge", c_double),
        ("variance_edge", c_double),
        ("sigma_edge", c_double),
        ("mean_absolute_deviation", c_double),
        ("median_absolute_deviation", c_double),
        ("min_edge", c_double),
        ("max_edge", c_double),
        ("edge_ratio", c_double),
        ("q1", c_double),
        ("q2", c_double),
        ("q3", c_double),
        ("quartile_deviation", c_double),
        ("min_angle", c_double),
        ("max_angle", c_double),
        ("anisotropy", c_double),
        ("paper_scale", c_double),
    ]


# --------------------------------------------------------------------------------------------------------- Functions

taut_callback = CFUNCTYPE(c_int, c_double, c_void_p)

_control = POINTER(taut_control)
_mesh = POINTER(taut_mesh)
_closest = POINTER(taut_closest)
_exact = POINTER(taut_exact)
_exact_field = POINTER(taut_exact_field)
_sparse = POINTER(taut_sparse_distances)
_heat = POINTER(taut_heat)
_heat_field = POINTER(taut_heat_field)
_curves = POINTER(taut_curves)
_report = POINTER(taut_report)
_sources = POINTER(taut_sources)
_targets = POINTER(taut_targets)

# The type that a function returns, then those of its parameters.
PROTOTYPES: dict[str, tuple[Any, ...]] = {
    "taut_version": (c_char_p,),
    "taut_abi": (c_uint32,),
    "taut_status_name": (c_char_p, c_int32),
    "taut_last_error": (c_char_p, POINTER(taut_error)),
    "taut_control_new": (taut_status, POINTER(_control)),
    "taut_control_cancel": (None, _control),
    "taut_control_is_cancelled": (c_bool, _control),
    "taut_control_progress": (c_double, _control),
    "taut_control_set_time_limit": (taut_status, _control, c_double),
    "taut_control_set_memory_limit": (taut_status, _control, c_size_t),
    "taut_control_set_callback": (taut_status, _control, taut_callback, c_void_p),
    "taut_control_set_callback_interval": (taut_status, _control, c_double),
    "taut_control_free": (None, _control),
    "taut_mesh_new": (taut_status, taut_input, taut_input, POINTER(_mesh)),
    "taut_mesh_new_polygons": (taut_status, taut_input, taut_input, taut_input, POINTER(_mesh)),
    "taut_mesh_with_positions": (taut_status, _mesh, taut_input, POINTER(_mesh)),
    "taut_mesh_read": (taut_status, c_char_p, POINTER(_mesh)),
    "taut_mesh_read_bytes": (taut_status, c_void_p, c_size_t, taut_format, POINTER(_mesh)),
    "taut_mesh_vertex_count": (c_size_t, _mesh),
    "taut_mesh_triangle_count": (c_size_t, _mesh),
    "taut_mesh_ignored_count": (c_size_t, _mesh),
    "taut_mesh_positions": (taut_status, _mesh, taut_output),
    "taut_mesh_triangles": (taut_status, _mesh, taut_output),
    "taut_mesh_ignored_triangles": (taut_status, _mesh, taut_output),
    "taut_mesh_free": (None, _mesh),
    "taut_mesh_point_positions": (taut_status, _mesh, taut_input, taut_input, taut_output),
    "taut_closest_new": (taut_status, _mesh, POINTER(_closest)),
    "taut_closest_points": (taut_status, _closest, taut_input, _control, taut_output, taut_output, taut_output),
    "taut_closest_free": (None, _closest),
    "taut_exact_new": (taut_status, _mesh, POINTER(_exact)),
    "taut_exact_free": (None, _exact),
    "taut_exact_field_new": (
        taut_status, _exact, _sources, POINTER(taut_exact_options), _control, POINTER(_exact_field),
    ),
    "taut_exact_field_distances": (taut_status, _exact_field, _targets, taut_output),
    "taut_exact_field_nearest_sources": (taut_status, _exact_field, _targets, taut_output),
    "taut_exact_field_paths": (taut_status, _exact_field, _targets, _control, POINTER(_curves)),
    "taut_exact_field_final_radius": (c_double, _exact_field),
    "taut_exact_field_interruption": (taut_status, _exact_field, POINTER(taut_error)),
    "taut_exact_field_windows": (c_uint64, _exact_field),
    "taut_exact_field_free": (None, _exact_field),
    "taut_exact_curve_through": (taut_status, _exact, taut_input, taut_input, _control, POINTER(_curves)),
    "taut_exact_distance_rows": (taut_status, _exact, _sources, taut_input, c_size_t, _control, taut_output),
    "taut_exact_distances_within": (taut_status, _exact, _sources, c_double, c_size_t, _control, POINTER(_sparse)),
    "taut_sparse_distances_row_count": (c_size_t, _sparse),
    "taut_sparse_distances_count": (c_size_t, _sparse),
    "taut_sparse_distances_offsets": (taut_status, _sparse, taut_output),
    "taut_sparse_distances_vertices": (taut_status, _sparse, taut_output),
    "taut_sparse_distances_values": (taut_status, _sparse, taut_output),
    "taut_sparse_distances_free": (None, _sparse),
    "taut_exact_farthest_points": (taut_status, _exact, _sources, c_size_t, _control, taut_output, taut_output),
    "taut_time_step_value": (taut_status, _mesh, taut_time_step, POINTER(c_double)),
    "taut_heat_new": (taut_status, _mesh, POINTER(taut_heat_options), _control, POINTER(_heat)),
    "taut_heat_with_time_step": (taut_status, _heat, taut_time_step, _control, POINTER(_heat)),
    "taut_heat_with_mesh": (taut_status, _heat, _mesh, _control, POINTER(_heat)),
    "taut_heat_time_step": (c_double, _heat),
    "taut_heat_report_of": (taut_status, _heat, POINTER(taut_heat_report)),
    "taut_heat_free": (None, _heat),
    "taut_heat_field_new": (taut_status, _heat, _sources, _control, POINTER(_heat_field)),
    "taut_heat_field_distances": (taut_status, _heat_field, taut_output),
    "taut_heat_field_nearest_sources": (taut_status, _heat_field, taut_output),
    "taut_heat_field_nonpositive_heat": (c_uint64, _heat_field),
    "taut_heat_field_restarts": (c_uint32, _heat_field),
    "taut_heat_field_free": (None, _heat_field),
    "taut_heat_residuals_of": (taut_status, _heat, _sources, _control, POINTER(taut_heat_residuals)),
    "taut_heat_distance_rows": (taut_status, _heat, _sources, taut_input, c_size_t, _control, taut_output),
    "taut_even_levels": (taut_status, _mesh, taut_input, c_size_t, taut_output, POINTER(c_size_t)),
    "taut_spaced_levels": (taut_status, _mesh, taut_input, c_double, taut_output, POINTER(c_size_t)),
    "taut_isolines_new": (taut_status, _mesh, taut_input, taut_input, POINTER(_curves)),
    "taut_descent_paths_new": (taut_status, _mesh, taut_input, _sources, _targets, _control, POINTER(_curves)),
    "taut_curves_count": (c_size_t, _curves),
    "taut_curves_point_count": (c_size_t, _curves),
    "taut_curves_offsets": (taut_status, _curves, taut_output),
    "taut_curves_positions": (taut_status, _curves, taut_output),
    "taut_curves_faces": (taut_status, _curves, taut_output),
    "taut_curves_barycentrics": (taut_status, _curves, taut_output),
    "taut_curves_closed": (taut_status, _curves, taut_output),
    "taut_curves_levels": (taut_status, _curves, taut_output),
    "taut_curves_sources": (taut_status, _curves, taut_output),
    "taut_curves_free": (None, _curves),
    "taut_report_new": (taut_status, _mesh, POINTER(_report)),
    "taut_report_count": (c_size_t, _report, taut_finding),
    "taut_report_list": (taut_status, _report, taut_finding, taut_output),
    "taut_report_boundary_vertices": (taut_status, _report, taut_output),
    "taut_report_component": (taut_status, _report, c_size_t, POINTER(taut_component)),
    "taut_report_component_of": (taut_status, _report, taut_output),
    "taut_report_angles": (taut_status, _report, POINTER(taut_angle), POINTER(taut_angle)),
    "taut_report_free": (None, _report),
    "taut_mesh_properties": (taut_status, _mesh, POINTER(taut_properties)),
}


def _path() -> str:
    """Where the library is: as the environment says, else beside this module."""
    wanted = os.environ.get("TAUT_LIBRARY")
    if wanted:
        return wanted
    folder = pathlib.Path(__file__).parent
    for path in sorted(folder.iterdir()):
        if re.match(r"(lib)?taut\.(so|dylib|dll)", path.name):
            return str(path)
    raise ImportError(f"taut finds no library in {folder}, and TAUT_LIBRARY names none", name="taut")


def _load() -> ctypes.CDLL:
    path = _path()
    try:
        library = ctypes.CDLL(path)
        library.taut_abi.restype = c_uint32
        abi = library.taut_abi()
    except (OSError, AttributeError) as error:
        raise ImportError(f"taut cannot load its library {path}: {error}", name="taut", path=path) from error
    if abi != TAUT_ABI:
        raise ImportError(
            f"the library {path} has the interface {abi}, this package needs {TAUT_ABI}", name="taut", path=path
        )
    for name, (returned, *parameters) in PROTOTYPES.items():
        function = getattr(library, name)
        function.restype = returned
        function.argtypes = parameters
    return library


library = _load()
