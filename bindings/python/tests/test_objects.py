"""Objects pickle and copy, are freed, and serve many threads and processes."""

import copy
import gc
import os
import pickle
import threading
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

import taut


def made_of(mesh):
    """One of each kind of object that pickles, and what it tells."""
    lines = taut.isolines(mesh, mesh.positions[:, 0], [0.0, 0.1])
    sources = taut.Sources([1, 2], faces=[3], barycentrics=[(0.2, 0.3, 0.5)], curves=lines, offsets=np.zeros(3 + len(lines)))
    heat = taut.HeatSolver(mesh, time_step=taut.TimeStep("sigma", factor=2), boundary=0.5, laplacian="plain", shift="min")
    return [
        (mesh, lambda m: (m.positions, m.triangles)),
        (heat, lambda h: (h.compute_distance(5), h.time_step)),
        (heat.with_time_step("median_fit"), lambda h: (h.compute_distance(5), h.time_step)),
        (taut.ExactSolver(mesh), lambda e: e.compute_distance(5)),
        (taut.Closest(mesh), lambda c: c.points([(0.1, 0.2, 0.3)])),
        (sources, lambda s: taut.ExactSolver(mesh).compute_distance(s)),
        (taut.Targets([1], faces=[2], barycentrics=[(0, 0.5, 0.5)]), lambda t: (t.vertices, t.faces, t.barycentrics)),
        (taut.TimeStep.value(0.5), lambda t: mesh.time_step(t)),
        (lines, lambda c: (c.offsets, c.positions, c.faces, c.barycentrics, c.closed, c.levels, c.sources)),
        (mesh.report(), lambda r: (r.component_of, r.components, r.smallest_angle)),
        (mesh.properties(), tuple),
        (taut.ExactSolver(mesh).distances_within([0, 1], 0.1), tuple),
    ]


def same(one, other):
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    return np.asarray(one).tobytes() == np.asarray(other).tobytes()


@pytest.mark.parametrize("place", range(12))
@pytest.mark.parametrize(
    "again",
    [lambda x: pickle.loads(pickle.dumps(x)), lambda x: pickle.loads(pickle.dumps(x, 2)), copy.copy, copy.deepcopy],
)
def test_copies_tell_the_same_to_the_bit(elephant, place, again):
    thing, tell = made_of(elephant)[place]
    other = again(thing)
    assert type(other) is type(thing)
    assert same(tell(thing), tell(other))


def test_a_solver_that_moved_pickles(elephant):
    moved = elephant.with_positions(elephant.positions * (1, 1.3, 1))
    solver = taut.HeatSolver(elephant, laplacian="plain").with_mesh(moved)
    again = pickle.loads(pickle.dumps(solver))
    assert again.mesh == moved
    np.testing.assert_allclose(again.compute_distance(5), solver.compute_distance(5), rtol=1e-9)
    assert again.report.flips == 0


@pytest.mark.parametrize("kind", ["Mesh", "Sources", "Targets", "TimeStep", "Curves"])
def test_values_are_equal(elephant, kind):
    for thing, _ in made_of(elephant):
        if type(thing).__name__ == kind:
            assert thing == pickle.loads(pickle.dumps(thing))
            return
    raise AssertionError(kind)


def test_sources_differ():
    base = taut.Sources([1, 2], offsets=[0, 1])
    assert base == taut.Sources(np.array([1, 2], np.uint16), offsets=(0.0, 1.0))
    assert base != taut.Sources([1, 3], offsets=[0, 1])
    assert base != taut.Sources([1, 2])
    assert taut.Targets([1]) != taut.Targets([1, 2])
    assert taut.Targets([1]) != taut.Sources([1])


def test_fields_do_not_pickle(square):
    for field in (taut.ExactSolver(square).field(0), taut.HeatSolver(square).field(0)):
        with pytest.raises(TypeError, match=f"a {type(field).__name__} does not pickle"):
            pickle.dumps(field)
        assert copy.copy(field) is copy.deepcopy(field) is field


