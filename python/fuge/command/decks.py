"""Structures with one-way links: from the deck and the stiffness matrix to the table of all load cases."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import fuge
from fuge.command.checks import check_input
from fuge.command.errors import CommandError, UsageError
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
class _Model:
    """What the deck, its tables and the stiffness matrix have."""

    deck: fuge.Deck
    stiffness: fuge.StiffnessFile

    def named(self, message: str) -> str:
        """A message of the library with names of links, and nodes with their directions, instead of numbers."""
        links, stiffness = self.deck.link_names, self.stiffness
        message = re.sub(r"\bcontact point (\d+)", lambda match: links[int(match[1])], message)
        return re.sub(r"\bdegree of freedom (\d+)", lambda match: self.dof_words(int(match[1])), message)

    def dof_words(self, row: int) -> str:
        return f"node {self.stiffness.node[row]}, direction {self.stiffness.direction[row]}"


@dataclass
class _Results:
    """A row for each case; those of cases that failed are NaN."""

    force: Array
    gap: Array
    state: NDArray[np.intc]
    displacement: Array
    status: list[Status]
    message: list[str]
    info: list[Any]


def solve_deck(given: Options, log: Log) -> Outcome:
    """--deck, --links. Where cases fail, the outcome has the others, and the first failure."""
    model = _read(given, log)
    draws_mesh = given.file("field")[-4:].lower() == ".vtu"
    mesh = _drawn_mesh(given) if draws_mesh else None
    results = _solve_cases(model, log)
    names = model.deck.case_names
    for name, status, message in zip(names, results.status, results.message):
        if status > 0:
            log.warn(f"{name}: {message}")
    failed = [k for k, status in enumerate(results.status) if status < 0]
    failure = ""
    if failed:
        first = failed[0]
        failure = f"{len(failed)} of {len(names)} load cases failed; {names[first]}: {results.message[first]}"

    def write_field(path: str) -> None:
        if mesh is None:
            write_lines(path, _field_table(model, results).lines())
        else:
            mesh.write(path, _node_fields(model, results, mesh))

    table = (_long_table if given.has("long") else _table)(model, results)
    table.comments = [line for k in range(len(names)) for line in _case_comments(model, results, k)]
    return Outcome(table, write_field, lambda axes: _draw(model, results, axes), failure=failure)


# ---- what is read


def _read(given: Options, log: Log) -> _Model:
    deck = fuge.read_deck(given.file("deck")) if given.has("deck") else fuge.Deck()
    for option, read in (("links", deck.read_links), ("supports", deck.read_supports), ("cases", deck.read_cases)):
        if given.has(option):
            read(given.file(option))
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
    return _Model(deck, stiffness)


# ---- load cases


def _solve_cases(model: _Model, log: Log) -> _Results:
    """All cases; those that hold the same rows share one condensation, and one that fails does not harm the others."""
    deck, stiffness = model.deck, model.stiffness
    cases, shape = len(deck.case_names), (len(deck.case_names), len(deck.link_names))
    links, loads = deck.links(stiffness), deck.loads(stiffness)
    supports = [deck.supports(k, stiffness) for k in range(cases)]
    groups: dict[bytes, list[int]] = {}
    for k, (dof, _) in enumerate(supports):
        groups.setdefault(np.sort(dof).tobytes(), []).append(k)
    results = _Results(
        np.full(shape, np.nan), np.full(shape, np.nan), np.zeros(shape, dtype=np.intc),
        np.full(loads.shape, np.nan), [Status.DONE] * cases, [""] * cases, [None] * cases,
    )
    body = fuge.Body(stored(stiffness))
    body.find_rigid_modes()
    body.set_links(links)
    solved = 0
    for members in groups.values():
        dof = np.sort(supports[members[0]][0])
        moved = np.array([supports[k][1][np.argsort(supports[k][0])] for k in members])
        body.fix(dof)
        try:
            _solve_group(model, body, links, loads, members, moved, results)
        except Error as failure:
            for k in members:
                results.status[k], results.message[k] = failure.status, model.named(failure.message)
        solved += len(members)
        log.say(f"{solved} load cases are solved")
    return results


def _solve_group(
    model: _Model, body: fuge.Body, links: fuge.Links, loads: Array, members: list[int], moved: Array, results: _Results
) -> None:
    with caught() as condensation:
        body.condense()
        cases = body.solve_cases(loads[members], supports=moved)
    for j, k in enumerate(members):
        results.force[k], results.gap[k], results.state[k] = cases.force[j], cases.gap[j], cases.state[j]
        results.displacement[k] = np.nan if cases.displacement is None else cases.displacement[j]
        results.status[k], results.info[k] = Status(cases.status[j]), cases.info[j]
        results.message[k] = model.named(cases.message[j])
        if results.status[k] == Status.ERR_NO_EQUILIBRIUM:
            body.set_load(loads[k])
            results.message[k] = _mechanism(model, body, links) or results.message[k]
        for warning in condensation:
            if results.status[k] == Status.DONE and warning.status not in (Status.DONE, Status.WARN_CASES):
                results.status[k], results.message[k] = warning.status, model.named(warning.message)


def _mechanism(model: _Model, body: fuge.Body, links: fuge.Links) -> str:
    """Which links open, and which node moves most, where no link resists the load; empty if that is not known."""
    try:
        motion = body.mechanism()
    except Error:
        return ""
    if not motion.any():
        return ""
    words = links.describe(motion, np.zeros((0, 3)), np.zeros((0, 3), dtype=np.intc))
    row = int(np.abs(motion).argmax())
    node, direction = model.stiffness.node[row], model.stiffness.direction[row]
    moves = f"node {node} moves most, in direction {direction}"
    return f"nothing holds the structure against these loads: {words}; {moves}"


# ---- tables


def _states(model: _Model, results: _Results, k: int) -> NDArray[np.str_]:
    """What the links do in case k."""
    state = results.state[k]
    if results.status[k] < 0:
        return np.full(state.shape, "failed")
    limited = (state == _State.LIMITED_LOWER) | (state == _State.LIMITED_UPPER)
    chosen = [limited, ~(model.deck.play > 0.0), state == _State.AT_LOWER_STOP, state == _State.AT_UPPER_STOP]
    return np.select(chosen, ["limited", "held", "contact", "upper"], "open")


def _table(model: _Model, results: _Results) -> Table:
    """A line for each link, columns for each case, and the envelope."""
    deck = model.deck
    columns = [Column("element", deck.link_names), Column("node_a", deck.node_a), Column("node_b", deck.node_b)]
    for k in range(len(deck.case_names)):
        columns += [Column(f"force {k + 1}", results.force[k], 25), Column(f"gap {k + 1}", results.gap[k], 25)]
        columns.append(Column(f"state {k + 1}", _states(model, results, k)))
    envelope = fuge.envelope(results.force)
    for word in ("smallest", "largest"):
        case = getattr(envelope, f"{word}_case").tolist()
        columns.append(Column(f"{word} force", getattr(envelope, word), 25))
        columns.append(Column(f"{word} in case", [number + 1 if number >= 0 else "" for number in case]))
    return Table(columns)


def _long_table(model: _Model, results: _Results) -> Table:
    """A line for each link in each case."""
    names, links = model.deck.case_names, model.deck.link_names
    states = np.concatenate([_states(model, results, k) for k in range(len(names))])
    return Table(
        [
            Column("case", np.repeat(names, len(links))),
            Column("link", np.tile(links, len(names))),
            Column("force", results.force.ravel(), 25),
            Column("gap", results.gap.ravel(), 25),
            Column("state", states),
        ]
    )


def _case_comments(model: _Model, results: _Results, k: int) -> list[str]:
    info, status = results.info[k], results.status[k]
    comments = [f"case {k + 1}: {model.deck.case_names[k]}"]
    residual = 0.0 if info is None else info.residual
    if status < 0:
        return comments + outcome_comments(status, results.message[k], residual)
    largest, node = _largest(model, results.displacement[k])
    comments += outcome_comments(status, results.message[k], residual, info.contacts)
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


def _field_table(model: _Model, results: _Results) -> Table:
    """A line for each row of the matrix, a column for each case."""
    columns = [Column("node", model.stiffness.node), Column("direction", model.stiffness.direction)]
    for k, displacement in enumerate(results.displacement, 1):
        columns.append(Column(f"displacement {k}", displacement, 25))
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


def _node_fields(model: _Model, results: _Results, mesh: fuge.Mesh) -> dict[str, Array]:
    """Displacements of all nodes of the mesh in the cases that are solved."""
    places = {number: place for place, number in enumerate(mesh.node.tolist())}
    place = np.array([places.get(number, -1) for number in model.stiffness.node.tolist()])
    axis = model.stiffness.direction - 1
    rows = np.flatnonzero((place >= 0) & (axis >= 0) & (axis < 3))
    fields = {}
    for k, name in enumerate(model.deck.case_names):
        if results.status[k] >= 0:
            field = fields[f"displacement {k + 1}, {name}"] = np.zeros((mesh.node.size, 3))
            field[place[rows], axis[rows]] = results.displacement[k, rows]
    return fields


def _draw(model: _Model, results: _Results, axes: Any) -> None:
    """The envelope of the forces."""
    envelope = fuge.envelope(results.force)
    places = np.arange(envelope.largest.size)
    axes.bar(places, envelope.largest - envelope.smallest, bottom=envelope.smallest)
    axes.set_xticks(places, model.deck.link_names, rotation=90)
    axes.set_ylabel("force, smallest to largest of all cases")
