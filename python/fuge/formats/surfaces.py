"""Surfaces, heights on a regular grid, in files."""

from __future__ import annotations

import os
from dataclasses import dataclass
from itertools import chain
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge.errors import Status
from fuge.formats.instruments import failure, instrument_format, read_instrument
from fuge.formats.rows import read_rows
from fuge.formats.sdf import is_sdf, read_sdf
from fuge.formats.surface_text import Heights, comment_spacings, read_grid, read_points
from fuge.formats.text import PathLike, read_bytes, refusal, write_text
from fuge.heights import LARGEST, check_numbers, checked_heights, fill_surface, first_place, refuse_numbers, rms_slope

SurfaceFormat = Literal["any", "grid", "points", "sdf"]

# Ground and polished surfaces are between these slopes; beyond them lengths have two units, as a rule.
_LEAST_SLOPE, _LARGEST_SLOPE = 1e-4, 1.0


@dataclass(frozen=True, eq=False)
class SurfaceHeights:
    """Heights on a regular grid, positive upwards.

    The initial gap of a surface below a plane is ``height.max() - height``.

    Attributes
    ----------
    height : ndarray, shape (ny, nx)
        In the unit of the file.
    spacing : tuple of float or None
        Along x and y; None if the file does not give it.
    origin : tuple of float
        Position of height[0, 0].
    filled : int
        Number of points that were not measured and have been filled.
    unit : str or None
        'm' if the file says in which unit it is, as SDF and files of instruments do: all lengths are in metres.
        Otherwise None, and lengths are in the unit of the file.
    header : tuple of str
        What the header of the file says about lengths, and what has been made of it.
    """

    height: NDArray[np.float64]
    spacing: tuple[float, float] | None
    origin: tuple[float, float]
    filled: int
    unit: str | None = None
    header: tuple[str, ...] = ()

    @property
    def notes(self) -> tuple[str, ...]:
        """What a user should know: the header, the share of filled points, and a slope that hardly any surface has."""
        notes = self.header
        if self.filled > 0:
            share = f"{self.filled} of {self.height.size} points ({100.0 * self.filled / self.height.size:.3g} %)"
            notes += (f"{share} were not measured and are filled",)
        slope = rms_slope(self.height, self.spacing) if self.spacing else 0.0
        if slope > _LARGEST_SLOPE or 0.0 < slope < _LEAST_SLOPE:
            kind = "too steep for a half-space" if slope > _LARGEST_SLOPE else "less than that of polished surfaces"
            reason = "do its heights have another unit than its spacings?"
            notes += (f"the mean slope of the surface is {slope:.3g}, {kind}: {reason}",)
        return notes


def read_surface(path: PathLike, format: SurfaceFormat = "any", *, fill: bool = False) -> SurfaceHeights:
    """Read the heights of a surface on a grid.

    Files of instruments, such as x3p, sur, vk4, plux, al3d, datx, opd, gwy and bcrf, are read by the package
    SurfaceTopography where that is installed (``pip install 'fuge[surfaces]'``), in metres.

    Parameters
    ----------
    path : str or path
    format : {'any', 'grid', 'points', 'sdf'}
        'grid': a line for each row; 'points': x, y and height of a point on each line; 'sdf': ISO 25178-71. 'any'
        recognises them, and files of instruments; a few long columns of numbers could be either and are refused.
    fill : bool
        Points that were not measured get the mean height of their neighbours; otherwise they are refused.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    _arrays.choice("format", format, {"any": 0, "grid": 1, "points": 2, "sdf": 3})
    found = _read(path, format, fill)
    for j, i in first_place(np.abs(found.height) > LARGEST):
        raise refusal(path, f"height[{j}, {i}] is out of range: choose another unit of length")
    holes = np.isnan(found.height)
    filled = int(np.count_nonzero(holes))
    if filled == holes.size:
        raise failure(path, "has no point that was measured")
    for j, i in () if fill else first_place(holes):
        place = f"{filled} points were not measured, the first one is height[{j}, {i}]"
        raise refusal(path, f"{place}: let such points be filled")
    height = fill_surface(found.height) if filled > 0 else found.height
    spacing = found.spacing if all(found.spacing) else None
    return SurfaceHeights(height, spacing, found.origin, filled, found.unit, found.header)


def _read(path: PathLike, format: str, fill: bool) -> Heights:
    content, name = read_bytes(path).removeprefix(b"\xef\xbb\xbf"), os.fspath(path)
    instrument = "" if is_sdf(content) else instrument_format(path, content)
    if instrument and format != "any":
        raise failure(path, f"is {instrument}, which fuge does not read as {format!r}")
    if instrument:
        return read_instrument(path, instrument)
    if format == "sdf" or format == "any" and is_sdf(content):
        return read_sdf(name, content)
    rows = read_rows(name, content)
    if format == "any" and rows.values.shape[1] == 3:
        if any(comment_spacings(rows)):
            raise rows.refuse(0, "three columns may be points, but comments give spacings: say by format what they are")
        format = "points"
    return read_points(rows, fill) if format == "points" else read_grid(rows, fill, certain=format == "grid")


def write_surface(path: PathLike, height: ArrayLike, spacing: tuple[float, float] | None = None) -> None:
    """Write heights of shape (ny, nx) as a plain grid of 17 digits; an existing file is replaced.

    Parameters
    ----------
    path : str or path
    height : array_like, shape (ny, nx)
    spacing : (float, float), optional
        Along x and y, for the comments from which ``read_surface`` takes them; 0 where unknown.

    Raises
    ------
    InputError
        A number is not finite, or a spacing is negative; nothing is written.
    FileError
        The file cannot be written; it is empty then.
    """
    heights = checked_heights(height)
    steps = np.zeros(2) if spacing is None else _arrays.vector("spacing", spacing, 2)
    check_numbers("spacing", steps)
    refuse_numbers(Status.ERR_WIDTH, "spacing", steps, steps < 0.0, "is negative: pass 0 if it is unknown")
    row = " ".join(["%.16e"] * heights.shape[1]) + "\n"
    comments = (f"# spacing_{axis} = {step:.16e}\n" for axis, step in zip("xy", steps) if step > 0.0)
    write_text(path, chain(comments, (row % tuple(line.tolist()) for line in heights)))
