"""Numbers in columns of text: many lines at once, and word by word where one of them is wrong."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any, Callable, NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

from fuge.formats.text import BLANKS, LARGEST_LABEL, TextFile, label, located, value

Table = NDArray[np.float64]
"""A row for each column of the text; labels are exact."""

Numbers = Union[Sequence[int], NDArray[np.int64]]
"""Numbers of lines, from 1."""

_LARGEST = float(np.finfo(float).max)
# Where the letter of an exponent is missing, as in 3.+5.
_NO_LETTER = re.compile(r"(?<=[\d.])(?=[+-])", re.ASCII)
# `str.split` also parts at control characters, which are no blanks here.
_TEXT = bytes([*b"\t\n\r", *range(32, 127)])


class Column(NamedTuple):
    """What stands in a column: `read` makes a number of a word, or says by a Reason why it is none.

    Words of `letters` are between `least` and `most`, where `float` reads them as `read` does; others take longer.
    """

    read: Callable[[str], float] = value
    letters: bytes = b"+-.0123456789DEde"
    least: float = -_LARGEST
    most: float = _LARGEST


def label_column(name: str, least: int = 1, most: int = LARGEST_LABEL) -> Column:
    """A column of whole numbers in a range, which messages call `name`."""
    return Column(lambda word: label(word, name, least, most), b"+-0123456789", least, most)


def read_columns(
    file: TextFile,
    numbers: Numbers,
    columns: Sequence[Column],
    split: Callable[[str, int], list[str]],
    comma: bool = False,
) -> Table:
    """The numbers on the lines `numbers` of a file, shape (columns, lines); FileError if one is wrong or missing.

    `split` parts a line into its words, of which there should be so many, and raises a Reason if there are more. With
    `comma` a comma may part them.
    """
    tables = [np.empty((len(columns), 0))]
    for block in blocks(numbers):
        lines = [file.lines[number - 1] for number in block]
        table = _at_once(_plain_words(lines, len(columns), comma), columns)
        tables.append(_one_by_one(file, block, lines, columns, split) if table is None else table)
    return np.hstack(tables)


def read_words(file: TextFile, numbers: Numbers, words: Sequence[Sequence[str]], columns: Sequence[Column]) -> Table:
    """As `read_columns`, of words with blanks around them, a sequence for each column; `numbers` are their lines."""
    table = _at_once(words, columns)
    if table is None:
        rows = [[word.strip(" ") for word in row] for row in zip(*words)]
        return _one_by_one(file, numbers, rows, columns, lambda row, _: row)
    return table


def blocks(items: Any) -> Iterator[Any]:
    """Parts of a long sequence, so that the words of a few lines only are in memory at a time."""
    return (items[begin : begin + 50000] for begin in range(0, len(items), 50000))


def blank_words(line: str) -> list[str]:
    """The words of a line between blanks."""
    return re.split("[ \t\r]+", line.strip(BLANKS))


def _plain_words(lines: list[str], count: int, comma: bool) -> list[list[str]]:
    """The words of each column, if all lines have `count` words between blanks, or between commas; else nothing."""
    text = "\n".join(lines) + "\n"
    if not text.isascii() or text.encode().translate(None, _TEXT):
        return []
    commas = comma and "," in lines[0]
    step, stride = (2, 2 * count) if commas else (1, count + 1)
    words = text.replace(",", " , ").replace("\n", " ; ").split()
    if len(words) != stride * len(lines) or words[stride - 1 :: stride].count(";") != len(lines):
        return []
    if commas and words[1::2].count(",") != (count - 1) * len(lines):
        return []
    return [words[step * k :: stride] for k in range(count)]


def _at_once(words: Sequence[Sequence[str]], columns: Sequence[Column]) -> Table | None:
    """The numbers, or None if their spelling or size is not plain."""
    rows = []
    for texts, column in zip(words, columns):
        text = "\n".join(texts)
        if not text.isascii() or text.encode().translate(None, column.letters + b" \n"):
            return None
        numbers = _floats(text.replace("D", "e").replace("d", "e"))
        if numbers is None and column.read is value:
            numbers = _floats(_NO_LETTER.sub("e", text))
        if numbers is None or not np.all((column.least <= numbers) & (numbers <= column.most)):
            return None
        rows.append(numbers)
    return np.array(rows) if rows else None


def _floats(text: str) -> NDArray[np.float64] | None:
    """The numbers on the lines of a text; None if there is a blank one, or none at all."""
    try:
        return np.array(list(map(float, text.split("\n"))))
    except ValueError:
        return None


def _one_by_one(
    file: TextFile, numbers: Numbers, items: list[Any], columns: Sequence[Column], split: Callable[..., list[str]]
) -> Table:
    """The numbers in any spelling; refuses the first line that cannot be read."""
    table = np.empty((len(columns), len(items)))
    for k, item in enumerate(items):
        with located(file.place(int(numbers[k]))):
            words = split(item, len(columns))
            table[:, k] = [column.read(word) for column, word in zip(columns, [*words, *[""] * len(columns)])]
    return table
