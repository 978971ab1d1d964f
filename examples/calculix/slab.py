"""Meshes of bodies that are one element thick, written as input files of CalculiX."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

# The corners of an element, and those at the ends of its edges, in CalculiX's order. Face S2, the second four, touches.
CORNERS = np.array([[0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1], [0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]])
EDGES = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]])
# An element above its contact surface would be inside out in the order of one below.
TURNED = [0, 3, 2, 1, 4, 7, 6, 5]


class Slab(NamedTuple):
    """`place` (lines along the contact surface, lines into the body, 2) are x and z of the nodes; order 1 is linear."""

    name: str
    place: np.ndarray
    thickness: float
    faces: int
    order: int = 1
    above: bool = False

    def nodes(self, first):
        """Numbers (lines i, lines j, lines through the thickness), 0 where there is no node, and positions."""
        i, j, k = np.indices((*self.place.shape[:2], self.order + 1))
        # Quadratic elements have nodes on their edges, not in the middle of their faces.
        there = (self.order == 1) | (i % 2 + j % 2 + k % 2 <= 1)
        number = np.where(there, first + np.cumsum(there).reshape(there.shape) - 1, 0)
        position = np.stack([self.place[i, j, 0], self.thickness * k / self.order, self.place[i, j, 1]], axis=-1)
        return number, position[there]

    def elements(self, number):
        at = self.order * (CORNERS[TURNED] if self.above else CORNERS)
        if self.order == 2:
            at = np.vstack([at, at[EDGES].sum(axis=1) // 2])
        lines, depths = (range(0, count - 1, self.order) for count in number.shape[:2])
        begin = np.array([(i, j, 0) for i in lines for j in depths])
        return number[tuple(np.moveaxis(begin[:, None] + at, 2, 0))]


def block(name, side, spacing, growth, reach, thickness, radius=np.inf, parts=1, above=False, shift=0.0):
    """A block with a cylindrical face and a flat end; half of its width is at least `side`, and so is its height.

    Elements of `spacing`, up to `reach` from the middle, and growing ones farther out are divided into parts x parts.
    """
    faces = round(reach / spacing)
    lines = (graded(side, spacing, growth, equal, parts) for equal in (faces + 1, 2))
    x, depth = np.meshgrid(*lines, indexing="ij")
    z = depth + x**2 / (2.0 * radius) * (1.0 - depth / depth[:, -1:])
    return Slab(name, np.stack([x, shift + z if above else -z], axis=-1), thickness, parts * faces, above=above)


def graded(last, spacing, growth, equal, parts):
    """From 0 to `last` or beyond: `equal` lines at equal distances, then at growing ones, all divided into parts."""
    lines = list(spacing * np.arange(equal))
    while lines[-1] < last:
        spacing *= growth
        lines.append(lines[-1] + spacing)
    return np.interp(np.arange(parts * (len(lines) - 1) + 1) / parts, np.arange(len(lines)), lines)


def write(path, *slabs, unit=1.0):
    """Write a mesh, lengths times `unit`, with sets, and for each slab the surface S.. of its first `faces` faces."""
    cards, node, element = [], 1, 1
    for slab in slabs:
        number, position = slab.nodes(node)
        elements = slab.elements(number)
        # CalculiX reads twenty characters of a number, and sixteen numbers of a line.
        cards.append(f"*NODE, NSET={slab.name}")
        cards += [f"{k}, {x:.13E}, {y:.13E}, {z:.13E}" for k, (x, y, z) in enumerate(unit * position, node)]
        cards.append(f"*ELEMENT, TYPE=C3D{elements.shape[1]}, ELSET={slab.name}")
        for k, nodes in enumerate(elements.astype(str), element):
            cards.append(f"{k}, " + ",\n".join(", ".join(part) for part in (nodes[:8], nodes[8:]) if part.size))
        sets = {"FACE": number[: slab.order * slab.faces + 1, 0], "END": number[:, -1], "FRONT": number[:, :, 0]}
        for name, nodes in {**sets, "FIRST": number[0], "LAST": number[-1]}.items():
            cards += [f"*NSET, NSET={slab.name}{name}", *(f"{k}," for k in nodes[nodes > 0])]
        cards.append(f"*SURFACE, NAME=S{slab.name}")
        cards += [f"{element + k * (number.shape[1] - 1) // slab.order}, S2" for k in range(slab.faces)]
        node, element = node + len(position), element + len(elements)
    Path(path).write_text("\n".join(cards) + "\n")
