"""What is proved of the solution of a contact problem."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Proof:
    """Bounds of the error of a solution.

    They are theorems about the data as they are stored, rounding included: the exact solution of the problem is within
    them. Infinity where nothing is proved.

    Attributes
    ----------
    force_bound : ndarray, shape of the gaps
        By how much each force may be off; force.
    gap_bound : ndarray, shape of the gaps
        By how much each gap may be off; length.
    motion_bound : ndarray, shape (m,)
        By how much each motion may be off, 0 for a prescribed one; length for a translation.
    proved : ndarray of bool, shape of the gaps
        Is it proved that the point has the state that the solution says, and is not on the border to another one?
    largest_force : tuple of float
        The least and the most that the largest exact force can be; over the area of a cell, the largest pressure.
    message : str
        Which states are not proved, or why bounds are infinite; otherwise empty.
    """

    force_bound: NDArray[np.float64]
    gap_bound: NDArray[np.float64]
    motion_bound: NDArray[np.float64]
    proved: NDArray[np.bool_]
    largest_force: tuple[float, float]
    message: str

    @property
    def bounded(self) -> bool:
        """Are all errors bounded?"""
        return all(bool(np.isfinite(bound).all()) for bound in (self.force_bound, self.gap_bound, self.motion_bound))

    def __repr__(self) -> str:
        low, high = self.largest_force
        known = [
            f"forces within {self._largest(self.force_bound):.1e}",
            f"gaps within {self._largest(self.gap_bound):.1e}",
            f"{np.count_nonzero(self.proved)} of {self.proved.size} states",
            f"largest force {low:.6g} to {high:.6g}",
        ]
        return f"<Proof: {', '.join(known)}>"

    @staticmethod
    def _largest(bound: NDArray[np.float64]) -> float:
        return float(bound.max(initial=0.0))


def range_of_largest(force: NDArray[np.float64], force_bound: NDArray[np.float64]) -> tuple[float, float]:
    """The least and the most that the largest exact force can be, by forces and their bounds."""
    # The sums are rounded: one unit in the last place more is not below the exact bound.
    low, high = np.nextafter([(force - force_bound).max(), (force + force_bound).max()], [-np.inf, np.inf])
    return float(low), float(high)
