"""Structures with one-way links: from the deck and the stiffness matrix to the table of all load cases."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any, NamedTuple

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

# Types of elements that have no cell in a picture, by the letters that they begin with.
_NOT_DRAWN = ("GAP", "SPRING", "DASHPOT", "MASS", "ROTARYI", "CONN", "DCOUP", "DGAP")

_NO_INFO = fuge.Info(Status.DONE, 0, 0, 0, 0, 0.0, 0.0, 0.0)


class _Model(NamedTuple):
    """What the deck, its tables and the stiffness matrix have."""

    deck: fuge.Deck
    stiffness: fuge.StiffnessFile


def solve_deck(given: Options, log: Log) -> Outcome:
    """--deck, --links. Where cases fail, the outcome has the others, and the first failure."""
    model = _read(given, log)
    mesh = _drawn_mesh(given) if given.file("field")[-4:].lower() == ".vtu" else None
    cases, held = _solve_cases(model, given, log)
    told = [f"{name}: {message}" for name, message in zip(cases.names, cases.message)]
    for k in np.flatnonzero(cases.status > 0):
        log.warn(told[k])
    failed = np.flatnonzero(cases.status < 0)
    failure = f"{failed.size} of {len(cases)} load cases failed; {told[failed[0]]}" if failed.size else ""

    def write_field(path: str) -> None:
        if mesh is None:
            write_lines(path, _field_table(model, cases).lines())
        else:
            mesh.write(path, _node_fields(model, cases, mesh))

    table = _long_table(model, cases) if given.has("long") else _table(model, cases)
    table.comments = [line for k in range(len(cases)) for line in _case_comments(model, cases, k)]
    return Outcome(table, write_field, lambda axes: _draw(cases, axes), _reactions(model, cases, held), failure)


def _read(given: Options, log: Log) -> _Model:
    deck = fuge.read_deck(given.file("deck")) if given.has("deck") else fuge.Deck()
    for option in ("links", "supports", "cases"):
        if given.has(option):
            getattr(deck, f"read_{option}")(given.file(option))
    for path in deck.paths:
        check_input(given, path, "the same file as of --deck or of one that it includes")
    if not deck.link_names:
        has = "the deck has no CGAP, no CBUSH1D with a table, and no GAPUNI"
        raise UsageError(f"no one-way link: {has}, and --links gives none")
    if not deck.case_names:
        has = "the deck has no SUBCASE, no only load set and no static *STEP"
        raise UsageError(f"no load case: {has}, and --cases gives none")
    log.say(f"deck: {len(deck.link_names)} one-way links, {len(deck.case_names)} load cases")
    path, name = given.file("stiffness"), given.first("matrix").value if given.has("matrix") else None
    stiffness = fuge.read_stiffness(path, names_path=given.file("rows") or None, name=name)
    log.say(f"stiffness matrix of {stiffness.node.size} rows is read")
    if not stiffness.node.any():
        raise UsageError(f'"{path}" has rows without names: give the node and the direction of each by --rows')
    return _Model(deck, stiffness)


# ---- load cases


def _solve_cases(model: _Model, given: Options, log: Log) -> tuple[fuge.Cases, NDArray[np.intp]]:
    """All cases, with the reactions at all rows that a case holds; one that fails harms no other."""
    deck, stiffness = model
    links, loads, names = deck.links(stiffness), deck.loads(stiffness), tuple(deck.case_names)
    supports = [_held(deck, k, stiffness) for k in range(len(names))]
    held = np.array(sorted(set().union(*supports)), dtype=np.intp)
    body = fuge.Body(stored(stiffness))
    body.find_rigid_modes()
    body.set_links(links)
    force, gap = (np.full((len(names), links.count), np.nan) for _ in range(2))
    displacement, reaction = np.full(loads.shape, np.nan), np.full((len(names), held.size), np.nan)
    state, status = np.zeros(force.shape, dtype=np.intc), np.zeros(len(names), dtype=np.intc)
    message, info = [""] * len(names), [_NO_INFO] * len(names)
    proof: list[fuge.Proof | None] = [None] * len(names)
    for fixed in dict.fromkeys(tuple(sorted(each)) for each in supports):
        members = [k for k, each in enumerate(supports) if tuple(sorted(each)) == fixed]
        moved = np.array([[supports[k][row] for row in fixed] for k in members])
        body.fix(np.array(fixed, dtype=np.intc))
        try:
            found, remarks = _solve_group(body, loads[members], moved, [names[k] for k in members], given, log)
        except Error as failure:
            status[members] = failure.status
            for k in members:
                message[k] = _words(failure.message)
            continue
        force[members], gap[members], state[members] = found.force, found.gap, found.state
        displacement[members] = found.displacement
        reaction[np.ix_(np.array(members), np.searchsorted(held, fixed))] = found.reaction
        for j, k in enumerate(members):
            info[k], proof[k] = found.info[j], found.proof[j] if found.proof else None
            status[k], message[k] = _report(found, j, remarks)
    cases = fuge.Cases(
        force, gap, np.empty((len(names), 0)), state, status, tuple(info), tuple(message), displacement, reaction,
        names, tuple(deck.link_names), proof=tuple(proof),
    )
    return cases, held


def _held(deck: fuge.Deck, case: int, stiffness: fuge.StiffnessFile) -> dict[int, float]:
    """Rows that a case holds, and their displacements."""
    rows, displacement = deck.supports(case, stiffness)
    return dict(zip(rows.tolist(), displacement.tolist()))


def _solve_group(
    body: fuge.Body, loads: Array, moved: Array, names: list[str], given: Options, log: Log
) -> tuple[fuge.Cases, list[fuge.Warning]]:
    """Cases with the same supports, which share a condensation, and what is said of all of them."""
    with caught() as condensation:
        body.condense()
    with caught() as warned:
        found = body.solve_cases(loads, supports=moved, names=names, prove=given.has("prove"))
    # Other warnings are those of single cases, which have them in their reports.
    idle = [warning for warning in warned if warning.status == Status.DONE]
    for warning in idle:
        log.warn(warning.message)
    log.say(f"{len(names)} load cases with the same supports are solved")
    return found, condensation + idle


def _report(found: fuge.Cases, j: int, remarks: list[fuge.Warning]) -> tuple[Status, str]:
    """Status and message of a case: its own, or those of all cases with these supports, or that of its proof."""
    told = [(Status(found.status[j]), found.message[j]), *((warning.status, warning.message) for warning in remarks)]
    proof = found.proof[j] if found.proof else None
    if proof is not None:
        told.append((Status.DONE if proof.bounded else Status.WARN_NOT_PROVED, proof.message))
    status, message = next((each for each in told if each[0] != Status.DONE), max(told, key=lambda each: bool(each[1])))
    return status, _words(message)


def _words(message: str) -> str:
    """A message of the package without numbers of rows, which nodes name, and without advice on Python."""
    message = message.partition("; Body.mechanism")[0]
    return re.sub(r"degree of freedom \d+ \((node \d+, direction \d+)\)", r"\1", message)


# ---- tables


def _table(model: _Model, cases: fuge.Cases) -> Table:
    """A line for each link, columns for each case, and the envelope."""
    deck = model.deck
    columns = [Column("element", deck.link_names), Column("node_a", deck.node_a), Column("node_b", deck.node_b)]
    for k in range(len(cases)):
        columns += [replace(column, name=f"{column.name} {k + 1}") for column in _case_columns(model, cases, k)]
    return Table(columns + _envelope("force", cases.force))


def _long_table(model: _Model, cases: fuge.Cases) -> Table:
    """A line for each link in each case."""
    parts = zip(*(_case_columns(model, cases, k) for k in range(len(cases))))
    columns = [replace(part[0], values=np.concatenate([column.values for column in part])) for part in parts]
    names, links = np.repeat(cases.names, len(cases.links)), cases.links * len(cases)
    return Table([Column("case", names), Column("link", links), *columns])


def _case_columns(model: _Model, cases: fuge.Cases, k: int) -> list[Column]:
    """What the links do in case k."""
    state, words = cases.state[k], fuge.PointState
    if cases.status[k] < 0:
        states = np.full(state.shape, "failed")
    else:
        limited = (state == words.LIMITED_LOWER) | (state == words.LIMITED_UPPER)
        chosen = [limited, ~(model.deck.play > 0.0), state == words.AT_LOWER_STOP, state == words.AT_UPPER_STOP]
        states = np.select(chosen, ["limited", "held", "contact", "upper"], "open")
    columns = [Column("force", cases.force[k], 25), Column("gap", cases.gap[k], 25), Column("state", states)]
    proof, nothing = cases.proof[k], np.full(state.shape, np.nan)
    if any(cases.proof):
        force_bound, gap_bound = (nothing, nothing) if proof is None else (proof.force_bound, proof.gap_bound)
        proved = np.where(nothing == 0.0 if proof is None else proof.proved, "yes", "no")
        columns += [Column("force_bound", force_bound, 25), Column("gap_bound", gap_bound, 25)]
        columns.append(Column("proved", proved))
    return columns


def _envelope(name: str, values: Array) -> list[Column]:
    """The smallest and the largest value of all cases, (cases, ..), and the cases that have them."""
    found = fuge.envelope(values)
    columns = []
    for end in ("smallest", "largest"):
        numbers = [k + 1 if k >= 0 else "" for k in getattr(found, f"{end}_case").tolist()]
        columns += [Column(f"{end} {name}", getattr(found, end), 25), Column(f"{end} in case", numbers)]
    return columns


def _reactions(model: _Model, cases: fuge.Cases, held: NDArray[np.intp]) -> Table:
    """Forces of the supports on the structure: a line for each row that a case holds."""
    assert cases.reaction is not None
    rows = [Column("node", model.stiffness.node[held]), Column("direction", model.stiffness.direction[held])]
    columns = [Column(f"reaction {k}", row, 25) for k, row in enumerate(cases.reaction, 1)]
    comments = [f"case {k}: {name}" for k, name in enumerate(cases.names, 1)]
    return Table(rows + columns + _envelope("reaction", cases.reaction), comments)


def _case_comments(model: _Model, cases: fuge.Cases, k: int) -> list[str]:
    assert cases.displacement is not None
    status, info = Status(cases.status[k]), cases.info[k]
    contacts = None if status < 0 else info.contacts
    comments = [f"case {k + 1}: {cases.names[k]}", *outcome_comments(status, cases.message[k], info.residual, contacts)]
    if status < 0:
        return comments
    # Rotations are left out.
    moves = (model.stiffness.direction >= 1) & (model.stiffness.direction <= 3)
    nodes, place = np.unique(model.stiffness.node[moves], return_inverse=True)
    length = np.sqrt(np.bincount(place, cases.displacement[k, moves] ** 2, minlength=1))
    first = place[np.argmax(length[place])] if nodes.size else 0
    node = nodes[first] if nodes.size else 0
    return [*comments, f"largest displacement: {short_text(length[first])} of node {node}"]


# ---- displacements and pictures


def _field_table(model: _Model, cases: fuge.Cases) -> Table:
    """A line for each row of the matrix, a column for each case."""
    assert cases.displacement is not None
    columns = [Column("node", model.stiffness.node), Column("direction", model.stiffness.direction)]
    return Table(columns + [Column(f"displacement {k}", u, 25) for k, u in enumerate(cases.displacement, 1)])


def _drawn_mesh(given: Options) -> fuge.Mesh:
    """The mesh of --mesh, or of a deck of Abaqus or CalculiX, without its springs and masses."""
    try:
        mesh = fuge.read_mesh(given.file("mesh") or given.file("deck"))
    except Error:
        if given.has("mesh"):
            raise
        reason = "needs --mesh, an input file of Abaqus or CalculiX with the nodes and elements"
        raise UsageError(f"--field {given.file('field')} {reason}") from None
    kept = np.array([not word.startswith(_NOT_DRAWN) for word in mesh.element_types.tolist()], dtype=bool)
    counts = np.diff(mesh.first)
    return replace(
        mesh,
        element=mesh.element[kept],
        element_types=mesh.element_types[kept],
        first=np.append(0, np.cumsum(counts[kept])).astype(np.intc),
        connection=mesh.connection[np.repeat(kept, counts)],
        elements_of_sets={},
        faces_of_surfaces={},
    )


def _node_fields(model: _Model, cases: fuge.Cases, mesh: fuge.Mesh) -> dict[str, Array]:
    """Displacements of all nodes of the mesh in the cases that are solved."""
    assert cases.displacement is not None
    places = {number: place for place, number in enumerate(mesh.node.tolist())}
    place = np.array([places.get(number, -1) for number in model.stiffness.node.tolist()])
    axis = model.stiffness.direction - 1
    rows = np.flatnonzero((place >= 0) & (axis >= 0) & (axis < 3))
    fields = {}
    for k in np.flatnonzero(cases.status >= 0):
        field = fields[f"displacement {k + 1}, {cases.names[k]}"] = np.zeros((mesh.node.size, 3))
        field[place[rows], axis[rows]] = cases.displacement[k, rows]
    return fields


def _draw(cases: fuge.Cases, axes: Any) -> None:
    """The envelope of the forces."""
    found = fuge.envelope(cases.force)
    places = np.arange(found.largest.size)
    axes.bar(places, found.largest - found.smallest, bottom=found.smallest)
    axes.set_xticks(places, cases.links, rotation=90)
    axes.set_ylabel("force, smallest to largest of all cases")
