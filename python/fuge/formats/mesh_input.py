"""Meshes in input files of Abaqus and CalculiX: nodes, elements, sets and surfaces."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from fuge.element_faces import is_shell
from fuge.errors import FileError
from fuge.formats.keyword import Block, complete, squeezed, unquoted
from fuge.formats.mesh_lines import Run, plain_labels, read_elements, read_nodes, read_rows
from fuge.formats.text import PathLike, Reason, label, quoted, refusal
from fuge.mesh import Mesh

_Indices = NDArray[np.intp]
_Item = Union[int, _Indices]
"""A label, or the members of a set."""

_NAME_LENGTH, _TYPE_LENGTH = 80, 16
_MOST_GENERATED = 20000000

# Keywords that make, move or take away nodes and elements.
_REFUSED = """
    ELCOPY ELGEN IMPERFECTION IMPORT INSTANCE NCOPY NFILL NGEN NMAP PART REFINEMESH SYMMETRICMODELGENERATION SYSTEM
    USEREFINEDMESH
""".split()

# Parameters that are read, or change nothing; and what to do instead of those that are not read.
_PARAMETERS = {
    "NODE": "NSET SYSTEM",
    "ELEMENT": "TYPE ELSET",
    "NSET": "NSET ELSET GENERATE INTERNAL UNSORTED",
    "ELSET": "ELSET GENERATE INTERNAL UNSORTED",
    "SURFACE": "NAME TYPE FILLETRADIUS INTERNAL MAXRATIO REGIONTYPE TRIM",
}
# The set to which a block adds.
_SETS = {"NODE": "NSET", "NSET": "NSET", "ELEMENT": "ELSET", "ELSET": "ELSET"}

_REMEDIES = {"INPUT": "use *INCLUDE", "COMBINE": "list its faces", "CROP": "list its faces"}

# Surfaces of other types than the first two are skipped: they are no faces of elements.
_SURFACE_TYPES = "ELEMENT NODE CUTTINGSURFACE CYLINDER EULERIANMATERIAL REVOLUTION SEGMENTS USER XFEM".split()

# Faces S1 .. are numbered by their element and 1 .., sides of shells by 6 more.
_FACES = 16
_SIDES = {"SNEG": 7, "SPOS": 8}

# A set joins so many new members at once, or more if it has more already.
_AT_ONCE = 100000


def mesh_of(blocks: Iterable[Block], path: PathLike, paths: Sequence[str] = ()) -> Mesh:
    """The mesh of the blocks of a file; `paths` are those of all files that they come from.

    Raises
    ------
    FileError
        A line cannot be read, or a keyword makes another mesh of it.
    """
    reader = _Reader()
    read = []
    for block in blocks:
        parameters = _parameters(block)
        if parameters is not None:
            read.append((block, parameters, reader.read_items(block, parameters)))
    if not reader.positions:
        raise refusal(path, "there is no *NODE: is it an input file of Abaqus or CalculiX?")
    reader.number()
    # Sets and surfaces may stand above their members.
    for block, parameters, items in read:
        reader.read_members(block, parameters, items)
    return reader.mesh(list(paths))


def _parameters(block: Block) -> dict[str, str] | None:
    """The parameters of a keyword that is read, None if it is skipped."""
    if block.keyword in _REFUSED:
        reason = "is not read, and without it the mesh would be another one: write a file that lists all nodes and"
        raise block.refuse(f"*{block.keyword} {reason} elements")
    if block.keyword not in _PARAMETERS:
        return None
    parameters = block.named([*_PARAMETERS[block.keyword].split(), *_REMEDIES])
    for name, remedy in _REMEDIES.items():
        if name in parameters:
            raise block.refuse(f"*{block.keyword}: {name} = is not read here: {remedy}")
    return parameters


class _Set:
    """Members in their order, each once."""

    def __init__(self) -> None:
        self._parts = [np.empty(0, dtype=np.intp)]
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
        self.runs: list[Run] = []
        self.count = 0
        self.sets: dict[str, _Set] = {}

    def add(self, run: Run) -> range:
        """The indices of new labels."""
        self.runs.append(run)
        self.count += run.labels.size
        return range(self.count - run.labels.size, self.count)

    def number(self) -> None:
        """Make it ready to find labels."""
        self.labels = np.concatenate([np.empty(0, dtype=np.int64), *(run.labels for run in self.runs)])
        order = np.argsort(self.labels, kind="stable")
        # Behind the labels stands 0, which is none.
        self._order, self._sorted = np.append(order, -1), np.append(self.labels[order], 0)
        again = self._order[1:][self._sorted[1:] == self._sorted[:-1]]
        if again.size:
            raise self.refuse(int(again.min()), f"{self.what} {self.labels[again.min()]} is defined a second time")

    def refuse(self, k: int, reason: str) -> FileError:
        """The error that item k cannot be used, at its line."""
        for run in self.runs:
            if k < run.labels.size:
                break
            k -= run.labels.size
        return run.block.refuse(reason, int(run.lines[k]))

    def find(self, labels: NDArray[np.int64]) -> _Indices:
        """Indices of labels, -1 where there is none."""
        place = np.searchsorted(self._sorted[:-1], labels)
        return np.where(self._sorted[place] == labels, self._order[place], -1)

    def within(self, labels: range) -> _Indices:
        """Indices of those labels of a range that exist."""
        begin, end = np.searchsorted(self._sorted[:-1], [labels.start, labels.stop])
        return self._order[begin:end][(self._sorted[begin:end] - labels.start) % labels.step == 0]

    def item(self, text: str) -> _Item:
        """A label, or the members that a set has so far."""
        if not text or text[0] in "0123456789+-.":
            return label(text, self.what)
        name = unquoted(text).upper()
        if name not in self.sets:
            raise Reason(f"the {self.what} set {quoted(name)} is not defined above")
        return self.sets[name].members()

    def indices(self, block: Block, labels: NDArray[np.int64], lines: _Indices, owner: str) -> _Indices:
        """Indices of labels that stand in lines of a block; -1 for the label 0."""
        found = self.find(labels)
        missing = np.flatnonzero((found < 0) & (labels > 0))
        if missing.size:
            reason = f"{self.what} {labels[missing[0]]} of the {owner} is not defined in any file"
            raise block.refuse(reason, int(lines[missing[0]]))
        return found

    def parts(self, block: Block, items: list[_Item], lines: list[int], owner: str) -> Iterator[_Indices]:
        """Indices of each label, or the members of each set, that stand in lines of a block."""
        labels = np.array([item if isinstance(item, int) else 0 for item in items], dtype=np.int64)
        found = self.indices(block, labels, np.array(lines), owner)
        for k, item in enumerate(items):
            yield found[k : k + 1] if isinstance(item, int) else item


def _named(block: Block, parameters: dict[str, str], key: str, sets: dict[str, _Set]) -> _Set:
    """The set that a parameter names, a new one if there is none."""
    name = parameters.get(key, "").upper()
    if not name:
        raise block.refuse(f"*{block.keyword} needs {key} = and a name")
    if len(name) > _NAME_LENGTH:
        raise block.refuse(f"the name {quoted(name)} has more than {_NAME_LENGTH} characters")
    return sets.setdefault(name, _Set())


class _Reader:
    """Nodes and elements first, then sets and surfaces."""

    def __init__(self) -> None:
        self.nodes, self.elements = _Table("node"), _Table("element")
        self.tables = {"NSET": self.nodes, "ELSET": self.elements}
        self.positions: list[NDArray[np.float64]] = []
        self.types: list[str] = []
        self.counts, self.node_labels = [np.zeros(1, dtype=np.intp)], [np.empty(0, dtype=np.int64)]
        self.surfaces: dict[str, _Set] = {}

    def read_items(self, block: Block, parameters: dict[str, str]) -> range:
        """Read nodes or elements and return their indices."""
        if block.keyword == "NODE":
            system = squeezed(parameters.get("SYSTEM", ""))
            if system not in ("", "R"):
                raise block.refuse(f"SYSTEM = {system} is not read: write rectangular coordinates")
            if block.lines:
                run, positions = read_nodes(block)
                self.positions.append(positions)
                return self.nodes.add(run)
        elif block.keyword == "ELEMENT":
            type = squeezed(parameters.get("TYPE", ""))
            if not (0 < len(type) <= _TYPE_LENGTH and type.isascii() and type.isprintable()):
                raise block.refuse(f"*ELEMENT needs TYPE = and a type of at most {_TYPE_LENGTH} characters")
            if block.lines:
                run, counts, nodes = read_elements(block, type)
                self.types.append(type)
                self.counts.append(counts)
                self.node_labels.append(nodes)
                return self.elements.add(run)
        return range(0)

    def number(self) -> None:
        """Find the indices of nodes and elements."""
        self.nodes.number()
        self.elements.number()
        sizes = [counts.size for counts in self.counts[1:]]
        self.element_types = np.repeat(np.array(self.types, dtype=np.str_), sizes)
        self.is_shell = np.repeat(np.array([is_shell(type) for type in self.types], dtype=bool), sizes)
        self.first = np.cumsum(np.concatenate(self.counts))
        labels = np.concatenate(self.node_labels)
        self.connection = self.nodes.find(labels)
        missing = np.flatnonzero(self.connection < 0)
        if missing.size:
            element = int(np.searchsorted(self.first, missing[0], side="right")) - 1
            reason = f"node {labels[missing[0]]} of element {self.elements.labels[element]} is not defined in any file"
            raise self.elements.refuse(element, reason)

    def read_members(self, block: Block, parameters: dict[str, str], items: range) -> None:
        """Add to sets and surfaces what a block says; `items` are the nodes or elements that it has."""
        key = _SETS.get(block.keyword)
        if key is None:
            self._read_surface(block, parameters)
        elif block.keyword == key:
            self._read_set(block, parameters, key)
        elif parameters.get(key):
            _named(block, parameters, key, self.tables[key].sets).add(np.arange(items.start, items.stop))

    def _read_set(self, block: Block, parameters: dict[str, str], key: str) -> None:
        table = self.tables[key]
        members = _named(block, parameters, key, table.sets)
        if key == "NSET" and "ELSET" in parameters:
            try:
                members.add(self._nodes_of(self.elements.item(f'"{parameters["ELSET"]}"')))
            except Reason as reason:
                raise block.refuse(reason) from None
        if "GENERATE" in parameters:
            for labels in read_rows(block, lambda items: _range(items, table.what)):
                members.add(table.within(labels))
        else:
            self._read_labels(block, members, table, f"set {parameters[key].upper()}")

    def _nodes_of(self, elements: _Item) -> _Indices:
        counts = np.diff(self.first)[elements]
        before = np.cumsum(counts) - counts
        return self.connection[np.repeat(self.first[elements] - before, counts) + np.arange(counts.sum())]

    def _read_labels(self, block: Block, members: _Set, table: _Table, owner: str) -> None:
        plain = plain_labels(block.lines)
        if plain is not None:
            labels, counts = plain
            members.add(table.indices(block, labels, np.repeat(np.arange(counts.size), counts), owner))
            return
        rows = read_rows(block, lambda items: [table.item(item) for item in items])
        items = [(item, k) for k, row in enumerate(rows) for item in row]
        for part in table.parts(block, [item for item, _ in items], [k for _, k in items], owner):
            members.add(part)

    def _read_surface(self, block: Block, parameters: dict[str, str]) -> None:
        given = squeezed(parameters.get("TYPE", "")) or "ELEMENT"
        try:
            type = complete(given, _SURFACE_TYPES)
        except Reason as reason:
            raise block.refuse(f"*SURFACE: TYPE = {reason}") from None
        if type is None:
            raise block.refuse(f"*SURFACE: TYPE = {quoted(given)} is not read")
        if type == "ELEMENT":
            surface = _named(block, parameters, "NAME", self.surfaces)
            self._read_faces(block, surface, f"surface {parameters['NAME'].upper()}")
        elif type == "NODE":
            members = _named(block, parameters, "NAME", self.nodes.sets)
            read_rows(block, _alone)
            self._read_labels(block, members, self.nodes, f"surface {parameters['NAME'].upper()}")

    def _read_faces(self, block: Block, surface: _Set, owner: str) -> None:
        rows = read_rows(block, lambda items: (self.elements.item(items[0]), _face(items)))
        parts = self.elements.parts(block, [item for item, _ in rows], list(range(len(rows))), owner)
        for k, (elements, (_, face)) in enumerate(zip(parts, rows)):
            if face in _SIDES.values() and not np.all(self.is_shell[elements]):
                element = self.elements.labels[elements[~self.is_shell[elements]][0]]
                raise block.refuse(f"element {element} has no faces SPOS and SNEG, which shells have", k)
            surface.add(_FACES * elements + face)

    def mesh(self, paths: list[str]) -> Mesh:
        """The mesh in indices."""
        faces = {name: np.divmod(surface.members(), _FACES) for name, surface in self.surfaces.items()}
        return Mesh(
            _ints(self.nodes.labels),
            np.concatenate(self.positions),
            _ints(self.elements.labels),
            self.element_types,
            _ints(self.first),
            _ints(self.connection),
            {name: _ints(members.members()) for name, members in self.nodes.sets.items()},
            {name: _ints(members.members()) for name, members in self.elements.sets.items()},
            {
                name: (_ints(element), _ints(np.where(face > 6, face - 6, face)))
                for name, (element, face) in faces.items()
            },
            paths,
        )


def _ints(values: NDArray[Any]) -> NDArray[np.intc]:
    return values.astype(np.intc)


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


def _alone(items: list[str]) -> None:
    if any(items[1:]):
        raise Reason(f"{quoted(items[1])} would be the area of a node, which is not read: write one node in a line")


def _face(items: list[str]) -> int:
    """The number of a face behind an element or a set."""
    if any(items[2:]):
        raise Reason(f"{quoted(items[2])} behind the face is not read")
    name = "".join(items[1:2]).upper()
    if not name:
        raise Reason(f"the face of {quoted(items[0])} is missing: write its number, as in S1")
    if name in _SIDES:
        return _SIDES[name]
    if not name.startswith("S"):
        raise Reason(f"{quoted(name)} is no face: S1 to S6, SPOS and SNEG are read")
    return label(name[1:], "face S", 1, 6)
