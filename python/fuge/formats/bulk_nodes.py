"""Nodes and scalar points of a Nastran deck: GRID and SPOINT."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from fuge.formats.bulk import Card
from fuge.formats.text import Place, Reason, quoted

_T = TypeVar("_T")

# Of one card with THRU: a short deck could name millions.
_MOST_POINTS = 100000


@dataclass(frozen=True)
class Node:
    """A GRID: coordinate systems of its position and of its displacements, its position, its permanent supports."""

    place: Place = field(compare=False)
    position_system: int
    system: int
    position: tuple[float, ...]
    held: tuple[int, ...]


class NodeCards:
    """The cards of nodes and scalar points."""

    def __init__(self) -> None:
        self.grids: dict[int, Node] = {}
        self._points: list[range] = []
        self.readers = {"GRID": self._read_grid, "GRDSET": self._read_defaults, "SPOINT": self._read_points}

    def _read_grid(self, card: Card) -> None:
        number = card.whole(1, "number of the node")
        position = tuple(card.number(k, f"X{k - 2}", 0.0) for k in (3, 4, 5))
        systems = card.whole(2, "CP", 0, 0), card.whole(6, "CD", -1, 0)
        held = read_directions(card.word(7)) if card.has(7) else ()
        define(self.grids, number, Node(card.place, *systems, position, held), "node")

    def _read_defaults(self, card: Card) -> None:
        if card.has(2) or card.has(6) or card.has(7):
            raise Reason("defaults of CP, CD and PS are not read: write them on each GRID")

    def _read_points(self, card: Card) -> None:
        if card.word(2) == "THRU":
            self._points.append(read_range(card, 1))
        else:
            self._points += [range(point, point + 1) for point in card.wholes(1, "scalar point")]

    def existing(self, nodes: Sequence[int], directions: tuple[int, ...]) -> Iterator[tuple[int, tuple[int, ...]]]:
        """The nodes of a list, all of which must exist, or those of a range that exist, with their directions.

        Scalar points have the direction 0. Reason if a range has too many of them.
        """
        if directions != (0,):
            if not isinstance(nodes, range):
                for node in nodes:
                    self.find(node)
            found = (grid for grid in self.grids if grid in nodes) if len(nodes) > len(self.grids) else nodes
            yield from ((node, directions) for node in found if node in self.grids)
        elif not isinstance(nodes, range):
            yield from ((point, directions) for point in nodes)
        if isinstance(nodes, range) and directions in ((0,), (1,)):
            overlaps = [range(max(p.start, nodes.start), min(p.stop, nodes.stop)) for p in self._points]
            if sum(map(len, overlaps)) > _MOST_POINTS:
                raise Reason(f"THRU names more than {_MOST_POINTS} scalar points")
            yield from ((point, (0,)) for overlap in overlaps for point in overlap)

    def find(self, number: int) -> Node:
        """A node; Reason if the deck does not have it."""
        if number not in self.grids:
            raise Reason(f"the deck has no GRID {number}")
        return self.grids[number]

    def find_basic(self, number: int, what: str) -> Node:
        """The same, but Reason also if its displacements are not in the basic system, in which `what` is read."""
        node = self.find(number)
        if node.system != 0:
            raise Reason(
                f"GRID {number} has the displacement system CD = {node.system}: {what} are read at nodes of the basic "
                "system, 0"
            )
        return node


def define(table: dict[int, _T], number: int, entry: _T, what: str) -> None:
    """Enter what a card defines; Reason if its number has another meaning already."""
    if table.setdefault(number, entry) != entry:
        raise Reason(f"the {what} is defined a second time")


def read_directions(word: str) -> tuple[int, ...]:
    """Directions, such as 123; blank and 0: of a scalar point."""
    if word in ("", "0"):
        return (0,)
    if not set(word) <= set("123456"):
        raise Reason(f"{quoted(word)} is no list of directions 1 to 6, such as 123")
    return tuple(map(int, word))


def read_range(card: Card, k: int) -> range:
    """The range from field k on, which is followed by THRU, its end, and nothing else."""
    first = card.whole(k, "begin of THRU")
    last = card.whole(k + 2, "end of THRU", first)
    for behind in card.filled(k + 3):
        raise Reason(f"{quoted(card.word(behind))} stands behind the end of THRU: write another card")
    return range(first, last + 1)
