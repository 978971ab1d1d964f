"""Text files and the numbers in them; what cannot be read is refused with its file and line."""

from __future__ import annotations

import math
import os
import re
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import NamedTuple, Union

from fuge.errors import FileError, Status

PathLike = Union[str, "os.PathLike[str]"]

LARGEST_LABEL = 2**31 - 1

# Ends of long paths and beginnings of long words in messages.
_PATH_LENGTH, _QUOTE_LENGTH = 100, 24

# Most files that include each other in turn, and most inclusions in all: files that include others twice double them.
_MOST_FILES, _MOST_INCLUDED = 16, 10000

# 1.5, .5e3, 1d-4 and, as Nastran has it, 3.+5.
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))(?:[eEdD]([+-]?\d+)|([+-]\d+))?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf(?:inity)?)", re.IGNORECASE)
_WHOLE = re.compile(r"[+-]?\d+", re.ASCII)

BLANKS = " \t\r"
# Columns stand between commas or semicolons, else between blanks.
_SEPARATOR = re.compile(r"[ \t\r]*([,;])[ \t\r]*|[ \t\r]+")
_COMMENT = re.compile(r"(?<![^ \t\r,;])[#!].*", re.DOTALL)


class Reason(Exception):
    """Why a line cannot be read; whoever knows its place makes a FileError of it."""


class Place(NamedTuple):
    """A line of a file, counted from 1."""

    path: str
    line: int

    def __str__(self) -> str:
        return f"{quoted_path(self.path)}, line {self.line}"


def refusal(place: Place | PathLike, reason: object) -> FileError:
    """The error that a file, or a line of it, cannot be read for this reason."""
    where = place if isinstance(place, Place) else quoted_path(place)
    return FileError(f"{where}: {reason}", Status.ERR_FILE)


class located:
    """A context that makes a FileError with this place of a Reason."""

    def __init__(self, place: Place | PathLike) -> None:
        self._place = place

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, reason: object, trace: object) -> None:
        if isinstance(reason, Reason):
            raise refusal(self._place, reason) from None


@contextmanager
def named(name: str) -> Iterator[None]:
    """Put a name before a Reason."""
    try:
        yield
    except Reason as reason:
        raise Reason(f"{name}: {reason}") from None


def quoted_path(path: PathLike) -> str:
    """A path for messages: in quotes, only the end of a long one, control characters as ?."""
    name = os.fspath(path)
    if len(name) > _PATH_LENGTH:
        name = f"..{name[-_PATH_LENGTH:]}"
    return '"' + "".join(letter if letter.isprintable() else "?" for letter in name) + '"'


def quoted(text: str) -> str:
    """Text for messages: its beginning in quotes, what cannot be printed as ?, quotes as '."""
    shown = text if len(text) <= _QUOTE_LENGTH else f"{text[:_QUOTE_LENGTH]}.."
    return '"' + "".join(letter if letter.isprintable() else "?" for letter in shown).replace('"', "'") + '"'


def read_bytes(path: PathLike) -> bytes:
    """All of a regular file; FileError if it is a device, a pipe or a folder, or cannot be read."""
    if not os.fspath(path).strip():
        raise FileError("the path is blank: pass the path of a file", Status.ERR_FILE)
    try:
        # A pipe would wait for its other end.
        if not stat.S_ISREG(os.stat(path).st_mode):
            reason = "is a device, a pipe or a folder: only a regular file can be read"
            raise FileError(f"{quoted_path(path)} {reason}", Status.ERR_FILE)
        with open(path, "rb") as file:
            return file.read()
    except (OSError, ValueError) as failure:
        if isinstance(failure, FileError):
            raise
        cause = getattr(failure, "strerror", None) or failure
        raise FileError(f"{quoted_path(path)} cannot be opened: {cause}", Status.ERR_FILE) from None


@dataclass(frozen=True)
class TextFile:
    """The lines of a text file, without their ends."""

    path: str
    lines: list[str]

    def place(self, number: int) -> Place | PathLike:
        """The place of line `number`, from 1; an empty file has no line."""
        return Place(self.path, number) if self.lines else self.path

    def refuse(self, number: int, reason: object) -> FileError:
        """The error that line `number` cannot be read."""
        return refusal(self.place(number), reason)


