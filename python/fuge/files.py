"""Profiles and surfaces in files; doc/files.md describes the formats."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Literal, Mapping, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge._instruments import REMARK, read_instrument
from fuge._words import Words
from fuge.errors import FileError, Status

PathLike = Union[str, "os.PathLike[str]"]
SurfaceFormat = Literal["any", "grid", "points", "sdf"]

ProfileForm = Literal["mean", "line"]
SurfaceForm = Literal["mean", "plane"]

SURFACE_FORMATS = Words("format", SurfaceFormat, "FILE_")
PROFILE_FORMS = Words("form", ProfileForm, "LEVEL_")
SURFACE_FORMS = Words("form", SurfaceForm, "LEVEL_")


def encoded(path: PathLike) -> bytes:
    """The name of a file as C takes it."""
    return os.fsencode(path)


def _counts(number: int) -> list[NDArray[np.intc]]:
    return [np.zeros(1, dtype=np.intc) for _ in range(number)]


def _value(count: NDArray[np.intc]) -> int:
    return int(count[0])


# ---- profiles


def read_profile(path: PathLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read a profile: x, strictly increasing, and heights z, positive upwards.

    The initial gap of two profiles is upper - lower.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    (count,) = _counts(1)
    call("fuge_read_profile", encoded(path), 0, None, None, count)
    x, z = np.empty(_value(count)), np.empty(_value(count))
    call("fuge_read_profile", encoded(path), x.size, x, z, count)
    return x, z


def sample_profile(x: ArrayLike, z: ArrayLike, centre: ArrayLike) -> NDArray[np.float64]:
    """Heights of a profile at places within it, of any shape, by linear interpolation; length."""
    places = _arrays.vector("x", x)
    centres = _arrays.doubles("centre", centre)
    height = np.empty(centres.shape)
    call(
        "fuge_sample_profile",
        places.size,
        places,
        _arrays.vector("z", z, places.size),
        centres.size,
        centres,
        height,
    )
    return height


def level_profile(x: ArrayLike, z: ArrayLike, form: ProfileForm) -> NDArray[np.float64]:
    """Heights without their mean, or without the least-squares line; each weighted by the length it stands for."""
    places = _arrays.vector("x", x)
    heights = _arrays.vector("z", z, places.size).copy()
    call("fuge_level_profile", places.size, places, heights, PROFILE_FORMS.number(form))
    return heights


# ---- surfaces


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
        'm' if a file of an instrument gives its unit; otherwise None, and lengths are in the unit of the file (SDF:
        metres).
    """

    height: NDArray[np.float64]
    spacing: tuple[float, float] | None
    origin: tuple[float, float]
    filled: int
    unit: str | None = None


