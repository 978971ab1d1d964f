"""Tables of links, of supports and of load cases, for decks that no program has written.

Columns stand between commas, semicolons or tabs, else between blanks; comments go from # or ! on. Names in double
quotes may have any of these.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

from fuge.deck import Conditions, Deck, DeckCase, DeckLink
from fuge.formats.text import PathLike, Place, Reason, label, located, named, quoted, read_text, refusal, value

_LINK_COLUMNS = ("node_a", "node_b", "x", "y", "z", "gap", "play", "stiffness", "limit", "name")
_SUPPORT_COLUMNS = ("node", "directions", "displacement")
_SYNONYMS = {"held": "directions"}

# Directions by letters and numbers.
_DIRECTIONS = {**dict(zip("xyz", (1, 2, 3))), **{str(k): k for k in range(1, 7)}}
_LARGEST_DIRECTION = 9999

# Quotes at the begin of a column, and comments.
_QUOTED = re.compile(r'(?<![^,;\t ])"[^"]*"')
_COMMENT = re.compile(r"(?<![^,;\t ])[#!]")


def read_links(deck: Deck, path: PathLike) -> None:
    """Add the links of a table to a deck; :meth:`Deck.read_links` describes it."""
    links: list[DeckLink] = []
    for place, cells in _named_rows(path, _LINK_COLUMNS):
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
    return DeckLink(
        cells.get("name") or name,
        node_a,
        node_b,
        direction,
        gap,
        math.inf if play < 0.0 else play,
        1.0 / stiffness if stiffness else 0.0,
        math.inf if limit < 0.0 else limit,
        place,
    )


def _number(cells: dict[str, str], column: str, default: str = "") -> float:
    with named(column):
        return value(cells.get(column) or default)


def read_supports(deck: Deck, path: PathLike) -> None:
    """Add the supports of a table to the model and all load cases; :meth:`Deck.read_supports` describes it."""
    found = Conditions()
    for place, cells in _named_rows(path, _SUPPORT_COLUMNS):
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
    for place, cells in _rows(path):
        with located(place):
            if not seen:
                cases = [DeckCase(name) for name in _case_names(cells, len(deck._cases))]
            if seen or not _is_heading(cells):
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
    given = cells[1:] if _is_heading(cells) else [""] * len(cells[1:])
    names = [name or f"case {number}" for number, name in enumerate(given, before + 1)]
    _check_unique(names)
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


def _named_rows(path: PathLike, columns: Sequence[str]) -> Iterator[tuple[Place, dict[str, str]]]:
    """Lines of a table by the names of their columns.

    A heading names them, and goes on as `columns` if it begins as they do; without a heading they are `columns`.
    """
    names = columns
    seen = False
    for place, cells in _rows(path):
        with located(place):
            if not seen and _is_heading(cells):
                names = _headings(cells, columns)
            elif len(cells) > len(names):
                raise Reason(f"there are more columns than {', '.join(names)}")
            else:
                yield place, dict(zip(names, cells))
        seen = True


def _headings(cells: Sequence[str], columns: Sequence[str]) -> Sequence[str]:
    names = [_SYNONYMS.get(cell.lower(), cell.lower()) for cell in cells]
    for cell, name in zip(cells, names):
        if name not in columns:
            raise Reason(f"there is no column {quoted(cell)}: columns are {', '.join(columns)}")
    _check_unique(names)
    return [*names, *columns[len(names) :]] if names == list(columns[: len(names)]) else names


def _check_unique(names: Sequence[str]) -> None:
    for k, name in enumerate(names):
        if name in names[:k]:
            raise Reason(f"two columns have the name {quoted(name)}")


def _is_heading(cells: Sequence[str]) -> bool:
    return cells[0][:1] not in set("0123456789+-.")


def _rows(path: PathLike) -> Iterator[tuple[Place, list[str]]]:
    """The cells of each line that has some."""
    file = read_text(path)
    for number, line in enumerate(file.lines, 1):
        place = Place(file.path, number)
        with located(place):
            cells = _cells(line)
        if cells:
            yield place, cells


def _cells(line: str) -> list[str]:
    """What stands between the separators of a line, without outer blanks and without empty cells at the end."""
    # Of the same length, without separators in quotes.
    bare = _QUOTED.sub(lambda name: "x" * len(name[0]), line)
    comment = _COMMENT.search(bare)
    bare = bare[: comment.start()] if comment else bare
    if "," in bare and ";" in bare:
        raise Reason("commas and semicolons on one line: separate columns by one of them, and write decimal points")
    bare = bare.rstrip(" \t\r,;")
    separator = next((letter for letter in ",;\t" if letter in bare), None)
    if separator is None:
        return [line[slice(*cell.span())] for cell in re.finditer(r"\S+", bare)]
    cells, begin = [], 0
    for cell in bare.split(separator):
        cells.append(line[begin : begin + len(cell)].strip())
        begin += len(cell) + 1
    return cells
