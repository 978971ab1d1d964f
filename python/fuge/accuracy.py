"""Contact to a wanted error: the solve chooses method and cells, and tells how exact its answer is."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Callable, Literal, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call, gap_callback, interruptible, new_handle
from fuge._library import struct
from fuge._words import Words
from fuge.errors import Status, error
from fuge.layers import Layers, layers_of
from fuge.operators import BOUNDARIES, Boundary

Method = Literal["series", "graded_cells", "equal_cells"]

METHODS = Words("method", Method, "BY_")

LineGap = Union[Callable[[NDArray[np.float64]], ArrayLike], Tuple[ArrayLike, ArrayLike]]
AreaGap = Union[Callable[[NDArray[np.float64], NDArray[np.float64]], ArrayLike], Tuple[ArrayLike, ArrayLike, ArrayLike]]
Range = Tuple[float, float]


class Estimate(float):
    """A number with the estimate of its error.

    Attributes
    ----------
    error : float
        The largest difference from the exact number that is expected, in its unit; inf if nothing is known.
    """

    error: float

    def __new__(cls, value: float, error: float) -> Estimate:
        number = super().__new__(cls, value)
        number.error = error
        return number

    def __getnewargs__(self) -> Any:
        return float(self), self.error

    def __repr__(self) -> str:
        return f"Estimate({float(self)!r}, error={self.error:.2g})"

    def __str__(self) -> str:
        return float.__repr__(self)


@dataclass(frozen=True)
class Level:
    """One solve on the way to the wanted error.

    Attributes
    ----------
    cells : int
        Of the grid; of a series its coefficients.
    method : {'series', 'graded_cells', 'equal_cells'}
    pressure_error : float
        Estimated share of the load in the wrong place; 1 if nothing is known yet.
    approach_error : float
        Estimated error of the approach, length; inf if nothing is known yet.
    seconds : float
        Time since the call when this level was done.
    """

    cells: int
    method: Method
    pressure_error: float
    approach_error: float
    seconds: float


@dataclass(frozen=True, eq=False)
class ResolvedContact:
    """A contact to a wanted error, on cells; made by :func:`solve_line` and :func:`solve_area`.

    Errors are estimates, those of the discretisation, not of the model. Its cells and forces make a field of stresses:
    :meth:`Field.halfplane` of a line, :meth:`Field.halfspace_grid` of an area.

    Attributes
    ----------
    x, y : ndarray, shape (nx,) and (ny,)
        Centres of the cells; on a line y is [0]; length.
    width_x, width_y : ndarray, shape (nx,) and (ny,)
        Widths of the cells; on a line that along y is [1].
    force : ndarray, shape (nx,) on a line, (ny, nx) on an area
        Contact forces, on a line per depth.
    gap : ndarray of the same shape
        Gaps under load; length.
    load : float
        Sum of the forces.
    approach : Estimate
        The bodies move by approach + tilt x; length.
    tilt : float
        0 without a moment.
    largest : Estimate
        The largest pressure; force per length^2.
    size : Estimate
        Length, or area, of the contact.
    edges : ndarray, shape (intervals, 2)
        Ends of the intervals of contact on a line; none on an area; length.
    edge_error : float
        Error of the edges; length.
    pressure_error : float
        Error of the pressure: the share of the load that may be in the wrong place.
    accuracy : float
        The one that was wanted.
    at_rim : tuple of bool
        Whether the contact reaches the left, the right, the low and the high side of y: there the bodies are taken to
        end. Never on a periodic surface.
    method : {'series', 'graded_cells', 'equal_cells'}
        A series on one smooth contact, cells that are narrow at the ends of the contact, or equal cells by FFT.
    choice : str
        A sentence that explains the method.
    levels : list of Level
        All solves on the way, the last one that of the contact.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    width_x: NDArray[np.float64]
    width_y: NDArray[np.float64]
    force: NDArray[np.float64]
    gap: NDArray[np.float64]
    load: float
    approach: Estimate
    tilt: float
    largest: Estimate
    size: Estimate
    edges: NDArray[np.float64]
    edge_error: float
    pressure_error: float
    accuracy: float
    at_rim: tuple[bool, bool, bool, bool]
    method: Method
    choice: str
    levels: list[Level]

    @property
    def pressure(self) -> NDArray[np.float64]:
        """Pressures of the cells, in the shape of the forces; force per length^2."""
        if self.force.ndim == 1:
            return self.force / self.width_x
        areas: NDArray[np.float64] = np.multiply.outer(self.width_y, self.width_x)
        return self.force / areas

    def __repr__(self) -> str:
        cells = " x ".join(str(n) for n in reversed(self.force.shape))
        known = [
            f"{cells} {'cells' if self.method == 'series' else self.method.replace('_', ' ')}",
            *(["by a series"] if self.method == "series" else []),
            f"load {self.load:.6g}",
            f"approach {self.approach:.6g}",
            f"largest pressure {self.largest:.6g}",
            *(["reaches the rim"] if any(self.at_rim) else []),
            f"error {self.pressure_error:.1e}",
            f"{self.levels[-1].seconds:.2g} s",
        ]
        return f"<ResolvedContact: {', '.join(known)}>"


