"""Matrices in Nastran's bulk data: DMIG, as a punch file holds it.

A header, DMIG NAME 0 IFO TIN .., says what the matrix is: IFO = 6 symmetric, 1 square; TIN = 1 or 2 real. A column is
DMIG NAME GJ CJ and then, four fields each, Gi Ci Ai Bi: node and direction of the row, the value, and its imaginary
part. Four fields never part at the end of a line.
"""

from __future__ import annotations

import re
from collections import defaultdict
from functools import lru_cache

import numpy as np

from fuge.formats.matrix_rows import DIRECTIONS, Entries
from fuge.formats.number_columns import Column, Table, blocks, label_column, read_words
from fuge.formats.text import BLANKS, Reason, TextFile, label, quoted, refusal

_SYMMETRIC, _SQUARE = 6, 1

_ROW = (label_column("node"), label_column("component", 0, DIRECTIONS - 1), Column(), Column())

_SKIPPED = re.compile(r"[ \t\r]*(?:\$|$)")
# The beginning of a card. Others continue the line above: from + or * on, or with a blank first field.
_CARD = re.compile(r" {0,7}[^ +*,$]")
# What stands behind the fields of a free line is the marker of a continuation, which does not begin like a number.
_MARKER = re.compile(r"[ \t]*(?![-.\d])[^,]*[, \t\r]*$", re.ASCII)


def read_dmig(file: TextFile, name: str) -> Entries:
    """Read all entries of the matrix called `name`, or of the only one if it is blank."""
    heads: list[int] = []
    keys: list[int] = []
    body: list[int] = []
    wanted, other, whole = name, "", False
    cards = [k for k, line in enumerate(file.lines) if line[:1] not in "*+$" and _CARD.match(line)]
    for k, end in zip(cards, [*cards[1:], len(file.lines)]):
        if file.lines[k][:8].strip(" ")[:4].lower() != "dmig":
            continue
        try:
            found, node, *fields = _head(file, k)
            wanted = wanted or found
            if found.lower() != wanted.lower():
                other = found
                if not name:
                    both = f"{quoted(wanted)} and {quoted(found)}"
                    raise Reason(f"the file holds the matrices {both}: pass the name of the one to read")
            elif label(node, "node", 0) == 0:
                whole = _is_whole(fields[0], fields[1])
            else:
                heads.append(k)
                keys.append(int(node) * DIRECTIONS + label(fields[0] or "0", "component", 0, DIRECTIONS - 1))
                body += [i for i in range(k + 1, end) if not _SKIPPED.match(file.lines[i])]
                if fields[1]:
                    raise Reason(f"{quoted(fields[1])} stands where a column has a blank field")
                if end < len(file.lines) and not re.match(" *[A-Za-z]", file.lines[end]):
                    raise file.refuse(end + 1, "neither a card nor a continuation of the DMIG above")
        except Reason as reason:
            raise file.refuse(k + 1, reason) from None
    if not heads:
        no_matrix = f"no matrix {quoted(name)}, but {quoted(other)}"
        raise refusal(file.path, f"the file has {no_matrix if other else 'no entry of a DMIG matrix'}")
    table = np.hstack([_rows(file, heads, 4), _rows(file, body, 0)])
    line, node, component, value, _ = table[:, np.argsort(table[0], kind="stable")]
    # A column without rows is one of the matrix too.
    column = np.array(keys)[np.searchsorted(np.array(heads), line, side="left") - 1]
    row = (node * DIRECTIONS + component).astype(np.int64)
    return Entries(row, column, value, line.astype(np.int64), names=np.array(keys), whole=whole)


def _head(file: TextFile, k: int) -> list[str]:
    """The first four data fields of a DMIG: the name of its matrix, node, direction, and a blank one."""
    line = file.lines[k]
    keyword = line[:8].partition(",")[0].strip(" ")
    if keyword.upper() not in ("DMIG", "DMIG*"):
        raise Reason(f"{quoted(keyword)} is no card: is DMIG meant?")
    fields = [words[0].strip(BLANKS) for words in _fields(file, [k], *_form(line[:9]), line.count(","))]
    if not fields[0]:
        raise Reason("the name of the matrix is missing: DMIG and the name are needed")
    if not re.fullmatch(r"\S{1,8}", fields[0]):
        raise Reason(f"{quoted(fields[0])} is no name of a matrix: it has up to eight letters")
    return fields[:4]


def _is_whole(form: str, number_type: str) -> bool:
    """Whether a header is that of a square matrix, rather than of a symmetric one; Reason if of another one."""
    if label(form, "form IFO", 0) not in (_SYMMETRIC, _SQUARE):
        raise Reason(f"IFO = {form} is no stiffness matrix: it has the form 6 (symmetric) or 1 (square)")
    if label(number_type, "type TIN", 0) not in (1, 2):
        raise Reason(f"TIN = {number_type} is not read: a stiffness matrix is real, of type 1 or 2")
    return int(form) == _SQUARE


@lru_cache(maxsize=1000)
def _form(begin: str) -> tuple[bool, int]:
    """Whether the fields of a line are free, and how many they are, by its first nine characters."""
    first, comma, _ = begin.partition(",")
    return bool(comma), 4 if "*" in first[:8] else 8


def _fields(file: TextFile, indices: list[int], free: bool, count: int, commas: int) -> list[list[str]]:
    """The data fields of lines of the same form: for each field the words of all lines, with blanks around them."""
    lines = [file.lines[k] for k in indices]
    if not free:
        width = 64 // count
        return [[line[k : k + width] for line in lines] for k in range(8, 72, width)]
    words = ",".join(lines).replace("\t", " ").split(",")
    if commas > count:
        for k, line in zip(indices, lines):
            if not _MARKER.match(line.split(",", count + 1)[-1]):
                raise file.refuse(k + 1, f"more than {count} fields")
    blank = [""] * len(lines)
    return [words[k :: commas + 1] if k <= commas else blank for k in range(1, count + 1)]


def _rows(file: TextFile, indices: list[int], first: int) -> Table:
    """Line, node, component, value and imaginary part of each row on these lines, from the data field `first` on."""
    tables = [np.empty((5, 0))]
    for block in blocks(indices):
        forms = defaultdict(list)
        for k in block:
            free, count = _form(file.lines[k][:9])
            forms[free, count, free and file.lines[k].count(",")].append(k)
        for form, chosen in forms.items():
            fields = _fields(file, chosen, *form)
            tables += [_group(file, chosen, fields[k : k + 4]) for k in range(first, len(fields), 4)]
    return np.hstack(tables)


def _group(file: TextFile, indices: list[int], words: list[list[str]]) -> Table:
    if not all(map(str.strip, words[0])):
        # A row may be left blank, but not its node alone.
        used = [k for k in range(len(indices)) if any(word[k].strip(" ") for word in words)]
        indices, words = [indices[k] for k in used], [[word[k] for k in used] for word in words]
    words[1::2] = [[word if word.strip(" ") else "0" for word in column] for column in words[1::2]]
    lines = [k + 1 for k in indices]
    table = read_words(file, lines, words, _ROW)
    for k in np.flatnonzero(table[3]):
        raise file.refuse(lines[k], "the value has an imaginary part: a stiffness matrix is real")
    return np.vstack([lines, table])
