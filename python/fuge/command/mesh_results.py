"""What is found of bodies with meshes in contact: the table of contact points, fields of displacements, a picture."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge.command.errors import CommandError
from fuge.command.matrices import state_words
from fuge.command.mesh_model import MeshModel
from fuge.command.mesh_pairs import MeshPair
from fuge.command.options import Options
from fuge.command.run import Outcome, Report
from fuge.command.tables import Column, Table, long_text, write_lines
from fuge.contact import Contact
from fuge.errors import Error

Array = NDArray[np.float64]

# Nodes without an opposite that are listed on a line.
_NODES_ON_A_LINE = 20


class Points(NamedTuple):
    """Contact points of all pairs, as :class:`ContactPairs` has them, with nodes and rows of the model.

    Gaps have the clearances; `unpaired` has pair and node of each node without an opposite.
    """

    pair: NDArray[np.intc]
    node: NDArray[np.intc]
    direction: Array
    dof: NDArray[np.intc]
    normal: Array
    area: Array
    gap: Array
    gap_upper: Array
    unpaired: NDArray[np.intc]


def check_field(given: Options, model: MeshModel) -> None:
    """Refuse, before all is computed, meshes that cannot be written for ParaView."""
    path = given.file("field")
    if not _is_mesh_file(path):
        return
    try:
        model.mesh.write(os.devnull)
    except Error as failure:
        raise CommandError(f"--field {path}: {failure.message}", failure.status) from None


def outcome(
    model: MeshModel,
    pairs: Sequence[MeshPair],
    points: Points,
    excluded: NDArray[np.bool_] | None,
    contact: Contact,
    displacement: Array,
    report: Report,
) -> Outcome:
    """The table of the contact points, the fields and the picture; `displacement` is that of all rows."""
    action = contact.force[:, None] * _actions(model, pairs, points)
    comments = report.comments(contact.info.contacts)
    for k, pair in enumerate(pairs):
        comments += _pair_comments(model, k, pair, action[points.pair == k].sum(axis=0), points)
    place, pressure = model.mesh.position[points.node], contact.force / points.area
    dimensions = points.direction.shape[1]
    direction = np.pad(points.direction, ((0, 0), (0, 3 - dimensions)))
    numbers = (*place.T, *direction.T, points.area, contact.force, pressure, contact.gap)
    columns = [
        Column("pair", points.pair + 1),
        Column("body", [model.bodies[k].name for k in model.owner[points.node]]),
        Column("node", model.mesh.node[points.node]),
        *map(Column, "x y z nx ny nz area force pressure gap".split(), numbers),
        Column("state", state_words(contact.force, contact.state, points.gap_upper, excluded)),
    ]

    def write_field(path: str) -> None:
        if not _is_mesh_file(path):
            rows = Column("node", model.row_node), Column("direction", model.row_direction)
            owner = Column("body", [model.bodies[k].name for k in model.row_owner])
            write_lines(path, Table([owner, *rows, Column("displacement", displacement)]).lines())
            return
        tied = np.array(["tied" in pair.options for pair in pairs])[points.pair]
        fields = {
            "displacement": np.where(model.row[:, :3] >= 0, displacement[model.row[:, :3]], 0.0),
            "pressure": np.zeros(model.owner.size),
            "contact_force": np.zeros((model.owner.size, 3)),
            "body": model.owner + 1.0,
        }
        np.add.at(fields["pressure"], points.node, np.where(tied, 0.0, pressure))
        np.add.at(fields["contact_force"], points.node, action)
        model.mesh.write(path, fields)

    def draw(axes: Any) -> None:
        """Pressures over the longest extent of the points, in space as colours over the two longest ones."""
        first, second = np.argsort(-np.ptp(place, axis=0), kind="stable")[:2]
        axes.set_xlabel("xyz"[first])
        if dimensions == 2:
            axes.plot(place[:, first], pressure, "o")
            axes.set_ylabel("pressure")
            return
        drawn = axes.scatter(place[:, first], place[:, second], c=pressure)
        axes.set(ylabel="xyz"[second], aspect="equal")
        axes.figure.colorbar(drawn, label="pressure")

    return Outcome(Table(columns, comments), write_field, draw)


def _actions(model: MeshModel, pairs: Sequence[MeshPair], points: Points) -> Array:
    """Resultants on the contact body of a force of 1 at each point, shape (n, 3).

    On bent surfaces the force is spread along several normals. Along an axis that the stiffness lacks the resultant is
    that of the direction of the gap.
    """
    result = np.zeros((points.gap.size, 3))
    dimensions = points.direction.shape[1]
    for k, pair in enumerate(pairs):
        here = np.flatnonzero(points.pair == k)
        rigid = pair.surfaces[0].dof is None
        node = pair.faces[int(rigid)].node
        # The last element is that of no degree of freedom, -1.
        axis = np.full(model.load.size + 1, -1)
        axis[model.row[node[node >= 0], :dimensions]] = np.arange(dimensions)
        axis[-1] = -1
        along = axis[points.dof[here]]
        for d in range(dimensions):
            factors = np.where(along == d, points.normal[here], 0.0).sum(axis=1)
            lacking = (model.row[points.node[here], d] < 0) & (not rigid)
            result[here, d] = np.where(lacking, -points.direction[here, d], -factors if rigid else factors)
    return result


def _pair_comments(model: MeshModel, k: int, pair: MeshPair, force: Array, points: Points) -> Iterator[str]:
    """What a pair is, the force on its contact body, and the nodes that have no opposite."""
    resultant = [0.0, *force[1:]] if pair.options["revolution"] else force
    values = ",".join(map(long_text, resultant))
    yield f"pair {k + 1}: {pair.source.value}, force on {pair.faces[0].body.name}: {values}"
    if pair.options["revolution"]:
        yield f"pair {k + 1}, sum of the radial forces, which balance each other: {long_text(force[0])}"
    lonely = sorted(model.mesh.node[points.unpaired[points.unpaired[:, 0] == k, 1]].tolist())
    for begin in range(0, len(lonely), _NODES_ON_A_LINE):
        nodes = " ".join(map(str, lonely[begin : begin + _NODES_ON_A_LINE]))
        yield f"pair {k + 1}, nodes without an opposite: {nodes}"


def _is_mesh_file(path: str) -> bool:
    return path.upper().endswith(".VTU")
