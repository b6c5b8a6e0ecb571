"""Garbage, and Python at its most unkind: every call ends with a result or a clear exception, and never with a crash."""

import base64
import decimal
import gc
import os
import pickle
import signal
import threading
import time

import hypothesis
import hypothesis.strategies as some
import numpy as np
import pytest
from hypothesis.extra import numpy as arrays_of
from pygeodesic import geodesic

import taut

POSITIONS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)
TRIANGLES = np.array([(0, 1, 3), (1, 2, 3)])
REFUSED = (TypeError, ValueError, OverflowError)

slow = hypothesis.settings(max_examples=150, deadline=None, database=None, derandomize=True)


@pytest.fixture(scope="module")
def exact():
    return taut.ExactSolver(taut.Mesh(POSITIONS, TRIANGLES))


@pytest.fixture(scope="module")
def heat(exact):
    return taut.HeatSolver(exact.mesh)


@pytest.fixture(scope="module")
def large(elephant):
    return taut.ExactSolver(elephant)


class Wrapped:
    """What offers its numbers by `__array__`, as a pandas series and a tensor of torch do."""

    def __init__(self, data):
        self.data = np.asarray(data)

    def __array__(self, dtype=None, copy=None):
        return self.data if dtype is None else self.data.astype(dtype)


# ----------------------------------------------------------------------------------------------------------- Garbage

NO_INDICES = {
    "float": 1.0,
    "floats": [0.0, 1.0],
    "mask": np.array([True, False]),
    "text": "0",
    "texts": np.array(["0", "1"]),
    "nested": [[0, 1]],
    "ragged objects": np.array([[0], [0, 1]], object),
    "objects": np.array([0, None], object),
    "set": {0, 1},
    "dictionary": {0: 1},
    "generator": (i for i in (0, 1)),
    "complex": np.array([0j]),
    "dates": np.array([0], "M8[s]"),
    "records": np.zeros(2, [("a", int), ("b", int)]),
    "negative": -1,
    "negative small": np.array([-1], np.int8),
    "64 bits": 2**63,
    "unsigned 64 bits": np.array([2**64 - 1], np.uint64),
    "more bits": 2**64,
    "many more bits": -(2**200),
    "past 32 bits": np.array([2**32]),
    "past the end": [0, 4],
    "masked": np.ma.array([0, 1], mask=[0, 1]),
}


@pytest.mark.parametrize("vertices", NO_INDICES.values(), ids=NO_INDICES)
def test_what_is_no_source(exact, heat, vertices):
    field = exact.field(0, keep_windows=True)
    for call in (
        exact.compute_distance,
        heat.compute_distance,
        exact.distance_rows,
        lambda bad: exact.farthest_points(bad, 2),
        lambda bad: exact.find_geodesic_path(0, bad),
        lambda bad: taut.descent_paths(exact.mesh, POSITIONS[:, 0], bad, 0),
        lambda bad: field.distances(taut.Targets(bad)),
        lambda bad: field.paths(taut.Targets(bad)),
        lambda bad: exact.field(taut.Sources(faces=bad, barycentrics=[(1, 0, 0)])),
    ):
        with pytest.raises(REFUSED):
            call(vertices)


@pytest.mark.parametrize("triangles", NO_INDICES.values(), ids=NO_INDICES)
def test_what_is_no_triangle(triangles):
    for faces in ([[0, 1, triangles]], [triangles] * 3, triangles):
        with pytest.raises(REFUSED):
            taut.Mesh(POSITIONS, faces)
    with pytest.raises(REFUSED):
        taut.Mesh.polygons(POSITIONS, [0, 3], [0, 1, triangles])


NO_NUMBERS = {
    "text": "1",
    "texts": np.array(["0.5"] * 4),
    "nothing": None,
    "objects": np.array([0.5] * 4, object),
    "decimals": [decimal.Decimal(1)] * 4,
    "complex": np.zeros(4, complex),
    "dates": np.zeros(4, "M8[s]"),
    "times": np.zeros(4, "m8[s]"),
    "bools": np.zeros(4, bool),
    "records": np.zeros(4, [("a", float)]),
    "too large": [2**2000] * 4,
    "too many": np.zeros(5),
    "too few": np.zeros(3),
    "rows": np.zeros((4, 1)),
    "number": np.array(1.0),
    "masked": np.ma.array(np.zeros(4), mask=[0, 0, 1, 0]),
}


