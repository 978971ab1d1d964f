"""Bodies with meshes, as options name them, as one model: all nodes and all rows, one body after the other."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Callable, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from fuge.command.checks import check_input
from fuge.command.errors import CommandError, UsageError
from fuge.command.options import Options, Setting
from fuge.command.run import Log
from fuge.errors import Error, Status
from fuge.formats.mesh_input import read_mesh
from fuge.formats.stiffness import read_stiffness
from fuge.formats.text import quoted_path, whole
from fuge.mesh import join_meshes

AXES = ("x", "y", "z", "about x", "about y", "about z")
# CalculiX computes elements CAX on a sector of 2 degrees, and takes loads for the whole ring.
_SECTORS = 180
# Names that a message lists.
_LISTED = 40

Refuse = Callable[[str], Error]
"""Makes the error that an option, or a line of a file, is wrong for a reason."""

_Found = TypeVar("_Found")
_Part = dict[str, Setting]


class Faces(NamedTuple):
    """Faces of a body: their nodes in the model, -1 in unused places, and the types of their elements."""

    body: MeshBody
    node: NDArray[np.intp]
    type: NDArray[np.str_]


class MeshBody:
    """A body with the options of it, rigid without a stiffness matrix; `before` nodes of the model are before its own.

    Raises
    ------
    UsageError
        Options are missing, or a result would overwrite what the mesh includes.
    FileError
        A file cannot be read.
    """

    def __init__(self, given: Options, log: Log, name: str, part: _Part, before: int) -> None:
        self.name, self.part, self.before = name, part, before
        self.mesh = read_mesh(part["mesh"].path())
        for path in self.mesh.paths:
            check_input(given, path, "the same file as of --mesh or of an *INCLUDE in it")
        log.say(f"mesh of {name}: {self.mesh.node.size} nodes, {self.mesh.element.size} elements")
        self.places: dict[int | None, int] = {number: k for k, number in enumerate(self.mesh.node.tolist(), before)}
        self.stiffness = None
        if "stiffness" in part:
            names = part["rows"].path() if "rows" in part else None
            matrix = part["matrix"].value if "matrix" in part else None
            path = part["stiffness"].path()
            self.stiffness = read_stiffness(path, names_path=names, name=matrix)
            log.say(f"stiffness of {name}: {self.stiffness.shape[0]} rows, {self.stiffness.row.size} entries")
            if path.lower().endswith(".sti") and any(map(is_ring, self.mesh.element_types)):
                self.stiffness = replace(self.stiffness, value=_SECTORS * self.stiffness.value)
                log.note(f"{quoted_path(path)} is multiplied by {_SECTORS}: CalculiX has 2 degrees of a ring")
            return
        for option in part.keys() & {"rows", "matrix"}:
            raise part[option].refuse("its body has no --stiffness")

    def nodes(self, name: str) -> NDArray[np.intp] | None:
        """The nodes of a set, of a surface, or the one with this number; None: no such."""
        if name.upper() in self.mesh.node_sets:
            return self.before + self.mesh.node_set(name).astype(np.intp)
        if name.upper() in self.mesh.surfaces:
            members = np.unique(self.mesh.faces(name))
            return self.before + members[members >= 0].astype(np.intp)
        number = whole(name)
        return np.array([self.places[number]]) if number in self.places else None

    def faces(self, name: str) -> Faces | None:
        """The faces of a surface; None: no such."""
        if name.upper() not in self.mesh.surfaces:
            return None
        faces = self.mesh.faces(name)
        width = int((faces >= 0).sum(axis=1).max(initial=0))
        node = np.where(faces >= 0, faces + self.before, -1)[:, :width]
        return Faces(self, node, self.mesh.element_types[self.mesh.faces_of_surfaces[name.upper()][0]])


def dimensions_of(name: str) -> int:
    """Dimensions of the faces of elements of this type: 2 for edges in the plane."""
    return 2 if name.startswith(("CPS", "CPE", "CAX")) else 3


def is_ring(name: str) -> bool:
    """Whether elements of this type are those of a body of revolution."""
    return name.startswith("CAX")


class MeshModel:
    """All bodies.

    Attributes
    ----------
    bodies : list of MeshBody
    mesh : Mesh
        That of all bodies, without sets and surfaces.
    owner : ndarray of int, shape (nodes,)
        Index of the body.
    row : ndarray of int, shape (nodes, 6)
        Row of each direction, -1 where the stiffness has none.
    load, displacement, held : ndarray, shape (rows,)
        Forces, displacements of supports, and whether there is one.
    row_owner, row_node, row_direction : ndarray of int, shape (rows,)
        Index of the body, and the name in the file.

    Raises
    ------
    UsageError
        Options of a body are missing or given twice, names of bodies cannot be told apart, or a result would overwrite
        what a mesh includes.
    FileError
        A file cannot be read, or mesh and matrix are not of one body.
    """

    def __init__(self, given: Options, log: Log) -> None:
        self.bodies: list[MeshBody] = []
        before = 0
        for name, part in _named_parts(given).items():
            self.bodies.append(MeshBody(given, log, name, part, before))
            before += self.bodies[-1].mesh.node.size
        self.mesh = join_meshes([body.mesh for body in self.bodies])
        self.owner = np.repeat(np.arange(len(self.bodies)), [body.mesh.node.size for body in self.bodies])
        matrices = [(k, body.stiffness) for k, body in enumerate(self.bodies) if body.stiffness is not None]
        self.row_owner = np.repeat([k for k, _ in matrices], [matrix.shape[0] for _, matrix in matrices])
        self.row_node = np.concatenate([matrix.node for _, matrix in matrices])
        self.row_direction = np.concatenate([matrix.direction for _, matrix in matrices])
        self.load, self.displacement = np.zeros((2, self.row_owner.size))
        self.held = np.zeros(self.row_owner.size, dtype=bool)
        self.row = np.full((before, len(AXES)), -1)
        for k, _ in matrices:
            self._name_rows(k, self.bodies[k])

    def _name_rows(self, k: int, body: MeshBody) -> None:
        """Find the rows of the nodes of body k; those of nodes that the mesh does not have stay."""
        rows = np.flatnonzero(self.row_owner == k)
        node = np.array([body.places.get(number, -1) for number in self.row_node[rows].tolist()], dtype=np.intp)
        axis = self.row_direction[rows] - 1
        known = (node >= 0) & (axis >= 0) & (axis < len(AXES))
        if not known.any():
            reason = f"has no row of a node of {quoted_path(body.part['mesh'].path())}: they are not of the same body"
            if not self.row_node[rows].any():
                reason = "has rows without names: give the node and the direction of each by --rows"
            raise CommandError(f"{quoted_path(body.part['stiffness'].path())} {reason}", Status.ERR_FILE)
        self.row[node[known], axis[known]] = rows[known]

    def node_name(self, node: int) -> str:
        """A node as options name it."""
        return f"{self.bodies[self.owner[node]].name}.{self.mesh.node[node]}"

    def row_name(self, row: int) -> str:
        """The node and the direction of a row."""
        direction = int(self.row_direction[row])
        axis = AXES[direction - 1] if 1 <= direction <= len(AXES) else str(direction)
        return f"node {self.bodies[self.row_owner[row]].name}.{self.row_node[row]} along {axis}"

    def find_faces(self, word: str, refuse: Refuse) -> Faces:
        """The faces of body.SURFACE, or of SURFACE where only one body has it."""
        return self._find(word, refuse, "surface", MeshBody.faces)

    def find_nodes(self, word: str, refuse: Refuse) -> NDArray[np.intp]:
        """The nodes of body.NODES, or of NODES where only one body has them."""
        nodes = self._find(word, refuse, "set of nodes", MeshBody.nodes)
        if nodes.size == 0:
            raise refuse(f'"{word}" is empty')
        return nodes

    def _find(self, word: str, refuse: Refuse, what: str, look: Callable[[MeshBody, str], _Found | None]) -> _Found:
        head, point, tail = word.partition(".")
        named = [body for body in self.bodies if point and body.name.upper() == head.upper()]
        bodies, name = (named, tail) if named else (self.bodies, word)
        found = [(body.name, thing) for body in bodies for thing in [look(body, name)] if thing is not None]
        if len(found) == 1:
            return found[0][1]
        if found:
            first, second = (body for body, _ in found[:2])
            choice = f"write {second}.{name} or {first}.{name}"
            raise refuse(f'bodies {first} and {second} both have "{name}": {choice}')
        lacks = f"body {named[0].name} has no" if named else "there is no"
        if what != "surface" and whole(name) is not None:
            raise refuse(f"{lacks} node {name}")
        raise refuse(f'{lacks} {what} "{name}"{_names(bodies, what)}')


def _names(bodies: Sequence[MeshBody], what: str) -> str:
    """The names that there are, for messages."""
    names = []
    for body in bodies:
        sets = [] if what == "surface" else body.mesh.node_sets
        names += [f"{body.name}.{name}" for name in (*sets, *body.mesh.surfaces)]
    if names:
        return f"; there are {', '.join(names[:_LISTED])}{', ..' * (len(names) > _LISTED)}"
    card = "*SURFACE, TYPE=ELEMENT" if what == "surface" else "*NSET"
    return f" and no other one: {card} in the mesh makes one"


# ---- options


def _named_parts(given: Options) -> dict[str, _Part]:
    """The options of each body by its name, that of --body or of the file of its mesh."""
    parts: dict[str, _Part] = {}
    for part in _parts(given):
        if "mesh" not in part:
            raise next(iter(part.values())).refuse("its body has no --mesh")
        base = os.path.basename(part["mesh"].path())
        name = part["body"].value if "body" in part else base.partition(".")[0] or base
        if re.search(r"[.:,=\s]", name) or not name:
            reason = "has a point, colon, comma, equals sign or blank, or no letter: give another one by --body"
            raise UsageError(f'the name of body "{name}" {reason}')
        if name.upper() in map(str.upper, parts):
            raise UsageError(f'two bodies have the name "{name}": give others by --body')
        parts[name] = part
    return parts


def _parts(given: Options) -> Iterator[_Part]:
    """The options of each body: --body begins one, and so does a second --mesh or --stiffness."""
    part: _Part = {}
    for setting in given.settings:
        name = setting.name
        if name not in ("body", "mesh", "stiffness", "rows", "matrix"):
            continue
        if part and (name == "body" or (name in part and name in ("mesh", "stiffness"))):
            yield part
            part = {}
        if name in part:
            raise setting.refuse("its body has one already")
        part[name] = setting
    yield part