def read_surface(path: PathLike, format: SurfaceFormat = "any", *, fill: bool = False) -> SurfaceHeights:
    """Read the heights of a surface on a grid.

    Other files of instruments, such as x3p, sur, vk4, plux, al3d, datx, opd and gwy, are read by the package
    SurfaceTopography where that is installed, in metres.

    Parameters
    ----------
    path : str or path
    format : {'any', 'grid', 'points', 'sdf'}
        'grid': a line for each row; 'points': x, y and height of a point on each line; 'sdf': ISO 25178-71. 'any'
        recognises them, and files of instruments.
    fill : bool
        Points that were not measured get the mean height of their neighbours; otherwise they are refused.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    try:
        return _read_text(path, format, fill)
    except FileError as unknown:
        if format != "any" or REMARK not in unknown.message:
            raise
        message = unknown.message
    height, spacing, unit = read_instrument(path, message)
    holes = np.argwhere(np.isnan(height))
    if len(holes) > 0 and not fill:
        raise FileError(
            f"{path}: {len(holes)} points were not measured, the first one is height[{holes[0][0]}, {holes[0][1]}]: "
            "let them be filled by fill=True",
            Status.ERR_FILE,
        )
    if len(holes) == height.size:
        raise FileError(f"{path} has no point that was measured", Status.ERR_FILE)
    if len(holes) > 0:
        height = fill_surface(height)
    return SurfaceHeights(height, spacing, (0.0, 0.0), len(holes), unit)


def _read_text(path: PathLike, format: SurfaceFormat, fill: bool) -> SurfaceHeights:
    arguments = [encoded(path), SURFACE_FORMATS.number(format), int(bool(fill))]
    nx, ny, filled = _counts(3)
    spacing, origin = np.empty(2), np.empty(2)
    call("fuge_read_surface", *arguments, 0, None, nx, ny, spacing, origin, filled)
    height = np.empty((_value(ny), _value(nx)))
    call("fuge_read_surface", *arguments, height.size, height, nx, ny, spacing, origin, filled)
    known = (float(spacing[0]), float(spacing[1])) if spacing.all() else None
    return SurfaceHeights(height, known, (float(origin[0]), float(origin[1])), _value(filled))


def write_surface(path: PathLike, height: ArrayLike, spacing: tuple[float, float] | None = None) -> None:
    """Write heights of shape (ny, nx) as a plain grid of 17 digits; an existing file is replaced."""
    heights = _arrays.doubles("height", height, ("ny", "nx"))
    ny, nx = heights.shape
    steps = None if spacing is None else _arrays.vector("spacing", spacing, 2)
    call("fuge_write_surface", encoded(path), nx, ny, steps, heights, shapes={"height": heights.shape})


def fill_surface(height: ArrayLike) -> NDArray[np.float64]:
    """Heights of shape (ny, nx) without holes: each NaN gets the mean height of its neighbours, from the rim inwards.

    As ``read_surface(.., fill=True)`` fills the points of a file that were not measured. An array with masked elements
    goes in as ``numpy.ma.filled(height, numpy.nan)``.

    Raises
    ------
    InputError
        All heights are NaN, or one of them is infinite.
    """
    heights = _arrays.doubles("height", height, ("ny", "nx")).copy()
    ny, nx = heights.shape
    call("fuge_fill_surface", nx, ny, heights, None, shapes={"height": heights.shape})
    return heights


def level_surface(height: ArrayLike, form: SurfaceForm) -> NDArray[np.float64]:
    """Heights of shape (ny, nx) without their mean, or without the least-squares plane."""
    heights = _arrays.doubles("height", height, ("ny", "nx")).copy()
    ny, nx = heights.shape
    chosen = SURFACE_FORMS.number(form)
    call("fuge_level_surface", nx, ny, heights, chosen, shapes={"height": heights.shape})
    return heights


# ---- pictures


def _named(results: Mapping[str, ArrayLike], shape: tuple[int, ...]) -> tuple[list[Any], Any]:
    """C arrays of names and results, and what keeps them alive."""
    arrays = [_arrays.doubles(f"the result {name!r}", result, shape) for name, result in results.items()]
    return [len(arrays), _arrays.texts(results), _arrays.addresses(arrays)], arrays


def _grid_shape(results: Mapping[str, ArrayLike], *dimensions: str) -> tuple[int, ...]:
    for name, result in results.items():
        shape = np.shape(result)
        _arrays.check_shape(f"the result {name!r}", shape, dimensions)
        return shape
    return (0,) * len(dimensions)


def write_results(
    path: PathLike,
    spacing: tuple[float, float],
    results: Mapping[str, ArrayLike],
    *,
    origin: tuple[float, float] | None = None,
) -> None:
    """Write results on the cells of a grid for ParaView, a VTI file; an existing file is replaced.

    Parameters
    ----------
    path : str or path
    spacing : (float, float)
        Sizes of a cell along x and y; length.
    results : dict of array_like, shape (ny, nx)
        By their names.
    origin : (float, float), optional
        Centre of the first cell; length.
    """
    ny, nx = _grid_shape(results, "ny", "nx")
    named, kept = _named(results, (ny, nx))
    start = None if origin is None else _arrays.vector("origin", origin, 2)
    steps = _arrays.vector("spacing", spacing, 2)
    call("fuge_write_results", encoded(path), nx, ny, steps, start, *named, shapes={"value": (ny, nx)})
    del kept


def write_volume(
    path: PathLike,
    spacing: tuple[float, float],
    depth: ArrayLike,
    results: Mapping[str, ArrayLike],
    *,
    origin: tuple[float, float] | None = None,
) -> None:
    """Write results below the cells of a grid, at several depths, for ParaView: a VTR file.

    Parameters
    ----------
    path, spacing, origin
        As in :func:`write_results`.
    depth : array_like, shape (d,)
        Ascending; length.
    results : dict of array_like, shape (d, ny, nx)
        Such as the components of :func:`halfspace_stress_grid`.
    """
    depths = _arrays.vector("depth", depth)
    shape = _grid_shape(results, "d", "ny", "nx")
    named, kept = _named(results, (depths.size, *shape[1:]))
    start = None if origin is None else _arrays.vector("origin", origin, 2)
    steps = _arrays.vector("spacing", spacing, 2)
    size = [shape[2], shape[1]]
    call("fuge_write_volume", encoded(path), *size, steps, start, depths.size, depths, *named, shapes={"value": shape})
    del kept