@pytest.mark.parametrize("values", NO_NUMBERS.values(), ids=NO_NUMBERS)
def test_what_are_no_values(exact, values):
    mesh = exact.mesh
    for call in (
        lambda: taut.isolines(mesh, values, [0.5]),
        lambda: taut.even_levels(mesh, values, 3),
        lambda: taut.spaced_levels(mesh, values, 0.1),
        lambda: taut.descent_paths(mesh, values),
        lambda: taut.Sources([0, 1], offsets=values) and exact.field(taut.Sources([0, 1], offsets=values)),
        lambda: mesh.with_positions(values),
        lambda: taut.Closest(mesh).points(values),
        lambda: mesh.point_positions([0], values),
    ):
        with pytest.raises(REFUSED):
            call()


@pytest.mark.parametrize("number", [None, "1", b"1", 1j, [1, 2], object], ids=str)
def test_options_that_are_no_numbers(exact, heat, number):
    for call in (
        lambda: exact.distance_rows([0], threads=number),
        lambda: heat.distance_rows([0], threads=number),
        lambda: exact.distances_within([0], number),
        lambda: exact.distances_within([0], 1, threads=number),
        lambda: exact.farthest_points(0, number),
        lambda: taut.even_levels(exact.mesh, POSITIONS[:, 0], number),
        lambda: taut.spaced_levels(exact.mesh, POSITIONS[:, 0], number),
        lambda: taut.HeatSolver(exact.mesh, boundary=number),
        lambda: taut.HeatSolver(exact.mesh, laplacian=number),
        lambda: taut.HeatSolver(exact.mesh, shift=number),
        lambda: taut.TimeStep(factor=number),
        lambda: taut.TimeStep.value(number),
    ):
        with pytest.raises(REFUSED):
            call()
    if number is not None:
        for call in (
            lambda: exact.field(0, radius=number),
            lambda: exact.field(0, time_limit=number),
            lambda: taut.Control(time_limit=number),
        ):
            with pytest.raises(REFUSED):
                call()


@pytest.mark.parametrize("count", [-1, -(2**70)])
def test_counts_are_not_negative(exact, heat, count):
    for call in (
        lambda: exact.distance_rows([0], threads=count),
        lambda: heat.distance_rows([0], threads=count),
        lambda: exact.distances_within([0], 1.0, threads=count),
        lambda: exact.farthest_points(0, count),
        lambda: taut.even_levels(exact.mesh, POSITIONS[:, 0], count),
        lambda: taut.Control(memory_limit=count),
    ):
        with pytest.raises(taut.InvalidArgument):
            call()


def test_numbers_too_large_for_c(exact):
    for call in (
        lambda: exact.distances_within([0], 2**2000),
        lambda: exact.field(0, radius=2**2000),
        lambda: exact.field(0, time_limit=2**2000),
        lambda: taut.HeatSolver(exact.mesh, boundary=2**2000),
        lambda: taut.TimeStep.value(2**2000),
    ):
        with pytest.raises(REFUSED):
            call()


def test_counts_do_not_wrap_around(exact):
    with pytest.raises(taut.InvalidArgument):
        taut.even_levels(exact.mesh, POSITIONS[:, 0], 2**64 + 2)
    with pytest.raises((ValueError, MemoryError)):
        exact.farthest_points(0, 2**64 + 2)
    exact.field(0, control=taut.Control(memory_limit=2**64 + 2))
    exact.distance_rows([0], threads=2**64 + 2)


@pytest.mark.parametrize("other", [None, 5, "mesh", POSITIONS, taut.Mesh, taut.Control()], ids=lambda it: type(it).__name__)
def test_what_is_no_mesh(heat, other):
    for call in (
        lambda: taut.ExactSolver(other),
        lambda: taut.HeatSolver(other),
        lambda: heat.with_mesh(other),
        lambda: taut.Closest(other),
        lambda: taut.isolines(other, POSITIONS[:, 0], 0.5),
        lambda: taut.even_levels(other, POSITIONS[:, 0], 3),
        lambda: taut.descent_paths(other, POSITIONS[:, 0]),
    ):
        with pytest.raises(TypeError, match="mesh must be"):
            call()


def test_what_is_no_control(exact):
    with pytest.raises(TypeError, match="control must be"):
        exact.field(0, control=5)
    with pytest.raises(TypeError):
        exact.field(0, progress=5)


