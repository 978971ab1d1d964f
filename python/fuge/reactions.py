"""Rows of stiffness matrices, and contact points as rows: what forces at supports are computed from."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse


def symmetric(matrix: Any) -> Any:
    """A dense matrix as it is, or compressed rows of a sparse one, with both triangles."""
    if isinstance(matrix, np.ndarray):
        return matrix
    # Columns are the rows of a symmetric matrix, and the transpose of compressed columns costs nothing.
    rows = matrix.tocsc().T
    lower, upper = sparse.tril(rows, -1), sparse.triu(rows, 1)
    return rows if lower.count_nonzero() and upper.count_nonzero() else (rows + (lower + upper).T).tocsr()


def opening_rows(dof: NDArray[np.intc], normal: NDArray[np.float64], degrees: int) -> Any:
    """How far displacements open each contact point, as a matrix (points, degrees); its transpose gives the forces."""
    point, place = np.nonzero((dof >= 0) & (normal != 0.0))
    return sparse.csr_matrix((normal[point, place], (point, dof[point, place])), shape=(len(dof), degrees))
