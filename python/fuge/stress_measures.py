"""Scalars of stresses, point by point; the components are in the last dimension of an array.

A tensor has the components xx, yy, zz, yz, xz, xy. Results are NaN where a component is NaN or infinite.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.errors import Status, error
from fuge.halfplane import PLANE_STATES, PlaneState


def _components(name: str, value: ArrayLike, count: int) -> NDArray[np.float64]:
    found = _arrays.doubles(name, value)
    if found.ndim == 0 or found.shape[-1] != count:
        raise error(Status.ERR_SIZE, f"{name} has the shape {found.shape}, but its last dimension must be {count}")
    return found


def halfplane_tensor(stress: ArrayLike, poisson: float, plane_state: PlaneState = "strain") -> NDArray[np.float64]:
    """Tensors (.., 6) from the stresses (.., 3) in a plane: xx, zz, xz.

    In plane strain yy is poisson (xx + zz), in plane stress 0.
    """
    stresses = _components("stress", stress, 3)
    tensor = np.empty((*stresses.shape[:-1], 6))
    state = PLANE_STATES.number(plane_state)
    call("fuge_halfplane_tensor", tensor.size // 6, stresses, state, _arrays.number("poisson", poisson), tensor)
    return tensor


def round_tensor(stress: ArrayLike) -> NDArray[np.float64]:
    """Tensors (.., 6) from the stresses (.., 4) about an axis: rr, tt, zz, rz; x is the radius."""
    stresses = _components("stress", stress, 4)
    tensor = np.empty((*stresses.shape[:-1], 6))
    call("fuge_round_tensor", tensor.size // 6, stresses, tensor)
    return tensor


def principal_stresses(tensor: ArrayLike) -> NDArray[np.float64]:
    """Principal stresses (.., 3) of tensors (.., 6), the largest first."""
    tensors = _components("tensor", tensor, 6)
    principal = np.empty((*tensors.shape[:-1], 3))
    call("fuge_principal_stresses", tensors.size // 6, tensors, principal)
    return principal


def _measure(name: str, tensor: ArrayLike) -> NDArray[np.float64]:
    tensors = _components("tensor", tensor, 6)
    value = np.empty(tensors.shape[:-1])
    call(name, tensors.size // 6, tensors, value)
    return value


def von_mises(tensor: ArrayLike) -> NDArray[np.float64]:
    """Von Mises stress of tensors (.., 6)."""
    return _measure("fuge_von_mises", tensor)


def tresca(tensor: ArrayLike) -> NDArray[np.float64]:
    """Tresca stress of tensors (.., 6): the largest principal stress minus the smallest one."""
    return _measure("fuge_tresca", tensor)


def mean_stress(tensor: ArrayLike) -> NDArray[np.float64]:
    """Mean stress of tensors (.., 6): (xx + yy + zz)/3."""
    return _measure("fuge_mean_stress", tensor)
