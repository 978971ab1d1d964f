"""The case control of a Nastran deck, the lines before BEGIN BULK: which loads and supports each subcase selects."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from fuge.formats.bulk_words import HARMLESS_COMMANDS, check_parameter
from fuge.formats.keyword import abbreviates
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


def split_deck(lines: list[tuple[Place, str]]) -> tuple[list[Subcase] | None, list[tuple[Place, str]]]:
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


def _subcases(lines: Sequence[tuple[Place, str]], end: Place) -> list[Subcase]:
    """Read the lines below CEND; without CEND all of them are case control."""
    ends = [k for k, (_, line) in enumerate(lines) if _END_OF_EXECUTIVE.match(line)]
    reader = _Reader(end)
    for place, line in lines[ends[0] + 1 if ends else 0 :]:
        with located(place):
            reader.read(place, line)
    _check_equations(reader.subcases)
    return reader.subcases


class _Reader:
    def __init__(self, place: Place) -> None:
        self.subcases = [Subcase(place)]
        # The line above ends with a comma; below OUTPUT(PLOT) and OUTPUT(XYPLOT) come commands of pictures.
        self._continues = self._plots = False

    def read(self, place: Place, line: str) -> None:
        if self._continues:
            self._continues = line.endswith(",")
            return
        match = _COMMAND.fullmatch(line)
        command, option, value = match.groups("") if match else (quoted(line.strip()), "", "")
        command, option = command.upper(), option.upper()
        words = next((word for word in _WORDS if abbreviates(command, word, 4)), None)
        if words is not None:
            self.subcases[-1].words[words] = value
        elif abbreviates(command, "SUBCASE", 4):
            self._begin(place, label(option + value.upper(), "subcase"))
        elif command in _SETS:
            self.subcases[-1].sets[command] = label(option + value.upper(), _SETS[command])
        else:
            self._check(command, option, value.upper())
            self._continues = line.endswith(",")

    def _begin(self, place: Place, number: int) -> None:
        if any(subcase.number == number for subcase in self.subcases):
            raise Reason(f"subcase {number} is defined twice")
        common = self.subcases[0]
        self.subcases.append(replace(common, place=place, number=number, sets=dict(common.sets), words={}))

    def _check(self, command: str, option: str, value: str) -> None:
        """Refuse what could change the answer."""
        if command == "PARAM":
            name, _, setting = value.partition(",")
            check_parameter(name.strip(), setting.strip())
        elif command == "OUTPUT":
            self._plots = "PLOT" in option or "XY" in option
        elif not (self._plots or _is_harmless(command, option, value)):
            raise Reason(
                f"{command} is not read: give each load case as a SUBCASE with LOAD = and SPC =, and take out what "
                "has no say in it"
            )


def _is_harmless(command: str, option: str, value: str) -> bool:
    if command in ("TEMP", "TEMPERATURE"):
        return "INIT" in option or "MATE" in option
    if abbreviates(command, "ANALYSIS", 4):
        return value.startswith(("STAT", "NLST"))
    if abbreviates(command, "NLPARM", 4):
        return "LGDISP" not in option
    return any(abbreviates(command, word, 4) for word in HARMLESS_COMMANDS)


def _check_equations(subcases: list[Subcase]) -> None:
    """Refuse different sets of equations, MPC: one stiffness matrix serves all subcases."""
    for subcase in subcases[2:]:
        if subcase.sets.get("MPC") != subcases[1].sets.get("MPC"):
            raise refusal(
                subcase.place,
                f"subcase {subcase.number} has other equations, MPC, than the first one: a stiffness matrix serves "
                "those of one set, so read them as decks of their own",
            )
