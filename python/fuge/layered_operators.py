"""Operators of layers under equal cells, on a line or an area."""

from __future__ import annotations

from typing import Any, Mapping

from fuge import _arrays
from fuge.cells import Cells
from fuge.halfplane import ELEMENTS, Element
from fuge.halfspace import AREA_ELEMENTS, AreaElement
from fuge.layers import Layers, layers_of
from fuge.operators import AREA_BOUNDARIES, BOUNDARIES, AreaBoundary, Boundary, HalfplaneOperator, HalfspaceOperator


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
        self._create("fuge_operator_layered_halfplane", self.n, width, *layers_of(layers), *kind)
        self.e_star = layers.e_star
        self.cells = Cells((self.n,), (width,), boundary, element, homogeneous=False, layers=layers)

    def _described(self) -> Mapping[str, Any]:
        return _described(self)


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
        self._create("fuge_operator_layered_halfspace", columns, rows, *spacing, *layers_of(layers), *kind)
        self.n = columns * rows
        self.grid = (rows, columns)
        self.e_star = layers.e_star
        self.cells = Cells(self.grid, spacing, boundary, element, homogeneous=False, layers=layers)

    def _described(self) -> Mapping[str, Any]:
        return _described(self)


def _described(operator: LayeredHalfplaneOperator | LayeredHalfspaceOperator) -> Mapping[str, Any]:
    """What `repr` shows of an operator: the layers in place of the modulus."""
    names = ("layers", "element", "boundary")
    return {**operator._size(), **{name: getattr(operator, name) for name in names}}
