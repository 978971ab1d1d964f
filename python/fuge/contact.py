"""Solutions of contact problems."""

from __future__ import annotations

import weakref
from dataclasses import dataclass, field as attribute
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge.cells import Cells, pressure_of
from fuge.design import Gradients
from fuge.errors import Status, error
from fuge.field import Field, field_of_cells
from fuge.halfplane import PlaneState
from fuge.proof import Proof


@dataclass(frozen=True)
class Info:
    """Report of a solve.

    Attributes
    ----------
    status : Status
    iterations : int
        Pivots of the tableau, otherwise contact sets, on all grids.
    contacts : int
        Points with a contact force.
    products : int
        Products by the operator; those on coarser grids count by their cost.
    preconditionings : int
        Applications of a preconditioner; those on coarser grids count by their cost.
    residual : float
        The certificate: the largest scaled violation of the contact conditions.
    force_error : float
        Estimated largest error of a force, relative to the largest force; 1 if no digit is known.
    energy : float
        Elastic energy of the bodies and of all springs; force times length.
    """

    status: Status
    iterations: int
    contacts: int
    products: int
    preconditionings: int
    residual: float
    force_error: float
    energy: float


@dataclass(frozen=True, eq=False)
class Contact:
    """Solution of a contact problem.

    Attributes
    ----------
    force : ndarray, shape of the gaps
        Contact forces, positive where the bodies press on each other.
    gap : ndarray, shape of the gaps
        Gaps under load; length. Negative only where excluded, or where the force has reached its limit.
    motion : ndarray, shape (m,)
        Rigid motions, free and prescribed.
    resultant : ndarray, shape (m,)
        Resultants of the forces in the directions of the motions.
    state : ndarray of int, shape of the gaps
        State of each point, a value of :class:`PointState`.
    info : Info
        Report, with the certificate.
    message : str
        What the library remarks on the solution; mostly empty.
    cells : Cells or None
        The cells of the operator, if its points are equal cells.
    proof : Proof or None
        Bounds of the errors of forces, gaps and motions, if :func:`solve` was asked for them by ``prove=True``;
        :meth:`prove` gives them otherwise.
    """

    force: NDArray[np.float64]
    gap: NDArray[np.float64]
    motion: NDArray[np.float64]
    resultant: NDArray[np.float64]
    state: NDArray[np.intc]
    info: Info
    message: str
    cells: Cells | None = None
    proof: Proof | None = None
    _solver: weakref.ref[Any] | None = attribute(default=None, repr=False)

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_solver": None}

    def prove(self) -> Proof:
        """Bounds of the error of each force, gap and motion, rounding included: those of :meth:`Solver.prove`.

        For a solution with a `proof`, and for the last one of a solver that is still there.

        Raises
        ------
        CallOrderError
            The solver has gone, or has solved another problem since.
        """
        proof: Proof = self._last_solver()._prove(self) if self.proof is None else self.proof
        return proof

    def vjp(
        self,
        *,
        force: ArrayLike | None = None,
        gap: ArrayLike | None = None,
        motion: ArrayLike | None = None,
        pressure: ArrayLike | None = None,
    ) -> Gradients:
        """Gradient of an objective of this solution by all data of its problem: that of :meth:`Solver.vjp`.

        For the last solution of a solver that is still there.

        Parameters
        ----------
        force, gap, motion, pressure : array_like, optional
            Partial derivatives of the objective by those of the contact.

        Raises
        ------
        CallOrderError
            The solver has gone, or has solved another problem since.
        """
        gradients: Gradients = self._last_solver()._vjp(self, force, gap, motion, pressure)
        return gradients

    def _last_solver(self) -> Any:
        """The solver whose solution this is; whether the last one, it says itself."""
        solver = None if self._solver is None else self._solver()
        if solver is None:
            raise no_solver()
        return solver

    @property
    def pressure(self) -> NDArray[np.float64]:
        """Forces over the area of a cell, or its width on a line, in the shape of the forces; force per length^2.

        For operators of equal cells. With the element 'hat' it is the pressure at the centres of the cells.

        Raises
        ------
        InputError
            The operator does not know the cells of its points, as a matrix does not.
        """
        return pressure_of(self.force, self.cells)

    def field(
        self, *, young: float | None = None, poisson: float | None = None, plane_state: PlaneState = "strain"
    ) -> Field:
        """Stresses and displacements in the body below, for operators of equal cells.

        Parameters
        ----------
        young : float, optional
            Young's modulus of this body, not of the pair, for displacements; force per length^2.
        poisson : float
            Its Poisson's ratio. Layers are known to their operator: leave both out.
        plane_state : {'strain', 'stress'}
            On a line: long bodies, or thin ones.

        Returns
        -------
        Field
            Its x and y count from the centre of the first cell.

        Raises
        ------
        InputError
            The operator does not know the cells of its points, as a matrix does not: see :meth:`Field.halfplane`.
        UnsupportedError
            The operator is a callback, whose body is not known.
        """
        return field_of_cells(self.cells, self.force, young, poisson, plane_state)

    @property
    def approach(self) -> float:
        """By how much the bodies have approached each other, where that is the only motion; length."""
        return float(self._one(self.motion))

    @property
    def load(self) -> float:
        """Sum of the forces, where the approach is the only motion."""
        return float(self._one(self.resultant))

    def __repr__(self) -> str:
        motions = "motion" if self.motion.size != 1 else "approach"
        known = [
            f"{self.info.contacts} of {self.force.size} points in contact",
            f"{motions} {self._shown(self.motion)}",
            f"{'resultant' if self.motion.size != 1 else 'load'} {self._shown(self.resultant)}",
            f"residual {self.info.residual:.1e}",
        ]
        return f"<Contact: {', '.join(known)}>"

    @staticmethod
    def _shown(values: NDArray[np.float64]) -> str:
        return f"{values[0]:.6g}" if values.size == 1 else str(values)

    def _one(self, values: NDArray[np.float64]) -> float:
        if values.size != 1:
            raise error(Status.ERR_SIZE, f"there are {values.size} rigid motions: use motion and resultant")
        return float(values[0])


