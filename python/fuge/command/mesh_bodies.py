"""Bodies with meshes as the options name them: which files belong to which, and what these have."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator

import numpy as np

from fuge.command.checks import check_input
from fuge.command.errors import CommandError, UsageError
from fuge.command.mesh_model import AXES, MeshBody, MeshModel
from fuge.command.options import Options, Setting
from fuge.command.run import Log
from fuge.errors import Status
from fuge.formats.stiffness import read_stiffness
from fuge.formats.text import quoted_path
from fuge.mesh import read_mesh

_Part = dict[str, Setting]


def read_model(given: Options, log: Log) -> MeshModel:
    """Read the files of all bodies.

    Raises
    ------
    UsageError
        Options of a body are missing or given twice, names of bodies cannot be told apart, or a result would overwrite
        what a mesh includes.
    FileError
        A file cannot be read, or mesh and matrix are not of one body.
    """
    parts: dict[str, _Part] = {}
    for part in _parts(given):
        name = _name(part)
        if re.search(r"[.:,=\s]", name) or not name:
            reason = "has a point, colon, comma, equals sign or blank, or no letter: give another one by --body"
            raise UsageError(f'the name of body "{name}" {reason}')
        if name.upper() in map(str.upper, parts):
            raise UsageError(f'two bodies have the name "{name}": give others by --body')
        parts[name] = part
    bodies: list[MeshBody] = []
    for name, part in parts.items():
        before = bodies[-1].before + bodies[-1].mesh.node.size if bodies else 0
        bodies.append(_read(given, log, name, part, before))
    model = MeshModel(bodies)
    for k, part in enumerate(parts.values()):
        if "stiffness" in part:
            _name_rows(model, k, part)
    return model


def _parts(given: Options) -> Iterator[_Part]:
    """The options of each body: --body begins one, and so does a second --mesh or --stiffness."""
    part: _Part = {}
    for setting in given.settings:
        name = setting.name
        if name not in ("body", "mesh", "stiffness", "rows", "matrix"):
            continue
        if part and (name == "body" or (name in part and name in ("mesh", "stiffness"))):
            yield part
            part = {}
        if name in part:
            raise setting.refuse("its body has one already")
        part[name] = setting
    yield part


def _name(part: _Part) -> str:
    if "mesh" not in part:
        raise next(iter(part.values())).refuse("its body has no --mesh")
    if "body" in part:
        return part["body"].value
    base = os.path.basename(part["mesh"].path())
    return base.partition(".")[0] or base


def _read(given: Options, log: Log, name: str, part: _Part, before: int) -> MeshBody:
    mesh = read_mesh(part["mesh"].path())
    for path in mesh.paths:
        check_input(given, path, "the same file as of --mesh or of an *INCLUDE in it")
    log.say(f"mesh of {name}: {mesh.node.size} nodes, {mesh.element.size} elements")
    if "stiffness" not in part:
        for option in part.keys() & {"rows", "matrix"}:
            raise part[option].refuse("its body has no --stiffness")
        return MeshBody(name, mesh, None, before)
    names = part["rows"].path() if "rows" in part else None
    matrix = part["matrix"].value if "matrix" in part else None
    stiffness = read_stiffness(part["stiffness"].path(), names_path=names, name=matrix)
    log.say(f"stiffness of {name}: {stiffness.shape[0]} rows, {stiffness.row.size} entries")
    return MeshBody(name, mesh, stiffness, before)


def _name_rows(model: MeshModel, k: int, part: _Part) -> None:
    """Find the rows of the nodes of body k; those of nodes that the mesh does not have stay."""
    node, path = model.bodies[k].mesh.node, part["stiffness"].path()
    rows = np.flatnonzero(model.row_owner == k)
    number, axis = model.row_node[rows], model.row_direction[rows] - 1
    order = np.argsort(node)
    place = order[np.searchsorted(node, number, sorter=order).clip(max=order.size - 1)]
    known = (node[place] == number) & (axis >= 0) & (axis < len(AXES))
    if not known.any():
        mesh_path = quoted_path(part["mesh"].path())
        reason = f"has no row of a node of {mesh_path}: they are not of the same body"
        if not number.any():
            reason = "has rows without names: give the node and the direction of each by --rows"
        raise CommandError(f"{quoted_path(path)} {reason}", Status.ERR_FILE)
    model.row[model.bodies[k].before + place[known], axis[known]] = rows[known]
