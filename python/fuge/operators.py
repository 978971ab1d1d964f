"""Operators: how the bodies deform under contact forces."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Callable, Literal, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import NO_SHAPES, Owner, call, interruptible, new_handle, product_callback
from fuge._words import Words
from fuge.cells import Cells
from fuge.errors import Status, error
from fuge.halfplane import ELEMENTS, Element
from fuge.halfspace import AREA_ELEMENTS, AreaElement

Boundary = Literal["free", "periodic"]
AreaBoundary = Literal["free", "periodic", "periodic_x", "periodic_y"]

BOUNDARIES = Words("boundary", Boundary)
AREA_BOUNDARIES = Words("boundary", AreaBoundary)

Product = Callable[[NDArray[np.float64]], ArrayLike]


class Operator(Owner):
    """Base of all operators, which give the displacements of n contact points by forces on them.

    ``operator @ force`` are the displacements by forces of the shape (n,) or that of the grid. Solvers may share an
    operator, also in several threads. It cannot be changed during a solve or a product; if it is closed meanwhile, it
    is freed at their end.

    Attributes
    ----------
    n : int
        Number of contact points.
    grid : tuple of int or None
        (ny, nx) for the cells of an area, whose gaps and forces may have this shape; otherwise None.
    cells : Cells or None
        Spacing, boundary and element of an operator whose points are equal cells; otherwise None.
    """

    n: int
    grid: tuple[int, int] | None = None
    cells: Cells | None = None

    def __matmul__(self, force: ArrayLike) -> NDArray[np.float64]:
        """Displacements by given forces, of the same shape: the product by the influence matrix; length.

        Raises
        ------
        InputError
            The shape is neither (n,) nor that of the grid, or a force is not finite.
        CallbackError, LimitError
        """
        forces = self._points("force", force)
        displacement = np.empty(forces.shape)
        with interruptible(), self._handle.reading() as pointer:
            call("fuge_operator_apply", pointer, self.n, forces, displacement, shapes={"f": forces.shape})
        return displacement

    def __repr__(self) -> str:
        arguments = ", ".join(f"{name}={value!r}" for name, value in self._described().items())
        return f"{type(self).__name__}({arguments})"

    def _described(self) -> Mapping[str, Any]:
        """What `repr` shows of the operator."""
        return {"n": self.n}

    def _points(self, name: str, value: ArrayLike) -> NDArray[np.float64]:
        """An array with a value for each point, in one of the shapes that it may have."""
        found = _arrays.doubles(name, value)
        self._check_shape(name, found.shape)
        return found

    def _check_shape(self, name: str, shape: tuple[int, ...]) -> None:
        if self.grid is None:
            _arrays.check_shape(name, shape, (self.n,))
        elif shape not in (self.grid, (self.n,)):
            raise error(
                Status.ERR_SIZE,
                f"{name} has the shape {shape}, but must have (ny, nx) = {self.grid} or ({self.n},)",
            )

    def _create(self, create: str, *arguments: Any, shapes: Mapping[str, tuple[int, ...]] = NO_SHAPES) -> None:
        self._handle = new_handle("operator", create, "fuge_operator_free", *arguments, shapes=shapes)

    def _set(self, name: str, *arguments: Any) -> None:
        with self._handle.changing() as pointer:
            call(name, pointer, *arguments)


class DenseOperator(Operator):
    """An influence matrix.

    Parameters
    ----------
    alpha : array_like, shape (n, n)
        Displacement per force, symmetric. An array of doubles is not copied: leave it unchanged as long as
        the operator is in use.

    Raises
    ------
    MatrixError
        alpha is not symmetric.
    InputError
        Its shape is not square, or an element is not finite.
    """

    def __init__(self, alpha: ArrayLike) -> None:
        matrix = _arrays.symmetric("alpha", alpha)
        self.n = matrix.shape[0]
        # The library sees rows in C's order as columns.
        shapes = NO_SHAPES if matrix.flags.f_contiguous else {"alpha": matrix.shape}
        self._create("fuge_operator_dense", self.n, matrix, self.n, shapes=shapes)
        self._handle.keep(matrix)


class GridOperator(Operator):
    """A :class:`HalfplaneOperator` or a :class:`HalfspaceOperator`: products by FFT.

    Attributes
    ----------
    cells : Cells
    e_star : float
        Combined modulus; force per length^2.
    """

    cells: Cells
    e_star: float

    @property
    def element(self) -> str:
        """What a force and a displacement stand for."""
        return self.cells.element

    @property
    def boundary(self) -> str:
        """What lies beyond the cells."""
        return self.cells.boundary

    def _described(self) -> Mapping[str, Any]:
        return {**self._size(), **{name: getattr(self, name) for name in ("e_star", "element", "boundary")}}

    def _size(self) -> Mapping[str, Any]:
        """Numbers of cells and their widths."""
        return {"n": self.n}


class HalfplaneOperator(GridOperator):
    """An elastic half-plane of n equal cells side by side, by FFT: no matrix, for millions of cells.

    Parameters
    ----------
    n : int
        Number of cells.
    spacing : float
        Width of a cell; length.
    e_star : float
        Combined modulus, see :func:`combined_modulus`; force per length^2.
    element : {'mean', 'centre', 'hat'}
        As in :func:`halfplane_matrix`; 'mean' and 'hat' are the same here.
    boundary : {'free', 'periodic'}
        Beyond the cells a free surface; or the cells repeat, and displacements count from the mean of the surface.

    Attributes
    ----------
    spacing, e_star, element, boundary
        The parameters; also :attr:`cells`.

    Raises
    ------
    InputError
    OutOfMemoryError
    """

    def __init__(
        self,
        n: int,
        spacing: float,
        e_star: float,
        element: Element = "mean",
        boundary: Boundary = "free",
    ) -> None:
        self.n = _arrays.integer("n", n)
        modulus, width = _arrays.modulus(e_star), _arrays.number("spacing", spacing)
        self._create(
            "fuge_operator_halfplane",
            self.n,
            width,
            modulus,
            ELEMENTS.number(element),
            BOUNDARIES.number(boundary),
        )
        self.e_star = modulus
        self.cells = Cells((self.n,), (width,), boundary, element)

    @property
    def spacing(self) -> float:
        """Width of a cell; length."""
        return self.cells.spacing[0]

    def _size(self) -> Mapping[str, Any]:
        return {"n": self.n, "spacing": self.spacing}


class HalfspaceOperator(GridOperator):
    """An elastic half-space of nx times ny equal rectangles side by side, by FFT.

    Gaps and forces may have the shape (ny, nx): element [j, i] is the cell in column i, along x, and row j.

    Parameters
    ----------
    nx, ny : int
        Numbers of cells along x and y.
    spacing_x, spacing_y : float
        Widths of a cell; length.
    e_star : float
        Combined modulus; force per length^2.
    element : {'mean', 'centre'}
        As in :func:`halfspace_matrix`.
    boundary : {'free', 'periodic', 'periodic_x', 'periodic_y'}
        What lies beyond the cells: free surface, or the cells repeat along both axes or one of them. With
        'periodic' displacements count from the mean of the surface.

    Attributes
    ----------
    nx, ny, spacing_x, spacing_y, e_star, element, boundary
        The parameters; also :attr:`cells`.

    Raises
    ------
    InputError
    OutOfMemoryError
        Also before anything is allocated, if the machine has too little.
    """

    def __init__(
        self,
        nx: int,
        ny: int,
        spacing_x: float,
        spacing_y: float,
        e_star: float,
        element: AreaElement = "mean",
        boundary: AreaBoundary = "free",
    ) -> None:
        columns, rows = _arrays.integer("nx", nx), _arrays.integer("ny", ny)
        spacing = _arrays.number("spacing_x", spacing_x), _arrays.number("spacing_y", spacing_y)
        modulus = _arrays.modulus(e_star)
        self._create(
            "fuge_operator_halfspace",
            columns,
            rows,
            *spacing,
            modulus,
            AREA_ELEMENTS.number(element),
            AREA_BOUNDARIES.number(boundary),
        )
        self.n = columns * rows
        self.grid = (rows, columns)
        self.e_star = modulus
        self.cells = Cells(self.grid, spacing, boundary, element)

    @property
    def nx(self) -> int:
        """Number of cells along x."""
        return self.cells.shape[1]

    @property
    def ny(self) -> int:
        """Number of cells along y, the rows."""
        return self.cells.shape[0]

    @property
    def spacing_x(self) -> float:
        """Width of a cell along x; length."""
        return self.cells.spacing[0]

    @property
    def spacing_y(self) -> float:
        """Width of a cell along y; length."""
        return self.cells.spacing[1]

    def _size(self) -> Mapping[str, Any]:
        return {name: getattr(self, name) for name in ("nx", "ny", "spacing_x", "spacing_y")}


class CallbackOperator(Operator):
    """An operator of your own, by its products alone.

    Parameters
    ----------
    n : int
        Number of contact points.
    apply : callable
        ``apply(f)`` returns the n displacements by the n forces f, which are read-only. It has to be linear, symmetric
        and the same in all calls. An exception in it ends the solve, and is raised there.
    preconditioner : callable, optional
        An approximate inverse, from n lengths to n forces: linear, symmetric and positive definite.
    diagonal : array_like, shape (n,), optional
        In place of a preconditioner: the coefficients alpha_kk > 0; length per force.

    Raises
    ------
    InputError
    """

    def __init__(
        self,
        n: int,
        apply: Product,
        *,
        preconditioner: Product | None = None,
        diagonal: ArrayLike | None = None,
    ) -> None:
        self.n = _arrays.integer("n", n)
        if preconditioner is not None and diagonal is not None:
            raise error(Status.ERR_OPTION, "preconditioner and diagonal replace each other: give one of them")
        function = product_callback(_callable("apply", apply))
        self._create("fuge_operator_callback", self.n, function, None)
        self._handle.keep(function)
        if preconditioner is not None:
            self.set_preconditioner(preconditioner)
        if diagonal is not None:
            self.set_diagonal(diagonal)

    def set_preconditioner(self, preconditioner: Product) -> None:
        """Set an approximate inverse of the operator, in place of an earlier one or of the diagonal."""
        function = product_callback(_callable("preconditioner", preconditioner))
        self._handle.keep(function)
        self._set("fuge_operator_set_preconditioner", function)

    def set_diagonal(self, diagonal: ArrayLike) -> None:
        """Set the preconditioner 1/alpha_kk, from the n coefficients alpha_kk > 0."""
        self._set("fuge_operator_set_diagonal", _arrays.vector("diagonal", diagonal, self.n))

    def set_grid(self, nx: int, ny: int = 1) -> None:
        """Let the points be equal cells of a grid, nx in a row; for :meth:`set_coarser` and :meth:`set_auxiliary`."""
        columns, rows = _arrays.integer("nx", nx), _arrays.integer("ny", ny)
        self._set("fuge_operator_set_grid", columns, rows)
        self.grid = (rows, columns) if rows > 1 else None
        if self.cells is not None and self.cells.shape not in (self.grid, (self.n,)):
            self.cells = None

    def set_coarser(self, coarse: Operator) -> None:
        """Set the operator of the same body on cells twice as wide, where a solve gets the forces to start with.

        Parameters
        ----------
        coarse : Operator
            Another callback operator with a grid of half the cells in each direction, rounded up, or a half-plane
            or half-space operator.
        """
        self._set_other("fuge_operator_set_coarser", "coarse", coarse)

    def set_auxiliary(self, auxiliary: Operator) -> None:
        """Set a half-plane or half-space operator of the same cells whose displacements are close to those of `apply`.

        A solve uses its grid, its preconditioner and its coarser grids, and so needs fewer products; the solution is
        still that of `apply`.
        """
        self._set_other("fuge_operator_set_auxiliary", "auxiliary", auxiliary)
        # The cells give the pressures, but the stresses are not those of the auxiliary body.
        self.cells = auxiliary.cells and replace(auxiliary.cells, homogeneous=False, layers=None)

    def _described(self) -> Mapping[str, Any]:
        return {"n": self.n, **({"grid": self.grid} if self.grid else {})}

    def set_coefficients(self, datum: float = 0.0, mean: float = 0.0) -> None:
        """Give what products do not show of the coefficients.

        Parameters
        ----------
        datum : float
            A constant that `apply` leaves out of all coefficients; length per force.
        mean : float
            Mean magnitude of the coefficients without the datum, 0 if unknown; length per force.
        """
        self._set("fuge_operator_set_coefficients", _arrays.number("datum", datum), _arrays.number("mean", mean))

    def _set_other(self, name: str, argument: str, other: Operator) -> None:
        if not isinstance(other, Operator):
            raise TypeError(f"{argument} must be an Operator, not {type(other).__name__}")
        if other is self:
            raise error(Status.ERR_OPTION, f"{argument} is this operator itself, but must be another one")
        with other._handle.reading(closed=True) as pointer:
            self._set(name, pointer)
            self._handle.need(other._handle)
        if self.grid is None:
            self.grid = other.grid if other.n == self.n else None


def _callable(name: str, value: Any) -> Any:
    if not callable(value):
        raise TypeError(f"{name} must be callable, not {type(value).__name__}")
    return value
