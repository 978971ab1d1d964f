"""The shared libraries: where they are, and their functions with the types of their arguments."""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path
from typing import Any, Callable

import numpy as np

from fuge._declarations import DECLARATIONS
from fuge._structs import STRUCTS

# Functions that are not in the core library.
_SPARSE = {"fuge_body_sparse", "fuge_bodies_solve_sparse"}

Apply = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.c_int, ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_double), ctypes.c_void_p
)
Progress = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int, ctypes.c_double, ctypes.c_int, ctypes.c_void_p)
Profile = ctypes.CFUNCTYPE(
    ctypes.c_int,
    ctypes.c_int,
    ctypes.POINTER(ctypes.c_double),
    ctypes.POINTER(ctypes.c_double),
    ctypes.POINTER(ctypes.c_double),
    ctypes.c_void_p,
)


class _Array:
    """A parameter that is an array; ctypes holds a reference to it during the call."""

    dtype: np.dtype[Any]

    @classmethod
    def from_param(cls, value: np.ndarray[Any, Any] | None) -> ctypes.c_void_p | None:
        if value is None:
            return None
        if value.dtype != cls.dtype or not (value.flags.c_contiguous or value.flags.f_contiguous):
            raise TypeError(f"expected a contiguous array of {cls.dtype}")
        return ctypes.c_void_p(value.ctypes.data)


class _Doubles(_Array):
    dtype = np.dtype(np.float64)


class _Ints(_Array):
    dtype = np.dtype(np.intc)


_TYPES: dict[str, Any] = {
    "int": ctypes.c_int,
    "double": ctypes.c_double,
    "size_t": ctypes.c_size_t,
    "void": None,
    "user": ctypes.c_void_p,
    "text": ctypes.c_char_p,
    "buffer": ctypes.c_char_p,
    "doubles": _Doubles,
    "ints": _Ints,
    "texts": ctypes.POINTER(ctypes.c_char_p),
    "arrays": ctypes.POINTER(ctypes.c_void_p),
    "fuge_apply": Apply,
    "fuge_progress": Progress,
    "fuge_smooth_profile": Profile,
    **{name: ctypes.POINTER(struct) for name, struct in STRUCTS.items()},
}


def _type(code: str) -> Any:
    if code in _TYPES:
        return _TYPES[code]
    # A handle, or the place for one.
    return ctypes.POINTER(ctypes.c_void_p) if code.endswith("*") else ctypes.c_void_p


def _declared() -> dict[str, list[str]]:
    lines = DECLARATIONS.strip().replace("\n ", " ").splitlines()
    return {name: codes.split() for name, codes in (line.split(":") for line in lines)}


_CODES = _declared()


def _file_name(name: str) -> str:
    if sys.platform == "win32":
        return f"lib{name}.dll"
    return f"lib{name}.dylib" if sys.platform == "darwin" else f"lib{name}.so"


def _path(name: str) -> Path:
    """The file of a library: in the folder FUGE_LIBRARY_DIR if that is set, else in that of the package."""
    return Path(os.environ.get("FUGE_LIBRARY_DIR") or Path(__file__).parent) / _file_name(name)


def has_sparse() -> bool:
    """Whether there is the library for sparse matrices."""
    return _path("fuge_sparse").exists()


def _load(name: str) -> ctypes.CDLL:
    path = _path(name)
    if not path.exists():
        raise ImportError(
            f"{path} does not exist: install the package with pip, or set FUGE_LIBRARY_DIR to the folder of a "
            "shared library that was built with CMake (-DBUILD_SHARED_LIBS=ON)"
        )
    return ctypes.CDLL(str(path))


_core = _load("fuge")
_functions: dict[str, Callable[..., Any]] = {}


def function(name: str) -> Callable[..., Any]:
    """The C function `name`. The interpreter lock is released while it runs."""
    found = _functions.get(name)
    if found is None:
        found = getattr(_load("fuge_sparse") if name in _SPARSE else _core, name)
        result, *parameters = (_type(code) for code in _CODES[name])
        found.restype = result
        found.argtypes = parameters
        _functions[name] = found
    return found


def version() -> str:
    """Version of the library, such as '0.1.0'."""
    return str(function("fuge_version")().decode())
