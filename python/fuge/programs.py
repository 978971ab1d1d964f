"""Linear complementarity problems and quadratic programs as such, solved as contact problems.

A symmetric M is an influence matrix; the dual of a strictly convex quadratic program is a contact problem: P is a
stiffness matrix, a row of G a contact point, its multiplier the contact force, its slack the gap.
"""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Iterator, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge.body import Body
from fuge.columns import compressed, is_sparse
from fuge.contact import Contact, Info
from fuge.errors import (
    EquilibriumError,
    InputError,
    MatrixError,
    NotProvedWarning,
    NotUniqueWarning,
    Status,
    Warning,
    warn,
)
from fuge.proof import Proof
from fuge.solver import Solver

Doubles = NDArray[np.float64]
Rows = Tuple[Doubles, Doubles]

# Of the largest force, and of the largest gap.
_ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class LcpSolution:
    """z >= 0 and w = M z + q >= 0 with z^T w = 0.

    Attributes
    ----------
    z, w : ndarray, shape (n,)
    undecided : ndarray of int
        Indices at which it is not decided which one of z and w is 0, most often because both are: not proved, or, where
        the bounds are infinite, both as small as rounding.
    z_bound, w_bound : ndarray, shape (n,)
        Bounds of the errors of z and w, proved; infinite where M is not proved to be positive definite.
    info : Info
        Report of the solve, with its certificate.
    """

    z: NDArray[np.float64]
    w: NDArray[np.float64]
    undecided: NDArray[np.intp]
    z_bound: NDArray[np.float64]
    w_bound: NDArray[np.float64]
    info: Info

    def __repr__(self) -> str:
        return f"<LcpSolution: n = {self.z.size}, {np.count_nonzero(self.z)} z > 0, {self.undecided.size} undecided>"


def solve_lcp(M: ArrayLike, q: ArrayLike) -> LcpSolution:
    """Solve the linear complementarity problem: z >= 0, w = M z + q >= 0, z^T w = 0.

    Parameters
    ----------
    M : array_like, shape (n, n)
        Symmetric and positive semidefinite, as of a convex quadratic program over z >= 0.
    q : array_like, shape (n,)

    Raises
    ------
    MatrixError
        M is not symmetric; or not positive semidefinite, where the solve comes upon it. If it does not, the solution is
        one of perhaps several, and its bounds are infinite.
    EquilibriumError
        There is no solution.

    Examples
    --------
    >>> solution = fuge.solve_lcp([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0])
    >>> solution.z.round(12).tolist()
    [1.333333333333, 2.333333333333]
    """
    matrix = _finite("M", _arrays.symmetric("M", M))
    with _words_of_programs("M", matrix, "semidefinite"):
        solver = Solver(matrix)
        solver.set_gap(_finite("q", _arrays.vector("q", q, matrix.shape[0])))
        solver.set_approach(0.0)
        contact = _solved(
            solver,
            "z is not unique: that given is one of many, w is the only one",
            "there is no z >= 0 with M z + q >= 0",
        )
    undecided, proof = _undecided(solver, contact)
    return LcpSolution(contact.force, contact.gap, undecided, proof.force_bound, proof.gap_bound, contact.info)


def _finite(name: str, values: Doubles) -> Doubles:
    """The values, unless one of them is NaN or infinite."""
    wrong = np.argwhere(~np.isfinite(values))
    if wrong.size:
        place = ", ".join(map(str, wrong[0]))
        raise InputError(f"{name}[{place}] = {values[tuple(wrong[0])]} is not a finite number", Status.ERR_NOT_FINITE)
    return values


@contextmanager
def _words_of_programs(name: str, matrix: Any, kind: str) -> Iterator[None]:
    """Refusals of a matrix, which the library calls an influence or a stiffness matrix, by its name here."""
    try:
        yield
    except MatrixError as failure:
        if failure.status != Status.ERR_NOT_SYMMETRIC:
            raise MatrixError(f"{name} is not positive {kind}, to rounding", failure.status) from failure
        i, j = sorted(map(int, np.unravel_index(int(abs(matrix - matrix.T).argmax()), matrix.shape)))
        raise MatrixError(
            f"{name}[{i}, {j}] = {matrix[i, j]:g} and {name}[{j}, {i}] = {matrix[j, i]:g} differ: {name} has to be "
            f"symmetric; if that is rounding, pass ({name} + {name}.T)/2",
            failure.status,
        ) from failure


