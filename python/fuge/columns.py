"""Sparse matrices as compressed columns, those of scipy among them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._library import has_sparse
from fuge.errors import Status, error


@dataclass(frozen=True, eq=False)
class CompressedColumns:
    """A sparse matrix: column j has the entries value[p] in row[p], column[j] <= p < column[j + 1].

    Attributes
    ----------
    shape : tuple of int
        Rows and columns.
    column : ndarray of int, shape (columns + 1,)
    row : ndarray of int, shape (entries,)
        From 0, in any order; repeated entries are added.
    value : ndarray, shape (entries,)
    """

    shape: tuple[int, int]
    column: NDArray[np.intc]
    row: NDArray[np.intc]
    value: NDArray[np.float64]

    def __repr__(self) -> str:
        rows, columns = self.shape
        return f"<{type(self).__name__}: {rows} x {columns}, {len(self.value)} entries>"

    def tocsc(self) -> Any:
        """The matrix as ``scipy.sparse.csc_matrix``."""
        from scipy.sparse import csc_matrix

        return csc_matrix((self.value, self.row, self.column), shape=self.shape)


def require_sparse() -> None:
    """Raise an error if the library for sparse matrices is missing."""
    if not has_sparse():
        raise error(
            Status.ERR_UNSUPPORTED,
            "this copy of fuge was built without CHOLMOD (Debian: libsuitesparse-dev), so it factorises sparse "
            "matrices as bands: pass sparse=False",
        )


def is_sparse(matrix: Any) -> bool:
    """Whether it is a matrix of this module or of scipy.sparse."""
    return isinstance(matrix, CompressedColumns) or hasattr(matrix, "tocsc")


def compressed_dense(name: str, matrix: ArrayLike) -> CompressedColumns:
    """Compressed columns of the entries of a matrix that are not zero."""
    array = _arrays.doubles(name, matrix, (None, None))
    columns, rows = np.nonzero(array.T)
    first = np.searchsorted(columns, np.arange(array.shape[1] + 1)).astype(np.intc)
    return CompressedColumns(
        (array.shape[0], array.shape[1]), first, rows.astype(np.intc), np.ascontiguousarray(array[rows, columns])
    )


def compressed(name: str, matrix: Any) -> CompressedColumns:
    """Compressed columns of a sparse matrix, checked; the caller's arrays where their types fit."""
    if not is_sparse(matrix):
        raise TypeError(
            f"{name} must be a sparse matrix (scipy.sparse or CompressedColumns), not {type(matrix).__name__}"
        )
    if isinstance(matrix, CompressedColumns):
        shape, column, row, value = matrix.shape, matrix.column, matrix.row, matrix.value
    else:
        csc = matrix.tocsc()
        shape, column, row, value = csc.shape, csc.indptr, csc.indices, csc.data
    columns = _arrays.integers(f"{name}.column", column, (shape[1] + 1,))
    if columns[0] != 0 or np.any(columns[1:] < columns[:-1]):
        raise error(Status.ERR_SIZE, f"{name}.column must begin with 0 and not decrease")
    entries = int(columns[-1])
    rows, values = _arrays.array(f"{name}.row", row), _arrays.array(f"{name}.value", value)
    if rows.ndim != 1 or values.ndim != 1 or min(rows.size, values.size) < entries:
        raise error(Status.ERR_SIZE, f"{name} has fewer rows or values than its {entries} entries")
    return CompressedColumns(
        (int(shape[0]), int(shape[1])),
        columns,
        _arrays.integers(f"{name}.row", rows[:entries]),
        _arrays.doubles(f"{name}.value", values[:entries]),
    )


def stacked(name: str, value: ArrayLike) -> NDArray[Any]:
    """An array of one or two dimensions, one row for each point."""
    found = _arrays.array(name, value)
    return found.reshape(-1, 1) if found.ndim == 1 else found
