"""Cuts through the bodies under a contact: where fuge.plot shows stresses, and the largest shear stresses there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import NDArray

from fuge.cells import Cells
from fuge.contact import Contact
from fuge.errors import Status, error
from fuge.halfplane import Element
from fuge.operators import AreaBoundary, Boundary
from fuge.smooth import RoundContact, SmoothContact
from fuge.stress import halfplane_stress, halfspace_stress
from fuge.stress_grid import halfplane_stress_grid, halfspace_stress_grid
from fuge.stress_measures import halfplane_tensor, round_tensor, tresca

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

    The contact begins at `left` and ends at `right`; on a grid these and `place` count from its middle. Above the depth
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


def cut_through(
    contact: Contact | SmoothContact | RoundContact, poisson: float, along: str, below: float | None
) -> Cut:
    """The cut through the largest pressure, down to the depth `below`, or to one that fits the contact."""
    if not isinstance(contact, Contact):
        place, depth = _points(*ends(contact), below)
        if isinstance(contact, RoundContact):
            tensor = round_tensor(contact.stress(poisson, np.abs(place), depth[:, None]))
        else:
            tensor = halfplane_tensor(contact.stress(place, depth[:, None]), poisson)
        unlimited = contact.peak(poisson, "tresca").location == "singular"
        return Cut(place, depth, tresca(tensor) / 2, *ends(contact), np.inf if unlimited else 0.0)
    if contact.cells is None:
        raise error(
            Status.ERR_GRID,
            "the operator does not know its cells, so there are no stresses to draw: use HalfplaneOperator or "
            "HalfspaceOperator, or functions such as fuge.halfplane_stress with the cells and the forces",
        )
    if not contact.cells.homogeneous:
        raise error(
            Status.ERR_UNSUPPORTED,
            "fuge.plot.stress draws the stresses in a homogeneous half-plane or half-space, but this body has layers, "
            "or is that of a CallbackOperator, which is only close to one: draw the pressure by fuge.plot.map or "
            "fuge.plot.line",
        )
    return _cut_through_cells(contact, contact.cells, poisson, along, below)


def ends(contact: SmoothContact | RoundContact) -> tuple[float, float]:
    """Where a contact without a grid begins and ends, along x."""
    if isinstance(contact, RoundContact):
        return -contact.radius, contact.radius
    return contact.left, contact.right


def _points(left: float, right: float, below: float | None) -> tuple[Doubles, Doubles]:
    """Places about an interval and depths below it."""
    length = right - left
    if not length > 0.0:
        raise error(Status.ERR_OPTION, "the bodies touch without a force, so there is no stress: press harder")
    beside = _BESIDE * length
    # The pressure may have no limit at the ends and in the middle: no place is there, and no depth is zero.
    place = np.linspace(left - beside, right + beside, _COLUMNS)
    depth = np.linspace(0.0, below or _BELOW * length, _DEPTHS)
    depth[0] = 0.02 * depth[1]
    return place, depth


def _cut_through_cells(contact: Contact, cells: Cells, poisson: float, along: str, below: float | None) -> Cut:
    force = contact.force.reshape(cells.shape)
    peak = peak_cell(force)
    if along == "y" and len(cells.shape) == 1:
        raise error(Status.ERR_OPTION, "along='y' is for areas: on a line the cut is along x")
    axis = 1 if along == "y" else 0
    row = force if force.ndim == 1 else (force[peak[0]] if axis == 0 else force[:, peak[1]])
    first, last = segment_around(row > 0.0, peak[-1] if axis == 0 else peak[0])
    width = cells.spacing[axis]
    length = (last - first + 1) * width
    beside = max(int(np.ceil(_BESIDE * (last - first + 1))), 3)
    begin, end = max(first - beside, 0), min(last + beside, row.size - 1)
    if begin == end:
        raise error(Status.ERR_GRID, "a cut needs two cells and more: use functions such as fuge.halfplane_stress")
    columns = np.unique(np.linspace(begin, end, min(end - begin + 1, _COLUMNS)).astype(int))
    depth = np.linspace(0.0, below or _BELOW * length, _DEPTHS)
    if force.ndim == 1:
        tensor = halfplane_tensor(_line_stress(force, cells, columns, depth), poisson)
    else:
        tensor = _area_stress(force, cells, poisson, peak, axis, columns, depth)
    place = cells.centres(axis)
    left = float(place[first]) - 0.5 * width
    return Cut(place[columns], depth, tresca(tensor) / 2, left, left + length, width)


def _line_stress(force: Doubles, cells: Cells, columns: NDArray[np.intp], depth: Doubles) -> Doubles:
    """xx, zz, xz, (depths, columns, 3)."""
    element, width, x = cast(Element, cells.element), cells.spacing[0], cells.centres(0)
    loaded = force != 0.0
    if cells.boundary == "free" and np.count_nonzero(loaded) * columns.size <= _TRANSFORMS * force.size:
        return halfplane_stress(x[loaded], width, force[loaded], element, x[columns], depth[:, None])
    boundary = cast(Boundary, cells.boundary)
    batches = _batches(depth, force.size)
    return np.concatenate(
        [halfplane_stress_grid(width, force, element, batch, boundary)[:, columns] for batch in batches]
    )


def _batches(depth: Doubles, cells: int) -> list[Doubles]:
    """The depths, split so that a grid of this number of cells has room for each batch."""
    return np.array_split(depth, min(-(-depth.size * cells // _ROOM), depth.size))


def _area_stress(
    force: Doubles,
    cells: Cells,
    poisson: float,
    peak: tuple[int, ...],
    axis: int,
    columns: NDArray[np.intp],
    depth: Doubles,
) -> Doubles:
    """Tensors, (depths, columns, 6)."""
    width_x, width_y = cells.spacing
    loaded = force != 0.0
    if cells.boundary == "free" and np.count_nonzero(loaded) * columns.size <= _TRANSFORMS * force.size:
        x, y = np.meshgrid(cells.centres(0), cells.centres(1))
        px = cells.centres(0)[columns if axis == 0 else peak[1]]
        py = cells.centres(1)[columns if axis == 1 else peak[0]]
        return halfspace_stress(
            x[loaded], y[loaded], width_x, width_y, force[loaded], poisson, px, py, depth[:, None]
        )
    boundary = cast(AreaBoundary, cells.boundary)
    tensors = []
    for batch in _batches(depth, force.size):
        stress = halfspace_stress_grid(width_x, width_y, force, poisson, batch, boundary)
        tensors.append(stress[:, peak[0], columns] if axis == 0 else stress[:, columns, peak[1]])
    return np.concatenate(tensors)
