"""Each failure is an exception that says what is wrong with which element."""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

import taut
from taut import Reason

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
NAN, INF = float("nan"), float("inf")


def off(text):
    return lambda mesh: taut.Mesh.read_bytes(text.encode(), "off")


CASES = [
    (lambda m: taut.Mesh(CORNERS, [(0, 1, 2), (0, 4, 1)]), taut.InvalidMesh, "INDEX_OUT_OF_RANGE", "face", 1),
    (lambda m: taut.Mesh(CORNERS, [(0, 1, -1)]), taut.InvalidMesh, "INDEX_OUT_OF_RANGE", "face", 0),
    (lambda m: taut.Mesh([*CORNERS, (0, NAN, 0)], [(0, 1, 4)]), taut.InvalidMesh, "NON_FINITE_COORDINATE", "vertex", 4),
    (lambda m: m.with_positions([*CORNERS[:3], (0, INF, 0)]), taut.InvalidMesh, "NON_FINITE_COORDINATE", "vertex", 3),
    (lambda m: m.with_positions(CORNERS[:3]), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.Mesh(CORNERS, [(0, 1, 2), (0, 1)]), taut.InvalidMesh, "FACE_TOO_SMALL", "face", 1),
    (lambda m: taut.Mesh.polygons(CORNERS, [0, 4, 2, 7], [0] * 7), taut.InvalidMesh, "BAD_OFFSETS", "face", 1),
    (lambda m: taut.Mesh.read("missing.obj"), taut.IoError, "IO", None, None),
    (lambda m: taut.Mesh.read("missing.xyz"), taut.FormatError, "UNKNOWN_FORMAT", None, None),
    (off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n"), taut.FormatError, "MALFORMED", "line", 5),
    (off("OFF\n3 1 0\n0 0 0\n1 0 0\n"), taut.FormatError, "TRUNCATED", "vertex", 2),
    (lambda m: taut.Mesh.read_bytes(b"", "xyz"), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: m.point_positions([0, 2], np.eye(3)[:2]), taut.InvalidArgument, "BAD_ARGUMENT", "face", 2),
    (lambda m: m.point_positions([0, -1], np.eye(3)[:2]), taut.InvalidArgument, "BAD_ARGUMENT", "point", 1),
    (lambda m: m.time_step(taut.TimeStep("cubic")), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: m.time_step(taut.TimeStep(scale="huge")), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: m.time_step(0.0), taut.InvalidArgument, "BAD_TIME_STEP", None, None),
    (lambda m: m.time_step(NAN), taut.InvalidArgument, "BAD_TIME_STEP", None, None),
    (lambda m: m.time_step(INF), taut.InvalidArgument, "BAD_TIME_STEP", None, None),
    (lambda m: m.time_step(taut.TimeStep(factor=0)), taut.InvalidArgument, "BAD_TIME_STEP", None, None),
    (lambda m: taut.HeatSolver(m, boundary=2.0), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.HeatSolver(m, laplacian="flat"), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.HeatSolver(m, shift="left"), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.HeatSolver(m, solver="ldl"), taut.Unsupported, "MISSING_FEATURE", None, None),
    (lambda m: taut.HeatSolver(m, boundary=1).field(0), taut.InvalidArgument, "SOURCE_ON_BOUNDARY", "source", 0),
    (lambda m: taut.HeatSolver(m).field([]), taut.InvalidArgument, "NO_SOURCE", None, None),
    (lambda m: taut.HeatSolver(m).field([1, 4]), taut.InvalidArgument, "VERTEX_OUT_OF_RANGE", "source", 1),
    (lambda m: taut.HeatSolver(m).with_mesh(taut.Mesh(CORNERS, [(0, 1, 2)])), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.ExactSolver(m).field(-1), taut.InvalidArgument, "VERTEX_OUT_OF_RANGE", "source", 0),
    (lambda m: taut.ExactSolver(m).field(0, targets=[0, 9]), taut.InvalidArgument, "VERTEX_OUT_OF_RANGE", "target", 1),
    (lambda m: taut.ExactSolver(m).field(0, radius=-1.0), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.ExactSolver(m).field(0).distances([0, 4]), taut.InvalidArgument, "VERTEX_OUT_OF_RANGE", "target", 1),
    (
        lambda m: taut.ExactSolver(m).field(0).paths(taut.Targets(2, faces=[0], barycentrics=[(0.5, 0.25, 0.25)])),
        taut.InvalidArgument, "BAD_ARGUMENT", "target", 1,
    ),
    (
        lambda m: taut.ExactSolver(m).field(taut.Sources(0, faces=[7], barycentrics=[(1, 0, 0)])),
        taut.InvalidArgument, "BAD_ARGUMENT", "source", 1,
    ),
    (lambda m: taut.ExactSolver(m).field(taut.Sources([0, 1], offsets=[0, NAN])), taut.InvalidArgument, "BAD_ARGUMENT", "source", 1),
    (lambda m: taut.ExactSolver(m).distance_rows([0, 1], [0, 0, 2]), taut.InvalidArgument, "NO_SOURCE", None, None),
    (lambda m: taut.ExactSolver(m).distance_rows([0, 1], [0, 1, 9]), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.ExactSolver(m).distances_within([0], NAN), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.ExactSolver(m).farthest_points([], 3), taut.InvalidArgument, "NO_SOURCE", None, None),
    (lambda m: taut.ExactSolver(m).curve_through([0, 5], np.eye(3)[:2]), taut.InvalidArgument, "BAD_ARGUMENT", "point", 1),
    (lambda m: taut.Closest(taut.Mesh([], [])), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.Closest(m).points([(0, 0, 0), (0, INF, 0)]), taut.InvalidArgument, "BAD_ARGUMENT", "point", 1),
    (lambda m: taut.isolines(m, [0, 1, 2, 3], [1.0, NAN]), taut.InvalidArgument, "BAD_ARGUMENT", "level", 1),
    (lambda m: taut.isolines(m, [0, 1, 2], [1.0]), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.even_levels(m, [0, 1, 2, 3], 10_001), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.spaced_levels(m, [0, 1, 2, 3], 0.0), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.descent_paths(m, [0, 1, 2, 3], 4), taut.InvalidArgument, "VERTEX_OUT_OF_RANGE", "source", 0),
    (lambda m: taut.Mesh([(0, 0)], []), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.Mesh(CORNERS, [0, 1, 2]), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
    (lambda m: taut.Mesh([], []).properties(), taut.InvalidArgument, "BAD_ARGUMENT", None, None),
]  # fmt: skip


@pytest.mark.parametrize(("call", "kind", "reason", "element", "index"), CASES)
def test_failures_name_the_element(square, call, kind, reason, element, index):
    with pytest.raises(kind) as caught:
        call(square)
    error = caught.value
    assert (error.reason, error.element, error.index) == (Reason[reason], element, index)
    assert type(error).__mro__[1] is taut.Error
    assert str(error)
    for again in (pickle.loads(pickle.dumps(error)), copy.copy(error), copy.deepcopy(error)):
        assert type(again) is kind
        assert str(again) == str(error)
        assert vars(again) == vars(error)


@pytest.mark.parametrize(
    ("kind", "builtin"),
    [
        (taut.InvalidArgument, ValueError),
        (taut.InvalidMesh, ValueError),
        (taut.IoError, OSError),
        (taut.FormatError, ValueError),
        (taut.Unsupported, NotImplementedError),
        (taut.NumericError, ArithmeticError),
        (taut.Cancelled, Exception),
        (taut.TooLarge, MemoryError),
        (taut.InternalError, RuntimeError),
        (taut.LimitReached, TimeoutError),
    ],
)
def test_each_status_has_its_exception(kind, builtin):
    error = kind("what", 1, 2, "vertex", 3)
    assert isinstance(error, taut.Error)
    assert isinstance(error, builtin)
    assert vars(pickle.loads(pickle.dumps(error))) == vars(error)
    assert str(error) == "what"


def bad_distance(vertex):
    return taut.ExactSolver(taut.Mesh(CORNERS, [(0, 1, 2)])).compute_distance(vertex)


def test_errors_come_back_from_another_process():
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        with pytest.raises(taut.InvalidArgument, match="source 0") as caught:
            pool.submit(bad_distance, 17).result()
    assert caught.value.element == "source"


def test_missing_arguments_are_type_errors(square):
    with pytest.raises(TypeError):
        taut.ExactSolver(square).field(0, keep_window=True)
    with pytest.raises(TypeError):
        taut.Sources(curves=[1, 2])
    with pytest.raises(ValueError, match="one place"):
        taut.ExactSolver(square).find_geodesic_path([0, 1], 2)
