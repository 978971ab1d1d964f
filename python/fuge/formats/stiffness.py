"""Stiffness matrices in files of finite element programs: which reader a file needs, and both triangles."""

from __future__ import annotations

import os
import re
from typing import Literal, get_args

import numpy as np

from fuge import _arrays
from fuge.columns import CompressedColumns
from fuge.formats.dmig import read_dmig
from fuge.formats.matrix_market import compressed_columns, mirrored, read_sparse
from fuge.formats.matrix_rows import DIRECTIONS, SKIPPED, Entries, Keys, read_entries, read_row_names, row_name
from fuge.formats.op4 import op4_header, read_op4
from fuge.formats.text import PathLike, TextFile, read_text, refusal
from fuge.stiffness_rows import StiffnessFile

StiffnessFormat = Literal["any", "matrix_market", "calculix", "abaqus", "dmig", "op4"]

# A binary file begins with the length of its first record, six words of 4 or 8 bytes, in 4 or 8 bytes.
_BINARY = re.compile("[\x18\x30]\0\0\0|\0\0\0[\x00\x18\x30]")


def read_stiffness(
    path: PathLike,
    format: StiffnessFormat = "any",
    *,
    names_path: PathLike | None = None,
    name: str | None = None,
) -> StiffnessFile:
    """Read a stiffness matrix from a file of a finite element program.

    Both triangles are returned: if no entry of the file has its mirror image, the other triangle is filled in.

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
    InputError
        The format is unknown.
    """
    _arrays.choice("format", format, dict.fromkeys(get_args(StiffnessFormat), 0))
    file = read_text(path)
    names = _names(os.fspath(path), format, names_path)
    rows = 0 if names is None else len(names)
    if file.lines and _BINARY.match(file.lines[0]):
        raise refusal(path, "this is a binary file, as of OUTPUT4: only text is read, write it with FORM=FORMATTED")
    known = _recognised(file) if format == "any" else format
    if known == "matrix_market":
        return _from_matrix_market(path, names)
    if known == "dmig":
        entries = read_dmig(file, (name or "").strip())
    elif known == "op4":
        entries = read_op4(file, (name or "").strip(), rows)
    else:
        entries = read_entries(file, rows)
    return _both_triangles(file, entries, names)


def _names(path: str, format: StiffnessFormat, names_path: PathLike | None) -> Keys | None:
    if names_path is not None and os.fspath(names_path).strip():
        return read_row_names(names_path)
    if format in ("any", "calculix") and path[-4:].lower() == ".sti":
        return read_row_names(path[:-4] + ".dof")
    return None


def _recognised(file: TextFile) -> StiffnessFormat:
    """The format of the first line that is neither blank nor a comment."""
    if file.lines and file.lines[0][:14].lower() == "%%matrixmarket":
        return "matrix_market"
    line = next((line for line in file.lines if not SKIPPED.match(line)), "")
    if op4_header(line):
        return "op4"
    # A word of bulk data; DMIG need not be the first one.
    return "dmig" if re.match("[A-Za-z]", line) else "abaqus"


def _from_matrix_market(path: PathLike, names: Keys | None) -> StiffnessFile:
    matrix = read_sparse(path)
    rows, columns = matrix.shape
    if rows != columns:
        raise refusal(path, f"the file has a matrix of {rows} x {columns}: a stiffness matrix is square")
    if names is not None and len(names) != rows:
        raise refusal(path, f"the file has {rows} rows, but {len(names)} are named")
    return _named(matrix, names)


def _both_triangles(file: TextFile, entries: Entries, names: Keys | None) -> StiffnessFile:
    """Compressed columns; rows ascend by node and direction where the entries name them."""
    row, column, value, count = entries.row, entries.column, entries.value, len(entries.value)
    if count == 0:
        raise refusal(file.path, "the file has no entry of a matrix")
    if entries.names is not None:
        if names is not None:
            raise refusal(file.path, "the file names the nodes of its entries itself: pass no file of names")
        names, place = np.unique(np.concatenate([row, column, entries.names]), return_inverse=True)
        row, column = place[: 2 * count].reshape(2, -1)
    last = int(max(row.max(), column.max())) + 1
    rows = entries.rows or (last if names is None else len(names))
    if entries.names is None and names is not None and last < rows:
        reason = f"the file ends with row {last}, but {rows} rows are named: is it cut off, or of another model?"
        raise refusal(file.path, reason)
    if rows > count:
        reason = "each row of a stiffness matrix has one on the diagonal"
        raise refusal(file.path, f"the file has {count} entries for {rows} rows: {reason}")
    pair = np.maximum(row, column) * rows + np.minimum(row, column)
    positions, first = np.unique(2 * pair + (row < column), return_index=True)
    if len(first) < count:
        k = int(np.setdiff1d(np.arange(count), first)[0])
        where = " and ".join(row_name(int(i), names) for i in (max(row[k], column[k]), min(row[k], column[k])))
        reason = f"a second entry for {where}: the file was written twice, or into another one"
        raise file.refuse(int(entries.line[k]), reason)
    # Unless some pair of positions has two entries, the other triangle is the mirror image.
    if not entries.whole and np.all(np.diff(positions // 2)):
        row, column, value = mirrored(row, column, value)
    return _named(compressed_columns((rows, rows), row, column, value), names)


def _named(matrix: CompressedColumns, names: Keys | None) -> StiffnessFile:
    """A matrix with the names of its rows, 0 where none is known."""
    keys = np.zeros(matrix.shape[0], dtype=np.int64) if names is None else names
    node, direction = np.divmod(keys, DIRECTIONS)
    return StiffnessFile(
        matrix.shape, matrix.column, matrix.row, matrix.value, node.astype(np.intc), direction.astype(np.intc)
    )
