"""The shared libraries: where they are, and their functions and types as the headers declare them."""

from __future__ import annotations

import ctypes
import os
import sys
from enum import IntEnum
from pathlib import Path
from typing import Any, Callable

import numpy as np

import fuge
from fuge._headers import Headers, Member, Signature

# Where the package is: its own folder, and in an editable installation also the one with what has been built.
_FOLDERS = [Path(folder) for folder in fuge.__path__]


def _headers() -> Headers:
    """The headers in the folder of the package, where it is installed, otherwise those of the sources around it."""
    folders = [folder / "include" for folder in _FOLDERS] + [Path(__file__).parents[2] / "include"]
    for folder in folders:
        if (folder / "fuge.h").exists():
            return Headers(folder / "fuge.h")
    raise ImportError(f"there is no fuge.h in {' or '.join(map(str, folders))}: install the package with pip")


HEADERS = _headers()


class Constants(IntEnum):
    """An enumeration whose members, by ``auto()``, have the values of the constants FUGE_<member> of the headers."""

    @staticmethod
    def _generate_next_value_(name: str, start: int, count: int, last_values: list[Any]) -> int:
        return HEADERS.constants[name]


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


_NUMBERS: dict[str, Any] = {"int": ctypes.c_int, "double": ctypes.c_double}
# In structs; the caller keeps the arrays to which pointers lead.
_OF_STRUCTS: dict[str, Any] = {
    **_NUMBERS,
    "char": ctypes.c_char,
    "double*": ctypes.POINTER(ctypes.c_double),
}
# Arrays that a callback gets or fills are those of the library.
_OF_CALLBACKS: dict[str, Any] = {
    **_NUMBERS,
    "double*": ctypes.POINTER(ctypes.c_double),
    "void*": ctypes.c_void_p,
}


def _type(name: str, types: dict[str, Any]) -> Any:
    """The counterpart of a C type in `types`, whose names have neither const nor spaces."""
    key = "".join(word for word in name.split() if word != "const")
    if key not in types:
        raise ValueError(f"fuge/_library.py does not know the type {name!r} that the headers use")
    return types[key]


def _callback(signature: Signature) -> Any:
    return ctypes.CFUNCTYPE(*(_type(name, _OF_CALLBACKS) for name in (signature.result, *signature.parameters)))


def _struct(name: str, members: list[Member]) -> type[ctypes.Structure]:
    fields = []
    for member in members:
        number = _type(member.type, _OF_STRUCTS)
        fields.append((member.name, number if member.length is None else number * member.length))
    return type(name, (ctypes.Structure,), {"_fields_": fields})


CALLBACKS: dict[str, Any] = {name: _callback(signature) for name, signature in HEADERS.callbacks.items()}
STRUCTS = {name: _struct(name, members) for name, members in HEADERS.structs.items()}

_TYPES: dict[str, Any] = {
    **_NUMBERS,
    "size_t": ctypes.c_size_t,
    "void": None,
    "void*": ctypes.c_void_p,
    "char*": ctypes.c_char_p,
    "char**": ctypes.POINTER(ctypes.c_char_p),
    "int*": _Ints,
    "double*": _Doubles,
    "double**": ctypes.POINTER(ctypes.c_void_p),
    **CALLBACKS,
    **{f"{name}*": ctypes.POINTER(struct) for name, struct in STRUCTS.items()},
    **{f"{name}*": ctypes.c_void_p for name in HEADERS.handles},
    **{f"{name}**": ctypes.POINTER(ctypes.c_void_p) for name in HEADERS.handles},
}
# The type of each result and each parameter of a function, by its name in the headers.
_DECLARED = {
    name: _type(name, _TYPES)
    for name in {name for function in HEADERS.functions.values() for name in (function.result, *function.parameters)}
}


def _path(name: str) -> Path:
    """The file of a library: in the folder FUGE_LIBRARY_DIR if that is set, else in that of the package."""
    suffix = {"win32": "dll", "darwin": "dylib"}.get(sys.platform, "so")
    given = os.environ.get("FUGE_LIBRARY_DIR")
    paths = [folder / f"lib{name}.{suffix}" for folder in ([Path(given)] if given else _FOLDERS)]
    return next((path for path in paths if path.exists()), paths[0])


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
        found = getattr(_core if hasattr(_core, name) else _load("fuge_sparse"), name)
        signature = HEADERS.functions[name]
        found.restype = _DECLARED[signature.result]
        found.argtypes = [_DECLARED[parameter] for parameter in signature.parameters]
        _functions[name] = found
    return found


def struct(name: str) -> Any:
    """A new struct of the C interface, such as fuge_info, with all members zero."""
    return STRUCTS[name]()


def struct_array(name: str, count: int) -> Any:
    """`count` structs one after the other, with all members zero."""
    return (STRUCTS[name] * count)()


def version() -> str:
    """Version of the library, such as '0.1.0'; ImportError if it is not that of the headers."""
    found = str(function("fuge_version")().decode())
    if found != HEADERS.version:
        raise ImportError(f"{_path('fuge')} is of version {found}, but this package is of version {HEADERS.version}")
    return found
