"""Line contact: elastic moduli, influence matrices of a half-plane, and edges of the contact."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge._library import HEADERS
from fuge._words import Words
from fuge.errors import Status

Element = Literal["centre", "mean", "hat"]
PlaneState = Literal["strain", "stress"]
EndKind = Literal["plain", "edge", "corner"]

ELEMENTS = Words("element", Element, status=Status.ERR_ELEMENT)
PLANE_STATES = Words("plane_state", PlaneState, "PLANE_")
END_KINDS = Words("ends", EndKind, "END_")


def plane_modulus(young: float, poisson: float, plane_state: PlaneState = "strain") -> float:
    """Modulus of one body's surface: E/(1 - nu^2) in plane strain and on a half-space, E in plane stress.

    Parameters
    ----------
    young : float
        E > 0, infinity for a rigid body; force per length^2.
    poisson : float
        nu, above -1 and at most 0.5.
    plane_state : {'strain', 'stress'}
        Long bodies, or thin ones.

    Returns
    -------
    float
        Force per length^2.

    Raises
    ------
    InputError
        E or nu is out of range.
    """
    modulus = np.empty(1)
    state = PLANE_STATES.number(plane_state)
    call("fuge_plane_modulus", _arrays.number("young", young), _arrays.number("poisson", poisson), state, modulus)
    return float(modulus[0])


def combined_modulus(e1: float, e2: float) -> float:
    """Combined modulus e_star of two bodies, 1/e_star = 1/e1 + 1/e2.

    Parameters
    ----------
    e1, e2 : float
        Moduli of :func:`plane_modulus`; one of them may be infinity, for a rigid body.

    Raises
    ------
    InputError
        A modulus is not positive, or both bodies are rigid.
    """
    e_star = np.empty(1)
    call("fuge_combined_modulus", _arrays.number("e1", e1), _arrays.number("e2", e2), e_star)
    return float(e_star[0])


def displacement_shares(e1: float, e2: float) -> tuple[float, float]:
    """Shares of the two bodies in the displacement: e_star/e1 and e_star/e2, whose sum is 1."""
    share1, share2 = np.empty(1), np.empty(1)
    call("fuge_displacement_shares", _arrays.number("e1", e1), _arrays.number("e2", e2), share1, share2)
    return float(share1[0]), float(share2[0])


def halfplane_matrix(
    x: ArrayLike, width: ArrayLike, e_star: float, element: Element = "mean", *, symmetric: bool = False
) -> NDArray[np.float64]:
    """Influence matrix of cells on an elastic half-plane.

    Parameters
    ----------
    x : array_like, shape (n,)
        Centres of the cells, in any order; length.
    width : array_like, shape (n,), or float
        Widths of the cells; length.
    e_star : float
        Combined modulus; force per length^2.
    element : {'centre', 'mean', 'hat'}
        What a force and a displacement stand for: uniform pressure force/width on a cell and the displacement at
        its centre; the same pressure and the mean displacement of a cell, for any widths; or a pressure with the peak
        force/width at x that falls linearly to zero at x - width and x + width, and the displacement at x.
    symmetric : bool
        The model is symmetric about x = 0, and only the cells with x >= 0 are passed: a force is the sum over
        a cell and its mirror image, the load is the whole load.

    Returns
    -------
    ndarray, shape (n, n)
        Displacement per force per unit depth. The displacement by a line load is zero at twice the length that
        the cells cover.

    Raises
    ------
    InputError
        Widths that are not positive, cells that overlap, 'centre' or 'hat' with unequal widths, a modulus out of range.
    """
    centres = _arrays.vector("x", x)
    n = centres.size
    alpha = np.empty((n, n), order="F")
    widths = _arrays.spread("width", width, n)
    chosen = ELEMENTS.number(element)
    modulus = _arrays.modulus(e_star)
    call("fuge_halfplane_matrix", n, centres, widths, modulus, chosen, int(bool(symmetric)), alpha, n)
    return alpha


def graded_cells(
    left: float,
    right: float,
    n: int,
    *,
    ends: tuple[EndKind, EndKind] = ("edge", "edge"),
    beyond: tuple[int, int] = (0, 0),
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Cells side by side that are narrow at the ends of an interval and wide in its middle.

    They are meant for ``halfplane_matrix(.., "mean")``, with gaps that are means over the cells. Several contacts:
    one call for each, and the arrays one after the other.

    Parameters
    ----------
    left, right : float
        The interval, left < right: an expected contact, as :func:`contact_edges` finds it on a coarse grid, or the face
        of a punch; length.
    n : int
        Cells in the interval.
    ends : pair of {'plain', 'edge', 'corner'}
        The left and the right end: cells do not become narrower, as at an axis of symmetry; the pressure falls to
        zero like a square root, and distances from the end grow quadratically; it has no limit, and distances grow with
        the fourth power.
    beyond : pair of int
        Further cells beyond either end, at most n, mirror images of those inside, so that the contact may turn out to
        be wider: 3 for an end from :func:`contact_edges`, 0 at a corner.

    Returns
    -------
    x, width : ndarray, shape (n + sum(beyond),)
        Centres, ascending, and widths; length.

    Raises
    ------
    InputError
        No cell, left >= right, more cells beyond an end than inside, or cells that rounding would lose.
    """
    limits = _arrays.number("left", left), _arrays.number("right", right)
    left_end, right_end = (END_KINDS.number(kind) for kind in ends)
    before, after = (_arrays.integer("beyond", cells) for cells in beyond)
    total = _arrays.integer("n", _arrays.integer("n", n) + before + after)
    x, width = np.empty(max(total, 1)), np.empty(max(total, 1))
    call("fuge_graded_cells", *limits, left_end, right_end, before, after, total, x, width)
    return x, width


