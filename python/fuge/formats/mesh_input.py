"""Meshes in input files of Abaqus and CalculiX: nodes, elements, sets and surfaces."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fuge.element_faces import element_type
from fuge.errors import FileError
from fuge.formats.keyword import Block, complete, read_blocks, squeezed, unquoted
from fuge.formats.keyword_names import MESH_MAKERS
from fuge.formats.mesh_lines import Labels, plain_labels, read_elements, read_nodes, read_rows
from fuge.formats.text import PathLike, Reason, label, located, quoted, refusal
from fuge.mesh import Mesh

_Indices = NDArray[Any]
_Parameters = dict[str, str]

_NAME_LENGTH, _TYPE_LENGTH = 80, 16
_MOST_GENERATED = 20000000

# Parameters that are read, or change nothing; and what to do instead of those that are not read.
_PARAMETERS = {
    "NODE": "NSET SYSTEM",
    "ELEMENT": "TYPE ELSET",
    "NSET": "NSET ELSET GENERATE INTERNAL UNSORTED",
    "ELSET": "ELSET GENERATE INTERNAL UNSORTED",
    "SURFACE": "NAME TYPE FILLETRADIUS INTERNAL MAXRATIO REGIONTYPE TRIM",
}
_REMEDIES = {"INPUT": "use *INCLUDE", "COMBINE": "list its faces", "CROP": "list its faces"}

# Surfaces of other types than the first two are skipped: they are no faces of elements.
_SURFACE_TYPES = "ELEMENT NODE CUTTINGSURFACE CYLINDER EULERIANMATERIAL REVOLUTION SEGMENTS USER XFEM".split()

# The numbers of these faces, which only shells have.
_SIDES = {"SNEG": 1, "SPOS": 2}

# Members of a set are joined when so many are new, or as many as it has.
_AT_ONCE = 100000


def read_mesh(path: PathLike) -> Mesh:
    """Read an input file of Abaqus or CalculiX: nodes, elements, sets and surfaces; other keywords are skipped.

    Raises
    ------
    FileError
        The message has the file, the line and the reason; also for what is no keyword, and for keywords such as
        ``*PART`` and ``*NGEN``, without which the mesh would be another one.
    """
    paths: list[str] = []
    return mesh_of(read_blocks(path, paths), path, paths)


def mesh_of(blocks: Iterable[Block], path: PathLike, paths: Sequence[str] = ()) -> Mesh:
    """The mesh of the blocks of a file; `paths` are those of all files that they come from."""
    reader = _Reader()
    read = [(block, _parameters(block)) for block in blocks if block.keyword in {*_PARAMETERS, *MESH_MAKERS}]
    _take(read, reader.take_items)
    if not reader.positions:
        raise refusal(path, "there is no *NODE: is it an input file of Abaqus or CalculiX?")
    reader.number()
    # Sets and surfaces may stand above their members.
    _take(read, reader.take_members)
    return reader.mesh(list(paths))


def _parameters(block: Block) -> _Parameters:
    if block.keyword in MESH_MAKERS:
        reason = "is not read, and without it the mesh would be another one: write a file that lists all nodes and"
        raise block.refuse(f"*{block.keyword} {reason} elements")
    parameters = block.named([*_PARAMETERS[block.keyword].split(), *_REMEDIES])
    for name, remedy in _REMEDIES.items():
        if name in parameters:
            raise block.refuse(f"{name} = is not read here: {remedy}")
    return parameters


def _take(read: list[tuple[Block, _Parameters]], take: Callable[[Block, _Parameters], None]) -> None:
    for block, parameters in read:
        with located(block.place):
            take(block, parameters)


class _Set:
    """Members in their order, each once."""

    def __init__(self, name: str) -> None:
        self.name = name
        self._parts = [np.empty(0, dtype=np.intc)]
        self._added = 0

    def add(self, members: _Indices) -> None:
        self._parts.append(members)
        self._added += members.size
        # Sets that name each other would double at each line.
        if self._added > max(_AT_ONCE, self._parts[0].size):
            self.members()

    def members(self) -> _Indices:
        if len(self._parts) > 1:
            joined = np.concatenate(self._parts)
            self._parts = [joined[np.sort(np.unique(joined, return_index=True)[1])]]
            self._added = 0
        return self._parts[0]


class _Table:
    """All nodes, or all elements: their labels in the order of the file, and their sets."""

    def __init__(self, what: str) -> None:
        self.what = what
        self.sets: dict[str, _Set] = {}
        # Those of each block, by its id.
        self.blocks: dict[int, Labels] = {}

    def number(self) -> None:
        """Make ready to find labels; refused if one is there twice."""
        self.labels = np.concatenate([np.empty(0, dtype=np.int64), *(found.numbers for found in self.blocks.values())])
        order = np.argsort(self.labels, kind="stable").astype(np.intc)
        # Behind the labels stands 0, which is none.
        self._order, self._sorted = np.append(order, np.intc(-1)), np.append(self.labels[order], 0)
        again = self._order[1:][self._sorted[1:] == self._sorted[:-1]]
        if again.size:
            raise self.refuse(int(again.min()), "is defined a second time")

    def refuse(self, k: int, reason: str) -> FileError:
        """The error that item k cannot be used, at its line."""
        reason, at = f"{self.what} {self.labels[k]} {reason}", k
        for block, numbers, lines in self.blocks.values():
            if at < numbers.size:
                break
            at -= numbers.size
        return block.refuse(reason, int(lines[at]))

    def find(self, labels: NDArray[np.int64]) -> _Indices:
        """Indices of labels, -1 where there is none."""
        place = np.searchsorted(self._sorted[:-1], labels)
        return np.where(self._sorted[place] == labels, self._order[place], np.intc(-1))

    def of_block(self, block: Block) -> _Indices:
        """Indices of the nodes or elements of a block."""
        return self.find(self.blocks[id(block)].numbers) if block.lines else np.empty(0, dtype=np.intc)

    def within(self, labels: range) -> _Indices:
        """Indices of those labels of a range that exist."""
        begin, end = np.searchsorted(self._sorted[:-1], [labels.start, labels.stop])
        return np.compress((self._sorted[begin:end] - labels.start) % labels.step == 0, self._order[begin:end])

    def members(self, name: str) -> _Indices:
        """Those that a set has so far."""
        if name.upper() not in self.sets:
            raise Reason(f"the {self.what} set {quoted(name)} is not defined above")
        return self.sets[name.upper()].members()

    def item(self, text: str) -> int | _Indices:
        """A label, or the members of a set."""
        is_label = not text or text[0] in "0123456789+-."
        return label(text, self.what) if is_label else self.members(unquoted(text))

    def indices(self, labels: Labels, owner: str) -> _Indices:
        """Indices of the labels that a set or surface has, -1 for the label 0; refused if one does not exist."""
        found = self.find(labels.numbers)
        missing = np.flatnonzero((found < 0) & (labels.numbers > 0))
        if missing.size:
            reason = f"{self.what} {labels.numbers[missing[0]]} of {owner} is not defined in any file"
            raise labels.block.refuse(reason, int(labels.lines[missing[0]]))
        return found

    def parts(self, block: Block, items: list[tuple[int, int | _Indices]], owner: str) -> Iterator[_Indices]:
        """Indices of each item, a label or the members of a set, in a line of a block."""
        labels = np.array([item if isinstance(item, int) else 0 for _, item in items], dtype=np.int64)
        found = self.indices(Labels(block, labels, np.array([k for k, _ in items])), owner)
        for k, (_, item) in enumerate(items):
            yield found[k : k + 1] if isinstance(item, int) else item


class _Reader:
    """Nodes and elements, then sets and surfaces."""

    def __init__(self) -> None:
        self.nodes, self.elements = _Table("node"), _Table("element")
        self.positions: list[NDArray[np.float64]] = []
        self.types: list[str] = []
        self.counts, self.node_labels = [np.zeros(1, dtype=np.intp)], [np.empty(0, dtype=np.int64)]
        self.surfaces: dict[str, _Set] = {}

    def take_items(self, block: Block, parameters: _Parameters) -> None:
        """Add nodes or elements."""
        if block.keyword == "NODE":
            system = squeezed(parameters.get("SYSTEM", ""))
            if system not in ("", "R"):
                raise Reason(f"SYSTEM = {system} is not read: write rectangular coordinates")
            if block.lines:
                labels, positions = read_nodes(block)
                self.nodes.blocks[id(block)] = labels
                self.positions.append(positions)
        elif block.keyword == "ELEMENT":
            type = squeezed(parameters.get("TYPE", ""))
            if not (0 < len(type) <= _TYPE_LENGTH and type.isascii() and type.isalnum()):
                raise Reason(f"*ELEMENT needs TYPE = and a type of at most {_TYPE_LENGTH} letters and digits")
            if block.lines:
                labels, counts, nodes = read_elements(block, type)
                self.elements.blocks[id(block)] = labels
                self.types.append(type)
                self.counts.append(counts)
                self.node_labels.append(nodes)

    def number(self) -> None:
        """Indices take the place of labels."""
        self.nodes.number()
        self.elements.number()
        sizes = [counts.size for counts in self.counts[1:]]
        self.element_types = np.repeat(np.array(self.types, dtype=np.str_), sizes)
        is_shell = [element_type(type)[0] == "shell" for type in self.types]
        self.is_shell = np.repeat(np.array(is_shell, dtype=bool), sizes)
        self.first = np.cumsum(np.concatenate(self.counts)).astype(np.intc)
        labels = np.concatenate(self.node_labels)
        self.connection = self.nodes.find(labels)
        missing = np.flatnonzero(self.connection < 0)
        if missing.size:
            element = int(np.searchsorted(self.first, missing[0], side="right")) - 1
            raise self.elements.refuse(element, f"has the node {labels[missing[0]]}, which is not defined in any file")

    def take_members(self, block: Block, parameters: _Parameters) -> None:
        """Add to sets and surfaces."""
        if block.keyword == "SURFACE":
            self._take_surface(block, parameters)
            return
        key, table = ("NSET", self.nodes) if block.keyword in ("NODE", "NSET") else ("ELSET", self.elements)
        if block.keyword == key:
            self._take_set(block, parameters, _named(block, parameters, key, table.sets), table)
        elif parameters.get(key):
            _named(block, parameters, key, table.sets).add(table.of_block(block))

    def _take_set(self, block: Block, parameters: _Parameters, members: _Set, table: _Table) -> None:
        if block.keyword == "NSET" and "ELSET" in parameters:
            members.add(self._nodes_of(self.elements.members(parameters["ELSET"])))
        if "GENERATE" in parameters:
            for labels in read_rows(block, lambda items: _range(items, table.what)):
                members.add(table.within(labels))
        else:
            _take_labels(block, members, table)

    def _nodes_of(self, elements: _Indices) -> _Indices:
        counts = np.diff(self.first)[elements]
        before = np.cumsum(counts) - counts
        return np.take(self.connection, np.repeat(self.first[elements] - before, counts) + np.arange(counts.sum()))

    def _take_surface(self, block: Block, parameters: _Parameters) -> None:
        type = complete(squeezed(parameters.get("TYPE", "")) or "ELEMENT", _SURFACE_TYPES)
        if type == "ELEMENT":
            self._take_faces(block, _named(block, parameters, "NAME", self.surfaces))
        elif type == "NODE":
            read_rows(block, _check_alone)
            _take_labels(block, _named(block, parameters, "NAME", self.nodes.sets), self.nodes)
        elif type is None:
            raise Reason(f"*SURFACE: TYPE = {quoted(parameters['TYPE'])} is not read")

    def _take_faces(self, block: Block, surface: _Set) -> None:
        rows = read_rows(block, lambda items: (self.elements.item(items[0]), *_face(items)))
        items = [(k, item) for k, (item, _, _) in enumerate(rows)]
        parts = self.elements.parts(block, items, f"surface {surface.name}")
        for k, (elements, (_, face, of_shells)) in enumerate(zip(parts, rows)):
            wrong = elements[~self.is_shell[elements]] if of_shells else elements[:0]
            if wrong.size:
                what = f"element {self.elements.labels[wrong[0]]} of type {self.element_types[wrong[0]]}"
                raise block.refuse(f"{what} has no faces SPOS and SNEG, which shells have", k)
            # All faces of all elements are counted together.
            surface.add(elements.astype(np.int64) * 8 + face)

    def mesh(self, paths: list[str]) -> Mesh:
        """All of it."""
        faces = {name: np.divmod(surface.members(), 8) for name, surface in self.surfaces.items()}
        return Mesh(
            self.nodes.labels.astype(np.intc),
            np.concatenate(self.positions),
            self.elements.labels.astype(np.intc),
            self.element_types,
            self.first,
            self.connection,
            {name: members.members() for name, members in self.nodes.sets.items()},
            {name: members.members() for name, members in self.elements.sets.items()},
            {name: (element.astype(np.intc), face.astype(np.intc)) for name, (element, face) in faces.items()},
            paths,
        )


def _named(block: Block, parameters: _Parameters, key: str, sets: dict[str, _Set]) -> _Set:
    """The set that a parameter names, a new one if there is none."""
    name = parameters.get(key, "").upper()
    if not name:
        raise Reason(f"*{block.keyword} needs {key} = and a name")
    if len(name) > _NAME_LENGTH:
        raise Reason(f"the name {quoted(name)} has more than {_NAME_LENGTH} characters")
    return sets.setdefault(name, _Set(name))


def _take_labels(block: Block, members: _Set, table: _Table) -> None:
    """Add labels, and members of other sets."""
    plain = plain_labels(block.lines)
    owner = f"set {members.name}"
    if plain is not None:
        numbers, counts = plain
        members.add(table.indices(Labels(block, numbers, np.repeat(np.arange(counts.size), counts)), owner))
        return
    rows = read_rows(block, lambda items: [table.item(item) for item in items])
    for part in table.parts(block, [(k, item) for k, row in enumerate(rows) for item in row], owner):
        members.add(part)


def _range(items: list[str], what: str) -> range:
    """The labels that a line of GENERATE makes."""
    if any(items[3:]):
        raise Reason("more than a first number, a last one and a step")
    first, last = (label(item, what) for item in [*items, ""][:2])
    step = label(items[2], what) if any(items[2:]) else 1
    if first > last:
        raise Reason(f"from {first} to {last}: the first number must not be above the last one")
    if (last - first) // step >= _MOST_GENERATED:
        raise Reason(f"more than {_MOST_GENERATED} members from {first} to {last}")
    return range(first, last + 1, step)


def _check_alone(items: list[str]) -> None:
    if any(items[1:]):
        raise Reason(f"{quoted(items[1])} would be the area of a node, which is not read: write one node in a line")


def _face(items: list[str]) -> tuple[int, bool]:
    """The number of the face behind an element or a set, and whether only shells have it."""
    name = "".join(items[1:2]).upper()
    if any(items[2:]):
        raise Reason(f"{quoted(items[2])} behind the face is not read")
    if not name:
        raise Reason(f"the face of {quoted(items[0])} is missing: write its number, as in S1")
    if name not in _SIDES and not name.startswith("S"):
        raise Reason(f"{quoted(name)} is no face: S1 to S6, SPOS and SNEG are read")
    return _SIDES.get(name) or label(name[1:], "face S", 1, 6), name in _SIDES
