"""Bodies with meshes as one model: all nodes and all degrees of freedom, one body after the other, and their names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Callable, NamedTuple, Optional, TypeVar

import numpy as np
from numpy.typing import NDArray

from fuge.errors import Error
from fuge.formats.text import whole
from fuge.mesh import Mesh
from fuge.stiffness_rows import StiffnessFile

AXES = ("x", "y", "z", "about x", "about y", "about z")
# Names that a message lists.
_LISTED = 40

Refuse = Callable[[str], Error]
"""Makes the error that an option, or a line of a file, is wrong for a reason."""

_Found = TypeVar("_Found")


@dataclass(frozen=True, eq=False)
class MeshBody:
    """A body, rigid without a stiffness matrix; `before` of the nodes of the model are those of bodies before it."""

    name: str
    mesh: Mesh
    stiffness: Optional[StiffnessFile]
    before: int

    @cached_property
    def _places(self) -> dict[int | None, int]:
        return {number: node for node, number in enumerate(self.mesh.node.tolist(), self.before)}

    def nodes(self, name: str) -> NDArray[np.intp] | None:
        """The nodes of a set, of a surface, or the one with this number; None: no such."""
        if name.upper() in self.mesh.node_sets:
            return self.before + self.mesh.node_set(name).astype(np.intp)
        if name.upper() in self.mesh.surfaces:
            members = np.unique(self.mesh.faces(name))
            return self.before + members[members >= 0].astype(np.intp)
        number = whole(name)
        return np.array([self._places[number]]) if number in self._places else None

    def faces(self, name: str) -> Faces | None:
        """The faces of a surface; None: no such."""
        if name.upper() not in self.mesh.surfaces:
            return None
        faces = self.mesh.faces(name)
        width = int((faces >= 0).sum(axis=1).max(initial=0))
        node = np.where(faces >= 0, faces + self.before, -1)[:, :width]
        return Faces(self, node, self.mesh.element_types[self.mesh.faces_of_surfaces[name.upper()][0]])


class Faces(NamedTuple):
    """Faces of a body: their nodes in the model, -1 in unused places, and the types of their elements."""

    body: MeshBody
    node: NDArray[np.intp]
    type: NDArray[np.str_]


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
    position : ndarray, shape (nodes, 3)
    number, owner : ndarray of int, shape (nodes,)
        Number in the file, and index of the body.
    row : ndarray of int, shape (nodes, 6)
        Row of each direction, -1 where the stiffness has none.
    load, displacement, held : ndarray, shape (rows,)
        Forces, displacements of supports, and whether there is one.
    row_owner, row_node, row_direction : ndarray of int, shape (rows,)
        Index of the body, and the name in the file.
    """

    def __init__(self, bodies: Sequence[MeshBody]) -> None:
        self.bodies = list(bodies)
        matrices = [(k, body.stiffness) for k, body in enumerate(bodies) if body.stiffness is not None]
        self.position = np.concatenate([body.mesh.position for body in bodies])
        self.number = np.concatenate([body.mesh.node for body in bodies])
        self.owner = np.repeat(np.arange(len(bodies)), [body.mesh.node.size for body in bodies])
        self.row_owner = np.repeat([k for k, _ in matrices], [matrix.shape[0] for _, matrix in matrices])
        self.row_node = np.concatenate([matrix.node for _, matrix in matrices])
        self.row_direction = np.concatenate([matrix.direction for _, matrix in matrices])
        self.row = np.full((self.number.size, len(AXES)), -1)
        self.load, self.displacement = np.zeros((2, self.row_owner.size))
        self.held = np.zeros(self.row_owner.size, dtype=bool)

    def node_name(self, node: int) -> str:
        """A node as options name it."""
        return f"{self.bodies[self.owner[node]].name}.{self.number[node]}"

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
