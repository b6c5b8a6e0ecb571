"""Handles of C that free themselves, and the calls that make them."""

from __future__ import annotations

import ctypes
from typing import Any, TypeVar

from . import _native
from ._errors import check

Self = TypeVar("Self", bound="Owner")


class Handle:
    """A pointer that C fills, freed with this object.

    It is there before the call that fills it, so that no interruption can come between the two.
    """

    __slots__ = ("_free", "pointer")

    def __init__(self, kind: type[ctypes.Structure]) -> None:
        # Kept here: at the end of the program modules may be gone before their objects.
        self._free = getattr(_native.library, kind.__name__ + "_free")
        self.pointer = ctypes.POINTER(kind)()

    def __del__(self) -> None:
        if hasattr(self, "pointer"):  # else Ctrl-C came while it was made
            self._free(self.pointer)


class Owner:
    """A class that is a handle of C. Handles never change, so a copy is the object itself."""

    _kind: type[ctypes.Structure]
    _handle: Handle

    @property
    def _pointer(self) -> Any:
        return self._handle.pointer

    def __copy__(self: Self) -> Self:
        return self

    def __deepcopy__(self: Self, memo: dict[int, Any]) -> Self:
        return self

    def __reduce__(self) -> Any:
        raise TypeError(f"a {type(self).__name__} does not pickle: pickle what it was made of, or what it tells")


def made(kind: type[ctypes.Structure], make: Any, *arguments: Any) -> Handle:
    """The handle that `make` makes of `arguments`, by its last parameter."""
    handle = Handle(kind)
    check(make(*arguments, ctypes.byref(handle.pointer)))
    return handle
