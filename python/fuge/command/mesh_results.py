"""What is found of bodies with meshes in contact: the table of contact points, and fields of displacements."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from fuge.command.errors import CommandError
from fuge.command.matrices import state_words
from fuge.command.mesh_model import MeshModel
from fuge.command.mesh_pairs import MeshPair
from fuge.command.options import Options
from fuge.command.run import Outcome, Report
from fuge.command.tables import Column, Table, number_text, write_lines
from fuge.contact import Contact
from fuge.errors import Error
from fuge.mesh import join_meshes

Array = NDArray[np.float64]

# Nodes without an opposite that are listed on a line.
_NODES_ON_A_LINE = 20


class Points(NamedTuple):
    """Contact points of all pairs, as :class:`ContactPairs` has them; gaps with clearances, nodes of the model."""

    pair: NDArray[np.intc]
    node: NDArray[np.intc]
    direction: Array
    dof: NDArray[np.intc]
    normal: Array
    area: Array
    gap: Array
    play: Optional[Array]
    # Pair and node of each node without an opposite.
    unpaired: NDArray[np.intc]
    excluded: Optional[NDArray[np.bool_]] = None


def check_field(given: Options, model: MeshModel) -> None:
    """Refuse, before all is computed, meshes that cannot be written for ParaView."""
    path = given.file("field")
    if not _is_mesh_file(path):
        return
    try:
        join_meshes([body.mesh for body in model.bodies]).write(os.devnull)
    except Error as failure:
        raise CommandError(f"--field {path}: {failure.message}", failure.status) from None


def outcome(
    model: MeshModel,
    pairs: Sequence[MeshPair],
    points: Points,
    contact: Contact,
    displacement: Array,
    report: Report,
) -> Outcome:
    """The table of the contact points, and the fields; `displacement` is that of all rows."""
    force = contact.force[:, None] * _action(model, pairs, points)
    comments = report.comments(contact.info.contacts)
    for k, pair in enumerate(pairs):
        comments += _pair_comments(model, k, pair, force[points.pair == k].sum(axis=0), points)
    direction = np.zeros((points.gap.size, 3))
    direction[:, : points.direction.shape[1]] = points.direction
    numbers = (*model.position[points.node].T, *direction.T, points.area, contact.force)
    numbers += (contact.force / points.area, contact.gap)
    names = "x y z nx ny nz area force pressure gap".split()
    columns = [
        Column("pair", points.pair + 1),
        Column("body", [model.bodies[k].name for k in model.owner[points.node]]),
        Column("node", model.number[points.node]),
        *(Column(name, values) for name, values in zip(names, numbers)),
        Column("state", state_words(contact.force, contact.state, points.play, points.excluded)),
    ]

    def write_field(path: str) -> None:
        if not _is_mesh_file(path):
            write_lines(path, _displacements(model, displacement).lines())
            return
        fields = _fields(model, pairs, points, contact, displacement, force)
        join_meshes([body.mesh for body in model.bodies]).write(path, fields)

    return Outcome(Table(columns, comments), write_field=write_field)


def _action(model: MeshModel, pairs: Sequence[MeshPair], points: Points) -> Array:
    """Resultants on the contact body of a force of 1 at each point, shape (n, 3).

    On bent surfaces the force is spread along several normals. Along an axis that the stiffness lacks the resultant is
    that of the direction of the gap.
    """
    result = np.zeros((points.gap.size, 3))
    for k, pair in enumerate(pairs):
        here = np.flatnonzero(points.pair == k)
        dimensions = points.direction.shape[1]
        rigid = pair.surfaces[0].dof is None
        nodes = np.unique(pair.faces[int(rigid)].node)
        rows = model.row[nodes[nodes >= 0], :dimensions]
        # The last element is that of no degree of freedom, -1.
        axis = np.full(model.load.size + 1, -1)
        axis[rows] = np.arange(dimensions)
        axis[-1] = -1
        along, normal = axis[points.dof[here]], points.normal[here]
        for d in range(dimensions):
            result[here, d] = (-1.0 if rigid else 1.0) * np.where(along == d, normal, 0.0).sum(axis=1)
            if not rigid:
                lacking = here[model.row[points.node[here], d] < 0]
                result[lacking, d] = -points.direction[lacking, d]
    return result


def _pair_comments(model: MeshModel, k: int, pair: MeshPair, force: Array, points: Points) -> Iterator[str]:
    """What a pair is, the force on its contact body, and the nodes that have no opposite."""
    if pair.options["revolution"]:
        # Radial forces of a ring balance each other.
        force[0] = 0.0
    values = ",".join(number_text(value, 16, 24) for value in force)
    yield f"pair {k + 1}: {pair.source.value}, force on {pair.faces[0].body.name}: {values}"
    lonely = sorted(model.number[points.unpaired[points.unpaired[:, 0] == k, 1]].tolist())
    for begin in range(0, len(lonely), _NODES_ON_A_LINE):
        nodes = " ".join(map(str, lonely[begin : begin + _NODES_ON_A_LINE]))
        yield f"pair {k + 1}, nodes without an opposite: {nodes}"


# ---- fields


def _is_mesh_file(path: str) -> bool:
    return path.upper().endswith(".VTU")


def _fields(
    model: MeshModel, pairs: Sequence[MeshPair], points: Points, contact: Contact, displacement: Array, force: Array
) -> dict[str, Any]:
    """Displacements, pressures and forces of the contact points, and the number of the body, at all nodes."""
    row, nodes = model.row[:, :3], model.number.size
    pressure, forces = np.zeros(nodes), np.zeros((nodes, 3))
    np.add.at(forces, points.node, force)
    loose = ~np.array([bool(pair.options.get("tied")) for pair in pairs])[points.pair]
    np.add.at(pressure, points.node[loose], (contact.force / points.area)[loose])
    moved = np.where(row >= 0, displacement[row], 0.0)
    return {"displacement": moved, "pressure": pressure, "contact_force": forces, "body": model.owner + 1.0}


def _displacements(model: MeshModel, displacement: Array) -> Table:
    """A line for each degree of freedom."""
    bodies = [model.bodies[k].name for k in model.row_owner]
    columns = [Column("body", bodies), Column("node", model.row_node), Column("direction", model.row_direction)]
    return Table([*columns, Column("displacement", displacement)])