def test_paths_of_files(tmp_path):
    path = tmp_path / "one.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    assert taut.Mesh.read(path) == taut.Mesh.read(os.fsencode(path))
    # C would read one.off.
    with pytest.raises(ValueError, match="null"):
        taut.Mesh.read(f"{path}\0.ply")
    for bad in (None, 5, 1.5, [str(path)]):
        with pytest.raises(TypeError):
            taut.Mesh.read(bad)
    for missing in ("", "\udcff.off", str(tmp_path), str(path) + "\n", "x" * 100_000 + ".off"):
        with pytest.raises((taut.IoError, taut.FormatError, taut.InvalidArgument)):
            taut.Mesh.read(missing)


@pytest.mark.parametrize("rows", [0, 1, 2, 5])
def test_outputs_that_lie_over_the_inputs(exact, rows):
    """C reads all of its inputs before it writes."""
    weights = np.tile([(0.2, 0.3, 0.5)], (rows, 1))
    faces = np.arange(rows) % 2
    expected = exact.mesh.point_positions(faces, weights)
    assert np.array_equal(exact.mesh.point_positions(faces, weights, out=weights), expected)


def test_arrays_with_strange_strides(exact):
    column = np.zeros((4, 10**6))[:, 0]
    column[:] = [0, 1, 2, 1]
    assert np.array_equal(taut.even_levels(exact.mesh, column, 3), [0.5, 1, 1.5])
    everywhere = np.lib.stride_tricks.as_strided(np.zeros(1, np.int64), (10**6,), (0,))
    assert np.array_equal(exact.compute_distance(everywhere), exact.compute_distance(0))
    odd = np.frombuffer(bytearray(8 * 12 + 1), np.uint8)[1:].view(np.float64)
    odd[:] = POSITIONS.ravel()
    assert taut.Mesh(odd.reshape(4, 3), TRIANGLES) == exact.mesh


def test_arrays_of_other_libraries(exact):
    assert taut.Mesh(Wrapped(POSITIONS), Wrapped(TRIANGLES)) == exact.mesh
    assert np.array_equal(exact.compute_distance(Wrapped([0, 2])), exact.compute_distance([0, 2]))
    with pytest.raises(TypeError):
        exact.compute_distance(Wrapped([0.5]))


def test_attributes_that_were_replaced(exact):
    """They are converted for C, and the copy must live as long as the call."""
    expected = exact.compute_distance(0)
    sources, targets = taut.Sources([1]), taut.Targets([1])
    sources.vertices = targets.vertices = np.zeros(5_000_000, np.int64)[::-1]
    assert np.array_equal(exact.compute_distance(sources), expected)
    assert not exact.field(0).distances(targets).any()
    sources.vertices = "no vertices"
    with pytest.raises(TypeError):
        exact.compute_distance(sources)


def test_curves_that_contradict_themselves(exact):
    good = taut.isolines(exact.mesh, POSITIONS[:, 0], [0.5])
    names = ("offsets", "positions", "faces", "barycentrics", "closed", "levels", "sources")
    parts = {name: getattr(good, name) for name in names}
    for wrong in (
        {"offsets": [0, 99]},
        {"offsets": [5, 0]},
        {"offsets": [0]},
        {"faces": [9] * len(good.faces)},
        {"faces": []},
        {"barycentrics": np.zeros((0, 3))},
        {"barycentrics": np.full_like(good.barycentrics, np.nan)},
        {"closed": [1] * 50},
    ):
        with pytest.raises(taut.InvalidArgument):
            exact.compute_distance(taut.Sources(curves=taut.Curves(**{**parts, **wrong})))


def test_objects_that_were_never_made():
    for kind in (taut.Mesh, taut.ExactSolver, taut.HeatSolver, taut.ExactField, taut.HeatField, taut.Closest):
        with pytest.raises(AttributeError):
            repr(kind.__new__(kind))
    with pytest.raises(AttributeError):
        taut.Control.__new__(taut.Control).cancel()


# ----------------------------------------------------------------------------------------------------- Random meshes

COORDINATE = some.floats(-2, 2) | some.sampled_from([0.0, 1.0, -0.0, 1e-300, 1e300, np.nan, np.inf])
INDEX = some.integers(0, 7) | some.sampled_from([-1, 8, 2**31, 2**32])


