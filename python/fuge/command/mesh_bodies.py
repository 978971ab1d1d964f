"""Bodies with meshes as the options name them: which files belong to which, and what these have."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable

import numpy as np

from fuge.command.checks import check_input
from fuge.command.errors import CommandError, UsageError
from fuge.command.mesh_model import AXES, MeshBody, MeshModel
from fuge.command.options import Options, Setting
from fuge.command.run import Log
from fuge.errors import Status
from fuge.files import read_stiffness
from fuge.formats.text import quoted_path, refusal
from fuge.mesh import read_mesh

_OF_BODIES = ("body", "mesh", "stiffness", "rows", "matrix")


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
    parts = list(_split(given.settings))
    names: list[str] = []
    for part in parts:
        name = _name(part)
        if re.search(r"[.:,=\s]", name) or not name:
            reason = "has a point, colon, comma, equals sign or blank, or no letter: give another one by --body"
            raise UsageError(f'the name of body "{name}" {reason}')
        if name.upper() in map(str.upper, names):
            raise UsageError(f'two bodies have the name "{name}": give others by --body')
        names.append(name)
    bodies: list[MeshBody] = []
    nodes = rows = 0
    for name, part in zip(names, parts):
        bodies.append(_read(given, log, name, part, nodes, rows))
        nodes += bodies[-1].mesh.node.size
        rows += bodies[-1].rows
    model = MeshModel(bodies)
    for body, part in zip(bodies, parts):
        if body.stiffness is not None:
            _name_rows(model, body, part["stiffness"].path(), part["mesh"].path())
    return model


def _split(settings: Iterable[Setting]) -> Iterable[dict[str, Setting]]:
    """The options of each body: --body begins one, and so does a second --mesh or --stiffness."""
    part: dict[str, Setting] = {}
    for setting in settings:
        name = setting.name
        if name not in _OF_BODIES:
            continue
        if part and (name == "body" or (name in part and name in ("mesh", "stiffness"))):
            yield part
            part = {}
        if name in part:
            raise setting.refuse("its body has one already")
        part[name] = setting
    yield part


def _name(part: dict[str, Setting]) -> str:
    if "mesh" not in part:
        if "body" in part:
            raise UsageError(f'body "{part["body"].value}" has no --mesh')
        raise next(iter(part.values())).refuse("its body has no --mesh")
    if "body" in part:
        return part["body"].value
    base = os.path.basename(part["mesh"].path())
    return base.partition(".")[0] or base


def _read(given: Options, log: Log, name: str, part: dict[str, Setting], nodes: int, rows: int) -> MeshBody:
    mesh = read_mesh(part["mesh"].path())
    for path in getattr(mesh, "paths", ()):
        check_input(given, path, "the same file as of --mesh or of an *INCLUDE in it")
    log.say(f"mesh of {name}: {mesh.node.size} nodes, {mesh.element.size} elements")
    if "stiffness" not in part:
        for option in {"rows", "matrix"} & part.keys():
            raise part[option].refuse("its body has no --stiffness")
        return MeshBody(name, mesh, None, nodes, rows)
    stiffness = read_stiffness(
        part["stiffness"].path(),
        names_path=part["rows"].path() if "rows" in part else None,
        name=part["matrix"].value if "matrix" in part else None,
    )
    log.say(f"stiffness of {name}: {stiffness.shape[0]} rows, {stiffness.row.size} entries")
    return MeshBody(name, mesh, stiffness, nodes, rows)


def _name_rows(model: MeshModel, body: MeshBody, path: str, mesh_path: str) -> None:
    """Find the rows of the nodes of a body; nodes that the mesh does not have keep theirs without a name."""
    here = slice(body.rows_before, body.rows_before + body.rows)
    number, axis = model.row_node[here], model.row_direction[here] - 1
    order = np.argsort(body.mesh.node)
    place = order[np.searchsorted(body.mesh.node, number, sorter=order).clip(max=order.size - 1)]
    named = np.flatnonzero((body.mesh.node[place] == number) & (axis >= 0) & (axis < len(AXES)))
    if named.size == 0:
        reason = f"has no row of a node of {quoted_path(mesh_path)}: they are not of the same body"
        if not number.any():
            reason = "has rows without names: give the node and the direction of each by --rows"
        raise CommandError(f"{quoted_path(path)} {reason}", Status.ERR_FILE)
    node, axis = body.before + place[named], axis[named]
    model.row[node, axis] = body.rows_before + named
    twice = np.flatnonzero(model.row[node, axis] != body.rows_before + named)
    if twice.size > 0:
        name = model.row_name(body.rows_before + int(named[twice[0]]))
        raise refusal(path, f"{name} is the name of two rows")
