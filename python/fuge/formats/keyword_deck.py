"""Decks of Abaqus and CalculiX: gap elements, supports, and steps as load cases."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from fuge.deck import Conditions, Deck, DeckCase
from fuge.errors import FileError, FileWarning, InputError, Status, warn
from fuge.formats import keyword_names as names, keyword_rules as rules
from fuge.formats.keyword import Block, read_blocks, split_items, unquoted
from fuge.formats.keyword_gaps import Gaps
from fuge.formats.mesh_input import mesh_of
from fuge.formats.text import PathLike, Place, Reason, label, located, named, quoted, value
from fuge.mesh import Mesh

_DIRECTIONS = 6

# The directions that the names of supports hold.
_SUPPORTS = dict(
    support.split(":")
    for support in ("ENCASTRE:123456 PINNED:123 XSYMM:156 YSYMM:246 ZSYMM:345 XASYMM:234 YASYMM:135 ZASYMM:126").split()
)

_NUMBERED_STEP = re.compile(r"STEP \d+", re.IGNORECASE)


def read_keyword_deck(path: PathLike) -> Deck:
    """Read gap elements, supports and steps from an input file of Abaqus or CalculiX.

    GAPUNI, GAPCYL and GAPSPHER with *GAP are links, *BOUNDARY and *CLOAD are conditions, and each static *STEP is a
    load case, called as its NAME if no other step is. What could change the answer otherwise is refused; in a step only
    if that, or a later one to which it is handed on, is a load case. A :class:`FileWarning` tells of NLGEOM.
    """
    deck = Deck()
    others: list[Block] = []
    mesh = mesh_of(_beside(others, read_blocks(path, deck.paths)), path)
    reader = _Reader(deck, mesh)
    for block in others:
        reader.read(block)
    reader.finish(path)
    return deck


def _beside(others: list[Block], blocks: Iterable[Block]) -> Iterator[Block]:
    """All blocks; those that are none of the mesh go into the list of others too."""
    for block in blocks:
        if block.keyword == "ELEMENT":
            rules.check_element(block, rules.parameters_of(block))
        elif block.keyword not in names.MESH:
            others.append(block)
        yield block


@dataclass
class _Step:
    """A step while it is read, with what was before it, which comes back after a perturbation."""

    name: str
    held: Conditions
    forces: Conditions
    unread: FileError | None
    large: Place | None = None
    procedure: str = ""
    perturbation: bool = False


class _Reader:
    """Adds links and load cases to a deck, block by block."""

    def __init__(self, deck: Deck, mesh: Mesh) -> None:
        self._deck, self._mesh = deck, mesh
        self._nodes = frozenset(mesh.node.tolist())
        self._gaps = Gaps(mesh, deck._links)
        self._held, self._forces = Conditions(), Conditions()
        self._step: _Step | None = None
        self._steps = 0
        self._names: set[str] = set()
        # OP of the first *BOUNDARY and of the first *CLOAD of the step.
        self._first_op: dict[str, str] = {}
        # What this step, or an earlier one that handed it on, has that a load case must not have; it may become none.
        self._unread: FileError | None = None
        # Where the first load case with large displacements begins.
        self._large: Place | None = None
        self._actions: dict[str, Callable[[Block, dict[str, str]], None]] = {
            "BOUNDARY": self._hold,
            "CLOAD": self._load,
            "GAP": self._gaps.read,
            "MATERIAL": rules.check_material,
            "MPC": rules.check_constraint,
            "STEP": self._describe_step,
        }

    def read(self, block: Block) -> None:
        """Act on a keyword and the lines below it."""
        if block.keyword == "STEP":
            self._begin_step()
        elif block.keyword == "ENDSTEP":
            self._end_step()
        elif block.keyword in names.PROCEDURES:
            self._set_procedure(block)
        try:
            parameters = rules.parameters_of(block)
        except FileError as refused:
            if self._step is None or block.keyword in rules.MODEL:
                raise
            self._unread, parameters = self._unread or refused, {}
        if block.keyword in self._actions:
            self._actions[block.keyword](block, parameters)

    def _begin_step(self) -> None:
        self._end_step()
        self._keep_supports()
        self._steps += 1
        self._first_op = {}
        self._step = _Step(f"STEP {self._steps}", Conditions(self._held), Conditions(self._forces), self._unread)

    def _describe_step(self, block: Block, parameters: dict[str, str]) -> None:
        step = self._step
        assert step is not None
        name = parameters.get("NAME", "")
        if name and name.isprintable() and name.upper() not in self._names and not _NUMBERED_STEP.fullmatch(name):
            step.name = name
            self._names.add(name.upper())
        if parameters.get("NLGEOM", "NO") != "NO":
            step.large = block.place
        if "PERTURBATION" in parameters:
            step.perturbation = True
            reason = "a *STEP with PERTURBATION is not read: contact depends on the whole load"
            self._unread = self._unread or block.refuse(reason)

    def _set_procedure(self, block: Block) -> None:
        if self._step is None:
            raise block.refuse(f"*{block.keyword} is needed in a *STEP")
        if self._step.procedure:
            raise block.refuse(f"*{block.keyword}: the step has *{self._step.procedure} already")
        self._step.procedure = block.keyword
        self._step.perturbation |= block.keyword in names.PERTURBATIONS

    def _end_step(self) -> None:
        """Keep a static step as a load case; what a perturbation has ends with it."""
        step, self._step = self._step, None
        if step is None:
            return
        if step.procedure and step.procedure not in names.STATIC:
            if step.perturbation:
                self._held, self._forces, self._unread = step.held, step.forces, step.unread
            return
        if self._unread is not None:
            raise self._unread
        self._deck._cases.append(DeckCase(step.name, Conditions(self._forces), Conditions(self._held)))
        self._large = self._large or step.large

    def _keep_supports(self) -> None:
        """Those of the model itself are what is held before the first step."""
        if self._steps == 0:
            self._deck._supports = Conditions(self._held)

    def finish(self, path: PathLike) -> None:
        """End the deck."""
        self._end_step()
        self._keep_supports()
        self._gaps.check(path)
        if self._large is not None:
            reason = "NLGEOM has no effect: displacements are small, and the stiffness matrix is that of the start"
            warn(FileWarning(f"{self._large}: {reason}", Status.DONE))

    def _hold(self, block: Block, parameters: dict[str, str]) -> None:
        if self._begins_anew(block, parameters):
            self._held = Conditions()
        _read_lines(block, self._hold_nodes)

    def _hold_nodes(self, items: list[str], place: Place) -> None:
        """Node or set, first and last direction, displacement; or node or set, and the name of a support."""
        nodes = self._nodes_of(items[0])
        directions, displacement = _support(*_columns(items, 4, "node, first and last direction, displacement"))
        for node in nodes:
            for direction in directions:
                self._held.hold((node, direction), displacement, place, self._steps)

    def _load(self, block: Block, parameters: dict[str, str]) -> None:
        if self._step is None:
            raise block.refuse("*CLOAD is needed in a *STEP")
        if self._begins_anew(block, parameters):
            self._forces = Conditions()
        _read_lines(block, self._load_nodes)

    def _load_nodes(self, items: list[str], place: Place) -> None:
        """Node or set, direction, force on each node."""
        nodes = self._nodes_of(items[0])
        direction, force = _columns(items, 3, "node, direction and force")
        along, size = label(direction, "direction", 1, _DIRECTIONS), value(force)
        for node in nodes:
            self._forces.add((node, along), size, place, self._steps)

    def _begins_anew(self, block: Block, parameters: dict[str, str]) -> bool:
        """Whether earlier conditions end here: by OP=NEW of the first keyword; Abaqus wants it on all of them."""
        keyword, op = block.keyword, parameters.get("OP") or "MOD"
        is_first = keyword not in self._first_op
        if self._first_op.setdefault(keyword, op) == "MOD" and op == "NEW":
            raise block.refuse(f"*{keyword}: OP=NEW belongs to the first *{keyword} of the step")
        return is_first and op == "NEW"

    def _nodes_of(self, word: str) -> list[int]:
        """The node of this number, or those of the set of this name."""
        if not word or word[0] in "0123456789+-.":
            number = label(word, "node")
            if number not in self._nodes:
                raise Reason(f"the deck has no node {number}")
            return [number]
        name = unquoted(word)
        try:
            numbers: list[int] = self._mesh.node[self._mesh.node_set(name)].tolist()
            return numbers
        except InputError:
            raise Reason(f"the set of nodes {quoted(name)} is not defined") from None


def _read_lines(block: Block, read: Callable[[list[str], Place], None]) -> None:
    """Read the columns of each data line."""
    for index, line in enumerate(block.lines):
        place = block.where(index)
        with located(place), named(f"*{block.keyword}"):
            read(split_items(line)[0], place)


def _columns(items: list[str], most: int, names: str) -> list[str]:
    """The columns behind the first one, blank where the line has none."""
    if any(items[most:]):
        raise Reason(f"more columns than {names}")
    return (items + [""] * most)[1:most]


def _support(first: str, last: str, displacement: str) -> tuple[Iterable[int], float]:
    """Directions that are held, and their displacement."""
    name = first.upper()
    if name not in _SUPPORTS:
        begin = label(first, "direction", 1, _DIRECTIONS)
        end = label(last, "last direction", begin, _DIRECTIONS) if last else begin
        return range(begin, end + 1), value(displacement) if displacement else 0.0
    if last or displacement:
        raise Reason("more columns than node and name of a support")
    return [int(digit) for digit in _SUPPORTS[name]], 0.0
