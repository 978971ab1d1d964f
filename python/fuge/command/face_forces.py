"""Forces of a uniform pressure on faces of finite elements, at their nodes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import roots_legendre

_SIDES = [(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0)]
_CORNERS = [(0, 0), (1, 0), (0, 1), (0.5, 0), (0.5, 0.5), (0, 0.5)]
_POWERS = [(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (0, 2), (2, 1), (1, 2)]

# Places of the nodes, by dimensions and their number, and the powers of both coordinates that they interpolate.
_FACES = {
    (2, 2): ([(-1, 0), (1, 0)], [(0, 0), (1, 0)]),
    (2, 3): ([(-1, 0), (1, 0), (0, 0)], [(0, 0), (1, 0), (2, 0)]),
    (3, 3): (_CORNERS[:3], _POWERS[:3]),
    (3, 4): (_SIDES[:4], _POWERS[:4]),
    (3, 6): (_CORNERS, _POWERS[:6]),
    (3, 8): (_SIDES, _POWERS),
}


def pressure_forces(position: NDArray[np.float64], revolution: bool = False) -> NDArray[np.float64]:
    """Consistent forces of a pressure of 1, into the body, at the nodes of faces of one kind.

    Parameters
    ----------
    position : ndarray, shape (faces, nodes, dimensions)
        In the plane of 2 or 3 nodes, in space of 3, 4, 6 or 8: corners first, counter-clockwise seen from outside; in
        the plane the body lies to the left of the way from corner 0 to corner 1.
    revolution : bool
        The plane is the section of a body of revolution about x = 0, and forces are those of whole rings.

    Returns
    -------
    ndarray, shape (faces, nodes, dimensions)
    """
    nodes, dimensions = position.shape[1:]
    point, weight = _gauss(dimensions, nodes)
    places, powers = (np.array(found, dtype=float) for found in _FACES[dimensions, nodes])
    shapes = np.linalg.inv(_monomials(places, powers))
    value = _monomials(point, powers) @ shapes
    tangent = []
    for step in np.eye(2)[: dimensions - 1]:
        slope = _monomials(point, np.maximum(powers - step, 0.0)) * (powers @ step) @ shapes
        tangent.append(np.einsum("gn,fnd->fgd", slope, position))
    if dimensions == 2:
        area = np.stack([tangent[0][..., 1], -tangent[0][..., 0]], axis=-1)
    else:
        area = np.cross(*tangent)
    if revolution:
        area = area * (2.0 * np.pi * (position[..., 0] @ value.T)[..., None])
    return -np.asarray(np.einsum("g,gn,fgd->fnd", weight, value, area))


def _gauss(dimensions: int, nodes: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Three points along each coordinate; a triangle is a square with one side drawn together to a corner."""
    root, share = roots_legendre(3)
    if dimensions == 2:
        return np.stack([root, np.zeros(3)], axis=1), share
    u, v = np.repeat(root, 3), np.tile(root, 3)
    weight = np.outer(share, share).reshape(-1)
    if nodes % 3 == 0:
        v = 0.5 * (1.0 + v)
        u, weight = 0.5 * (1.0 + u) * (1.0 - v), 0.25 * weight * (1.0 - v)
    return np.stack([u, v], axis=1), weight


def _monomials(point: NDArray[np.float64], powers: NDArray[np.float64]) -> NDArray[np.float64]:
    """Products of powers of the coordinates of points, shape (points, powers)."""
    return np.asarray(np.prod(point[:, None, :] ** powers, axis=2))
