"""Heights of surfaces and profiles: holes filled, mean and tilt taken out, profiles sampled at other places."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._arrays import Doubles
from fuge.errors import Status, error

ProfileForm = Literal["mean", "line"]
SurfaceForm = Literal["mean", "plane"]

# Larger heights could overflow when they are added and subtracted.
LARGEST = 2.0**992

# A place outside a profile by less than this fraction of its length is its end.
_END_TOLERANCE = 1e-12


def first_place(wrong: NDArray[np.bool_]) -> list[tuple[int, ...]]:
    """The indices of the first element that is true; none if all are false."""
    return [tuple(map(int, np.unravel_index(int(np.argmax(wrong)), wrong.shape)))] if wrong.any() else []


def refuse_numbers(status: Status, name: str, values: Doubles, wrong: NDArray[np.bool_], reason: str) -> None:
    """Name the first of the values that are wrong, if there are any."""
    for place in first_place(wrong):
        value = f"{values[place]:.7g}".replace("nan", "NaN").replace("inf", "Inf")
        raise error(status, f"{name}[{', '.join(map(str, place))}] = {value} {reason}")


def check_numbers(name: str, values: Doubles, hint: str = "", holes: bool = False) -> None:
    """Refuse numbers that are not finite, or out of range; NaN passes with `holes`."""
    wrong = np.isinf(values) if holes else ~np.isfinite(values)
    refuse_numbers(Status.ERR_NOT_FINITE, name, values, wrong, f"is not a finite number{hint}")
    too_large = np.abs(values) > LARGEST
    refuse_numbers(Status.ERR_OVERFLOW, name, values, too_large, "is out of range: choose another unit of length")


def checked_heights(height: ArrayLike, holes: bool = False) -> Doubles:
    """Heights of shape (ny, nx), which are NaN only with `holes`."""
    heights = _arrays.doubles("height", height, ("ny", "nx"))
    if heights.size == 0:
        raise error(Status.ERR_SIZE, "the surface has no heights")
    check_numbers("height", heights, ": if the point was not measured, fill it by fill_surface", holes)
    return heights


def fill_surface(height: ArrayLike) -> Doubles:
    """Heights of shape (ny, nx) without holes: each NaN gets the mean height of its neighbours, from the rim inwards.

    As ``read_surface(.., fill=True)`` fills the points of a file that were not measured: no point in a hole is higher
    than its rim. An array with masked elements goes in as ``numpy.ma.filled(height, numpy.nan)``.

    Raises
    ------
    InputError
        All heights are NaN, or one of them is infinite.
    """
    heights = checked_heights(height, holes=True)
    if np.isnan(heights).all():
        raise error(Status.ERR_NOT_FINITE, "all heights are NaN: no point was measured to fill the others from")
    # A frame of NaN, which is no hole, gives each point four neighbours.
    framed = np.pad(heights, 1, constant_values=np.nan)
    flat, hole = framed.reshape(-1), np.pad(np.isnan(heights), 1).reshape(-1)
    steps = np.array([[-1], [1], [-framed.shape[1]], [framed.shape[1]]])
    layer = np.flatnonzero(hole)
    layer = layer[~np.isnan(flat[layer + steps]).all(axis=0)]
    while layer.size > 0:
        around = layer + steps
        known = ~np.isnan(flat[around])
        flat[layer] = np.where(known, flat[around], 0.0).sum(axis=0) / known.sum(axis=0)
        layer = np.unique(around[hole[around] & np.isnan(flat[around])])
    return np.ascontiguousarray(framed[1:-1, 1:-1])


def level_surface(height: ArrayLike, form: SurfaceForm) -> Doubles:
    """Heights of shape (ny, nx) without their mean, or without the least-squares plane.

    Raises
    ------
    InputError
        A height is not finite; the form is neither 'mean' nor 'plane'.
    """
    heights = checked_heights(height)
    tilted = _arrays.choice("form", form, {"mean": 0, "plane": 1})
    # Relative to one height, so that an offset costs no digits; the second pass removes the rounding of the first.
    heights = np.asarray(heights - heights[0, 0])
    for _ in range(2):
        plane = heights.mean(keepdims=True)
        for axis in (0, 1) if tilted and heights.size > 1 else ():
            # Places about the middle, so that the slopes do not depend on each other; one place has no slope.
            place = np.linspace(-1.0, 1.0, heights.shape[axis]) if heights.shape[axis] > 1 else np.zeros(1)
            slope = place @ heights.mean(axis=1 - axis) / max(place @ place, 1.0)
            plane = plane + np.expand_dims(slope * place, 1 - axis)
        heights -= plane
    return heights


def rms_slope(height: ArrayLike, spacing: tuple[float, float]) -> float:
    """Root mean square of the slope between neighbours of heights of shape (ny, nx), along x and y together."""
    heights = checked_heights(height)
    slopes = [np.diff(heights, axis=axis) / step for axis, step in ((1, spacing[0]), (0, spacing[1]))]
    return float(np.sqrt(sum(np.square(slope).mean() for slope in slopes if slope.size > 0)))


def _profile(x: ArrayLike, z: ArrayLike) -> tuple[Doubles, Doubles]:
    places = _arrays.vector("x", x)
    heights = _arrays.vector("z", z, places.size)
    if places.size < 2:
        raise error(Status.ERR_SIZE, f"x and z have {places.size} value(s): a profile needs 2 or more")
    check_numbers("x", places)
    check_numbers("z", heights)
    stays = np.diff(places, prepend=-np.inf) <= 0.0
    reason = "does not exceed the one before: x must increase; sort the points and merge repeated ones"
    refuse_numbers(Status.ERR_WIDTH, "x", places, stays, reason)
    return places, heights


def sample_profile(x: ArrayLike, z: ArrayLike, centre: ArrayLike) -> Doubles:
    """Heights of a profile at places within it, of any shape, by linear interpolation; length.

    Raises
    ------
    InputError
        x does not increase, a number is not finite, or a place is outside the profile.
    """
    places, heights = _profile(x, z)
    centres = _arrays.doubles("centre", centre)
    points = centres.reshape(-1)
    check_numbers("centre", points)
    first, last = places[0], places[-1]
    outside = np.maximum(first - points, points - last) > _END_TOLERANCE * (last - first)
    reason = f"is outside the profile, {first:.7g} .. {last:.7g}: extend the profile, or leave the point out"
    refuse_numbers(Status.ERR_WIDTH, "centre", points, outside, reason)
    left = np.clip(np.searchsorted(places, points, side="right") - 1, 0, places.size - 2)
    fraction = np.clip((points - places[left]) / (places[left + 1] - places[left]), 0.0, 1.0)
    return np.asarray((1.0 - fraction) * heights[left] + fraction * heights[left + 1]).reshape(centres.shape)


def level_profile(x: ArrayLike, z: ArrayLike, form: ProfileForm) -> Doubles:
    """Heights without their mean, or without the least-squares line; each weighted by the length it stands for.

    Raises
    ------
    InputError
        x does not increase, a number is not finite; the form is neither 'mean' nor 'line'.
    """
    places, heights = _profile(x, z)
    tilted = _arrays.choice("form", form, {"mean": 0, "line": 1})
    abscissa = (places - places[0]) / (places[-1] - places[0])
    weight = 0.5 * (np.diff(abscissa, prepend=0.0) + np.diff(abscissa, append=1.0))
    # Relative to one height, so that an offset costs no digits.
    heights = np.asarray(heights - heights[0])
    heights -= weight @ heights
    if tilted:
        abscissa -= weight @ abscissa
        heights -= abscissa * (weight @ (abscissa * heights) / (weight @ abscissa**2))
    return heights
