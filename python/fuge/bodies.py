"""Elastic bodies with meshes of their own in contact: from stiffness matrices and surfaces to forces."""

from __future__ import annotations

import ctypes
import warnings
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Any, Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge._calls import Owner, new_handle
from fuge._library import has_sparse, struct
from fuge.body import Body
from fuge.columns import CompressedColumns, require_sparse
from fuge.contact import Info, info_of
from fuge.errors import Status, error
from fuge.pairs import ContactPairs, Normals, PairMethod, Surface, pair_options
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
        For each body, forces of the supports on it, in the order of :meth:`Body.fix`.
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
    >>> block.fix(block_supports)
    >>> punch.set_load(punch_load)
    >>> bodies.add_pair(punch, punch_surface, block, block_surface)
    >>> contact = bodies.solve()
    """

    _message_function = "fuge_bodies_message"

    def __init__(self) -> None:
        self._handle = new_handle("bodies", "fuge_bodies_create", "fuge_bodies_free")
        self._pairs = ContactPairs()
        self._bodies: list[Body] = []
        self._surfaces: list[tuple[int, Surface]] = []

    def __repr__(self) -> str:
        degrees = ", ".join(str(body.degrees) for body in self._bodies)
        return f"<ElasticBodies: {len(self._bodies)} bodies of {degrees} degrees of freedom>"

    def add(self, body: Any) -> Body:
        """Add a body and return it; supports and load are those that it has at the time of a solve.

        Bodies are numbered from 0, in messages and in :class:`BodiesContact`. Give the rigid modes of all bodies that
        float, or of none: then they are found.

        Parameters
        ----------
        body : Body, or a stiffness matrix as :class:`Body` takes it
        """
        added = body if isinstance(body, Body) else Body(body)
        with added._handle.use() as pointer:
            self._call("fuge_bodies_add", pointer, None)
        self._handle.need(added._handle)
        self._bodies.append(added)
        return added

    def add_pair(
        self,
        contact_body: Body | None,
        contact: Surface,
        opposite_body: Body | None,
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
        contact_body, opposite_body : Body or None
            Both may be the same; None: the surface is rigid and held in space.
        contact, opposite, method, normals, normal, reach, play, tied, smooth, crease, revolution
            As in :meth:`ContactPairs.find`.
        """
        options = pair_options(contact, method, normals, normal, reach, play, tied, smooth)
        numbers = self._number(contact_body), self._number(opposite_body)
        self._pairs._set(contact, opposite, crease, revolution)
        with self._pairs._handle.use() as pairs:
            self._call("fuge_bodies_add_pair", *numbers, pairs, *options)
        for number, surface in zip(numbers, (contact, opposite)):
            if number >= 0 and surface.dof is not None:
                self._surfaces.append((number, surface))

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
        name = "fuge_bodies_solve_sparse" if by_cholmod else "fuge_bodies_solve"
        with self._in_use() as pairs:
            self._call(name, ctypes.byref(options), pairs)
        return self._contact()

    def join(self) -> JoinedBodies:
        """Join the bodies into one, for further loads on the same factor, or to exclude points."""
        degrees, entries = (np.empty(1, dtype=np.intc) for _ in range(2))
        with self._in_use() as pairs:
            self._call("fuge_bodies_join", pairs, degrees, entries)
        shape = int(degrees[0]), int(degrees[0])
        column, row = np.empty(shape[0] + 1, dtype=np.intc), np.empty(entries[0], dtype=np.intc)
        value, first = np.empty(entries[0]), np.empty(len(self._bodies) + 1, dtype=np.intc)
        self._call("fuge_bodies_get_matrix", column, row, value, first)
        stiffness, points = CompressedColumns(shape, column, row, value), self._pairs
        points._collect()
        return JoinedBodies(stiffness, first, points.dof, points.normal, points.gap, points.gap_upper, points.area)

    @property
    def info(self) -> Info:
        """Report of the last solve, failed or not."""
        report = struct("fuge_info")
        self._call("fuge_bodies_get_info", ctypes.byref(report))
        return info_of(report)

    def _contact(self) -> BodiesContact:
        with self._handle.use() as pointer:
            message = self._read_message(pointer)
        self._pairs._collect()
        points = self._pairs
        force, pressure, gap = (np.empty(points.gap.size) for _ in range(3))
        self._call("fuge_bodies_get_forces", force, pressure, gap)
        displacement = [np.empty(body.degrees) for body in self._bodies]
        for number, result in enumerate(displacement):
            self._call("fuge_bodies_get_displacement", number, result)
        found = (points.gap, points.area, points.pair, points.node, points.face, points.place, points.direction)
        unpaired, reaction = points.unpaired, self._reactions(displacement, force)
        return BodiesContact(force, pressure, gap, *found, unpaired, displacement, reaction, self.info, message)

    def _reactions(
        self, displacement: list[NDArray[np.float64]], force: NDArray[np.float64]
    ) -> list[NDArray[np.float64]]:
        """Forces of the supports of each body: what its stiffness, its load and the contact forces leave."""
        found = [
            symmetric(body._matrix)[body._fixed] @ u - body._loads()[body._fixed]
            for body, u in zip(self._bodies, displacement)
        ]
        if any(np.isin(self._bodies[k]._fixed, np.asarray(surface.dof)).any() for k, surface in self._surfaces):
            with warnings.catch_warnings():
                # The solve has given them.
                warnings.simplefilter("ignore")
                joined = self.join()
            pressing = opening_rows(joined.dof, joined.normal, int(joined.first[-1])).T @ force
            for reaction, body, first in zip(found, self._bodies, joined.first):
                reaction -= pressing[first + body._fixed]
        return found

    @contextmanager
    def _in_use(self) -> Iterator[ctypes.c_void_p]:
        """The address of the pairs, while no other thread changes a body."""
        handles = {body._handle for body in self._bodies}
        with ExitStack() as stack:
            for handle in sorted(handles, key=id):
                stack.enter_context(handle._alone())
            yield stack.enter_context(self._pairs._handle.use())

    def _number(self, body: Body | None) -> int:
        """The number of a body, -1 for none."""
        if body is None:
            return -1
        numbers = [k for k, added in enumerate(self._bodies) if added is body]
        if not numbers:
            raise error(Status.ERR_SIZE, f"{body!r} is not one of the {len(self._bodies)} bodies that have been added")
        return numbers[0]
