"""Decks of Abaqus and CalculiX: gap elements, supports, and steps as load cases."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from fuge.deck import Conditions, Deck, DeckCase, DeckLink
from fuge.errors import FileError, FileWarning, InputError, Status, warn
from fuge.formats.keyword import Block, read_blocks, split_items, unquoted
from fuge.formats.keyword_gaps import GAP_TYPES, Gap, gap_link, read_gap
from fuge.formats.keyword_words import PERTURBATIONS, PROCEDURES, STATIC, check_keyword, parameters_of
from fuge.formats.text import PathLike, Place, Reason, label, quoted, refusal, value
from fuge.mesh import Mesh, read_mesh

_DIRECTIONS = 6

# Directions that the names of supports hold.
_SUPPORTS = {
    "ENCASTRE": (1, 2, 3, 4, 5, 6),
    "PINNED": (1, 2, 3),
    "XSYMM": (1, 5, 6),
    "YSYMM": (2, 4, 6),
    "ZSYMM": (3, 4, 5),
    "XASYMM": (2, 3, 4),
    "YASYMM": (1, 3, 5),
    "ZASYMM": (1, 2, 6),
}

# Solids, plates, shells, membranes, bars, beams, springs, dampers, masses and rigid bodies.
_LINEAR_ELEMENT = re.compile(
    r"C3D|CPS|CPE|CAX|CGAX|SAX|MAX|MGAX|M3D|S[34689]|SC[68]|STRI|SFM|US[34]|T[23]D|B[23][1-4]|PIPE[23]|ELBOW|SPRING|"
    r"DASHPOT|MASS|ROTARYI|R2D|R3D|RAX|RB[23]D|DCOUP"
)

# Constraints between displacements that are equations; blank or 0 where the list of nodes goes on.
_LINEAR_CONSTRAINTS = ("", "0", "BEAM", "LINEAR", "LINK", "MEANROT", "PIN", "PLANE", "QUADRATIC", "STRAIGHT", "TIE")

# The beginnings of names of CalculiX' materials for one sign.
_ONE_SIGN = ("COMPRESSION_ONLY", "TENSION_ONLY")

_NUMBERED_STEP = re.compile(r"STEP \d+", re.IGNORECASE)


def read_keyword_deck(path: PathLike) -> Deck:
    """Read gap elements, supports and steps from an input file of Abaqus or CalculiX.

    GAPUNI, GAPCYL and GAPSPHER with *GAP are links, *BOUNDARY and *CLOAD are conditions, and each static *STEP is a
    load case, called as its NAME if no other step is. What could change the answer otherwise is refused; in a step only
    if that, or a later one to which it is handed on, is a load case. A :class:`FileWarning` tells of NLGEOM.

    Raises
    ------
    FileError
        The message has the file, the line, the keyword and the reason.
    """
    deck = Deck()
    reader = _Reader(read_mesh(path))
    for block in read_blocks(path, deck.paths):
        reader.read(block)
    reader.end_step()
    reader.check_gaps(path)
    deck._links, deck._cases = reader.links, reader.cases
    deck._supports = reader.held if reader.of_model is None else reader.of_model
    if reader.large is not None:
        reason = "NLGEOM has no effect: displacements are small, and the stiffness matrix is that of the start"
        warn(FileWarning(f"{reader.large}: {reason}", Status.DONE))
    return deck


@dataclass
class _Step:
    """A step while it is read, with what was before it, which comes back after a perturbation."""

    name: str
    held: Conditions
    forces: Conditions
    unread: FileError | None
    large: Place | None = None
    static: bool = False
    other: bool = False
    perturbation: bool = False


class _Reader:
    """What has been read of a deck; `of_model` are the supports of the model once there is a step."""

    def __init__(self, mesh: Mesh) -> None:
        self.links: list[DeckLink] = []
        self.cases: list[DeckCase] = []
        self.held, self._forces = Conditions(), Conditions()
        self.of_model: Conditions | None = None
        # Where the first load case with large displacements begins.
        self.large: Place | None = None
        self._mesh = mesh
        self._nodes = frozenset(mesh.node.tolist())
        self._with_gap: set[int] = set()
        self._step: _Step | None = None
        self._steps = 0
        self._names: set[str] = set()
        # OP of the first *BOUNDARY and of the first *CLOAD of the step.
        self._first_op: dict[str, str] = {}
        # What this step, or an earlier one that handed it on, has that a load case must not have.
        self._unread: FileError | None = None
        self._actions: dict[str, Callable[[Block, dict[str, str]], None]] = {
            "BOUNDARY": self._hold,
            "CLOAD": self._load,
            "ELEMENT": self._check_type,
            "GAP": self._link,
            "MATERIAL": self._check_material,
            "MPC": self._check_constraints,
            "STEP": self._describe_step,
        }

    def read(self, block: Block) -> None:
        """Act on a keyword and the lines below it."""
        if block.keyword == "STEP":
            self._begin_step()
        elif block.keyword == "ENDSTEP":
            self.end_step()
        elif block.keyword in PROCEDURES:
            self._set_procedure(block)
        try:
            check_keyword(block)
            parameters = parameters_of(block)
        except FileError as refused:
            self._refuse(refused)
        else:
            if block.keyword in self._actions:
                self._actions[block.keyword](block, parameters)

    def _refuse(self, refused: FileError) -> None:
        """Refuse the model, or the load case that the present step may become: its procedure may follow."""
        if self._step is None:
            raise refused
        self._unread = self._unread or refused

    def _begin_step(self) -> None:
        self.end_step()
        if self.of_model is None:
            self.of_model = Conditions(self.held)
        self._steps += 1
        self._first_op = {}
        self._step = _Step(f"STEP {self._steps}", Conditions(self.held), Conditions(self._forces), self._unread)

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
            self._refuse(block.refuse("a *STEP with PERTURBATION is not read: contact depends on the whole load"))

    def _set_procedure(self, block: Block) -> None:
        if self._step is None:
            raise block.refuse(f"*{block.keyword} is needed in a *STEP")
        self._step.static |= block.keyword in STATIC
        self._step.other |= block.keyword not in STATIC
        self._step.perturbation |= block.keyword in PERTURBATIONS

    def end_step(self) -> None:
        """Keep a static step as a load case; what a perturbation has ends with it."""
        step, self._step = self._step, None
        if step is None:
            return
        if step.other and not step.static:
            if step.perturbation:
                self.held, self._forces, self._unread = step.held, step.forces, step.unread
            return
        if self._unread is not None:
            raise self._unread
        self.cases.append(DeckCase(step.name, Conditions(self._forces), Conditions(self.held)))
        self.large = self.large or step.large

    def _hold(self, block: Block, parameters: dict[str, str]) -> None:
        """Supports: node or set, first and last direction, displacement; or node or set, and the name of a support."""
        if self._begins_anew(block, parameters):
            self.held = Conditions()
        for items, place in _data(block):
            with _reasons(block, place):
                nodes = self._nodes_of(items[0])
                directions, displacement = _support(*_columns(items, 4, "node, first and last direction, displacement"))
                for node in nodes:
                    for direction in directions:
                        self.held.hold((node, direction), displacement, place, self._steps)

    def _load(self, block: Block, parameters: dict[str, str]) -> None:
        """Forces: node or set, direction, force on each node."""
        if self._step is None:
            raise block.refuse("*CLOAD is needed in a *STEP")
        if self._begins_anew(block, parameters):
            self._forces = Conditions()
        for items, place in _data(block):
            with _reasons(block, place):
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
            return list(map(int, self._mesh.node[self._mesh.node_set(name)]))
        except InputError:
            raise Reason(f"the set of nodes {quoted(name)} is not defined") from None

    def _link(self, block: Block, parameters: dict[str, str]) -> None:
        """The links of a set of gap elements: one data line for all of them."""
        name = parameters.get("ELSET", "")
        if not name:
            raise block.refuse("*GAP needs ELSET = and a name")
        try:
            elements = list(map(int, self._mesh.element_set(name)))
        except InputError:
            raise block.refuse(f"*GAP: the element set {quoted(name)} is not defined") from None
        if not block.lines:
            raise block.refuse("*GAP: its data line is missing")
        if len(block.lines) > 1:
            raise block.refuse("*GAP: more than one data line", 1)
        place = block.where(0)
        with _reasons(block, place):
            gap = read_gap(block.lines[0])
            self.links += [self._gap_link(element, gap, place) for element in elements]

    def _gap_link(self, index: int, gap: Gap, place: Place) -> DeckLink:
        mesh = self._mesh
        kind, number = mesh.element_type(index), int(mesh.element[index])
        nodes = mesh.connection[mesh.first[index] : mesh.first[index + 1]]
        if kind not in GAP_TYPES:
            raise Reason(f"element {number} is no gap, but of type {kind}")
        if index in self._with_gap:
            raise Reason(f"element {number} has a *GAP already")
        if nodes.size != 2:
            raise Reason(f"element {number} has {nodes.size} nodes: a gap has two")
        self._with_gap.add(index)
        node_a, node_b = map(int, mesh.node[nodes])
        try:
            return gap_link(kind, number, (node_a, node_b), mesh.position[nodes], gap, place)
        except Reason as reason:
            raise Reason(f"{kind} {number}: {reason}") from None

    def check_gaps(self, path: PathLike) -> None:
        """Refuse gap elements without *GAP."""
        for index, number in enumerate(self._mesh.element.tolist()):
            if index not in self._with_gap and self._mesh.element_type(index) in GAP_TYPES:
                raise refusal(path, f"{self._mesh.element_type(index)} {number} has no *GAP with its element set")

    def _check_type(self, block: Block, parameters: dict[str, str]) -> None:
        kind = parameters.get("TYPE", "").upper()
        if kind not in GAP_TYPES and not _LINEAR_ELEMENT.match(kind):
            raise block.refuse(
                f"elements of type {quoted(kind)} are not read here: beside linear ones {', '.join(GAP_TYPES)} are"
            )

    def _check_material(self, block: Block, parameters: dict[str, str]) -> None:
        if parameters.get("NAME", "").upper().startswith(_ONE_SIGN):
            raise block.refuse(
                "materials for one sign only are not read: give struts and cables as GAPUNI with a stiffness, or in a "
                "table of links"
            )

    def _check_constraints(self, block: Block, parameters: dict[str, str]) -> None:
        for items, place in _data(block):
            if items[0].upper() not in _LINEAR_CONSTRAINTS:
                raise refusal(place, f"*MPC of type {quoted(items[0])} is not read: it may be no linear equation")


def _data(block: Block) -> Iterator[tuple[list[str], Place]]:
    """The columns of each data line, and its place."""
    for index, line in enumerate(block.lines):
        yield split_items(line)[0], block.where(index)


@contextmanager
def _reasons(block: Block, place: Place) -> Iterator[None]:
    """Make errors of reasons why a data line cannot be read."""
    try:
        yield
    except Reason as reason:
        raise refusal(place, f"*{block.keyword}: {reason}") from None


def _columns(items: list[str], most: int, names: str) -> list[str]:
    """The columns behind the first one, blank where the line has none."""
    if any(items[most:]):
        raise Reason(f"more columns than {names}")
    return (items + [""] * most)[1:most]


def _support(first: str, last: str, displacement: str) -> tuple[tuple[int, ...], float]:
    """Directions that are held, and their displacement."""
    named = _SUPPORTS.get(first.upper())
    if named is None:
        begin = label(first, "direction", 1, _DIRECTIONS)
        end = label(last, "last direction", begin, _DIRECTIONS) if last else begin
        return tuple(range(begin, end + 1)), value(displacement) if displacement else 0.0
    if last or displacement:
        raise Reason("more columns than node and name of a support")
    return named, 0.0