@slow
@hypothesis.given(
    arrays_of.arrays(float, (8, 3), elements=COORDINATE),
    arrays_of.arrays(np.int64, some.tuples(some.integers(0, 12), some.just(3)), elements=INDEX),
    some.lists(some.integers(0, 7), min_size=1, max_size=3),
)
def test_any_soup_gets_an_answer_or_an_error(positions, triangles, sources):
    try:
        mesh = taut.Mesh(positions, triangles)
    except taut.InvalidMesh as error:
        assert error.element in ("face", "vertex")
        return
    mesh.report()
    exact = taut.ExactSolver(mesh)
    field = exact.field(sources, keep_windows=True)
    distances = field.distances()
    assert not np.isnan(distances).any()
    assert not distances[sources].any()
    assert np.array_equal(field.nearest_sources() < 0, np.isinf(distances))
    assert pickle.loads(pickle.dumps(mesh)) == mesh
    try:
        assert len(field.paths()) == 8
        heat = taut.HeatSolver(mesh).compute_distance(sources)
    except taut.Error:
        return
    assert not np.isnan(heat).any()


@slow
@hypothesis.given(
    some.integers(3, 9), some.integers(3, 9), some.integers(0, 2**32 - 1), some.floats(0, 1), some.floats(0, 0.4)
)
def test_random_surfaces_are_as_pygeodesic_says(rows, columns, seed, height, missing):
    """Rough grids with holes and random diagonals, where no vertex joins two fans."""
    random = np.random.default_rng(seed)
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    positions = np.stack([i, j, np.zeros_like(i)], -1).reshape(-1, 3) + random.uniform(-0.3, 0.3, (rows * columns, 3))
    positions[:, 2] += height * random.normal(size=len(positions))
    a = (i[:-1, :-1] * columns + j[:-1, :-1]).ravel()
    quads = np.column_stack([a, a + columns, a + columns + 1, a + 1])
    turned = np.where(random.integers(2, size=len(quads))[:, None], quads, np.roll(quads, 1, axis=1))
    triangles = np.concatenate([turned[:, [0, 1, 2]], turned[:, [0, 2, 3]]])
    triangles = random.permutation(triangles[random.random(len(triangles)) >= missing])
    hypothesis.assume(len(triangles))
    used, triangles = np.unique(triangles, return_inverse=True)
    positions, triangles = positions[used], triangles.reshape(-1, 3)
    mesh = taut.Mesh(positions, triangles)
    hypothesis.assume(not len(mesh.report().nonmanifold_vertices))
    source = int(random.integers(len(positions)))
    ours = taut.ExactSolver(mesh).compute_distance(source)
    reached = np.flatnonzero(np.isfinite(ours)).astype(np.int32)
    peer = geodesic.PyGeodesicAlgorithmExact(positions, triangles.astype(np.int32))
    theirs = peer.geodesicDistances(np.array([source], np.int32), reached)[0]
    assert np.abs(ours[reached] - theirs).max() <= 1e-10 * theirs.max()
    part = mesh.report().component_of
    assert np.array_equal(np.isfinite(ours), part == part[source])


# ---------------------------------------------------------------------------------------------------- While it runs


def test_solvers_called_by_the_progress_of_a_solver(large):
    expected = large.compute_distance(0)
    depth, deepest = 0, 0

    def tell(share):
        nonlocal depth, deepest
        if depth < 3:
            depth += 1
            deepest = max(deepest, depth)
            assert np.array_equal(small.compute_distance(0, progress=tell), near)
            depth -= 1

    small = taut.ExactSolver(taut.Mesh(POSITIONS, TRIANGLES))
    near = small.compute_distance(0)
    assert np.array_equal(large.compute_distance(0, progress=tell), expected)
    assert deepest == 3


def test_a_call_by_the_progress_of_its_own_control(large):
    expected = large.compute_distance(0)
    inner = []

    def tell(share):
        if len(inner) < 5:
            inner.append(large.compute_distance(0, control=control))

    control = taut.Control(progress=tell)
    assert np.array_equal(large.compute_distance(0, control=control), expected)
    assert inner
    assert all(np.array_equal(row, expected) for row in inner)


def test_progress_that_calls_itself_without_end(large):
    def tell(share):
        large.compute_distance(0, progress=tell)

    with pytest.raises(RecursionError):
        large.compute_distance(0, progress=tell)


