"""Pictures by matplotlib, each one call on what a solve returns.

    contact = fuge.solve(operator, gap, load)
    fuge.plot.map(contact)       the pressure on an area
    fuge.plot.line(contact)      the pressure along a line
    fuge.plot.gap(contact)       the gaps under load
    fuge.plot.stress(contact)    the largest shear stress below the contact, or in a fuge.Field
    fuge.plot.path(fuge.load_path(alpha, gap, load))    the load over the approach
    fuge.plot.levels(fuge.solve_line(gap, interval, e_star=E, load=F))    the error over time, or over cells

Each returns matplotlib's Axes, those of the argument ``ax`` or new ones; ``ax.figure.savefig`` saves the picture. The
axes show units that are given, ``unit="mm", pressure_unit="MPa"``. Coordinates count from the middle of the grid unless
they are given.
"""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._cuts import Cut, cut_through
from fuge.accuracy import ResolvedContact
from fuge.contact import Contact
from fuge.errors import Status, error
from fuge.field import Field
from fuge.path import Path, PointState
from fuge.smooth import RoundContact, SmoothContact

Axes = Any
"""matplotlib.axes.Axes"""

AnyContact = Union[Contact, SmoothContact, RoundContact]

# Colour-blind readers too can tell blue from vermilion, and the shades of these maps from each other.
BLUE, VERMILION, GREY = "#0072B2", "#D55E00", "#BBBBBB"
PRESSURES, GAPS, STRESSES = "viridis", "cividis_r", "inferno"
# Of levels, by their method.
_MARKS = {"series": ("^", BLUE), "graded_cells": ("s", VERMILION), "equal_cells": ("o", BLUE)}
# Cells are drawn as equal ones if their widths differ by at most this, relative to the mean width.
_UNEQUAL = 1e-3


# ---- what the pictures share


def _check(name: str, value: Any, *kinds: type) -> None:
    if not isinstance(value, kinds):
        wanted = " or a ".join(kind.__name__ for kind in kinds)
        arrays = ": draw its arrays x, y, pressure and gap, or by fuge.plot.stress the fuge.Field of its cells"
        instead = arrays if isinstance(value, ResolvedContact) else ""
        raise TypeError(f"fuge.plot.{name} draws a {wanted}, not {type(value).__name__}{instead}")


def _new_axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    try:
        pyplot = importlib.import_module("matplotlib.pyplot")
    except ImportError as missing:
        raise ImportError(
            "fuge.plot draws with matplotlib, which cannot be imported: pip install matplotlib (Debian: apt-get "
            f"install python3-matplotlib): {missing}"
        ) from missing
    return pyplot.subplots(layout="constrained")[1]


def _label(name: str, unit: str | None) -> str:
    return name if unit is None else f"{name} [{unit}]"


def _value(value: float, unit: str | None) -> str:
    number = f"{value:.0f}" if 1e4 <= abs(value) < 1e7 else f"{value:.4g}"
    return number if unit is None else f"{number} {unit}"


def _largest(values: NDArray[np.float64]) -> float:
    """The value of the largest magnitude, with its sign."""
    return float(values.flat[int(np.abs(values).argmax())])


def _title(ax: Axes, text: str) -> None:
    ax.set_title(text, loc="left", fontsize="medium")


@dataclass(frozen=True)
class _Places:
    """Middles of cells along one axis."""

    values: NDArray[np.float64]
    label: str

    def widths(self) -> NDArray[np.float64]:
        """Distances of the middles; that of a single cell is 1."""
        return np.diff(self.values) if self.values.size > 1 else np.ones(1)

    def equal(self) -> bool:
        """Whether a picture shows the cells as equal ones."""
        widths = self.widths()
        mean = float(widths.mean())
        return bool(np.all(np.abs(widths - mean) <= _UNEQUAL * abs(mean)))

    def edges(self) -> NDArray[np.float64]:
        """Where the cells begin and end: halfway between their middles."""
        half = 0.5 * self.widths()
        return np.concatenate(
            [self.values[:1] - half[0], self.values[:-1] + half[: self.values.size - 1], self.values[-1:] + half[-1]]
        )


