"""Stresses and displacements inside the bodies, under the forces of a contact.

z >= 0 counts from the surface into the body; tension is positive, so that under a pressure p at z = 0 the stress zz is
-p. Displacements are positive along their axes, that along z into the body. The body is the one below; for the other
one z points into it, and the moduli are its own. Coordinates of points are broadcast against each other, as by numpy,
and results have their shape followed by the components.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.halfplane import ELEMENTS, PLANE_STATES, Element, PlaneState


def at_points(
    name: str, arguments: list[Any], components: int, *coordinates: tuple[str, ArrayLike]
) -> NDArray[np.float64]:
    """Call a function whose last arguments are points, their coordinates and the result, `components` for each."""
    shape, flat = _arrays.points(*coordinates)
    result = np.empty((*shape, components))
    shapes = dict.fromkeys([coordinate for coordinate, _ in coordinates] + ["point"], shape)
    call(name, *arguments, flat[0].size, *flat, result, shapes=shapes)
    return result


def strips(x: ArrayLike, width: ArrayLike, force: ArrayLike, element: Element) -> list[Any]:
    """The arguments of forces on cells of a half-plane."""
    centres = _arrays.vector("x", x)
    return [
        centres.size,
        centres,
        _arrays.spread("width", width, centres.size),
        _arrays.vector("force", force, centres.size),
        ELEMENTS.number(element),
    ]


def rectangles(x: ArrayLike, y: ArrayLike, width_x: ArrayLike, width_y: ArrayLike, force: ArrayLike) -> list[Any]:
    """The arguments of forces on rectangles of a half-space."""
    centres = _arrays.vector("x", x)
    return [
        centres.size,
        centres,
        _arrays.vector("y", y, centres.size),
        _arrays.spread("width_x", width_x, centres.size),
        _arrays.spread("width_y", width_y, centres.size),
        _arrays.vector("force", force, centres.size),
    ]


def rings(radius: ArrayLike, force: ArrayLike) -> list[Any]:
    """The arguments of forces on rings."""
    radii = _arrays.vector("radius", radius)
    n = max(radii.size - 1, 0)
    return [n, radii, _arrays.vector("force", force, n)]


def elasticity(young: float, poisson: float, plane_state: PlaneState) -> list[Any]:
    """The arguments young, poisson, plane_state of a body in a plane."""
    return [
        _arrays.number("young", young),
        _arrays.number("poisson", poisson),
        PLANE_STATES.number(plane_state),
    ]


def halfplane_stress(
    x: ArrayLike,
    width: ArrayLike,
    force: ArrayLike,
    element: Element,
    px: ArrayLike,
    pz: ArrayLike,
    *,
    symmetric: bool = False,
) -> NDArray[np.float64]:
    """Stresses in a half-plane under forces on its cells.

    Parameters
    ----------
    x : array_like, shape (n,)
        Centres of the cells; length.
    width : array_like, shape (n,), or float
        Widths of the cells; length.
    force : array_like, shape (n,)
        Forces of a contact, per depth.
    element : {'centre', 'mean', 'hat'}
        As in :func:`halfplane_matrix`.
    px, pz : array_like
        Points along the surface, and into the body; length.
    symmetric : bool
        The model is symmetric about x = 0: each force is the sum over a cell and its mirror image.

    Returns
    -------
    ndarray, shape (.., 3)
        xx, zz, xz at each point; force per length^2. See :func:`halfplane_tensor` for yy.

    Raises
    ------
    InputError
        A point is above the surface, or the cells are not those of a matrix.
    """
    arguments = [*strips(x, width, force, element), int(bool(symmetric))]
    return at_points("fuge_halfplane_stress", arguments, 3, ("px", px), ("pz", pz))


def halfplane_displacement(
    x: ArrayLike,
    width: ArrayLike,
    force: ArrayLike,
    element: Element,
    young: float,
    poisson: float,
    px: ArrayLike,
    pz: ArrayLike,
    *,
    plane_state: PlaneState = "strain",
    symmetric: bool = False,
) -> NDArray[np.float64]:
    """Displacements in a half-plane under forces on its cells.

    Parameters
    ----------
    x, width, force, element, px, pz, symmetric
        As in :func:`halfplane_stress`.
    young, poisson : float
        Of the body.
    plane_state : {'strain', 'stress'}
        Long bodies, or thin ones.

    Returns
    -------
    ndarray, shape (.., 2)
        Along x and z; length. Along z the datum is that of :func:`halfplane_matrix`.
    """
    body = elasticity(young, poisson, plane_state)
    arguments = [*strips(x, width, force, element), *body, int(bool(symmetric))]
    return at_points("fuge_halfplane_displacement", arguments, 2, ("px", px), ("pz", pz))


def halfspace_stress(
    x: ArrayLike,
    y: ArrayLike,
    width_x: ArrayLike,
    width_y: ArrayLike,
    force: ArrayLike,
    poisson: float,
    px: ArrayLike,
    py: ArrayLike,
    pz: ArrayLike,
    *,
    symmetric_x: bool = False,
    symmetric_y: bool = False,
) -> NDArray[np.float64]:
    """Stresses in a half-space under the forces of rectangles.

    Parameters
    ----------
    x, y : array_like, shape (n,)
        Centres of the rectangles; length.
    width_x, width_y : array_like, shape (n,), or float
        Their widths; length.
    force : array_like, shape (n,)
        Forces of a contact.
    poisson : float
        Poisson's ratio of the body.
    px, py, pz : array_like
        Points, pz into the body; length.
    symmetric_x, symmetric_y : bool
        As in :func:`halfspace_matrix`.

    Returns
    -------
    ndarray, shape (.., 6)
        xx, yy, zz, yz, xz, xy at each point; force per length^2.
    """
    arguments = [
        *rectangles(x, y, width_x, width_y, force),
        _arrays.number("poisson", poisson),
        int(bool(symmetric_x)),
        int(bool(symmetric_y)),
    ]
    return at_points("fuge_halfspace_stress", arguments, 6, ("px", px), ("py", py), ("pz", pz))


def halfspace_displacement(
    x: ArrayLike,
    y: ArrayLike,
    width_x: ArrayLike,
    width_y: ArrayLike,
    force: ArrayLike,
    young: float,
    poisson: float,
    px: ArrayLike,
    py: ArrayLike,
    pz: ArrayLike,
    *,
    symmetric_x: bool = False,
    symmetric_y: bool = False,
) -> NDArray[np.float64]:
    """Displacements in a half-space under the forces of rectangles; they vanish far away.

    Parameters
    ----------
    x, y, width_x, width_y, force, px, py, pz, symmetric_x, symmetric_y
        As in :func:`halfspace_stress`.
    young, poisson : float
        Of the body.

    Returns
    -------
    ndarray, shape (.., 3)
        Along x, y, z; length.
    """
    arguments = [
        *rectangles(x, y, width_x, width_y, force),
        _arrays.number("young", young),
        _arrays.number("poisson", poisson),
        int(bool(symmetric_x)),
        int(bool(symmetric_y)),
    ]
    return at_points("fuge_halfspace_displacement", arguments, 3, ("px", px), ("py", py), ("pz", pz))


def ring_stress(
    radius: ArrayLike, force: ArrayLike, poisson: float, pr: ArrayLike, pz: ArrayLike
) -> NDArray[np.float64]:
    """Stresses in a half-space under forces on rings about one axis.

    Parameters
    ----------
    radius : array_like, shape (n + 1,)
        As in :func:`ring_matrix`; length.
    force : array_like, shape (n,)
        Resultants of the rings; force.
    poisson : float
        Poisson's ratio of the body.
    pr, pz : array_like
        Points, from the axis and into the body; length.

    Returns
    -------
    ndarray, shape (.., 4)
        rr, tt (around the axis), zz, rz at each point; force per length^2.
    """
    arguments = [*rings(radius, force), _arrays.number("poisson", poisson)]
    return at_points("fuge_ring_stress", arguments, 4, ("pr", pr), ("pz", pz))


def ring_interior_displacement(
    radius: ArrayLike, force: ArrayLike, young: float, poisson: float, pr: ArrayLike, pz: ArrayLike
) -> NDArray[np.float64]:
    """Displacements in a half-space under forces on rings; they vanish far away.

    Parameters
    ----------
    radius, force, pr, pz
        As in :func:`ring_stress`.
    young, poisson : float
        Of the body.

    Returns
    -------
    ndarray, shape (.., 2)
        Away from the axis and into the body; length.
    """
    arguments = [*rings(radius, force), _arrays.number("young", young), _arrays.number("poisson", poisson)]
    return at_points("fuge_ring_interior_displacement", arguments, 2, ("pr", pr), ("pz", pz))
