"""One-way links of structures: supports that lift off, gaps, cables and struts."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import MESSAGE_LENGTH, Owner, call, end_call, new_handle
from fuge._library import function, struct
from fuge._words import Words
from fuge.columns import CompressedColumns, compressed, compressed_dense, is_sparse
from fuge.errors import Status, error

MemberKind = Literal["tension_only", "compression_only"]

_KINDS = Words("kind", MemberKind)


# Degrees of freedom, by how much they open a link, and the distance of its stops.
_Row = tuple[NDArray[np.intc], NDArray[np.float64], float]


class Links(Owner):
    """Links of a structure, for :meth:`Body.set_links`; link k is contact point k.

    Degrees of freedom count from 0; -1 is one that does not move. Names are for messages; without one a link is
    called 'link 1', 'link 2' and so on, in the order in which they are added.

    Examples
    --------
    >>> links = fuge.Links()
    >>> links.add_member([0, 1], [-1, -1], [0.0, 0.0], [3.0, 4.0], area=1.0, modulus=500.0, name="cable")
    >>> body.set_links(links)
    >>> body.condense()
    >>> cases = body.solve_cases(loads)
    >>> forces = dict(zip(links.names, cases.force.T))
    """

    _message_function = "fuge_links_message"

    def __init__(self) -> None:
        self._handle = new_handle("links", "fuge_links_create", "fuge_links_free")
        self._names: list[str] = []
        self._rows: list[_Row] = []

    def __repr__(self) -> str:
        return f"<Links: {listed(self._names) or 'none'}>"

    @property
    def count(self) -> int:
        """Number of links."""
        return self._counts("fuge_links_get_count")[0]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the links, in the order of the forces; 'link 1' and so on where none was given."""
        return tuple(self._names)

    def add_support(
        self,
        dof: ArrayLike,
        direction: ArrayLike,
        *,
        gap: float = 0.0,
        play: float = math.inf,
        compliance: float = 0.0,
        limit: float = math.inf,
        limit_upper: float = math.inf,
        name: str | None = None,
    ) -> None:
        """Add a support: it pushes a node along `direction`, and its gap opens when the node moves along it.

        Parameters
        ----------
        dof : array_like of int, shape (count,), or int
            Degrees of freedom of the node, at most 6.
        direction : array_like, shape (count,), or float
            A component for each, not all of them zero. The first three are translations, which are scaled to length 1
            together; the others are rotations, whose components are lever arms, length. So the rotation of a plane
            frame is a fourth component or a later one, with -1 for degrees of freedom that are missing.
        gap : float
            Without load; negative: an interference; length.
        play : float
            Distance of a second stop from the first; infinity: none; length.
        compliance : float
            Of the support; length per force; 0: rigid.
        limit, limit_upper : float
            Limits of the force at the first stop and at the second; infinity: none.
        name : str, optional

        Raises
        ------
        InputError
            No degree of freedom moves along the direction, or a number has no sense.
        """
        degrees, along = _axes("dof", dof), _components("direction", direction)
        _arrays.check_shape("direction", along.shape, degrees.shape)
        law = _law(gap, play, compliance, limit, limit_upper)
        values = degrees.size, degrees, along, ctypes.byref(law)
        self._add("fuge_links_add_support", name, values, (degrees, _unit(along), law.play))

    def add_gap(
        self,
        dof_a: ArrayLike,
        dof_b: ArrayLike,
        direction: ArrayLike,
        *,
        gap: float = 0.0,
        play: float = math.inf,
        compliance: float = 0.0,
        limit: float = math.inf,
        limit_upper: float = math.inf,
        name: str | None = None,
    ) -> None:
        """Add a gap that closes when node a approaches node b along `direction`, which points from a to b.

        The parameters are those of :meth:`add_support`, with as many degrees of freedom of each node.
        """
        first, second, along = _axes("dof_a", dof_a), _axes("dof_b", dof_b), _components("direction", direction)
        _arrays.check_shape("dof_b", second.shape, first.shape)
        _arrays.check_shape("direction", along.shape, first.shape)
        law = _law(gap, play, compliance, limit, limit_upper)
        values = first.size, first, second, along, ctypes.byref(law)
        unit = _unit(along)
        self._add("fuge_links_add_gap", name, values, (np.r_[second, first], np.r_[unit, -unit], law.play))

    def add_member(
        self,
        dof_a: ArrayLike,
        dof_b: ArrayLike,
        position_a: ArrayLike,
        position_b: ArrayLike,
        *,
        area: float,
        modulus: float,
        kind: MemberKind = "tension_only",
        slack: float = 0.0,
        yield_force: float = 0.0,
        name: str | None = None,
    ) -> None:
        """Add a straight member between two nodes, a cable or a strut; its force is positive where it carries.

        The stiffness matrix must not have the member too; :func:`remove_member` takes it out.

        Parameters
        ----------
        dof_a, dof_b : array_like of int, shape (dimensions,)
            Displacements of its ends along the axes.
        position_a, position_b : array_like, shape (dimensions,)
            Where the ends are; length.
        area, modulus : float
            Of the section, and Young's.
        kind : {'tension_only', 'compression_only'}
        slack : float
            A cable is longer than the distance of its ends by so much, a strut shorter; negative: prestressed; length.
        yield_force : float
            Force at which it yields; 0: never.
        name : str, optional

        Raises
        ------
        InputError
            The member has no length, area or modulus, or its ends do not move along it.
        """
        first, second, place_a, place_b = _ends(dof_a, dof_b, position_a, position_b)
        member = struct("fuge_member")
        member.kind = _KINDS.number(kind)
        member.area, member.modulus = _arrays.number("area", area), _arrays.number("modulus", modulus)
        member.slack = _arrays.number("slack", slack)
        setattr(member, "yield", _arrays.number("yield_force", yield_force))
        values = first.size, first, second, place_a, place_b, ctypes.byref(member)
        unit = _unit(place_b - place_a) * (1 if kind == "tension_only" else -1)
        self._add("fuge_links_add_member", name, values, (np.r_[first, second], np.r_[unit, -unit], math.inf))

    @property
    def gap(self) -> NDArray[np.float64]:
        """Gaps without load, shape (count,); those of members are their slack."""
        gap = np.empty(self.count)
        self._call("fuge_links_get_gaps", gap)
        return gap

    def describe(self, displacement: ArrayLike, position: ArrayLike, dof: ArrayLike) -> str:
        """A mechanism in words: which links open, and how the structure moves.

        Parameters
        ----------
        displacement : array_like, shape (degrees,)
            That of :meth:`Body.mechanism`.
        position : array_like, shape (nodes, 2) or (nodes, 3)
            Where the nodes are; length.
        dof : array_like of int, shape of position
            Their degrees of freedom; -1: does not move.

        Returns
        -------
        str
        """
        u = _arrays.vector("displacement", displacement)
        places = _arrays.doubles("position", position, (None, 2), (None, 3))
        degrees = _arrays.integers("dof", dof, places.shape)
        nodes, dimensions = places.shape
        message = ctypes.create_string_buffer(MESSAGE_LENGTH + 1)
        with self._handle.use() as pointer:
            code = function("fuge_links_describe")(
                pointer, u.size, u, dimensions, nodes, places, degrees, message, MESSAGE_LENGTH + 1
            )
            end_call(code, lambda: message.value.decode(errors="surrogateescape"))
        return message.value.decode(errors="surrogateescape")

    def _contact(self) -> tuple[NDArray[np.intc], NDArray[np.float64]]:
        """Degrees of freedom and normals of all links, as :meth:`Body.set_contact` takes them."""
        width = max((dof.size for dof, _, _ in self._rows), default=0)
        dof, normal = np.full((self.count, width), -1, dtype=np.intc), np.zeros((self.count, width))
        for k, (degrees, unit, _) in enumerate(self._rows):
            dof[k, : degrees.size], normal[k, : unit.size] = degrees, unit
        return dof, normal

    def _play(self) -> NDArray[np.float64] | None:
        """Distances of the stops, if any link has two."""
        play = np.array([play for _, _, play in self._rows])
        return play if np.isfinite(play).any() else None

    def _add(self, add: str, name: str | None, arguments: Sequence[Any], row: _Row) -> None:
        """Call a function that adds a link, and remember its name and what opens it."""
        self._call(add, *arguments, None if name is None else name.encode(errors="surrogateescape"))
        self._names.append(name if name and name.strip() else f"link {len(self._names) + 1}")
        self._rows.append(row)


