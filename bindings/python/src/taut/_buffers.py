"""numpy arrays as the buffers of C, without a copy wherever C can read or write the array as it is.

C takes rows that are any number of bytes apart, of 32- or 64-bit numbers (16-bit ones as well, if unsigned), at any address. An
array that is like that is passed on as it is; any other is converted once, to `float64` or `int64`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._errors import InvalidArgument, check
from ._native import Reason, Type

Reals = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]
AnyArray = npt.NDArray[Any]

#: What nearest sources, components and sources of curves say where there is none.
none = -1

_Types = dict["np.dtype[Any]", Type]

_REALS: _Types = {np.dtype(np.float32): Type.F32, np.dtype(np.float64): Type.F64}
_INDICES: _Types = {
    np.dtype(np.uint16): Type.U16,
    np.dtype(np.uint32): Type.U32,
    np.dtype(np.uint64): Type.U64,
    np.dtype(np.int32): Type.I32,
    np.dtype(np.int64): Type.I64,
}


def reals(data: npt.ArrayLike, name: str, width: int | None = None) -> AnyArray:
    """An array of real numbers that C can read: `data` itself if it can, else a copy.

    With `width` it has rows of so many numbers, without it is one-dimensional.
    """
    array = _array(data, name)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be real numbers, not {array.dtype}")
    return _readable(_shaped(array, name, width), _REALS, np.float64)


def indices(data: npt.ArrayLike, name: str, width: int | None = None) -> AnyArray:
    """An array of indices that C can read: `data` itself if it can, else a copy. Shaped as by `reals`."""
    array = _array(data, name)
    if array.size == 0:
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    return _readable(_shaped(array, name, width), _INDICES, np.int64)


def _array(data: npt.ArrayLike, name: str) -> AnyArray:
    if isinstance(data, np.ma.MaskedArray) and np.ma.is_masked(data):
        raise InvalidArgument(f"{name} has masked elements: fill them, values at vertices with NaN")
    return np.asarray(data)


def _shaped(array: AnyArray, name: str, width: int | None) -> AnyArray:
    if width is None:
        if array.ndim != 1:
            raise InvalidArgument(f"{name} must have the shape (n,), not {array.shape}")
    elif array.size == 0 and array.ndim == 1:
        return array.reshape(0, width)
    elif array.ndim != 2 or array.shape[1] != width:
        raise InvalidArgument(f"{name} must have the shape (n, {width}), not {array.shape}")
    return array


def _readable(array: AnyArray, types: _Types, fallback: type[Any]) -> AnyArray:
    if array.dtype not in types:
        return array.astype(fallback, order="C")
    return array if _has_rows(array) else np.ascontiguousarray(array)


def _has_rows(array: AnyArray) -> bool:
    """Whether the rows are whole, apart from each other and in ascending order."""
    if array.size == 0:
        return True
    width = array.shape[1] if array.ndim == 2 else 1
    is_whole = width <= 1 or array.strides[1] == array.itemsize
    return is_whole and (array.shape[0] <= 1 or array.strides[0] >= width * array.itemsize)


def _buffer(array: AnyArray, buffer: Any, types: _Types) -> Any:
    view = buffer(
        data=array.__array_interface__["data"][0],
        count=array.shape[0],
        stride=array.strides[0] if array.shape[0] > 1 else 0,
        type=types[array.dtype],
    )
    view.array = array  # lives as long as what C sees of it
    return view


def input_reals(data: npt.ArrayLike, name: str, width: int | None = None) -> Any:
    """Real numbers as C reads them."""
    return _buffer(reals(data, name, width), _native.taut_input, _REALS)


def input_indices(data: npt.ArrayLike, name: str, width: int | None = None) -> Any:
    """Indices as C reads them."""
    return _buffer(indices(data, name, width), _native.taut_input, _INDICES)


def output(array: AnyArray) -> Any:
    """An array that C fills."""
    return _buffer(array, _native.taut_output, {**_REALS, **_INDICES})


def real_output(out: AnyArray | None, shape: tuple[int, ...]) -> AnyArray:
    """The caller's `out`, checked, or a new array of `float64`."""
    if out is None:
        return np.empty(shape)
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out must be a numpy array, not {type(out).__name__}")
    if out.dtype not in _REALS:
        raise TypeError(f"out must be float64 or float32, not {out.dtype}")
    if not out.flags.writeable:
        raise InvalidArgument("out is read-only")
    if out.shape != shape:
        small = Reason.BUFFER_TOO_SMALL
        raise InvalidArgument(f"out must have the shape {shape}, not {out.shape}", reason=small)
    if not _has_rows(out):
        raise InvalidArgument("the rows of out must be contiguous, apart from each other and in ascending order")
    return out


def frozen(array: AnyArray) -> AnyArray:
    """The array, from now on read-only."""
    array.flags.writeable = False
    return array


def filled(fill: Any, shape: tuple[int, ...], dtype: Any, *arguments: Any) -> AnyArray:
    """A new read-only array, filled by `fill`, which is given `arguments` and a buffer."""
    array = np.empty(shape, dtype)
    check(fill(*arguments, output(array)))
    return frozen(array)
