"""Matrix Market files: real and integer matrices, dense (array) and sparse (coordinate).

The format: R. F. Boisvert, R. Pozo, K. A. Remington, The Matrix Market exchange formats: initial design, NISTIR 5935,
1996. It does not say what repeated entries mean; they are added, like contributions of finite elements.
"""

from __future__ import annotations

import re
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge.columns import CompressedColumns, compressed
from fuge.errors import InputError, OutOfMemoryError, Status
from fuge.formats.number_columns import Column, blank_words, blocks, label_column, read_columns
from fuge.formats.text import PathLike, Reason, TextFile, quoted, read_text, refusal, value, whole, write_text

# The words of the first line after %%MatrixMarket, and why others are refused.
_BANNER = (
    (("matrix",), ' cannot be read, only "matrix"'),
    (("coordinate", "array"), " is not a supported format: use coordinate or array"),
    (("real", "integer"), " values are not supported: write a real or an integer matrix"),
    (("general", "symmetric"), " matrices are not supported: write a general or a symmetric one"),
)
_LARGEST_SIZE = 2**31 - 2
# With up to this many positions, or rows and columns of a sparse matrix, a file is read however few entries it has.
# Otherwise a damaged line of sizes could take any amount of memory.
_EMPTY_ROOM = 10**7

_SKIPPED = re.compile(r"[ \t\r]*(?:%|$)")
# An exponent follows a letter here.
_BARE_EXPONENT = re.compile(r"[^eEdD]*[\d.][+-]")


def read_matrix(path: PathLike) -> NDArray[np.float64]:
    """Read a matrix of the Matrix Market format, shape (rows, columns); both triangles of a symmetric one.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    OutOfMemoryError
        A sparse matrix is too large for a dense one.
    """
    entries = _read(read_text(path), dense=True)
    rows, columns = entries.shape
    try:
        matrix = np.zeros((rows, columns), order="F")
    except MemoryError:
        reason = f"no memory for a dense matrix of {rows} x {columns}: read it with fuge.read_sparse"
        raise OutOfMemoryError(refusal(path, reason).message, Status.ERR_MEMORY) from None
    matrix[entries.row, np.repeat(np.arange(columns), np.diff(entries.column))] = entries.value
    return matrix


def read_sparse(path: PathLike) -> CompressedColumns:
    """Read a matrix of the Matrix Market format into compressed columns; both triangles of a symmetric one.

    Rows ascend in each column. Zeros of a coordinate file are kept, those of an array file are not.

    Raises
    ------
    FileError
        The message has the file, the line and the reason.
    """
    return _read(read_text(path), dense=False)


def compressed_columns(
    shape: tuple[int, int], row: NDArray[Any], column: NDArray[Any], number: NDArray[Any]
) -> CompressedColumns:
    """Compressed columns of entries in any order, each position once; rows ascend in each column."""
    from scipy.sparse import coo_matrix

    matrix = coo_matrix((number, (row, column)), shape=shape).tocsc()
    return CompressedColumns(shape, matrix.indptr.astype(np.intc), matrix.indices.astype(np.intc), matrix.data)


def mirrored(row: NDArray[Any], column: NDArray[Any], number: NDArray[Any]) -> tuple[NDArray[Any], ...]:
    """Entries of one triangle, followed by those of the other one."""
    off = row != column
    return np.append(row, column[off]), np.append(column, row[off]), np.append(number, number[off])


def _read(file: TextFile, dense: bool) -> CompressedColumns:
    coordinate, integers, symmetric = _banner(file)
    lines = [k for k, line in enumerate(file.lines, 1) if k > 1 and not _SKIPPED.match(line)]
    rows, columns, entries = _sizes(file, lines, coordinate, symmetric)
    room, filled = (rows * columns, entries**2) if dense else (max(rows, columns), 10 * entries)
    if room > max(_EMPTY_ROOM, filled):
        size = f"{rows} rows and {columns} columns"
        raise file.refuse(lines[0], f"most of {size} have none of the entries: are the sizes right?")
    kinds = [Column(_whole, b"+-0123456789") if integers else Column(_real)]
    if coordinate:
        kinds = [label_column("row", 1, rows), label_column("column", 1, columns), *kinds]
    *places, number = read_columns(file, lines[1:], kinds, _one_entry)
    if coordinate:
        row, column = np.array(places, dtype=np.int64) - 1
    else:
        column, row = np.triu_indices(rows) if symmetric else np.divmod(np.arange(entries), max(rows, 1))
    if symmetric:
        for k in np.flatnonzero(row < column):
            reason = "is above the diagonal: a symmetric file holds the lower triangle only"
            raise file.refuse(lines[k + 1], f"entry ({row[k] + 1}, {column[k] + 1}) {reason}")
        row, column, number = mirrored(row, column, number)
    position, first, place = np.unique(column * rows + row, return_index=True, return_inverse=True)
    if len(first) < len(number):
        # Entries of one position are added in the order of the file.
        number, first = np.bincount(place, number), np.arange(len(position))
    number = number[first]
    column, row = np.divmod(position, max(rows, 1))
    for k in np.flatnonzero(~np.isfinite(number)):
        raise refusal(file.path, f"the sum of the entries for ({row[k] + 1}, {column[k] + 1}) is out of range")
    kept = number != 0.0 if not (coordinate or dense) else slice(None)
    return compressed_columns((rows, columns), row[kept], column[kept], number[kept])


