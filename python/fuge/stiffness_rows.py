"""Stiffness matrices whose rows have names, as finite element programs write them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fuge.columns import CompressedColumns
from fuge.errors import InputError, Status


@dataclass(frozen=True, eq=False, repr=False)
class StiffnessFile(CompressedColumns):
    """A stiffness matrix, for :class:`Body`, and the names of its rows.

    Attributes
    ----------
    shape, column, row, value
        As in :class:`CompressedColumns`.
    node, direction : ndarray of int, shape (rows,)
        Node of each row and its direction, 1 to 3 along x, y, z, 4 to 6 about them; 0 where no name is known.
    """

    node: NDArray[np.intc]
    direction: NDArray[np.intc]

    @cached_property
    def row_names(self) -> RowNames:
        """Its rows by their names; InputError as of :class:`RowNames`."""
        return RowNames(self)


class RowNames:
    """Rows of a matrix by node and direction.

    Raises
    ------
    InputError
        Rows have no names, or two the same one; or there are not as many names as rows.
    """

    def __init__(self, stiffness: StiffnessFile) -> None:
        sizes = np.size(stiffness.node), np.size(stiffness.direction), stiffness.shape[0]
        if len(set(sizes)) > 1:
            reason = f"node has {sizes[0]} value(s), direction {sizes[1]}, for {sizes[2]} row(s): both name each row"
            raise InputError(reason, Status.ERR_SIZE)
        names = list(zip(stiffness.node.tolist(), stiffness.direction.tolist()))
        self._rows = {name: row for row, name in enumerate(names)}
        if len(self._rows) == len(names):
            return
        node, direction = next(name for row, name in enumerate(names) if self._rows[name] != row)
        if node == 0:
            reason = "the rows of the matrix have no names: the node and the direction of each are needed"
            raise InputError(reason, Status.ERR_DOF)
        raise InputError(f"node {node}, direction {direction} is the name of two rows", Status.ERR_DOF)

    def __len__(self) -> int:
        return len(self._rows)

    def find(self, node: int, direction: int) -> int:
        """Row of a node along or about an axis; -1 if the matrix has none."""
        return self._rows.get((node, direction), -1)
