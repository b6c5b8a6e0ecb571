"""Progress, cancellation and limits of long calls, and Ctrl-C.

A call of the library runs without the interpreter lock, and consults its control about every millisecond. There Python gets
a turn: the callback tells the progress, and lets the handlers of signals run on the main thread. What either raises cancels
the call and comes out of it. Where there is no progress to tell, Python takes a turn every hundredth of a second only.
"""

from __future__ import annotations

import atexit
import ctypes
import threading
import time
from collections.abc import Generator
from typing import Any, Callable, Optional, Union

from . import _native
from ._errors import Error, check
from ._handle import Handle
from ._native import library
from ._options import counted

#: What the keyword argument ``progress`` takes: True for a bar of tqdm, or a function that is told the share that is done,
#: in [0, 1], and returns True to cancel.
Progress = Union[bool, Callable[[float], Optional[bool]]]


#: Seconds between turns for signals alone. Each waits for the interpreter, up to 5 ms beside a thread that computes in it.
_TURN = 0.01

_callback = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_double)


class _Thrown:
    """What the callback of a control threw, and on which thread."""

    error: BaseException | None = None
    thread = 0


def _turns(tell: Callable[[float], bool | None] | None, thrown: _Thrown) -> Generator[int, float, None]:
    """Answers the callback: 0 to go on, 1 to cancel, and 1 ever after. To be started by `next`.

    Handlers of signals run where a Python function begins, before it can catch what they raise. A generator waits inside
    its ``try``, so that nothing is lost.
    """
    answer = 0
    is_telling = False
    while True:
        try:
            while True:
                share = yield answer
                if tell and not answer:
                    is_telling = True
                    answer = int(bool(tell(share)))
                    is_telling = False
        except BaseException as error:
            if isinstance(error, GeneratorExit) and not is_telling:
                return
            is_telling = False
            answer = 1
            thrown.thread = threading.get_ident()
            thrown.error = error


class _Bar:
    """A bar of tqdm; nothing where that is not installed."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self._bar: Any = None
        else:
            self._bar = tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining}")

    def tell(self, share: float) -> None:
        if self._bar is not None:
            self._bar.update(share - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


class Control:
    """Watches, limits and cancels long calls, from any thread. C: ``taut_control``.

    Use a new one for each call, or one for several calls that share a limit.

    Parameters
    ----------
    progress : callable, optional
        Is told the share that is done, in [0, 1], about every millisecond, on the thread of the call. It returns True to
        cancel. What it raises cancels the call and comes out of it.
    time_limit : float, optional
        Seconds from now, after which calls end with `LimitReached`.
    memory_limit : int, optional
        Bytes that a call that computes exact distances may take beyond the mesh and what was prepared.
    """

    def __init__(
        self,
        progress: Callable[[float], bool | None] | None = None,
        time_limit: float | None = None,
        memory_limit: int | None = None,
    ) -> None:
        self._thrown = _Thrown()
        turns = _turns(progress, self._thrown)
        next(turns)
        # C calls with a second argument, which `send` has no use for and ctypes does not look at.
        self._callback = ctypes.cast(_callback(turns.send), _native.taut_callback)
        self._handle = Handle(_native.taut_control)
        check(library.taut_control_new(ctypes.byref(self._handle.pointer)))
        check(library.taut_control_set_callback(self._handle.pointer, self._callback, None))
        if progress is None:
            check(library.taut_control_set_callback_interval(self._handle.pointer, _TURN))
        if time_limit is not None:
            # To C 0 means no limit.
            check(library.taut_control_set_time_limit(self._handle.pointer, ctypes.c_double(time_limit or 1e-9)))
        if memory_limit is not None:
            limit = max(counted(memory_limit, "memory_limit"), 1)
            check(library.taut_control_set_memory_limit(self._handle.pointer, limit))

    def cancel(self) -> None:
        """Ask the calls that use this control to end with `Cancelled`, at their next check."""
        library.taut_control_cancel(self._handle.pointer)

    @property
    def is_cancelled(self) -> bool:
        """Whether `cancel` was called, or the callback cancelled or raised."""
        return bool(library.taut_control_is_cancelled(self._handle.pointer))

    @property
    def progress(self) -> float:
        """The share of the work that is done, in [0, 1]."""
        return float(library.taut_control_progress(self._handle.pointer))

    def _rethrow(self) -> None:
        """Raise what the callback threw on this thread, if it did."""
        thrown = self._thrown
        if thrown.error is not None and thrown.thread == threading.get_ident():
            error, thrown.error = thrown.error, None
            raise error from None


class watched:
    """The context of one long call: gives its control as C takes it, and raises what its callback threw.

    Signals reach Python on the main thread only: elsewhere a call that is not watched has no control.
    """

    __slots__ = ("_bar", "_control", "_is_elsewhere")

    def __init__(self, progress: Progress | None, time_limit: float | None, control: Control | None) -> None:
        self._bar: _Bar | None = None
        self._is_elsewhere = threading.current_thread() is not threading.main_thread()
        if control is not None:
            if progress or time_limit is not None:
                raise TypeError("progress and time_limit are the control's own: give them to it")
            if not isinstance(control, Control):
                raise TypeError(f"control must be a taut.Control, not {type(control).__name__}")
        elif progress or time_limit is not None or not self._is_elsewhere:
            if progress is True:
                self._bar = _Bar()
                progress = self._bar.tell
            control = Control(progress or None, time_limit)
        self._control = control

    def __enter__(self) -> Any:
        if self._control is None:
            return None
        if self._is_elsewhere:
            _ending.enter(self)
        return self._control._handle.pointer

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: Any) -> None:
        if self._bar is not None:
            self._bar.close()
        if self._control is None:
            return
        if self._is_elsewhere:
            _ending.leave(self)
        if error is None or isinstance(error, Error):
            self._control._rethrow()

    def cancel(self) -> None:
        """Cancel the call."""
        if self._control is not None:
            self._control.cancel()


class _Ending:
    """Ends the calls that daemon threads are in when the program ends.

    Python stops such a thread where it next asks for the interpreter. In a callback that is inside of the library, and
    would abort the process. So the calls are cancelled, and their threads ended, before that.
    """

    def __init__(self) -> None:
        self._calls: set[watched] = set()
        self._has_begun = False
        atexit.register(self._begin)

    def enter(self, call: watched) -> None:
        if self._has_begun:
            raise SystemExit
        self._calls.add(call)

    def leave(self, call: watched) -> None:
        self._calls.discard(call)
        if self._has_begun:
            raise SystemExit

    def _begin(self) -> None:
        self._has_begun = True
        for call in list(self._calls):
            call.cancel()
        for _ in range(1000):
            if not self._calls:
                return
            time.sleep(0.001)


_ending = _Ending()
