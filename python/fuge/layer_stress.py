"""Stresses and displacements in bodies of layers, below the centres of equal cells side by side, by FFT.

With 'periodic' the mean pressure gives the half-space below the layers no stress along the surface, and the layers the
same strain as it has. On a rigid base layers have no strain along the surface, and those that slide on it no resultant
force along it: both are the limit of long waves in one direction. Displacements count from the mean at each depth, on a
rigid base from the base, as those of the operator.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge._library import struct, struct_array
from fuge.halfplane import Element
from fuge.layers import Layers, layers_of
from fuge.operators import AreaBoundary, Boundary
from fuge.stress_grid import area_arguments, line_arguments
from fuge.stress_peak import MEASURES, Measure


@dataclass(frozen=True)
class InterfaceStress:
    """The largest stresses of the surface of a body of layers, or of an interface.

    Attributes
    ----------
    depth : float
        0 at the surface; length.
    tension_above, tension_below : float
        The largest principal stress, tension positive, on both sides of the interface; at the surface, and at a rigid
        base, both are those in the layers; force per length^2.
    shear, opening : float
        The largest shear stress between both sides, and the largest stress zz.
    cell_above, cell_below, cell_of_shear, cell_of_opening : tuple of int
        The cells above them: (i,) of a line, (row, column) of an area.
    """

    depth: float
    tension_above: float
    tension_below: float
    shear: float
    opening: float
    cell_above: tuple[int, ...]
    cell_below: tuple[int, ...]
    cell_of_shear: tuple[int, ...]
    cell_of_opening: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class LayerPeak:
    """The largest von Mises or Tresca stress in a body of layers.

    Attributes
    ----------
    value : float
        Force per length^2; 0 without forces.
    depth : float
        Length.
    layer : int
        0 is the top layer, the last number the substrate; layers that are bonded to the same material are one with it.
    cell : tuple of int
        The cell above it: (i,) of a line, (row, column) of an area.
    tensor : ndarray, shape (6,)
        xx, yy, zz, yz, xz, xy there.
    """

    value: float
    depth: float
    layer: int
    cell: tuple[int, ...]
    tensor: NDArray[np.float64]


def _at_depths(
    name: str,
    layers: Layers,
    arguments: list[Any],
    depth: ArrayLike,
    below: ArrayLike,
    grid: tuple[int, ...],
    components: int,
) -> NDArray[np.float64]:
    depths = _arrays.vector("depth", np.atleast_1d(_arrays.array("depth", depth)))
    sides = _arrays.spread_flags("below", below, depths.shape)
    result = np.empty((depths.size, *grid, components))
    body = layers_of(layers)[:-1]
    call(name, *body, *arguments, depths.size, depths, sides, result, shapes={"force": grid})
    return result


def layered_halfplane_stress_grid(
    layers: Layers,
    spacing: float,
    force: ArrayLike,
    depth: ArrayLike,
    boundary: Boundary = "free",
    *,
    element: Element = "mean",
    below: ArrayLike = False,
) -> NDArray[np.float64]:
    """Stresses in a body of layers, in plane strain, below the centres of its cells.

    Parameters
    ----------
    layers : Layers
        The stresses are those in the body that it describes, not in the other one.
    spacing, force, depth, boundary
        As in :func:`halfplane_stress_grid`.
    element : {'mean', 'centre'}
        Strips of pressure.
    below : bool or array_like, shape (d,)
        At an interface: False, just above it; True, just below it. There xx differs.

    Returns
    -------
    ndarray, shape (d, n, 3)
        xx, zz, xz below each cell at each depth; force per length^2.
    """
    arguments = line_arguments(spacing, force, element, boundary)
    return _at_depths("fuge_layered_halfplane_stress_grid", layers, arguments, depth, below, (arguments[0],), 3)


def layered_halfplane_displacement_grid(
    layers: Layers,
    spacing: float,
    force: ArrayLike,
    depth: ArrayLike,
    boundary: Boundary = "free",
    *,
    element: Element = "mean",
    below: ArrayLike = False,
) -> NDArray[np.float64]:
    """Displacements in a body of layers, in plane strain, shape (d, n, 2): along x and z; length.

    Parameters are those of :func:`layered_halfplane_stress_grid`. The datum is that of
    :class:`LayeredHalfplaneOperator`.
    """
    arguments = line_arguments(spacing, force, element, boundary)
    return _at_depths("fuge_layered_halfplane_displacement_grid", layers, arguments, depth, below, (arguments[0],), 2)


def layered_halfspace_stress_grid(
    layers: Layers,
    spacing_x: float,
    spacing_y: float,
    force: ArrayLike,
    depth: ArrayLike,
    boundary: AreaBoundary = "free",
    *,
    below: ArrayLike = False,
) -> NDArray[np.float64]:
    """Stresses in a body of layers below the centres of its cells.

    Parameters
    ----------
    layers : Layers
        The stresses are those in the body that it describes, not in the other one.
    spacing_x, spacing_y, force, depth, boundary
        As in :func:`halfspace_stress_grid`.
    below : bool or array_like, shape (d,)
        At an interface: False, just above it; True, just below it. There xx, yy and xy differ.

    Returns
    -------
    ndarray, shape (d, ny, nx, 6)
        xx, yy, zz, yz, xz, xy below each cell at each depth; force per length^2.
    """
    grid, arguments = area_arguments(spacing_x, spacing_y, force, boundary)
    return _at_depths("fuge_layered_halfspace_stress_grid", layers, arguments, depth, below, grid, 6)


def layered_halfspace_displacement_grid(
    layers: Layers,
    spacing_x: float,
    spacing_y: float,
    force: ArrayLike,
    depth: ArrayLike,
    boundary: AreaBoundary = "free",
    *,
    below: ArrayLike = False,
) -> NDArray[np.float64]:
    """Displacements in a body of layers, shape (d, ny, nx, 3): along x, y, z below each cell at each depth; length.

    Parameters are those of :func:`layered_halfspace_stress_grid`.
    """
    grid, arguments = area_arguments(spacing_x, spacing_y, force, boundary)
    return _at_depths("fuge_layered_halfspace_displacement_grid", layers, arguments, depth, below, grid, 3)


def _place(cell: int, grid: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(int(i) for i in np.unravel_index(cell, grid))


def _interfaces(name: str, layers: Layers, arguments: list[Any], grid: tuple[int, ...]) -> list[InterfaceStress]:
    body = layers_of(layers)[:-1]
    count = np.zeros(1, dtype=np.intc)
    peaks = struct_array("fuge_interface_stress", body[0] + 1)
    call(name, *body, *arguments, count, peaks, shapes={"force": grid})

    return [
        InterfaceStress(
            peak.depth,
            peak.tension_above,
            peak.tension_below,
            peak.shear,
            peak.opening,
            _place(peak.cell_above, grid),
            _place(peak.cell_below, grid),
            _place(peak.cell_of_shear, grid),
            _place(peak.cell_of_opening, grid),
        )
        for peak in peaks[: int(count[0]) + 1]
    ]


def layered_halfplane_interfaces(
    layers: Layers, spacing: float, force: ArrayLike, boundary: Boundary = "free", *, element: Element = "mean"
) -> list[InterfaceStress]:
    """The largest stresses of the surface, and of each interface from above, below a line of cells.

    Parameters are those of :func:`layered_halfplane_stress_grid`. Layers that are bonded to the same material are one
    with it.
    """
    arguments = line_arguments(spacing, force, element, boundary)
    return _interfaces("fuge_layered_halfplane_interfaces", layers, arguments, (arguments[0],))


def layered_halfspace_interfaces(
    layers: Layers, spacing_x: float, spacing_y: float, force: ArrayLike, boundary: AreaBoundary = "free"
) -> list[InterfaceStress]:
    """The largest stresses of the surface, and of each interface from above, below a grid of cells.

    Parameters are those of :func:`layered_halfspace_stress_grid`. Layers that are bonded to the same material are one
    with it. At the surface stresses jump from cell to cell at the edge of the contact, and their error is of the order
    of a cell.
    """
    grid, arguments = area_arguments(spacing_x, spacing_y, force, boundary)
    return _interfaces("fuge_layered_halfspace_interfaces", layers, arguments, grid)


def _peak(name: str, layers: Layers, arguments: list[Any], measure: Measure, grid: tuple[int, ...]) -> LayerPeak:
    peak = struct("fuge_layer_peak")
    body = layers_of(layers)[:-1]
    call(name, *body, *arguments, MEASURES.number(measure), ctypes.byref(peak), shapes={"force": grid})
    return LayerPeak(peak.value, peak.depth, peak.layer, _place(peak.cell, grid), np.array(peak.tensor))


def layered_halfplane_peak(
    layers: Layers,
    spacing: float,
    force: ArrayLike,
    boundary: Boundary = "free",
    measure: Measure = "von_mises",
    *,
    element: Element = "mean",
) -> LayerPeak:
    """The largest von Mises or Tresca stress in a body of layers below a line of cells, in plane strain.

    Parameters are those of :func:`layered_halfplane_stress_grid`, and the measure of :func:`halfplane_peak`. It is that
    of all layers, both sides of their interfaces, the surface, and all depths from a quarter of a cell on.
    """
    arguments = line_arguments(spacing, force, element, boundary)
    return _peak("fuge_layered_halfplane_peak", layers, arguments, measure, (arguments[0],))


def layered_halfspace_peak(
    layers: Layers,
    spacing_x: float,
    spacing_y: float,
    force: ArrayLike,
    boundary: AreaBoundary = "free",
    measure: Measure = "von_mises",
) -> LayerPeak:
    """The largest von Mises or Tresca stress in a body of layers below a grid of cells.

    Parameters are those of :func:`layered_halfspace_stress_grid`, and the measure of :func:`halfspace_peak`. It is that
    below the centres of cells, of all layers, both sides of their interfaces, the surface, and all depths from a
    quarter of a cell on.
    """
    grid, arguments = area_arguments(spacing_x, spacing_y, force, boundary)
    return _peak("fuge_layered_halfspace_peak", layers, arguments, measure, grid)
