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
from fuge.formats.number_columns import Column, blocks, read_words
from fuge.formats.text import BLANKS, Reason, TextFile, located, quoted, refusal, whole


class Op4Header(NamedTuple):
    """The header of a matrix."""

    columns: int
    rows: int
    type: int
    name: str
    # Of a value: characters, and words in memory.
    width: int
    words: int


# A dense column or a string: its column, its first row, and how many words or values it should have.
_Run = tuple[int, int, int]
# Lines of values: number, column and row of the first value, and how many values, one after the other.
_ValueLines = list[int]

# The header of a column, three numbers, or of a string, one or two.
_RUN = re.compile(r"[ \t]*(\d{1,10})(?:[ \t]+(\d{1,10}))?(?:[ \t]+(\d{1,10}))?[ \t]*", re.ASCII)


def op4_header(line: str) -> Op4Header | None:
    """The header that a line is: four whole numbers of eight columns, and a name."""
    columns, rows, form, number_type = [whole(line[k : k + 8].strip(" ")) for k in range(0, 32, 8)]
    name = line[32:40].rstrip(" \r")
    if columns is None or rows is None or form is None or number_type is None or not re.match("[A-Za-z]", name):
        return None
    width = re.search("[EDG](\\d*)", line[40:], re.IGNORECASE | re.ASCII)
    known = width is not None and re.fullmatch("[89]|[1-5]\\d|6[0-4]", width[1])
    words = 2 if number_type in (2, 4) else 1
    return Op4Header(columns, abs(rows), number_type, name, int(known[0]) if known else 16, words)


def read_op4(file: TextFile, name: str, rows: int) -> Entries:
    """Read the matrix called `name`, or the only one if it is blank, of so many rows, unless 0; without its zeros."""
    seen, chosen, k = "", None, 0
    while k < len(file.lines):
        if not file.lines[k].strip(BLANKS):
            k += 1
            continue
        header = op4_header(file.lines[k])
        if header is None:
            raise file.refuse(k + 1, "the header of a matrix is needed here: columns, rows, form, type (4I8) and name")
        if chosen and name:
            break
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


def _value_lines(file: TextFile, begin: int, header: Op4Header) -> tuple[_ValueLines, int]:
    """The lines of values up to the column after the last one, and the index of the line that follows."""
    lines: _ValueLines = []
    column, row, announced, found = 0, 0, 0, 0
    for k in range(begin, len(file.lines)):
        line = file.lines[k].rstrip(" \r")
        if "." in line:
            if column > header.columns:
                return lines, k + 1
            if row == 0:
                raise file.refuse(k + 1, "values before the header of their column or string")
            count = -(-len(line) // header.width)
            lines += (k + 1, column, row + found, count)
            found += count
            if row + found > header.rows + 1:
                raise file.refuse(k + 1, f"row {header.rows + 1} is outside 1 .. {header.rows}")
        elif line.strip(BLANKS):
            with located(file.place(k + 1)):
                if announced not in (found, found * header.words):
                    words = f"{announced} words of {header.words} for each value are announced"
                    raise Reason(f"column {column} has {found} values above this line, but {words}")
                (column, row, announced), found = _next_run(line, column, header), 0
    if column > header.columns:
        return lines, len(file.lines)
    where = f"in or before column {min(column + 1, header.columns)} of {header.columns}"
    missing = "and without the column after the last one: is it cut off?"
    raise file.refuse(len(file.lines), f"the file ends {where}, {missing}")


def _next_run(line: str, column: int, header: Op4Header) -> _Run:
    """The run whose header is a line, in or after a column."""
    match = _RUN.fullmatch(line)
    if match is None:
        raise Reason("values with a decimal point, or the header of a column or of a string are needed here")
    first, second, third = match.groups()
    if third is None:
        if column == 0:
            raise Reason("a string before the first column")
        length, row = divmod(int(first), 65536) if second is None else (int(first), int(second))
        announced = max(length - 1, 0)
    else:
        before, column, row = column, int(first), int(second)
        if not before < column <= header.columns + 1:
            last = f"columns ascend, up to {header.columns + 1} after the last one"
            raise Reason(f"column {column} after column {before}: {last}")
        announced = int(third) if row else 0
    if not (third is None) <= row <= header.rows:
        raise Reason(f"row {row} is outside 1 .. {header.rows}")
    return column, row, announced


def _entries(file: TextFile, header: Op4Header, lines: _ValueLines) -> Entries:
    table = np.array(lines, dtype=np.int64).reshape(-1, 4)
    values = [np.empty(0)]
    for number, many in zip(blocks(table[:, 0]), blocks(table[:, 3])):
        lengths = zip(number.tolist(), (many * header.width).tolist())
        text = "".join([file.lines[k - 1].rstrip(" \r").ljust(length) for k, length in lengths])
        words = [text[k : k + header.width] for k in range(0, len(text), header.width)]
        values.append(read_words(file, np.repeat(number, many), [words], [Column()])[0])
    value = np.concatenate(values)
    count = table[:, 3]
    line, column, row = np.repeat(table[:, :3], count, axis=0).T
    row = row + np.arange(len(value)) - np.repeat(np.cumsum(count) - count, count)
    kept = value != 0.0
    return Entries(row[kept] - 1, column[kept] - 1, value[kept], line[kept], rows=header.columns)
