"""Elastic bodies with meshes of their own in contact: from stiffness matrices and surfaces to forces."""

from __future__ import annotations

import ctypes
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import Owner, new_handle
from fuge._library import has_sparse, struct
from fuge.columns import CompressedColumns, compressed, compressed_dense, is_sparse, require_sparse
from fuge.contact import Info, info_of
from fuge.errors import Status, error
from fuge.pairs import Normals, PairMethod, Surface, pair_options, surface_arguments
from fuge.reactions import opening_rows, symmetric
from fuge.solver import ALL_CORES, Method, chosen_options


@dataclass(frozen=True, eq=False)
class BodiesContact:
    """Contact of elastic bodies.

    Attributes
    ----------
    force : ndarray, shape (n,)
        Contact forces; negative only at an upper stop and at tied points, where they are components along the axes.
    pressure : ndarray, shape (n,)
        Force over area.
    gap, initial_gap : ndarray, shape (n,)
        Gaps under load and before it; length.
    area : ndarray, shape (n,)
        Areas of the contact points; in the plane lengths.
    pair, node, face : ndarray of int, shape (n,)
        The pair, the node of its contact surface, and the opposite face.
    place : ndarray, shape (n, dimensions - 1)
        Coordinates in the opposite face.
    direction : ndarray, shape (n, dimensions)
        Direction of the gap.
    unpaired : ndarray of int, shape (count, 2)
        Pair and node of each node without an opposite face.
    displacement : list of ndarray
        For each body, of all its degrees of freedom; length.
    reaction : list of ndarray
        For each body, forces of the supports on it, in the order of :meth:`ElasticBodies.fix`.
    info : Info
        Report, with the certificate.
    message : str
        What the library remarks on the solution; mostly empty.
    """

    force: NDArray[np.float64]
    pressure: NDArray[np.float64]
    gap: NDArray[np.float64]
    initial_gap: NDArray[np.float64]
    area: NDArray[np.float64]
    pair: NDArray[np.intc]
    node: NDArray[np.intc]
    face: NDArray[np.intc]
    place: NDArray[np.float64]
    direction: NDArray[np.float64]
    unpaired: NDArray[np.intc]
    displacement: list[NDArray[np.float64]]
    reaction: list[NDArray[np.float64]]
    info: Info
    message: str

    def __repr__(self) -> str:
        known = f"{self.info.contacts} of {self.force.size} points in contact, residual {self.info.residual:.1e}"
        return f"<BodiesContact: {len(self.displacement)} bodies, {known}>"


@dataclass(frozen=True, eq=False)
class JoinedBodies:
    """Several bodies as one, whose matrix is one for :class:`Body`.

    Attributes
    ----------
    stiffness : CompressedColumns
        The upper triangle of the matrix of all bodies.
    first : ndarray of int, shape (bodies + 1,)
        Degree of freedom j of body k is first[k] + j.
    dof, normal : ndarray, shape (n, width)
        For :meth:`Body.set_contact`.
    gap, gap_upper, area : ndarray, shape (n,)
        Initial gaps, plays and areas.
    """

    stiffness: CompressedColumns
    first: NDArray[np.intc]
    dof: NDArray[np.intc]
    normal: NDArray[np.float64]
    gap: NDArray[np.float64]
    gap_upper: NDArray[np.float64]
    area: NDArray[np.float64]

    def __repr__(self) -> str:
        return (
            f"<JoinedBodies: {len(self.first) - 1} bodies, {self.first[-1]} degrees of freedom, {len(self.dof)} points>"
        )