def solve_line(
    gap: LineGap,
    interval: Range,
    *,
    e_star: float | None = None,
    load: float | None = None,
    approach: float | None = None,
    moment: float | None = None,
    accuracy: float = 1e-3,
    boundary: Boundary = "free",
    layers: Layers | None = None,
    most_cells: int = 0,
    most_seconds: float | None = None,
    threads: int = 1,
) -> ResolvedContact:
    """Press bodies together along a line, to a wanted error of the pressure.

    Parameters
    ----------
    gap : callable or pair of array_like
        The initial gap at an array of places in the interval, ``gap(x)``, with edges, kinks and jumps if it has some;
        an exception in it is raised here. Or places that grow and the gaps there, ``(x, gap)``: linear in between.
        Length.
    interval : pair of float
        Left and right end of the bodies, or of the part of them that may touch; length.
    e_star : float
        Combined modulus, force per length^2; in its place `layers`.
    load, approach : float
        One of them: the load per depth, or how far the bodies approach each other, with the datum of
        :func:`halfplane_matrix` for cells that cover the interval.
    moment : float, optional
        Of the load about x = 0, per depth, under which the bodies tilt; without it they only approach each other. Not
        on a periodic surface.
    accuracy : float
        Wanted error of the pressure: the share of the load that may be in the wrong place; between 0 and 1.
    boundary : {'free', 'periodic'}
        What lies beyond the interval: a surface without pressure, or the same again.
    layers : Layers, optional
        The body, in place of `e_star`.
    most_cells : int
        Of a grid; 0: 2^20.
    most_seconds : float, optional
        No finer grid is begun that would be expected to end later than so many seconds after the call.
    threads : int
        Threads that share the work; 0: all cores that the process may use. No result depends on it.

    Returns
    -------
    ResolvedContact

    Raises
    ------
    InputError
        A value is out of range, or not exactly one of load and approach is given.
    EquilibriumError
        The load is negative, or the moment too large for the interval.
    CallbackError
        The function returned NaN or infinity.
    UnsupportedError
        A moment comes with an approach, or on a periodic surface.

    Warns
    -----
    AccuracyWarning
        The error is estimated above the wanted one; the message says what was reached, and why no more.

    Examples
    --------
    >>> contact = fuge.solve_line(lambda x: x**2 / 2, (-2.0, 2.0), e_star=1.0, load=0.5, accuracy=1e-3)
    >>> contact.pressure_error < 1e-3
    True
    """
    ends = _range("interval", interval)
    pressing = _pressing(e_star, load, approach, moment, accuracy, boundary, layers, most_cells, most_seconds, threads)
    function = gap if callable(gap) else _profile(gap, ends)
    return _solved("fuge_solve_line", pressing, gap_callback(function, 1), None, *ends)