def _shape(contact: Contact) -> tuple[int, ...]:
    return contact.force.shape if contact.cells is None else contact.cells.shape


def _places(contact: Contact, axis: int, given: ArrayLike | None, unit: str | None) -> _Places:
    name, n = "xy"[axis], _shape(contact)[::-1][axis]
    if given is not None:
        places = _Places(_arrays.vector(name, given, n), _label(name, unit))
        widths = places.widths()
        if not (np.all(widths > 0.0) or np.all(widths < 0.0)):
            raise error(Status.ERR_OPTION, f"{name} must grow from cell to cell, or fall: sort the cells along {name}")
        return places
    if contact.cells is not None:
        return _Places(contact.cells.centres(axis), _label(f"{name} from the middle", unit))
    counted = ("point",) if len(_shape(contact)) == 1 else ("column", "row")
    return _Places(np.arange(float(n)), counted[axis])


def _pressure(contact: Contact, width: ArrayLike | None) -> tuple[NDArray[np.float64], str]:
    """Pressures and their name; forces where the areas are unknown."""
    force = contact.force.reshape(_shape(contact))
    if width is not None:
        return force / _arrays.spread("width", width, force.size).reshape(force.shape), "pressure"
    return (force, "force") if contact.cells is None else (force / contact.cells.size, "pressure")


def _only_areas(contact: Contact, name: str) -> None:
    if len(_shape(contact)) != 2:
        raise error(
            Status.ERR_SIZE,
            f"fuge.plot.{name} draws an area, but this contact is one of {contact.force.size} points in a row: use "
            "fuge.plot.line",
        )


def _image(ax: Axes, values: NDArray[np.float64], x: _Places, y: _Places, colours: str, empty: str, label: str) -> None:
    """A map whose first row is the lowest one; NaN has a colour of its own."""
    if x.equal() and y.equal():
        extent = [float(places.edges()[k]) for places in (x, y) for k in (0, -1)]
        image = ax.imshow(
            values, origin="lower", extent=extent, cmap=colours, interpolation="nearest", aspect="equal"
        )
    else:
        image = ax.pcolormesh(x.edges(), y.edges(), values, cmap=colours)
        ax.set_aspect("equal")
    ax.set_facecolor(empty)
    ax.set_xlabel(x.label)
    ax.set_ylabel(y.label)
    _colour_bar(ax, image, label)


def _colour_bar(ax: Axes, image: Any, label: str) -> None:
    """Add a colour bar as high as the picture beside it."""
    ax.figure.colorbar(image, cax=ax.inset_axes([1.03, 0.0, 0.04, 1.0]), label=label)


def _touching(contact: Contact) -> str:
    return f"{contact.info.contacts} of {contact.force.size} points touch"


# ---- the pictures


