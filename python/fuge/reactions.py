"""Rows of stiffness matrices, and contact points as rows: what forces at supports are computed from."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse


def stiffness_rows(matrix: Any, rows: NDArray[np.intc]) -> Any:
    """Rows of a symmetric matrix, (rows, degrees), of which both triangles are given or one of them."""
    if isinstance(matrix, np.ndarray):
        return matrix[rows]
    columns = matrix.tocsc()
    place = np.repeat(np.arange(columns.shape[1]), np.diff(columns.indptr))
    entries = columns.data != 0.0
    both = np.any(entries & (columns.indices > place)) and np.any(entries & (columns.indices < place))
    # Columns are the rows of a symmetric matrix, and the transpose of compressed columns costs nothing.
    found = columns.T[rows]
    if both:
        return found
    diagonal = sparse.csr_matrix((columns.diagonal()[rows], (np.arange(rows.size), rows)), shape=found.shape)
    return found + columns.tocsr()[rows] - diagonal


def opening_rows(dof: NDArray[np.intc], normal: NDArray[np.float64], degrees: int) -> Any:
    """How far displacements open each contact point, as a matrix (points, degrees); its transpose gives the forces."""
    point, place = np.nonzero((dof >= 0) & (normal != 0.0))
    return sparse.csr_matrix((normal[point, place], (point, dof[point, place])), shape=(len(dof), degrees))
