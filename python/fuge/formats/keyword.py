"""Input files of Abaqus and CalculiX: keyword lines, and the data lines below them."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field

from fuge.errors import FileError
from fuge.formats.keyword_names import KEYWORDS
from fuge.formats.text import BLANKS, Inclusions, PathLike, Place, Reason, TextFile, located, named, quoted, refusal

# A comma in quotes is part of a name.
_ITEM = re.compile(r'((?:"[^"]*"?|[^",])*)(,?)')


@dataclass
class Block:
    """A keyword with its parameters, and the data lines below it, each with its place; `lines` are not blank.

    The keyword is written out; the names of parameters are in upper case without blanks, as the file has them: see
    :meth:`named`. Data of an included file, and those below its end, belong to the keyword that stands before them.
    """

    keyword: str
    parameters: dict[str, str]
    place: Place
    lines: list[str] = field(default_factory=list)
    # Where a run of lines begins: index of the first one, its path, and its number less that index.
    _runs: list[tuple[int, str, int]] = field(default_factory=list)

    def where(self, index: int) -> Place:
        """The place of data line `index`, from 0."""
        _, path, offset = self._runs[bisect_left(self._runs, (index + 1,)) - 1]
        return Place(path, index + offset)

    def refuse(self, reason: object, index: int | None = None) -> FileError:
        """The error that the keyword line, or data line `index`, from 0, cannot be read."""
        return refusal(self.place if index is None else self.where(index), reason)

    def add(self, path: str, number: int, lines: list[str]) -> None:
        """Append data lines, the first of which has a number in its file."""
        self._runs.append((len(self.lines), path, number - len(self.lines)))
        self.lines += lines

    def named(self, names: Collection[str]) -> dict[str, str]:
        """The parameters by their full names; refused is one that is none of these names, and one given twice."""
        found: dict[str, str] = {}
        for text, value in self.parameters.items():
            with located(self.place), named(f"*{self.keyword}"):
                name = complete(text, names)
                if name is None:
                    raise Reason(f"the parameter {quoted(text)} is not read")
                if name in found:
                    raise Reason(f"{name} is given twice")
            found[name] = value
        return found


def read_blocks(path: PathLike, paths: list[str] | None = None) -> Iterator[Block]:
    """All keywords of an input file and of the files that it includes, in their order.

    Paths of included files begin at the folder of the first one. `paths` gets the path of each file once. Data lines
    before the first keyword belong to a block with the keyword ''. Abbreviated keywords are written out; refused is
    what is no keyword, or abbreviates several.
    """
    inclusions = Inclusions(path, [] if paths is None else paths)
    files = [_File(inclusions.read(path))]
    block: Block | None = None
    while files:
        file = files[-1]
        number, data = file.take_data()
        if data:
            block = block or Block("", {}, Place(file.path, number))
            block.add(file.path, number, data)
        line = file.take_line()
        if line is None:
            files.pop()
        if not line or line.startswith("**"):
            continue
        keyword = _parsed(line, file, first=block is None or not block.keyword)
        if keyword.keyword == "INCLUDE":
            with located(keyword.place):
                files.append(_File(inclusions.include(_included_path(keyword), len(files))))
            continue
        if block is not None:
            yield block
        block = keyword
    if block is not None:
        yield block


class _File:
    """The lines of a file, without outer blanks."""

    def __init__(self, file: TextFile) -> None:
        self.path = file.path
        self._lines = [line.strip(BLANKS) for line in file.lines]
        # Blank lines, comments and keywords stand between the data.
        self._stops = [k for k, line in enumerate(self._lines) if not line or line[0] == "*"]
        self._stops.append(len(self._lines))
        self._next = 0

    @property
    def place(self) -> Place:
        """That of the last line taken."""
        return Place(self.path, self._next)

    def take_data(self) -> tuple[int, list[str]]:
        """The data lines that come next, and the number of the first."""
        first, self._next = self._next, self._stops[bisect_left(self._stops, self._next)]
        return first + 1, self._lines[first : self._next]

    def take_line(self) -> str | None:
        """The next line, whatever it is; None behind the last one."""
        if self._next == len(self._lines):
            return None
        self._next += 1
        return self._lines[self._next - 1]


def _parsed(line: str, file: _File, first: bool) -> Block:
    """The keyword of a line, with the lines below it as long as a line ends with a comma."""
    place = file.place
    items, continued = split_items(line)
    while continued:
        following = file.take_line()
        if following is None:
            break
        if not following or following.startswith("**"):
            continue
        if following.startswith("*"):
            reason = "the keyword line above ends with a comma, and goes on with another keyword"
            raise refusal(file.place, reason)
        more, continued = split_items(following)
        items += more
    text = squeezed(items[0])[1:]
    with located(place):
        keyword = complete(text, KEYWORDS)
        if keyword is None:
            known = ", and none stands above: is this an input file of theirs?" if first else ""
            raise Reason(f"{quoted(f'*{text}')} is no keyword of Abaqus or CalculiX{known}")
    block = Block(keyword, {}, place)
    for item in filter(None, items[1:]):
        name, _, value = item.partition("=")
        if block.parameters.setdefault(squeezed(name), unquoted(value)) != unquoted(value):
            raise block.refuse(f"*{keyword}: {squeezed(name)} is given twice")
    return block


def _included_path(keyword: Block) -> str:
    path = keyword.named(["INPUT"]).get("INPUT", "")
    if not path:
        raise Reason("*INCLUDE needs INPUT = and a path")
    return path


def complete(text: str, words: Collection[str]) -> str | None:
    """The word that a text is or abbreviates, as Abaqus lets keywords, parameters and their values be; None if none.

    A word with which all others begin that are meant is taken: ELEM is ELEMENT, although there is ELEMENTOUTPUT. Reason
    if the text begins several others.
    """
    if text in words:
        return text
    found = sorted((word for word in words if text and word.startswith(text)), key=lambda word: (len(word), word))
    for other in found:
        if not other.startswith(found[0]):
            raise Reason(f"{quoted(text)} may be {found[0]} or {other}: write it out")
    return found[0] if found else None


def split_items(line: str) -> tuple[list[str], bool]:
    """What stands between the commas of a line, without outer blanks; and whether the line ends with a comma."""
    if '"' not in line:
        items = [item.strip() for item in line.split(",")]
        return (items, False) if items[-1] else (items[:-1], len(items) > 1)
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
