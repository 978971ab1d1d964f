"""Points of an operator that are equal cells, on a line or an area."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fuge.errors import Status, error
from fuge.layers import Layers


@dataclass(frozen=True)
class Cells:
    """Equal cells side by side.

    Attributes
    ----------
    shape : tuple of int
        (n,) on a line, (ny, nx) on an area.
    spacing : tuple of float
        Width along x, and on an area along y; length.
    boundary : {'free', 'periodic', 'periodic_x', 'periodic_y'}
        What lies beyond the cells.
    element : {'centre', 'mean', 'hat'}
        What a force and a displacement stand for, as in :func:`halfplane_matrix`.
    homogeneous : bool
        The body is a half-plane or a half-space; False for layers, and for a callback operator that is only
        close to one.
    layers : Layers or None
        The body, if it has layers.
    """

    shape: tuple[int, ...]
    spacing: tuple[float, ...]
    boundary: str
    element: str
    homogeneous: bool = True
    layers: Layers | None = None

    @property
    def size(self) -> float:
        """Area of a cell, on a line its width: the pressure is the force over it."""
        return float(np.prod(self.spacing))

    @property
    def periodic(self) -> tuple[bool, ...]:
        """Whether the cells repeat along x, and on an area along y."""
        axes = "xy"[: len(self.spacing)]
        return tuple(self.boundary in ("periodic", f"periodic_{axis}") for axis in axes)

    def centres(self, axis: int) -> NDArray[np.float64]:
        """Coordinates of the centres along x (axis 0) or y (axis 1), from the middle of the grid; length."""
        n = self.shape[::-1][axis]
        return self.spacing[axis] * (np.arange(n, dtype=np.float64) - 0.5 * (n - 1))


def known_cells(cells: Cells | None) -> Cells:
    """The cells of an operator, of which a pressure needs the area; an error if it does not know them."""
    if cells is None:
        raise error(
            Status.ERR_GRID,
            "the operator does not know the areas of its points, so there is no pressure: use forces, which are "
            "pressures times the area, or the width, of each cell, or use HalfplaneOperator or HalfspaceOperator",
        )
    return cells


def pressure_of(force: NDArray[np.float64], cells: Cells | None) -> NDArray[np.float64]:
    """Forces over the area of a cell, in the same shape."""
    return force / known_cells(cells).size