def remove_member(
    stiffness: Any,
    dof_a: ArrayLike,
    dof_b: ArrayLike,
    position_a: ArrayLike,
    position_b: ArrayLike,
    *,
    area: float,
    modulus: float,
) -> Any:
    """A stiffness matrix without a member that it has, so that :meth:`Links.add_member` can take its place.

    Of several members at a node take out the softest first: rounding of a stiffer one hides what is left of it.

    Parameters
    ----------
    stiffness : array_like of shape (degrees, degrees), scipy.sparse matrix or CompressedColumns
        Both triangles or one; it is not changed.
    dof_a, dof_b, position_a, position_b, area, modulus
        As in :meth:`Links.add_member`. Only the stiffness along the member is taken out: it has to be a bar.

    Returns
    -------
    ndarray, scipy.sparse.csc_matrix or CompressedColumns
        The matrix without the member, of the kind of `stiffness`.

    Raises
    ------
    MatrixError
        The matrix does not have the member.
    InputError
        The member has no length, area or modulus, a degree of freedom is out of range, or the shape is not square.
    """
    sparse = is_sparse(stiffness)
    matrix = compressed("stiffness", stiffness) if sparse else compressed_dense("stiffness", stiffness)
    if matrix.shape[0] != matrix.shape[1]:
        raise error(Status.ERR_SIZE, f"stiffness has the shape {matrix.shape}, but must be square")
    first, second, place_a, place_b = _ends(dof_a, dof_b, position_a, position_b)
    span = place_b - place_a
    length = math.hypot(*span)
    if length == 0.0:
        raise error(Status.ERR_LAW, "the ends of the member are at the same place")
    axial = _arrays.number("area", area) * _arrays.number("modulus", modulus) / length
    dof, normal = np.r_[first, second], np.r_[-span, span] / length
    value = matrix.value.copy()
    arguments = matrix.shape[0], matrix.column, matrix.row, value, dof.size, dof, normal, axial
    call("fuge_remove_member", *arguments)
    if not sparse:
        without = np.zeros(matrix.shape)
        without[matrix.row, np.repeat(np.arange(matrix.shape[1]), np.diff(matrix.column))] = value
        return without
    changed = CompressedColumns(matrix.shape, matrix.column, matrix.row, value)
    return changed if isinstance(stiffness, CompressedColumns) else changed.tocsc()


