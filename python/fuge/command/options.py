"""The options as they are given, on the command line and in a job file, in their order."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Sequence
from typing import NamedTuple

from fuge.command.errors import UsageError
from fuge.command.option_table import INPUTS, NAMES, REPEATED, WITHOUT_VALUE
from fuge.formats.text import Place, Reason, quoted_path, read_text, value

# A word is like another one if this share of their letters is the same.
_ALIKE = 0.66
_SHORT = {"-h": "--help", "-V": "--version"}


class Setting(NamedTuple):
    """An option as it is given.

    `source` is what messages call it, the option with its value or the line of a job file; paths begin at `folder`,
    which is empty or ends with a slash.
    """

    name: str
    value: str
    source: str
    folder: str = ""

    def refuse(self, reason: str) -> UsageError:
        """The error that the option is wrong for this reason."""
        return UsageError(f"{self.source}: {reason}")

    def path(self, skipped: int = 0) -> str:
        """The value as a path, without its first `skipped` characters."""
        return os.path.join(self.folder, self.value[skipped:])

    def number(self) -> float:
        """The value as a number; UsageError if it is none."""
        try:
            return value(self.value)
        except Reason:
            raise self.refuse(f'a number is needed, not "{self.value}"') from None

    def numbers(self) -> list[float]:
        """The numbers between the commas of the value; UsageError."""
        try:
            return [value(item.strip()) for item in self.value.split(",")]
        except Reason:
            raise self.refuse(f'numbers with commas between them are needed, not "{self.value}"') from None


class Options:
    """All options, in their order; `settings[k]` is the one in place k.

    Attributes
    ----------
    settings : list of Setting
    job : str or None
        Path of the job file.

    Raises
    ------
    UsageError
        An option is unknown, has no value or is given twice; or there is none.
    FileError
        The job file cannot be read.
    """

    def __init__(self, words: Sequence[str]) -> None:
        self.settings: list[Setting] = []
        self.job: str | None = None
        rest = iter(words)
        for word in rest:
            word = _SHORT.get(word, word)
            if not word.startswith("-"):
                self._read_job(word)
                continue
            given = next(rest, None) if needs_value(word) else ""
            if given is None:
                raise UsageError(f"{word} needs a value")
            self._add(word, given)
        if not self.settings:
            raise UsageError("no options are given")

    def has(self, name: str) -> bool:
        """Whether the option is given."""
        return bool(self.all(name))

    def all(self, name: str) -> list[Setting]:
        """All settings of an option, in their order."""
        return [setting for setting in self.settings if setting.name == name]

    def first(self, name: str) -> Setting:
        """The first setting of an option, which must be given."""
        return self.all(name)[0]

    def file(self, name: str) -> str:
        """The path that an option names; empty if it is not given."""
        return self.first(name).path() if self.has(name) else ""

    def choice(self, name: str, words: Sequence[str]) -> str:
        """The word of an option, which must be one of `words`; the first of them without it."""
        if not self.has(name):
            return words[0]
        setting = self.first(name)
        if setting.value not in words:
            raise setting.refuse(f"one of {', '.join(words)} is needed")
        return setting.value

    def positive(self, name: str) -> list[float]:
        """The numbers of an option that is given, all above 0."""
        values = self.first(name).numbers()
        if min(values) <= 0.0:
            raise self.first(name).refuse("it has to be > 0")
        return values

    def factor(self, name: str, default: float = 1.0) -> float:
        """The one number of an option, above 0; the default without it."""
        values = self.positive(name) if self.has(name) else [default]
        if len(values) > 1:
            raise self.first(name).refuse("one number is needed")
        return values[0]

    def threads(self) -> int:
        """The value of --threads; 0, all cores, without it."""
        for setting in self.all("threads"):
            if re.fullmatch(r"\+?\d{1,9}", setting.value, re.ASCII) is None:
                raise setting.refuse("a number of threads is needed, or 0 for all cores")
            return int(setting.value)
        return 0

    def _add(self, word: str, given: str, where: str = "", folder: str = "") -> None:
        if not is_option(word):
            alike = difflib.get_close_matches(word.lstrip("-"), NAMES, 1, _ALIKE)
            meant = f" (did you mean --{alike[0]}?)" if alike else ""
            raise UsageError(f'{where}unknown option "{word}"{meant}')
        if self.has(word[2:]) and word[2:] not in REPEATED:
            raise UsageError(f"{where}{word} is given twice")
        self.settings.append(Setting(word[2:], given, f"{where}{word} {given}".strip(), folder))

    def _read_job(self, path: str) -> None:
        """Lines of a name and a value, with comments behind #, or on lines that begin with **."""
        if self.job is not None:
            raise UsageError(f'"{self.job}" and "{path}" are two job files')
        self.job = path
        folder = os.path.join(os.path.dirname(path), "")
        count = len(self.settings)
        for number, line in enumerate(read_text(path).lines, 1):
            kept = line.replace("\t", " ").partition("#")[0].strip(" \r")
            if not kept or kept.startswith("**"):
                continue
            name, *rest = re.split("[ =]", kept, maxsplit=1)
            word, given = name if name.startswith("--") else f"--{name}", "".join(rest).strip()
            where = f"{Place(path, number)}: "
            if is_option(word) and needs_value(word) != bool(given):
                raise UsageError(f"{where}{word} {'needs a value' if needs_value(word) else 'has no value'}")
            second = _second_option(word, given, folder)
            if is_option(word) and second:
                raise UsageError(f'{where}"{second}" begins a second option, but there is one on each line')
            self._add(word, given, where, folder)
        if len(self.settings) == count:
            raise UsageError(f"{quoted_path(path)} has no options: one on each line is needed")


def is_option(word: str) -> bool:
    """Whether a word is an option with its hyphens."""
    return word.startswith("--") and word[2:] in NAMES


def needs_value(word: str) -> bool:
    """Whether a word is an option that has a value."""
    return is_option(word) and word[2:] not in WITHOUT_VALUE


def _second_option(word: str, given: str, folder: str) -> str:
    """The word in the value of an option that begins a second one, or an empty text.

    Without hyphens it may be a word of a name, unless an input is to be read that does not exist.
    """
    is_input = word[2:] in INPUTS
    # The inputs of a body are behind its name.
    names = (given, given.partition("=")[2])
    if is_input and any(name and os.path.exists(os.path.join(folder, name)) for name in names):
        return ""
    begins = [later.partition("=")[0] for later in given.split()[1:]]
    return next((begin for begin in begins if is_option(begin) or (is_input and begin in NAMES)), "")
