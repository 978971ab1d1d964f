"""Results on grids for ParaView."""

from __future__ import annotations

import os
from typing import Any, Mapping

import numpy as np
from numpy.typing import ArrayLike

from fuge import _arrays
from fuge._calls import call
from fuge.formats.text import PathLike


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
    call("fuge_write_results", os.fsencode(path), nx, ny, steps, start, *named, shapes={"value": (ny, nx)})
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
        Such as the components of :meth:`Field.grid_stress`.
    """
    depths = _arrays.vector("depth", depth)
    shape = _grid_shape(results, "d", "ny", "nx")
    named, kept = _named(results, (depths.size, *shape[1:]))
    start = None if origin is None else _arrays.vector("origin", origin, 2)
    steps = _arrays.vector("spacing", spacing, 2)
    grid = [os.fsencode(path), shape[2], shape[1], steps, start, depths.size, depths]
    call("fuge_write_volume", *grid, *named, shapes={"value": shape})
    del kept
