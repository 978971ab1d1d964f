"""One-way links and load cases from decks of Nastran, Abaqus and CalculiX, and from tables."""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import NDArray

from fuge import _arrays
from fuge._calls import Handle, Owner, call, new_handle
from fuge.files import PathLike, StiffnessFile, encoded
from fuge.links import Links

# The longest name of a link or a load case.
_NAME_LENGTH = 80


class Deck(Owner):
    """One-way links between nodes, and load cases with their supports.

    Made by :func:`read_deck`; ``Deck()`` is empty, for tables. The stiffness matrix must not have the links. A link
    opens by the displacement of node b less that of node a along its direction; its force, not negative, acts on node b
    along the direction and on node a against it.

    Attributes
    ----------
    link_names, case_names : list of str
        Card and number, such as CGAP 12, and such as SUBCASE 3.
    node_a, node_b : ndarray of int, shape (links,)
        Numbers of the nodes in the file; 0: the ground.
    direction : ndarray, shape (links, 3)
        Unit vectors.
    gap, play, compliance, limit : ndarray, shape (links,)
        Gap and distance of a second stop, length; of the link, length per force; of its force. Infinite play: no second
        stop; infinite limit: none.
    """

    def __init__(self, handle: Handle | None = None) -> None:
        if handle is None:
            handle = new_handle("deck", "fuge_deck_create", "fuge_deck_free")
        self._handle = handle
        self._take()

    def _take(self) -> None:
        links, cases = self._counts("fuge_deck_get_counts")
        self.node_a, self.node_b = np.empty(links, dtype=np.intc), np.empty(links, dtype=np.intc)
        self.direction = np.empty((links, 3))
        self.gap, self.play, self.compliance, self.limit = (np.empty(links) for _ in range(4))
        laws = [self.gap, self.play, self.compliance, self.limit]
        self._call("fuge_deck_get_links", self.node_a, self.node_b, self.direction, *laws)
        self.link_names = [self._text("fuge_deck_get_link_name", k) for k in range(links)]
        self.case_names = [self._text("fuge_deck_get_case_name", k) for k in range(cases)]

    def read_links(self, path: PathLike) -> None:
        """Add links: lines node_a, node_b, x, y, z, gap, play, stiffness, limit, name; blank from gap on for none."""
        call("fuge_deck_read_links", self._handle.pointer, encoded(path))
        self._take()

    def read_supports(self, path: PathLike) -> None:
        """Add supports of the model and of all load cases: lines node, directions such as xyz or 123, displacement."""
        call("fuge_deck_read_supports", self._handle.pointer, encoded(path))

    def read_cases(self, path: PathLike) -> None:
        """Add load cases: lines node.direction and a force for each; the first line may name them."""
        call("fuge_deck_read_cases", self._handle.pointer, encoded(path))
        self._take()

    def links(self, stiffness: StiffnessFile) -> Links:
        """The links with their laws and names, for :meth:`Body.set_links`; link k is ``link_names[k]``.

        Parameters
        ----------
        stiffness : StiffnessFile
            The matrix of the structure without the links, whose rows have names. A row that it does not have must be
            held in every load case.

        Raises
        ------
        InputError
            There is no link, rows have no names or the same name, no row moves a link, or a row is missing at a
            degree of freedom that is not held.
        """
        rows = _rows(stiffness)
        handle = new_handle("links", "fuge_deck_make_links", "fuge_links_free", self._handle.pointer, *rows)
        return Links(handle, self.link_names)

    def loads(self, stiffness: StiffnessFile) -> NDArray[np.float64]:
        """External forces of the load cases, (cases, rows)."""
        loads = np.empty((len(self.case_names), stiffness.node.size))
        call("fuge_deck_get_loads", self._handle.pointer, *_rows(stiffness), loads)
        return loads

    def supports(self, case: int, stiffness: StiffnessFile) -> tuple[NDArray[np.intc], NDArray[np.float64]]:
        """Degrees of freedom that a load case holds, and their displacements, for :meth:`Body.fix`.

        Cases that hold the same ones need one :meth:`Body.condense`, and `supports` of :meth:`Body.solve_cases`.
        """
        count = np.empty(1, dtype=np.intc)
        arguments = [self._handle.pointer, _arrays.integer("case", case), *_rows(stiffness)]
        call("fuge_deck_get_supports", *arguments, 0, None, None, count)
        dof = np.empty(int(count[0]), dtype=np.intc)
        displacement = np.empty(dof.size)
        call("fuge_deck_get_supports", *arguments, dof.size, dof, displacement, count)
        return dof, displacement

    def _text(self, getter: str, k: int) -> str:
        text = ctypes.create_string_buffer(_NAME_LENGTH + 1)
        self._call(getter, k, text, len(text))
        return text.value.decode(errors="replace")

    def _read_message(self, pointer: ctypes.c_void_p) -> str:
        """None: a deck does not keep messages, and the exception has the general text of the status."""
        return ""


def _rows(stiffness: StiffnessFile) -> list[object]:
    return [stiffness.node.size, stiffness.node, stiffness.direction]


def read_deck(path: PathLike) -> Deck:
    """Read one-way links and load cases from bulk data of Nastran, or an input file of Abaqus or CalculiX.

    Raises
    ------
    FileError
        The message has the file, the line, the card and the reason.
    """
    return Deck(new_handle("deck", "fuge_read_deck", "fuge_deck_free", encoded(path)))
