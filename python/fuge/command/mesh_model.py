"""Bodies with meshes as one model: all nodes and all degrees of freedom, one body after the other, and their names."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Callable, NamedTuple, Optional, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix

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
    """A body, rigid without a stiffness matrix; its nodes and rows follow `before` and `rows_before` in the model."""

    name: str
    mesh: Mesh
    stiffness: Optional[StiffnessFile]
    before: int
    rows_before: int

    @property
    def rows(self) -> int:
        """Number of degrees of freedom."""
        return 0 if self.stiffness is None else self.stiffness.shape[0]

    def nodes(self, name: str) -> NDArray[np.intp] | None:
        """Indices in the model of the nodes of a set, of a surface, or of the one with this number; None: no such."""
        if name.upper() in self.mesh.node_sets:
            return self.before + self.mesh.node_set(name).astype(np.intp)
        if name.upper() in self.mesh.surfaces:
            members = np.unique(self.mesh.faces(name))
            return self.before + members[members >= 0].astype(np.intp)
        number = whole(name)
        found = np.flatnonzero(self.mesh.node == number) if number is not None else np.empty(0, dtype=np.intp)
        return self.before + found if found.size else None

    def faces(self, name: str) -> Faces | None:
        """The faces of a surface; None: no such."""
        if name.upper() not in self.mesh.surfaces:
            return None
        faces = self.mesh.faces(name)
        width = int((faces >= 0).sum(axis=1).max(initial=0))
        node = np.where(faces >= 0, faces + self.before, -1)[:, :width]
        return Faces(self, node, np.array(_face_types(self.mesh, faces), dtype=str))


class Faces(NamedTuple):
    """Faces of a body: nodes in the model, -1 in unused places, and the type of the element of each."""

    body: MeshBody
    node: NDArray[np.intp]
    type: NDArray[np.str_]


# Types of elements that have faces.
_FACED = re.compile("C3D|CPS|CPE|CAX|M3D|R3D|S[3468]")


def _face_types(mesh: Mesh, faces: NDArray[np.intc]) -> list[str]:
    """Types of the elements that have all nodes of a face."""
    used = faces >= 0
    first = np.append(0, np.cumsum(used.sum(axis=1)))
    of_faces = csr_matrix((np.ones(first[-1]), faces[used], first), shape=(len(faces), mesh.node.size))
    connection = (np.ones(mesh.connection.size), mesh.connection, mesh.first)
    shared = (of_faces @ csr_matrix(connection, shape=(mesh.element.size, mesh.node.size)).T).tocoo()
    types: dict[int, str] = {}
    for face, element, nodes in zip(shared.row.tolist(), shared.col.tolist(), shared.data):
        if nodes == used[face].sum() and _FACED.match(mesh.element_type(element)):
            types.setdefault(face, mesh.element_type(element))
    return [types[face] for face in range(len(faces))]


def is_plane(element_type: str) -> bool:
    """Whether faces of elements of this type are edges in the plane."""
    return element_type.startswith(("CPS", "CPE", "CAX"))


class MeshModel:
    """All bodies.

    Attributes
    ----------
    bodies, elastic : sequence of MeshBody
        All, and those that are not rigid.
    position : ndarray, shape (nodes, 3)
    number, owner : ndarray of int, shape (nodes,)
        Number in the file, and the body.
    row : ndarray of int, shape (nodes, 6)
        Row of each direction, -1 where the stiffness has none.
    load, displacement, held : ndarray, shape (rows,)
        Forces, displacements of supports, and whether there is one.
    row_body, row_node, row_direction : ndarray of int, shape (rows,)
        Body of each row, and its name in the file.
    """

    def __init__(self, bodies: Sequence[MeshBody]) -> None:
        self.bodies = bodies
        self.elastic = [body for body in bodies if body.stiffness is not None]
        sizes = [body.mesh.node.size for body in bodies]
        matrices = [(k, body.stiffness) for k, body in enumerate(bodies) if body.stiffness is not None]
        self.position = np.concatenate([body.mesh.position for body in bodies])
        self.number = np.concatenate([body.mesh.node for body in bodies])
        self.owner = np.repeat(np.arange(len(bodies)), sizes)
        self.row_body = np.repeat([k for k, _ in matrices], [matrix.shape[0] for _, matrix in matrices])
        self.row_node = np.concatenate([matrix.node for _, matrix in matrices])
        self.row_direction = np.concatenate([matrix.direction for _, matrix in matrices])
        self.row = np.full((self.number.size, len(AXES)), -1)
        self.load, self.displacement = np.zeros(self.row_body.size), np.zeros(self.row_body.size)
        self.held = np.zeros(self.row_body.size, dtype=bool)

    def node_name(self, node: int) -> str:
        """A node as options name it."""
        return f"{self.bodies[self.owner[node]].name}.{self.number[node]}"

    def row_name(self, row: int) -> str:
        """The node and the direction of a row."""
        direction = int(self.row_direction[row])
        axis = AXES[direction - 1] if 1 <= direction <= len(AXES) else str(direction)
        return f"node {self.bodies[self.row_body[row]].name}.{self.row_node[row]} along {axis}"

    def find_faces(self, word: str, refuse: Refuse) -> Faces:
        """The faces of body.SURFACE, or of SURFACE where only one body has it."""
        return self._find(word, refuse, "surface", MeshBody.faces)

    def find_nodes(self, word: str, refuse: Refuse) -> NDArray[np.intp]:
        """The nodes of body.NODES, or of NODES where only one body has them."""
        nodes = self._find(word, refuse, "set of nodes", MeshBody.nodes)
        if nodes.size == 0:
            raise refuse(f'"{word}" is empty')
        return nodes

    def _find(
        self, word: str, refuse: Refuse, what: str, look: Callable[[MeshBody, str], Optional[_Found]]
    ) -> _Found:
        head, point, tail = word.partition(".")
        named = [body for body in self.bodies if point and body.name.upper() == head.upper()]
        candidates, name = (named, tail) if named else (self.bodies, word)
        found = [(body.name, thing) for body in candidates for thing in [look(body, name)] if thing is not None]
        if len(found) == 1:
            return found[0][1]
        if found:
            first, second = (body for body, _ in found[:2])
            choice = f"write {second}.{name} or {first}.{name}"
            raise refuse(f'bodies {first} and {second} both have "{name}": {choice}')
        lacks = f"body {named[0].name} has no" if named else "there is no"
        if what != "surface" and whole(name) is not None:
            raise refuse(f"{lacks} node {name}")
        raise refuse(f'{lacks} {what} "{name}"{_names(candidates, what)}')


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
