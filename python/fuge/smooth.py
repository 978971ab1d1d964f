"""Smooth punches, on a half-plane and round ones on a half-space, without a grid."""

from __future__ import annotations

import ctypes
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import Owner, call, interruptible, new_handle, profile_callback
from fuge._library import struct
from fuge.field import Field, moduli
from fuge.halfplane import PLANE_STATES, PlaneState

Profile = Callable[[NDArray[np.float64]], "tuple[ArrayLike, ArrayLike]"]


class PunchContact(Owner):
    """Contact of a body with a punch, without a grid; threads may share it.

    Attributes
    ----------
    left, right : float
        Ends of the contact along x; length.
    half_width : float
        More accurate than (right - left)/2 far from x = 0; length.
    force, moment : float
        The moment is that about x = 0; per depth, or on the whole disc.
    approach, tilt : float
        The punch moves by approach + tilt x.
    residual : float
        The certificate: largest scaled violation of the problem.
    end_error, pressure_error : float
        Estimated errors of the ends, relative to the half width, and of the pressure, relative to its maximum, under a
        round punch to its mean.
    iterations : int
        Series formed.
    coefficients : ndarray
        Of the series.
    """

    def __init__(self, solve: str, *arguments: Any) -> None:
        with interruptible():
            self._handle = new_handle("contact", solve, "fuge_punch_free", *arguments)
        report = struct("fuge_punch_report")
        call("fuge_punch_get_report", self._handle.pointer, ctypes.byref(report))
        self.left: float = report.left
        self.right: float = report.right
        self.half_width: float = report.half_width
        self.force: float = report.force
        self.moment: float = report.moment
        self.approach: float = report.approach
        self.tilt: float = report.tilt
        self.residual: float = report.residual
        self.end_error: float = report.end_error
        self.pressure_error: float = report.pressure_error
        self.iterations: int = report.iterations
        self.coefficients = np.empty(report.coefficients)
        call("fuge_punch_get_coefficients", self._handle.pointer, self.coefficients.size, self.coefficients)

    def pressure(self, x: ArrayLike) -> NDArray[np.float64]:
        """Pressure at places x of any shape; 0 outside the contact, the largest number in the tip of a cone."""
        places = _arrays.doubles("x", x)
        pressure = np.empty(places.shape)
        call("fuge_punch_get_pressure", self._handle.pointer, places.size, places, pressure)
        return pressure

    def gap(self, x: ArrayLike, initial_gap: ArrayLike) -> NDArray[np.float64]:
        """Gap under load at places x, from the initial gaps there; length."""
        shape, (places, initial) = _arrays.points(("x", x), ("initial_gap", initial_gap))
        gap = np.empty(shape)
        call("fuge_punch_get_gap", self._handle.pointer, places.size, places, initial, gap)
        return gap

    def _field(self, young: float | None, poisson: float, plane_state: int, symmetric: bool) -> Field:
        create = ["fuge_field_punch", self._handle.pointer, *moduli(young, poisson), plane_state]
        return Field._of_punch(create, young, 0.0 if symmetric else self.left, self.right, symmetric)


class SmoothContact(PunchContact):
    """Contact of a half-plane with a smooth punch; made by :func:`solve_smooth_punch`.

    The pressure is sqrt(1 - t^2) times the sum of coefficients[k] U_k(t), x = middle + half_width t, with the
    Chebyshev polynomials U_k of the second kind. The attributes are those of :class:`PunchContact`.
    """

    def field(self, *, young: float | None = None, poisson: float, plane_state: PlaneState = "strain") -> Field:
        """Stresses and displacements in the body below, to rounding; parameters as of :meth:`Contact.field`."""
        return self._field(young, poisson, PLANE_STATES.number(plane_state), False)