def test_progress_that_answers_with_what_is_neither_true_nor_false(large):
    with pytest.raises(ValueError, match="ambiguous"):
        large.compute_distance(0, progress=lambda share: np.zeros(2))
    with pytest.raises(taut.Cancelled):
        large.compute_distance(0, progress=lambda share: "stop")


EXCEPTIONS = [KeyboardInterrupt, SystemExit, GeneratorExit, StopIteration, MemoryError, taut.Error]


@pytest.mark.parametrize("exception", EXCEPTIONS)
def test_whatever_progress_raises_comes_out_once(large, exception, capfd):
    def tell(share):
        raise exception("raised")

    control = taut.Control(progress=tell)
    with pytest.raises(exception, match="raised"):
        large.compute_distance(0, control=control)
    for _ in range(3):
        with pytest.raises(taut.Cancelled):
            large.compute_distance(0, control=control)
    assert capfd.readouterr().err == ""


def test_a_control_of_several_threads(large):
    expected = large.compute_distance(0)
    told, rows = [], []
    control = taut.Control(progress=told.append)
    work = lambda: rows.extend(large.compute_distance(0, control=control) for _ in range(5))
    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert told
    assert len(rows) == 20
    assert all(np.array_equal(row, expected) for row in rows)


def test_everything_is_deleted_while_a_thread_uses_it(elephant):
    expected = taut.ExactSolver(elephant).distance_rows(np.arange(30), threads=1)
    mesh = taut.Mesh(elephant.positions.copy(), elephant.triangles.copy())
    exact, sources, out = taut.ExactSolver(mesh), np.arange(30), np.empty_like(expected)
    results, started = [], threading.Event()

    def work(exact, sources, out):
        results.append(exact.distance_rows(sources, out=out, threads=2, progress=lambda share: started.set()))

    thread = threading.Thread(target=work, args=(exact, sources, out))
    thread.start()
    started.wait(10)
    del mesh, exact, sources, out
    gc.collect()
    rubbish = [np.full(100_000, np.nan) for _ in range(20)]
    thread.join()
    assert len(rubbish) == 20
    assert np.array_equal(results[0], expected)


def test_garbage_is_collected_at_every_step():
    """Meshes, fields and controls in cycles, freed by whichever thread happens to collect."""
    stop, failures = threading.Event(), []

    class Cycle:
        pass

    def work():
        while not stop.is_set():
            cycle = Cycle()
            cycle.itself = cycle
            cycle.mesh = taut.Mesh(POSITIONS, TRIANGLES)
            cycle.field = taut.ExactSolver(cycle.mesh).field(0)
            cycle.control = taut.Control(progress=lambda share, cycle=cycle: None)
            heat = taut.HeatSolver(cycle.mesh, control=cycle.control)
            if abs(cycle.field.distances()[2] - 2**0.5) > 1e-15 or heat.compute_distance(0)[0] != 0:
                failures.append(cycle)

    before = gc.get_threshold()
    gc.set_threshold(1)
    threads = [threading.Thread(target=work) for _ in range(3)]
    try:
        for thread in threads:
            thread.start()
        time.sleep(1)
        stop.set()
        for thread in threads:
            thread.join()
    finally:
        gc.set_threshold(*before)
    assert failures == []


def test_arrays_that_change_while_they_are_read(elephant):
    """What C reads once it has copied and checked: never an index that was not checked."""
    exact = taut.ExactSolver(elephant)
    positions, triangles = elephant.positions.copy(), elephant.triangles.copy()
    good_positions, good_triangles = positions.copy(), triangles.copy()
    sources, faces, weights = np.zeros(50, np.int64), np.zeros(50, np.int64), np.full((50, 3), 1 / 3)
    values, stop = positions[:, 0].copy(), threading.Event()

    def disturb():
        random = np.random.default_rng(0)
        while not stop.is_set():
            some_faces = random.integers(len(triangles), size=50)
            triangles[some_faces] = random.choice([2**40, -1, 2**31, 10**7])
            sources[:] = random.choice([0, 2**31, 2**62, -5, 3000])
            faces[:] = random.choice([0, 10**8, -3])
            weights[:] = random.choice([1 / 3, np.nan, 5, -1e300])
            positions[random.integers(len(positions))] = np.nan
            values[random.integers(len(values), size=30)] = np.nan
            triangles[some_faces] = good_triangles[some_faces]
            positions[:] = good_positions

    calls = (
        lambda: taut.Mesh(positions, triangles).report(),
        lambda: exact.field(sources, radius=0.05),
        lambda: exact.field(taut.Sources(faces=faces, barycentrics=weights), radius=0.05),
        lambda: elephant.point_positions(faces, weights),
        lambda: taut.isolines(elephant, values, [0.0, 0.1]),
        lambda: taut.descent_paths(elephant, values, 0, sources),
    )
    thread = threading.Thread(target=disturb)
    thread.start()
    outcomes = set()
    try:
        end = time.monotonic() + 2
        while time.monotonic() < end:
            for call in calls:
                try:
                    call()
                    outcomes.add("result")
                except (taut.InvalidArgument, taut.InvalidMesh):
                    outcomes.add("error")
    finally:
        stop.set()
        thread.join()
    assert outcomes == {"result", "error"}


