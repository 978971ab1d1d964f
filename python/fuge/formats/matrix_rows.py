"""Entries of a stiffness matrix on lines of their own, and the names of its rows.

Three columns, row, column and value: CalculiX (*FREQUENCY, SOLVER=MATRIXSTORAGE) and Abaqus (*MATRIX OUTPUT,
FORMAT=COORDINATE). Five, node, direction, node, direction and value: Abaqus (FORMAT=MATRIX INPUT).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fuge.formats.number_columns import Column, label_column, read_columns
from fuge.formats.text import LARGEST_LABEL, PathLike, Reason, TextFile, quoted, read_text, refusal, split_columns

Keys = NDArray[np.int64]
"""Names of rows: node * DIRECTIONS + direction."""

DIRECTIONS = 10000
"""A node has directions 1 to 6 for displacements and rotations, and more for other quantities."""

_NODE, _DIRECTION = label_column("node", -LARGEST_LABEL), label_column("direction", 0, DIRECTIONS - 1)

SKIPPED = re.compile(r"[ \t\r]*(?:[%#!$]|\*\*|$)")
"""Matches lines that are blank, or a comment of one of the programs."""

# What may stand above the entries; a scale factor, for one, would change them.
_KEYWORD = re.compile(
    r"\*matrix\s*(inp(ut?)?\s*)?(,\s*(name?\s*=[^,]*|type?\s*=\s*(stiffness|symmetric|unsymmetric)\s*))*$",
    re.IGNORECASE,
)
_NO_ENTRY = "{} is no entry of a matrix: give the file that *MATRIX OUTPUT writes"
_DOT = re.compile(r"(?<=\d)\.(?=\d)", re.ASCII)


@dataclass
class Entries:
    """Entries in the order of a file, and the line of each.

    Rows and columns count from 0, or are keys if there are `names`, the keys of all or some. `rows`: their number, 0 if
    only the entries say so. `whole`: an entry that is missing is zero; otherwise it may be that of the other triangle.
    """

    row: Keys
    column: Keys
    value: NDArray[np.float64]
    line: NDArray[np.int64]
    names: Keys | None = None
    rows: int = 0
    whole: bool = False


def row_name(row: int, names: Keys | None) -> str:
    """Node and direction of a row, from 0, for messages."""
    if names is None:
        return f"row {row + 1}"
    return "node {}, direction {}".format(*divmod(int(names[row]), DIRECTIONS))


def read_entries(file: TextFile, rows: int) -> Entries:
    """Read entries in three or five columns, as the first one has; three columns name up to `rows` rows, if not 0."""
    lines = _lines(file)
    while lines and _KEYWORD.match(file.lines[lines[0] - 1]):
        del lines[0]
    if not lines:
        raise refusal(file.path, "the file has no entry of a matrix")
    first = file.lines[lines[0] - 1]
    count = len(split_columns(first)[0])
    if count not in (3, 5):
        reason = (
            f"an entry has 3 columns (row, column, value) or 5 (node, direction, node, direction, value), not {count}"
        )
        raise file.refuse(lines[0], _NO_ENTRY.format(quoted(first)) if first[0] == "*" else reason)
    if count == 5:
        table = read_columns(file, lines, [_NODE, _DIRECTION, _NODE, _DIRECTION, Column()], _words, comma=True)
        row, column = table[0] * DIRECTIONS + table[1], table[2] * DIRECTIONS + table[3]
    else:
        labels = [label_column(name, 1, rows or LARGEST_LABEL - 1) for name in ("row", "column")]
        table = read_columns(file, lines, [*labels, Column()], _words, comma=True)
        row, column = table[0] - 1, table[1] - 1
    row, column = row.astype(np.int64), column.astype(np.int64)
    return Entries(row, column, table[-1], np.array(lines), names=row if count == 5 else None)


def read_row_names(path: PathLike) -> Keys:
    """Read the node and the direction of each row, from lines such as 17.3, or with a blank or a comma between them."""
    file = read_text(path)
    lines = _lines(file)
    if not lines:
        reason = "the file names no row: a line like 17.3 (node.direction) is needed for each"
        raise file.refuse(len(file.lines), reason)
    parted = TextFile(file.path, [_DOT.sub(" ", line) for line in file.lines])
    node, direction = read_columns(parted, lines, [_NODE, _DIRECTION], _name, comma=True)
    names: Keys = (node * DIRECTIONS + direction).astype(np.int64)
    _, first, place = np.unique(names, return_index=True, return_inverse=True)
    for k in np.flatnonzero(first[place] != np.arange(len(names))):
        reason = f"{row_name(int(k), names)} is the name of row {first[place][k] + 1} already"
        if file.path.endswith(".dof"):
            reason += ": CalculiX makes solids of beams, shells and some elements of a plane: use solid elements there"
        raise file.refuse(lines[k], reason)
    return names


def _lines(file: TextFile) -> list[int]:
    """The numbers of the lines that are neither blank nor a comment."""
    return [number for number, line in enumerate(file.lines, 1) if not SKIPPED.match(line)]


def _words(line: str, count: int) -> list[str]:
    words = split_columns(line)[0]
    if line[0] == "*":
        raise Reason(_NO_ENTRY.format(quoted(line)))
    if len(words) != count:
        raise Reason(f"{len(words)} column(s), but the first entry has {count}: is the file cut off?")
    return words


def _name(line: str, count: int) -> list[str]:
    words = split_columns(line)[0]
    if len(words) != count:
        raise Reason("the node and the direction of one row are needed here, like 17.3")
    return words