def solve_area(
    gap: AreaGap,
    x_range: Range,
    y_range: Range,
    *,
    e_star: float | None = None,
    load: float | None = None,
    approach: float | None = None,
    accuracy: float = 1e-3,
    boundary: Boundary = "free",
    layers: Layers | None = None,
    most_cells: int = 0,
    most_seconds: float | None = None,
    threads: int = 1,
) -> ResolvedContact:
    """Press bodies together on a rectangle, to a wanted error of the pressure.

    Parameters
    ----------
    gap : callable or three array_like
        The initial gap at arrays of places in the rectangle, ``gap(x, y)``; or places that grow along x and along y,
        and the gaps there in the shape (ny, nx), ``(x, y, gap)``: bilinear in between. Length.
    x_range, y_range : pair of float
        The sides of the rectangle; length.
    load, approach : float
        One of them: the load, or how far the bodies approach each other.
    boundary : {'free', 'periodic'}
        What lies beyond the rectangle: a surface without pressure, or the same again on all sides.
    most_cells : int
        Of a grid; 0: 2^22.
    e_star, accuracy, layers, most_seconds, threads
        As in :func:`solve_line`, and so are errors and warnings.

    Returns
    -------
    ResolvedContact
    """
    across, up = _range("x_range", x_range), _range("y_range", y_range)
    pressing = _pressing(e_star, load, approach, None, accuracy, boundary, layers, most_cells, most_seconds, threads)
    function = gap if callable(gap) else _surface(gap, across, up)
    lower, upper = (np.array([across[k], up[k]]) for k in (0, 1))
    return _solved("fuge_solve_area", pressing, gap_callback(function, 2), None, lower, upper)


# ---- the gap


def _range(name: str, ends: Range) -> list[float]:
    try:
        first, last = ends
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a pair of numbers, not {ends!r}") from None
    return [_arrays.number(name, first), _arrays.number(name, last)]


def _places(name: str, value: ArrayLike, ends: list[float], data: str) -> NDArray[np.float64]:
    """Places of data, which have to cover an interval."""
    places = _arrays.vector(name, value)
    if places.size < 2 or not np.all(np.diff(places) > 0.0):
        raise error(Status.ERR_WIDTH, f"{name} of the gap must be two or more places that grow")
    if not (places[0] <= ends[0] and places[-1] >= ends[1]):
        known, wanted = f"from {places[0]:g} to {places[-1]:g}", f"from {ends[0]:g} to {ends[1]:g}"
        raise error(Status.ERR_WIDTH, f"the gap is known {known} along {name}, but needed {wanted}: choose {data}")
    return places


def _values(values: NDArray[np.float64]) -> NDArray[np.float64]:
    if not np.all(np.isfinite(values)):
        raise error(
            Status.ERR_NOT_FINITE,
            "the gap has values that are not finite: a large one keeps a place out of contact, and "
            "fuge.fill_surface fills what was not measured",
        )
    return values


def _parts(gap: Any, names: str) -> Any:
    if not isinstance(gap, (tuple, list)) or len(gap) != names.count(",") + 1:
        raise TypeError(f"gap must be a function, or the arrays ({names}), not {type(gap).__name__}")
    return gap


def _profile(gap: Any, ends: list[float]) -> Callable[[NDArray[np.float64]], ArrayLike]:
    """Linear between points."""
    x, values = _parts(gap, "x, gap")
    places = _places("x", x, ends, "an interval inside")
    gaps = _values(_arrays.vector("gap", values, places.size))

    return lambda x: np.asarray(np.interp(x, places, gaps))


def _surface(
    gap: Any, across: list[float], up: list[float]
) -> Callable[[NDArray[np.float64], NDArray[np.float64]], ArrayLike]:
    """Bilinear between points."""
    x, y, values = _parts(gap, "x, y, gap")
    columns, rows = (_places(*side, "a rectangle inside") for side in (("x", x, across), ("y", y, up)))
    gaps = _values(_arrays.doubles("gap", values, (rows.size, columns.size)))

    def share(at: NDArray[np.float64], places: NDArray[np.float64]) -> tuple[Any, Any]:
        """Which interval, and how far in it."""
        k = np.clip(np.searchsorted(places, at, "right") - 1, 0, places.size - 2)
        return k, (at - places[k]) / (places[k + 1] - places[k])

    def interpolated(x: NDArray[np.float64], y: NDArray[np.float64]) -> ArrayLike:
        (i, s), (k, t) = share(x, columns), share(y, rows)
        low = (1.0 - s) * gaps[k, i] + s * gaps[k, i + 1]
        high = (1.0 - s) * gaps[k + 1, i] + s * gaps[k + 1, i + 1]
        return np.asarray((1.0 - t) * low + t * high)

    return interpolated


# ---- the call


