"""A measured surface under a rigid plane: from its file to a line of a table for each load."""

from __future__ import annotations

import math
import re
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import fuge
from fuge.command.errors import CommandError, UsageError, counted_from_one
from fuge.command.options import Options
from fuge.command.run import Log, Outcome, Report, caught, outcome_comments
from fuge.command.tables import Column, Table, short_text, write_lines
from fuge.errors import Error, FileError, Status

Array = NDArray[np.float64]

# Words of options; the first one is the default.
_CHOICES = {
    "boundary": ("periodic", "free", "periodic-x", "periodic-y"),
    "element": ("mean", "centre"),
    "level": ("plane", "mean", "none"),
}

# Squares of heights over spacings do not overflow: neither is above this length, and no spacing below its inverse.
_LARGEST_LENGTH = 1e70

# Slopes between which surfaces mostly are, and a half-space can stand for them.
_LEAST_SLOPE, _LARGEST_SLOPE = 1e-4, 1.0

_COLUMNS = (
    "pressure load cells area fraction approach mean_gap contact_pressure largest_pressure residual status "
    "approach_bound pressure_bound gap_bound proved"
).split()


class _Surface(NamedTuple):
    """Heights, (ny, nx), levelled, and lengths in the user's unit; and what the file says of itself."""

    height: Array
    spacing: tuple[float, float]
    origin: tuple[float, float]
    file: fuge.SurfaceHeights

    @property
    def cell(self) -> float:
        return self.spacing[0] * self.spacing[1]

    @property
    def rms_slope(self) -> float:
        """Of the slopes between neighbours along x and along y, both together; 0 for one point."""
        along = [np.diff(self.height, axis=1 - axis) / self.spacing[axis] for axis in (0, 1)]
        return math.sqrt(sum(float(np.mean(slope**2)) for slope in along if slope.size))


def solve_surface(given: Options, log: Log) -> Outcome:
    """--surface."""
    words = {option: given.choice(option, choices) for option, choices in _CHOICES.items()}
    e_star = _modulus(given)
    loads = given.positive("pressure" if given.has("pressure") else "load")
    field = given.file("field")
    if ".vt" in field[-4:] and not field.endswith(".vti"):
        reason = "a surface is a grid, for ParaView a file *.vti; any other name is that of a table"
        raise UsageError(f"--field {field}: {reason}")
    surface = _read(given, words["level"])
    ny, nx = surface.height.shape
    log.say(f"{nx} x {ny} heights are read, {surface.file.filled} of them filled")
    report = Report(log)
    _remark_slope(surface, report)
    kind: Any = words["element"], words["boundary"].replace("-", "_")
    operator = fuge.HalfspaceOperator(nx, ny, *surface.spacing, e_star, *kind)
    rows = []
    with fuge.Solver(operator, threads=given.threads(), progress=log.progress) as solver:
        solver.set_gap(surface.height.max() - surface.height)
        for k, load in enumerate(loads, 1):
            row, contact = _solve_load(given, surface, solver, load, k, report)
            rows.append(row)
            log.say(f"load {k} of {len(loads)}: {row[2]} cells touch, {contact.info.products} products")
    form = {"residual": (9, 2)}
    columns = [Column(name, values, *form.get(name, ())) for name, values in zip(_COLUMNS, zip(*rows))]
    notes = [f"note: {'; '.join(report.notes)}"] if report.notes else []
    head = outcome_comments(report.status, report.message, report.residual) + notes
    table = Table(columns, head + _surface_comments(given, surface, words, e_star))
    writer = partial(_write_field, surface=surface, contact=contact)
    return Outcome(table, writer, lambda axes: fuge.plot.map(contact, ax=axes))


def _solve_load(
    given: Options, surface: _Surface, solver: fuge.Solver, load: float, k: int, report: Report
) -> tuple[list[Any], fuge.Contact]:
    """The line of one load, and its solution."""
    size, cell, of_pressure = surface.height.size, surface.cell, given.has("pressure")
    force = load * (size * surface.spacing[0] * surface.spacing[1]) if of_pressure else load
    solver.set_load(force)
    try:
        with caught():
            contact = solver.solve()
    except Error as failure:
        raise CommandError(f"load {k}: {counted_from_one(failure.message)}", failure.status) from None
    info = contact.info
    report.take(info.status, contact.message)
    report.residual = max(report.residual, info.residual)
    if info.contacts == size and np.ptp(surface.height) > 0.0:
        report.take(Status.DONE, f"the whole surface touches under load {k}: are its unit and the modulus right?")
    area = info.contacts * cell
    # A load that rounds to zero presses no cell.
    mean = force / area if info.contacts else 0.0
    row = [load if of_pressure else force / (size * cell), force, info.contacts, area, info.contacts / size]
    row += [contact.approach, contact.gap.mean(), mean, contact.force.max() / cell, info.residual, int(info.status)]
    if given.has("prove"):
        with caught() as warned:
            proof = solver.prove()
        of_proof = warned[0].status if warned else Status.DONE
        report.take(of_proof, proof.message)
        row[-1] = int(info.status or of_proof)
        # One unit in the last place more is not below the exact quotient.
        pressure_bound = np.nextafter(proof.force_bound.max() / cell, np.inf)
        row += [float(proof.motion_bound[0]), pressure_bound, proof.gap_bound.max(), int(proof.proved.sum())]
    return row, contact


