"""Contact points from two surfaces of finite elements whose nodes do not face each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import Owner, new_handle
from fuge._words import Words
from fuge.errors import Warning

PairMethod = Literal["mortar", "node_to_face"]
Normals = Literal["averaged", "opposite", "given"]

PAIR_METHODS = Words("method", PairMethod)
NORMALS = Words("normals", Normals, "NORMALS_")


@dataclass(frozen=True, eq=False)
class Surface:
    """A surface of finite elements.

    Attributes
    ----------
    node : array_like, shape (nodes, 2) or (nodes, 3)
        Positions; length. Those of the body's other nodes tell on which side of its faces it lies.
    face : array_like of int, shape (faces, most)
        Nodes of each face, from 0, -1 in unused places: 2 or 3 in the plane, 3, 4, 6 or 8 in space; corners first, then
        the nodes in the middle of the sides. In the plane the body lies to the left of the way from corner 0 to
        corner 1; in space the corners run counter-clockwise if seen from outside.
    dof : array_like of int, shape of node, optional
        Degrees of freedom of the nodes, -1 where a node does not move; without them the surface is rigid.
    """

    node: ArrayLike
    face: ArrayLike
    dof: ArrayLike | None = None

    def __repr__(self) -> str:
        rigid = ", rigid" if self.dof is None else ""
        return f"<Surface: {len(np.asarray(self.node))} nodes, {len(np.asarray(self.face))} faces{rigid}>"


def surface_arguments(name: str, surface: Surface) -> list[Any]:
    """The arguments dimensions, nodes, node, most, faces, face, dof of a surface."""
    nodes = _arrays.doubles(f"{name}.node", surface.node, (None, 2), (None, 3))
    faces = _arrays.integers(f"{name}.face", surface.face, (None, None))
    dof = None if surface.dof is None else _arrays.integers(f"{name}.dof", surface.dof, nodes.shape)
    count, dimensions = nodes.shape
    return [dimensions, count, nodes, faces.shape[1], faces.shape[0], faces, dof]


def pair_options(
    contact: Surface,
    method: PairMethod,
    normals: Normals,
    normal: ArrayLike | None,
    reach: float,
    play: float,
    tied: bool,
    smooth: bool,
) -> list[Any]:
    """The arguments method, normals, normal, reach, play, tied, smooth of a pair."""
    return [
        PAIR_METHODS.number(method),
        NORMALS.number(normals),
        None if normal is None else _arrays.doubles("normal", normal, np.shape(contact.node)),
        _arrays.number("reach", reach),
        _arrays.number("play", play),
        int(bool(tied)),
        int(bool(smooth)),
    ]


class ContactPairs(Owner):
    """Contact points of pairs of surfaces; :meth:`find` adds those of one pair.

    Pressure is force/area.

    Attributes
    ----------
    dof, normal : ndarray, shape (n, width)
        For :meth:`Body.set_contact`; dof is -1 where unused.
    gap, gap_upper : ndarray, shape (n,)
        Initial gaps and plays, for :meth:`Solver.set_gap`; length.
    area : ndarray, shape (n,)
        Areas of the contact points, in the plane lengths.
    pair, node, face : ndarray of int, shape (n,)
        The pair, the node of its contact surface, and the opposite face (with 'mortar' that with the largest share).
    place : ndarray, shape (n, dimensions - 1)
        Coordinates in the opposite face.
    direction : ndarray, shape (n, dimensions)
        Direction of the gap: the force on the opposite body is force*direction.
    unpaired : ndarray of int, shape (count, 2)
        Pair and node of each node without an opposite face, which is no contact point.
    """

    _message_function = "fuge_pairs_message"

    def __init__(self) -> None:
        self._handle = new_handle("contact pairs", "fuge_pairs_create", "fuge_pairs_free")
        self._keep(0, 0, 0, 0)

    def __repr__(self) -> str:
        return f"<ContactPairs: {self.gap.size} points, {len(self.unpaired)} nodes without an opposite face>"

    def find(
        self,
        contact: Surface,
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
        """Find the contact points of two surfaces and add them to those found before.

        Parameters
        ----------
        contact, opposite : Surface
            The surface whose nodes become contact points (with linear faces the coarser
            one, whose pressures are smooth, with quadratic faces the finer one), and the other.
        method : {'mortar', 'node_to_face'}
            Weighted gaps of the dual mortar method; or each node against the face across from it, which does not
            reproduce a uniform pressure on meshes that do not match.
        normals : {'averaged', 'opposite', 'given'}
            Normals averaged at the nodes of the contact surface, those of the opposite faces, or `normal`.
        normal : array_like, shape of contact.node, optional
            For 'given': outwards from the contact surface, of any length.
        reach : float
            How far apart, or one inside the other, opposite points may be; 0: as far as the surfaces extend; length.
        play : float
            Distance of the two stops: 0 for points that stay in contact but slide; length.
        tied : bool
            Glue the surfaces where they are, along each axis.
        smooth : bool
            Use normals, gaps and areas of the curved bodies that the meshes approximate, exact on circles, spheres and
            cylinders. If false, those of the faces as they are.
        crease : float
            Angle between the normals of neighbouring faces, in degrees from 0 to 90, beyond which a curved body has an
            edge there.
        revolution : bool
            Surfaces in the plane are those of bodies of revolution with the radius along x: areas are those of rings,
            and forces those of whole rings.

        Raises
        ------
        InputError
            Faces have no area, look the wrong way or not at each other, or numbers and shapes do not fit.

        Warns
        -----
        PairsWarning
            A node is a contact point of two pairs.
        """
        options = pair_options(contact, method, normals, normal, reach, play, tied, smooth)
        self._set(contact, opposite, crease, revolution)
        try:
            self._call("fuge_pairs_find", *options)
        except Warning:
            # The caller has made an exception of it, but the pairs are there.
            self._collect()
            raise
        self._collect()

    def _set(self, contact: Surface, opposite: Surface, crease: float, revolution: bool) -> None:
        """Set the surfaces of the next pair."""
        arguments = surface_arguments("contact", contact)
        self._call("fuge_pairs_set_contact", *arguments)
        self._call("fuge_pairs_set_opposite", *surface_arguments("opposite", opposite))
        self._call("fuge_pairs_set_geometry", _arrays.number("crease", crease), int(bool(revolution)))
        self._dimensions = int(arguments[0])

    def _collect(self) -> None:
        n, width, unpaired = self._counts("fuge_pairs_get_sizes")
        lonely = self._keep(n, width, unpaired, self._dimensions)
        self._call("fuge_pairs_get_contact", self.dof, self.normal)
        self._call("fuge_pairs_get_gaps", self.gap, self.gap_upper, self.area)
        self._call("fuge_pairs_get_points", self.pair, self.node, self.face, self.place, self.direction)
        self._call("fuge_pairs_get_unpaired", *lonely)
        self.unpaired = np.column_stack(lonely)

    def _keep(self, n: int, width: int, unpaired: int, dimensions: int) -> list[NDArray[np.intc]]:
        """Make new arrays; those returned are for pair and node of the nodes without an opposite face."""
        self.dof: NDArray[np.intc] = np.empty((n, width), dtype=np.intc)
        self.normal = np.empty((n, width))
        self.gap, self.gap_upper, self.area = np.empty(n), np.empty(n), np.empty(n)
        self.pair, self.node, self.face = (np.empty(n, dtype=np.intc) for _ in range(3))
        self.place, self.direction = np.empty((n, max(dimensions - 1, 0))), np.empty((n, dimensions))
        self.unpaired = np.empty((unpaired, 2), dtype=np.intc)
        return [np.empty(unpaired, dtype=np.intc) for _ in range(2)]
