"""Design: how an objective changes with the data of a contact problem, and the gaps for a wanted pressure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fuge.cells import Cells, pressure_of


@dataclass(frozen=True, eq=False)
class Gradients:
    """Gradient of an objective J by all data of a contact problem, exact as long as the contact set stays.

    Each has the unit of J over that of the datum.

    Attributes
    ----------
    gap : ndarray, shape of the gaps
        dJ/dg, by the initial gaps.
    load : ndarray, shape (m,)
        By the load or the resultants; where a motion is prescribed, by the motion.
    compliance : ndarray, shape of the gaps
        By the compliances of springs at the points; where there is none, by the first bit of one.
    motion_stiffness : ndarray, shape (m,)
        By the stiffnesses of springs on the motions; 0 where prescribed.
    gap_upper : ndarray, shape of the gaps
        By the play; not 0 at the upper stop, and where a tied point pulls.
    limit, limit_upper : ndarray, shape of the gaps
        By the limits of the forces; not 0 where a force has reached its limit only, by the first bit of a limit of 0.
    log_modulus : float
        ``e_star * dJ/de_star``, by the logarithm of the modulus to which all displacements by contact forces are
        inversely proportional; unit of J.
    at_kink : ndarray of bool, shape of the gaps
        Is the point on the border between two states? J has a kink there, and the gradient is that of one side.
    """

    gap: NDArray[np.float64]
    load: NDArray[np.float64]
    compliance: NDArray[np.float64]
    motion_stiffness: NDArray[np.float64]
    gap_upper: NDArray[np.float64]
    limit: NDArray[np.float64]
    limit_upper: NDArray[np.float64]
    log_modulus: float
    at_kink: NDArray[np.bool_]

    def __repr__(self) -> str:
        # Zero is added, so that none shows as -0.
        load = f"{self.load[0] + 0.0:.6g}" if self.load.size == 1 else str(self.load)
        known = [
            f"by {self.gap.size} gaps up to {np.abs(self.gap).max():.6g}",
            f"load {load}",
            f"log_modulus {self.log_modulus + 0.0:.6g}",
            f"{np.count_nonzero(self.at_kink)} points at a kink",
        ]
        return f"<Gradients: {', '.join(known)}>"


@dataclass(frozen=True, eq=False)
class WantedContact:
    """A contact with wanted forces: the gaps that give them.

    Attributes
    ----------
    gap : ndarray, shape of the wanted pressure
        Initial gaps, for :meth:`Solver.set_gap`; length.
    force : ndarray of the same shape
        Forces that these give: those wanted, or the nearest that a point can have.
    resultant : ndarray, shape (m,)
        Resultants of the forces, the loads that belong to them; where a motion is prescribed, its reaction.
    cells : Cells or None
        The cells of the operator, if its points are equal cells.
    """

    gap: NDArray[np.float64]
    force: NDArray[np.float64]
    resultant: NDArray[np.float64]
    cells: Cells | None = None

    @property
    def pressure(self) -> NDArray[np.float64]:
        """Forces over the area of a cell, or its width on a line, as :attr:`Contact.pressure`; force per length^2."""
        return pressure_of(self.force, self.cells)

    def __repr__(self) -> str:
        resultant = f"load {self.resultant[0]:.6g}" if self.resultant.size == 1 else f"resultant {self.resultant}"
        return f"<WantedContact: gaps {self.gap.min():.6g} to {self.gap.max():.6g}, {resultant}>"