class _Pressing:
    """The struct fuge_pressing, and the arrays to which it points."""

    def __init__(self) -> None:
        self.struct = struct("fuge_pressing")
        self._kept: list[Any] = []

    def point(self, name: str, values: NDArray[np.float64] | None) -> None:
        """Let a member point to values; None: NULL."""
        if values is not None:
            self._kept.append(values)
            setattr(self.struct, name, values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)))


def _pressing(
    e_star: float | None,
    load: float | None,
    approach: float | None,
    moment: float | None,
    accuracy: float,
    boundary: Boundary,
    layers: Layers | None,
    most_cells: int,
    most_seconds: float | None,
    threads: int,
) -> _Pressing:
    pressing = _Pressing()
    members = pressing.struct
    members.boundary = BOUNDARIES.number(boundary)
    members.most_cells = _arrays.integer("most_cells", most_cells)
    members.threads = _arrays.integer("threads", threads)
    # Zeros stand for defaults in C.
    members.accuracy = _positive("accuracy", accuracy)
    if most_seconds is not None:
        members.most_seconds = _positive("most_seconds", most_seconds)
    for name, value in (("load", load), ("approach", approach), ("moment", moment)):
        pressing.point(name, _arrays.optional_number(name, value))
    if (e_star is None) == (layers is None):
        raise error(Status.ERR_OPTION, "give e_star, the modulus of two half-spaces, or layers, and not both")
    if layers is None:
        members.e_star = _arrays.modulus(e_star)
    else:
        members.layers, thickness, young, poisson, members.bonded, members.e_star_other = layers_of(layers)
        for name, array in (("thickness", thickness), ("young", young), ("poisson", poisson)):
            pressing.point(name, array)
    return pressing


def _positive(name: str, value: float) -> float:
    number = _arrays.number(name, value)
    if not number > 0.0:
        raise error(Status.ERR_OPTION, f"{name} is {number:g}, but must be positive")
    return number


def _known(number: float) -> float:
    """An error; the largest number stands for one that is not known."""
    return float(np.inf) if number >= np.finfo(np.float64).max else float(number)


def _solved(solve: str, pressing: _Pressing, *arguments: Any) -> ResolvedContact:
    with interruptible():
        handle = new_handle("contact", solve, "fuge_resolved_free", *arguments, ctypes.byref(pressing.struct))
    report = struct("fuge_resolved_report")
    call("fuge_resolved_get_report", handle.pointer, ctypes.byref(report))
    nx, ny, count = report.nx, report.ny, report.levels
    shape = (nx,) if solve == "fuge_solve_line" else (ny, nx)
    x, width_x, y, width_y = np.empty(nx), np.empty(nx), np.empty(ny), np.empty(ny)
    force, gap, edges = np.empty(shape), np.empty(shape), np.empty((report.intervals, 2))
    call("fuge_resolved_get_cells", handle.pointer, x, width_x, y, width_y, force, gap, edges)
    cells, method = np.empty(count, dtype=np.intc), np.empty(count, dtype=np.intc)
    pressure_error, approach_error, seconds = np.empty(count), np.empty(count), np.empty(count)
    call("fuge_resolved_get_levels", handle.pointer, cells, method, pressure_error, approach_error, seconds)
    handle.close()
    levels = [
        Level(int(cells[k]), _method(method[k]), float(pressure_error[k]), _known(approach_error[k]), float(seconds[k]))
        for k in range(count)
    ]
    return ResolvedContact(
        x=x,
        y=y,
        width_x=width_x,
        width_y=width_y,
        force=force,
        gap=gap,
        load=report.load,
        approach=Estimate(report.approach, _known(report.approach_error)),
        tilt=report.tilt,
        largest=Estimate(report.largest, _known(report.largest_error)),
        size=Estimate(report.size, _known(report.size_error)),
        edges=edges,
        edge_error=_known(report.edge_error),
        pressure_error=report.pressure_error,
        accuracy=pressing.struct.accuracy,
        at_rim=(bool(report.at_rim[0]), bool(report.at_rim[1]), bool(report.at_rim[2]), bool(report.at_rim[3])),
        method=_method(report.method),
        choice=report.choice.decode(errors="replace"),
        levels=levels,
    )


def _method(number: int) -> Method:
    word: Any = METHODS.word(int(number))
    method: Method = word
    return method