# ---- what is read


def _modulus(given: Options) -> float:
    """The combined modulus, by --modulus or by --young and --poisson of one elastic body or of both."""
    if given.has("modulus"):
        return given.factor("modulus")
    young, poisson = given.positive("young"), given.first("poisson").numbers()
    if len(young) > 2 or len(poisson) != len(young):
        raise UsageError("--young and --poisson need one number each, or two each for two elastic bodies")
    moduli = [fuge.plane_modulus(e, nu) for e, nu in zip(young, poisson)]
    return moduli[0] if len(moduli) == 1 else fuge.combined_modulus(*moduli)


def _read(given: Options, level: Any) -> _Surface:
    path = given.file("surface")
    try:
        found = fuge.read_surface(path, fill=given.has("fill"))
    except FileError as failure:
        message = re.sub("be filled( by fill=True)?", "be filled by --fill", failure.message)
        raise FileError(message, failure.status) from None
    scale = given.factor("scale")
    height_scale = given.factor("height-scale", scale)
    spacing = _spacing(given, found.spacing, scale)
    largest = max(*spacing, 1.0 / min(spacing), np.abs(found.height).max() * max(height_scale, 1.0))
    if not largest <= _LARGEST_LENGTH:
        reason = "its heights or spacings are out of range after --height-scale or --scale"
        raise FileError(f'"{path}": {reason}', Status.ERR_FILE)
    height = height_scale * found.height
    origin = scale * found.origin[0], scale * found.origin[1]
    return _Surface(height if level == "none" else fuge.level_surface(height, level), spacing, origin, found)


def _spacing(given: Options, known: tuple[float, float] | None, scale: float) -> tuple[float, float]:
    """The spacings of the file, scaled, or those of the options."""
    path = given.file("surface")
    if given.has("spacing") == (known is not None):
        comments = "comments # spacing_x = .. and # spacing_y = .. before its heights"
        remedy = f"give --spacing, one or two lengths, or {comments}"
        reason = f'"{path}" does not say how far apart its points are: {remedy}'
        if known is not None:
            own = f"spacings of its own, {short_text(known[0])} and {short_text(known[1])}"
            reason = f'--spacing: "{path}" has {own}; leave the option out, --scale changes their unit'
        raise CommandError(reason, Status.ERR_OPTION)
    if known is not None:
        return scale * known[0], scale * known[1]
    values = given.positive("spacing")
    if len(values) > 2:
        raise given.first("spacing").refuse("one or two lengths are needed, along x and along y")
    return values[0], values[-1]


def _remark_slope(surface: _Surface, report: Report) -> None:
    slope = surface.rms_slope
    if slope and not _LEAST_SLOPE <= slope <= _LARGEST_SLOPE:
        wrong = "too steep for a half-space" if slope > _LARGEST_SLOPE else "flatter than surfaces mostly are"
        remedy = "if its heights have another unit than its spacings, give --height-scale"
        report.take(Status.DONE, f"the mean slope of the surface is {short_text(slope)}, {wrong}: {remedy}")


# ---- what is written


def _surface_comments(given: Options, surface: _Surface, words: dict[str, str], e_star: float) -> list[str]:
    ny, nx = surface.height.shape
    unit = "" if surface.file.unit is None else f", unit of the file: {surface.file.unit}"
    spacings = f"{short_text(surface.spacing[0])} and {short_text(surface.spacing[1])}"
    rms = f"rms height {short_text(surface.height.std())}, rms slope {short_text(surface.rms_slope)}"
    return [
        f"surface: {given.file('surface')}, {nx} x {ny} heights, {surface.file.filled} of them filled{unit}",
        f"spacings: {spacings}, {rms}, level: {words['level']}",
        f"e_star: {short_text(e_star)}, boundary: {words['boundary']}, element: {words['element']}",
    ]


def _write_field(path: str, surface: _Surface, contact: fuge.Contact) -> None:
    """Height, pressure and gap: for ParaView, or as a table that gnuplot draws."""
    fields = {"height": surface.height, "pressure": contact.force / surface.cell, "gap": contact.gap}
    if path.endswith(".vti"):
        fuge.write_results(path, surface.spacing, fields, origin=surface.origin)
        return
    ny, nx = surface.height.shape
    x, y = (surface.origin[k] + surface.spacing[k] * np.arange(n) for k, n in enumerate((nx, ny)))
    places = {"x": np.tile(x, ny), "y": np.repeat(y, nx)}
    columns = [Column(name, np.ravel(values), 16, 8) for name, values in {**places, **fields}.items()]
    write_lines(path, Table(columns, block=nx).lines())
