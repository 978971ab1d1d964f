"""Tables whose columns have names, given by a heading or by their order.

Columns stand between commas, semicolons or tabs, else between blanks; comments go from # or ! on, and on lines from **
on. Names in double quotes may have any of these.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

from fuge.formats.text import PathLike, Place, Reason, located, quoted, read_text

# Quotes at the begin of a column, and comments.
_QUOTED = re.compile(r'(?<![^,;\t ])"[^"]*"')
_COMMENT = re.compile(r"(?<![^,;\t ])[#!]|^[ \t]*\*\*")


def begins_with_word(cells: Sequence[str]) -> bool:
    """Whether the first cell of a line is no number."""
    return cells[0][:1] not in set("0123456789+-.")


def named_rows(
    path: PathLike,
    columns: Sequence[str],
    synonyms: Mapping[str, str],
    is_heading: Callable[[Sequence[str]], bool] = begins_with_word,
) -> Iterator[tuple[Place, dict[str, str]]]:
    """Lines of a table by the names of their columns.

    A heading names them, and goes on as `columns` if it begins as they do; without a heading they are `columns`.
    """
    names = columns
    seen = False
    for place, cells in rows(path):
        with located(place):
            if not seen and is_heading(cells):
                names = _headings(cells, columns, synonyms)
            elif len(cells) > len(names):
                raise Reason(f"there are more columns than {', '.join(names)}")
            else:
                yield place, dict(zip(names, cells))
        seen = True


def _headings(cells: Sequence[str], columns: Sequence[str], synonyms: Mapping[str, str]) -> Sequence[str]:
    names = [synonyms.get(cell.lower(), cell.lower()) for cell in cells]
    for cell, name in zip(cells, names):
        if name not in columns:
            raise Reason(f"there is no column {quoted(cell)}: columns are {', '.join(columns)}")
    check_unique(names)
    return [*names, *columns[len(names) :]] if names == list(columns[: len(names)]) else names


def check_unique(names: Sequence[str]) -> None:
    """Reason if two columns have the same name."""
    for k, name in enumerate(names):
        if name in names[:k]:
            raise Reason(f"two columns have the name {quoted(name)}")


def rows(path: PathLike) -> Iterator[tuple[Place, list[str]]]:
    """The cells of each line that has some."""
    file = read_text(path)
    for number, line in enumerate(file.lines, 1):
        place = Place(file.path, number)
        with located(place):
            cells = _cells(line)
        if cells:
            yield place, cells


def _cells(line: str) -> list[str]:
    """What stands between the separators of a line, without outer blanks and without empty cells at the end."""
    # Of the same length, without separators in quotes.
    bare = _QUOTED.sub(lambda name: "x" * len(name[0]), line)
    comment = _COMMENT.search(bare)
    bare = bare[: comment.start()] if comment else bare
    if "," in bare and ";" in bare:
        raise Reason("commas and semicolons on one line: separate columns by one of them, and write decimal points")
    bare = bare.rstrip(" \t\r,;")
    separator = next((letter for letter in ",;\t" if letter in bare), None)
    if separator is None:
        return [line[slice(*cell.span())] for cell in re.finditer(r"\S+", bare)]
    cells, begin = [], 0
    for cell in bare.split(separator):
        cells.append(line[begin : begin + len(cell)].strip())
        begin += len(cell) + 1
    return cells
