"""One-way links of structures: supports that lift off, gaps, cables and struts."""

from __future__ import annotations

import ctypes
import math
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import MESSAGE_LENGTH, Handle, Owner, end_call, new_handle
from fuge._library import function, struct
from fuge._words import Words

MemberKind = Literal["tension_only", "compression_only"]

_KINDS = Words("kind", MemberKind)


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
    """

    _message_function = "fuge_links_message"

    def __init__(self, handle: Handle | None = None) -> None:
        if handle is None:
            handle = new_handle("links", "fuge_links_create", "fuge_links_free")
        self._handle = handle

    @property
    def count(self) -> int:
        """Number of links."""
        return self._counts("fuge_links_get_count")[0]

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
            A component for each, of any length but zero.
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
        self._call("fuge_links_add_support", degrees.size, degrees, along, ctypes.byref(law), _bytes(name))

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
        self._call("fuge_links_add_gap", first.size, first, second, along, ctypes.byref(law), _bytes(name))

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

        The stiffness matrix must not have the member too; to take it out, with the direction h of the member at its
        ends: ``stiffness[np.ix_(dof, dof)] -= area * modulus / length * np.outer(h, h)``.

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
        first, second = _axes("dof_a", dof_a), _axes("dof_b", dof_b)
        place_a, place_b = _components("position_a", position_a), _components("position_b", position_b)
        for label, found in (("dof_b", second), ("position_a", place_a), ("position_b", place_b)):
            _arrays.check_shape(label, found.shape, first.shape)
        member = struct("fuge_member")
        member.kind = _KINDS.number(kind)
        member.area, member.modulus = _arrays.number("area", area), _arrays.number("modulus", modulus)
        member.slack = _arrays.number("slack", slack)
        setattr(member, "yield", _arrays.number("yield_force", yield_force))
        values = first.size, first, second, place_a, place_b, ctypes.byref(member), _bytes(name)
        self._call("fuge_links_add_member", *values)

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
            end_call(code, lambda: message.value.decode(errors="replace"))
        return message.value.decode(errors="replace")


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


def _bytes(name: str | None) -> bytes | None:
    return None if name is None else name.encode()