class EdgeKind(IntEnum):
    """How well an edge of contact is known, an ``IntEnum``; all but REFINED and LIMITED are edges of cells."""

    REFINED = HEADERS.constants["EDGE_REFINED"]
    """Extrapolated from the forces, more accurate than the grid."""
    FEW_CELLS = HEADERS.constants["EDGE_FEW_CELLS"]
    """Fewer than five cells are in contact."""
    SINGULAR = HEADERS.constants["EDGE_SINGULAR"]
    """The pressure does not fall like a square root, as under a corner."""
    GRID_END = HEADERS.constants["EDGE_GRID_END"]
    """The contact reaches the last cell of the grid."""
    LIMITED = HEADERS.constants["EDGE_LIMITED"]
    """The force of one of the first five cells is at its limit: estimated from the others."""


@dataclass(frozen=True, eq=False)
class ContactEdges:
    """Intervals of contact, from left to right; each array has one element for each interval.

    Attributes
    ----------
    left, right : ndarray
        Where they begin and end; length.
    left_error, right_error : ndarray
        Estimated errors, to an order of magnitude; length.
    left_kind, right_kind : ndarray of int
        Values of :class:`EdgeKind`.
    """

    left: NDArray[np.float64]
    right: NDArray[np.float64]
    left_error: NDArray[np.float64]
    right_error: NDArray[np.float64]
    left_kind: NDArray[np.intc]
    right_kind: NDArray[np.intc]


def contact_edges(
    x: ArrayLike,
    width: ArrayLike,
    force: ArrayLike,
    element: Element,
    *,
    symmetric: bool = False,
    state: ArrayLike | None = None,
    compliance: ArrayLike | None = None,
) -> ContactEdges:
    """Intervals of contact on a half-plane and their edges, from the forces.

    For a smooth gap the error of an edge is of third order in the width of the cells. Beyond some 600 cells in contact
    the forces should come from a solver with ``tolerance=1e-13``.

    Parameters
    ----------
    x : array_like, shape (n,)
        Centres of the cells of a uniform grid, ascending; length.
    width : array_like, shape (n,), or float
        Widths of the cells, all equal; length.
    force : array_like, shape (n,)
        In contact where positive; force per depth.
    element : {'centre', 'mean', 'hat'}
        As for the matrix; 'hat' also if with 'mean' the gap is that at the centre.
    symmetric : bool
        The model of ``halfplane_matrix(.., symmetric=True)``.
    state : array_like of int, shape (n,), optional
        ``Contact.state``: needed where forces have limits.
    compliance : array_like, shape (n,), or float, optional
        Compliances of the points, length per force: needed where there are any, because on a bed the pressure may fall
        to zero linearly instead of like a square root.

    Raises
    ------
    InputError
        The grid is not uniform, or arrays do not fit together.
    """
    centres = _arrays.vector("x", x)
    n = centres.size
    numbers = [np.empty(n) for _ in range(4)]
    kinds = [np.empty(n, dtype=np.intc) for _ in range(2)]
    count = np.empty(1, dtype=np.intc)
    call(
        "fuge_contact_edges",
        n,
        centres,
        _arrays.spread("width", width, n),
        _arrays.vector("force", force, n),
        None if state is None else _arrays.integers("state", state, (n,)),
        None if compliance is None else _arrays.spread("compliance", compliance, n),
        ELEMENTS.number(element),
        int(bool(symmetric)),
        n,
        *numbers,
        *kinds,
        count,
    )
    m = int(count[0])
    left, right, left_error, right_error = (array[:m].copy() for array in numbers)
    left_kind, right_kind = (array[:m].copy() for array in kinds)
    return ContactEdges(left, right, left_error, right_error, left_kind, right_kind)
