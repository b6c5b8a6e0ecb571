"""Progress, cancellation, limits, and Ctrl-C."""

import signal
import sys
import threading
import time

import numpy as np
import pytest

import taut
from taut import Reason

# Each is a long call, given a mesh and what prepares it.
LONG_CALLS = {
    "heat": lambda mesh, exact, **how: taut.HeatSolver(mesh, **how),
    "with_time_step": lambda mesh, exact, **how: HEAT(mesh).with_time_step(1.0, **how),
    "with_mesh": lambda mesh, exact, **how: HEAT(mesh).with_mesh(mesh, **how),
    "heat field": lambda mesh, exact, **how: HEAT(mesh).field(0, **how),
    "heat distance": lambda mesh, exact, **how: HEAT(mesh).compute_distance(0, **how),
    "heat rows": lambda mesh, exact, **how: HEAT(mesh).distance_rows(range(9), **how),
    "residuals": lambda mesh, exact, **how: HEAT(mesh).residuals(0, **how),
    "exact field": lambda mesh, exact, **how: exact.field(0, **how),
    "exact distance": lambda mesh, exact, **how: exact.compute_distance(0, **how),
    "exact rows": lambda mesh, exact, **how: exact.distance_rows(range(9), **how),
    "within": lambda mesh, exact, **how: exact.distances_within(range(9), 1.0, **how),
    "farthest": lambda mesh, exact, **how: exact.farthest_points(0, 9, **how),
    "paths": lambda mesh, exact, **how: exact.field(0, radius=0.1).paths(**how),
    "curve": lambda mesh, exact, **how: exact.curve_through([0, 3000], np.eye(3)[:2], **how),
    "closest": lambda mesh, exact, **how: taut.Closest(mesh).points(mesh.positions, **how),
    "descent": lambda mesh, exact, **how: taut.descent_paths(mesh, mesh.positions[:, 0], **how),
}
KEPT = {}


def HEAT(mesh):
    return KEPT.setdefault(id(mesh), taut.HeatSolver(mesh))


@pytest.fixture(scope="module")
def exact(elephant):
    return taut.ExactSolver(elephant)


@pytest.fixture(params=LONG_CALLS)
def long_call(request, elephant, exact):
    return lambda **how: LONG_CALLS[request.param](elephant, exact, **how)


def test_progress_ascends(long_call):
    shares = []
    long_call(progress=shares.append)
    assert shares
    assert shares == sorted(shares)
    assert 0 <= shares[0] <= shares[-1] <= 1


def test_progress_cancels_by_true(long_call):
    calls = []
    with pytest.raises(taut.Cancelled) as caught:
        long_call(progress=lambda share: calls.append(share) or True)
    assert len(calls) == 1
    assert caught.value.reason == Reason.CANCELLED


def test_what_progress_raises_comes_out(long_call):
    problem = KeyError("what")

    def tell(share):
        raise problem

    with pytest.raises(KeyError) as caught:
        long_call(progress=tell)
    assert caught.value is problem
    assert caught.value.__context__ is None or caught.value.__suppress_context__


def test_time_is_limited(long_call):
    with pytest.raises(taut.LimitReached) as caught:
        long_call(time_limit=0)
    assert caught.value.reason == Reason.TIME_LIMIT
    long_call(time_limit=1000)
    long_call(time_limit=float("inf"))


def test_a_cancelled_control_cancels(long_call):
    control = taut.Control()
    control.cancel()
    assert control.is_cancelled
    with pytest.raises(taut.Cancelled):
        long_call(control=control)


def test_a_control_watches(exact):
    control = taut.Control()
    assert control.progress == 0
    exact.field(0, control=control)
    assert control.progress > 0.5
    assert not control.is_cancelled


def test_another_thread_cancels(bunny):
    control = taut.Control()
    threading.Timer(0.1, control.cancel).start()
    with pytest.raises(taut.Cancelled):
        taut.ExactSolver(bunny).distance_rows(range(100), control=control)


def test_memory_is_limited(exact):
    with pytest.raises(taut.LimitReached) as caught:
        exact.field(0, control=taut.Control(memory_limit=0))
    assert caught.value.reason == Reason.MEMORY_LIMIT
    exact.field(0, control=taut.Control(memory_limit=1 << 30))


@pytest.mark.parametrize("limits", [{"time_limit": -1.0}, {"time_limit": float("nan")}, {"memory_limit": -1}])
def test_limits_are_not_negative(limits):
    with pytest.raises(ValueError):
        taut.Control(**limits)


