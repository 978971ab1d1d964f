"""Supports, forces and pressures on bodies with meshes: from options, tables and input files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple, Optional

import numpy as np

from fuge.command.checks import check_input
from fuge.command.face_forces import pressure_forces
from fuge.command.mesh_model import AXES, MeshModel, Refuse, is_plane
from fuge.command.options import Options, Setting
from fuge.errors import FileError, Status
from fuge.formats.keyword import Block, read_blocks, split_items
from fuge.formats.text import Reason, TextFile, quoted_path, read_text, value

_DIRECTIONS = {str(k + 1): k for k in range(len(AXES))}
_AXES = {**_DIRECTIONS, **{letter: "xyz".index(letter.lower()) for letter in "xyzXYZ"}}

# Headings of the columns of a table.
_HEADINGS = {
    **dict.fromkeys(("node", "nodes"), 0),
    **dict.fromkeys(("axis", "axes", "direction", "directions", "dof"), 1),
    **dict.fromkeys(("value", "force", "load", "displacement", "u", "f"), 2),
}

# Keywords of input files that neither hold nor load what *BOUNDARY and *CLOAD do not.
_HARMLESS = frozenset(
    """
    HEADING PREPRINT RESTART NODE NSET ELEMENT ELSET SURFACE ORIENTATION MATERIAL ELASTIC DENSITY
    SOLIDSECTION SHELLSECTION MEMBRANESECTION BEAMSECTION AMPLITUDE STEP ENDSTEP STATIC OUTPUT NODEOUTPUT ELEMENTOUTPUT
    CONTACTOUTPUT ENERGYOUTPUT NODEFILE ELFILE CONTACTFILE NODEPRINT ELPRINT CONTACTPRINT FILEFORMAT MONITOR CONTROLS
    CONTACTPAIR SURFACEINTERACTION SURFACEBEHAVIOR MATRIXGENERATE MATRIXOUTPUT SUBSTRUCTUREGENERATE
    """.split()
)
# Parameters that change nothing, with their values.
_PLAIN = {"OP": ("NEW", "MOD"), "TYPE": ("DISPLACEMENT",)}


class _Kind(NamedTuple):
    """What a support and a load differ in."""

    keyword: str
    least: int
    example: str
    needed: str
    line: str


_SUPPORT = _Kind("BOUNDARY", 2, "hub.BOTTOM:xyz or hub.17:z=0.1", "perhaps a displacement are needed, like 17,z,0.1",
                 "17,z: a support")  # fmt: skip
_LOAD = _Kind("CLOAD", 3, "hub.TOP:z=-100", "a force are needed, like 17,z,-100", "17,z,-100: a load")


class _Condition(NamedTuple):
    """Nodes by their name, axes, and a force or a displacement; `refuse` makes the error that it is wrong."""

    refuse: Refuse
    nodes: str
    axes: Sequence[int]
    value: Optional[float]


def take_conditions(given: Options, model: MeshModel) -> None:
    """Put all supports, forces and pressures into the model.

    Raises
    ------
    UsageError
        An option is wrong, or names nodes that do not exist or do not move.
    FileError
        The same of a line of a file.
    """
    for setting in given.settings:
        kind = _LOAD if setting.name in ("load", "loads") else _SUPPORT
        if setting.name in ("support", "load"):
            _apply(_word(setting, kind), kind, model)
        elif setting.name in ("supports", "loads"):
            for condition in _file(given, setting, kind, model):
                _apply(condition, kind, model)
        elif setting.name == "pressure":
            _press(setting, model)


def _apply(condition: _Condition, kind: _Kind, model: MeshModel) -> None:
    refuse, number = condition.refuse, condition.value or 0.0
    nodes = model.find_nodes(condition.nodes, refuse)
    _check_elastic(model, nodes[0], refuse)
    for axis in condition.axes:
        row = model.row[nodes, axis]
        lost, row = nodes[row < 0], row[row >= 0]
        if lost.size > 0 and (kind is _LOAD or number != 0.0):
            reason = "has no row in the stiffness: its program has held it, or it does not move that way"
            raise refuse(f"node {model.node_name(lost[0])} along {AXES[axis]} {reason}")
        if row.size == 0:
            reason = "in the stiffness: its program has held them, or the axis is wrong"
            raise refuse(f"no node there has a row along {AXES[axis]} {reason}")
        if kind is _LOAD:
            model.load[row] += number
            continue
        other = row[model.held[row] & (model.displacement[row] != number)]
        if other.size > 0:
            raise refuse(f"{model.row_name(other[0])} is displaced by another value already")
        model.held[row], model.displacement[row] = True, number


def _check_elastic(model: MeshModel, node: int, refuse: Refuse) -> None:
    body = model.bodies[model.owner[node]]
    if body.stiffness is None:
        raise refuse(f"body {body.name} has no --stiffness: it is rigid and stands still")


def _condition(refuse: Refuse, nodes: str, axes: Sequence[int], number: str | None) -> _Condition:
    try:
        return _Condition(refuse, nodes, axes, None if number is None else value(number))
    except Reason:
        raise refuse(f'a number is needed, not "{number}"') from None


def _axes(refuse: Refuse, word: str) -> list[int]:
    """Axes by letters or numbers, one or several."""
    if not word or not set(word) <= set(_AXES):
        raise refuse(f'"{word}" is no axis: x, y, z, or 1 to 6')
    return sorted({_AXES[letter] for letter in word})


def _word(setting: Setting, kind: _Kind) -> _Condition:
    """NODES:AXES or NODES:AXES=VALUE."""
    nodes, _, rest = setting.value.rpartition(":")
    if not nodes:
        raise setting.refuse(f"nodes and an axis are needed, like {kind.example}")
    axes, equals, number = rest.partition("=")
    condition = _condition(setting.refuse, nodes, _axes(setting.refuse, axes), number if equals else None)
    if kind is _LOAD and not equals:
        raise setting.refuse(f"a force is needed, like {kind.example}")
    return condition


# ---- files


def _file(given: Options, setting: Setting, kind: _Kind, model: MeshModel) -> Iterator[_Condition]:
    """The lines of FILE, or of BODY=FILE, whose nodes are all of that body."""
    name = setting.value.partition("=")[0]
    named = (body.name + "." for body in model.bodies if body.name.upper() == name.upper())
    body = next(named, "") if "=" in setting.value else ""
    path = setting.path(len(body))
    file = read_text(path)
    lines = (line.strip() for line in file.lines)
    begin = next((line for line in lines if line and not line.startswith(("**", "#"))), "")
    is_deck = re.match(r"\*[A-Za-z]", begin) is not None
    found = 0
    for condition in _deck(given, path, kind) if is_deck else _table(file, kind):
        found += 1
        yield condition._replace(nodes=body + condition.nodes)
    if found == 0:
        raise FileError(f"{quoted_path(path)} has no line like {kind.line}", Status.ERR_FILE)


def _table(file: TextFile, kind: _Kind) -> Iterator[_Condition]:
    """Lines NODES, AXES and VALUE; a heading may give the columns another order."""
    order: list[int] = []
    for number, line in enumerate(file.lines, 1):
        text = line.partition("#")[0].strip(" \r")
        if not text or text.startswith("**"):
            continue
        cells = _cells(text)
        refuse: Refuse = partial(file.refuse, number)
        if not order:
            order = [0, 1, 2]
            if all(cell.lower() in _HEADINGS for cell in cells):
                order = [_HEADINGS[cell.lower()] for cell in cells]
                if sorted(order) not in ([0, 1], [0, 1, 2]):
                    raise refuse("the columns are nodes, axes and value, each once")
                continue
        row = dict(zip(order, cells))
        if not kind.least <= len(cells) <= len(order) or {0, 1} - set(row):
            raise refuse(f"nodes, an axis and {kind.needed}")
        yield _condition(refuse, row[0], _axes(refuse, row[1]), row.get(2))


def _cells(text: str) -> list[str]:
    """The columns of a line, between semicolons, commas or tabs, or else blanks; an empty last one does not count."""
    separator = next((mark for mark in ";,\t" if mark in text), None)
    cells = [cell.strip() for cell in text.split(separator)]
    return cells[:-1] if cells[-1] == "" else cells


def _deck(given: Options, path: str, kind: _Kind) -> Iterator[_Condition]:
    """The lines under *BOUNDARY or *CLOAD of an input file of Abaqus or CalculiX."""
    paths: list[str] = []
    step = 0
    steps: set[int] = set()
    for block in read_blocks(path, paths):
        step += block.keyword == "STEP"
        if block.keyword not in (_SUPPORT.keyword, _LOAD.keyword):
            if block.keyword not in _HARMLESS:
                reason = f"*{block.keyword} is not read here: leave it out if it neither holds nor loads the body"
                raise block.refuse(reason)
        elif block.keyword == kind.keyword and block.lines:
            _check_parameters(block)
            if steps - {0, step} or (steps - {step} and block.parameters.get("OP") == "NEW"):
                raise block.refuse(f"*{block.keyword} of more than one load case: leave those of one")
            steps.add(step)
            yield from _data(block, kind)
    for included in paths[1:]:
        check_input(given, included, "the same file as of an *INCLUDE")


def _check_parameters(block: Block) -> None:
    for name, setting in block.named(_PLAIN).items():
        if setting.upper() not in _PLAIN[name]:
            raise block.refuse(f"{name}={setting} of *{block.keyword} is not supported")


def _data(block: Block, kind: _Kind) -> Iterator[_Condition]:
    for k, line in enumerate(block.lines):
        items, _ = split_items(line)
        refuse: Refuse = partial(block.refuse, index=k)
        if not kind.least <= len(items) <= (3 if kind is _LOAD else 4):
            raise refuse(f"nodes, an axis and {kind.needed}")
        ends = items[1:2] if kind is _LOAD or not "".join(items[2:3]) else items[1:3]
        for word in ends:
            if word not in _DIRECTIONS:
                raise refuse(f'"{word}" is no axis: 1 to 6')
        first, last = (_DIRECTIONS[word] for word in (ends[0], ends[-1]))
        if last < first:
            raise refuse("the last direction is less than the first one")
        number = items[-1] if len(items) == (3 if kind is _LOAD else 4) else None
        yield _condition(refuse, items[0], range(first, last + 1), number or None)


# ---- pressures


def _press(setting: Setting, model: MeshModel) -> None:
    """SURFACE=P, positive into the body. A force along a direction that the stiffness lacks goes into the support."""
    surface, _, word = setting.value.rpartition("=")
    try:
        pressure = value(word if surface else "")
    except Reason:
        raise setting.refuse("a surface and a pressure are needed, like hub.TOP=2.5") from None
    faces = model.find_faces(surface, setting.refuse)
    if faces.body.stiffness is None:
        raise setting.refuse(f"body {faces.body.name} has no --stiffness: it is rigid and stands still")
    nodes = (faces.node >= 0).sum(axis=1)
    moves = False
    for count, kind in sorted(set(zip(nodes.tolist(), faces.type.tolist()))):
        face = faces.node[(nodes == count) & (faces.type == kind), :count]
        dimensions = 2 if is_plane(kind) else 3
        force = pressure * pressure_forces(model.position[face][..., :dimensions], kind.startswith("CAX"))
        row = model.row[face][..., :dimensions]
        np.add.at(model.load, row[row >= 0], force[row >= 0])
        moves = moves or bool((row >= 0).any())
    if not moves:
        raise setting.refuse("no node there has a row in the stiffness")
