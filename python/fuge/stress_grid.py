"""Stresses and displacements below the centres of equal cells side by side, at several depths, by FFT.

With 'periodic' the mean pressure is a stress zz at all depths, and none along the surface; displacements count, at each
depth, from the mean at that depth.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.halfplane import ELEMENTS, Element, PlaneState
from fuge.operators import AREA_BOUNDARIES, BOUNDARIES, AreaBoundary, Boundary
from fuge.stress import elasticity


def line_arguments(spacing: float, force: ArrayLike, element: Element, boundary: Boundary) -> list[Any]:
    """The arguments of the cells of a line, and of its forces."""
    forces = _arrays.vector("force", force)
    return [
        forces.size,
        _arrays.number("spacing", spacing),
        forces,
        ELEMENTS.number(element),
        BOUNDARIES.number(boundary),
    ]


def area_arguments(
    spacing_x: float, spacing_y: float, force: ArrayLike, boundary: AreaBoundary
) -> tuple[tuple[int, int], list[Any]]:
    """The shape of a grid, and the arguments of its cells and forces."""
    forces = _arrays.doubles("force", force, ("ny", "nx"))
    ny, nx = forces.shape
    return (ny, nx), [
        nx,
        ny,
        _arrays.number("spacing_x", spacing_x),
        _arrays.number("spacing_y", spacing_y),
        forces,
        AREA_BOUNDARIES.number(boundary),
    ]


def _at_depths(
    name: str, arguments: list[Any], depth: ArrayLike, grid: tuple[int, ...], components: int
) -> NDArray[np.float64]:
    depths = _arrays.vector("depth", np.atleast_1d(_arrays.array("depth", depth)))
    result = np.empty((depths.size, *grid, components))
    call(name, *arguments, depths.size, depths, result, shapes={"force": grid})
    return result


def halfplane_stress_grid(
    spacing: float, force: ArrayLike, element: Element, depth: ArrayLike, boundary: Boundary = "free"
) -> NDArray[np.float64]:
    """Stresses in a half-plane below the centres of its cells.

    Parameters
    ----------
    spacing : float
        Width of a cell; length.
    force : array_like, shape (n,)
        Forces on the cells per depth, positive in compression.
    element : {'centre', 'mean', 'hat'}
        As in :func:`halfplane_matrix`.
    depth : array_like, shape (d,), or float
        Not negative; length.
    boundary : {'free', 'periodic'}
        As for :class:`HalfplaneOperator`.

    Returns
    -------
    ndarray, shape (d, n, 3)
        xx, zz, xz below each cell at each depth; force per length^2.
    """
    arguments = line_arguments(spacing, force, element, boundary)
    return _at_depths("fuge_halfplane_stress_grid", arguments, depth, (arguments[0],), 3)


def halfplane_displacement_grid(
    spacing: float,
    force: ArrayLike,
    element: Element,
    young: float,
    poisson: float,
    depth: ArrayLike,
    boundary: Boundary = "free",
    *,
    plane_state: PlaneState = "strain",
) -> NDArray[np.float64]:
    """Displacements in a half-plane, shape (d, n, 2): along x and z below each cell at each depth; length.

    Parameters are those of :func:`halfplane_stress_grid` and of :func:`plane_modulus`.
    """
    arguments = line_arguments(spacing, force, element, boundary) + elasticity(young, poisson, plane_state)
    return _at_depths("fuge_halfplane_displacement_grid", arguments, depth, (arguments[0],), 2)


def halfspace_stress_grid(
    spacing_x: float,
    spacing_y: float,
    force: ArrayLike,
    poisson: float,
    depth: ArrayLike,
    boundary: AreaBoundary = "free",
) -> NDArray[np.float64]:
    """Stresses in a half-space below the centres of its cells.

    Parameters
    ----------
    spacing_x, spacing_y : float
        Widths of a cell; length.
    force : array_like, shape (ny, nx)
        Forces on the cells, positive in compression.
    poisson : float
        Poisson's ratio of the body.
    depth : array_like, shape (d,), or float
        Not negative; length.
    boundary : {'free', 'periodic', 'periodic_x', 'periodic_y'}
        As for :class:`HalfspaceOperator`.

    Returns
    -------
    ndarray, shape (d, ny, nx, 6)
        xx, yy, zz, yz, xz, xy below each cell at each depth; force per length^2.
    """
    grid, arguments = area_arguments(spacing_x, spacing_y, force, boundary)
    arguments.append(_arrays.number("poisson", poisson))
    return _at_depths("fuge_halfspace_stress_grid", arguments, depth, grid, 6)


def halfspace_displacement_grid(
    spacing_x: float,
    spacing_y: float,
    force: ArrayLike,
    young: float,
    poisson: float,
    depth: ArrayLike,
    boundary: AreaBoundary = "free",
) -> NDArray[np.float64]:
    """Displacements in a half-space, shape (d, ny, nx, 3): along x, y, z below each cell at each depth; length.

    Parameters are those of :func:`halfspace_stress_grid`, and Young's modulus of the body.
    """
    grid, arguments = area_arguments(spacing_x, spacing_y, force, boundary)
    arguments += [_arrays.number("young", young), _arrays.number("poisson", poisson)]
    return _at_depths("fuge_halfspace_displacement_grid", arguments, depth, grid, 3)
