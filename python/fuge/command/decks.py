"""Structures with one-way links: from the deck and the stiffness matrix to the table of all load cases."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import fuge
from fuge.command.checks import check_input
from fuge.command.errors import UsageError
from fuge.command.matrices import stored
from fuge.command.options import Options
from fuge.command.run import Log, Outcome, caught, outcome_comments
from fuge.command.tables import Column, Table, short_text, write_lines
from fuge.errors import Error, Status

Array = NDArray[np.float64]
_State = fuge.PointState

# Types of elements that have no cell in a picture, by the letters that they begin with.
_NOT_DRAWN = ("GAP", "SPRING", "DASHPOT", "MASS", "ROTARYI", "CONN", "DCOUP", "DGAP")


@dataclass
class _Case:
    """A load case: its report and, unless it failed, its solution; forces are NaN where it failed."""

    name: str
    force: Array
    gap: Array
    state: NDArray[np.intc]
    status: Status = Status.DONE
    message: str = ""
    info: fuge.Info | None = None
    displacement: Array | None = None
    # By rows of the matrix.
    reaction: dict[int, float] = field(default_factory=dict)
    proof: fuge.Proof | None = None


@dataclass
class _Model:
    """What the deck, its tables and the stiffness matrix have, and the load cases."""

    deck: fuge.Deck
    stiffness: fuge.StiffnessFile
    cases: list[_Case]

    @property
    def force(self) -> Array:
        """Of the links, (cases, links)."""
        return np.array([case.force for case in self.cases])


def solve_deck(given: Options, log: Log) -> Outcome:
    """--deck, --links. Where cases fail, the outcome has the others, and the first failure."""
    model = _read(given, log)
    mesh = _drawn_mesh(given) if given.file("field")[-4:].lower() == ".vtu" else None
    _solve_cases(model, given, log)
    for case in model.cases:
        if case.status > 0:
            log.warn(f"{case.name}: {case.message}")
    failed = [case for case in model.cases if case.status < 0]
    failure = ""
    if failed:
        counts = f"{len(failed)} of {len(model.cases)} load cases failed"
        failure = f"{counts}; {failed[0].name}: {failed[0].message}"

    def write_field(path: str) -> None:
        if mesh is None:
            write_lines(path, _field_table(model).lines())
        else:
            mesh.write(path, _node_fields(model, mesh))

    table = _long_table(model) if given.has("long") else _table(model)
    table.comments = [line for k in range(len(model.cases)) for line in _case_comments(model, k)]
    return Outcome(table, write_field, lambda axes: _draw(model, axes), _reactions(model), failure)


# ---- what is read


def _read(given: Options, log: Log) -> _Model:
    deck = fuge.read_deck(given.file("deck")) if given.has("deck") else fuge.Deck()
    for option in ("links", "supports", "cases"):
        if given.has(option):
            getattr(deck, f"read_{option}")(given.file(option))
    for path in deck.paths:
        check_input(given, path, "the same file as of --deck or of one that it includes")
    if not deck.link_names:
        raise UsageError(
            "no one-way link: the deck has no CGAP, no CBUSH1D with a table, and no GAPUNI, and --links gives none"
        )
    if not deck.case_names:
        raise UsageError(
            "no load case: the deck has no SUBCASE, no only load set and no static *STEP, and --cases gives none"
        )
    log.say(f"deck: {len(deck.link_names)} one-way links, {len(deck.case_names)} load cases")
    path, rows = given.file("stiffness"), given.file("rows") or None
    name = given.first("matrix").value if given.has("matrix") else None
    stiffness = fuge.read_stiffness(path, names_path=rows, name=name)
    log.say(f"stiffness matrix of {stiffness.node.size} rows is read")
    if not stiffness.node.any():
        raise UsageError(f'"{path}" has rows without names: give the node and the direction of each by --rows')
    shape = len(deck.link_names)
    nothing, states = np.full(shape, np.nan), np.zeros(shape, dtype=np.intc)
    return _Model(deck, stiffness, [_Case(name, nothing, nothing, states) for name in deck.case_names])


# ---- load cases


def _solve_cases(model: _Model, given: Options, log: Log) -> None:
    """Solve all cases; those that hold the same rows share one condensation, and one that fails harms no other."""
    deck, stiffness = model.deck, model.stiffness
    links, loads = deck.links(stiffness), deck.loads(stiffness)
    supports = [dict(zip(*map(np.ndarray.tolist, deck.supports(k, stiffness)))) for k in range(len(model.cases))]
    groups: dict[tuple[int, ...], list[int]] = {}
    for k, held in enumerate(supports):
        groups.setdefault(tuple(sorted(held)), []).append(k)
    body = fuge.Body(stored(stiffness))
    body.find_rigid_modes()
    body.set_links(links)
    solved = 0
    for fixed, members in groups.items():
        moved = np.array([[supports[k][dof] for dof in fixed] for k in members])
        try:
            body.fix(np.array(fixed, dtype=np.intc))
            with caught() as condensation:
                body.condense()
            with caught() as warned:
                names = [model.cases[k].name for k in members]
                found = body.solve_cases(loads[members], supports=moved, names=names, prove=given.has("prove"))
        except Error as failure:
            for k in members:
                model.cases[k].status, model.cases[k].message = failure.status, _words(failure.message)
        else:
            # Warnings of single cases are in their reports.
            remarks = condensation + [warning for warning in warned if warning.status == Status.DONE]
            for j, k in enumerate(members):
                _take(model.cases[k], found, j, fixed, remarks)
            for warning in warned:
                if warning.status == Status.DONE:
                    log.warn(warning.message)
        solved += len(members)
        log.say(f"{solved} load cases are solved")


def _take(case: _Case, found: fuge.Cases, j: int, fixed: tuple[int, ...], remarks: list[fuge.Warning]) -> None:
    """The report and the solution of a case, which is case j of those that were solved together."""
    case.status, case.message, case.info = Status(found.status[j]), _words(found.message[j]), found.info[j]
    if case.status < 0:
        return
    case.force, case.gap, case.state = found.force[j], found.gap[j], found.state[j]
    case.displacement = None if found.displacement is None else found.displacement[j]
    case.reaction = {} if found.reaction is None else dict(zip(fixed, found.reaction[j].tolist()))
    case.proof = found.proof[j] if found.proof else None
    told = [(warning.status, _words(warning.message)) for warning in remarks]
    if case.proof is not None:
        told.append((Status.DONE if case.proof.bounded else Status.WARN_NOT_PROVED, case.proof.message))
    for status, message in told:
        if case.status == Status.DONE and (status > 0 or not case.message):
            case.status, case.message = status, message


def _words(message: str) -> str:
    """A message of the package without numbers of rows, which nodes name, and without advice on Python."""
    message = message.partition("; Body.mechanism")[0]
    return re.sub(r"degree of freedom \d+ \((node \d+, direction \d+)\)", r"\1", message)


# ---- tables


def _states(model: _Model, case: _Case) -> NDArray[np.str_]:
    """What the links do in a case."""
    state = case.state
    if case.status < 0:
        return np.full(state.shape, "failed")
    limited = (state == _State.LIMITED_LOWER) | (state == _State.LIMITED_UPPER)
    chosen = [limited, ~(model.deck.play > 0.0), state == _State.AT_LOWER_STOP, state == _State.AT_UPPER_STOP]
    return np.select(chosen, ["limited", "held", "contact", "upper"], "open")


def _table(model: _Model) -> Table:
    """A line for each link, columns for each case, and the envelope."""
    deck = model.deck
    columns = [Column("element", deck.link_names), Column("node_a", deck.node_a), Column("node_b", deck.node_b)]
    for k, case in enumerate(model.cases, 1):
        columns += [replace(column, name=f"{column.name} {k}") for column in _case_columns(model, case)]
    return Table(columns + _envelope("force", model.force))


def _long_table(model: _Model) -> Table:
    """A line for each link in each case."""
    names, links = [case.name for case in model.cases], model.deck.link_names
    parts = zip(*(_case_columns(model, case) for case in model.cases))
    columns = [replace(part[0], values=np.concatenate([column.values for column in part])) for part in parts]
    return Table([Column("case", np.repeat(names, len(links))), Column("link", links * len(names)), *columns])


def _case_columns(model: _Model, case: _Case) -> list[Column]:
    columns = [Column("force", case.force, 25), Column("gap", case.gap, 25), Column("state", _states(model, case))]
    if any(other.proof for other in model.cases):
        nothing = np.full(case.force.shape, np.nan)
        bounds = (nothing, nothing) if case.proof is None else (case.proof.force_bound, case.proof.gap_bound)
        proved = np.zeros(nothing.shape, dtype=bool) if case.proof is None else case.proof.proved
        columns += [Column("force_bound", bounds[0], 25), Column("gap_bound", bounds[1], 25)]
        columns.append(Column("proved", np.where(proved, "yes", "no")))
    return columns


def _envelope(name: str, values: Array) -> list[Column]:
    """The smallest and the largest value of all cases, (cases, ..), and the cases that have them."""
    found = fuge.envelope(values)
    columns = []
    for end in ("smallest", "largest"):
        cases = getattr(found, f"{end}_case").tolist()
        columns.append(Column(f"{end} {name}", getattr(found, end), 25))
        columns.append(Column(f"{end} in case", [case + 1 if case >= 0 else "" for case in cases]))
    return columns


def _reactions(model: _Model) -> Table:
    """Forces of the supports on the structure: a line for each row that is held in any case."""
    rows = sorted({row for case in model.cases for row in case.reaction})
    values = np.array([[case.reaction.get(row, np.nan) for row in rows] for case in model.cases])
    columns = [Column("node", model.stiffness.node[rows]), Column("direction", model.stiffness.direction[rows])]
    columns += [Column(f"reaction {k}", row, 25) for k, row in enumerate(values, 1)]
    comments = [f"case {k}: {case.name}" for k, case in enumerate(model.cases, 1)]
    return Table(columns + _envelope("reaction", values), comments)


def _case_comments(model: _Model, k: int) -> list[str]:
    case = model.cases[k]
    comments = [f"case {k + 1}: {case.name}"]
    residual = 0.0 if case.info is None else case.info.residual
    if case.info is None or case.displacement is None:
        return comments + outcome_comments(case.status, case.message, residual)
    largest, node = _largest(model, case.displacement)
    comments += outcome_comments(case.status, case.message, residual, case.info.contacts)
    return [*comments, f"largest displacement: {short_text(largest)} of node {node}"]


def _largest(model: _Model, displacement: Array) -> tuple[float, int]:
    """The largest displacement of a node, rotations left out, and its number."""
    moves = (model.stiffness.direction >= 1) & (model.stiffness.direction <= 3)
    node, inverse = np.unique(model.stiffness.node[moves], return_inverse=True)
    if node.size == 0:
        return 0.0, 0
    length = np.sqrt(np.bincount(inverse, displacement[moves] ** 2))
    first = inverse[np.argmax(length[inverse])]
    return float(length[first]), int(node[first])


# ---- displacements and pictures


def _field_table(model: _Model) -> Table:
    """A line for each row of the matrix, a column for each case."""
    columns = [Column("node", model.stiffness.node), Column("direction", model.stiffness.direction)]
    for k, case in enumerate(model.cases, 1):
        nothing = np.full(model.stiffness.node.size, np.nan)
        columns.append(Column(f"displacement {k}", nothing if case.displacement is None else case.displacement, 25))
    return Table(columns)


def _drawn_mesh(given: Options) -> fuge.Mesh:
    """The mesh of --mesh, or of a deck of Abaqus or CalculiX, without its springs and masses."""
    try:
        mesh = fuge.read_mesh(given.file("mesh") or given.file("deck"))
    except Error:
        if given.has("mesh"):
            raise
        field = given.file("field")
        reason = "needs --mesh, an input file of Abaqus or CalculiX with the nodes and elements"
        raise UsageError(f"--field {field} {reason}") from None
    types = [mesh.element_type(k) for k in range(mesh.element.size)]
    kept = [k for k, word in enumerate(types) if not word.startswith(_NOT_DRAWN)]
    sizes = np.diff(mesh.first)[kept]
    nodes = np.full((len(kept), sizes.max(initial=1)), -1, dtype=np.intc)
    for row, k in enumerate(kept):
        nodes[row, : sizes[row]] = mesh.connection[mesh.first[k] : mesh.first[k + 1]]
    drawn = fuge.Mesh.from_arrays(mesh.position, nodes, [types[k] for k in kept])
    drawn.node = mesh.node
    return drawn


def _node_fields(model: _Model, mesh: fuge.Mesh) -> dict[str, Array]:
    """Displacements of all nodes of the mesh in the cases that are solved."""
    places = {number: place for place, number in enumerate(mesh.node.tolist())}
    place = np.array([places.get(number, -1) for number in model.stiffness.node.tolist()])
    axis = model.stiffness.direction - 1
    rows = np.flatnonzero((place >= 0) & (axis >= 0) & (axis < 3))
    fields = {}
    for k, case in enumerate(model.cases, 1):
        if case.displacement is not None:
            vectors = fields[f"displacement {k}, {case.name}"] = np.zeros((mesh.node.size, 3))
            vectors[place[rows], axis[rows]] = case.displacement[rows]
    return fields


def _draw(model: _Model, axes: Any) -> None:
    """The envelope of the forces."""
    envelope = fuge.envelope(model.force)
    places = np.arange(envelope.largest.size)
    axes.bar(places, envelope.largest - envelope.smallest, bottom=envelope.smallest)
    axes.set_xticks(places, model.deck.link_names, rotation=90)
    axes.set_ylabel("force, smallest to largest of all cases")
