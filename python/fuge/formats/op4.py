"""Matrices in formatted files of Nastran's module OUTPUT4.

Records: the header, NCOL NR FORM TYPE NAME FORMAT (4I8, 2A4, and the format of the values); for each column that is not
zero ICOL IROW NW (3I8); after the last one column NCOL + 1, with one value. A dense column has IROW > 0 and the values
from row IROW on. A sparse one has IROW = 0 and strings: the header IS = IROW + 65536 (L + 1), or L + 1 and IROW if NR
is negative (BIGMAT), and the values from row IROW on. L and NW count words, of which a value has two in double
precision, TYPE = 2; some programs give them in values. Only values have a decimal point.
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

from fuge.formats.matrix_rows import Entries
from fuge.formats.number_columns import BLANKS, Column, blank_words, blocks, read_words
from fuge.formats.text import Reason, TextFile, label, quoted, refusal, whole


class Op4Header(NamedTuple):
    """The header of a matrix."""

    columns: int
    rows: int
    type: int
    name: str
    # Of a value, in characters.
    width: int


class _Run(NamedTuple):
    """A dense column or a string: its column, its first row, and how many words or values it should have."""

    column: int
    row: int
    announced: int


# Number, column and row of the first value, and how many values are on a line.
_ValueLine = tuple[int, int, int, int]


def op4_header(line: str) -> Op4Header | None:
    """The header that a line is: four whole numbers of eight columns, and a name."""
    columns, rows, _, number_type = [whole(line[k : k + 8].strip(" ")) for k in range(0, 32, 8)]
    name = line[32:40].rstrip(" \r")
    if columns is None or rows is None or number_type is None or not re.match("[A-Za-z]", name):
        return None
    width = re.search("[EDG](\\d*)", line[40:], re.IGNORECASE | re.ASCII)
    known = width is not None and re.fullmatch("[89]|[1-5]\\d|6[0-4]", width[1])
    return Op4Header(columns, abs(rows), number_type, name, int(known[0]) if known else 16)


def read_op4(file: TextFile, name: str, rows: int) -> Entries:
    """Read the matrix called `name`, or the only one if it is blank, of so many rows, unless 0; without its zeros."""
    seen, chosen, k = "", None, 0
    while k < len(file.lines) and not (chosen and name):
        if not file.lines[k].strip(BLANKS):
            k += 1
            continue
        header = op4_header(file.lines[k])
        if header is None:
            raise file.refuse(k + 1, "the header of a matrix is needed here: columns, rows, form, type (4I8) and name")
        if chosen:
            both = f"{quoted(seen)} and {quoted(header.name)}"
            raise file.refuse(k + 1, f"the file holds the matrices {both}: pass the name of the one to read")
        seen = header.name
        kept = name.lower() in ("", seen.lower())
        if kept:
            _check_form(file, k + 1, header, rows)
        lines, k = _value_lines(file, k + 1, header)
        if kept:
            chosen = header, lines
    if chosen is None:
        raise refusal(file.path, f"the file has no matrix {quoted(name)}, but {quoted(seen)}")
    return _entries(file, *chosen)


def _check_form(file: TextFile, number: int, header: Op4Header, rows: int) -> None:
    reason = ""
    if header.type not in (1, 2):
        reason = "is not real: a stiffness matrix has the type 1 or 2"
    elif header.columns < 1 or header.rows != header.columns:
        reason = f"is {header.rows} x {header.columns}: a stiffness matrix is square"
    elif rows not in (0, header.columns):
        reason = f"has {header.columns} rows, but {rows} are named"
    if reason:
        raise file.refuse(number, f"the matrix {quoted(header.name)} {reason}")


def _value_lines(file: TextFile, begin: int, header: Op4Header) -> tuple[list[_ValueLine], int]:
    """The lines of values up to the column after the last one, and the index of the line that follows."""
    lines: list[_ValueLine] = []
    run, found = _Run(0, 0, 0), 0
    for k in range(begin, len(file.lines)):
        line = file.lines[k].rstrip(" \r")
        try:
            if "." in line:
                if run.column > header.columns:
                    return lines, k + 1
                if run.row == 0:
                    raise Reason("values before the header of their column or string")
                count = -(-len(line) // header.width)
                lines.append((k + 1, run.column, run.row + found, count))
                found += count
                if run.row + found > header.rows + 1:
                    raise Reason(f"row {header.rows + 1} is outside 1 .. {header.rows}")
            elif line.strip(BLANKS):
                run, found = _next_run(line, run, found, header), 0
        except Reason as reason:
            raise file.refuse(k + 1, reason) from None
    if run.column > header.columns:
        return lines, len(file.lines)
    where = f"in or before column {min(run.column + 1, header.columns)} of {header.columns}"
    missing = "and without the column after the last one: is it cut off?"
    raise file.refuse(len(file.lines), f"the file ends {where}, {missing}")


def _next_run(line: str, run: _Run, found: int, header: Op4Header) -> _Run:
    """The header of a column, three numbers, or of a string, one or two."""
    words = 2 if header.type in (2, 4) else 1
    if run.announced not in (found, found * words):
        announced = f"{run.announced} words of {words} for each value are announced"
        raise Reason(f"column {run.column} has {found} values above this line, but {announced}")
    numbers = [label(word, "number", 0) for word in blank_words(line)]
    if len(numbers) > 3:
        raise Reason("values with a decimal point, or the header of a column or of a string are needed here")
    if len(numbers) < 3:
        if run.column == 0:
            raise Reason("a string before the first column")
        length, row = numbers if len(numbers) == 2 else divmod(numbers[0], 65536)
        column, announced_words, first_row = run.column, max(length - 1, 0), 1
    else:
        column, row, announced_words = numbers
        if not run.column < column <= header.columns + 1:
            last = f"columns ascend, up to {header.columns + 1} after the last one"
            raise Reason(f"column {column} after column {run.column}: {last}")
        first_row = 0
    if not first_row <= row <= header.rows:
        raise Reason(f"row {row} is outside 1 .. {header.rows}")
    return _Run(column, row, announced_words if row else 0)


def _entries(file: TextFile, header: Op4Header, lines: list[_ValueLine]) -> Entries:
    values = [np.empty(0)]
    for block in blocks(lines):
        text = "".join([file.lines[k - 1].rstrip(" \r").ljust(n * header.width) for k, _, _, n in block])
        words = [text[k : k + header.width] for k in range(0, len(text), header.width)]
        numbers = np.repeat([k for k, _, _, _ in block], [n for _, _, _, n in block])
        values.append(read_words(file, numbers.tolist(), [words], [Column()])[0])
    value = np.concatenate(values)
    line, column, row, count = np.array(lines, dtype=np.int64).reshape(-1, 4).T
    row = np.repeat(row - 1 - np.cumsum(count) + count, count) + np.arange(len(value))
    kept = value != 0.0
    line, column = np.repeat(line, count), np.repeat(column - 1, count)
    return Entries(row[kept], column[kept], value[kept], line[kept], rows=header.columns)
