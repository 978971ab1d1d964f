"""Contact of bodies with meshes: from the files to forces and displacements."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_diag

from fuge.body import Body
from fuge.command.errors import CommandError, UsageError
from fuge.command.matrices import solve_contact
from fuge.command.mesh_loads import take_conditions
from fuge.command.mesh_model import MeshModel
from fuge.command.mesh_pairs import MeshPair, read_pairs
from fuge.command.mesh_results import Points, check_field, outcome
from fuge.command.options import Options
from fuge.command.run import Log, Outcome, Report, caught
from fuge.errors import EquilibriumError, Error, Status, Warning
from fuge.pairs import ContactPairs
from fuge.solver import Solver

# What is smaller beside the largest of its kind is rounding: factors of degrees of freedom and gaps, and displacements.
_NOTHING, _NO_MOTION = 1e-10, 1e-6

_OPENS = (
    "no point touches, and loads and supports open every gap: if they press, the surfaces of each pair look into their "
    "bodies: reverse the order of the nodes of all their faces"
)

# What the library numbers from 0 in its messages.
_NUMBERED = re.compile(r"\b(degree of freedom|nodes?|faces?|pair) (\d+)(?: and (\d+))?\b(?!\.\d)")


def solve_meshes(given: Options, log: Log) -> Outcome:
    """--mesh and --pair."""
    model = MeshModel(given, log)
    check_field(given, model)
    pairs = read_pairs(given, model)
    for pair in pairs:
        if any(name.startswith(("S", "M3D")) for faces in pair.faces for name in faces.type.tolist()):
            reason = "shells and membranes touch where their nodes are: half their thickness is a negative --clearance"
            log.note(f"{pair.source.source}: {reason}")
    take_conditions(given, model)
    points, pairing = _find_points(model, pairs)
    log.say(f"{points.gap.size} contact points, {len(points.unpaired)} nodes without an opposite")
    excluded = _excluded(given, model, points)
    with _named(model) as condensation:
        body = _body(model, points)
        condensed = body.condense()
    log.say(f"{body.degrees} degrees of freedom are condensed, {condensed.resultant.size} rigid motions")
    report = Report(log)
    with Solver(condensed.influence, threads=given.threads(), progress=log.progress) as solver:
        solver.set_gap(points.gap + condensed.displacement, points.gap_upper)
        solver.set_modes(condensed.modes, condensed.resultant)
        solver.set_excluded(excluded)
        try:
            contact, _ = solve_contact(given, solver, report)
        except EquilibriumError as failure:
            raise _moving(failure, model, body, *condensed.modes.shape) from None
    with _named(model) as recovery:
        displacement = body.recover(contact.force, contact.motion)
    log.say("displacements are found")
    for warning in (*condensation, *recovery, *pairing):
        report.take(warning.status, _in_names(warning.message, model))
    largest = abs(displacement).max()
    if largest > 0.0 and not contact.force.any() and (contact.gap - points.gap).min() > _NO_MOTION * largest:
        report.take(Status.WARN_NO_CONTACT, _OPENS)
    return outcome(model, pairs, points, excluded, contact, displacement, report)


def _find_points(model: MeshModel, pairs: Sequence[MeshPair]) -> tuple[Points, list[Warning]]:
    """The contact points of all pairs, without those that supports hold on both sides; and warnings."""
    found, warned = ContactPairs(), []
    for pair in pairs:
        with _named(model, f"{pair.source.source}: ") as remarks:
            found.find(*pair.surfaces, **pair.options)
        warned += remarks
    gap = found.gap + np.array([pair.clearance for pair in pairs])[found.pair]
    kept = _moving_points(model, found, gap)
    kept = kept[np.lexsort((model.mesh.node[found.node[kept]], found.pair[kept]))]
    names = "pair node direction dof normal area gap_upper".split()
    chosen: dict[str, Any] = {name: getattr(found, name)[kept] for name in names}
    return Points(**chosen, gap=gap[kept], unpaired=found.unpaired), warned


def _moving_points(model: MeshModel, found: ContactPairs, gap: NDArray[np.float64]) -> NDArray[np.intp]:
    """The points with a degree of freedom that is not held; gaps of the others must not violate a stop."""
    size = abs(found.normal)
    used = (found.dof >= 0) & (size > _NOTHING * size.max(axis=1, keepdims=True))
    moves = (used & ~model.held[found.dof]).any(axis=1)
    gap = gap + np.where(found.dof >= 0, found.normal * model.displacement[found.dof], 0.0).sum(axis=1)
    rounding = _NOTHING * abs(model.mesh.position).max()
    for k in np.flatnonzero(~moves & ((gap < -rounding) | (gap > found.gap_upper + rounding)))[:1]:
        reason = f"are held by supports with a gap of {gap[k]:.6g}, beyond a stop"
        remedy = "free or move one of them, or leave the faces there out"
        where = f"node {model.node_name(found.node[k])} of the contact surface of pair {found.pair[k] + 1}"
        raise CommandError(f"{where} and what lies across from it {reason}: {remedy}", Status.ERR_GAP)
    if not moves.any():
        reason = f"supports hold both surfaces at each of the {moves.size} contact points"
        raise CommandError(f"{reason}: free degrees of freedom, or leave the pair out", Status.ERR_MESH)
    return np.flatnonzero(moves)


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


def _body(model: MeshModel, points: Points) -> Body:
    """All bodies as one, with supports, loads and contact points; motions that supports leave are found."""
    matrices = [body.stiffness.tocsc() for body in model.bodies if body.stiffness is not None]
    stiffness = block_diag(matrices, format="csc")
    body = Body(stiffness)
    held = np.flatnonzero(model.held)
    body.fix(held, model.displacement[held])
    body.set_load(model.load)
    body.find_rigid_modes()
    body.set_contact(points.dof, points.normal)
    return body


# ---- messages


@contextmanager
def _named(model: MeshModel, source: str = "") -> Iterator[list[Warning]]:
    """Warnings of the library, and its errors in the words of the files."""
    try:
        with caught() as warned:
            yield warned
    except Error as failure:
        raise CommandError(source + _in_names(failure.message, model), failure.status) from None


def _in_names(message: str, model: MeshModel) -> str:
    """A message with names of nodes and of degrees of freedom; faces and pairs count from 1."""

    def renamed(match: re.Match[str]) -> str:
        word, numbers = match[1], [int(text) for text in match.groups()[1:] if text]
        if word == "degree of freedom":
            return model.row_name(numbers[0])
        names = [model.node_name(k) if word.startswith("node") else str(k + 1) for k in numbers]
        return f"{word} {' and '.join(names)}"

    return _NUMBERED.sub(renamed, message)


def _moving(failure: EquilibriumError, model: MeshModel, body: Body, n: int, motions: int) -> Error:
    """The error with a body and how it moves, instead of the number of the motion without equilibrium."""
    number = re.search(r"\bmotion (\d+)", failure.message)
    if number is None:
        return failure
    none, unit = np.zeros(motions), np.eye(motions)[int(number[1])]
    with caught():
        moved = body.recover(np.zeros(n), unit) - body.recover(np.zeros(n), none)
    owner = model.row_owner[abs(moved).argmax()]
    along = [moved[(model.row_owner == owner) & (model.row_direction == k)] for k in (1, 2, 3)]
    limit = _NO_MOTION * max(abs(rows).max(initial=0.0) for rows in along)
    # What stands still belongs to other parts of the body, as where one matrix has several.
    along = [rows[abs(rows) > limit] for rows in along]
    axes = [axis for axis, rows in zip("xyz", along) if rows.size]
    how = f"displacement along {axes[0]}" if len(axes) == 1 else "displacement aslant"
    if any(rows.size and np.ptp(rows) > limit for rows in along):
        how = "a rotation"
    reason = "its loads move it that way without closing a contact, so that no contact forces can balance them"
    remedy = "hold it by --support, or turn the loads"
    return CommandError(f"body {model.bodies[owner].name}, {how}: {reason}: {remedy}", failure.status)
