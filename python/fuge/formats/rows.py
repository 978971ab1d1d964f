"""Rows of numbers in text: columns between blanks, commas or semicolons, up to a comment."""

from __future__ import annotations

import io
import math
import re
from array import array
from dataclasses import dataclass
from itertools import islice
from typing import Iterator, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge.errors import FileError
from fuge.formats.text import Place, Reason, located, quoted, refusal, split_columns, value
from fuge.heights import LARGEST, first_place

_NAMES = {" ": "blanks", ",": "commas", ";": "semicolons"}

_UNMEASURED = re.compile(r"(?:[+-]?nan(?:\(.*)?|bad)?", re.IGNORECASE)
# What is a number, may be a damaged one, or stands for one.
_NO_WORD = re.compile(r"[0-9+\-.*].*|inf(?:inity)?|" + _UNMEASURED.pattern, re.IGNORECASE | re.DOTALL)
# Nastran has exponents without a letter; elsewhere 1-2 is what is left of two numbers.
_BARE_EXPONENT = re.compile(r"[0-9.][+-]")
_HOLES = {b"BAD": b"nan", b"": b"nan"}
# What numbers, NaN and BAD consist of, and what stands between them.
_PLAIN = b"0123456789+-.eEnNaABD,; \t\r\n"


class _Form(NamedTuple):
    """The form of all rows, taken from the first one."""

    line: int
    columns: int
    separator: str


@dataclass(frozen=True)
class Rows:
    """Rows of numbers, shape (rows, columns), NaN where there is none; their lines, and the lines before them."""

    path: str
    values: NDArray[np.float64]
    line: array[int]
    header: list[str]

    def refuse(self, row: int, reason: str) -> FileError:
        """The error that a row cannot be read."""
        return refusal(Place(self.path, self.line[row]), reason)


def lines(content: bytes) -> Iterator[tuple[int, bytes]]:
    """The lines of a file with their numbers."""
    return enumerate(io.BytesIO(content), 1)


def text(line: bytes) -> str:
    """A line without its end; letters that are not UTF-8 keep their bytes."""
    return line.decode("utf-8", errors="surrogateescape").rstrip("\n")


def number(word: str) -> float:
    """A finite number, with a decimal point and an exponent after e or d."""
    if _BARE_EXPONENT.search(word):
        raise Reason(f"{quoted(word)} is not a number")
    return value(word)


def height(word: str) -> float:
    """A height, or NaN for a point that was not measured: an empty column, NaN or BAD."""
    return math.nan if _UNMEASURED.fullmatch(word) else number(word)


def is_word(column: str) -> bool:
    """Is a column neither a number, nor what looks like a damaged one, nor NaN, BAD or infinity?"""
    return not _NO_WORD.fullmatch(column)


def plain_heights(line: bytes, separator: bytes | None = None) -> list[float] | None:
    """The heights of a line that has nothing else but the separator, None stands for blanks; None of other lines."""
    if line.translate(None, _PLAIN):
        return None
    words = line.split(separator)
    if b"BAD" in line or separator and b"" in words:
        words = [_HOLES.get(word, word) for word in words]
    try:
        return list(map(float, words))
    except ValueError:
        return None


def _first_row(path: str, content: bytes) -> _Form:
    """The first row, after lines of words: those without a number, or that begin with a word and are shorter.

    A line that begins with a word and is as long may be a damaged row: it is taken for the first one, and refused when
    it is read.
    """
    count, doubtful = 0, _Form(0, 0, "")
    for count, line in lines(content):
        words, separators = split_columns(text(line))
        if all(map(is_word, words)):
            continue
        form = _Form(count, len(words), separators[0] if separators else "")
        if not is_word(words[0]):
            break
        doubtful = max(doubtful, form, key=lambda form: form.columns)
    else:
        form = doubtful
    if form.columns == 0:
        raise refusal(Place(path, count) if count else path, "the file has no row of numbers")
    return form if form.columns > doubtful.columns else doubtful


def _row(line: bytes, form: _Form) -> list[float]:
    """The heights of any line; none if it is blank or a comment."""
    words, separators = split_columns(text(line))
    for separator in separators[: form.columns] if form.columns > 1 else ():
        if separator != form.separator:
            kinds = f"{_NAMES[form.separator]} and by {_NAMES[separator]}"
            raise Reason(f"columns are separated by {kinds}: numbers need a decimal point, not a comma")
    row = [height(word) for word in words[: form.columns]]
    if len(words) == form.columns - 1 and separators[len(words) - 1 :] in ([","], [";"]):
        row.append(math.nan)
    elif words and len(words) != form.columns:
        raise Reason(f"{len(words)} value(s), but the first row has {form.columns}")
    return row


def read_rows(path: str, content: bytes) -> Rows:
    """All rows of a text file; FileError if one has another form than the first, or anything but heights."""
    form = _first_row(path, content)
    separator = form.separator.strip().encode() or None
    values, numbers = array("d"), array("L")
    for count, line in islice(lines(content), form.line - 1, None):
        row = plain_heights(line, separator)
        if row is None or len(row) != form.columns:
            with located(Place(path, count)):
                row = _row(line, form)
        if row:
            values.fromlist(row)
            numbers.append(count)
    header = [text(line) for _, line in islice(lines(content), form.line - 1)]
    rows = Rows(path, np.frombuffer(values).reshape(-1, form.columns), numbers, header)
    for place in first_place(np.abs(rows.values) > LARGEST):
        raise rows.refuse(place[0], f"{rows.values[place]:.7g} is out of range: choose another unit of length")
    return rows
