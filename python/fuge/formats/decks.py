"""Decks of Nastran, Abaqus and CalculiX: which reader a file needs."""

from __future__ import annotations

from fuge.deck import Deck
from fuge.formats.bulk_deck import read_bulk_deck
from fuge.formats.keyword_deck import read_keyword_deck
from fuge.formats.text import PathLike, read_text


def read_deck(path: PathLike) -> Deck:
    """Read one-way links and load cases from bulk data of Nastran, or an input file of Abaqus or CalculiX.

    The format is known by the first line that is neither blank nor a comment: that of Abaqus and CalculiX begins with *
    and a letter.

    Raises
    ------
    FileError
        The message has the file, the line, the card and the reason; also for what is not read but could change the
        answer.
    """
    if has_keywords(read_text(path).lines):
        return read_keyword_deck(path)
    return read_bulk_deck(path)


def has_keywords(lines: list[str]) -> bool:
    """Whether the first line that is neither blank nor a comment begins with a keyword of Abaqus and CalculiX."""
    for line in lines:
        begin = line.strip()
        if begin and not begin.startswith(("$", "**")):
            return begin.startswith("*") and begin[1:2].isalpha()
    return False
