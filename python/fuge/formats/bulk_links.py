"""One-way elements of a Nastran deck: gaps, CGAP with PGAP, and springs with a table, CBUSH1D, PBUSH1D and TABLED1."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge.deck import DeckLink
from fuge.formats.bulk import LINE_FIELDS, Card
from fuge.formats.bulk_nodes import NodeCards, define
from fuge.formats.force_table import find_one_way_law
from fuge.formats.text import Place, Reason, located, named

_Vector = NDArray[np.float64]
# Fraction of the stiffness of a closed gap that may remain in an open one: it stands for none.
_OPEN_STIFFNESS = 1e-6

# Nodes whose distance is below this fraction of their largest coordinate coincide: the digits of a deck give the line
# between them no direction.
_COINCIDENT = 1e-6

# CID of an element: blank, and FLIP.
_NO_SYSTEM, _FLIPPED = -1, -2


class _Element(NamedTuple):
    place: Place
    property: int
    node_a: int
    node_b: int
    system: int


class _GapProperty(NamedTuple):
    # None: the distance of the nodes.
    gap: float | None
    compliance: float


class _System(NamedTuple):
    reference: int
    points: tuple[float, ...]


class LinkCards:
    """The cards of one-way elements, and their links between nodes."""

    def __init__(self, nodes: NodeCards) -> None:
        self._nodes = nodes
        self._elements: dict[str, dict[int, _Element]] = {"CGAP": {}, "CBUSH1D": {}}
        self._gap_properties: dict[int, _GapProperty] = {}
        # Number of the table of each property; None: the spring is linear.
        self._spring_properties: dict[int, int | None] = {}
        self._tables: dict[int, tuple[tuple[float, float], ...]] = {}
        self._systems: dict[int, _System] = {}
        self.readers = {
            **dict.fromkeys(self._elements, self._read_element),
            "PGAP": self._read_gap_property,
            "PBUSH1D": self._read_spring_property,
            "TABLED1": self._read_table,
            "CORD2R": self._read_system,
        }

    def _read_element(self, card: Card) -> None:
        is_gap = card.name == "CGAP"
        number = card.whole(1, "number of the element")
        property, a = card.whole(2, "PID", default=number), card.whole(3, "GA")
        b = card.whole(4, "GB") if is_gap else card.whole(4, "GB", 0, 0)
        field = 8 if is_gap else 5
        system = _FLIPPED if is_gap and card.word(8) == "FLIP" else card.whole(field, "CID", 0, _NO_SYSTEM)
        if a == b:
            raise Reason("GA and GB are the same node")
        define(self._elements[card.name], number, _Element(card.place, property, a, b, system), "element")

    def _read_gap_property(self, card: Card) -> None:
        """Friction, preload and the stiffness of an open gap are refused; what adjusts penalties has no meaning."""
        number = card.whole(1, "number of the property")
        gap = None if card.word(2) == "AUTO" else card.number(2, "U0", 0.0)
        closed = 0.0 if card.word(4) in ("AUTO", "SOFT", "HARD") else card.number(4, "KA", 0.0)
        if card.number(3, "F0", 0.0) != 0.0:
            raise Reason("the preload F0 is not read: an initial interference, U0 = -F0/KA, has the same force")
        if closed < 0.0:
            raise Reason("KA is negative: a stiffness is needed, or a blank field for a rigid gap")
        if abs(card.number(5, "KB", 0.0)) > _OPEN_STIFFNESS * closed:
            raise Reason(
                f"KB, the stiffness of the open gap, is above {_OPEN_STIFFNESS:g} KA: make it a spring of its own, so "
                "that it is in the stiffness matrix"
            )
        # A closed gap without friction slides, whatever KT is.
        if card.word(6) != "AUTO":
            card.number(6, "KT", 0.0)
        for k, name in [(7, "MU1"), (8, "MU2")]:
            if card.word(k) in ("STICK", "FREEZE") or card.number(k, name, 0.0) != 0.0:
                raise Reason(f"{name} is not zero: fuge has no friction, a closed gap slides freely")
        define(self._gap_properties, number, _GapProperty(gap, 1.0 / closed if closed else 0.0), "property")

    def _read_spring_property(self, card: Card) -> None:
        """Each continuation begins with the name of what it gives."""
        number = card.whole(1, "number of the property")
        table = None
        for k in range(LINE_FIELDS + 1, len(card.fields) + 1, LINE_FIELDS):
            what, how = card.word(k), card.word(k + 1)
            if what == "DAMPER" or what == how == "":
                continue
            if what != "SPRING" or how == "EQUAT":
                raise Reason(
                    f"{what} {how} is not read: the force of a one-way spring is given by SPRING, TABLE and a TABLED1"
                )
            table = card.whole(k + 2 if how == "TABLE" else k + 1, "number of the table")
        define(self._spring_properties, number, table, "property")

    def _read_table(self, card: Card) -> None:
        number = card.whole(1, "number of the table")
        if "LOG" in (card.word(2), card.word(3)):
            raise Reason("a logarithmic axis is not read")
        if card.word(4) not in ("", "0"):
            raise Reason(f"field 4 is {card.word(4)}: tables go on as their last lines beyond their ends, with 0 there")
        points = []
        for k in range(LINE_FIELDS + 1, len(card.fields), 2):
            words = (card.word(k), card.word(k + 1))
            if "ENDT" in words:
                break
            if "SKIP" not in words and words != ("", ""):
                points.append((card.number(k, "x"), card.number(k + 1, "y")))
        define(self._tables, number, tuple(points), "table")

    def _read_system(self, card: Card) -> None:
        number = card.whole(1, "number of the system")
        points = tuple(card.number(k, "coordinate", 0.0) for k in range(3, 12))
        define(self._systems, number, _System(card.whole(2, "RID", 0, 0), points), "coordinate system")

    def links(self) -> Iterator[DeckLink]:
        """The links of all gaps and one-way springs; linear springs are part of the stiffness matrix."""
        for card, elements in self._elements.items():
            for number, element in elements.items():
                name = f"{card} {number}"
                with located(element.place), named(name):
                    link = self._gap(name, element) if card == "CGAP" else self._spring(name, element)
                if link is not None:
                    yield link

    def _gap(self, name: str, element: _Element) -> DeckLink:
        property = self._gap_properties.get(element.property)
        if property is None:
            raise Reason(f"the deck has no PGAP {element.property}")
        position = self._positions(element, element.system < 0 or property.gap is None)
        direction = self._direction(element.system, position)
        gap = property.gap
        if gap is None:
            gap = abs(float(direction @ (position[1] - position[0])))
        return _link(name, element, direction, gap, property.compliance)

    def _spring(self, name: str, element: _Element) -> DeckLink | None:
        if element.property not in self._spring_properties:
            raise Reason(f"the deck has no PBUSH1D {element.property}")
        table = self._spring_properties[element.property]
        if table is None:
            return None
        position = self._positions(element, element.system < 0)
        if not self._tables.get(table):
            raise Reason(f"the deck has no TABLED1 {table}")
        with named(f"TABLED1 {table}"):
            law = find_one_way_law(*np.array(self._tables[table]).T)
        if element.node_b == 0 and element.system == _NO_SYSTEM:
            raise Reason("a spring to the ground needs CID, whose x axis it follows")
        direction = self._direction(element.system, position)
        return _link(name, element, -direction if law.tension else direction, law.gap, law.compliance, law.limit)

    def _positions(self, element: _Element, needed: bool) -> _Vector:
        """Positions of nodes a and b, shape (2, 3), in the basic system where they are `needed`; the ground's is 0."""
        position = np.zeros((2, 3))
        for i, number in enumerate((element.node_a, element.node_b)):
            if number == 0:
                continue
            node = self._nodes.find_basic(number, "one-way elements")
            if node.position_system != 0 and needed:
                raise Reason(
                    f"GRID {number} has the coordinate system CP = {node.position_system}: positions are read in the "
                    "basic system, 0"
                )
            position[i] = node.position
        return position

    def _direction(self, system: int, position: _Vector) -> _Vector:
        """The direction of an element from node a to b: the x axis of its coordinate system if it names one."""
        if system >= 0:
            return self._axis(system)
        try:
            direction = _between(*position)
        except Reason as reason:
            raise Reason(f"{reason}: CID must name the coordinate system whose x axis it follows") from None
        return -direction if system == _FLIPPED else direction

    def _axis(self, number: int) -> _Vector:
        """The x axis of a coordinate system, of which the basic one is 0."""
        if number == 0:
            return np.array([1.0, 0.0, 0.0])
        if number not in self._systems:
            raise Reason(f"CID = {number} is no CORD2R of the deck: other coordinate systems are not read")
        system = self._systems[number]
        where = f"the coordinate system CID = {number}"
        if system.reference != 0:
            raise Reason(f"{where} has another reference system than 0, which is not read")
        a, b, c = np.array(system.points).reshape(3, 3)
        with named(where):
            z, axis = _between(a, b), _between(a, c)
            axis = axis - (axis @ z) * z
            length = float(np.linalg.norm(axis))
            if not length > _COINCIDENT:
                raise Reason("its three points are on one line")
            return axis / length


def _link(
    name: str, element: _Element, direction: _Vector, gap: float, compliance: float, limit: float = math.inf
) -> DeckLink:
    x, y, z = direction.tolist()
    a, b = element.node_a, element.node_b
    return DeckLink(name, a, b, (x, y, z), gap, math.inf, compliance, limit, element.place)


def _between(a: _Vector, b: _Vector) -> _Vector:
    """The unit vector from a to b; Reason if they coincide."""
    largest = max(np.abs(a).max(), np.abs(b).max())
    direction = b / largest - a / largest if largest > 0.0 else np.zeros(3)
    length = float(np.linalg.norm(direction))
    if not length > _COINCIDENT:
        raise Reason("its nodes coincide, so that it has no direction")
    return np.asarray(direction / length)