def listed(names: Sequence[str], most: int = 8) -> str:
    """Names one after the other; of many the first ones and the number of the others."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def _unit(direction: NDArray[np.float64]) -> NDArray[np.float64]:
    """A direction whose translations, the first three components, have length 1."""
    unit = direction.copy()
    if np.any(unit[:3]):
        unit[:3] /= np.abs(unit[:3]).max()
        unit[:3] /= np.linalg.norm(unit[:3])
    return unit


def _ends(dof_a: ArrayLike, dof_b: ArrayLike, position_a: ArrayLike, position_b: ArrayLike) -> tuple[Any, ...]:
    """Degrees of freedom and places of the ends of a member, of one shape."""
    first, second = _axes("dof_a", dof_a), _axes("dof_b", dof_b)
    place_a, place_b = _components("position_a", position_a), _components("position_b", position_b)
    for label, found in (("dof_b", second), ("position_a", place_a), ("position_b", place_b)):
        _arrays.check_shape(label, found.shape, first.shape)
    return first, second, place_a, place_b


def _axes(name: str, dof: ArrayLike) -> NDArray[np.intc]:
    return _arrays.integers(name, np.atleast_1d(_arrays.array(name, dof)), (None,))


def _components(name: str, value: ArrayLike) -> NDArray[np.float64]:
    return _arrays.vector(name, np.atleast_1d(_arrays.array(name, value)))


def _law(gap: float, play: float, compliance: float, limit: float, limit_upper: float) -> Any:
    law = struct("fuge_link_law")
    law.gap, law.play = _arrays.number("gap", gap), _arrays.number("play", play)
    law.compliance = _arrays.number("compliance", compliance)
    law.limit, law.limit_upper = _arrays.number("limit", limit), _arrays.number("limit_upper", limit_upper)
    return law
