"""Tables of results: CSV with comments after #, and the same as JSON."""

from __future__ import annotations

import errno
import json
import math
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, Literal, TextIO, Union

import numpy as np
from numpy.typing import NDArray

from fuge.errors import FileError, Status
from fuge.formats.text import quoted_path

# Lines that are written in one piece.
_PIECE = 10000


def number_text(value: float, digits: int = 16, width: int = 0) -> str:
    """A number with an exponent of three digits, right-justified."""
    if not math.isfinite(value):
        text = "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"
        return text.rjust(width)
    text = f"{value:.{digits}E}"
    if text[-3] in "+-":
        text = f"{text[:-2]}0{text[-2:]}"
    return text.rjust(width)


def short_text(value: float) -> str:
    """A number to six digits, for comments."""
    return number_text(value, 5)


def long_text(value: float) -> str:
    """A number with all its digits, for comments."""
    return number_text(value, 16, 24)


@dataclass
class Column:
    """A column of a table: whole numbers, words, or numbers with so many digits in so many places; NaN is blank."""

    name: str
    values: Union[Sequence[Any], NDArray[Any]]
    width: int = 24
    digits: int = 16

    def plain(self) -> list[Any]:
        """The values as numbers and words of Python."""
        return self.values.tolist() if isinstance(self.values, np.ndarray) else list(self.values)

    def texts(self) -> Iterator[str]:
        """The values as a table has them."""
        for value in self.plain():
            if isinstance(value, float):
                yield "" if math.isnan(value) else number_text(value, self.digits, self.width)
            else:
                yield _quoted(str(value))


@dataclass
class Table:
    """Columns of one length, and comments above them."""

    columns: list[Column]
    comments: list[str] = field(default_factory=list)
    # A line is left blank after so many rows, as gnuplot needs it for maps.
    block: int = 0

    def lines(self) -> Iterator[str]:
        """The lines of the CSV file."""
        yield from (f"# {comment}" for comment in self.comments)
        yield ",".join(_quoted(column.name) for column in self.columns)
        for number, row in enumerate(zip(*(column.texts() for column in self.columns))):
            if self.block and number and number % self.block == 0:
                yield ""
            yield ",".join(row)

    def json_lines(self) -> Iterator[str]:
        """Comments, names of columns and rows as JSON; what is infinite or not a number is null."""
        names = [column.name for column in self.columns]
        yield f'{{"comments": {json.dumps(self.comments)},\n"columns": {json.dumps(names)},\n"rows": ['
        before = ""
        for row in zip(*(column.plain() for column in self.columns)):
            known = [None if isinstance(value, float) and not math.isfinite(value) else value for value in row]
            yield before + json.dumps(known)
            before = ","
        yield "]}"


def _quoted(word: str) -> str:
    """A word for CSV: in quotes where it has a comma or a quote."""
    return '"' + word.replace('"', '""') + '"' if "," in word or '"' in word else word


def write_lines(path: str, lines: Iterable[str]) -> None:
    """Write lines to a file, which is replaced, or to standard output if the path is empty; FileError."""
    with written(path), open_file(path, "w") if path else nullcontext(sys.stdout) as file:
        if file is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        rest = iter(lines)
        while piece := list(islice(rest, _PIECE)):
            file.write("\n".join(piece) + "\n")
        file.flush()


def open_file(path: str, mode: Literal["w", "a"]) -> TextIO:
    """Open a file for writing; names keep their bytes, whatever their encoding is. Errors: FileError."""
    try:
        return open(path, mode, encoding="utf-8", errors="surrogateescape", newline="\n")
    except (OSError, ValueError) as failure:
        raise _failed(path, "opened", failure) from None


@contextmanager
def written(path: str) -> Iterator[None]:
    """Make a FileError of what goes wrong, and leave no part of the file."""
    try:
        yield
    except FileError:
        raise
    except OSError as failure:
        if not path:
            _drop_output()
        elif os.path.isfile(path):
            os.remove(os.path.realpath(path))
        if not path and isinstance(failure, BrokenPipeError):
            raise
        raise _failed(path, "written", failure) from None


def _failed(path: str, verb: str, failure: Exception) -> FileError:
    what = quoted_path(path) if path else "standard output"
    return FileError(f"{what} cannot be {verb}: {getattr(failure, 'strerror', None) or failure}", Status.ERR_FILE)


def _drop_output() -> None:
    """Let what standard output has not taken go nowhere when Python flushes it at its end."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
