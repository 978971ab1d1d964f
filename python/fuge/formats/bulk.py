"""Bulk data of Nastran and its kin: lines, with those of included files, and the cards on them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from fuge.errors import FileError, Status
from fuge.formats.text import Inclusions, PathLike, Place, Reason, TextFile, label, located, quoted, value

LINE_FIELDS = 8

_INCLUDE = re.compile(r"""\s*INCLUDE(?=[\s='"])[\s=]*(.*?)\s*""", re.IGNORECASE)
_PATH = re.compile(r"""(['"])(?P<quoted>.+)\1|(?P<bare>[^'"].*)""")
_END = re.compile(r"\s*ENDDATA\b", re.IGNORECASE)

# A line is one of free fields if there is a comma in its first columns, or right behind them.
_FIRST_FIELD = 8

# How a ninth field begins that is no marker of a continuation.
_NUMERIC = tuple("0123456789-.")


@dataclass
class Card:
    """A card: its name in upper case, and its data fields, of which each line has eight; they count from 1."""

    name: str
    fields: list[str]
    place: Place

    def has(self, k: int) -> bool:
        """Whether there is something in field k."""
        return k <= len(self.fields) and self.fields[k - 1] != ""

    def word(self, k: int) -> str:
        """Field k in upper case; blank if the card has fewer."""
        return self.fields[k - 1].upper() if k <= len(self.fields) else ""

    def filled(self, k: int) -> list[int]:
        """The numbers of the fields from k on that are not blank."""
        return [i for i in range(k, len(self.fields) + 1) if self.fields[i - 1]]

    def wholes(self, k: int, name: str) -> list[int]:
        """The whole numbers from field k on, as of `whole`."""
        return [self.whole(i, name) for i in self.filled(k)]

    def whole(self, k: int, name: str, least: int = 1, default: int | None = None) -> int:
        """The whole number in field k, called `name` in the Reason if it is none; `default` if the field is blank."""
        if default is not None and not self.has(k):
            return default
        return label(self.word(k), name, least)

    def number(self, k: int, name: str, default: float | None = None) -> float:
        """The number in field k, called `name` in the Reason if it is none; `default` if the field is blank."""
        if default is not None and not self.has(k):
            return default
        try:
            return value(self.word(k))
        except Reason as reason:
            raise Reason(f"{name}: {reason}") from None

    def refuse(self, reason: object) -> FileError:
        """The error that the card is not read."""
        return FileError(f"{self.place}, {self.name} {self.word(1)}: {reason}", Status.ERR_FILE)


def read_lines(path: PathLike, paths: list[str]) -> Iterator[tuple[Place, str]]:
    """The lines of a deck and of the files that it includes, up to ENDDATA, without comments and blank lines.

    Paths of included files begin at the folder of the first one; `paths` gets the path of each file once.
    """
    inclusions = Inclusions(path, paths)
    files = [_file_lines(inclusions.read(path))]
    while files:
        for place, line in files[-1]:
            if _END.match(line):
                return
            include = _INCLUDE.fullmatch(line)
            if include is None:
                yield place, line
                continue
            with located(place):
                file = inclusions.include(_included_path(include[1]), len(files))
            files.append(_file_lines(file))
            break
        else:
            files.pop()


def _file_lines(file: TextFile) -> Iterator[tuple[Place, str]]:
    for number, line in enumerate(file.lines, 1):
        text = line.partition("$")[0].rstrip()
        if text:
            yield Place(file.path, number), text


def _included_path(text: str) -> str:
    match = _PATH.fullmatch(text)
    if match is None:
        raise Reason("INCLUDE needs a path in quotes, which ends on its line")
    return match["quoted"] or match["bare"]


def read_cards(lines: Iterable[tuple[Place, str]]) -> Iterator[Card]:
    """The cards of bulk data, each with the fields of the lines that continue it."""
    card: Card | None = None
    above = ""
    for place, line in lines:
        with located(place):
            name, fields, marker = _split(line)
            if name is not None:
                if card is not None:
                    yield card
                card = Card(name, fields, place)
            else:
                _check_continuation(line, above)
                if card is None:
                    raise Reason("the line continues a card, but there is none above")
                if len(fields) == LINE_FIELDS:
                    # A row of eight fields begins, whatever was before.
                    card.fields += [""] * (-len(card.fields) % LINE_FIELDS)
                card.fields += fields
        above = marker
    if card is not None:
        yield card


def _split(line: str) -> tuple[str | None, list[str], str]:
    """Name, None on a continuation; data fields: eight, or four if * is in the first field; marker in field 10."""
    first, comma, rest = line.partition(",")
    is_free = bool(comma) and len(first) <= _FIRST_FIELD
    begin = (first if is_free else line[:_FIRST_FIELD]).strip()
    count = LINE_FIELDS // 2 if "*" in begin else LINE_FIELDS
    if begin.startswith(("=", "*(")):
        raise Reason("replication by = and *( is not read: write each card")
    name = None if begin == "" or begin[0] in "+*" else begin.partition("*")[0].strip().upper()
    if is_free:
        fields = [field.strip() for field in rest.split(",")]
        fields += [""] * (count - len(fields))
    else:
        if "\t" in line:
            raise Reason("tabs between fixed fields are not read: write blanks, or commas")
        width = 64 // count
        fields = [line[k : k + width].strip() for k in range(8, 72, width)] + [line[72:80].strip()]
    behind = fields[count:]
    marker = behind[0] if behind else ""
    if is_free and (any(behind[1:]) or marker.startswith(_NUMERIC)):
        raise Reason("there are more than 8 fields: go on in the next line")
    if name is not None and len(name.split()) > 1:
        raise Reason(f"the name {quoted(begin)} has a blank in it: a field has 8 columns")
    return name, fields[:count], marker


def _check_continuation(line: str, above: str) -> None:
    """Refuse a marker that the line above does not have in its field 10: programs look for its card elsewhere."""
    begin = line.partition(",")[0][:_FIRST_FIELD].strip()
    # What markers begin with has no meaning, + or *; some programs write another letter in field 10.
    marker = begin[1:].strip().upper()
    if marker and marker not in (above.upper(), above.upper().lstrip("+*").strip(), above[1:].strip().upper()):
        raise Reason(
            f"the continuation {begin} does not follow its card: put it directly below, with its marker in "
            "field 10, or begin it with + alone"
        )
