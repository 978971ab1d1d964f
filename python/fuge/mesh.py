"""Meshes of finite elements from input files of Abaqus and CalculiX."""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import NDArray

from fuge import _arrays
from fuge._calls import Owner, call, end_call, new_handle
from fuge._library import function
from fuge.files import PathLike, encoded


class Mesh(Owner):
    """Nodes, elements, sets and surfaces; made by :func:`read_mesh`. Places in its arrays count from 0.

    Attributes
    ----------
    node : ndarray of int, shape (nodes,)
        Number of each node in the file.
    position : ndarray, shape (nodes, 3)
        Length.
    element : ndarray of int, shape (elements,)
        Number of each element in the file.
    first, connection : ndarray of int
        Element k has the nodes connection[first[k]:first[k + 1]], as places.
    """

    def __init__(self, path: PathLike) -> None:
        self._handle = new_handle("mesh", "fuge_read_mesh", "fuge_mesh_free", encoded(path))
        sizes = [np.empty(1, dtype=np.intc) for _ in range(3)]
        self._get("fuge_mesh_get_sizes", *sizes)
        nodes, elements, connections = (int(size[0]) for size in sizes)
        self.node, self.element = np.empty(nodes, dtype=np.intc), np.empty(elements, dtype=np.intc)
        self.position = np.empty((nodes, 3))
        self.first, self.connection = np.empty(elements + 1, dtype=np.intc), np.empty(connections, dtype=np.intc)
        self._get("fuge_mesh_get_nodes", self.node, self.position)
        self._get("fuge_mesh_get_elements", self.element, self.first, self.connection)

    def type(self, k: int) -> str:
        """Type of element k in upper case, such as C3D8."""
        text = ctypes.create_string_buffer(17)
        self._get("fuge_mesh_get_type", _arrays.integer("k", k), text, len(text))
        return text.value.decode(errors="replace")

    def node_set(self, name: str) -> NDArray[np.intc]:
        """Places of the nodes of a set; InputError if the mesh has none of this name, in upper or lower case."""
        return self._members("fuge_mesh_get_node_set", name, 1).reshape(-1)

    def element_set(self, name: str) -> NDArray[np.intc]:
        """Places of the elements of a set."""
        return self._members("fuge_mesh_get_element_set", name, 1).reshape(-1)

    def faces(self, name: str) -> NDArray[np.intc]:
        """Nodes of the faces of a surface, places, shape (faces, 8), -1 in unused places; for :class:`Surface`."""
        return self._members("fuge_mesh_get_faces", name, 8)

    def _members(self, getter: str, name: str, width: int) -> NDArray[np.intc]:
        count = np.empty(1, dtype=np.intc)
        pointer = self._handle.pointer
        call(getter, pointer, name.encode(), 0, None, count)
        members = np.empty((int(count[0]), width), dtype=np.intc)
        call(getter, pointer, name.encode(), len(members), members, count)
        return members

    def _get(self, name: str, *results: object) -> None:
        end_call(function(name)(self._handle.pointer, *results), lambda: "")


def read_mesh(path: PathLike) -> Mesh:
    """Read an input file of Abaqus or CalculiX: nodes, elements, sets and surfaces; other keywords are skipped.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    return Mesh(path)
