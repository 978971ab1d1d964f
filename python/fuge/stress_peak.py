"""The largest von Mises or Tresca stress under a contact, and where it is."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge._library import struct
from fuge._words import Words
from fuge.halfplane import PLANE_STATES, Element, PlaneState
from fuge.stress import rectangles, rings, strips

Measure = Literal["von_mises", "tresca"]
Location = Literal["inside", "surface", "singular"]

MEASURES = Words("measure", Measure, "MEASURE_")
LOCATIONS = Words("location", Location, "PEAK_")


@dataclass(frozen=True, eq=False)
class StressPeak:
    """A largest stress.

    Attributes
    ----------
    location : {'inside', 'surface', 'singular'}
        Below the surface, at the surface, or infinite at an edge of the contact or in a tip.
    value : float
        Force per length^2; infinity if singular, 0 without forces.
    place : ndarray, shape (3,)
        x, y, z; length. y is 0 in a plane; about an axis: radius, 0, z.
    tensor : ndarray, shape (6,)
        xx, yy, zz, yz, xz, xy there; NaN if singular.
    """

    location: Location
    value: float
    place: NDArray[np.float64]
    tensor: NDArray[np.float64]


def find_peak(name: str, *arguments: Any) -> StressPeak:
    """Call a function with `arguments`, followed by the peak, message and len."""
    peak = struct("fuge_stress_peak")
    call(name, *arguments, ctypes.byref(peak))
    location = cast(Location, LOCATIONS.word(peak.location))
    return StressPeak(location, peak.value, np.array(peak.place), np.array(peak.tensor))


def plane_body(plane_state: PlaneState, poisson: float) -> list[Any]:
    """The arguments plane_state, poisson of a body in a plane."""
    return [PLANE_STATES.number(plane_state), _arrays.number("poisson", poisson)]


def halfplane_peak(
    x: ArrayLike,
    width: ArrayLike,
    force: ArrayLike,
    element: Element,
    poisson: float,
    measure: Measure = "von_mises",
    *,
    plane_state: PlaneState = "strain",
    symmetric: bool = False,
) -> StressPeak:
    """The largest stress under forces on the cells of a half-plane.

    Parameters
    ----------
    x, width, force, element, symmetric
        As in :func:`halfplane_stress`.
    poisson : float
        Poisson's ratio of the body.
    measure : {'von_mises', 'tresca'}
        Which stress is to be largest.
    plane_state : {'strain', 'stress'}
        Long bodies, or thin ones.
    """
    arguments = [*strips(x, width, force, element), *plane_body(plane_state, poisson), int(bool(symmetric))]
    return find_peak("fuge_halfplane_peak", *arguments, MEASURES.number(measure))


def halfspace_peak(
    x: ArrayLike,
    y: ArrayLike,
    width_x: ArrayLike,
    width_y: ArrayLike,
    force: ArrayLike,
    poisson: float,
    measure: Measure = "von_mises",
    *,
    symmetric_x: bool = False,
    symmetric_y: bool = False,
) -> StressPeak:
    """The largest stress under forces on rectangles, given as for :func:`halfspace_stress`."""
    arguments = [*rectangles(x, y, width_x, width_y, force), _arrays.number("poisson", poisson)]
    sides = [int(bool(symmetric_x)), int(bool(symmetric_y))]
    return find_peak("fuge_halfspace_peak", *arguments, *sides, MEASURES.number(measure))


def ring_peak(radius: ArrayLike, force: ArrayLike, poisson: float, measure: Measure = "von_mises") -> StressPeak:
    """The largest stress under forces on rings, given as for :func:`ring_stress`."""
    arguments = [*rings(radius, force), _arrays.number("poisson", poisson)]
    return find_peak("fuge_ring_peak", *arguments, MEASURES.number(measure))
