"""Surfaces in text: a grid with a line for each row of points, or a line with x, y and height for each point."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge.errors import FileError
from fuge.formats.rows import Rows, number
from fuge.formats.text import Reason, located, quoted, refusal
from fuge.heights import first_place

_MICROMETRES = {"um", "\N{MICRO SIGN}m", "\N{GREEK SMALL LETTER MU}m"}
_ANGSTROMS = {"\N{ANGSTROM SIGN}", "\N{LATIN CAPITAL LETTER A WITH RING ABOVE}"}
METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "nm": 1e-9, "pm": 1e-12}
# The last is the micro sign in UTF-8 read as Latin-1, as in files .sur of programs other than MountainsMap.
METRES.update(dict.fromkeys([*_MICROMETRES, "\N{LATIN CAPITAL LETTER A WITH CIRCUMFLEX}\N{MICRO SIGN}m"], 1e-6))
METRES.update(dict.fromkeys(_ANGSTROMS, 1e-10))

# Points may have colours and normals after their positions; measured grids have more columns than those.
_FEWEST_COLUMNS = 10

_SPACING = re.compile(r"# spacing_([xy]) =[ \t]*([^ \t\r]+)[ \t\r]*")
# Gwyddion writes the sizes of the whole surface.
_GWYDDION = re.compile(r"# Width: (\S+) (\S+)\s*\n# Height: (\S+) (\S+)\s*\n# Value units: (\S+)\s*(?:\n|$)")
_TELLS_LENGTHS = re.compile(r"spacing|pixel|\bunits?\b|(?<![a-z])[munpc\xb5\u03bc]m(?![a-z])", re.IGNORECASE)
_NOTED_LINES = 4

# Coordinates that differ by less than this fraction of the widest step are one position, from which a coordinate may be
# off by the other: coordinates in files are rounded.
_SAME_POSITION, _TOLERANCE = 0.25, 0.05


class Heights(NamedTuple):
    """Heights of shape (ny, nx), NaN where nothing was measured, with spacings along x and y, 0 where unknown."""

    height: NDArray[np.float64]
    spacing: tuple[float, float] = (0.0, 0.0)
    origin: tuple[float, float] = (0.0, 0.0)
    unit: str | None = None
    header: tuple[str, ...] = ()


def _positive(word: str) -> float:
    """A number > 0, or 0 for any other word."""
    try:
        return max(number(word), 0.0)
    except Reason:
        return 0.0


def comment_spacings(rows: Rows) -> tuple[float, float]:
    """The spacings in comments before the rows, those that are a positive number and nothing else; 0 for others."""
    found = {"x": 0.0, "y": 0.0}
    for match in filter(None, map(_SPACING.fullmatch, rows.header)):
        found[match[1]] = _positive(match[2]) or found[match[1]]
    return found["x"], found["y"]


def _gwyddion_sizes(rows: Rows) -> tuple[float, float, float] | None:
    """Width and height of the surface in metres, and the unit of its heights, from the header of Gwyddion."""
    match = _GWYDDION.search("\n".join(rows.header))
    if match is None or not {match[2], match[4], match[5]} <= set(METRES):
        return None
    width, height = METRES[match[2]] * _positive(match[1]), METRES[match[4]] * _positive(match[3])
    return (width, height, METRES[match[5]]) if width > 0.0 and height > 0.0 else None


def _header_note(rows: Rows, made_of_it: str = "is not used") -> tuple[str, ...]:
    """What a header says about lengths, apart from comments with spacings."""
    taken = [line for line in rows.header for match in [_SPACING.fullmatch(line)] if match and _positive(match[2])]
    told = [line for line in rows.header if _TELLS_LENGTHS.search(line) and line not in taken]
    shown = ", ".join(quoted(line.strip()) for line in told[:_NOTED_LINES])
    return (f"what its header says about lengths {made_of_it}: {shown}",) if told else ()


def _unmeasured(rows: Rows, row: int, column: int) -> FileError:
    return rows.refuse(row, f"column {column + 1} has no height, the point was not measured: let such points be filled")


def read_grid(rows: Rows, fill: bool, certain: bool) -> Heights:
    """Heights of a grid, with the spacings in comments or in the header of Gwyddion.

    Few columns are refused, since they may be points, unless it is `certain` that this is a grid.
    """
    height = rows.values
    ny, nx = height.shape
    spacing, sizes = comment_spacings(rows), _gwyddion_sizes(rows)
    if nx < min(_FEWEST_COLUMNS, ny) and not (certain or sizes or any(spacing)):
        raise rows.refuse(
            0,
            f"{ny} rows of {nx} columns may be points or profiles: of points keep x, y and height only; if they are a "
            "grid, write # spacing_x = .. and # spacing_y = .. before them, or pass format='grid'",
        )
    for row, column in () if fill else first_place(np.isnan(height)):
        raise _unmeasured(rows, row, column)
    if any(spacing) or sizes is None:
        return Heights(height, spacing, header=_header_note(rows))
    note = _header_note(rows, "is used, and all is brought to metres")
    return Heights(height * sizes[2], (sizes[0] / nx, sizes[1] / ny), unit="m", header=note)


def _fitted_axis(x: NDArray[np.float64], name: str) -> tuple[float, float, int, NDArray[np.intp]]:
    """The regular positions first + step*k, k < n, that fit coordinates best, by least squares: first, step, n, each k.

    Reason if a coordinate is off its position.
    """
    distinct = np.unique(x)
    gaps = np.diff(distinct)
    if gaps.size == 0:
        return float(x[0]), 0.0, 1, np.zeros(x.size, dtype=np.intp)
    begins = np.append(distinct[0], distinct[1:][gaps > _SAME_POSITION * gaps.max()])
    k = np.searchsorted(begins, x, side="right") - 1
    step = (distinct[-1] - distinct[0]) / (begins.size - 1)
    # How far coordinates are off, in steps: what is linear in k corrects the positions.
    off = (x - distinct[0]) / step - k
    slope = (k - k.mean()) @ off / np.square(k - k.mean()).sum()
    shift = off.mean() - slope * k.mean()
    wrong = np.abs(off - shift - slope * k) > _TOLERANCE * (1.0 + slope)
    first, step = float(distinct[0] + shift * step), float(step * (1.0 + slope))
    if wrong.any():
        place = (
            f"{name} = {x[np.argmax(wrong)]:.7g} is no multiple of the step {step:.7g} away from {name} = {first:.7g}"
        )
        raise Reason(f"{place}: positions must be a regular grid, or the file is a grid of three columns")
    return first, step, begins.size, k


def read_points(rows: Rows, fill: bool) -> Heights:
    """Heights of points in any order, which form a full regular grid; with `fill` up to half of them may be missing."""
    points = rows.values
    if points.shape[1] != 3:
        raise rows.refuse(0, f"{points.shape[1]} column(s): x, y and the height are needed")
    for row, _ in first_place(np.isnan(points[:, :2])):
        raise rows.refuse(row, "a position is missing: x, y and the height are needed")
    for row, _ in () if fill else first_place(np.isnan(points)):
        raise _unmeasured(rows, row, 2)
    with located(rows.path):
        x, dx, nx, i = _fitted_axis(points[:, 0], "x")
        y, dy, ny, j = _fitted_axis(points[:, 1], "y")
    if nx * ny // 2 > len(points):
        raise refusal(rows.path, f"{len(points)} points are no full grid of {nx} positions x and {ny} positions y")
    place = nx * j + i
    named = np.bincount(place, minlength=nx * ny)
    if named.max() > 1:
        second = int(np.setdiff1d(np.arange(len(place)), np.unique(place, return_index=True)[1])[0])
        position = f"x = {points[second, 0]:.7g}, y = {points[second, 1]:.7g}"
        remedy = "remove one of them, or say that the file is a grid of three columns"
        raise rows.refuse(second, f"a second point at {position}: {remedy}")
    for missing in () if fill else np.flatnonzero(named == 0)[:1]:
        position = f"x = {x + missing % nx * dx:.7g}, y = {y + missing // nx * dy:.7g}"
        remedy = "add it, or let missing points be filled"
        raise refusal(rows.path, f"no point at {position} of a regular grid of {nx} x {ny}: {remedy}")
    height = np.full(nx * ny, np.nan)
    height[place] = points[:, 2]
    return Heights(height.reshape(ny, nx), (dx, dy), (x, y), header=_header_note(rows))