# ----------------------------------------------------------------------------------------- Signals, forks and the end

needs_alarms = pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="this system has no such alarms")
needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")


@needs_alarms
def test_ctrl_c_at_any_moment(run_python, cgal_meshes):
    """Thousands of interrupts, each after another part of a millisecond: right results or KeyboardInterrupt, and no leak."""
    done = run_python(
        """
import os, random, resource, signal, sys, time
import numpy as np, taut

def interrupt(number, frame):
    raise KeyboardInterrupt

mesh = taut.Mesh.read(os.environ["MESH"])
small = taut.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 3), (1, 2, 3)])
exact, heat = taut.ExactSolver(mesh), taut.HeatSolver(mesh)
far, near = exact.compute_distance(0), heat.compute_distance(0)
calls = [
    lambda: np.array_equal(exact.compute_distance(0), far),
    lambda: np.array_equal(heat.compute_distance(0), near),
    lambda: np.array_equal(exact.distance_rows([0, 1], threads=2)[0], far),
    lambda: taut.HeatSolver(small).compute_distance(2)[2] == 0,
    lambda: taut.Mesh(small.positions, small.triangles) == small and small.report() and True,
    lambda: taut.ExactSolver(small).find_geodesic_path(0, 2).shape == (3, 3),
    lambda: len(taut.isolines(mesh, far, taut.even_levels(mesh, far, 5))) >= 5,
    lambda: (taut.Closest(small).points(small.positions).distances < 1e-12).all(),
    lambda: np.array_equal(heat.compute_distance(0, progress=lambda share: None), near),
]
signal.signal(signal.SIGALRM, interrupt)
sys.unraisablehook = lambda what: None  # where it comes in a destructor Python can only tell
random.seed(1)
counts = [0, 0]
end = time.monotonic() + 6
while time.monotonic() < end:
    try:
        signal.setitimer(signal.ITIMER_REAL, random.choice([1e-5, 1e-4, 1e-3, 1e-2]) * random.random() + 1e-6)
        assert random.choice(calls)()
        signal.setitimer(signal.ITIMER_REAL, 0)
        counts[0] += 1
    except KeyboardInterrupt:
        counts[1] += 1
    if sum(counts) == 300:
        early = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
signal.setitimer(signal.ITIMER_REAL, 0)
assert min(counts) > 50, counts
late = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
assert late - early < 20_000, (early, late)
assert np.array_equal(exact.compute_distance(0), far)
print("well")
""",
        MESH=str(cgal_meshes / "elephant.off"),
    )
    assert (done.returncode, done.stdout) == (0, "well\n"), done.stderr


@needs_fork
def test_forks_while_calls_run(run_python, cgal_meshes):
    """In another thread, and in the progress of a call of one thread; the child computes, and so does the parent."""
    done = run_python(
        """
import os, threading
import numpy as np, taut

exact = taut.ExactSolver(taut.Mesh.read(os.environ["MESH"]))
expected = exact.distance_rows([0, 1], threads=1)

def child():
    os._exit(0 if np.array_equal(exact.distance_rows([0, 1], threads=2), expected) else 3)

started = threading.Event()
busy = threading.Thread(target=lambda: exact.distance_rows(range(200), threads=2, progress=lambda share: started.set()))
busy.start()
started.wait()
for _ in range(5):
    process = os.fork()
    if not process:
        child()
    assert os.waitpid(process, 0)[1] == 0
busy.join()

processes = []
def tell(share):
    if not processes:
        processes.append(os.fork())

rows = exact.distance_rows([0, 1], threads=1, progress=tell)
if processes == [0]:
    os._exit(0 if np.array_equal(rows, expected) else 4)
assert os.waitpid(processes[0], 0)[1] == 0
assert np.array_equal(rows, expected)
print("well")
""",
        MESH=str(cgal_meshes / "elephant.off"),
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "well\n", "")


