"""Matrices, stiffness matrices and results in files; doc/files.md describes the formats."""

from __future__ import annotations

import os
from typing import Any, Literal, Mapping, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge._words import Words
from fuge.columns import CompressedColumns, compressed
from fuge.stiffness_rows import StiffnessFile

PathLike = Union[str, "os.PathLike[str]"]
StiffnessFormat = Literal["any", "matrix_market", "calculix", "abaqus", "dmig", "op4"]

STIFFNESS_FORMATS = Words("format", StiffnessFormat, "STIFFNESS_")


def encoded(path: PathLike) -> bytes:
    """The name of a file as C takes it."""
    return os.fsencode(path)


def _counts(number: int) -> list[NDArray[np.intc]]:
    return [np.zeros(1, dtype=np.intc) for _ in range(number)]


def _value(count: NDArray[np.intc]) -> int:
    return int(count[0])


# ---- matrices


def read_matrix(path: PathLike) -> NDArray[np.float64]:
    """Read a matrix of the Matrix Market format, shape (rows, columns); both triangles of a symmetric one.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    rows, columns = _counts(2)
    call("fuge_read_matrix", encoded(path), 0, 0, None, rows, columns)
    matrix = np.zeros((_value(rows), _value(columns)), order="F")
    call("fuge_read_matrix", encoded(path), *matrix.shape, matrix, rows, columns)
    return matrix


def write_matrix(path: PathLike, matrix: ArrayLike, *, symmetric: bool = False) -> None:
    """Write a matrix to a file of the Matrix Market format, with 17 digits; an existing file is replaced.

    Parameters
    ----------
    path : str or path
    matrix : array_like, shape (rows, columns)
    symmetric : bool
        Only the lower triangle of a square matrix is written.
    """
    array = _arrays.columns("matrix", matrix, (None, None))
    rows, columns = array.shape
    call("fuge_write_matrix", encoded(path), rows, columns, array, rows, int(bool(symmetric)))


def read_sparse(path: PathLike) -> CompressedColumns:
    """Read a matrix of the Matrix Market format into compressed columns; both triangles of a symmetric one.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    counts = _counts(3)
    call("fuge_read_sparse", encoded(path), 0, 0, None, None, None, *counts)
    rows, columns, entries = (_value(count) for count in counts)
    column, row = np.empty(columns + 1, dtype=np.intc), np.empty(entries, dtype=np.intc)
    value = np.empty(entries)
    call("fuge_read_sparse", encoded(path), columns, entries, column, row, value, *counts)
    return CompressedColumns((rows, columns), column, row, value)


def write_sparse(path: PathLike, matrix: Any, *, symmetric: bool = False) -> None:
    """Write a sparse matrix (scipy.sparse or CompressedColumns) to a file of the Matrix Market format.

    With `symmetric` only the lower triangle of a square matrix is written.
    """
    columns = compressed("matrix", matrix)
    call(
        "fuge_write_sparse",
        encoded(path),
        *columns.shape,
        columns.column,
        columns.row,
        columns.value,
        int(bool(symmetric)),
    )


def read_stiffness(
    path: PathLike,
    format: StiffnessFormat = "any",
    *,
    names_path: PathLike | None = None,
    name: str | None = None,
) -> StiffnessFile:
    """Read a stiffness matrix from a file of a finite element program.

    Parameters
    ----------
    path : str or path
    format : {'any', 'matrix_market', 'calculix', 'abaqus', 'dmig', 'op4'}
        'any' recognises it by its content.
    names_path : str or path, optional
        For a matrix whose rows have no names: a file with a line node.direction for each row. By default that of
        job.sti is job.dof.
    name : str, optional
        Name of the matrix in a file of Nastran, such as KAAX.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    arguments = [
        encoded(path),
        STIFFNESS_FORMATS.number(format),
        None if names_path is None else encoded(names_path),
        None if name is None else name.encode(),
    ]
    counts = _counts(2)
    call("fuge_read_stiffness", *arguments, 0, 0, *[None] * 5, *counts)
    rows, entries = (_value(count) for count in counts)
    column, row = np.empty(rows + 1, dtype=np.intc), np.empty(entries, dtype=np.intc)
    value = np.empty(entries)
    node, direction = np.empty(rows, dtype=np.intc), np.empty(rows, dtype=np.intc)
    call("fuge_read_stiffness", *arguments, rows, entries, column, row, value, node, direction, *counts)
    return StiffnessFile((rows, rows), column, row, value, node, direction)


# ---- pictures


def _named(results: Mapping[str, ArrayLike], shape: tuple[int, ...]) -> tuple[list[Any], Any]:
    """C arrays of names and results, and what keeps them alive."""
    arrays = [_arrays.doubles(f"the result {name!r}", result, shape) for name, result in results.items()]
    return [len(arrays), _arrays.texts(results), _arrays.addresses(arrays)], arrays


def _grid_shape(results: Mapping[str, ArrayLike], *dimensions: str) -> tuple[int, ...]:
    for name, result in results.items():
        shape = np.shape(result)
        _arrays.check_shape(f"the result {name!r}", shape, dimensions)
        return shape
    return (0,) * len(dimensions)


def write_results(
    path: PathLike,
    spacing: tuple[float, float],
    results: Mapping[str, ArrayLike],
    *,
    origin: tuple[float, float] | None = None,
) -> None:
    """Write results on the cells of a grid for ParaView, a VTI file; an existing file is replaced.

    Parameters
    ----------
    path : str or path
    spacing : (float, float)
        Sizes of a cell along x and y; length.
    results : dict of array_like, shape (ny, nx)
        By their names.
    origin : (float, float), optional
        Centre of the first cell; length.
    """
    ny, nx = _grid_shape(results, "ny", "nx")
    named, kept = _named(results, (ny, nx))
    start = None if origin is None else _arrays.vector("origin", origin, 2)
    steps = _arrays.vector("spacing", spacing, 2)
    call("fuge_write_results", encoded(path), nx, ny, steps, start, *named, shapes={"value": (ny, nx)})
    del kept


def write_volume(
    path: PathLike,
    spacing: tuple[float, float],
    depth: ArrayLike,
    results: Mapping[str, ArrayLike],
    *,
    origin: tuple[float, float] | None = None,
) -> None:
    """Write results below the cells of a grid, at several depths, for ParaView: a VTR file.

    Parameters
    ----------
    path, spacing, origin
        As in :func:`write_results`.
    depth : array_like, shape (d,)
        Ascending; length.
    results : dict of array_like, shape (d, ny, nx)
        Such as the components of :func:`halfspace_stress_grid`.
    """
    depths = _arrays.vector("depth", depth)
    shape = _grid_shape(results, "d", "ny", "nx")
    named, kept = _named(results, (depths.size, *shape[1:]))
    start = None if origin is None else _arrays.vector("origin", origin, 2)
    steps = _arrays.vector("spacing", spacing, 2)
    size = [shape[2], shape[1]]
    call("fuge_write_volume", encoded(path), *size, steps, start, depths.size, depths, *named, shapes={"value": shape})
    del kept