@dataclass(frozen=True, eq=False)
class Derivative:
    """Changes of a solution in a direction, exact as long as the contact set does not change.

    Attributes
    ----------
    force, gap : ndarray, shape of the gaps
        Changes of the forces and of the gaps.
    motion : ndarray, shape (m,)
        Changes of the rigid motions.
    """

    force: NDArray[np.float64]
    gap: NDArray[np.float64]
    motion: NDArray[np.float64]

    def __repr__(self) -> str:
        return f"<Derivative: {self.force.size} points, motion {self.motion}>"


def no_solver() -> Exception:
    """The error of a solution that is not the last one of a solver that is still there."""
    return error(
        Status.ERR_CALL_ORDER,
        "the solver of this solution has gone, or has solved another problem since: make a fuge.Solver and keep it, "
        "and call this before it solves again; for a proof pass prove=True to fuge.solve",
    )


@dataclass(frozen=True, eq=False)
class History:
    """Steps of the tableau, of which the first one is the artificial start and each other one a pivot.

    Attributes
    ----------
    basis : ndarray of int, shape (steps, n + m)
        Column numbers as in the paper, from 1: 1 to n forces, n + 1 to 2 n gaps, then motions, then artificials.
    z : ndarray, shape (steps,)
        Sum of the artificial variables.
    """

    basis: NDArray[np.intc]
    z: NDArray[np.float64]

    def __repr__(self) -> str:
        return f"<History: {self.z.size} steps>"


def info_of(report: Any) -> Info:
    """The report in the struct fuge_info."""
    return Info(
        Status(report.status),
        report.iterations,
        report.contacts,
        report.products,
        report.preconditionings,
        report.residual,
        report.force_error,
        report.energy,
    )
