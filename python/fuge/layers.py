"""Coated and layered bodies: elastic layers on a half-space or on a rigid base."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.cells import Cells
from fuge.halfplane import ELEMENTS, Element
from fuge.halfspace import AREA_ELEMENTS, AreaElement
from fuge.operators import AREA_BOUNDARIES, BOUNDARIES, AreaBoundary, Boundary, HalfplaneOperator, HalfspaceOperator


@dataclass(frozen=True)
class Layers:
    """Elastic layers, from the surface down, on a half-space or on a rigid base.

    Parameters
    ----------
    thickness : array_like, shape (layers,), or float
        Thicknesses; length.
    young : array_like, shape (layers + 1,)
        Young's moduli, the last one of the half-space below the layers; ``inf``: a rigid base; force per length^2.
    poisson : array_like, shape (layers + 1,), or float
        Poisson's ratios, 0 .. 0.5.
    bonded : bool
        All interfaces are bonded. Otherwise they slide without friction, and do not come off.
    e_star_other : float
        E/(1 - nu^2) of the other body, a half-space; ``inf``: it is rigid.

    Attributes
    ----------
    e_star : float
        1/e_star = (1 - nu^2)/E of the top layer + 1/e_star_other: the modulus of short waves.
    """

    thickness: ArrayLike
    young: ArrayLike
    poisson: ArrayLike
    bonded: bool = True
    e_star_other: float = np.inf

    def _arguments(self) -> list[Any]:
        thickness = np.atleast_1d(_arrays.doubles("thickness", self.thickness))
        thickness = _arrays.vector("thickness", thickness)
        materials = thickness.size + 1
        return [
            thickness.size,
            thickness,
            _arrays.spread("young", self.young, materials),
            _arrays.spread("poisson", self.poisson, materials),
            int(bool(self.bonded)),
            _arrays.number("e_star_other", self.e_star_other),
        ]

    @property
    def e_star(self) -> float:
        """The modulus of short waves; force per length^2."""
        _, _, young, poisson, _, other = self._arguments()
        return float(1.0 / ((1.0 - poisson[0] ** 2) / young[0] + 1.0 / other))

    def compliance(self, q: ArrayLike) -> NDArray[np.float64]:
        """Displacement of the surface per pressure of waves, 2 T/(e_star q).

        Parameters
        ----------
        q : array_like
            2 pi over the lengths of the waves; 1/length.

        Raises
        ------
        InputError
        """
        waves = _arrays.doubles("q", q)
        compliance = np.empty(waves.shape)
        call("fuge_layered_waves", *self._arguments(), waves.size, waves, compliance)
        return compliance

    def halfplane_matrix(
        self, x: ArrayLike, width: ArrayLike, element: Element, *, symmetric: bool = False
    ) -> NDArray[np.float64]:
        """Influence matrix of cells in plane strain; the arguments are those of :func:`halfplane_matrix`."""
        centres = _arrays.vector("x", x)
        n = centres.size
        alpha = np.empty((n, n), order="F")
        widths = _arrays.spread("width", width, n)
        cells = [n, centres, widths, ELEMENTS.number(element), int(bool(symmetric))]
        call("fuge_layered_halfplane_matrix", *self._arguments(), *cells, alpha, n)
        return alpha

    def halfspace_matrix(
        self,
        x: ArrayLike,
        y: ArrayLike,
        width_x: ArrayLike,
        width_y: ArrayLike,
        element: AreaElement,
        *,
        symmetric_x: bool = False,
        symmetric_y: bool = False,
    ) -> NDArray[np.float64]:
        """Influence matrix of rectangles; the arguments are those of :func:`halfspace_matrix`."""
        centres = _arrays.vector("x", x)
        n = centres.size
        alpha = np.empty((n, n), order="F")
        cells = [
            n,
            centres,
            _arrays.vector("y", y, n),
            _arrays.spread("width_x", width_x, n),
            _arrays.spread("width_y", width_y, n),
            AREA_ELEMENTS.number(element),
            int(bool(symmetric_x)),
            int(bool(symmetric_y)),
        ]
        call("fuge_layered_halfspace_matrix", *self._arguments(), *cells, alpha, n)
        return alpha

    def ring_matrix(self, radius: ArrayLike) -> NDArray[np.float64]:
        """Influence matrix of rings about an axis; ``radius`` as in :func:`ring_matrix`."""
        radii = _arrays.vector("radius", radius)
        n = radii.size - 1
        alpha = np.empty((max(n, 0), max(n, 0)), order="F")
        call("fuge_layered_ring_matrix", *self._arguments(), n, radii, alpha, n)
        return alpha


class LayeredHalfplaneOperator(HalfplaneOperator):
    """Layers in plane strain under n equal cells side by side, by FFT.

    Parameters
    ----------
    n : int
        Number of cells.
    spacing : float
        Width of a cell; length.
    layers : Layers
        The body.
    element, boundary
        As in :class:`HalfplaneOperator`.

    Attributes
    ----------
    layers, spacing, e_star, element, boundary
        The parameters; also :attr:`cells`.
    """

    def __init__(
        self, n: int, spacing: float, layers: Layers, element: Element = "mean", boundary: Boundary = "free"
    ) -> None:
        self.n = _arrays.integer("n", n)
        self.layers = layers
        width = _arrays.number("spacing", spacing)
        kind = [ELEMENTS.number(element), BOUNDARIES.number(boundary)]
        self._create("fuge_operator_layered_halfplane", self.n, width, *layers._arguments(), *kind)
        self.e_star = layers.e_star
        self.cells = replace(Cells((self.n,), (width,), boundary, element), homogeneous=False)


class LayeredHalfspaceOperator(HalfspaceOperator):
    """Layers under nx times ny equal rectangles side by side, by FFT.

    Parameters
    ----------
    nx, ny : int
        Numbers of cells along x and y.
    spacing_x, spacing_y : float
        Widths of a cell; length.
    layers : Layers
        The body.
    element, boundary
        As in :class:`HalfspaceOperator`.

    Attributes
    ----------
    layers, nx, ny, spacing_x, spacing_y, e_star, element, boundary
        The parameters; also :attr:`cells`.
    """

    def __init__(
        self,
        nx: int,
        ny: int,
        spacing_x: float,
        spacing_y: float,
        layers: Layers,
        element: AreaElement = "mean",
        boundary: AreaBoundary = "free",
    ) -> None:
        columns, rows = _arrays.integer("nx", nx), _arrays.integer("ny", ny)
        spacing = _arrays.number("spacing_x", spacing_x), _arrays.number("spacing_y", spacing_y)
        self.layers = layers
        kind = [AREA_ELEMENTS.number(element), AREA_BOUNDARIES.number(boundary)]
        self._create("fuge_operator_layered_halfspace", columns, rows, *spacing, *layers._arguments(), *kind)
        self.n = columns * rows
        self.grid = (rows, columns)
        self.e_star = layers.e_star
        self.cells = replace(Cells(self.grid, spacing, boundary, element), homogeneous=False)