class ElasticBodies(Owner):
    """Bodies and pairs of their surfaces. Bodies may float; sliding is small, without friction.

    Examples
    --------
    >>> bodies = fuge.ElasticBodies()
    >>> block, punch = bodies.add(block_stiffness), bodies.add(punch_stiffness)
    >>> bodies.fix(block, block_supports)
    >>> bodies.set_load(punch, punch_load)
    >>> bodies.add_pair(punch, punch_surface, block, block_surface)
    >>> contact = bodies.solve()
    """

    _message_function = "fuge_bodies_message"

    def __init__(self) -> None:
        self._handle = new_handle("bodies", "fuge_bodies_create", "fuge_bodies_free")
        self._matrices: list[CompressedColumns] = []
        self._degrees: list[int] = []
        self._fixed: list[NDArray[np.intc]] = []
        self._loads: list[NDArray[np.float64]] = []
        self._surfaces: list[tuple[int, Surface]] = []
        self._dimensions = 0

    def __repr__(self) -> str:
        return (
            f"<ElasticBodies: {len(self._degrees)} bodies of {', '.join(map(str, self._degrees))} degrees of freedom>"
        )

    def add(self, stiffness: Any) -> int:
        """Add a body and return its number, from 0.

        Parameters
        ----------
        stiffness : scipy.sparse matrix, CompressedColumns or StiffnessFile, or array_like of shape (degrees, degrees)
            Symmetric, both triangles or one of them.
        """
        pack = compressed if is_sparse(stiffness) else compressed_dense
        matrix = pack("stiffness", stiffness)
        if matrix.shape[0] != matrix.shape[1]:
            raise error(Status.ERR_SIZE, f"stiffness has the shape {matrix.shape}, but must be square")
        body = np.empty(1, dtype=np.intc)
        self._call("fuge_bodies_add", matrix.shape[0], matrix.column, matrix.row, matrix.value, body)
        self._matrices.append(matrix)
        self._degrees.append(matrix.shape[0])
        self._fixed.append(np.empty(0, dtype=np.intc))
        self._loads.append(np.zeros(matrix.shape[0]))
        return int(body[0])

    def fix(self, body: int, dof: ArrayLike, displacement: ArrayLike | None = None) -> None:
        """Fix degrees of freedom of a body; see :meth:`Body.fix`."""
        fixed = _arrays.integers("dof", dof, (None,))
        given = None if displacement is None else _arrays.spread("displacement", displacement, fixed.size)
        number = self._number(body)
        self._call("fuge_bodies_fix", number, fixed.size, fixed, given)
        self._fixed[number] = fixed.copy()

    def set_load(self, body: int, load: ArrayLike) -> None:
        """Set the external load of a body, one force for each of its degrees of freedom."""
        number = self._number(body)
        forces = _arrays.vector("load", load, self._degrees[number])
        self._call("fuge_bodies_set_load", number, forces)
        self._loads[number] = forces.copy()

    def set_rigid_modes(self, body: int, rigid_modes: ArrayLike) -> None:
        """Set the rigid modes that the supports of a body leave, (degrees, m).

        Give those of all bodies that float, or of none: then they are found.
        """
        number = self._number(body)
        modes = _arrays.columns("rigid_modes", rigid_modes, (self._degrees[number], None))
        self._call("fuge_bodies_set_rigid_modes", number, modes.shape[1], modes)

    def add_pair(
        self,
        contact_body: int | None,
        contact: Surface,
        opposite_body: int | None,
        opposite: Surface,
        *,
        method: PairMethod = "mortar",
        normals: Normals = "averaged",
        normal: ArrayLike | None = None,
        reach: float = 0.0,
        play: float = np.inf,
        tied: bool = False,
        smooth: bool = True,
        crease: float = 25.0,
        revolution: bool = False,
    ) -> None:
        """Add a pair of surfaces, each with degrees of freedom of its own body.

        Parameters
        ----------
        contact_body, opposite_body : int or None
            Both may be the same; None: the surface is rigid and held in space.
        contact, opposite, method, normals, normal, reach, play, tied, smooth, crease, revolution
            As in :meth:`ContactPairs.find`.
        """
        options = pair_options(contact, method, normals, normal, reach, play, tied, smooth)
        arguments = surface_arguments("contact", contact)
        self._call("fuge_bodies_set_contact", self._owner(contact_body), *arguments)
        self._call("fuge_bodies_set_opposite", self._owner(opposite_body), *surface_arguments("opposite", opposite))
        self._call("fuge_bodies_set_geometry", _arrays.number("crease", crease), int(bool(revolution)))
        self._call("fuge_bodies_add_pair", *options)
        self._dimensions = int(arguments[0])
        for body, surface in ((contact_body, contact), (opposite_body, opposite)):
            if body is not None and surface.dof is not None:
                self._surfaces.append((body, surface))

    def solve(
        self,
        *,
        sparse: bool | None = None,
        method: Method | None = None,
        max_iterations: int | None = None,
        tolerance: float | None = None,
        threads: int = ALL_CORES,
    ) -> BodiesContact:
        """Solve: pairs, condensation, contact and displacements.

        Parameters
        ----------
        sparse : bool, optional
            True: factorise by CHOLMOD; False: as a band, for small models. By CHOLMOD if the library has it.
        method, max_iterations, tolerance, threads
            As in :class:`Solver`.

        Raises
        ------
        Error
            Those of :meth:`ContactPairs.find`, :meth:`Body.condense` and :meth:`Solver.solve`; the message names the
            body or the pair.

        Warns
        -----
        Warning
            Those of the same three.
        """
        options = chosen_options(method, None, max_iterations, None, tolerance, threads)
        by_cholmod = has_sparse() if sparse is None else sparse
        if by_cholmod:
            require_sparse()
        self._call("fuge_bodies_solve_sparse" if by_cholmod else "fuge_bodies_solve", ctypes.byref(options))
        return self._contact()

    def join(self) -> JoinedBodies:
        """Join the bodies into one, for further loads on the same factor, or to exclude points."""
        self._call("fuge_bodies_join")
        degrees, entries, n, width = self._counts("fuge_bodies_get_joined_sizes")
        column, row = np.empty(degrees + 1, dtype=np.intc), np.empty(entries, dtype=np.intc)
        value, first = np.empty(entries), np.empty(len(self._degrees) + 1, dtype=np.intc)
        dof, normal = np.empty((n, width), dtype=np.intc), np.empty((n, width))
        gap, gap_upper, area = np.empty(n), np.empty(n), np.empty(n)
        self._call("fuge_bodies_get_matrix", column, row, value, first)
        self._call("fuge_bodies_get_contact", dof, normal, gap, gap_upper, area)
        stiffness = CompressedColumns((degrees, degrees), column, row, value)
        return JoinedBodies(stiffness, first, dof, normal, gap, gap_upper, area)

    @property
    def info(self) -> Info:
        """Report of the last solve, failed or not."""
        report = struct("fuge_info")
        self._call("fuge_bodies_get_info", ctypes.byref(report))
        return info_of(report)

    def _contact(self) -> BodiesContact:
        with self._handle.use() as pointer:
            message = self._read_message(pointer)
        n, lonely, _ = self._counts("fuge_bodies_get_sizes")
        force, pressure, gap, area, initial_gap = (np.empty(n) for _ in range(5))
        pair, node, face = (np.empty(n, dtype=np.intc) for _ in range(3))
        place, direction = np.empty((n, max(self._dimensions - 1, 0))), np.empty((n, self._dimensions))
        unpaired = [np.empty(lonely, dtype=np.intc) for _ in range(2)]
        self._call("fuge_bodies_get_forces", force, pressure, gap)
        self._call("fuge_bodies_get_points", pair, node, face, place, direction)
        self._call("fuge_bodies_get_areas", area, initial_gap)
        self._call("fuge_bodies_get_unpaired", *unpaired)
        displacement = [np.empty(degrees) for degrees in self._degrees]
        for body, result in enumerate(displacement):
            self._call("fuge_bodies_get_displacement", body, result)
        return BodiesContact(
            force,
            pressure,
            gap,
            initial_gap,
            area,
            pair,
            node,
            face,
            place,
            direction,
            np.column_stack(unpaired),
            displacement,
            self._reactions(displacement, force),
            self.info,
            message,
        )

    def _reactions(
        self, displacement: list[NDArray[np.float64]], force: NDArray[np.float64]
    ) -> list[NDArray[np.float64]]:
        """Forces of the supports of each body: what its stiffness, its load and the contact forces leave."""
        given = zip(self._matrices, self._fixed, self._loads, displacement)
        found = [symmetric(matrix)[fixed] @ u - load[fixed] for matrix, fixed, load, u in given]
        if any(np.isin(self._fixed[body], np.asarray(surface.dof)).any() for body, surface in self._surfaces):
            with warnings.catch_warnings():
                # The solve has given them.
                warnings.simplefilter("ignore")
                joined = self.join()
            pressing = opening_rows(joined.dof, joined.normal, int(joined.first[-1])).T @ force
            for reaction, fixed, first in zip(found, self._fixed, joined.first):
                reaction -= pressing[first + fixed]
        return found

    def _number(self, body: int) -> int:
        number = _arrays.integer("body", body)
        if not 0 <= number < len(self._degrees):
            raise error(Status.ERR_SIZE, f"there is no body {number}: {len(self._degrees)} have been added")
        return number

    def _owner(self, body: int | None) -> int:
        return -1 if body is None else self._number(body)
