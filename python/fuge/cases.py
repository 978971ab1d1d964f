"""Load cases of one contact problem, and their envelope."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.contact import Info


@dataclass(frozen=True, eq=False)
class Cases:
    """Solutions of load cases; row k is case k. Rows of cases that failed are NaN, and their points are open.

    Attributes
    ----------
    force : ndarray, shape (cases, n)
        Contact forces.
    gap : ndarray, shape (cases, n)
        Gaps under load; length.
    motion : ndarray, shape (cases, m)
        Rigid motions, free and prescribed.
    state : ndarray of int, shape (cases, n)
        State of each point, a value of :class:`PointState`.
    status : ndarray of int, shape (cases,)
        The :class:`Status` of each solve; negative: it failed.
    info : tuple of Info
        Report of each case, with its certificate.
    message : tuple of str
        What the library remarks on each case, or why it failed; mostly empty.
    displacement : ndarray, shape (cases, degrees), or None
        Displacements of all degrees of freedom, if :meth:`Body.solve_cases` has solved the cases.
    """

    force: NDArray[np.float64]
    gap: NDArray[np.float64]
    motion: NDArray[np.float64]
    state: NDArray[np.intc]
    status: NDArray[np.intc]
    info: tuple[Info, ...]
    message: tuple[str, ...]
    displacement: NDArray[np.float64] | None = None

    def __len__(self) -> int:
        """Number of cases."""
        return self.status.size

    def __repr__(self) -> str:
        failed = int(np.count_nonzero(self.status < 0))
        return f"<Cases: {len(self)} load cases of {self.force.shape[1]} points, {failed} failed>"


@dataclass(frozen=True, eq=False)
class Envelope:
    """The smallest and the largest value of each column over all cases.

    Attributes
    ----------
    smallest, largest : ndarray, shape (n,)
        NaN where all values are NaN.
    smallest_case, largest_case : ndarray of int, shape (n,)
        The first case that has the value; -1 where all values are NaN.
    """

    smallest: NDArray[np.float64]
    largest: NDArray[np.float64]
    smallest_case: NDArray[np.intc]
    largest_case: NDArray[np.intc]


def envelope(values: ArrayLike) -> Envelope:
    """The envelope of load cases, as of the forces in :class:`Cases` or of displacements.

    Parameters
    ----------
    values : array_like, shape (cases, n)
        Row k is case k. NaN, as in cases that failed, does not count.

    Returns
    -------
    Envelope

    Raises
    ------
    InputError
        There is no case.
    """
    rows = _arrays.doubles("values", values, (None, None))
    cases, n = rows.shape
    smallest, largest = np.empty(n), np.empty(n)
    smallest_case, largest_case = np.empty(n, dtype=np.intc), np.empty(n, dtype=np.intc)
    call("fuge_find_envelope", n, cases, rows, smallest, largest, smallest_case, largest_case)
    return Envelope(smallest, largest, smallest_case, largest_case)
