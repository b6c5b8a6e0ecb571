"""Work spread over threads, processes and Dask: the numbers of a loop, to the bit, and errors that arrive whole."""

import concurrent.futures
import importlib.util
import multiprocessing
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import time

import joblib
import numpy as np
import pytest
from distributed import Client

import taut

EXAMPLE = pathlib.Path(__file__).parent.parent / "examples/dask_distances.py"
KINDS = [taut.HeatSolver, taut.ExactSolver]
SOURCES = np.arange(0, 2700, 110)
BLOCKS = np.array_split(SOURCES, 7)

# From Python 3.12 on: the processes are forked beside the threads of Dask on purpose.
pytestmark = pytest.mark.filterwarnings("ignore:.*multi-threaded:DeprecationWarning")
needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")


@pytest.fixture(scope="module", params=KINDS, ids=lambda kind: kind.__name__)
def solver(request, elephant):
    return request.param(elephant)


@pytest.fixture(scope="module")
def serial(solver):
    """A row at a time."""
    return np.array([solver.compute_distance(source) for source in SOURCES])


@pytest.fixture(scope="module")
def example():
    spec = importlib.util.spec_from_file_location(EXAMPLE.stem, EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    # Workers know no such module: what it defines travels to them by value.
    module.block_of_rows.__module__ = module.mean_distance.__module__ = "__main__"
    return module


@pytest.fixture(scope="module")
def client(example):
    with example.local_cluster(2) as cluster, Client(cluster) as client:
        yield client


def rows_of(solver, sources):
    return solver.distance_rows(sources, threads=1)


def solver_with_other_options(mesh):
    step = taut.TimeStep("mean_sigma", factor=0.7)
    return taut.HeatSolver(mesh, time_step=step, boundary=0.3, laplacian="plain", shift="min")


# ---------------------------------------------------------------------------------------------------------- Pickling


def test_a_loaded_solver_gives_the_same_numbers(solver, serial):
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        assert np.array_equal(rows_of(pickle.loads(pickle.dumps(solver, protocol)), SOURCES), serial)


def test_a_loaded_solver_has_its_options(elephant):
    solver = solver_with_other_options(elephant)
    loaded = pickle.loads(pickle.dumps(solver))
    assert loaded.time_step == solver.time_step
    assert np.array_equal(loaded.compute_distance(7), solver.compute_distance(7))
    assert not np.array_equal(loaded.compute_distance(7), taut.HeatSolver(elephant).compute_distance(7))


def test_solvers_made_of_solvers_pickle(elephant):
    moved = elephant.with_positions(1.5 * elephant.positions + 1)
    first = solver_with_other_options(elephant)
    retimed = first.with_time_step(0.01)
    moved_first = first.with_mesh(moved)
    for solver in (retimed, moved_first, moved_first.with_time_step(0.01), retimed.with_mesh(moved)):
        loaded = pickle.loads(pickle.dumps(solver))
        assert loaded.time_step == solver.time_step
        np.testing.assert_allclose(loaded.compute_distance(7), solver.compute_distance(7), rtol=1e-9)
        assert loaded.with_mesh(elephant).time_step == solver.with_mesh(elephant).time_step


# ------------------------------------------------------------------------------------------------- Threads, processes


def test_threads_share_a_solver(solver, serial):
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert np.array_equal(list(pool.map(solver.compute_distance, SOURCES)), serial)
        assert np.array_equal(np.vstack(list(pool.map(lambda block: rows_of(solver, block), BLOCKS))), serial)


def test_rows_by_threads_of_the_library(solver, serial):
    for threads in (0, 1, 2, 3):
        assert np.array_equal(solver.distance_rows(SOURCES, threads=threads), serial)


@pytest.mark.parametrize("method", ["spawn", pytest.param("fork", marks=needs_fork)])
def test_processes(solver, serial, method):
    with multiprocessing.get_context(method).Pool(2) as pool:
        rows = pool.starmap(rows_of, [(solver, block) for block in BLOCKS])
        assert np.array_equal(np.vstack(rows), serial)


@needs_fork
def test_a_forked_process_uses_the_solver_of_its_parent(solver, serial):
    reader, writer = multiprocessing.get_context("fork").Pipe(duplex=False)

    def child():
        writer.send(solver.distance_rows(SOURCES, threads=2))

    process = multiprocessing.get_context("fork").Process(target=child)
    process.start()
    assert np.array_equal(reader.recv(), serial)
    process.join()
    assert process.exitcode == 0


@pytest.mark.parametrize("backend", ["loky", "threading"])
def test_joblib(solver, serial, backend):
    with joblib.parallel_config(backend, n_jobs=2):
        rows = joblib.Parallel()(joblib.delayed(rows_of)(solver, block) for block in BLOCKS)
    assert np.array_equal(np.vstack(rows), serial)


def test_joblib_over_dask(client, solver, serial):
    with joblib.parallel_config("dask"):
        rows = joblib.Parallel()(joblib.delayed(rows_of)(solver, block) for block in BLOCKS)
    assert np.array_equal(np.vstack(rows), serial)


# -------------------------------------------------------------------------------------------------------------- Dask


def test_dask_spreads_sources(client, example, solver, serial, capsys):
    rows = example.distance_rows(client, solver, SOURCES, block=3)
    assert np.array_equal(rows, serial)
    assert f"{len(SOURCES)} of {len(SOURCES)} sources" in capsys.readouterr().out


def test_dask_runs_in_other_processes(client):
    processes = set(client.run(os.getpid).values())
    assert len(processes) == 2
    assert os.getpid() not in processes


def test_dask_spreads_meshes(client, example, cgal_meshes):
    paths = [str(cgal_meshes / name) for name in ("elephant.off", "fandisk.off", "camel.off")]
    means = client.gather([client.submit(example.mean_distance, path, 5) for path in paths])
    assert means == [example.mean_distance(path, 5) for path in paths]
    assert len(set(means)) == len(means)


# ------------------------------------------------------------------------------------------------------------ Errors

BAD = np.array([3, 4, 5, 6, 10**6, 7])


def assert_is_about_the_fifth_source(error, index=4):
    assert type(error) is taut.InvalidArgument
    assert isinstance(error, ValueError)
    assert (error.status, error.reason) == (taut.Status.INVALID_ARGUMENT, taut.Reason.VERTEX_OUT_OF_RANGE)
    assert (error.element, error.index) == ("source", index)
    assert str(10**6) in str(error)


def test_errors_pickle_with_all_that_they_tell(solver):
    with pytest.raises(taut.Error) as here:
        rows_of(solver, BAD)
    assert_is_about_the_fifth_source(here.value)
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        loaded = pickle.loads(pickle.dumps(here.value, protocol))
        assert_is_about_the_fifth_source(loaded)
        assert str(loaded) == str(here.value)


def test_every_kind_of_error_pickles():
    for kind in [taut.Error, *taut.Error.__subclasses__()]:
        error = kind("what it says", taut.Status.IO, taut.Reason.TRUNCATED, "line", 17)
        loaded = pickle.loads(pickle.dumps(error))
        assert type(loaded) is kind
        assert (str(loaded), vars(loaded)) == (str(error), vars(error))


@pytest.mark.parametrize("method", ["spawn", pytest.param("fork", marks=needs_fork)])
def test_errors_come_back_from_processes(solver, method):
    with multiprocessing.get_context(method).Pool(1) as pool, pytest.raises(taut.Error) as there:
        pool.apply(rows_of, (solver, BAD))
    assert_is_about_the_fifth_source(there.value)


def test_errors_come_back_from_joblib(solver):
    with pytest.raises(taut.Error) as there:
        joblib.Parallel(2)([joblib.delayed(rows_of)(solver, BAD)])
    assert_is_about_the_fifth_source(there.value)


def test_errors_come_back_from_dask(client, example, solver):
    with pytest.raises(taut.Error) as there:
        client.submit(rows_of, solver, BAD, pure=False).result()
    assert_is_about_the_fifth_source(there.value)
    with pytest.raises(RuntimeError, match="from number 3 on") as there:
        example.distance_rows(client, solver, BAD, block=3)
    assert_is_about_the_fifth_source(there.value.__cause__, index=1)


def test_a_mesh_that_is_no_mesh_comes_back_from_dask(client, example, tmp_path):
    path = tmp_path / "broken.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n")
    with pytest.raises(taut.InvalidMesh) as there:
        client.submit(example.mean_distance, str(path), 0).result()
    assert (there.value.element, there.value.index) == ("face", 0)


