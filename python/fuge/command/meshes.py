"""Contact of bodies with meshes: from the files to forces and displacements."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fuge.bodies import ElasticBodies
from fuge.body import Body
from fuge.columns import CompressedColumns
from fuge.command.errors import CommandError, UsageError
from fuge.command.matrices import solve_contact, stored
from fuge.command.mesh_bodies import read_model
from fuge.command.mesh_loads import take_conditions
from fuge.command.mesh_model import MeshModel
from fuge.command.mesh_pairs import MeshPair, read_pairs
from fuge.command.mesh_results import Points, check_field, outcome
from fuge.command.options import Options
from fuge.command.run import Log, Outcome, Report, caught
from fuge.errors import EquilibriumError, Error, Status, Warning
from fuge.pairs import ContactPairs
from fuge.solver import Solver

# Factors of free degrees of freedom below this fraction of the largest one are rounding, as in the library.
_NO_FACTOR = 1e-10
# The same of displacements, beside the largest one.
_NO_MOTION = 1e-6

_OPENS = (
    "no point touches, and loads and supports open every gap: if they press, the surfaces of each pair look into their "
    "bodies: reverse the order of the nodes of all their faces"
)

# Numbers in messages: of a pair and its bodies, of bodies, and of other things.
_PAIR = re.compile(r"\bpair (\d+)(?:, contact (?:body \d+|rigid), opposite (?:body \d+|rigid))?")
_BODY = re.compile(r"\bbody (\d+)")
_NUMBERED = re.compile(r"\b(degree of freedom|nodes?|faces?) (\d+)(?: and (\d+))?\b(?!\.\d)")


def solve_meshes(given: Options, log: Log) -> Outcome:
    """--mesh and --pair."""
    model = read_model(given, log)
    check_field(given, model)
    pairs = read_pairs(given, model)
    take_conditions(given, model)
    with _named(model, pairs) as joining:
        stiffness = _join(model, pairs)
    points = _points(model, pairs)
    log.say(f"{points.gap.size} contact points, {len(points.unpaired)} nodes without an opposite")
    points = points._replace(excluded=_excluded(given, model, points))
    body = _body(model, stiffness, points)
    with _named(model, pairs) as condensation:
        condensed = body.condense()
    log.say(f"{body.degrees} degrees of freedom are condensed, {condensed.resultant.size} rigid motions")
    report = Report(log)
    with Solver(condensed.influence, threads=given.threads(), progress=log.progress) as solver:
        solver.set_gap(points.gap + condensed.displacement, points.play)
        solver.set_modes(condensed.modes, condensed.resultant)
        solver.set_excluded(points.excluded)
        try:
            contact, _ = solve_contact(given, solver, report)
        except EquilibriumError as failure:
            raise _moving(failure, model, body, *condensed.modes.shape) from None
    with _named(model, pairs) as recovery:
        displacement = body.recover(contact.force, contact.motion)
    log.say("displacements are found")
    for warning in (*condensation, *recovery, *joining):
        report.take(warning.status, _in_names(warning.message, model, pairs))
    largest = abs(displacement).max()
    if largest > 0.0 and not contact.force.any() and (contact.gap - points.gap).min() > _NO_MOTION * largest:
        report.take(Status.WARN_NO_CONTACT, _OPENS)
    return outcome(model, pairs, points, contact, displacement, report)


def _join(model: MeshModel, pairs: Sequence[MeshPair]) -> CompressedColumns:
    """The stiffness of all bodies; the library checks them, and on which side of its surfaces each lies."""
    numbers: dict[str, int] = {}
    with ElasticBodies() as together:
        for body in model.elastic:
            here = slice(body.rows_before, body.rows_before + body.rows)
            held = np.flatnonzero(model.held[here])
            numbers[body.name] = together.add(body.stiffness)
            together.fix(numbers[body.name], held, model.displacement[here][held])
            together.set_load(numbers[body.name], model.load[here])
        for pair in pairs:
            sides: list[Any] = []
            for faces, surface in zip(pair.faces, pair.surfaces):
                body, dof = faces.body, surface.dof
                if dof is not None:
                    own = np.asarray(dof) - body.rows_before
                    dof = np.where((own >= 0) & (own < body.rows), own, -1)
                sides += [numbers.get(body.name), replace(surface, dof=dof)]
            together.add_pair(*sides, **pair.options)
        joined = together.join()
    return joined.stiffness


def _points(model: MeshModel, pairs: Sequence[MeshPair]) -> Points:
    """The contact points of all pairs, without those that supports hold on both sides."""
    found = ContactPairs()
    with caught():
        for pair in pairs:
            found.find(*pair.surfaces, **pair.options)
    size = abs(found.normal)
    moves = (found.dof >= 0) & ~model.held[found.dof] & (size > _NO_FACTOR * size.max(axis=1, keepdims=True))
    kept = np.flatnonzero(moves.any(axis=1))
    kept = kept[np.lexsort((model.number[found.node[kept]], found.pair[kept]))]
    gap = found.gap + np.array([pair.clearance for pair in pairs])[found.pair]
    arrays = (found.pair, found.node, found.direction, found.dof, found.normal, found.area, gap)
    points = Points(*(array[kept] for array in arrays), unpaired=found.unpaired)
    play = found.gap_upper[kept]
    return points._replace(play=play) if np.isfinite(play).any() else points


def _excluded(given: Options, model: MeshModel, points: Points) -> NDArray[np.bool_] | None:
    """The points at the nodes that --exclude names; None without the option."""
    excluded = np.zeros(points.gap.size, dtype=bool)
    for setting in given.all("exclude"):
        named = np.isin(points.node, model.find_nodes(setting.value, setting.refuse))
        if not named.any():
            raise setting.refuse("no node there is a contact point, a node of the first surface of a pair")
        excluded |= named
    if excluded.all():
        raise UsageError("--exclude leaves no contact point")
    return excluded if excluded.any() else None


def _body(model: MeshModel, stiffness: CompressedColumns, points: Points) -> Body:
    """All bodies with their supports, loads and contact points; motions that supports leave are found."""
    matrix = stored(stiffness)
    body = Body(matrix + np.triu(matrix, 1).T if isinstance(matrix, np.ndarray) else matrix)
    held = np.flatnonzero(model.held)
    body.fix(held, model.displacement[held])
    body.set_load(model.load)
    body.find_rigid_modes()
    body.set_contact(points.dof, points.normal)
    return body


# ---- messages


@contextmanager
def _named(model: MeshModel, pairs: Sequence[MeshPair]) -> Iterator[list[Warning]]:
    """Warnings of the library, and its errors in the words of the files."""
    try:
        with caught() as warned:
            yield warned
    except Error as failure:
        raise CommandError(_in_names(failure.message, model, pairs), failure.status) from None


def _in_names(message: str, model: MeshModel, pairs: Sequence[MeshPair]) -> str:
    """A message with pairs as they are given, names of bodies, and nodes for degrees of freedom.

    Degrees of freedom are those of the body that the message names, or else of all.
    """
    named = _BODY.search(message)
    before = model.elastic[int(named[1])].rows_before if named else 0

    def numbered(match: re.Match[str]) -> str:
        word, numbers = match[1], [int(text) for text in match.groups()[1:] if text]
        if word == "degree of freedom":
            return model.row_name(before + numbers[0])
        names = [model.node_name(k) if word.startswith("node") else str(k + 1) for k in numbers]
        return f"{word} {' and '.join(names)}"

    message = _NUMBERED.sub(numbered, message)
    message = _PAIR.sub(lambda match: pairs[int(match[1])].source.source, message)
    return _BODY.sub(lambda match: f"body {model.elastic[int(match[1])].name}", message)


def _moving(failure: EquilibriumError, model: MeshModel, body: Body, n: int, motions: int) -> Error:
    """The error with a body and how it moves, instead of the number of the motion without equilibrium."""
    number = re.search(r"\bmotion (\d+)", failure.message)
    if number is None:
        return failure
    force = np.zeros(n)
    with caught():
        moved = body.recover(force, np.eye(motions)[int(number[1])]) - body.recover(force, np.zeros(motions))
    owner = model.row_body[abs(moved).argmax()]
    reason = "its loads move it that way without closing a contact, so that no contact forces can balance them"
    how = _motion_words([moved[(model.row_body == owner) & (model.row_direction == k + 1)] for k in range(3)])
    remedy = "hold it by --support, or turn the loads"
    return CommandError(f"body {model.bodies[owner].name}, {how}: {reason}: {remedy}", failure.status)


def _motion_words(moved: Sequence[NDArray[np.float64]]) -> str:
    """What a rigid motion is, by the displacements along each axis."""
    limit = _NO_MOTION * max(abs(rows).max(initial=0.0) for rows in moved)
    if any(np.ptp(rows) > limit for rows in moved if rows.size):
        return "a rotation"
    axes = [axis for axis, rows in zip("xyz", moved) if abs(rows).max(initial=0.0) > limit]
    return f"displacement along {axes[0]}" if len(axes) == 1 else "displacement aslant"
