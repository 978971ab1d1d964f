"""Messages of the library in Python's words: gap[2, 3] for gap(13) on a grid, 'mean' for FUGE_MEAN, set_gap for
fuge_set_gap."""

from __future__ import annotations

import re
from typing import Mapping

import numpy as np

from fuge._words import WORDS

Shapes = Mapping[str, "tuple[int, ...]"]
"""Shapes of arrays whose indices differ in Python, by their names in messages; `point` is that of all points."""

_PATTERN = re.compile(
    r'"[^"]*"'
    r"|\bmode (?P<mode>\d+) at point \((?P<row>\d+)\)"
    r"|\b(?P<before>point|the first is) (?P<point>\d+)\b"
    r"|\b(?P<name>[a-z]\w*)\((?P<index>\d+)(?:, ?(?P<second>\d+))?\)"
    r"|\bFUGE_(?P<constant>[A-Z_]*[A-Z]\d*)"
    r"|\bfuge_(?P<function>\w+)"
)

# Prefixes of functions that Python's methods do not have.
_HANDLE = re.compile("(?:operator|bodies|body|pairs|links)_(?=.)")

_ARRAYS = {"f": "force", "u": "displacement"}
# What the library calls the columns of points.
_COLUMNS = {"px": 0, "pr": 0, "py": 1, "pz": 2}
_FUNCTIONS = {
    "operator_dense": "DenseOperator",
    "operator_callback": "CallbackOperator",
    "operator_halfplane": "HalfplaneOperator",
    "operator_halfspace": "HalfspaceOperator",
    "operator_layered_halfplane": "LayeredHalfplaneOperator",
    "operator_layered_halfspace": "LayeredHalfspaceOperator",
    "solve": "solve",
    "condense": "condense",
    "follow_path": "follow_path",
    "solve_cases": "solve_cases",
    "join_bodies": "join",
}


def in_python(message: str, shapes: Shapes) -> str:
    """The message with Python's indices, for arrays of these shapes, and with the names and words of this package.

    Quoted text stays as it is.
    """
    return _PATTERN.sub(lambda match: _replaced(match, shapes), message)


def _replaced(match: re.Match[str], shapes: Shapes) -> str:
    found = match.groupdict()
    if found["mode"]:
        return f"modes[{_places('point', found['row'], shapes)}, {found['mode']}]"
    if found["point"]:
        place = _places("point", found["point"], shapes)
        return f"{found['before']} [{place}]" if "," in place else match[0]
    if found["name"]:
        return _element(found["name"], found["index"], found["second"], shapes)
    if found["constant"]:
        word = WORDS.get(found["constant"])
        return match[0] if word is None else repr(word)
    if found["function"]:
        return _function(found["function"])
    return match[0]


def _element(name: str, index: str, second: str | None, shapes: Shapes) -> str:
    """An element of an array; two indices come in Fortran's order, which Python reverses for arrays with a shape."""
    if name in _COLUMNS and "points" in shapes:
        return f"points[{_places('points', str(3 * int(index) + _COLUMNS[name]), shapes)}]"
    if second is None:
        place = _places(name, index, shapes)
    else:
        place = f"{second}, {index}" if name in shapes else f"{index}, {second}"
    return f"{_ARRAYS.get(name, name)}[{place}]"


def _places(name: str, index: str, shapes: Shapes) -> str:
    shape = shapes.get(name, ())
    if len(shape) < 2 or int(index) >= np.prod(shape):
        return index
    return ", ".join(str(k) for k in np.unravel_index(int(index), shape))


def _function(name: str) -> str:
    """The class, method or function that calls a function of the library."""
    if name in _FUNCTIONS:
        return _FUNCTIONS[name]
    method = _HANDLE.sub("", name, count=1)
    return method if method != name or name.startswith(("set_", "get_")) else f"fuge.{name}"
