"""Arguments: type, shape and memory order are checked here, values by the library."""

from __future__ import annotations

import ctypes
import operator
from typing import Any, Collection, Mapping, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge.errors import Status, error

Doubles = NDArray[np.float64]
Ints = NDArray[np.intc]

_LARGEST = int(np.iinfo(np.intc).max)


def number(name: str, value: Any) -> float:
    """A real number."""
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        return float(array(name, value) if isinstance(value, np.ma.MaskedArray) else value)
    except TypeError:
        raise TypeError(f"{name} must be a real number, not {type(value).__name__}") from None


def modulus(value: Any) -> float:
    """The combined modulus e_star of two half-spaces; layers have more than that."""
    if hasattr(value, "e_star"):
        raise TypeError(
            f"e_star must be a real number, not {type(value).__name__}: of layers take the methods halfplane_matrix, "
            "halfspace_matrix and ring_matrix, or LayeredHalfplaneOperator and LayeredHalfspaceOperator"
        )
    return number("e_star", value)


def optional_number(name: str, value: Any) -> Doubles | None:
    """A number, or None, for a parameter that may be NULL."""
    return None if value is None else np.array([number(name, value)])


def integer(name: str, value: Any) -> int:
    """An integer that fits into a C int."""
    try:
        found = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer, not {type(value).__name__}") from None
    if not -_LARGEST <= found <= _LARGEST:
        raise error(Status.ERR_SIZE, f"{name} is {found}, beyond the range of an int")
    return found


Shape = Tuple[Union[int, str, None], ...]
"""A shape as it has to be, in which None and names such as 'ny' stand for any number."""


def _described(shape: Shape) -> str:
    return "(" + ", ".join("any" if k is None else str(k) for k in shape) + ("," if len(shape) == 1 else "") + ")"


def _fits(found: tuple[int, ...], wanted: Shape) -> bool:
    return len(found) == len(wanted) and all(not isinstance(w, int) or f == w for f, w in zip(found, wanted))


def check_shape(name: str, found: tuple[int, ...], *wanted: Shape) -> None:
    """Refuse a shape that is none of those `wanted`."""
    if not any(_fits(found, shape) for shape in wanted):
        shapes = " or ".join(dict.fromkeys(_described(shape) for shape in wanted))
        raise error(Status.ERR_SIZE, f"{name} has the shape {_described(found)}, but must have {shapes}")


def _is_masked(value: Any) -> bool:
    if isinstance(value, (list, tuple)):
        return any(map(_is_masked, value))
    return isinstance(value, np.ma.MaskedArray) and bool(np.any(value.mask))


def array(name: str, value: ArrayLike) -> NDArray[Any]:
    """An array of any type; refused if elements are masked, because numpy would use their values without a warning."""
    if _is_masked(value):
        raise error(
            Status.ERR_NOT_FINITE,
            f"{name} has masked elements, which are no numbers: replace them (numpy.ma.filled) or leave them out",
        )
    if hasattr(value, "toarray"):
        raise TypeError(f"{name} is a sparse matrix, but must be an array of all numbers: pass {name}.toarray()")
    return np.asarray(value)


def _real(name: str, value: ArrayLike) -> NDArray[Any]:
    found = array(name, value)
    if found.dtype.kind not in "iuf":
        raise TypeError(f"{name} must hold real numbers, not {found.dtype}")
    return found


def doubles(name: str, value: ArrayLike, *shapes: Shape) -> Doubles:
    """An array of doubles in C order; the caller's own memory if it is one. No shapes: any shape."""
    found = _real(name, value)
    if shapes:
        check_shape(name, found.shape, *shapes)
    # ascontiguousarray makes a scalar an array of one.
    return np.ascontiguousarray(found, dtype=np.float64).reshape(found.shape)


def vector(name: str, value: ArrayLike, n: int | None = None) -> Doubles:
    """n doubles, or any number of them."""
    return doubles(name, value, (n,))