def one_row(solver, source):
    return os.getpid(), solver.compute_distance(source)


@pytest.mark.parametrize("method", ["spawn", "fork"])
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")  # of fork in a process with threads
def test_solvers_go_to_other_processes(elephant, method):
    with ProcessPoolExecutor(2, mp_context=get_context(method)) as pool:
        for solver in (taut.HeatSolver(elephant), taut.ExactSolver(elephant)):
            rows = list(pool.map(one_row, [solver] * 4, range(4)))
            assert os.getpid() not in {pid for pid, _ in rows}
            for source, (_, row) in enumerate(rows):
                np.testing.assert_array_equal(row, solver.compute_distance(source))


def test_threads_on_one_solver(elephant):
    for solver in (taut.HeatSolver(elephant), taut.ExactSolver(elephant)):
        expected = solver.distance_rows(range(24), threads=1)
        with ThreadPoolExecutor(4) as pool:
            rows = list(pool.map(solver.compute_distance, range(24)))
        np.testing.assert_array_equal(rows, expected)


def test_the_interpreter_goes_on_while_a_call_runs(bunny):
    counted, done = 0, threading.Event()
    exact = taut.ExactSolver(bunny)

    def work():
        exact.field(0)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        counted += 1
    thread.join()
    assert counted > 10_000


def test_what_was_made_outlives_what_it_was_made_of(elephant):
    mesh = taut.Mesh(elephant.positions, elephant.triangles)
    expected = taut.ExactSolver(elephant).compute_distance(3)
    field = taut.ExactSolver(mesh).field(3)
    heat = taut.HeatSolver(mesh).field(3)
    del mesh
    gc.collect()
    np.testing.assert_array_equal(field.distances(), expected)
    assert heat.nearest_sources().max() == 0


def test_sources_outlive_their_arrays(elephant):
    sources = taut.Sources(np.arange(50), faces=np.arange(9), barycentrics=np.full((9, 3), 1 / 3))
    gc.collect()
    [np.full(50, 10**6) for _ in range(100)]
    assert (taut.ExactSolver(elephant).compute_distance(sources)[:50] == 0).all()


def memory_in_use():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_handles_are_freed(elephant):
    positions, triangles = elephant.positions, elephant.triangles

    def use():
        mesh = taut.Mesh(positions, triangles)
        taut.HeatSolver(mesh).field([0, 1]).distances()
        exact = taut.ExactSolver(mesh)
        exact.field(0, keep_windows=True).paths(range(100))
        exact.distances_within([0], 0.1)
        taut.Closest(mesh)
        mesh.report()
        with pytest.raises(taut.Cancelled):
            taut.HeatSolver(mesh, progress=lambda share: True)

    gc.disable()  # counted references free all of it
    try:
        for _ in range(5):
            use()
        before = memory_in_use()
        for _ in range(30):
            use()
        assert memory_in_use() - before < 20e6
    finally:
        gc.enable()


AT_EXIT = """
import threading, time
import taut

mesh = taut.Mesh.read({path!r})
exact, heat = taut.ExactSolver(mesh), taut.HeatSolver(mesh)
fields = [exact.field(0), heat.field(0)]
fields.append(fields)  # freed by nobody before the end
control = taut.Control()

def work(**how):
    while True:
        exact.field(0, **how)

for how in {{}}, {{"control": control}}, {{"progress": lambda share: None}}, {{"time_limit": 100}}:
    threading.Thread(target=work, kwargs=how, daemon=True).start()
time.sleep(0.1)
"""


def test_the_end_of_a_program(cgal_meshes, run_python):
    told = run_python(AT_EXIT.format(path=str(cgal_meshes / "elephant.off")))
    assert (told.returncode, told.stdout, told.stderr) == (0, "", "")


def test_use_while_a_program_ends(run_python):
    program = """
import atexit, taut
mesh = taut.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
atexit.register(lambda: print(taut.HeatSolver(mesh).compute_distance(0)[0]))
"""
    told = run_python(program)
    assert (told.returncode, told.stdout, told.stderr) == (0, "0.0\n", "")
