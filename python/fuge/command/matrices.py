"""Contact problems from matrices in files: an influence matrix, or the stiffness matrix of a body and its points."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

import fuge
from fuge.command.errors import CommandError, UsageError
from fuge.command.options import Options
from fuge.command.run import Log, Outcome, Report, caught
from fuge.command.tables import Column, Table, long_text, short_text, write_lines
from fuge.errors import Error, Status
from fuge.formats.text import LARGEST_LABEL, Reason, label, quoted_path, value

Array = NDArray[np.float64]

# Points on springs of their own up to this number are solved by a matrix, which can be proved.
_MOST_DENSE = 1000

# What the library says of motions is in its numbers, and no file names those of a body that floats.
_DEPENDENT = (
    "the body floats (--floats) and the counter-body is free under its load (--load): nothing resists a motion of both "
    "together; prescribe the counter-body by --approach, or hold the body by --fixed"
)
_IDLE = (
    "a rigid motion of the body that floats, or of the counter-body, moves no point that may touch: exclude fewer "
    "points, or hold the body by --fixed"
)


def solve_influence(given: Options, log: Log) -> Outcome:
    """--alpha."""
    gap, operator = _influence(given, log)
    report = Report(log)
    with fuge.Solver(operator, threads=given.threads(), progress=log.progress) as solver:
        _set_points(given, solver, gap)
        if given.has("modes"):
            _set_modes(given, solver)
        elif given.has("load"):
            solver.set_load(given.first("load").number())
        else:
            solver.set_approach(given.first("approach").number())
        contact, proof = solve_contact(given, solver, report)
    return Outcome(_table(given, contact, proof, report))


def solve_body(given: Options, log: Log) -> Outcome:
    """--stiffness and --contact."""
    body = _read_body(given, log)
    with caught() as condensation:
        condensed = body.condense()
    log.say(f"the body is condensed to {condensed.displacement.size} points")
    gap = _vector(given.file("gap"), condensed.displacement.size) + condensed.displacement
    report = Report(log)
    with fuge.Solver(condensed.influence, threads=given.threads(), progress=log.progress) as solver:
        _set_points(given, solver, gap)
        try:
            _pose_body(given, condensed, solver)
            contact, proof = solve_contact(given, solver, report)
        except Error as failure:
            if failure.status != Status.ERR_MODES or condensed.resultant.size == 0:
                raise
            raise CommandError(_IDLE if "moves no point" in failure.message else _DEPENDENT, failure.status) from None
    report.take_all(condensation)
    field: list[Column] = []
    if given.has("field"):
        with caught() as recovery:
            displacement = body.recover(contact.force, contact.motion[: condensed.resultant.size])
        report.take_all(recovery)
        degrees = range(1, displacement.size + 1)
        field = [Column("degree of freedom", degrees), Column("displacement", displacement)]
    return Outcome(_table(given, contact, proof, report), lambda path: write_lines(path, Table(field).lines()))


def solve_contact(
    given: Options, solver: fuge.Solver, report: Report
) -> tuple[fuge.Contact, fuge.Proof | None]:
    """Solve, and prove where that is asked for; warnings and remarks go into the report."""
    with caught():
        contact = solver.solve()
    info, n = contact.info, contact.force.size
    report.log.say(f"contact is solved: {info.contacts} of {n} points, {info.iterations} contact sets")
    report.residual = info.residual
    report.take(info.status, contact.message)
    if not given.has("prove"):
        return contact, None
    with caught() as warned:
        proof = solver.prove()
    report.log.say("the proof is done")
    report.take(warned[0].status if warned else Status.DONE, proof.message)
    return contact, proof


# ---- what is read


def _influence(given: Options, log: Log) -> tuple[Array, Any]:
    """Gaps, and the influence matrix or, where there is none, an operator without displacements."""
    path = given.file("alpha")
    with suppress(Reason):
        # 0 in all its forms.
        path = path if path and value(given.first("alpha").value) else ""
    if not path:
        if not given.has("compliance"):
            raise UsageError("--alpha 0 needs --compliance, the springs at the points")
        gap = _vector(given.file("gap"))
        log.say(f"{gap.size} points on springs of their own")
        if gap.size <= _MOST_DENSE:
            return gap, np.zeros((gap.size, gap.size))
        return gap, fuge.CallbackOperator(gap.size, np.zeros_like)
    alpha = fuge.read_matrix(path)
    if alpha.shape[0] != alpha.shape[1] or alpha.size == 0:
        raise _size_error(path, alpha.shape, "a square one is needed")
    log.say(f"influence matrix of {len(alpha)} points is read")
    return _vector(given.file("gap"), len(alpha)), alpha


def _read_body(given: Options, log: Log) -> fuge.Body:
    """The body with its supports, loads and contact points."""
    stiffness = fuge.read_stiffness(given.file("stiffness"), names_path=given.file("rows") or None)
    degrees = stiffness.shape[0]
    log.say(f"stiffness matrix of {degrees} rows is read")
    body = fuge.Body(stiffness)
    if given.has("floats"):
        body.find_rigid_modes()
    dof, normal = _contact(given.file("contact"), degrees)
    body.set_contact(dof, normal)
    if given.has("fixed"):
        body.fix(*_fixed(given.file("fixed")))
    if given.has("external"):
        body.set_load(_vector(given.file("external"), degrees))
    return body


def _contact(path: str, degrees: int) -> tuple[NDArray[np.intc], Array]:
    """Degrees of freedom of each point, and their directions, from a matrix with a row for each point."""
    matrix = fuge.read_sparse(path)
    points = matrix.shape[0]
    if matrix.shape[1] != degrees or points < 1:
        raise _size_error(path, matrix.shape, f"n x {degrees} is needed")
    rows = matrix.tocsc().tocsr()
    used = np.diff(rows.indptr)
    taken = np.arange(used.max()) < used[:, None]
    dof, normal = np.full(taken.shape, -1, dtype=np.intc), np.zeros(taken.shape)
    dof[taken], normal[taken] = rows.indices, rows.data
    return dof, normal


def _fixed(path: str) -> tuple[NDArray[np.intc], Array | None]:
    """Degrees of freedom that are held, and their displacements if there is a second column."""
    matrix = fuge.read_matrix(path)
    if not 1 <= matrix.shape[1] <= 2:
        raise _size_error(path, matrix.shape, "k x 1 or k x 2 is needed")
    named = matrix[:, 0]
    for k in np.flatnonzero((named != np.rint(named)) | (abs(named) > LARGEST_LABEL))[:1]:
        reason = f"entry ({k + 1}, 1) = {short_text(named[k])} is no degree of freedom"
        raise CommandError(f"{quoted_path(path)}: {reason}", Status.ERR_DOF)
    return named.astype(np.intc) - 1, matrix[:, 1] if matrix.shape[1] == 2 else None


def _vector(path: str, n: int | None = None) -> Array:
    """A matrix of n rows and one column, or of one row and n columns; of any length without n."""
    matrix = fuge.read_matrix(path)
    length = max(matrix.shape) if n is None else n
    if matrix.shape not in ((length, 1), (1, length)):
        raise _size_error(path, matrix.shape, f"{'n' if n is None else n} x 1 is needed")
    return matrix.reshape(-1)


def _size_error(path: str, shape: tuple[int, ...], wanted: str) -> Error:
    return CommandError(f"{quoted_path(path)}: a matrix of {shape[0]} x {shape[1]}, {wanted}", Status.ERR_SIZE)


# ---- points and motions


def _set_points(given: Options, solver: fuge.Solver, gap: Array) -> None:
    """Gaps, springs, limits of the forces and excluded points."""
    solver.set_gap(gap, _play(given, gap.size))
    solver.set_compliance(_law(given, "compliance", solver.n))
    solver.set_limits(*(_infinite(_law(given, name, solver.n)) for name in ("limit", "limit-upper")))
    solver.set_excluded(_excluded(given, solver.n))


def _play(given: Options, n: int) -> Array | None:
    return _infinite(_vector(given.file("play"), n)) if given.has("play") else None


def _law(given: Options, name: str, n: int) -> Array | None:
    """A value for each point, from a file or one for all; None without the option."""
    if not given.has(name):
        return None
    try:
        return np.full(n, value(given.first(name).value))
    except Reason:
        return _vector(given.file(name), n)


def _infinite(values: Array | None) -> Array | None:
    """Where a file has -1 there is no stop and no limit."""
    return None if values is None else np.where(values == -1.0, np.inf, values)


def _excluded(given: Options, n: int) -> NDArray[np.bool_] | None:
    """Points that --exclude names in lists such as 3,7-9; None without the option."""
    excluded = np.zeros(n, dtype=bool)
    for setting in given.all("exclude"):
        for item in setting.value.split(","):
            first, hyphen, last = item.partition("-")
            try:
                begin = label(first, "point", 0)
                end = label(last, "point", begin) if hyphen else begin
            except Reason:
                raise setting.refuse(f'"{item}" is no number of a point and no range such as 7-9') from None
            if begin < 1 or end > n:
                raise setting.refuse(f'"{item}" is not within 1 to {n}')
            excluded[begin - 1 : end] = True
    return excluded if given.has("exclude") else None


def _set_modes(given: Options, solver: fuge.Solver) -> None:
    """Rigid motions from files, and those that --motion prescribes."""
    path = given.file("modes")
    modes = fuge.read_matrix(path)
    if len(modes) != solver.n:
        raise _size_error(path, modes.shape, f"{solver.n} rows are needed")
    solver.set_modes(modes, _vector(given.file("resultant"), modes.shape[1]))
    prescribed = set()
    for setting in given.all("motion"):
        word, _, size = setting.value.partition("=")
        try:
            mode, motion = label(word, "motion", 0), value(size)
        except Reason:
            raise setting.refuse("the number of a motion and its value are needed, like 2=0.1") from None
        if not 1 <= mode <= modes.shape[1]:
            raise setting.refuse(f'"{path}" has {modes.shape[1]} motions')
        if mode in prescribed:
            raise setting.refuse(f"motion {mode} is given twice")
        prescribed.add(mode)
        solver.set_motion(mode - 1, motion)


def _pose_body(given: Options, condensed: fuge.Condensed, solver: fuge.Solver) -> None:
    """The motions of a body that floats come before that of the counter-body, which may stand still."""
    own = condensed.resultant.size
    load = given.first("load").number() if given.has("load") else 0.0
    if own == 0 and given.has("load"):
        solver.set_load(load)
        return
    counter = 1 if given.has("load") or given.has("approach") else 0
    modes = np.hstack([condensed.modes, np.ones((solver.n, counter))])
    solver.set_modes(modes, np.append(condensed.resultant, [load] * counter))
    if given.has("approach"):
        solver.set_motion(own, given.first("approach").number())


# ---- the table


def state_words(
    force: Array, state: NDArray[np.intc], play: Array | None = None, excluded: NDArray[np.bool_] | None = None
) -> NDArray[np.str_]:
    """What points do; where a force is limited, its sign tells the stop."""
    limited = (state == fuge.PointState.LIMITED_LOWER) | (state == fuge.PointState.LIMITED_UPPER)
    nowhere = np.zeros(force.shape, dtype=bool)
    held = nowhere if play is None else ~(play > 0.0)
    chosen = [nowhere if excluded is None else excluded, limited, held, force > 0.0, force < 0.0]
    return np.select(chosen, ["excluded", "limited", "held", "contact", "upper"], "open")


def _table(given: Options, contact: fuge.Contact, proof: fuge.Proof | None, report: Report) -> Table:
    n = contact.force.size
    comments = report.comments(contact.info.contacts)
    for k, (motion, resultant) in enumerate(zip(contact.motion, contact.resultant)):
        bound = "" if proof is None else f", bound: {long_text(proof.motion_bound[k])}"
        comments.append(f"motion {k + 1}: {long_text(motion)}, resultant: {long_text(resultant)}{bound}")
    words = state_words(contact.force, contact.state, _play(given, n), _excluded(given, n))
    columns = {"point": np.arange(1, n + 1), "force": contact.force, "gap": contact.gap, "state": words}
    if proof is not None:
        low, high = map(long_text, proof.largest_force)
        comments.append(f"largest force: from {low} to {high}")
        columns.update(force_bound=proof.force_bound, gap_bound=proof.gap_bound)
        columns["proved"] = np.where(proof.proved, "yes", "no")
    return Table([Column(name, values) for name, values in columns.items()], comments)
