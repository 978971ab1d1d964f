"""Stresses and displacements in a body, under the forces of a contact."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import NO_SHAPES, Handle, Owner, call, new_handle
from fuge._library import struct, struct_array
from fuge._words import Words
from fuge.cells import Cells
from fuge.errors import Status, error
from fuge.halfplane import ELEMENTS, PLANE_STATES, Element, PlaneState
from fuge.layers import Layers, layers_of
from fuge.operators import AREA_BOUNDARIES, BOUNDARIES, AreaBoundary, Boundary

Measure = Literal["von_mises", "tresca"]
Location = Literal["inside", "surface", "singular"]

MEASURES = Words("measure", Measure, "MEASURE_")
LOCATIONS = Words("location", Location, "PEAK_")


@dataclass(frozen=True, eq=False)
class StressPeak:
    """A largest stress.

    Attributes
    ----------
    location : {'inside', 'surface', 'singular'}
        Below the surface, at the surface, or infinite at an edge of the contact or in a tip.
    value : float
        Force per length^2; infinity if singular, 0 without forces.
    place : ndarray, shape (3,)
        x, y, z; length. y is 0 in a plane; about an axis: radius, 0, z.
    tensor : ndarray, shape (6,)
        xx, yy, zz, yz, xz, xy there; NaN if singular.
    layer : int or None
        In layers: 0 is the top one, the last number the substrate; layers that are bonded to the same material are one
        with it.
    cell : tuple of int or None
        In layers: the cell above, (i,) of a line, (row, column) of an area.
    """

    location: Location
    value: float
    place: NDArray[np.float64]
    tensor: NDArray[np.float64]
    layer: int | None = None
    cell: tuple[int, ...] | None = None


@dataclass(frozen=True)
class InterfaceStress:
    """The largest stresses of the surface of a body of layers, or of an interface.

    Attributes
    ----------
    depth : float
        0 at the surface; length.
    tension_above, tension_below : float
        The largest principal stress, tension positive, on both sides of the interface; at the surface, and at a rigid
        base, both are those in the layers; force per length^2.
    shear, opening : float
        The largest shear stress between both sides, and the largest stress zz.
    cell_above, cell_below, cell_of_shear, cell_of_opening : tuple of int
        The cells above them: (i,) of a line, (row, column) of an area.
    """

    depth: float
    tension_above: float
    tension_below: float
    shear: float
    opening: float
    cell_above: tuple[int, ...]
    cell_below: tuple[int, ...]
    cell_of_shear: tuple[int, ...]
    cell_of_opening: tuple[int, ...]


class Loads(NamedTuple):
    """Where the forces of a field act, for pictures: middles, widths and symmetry along x, and on areas along y.

    Closer to the surface than `resolved` the stresses follow the cells; it is 0 without a grid.
    """

    force: NDArray[np.float64]
    axes: list[tuple[NDArray[np.float64], NDArray[np.float64], bool]]
    resolved: float


class Field(Owner):
    """Stresses and displacements in the body below a contact, under the forces of a solution.

    ``contact.field(..)`` has the field of a contact with equal cells or without a grid; others are made of cells and
    forces by :meth:`halfplane` and the other class methods. For the body above turn z round and take its own moduli.
    Threads may share a field.

    Points are x, y, z, z >= 0 from the surface into the body; on grids x and y count from the centre of the first cell.
    In a plane y does not count; about an axis x >= 0 is the radius. Tensors are xx, yy, zz, yz, xz, xy, tension
    positive, so that under a pressure p at z = 0 the stress zz is -p; displacements are along x, y, z. With 'periodic'
    the mean pressure is a stress zz at all depths, and none along the surface of a half-space; displacements count, at
    each depth, from the mean at that depth.

    All constructors take ``young``, Young's modulus, force per length^2, which only displacements need, and
    ``poisson``, or ``layers`` in place of both: the body that these describe, not the other one. A line lies in plane
    strain unless ``plane_state`` is 'stress'.

    Attributes
    ----------
    cells : Cells or None
        Those of a grid.
    """

    def __init__(
        self,
        described: str,
        create: list[Any],
        young: float | None,
        loads: Loads,
        cells: Cells | None = None,
        layers: Layers | None = None,
    ) -> None:
        shapes = NO_SHAPES if cells is None else {"force": cells.shape}
        self._handle: Handle = new_handle("field", create[0], "fuge_field_free", *create[1:], shapes=shapes)
        self.cells = cells
        self._loads = loads
        self._described = described if layers is None else f"{described} on layers"
        self._moves = young is not None or layers is not None
        thickness, moduli = ([], [0.0]) if layers is None else layers_of(layers)[1:3]
        self._layers = len(thickness)
        self._bottom = float(np.sum(thickness)) if np.isinf(moduli[-1]) else np.inf

    def __repr__(self) -> str:
        return f"<Field: {self._described}>"

    @classmethod
    def halfplane(
        cls,
        x: ArrayLike,
        width: ArrayLike,
        force: ArrayLike,
        element: Element = "mean",
        *,
        young: float | None = None,
        poisson: float | None = None,
        plane_state: PlaneState = "strain",
        layers: Layers | None = None,
        symmetric: bool = False,
    ) -> Field:
        """Under forces per depth on cells; x, width, element and symmetric as in :func:`halfplane_matrix`.

        Displacements along z have the datum of that matrix; layers take the elements 'mean' and 'centre'.
        """
        middle = _arrays.vector("x", x)
        n = middle.size
        widths, forces = _arrays.spread("width", width, n), _arrays.vector("force", force, n)
        arguments = [n, middle, widths, forces, ELEMENTS.number(element), int(bool(symmetric))]
        loads = _loads(forces, (middle, widths, symmetric))
        names = "fuge_field_halfplane", "fuge_field_layered_line"
        create = _in_body(names, arguments, young, poisson, layers, plane_state)
        return cls(f"{n} cells of a line", create, young, loads, None, layers)

    @classmethod
    def halfplane_grid(
        cls,
        spacing: float,
        force: ArrayLike,
        element: Element = "mean",
        boundary: Boundary = "free",
        *,
        young: float | None = None,
        poisson: float | None = None,
        plane_state: PlaneState = "strain",
        layers: Layers | None = None,
    ) -> Field:
        """Under forces per depth, shape (n,), on equal cells side by side, as :class:`HalfplaneOperator` has them."""
        forces, width = _arrays.vector("force", force), _arrays.number("spacing", spacing)
        numbers = ELEMENTS.number(element), BOUNDARIES.number(boundary)
        arguments = [forces.size, width, forces, *numbers]
        cells = Cells(forces.shape, (width,), boundary, element, layers is None, layers)
        names = "fuge_field_halfplane_grid", "fuge_field_layered_line_grid"
        create = _in_body(names, arguments, young, poisson, layers, plane_state)
        return cls(f"line of {forces.size} cells", create, young, _loads(forces), cells, layers)

    @classmethod
    def halfspace(
        cls,
        x: ArrayLike,
        y: ArrayLike,
        width_x: ArrayLike,
        width_y: ArrayLike,
        force: ArrayLike,
        *,
        young: float | None = None,
        poisson: float | None = None,
        layers: Layers | None = None,
        symmetric_x: bool = False,
        symmetric_y: bool = False,
    ) -> Field:
        """Under forces on rectangles, which are given as for :func:`halfspace_matrix`; far away nothing moves."""
        middles = _arrays.vector("x", x), _arrays.vector("y", y, np.size(x))
        n = middles[0].size
        widths = _arrays.spread("width_x", width_x, n), _arrays.spread("width_y", width_y, n)
        forces, sides = _arrays.vector("force", force, n), (bool(symmetric_x), bool(symmetric_y))
        arguments = [n, *middles, *widths, forces, *map(int, sides)]
        names = "fuge_field_halfspace", "fuge_field_layered_area"
        create = _in_body(names, arguments, young, poisson, layers)
        return cls(f"{n} rectangles", create, young, _loads(forces, *zip(middles, widths, sides)), None, layers)

    @classmethod
    def halfspace_grid(
        cls,
        spacing_x: float,
        spacing_y: float,
        force: ArrayLike,
        boundary: AreaBoundary = "free",
        *,
        young: float | None = None,
        poisson: float | None = None,
        layers: Layers | None = None,
    ) -> Field:
        """Under forces, shape (ny, nx), on equal cells side by side, as :class:`HalfspaceOperator` has them."""
        forces = _arrays.doubles("force", force, ("ny", "nx"))
        ny, nx = forces.shape
        widths = _arrays.number("spacing_x", spacing_x), _arrays.number("spacing_y", spacing_y)
        arguments = [nx, ny, *widths, forces, AREA_BOUNDARIES.number(boundary)]
        cells = Cells((ny, nx), widths, boundary, "mean", layers is None, layers)
        names = "fuge_field_halfspace_grid", "fuge_field_layered_area_grid"
        create = _in_body(names, arguments, young, poisson, layers)
        return cls(f"area of {ny} x {nx} cells", create, young, _loads(forces), cells, layers)

    @classmethod
    def rings(
        cls, radius: ArrayLike, force: ArrayLike, *, young: float | None = None, poisson: float | None = None
    ) -> Field:
        """Under forces on rings, whose radii are given as for :func:`ring_matrix`; far away nothing moves."""
        radii = _arrays.vector("radius", radius)
        n = max(radii.size - 1, 0)
        forces = _arrays.vector("force", force, n)
        create = ["fuge_field_rings", n, radii, forces, *moduli(young, poisson)]
        loads = _loads(forces, (0.5 * radii[1:], radii[1:], True), resolved=np.diff(radii).max(initial=0.0))
        return cls(f"{n} rings", create, young, loads)

    @classmethod
    def _of_punch(cls, create: list[Any], young: float | None, left: float, right: float, symmetric: bool) -> Field:
        """Under a punch without a grid, which touches from `left` to `right`, or to as far on the other side."""
        middle, width = np.array([0.5 * (left + right)]), np.array([right - left])
        return cls("a punch without a grid", create, young, _loads(width, (middle, width, symmetric), resolved=0.0))

    def stress(self, points: ArrayLike, below: ArrayLike = False) -> NDArray[np.float64]:
        """Stresses at points, to rounding at any depth and distance; in layers to 1e-8 of the largest.

        Parameters
        ----------
        points : array_like, shape (.., 3)
            x, y, z; length.
        below : bool, or array_like of shape (..)
            At an interface of layers: False, just above it; True, just below it. There xx, yy and xy differ.

        Returns
        -------
        ndarray, shape (.., 6)
            xx, yy, zz, yz, xz, xy; force per length^2.

        Raises
        ------
        InputError
            A point is above the surface, or in a rigid base.
        UnsupportedError
            The field of a periodic grid is known below its cells only.
        """
        return self._at("fuge_field_stress", points, below, 6)

    def displacement(self, points: ArrayLike, below: ArrayLike = False) -> NDArray[np.float64]:
        """Displacements along x, y, z at points, shape (.., 3); length. All else as of :meth:`stress`."""
        self._require_young()
        return self._at("fuge_field_displacement", points, below, 3)

    def grid_stress(self, depth: ArrayLike, below: ArrayLike = False) -> NDArray[np.float64]:
        """Stresses below the centres of all cells of a grid, by FFT.

        Parameters
        ----------
        depth : array_like, shape (d,), or float
            Not negative, in any order; length.
        below : bool, or array_like of shape (d,)
            As in :meth:`stress`.

        Returns
        -------
        ndarray, shape (d, n, 6) or (d, ny, nx, 6)
            xx, yy, zz, yz, xz, xy; force per length^2.

        Raises
        ------
        InputError
        UnsupportedError
            The field is not that of a grid.
        """
        return self._below_cells("fuge_field_grid_stress", depth, below, 6)

    def grid_displacement(self, depth: ArrayLike, below: ArrayLike = False) -> NDArray[np.float64]:
        """Displacements, (d, n, 3) or (d, ny, nx, 3), along x, y, z; length. All else as of :meth:`grid_stress`."""
        self._require_young()
        return self._below_cells("fuge_field_grid_displacement", depth, below, 3)

    def largest(self, measure: Measure = "von_mises") -> StressPeak:
        """The largest stress in the body, and where it is.

        Its relative error is below 1e-6, and below 1e-3 where the stress has a cusp, as at the surface beside the rim
        of a contact. Of cells it is that of all depths from a quarter of a cell on, and that of their middles at the
        surface; of hats and of punches without a grid that of all depths. In layers it is that below the centres of the
        cells of a grid, with both sides of all interfaces. Under edges where the pressure has no limit it is infinite.

        Parameters
        ----------
        measure : {'von_mises', 'tresca'}
            Which stress is to be largest.

        Raises
        ------
        UnsupportedError
            For periodic grids without layers, and for layers without a grid.
        """
        peak = struct("fuge_stress_peak")
        with self._handle.reading() as pointer:
            call("fuge_field_largest", pointer, MEASURES.number(measure), ctypes.byref(peak))
        location = cast(Location, LOCATIONS.word(peak.location))
        where = (None, None) if peak.layer < 0 else (peak.layer, self._cell(peak.cell))
        return StressPeak(location, peak.value, np.array(peak.place), np.array(peak.tensor), *where)

    def interfaces(self) -> list[InterfaceStress]:
        """What cracks coatings: the largest stresses of the surface, and of each interface from above, below a grid.

        Layers that are bonded to the same material are one with it. At the surface stresses jump from cell to cell at
        the edge of the contact, and their error is of the order of a cell.

        Raises
        ------
        UnsupportedError
            The body has no layers, or the field is not that of a grid.
        """
        count = np.zeros(1, dtype=np.intc)
        found = struct_array("fuge_interface_stress", self._layers + 1)
        with self._handle.reading() as pointer:
            call("fuge_field_interfaces", pointer, len(found), count, found)
        numbers = "depth", "tension_above", "tension_below", "shear", "opening"
        cells = "cell_above", "cell_below", "cell_of_shear", "cell_of_opening"
        return [
            InterfaceStress(*(getattr(f, name) for name in numbers), *(self._cell(getattr(f, name)) for name in cells))
            for f in found[: int(count[0]) + 1]
        ]

    def _at(self, name: str, points: ArrayLike, below: ArrayLike, components: int) -> NDArray[np.float64]:
        places = _arrays.doubles("points", points)
        shape = places.shape[:-1]
        _arrays.check_shape("points", places.shape, (*shape, 3))
        sides = _arrays.spread_flags("below", below, shape)
        return self._found(name, places.size // 3, places, sides, shape, components)

    def _below_cells(self, name: str, depth: ArrayLike, below: ArrayLike, components: int) -> NDArray[np.float64]:
        depths = _arrays.vector("depth", np.atleast_1d(_arrays.array("depth", depth)))
        sides = _arrays.spread_flags("below", below, depths.shape)
        shape = depths.shape if self.cells is None else depths.shape + self.cells.shape
        return self._found(name, depths.size, depths, sides, shape, components)

    def _found(
        self, name: str, n: int, where: Any, sides: Any, shape: tuple[int, ...], components: int
    ) -> NDArray[np.float64]:
        found = np.empty((*shape, components))
        with self._handle.reading() as pointer:
            call(name, pointer, n, where, sides, found, shapes={"points": (*shape, 3)})
        return found

    def _require_young(self) -> None:
        if not self._moves:
            raise error(Status.ERR_OPTION, "displacements need Young's modulus: give it to the field as young")

    def _cell(self, number: int) -> tuple[int, ...]:
        return tuple(int(i) for i in np.unravel_index(number, cast(Cells, self.cells).shape))


def _loads(
    force: NDArray[np.float64],
    *axes: tuple[NDArray[np.float64], NDArray[np.float64], bool],
    resolved: float | None = None,
) -> Loads:
    """Copies, which the caller of a constructor cannot change."""
    widest = max((float(width.max(initial=0.0)) for _, width, _ in axes), default=0.0)
    kept = [(middle.copy(), width.copy(), bool(symmetric)) for middle, width, symmetric in axes]
    return Loads(force.copy(), kept, widest if resolved is None else float(resolved))


def moduli(young: float | None, poisson: float | None) -> list[float]:
    """Young's modulus, infinite if nobody asks for displacements, and Poisson's ratio."""
    if poisson is None:
        raise error(Status.ERR_OPTION, "a field needs Poisson's ratio, poisson, and for displacements young")
    return [np.inf if young is None else _arrays.number("young", young), _arrays.number("poisson", poisson)]


def _in_body(
    names: tuple[str, str],
    loads: list[Any],
    young: float | None,
    poisson: float | None,
    layers: Layers | None,
    plane_state: PlaneState = "strain",
) -> list[Any]:
    """The function of C for loads on a body or on layers, which are `names`, and its arguments."""
    if layers is None:
        state = [PLANE_STATES.number(plane_state)] if "halfplane" in names[0] else []
        return [names[0], *loads, *moduli(young, poisson), *state]
    arguments = layers_of(layers)[:-1]
    if young is not None or poisson is not None or plane_state != "strain":
        raise error(
            Status.ERR_OPTION, "layers have moduli of their own, in plane strain: leave out young, poisson, plane_state"
        )
    return [names[1], *arguments, *loads]


def field_of_cells(
    cells: Cells | None, force: NDArray[np.float64], young: Any, poisson: Any, plane_state: PlaneState
) -> Field:
    """The field under the forces on the cells of an operator."""
    if cells is None:
        raise error(
            Status.ERR_GRID,
            "the operator does not know its cells, so there is no field: use HalfplaneOperator or HalfspaceOperator, "
            "or make the field of the cells and the forces by Field.halfplane, Field.halfspace or Field.rings",
        )
    if not cells.homogeneous and cells.layers is None:
        raise error(
            Status.ERR_UNSUPPORTED,
            "the body of a CallbackOperator is only close to a half-plane or a half-space, so its field is not known",
        )
    forces = force.reshape(cells.shape)
    body: dict[str, Any] = {"young": young, "poisson": poisson, "layers": cells.layers}
    if len(cells.shape) == 1:
        line = cast(Element, cells.element), cast(Boundary, cells.boundary)
        return Field.halfplane_grid(cells.spacing[0], forces, *line, plane_state=plane_state, **body)
    if plane_state != "strain":
        raise error(Status.ERR_OPTION, f"plane_state is {plane_state!r}, but an area is in no plane: leave it out")
    width_x, width_y = cells.spacing
    return Field.halfspace_grid(width_x, width_y, forces, cast(AreaBoundary, cells.boundary), **body)
