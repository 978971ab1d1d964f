"""Condensation: from the stiffness matrix of a finite element model to the influence matrix of its contact points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import dia_matrix

from fuge import _arrays
from fuge._calls import Owner, call, new_handle
from fuge._library import function, has_sparse
from fuge._messages import in_python
from fuge.cases import Cases, checked_names
from fuge.columns import compressed, is_sparse, stacked
from fuge.dof_names import DofNames
from fuge.errors import Status, error, finish
from fuge.links import Links
from fuge.reactions import opening_rows, symmetric
from fuge.solver import Solver
from fuge.stability import free_motions, modes_of, null_space


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

    def __repr__(self) -> str:
        n, m = self.modes.shape
        return f"<Condensed: {n} contact points, {m} rigid modes>"


class Body(Owner):
    """A body, given by its stiffness matrix K, symmetric, force per displacement.

    Two bodies in contact are one Body: K has both, and contact points name degrees of freedom of both surfaces.
    Degrees of freedom count from 0.

    Parameters
    ----------
    stiffness : array_like of shape (degrees, degrees), scipy.sparse matrix, CompressedColumns or StiffnessFile
        Both triangles; of a sparse matrix one of them will do, and it is factorised by CHOLMOD, or as a band if the
        library was built without. Its arrays are not copied if they have the right types: leave them unchanged. With
        a StiffnessFile messages name degrees of freedom by node and direction.

    Raises
    ------
    InputError
        The shape is not square.

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
        self._names = DofNames(stiffness)
        if not is_sparse(stiffness):
            dense = _arrays.symmetric("stiffness", stiffness)
            self._create("fuge_body_dense", dense, len(dense), dense, len(dense))
            return
        matrix = compressed("stiffness", stiffness)
        if matrix.shape[0] != matrix.shape[1]:
            raise error(Status.ERR_SIZE, f"stiffness has the shape {matrix.shape}, but must be square")
        create = "fuge_body_sparse" if has_sparse() else "fuge_body_columns"
        self._create(create, matrix, matrix.shape[0], matrix.column, matrix.row, matrix.value)

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
        body._names = DofNames(None)
        diagonals = (rows - 1 if upper else 0) - np.arange(rows)
        matrix = dia_matrix((band, diagonals), shape=(degrees, degrees))
        body._create("fuge_body_band", matrix, degrees, rows - 1, band, rows, int(bool(upper)))
        body._handle.keep(band)
        return body

    def _create(self, create: str, matrix: Any, degrees: int, *arguments: Any) -> None:
        """Make the body of a matrix, to whose arrays the library refers."""
        self.degrees = degrees
        self._dof, self._normal = np.empty((0, 1), dtype=np.intc), np.empty((0, 1))
        self._fixed, self._settled = np.empty(0, dtype=np.intc), np.empty(0)
        self._supports: tuple[str, ...] | None = None
        self._load: NDArray[np.float64] | None = None
        self._links: Links | None = None
        self._solver: Solver | None = None
        self._handle = new_handle("body", create, "fuge_body_free", degrees, *arguments)
        self._handle.keep(matrix)
        self._matrix = matrix

    def __repr__(self) -> str:
        held = f"{self.degrees} degrees of freedom, {self._fixed.size} of them fixed"
        return f"<Body: {held}, {self._n} {'contact points' if self._links is None else 'links'}>"

    @property
    def _n(self) -> int:
        """Number of contact points."""
        return len(self._dof)

    def fix(self, dof: ArrayLike, displacement: ArrayLike | None = None, *, names: Sequence[str] | None = None) -> None:
        """Fix degrees of freedom, at zero or at these displacements, in place of those that were fixed before.

        Parameters
        ----------
        dof : array_like of int, shape (count,)
        displacement : array_like, shape (count,), or float, optional
        names : sequence of str, optional
            Of the supports, for tables of reactions; otherwise those of the degrees of freedom.
        """
        fixed = _arrays.integers("dof", dof, (None,))
        given = None if displacement is None else _arrays.spread("displacement", displacement, fixed.size)
        supports = None if names is None else checked_names(names, fixed.size)
        self._call("fuge_body_fix", fixed.size, fixed, given)
        self._supports, self._fixed = supports, fixed.copy()
        self._settled = np.zeros(fixed.size) if given is None else given.copy()

    def set_load(self, load: ArrayLike) -> None:
        """Set the external load, one force for each degree of freedom. After :meth:`condense` it costs one solve."""
        forces = _arrays.vector("load", load, self.degrees)
        self._call("fuge_body_set_load", forces)
        self._load = forces.copy()

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
        self._dof, self._normal, self._links = degrees.copy(), directions.copy(), None

    def set_links(self, links: Links) -> None:
        """Make the links of a structure the contact points, before :meth:`condense`; then :meth:`solve_cases`."""
        with links._handle.use() as pointer:
            self._call("fuge_body_set_links", pointer)
        self._dof, self._normal = links._contact()
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

    def reaction(self, displacement: ArrayLike, force: ArrayLike, load: ArrayLike | None = None) -> NDArray[np.float64]:
        """Forces of the supports on the body: at the degrees of freedom of :meth:`fix`, in their order.

        Parameters
        ----------
        displacement : array_like, shape (degrees,) or (cases, degrees)
            That of :meth:`recover`; length.
        force : array_like, shape (n,) or (cases, n)
            Contact forces.
        load : array_like, shape of displacement, optional
            External loads; by default that of :meth:`set_load`.

        Returns
        -------
        ndarray, shape (fixed,) or (cases, fixed)
            K u less the load and the contact forces; a moment where a rotation is held.

        Raises
        ------
        InputError
            A shape does not fit, or a fixed degree of freedom is out of range.
        """
        u = _arrays.doubles("displacement", displacement, (self.degrees,), (None, self.degrees))
        f = _arrays.doubles("force", force, (*u.shape[:-1], self._n))
        p = self._loads() if load is None else _arrays.doubles("load", load, u.shape, (self.degrees,))
        self._check_dof("fixed", self._fixed, 0)
        held, contact = symmetric(self._matrix)[self._fixed], self._openings()[:, self._fixed]
        return np.asarray((held @ u.T).T - (contact.T @ f.T).T - p[..., self._fixed])

    def solve_cases(
        self,
        loads: ArrayLike,
        *,
        supports: ArrayLike | None = None,
        names: Sequence[str] | None = None,
        prove: bool = False,
    ) -> Cases:
        """Forces of the links, reactions and displacements of the structure in load cases, after :meth:`condense`.

        Parameters
        ----------
        loads : array_like, shape (cases, degrees)
            External loads; the load of :meth:`set_load` does not count.
        supports : array_like, shape (cases, fixed), optional
            Displacements of the supports in each case, in the order of :meth:`fix`; length. By default those of
            :meth:`fix` in all cases.
        names : sequence of str, optional
            Of the cases, for messages and tables; otherwise 'load case 0' and so on.
        prove : bool
            Bound the errors of all forces and gaps too, `proof` of the result: of the condensed problem, whose
            influence matrix and gaps are taken as they are.

        Returns
        -------
        Cases
            With `displacement`, shape (cases, degrees), and `reaction`, shape (cases, fixed). A case that fails harms
            no other: its row is NaN. Where nothing balances the loads, `message` tells which links open or give way.

        Warns
        -----
        CasesWarning
            Some cases failed or have a warning; see `status` and `message` of the result.
        ResidualWarning
            Displacements are out of balance by more than 1e-10 of the forces; `message` tells in which cases.
        NotProvedWarning
            Bounds of some cases are infinite.
        Warning
            Links that can never act, because fixed degrees of freedom hold their ends.

        Raises
        ------
        CallOrderError
            There are no links, or the body has not been condensed, or has changed since.
        """
        from fuge.link_cases import solve_link_cases

        return solve_link_cases(self, loads, supports, names, prove)

    def mechanism(self, load: ArrayLike | None = None) -> NDArray[np.float64]:
        """How the structure moves where no forces of its links balance a load; no solve has to fail before.

        Parameters
        ----------
        load : array_like, shape (degrees,), optional
            External load; by default that of :meth:`set_load`.

        Returns
        -------
        ndarray, shape (degrees,)
            Displacements along which no link closes, unless its force is at the limit, while the load does work, the
            largest of size 1; all zero where there is equilibrium. :meth:`Links.describe` puts them into words.

        Raises
        ------
        EquilibriumError
            The load drives a motion that moves no link; :meth:`check_stability` tells which.
        CallOrderError
            There are no links, or the body has not been condensed, or has changed since.
        """
        if load is not None:
            before = self._loads()
            self.set_load(load)
            try:
                return self.mechanism()
            finally:
                self.set_load(before)
        solver, _ = self._pose()
        displacement = np.empty(self.degrees)
        with solver._handle.use() as pointer:
            self._call("fuge_body_find_mechanism", pointer, displacement)
        return displacement

    def check_stability(self, position: ArrayLike, dof: ArrayLike) -> dict[str, NDArray[np.float64]]:
        """What neither stiffness nor supports nor links hold, in whatever direction: to be asked before any load.

        Overturning depends on the load: ask :meth:`mechanism`. The body need not have been condensed; a factorisation
        is made for this alone.

        Parameters
        ----------
        position : array_like, shape (nodes, 2) or (nodes, 3)
            Where the nodes are; length.
        dof : array_like of int, shape of position
            Their degrees of freedom; -1: does not move.

        Returns
        -------
        dict
            Sentences such as 'nothing holds the structure along x: it slides', each with its motion, shape (degrees,),
            the largest displacement of size 1. Empty if all is held.

        Raises
        ------
        InputError
            A shape does not fit, or a degree of freedom is out of range.
        MatrixError
            K is not symmetric, or has negative stiffness.
        """
        places = _arrays.doubles("position", position, (None, 2), (None, 3))
        degrees = _arrays.integers("dof", dof, places.shape)
        if degrees.size == 0:
            raise error(Status.ERR_SIZE, "there is no node: position and dof are empty")
        self._check_dof("dof", degrees)
        stiffness = symmetric(self._matrix)
        with Body(stiffness) as probe:
            probe.fix(self._fixed)
            modes = modes_of(probe)
        free = modes @ null_space(self._openings() @ modes, np.abs(self._normal).max(initial=0.0))
        return free_motions(free, rigid_modes(places), degrees, self._names.most)

    def _pose(self) -> tuple[Solver, Links]:
        """A solver with the problem of the links, kept until the body is condensed again."""
        links = self._links
        if links is None:
            raise error(Status.ERR_CALL_ORDER, "the body has no links: call set_links and condense first")
        if self._solver is None:
            influence = np.empty((self._n, self._n), order="F")
            self._call("fuge_body_get_influence", influence, self._n)
            self._solver = Solver(influence)
        with self._handle.use() as body, self._solver._handle.use() as solver:
            links._call("fuge_links_pose", body, solver)
        self._solver._take_links(links.gap, links._play())
        return self._solver, links

    def _loads(self) -> NDArray[np.float64]:
        return np.zeros(self.degrees) if self._load is None else self._load

    def _mode_count(self) -> int:
        return self._counts("fuge_body_get_mode_count")[0]

    def _openings(self) -> Any:
        """How far displacements open the contact points, as a matrix (n, degrees)."""
        self._check_dof("dof", self._dof)
        return opening_rows(self._dof, self._normal, self.degrees)

    def _check_dof(self, name: str, dof: NDArray[np.intc], least: int = -1) -> None:
        wrong = dof[(dof < least) | (dof >= self.degrees)]
        if wrong.size > 0:
            raise error(Status.ERR_DOF, f"{name} has {wrong[0]}, but there are {self.degrees} degrees of freedom")

    def _support_names(self) -> tuple[str, ...]:
        return self._supports or tuple(self._names[int(dof)] for dof in self._fixed)

    def _named(self, message: str) -> str:
        """The message with names of links and degrees of freedom."""
        return self._names.in_message(message, () if self._links is None else self._links.names)

    def _call(self, name: str, *arguments: Any, shapes: Any = None) -> None:
        """Call a function of the body; its message has names."""
        with self._handle.use() as pointer:
            code = function(name)(pointer, *arguments)
            message = in_python(self._read_message(pointer), self._shapes) if code != 0 else ""
        finish(code, self._named(message))


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
