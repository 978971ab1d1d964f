"""The public part of a Fortran source, for FORD.

Module fuge takes names from modules that export more than it passes on. A copy of such a
module keeps what module fuge passes on and nothing else: exported procedures and those bound
to exported types, exported types and constants, the abstract interfaces of deferred
procedures. Docstrings are left as they are.
"""

import re

PROCEDURE = re.compile(r"\s*(?:(?:pure|elemental|recursive|impure|module)\s+)*(subroutine|function)\s+(\w+)", re.I)
TYPE = re.compile(r"\s*type\b(?!\s*\().*::\s*(\w+)\s*$", re.I)
BINDING = re.compile(r"\s*procedure\b[^:]*::\s*\w+(?:\s*=>\s*(\w+))?", re.I)
# Finalisers concern the compiler only.
FINAL = re.compile(r"\s*final\s*::", re.I)
DEFERRED = re.compile(r"\s*procedure\((\w+)\)", re.I)


def joined(text):
    """The text with continued lines in one line each."""
    return re.sub(r"&[ \t]*\n\s*&?", " ", text)


def exports(facade):
    """The names that a module takes from others with `use, only`, by module."""
    taken = {}
    for module, names in re.findall(r"^\s*use\s+(\w+)\s*,\s*only\s*:\s*(.*)$", joined(facade), re.M | re.I):
        taken.setdefault(module, []).extend(name.strip() for name in names.split(",") if name.strip())
    return taken


def own_exports(source):
    """The names that a module itself makes public."""
    text = joined(source).split("\ncontains\n")[0]
    names = []
    for attributes, rest in re.findall(r"^\s*(\w[^!\n]*?)::\s*([^!\n]*)$", text, re.M):
        if re.search(r"\bpublic\b", attributes):
            if attributes.strip().lower() == "public":
                names.extend(name.strip() for name in rest.split(","))
            else:
                names.append(re.match(r"\w+", rest).group())
    return names


class _Reader:
    """Blocks of lines, each with the docstring before it."""

    def __init__(self, lines):
        self.lines = lines
        self.at = 0

    def blocks(self):
        while self.at < len(self.lines):
            doc = []
            while self.at < len(self.lines) and self.lines[self.at].lstrip().startswith("!>"):
                doc.append(self._next())
            if self.at < len(self.lines):
                yield doc, self._statement()
            else:
                yield doc, []

    def _next(self):
        self.at += 1
        return self.lines[self.at - 1]

    def _statement(self):
        """A line, with its continuations; a whole type, interface or procedure."""
        first = self._next()
        taken = [first]
        end = None
        if TYPE.match(first):
            end = r"\s*end\s+type\b"
        elif re.match(r"\s*(abstract\s+)?interface\b", first, re.I):
            end = r"\s*end\s+interface\b"
        elif PROCEDURE.match(first):
            end = r"\s*end\s+(subroutine|function)\s+" + PROCEDURE.match(first).group(2) + r"\b"
        if end:
            while not re.match(end, taken[-1], re.I):
                taken.append(self._next())
        while taken[-1].split("!")[0].rstrip().endswith("&"):
            taken.append(self._next())
        return taken


def reduced(source, keep):
    """The source with only the names in `keep` public and without what they do not need."""
    lines = source.split("\n")
    start = next(k for k, line in enumerate(lines) if line.strip() == "private")
    split = next((k for k, line in enumerate(lines) if line == "contains"), len(lines))
    end = max(k for k, line in enumerate(lines) if line.startswith("end module"))
    bound, interfaces, out = set(), set(), lines[:start + 1]
    held = []
    for doc, block in _Reader(lines[start + 1:min(split, end)]).blocks():
        held.append((doc, block))
        name = TYPE.match(block[0]) if block else None
        if name and name.group(1) in keep:
            block[:] = [line for line in block if not FINAL.match(line)]
            bound |= {target for line in block for target in BINDING.findall(line) if target}
            bound |= {m.group(1) for m in (re.match(r"\s*procedure\b[^:(]*::\s*(\w+)", line) for line in block) if m}
            interfaces |= {m.group(1) for m in map(DEFERRED.match, block) if m}
    if interfaces:
        out.append("  public :: " + ", ".join(sorted(interfaces)))
    for doc, block in held:
        out += _specification(doc, block, keep)
    # What submodules define is shown as if the module did.
    procedures = [inner for _, block in held for inner in _of_submodules(block)]
    if split < end:
        procedures += _Reader(lines[split + 1:end]).blocks()
    if procedures:
        out.append("contains")
        for doc, block in procedures:
            name = PROCEDURE.match(block[0]) if block else None
            if name and (name.group(2) in keep or name.group(2) in bound):
                out += [""] + doc + block
    return "\n".join(out + [""] + lines[end:]) + "\n"


def without_uses(source, modules):
    """The source without `use` of modules that have no page."""
    def keep(match):
        return match.group(0) if match.group(1) in modules else ""
    return re.sub(r"^ *use\b(?:, *intrinsic *::)? *(\w+)[^\n]*(?:(?<=&)\n[^\n]*)*\n", keep, source, flags=re.M)



def _of_submodules(block):
    """The procedures, without their bodies, that an interface says submodules define."""
    if not block or not re.match(r"\s*interface\s*$", block[0], re.I):
        return []
    found = [(doc, inner) for doc, inner in _Reader(block[1:-1]).blocks() if inner and PROCEDURE.match(inner[0])]
    return [(doc, [re.sub(r"\bmodule +(?=subroutine|function)", "", inner[0]), *inner[1:]]) for doc, inner in found]


def _specification(doc, block, keep):
    """What is left of a block before `contains`."""
    if not block:
        return doc
    listed = re.match(r"\s*public\s*::\s*(.*)", joined("\n".join(block)), re.I)
    if listed:
        names = [name for name in re.split(r"\s*,\s*", listed.group(1).strip()) if name in keep]
        return ["  public :: " + ", ".join(names)] if names else []
    name = TYPE.match(block[0])
    if name:
        return doc + block if name.group(1) in keep else []
    if re.match(r"\s*interface\b", block[0], re.I):
        return []
    constant = re.match(r"(.*), public\s*::\s*(\w+)", block[0], re.I)
    if constant and constant.group(2) not in keep:
        return []
    return doc + block
