"""Scalars of stresses, point by point; the components are in the last dimension of an array.

A tensor has the components xx, yy, zz, yz, xz, xy. Results are NaN where a component is NaN or infinite.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.errors import Status, error


def _tensors(tensor: ArrayLike) -> NDArray[np.float64]:
    found = _arrays.doubles("tensor", tensor)
    if found.ndim == 0 or found.shape[-1] != 6:
        raise error(Status.ERR_SIZE, f"tensor has the shape {found.shape}, but its last dimension must be 6")
    return found


def principal_stresses(tensor: ArrayLike) -> NDArray[np.float64]:
    """Principal stresses (.., 3) of tensors (.., 6), the largest first."""
    tensors = _tensors(tensor)
    principal = np.empty((*tensors.shape[:-1], 3))
    call("fuge_measure_stresses", tensors.size // 6, tensors, principal, None, None, None)
    return principal


def _measure(which: int, tensor: ArrayLike) -> NDArray[np.float64]:
    """The scalar that is number `which` of the three that the function has."""
    tensors = _tensors(tensor)
    value = np.empty(tensors.shape[:-1])
    scalars = [value if which == k else None for k in range(3)]
    call("fuge_measure_stresses", tensors.size // 6, tensors, None, *scalars)
    return value


def von_mises(tensor: ArrayLike) -> NDArray[np.float64]:
    """Von Mises stress of tensors (.., 6)."""
    return _measure(0, tensor)


def tresca(tensor: ArrayLike) -> NDArray[np.float64]:
    """Tresca stress of tensors (.., 6): the largest principal stress minus the smallest one."""
    return _measure(1, tensor)


def mean_stress(tensor: ArrayLike) -> NDArray[np.float64]:
    """Mean stress of tensors (.., 6): (xx + yy + zz)/3."""
    return _measure(2, tensor)