# ------------------------------------------------------------------------------------------- The example as a program


def start_example(*arguments):
    command = [sys.executable, EXAMPLE, *map(str, arguments)]
    output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    return subprocess.Popen(command, start_new_session=True, **output)


def processes_of(session):
    """Those of a session that still run."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(fields[3]) == session and fields[0] != "Z":
            found.append(int(stat.parent.name))
    return found


def listening_addresses(processes):
    """The local addresses, as /proc/net has them, of the sockets on which some processes listen."""
    sockets = set()
    for process in processes:
        for file in pathlib.Path(f"/proc/{process}/fd").iterdir():
            try:
                sockets.add(os.readlink(file))
            except OSError:
                continue
    addresses = set()
    for table in ("tcp", "tcp6"):
        for row in pathlib.Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            fields = row.split()
            if fields[3] == "0A" and f"socket:[{fields[9]}]" in sockets:
                addresses.add(fields[1].split(":")[0])
    return addresses


linux_only = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks into /proc")


def test_the_example_as_it_is_run(cgal_meshes):
    meshes = [cgal_meshes / "elephant.off", cgal_meshes / "fandisk.off"]
    with start_example(*meshes, "--sources", 80) as process:
        told = process.communicate(timeout=120)[0]
    assert process.returncode == 0, told
    assert "80 of 80 sources" in told
    assert "the same as a loop: True" in told


@linux_only
def test_ctrl_c_ends_the_example_and_its_workers(cgal_meshes):
    with start_example(cgal_meshes / "fandisk.off", "--sources", 20_000) as process:
        first = process.stdout.readline()
        assert first == "32 of 20000 sources\n", first + process.stdout.read()
        running = processes_of(process.pid)
        assert len(running) >= 3
        assert listening_addresses(running) == {"0100007F"}  # 127.0.0.1
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        told = process.communicate(timeout=60)[0]
    assert process.returncode in (1, 130, -signal.SIGINT), told
    assert "KeyboardInterrupt" in told
    deadline = time.monotonic() + 10
    while processes_of(process.pid) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert processes_of(process.pid) == []