def _banner(file: TextFile) -> tuple[bool, bool, bool]:
    """Whether the matrix is sparse, whole and symmetric."""
    if not file.lines:
        raise file.refuse(1, "the file is empty")
    words = blank_words(file.lines[0].lower())
    if words[0] != "%%matrixmarket":
        reason = 'a Matrix Market file begins with a line like "%%MatrixMarket matrix array real general"'
        raise file.refuse(1, reason)
    words += [""] * (5 - len(words))
    for word, (known, refused) in zip(words[1:], _BANNER):
        if word not in known:
            raise file.refuse(1, quoted(word) + refused)
    if len(words) > 5:
        raise file.refuse(1, "the first line has more than five words")
    return words[2] == "coordinate", words[3] == "integer", words[4] == "symmetric"


def _sizes(file: TextFile, lines: list[int], coordinate: bool, symmetric: bool) -> tuple[int, int, int]:
    """Numbers of rows, columns and entries, from the first of these lines, which is followed by as many entries."""
    if not lines:
        raise file.refuse(len(file.lines), "the file ends before the line with the sizes")
    words = blank_words(file.lines[lines[0] - 1])
    sizes = [size for size in map(whole, words) if size is not None]
    if len(words) != len(sizes) or len(sizes) != 2 + coordinate:
        needed = "three {}, entries" if coordinate else "two {}"
        raise file.refuse(lines[0], needed.format("whole numbers are needed here: rows, columns"))
    if min(sizes) < 0 or max(sizes) > _LARGEST_SIZE:
        raise file.refuse(lines[0], f"sizes must be from 0 to {_LARGEST_SIZE}")
    rows, columns = sizes[:2]
    if symmetric and rows != columns:
        raise file.refuse(lines[0], "a symmetric matrix needs as many rows as columns")
    entries = sizes[2] if coordinate else rows * (rows + 1) // 2 if symmetric else rows * columns
    present = len(lines) - 1
    if present < entries:
        raise file.refuse(len(file.lines), f"the file ends after {present} of {entries} entries")
    if present > entries:
        raise file.refuse(lines[entries + 1], "more entries than the line with the sizes announces")
    return rows, columns, entries


def _one_entry(line: str, count: int) -> list[str]:
    words = blank_words(line)
    if len(words) > count:
        raise Reason("more than one entry on the line")
    return words


def _real(word: str) -> float:
    if _BARE_EXPONENT.match(word):
        raise Reason(f"{quoted(word)} is not a number")
    return value(word)


def _whole(word: str) -> float:
    number = _real(word)
    if not word.lstrip("+-").isdecimal():
        raise Reason(f"{quoted(word)} is not a whole number, although the banner says integer")
    return number


def write_matrix(path: PathLike, matrix: ArrayLike, *, symmetric: bool = False) -> None:
    """Write a matrix to a file of the Matrix Market format, with 17 digits; an existing file is replaced.

    Parameters
    ----------
    path : str or path
    matrix : array_like, shape (rows, columns)
    symmetric : bool
        Only the lower triangle of a square matrix is written.

    Raises
    ------
    InputError
        The matrix is not finite, or not square; an existing file is unchanged.
    FileError
        The file cannot be written; it is then empty.
    """
    array = _arrays.columns("matrix", matrix, (None, None))
    column, row = np.indices(array.shape[::-1]).reshape(2, -1)
    _write(path, "array", array.shape, row, column, array.ravel(order="F"), symmetric)


def write_sparse(path: PathLike, matrix: Any, *, symmetric: bool = False) -> None:
    """Write a sparse matrix (scipy.sparse or CompressedColumns) to a file of the Matrix Market format.

    With `symmetric` only the lower triangle of a square matrix is written. Errors are those of :func:`write_matrix`;
    also InputError for rows that are out of range.
    """
    columns = compressed("matrix", matrix)
    for k in np.flatnonzero((columns.row < 0) | (columns.row >= columns.shape[0])):
        raise InputError(f"row({k}) = {columns.row[k]} is outside 0 .. {columns.shape[0] - 1}", Status.ERR_SIZE)
    column = np.repeat(np.arange(columns.shape[1]), np.diff(columns.column))
    _write(path, "coordinate", columns.shape, columns.row, column, columns.value, symmetric)


def _write(
    path: PathLike, kind: str, shape: tuple[int, ...], row: Any, column: Any, number: Any, symmetric: bool
) -> None:
    if symmetric:
        if shape[0] != shape[1]:
            raise InputError(f"a symmetric matrix cannot be {shape[0]} x {shape[1]}", Status.ERR_SIZE)
        row, column, number = row[row >= column], column[row >= column], number[row >= column]
    for k in np.flatnonzero(~np.isfinite(number)):
        reason = f"entry ({row[k]}, {column[k]}) = {number[k]} is not a finite number"
        raise InputError(reason, Status.ERR_NOT_FINITE)
    form, table, sizes = "%d %d %.16e\n", np.column_stack([row + 1, column + 1, number]), [*shape, len(number)]
    if kind == "array":
        form, table, sizes = "%.16e\n", table[:, 2:], sizes[:2]
    head = f"%%MatrixMarket matrix {kind} real {'symmetric' if symmetric else 'general'}\n{' '.join(map(str, sizes))}\n"
    entries = (form * len(part) % tuple(part.ravel().tolist()) for part in blocks(table))
    write_text(path, chain([head], entries))