def solve_smooth_punch(
    profile: Profile, lower: float, upper: float, e_star: float, force: float, *, moment: float | None = None
) -> SmoothContact:
    """Press a smooth punch into a half-plane; a few dozen coefficients give the pressure to rounding.

    Parameters
    ----------
    profile : callable
        ``gap, slope = profile(x)``: the initial gap and its derivative at an array of places between lower and upper.
        An exception in it is raised here.
    lower, upper : float
        Ends of the profile; length.
    e_star : float
        Combined modulus; force per length^2.
    force : float
        Not negative; per depth.
    moment : float, optional
        Force times its distance from x = 0, under which the punch tilts; without it the punch only sinks.

    Returns
    -------
    SmoothContact

    Raises
    ------
    UnsupportedError
        The contact is not one interval, or reaches an end of the profile; the message says which engine to use.
    EquilibriumError
        The force is negative, or its line of action lies outside the profile.
    InputError, CallbackError

    Warns
    -----
    ResidualWarning
        Certificate or estimated error above 1e-10.
    NotUniqueWarning
        No force and a free tilt.
    """
    limits = [_arrays.number("lower", lower), _arrays.number("upper", upper)]
    return SmoothContact(
        "fuge_solve_smooth_punch",
        profile_callback(profile),
        None,
        *limits,
        _arrays.number("e_star", e_star),
        _arrays.number("force", force),
        _arrays.optional_number("moment", moment),
    )


class RoundContact(PunchContact):
    """Contact of a half-space with a punch of revolution; made by :func:`solve_round_punch` and its like.

    It reaches from -radius to radius, and its places x are distances from the axis. The attributes are those of
    :class:`PunchContact`; the approach is absolute.
    """

    @property
    def radius(self) -> float:
        """Radius of the contact; length."""
        return self.half_width

    @property
    def load(self) -> float:
        """Force."""
        return self.force

    def field(self, *, young: float | None = None, poisson: float) -> Field:
        """Stresses and displacements in the body below, to rounding; parameters as of :meth:`Contact.field`.

        In the tip of a cone zz is minus the largest number.
        """
        return self._field(young, poisson, 0, True)


def _pressed(load: float | None, approach: float | None, radius: float | None) -> list[Any]:
    return [
        _arrays.optional_number("load", load),
        _arrays.optional_number("approach", approach),
        _arrays.optional_number("radius", radius),
    ]


def solve_round_punch(
    profile: Profile,
    reach: float,
    e_star: float,
    *,
    load: float | None = None,
    approach: float | None = None,
    radius: float | None = None,
) -> RoundContact:
    """Press a punch of revolution into a half-space.

    Parameters
    ----------
    profile : callable
        ``gap, slope = profile(r)``: the initial gap and its derivative at distances from the axis; smooth, but
        for a tip.
    reach : float
        Where the profile ends; length.
    e_star : float
        Combined modulus; force per length^2.
    load, approach, radius : float
        One of them: the load, how far the bodies approach each other, or the radius of the contact.

    Returns
    -------
    RoundContact

    Raises
    ------
    UnsupportedError
        The contact is not one disc, or reaches the end of the profile; the message says which engine to use.
    InputError
        Not exactly one of load, approach and radius is given, or a value is out of range.
    EquilibriumError, CallbackError

    Warns
    -----
    ResidualWarning
        Certificate or estimated error above 1e-10.
    """
    return RoundContact(
        "fuge_solve_round_punch",
        profile_callback(profile),
        None,
        _arrays.number("reach", reach),
        _arrays.number("e_star", e_star),
        *_pressed(load, approach, radius),
    )


def solve_round_powers(
    coefficients: ArrayLike,
    powers: ArrayLike,
    reach: float,
    e_star: float,
    *,
    starts: ArrayLike | None = None,
    load: float | None = None,
    approach: float | None = None,
    radius: float | None = None,
) -> RoundContact:
    """Press a punch of revolution whose initial gap is a sum of powers into a half-space.

    The sum is that of coefficients[k] (r - starts[k])^powers[k], each term from r = starts[k] on.

    Parameters
    ----------
    coefficients : array_like, shape (terms,)
    powers : array_like, shape (terms,)
        1 or more: 1 for a cone, 2 for a paraboloid.
    starts : array_like, shape (terms,), optional
        Not negative; length. Where one is not 0 the power is 1 or 2.
    reach, e_star, load, approach, radius
        As in :func:`solve_round_punch`.

    Examples
    --------
    >>> cone = fuge.solve_round_powers([1.0], [1.0], reach=10.0, e_star=1.0, load=1.0)
    """
    factors = _arrays.vector("coefficients", coefficients)
    terms = factors.size
    return RoundContact(
        "fuge_solve_round_powers",
        terms,
        factors,
        _arrays.vector("powers", powers, terms),
        None if starts is None else _arrays.vector("starts", starts, terms),
        _arrays.number("reach", reach),
        _arrays.number("e_star", e_star),
        *_pressed(load, approach, radius),
    )
