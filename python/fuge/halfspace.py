"""Areas of contact: influence matrices of rectangles and of rings on an elastic half-space, and Hertz."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge._words import Words
from fuge.errors import Status
from fuge.halfplane import ELEMENTS

AreaElement = Literal["centre", "mean"]

AREA_ELEMENTS = Words("element", AreaElement, status=Status.ERR_ELEMENT)


def halfspace_matrix(
    x: ArrayLike,
    y: ArrayLike,
    width_x: ArrayLike,
    width_y: ArrayLike,
    e_star: float,
    element: AreaElement = "mean",
    *,
    symmetric_x: bool = False,
    symmetric_y: bool = False,
) -> NDArray[np.float64]:
    """Influence matrix of rectangles on an elastic half-space.

    Parameters
    ----------
    x, y : array_like, shape (n,)
        Centres of the rectangles; length.
    width_x, width_y : array_like, shape (n,), or float
        Their widths along x and y; length.
    e_star : float
        Combined modulus; force per length^2.
    element : {'centre', 'mean'}
        Uniform pressure on a rectangle, and the displacement at its centre (equal rectangles only) or its mean.
    symmetric_x, symmetric_y : bool
        The model is symmetric about x = 0, or y = 0, and only the rectangles with x >= 0, or y >= 0, are passed: a
        force is the sum over a rectangle and its mirror images, the load is the whole load.

    Returns
    -------
    ndarray, shape (n, n)
        Displacement per force. Displacements vanish far away, so the approach is absolute.

    Raises
    ------
    InputError
        Widths that are not positive, rectangles that overlap, 'centre' with unequal rectangles, a modulus out of range.
    """
    centres = _arrays.vector("x", x)
    n = centres.size
    alpha = np.empty((n, n), order="F")
    arguments = [
        n,
        centres,
        _arrays.vector("y", y, n),
        _arrays.spread("width_x", width_x, n),
        _arrays.spread("width_y", width_y, n),
        _arrays.modulus(e_star),
        AREA_ELEMENTS.number(element),
        int(bool(symmetric_x)),
        int(bool(symmetric_y)),
    ]
    call("fuge_halfspace_matrix", *arguments, alpha, n)
    return alpha


def ring_matrix(radius: ArrayLike, e_star: float) -> NDArray[np.float64]:
    """Influence matrix of rings side by side, for round bodies that are pressed along their axis.

    Uniform pressure on each ring, and its mean displacement; gaps are means over the rings, weighted by area.

    Parameters
    ----------
    radius : array_like, shape (n + 1,)
        Ring k lies between radius[k] and radius[k + 1]; increasing, the first one is 0 for a disc; length.
    e_star : float
        Combined modulus; force per length^2.

    Returns
    -------
    ndarray, shape (n, n)
        Displacement per force, which is the resultant of a ring. Displacements vanish far away.

    Raises
    ------
    InputError
        Radii that do not increase, or a ring thinner than 1e-7 of its radius; a modulus out of range.
    """
    radii = _arrays.vector("radius", radius)
    n = max(radii.size - 1, 0)
    alpha = np.empty((n, n), order="F")
    call("fuge_ring_matrix", n, radii, _arrays.modulus(e_star), ELEMENTS.number("mean"), alpha, n)
    return alpha


def ring_displacement(radius: ArrayLike, force: ArrayLike, e_star: float, place: ArrayLike) -> NDArray[np.float64]:
    """Displacement of the surface, into the body, by forces on rings.

    Parameters
    ----------
    radius : array_like, shape (n + 1,)
        As in :func:`ring_matrix`; length.
    force : array_like, shape (n,)
        Resultants of the rings; force.
    e_star : float
        Modulus; force per length^2.
    place : array_like, any shape
        Distances from the axis; length.

    Returns
    -------
    ndarray, shape of place
        Length.
    """
    radii = _arrays.vector("radius", radius)
    n = max(radii.size - 1, 0)
    places = _arrays.doubles("place", place)
    displacement = np.empty(places.shape)
    call(
        "fuge_ring_displacement",
        n,
        radii,
        _arrays.vector("force", force, n),
        _arrays.modulus(e_star),
        places.size,
        places,
        displacement,
        shapes={"place": places.shape},
    )
    return displacement


@dataclass(frozen=True)
class HertzContact:
    """Contact of two ellipsoids: an ellipse with the semi-axes, under the pressure of half an ellipsoid.

    Attributes
    ----------
    semi_axis_x, semi_axis_y : float
        Of the area of contact; length.
    approach : float
        By how much distant points of the bodies approach each other; length.
    peak_pressure : float
        The pressure in the middle; force per length^2.
    """

    semi_axis_x: float
    semi_axis_y: float
    approach: float
    peak_pressure: float


def hertz_ellipse(radius_x: float, radius_y: float, e_star: float, load: float) -> HertzContact:
    """Hertz's contact of two bodies with the initial gap x^2/(2 radius_x) + y^2/(2 radius_y), in closed form.

    Parameters
    ----------
    radius_x, radius_y : float
        Principal relative radii of curvature, 1/R = 1/R_1 + 1/R_2 of the two bodies; length.
    e_star : float
        Combined modulus; force per length^2.
    load : float
        Not negative; force.

    Raises
    ------
    InputError
        A radius or the modulus is out of range.
    EquilibriumError
        The load is negative.
    """
    found = [np.empty(1) for _ in range(4)]
    call(
        "fuge_hertz_ellipse",
        _arrays.number("radius_x", radius_x),
        _arrays.number("radius_y", radius_y),
        _arrays.modulus(e_star),
        _arrays.number("load", load),
        *found,
    )
    return HertzContact(*(float(value[0]) for value in found))
