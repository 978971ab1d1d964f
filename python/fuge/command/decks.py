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
            write_lines(path, _by_rows(model, "displacement", cases.displacement).lines())
        else:
            mesh.write(path, _node_fields(model, cases, mesh))

    table = _table(model, cases, given.has("long"))
    table.comments = [line for k in range(len(cases)) for line in _case_comments(model, cases, k)]
    reactions = _by_rows(model, "reaction", cases.reaction, held)
    reactions.columns += _envelope("reaction", cases.reaction)
    reactions.comments = [f"case {k}: {name}" for k, name in enumerate(cases.names, 1)]
    return Outcome(table, write_field, lambda axes: _draw(cases, axes), reactions, failure)


def _read(given: Options, log: Log) -> _Model:
    with caught() as warned:
        deck = fuge.read_deck(given.file("deck")) if given.has("deck") else fuge.Deck()
    for warning in warned:
        log.warn(warning.message)
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
    links, loads, names = deck.links(stiffness), deck.loads(stiffness), np.array(deck.case_names, dtype=object)
    given_supports = (deck.supports(k, stiffness) for k in range(len(names)))
    supports = [dict(zip(rows.tolist(), moved.tolist())) for rows, moved in given_supports]
    held = np.array(sorted(set().union(*supports)), dtype=np.intp)
    body = fuge.Body(stiffness)
    body.find_rigid_modes()
    body.set_links(links)
    shape = len(names), links.count
    info, message, proof = (np.full(len(names), nothing, dtype=object) for nothing in (_NO_INFO, "", None))
    state, status = np.zeros(shape, dtype=np.intc), np.zeros(len(names), dtype=np.intc)
    force, gap = np.full(shape, np.nan), np.full(shape, np.nan)
    displacement, reaction = np.full(loads.shape, np.nan), np.full((len(names), held.size), np.nan)
    for fixed in dict.fromkeys(tuple(sorted(each)) for each in supports):
        members = np.array([k for k, each in enumerate(supports) if each.keys() == set(fixed)])
        moved = np.array([[supports[k][row] for row in fixed] for k in members])
        body.fix(np.array(fixed, dtype=np.intc))
        try:
            found, remarks = _solve_group(body, loads[members], moved, names[members].tolist(), given, log)
        except Error as failure:
            status[members], message[members] = failure.status, _words(failure.message)
            continue
        force[members], gap[members], state[members] = found.force, found.gap, found.state
        displacement[members] = found.displacement
        reaction[np.ix_(members, np.searchsorted(held, fixed))] = found.reaction
        for j, k in enumerate(members):
            info[k], proof[k] = found.info[j], found.proof[j] if found.proof else None
            status[k], message[k] = _report(Status(found.status[j]), found.message[j], proof[k], remarks)
    cases = fuge.Cases(
        force, gap, np.empty((len(names), 0)), state, status, tuple(info), tuple(message), displacement, reaction,
        tuple(names), tuple(deck.link_names), proof=tuple(proof) if any(proof) else (),
    )
    return cases, held


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


def _report(
    status: Status, message: str, proof: fuge.Proof | None, remarks: list[fuge.Warning]
) -> tuple[Status, str]:
    """Status and message of a case: its own, or those of all cases with these supports, or that of its proof."""
    told = [(status, message), *((warning.status, warning.message) for warning in remarks)]
    if proof is not None:
        told.append((Status.DONE if proof.bounded else Status.WARN_NOT_PROVED, proof.message))
    status, message = next((each for each in told if each[0] != Status.DONE), max(told, key=lambda each: bool(each[1])))
    return status, _words(message)


def _words(message: str) -> str:
    """A message of the package without numbers of rows, which nodes name, and without advice on Python."""
    message = message.partition("; Body.mechanism")[0]
    return re.sub(r"degree of freedom \d+ \((node \d+, direction \d+)\)", r"\1", message)


# ---- tables


def _table(model: _Model, cases: fuge.Cases, long: bool) -> Table:
    """A line for each link in each case, or for each link, with columns for each case, and the envelope."""
    deck, found = model.deck, cases.table()
    words = found["state"]
    acts = np.isin(words, ("failed", "limited")) | np.tile(deck.play > 0.0, len(cases))
    found["state"] = np.where(acts, words, "held")
    if cases.proof:
        nothing = np.zeros(len(cases.links), dtype=bool)
        proved = [nothing if proof is None else proof.proved for proof in cases.proof]
        found["proved"] = np.where(np.concatenate(proved), "yes", "no")
    if long:
        return Table([Column(name, values, 25) for name, values in found.items()])
    columns = [Column("element", deck.link_names), Column("node_a", deck.node_a), Column("node_b", deck.node_b)]
    of_cases = {name: values.reshape(len(cases), -1) for name, values in found.items() if name not in ("case", "link")}
    columns += [Column(f"{name} {k + 1}", of_cases[name][k], 25) for k in range(len(cases)) for name in of_cases]
    return Table(columns + _envelope("force", cases.force))


def _envelope(name: str, values: Any) -> list[Column]:
    """The smallest and the largest value of all cases, (cases, ..), and the cases that have them."""
    found = fuge.envelope(values)
    columns = []
    for end in ("smallest", "largest"):
        numbers = [k + 1 if k >= 0 else "" for k in getattr(found, f"{end}_case").tolist()]
        columns += [Column(f"{end} {name}", getattr(found, end), 25), Column(f"{end} in case", numbers)]
    return columns


def _by_rows(model: _Model, name: str, values: Any, rows: Any = slice(None)) -> Table:
    """A line for each of these rows of the matrix, a column for each case."""
    node, direction = model.stiffness.node[rows], model.stiffness.direction[rows]
    columns = [Column(f"{name} {k}", of_case, 25) for k, of_case in enumerate(values, 1)]
    return Table([Column("node", node), Column("direction", direction), *columns])


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