def line(
    contact: AnyContact,
    *,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
    width: ArrayLike | None = None,
    along: Literal["x", "y"] = "x",
    unit: str | None = None,
    pressure_unit: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """The pressure along a line; of an area along the row, or the column, with the largest pressure.

    Parameters
    ----------
    contact : Contact, SmoothContact or RoundContact
    x, y : array_like, optional
        Middles of the cells; without them places count from the middle of the grid. Of contacts without a grid: where
        to draw.
    width : array_like or float, optional
        Widths of the cells where the operator is a matrix, which does not know them; without them forces are drawn.
    along : {'x', 'y'}
        On an area.
    unit, pressure_unit : str, optional
        For the axes.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes
    """
    _check("line", contact, Contact, SmoothContact, RoundContact)
    if not isinstance(contact, Contact):
        return _smooth_line(contact, x, unit, pressure_unit, ax)
    values, name = _pressure(contact, width)
    axis, where = 0, ""
    places = _places(contact, 0, x, unit)
    if values.ndim == 2:
        row, column = np.unravel_index(int(values.argmax()), values.shape)
        axis = int(_arrays.choice("along", along, {"x": 0, "y": 1}))
        across = _places(contact, 1 - axis, (y, x)[axis], unit)
        places = _places(contact, axis, (x, y)[axis], unit)
        values = values[row] if axis == 0 else values[:, column]
        where = f", at {'yx'[axis]} = {_value(float(across.values[row if axis == 0 else column]), unit)}"
    axes = _new_axes(ax)
    element = "mean" if contact.cells is None else contact.cells.element
    style = "default" if name == "force" or element == "hat" or values.size > 400 else "steps-mid"
    axes.plot(places.values, values, color=BLUE, drawstyle=style)
    shown = f"{name.capitalize()} along {'xy'[axis]}{where}" if name == "pressure" else "Contact forces"
    _finish_line(axes, shown, places, _label(name, pressure_unit), values, pressure_unit)
    return axes


def _smooth_line(
    contact: SmoothContact | RoundContact, x: ArrayLike | None, unit: str | None, pressure_unit: str | None, ax: Axes
) -> Axes:
    left, right = contact.left, contact.right
    beside = 0.2 * (right - left)
    # An even number: the tip of a cone, where the pressure has no limit, is left out.
    places = np.linspace(left - beside, right + beside, 1000) if x is None else _arrays.vector("x", x)
    pressure = contact.pressure(places)
    axes = _new_axes(ax)
    axes.plot(places, pressure, color=BLUE)
    label = _label("pressure", pressure_unit)
    drawn = _Places(places, _label("x", unit))
    _finish_line(axes, "Pressure along x", drawn, label, pressure, pressure_unit)
    return axes


def _finish_line(
    axes: Axes, shown: str, places: _Places, label: str, values: NDArray[np.float64], unit: str | None
) -> None:
    axes.set_xlabel(places.label)
    axes.set_ylabel(label)
    axes.margins(x=0.0)
    # Tied points and upper stops may pull.
    if values.min() >= 0.0:
        axes.set_ylim(bottom=0.0)
    _title(axes, f"{shown}: largest {_value(_largest(values), unit)}")


def map(
    contact: Contact,
    *,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
    unit: str | None = None,
    pressure_unit: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """The pressure on an area, seen from above; grey where the bodies do not touch.

    Parameters
    ----------
    contact : Contact
        Of an operator with the cells of an area.
    x, y : array_like, optional
        Middles of the columns and of the rows; without them places count from the middle of the grid.
    unit, pressure_unit : str, optional
        For the axes.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes
    """
    _check("map", contact, Contact)
    _only_areas(contact, "map")
    values, name = _pressure(contact, None)
    axes = _new_axes(ax)
    touching = np.where(contact.force.reshape(values.shape) == 0.0, np.nan, values)
    across = _places(contact, 0, x, unit), _places(contact, 1, y, unit)
    _image(axes, touching, *across, PRESSURES, GREY, _label(name, pressure_unit))
    _title(axes, f"{name.capitalize()}: {_touching(contact)}, largest {_value(_largest(values), pressure_unit)}")
    return axes


def gap(
    contact: Contact,
    *,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
    unit: str | None = None,
    gap_unit: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """The gaps under load, on a line or an area; where the bodies touch in vermilion.

    Parameters
    ----------
    contact : Contact
    x, y : array_like, optional
        Middles of the cells; without them places count from the middle of the grid.
    unit, gap_unit : str, optional
        For the axes; the gaps are in the unit of the places unless they have their own.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes
    """
    _check("gap", contact, Contact)
    values = contact.gap.reshape(_shape(contact))
    closed = contact.force.reshape(values.shape) != 0.0
    label = _label("gap", gap_unit or unit)
    axes = _new_axes(ax)
    places = _places(contact, 0, x, unit)
    if values.ndim == 2:
        rows = _places(contact, 1, y, unit)
        _image(axes, np.where(closed, np.nan, values), places, rows, GAPS, VERMILION, label)
    else:
        axes.plot(places.values, values, color=BLUE)
        axes.plot(places.values, np.where(closed, values, np.nan), color=VERMILION, linewidth=3, label="contact")
        axes.set_xlabel(places.label)
        axes.set_ylabel(label)
        axes.margins(x=0.0)
        axes.legend(frameon=False)
    _title(axes, f"Gap under load: {_touching(contact)}, widest {_value(float(values.max()), gap_unit or unit)}")
    return axes


def path(
    path: Path,
    *,
    end: float | None = None,
    unit: str | None = None,
    force_unit: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """The load over the approach, exactly, with a mark where a point comes into contact or leaves it.

    Parameters
    ----------
    path : Path
        Of :func:`fuge.load_path`; of :meth:`fuge.Solver.follow_path` all motions are drawn over the parameter.
    end : float, optional
        The last load, or parameter, up to which the line goes on beyond the last event.
    unit, force_unit : str, optional
        Of the approach and of the load.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes
    """
    _check("path", path, Path)
    of_load = path.motion.ndim == 1
    parameter, motion = path.parameter, path.motion.reshape(path.parameter.size, -1)
    if end is not None and end > parameter[-1]:
        rate = path.rate.reshape(motion.shape)[-1]
        motion = np.vstack([motion, motion[-1] + rate * (end - parameter[-1])])
        parameter = np.append(parameter, end)
    events = slice(0, path.parameter.size)
    axes = _new_axes(ax)
    for column, values in enumerate(motion.T):
        across, up = (values, parameter) if of_load else (parameter, values)
        colour = BLUE if motion.shape[1] == 1 else None
        (drawn,) = axes.plot(across, up, color=colour, label=f"motion {column}")
        axes.plot(across[events], up[events], "o", markersize=3, color=drawn.get_color())
    axes.set_xlabel(_label("approach", unit) if of_load else "parameter")
    axes.set_ylabel(_label("load", force_unit) if of_load else _label("motion", unit))
    if motion.shape[1] > 1:
        axes.legend(frameon=False)
    _title(axes, f"{'Load over approach' if of_load else 'Motions'}: {_told_events(path)}")
    return axes


def _told_events(path: Path) -> str:
    states = path.state[1:]
    joining, leaving = int(np.sum(states != PointState.OPEN)), int(np.sum(states == PointState.OPEN))
    return f"{joining} points come into contact" + (f", {leaving} leave it" if leaving else "")


def levels(
    contact: ResolvedContact,
    *,
    over: Literal["seconds", "cells"] = "seconds",
    ax: Axes | None = None,
) -> Axes:
    """The estimated error of the pressure on the way to the wanted one, which is a grey line.

    Levels whose error is not known yet, such as the first one, are left out.

    Parameters
    ----------
    contact : ResolvedContact
        Of :func:`fuge.solve_line` or :func:`fuge.solve_area`.
    over : {'seconds', 'cells'}
        The time since the call, with the number of cells at each mark, or the cells.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes
    """
    _check("levels", contact, ResolvedContact)
    by_time = _arrays.choice("over", over, {"seconds": 1, "cells": 0}) == 1
    known = [level for level in contact.levels if level.pressure_error < 1.0]
    axes = _new_axes(ax)
    axes.axhline(contact.accuracy, color=GREY, linewidth=2, label="wanted")
    for method in dict.fromkeys(level.method for level in known):
        of_method = [level for level in known if level.method == method]
        across = [level.seconds if by_time else level.cells for level in of_method]
        errors = [level.pressure_error for level in of_method]
        mark, colour = _MARKS[method]
        axes.plot(across, errors, color=colour, marker=mark, linewidth=1, label=method.replace("_", " "))
    for level in known if by_time else []:
        place = level.seconds, level.pressure_error
        axes.annotate(str(level.cells), place, xytext=(5, 5), textcoords="offset points", fontsize="small")
    # A series may reach rounding, and an error of 0 has no place.
    axes.set_xscale("log", nonpositive="mask")
    axes.set_yscale("log", nonpositive="mask")
    axes.set_xlabel("time [s]" if by_time else "cells")
    axes.set_ylabel("share of the load in the wrong place")
    axes.legend(frameon=False)
    reached = f"{contact.pressure_error:.1e} in {contact.levels[-1].seconds:.2g} s"
    _title(axes, f"Estimated error: {reached}, wanted {contact.accuracy:.1e}")
    return axes


def stress(
    contact: AnyContact | Field,
    *,
    poisson: float | None = None,
    depth: float | None = None,
    along: Literal["x", "y"] = "x",
    unit: str | None = None,
    pressure_unit: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """The largest shear stress below the contact, in a cut through the largest pressure; a cross where it is largest.

    It is half of Tresca's stress, in the body below; a contact along a line is taken as one of plane strain. Of several
    contacts on a grid the one with the largest pressure is shown. Where the stress is largest within a cell of the
    surface, as under the corner of a punch, the title says "or more".

    Parameters
    ----------
    contact : Contact, SmoothContact, RoundContact or Field
        A Contact must come from an operator of equal cells, those of layers included.
    poisson : float, optional
        Poisson's ratio of the body, 0.3 without it. Layers and fields know theirs.
    depth : float, optional
        How deep the cut goes; without it a quarter more than the contact is long; length.
    along : {'x', 'y'}
        The direction of the cut through an area.
    unit, pressure_unit : str, optional
        For the axes.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes
    """
    _check("stress", contact, Contact, SmoothContact, RoundContact, Field)
    axis = _arrays.choice("along", along, {"x": 0, "y": 1})
    below = None if depth is None else _arrays.number("depth", depth)
    if below is not None and not below > 0.0:
        raise error(Status.ERR_OPTION, f"depth is {below}, but must be positive")
    field = _field(contact, poisson)
    cut = cut_through(field, axis, below)
    axes = _new_axes(ax)
    levels = axes.pcolormesh(cut.place, cut.depth, cut.shear, cmap=STRESSES, shading="gouraud")
    k, i = cut.largest
    if np.isfinite(cut.resolved):
        axes.plot(cut.place[i], cut.depth[k], "x", color=BLUE, markeredgewidth=2)
    axes.plot([cut.left, cut.right], [0.0, 0.0], color=VERMILION, linewidth=4, clip_on=False, solid_capstyle="butt")
    axes.set_aspect("equal")
    axes.set_ylim(cut.depth[-1], 0.0)
    from_middle = " from the middle" if field.cells is not None else ""
    axes.set_xlabel(_label("xy"[axis] + from_middle, unit))
    axes.set_ylabel(_label("depth", unit))
    _colour_bar(axes, levels, _label("largest shear stress", pressure_unit))
    _title(axes, f"Largest shear stress: {_told_stress(cut, unit, pressure_unit)}")
    return axes


def _field(contact: AnyContact | Field, poisson: float | None) -> Field:
    if isinstance(contact, Field):
        if poisson is not None:
            raise error(Status.ERR_OPTION, "a field knows its body: leave out poisson")
        return contact
    if isinstance(contact, Contact) and contact.cells is not None and contact.cells.layers is not None:
        return contact.field(poisson=poisson)
    return contact.field(poisson=0.3 if poisson is None else poisson)


def _told_stress(cut: Cut, unit: str | None, pressure_unit: str | None) -> str:
    k, i = cut.largest
    if np.isinf(cut.resolved):
        return "without limit, as the pressure is"
    value = _value(float(cut.shear[k, i]), pressure_unit)
    if cut.depth[k] < cut.resolved:
        return f"{value} or more, at the surface"
    return f"{value}, {cut.depth[k]:.3g}{f' {unit}' if unit else ''} deep"
