"""Supports, forces and pressures on bodies with meshes: from options, tables and input files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple, Optional

import numpy as np

from fuge.command.checks import check_input
from fuge.command.face_forces import pressure_forces
from fuge.command.mesh_model import AXES, MeshBody, MeshModel, Refuse, dimensions_of, is_ring
from fuge.command.options import Options, Setting
from fuge.errors import FileError, Status
from fuge.formats.decks import has_keywords
from fuge.formats.keyword import read_blocks, split_items
from fuge.formats.keyword_rules import parameters_of
from fuge.formats.tables import named_rows
from fuge.formats.text import Reason, quoted_path, read_text, refusal, value

_DIRECTIONS = {str(k + 1): k for k in range(len(AXES))}
_LETTERS = {**_DIRECTIONS, **{letter: "xyz".index(letter.lower()) for letter in "xyzXYZ"}}

# The columns of a table, and their names in headings.
_COLUMNS = ("nodes", "axes", "value")
_HEADINGS = {
    **dict.fromkeys(("node", "nodes"), "nodes"),
    **dict.fromkeys(("axis", "axes", "direction", "directions"), "axes"),
    **dict.fromkeys(("value", "force", "load", "displacement"), "value"),
}


class _Kind(NamedTuple):
    """What supports and loads differ in: keyword, columns of a line at least and at most in input files, and words."""

    keyword: str
    least: int
    most: int
    example: str
    line: str
    needed: str
    # Keywords of input files that other options stand for.
    skipped: str


_SUPPORT = _Kind(
    "BOUNDARY", 2, 4, "hub.BOTTOM:xyz or hub.17:z=0.1", "17,z: a support",
    "nodes, an axis and perhaps a displacement are needed, like 17,z,0.1",
    "CLOAD DLOAD DSLOAD CONTACTPAIR SURFACEINTERACTION SURFACEBEHAVIOR",
)  # fmt: skip
_LOAD = _Kind(
    "CLOAD", 3, 3, "hub.TOP:z=-100", "17,z,-100: a load", "nodes, an axis and a force are needed, like 17,z,-100",
    "BOUNDARY CONTACTPAIR SURFACEINTERACTION SURFACEBEHAVIOR",
)  # fmt: skip


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
    _check_elastic(model.bodies[model.owner[nodes[0]]], refuse)
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


def _check_elastic(body: MeshBody, refuse: Refuse) -> None:
    if body.stiffness is None:
        raise refuse(f"body {body.name} has no --stiffness: it is rigid and stands still")


def _condition(refuse: Refuse, nodes: str, axes: Sequence[int] | str, number: str | None) -> _Condition:
    """A condition from words; axes are letters or numbers, one or several."""
    if isinstance(axes, str):
        if not axes or not set(axes) <= set(_LETTERS):
            raise refuse(f'"{axes}" is no axis: x, y, z, or 1 to 6')
        axes = sorted({_LETTERS[letter] for letter in axes})
    try:
        return _Condition(refuse, nodes, axes, None if number is None else value(number))
    except Reason:
        raise refuse(f'a number is needed, not "{number}"') from None


def _word(setting: Setting, kind: _Kind) -> _Condition:
    """NODES:AXES or NODES:AXES=VALUE."""
    nodes, _, rest = setting.value.rpartition(":")
    axes, equals, number = rest.partition("=")
    if not nodes:
        raise setting.refuse(f"nodes and an axis are needed, like {kind.example}")
    condition = _condition(setting.refuse, nodes, axes, number if equals else None)
    if kind is _LOAD and not equals:
        raise setting.refuse(f"a force is needed, like {kind.example}")
    return condition


def _press(setting: Setting, model: MeshModel) -> None:
    """SURFACE=P, positive into the body. Along a direction that the stiffness lacks a support takes the force."""
    surface, _, word = setting.value.rpartition("=")
    try:
        pressure = value(word if surface else "")
    except Reason:
        raise setting.refuse("a surface and a pressure are needed, like hub.TOP=2.5") from None
    faces = model.find_faces(surface, setting.refuse)
    _check_elastic(faces.body, setting.refuse)
    counts = (faces.node >= 0).sum(axis=1)
    moves = False
    for count, kind in sorted(set(zip(counts.tolist(), faces.type.tolist()))):
        face = faces.node[(counts == count) & (faces.type == kind), :count]
        dimensions = dimensions_of(kind)
        force = pressure * pressure_forces(model.mesh.position[face][..., :dimensions], is_ring(kind))
        row = model.row[face][..., :dimensions]
        np.add.at(model.load, row[row >= 0], force[row >= 0])
        moves = moves or bool((row >= 0).any())
    if not moves:
        raise setting.refuse("no node there has a row in the stiffness")


# ---- files


def _file(given: Options, setting: Setting, kind: _Kind, model: MeshModel) -> list[_Condition]:
    """The lines of FILE, or of BODY=FILE, whose nodes are all of that body."""
    name, equals, _ = setting.value.partition("=")
    named = (f"{body.name}." for body in model.bodies if equals and body.name.upper() == name.upper())
    body = next(named, "")
    path = setting.path(len(body))
    found = _deck(given, path, kind) if has_keywords(read_text(path).lines) else _table(path, kind)
    conditions = [condition._replace(nodes=body + condition.nodes) for condition in found]
    if not conditions:
        raise FileError(f"{quoted_path(path)} has no line like {kind.line}", Status.ERR_FILE)
    return conditions


def _is_heading(cells: Sequence[str]) -> bool:
    """Whether all cells are names of columns; those of nodes may begin with a letter too."""
    return all(cell.lower() in _HEADINGS for cell in cells)


def _table(path: str, kind: _Kind) -> Iterator[_Condition]:
    """Lines NODES, AXES and VALUE; a heading may give the columns another order."""
    for place, row in named_rows(path, _COLUMNS, _HEADINGS, _is_heading):
        refuse: Refuse = partial(refusal, place)
        if len(row) < kind.least or not {"nodes", "axes"} <= row.keys():
            raise refuse(kind.needed)
        yield _condition(refuse, row["nodes"], row["axes"], row.get("value"))


def _deck(given: Options, path: str, kind: _Kind) -> Iterator[_Condition]:
    """The lines under *BOUNDARY or *CLOAD of an input file of Abaqus or CalculiX, of one load case."""
    paths: list[str] = []
    step, steps = 0, set[int]()
    for block in read_blocks(path, paths):
        step += block.keyword == "STEP"
        if block.keyword in kind.skipped.split():
            continue
        if kind is _LOAD and block.keyword in ("DLOAD", "DSLOAD"):
            raise block.refuse(f"*{block.keyword} is not read here: give a uniform pressure by --pressure SURFACE=P")
        parameters = parameters_of(block)
        if block.keyword == kind.keyword:
            if steps - {0, step} or (steps - {step} and parameters.get("OP") == "NEW"):
                raise block.refuse(f"*{block.keyword} of another load case follows: leave those of one")
            steps.add(step)
            for k, line in enumerate(block.lines):
                yield _data(partial(block.refuse, index=k), split_items(line)[0], kind)
    for included in paths[1:]:
        check_input(given, included, "the same file as of an *INCLUDE")


def _data(refuse: Refuse, items: list[str], kind: _Kind) -> _Condition:
    """Node, direction and force, or node, first and perhaps last direction and displacement."""
    if not kind.least <= len(items) <= kind.most:
        raise refuse(kind.needed)
    node, first, third, fourth = [*items, "", ""][:4]
    last, number = (first, third) if kind is _LOAD else (third or first, fourth or None)
    for word in (first, last):
        if word not in _DIRECTIONS:
            raise refuse(f'"{word}" is no axis: 1 to 6')
    axes = range(_DIRECTIONS[first], _DIRECTIONS[last] + 1)
    if not axes:
        raise refuse("the last direction is less than the first one")
    return _condition(refuse, node, axes, number)
