"""Tables of force over elongation that are one-way: no force on one side, a line from there, and perhaps a limit."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge.formats.text import Reason

# Points are on a line if they leave it by no more than this fraction: a deck has few digits.
_ROUNDING = 1e-5


class OneWayLaw(NamedTuple):
    """The force of a cable, which pulls (`tension`), or of a strut: from the gap on, with a compliance, up to a limit.

    The gap is an elongation or a shortening, length; compliance: length per force; limit: force, infinite if none.
    """

    tension: bool
    gap: float
    compliance: float
    limit: float


def find_one_way_law(x: NDArray[np.float64], y: NDArray[np.float64]) -> OneWayLaw:
    """The law of a table of elongations x and tensile forces y, which go on as their last lines; Reason if none."""
    if x.size < 3:
        raise Reason("three points or more are needed: two without force, and one with")
    for before, after in zip(x[:-1], x[1:]):
        if after <= before:
            raise Reason(f"x = {after:g} follows x = {before:g}, but x must ascend")
    tension = bool(y.max() > -y.min())
    # A strut in the mirror is a cable.
    with np.errstate(all="ignore"):
        return OneWayLaw(tension, *(_find_cable(x, y) if tension else _find_cable(-x[::-1], -y[::-1])))


def _find_cable(x: NDArray[np.float64], force: NDArray[np.float64]) -> tuple[float, float, float]:
    """Gap, compliance and limit: forces are zero up to some point, then on a line, then perhaps constant."""
    first = int(np.argmax(force > 0.0))
    if first < 2 or force.min() < 0.0:
        raise Reason("a one-way spring has no force at two points or more on one side, and no change of sign")
    largest, last, limit = float(force.max()), x.size - 1, math.inf
    if force[-1] <= force[-2]:
        last, limit = int(np.argmax(force)), largest
    begin = gap = x[first - 1]
    slope = force[last] / (x[last] - begin)
    if last > first:
        # The first point on the line may lie beyond its begin.
        slope = (force[last] - force[first]) / (x[last] - x[first])
        gap = x[first] - force[first] / slope
    line = np.minimum(slope * (x[first:] - gap), limit)
    if not (
        0.0 < slope < math.inf
        and abs(gap - begin) <= _ROUNDING * (x[last] - begin)
        and np.all(np.abs(force[first:] - line) <= _ROUNDING * largest)
    ):
        raise Reason("the force must rise on one line from where it begins, and may then be constant")
    return float(begin) + 0.0, float(1.0 / slope), limit
