"""Loads and supports of a Nastran deck, FORCE, MOMENT, LOAD, SPC, SPC1, SPCADD and SPCD, and the cases they make."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from fuge.deck import Conditions, DeckCase, Dof
from fuge.formats.bulk import Card
from fuge.formats.bulk_case_control import Subcase
from fuge.formats.bulk_nodes import NodeCards, define, read_directions, read_range
from fuge.formats.text import Place, Reason, located, refusal

_FORCES = {"FORCE": (1, 2, 3), "MOMENT": (4, 5, 6)}


class _Entry(NamedTuple):
    """Values of a card at nodes, one for each direction; of a range of nodes those that exist."""

    card: str
    place: Place
    nodes: Sequence[int]
    directions: tuple[int, ...] = ()
    values: tuple[float, ...] = ()


class _Term(NamedTuple):
    """A set that is part of a sum."""

    place: Place
    set: int
    factor: float = 1.0


class _Sets:
    """Loads or supports by the numbers of their sets, and sums of sets. `command` selects them."""

    def __init__(self, command: str, what: str) -> None:
        self._command, self._what = command, what
        self._entries: dict[int, list[_Entry]] = {}
        self._sums: dict[int, list[_Term]] = {}

    def add(self, number: int, entry: _Entry) -> None:
        self._entries.setdefault(number, []).append(entry)

    def add_sum(self, number: int, terms: list[_Term]) -> None:
        define(self._sums, number, terms, "sum")

    def only(self) -> dict[str, int]:
        """The only set, or the only sum of all others, of a deck without case control; by its command."""
        places = {number: terms[0].place for number, terms in self._sums.items() if terms}
        places.update((number, entries[0].place) for number, entries in self._entries.items())
        chosen = next(iter(places), 0)
        known = {chosen, *(term.set for term in self._sums.get(chosen, []))}
        for number, place in places.items():
            if number not in known:
                raise refusal(
                    place,
                    f"the set {number} is another one than {chosen}: write the case control that selects them, with "
                    f"SUBCASE, {self._command} = and BEGIN BULK",
                )
        return {self._command: chosen} if places else {}

    def selected(self, subcase: Subcase) -> Iterator[tuple[int, float, _Entry]]:
        """What a subcase selects: number of the term, from 1, its factor, and an entry."""
        number = subcase.sets.get(self._command)
        if number is None:
            return
        terms = self._sums.get(number)
        if terms and number in self._entries:
            raise refusal(terms[0].place, f"the set {number} has {self._what} of its own and is a sum")
        if not terms and number not in self._entries:
            reason = f"SUBCASE {subcase.number or 1} selects the {self._what} {self._command} = {number}"
            raise refusal(subcase.place, f"{reason}, which the deck does not have")
        for index, term in enumerate(terms or [_Term(subcase.place, number)], 1):
            if term.set not in self._entries:
                raise refusal(term.place, f"the deck has no {self._what} of the set {term.set}")
            for entry in self._entries[term.set]:
                yield index, term.factor, entry


class LoadCards:
    """The cards of loads and supports, and the load cases that they make."""

    def __init__(self, nodes: NodeCards) -> None:
        self._nodes = nodes
        self._loads, self._supports = _Sets("LOAD", "loads"), _Sets("SPC", "supports")
        self.readers = {
            **dict.fromkeys(_FORCES, self._read_force),
            "LOAD": self._read_load_sum,
            "SPC": self._read_displacements,
            "SPCD": self._read_displacements,
            "SPC1": self._read_supports,
            "SPCADD": self._read_support_sum,
        }

    def read_unread(self, card: Card) -> None:
        """A load that no case may select."""
        number = card.whole(1, "number of the load set")
        self._loads.add(number, _Entry(f"{card.name} of the load set {number}", card.place, ()))

    def _read_force(self, card: Card) -> None:
        number, node = card.whole(1, "number of the load set"), card.whole(2, "G")
        system, factor = card.whole(3, "CID", 0, 0), card.number(4, "F", 0.0)
        components = [card.number(k, f"N{k - 4}", 0.0) for k in (5, 6, 7)]
        if system != 0:
            raise Reason(f"CID = {system}: only loads in the basic coordinate system, 0, are read")
        if factor != 0.0 and not any(components):
            raise Reason("the direction N1, N2, N3 has the length zero")
        values = tuple(factor * component for component in components)
        self._loads.add(number, _Entry(card.name, card.place, [node], _FORCES[card.name], values))

    def _read_load_sum(self, card: Card) -> None:
        number, scale = card.whole(1, "number of the load set"), card.number(2, "S", 1.0)
        terms = []
        for k in range(3, len(card.fields), 2):
            if card.has(k) or card.has(k + 1):
                factor = scale * card.number(k, "factor of a load set")
                terms.append(_Term(card.place, card.whole(k + 1, "number of a load set"), factor))
        self._loads.add_sum(number, terms)

    def _read_displacements(self, card: Card) -> None:
        number = card.whole(1, "number of the set")
        for k in (2, 5):
            if k == 2 or card.has(k):
                node, directions = card.whole(k, "G"), read_directions(card.word(k + 1))
                values = (card.number(k + 2, "D", 0.0),) * len(directions)
                sets = self._loads if card.name == "SPCD" else self._supports
                sets.add(number, _Entry(card.name, card.place, [node], directions, values))

    def _read_supports(self, card: Card) -> None:
        number, directions = card.whole(1, "number of the set"), read_directions(card.word(2))
        nodes = read_range(card, 3) if card.word(4) == "THRU" else card.wholes(3, "node")
        self._supports.add(number, _Entry(card.name, card.place, nodes, directions, (0.0,) * len(directions)))

    def _read_support_sum(self, card: Card) -> None:
        number = card.whole(1, "number of the set")
        self._supports.add_sum(number, [_Term(card.place, term) for term in card.wholes(2, "number of a set")])

    def only_sets(self) -> dict[str, int]:
        """The sets of bulk data alone, by the commands that would select them."""
        return {**self._loads.only(), **self._supports.only()}

    def supports(self, subcase: Subcase) -> Conditions:
        """The supports that a subcase selects, and the permanent ones of nodes."""
        held = Conditions()
        for number, node in self._nodes.grids.items():
            for direction in node.held:
                held.hold((number, direction), 0.0, node.place)
        for _, _, entry in self._supports.selected(subcase):
            with located(entry.place):
                values = list(self._values(entry))
                if not values:
                    raise Reason("the deck has none of the nodes that the card holds")
                for dof, value in values:
                    held.hold(dof, value, entry.place)
        return held

    def case(self, subcase: Subcase) -> DeckCase:
        """The load case of a subcase."""
        case = DeckCase(subcase.name, supports=self.supports(subcase))
        for term, factor, entry in self._loads.selected(subcase):
            with located(entry.place):
                for dof, value in self._values(entry):
                    if entry.card == "SPCD":
                        _displace(case.supports, dof, factor * value, entry.place, term)
                    elif value != 0.0:
                        case.loads.add(dof, factor * value, entry.place)
        return case

    def _values(self, entry: _Entry) -> Iterator[tuple[Dof, float]]:
        if not entry.directions:
            raise Reason(f"{entry.card} is not read: give its forces at nodes by FORCE and MOMENT")
        for node, directions in self._nodes.existing(entry.nodes, entry.directions):
            if entry.card in _FORCES:
                self._nodes.find_basic(node, "loads")
            for direction, value in zip(directions, entry.values):
                yield (node, direction), value


def _displace(supports: Conditions, dof: Dof, value: float, place: Place, step: int) -> None:
    """The displacement of an SPCD, which takes the place of that of an SPC; steps are the terms of a sum."""
    before = supports.get(dof)
    if before is None:
        raise Reason(f"node {dof[0]} is not held in direction {dof[1]} by the SPC of the subcase")
    if before.step not in (0, step):
        raise Reason(f"node {dof[0]} is displaced in direction {dof[1]} by another set of the sum, in {before.place}")
    supports.hold(dof, value, place, step)
