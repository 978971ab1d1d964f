"""Condensation: from the stiffness matrix of a finite element model to the influence matrix of its contact points."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import MESSAGE_LENGTH, Owner, call, end_call, new_handle
from fuge._library import function
from fuge._messages import in_python
from fuge.cases import Cases
from fuge.columns import compressed, is_sparse, require_sparse, stacked
from fuge.errors import Status, Warning, error, warn
from fuge.links import Links

if TYPE_CHECKING:
    from fuge.solver import Solver


@dataclass(frozen=True, eq=False)
class Condensed:
    """A body reduced to what a contact problem needs.

    Attributes
    ----------
    influence : ndarray, shape (n, n)
        Displacement of the contact points per contact force, for :class:`Solver` or :func:`solve`.
    displacement : ndarray, shape (n,)
        Displacements of the contact points by load and supports, to be added to the gaps; length.
    modes : ndarray, shape (n, m)
        Rigid modes that the contact has to resist; m = 0 if the body does not float.
    resultant : ndarray, shape (m,)
        Resultant of the load for each mode, which the contact forces must have too.
    """

    influence: NDArray[np.float64]
    displacement: NDArray[np.float64]
    modes: NDArray[np.float64]
    resultant: NDArray[np.float64]


class Body(Owner):
    """A body, given by its stiffness matrix K, symmetric, force per displacement.

    Two bodies in contact are one Body: K has both, and contact points name degrees of freedom of both surfaces.
    Degrees of freedom count from 0.

    Parameters
    ----------
    stiffness : array_like of shape (degrees, degrees), scipy.sparse matrix or CompressedColumns
        Both triangles; of a sparse matrix one of them will do. Its arrays are not copied if they have the right types:
        leave them unchanged.

    Raises
    ------
    InputError
        The shape is not square.
    UnsupportedError
        A sparse matrix, and the library was built without CHOLMOD.

    Examples
    --------
    >>> body = fuge.Body(stiffness)
    >>> body.fix([0, 1])
    >>> body.set_contact(dof, normal)
    >>> condensed = body.condense()
    >>> contact = fuge.solve(condensed.influence, gap + condensed.displacement, load)
    >>> displacement = body.recover(contact.force)
    """

    _message_function = "fuge_body_message"

    def __init__(self, stiffness: Any) -> None:
        if is_sparse(stiffness):
            self._sparse(stiffness)
            return
        matrix = _arrays.symmetric("stiffness", stiffness)
        self._create("fuge_body_dense", matrix.shape[0], matrix, matrix.shape[0])
        self._handle.keep(matrix)

    @classmethod
    def from_band(cls, ab: ArrayLike, *, upper: bool = False) -> Body:
        """A body from the diagonals of its stiffness matrix, as ``scipy.linalg.cholesky_banded`` takes them.

        Parameters
        ----------
        ab : array_like, shape (kd + 1, degrees)
            Lower form: ab[i - j, j] = K[i, j], i >= j; upper form: ab[kd + i - j, j] = K[i, j], i <= j.
        upper : bool
            Whether `ab` has the upper form.
        """
        band = _arrays.columns("ab", ab, (None, None))
        rows, degrees = band.shape
        body = cls.__new__(cls)
        body._create("fuge_body_band", degrees, rows - 1, band, rows, int(bool(upper)))
        body._handle.keep(band)
        return body

    def _sparse(self, stiffness: Any) -> None:
        matrix = compressed("stiffness", stiffness)
        if matrix.shape[0] != matrix.shape[1]:
            raise error(Status.ERR_SIZE, f"stiffness has the shape {matrix.shape}, but must be square")
        require_sparse()
        self._create("fuge_body_sparse", matrix.shape[0], matrix.column, matrix.row, matrix.value)
        self._handle.keep(matrix)

    def _create(self, create: str, degrees: int, *arguments: Any) -> None:
        self.degrees = degrees
        self._n = 0
        self._fixed = 0
        self._links: Links | None = None
        self._solver: Solver | None = None
        self._handle = new_handle("body", create, "fuge_body_free", degrees, *arguments)

    def fix(self, dof: ArrayLike, displacement: ArrayLike | None = None) -> None:
        """Fix degrees of freedom, at zero or at these displacements, in place of those that were fixed before.

        Parameters
        ----------
        dof : array_like of int, shape (count,)
        displacement : array_like, shape (count,), or float, optional
        """
        fixed = _arrays.integers("dof", dof, (None,))
        given = None if displacement is None else _arrays.spread("displacement", displacement, fixed.size)
        self._call("fuge_body_fix", fixed.size, fixed, given)
        self._fixed = fixed.size

    def set_load(self, load: ArrayLike) -> None:
        """Set the external load, one force for each degree of freedom. After :meth:`condense` it costs one solve."""
        self._call("fuge_body_set_load", _arrays.vector("load", load, self.degrees))

    def set_rigid_modes(self, rigid_modes: ArrayLike) -> None:
        """Let the body float, with the rigid modes that its supports allow, (degrees, m); see :func:`rigid_modes`."""
        modes = _arrays.columns("rigid_modes", rigid_modes, (self.degrees, None))
        self._call("fuge_body_set_rigid_modes", modes.shape[1], modes)

    def find_rigid_modes(self) -> None:
        """Let the body float, with rigid modes that :meth:`condense` finds."""
        self._call("fuge_body_find_rigid_modes")

    def set_contact(self, dof: ArrayLike, normal: ArrayLike) -> None:
        """Set the contact points; point i moves by the sum of normal[i, k] * u[dof[i, k]] over k, which opens its gap.

        Parameters
        ----------
        dof : array_like of int, shape (n, width) or (n,)
            Degrees of freedom of each point; -1 for none.
        normal : array_like of the same shape
            Direction of the contact force on the body, into the body; on a second body in K the opposite direction.
        """
        degrees = _arrays.integers("dof", stacked("dof", dof), (None, None))
        n, width = degrees.shape
        directions = _arrays.doubles("normal", stacked("normal", normal), (n, width))
        self._call("fuge_body_set_contact", n, width, degrees, directions)
        self._n = n
        self._links = None

    def set_links(self, links: Links) -> None:
        """Make the links of a structure the contact points, before :meth:`condense`; then :meth:`solve_cases`."""
        with links._handle.use() as pointer:
            self._call("fuge_body_set_links", pointer)
        self._n = links.count
        self._links = links

    def condense(self) -> Condensed:
        """Condense to the contact points: one Cholesky factorisation and n + 4 solves.

        Returns
        -------
        Condensed

        Raises
        ------
        MatrixError
            K is not symmetric, or not positive definite; the message names the degree of freedom that still moves.
        InputError
            A degree of freedom is out of range or named twice, a number is not finite, or modes are not rigid modes.
        EquilibriumError
            A load that no contact can resist.

        Warns
        -----
        ResidualWarning
            K is so close to singular that few digits may be correct.
        """
        self._call("fuge_body_condense")
        self._solver = None
        n, m = self._n, self._mode_count()
        influence, displacement = np.empty((n, n), order="F"), np.empty(n)
        modes, resultant = np.empty((n, m), order="F"), np.empty(m)
        self._call("fuge_body_get_influence", influence, n)
        self._call("fuge_body_get_displacement", displacement)
        self._call("fuge_body_get_modes", modes, resultant)
        return Condensed(influence, displacement, modes, resultant)

    def recover(self, force: ArrayLike, motion: ArrayLike | None = None) -> NDArray[np.float64]:
        """Displacements of all degrees of freedom under contact forces.

        Parameters
        ----------
        force : array_like, shape (n,)
            Forces of a solution.
        motion : array_like, shape (m,), optional
            Motions of the solution, if the body floats.

        Returns
        -------
        ndarray, shape (degrees,)

        Raises
        ------
        CallOrderError
            The body has not been condensed, or has changed since.

        Warns
        -----
        ResidualWarning
            K u is out of balance by more than 1e-10 of the forces.
        """
        forces = _arrays.vector("force", force, self._n)
        m = self._mode_count()
        motions = None if motion is None else _arrays.vector("motion", motion, m)
        displacement = np.empty(self.degrees)
        self._call("fuge_body_recover", forces, motions, displacement)
        return displacement

    def solve_cases(self, loads: ArrayLike, *, supports: ArrayLike | None = None) -> Cases:
        """Forces of the links and displacements of the structure in load cases, after :meth:`condense`.

        Parameters
        ----------
        loads : array_like, shape (cases, degrees)
            External loads; the load of :meth:`set_load` does not count.
        supports : array_like, shape (cases, fixed), optional
            Displacements of the supports in each case, in the order of :meth:`fix`; length. By default those of
            :meth:`fix` in all cases.

        Returns
        -------
        Cases
            With `displacement`, shape (cases, degrees). A case that fails harms no other: its row is NaN.

        Warns
        -----
        CasesWarning
            Some cases failed or have a warning; see `status` and `message` of the result.
        ResidualWarning
            Displacements are out of balance by more than 1e-10 of the forces; `message` tells in which cases.
        Warning
            Links that can never act, because fixed degrees of freedom hold their ends.

        Raises
        ------
        CallOrderError
            There are no links, or the body has not been condensed, or has changed since.
        """
        forces = _arrays.doubles("loads", loads, (None, self.degrees))
        number = len(forces)
        moved = None if supports is None else _arrays.doubles("supports", supports, (number, self._fixed))
        solver, links = self._pose()
        if moved is None:
            with links._handle.use() as pointer:
                idle = links._read_message(pointer)
            if idle:
                warn(Warning(idle, Status.DONE))
        displacement, resultant = np.empty((number, self._n)), np.empty((number, self._mode_count()))
        refused = np.zeros(number, dtype=np.intc)
        with self._handle.use() as pointer:
            code = function("fuge_body_get_cases")(pointer, number, forces, moved, displacement, resultant, refused)
            message = in_python(self._read_message(pointer), self._shapes)
            if code < 0:
                end_call(code, lambda: message)
            reasons = {int(k): self._case_message(pointer, int(k)) for k in np.flatnonzero(refused < 0)}
        found, solved, remark = solver._solve_cases(displacement + links.gap, resultant if resultant.size else None)
        if code == 0:
            code, message = solved, remark
        for k, reason in reasons.items():
            found = _report(found, k, Status(int(refused[k])), reason)
        recovered = np.empty(forces.shape)
        arguments = number, forces, moved, found.force, found.motion, recovered, found.status
        with self._handle.use() as pointer:
            balance = function("fuge_body_recover_cases")(pointer, *arguments)
            imbalance = in_python(self._read_message(pointer), self._shapes)
            remarks = [self._case_message(pointer, k) for k in range(number if balance > 0 else 0)]
        end_call(balance, lambda: imbalance)
        for k, remark in enumerate(remarks):
            if remark and found.status[k] == Status.DONE:
                found = _report(found, k, Status(balance), remark)
        end_call(code, lambda: message)
        return replace(found, displacement=recovered)

    def _case_message(self, pointer: ctypes.c_void_p, k: int) -> str:
        text = ctypes.create_string_buffer(MESSAGE_LENGTH + 1)
        function("fuge_body_case_message")(pointer, k, text, MESSAGE_LENGTH + 1)
        return in_python(text.value.decode(errors="replace"), self._shapes)

    def mechanism(self) -> NDArray[np.float64]:
        """How the structure moves where no forces of its links balance the load of :meth:`set_load`.

        Returns
        -------
        ndarray, shape (degrees,)
            Displacements along which no link closes, unless its force is at the limit, while the load does work, the
            largest of size 1; all zero where there is equilibrium. :meth:`Links.describe` puts them into words.

        Raises
        ------
        CallOrderError
            There are no links, or the body has not been condensed, or has changed since.
        """
        solver, _ = self._pose()
        displacement = np.empty(self.degrees)
        with solver._handle.use() as pointer:
            self._call("fuge_body_find_mechanism", pointer, displacement)
        return displacement

    def _pose(self) -> tuple[Solver, Links]:
        """A solver with the problem of the links, kept until the body is condensed again."""
        from fuge.solver import Solver

        links = self._links
        if links is None:
            raise error(Status.ERR_CALL_ORDER, "the body has no links: call set_links and condense first")
        if self._solver is None:
            influence = np.empty((self._n, self._n), order="F")
            self._call("fuge_body_get_influence", influence, self._n)
            self._solver = Solver(influence)
        with self._handle.use() as body, self._solver._handle.use() as solver:
            links._call("fuge_links_pose", body, solver)
        return self._solver, links

    def _mode_count(self) -> int:
        return self._counts("fuge_body_get_mode_count")[0]


def _report(cases: Cases, k: int, status: Status, message: str) -> Cases:
    """The cases with what the body has reported of case k."""
    cases.status[k] = status
    infos, messages = list(cases.info), list(cases.message)
    infos[k], messages[k] = replace(infos[k], status=status), message
    return replace(cases, info=tuple(infos), message=tuple(messages))


def rigid_modes(position: ArrayLike) -> NDArray[np.float64]:
    """Rigid modes of nodes in the plane or in space, for degrees of freedom dimensions*node + direction.

    Parameters
    ----------
    position : array_like, shape (nodes, 2) or (nodes, 3)
        Length.

    Returns
    -------
    ndarray, shape (2 nodes, 3) or (3 nodes, 6)
        Translations, then rotations about the centre of the nodes.
    """
    places = _arrays.doubles("position", position, (None, 2), (None, 3))
    nodes, dimensions = places.shape
    modes = np.empty((dimensions * nodes, 3 if dimensions == 2 else 6), order="F")
    call("fuge_rigid_modes", dimensions, nodes, places, modes, shapes={"position": places.shape})
    return modes
