"""Stresses and displacements at points of bodies of layers, under strips or rectangles of any size.

Each point takes time for each of them: on grids the functions of :mod:`fuge.layer_stress` are faster.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.halfplane import Element
from fuge.layers import Layers, layers_of
from fuge.stress import rectangles, strips


def _at_points(
    name: str,
    layers: Layers,
    arguments: list[Any],
    components: int,
    below: ArrayLike,
    *coordinates: tuple[str, ArrayLike],
) -> NDArray[np.float64]:
    shape, flat = _arrays.points(*coordinates)
    sides = _arrays.spread_flags("below", below, shape)
    result = np.empty((*shape, components))
    shapes = dict.fromkeys([coordinate for coordinate, _ in coordinates] + ["point"], shape)
    call(name, *layers_of(layers)[:-1], *arguments, flat[0].size, *flat, sides, result, shapes=shapes)
    return result


def layered_halfplane_stress(
    layers: Layers,
    x: ArrayLike,
    width: ArrayLike,
    force: ArrayLike,
    px: ArrayLike,
    pz: ArrayLike,
    *,
    element: Element = "mean",
    below: ArrayLike = False,
    symmetric: bool = False,
) -> NDArray[np.float64]:
    """Stresses at points of a body of layers, in plane strain, under forces on its cells.

    Parameters
    ----------
    layers : Layers
        The stresses are those in the body that it describes, not in the other one.
    x, width, force, px, pz, symmetric
        As in :func:`halfplane_stress`.
    element : {'mean', 'centre'}
        Strips of pressure.
    below : bool or array_like
        At an interface: False, just above it; True, just below it. There xx differs.

    Returns
    -------
    ndarray, shape (.., 3)
        xx, zz, xz at each point; force per length^2.
    """
    arguments = [*strips(x, width, force, element), int(bool(symmetric))]
    return _at_points("fuge_layered_halfplane_stress", layers, arguments, 3, below, ("px", px), ("pz", pz))


def layered_halfplane_displacement(
    layers: Layers,
    x: ArrayLike,
    width: ArrayLike,
    force: ArrayLike,
    px: ArrayLike,
    pz: ArrayLike,
    *,
    element: Element = "mean",
    below: ArrayLike = False,
    symmetric: bool = False,
) -> NDArray[np.float64]:
    """Displacements at points of a body of layers, in plane strain, shape (.., 2): along x and z; length.

    Parameters are those of :func:`layered_halfplane_stress`. The datum is that of
    :meth:`Layers.halfplane_matrix` with a rigid other body.
    """
    arguments = [*strips(x, width, force, element), int(bool(symmetric))]
    return _at_points("fuge_layered_halfplane_displacement", layers, arguments, 2, below, ("px", px), ("pz", pz))


def layered_halfspace_stress(
    layers: Layers,
    x: ArrayLike,
    y: ArrayLike,
    width_x: ArrayLike,
    width_y: ArrayLike,
    force: ArrayLike,
    px: ArrayLike,
    py: ArrayLike,
    pz: ArrayLike,
    *,
    below: ArrayLike = False,
    symmetric_x: bool = False,
    symmetric_y: bool = False,
) -> NDArray[np.float64]:
    """Stresses at points of a body of layers under the forces of rectangles.

    Parameters
    ----------
    layers : Layers
        The stresses are those in the body that it describes, not in the other one.
    x, y, width_x, width_y, force, px, py, pz, symmetric_x, symmetric_y
        As in :func:`halfspace_stress`.
    below : bool or array_like
        At an interface: False, just above it; True, just below it. There xx, yy and xy differ.

    Returns
    -------
    ndarray, shape (.., 6)
        xx, yy, zz, yz, xz, xy at each point; force per length^2.
    """
    arguments = [*rectangles(x, y, width_x, width_y, force), int(bool(symmetric_x)), int(bool(symmetric_y))]
    points = (("px", px), ("py", py), ("pz", pz))
    return _at_points("fuge_layered_halfspace_stress", layers, arguments, 6, below, *points)


def layered_halfspace_displacement(
    layers: Layers,
    x: ArrayLike,
    y: ArrayLike,
    width_x: ArrayLike,
    width_y: ArrayLike,
    force: ArrayLike,
    px: ArrayLike,
    py: ArrayLike,
    pz: ArrayLike,
    *,
    below: ArrayLike = False,
    symmetric_x: bool = False,
    symmetric_y: bool = False,
) -> NDArray[np.float64]:
    """Displacements at points of a body of layers, shape (.., 3): along x, y, z; length. They vanish far away.

    Parameters are those of :func:`layered_halfspace_stress`.
    """
    arguments = [*rectangles(x, y, width_x, width_y, force), int(bool(symmetric_x)), int(bool(symmetric_y))]
    points = (("px", px), ("py", py), ("pz", pz))
    return _at_points("fuge_layered_halfspace_displacement", layers, arguments, 3, below, *points)