def spread(name: str, value: ArrayLike, n: int) -> Doubles:
    """n doubles; a single number is repeated n times."""
    found = _real(name, value)
    if found.ndim == 0:
        return np.full(n, float(found))
    return vector(name, found, n)


def columns(name: str, value: ArrayLike, *shapes: Shape) -> Doubles:
    """An array of doubles in Fortran's order."""
    found = _real(name, value)
    check_shape(name, found.shape, *shapes)
    return np.asfortranarray(found, dtype=np.float64)


def symmetric(name: str, value: ArrayLike) -> Doubles:
    """A square matrix in either memory order, because the transpose of a symmetric matrix is the same matrix."""
    found = _real(name, value)
    check_shape(name, found.shape, (None, None))
    if found.shape[0] != found.shape[1]:
        raise error(Status.ERR_SIZE, f"{name} has the shape {_described(found.shape)}, but must be square")
    if found.flags.f_contiguous:
        return np.asfortranarray(found, dtype=np.float64)
    return np.ascontiguousarray(found, dtype=np.float64)


def integers(name: str, value: ArrayLike, *shapes: Shape) -> Ints:
    """An array of C ints in C order."""
    found = array(name, value)
    if found.size == 0 and found.dtype.kind == "f":
        found = found.astype(np.intc)
    if found.dtype.kind not in "iu":
        raise TypeError(f"{name} must hold integers, not {found.dtype}")
    if shapes:
        check_shape(name, found.shape, *shapes)
    if found.dtype != np.intc and found.size > 0 and (found.max() > _LARGEST or found.min() < -_LARGEST):
        raise error(Status.ERR_SIZE, f"{name} has numbers beyond the range of an int")
    return np.ascontiguousarray(found, dtype=np.intc).reshape(found.shape)


def flags(name: str, value: ArrayLike, *shapes: Shape) -> Ints:
    """Booleans as C ints. No shapes: any shape."""
    found = array(name, value)
    if found.dtype.kind != "b":
        raise TypeError(f"{name} must hold booleans, not {found.dtype}")
    if shapes:
        check_shape(name, found.shape, *shapes)
    return np.ascontiguousarray(found, dtype=np.intc)


def flag(name: str, value: Any) -> int:
    """One boolean as a C int."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} must be True or False, not {value!r}")
    return int(value)


def spread_flags(name: str, value: ArrayLike, shape: tuple[int, ...]) -> Ints:
    """Booleans, or one for all, broadcast to a shape."""
    found = flags(name, value).reshape(np.shape(value))
    try:
        return np.ascontiguousarray(np.broadcast_to(found, shape))
    except ValueError:
        raise error(Status.ERR_SIZE, f"{name} has the shape {found.shape}, but must fit {shape}") from None


def choice(name: str, value: Any, values: Mapping[str, int], status: Status = Status.ERR_OPTION) -> int:
    """The value of a word, or an error that lists the words."""
    if isinstance(value, str) and value in values:
        return values[value]
    raise error(status, f"{name} is {value!r}, but must be one of " + ", ".join(repr(word) for word in values))


def texts(words: Collection[str]) -> Any:
    """A C array of strings."""
    return (ctypes.c_char_p * len(words))(*(word.encode(errors="surrogateescape") for word in words))


def addresses(arrays: Sequence[Doubles]) -> Any:
    """A C array of the addresses of arrays, which the caller has to keep."""
    return (ctypes.c_void_p * len(arrays))(*(array.ctypes.data for array in arrays))


def points(*named: tuple[str, ArrayLike]) -> tuple[tuple[int, ...], list[Doubles]]:
    """Coordinates that are broadcast against each other: their common shape, and a flat array of each."""
    found = [_real(name, value) for name, value in named]
    try:
        shape = np.broadcast_shapes(*(array.shape for array in found))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for (name, _), array in zip(named, found))
        raise error(Status.ERR_SIZE, f"the shapes of coordinates do not fit together: {shapes}") from None
    flat = [np.ascontiguousarray(np.broadcast_to(array, shape), dtype=np.float64).reshape(-1) for array in found]
    return shape, flat
