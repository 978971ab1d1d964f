"""Gap elements of Abaqus and CalculiX as one-way links, with the data line of their *GAP."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge.deck import DeckLink
from fuge.errors import InputError
from fuge.formats.keyword import Block, split_items
from fuge.formats.keyword_rules import GAP_TYPES
from fuge.formats.text import PathLike, Place, Reason, located, named, quoted, refusal, value
from fuge.mesh import Mesh

# Nodes whose distance is below this fraction of their largest coordinate coincide: the digits of a deck give the line
# between them no direction.
_COINCIDENT = 1e-6

_COLUMNS = 7

_Vector = NDArray[np.float64]


class Gaps:
    """Makes links of the gap elements of a mesh, and appends them to a list."""

    def __init__(self, mesh: Mesh, links: list[DeckLink]) -> None:
        self._mesh, self._links = mesh, links
        self._with_gap: set[int] = set()

    def read(self, block: Block, parameters: dict[str, str]) -> None:
        """Read a *GAP: one data line for the elements of a set."""
        name = parameters.get("ELSET", "")
        if not name:
            raise block.refuse("*GAP needs ELSET = and a name")
        try:
            elements = self._mesh.element_set(name).tolist()
        except InputError:
            raise block.refuse(f"*GAP: the element set {quoted(name)} is not defined") from None
        if len(block.lines) != 1:
            raise block.refuse(f"*GAP needs one data line, and has {len(block.lines)}")
        place = block.where(0)
        with located(place), named("*GAP"):
            gap = read_gap(split_items(block.lines[0])[0])
            self._links += [self._link(element, gap, place) for element in elements]

    def _link(self, index: int, gap: Gap, place: Place) -> DeckLink:
        mesh = self._mesh
        kind = str(mesh.element_types[index])
        name = f"{kind} {mesh.element[index]}"
        nodes = mesh.connection[mesh.first[index] : mesh.first[index + 1]]
        if kind not in GAP_TYPES:
            raise Reason(f"{name} is no gap element")
        if index in self._with_gap:
            raise Reason(f"{name} has a *GAP already")
        if nodes.size != 2:
            raise Reason(f"{name} has {nodes.size} nodes: a gap has two")
        self._with_gap.add(index)
        with named(name):
            direction, clearance = _opening(kind, mesh.position[nodes], gap)
        (a, b), (x, y, z) = mesh.node[nodes].tolist(), direction.tolist()
        return DeckLink(name, a, b, (x, y, z), clearance, compliance=gap.compliance, place=place)

    def check(self, path: PathLike) -> None:
        """Refuse gap elements without *GAP."""
        for index in np.flatnonzero(np.isin(self._mesh.element_types, GAP_TYPES)).tolist():
            if index not in self._with_gap:
                name = f"{self._mesh.element_types[index]} {self._mesh.element[index]}"
                raise refusal(path, f"{name} has no *GAP with its element set")


class Gap(NamedTuple):
    """The data line of *GAP.

    `clearance` is that of GAPUNI; of the others the largest distance of their nodes or, if it is negative, less the
    smallest one. `direction` is that of GAPUNI and the axis of GAPCYL, a unit vector, or zero if it is not given.
    """

    clearance: float
    direction: _Vector
    compliance: float


def read_gap(items: list[str]) -> Gap:
    """Clearance, three direction cosines, a column without meaning, then CalculiX's stiffness and force at infinity.

    That force only rounds the corner of the law. The fifth column is Abaqus' area, which makes a pressure of the
    force; a number there may also be a stiffness in the wrong column.
    """
    if len(items) > _COLUMNS:
        raise Reason(f"more than {_COLUMNS} columns of *GAP")
    numbers = [value(item) if item else 0.0 for item in items] + [0.0] * (_COLUMNS - len(items))
    if numbers[4] != 0.0:
        reason = "a number in the fifth column is not read: the area of Abaqus has no meaning, and the stiffness of"
        raise Reason(f"{reason} CalculiX is the sixth column")
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


def _opening(kind: str, position: _Vector, gap: Gap) -> tuple[_Vector, float]:
    """Direction and gap of a link between two positions; of GAPCYL and GAPSPHER those for small displacements."""
    given = gap.direction.any()
    if kind == "GAPUNI" and given:
        return gap.direction, gap.clearance
    if kind == "GAPCYL" and not given:
        raise Reason("the direction cosines of its axis are missing")
    direction, length = _between(position, gap.direction if kind == "GAPCYL" else np.zeros(3))
    if length == 0.0:
        reason = "its nodes coincide, or are on one line along its axis, so that it has no direction"
        raise Reason(f"{reason}: use GAPUNI with direction cosines")
    if kind == "GAPUNI":
        return direction, gap.clearance
    if gap.clearance >= 0.0:
        return -direction, gap.clearance - length
    return direction, length + gap.clearance


def _between(position: _Vector, axis: _Vector) -> tuple[_Vector, float]:
    """Unit vector and distance from node to node across an axis; the distance is 0 if it may be rounding."""
    largest = np.abs(position).max()
    # A power of two, which neither rounds nor overflows.
    scale = math.ldexp(1.0, math.frexp(largest)[1] - 1)
    scaled = position / scale
    distance = scaled[1] - scaled[0]
    distance = distance - (distance @ axis) * axis
    length = math.hypot(*distance)
    if length * scale <= _COINCIDENT * largest:
        return distance, 0.0
    return distance / length, length * scale
