"""Rows of a stiffness matrix at the nodes of a mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fuge import _arrays
from fuge.errors import Status, error
from fuge.stiffness_rows import StiffnessFile

# Of a node: three displacements, three rotations.
DIRECTIONS = 6


def rows_of_nodes(
    number: NDArray[np.intc], stiffness: StiffnessFile, what: str, members: NDArray[np.intc]
) -> NDArray[np.intc]:
    """Row of each direction of the nodes with these numbers, shape (nodes, 6), -1 where the matrix has none.

    Programs leave out the rows of supports. Refused are rows without names or with the same one, and a matrix of
    another mesh: some of the nodes asked for, the `members` of `what`, have no row, and rows belong to unknown nodes.
    """
    node = _arrays.integers("stiffness.node", stiffness.node, (None,))
    direction = _arrays.integers("stiffness.direction", stiffness.direction, node.shape)
    named = np.flatnonzero((node != 0) & (direction >= 1) & (direction <= DIRECTIONS))
    if not named.size:
        reason = "have no names: read it from a file that names node and direction, or with names_path"
        raise error(Status.ERR_DOF, f"the rows of the stiffness matrix {reason}")
    order = np.argsort(number, kind="stable")
    place = order[np.minimum(np.searchsorted(number, node[named], sorter=order), order.size - 1)]
    is_known = number[place] == node[named]
    row, strange = named[is_known], named[~is_known]
    at = place[is_known], direction[row] - 1
    rows = np.full((number.size, DIRECTIONS), -1, dtype=np.intc)
    rows[at] = row
    twice = row[rows[at] != row]
    if twice.size:
        reason = f"are node {node[twice[0]]}, direction {direction[twice[0]]}: each needs a name of its own"
        raise error(Status.ERR_DOF, f"two rows of the stiffness matrix {reason}")
    lost = members[np.all(rows[members] < 0, axis=1)]
    if lost.size and not row.size:
        reason = f"of any node of the mesh, such as {number[lost[0]]}: are mesh and matrix of one model?"
        raise error(Status.ERR_DOF, f"the stiffness matrix has no row {reason}")
    if lost.size and strange.size:
        reason = f"which has rows of node {node[strange[0]]}, unknown to the mesh: are both of one model?"
        raise error(Status.ERR_DOF, f"{what}: node {number[lost[0]]} has no row in the stiffness matrix, {reason}")
    return rows
