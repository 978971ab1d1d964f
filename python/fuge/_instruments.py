"""Surfaces in files of instruments, which the package SurfaceTopography reads where it is installed."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fuge.errors import FileError, Status

# Follows the name of the file in the library's message about a format that it recognises but does not read.
REMARK = ", which fuge does not read: "
METRES = {
    "m": 1.0,
    "cm": 1e-2,
    "mm": 1e-3,
    "um": 1e-6,
    "\N{MICRO SIGN}m": 1e-6,
    "\N{GREEK SMALL LETTER MU}m": 1e-6,
    # The micro sign in UTF-8 read as Latin-1, as in files .sur of programs other than MountainsMap.
    "\N{LATIN CAPITAL LETTER A WITH CIRCUMFLEX}\N{MICRO SIGN}m": 1e-6,
    "nm": 1e-9,
    "\N{ANGSTROM SIGN}": 1e-10,
    "\N{LATIN CAPITAL LETTER A WITH RING ABOVE}": 1e-10,
    "pm": 1e-12,
}


def _failure(what: str, reason: str) -> FileError:
    return FileError(f"{what}{reason}", Status.ERR_FILE)


def _topography(path: str, what: str) -> Any:
    """The default channel of a file, as SurfaceTopography reads it; messages begin with `what`."""
    try:
        import SurfaceTopography
    except ModuleNotFoundError as missing:
        if missing.name != "SurfaceTopography":
            raise
        raise _failure(
            what,
            ": fuge reads it where SurfaceTopography is installed (pip install SurfaceTopography); or read it with "
            "surfalize and pass the heights, see tutorial_python.md",
        ) from None
    try:
        return SurfaceTopography.read_topography(path)
    except Exception as reason:
        # Where no reader takes the file, the message has what each of its dozens of readers says.
        if type(reason).__name__ == "CannotDetectFileFormat":
            raise _failure(what, ", but SurfaceTopography does not read it: is it broken or cut off?") from None
        raise _failure(what, f", but SurfaceTopography does not read it: {reason}") from reason


def read_instrument(
    path: str | os.PathLike[str], message: str
) -> tuple[NDArray[np.float64], tuple[float, float], str | None]:
    """Heights of shape (ny, nx) with NaN where nothing was measured, spacings along x and y, and their unit.

    The unit is metres, or None where the file has none. `message` is what the library says of the file.
    """
    what = message.split(REMARK)[0]
    topography = _topography(os.fspath(path), what)
    if topography.dim != 2 or not topography.is_uniform:
        raise _failure(what, ": it has a profile or scattered points, no heights on a grid")
    scale, unit = 1.0, topography.unit
    if unit is not None:
        if unit not in METRES:
            raise _failure(what, f": its unit is {unit!r}, no length: read it with SurfaceTopography")
        scale, unit = METRES[unit], "m"
    # Heights are masked where nothing was measured, and the first index counts along x.
    measured = topography.heights()
    heights = scale * np.array(measured, dtype=np.float64)
    heights[getattr(measured, "mask", False)] = np.nan
    x, y = (float(size) for size in topography.pixel_size)
    return np.ascontiguousarray(heights.T), (scale * x, scale * y), unit
