"""Meshes of finite elements: from input files of Abaqus and CalculiX, and to files for ParaView."""

from __future__ import annotations

import ctypes
from typing import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import Handle, Owner, call, new_handle
from fuge.files import PathLike, encoded
from fuge.pairs import Surface
from fuge.stiffness_rows import StiffnessFile

# The longest name of a set.
_NAME_LENGTH = 80


class Mesh(Owner):
    """Nodes, elements, sets and surfaces; indices of its arrays count from 0.

    Made by :func:`read_mesh`, :meth:`from_arrays` or :func:`join_meshes`.

    Attributes
    ----------
    node : ndarray of int, shape (nodes,)
        Number of each node in the file.
    position : ndarray, shape (nodes, 3)
        Length.
    element : ndarray of int, shape (elements,)
        Number of each element in the file.
    first, connection : ndarray of int
        Element k has the nodes with the indices connection[first[k]:first[k + 1]].
    node_sets, element_sets, surfaces : list of str
        Their names, in upper case.
    """

    def __init__(self, handle: Handle) -> None:
        self._handle = handle
        nodes, elements, connections = self._counts("fuge_mesh_get_sizes")
        self.node, self.element = np.empty(nodes, dtype=np.intc), np.empty(elements, dtype=np.intc)
        self.position = np.empty((nodes, 3))
        self.first, self.connection = np.empty(elements + 1, dtype=np.intc), np.empty(connections, dtype=np.intc)
        self._call("fuge_mesh_get_nodes", self.node, self.position)
        self._call("fuge_mesh_get_elements", self.element, self.first, self.connection)
        counts = self._counts("fuge_mesh_get_set_counts")
        self.node_sets = [self._text("fuge_mesh_get_node_set_name", k) for k in range(counts[0])]
        self.element_sets = [self._text("fuge_mesh_get_element_set_name", k) for k in range(counts[1])]
        self.surfaces = [self._text("fuge_mesh_get_surface_name", k) for k in range(counts[2])]

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
        """
        places = _arrays.doubles("position", position, (None, 2), (None, 3))
        elements = _arrays.integers("element", element, (None, None))
        types = [type] if isinstance(type, str) else list(type)
        nodes, dimensions = places.shape
        arguments = [dimensions, nodes, places, elements.shape[1], elements.shape[0], elements]
        names = [len(types), _arrays.texts(types)]
        return cls(new_handle("mesh", "fuge_mesh_create", "fuge_mesh_free", *arguments, *names))

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
        call("fuge_write_mesh", encoded(path), self._handle.pointer, *arguments)
        del fields

    def element_type(self, k: int) -> str:
        """Type of element k in upper case, such as C3D8."""
        return self._text("fuge_mesh_get_type", _arrays.integer("k", k))

    def node_set(self, name: str) -> NDArray[np.intc]:
        """Indices of the nodes of a set; InputError if the mesh has none of this name, in upper or lower case."""
        return self._members("fuge_mesh_get_node_set", name, 1).reshape(-1)

    def element_set(self, name: str) -> NDArray[np.intc]:
        """Indices of the elements of a set."""
        return self._members("fuge_mesh_get_element_set", name, 1).reshape(-1)

    def faces(self, name: str) -> NDArray[np.intc]:
        """Indices of the nodes of a surface's faces, shape (faces, 8), -1 where unused; for :class:`Surface`."""
        return self._members("fuge_mesh_get_faces", name, 8)

    def surface(self, name: str, stiffness: StiffnessFile, dimensions: int = 3) -> Surface:
        """A surface with the degrees of freedom of its nodes, for :class:`ElasticBodies` and :class:`ContactPairs`.

        Parameters
        ----------
        name : str
        stiffness : StiffnessFile
            The matrix of this mesh, whose rows have names.
        dimensions : int
            2 or 3.

        Raises
        ------
        InputError
            The mesh has no such surface, or rows have no names, the same name or those of another mesh.
        """
        count = _arrays.integer("dimensions", dimensions)
        dof = np.empty((self.node.size, count if count in (2, 3) else 3), dtype=np.intc)
        rows = [stiffness.node.size, stiffness.node, stiffness.direction]
        call("fuge_mesh_get_surface_dof", self._handle.pointer, name.encode(), count, *rows, dof)
        return Surface(np.ascontiguousarray(self.position[:, :count]), self.faces(name), dof)

    def set_dof(self, name: str, direction: int, stiffness: StiffnessFile) -> NDArray[np.intc]:
        """Degrees of freedom of a set of nodes along one direction: 1 to 3 for x, y, z, 4 to 6 about them.

        Nodes that have none are left out, as programs leave out those of supports.
        """
        count = np.empty(1, dtype=np.intc)
        along = _arrays.integer("direction", direction)
        rows = [stiffness.node.size, stiffness.node, stiffness.direction]
        arguments = [self._handle.pointer, name.encode(), along, *rows]
        call("fuge_mesh_get_set_dof", *arguments, 0, None, count)
        dof = np.empty(int(count[0]), dtype=np.intc)
        call("fuge_mesh_get_set_dof", *arguments, dof.size, dof, count)
        return dof

    def _members(self, getter: str, name: str, width: int) -> NDArray[np.intc]:
        count = np.empty(1, dtype=np.intc)
        pointer = self._handle.pointer
        call(getter, pointer, name.encode(), 0, None, count)
        members = np.empty((int(count[0]), width), dtype=np.intc)
        call(getter, pointer, name.encode(), len(members), members, count)
        return members

    def _text(self, getter: str, k: int) -> str:
        text = ctypes.create_string_buffer(_NAME_LENGTH + 1)
        self._call(getter, k, text, len(text))
        return text.value.decode(errors="replace")

    def _read_message(self, pointer: ctypes.c_void_p) -> str:
        """None: a mesh does not keep messages, and the exception has the general text of the status."""
        return ""


def read_mesh(path: PathLike) -> Mesh:
    """Read an input file of Abaqus or CalculiX: nodes, elements, sets and surfaces; other keywords are skipped.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    return Mesh(new_handle("mesh", "fuge_read_mesh", "fuge_mesh_free", encoded(path)))


def join_meshes(meshes: Sequence[Mesh]) -> Mesh:
    """Join meshes, such as those of several bodies: nodes and elements, one mesh after the other."""
    pointers = (ctypes.c_void_p * len(meshes))(*(mesh._handle.pointer.value for mesh in meshes))
    return Mesh(new_handle("mesh", "fuge_mesh_join", "fuge_mesh_free", len(meshes), pointers))
