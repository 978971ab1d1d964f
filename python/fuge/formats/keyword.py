"""Input files of Abaqus and CalculiX: keyword lines, and the data lines below them."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import PurePath

from fuge.formats.text import PathLike, Place, TextFile, read_text, refusal

# Most files that include each other in turn, and most inclusions in all: files that include others twice double them.
_MOST_FILES, _MOST_INCLUDED = 16, 10000

# A comma in quotes is part of a name.
_ITEM = re.compile(r'((?:"[^"]*"?|[^",])*)(,?)')


@dataclass
class Block:
    """A keyword with its parameters, and the data lines below it, each with its place; `lines` are not blank.

    Keywords and the names of parameters are in upper case without blanks, as the programs compare them. Data of an
    included file, and those below its end, belong to the keyword that stands before them.
    """

    keyword: str
    parameters: dict[str, str]
    place: Place
    lines: list[str] = field(default_factory=list)
    # Where a run of lines begins: index of the first one, its path, and its number less that index.
    _runs: list[tuple[int, str, int]] = field(default_factory=list)

    def where(self, index: int) -> Place:
        """The place of data line `index`, from 0."""
        first, path, offset = next(run for run in reversed(self._runs) if run[0] <= index)
        return Place(path, index + offset)

    def add(self, path: str, number: int, line: str) -> None:
        """Append a data line."""
        index = len(self.lines)
        if not self._runs or self._runs[-1][1:] != (path, number - index):
            self._runs.append((index, path, number - index))
        self.lines.append(line)


def read_blocks(path: PathLike, paths: list[str] | None = None) -> Iterator[Block]:
    """All keywords of an input file and of the files that it includes, in their order.

    Paths of included files begin at the folder of the first one. `paths` gets the path of each file once. Data lines
    before the first keyword belong to a block with the keyword ''.
    """
    lines = _Lines(path, [] if paths is None else paths)
    block: Block | None = None
    for place, line in lines:
        if not line.startswith("*"):
            if block is None:
                block = Block("", {}, place)
            block.add(place.path, place.line, line)
            continue
        keyword = _parsed(place, line, lines)
        if keyword.keyword == "INCLUDE":
            lines.include(keyword)
            continue
        if block is not None:
            yield block
        block = keyword
    if block is not None:
        yield block


class _Lines(Iterable[tuple[Place, str]]):
    """The lines of a file and of those that it includes which are neither blank nor comments, without outer blanks."""

    def __init__(self, path: PathLike, paths: list[str]) -> None:
        self._paths = paths
        self._folder = os.path.dirname(os.fspath(path))
        self._included = 0
        self._open: list[Iterator[tuple[int, str]]] = []
        self._files: list[TextFile] = []
        self._enter(os.fspath(path))

    def _enter(self, path: str) -> None:
        file = read_text(path)
        self._files.append(file)
        self._open.append(iter(enumerate(file.lines, 1)))
        if path not in self._paths:
            self._paths.append(path)

    def __iter__(self) -> Iterator[tuple[Place, str]]:
        while self._open:
            # The file may change between two lines, by an inclusion.
            for number, line in self._open[-1]:
                stripped = line.strip(" \t\r")
                if stripped and not stripped.startswith("**"):
                    yield Place(self._files[-1].path, number), stripped
                    break
            else:
                self._open.pop()
                self._files.pop()

    def below(self) -> Iterator[tuple[Place, str]]:
        """The lines that are left in the present file."""
        path = self._files[-1].path
        for number, line in self._open[-1]:
            stripped = line.strip(" \t\r")
            if stripped and not stripped.startswith("**"):
                yield Place(path, number), stripped

    def include(self, keyword: Block) -> None:
        path = keyword.parameters.get("INPUT", "")
        if not path:
            raise refusal(keyword.place, "*INCLUDE needs INPUT = and a path")
        if len(self._open) == _MOST_FILES:
            reason = f"more than {_MOST_FILES} files include each other: does one include itself?"
            raise refusal(keyword.place, reason)
        if self._included == _MOST_INCLUDED:
            reason = f"more than {_MOST_INCLUDED} files are included: do they include others twice?"
            raise refusal(keyword.place, reason)
        self._included += 1
        self._enter(path if PurePath(path).is_absolute() else os.path.join(self._folder, path))


def _parsed(place: Place, line: str, lines: _Lines) -> Block:
    """The keyword of a line, with the lines below it as long as a line ends with a comma."""
    items, continued = split_items(line)
    while continued:
        following = next(lines.below(), None)
        if following is None:
            break
        if following[1].startswith("*"):
            raise refusal(following[0], "the keyword line above ends with a comma, and goes on with another keyword")
        more, continued = split_items(following[1])
        items += more
    parameters = {}
    for item in items[1:]:
        if item:
            name, _, value = item.partition("=")
            parameters[squeezed(name)] = unquoted(value)
    return Block(squeezed(items[0])[1:], parameters, place)


def split_items(line: str) -> tuple[list[str], bool]:
    """What stands between the commas of a line, without outer blanks; and whether the line ends with a comma."""
    items = []
    position, comma = 0, ","
    while comma and position < len(line):
        match = _ITEM.match(line, position)
        assert match is not None
        items.append(match[1].strip())
        position, comma = match.end(), match[2]
    return items, bool(comma)


def squeezed(text: str) -> str:
    """Upper case without blanks."""
    return "".join(text.split()).upper()


def unquoted(text: str) -> str:
    """Without blanks at its ends and without quotes."""
    stripped = text.strip()
    return stripped[1:-1] if len(stripped) > 1 and stripped[0] == stripped[-1] == '"' else stripped


def abbreviates(text: str, word: str, least: int = 3) -> bool:
    """Whether text is a word or its beginning, as Abaqus lets keywords, parameters and their values be abbreviated."""
    return text == word or (least <= len(text) and word.startswith(text))



