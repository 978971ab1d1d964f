"""Operators: how the bodies deform under contact forces."""

from __future__ import annotations

from typing import Any, Callable, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import Owner, call, new_handle, product_callback
from fuge.errors import Status, error
from fuge.halfplane import ELEMENTS, Element

Boundary = Literal["free", "periodic"]
AreaBoundary = Literal["free", "periodic", "periodic_x", "periodic_y"]

BOUNDARIES = {"free": 0, "periodic": 1}
AREA_BOUNDARIES = {"free": 0, "periodic": 1, "periodic_x": 2, "periodic_y": 3}

Product = Callable[[NDArray[np.float64]], ArrayLike]


class Operator(Owner):
    """Displacements of n contact points by forces on them; made by one of the subclasses.

    Solvers may share an operator, also in several threads.

    Attributes
    ----------
    n : int
        Number of contact points.
    grid : tuple of int or None
        (ny, nx) for the cells of an area, whose gaps and forces may have this shape; otherwise None.
    """

    n: int
    grid: tuple[int, int] | None = None

    def _create(self, create: str, *arguments: Any) -> None:
        self._handle = new_handle("operator", create, "fuge_operator_free", *arguments)

    def _set(self, name: str, *arguments: Any) -> None:
        with self._handle.use() as pointer:
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
        self._create("fuge_operator_dense", self.n, matrix, self.n)
        self._handle.keep(matrix)


class HalfplaneOperator(Operator):
    """An elastic half-plane of n equal cells side by side, by FFT: no matrix, for millions of cells.

    Parameters
    ----------
    n : int
        Number of cells.
    spacing : float
        Width of a cell; length.
    e_star : float
        Combined modulus, see :func:`combined_modulus`; force per length^2.
    element : {'centre', 'mean', 'hat'}
        As in :func:`halfplane_matrix`; the last two are the same here.
    boundary : {'free', 'periodic'}
        Beyond the cells a free surface; or the cells repeat, and displacements count from the mean of the surface.
    threads : int
        Threads that share each transform; worth while from about 10^5 cells on.

    Raises
    ------
    InputError
    OutOfMemoryError
    """

    def __init__(
        self, n: int, spacing: float, e_star: float, element: Element, boundary: Boundary = "free", *, threads: int = 1
    ) -> None:
        self.n = _arrays.integer("n", n)
        self._create(
            "fuge_operator_halfplane",
            self.n,
            _arrays.number("spacing", spacing),
            _arrays.number("e_star", e_star),
            _arrays.choice("element", element, ELEMENTS, Status.ERR_ELEMENT),
            _arrays.choice("boundary", boundary, BOUNDARIES),
        )
        if threads != 1:
            self.set_threads(threads)

    def set_threads(self, threads: int) -> None:
        """Let `threads` threads share each transform; not during a solve."""
        self._set("fuge_operator_set_threads", _arrays.integer("threads", threads))


class HalfspaceOperator(Operator):
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
    element : {'centre', 'mean'}
        As in :func:`halfspace_matrix`.
    boundary : {'free', 'periodic', 'periodic_x', 'periodic_y'}
        What lies beyond the cells: free surface, or the cells repeat along both axes or one of them. With
        'periodic' displacements count from the mean of the surface.
    threads : int
        Threads that share each product; worth while from about 10^5 cells on.

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
        element: Literal["centre", "mean"],
        boundary: AreaBoundary = "free",
        *,
        threads: int = 1,
    ) -> None:
        columns, rows = _arrays.integer("nx", nx), _arrays.integer("ny", ny)
        self._create(
            "fuge_operator_halfspace",
            columns,
            rows,
            _arrays.number("spacing_x", spacing_x),
            _arrays.number("spacing_y", spacing_y),
            _arrays.number("e_star", e_star),
            _arrays.choice("element", element, ELEMENTS, Status.ERR_ELEMENT),
            _arrays.choice("boundary", boundary, AREA_BOUNDARIES),
        )
        self.n = columns * rows
        self.grid = (rows, columns)
        if threads != 1:
            self.set_threads(threads)

    def set_threads(self, threads: int) -> None:
        """Let `threads` threads share each product; not during a solve."""
        self._set("fuge_operator_set_threads", _arrays.integer("threads", threads))


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
        """An approximate inverse of the operator, which replaces an earlier one or the diagonal."""
        function = product_callback(_callable("preconditioner", preconditioner))
        self._handle.keep(function)
        self._set("fuge_operator_set_preconditioner", function)

    def set_diagonal(self, diagonal: ArrayLike) -> None:
        """The preconditioner 1/alpha_kk from the n coefficients alpha_kk > 0."""
        self._set("fuge_operator_set_diagonal", _arrays.vector("diagonal", diagonal, self.n))

    def set_grid(self, nx: int, ny: int = 1) -> None:
        """The points are equal cells of a grid, nx in a row; for :meth:`set_coarser` and :meth:`set_auxiliary`."""
        columns, rows = _arrays.integer("nx", nx), _arrays.integer("ny", ny)
        self._set("fuge_operator_set_grid", columns, rows)
        self.grid = (rows, columns) if rows > 1 else None

    def set_coarser(self, coarse: Operator) -> None:
        """The same body on cells twice as wide, from which a solve gets the forces to start with.

        Parameters
        ----------
        coarse : Operator
            Another callback operator with a grid of half the cells in each direction, rounded up, or a half-plane
            or half-space operator.
        """
        self._set_other("fuge_operator_set_coarser", "coarse", coarse)

    def set_auxiliary(self, auxiliary: Operator) -> None:
        """A half-plane or half-space operator of the same cells whose displacements are close to those of `apply`.

        It lends its grid, its preconditioner and its coarser grids, so that a solve needs fewer products; the
        solution is that of `apply`.
        """
        self._set_other("fuge_operator_set_auxiliary", "auxiliary", auxiliary)

    def set_coefficients(self, datum: float = 0.0, mean: float = 0.0) -> None:
        """What products do not show of the coefficients.

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
        self._handle.need(other._handle)
        self._set(name, other._handle.pointer)
        if self.grid is None:
            self.grid = other.grid if other.n == self.n else None


def _callable(name: str, value: Any) -> Any:
    if not callable(value):
        raise TypeError(f"{name} must be callable, not {type(value).__name__}")
    return value
