"""The exceptions, and how a failed call of the library becomes one."""

from __future__ import annotations

import ctypes
from typing import Any

from . import _native
from ._native import Element, Reason, Status, library


class Error(Exception):
    """A failure of the library; ``str(error)`` is the message for people.

    Attributes
    ----------
    status : Status
        The coarse class; each has its subclass of `Error`.
    reason : Reason
        What went wrong, finer than the status.
    element : str or None
        What kind of element is at fault: "vertex", "face", "source", "target", "line", "level" or "point".
    index : int or None
        Which one, counted from 0, a line of a file from 1.
    """

    def __init__(
        self,
        message: str,
        status: int = Status.INVALID_ARGUMENT,
        reason: int = Reason.BAD_ARGUMENT,
        element: str | None = None,
        index: int | None = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.status = status
        self.reason = reason
        self.element = element
        self.index = index

    def __str__(self) -> str:
        return self.message

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.message, self.status, self.reason, self.element, self.index)


class InvalidArgument(Error, ValueError):
    """An argument is outside its documented range."""


class InvalidMesh(Error, ValueError):
    """The mesh cannot be used: a bad index or coordinate."""


class IoError(Error, OSError):
    """A file could not be opened, read or written."""


class FormatError(Error, ValueError):
    """A file's content is not what its format asks for."""


class Unsupported(Error, NotImplementedError):
    """A valid request that this build or version does not serve."""


class NumericError(Error, ArithmeticError):
    """The computation broke down numerically."""


class Cancelled(Error):
    """The caller cancelled the work."""


class TooLarge(Error, MemoryError):
    """A size exceeds what the library can address or allocate."""


class InternalError(Error, RuntimeError):
    """A defect of the library; please report it."""


class LimitReached(Error, TimeoutError):
    """The work reached a limit of time or memory that the caller set."""


_CLASSES: dict[int, type[Error]] = {
    Status.INVALID_ARGUMENT: InvalidArgument,
    Status.INVALID_MESH: InvalidMesh,
    Status.IO: IoError,
    Status.FORMAT: FormatError,
    Status.UNSUPPORTED: Unsupported,
    Status.NUMERIC: NumericError,
    Status.CANCELLED: Cancelled,
    Status.TOO_LARGE: TooLarge,
    Status.INTERNAL: InternalError,
    Status.LIMIT_REACHED: LimitReached,
}


def _known(values: type[Status] | type[Reason], number: int) -> int:
    """The member of an enum, or the number itself where a newer library has more."""
    try:
        return values(number)
    except ValueError:
        return number


def error_of(detail: _native.taut_error, message: str) -> Error:
    """The exception that says what `detail` does."""
    has_element = detail.element != Element.NONE
    element = Element(detail.element).name.lower() if has_element else None
    return _CLASSES.get(detail.status, Error)(
        message,
        _known(Status, detail.status),
        _known(Reason, detail.reason),
        element,
        detail.index if has_element else None,
    )


def check(status: int) -> None:
    """Raise what the last call on this thread ran into, unless `status` is that of success."""
    if status == Status.OK:
        return
    detail = _native.taut_error()
    message: bytes = library.taut_last_error(ctypes.byref(detail))
    raise error_of(detail, message.decode())
