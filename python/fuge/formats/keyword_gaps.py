"""Gap elements of Abaqus and CalculiX as one-way links, with the data line of their *GAP."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge.deck import DeckLink
from fuge.formats.keyword import split_items
from fuge.formats.text import Place, Reason, value

GAP_TYPES = ("GAPUNI", "GAPCYL", "GAPSPHER")

# Nodes whose distance is below this fraction of their largest coordinate coincide: the digits of a deck give the line
# between them no direction.
_COINCIDENT = 1e-6

_COLUMNS = 7

_Vector = NDArray[np.float64]


class Gap(NamedTuple):
    """The data line of *GAP.

    `clearance` is that of GAPUNI; of the others the largest distance of their nodes or, if it is negative, less the
    smallest one. `direction` is that of GAPUNI and the axis of GAPCYL, a unit vector, or zero if it is not given.
    """

    clearance: float
    direction: _Vector
    compliance: float


def read_gap(line: str) -> Gap:
    """Clearance, three direction cosines, a column without meaning, then CalculiX's stiffness and force at infinity.

    That force only rounds the corner of the law. The fifth column is Abaqus' area, which makes a pressure of the
    force; a number there may also be a stiffness in the wrong column.

    Raises
    ------
    Reason
        The line is no data line of *GAP, or has a number in its fifth column.
    """
    items, _ = split_items(line)
    if len(items) > _COLUMNS:
        raise Reason(f"more than {_COLUMNS} columns of *GAP")
    numbers = [value(item) if item else 0.0 for item in items] + [0.0] * (_COLUMNS - len(items))
    if numbers[4] != 0.0:
        raise Reason(
            "a number in the fifth column is not read: the area of Abaqus has no meaning here, and the stiffness of "
            "CalculiX is the sixth column"
        )
    stiffness = numbers[5]
    if stiffness < 0.0:
        raise Reason("the stiffness is negative")
    compliance = 1.0 / stiffness if stiffness else 0.0
    if math.isinf(compliance):
        raise Reason("the stiffness is too small")
    direction = np.array(numbers[1:4])
    if direction.any():
        direction /= np.abs(direction).max()
        direction /= math.hypot(*direction)
    return Gap(numbers[0], direction, compliance)


def gap_link(kind: str, element: int, nodes: tuple[int, int], position: _Vector, gap: Gap, place: Place) -> DeckLink:
    """The link of a gap element, that of GAPCYL and GAPSPHER for small displacements.

    Parameters
    ----------
    kind : str
        One of GAP_TYPES.
    element, nodes : int, (int, int)
        Their numbers.
    position : ndarray, shape (2, 3)
        Of the nodes; length.
    gap : Gap
    place : Place
        Of the data line.

    Raises
    ------
    Reason
        The element has no direction.
    """
    direction, clearance = _uniaxial(position, gap) if kind == "GAPUNI" else _round(kind, position, gap)
    x, y, z = direction.tolist()
    return DeckLink(f"{kind} {element}", *nodes, (x, y, z), gap=clearance, compliance=gap.compliance, place=place)


def _uniaxial(position: _Vector, gap: Gap) -> tuple[_Vector, float]:
    if gap.direction.any():
        return gap.direction, gap.clearance
    direction, length = _between(position, gap.direction)
    if length == 0.0:
        raise Reason("its nodes coincide, so that it has no direction: give its direction cosines")
    return direction, gap.clearance


def _round(kind: str, position: _Vector, gap: Gap) -> tuple[_Vector, float]:
    """A tube or a ball in another one with a clearance from 0 on, else tubes or balls beside each other."""
    axis = gap.direction if kind == "GAPCYL" else np.zeros(3)
    if kind == "GAPCYL" and not axis.any():
        raise Reason("the direction cosines of its axis are missing")
    direction, length = _between(position, axis)
    if length == 0.0:
        raise Reason(
            "its nodes coincide, or are on one line along its axis, so that it has no direction at first: use GAPUNI"
        )
    if gap.clearance >= 0.0:
        return -direction, gap.clearance - length
    return direction, length + gap.clearance


def _between(position: _Vector, axis: _Vector) -> tuple[_Vector, float]:
    """Unit vector and distance from node to node across an axis; zero if what is left may be rounding."""
    largest = float(np.abs(position).max())
    scaled = position / (largest or 1.0)
    distance = scaled[1] - scaled[0]
    distance = distance - (distance @ axis) * axis
    length = math.hypot(*distance)
    if length <= _COINCIDENT:
        return np.zeros(3), 0.0
    return distance / length, length * largest