def _solved(solver: Solver, not_unique: str, no_solution: str) -> Contact:
    """The solution, with warnings and errors in the words of programs."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            contact = solver.solve()
        except EquilibriumError as failure:
            raise EquilibriumError(no_solution, failure.status) from failure
        except MatrixError as failure:
            if "there is no solution" not in failure.message:
                raise
            raise EquilibriumError(no_solution, Status.ERR_NO_EQUILIBRIUM) from failure
    for found in caught:
        if isinstance(found.message, NotUniqueWarning):
            warn(NotUniqueWarning(not_unique, Status.WARN_NOT_UNIQUE))
        elif isinstance(found.message, Warning):
            warn(found.message)
    return contact


def _undecided(solver: Solver, contact: Contact) -> tuple[NDArray[np.intp], Proof]:
    """Points whose state is not proved; without a proof those whose force and gap are both as small as rounding."""
    with warnings.catch_warnings():
        # Infinite bounds say it.
        warnings.simplefilter("ignore", NotProvedWarning)
        proof = solver.prove()
    if np.all(np.isfinite(proof.force_bound)):
        return np.flatnonzero(~proof.proved), proof
    tiny = [np.abs(value) <= _ROUNDING * np.max(np.abs(value)) for value in (contact.force, contact.gap)]
    return np.flatnonzero(tiny[0] & tiny[1]), proof


@dataclass(frozen=True, eq=False)
class QpSolution:
    """The minimum of x^T P x/2 + q^T x, and the multipliers: P x + q + G^T z + A^T y + z_box = 0.

    Attributes
    ----------
    x : ndarray, shape (n,)
    z : ndarray, shape (rows of G,)
        Not negative.
    y : ndarray, shape (rows of A,)
    z_box : ndarray, shape (n,)
        Positive at an upper bound of x, negative at a lower one.
    undecided : tuple of str
        Constraints of which it is not decided whether they are active, such as 'G[3]' or 'x[2]'.
    is_proved : bool
        Whether the others are proved, for the dual as it is computed; it must be positive definite.
    residual : float
        Largest violation of the conditions of Karush, Kuhn and Tucker, computed from x and the multipliers: each
        relative to the sizes of what it sums.
    info : Info
        Report of the contact problem.
    """

    x: NDArray[np.float64]
    z: NDArray[np.float64]
    y: NDArray[np.float64]
    z_box: NDArray[np.float64]
    undecided: tuple[str, ...]
    is_proved: bool
    residual: float
    info: Info

    def __repr__(self) -> str:
        active = np.count_nonzero(self.z) + np.count_nonzero(self.z_box)
        counts = f"{self.x.size} variables, {active} active inequalities, {len(self.undecided)} undecided"
        return f"<QpSolution: {counts}, residual {self.residual:.1e}>"


def solve_qp(
    P: Any,
    q: ArrayLike,
    G: ArrayLike | None = None,
    h: ArrayLike | None = None,
    A: ArrayLike | None = None,
    b: ArrayLike | None = None,
    lb: ArrayLike | None = None,
    ub: ArrayLike | None = None,
) -> QpSolution:
    """Minimise x^T P x/2 + q^T x subject to G x <= h, A x = b and lb <= x <= ub, exactly: an active set of the dual.

    Parameters
    ----------
    P : array_like of shape (n, n), scipy.sparse matrix or CompressedColumns
        Symmetric, positive definite; a sparse one may be one of its triangles.
    q : array_like, shape (n,)
    G, h : array_like, shapes (m, n) and (m,), optional
    A, b : array_like, shapes (k, n) and (k,), optional
    lb, ub : array_like of shape (n,), or float, optional
        Bounds of x; infinite ones are none.

    Raises
    ------
    MatrixError
        P is not symmetric or not positive definite.
    EquilibriumError
        No x satisfies all constraints.

    Examples
    --------
    >>> solution = fuge.solve_qp([[2.0, 0.0], [0.0, 2.0]], [-2.0, -5.0], G=[[1.0, 2.0]], h=[3.0])
    >>> solution.x.round(12).tolist(), solution.z.round(12).tolist()
    ([0.2, 1.4], [1.6, 0.0])
    """
    # As an array or a csc_matrix, for products, and as a body takes it.
    matrix, stiffness = _both_forms(P)
    n = matrix.shape[0]
    linear = _finite("q", _arrays.vector("q", q, n))
    constraints = _Constraints(_rows("G", G, "h", h, n), _rows("A", A, "b", b, n), *_bounds(lb, ub, n))
    with _words_of_programs("P", matrix, "definite"):
        body = Body(stiffness)
        body.set_load(-linear)
        body.set_contact(*constraints.directions())
        condensed = body.condense()
    solver = Solver(condensed.influence)
    solver.set_gap(constraints.slack + condensed.displacement, constraints.play)
    solver.set_approach(0.0)
    if constraints.excluded:
        solver.set_excluded(True)
    contact = _solved(
        solver,
        "multipliers are not unique: those given are some of many, x is the only minimum",
        "no x satisfies all constraints: some of them contradict each other",
    )
    names = constraints.names()
    points, proof = _undecided(solver, contact)
    undecided = tuple(names[k] for k in points if constraints.play[k] > 0.0 and not constraints.excluded)
    x = body.recover(contact.force)
    z, y, z_box = constraints.multipliers(contact.force)
    residual = constraints.residual(matrix, linear, x, contact.force)
    is_proved = bool(np.all(np.isfinite(proof.force_bound)))
    return QpSolution(x, z, y, z_box, undecided, is_proved, residual, contact.info)


def _both_forms(P: Any) -> tuple[Any, Any]:
    """P with both triangles, as an array or as ``scipy.sparse.csc_matrix``, and as a body takes it."""
    if not is_sparse(P):
        dense = _finite("P", _arrays.symmetric("P", P))
        return dense, dense
    from scipy.sparse import diags

    columns = compressed("P", P)
    _finite("P.value", columns.value)
    _arrays.check_shape("P", columns.shape, (columns.shape[0], columns.shape[0]))
    matrix = columns.tocsc()
    places = matrix.tocoo()
    if np.all(places.row <= places.col) or np.all(places.row >= places.col):
        matrix = (matrix + matrix.T - diags(matrix.diagonal())).tocsc()
    return matrix, columns


def _rows(matrix_name: str, matrix: ArrayLike | None, name: str, right: ArrayLike | None, n: int) -> Rows:
    """A matrix with n columns and its right side; without rows if it is not given."""
    if matrix is None and right is None:
        return np.empty((0, n)), np.empty(0)
    if matrix is None or right is None:
        raise InputError(f"{matrix_name} and {name} belong together: one of them is missing", Status.ERR_SIZE)
    rows = _finite(matrix_name, _arrays.doubles(matrix_name, matrix, (None, n)))
    return rows, _finite(name, _arrays.vector(name, right, len(rows)))


def _bounds(lb: ArrayLike | None, ub: ArrayLike | None, n: int) -> Rows:
    """Bounds of all variables, infinite where there are none."""
    lower = np.full(n, -np.inf) if lb is None else _arrays.spread("lb", lb, n)
    upper = np.full(n, np.inf) if ub is None else _arrays.spread("ub", ub, n)
    wrong = np.flatnonzero(~(lower <= upper) | (lower == np.inf) | (upper == -np.inf))
    if wrong.size:
        k = int(wrong[0])
        raise InputError(f"lb[{k}] = {lower[k]:g} and ub[{k}] = {upper[k]:g} leave no value for x[{k}]", Status.ERR_GAP)
    return lower, upper


class _Constraints:
    """Constraints as contact points: rows of G, rows of A, which are tied, then the variables that are bounded.

    Point k has the slack slack[k] + directions[k] x, which is between 0 and play[k]. Rows without an entry are no
    points: they say 0 <= h or 0 = b.
    """

    def __init__(self, inequalities: Rows, equalities: Rows, lower: Doubles, upper: Doubles) -> None:
        (g, h), (a, b) = inequalities, equalities
        self._count, self._rows = h.size, np.vstack([g, a])
        right, play = np.r_[h, b], np.r_[np.full(h.size, np.inf), np.zeros(b.size)]
        self._used = np.any(self._rows != 0.0, axis=1)
        # Rows of the same size, by powers of two, which round nothing.
        self._scale = np.exp2(-np.frexp(np.linalg.norm(self._rows, axis=1))[1].astype(float))
        wrong = np.flatnonzero(~self._used & ((right < 0.0) | ((play == 0.0) & (right != 0.0))))
        if wrong.size:
            name = self._row_name(int(wrong[0]))
            raise EquilibriumError(f"no x satisfies {name}, a row of zeros", Status.ERR_NO_EQUILIBRIUM)
        self._box = np.flatnonzero(np.isfinite(lower) | np.isfinite(upper))
        # A contact problem has a point: without constraints one that carries no force.
        self.excluded = not self._used.any() and self._box.size == 0
        if self.excluded:
            lower, upper, self._box = np.zeros(1), np.full(1, np.inf), np.zeros(1, dtype=int)
        low, high = lower[self._box], upper[self._box]
        # The stop of a variable is its upper bound, if it has one; the other bound is a second stop.
        bounded = np.isfinite(high)
        self._sign = np.where(bounded, -1.0, 1.0)
        self.slack = np.r_[(self._scale * right)[self._used], np.where(bounded, high, -low)]
        self.play = np.r_[play[self._used], np.where(bounded, high - low, np.inf)]

    def _row_name(self, row: int) -> str:
        return f"G[{row}]" if row < self._count else f"A[{row - self._count}]"

    def names(self) -> list[str]:
        """Names of the points."""
        return [self._row_name(int(row)) for row in np.flatnonzero(self._used)] + [f"x[{k}]" for k in self._box]

    def directions(self) -> tuple[NDArray[np.intc], Doubles]:
        """Variables of each point, -1 in unused places, and the components of its direction."""
        dense = -(self._scale[:, None] * self._rows)[self._used]
        rows, n = dense.shape
        width = n if rows else 1
        dof = np.full((self.slack.size, width), -1, dtype=np.intc)
        normal = np.zeros(dof.shape)
        dof[:rows], normal[:rows] = np.arange(width), dense[:, :width]
        dof[rows:, 0], normal[rows:, 0] = self._box, self._sign
        return dof, normal

    def multipliers(self, force: Doubles) -> tuple[Doubles, Doubles, Doubles]:
        """Those of G, of A, and of the bounds of all variables."""
        rows, used = np.zeros(len(self._rows)), np.count_nonzero(self._used)
        rows[self._used] = force[:used] * self._scale[self._used]
        box = np.zeros(self._rows.shape[1])
        box[self._box] = 0.0 - self._sign * force[used:]
        return rows[: self._count], rows[self._count :], box

    def residual(self, matrix: Any, linear: Doubles, x: Doubles, force: Doubles) -> float:
        """Largest violation of the conditions of optimality, each relative to the sizes of what it sums."""
        z, y, box = self.multipliers(force)
        multiplier, largest = np.r_[z, y], np.max(np.abs(x))
        balance = np.abs(matrix @ x + linear + self._rows.T @ multiplier + box)
        sums = np.ravel(abs(matrix).sum(axis=1))
        size = sums * largest + np.abs(linear) + np.abs(self._rows).T @ np.abs(multiplier)
        worst = _largest_ratio(balance, size + np.abs(box))
        if self.excluded:
            return worst
        rows = (self._scale[:, None] * self._rows)[self._used]
        slack = self.slack - np.r_[rows @ x, -self._sign * x[self._box]]
        size = np.abs(self.slack) + largest * np.r_[np.abs(rows).sum(axis=1), np.ones(self._box.size)]
        # A multiplier holds its constraint at one of the stops.
        stop = np.where(force < 0.0, self.play, 0.0)
        outside = np.maximum(np.maximum(-slack, slack - self.play), 0.0)
        wrong = np.where(force != 0.0, np.abs(slack - stop), outside)
        return max(worst, _largest_ratio(wrong, size))


def _largest_ratio(error: Doubles, size: Doubles) -> float:
    present = error > 0.0
    return float(np.max(error[present] / size[present], initial=0.0))
