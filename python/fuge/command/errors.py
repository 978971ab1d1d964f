"""Exit codes of the command, and the error of options that do not fit."""

from __future__ import annotations

import re

from fuge.errors import Error, FileError, Status

DONE, UNEXPECTED, USAGE, INPUT, UNSOLVED, WARNED = range(6)
# As shells have it: 128 and the number of the signal.
INTERRUPTED, CLOSED_PIPE = 130, 141

_UNSOLVED = (
    Status.ERR_NO_EQUILIBRIUM,
    Status.ERR_ITERATION_LIMIT,
    Status.ERR_OVERFLOW,
    Status.ERR_MEMORY,
    Status.ERR_CANCELLED,
)

# What the library counts from 0 in its messages, and tables of the command from 1; text in quotes stays.
_INDEX = re.compile(
    r'"[^"]*"'
    r"|(?P<name>\b[a-z]\w* ?)\[(?P<places>\d+(?:, \d+)*)\]"
    r"|(?P<word>\b(?:point|the first is|degrees? of freedom|motion|mode|cell))"
    r" (?P<number>\d+)(?P<other> and \d+)?\b(?!\.\d)"
)


class CommandError(Error):
    """An error whose message is in the words of the command, with numbers as tables have them."""


class UsageError(CommandError):
    """An option that is unknown, has no sense, or does not go with another."""

    def __init__(self, reason: str) -> None:
        super().__init__(f"{reason}: see fuge --help", Status.ERR_OPTION)


def exit_code(failure: Error) -> int:
    """The exit code of an error: of usage, of the input, or of a problem without a solution."""
    if failure.status == Status.ERR_OPTION:
        return USAGE
    return UNSOLVED if failure.status in _UNSOLVED else INPUT


def shown(failure: Error) -> str:
    """The message of an error for users of the command."""
    return failure.message if isinstance(failure, (CommandError, FileError)) else counted_from_one(failure.message)


def counted_from_one(message: str) -> str:
    """A message of the library with points, motions and degrees of freedom counted from 1."""
    return _INDEX.sub(_renumbered, message)


def _renumbered(match: re.Match[str]) -> str:
    if match["name"]:
        return f"{match['name']}({_next(match['places'])})"
    if match["word"]:
        return f"{match['word']} {_next(match['number'] + (match['other'] or ''))}"
    return match[0]


def _next(numbers: str) -> str:
    return re.sub(r"\d+", lambda number: str(int(number[0]) + 1), numbers)
