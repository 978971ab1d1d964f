"""Pairs of surfaces of bodies with meshes, as the options name them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from fuge.command.mesh_model import Faces, MeshModel, dimensions_of, is_ring
from fuge.command.options import Options, Setting
from fuge.formats.text import Reason, value
from fuge.pairs import Surface

# Options without a value, and what they mean in words of the package.
_SWITCHES = {"tied": ("tied", True), "faceted": ("smooth", False), "node-to-face": ("method", "node_to_face")}
# Options with a number: its bounds, and what is said of one beyond them.
_NUMBERS = {
    "play": (0.0, np.inf, "a play is not negative"),
    "reach": (np.nextafter(0.0, 1.0), np.inf, "a length above 0 is needed"),
    "crease": (0.0, 90.0, "an angle from 0 to 90 degrees is needed"),
    "clearance": (-np.inf, np.inf, ""),
}
_OF_PAIRS = {*_SWITCHES, *_NUMBERS, "normals"}


class MeshPair(NamedTuple):
    """Two surfaces, with nodes and rows of the model; `options` are those of :meth:`ContactPairs.find`."""

    source: Setting
    faces: tuple[Faces, Faces]
    surfaces: tuple[Surface, Surface]
    options: dict[str, Any]
    # Added to the gaps.
    clearance: float


def read_pairs(given: Options, model: MeshModel) -> list[MeshPair]:
    """All pairs with their surfaces; options before the first --pair hold for all.

    Raises
    ------
    UsageError
        Names are unknown or not clear, an option of a pair is given twice or is wrong, or surfaces do not go together.
    """
    common: dict[str, Any] = {}
    found: list[tuple[Setting, dict[str, Any]]] = []
    seen: set[str] = set()
    for setting in given.settings:
        if setting.name == "pair":
            found.append((setting, dict(common)))
            seen = set()
        elif setting.name in _OF_PAIRS:
            if setting.name in seen:
                raise setting.refuse("the pair has one already")
            seen.add(setting.name)
            (found[-1][1] if found else common).update(_option(setting))
    return [_pair(setting, options, model) for setting, options in found]


def _option(setting: Setting) -> dict[str, Any]:
    if setting.name in _SWITCHES:
        return dict([_SWITCHES[setting.name]])
    if setting.name in _NUMBERS:
        least, most, reason = _NUMBERS[setting.name]
        if not least <= setting.number() <= most:
            raise setting.refuse(reason)
        return {setting.name: setting.number()}
    if setting.value in ("averaged", "opposite"):
        return {"normals": setting.value, "normal": None}
    try:
        normal = [value(word) for word in setting.value.split(",")]
    except Reason:
        normal = []
    if len(normal) > 3 or not any(normal):
        raise setting.refuse("averaged, opposite, or a direction like 0,0,1 is needed")
    return {"normals": "given", "normal": normal}


def _pair(setting: Setting, options: dict[str, Any], model: MeshModel) -> MeshPair:
    words = setting.value.split(":", 1)
    if len(words) < 2 or "" in words:
        raise setting.refuse("two surfaces are needed, like shaft.OUTER:hub.BORE")
    faces = model.find_faces(words[0], setting.refuse), model.find_faces(words[1], setting.refuse)
    if all(each.body.stiffness is None for each in faces):
        raise setting.refuse("both bodies are rigid: --stiffness is needed")
    for word, each in zip(words, faces):
        if len(each.node) == 0:
            raise setting.refuse(f"surface {word} has no faces")
    types = {name for each in faces for name in each.type.tolist()}
    sizes = set(map(dimensions_of, types))
    if len(sizes) > 1:
        raise setting.refuse("one surface is of elements of a plane, the other one of elements in space")
    dimensions = sizes.pop()
    if options.get("normal") is not None:
        if len(options["normal"]) != dimensions:
            raise setting.refuse(f"--normals needs one number for each axis, {dimensions} in all")
        options["normal"] = np.broadcast_to(options["normal"], (model.owner.size, dimensions))
    options["revolution"] = any(map(is_ring, types))
    clearance = options.pop("clearance", 0.0)
    node = np.ascontiguousarray(model.mesh.position[:, :dimensions])
    surfaces = []
    for each in faces:
        row = None if each.body.stiffness is None else model.row[:, :dimensions]
        if row is not None and (row[each.node[each.node >= 0]] < 0).all():
            reason = "has a row in its stiffness: are they of the same model?"
            raise setting.refuse(f"no node of the surface of body {each.body.name} {reason}")
        surfaces.append(Surface(node, each.node, row))
    # Tied surfaces are glued where they are.
    return MeshPair(setting, faces, (surfaces[0], surfaces[1]), options, 0.0 if "tied" in options else clearance)
