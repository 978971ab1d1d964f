"""Cuts through the bodies under a contact: where fuge.plot shows stresses, and the largest shear stresses there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fuge.cells import Cells
from fuge.errors import Status, error
from fuge.field import Field
from fuge.stress_measures import tresca

Doubles = NDArray[np.float64]

# Largest number of columns of a picture, and number of its depths.
_COLUMNS = 240
_DEPTHS = 81
# Stresses are computed for at most this many cells at once, those at all depths together.
_ROOM = 2**21
# At each depth, transforms take as long for each cell of the grid as this many stresses at a point by one loaded cell.
_TRANSFORMS = 50
# How far a picture goes beside and below a contact, relative to its length.
_BESIDE = 0.75
_BELOW = 1.25


@dataclass(frozen=True)
class Cut:
    """Shear stresses in a cut: shear[k, i] is the largest one at depth[k] below place[i].

    The forces begin at `left` and end at `right`; on a grid these and `place` count from its middle. Above the depth
    `resolved` the cells are too wide to show how large a stress is; it is infinite if the pressure has no limit.
    """

    place: Doubles
    depth: Doubles
    shear: Doubles
    left: float
    right: float
    resolved: float

    @property
    def largest(self) -> tuple[int, int]:
        """Indices of the largest stress in the picture."""
        k, i = np.unravel_index(int(np.nanargmax(self.shear)), self.shear.shape)
        return int(k), int(i)


def segment_around(pressed: NDArray[np.bool_], peak: int) -> tuple[int, int]:
    """First and last cell of the segment of cells in contact that contains the cell `peak`."""
    open_cells = np.flatnonzero(~pressed)
    before, after = open_cells[open_cells < peak], open_cells[open_cells > peak]
    first = int(before[-1]) + 1 if before.size else 0
    last = int(after[0]) - 1 if after.size else pressed.size - 1
    return first, last


def peak_cell(force: Doubles) -> tuple[int, ...]:
    """Indices of the largest force, or an error if no force is positive."""
    if not force.max() > 0.0:
        raise error(Status.ERR_OPTION, "no point carries a force, so there is no stress: press harder")
    return tuple(int(k) for k in np.unravel_index(int(force.argmax()), force.shape))


def cut_through(field: Field, axis: int, below: float | None) -> Cut:
    """The cut through the largest pressure, down to the depth `below`, or to one that fits the contact."""
    areas = len(field._loads.axes) == 2 if field.cells is None else len(field.cells.shape) == 2
    if axis == 1 and not areas:
        raise error(Status.ERR_OPTION, "along='y' is for areas: on a line the cut is along x")
    if field.cells is None:
        return _through_loads(field, axis, below)
    return _through_cells(field, field.cells, axis, below)


def _depths(field: Field, length: float, below: float | None) -> Doubles:
    """Depths below a contact of this length, none of them in a rigid base."""
    return np.linspace(0.0, min(below or _BELOW * length, field._bottom), _DEPTHS)


def _points(x: Doubles | float, y: Doubles | float, depth: Doubles) -> Doubles:
    return np.stack(np.broadcast_arrays(x, y, depth[:, None]), axis=-1)


def _through_loads(field: Field, axis: int, below: float | None) -> Cut:
    """Of cells of any widths and of punches without a grid."""
    force, axes, resolved = field._loads
    peak_cell(np.abs(force))
    loaded = force != 0.0
    middle, width, symmetric = axes[axis]
    left, right = float(np.min((middle - width / 2)[loaded])), float(np.max((middle + width / 2)[loaded]))
    left = -right if symmetric else left
    pressure = force / np.prod([width for _, width, _ in axes], axis=0)
    across = float(axes[1 - axis][0][pressure.argmax()]) if len(axes) == 2 else 0.0
    beside = _BESIDE * (right - left)
    # The pressure may have no limit at the ends and in the middle: no place is there, and no depth is zero.
    place = np.linspace(left - beside, right + beside, _COLUMNS)
    depth = _depths(field, right - left, below)
    depth[0] = 0.02 * depth[1]
    along = np.abs(place) if symmetric else place
    points = _points(along, across, depth) if axis == 0 else _points(across, along, depth)
    unlimited = resolved == 0.0 and field.largest("tresca").location == "singular"
    return Cut(place, depth, tresca(field.stress(points)) / 2, left, right, np.inf if unlimited else resolved)


def _through_cells(field: Field, cells: Cells, axis: int, below: float | None) -> Cut:
    """Of equal cells."""
    force = field._loads.force
    peak = peak_cell(force)
    row = force if force.ndim == 1 else (force[peak[0]] if axis == 0 else force[:, peak[1]])
    first, last = segment_around(row > 0.0, peak[-1] if axis == 0 else peak[0])
    width = cells.spacing[axis]
    length = (last - first + 1) * width
    beside = max(int(np.ceil(_BESIDE * (last - first + 1))), 3)
    begin, end = max(first - beside, 0), min(last + beside, row.size - 1)
    if begin == end:
        raise error(Status.ERR_GRID, "a cut needs two cells and more: take the stress of the field at points")
    columns = np.unique(np.linspace(begin, end, min(end - begin + 1, _COLUMNS)).astype(int))
    where = (columns,) if force.ndim == 1 else ((peak[0], columns) if axis == 0 else (columns, peak[1]))
    depth = _depths(field, length, below)
    place = cells.centres(axis)
    left = float(place[first]) - 0.5 * width
    shear = tresca(_tensors(field, cells, where, depth)) / 2
    return Cut(place[columns], depth, shear, left, left + length, width)


def _tensors(field: Field, cells: Cells, where: tuple[Any, ...], depth: Doubles) -> Doubles:
    """Tensors below the cells with these indices, (depths, columns, 6)."""
    force = field._loads.force
    columns = max(np.size(k) for k in where)
    few = np.count_nonzero(force) * columns <= _TRANSFORMS * force.size
    if few and cells.boundary == "free" and cells.layers is None:
        x, y = [k * spacing for k, spacing in zip(where[::-1], cells.spacing)] + [0.0] * (2 - len(where))
        return field.stress(_points(x, y, depth))
    return np.concatenate([field.grid_stress(batch)[(slice(None), *where)] for batch in _batches(depth, force.size)])


def _batches(depth: Doubles, cells: int) -> list[Doubles]:
    """The depths, split so that a grid of this number of cells has room for each batch."""
    return np.array_split(depth, min(-(-depth.size * cells // _ROOM), depth.size))
