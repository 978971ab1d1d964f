"""Profiles in text: positions x and heights z."""

from __future__ import annotations

import math
import os

import numpy as np
from numpy.typing import NDArray

from fuge.formats.rows import is_word, lines, number, plain_heights, text
from fuge.formats.text import PathLike, Place, Reason, read_bytes, refusal, split_columns


def read_profile(path: PathLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read a profile: x, strictly increasing, and heights z, positive upwards.

    A line has x and z between blanks, a comma or a semicolon; one line of words may come first. The initial gap of two
    profiles is upper - lower.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    points: list[list[float]] = []
    headed, place = False, Place(os.fspath(path), 0)
    try:
        for count, line in lines(read_bytes(path).removeprefix(b"\xef\xbb\xbf")):
            place = Place(os.fspath(path), count)
            point = plain_heights(line, next((mark for mark in (b",", b";") if mark in line), None))
            if point is None or len(point) != 2 or not all(map(math.isfinite, point)):
                words = split_columns(text(line))[0]
                if words and not (points or headed) and all(map(is_word, words[:2])):
                    headed, words = True, []
                if not words:
                    continue
                point = _point(words)
            if points and point[0] <= points[-1][0]:
                before = f"x = {point[0]:.7g} does not exceed x = {points[-1][0]:.7g} of the point before"
                raise Reason(f"{before}: x must increase; sort the points and merge repeated ones")
            points.append(point)
        if len(points) < 2:
            raise Reason(f"the file ends after {len(points)} point(s): a profile needs 2 or more")
    except Reason as reason:
        raise refusal(place if place.line else path, reason) from None
    x, z = np.array(points).T.copy()
    return x, z


def _point(words: list[str]) -> list[float]:
    """x and z in the columns of a line."""
    if not all(words[:2]):
        raise Reason("an empty column: x and z are needed")
    x = number(words[0])
    if len(words) == 1:
        raise Reason("only one column: x and z are needed")
    z = number(words[1])
    if len(words) > 2:
        raise Reason("more than two columns: x and z are needed, with a decimal point and not a comma")
    return [x, z]
