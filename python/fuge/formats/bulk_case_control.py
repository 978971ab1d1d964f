"""The case control of a Nastran deck, the lines before BEGIN BULK: which loads and supports each subcase selects."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from fuge.formats.bulk_words import EXECUTIVE_COMMANDS, HARMLESS_COMMANDS, check_parameter
from fuge.formats.text import Place, Reason, label, located, quoted, refusal

_BULK = re.compile(r"\s*BEGIN\s+BULK(.*)", re.IGNORECASE)
_END_OF_EXECUTIVE = re.compile(r"\s*CEND\b", re.IGNORECASE)

# A command, its options in parentheses, and what follows behind = or a blank.
_COMMAND = re.compile(r"\s*(\w+)\s*(\([^)]*\)?)?\s*[=,]?\s*(.*?)\s*", re.ASCII)

# What each subcase selects, by its command, and as messages call it.
_SETS = {"LOAD": "load set", "SPC": "set of supports", "MPC": "set of equations"}

_WORDS = ("LABEL", "SUBTITLE", "TITLE")


@dataclass
class Subcase:
    """The sets that a subcase selects, by their commands, and its words; number 0: above the first SUBCASE."""

    place: Place
    number: int = 0
    sets: dict[str, int] = field(default_factory=dict)
    words: dict[str, str] = field(default_factory=dict)

    @property
    def name(self) -> str:
        name = f"SUBCASE {self.number or 1}"
        words = self.words.get("LABEL") or self.words.get("SUBTITLE")
        return f"{words} ({name})" if words else name


_Lines = list[tuple[Place, str]]


def split_deck(lines: _Lines) -> tuple[list[Subcase] | None, _Lines]:
    """The subcases, of which the first one is what all of them select, and the lines of bulk data.

    None in place of subcases: the deck is bulk data alone.
    """
    for k, (place, line) in enumerate(lines):
        bulk = _BULK.fullmatch(line)
        if bulk is not None:
            if bulk[1].strip():
                raise refusal(place, "superelements and parts of models are not read: only BEGIN BULK alone is")
            return _subcases(lines[:k], place), lines[k + 1 :]
    return None, lines


def _subcases(lines: _Lines, end: Place) -> list[Subcase]:
    """Read executive control, which ends with CEND where there is one, and case control."""
    reader = _Reader(end)
    reader.is_executive = any(_END_OF_EXECUTIVE.match(line) for _, line in lines)
    for place, line in lines:
        with located(place):
            reader.read(place, line)
    for subcase in reader.subcases[2:]:
        if subcase.sets.get("MPC") != reader.subcases[1].sets.get("MPC"):
            raise refusal(
                subcase.place,
                f"subcase {subcase.number} has other equations, MPC, than the first one: a stiffness matrix serves "
                "those of one set, so read them as decks of their own",
            )
    return reader.subcases


class _Reader:
    def __init__(self, place: Place) -> None:
        self.subcases = [Subcase(place)]
        # The line above ends with a comma; below OUTPUT(PLOT) and OUTPUT(XYPLOT) come commands of pictures.
        self._continues = self._plots = self.is_executive = False

    def read(self, place: Place, line: str) -> None:
        if self._continues:
            self._continues = line.endswith(",")
            return
        match = _COMMAND.fullmatch(line)
        command, option, value = match.groups("") if match else (quoted(line.strip()), "", "")
        command, option = command.upper(), option.upper()
        if self.is_executive:
            self._read_executive(command, line)
            return
        words = next((word for word in _WORDS if _abbreviates(command, word)), None)
        if words is not None:
            self.subcases[-1].words[words] = value
        elif _abbreviates(command, "SUBCASE"):
            self._begin(place, label(option + value.upper(), "subcase"))
        elif command in _SETS:
            self.subcases[-1].sets[command] = label(option + value.upper(), _SETS[command])
        else:
            self._check(command, option, value.upper())
            self._continues = line.endswith(",")

    def _read_executive(self, command: str, line: str) -> None:
        if command not in EXECUTIVE_COMMANDS:
            raise Reason(f"{command} above CEND could change the answer, and is not read: take it out if it does not")
        self.is_executive = command != "CEND"
        self._continues = line.endswith(",")

    def _begin(self, place: Place, number: int) -> None:
        if any(subcase.number == number for subcase in self.subcases):
            raise Reason(f"subcase {number} is defined twice")
        self.subcases.append(Subcase(place, number, dict(self.subcases[0].sets)))

    def _check(self, command: str, option: str, value: str) -> None:
        """Refuse what could change the answer."""
        if command == "PARAM":
            name, _, setting = value.partition(",")
            check_parameter(name.strip(), setting.strip())
        elif command == "OUTPUT":
            self._plots = "PLOT" in option or "XY" in option
        elif not (self._plots or _is_harmless(command, option, value)):
            raise Reason(
                f"{command} is not read: give each load case as a SUBCASE with LOAD = and SPC =, and leave out what "
                "only asks for output"
            )


def _is_harmless(command: str, option: str, value: str) -> bool:
    if command in ("TEMP", "TEMPERATURE"):
        return "INIT" in option or "MATE" in option
    if _abbreviates(command, "ANALYSIS"):
        return value.startswith(("STAT", "NLST"))
    if _abbreviates(command, "NLPARM"):
        return "LGDISP" not in option
    return any(_abbreviates(command, word) for word in HARMLESS_COMMANDS)


def _abbreviates(text: str, word: str) -> bool:
    """Whether text is a command or begins it with four letters or more."""
    return text == word or (len(text) >= 4 and word.startswith(text))
