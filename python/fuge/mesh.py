"""Meshes of finite elements: from input files of Abaqus and CalculiX, and to files for ParaView."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import Handle, call, new_handle
from fuge.element_faces import MOST_FACE_NODES, element_type, face_nodes
from fuge.errors import InputError, Status, error
from fuge.formats.text import PathLike, quoted
from fuge.mesh_rows import DIRECTIONS, rows_of_nodes
from fuge.pairs import Surface
from fuge.stiffness_rows import StiffnessFile

# Names that a message or repr lists.
_MOST_LISTED = 12

# A face looks into its element if the sine of the angle between it and the way to the middle is above this.
_INSIDE = 1.0e-3

_Value = TypeVar("_Value")


@dataclass(frozen=True, eq=False, repr=False)
class Mesh:
    """Nodes, elements, sets and surfaces; indices in its arrays count from 0.

    Made by :func:`read_mesh`, :meth:`from_arrays` or :func:`join_meshes`.

    Attributes
    ----------
    node : ndarray of int, shape (nodes,)
        Number of each node in the file.
    position : ndarray, shape (nodes, 3)
        Length.
    element : ndarray of int, shape (elements,)
        Number of each element in the file.
    element_types : ndarray of str, shape (elements,)
        In upper case, such as C3D8.
    first, connection : ndarray of int
        Element k has the nodes with the indices connection[first[k]:first[k + 1]].
    nodes_of_sets, elements_of_sets : dict of ndarray of int
        Indices of the members of each set, by its name in upper case.
    faces_of_surfaces : dict of tuple of ndarray of int
        Indices of the elements of each surface, and the numbers 1, 2 .. of their faces; of a shell 1 is SNEG, 2 SPOS.
    paths : list of str
        All files that have been read.
    """

    node: NDArray[np.intc]
    position: NDArray[np.float64]
    element: NDArray[np.intc]
    element_types: NDArray[np.str_]
    first: NDArray[np.intc]
    connection: NDArray[np.intc]
    nodes_of_sets: dict[str, NDArray[np.intc]] = field(default_factory=dict)
    elements_of_sets: dict[str, NDArray[np.intc]] = field(default_factory=dict)
    faces_of_surfaces: dict[str, tuple[NDArray[np.intc], NDArray[np.intc]]] = field(default_factory=dict)
    paths: list[str] = field(default_factory=list)

    def __repr__(self) -> str:
        parts = [
            f"{self.node.size} nodes",
            f"{self.element.size} elements {_listed(sorted(set(self.element_types.tolist())))}",
        ]
        for what, names in (("node sets", self.nodes_of_sets), ("surfaces", self.faces_of_surfaces)):
            parts += [f"{what} {_listed(names)}"] if names else []
        return f"<Mesh: {', '.join(parts)}>"

    @property
    def node_sets(self) -> list[str]:
        """Names of the sets of nodes, in upper case."""
        return list(self.nodes_of_sets)

    @property
    def element_sets(self) -> list[str]:
        """Names of the sets of elements."""
        return list(self.elements_of_sets)

    @property
    def surfaces(self) -> list[str]:
        """Names of the surfaces."""
        return list(self.faces_of_surfaces)

    @classmethod
    def from_arrays(cls, position: ArrayLike, element: ArrayLike, type: str | Sequence[str]) -> Mesh:
        """Make a mesh without sets and surfaces, for example to write it.

        Parameters
        ----------
        position : array_like, shape (nodes, 2) or (nodes, 3)
            Length.
        element : array_like of int, shape (elements, most)
            Nodes of each element, from 0, in the order of Abaqus and CalculiX; -1 in unused places, at the end.
        type : str, or one for each element
            Such as 'C3D8' or 'CPE4'.

        Raises
        ------
        InputError
            Numbers or sizes do not fit, or an element has another number of nodes than its type.
        """
        places = _arrays.doubles("position", position, (None, 2), (None, 3))
        elements = _arrays.integers("element", element, (None, None))
        types = [type] if isinstance(type, str) else list(type)
        # The library checks all of it.
        _made(places, elements, types).close()
        used = elements >= 0
        return cls(
            np.arange(1, len(places) + 1, dtype=np.intc),
            np.pad(places, ((0, 0), (0, 3 - places.shape[1]))),
            np.arange(1, len(elements) + 1, dtype=np.intc),
            np.char.upper(np.broadcast_to(types, len(elements))),
            np.append(0, np.cumsum(used.sum(1))).astype(np.intc),
            elements[used],
        )

    def write(
        self,
        path: PathLike,
        node_fields: Mapping[str, ArrayLike] | None = None,
        element_fields: Mapping[str, ArrayLike] | None = None,
    ) -> None:
        """Write the mesh and fields to a VTK file (.vtu), which ParaView reads; an existing file is replaced.

        Parameters
        ----------
        path : str or path
        node_fields, element_fields : dict of array_like, optional
            By their names; shape (nodes,) or (elements,), followed by 2 or 3 for a vector.

        Raises
        ------
        InputError
            Fields do not fit, or VTK does not have the type of an element.
        FileError
            The file cannot be written.
        """
        fields: list[NDArray[np.float64]] = []
        names: list[str] = []
        at_elements: list[int] = []
        for given, count in ((node_fields, self.node.size), (element_fields, self.element.size)):
            for name, value in (given or {}).items():
                fields.append(_arrays.doubles(f"the field {name!r}", value, (count,), (count, 2), (count, 3)))
                names.append(name)
                at_elements.append(int(given is not node_fields))
        components = np.array([field.shape[1] if field.ndim == 2 else 1 for field in fields], dtype=np.intc)
        where = np.array(at_elements, dtype=np.intc)
        arguments = [len(names), _arrays.texts(names), components, where, _arrays.addresses(fields)]
        counts = np.diff(self.first)
        elements = np.full((counts.size, counts.max(initial=1)), -1, dtype=np.intc)
        elements[np.arange(elements.shape[1]) < counts[:, None]] = self.connection
        types = self.element_types.tolist()
        # A mesh without elements has a type too.
        handle = _made(self.position, elements, types if len(set(types)) > 1 else [*types, ""][:1])
        try:
            call("fuge_write_mesh", os.fsencode(path), handle.pointer, *arguments)
        except InputError as failure:
            # The handle numbers elements from 1.
            message = re.sub(r"^element (\d+)", lambda m: f"element {self.element[int(m[1]) - 1]}", failure.message)
            raise error(failure.status, message) from None
        finally:
            handle.close()
        del fields

    def element_type(self, k: int) -> str:
        """Type of element k in upper case, such as C3D8."""
        number = _arrays.integer("k", k)
        if not 0 <= number < self.element.size:
            raise error(Status.ERR_SIZE, f"there is no element {number}: the mesh has {self.element.size}")
        return str(self.element_types[number])

    def node_set(self, name: str) -> NDArray[np.intc]:
        """Indices of the nodes of a set; InputError if the mesh has none of this name, in upper or lower case."""
        return _named(self.nodes_of_sets, name, "set of nodes").copy()

    def element_set(self, name: str) -> NDArray[np.intc]:
        """Indices of the elements of a set."""
        return _named(self.elements_of_sets, name, "set of elements").copy()

    def faces(self, name: str) -> NDArray[np.intc]:
        """Indices of the nodes of a surface's faces, shape (faces, 8), -1 where unused; for :class:`Surface`.

        Raises
        ------
        InputError
            The mesh has no such surface, an element has no such face, or a face looks into its element.
        """
        elements, numbers = _named(self.faces_of_surfaces, name, "surface")
        faces = np.full((elements.size, MOST_FACE_NODES), -1, dtype=np.intc)
        types = self.element_types[elements]
        for type, number in sorted(set(zip(types.tolist(), numbers.tolist()))):
            alike = np.flatnonzero((types == type) & (numbers == number))
            chosen = elements[alike]
            place = face_nodes(type, number)
            where = f"surface {quoted(name)}: "
            if not place:
                reason = f"of type {type} has no face S{number}, or its faces are not known"
                raise error(Status.ERR_ELEMENT, f"{where}element {self.element[chosen[0]]} {reason}")
            faces[alike, : len(place)] = self.connection[self.first[chosen][:, None] + place]
            inside = np.flatnonzero(self._look_inside(chosen, faces[alike, : len(place)], type))
            if inside.size:
                reason = "looks into the element, whose nodes are numbered the wrong way round: number them as the type"
                which = f"face S{number} of element {self.element[chosen[inside[0]]]}"
                raise error(Status.ERR_MESH, f"{where}{which} {reason} {type} requires")
        return faces

    def _look_inside(self, elements: NDArray[np.intc], faces: NDArray[np.intc], type: str) -> NDArray[np.bool_]:
        """Whether faces of solids, or of elements of a plane, look to the side where the middle of the element lies."""
        family, nodes = element_type(type)
        if family == "shell":
            return np.zeros(elements.size, dtype=bool)
        body = self.position[self.connection[self.first[elements][:, None] + np.arange(nodes)]]
        x = self.position[faces]
        inwards = body.mean(1) - x.mean(1)
        if family == "plane":
            normal = np.cross(x[:, 1] - x[:, 0], [0.0, 0.0, 1.0])
        elif faces.shape[1] % 3 == 0:
            normal = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
        else:
            normal = np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])
        sizes = np.linalg.norm(normal, axis=1) * np.linalg.norm(inwards, axis=1)
        return np.asarray(np.einsum("ij,ij->i", normal, inwards) > _INSIDE * sizes)

    def surface(self, name: str, stiffness: StiffnessFile | None, dimensions: int = 3) -> Surface:
        """A surface with the degrees of freedom of its nodes, for :class:`ElasticBodies` and :class:`ContactPairs`.

        The faces of shells and membranes lie where their nodes do, without the thickness, and look along the normal of
        the element (SPOS) or against it (SNEG).

        Parameters
        ----------
        name : str
        stiffness : StiffnessFile or None
            The matrix of this mesh, whose rows have names; None for a rigid surface.
        dimensions : int
            2 or 3.

        Raises
        ------
        InputError
            The mesh has no such surface, or rows have no names, the same name or those of another mesh.
        """
        what = f"surface {quoted(name)}"
        count = _arrays.integer("dimensions", dimensions)
        if count not in (2, 3):
            raise error(Status.ERR_OPTION, f"dimensions = {count}: it is 2 or 3")
        faces = self.faces(name)
        elements = self.faces_of_surfaces[name.upper()][0]
        families = np.array([element_type(type)[0] for type in self.element_types[elements].tolist()], dtype=np.str_)
        others = elements[(families == "plane") != (count == 2)]
        if others.size:
            which = f"element {self.element[others[0]]} of type {self.element_types[others[0]]}"
            reason = f"is none of {count} dimensions: set dimensions to those of the mesh"
            raise error(Status.ERR_ELEMENT, f"{what}: {which} {reason}")
        node = np.ascontiguousarray(self.position[:, :count])
        if stiffness is None:
            return Surface(node, faces)
        members = faces[faces >= 0]
        dof = np.ascontiguousarray(rows_of_nodes(self.node, stiffness, what, members)[:, :count])
        if np.all(dof[members] < 0):
            reason = "the stiffness matrix has no row of its nodes, so none of them moves: a rigid surface has None"
            raise error(Status.ERR_DOF, f"{what}: {reason}")
        if "shell" in families:
            # Shells have no inside, on which the library would look for other nodes that move.
            dof[np.setdiff1d(np.arange(len(dof)), members)] = -1
        return Surface(node, faces, dof)

    def set_dof(self, name: str, direction: int, stiffness: StiffnessFile) -> NDArray[np.intc]:
        """Degrees of freedom of a set of nodes along one direction: 1 to 3 for x, y, z, 4 to 6 about them.

        Nodes that have none are left out, as programs leave out those of supports.
        """
        members = self.node_set(name)
        along = _arrays.integer("direction", direction)
        if not 1 <= along <= DIRECTIONS:
            raise error(Status.ERR_OPTION, f"direction = {along}: directions are 1 to {DIRECTIONS}")
        dof = rows_of_nodes(self.node, stiffness, f"set {quoted(name)}", members)[members, along - 1]
        return np.compress(dof >= 0, dof)


def join_meshes(meshes: Sequence[Mesh]) -> Mesh:
    """Join meshes, such as those of several bodies: nodes and elements, one mesh after the other.

    They keep their numbers, so that numbers may be repeated; sets and surfaces are left out.
    """
    if not meshes:
        raise error(Status.ERR_SIZE, "there are no meshes to be joined")
    nodes = np.cumsum([0, *(mesh.node.size for mesh in meshes)])
    counts = np.concatenate([[0], *(np.diff(mesh.first) for mesh in meshes)])
    return Mesh(
        np.concatenate([mesh.node for mesh in meshes]),
        np.concatenate([mesh.position for mesh in meshes]),
        np.concatenate([mesh.element for mesh in meshes]),
        np.concatenate([mesh.element_types for mesh in meshes]),
        np.cumsum(counts).astype(np.intc),
        np.concatenate([mesh.connection + before for mesh, before in zip(meshes, nodes)]).astype(np.intc),
    )


def _made(position: NDArray[np.float64], element: NDArray[np.intc], types: Sequence[str]) -> Handle:
    """The mesh in the library, which checks it."""
    nodes, dimensions = position.shape
    arguments = [dimensions, nodes, position, element.shape[1], element.shape[0], element]
    return new_handle("mesh", "fuge_mesh_create", "fuge_mesh_free", *arguments, len(types), _arrays.texts(types))


def _named(members: Mapping[str, _Value], name: str, what: str) -> _Value:
    if name.upper() not in members:
        raise error(Status.ERR_OPTION, f"the mesh has no {what} {quoted(name)}, it has {_listed(members)}")
    return members[name.upper()]


def _listed(names: Collection[str]) -> str:
    """Names for a message."""
    shown = ", ".join(list(names)[:_MOST_LISTED]) or "none"
    return shown + (f" and {len(names) - _MOST_LISTED} more" if len(names) > _MOST_LISTED else "")
