"""The exact course of a contact while its load changes."""

from __future__ import annotations

from dataclasses import dataclass
from enum import auto
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge._library import Constants
from fuge.errors import Status, error
from fuge.operators import DenseOperator, Operator


class PointState(Constants):
    """State of a contact point, an ``IntEnum``."""

    AT_LOWER_STOP = auto()
    """Gap 0, force >= 0; of either sign if the point is tied."""
    OPEN = auto()
    """Between the stops, no force."""
    AT_UPPER_STOP = auto()
    """Gap equal to the play, force <= 0."""
    LIMITED_LOWER = auto()
    """Force at the limit of the lower stop, gap <= 0."""
    LIMITED_UPPER = auto()
    """Force at the limit of the upper stop, gap >= play."""


@dataclass(frozen=True, eq=False)
class Path:
    """Events of a path; the first entry is the start, each other one a point that changes its state.

    Points that change together have an entry each; motion, rate and contacts are then those after all of them.

    Attributes
    ----------
    parameter : ndarray, shape (entries,)
        The load of a load path, else the parameter from 0 to 1; ascending.
    motion : ndarray, shape (entries,) for a load path, else (entries, m)
        Approach, or motions.
    rate : ndarray of the same shape
        Its derivative by the parameter from there to the next entry; for a load path 1 over the contact stiffness.
    point : ndarray of int, shape (entries,)
        The point that changes; -1 for the start.
    state : ndarray of int, shape (entries,)
        Its new state, a value of :class:`PointState`.
    contacts : ndarray of int, shape (entries,)
        Points in contact from there on, those at their limit included.
    """

    parameter: NDArray[np.float64]
    motion: NDArray[np.float64]
    rate: NDArray[np.float64]
    point: NDArray[np.intc]
    state: NDArray[np.intc]
    contacts: NDArray[np.intc]

    def __repr__(self) -> str:
        return f"<Path: {self.point.size} entries, parameter {self.parameter[0]:.6g} to {self.parameter[-1]:.6g}>"


def collect_path(n: int, m: int, follow: Callable[..., None]) -> Path:
    """Call ``follow(capacity, parameter, .., entries)``, and once more if there are more entries than expected."""
    capacity = 2 * n + 16
    entries = np.empty(1, dtype=np.intc)
    while True:
        numbers: list[NDArray[Any]] = [np.empty(capacity), np.empty((capacity, m)), np.empty((capacity, m))]
        numbers += [np.empty(capacity, dtype=np.intc) for _ in range(3)]
        follow(capacity, *numbers, entries)
        found = int(entries[0])
        if found <= capacity:
            return Path(*(array[:found].copy() for array in numbers))
        capacity = found


def check_matrix(operator: Operator) -> None:
    """Refuse an operator without a matrix."""
    if not isinstance(operator, DenseOperator):
        raise error(
            Status.ERR_UNSUPPORTED,
            f"a path needs an influence matrix, which {operator!r} does not have: pass one, such as that of "
            "halfplane_matrix, or solve for one load after the other",
        )


def load_path(operator: Operator | ArrayLike, gap: ArrayLike, load: float) -> Path:
    """The exact course of the contact as the load of one translation grows from 0.

    For several motions, and for other starts, see :meth:`Solver.follow_path`.

    Parameters
    ----------
    operator : DenseOperator or array_like, shape (n, n)
        Influence matrix.
    gap : array_like, shape (n,)
        Initial gaps; length.
    load : float
        The load at the end, not negative; force.

    Returns
    -------
    Path

    Raises
    ------
    UnsupportedError
        The operator has no matrix.
    EquilibriumError
        The load is negative.
    """
    body = operator if isinstance(operator, Operator) else DenseOperator(operator)
    check_matrix(body)
    gaps = _arrays.vector("gap", gap, body.n)
    if np.ndim(load) > 0:
        raise error(
            Status.ERR_SIZE,
            f"load has the shape {np.shape(load)}, but load_path has one motion with its load: for several take "
            "Solver.follow_path",
        )
    end = _arrays.number("load", load)
    with body._handle.reading() as pointer:
        path = collect_path(body.n, 1, lambda *results: call("fuge_load_path", pointer, gaps, end, *results))
    return Path(path.parameter, path.motion[:, 0], path.rate[:, 0], path.point, path.state, path.contacts)