@pytest.mark.parametrize("how", ["", "progress=lambda share: None", "control=taut.Control(time_limit=1000)"])
@pytest.mark.parametrize("threads", [1, 2])
def test_the_end_of_the_program_while_daemon_threads_call(run_python, cgal_meshes, how, threads):
    done = run_python(
        f"""
import os, threading, time
import taut

exact = taut.ExactSolver(taut.Mesh.read(os.environ["MESH"]))
heat = taut.HeatSolver(exact.mesh)
def exact_rows():
    exact.distance_rows(range(2000), threads={threads}, {how})
def heat_rows():
    while True:
        heat.compute_distance(0, {how})
for work in (exact_rows, heat_rows, heat_rows):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)
print("well")
""",
        MESH=str(cgal_meshes / "elephant.off"),
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "well\n", "")


# --------------------------------------------------------------------------------------------- Pickles of version 0.1.0

OBJECTS = {
    "mesh": lambda: taut.Mesh(POSITIONS, TRIANGLES),
    "exact": lambda: taut.ExactSolver(taut.Mesh(POSITIONS, TRIANGLES)),
    "heat": lambda: taut.HeatSolver(
        taut.Mesh(POSITIONS, TRIANGLES), time_step="mean_sigma", shift="min"
    ).with_time_step(0.5),
    "sources": lambda: taut.Sources([1], faces=[0], barycentrics=[(0.25, 0.25, 0.5)], offsets=[0, 1]),
    "error": lambda: taut.InvalidMesh(
        "face 1: bad", taut.Status.INVALID_MESH, taut.Reason.INDEX_OUT_OF_RANGE, "face", 1
    ),
}
PICKLES = {
    "mesh": (
        "gASVdQEAAAAAAACMCXRhdXQubWVzaJSMBE1lc2iUk5SMFW51bXB5LmNvcmUubXVsdGlhcnJheZSMDF9yZWNvbnN0cnVjdJSTlIwFbnVtcHmUjA"
        "duZGFycmF5lJOUSwCFlEMBYpSHlFKUKEsBSwRLA4aUaAaMBWR0eXBllJOUjAJmOJSJiIeUUpQoSwOMATyUTk5OSv////9K/////0sAdJRiiUNg"
        "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAADwPwAAAAAAAAAAAAAAAAAAAAAAAA"
        "AAAADwPwAAAAAAAAAAlHSUYmgFaAhLAIWUaAqHlFKUKEsBSwJLA4aUaA+MAmk4lImIh5RSlChLA2gTTk5OSv////9K/////0sAdJRiiUMwAAAA"
        "AAAAAAABAAAAAAAAAAMAAAAAAAAAAQAAAAAAAAACAAAAAAAAAAMAAAAAAAAAlHSUYoaUUpQu"
    ),
    "exact": (
        "gASVlgEAAAAAAACMCnRhdXQuZXhhY3SUjAtFeGFjdFNvbHZlcpSTlIwJdGF1dC5tZXNolIwETWVzaJSTlIwVbnVtcHkuY29yZS5tdWx0aWFycm"
        "F5lIwMX3JlY29uc3RydWN0lJOUjAVudW1weZSMB25kYXJyYXmUk5RLAIWUQwFilIeUUpQoSwFLBEsDhpRoCYwFZHR5cGWUk5SMAmY4lImIh5RS"
        "lChLA4wBPJROTk5K/////0r/////SwB0lGKJQ2AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADwPwAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
        "DwPwAAAAAAAPA/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/AAAAAAAAAACUdJRiaAhoC0sAhZRoDYeUUpQoSwFLAksDhpRoEowCaTiUiYiHlFKU"
        "KEsDaBZOTk5K/////0r/////SwB0lGKJQzAAAAAAAAAAAAEAAAAAAAAAAwAAAAAAAAABAAAAAAAAAAIAAAAAAAAAAwAAAAAAAACUdJRihpRSlI"
        "WUUpQu"
    ),
    "heat": (
        "gASVVgIAAAAAAACMCXRhdXQuaGVhdJSMCV9wcmVwYXJlZJSTlIwJdGF1dC5tZXNolIwETWVzaJSTlIwVbnVtcHkuY29yZS5tdWx0aWFycmF5lI"
        "wMX3JlY29uc3RydWN0lJOUjAVudW1weZSMB25kYXJyYXmUk5RLAIWUQwFilIeUUpQoSwFLBEsDhpRoCYwFZHR5cGWUk5SMAmY4lImIh5RSlChL"
        "A4wBPJROTk5K/////0r/////SwB0lGKJQ2AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADwPwAAAAAAAAAAAAAAAAAAAAAAAAAAAADwPw"
        "AAAAAAAPA/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/AAAAAAAAAACUdJRiaAhoC0sAhZRoDYeUUpQoSwFLAksDhpRoEowCaTiUiYiHlFKUKEsD"
        "aBZOTk5K/////0r/////SwB0lGKJQzAAAAAAAAAAAAEAAAAAAAAAAwAAAAAAAAABAAAAAAAAAAIAAAAAAAAAAwAAAAAAAACUdJRihpRSlIwIYn"
        "VpbHRpbnOUjAdnZXRhdHRylJOUaAOMCFRpbWVTdGVwlJOUjAV2YWx1ZZSGlFKURz/gAAAAAAAAhZRSlH2UKIwJdGltZV9zdGVwlGgqjAptZWFu"
        "X3NpZ21hlIwFcGFwZXKURz/wAAAAAAAAh5RSlIwIYm91bmRhcnmURwAAAAAAAAAAjAlsYXBsYWNpYW6UjAlpbnRyaW5zaWOUjAVzaGlmdJSMA2"
        "1pbpSMBnNvbHZlcpSMCnN1cGVybm9kYWyUdYeUUpQu"
    ),
    "sources": (
        "gASVYAEAAAAAAACMDHRhdXQuc291cmNlc5SMCF9zb3VyY2VzlJOUKIwVbnVtcHkuY29yZS5tdWx0aWFycmF5lIwMX3JlY29uc3RydWN0lJOUjA"
        "VudW1weZSMB25kYXJyYXmUk5RLAIWUQwFilIeUUpQoSwFLAYWUaAaMBWR0eXBllJOUjAJpOJSJiIeUUpQoSwOMATyUTk5OSv////9K/////0sA"
        "dJRiiUMIAQAAAAAAAACUdJRiaAVoCEsAhZRoCoeUUpQoSwFLAYWUaBKJQwgAAAAAAAAAAJR0lGJoBWgISwCFlGgKh5RSlChLAUsBSwOGlGgPjA"
        "JmOJSJiIeUUpQoSwNoE05OTkr/////Sv////9LAHSUYolDGAAAAAAAANA/AAAAAAAA0D8AAAAAAADgP5R0lGJoBWgISwCFlGgKh5RSlChLAUsC"
        "hZRoI4lDEAAAAAAAAAAAAAAAAAAA8D+UdJRiTnSUUpQu"
    ),
    "error": (
        "gASVbwAAAAAAAACMDHRhdXQuX2Vycm9yc5SMC0ludmFsaWRNZXNolJOUKIwLZmFjZSAxOiBiYWSUjAx0YXV0Ll9uYXRpdmWUjAZTdGF0dXOUk5"
        "RLAoWUUpRoBIwGUmVhc29ulJOUSxSFlFKUjARmYWNllEsBdJRSlC4="
    ),
}


@pytest.mark.parametrize("name", PICKLES)
def test_pickles_of_earlier_versions_load(exact, name):
    loaded = pickle.loads(base64.b64decode(PICKLES[name]))
    expected = OBJECTS[name]()
    assert type(loaded) is type(expected)
    if isinstance(loaded, taut.HeatSolver):
        assert loaded.time_step == expected.time_step
        assert np.array_equal(loaded.compute_distance(0), expected.compute_distance(0))
    elif isinstance(loaded, taut.ExactSolver):
        assert loaded.mesh == expected.mesh
    elif isinstance(loaded, taut.Error):
        assert (str(loaded), vars(loaded)) == (str(expected), vars(expected))
    else:
        assert loaded == expected