def read_text(path: PathLike) -> TextFile:
    """Read a text file; a byte order mark and the line ends of Windows are taken away."""
    content = read_bytes(path).removeprefix(b"\xef\xbb\xbf")
    # Names keep their bytes, whatever their encoding is.
    text = content.decode("utf-8", errors="surrogateescape")
    lines = text.split("\n")
    if lines[-1] == "":
        lines.pop()
    return TextFile(os.fspath(path), [line.removesuffix("\r") for line in lines])


class Inclusions:
    """Reads a file and those that it includes, whose paths begin at its folder; `paths` gets the path of each once."""

    def __init__(self, path: PathLike, paths: list[str]) -> None:
        self._folder, self._paths, self._count = os.path.dirname(os.fspath(path)), paths, 0

    def read(self, path: PathLike) -> TextFile:
        """The file itself."""
        file = read_text(path)
        if file.path not in self._paths:
            self._paths.append(file.path)
        return file

    def include(self, path: str, depth: int) -> TextFile:
        """A file that is included while `depth` files are open; Reason if there are too many, or too many in all."""
        self._count += 1
        if depth == _MOST_FILES:
            raise Reason(f"more than {_MOST_FILES} files include each other: does one include itself?")
        if self._count > _MOST_INCLUDED:
            raise Reason(f"more than {_MOST_INCLUDED} files are included: do they include others twice?")
        try:
            return self.read(os.path.join(self._folder, path))
        except FileError as failure:
            raise Reason(f"the included file {failure.message}") from None


def split_columns(line: str) -> tuple[list[str], list[str]]:
    """The columns of a line up to a comment, and the separators after them; the last column may have one."""
    content = _COMMENT.sub("", line).strip(BLANKS)
    parts = _SEPARATOR.split(content) if content else []
    return parts[::2] if content and parts[-1] else parts[:-1:2], [separator or " " for separator in parts[1::2]]


def value(text: str) -> float:
    """A number of a file: an exponent after e, d or, as in 3.+5, after its sign; Reason if it is not finite."""
    match = _NUMBER.fullmatch(text)
    if match is None:
        if not text:
            raise Reason("the value is missing")
        finite = "finite " if _NOT_FINITE.fullmatch(text) else ""
        raise Reason(f"{quoted(text)} is not a {finite}number")
    number = float(f"{match[1]}e{match[2] or match[3] or 0}")
    if not math.isfinite(number):
        raise Reason(f"{quoted(text)} is not a finite number")
    return number


def whole(text: str) -> int | None:
    """A whole number, or None if the text is none."""
    return int(text) if _WHOLE.fullmatch(text) and len(text) < 20 else None


def label(text: str, name: str, least: int = 1, most: int = LARGEST_LABEL) -> int:
    """A whole number in a range, called `name` in the Reason if it is none."""
    if not text:
        raise Reason(f"the {name} is missing")
    number = whole(text)
    if number is None:
        raise Reason(f"{name} {quoted(text)} is not a whole number")
    if not least <= number <= most:
        raise Reason(f"{name} {quoted(text)} is outside {least} .. {most}")
    return number


def write_text(path: PathLike, parts: Iterable[str]) -> None:
    """Create a file, or replace it; FileError if it cannot be opened, or not be written: it is then empty."""
    if not os.fspath(path).strip():
        raise FileError("the path is blank: pass the path of a file", Status.ERR_FILE)
    opened = False
    # Half of a matrix or a surface could be read as a smaller one.
    try:
        with open(path, "w", encoding="utf-8", newline="") as file:
            opened = True
            file.writelines(parts)
    except (OSError, ValueError) as failure:
        cause = getattr(failure, "strerror", None) or failure
        if opened and os.path.isfile(path):
            os.truncate(path, 0)
        verb = "written" if opened else "opened"
        raise FileError(f"{quoted_path(path)} cannot be {verb}: {cause}", Status.ERR_FILE) from None
