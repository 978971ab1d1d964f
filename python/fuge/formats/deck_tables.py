"""Tables of links, of supports and of load cases, for decks that no program has written."""

from __future__ import annotations

import math
from collections.abc import Sequence

from fuge.deck import Conditions, Deck, DeckCase, DeckLink
from fuge.formats.tables import begins_with_word, check_unique, named_rows, rows
from fuge.formats.text import PathLike, Place, Reason, label, located, named, quoted, refusal, value

_LINK_COLUMNS = ("node_a", "node_b", "x", "y", "z", "gap", "play", "stiffness", "limit", "name")
_SUPPORT_COLUMNS = ("node", "directions", "displacement")

# Directions by letters and numbers.
_DIRECTIONS = {**dict(zip("xyz", (1, 2, 3))), **{str(k): k for k in range(1, 7)}}
_LARGEST_DIRECTION = 9999


def read_links(deck: Deck, path: PathLike) -> None:
    """Add the links of a table to a deck; :meth:`Deck.read_links` describes it."""
    links: list[DeckLink] = []
    for place, cells in named_rows(path, _LINK_COLUMNS, {}):
        with located(place):
            links.append(_link(cells, f"link {len(links) + 1}", place))
    if not links:
        raise refusal(path, "there is no link: lines node_a, node_b, x, y, z, .. are needed")
    deck._links += links
    deck.paths.append(place.path)


def _link(cells: dict[str, str], name: str, place: Place) -> DeckLink:
    node_a, node_b = (label(cells.get(column, ""), column, 0) for column in _LINK_COLUMNS[:2])
    x, y, z = (_number(cells, column) for column in "xyz")
    gap, stiffness = _number(cells, "gap", "0"), _number(cells, "stiffness", "0")
    play, limit = (_number(cells, column, "-1") for column in ("play", "limit"))
    largest = max(abs(x), abs(y), abs(z))
    if node_a == node_b:
        raise Reason("node_a and node_b are the same")
    if largest == 0.0:
        raise Reason("the direction x, y, z has the length zero")
    if stiffness < 0.0:
        raise Reason("the stiffness is negative")
    if any(number < 0.0 and number != -1.0 for number in (play, limit)):
        raise Reason("play and limit must not be negative, but for -1, which is none")
    # Any length of a direction can be squared once its largest component is 1.
    length = math.hypot(x / largest, y / largest, z / largest)
    direction = (x / largest / length, y / largest / length, z / largest / length)
    play, limit = (math.inf if number < 0.0 else number for number in (play, limit))
    compliance = 1.0 / stiffness if stiffness else 0.0
    return DeckLink(cells.get("name") or name, node_a, node_b, direction, gap, play, compliance, limit, place)


def _number(cells: dict[str, str], column: str, default: str = "") -> float:
    with named(column):
        return value(cells.get(column) or default)


def read_supports(deck: Deck, path: PathLike) -> None:
    """Add the supports of a table to the model and all load cases; :meth:`Deck.read_supports` describes it."""
    found = Conditions()
    for place, cells in named_rows(path, _SUPPORT_COLUMNS, {"held": "directions"}):
        with located(place):
            node, directions = label(cells.get("node", ""), "node"), cells.get("directions", "").lower()
            if not directions or not set(directions) <= set(_DIRECTIONS):
                raise Reason(f"{quoted(directions)} is no list of directions, such as xyz or 123")
            displacement = value(cells.get("displacement") or "0")
            for direction in directions:
                found.hold((node, _DIRECTIONS[direction]), displacement, place)
    if not found:
        raise refusal(path, "there is no support: lines like 17,xyz are needed")
    joined = [_joined(supports, found) for supports in (deck._supports, *(case.supports for case in deck._cases))]
    deck._supports = joined[0]
    for case, supports in zip(deck._cases, joined[1:]):
        case.supports = supports
    deck.paths.append(place.path)


def _joined(supports: Conditions, found: Conditions) -> Conditions:
    """Supports with those that are found, which may not contradict them, of whatever step they are."""
    joined = Conditions(supports)
    for dof, support in found.items():
        with located(support.place):
            joined.hold(dof, support.value, support.place, joined[dof].step if dof in joined else 0)
    return joined


def read_cases(deck: Deck, path: PathLike) -> None:
    """Add the load cases of a table; :meth:`Deck.read_cases` describes it."""
    cases: list[DeckCase] = []
    seen = False
    for place, cells in rows(path):
        with located(place):
            if not seen:
                cases = [DeckCase(name) for name in _case_names(cells, len(deck._cases))]
            if seen or not begins_with_word(cells):
                _add_row(cases, cells, place)
        seen = True
    if not any(case.loads for case in cases):
        raise refusal(path, "there are no forces: lines like 17.3,-100 are needed")
    for case in cases:
        case.supports = Conditions(deck._supports)
    deck._cases += cases
    deck.paths.append(place.path)


def _case_names(cells: Sequence[str], before: int) -> list[str]:
    """Names of the columns behind the first one; without a heading, or a name, cases are numbered."""
    given = cells[1:] if begins_with_word(cells) else [""] * len(cells[1:])
    names = [name or f"case {number}" for number, name in enumerate(given, before + 1)]
    check_unique(names)
    return names


def _add_row(cases: Sequence[DeckCase], cells: Sequence[str], place: Place) -> None:
    """A line node.direction and a force for each case."""
    forces = cells[1:]
    if not cases:
        raise Reason("a force for each load case is needed after node and direction")
    node, point, direction = cells[0].partition(".")
    if not (node and direction):
        raise Reason(f"a node and a direction are needed first, like 17.3, not {quoted(cells[0])}")
    dof = label(node, "node"), label(direction, "direction", 0, _LARGEST_DIRECTION)
    if len(forces) < len(cases):
        raise Reason(f"{len(forces)} force(s), but {len(cases)} load case(s)")
    if len(forces) > len(cases):
        raise Reason(f"more forces than the {len(cases)} load case(s)")
    if dof in cases[0].loads:
        raise Reason(f"a second line for node {dof[0]}, direction {dof[1]}")
    for case, force in zip(cases, forces):
        case.loads.add(dof, value(force), place)
