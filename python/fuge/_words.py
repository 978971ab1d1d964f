"""Python's words and enumerations for the constants of the headers, such as 'mean' for FUGE_MEAN."""

from __future__ import annotations

from typing import Any, get_args

from fuge import _arrays
from fuge._library import HEADERS
from fuge.errors import Status

WORDS: dict[str, str] = {}
"""All words, by the names of their constants without FUGE_."""


class Words:
    """The words that a parameter may have: those of a ``typing.Literal``.

    Each stands for the constant whose name is the word in upper case after `prefix`, or for the one that `others` name.
    """

    def __init__(
        self, parameter: str, literal: Any, prefix: str = "", status: Status = Status.ERR_OPTION, **others: str
    ) -> None:
        self._parameter = parameter
        self._status = status
        constants = {word: others.get(word, prefix + word.upper()) for word in get_args(literal)}
        self._numbers: dict[str, int] = {word: HEADERS.constants[constant] for word, constant in constants.items()}
        WORDS.update({constant: word for word, constant in constants.items()})

    def number(self, word: Any) -> int:
        """The value of a word, or an error that names the parameter and its words."""
        return _arrays.choice(self._parameter, word, self._numbers, self._status)

    def word(self, number: int) -> str:
        """The word for a value."""
        return {value: word for word, value in self._numbers.items()}[number]