def test_what_is_final_by_then(exact):
    field = exact.field(0, allow_partial=True, progress=lambda share: share > 0.3)
    interruption = field.interruption
    assert isinstance(interruption, taut.Cancelled)
    full = exact.field(0)
    assert full.interruption is None
    partial = field.distances()
    known = partial <= field.final_radius
    assert 0 < known.sum() < len(known)
    np.testing.assert_array_equal(partial[known], full.distances()[known])
    assert np.isinf(partial[~known]).all()


def test_what_progress_raises_goes_before_a_partial_result(exact):
    def tell(share):
        raise KeyError("what")

    with pytest.raises(KeyError):
        exact.field(0, allow_partial=True, progress=tell)


def test_a_control_excludes_what_it_has(exact):
    with pytest.raises(TypeError):
        exact.field(0, control=taut.Control(), time_limit=1.0)
    with pytest.raises(TypeError):
        exact.field(0, control=taut.Control(), progress=print)
    exact.field(0, progress=False)


def test_a_callback_may_use_the_library(exact):
    inner = []
    exact.field(0, progress=lambda share: inner.append(exact.field(1, radius=0.1).windows) and None)
    assert len(set(inner)) == 1


def test_a_control_that_two_threads_share(exact):
    """What the callback throws comes out on the thread that ran it; the other call is cancelled."""
    started, outcomes = threading.Barrier(2), []

    def tell(share):
        if share > 0.5:
            raise KeyError("what")

    control = taut.Control(tell)

    def work():
        started.wait()
        try:
            while True:
                exact.field(0, control=control)
        except (KeyError, taut.Cancelled) as error:
            outcomes.append(type(error))

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert set(outcomes) == {KeyError, taut.Cancelled}


def test_a_bar(exact, capsys):
    pytest.importorskip("tqdm")
    exact.distance_rows(range(50), progress=True)
    assert "%|" in capsys.readouterr().err


def test_no_bar_without_tqdm(exact, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    exact.distance_rows(range(50), progress=True)
    assert capsys.readouterr().err == ""


INTERRUPTED = """
import os, signal, sys, threading, time
import taut

mesh = taut.Mesh.read({path!r})
exact = taut.ExactSolver(mesh)
control = taut.Control()
worst = 0.0
calls = [
    lambda: exact.distance_rows(range(100)),
    lambda: exact.distance_rows(range(100), threads=1, control=control),
    lambda: exact.distance_rows(range(100), progress=lambda share: None),
    lambda: [exact.field(i, allow_partial=True) for i in range(1000)],
    lambda: [taut.HeatSolver(mesh) for i in range(1000)],
]
sent = []

def interrupt():
    time.sleep(0.2)
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)

for call in calls:
    threading.Thread(target=interrupt).start()
    try:
        call()
    except KeyboardInterrupt:
        worst = max(worst, time.perf_counter() - sent[-1])
    else:
        sys.exit("not interrupted")
assert control.is_cancelled
assert exact.compute_distance(0)[0] == 0
print(worst)
"""


def test_ctrl_c(cgal_meshes, run_python):
    told = run_python(INTERRUPTED.format(path=str(cgal_meshes / "bunny00.off")))
    assert told.returncode == 0, told.stderr
    assert told.stderr == ""
    assert float(told.stdout) < 0.5  # 0.1 s, and what a busy machine takes


def test_ctrl_c_ends_a_program(cgal_meshes, run_python):
    path = str(cgal_meshes / "bunny00.off")
    program = f"""
import os, signal, taut, threading
exact = taut.ExactSolver(taut.Mesh.read({path!r}))
threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
exact.distance_rows(range(100))
"""
    told = run_python(program)
    assert told.returncode == -signal.SIGINT
    assert told.stderr.rstrip().endswith("KeyboardInterrupt")


def test_what_any_signal_handler_raises_comes_out(exact):
    class TooLate(Exception):
        pass

    def late(number, frame):
        raise TooLate

    before = signal.signal(signal.SIGALRM, late)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with pytest.raises(TooLate):
            exact.distance_rows(np.arange(2700))
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_a_signal_that_raises_nothing_stops_nothing(exact):
    seen = []
    before = signal.signal(signal.SIGALRM, lambda number, frame: seen.append(time.perf_counter()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.01)
        exact.distance_rows(np.arange(500))
        ended = time.perf_counter()
    finally:
        signal.signal(signal.SIGALRM, before)
    assert seen[0] < ended  # while the call ran
