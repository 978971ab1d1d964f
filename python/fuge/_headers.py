"""What the C headers declare: functions, types and constants, read when the package is imported.

The headers are the one place where the C interface is written down. The reader knows the C that they use and no more:
anything else is an error, so that nothing is misread or left out. It runs at each import, and therefore works without
regular expressions, whose compilation would take longer than the reading.
"""

from __future__ import annotations

from pathlib import Path
from typing import Iterator, NamedTuple

# Characters that are words of their own.
_MARKS = "*(){},;="
# What only a C++ compiler sees.
_FOR_CXX = ('#ifdef __cplusplus\nextern "C" {\n#endif\n', "#ifdef __cplusplus\n}\n#endif\n")


class Signature(NamedTuple):
    """Types of the result and of the parameters of a function, such as ``const double *``."""

    result: str
    parameters: list[str]


class Member(NamedTuple):
    """A member of a struct; `length` is None unless it is an array. Pointers are to constants."""

    name: str
    type: str
    length: int | None


class Headers:
    """The declarations in a header and in those that it includes.

    Attributes
    ----------
    paths : list of Path
        The headers that were read.
    version : str
        FUGE_VERSION.
    functions, callbacks : dict of str to Signature
        The functions of the library, and the types of the caller's functions that it calls.
    structs : dict of str to list of Member
        Structs with members.
    handles : list of str
        Structs whose members only the library knows.
    constants : dict of str to int
        Values of the constants of all enumerations, by their names without the prefix FUGE_.

    Raises
    ------
    ValueError
        A declaration or a line of the preprocessor is not understood; the message has it and the path of its header.
    """

    def __init__(self, path: Path) -> None:
        self.version = ""
        self.functions: dict[str, Signature] = {}
        self.callbacks: dict[str, Signature] = {}
        self.structs: dict[str, list[Member]] = {}
        self.handles: list[str] = []
        self.constants: dict[str, int] = {}
        self.paths: list[Path] = []
        self._add_header(path)

    def _add_header(self, path: Path) -> None:
        if path in self.paths:
            return
        self.paths.append(path)
        text = _without_comments(path.read_text(encoding="utf-8"))
        for block in _FOR_CXX:
            text = text.replace(block, "")
        lines = text.splitlines()
        for line in lines:
            if line.startswith("#"):
                self._add_directive(path, line)
        for statement in _statements(" ".join(line for line in lines if not line.startswith("#"))):
            try:
                *words, end = statement.split()
                if end != ";":
                    raise ValueError
                self._add_declaration(words)
            except (IndexError, ValueError):
                raise _not_understood(path, statement) from None

    def _add_directive(self, path: Path, line: str) -> None:
        words = line.split()
        guard = path.name.upper().replace(".", "_")
        if words[0] == "#include" and words[-1].startswith('"'):
            self._add_header(path.with_name(words[-1].strip('"')))
        elif words[:-1] == ["#define", "FUGE_VERSION"]:
            self.version = words[-1].strip('"')
        elif words not in (["#ifndef", guard], ["#define", guard], ["#include", "<stddef.h>"], ["#endif"]):
            raise _not_understood(path, line)

    def _add_declaration(self, words: list[str]) -> None:
        if words[0] == "enum":
            for name, equals, value in _items(_inside("{}", words[1:])):
                if equals != "=" or not name.startswith("FUGE_"):
                    raise ValueError
                self.constants[name.removeprefix("FUGE_")] = int(value)
        elif words[:2] == ["typedef", "struct"]:
            self._add_struct(words[2:])
        elif words[0] == "typedef":
            opening = words.index("(")
            star, name, closing = words[opening + 1 : opening + 4]
            if star + closing != "*)":
                raise ValueError
            self.callbacks[name] = _signature(words[1:opening], words[opening + 4 :])
        else:
            opening = words.index("(")
            self.functions[words[opening - 1]] = _signature(words[: opening - 1], words[opening:])

    def _add_struct(self, words: list[str]) -> None:
        name, *members, alias = words
        if name != alias:
            raise ValueError
        if members:
            self.structs[name] = _members(_inside("{}", members))
        else:
            self.handles.append(name)


def _not_understood(path: Path, text: str) -> ValueError:
    return ValueError(f"{path}: fuge/_headers.py does not understand {' '.join(text.split())!r}")


def _without_comments(text: str) -> str:
    before, *rest = text.split("/*")
    return before + " ".join(part.partition("*/")[2] for part in rest)


def _statements(code: str) -> Iterator[str]:
    """Each declaration with its semicolon, and with spaces between its words; last what has no semicolon."""
    for mark in _MARKS:
        code = code.replace(mark, f" {mark} ")
    start = 0
    while (end := code.find(";", start)) >= 0:
        brace = code.find("{", start, end)
        if brace >= 0:
            end = code.find(";", max(brace, code.find("}", brace)))
            if end < 0:
                break
        yield code[start : end + 1]
        start = end + 1
    if code[start:].strip():
        yield code[start:]


def _inside(brackets: str, words: list[str]) -> list[str]:
    """The words between a pair of brackets, which are the first and the last word."""
    inner = words[1:-1]
    if words[0] + words[-1] != brackets or any(bracket in inner for bracket in brackets):
        raise ValueError
    return inner


def _items(words: list[str]) -> Iterator[list[str]]:
    """The words of each item of a list with commas."""
    return (item.split() for item in " ".join(words).split(","))


def _signature(result: list[str], parameters: list[str]) -> Signature:
    inner = _inside("()", parameters)
    types = []
    for *type, name in _items(inner) if inner != ["void"] else ():
        if not type or not name.isidentifier():
            raise ValueError
        types.append(" ".join(type))
    return Signature(" ".join(result), types)


def _members(words: list[str]) -> list[Member]:
    members = []
    *declarations, rest = " ".join(words).split(";")
    if rest:
        raise ValueError
    for declaration in declarations:
        type, *names = declaration.split()
        if type == "const":
            # A pointer to constants, alone in its declaration.
            target, star, *names = names
            if star != "*":
                raise ValueError
            type = f"const {target} *"
        for (declared,) in _items(names):
            name, bracket, length = declared.partition("[")
            if not name.isidentifier():
                raise ValueError
            members.append(Member(name, type, int(length.removesuffix("]")) if bracket else None))
    return members
