"""Nodes and faces of the elements of Abaqus and CalculiX, which number both alike, by the names of their types."""

from __future__ import annotations

import re

MOST_FACE_NODES = 8

# Letters before the number of nodes, and what they mean; others may follow, as in C3D20R.
_FAMILIES = {
    **dict.fromkeys(["CPS", "CPE", "CAX"], "plane"),
    **dict.fromkeys(["M3D", "R3D", "S"], "shell"),
    **dict.fromkeys(["T2D", "T3D"], "truss"),
    "C3D": "solid",
}
_TYPE = re.compile(rf"({'|'.join(_FAMILIES)})(\d\d?)(?!\d)", re.ASCII)

# Corners of the faces S1, S2 .. of solids with as many corners, counter-clockwise if seen from outside, and the ends of
# the edges on which the further nodes of a quadratic element lie.
_CORNERS = {
    4: "132 124 234 314",
    6: "132 456 1254 2365 3146",
    8: "1432 5678 1265 2376 3487 4158",
}
_EDGES = {
    4: "12 23 31 14 24 34",
    6: "12 23 31 45 56 64 14 25 36",
    8: "12 23 34 41 56 67 78 85 15 26 37 48",
}


def element_type(name: str) -> tuple[str, int]:
    """Family and number of nodes that the name of a type, in upper case, says; '' and 0 if it does not.

    Families are plane, solid, truss, and shell with membranes and rigid faces.
    """
    match = _TYPE.match(name)
    # The number of nodes of some types varies.
    if match is None or "V" in name or int(match[2]) in (0, 27):
        return "", 0
    return _FAMILIES[match[1]], int(match[2])


def face_nodes(name: str, face: int) -> list[int]:
    """The nodes of face 1, 2 .. of a type, counted in the element from 0; none if it is not known to have such a face.

    Corners first, then the nodes on the edges from corner to corner. Of a solid, the corners follow each other
    counter-clockwise if seen from outside. Of an element of a plane, a face is an edge, counter-clockwise round it. A
    shell has face 1, SNEG, on the side of its negative normal, and 2, SPOS, on that of its positive one.
    """
    faces = _FACES.get(element_type(name), [])
    return faces[face - 1] if 1 <= face <= len(faces) else []


def _solid_faces(corners: int, quadratic: bool) -> list[list[int]]:
    edges = [set(edge) for edge in _EDGES[corners].split()]
    faces = []
    for around in _CORNERS[corners].split():
        middles = [corners + edges.index({a, b}) for a, b in zip(around, around[1:] + around[0])]
        faces.append([int(corner) - 1 for corner in around] + middles * quadratic)
    return faces


_FACES = {}
for _quadratic in (False, True):
    for _c in (4, 6, 8):
        _FACES["solid", _c + _quadratic * len(_EDGES[_c].split())] = _solid_faces(_c, _quadratic)
    for _c in (3, 4):
        _nodes = list(range(_c * (1 + _quadratic)))
        _FACES["plane", len(_nodes)] = [[k, (k + 1) % _c] + [_c + k] * _quadratic for k in range(_c)]
        _FACES["shell", len(_nodes)] = [[0, *_nodes[_c - 1 : 0 : -1], *reversed(_nodes[_c:])], _nodes]
