"""Motions of a structure that nothing holds, and their words."""

from __future__ import annotations

from typing import Any, Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from fuge.errors import EquilibriumError

Doubles = NDArray[np.float64]

# Below this a displacement is an error of the modes, relative to the largest one.
_NOTHING = 1e-6

# Contact points by which motions are found, and degrees of freedom of each.
_POINTS, _WIDTH = 8, 256


def null_space(rows: Doubles, scale: float = 1.0) -> Doubles:
    """Orthonormal columns that rows take to zero, but for errors of numbers of this scale."""
    _, values, right = np.linalg.svd(np.linalg.qr(rows, mode="r"))
    return np.asarray(right[np.count_nonzero(values > _NOTHING * scale) :].T)


def modes_of(probe: Any) -> Doubles:
    """All rigid modes and mechanisms of a body, (degrees, modes), the largest displacement of each of size 1.

    They have to move contact points: random combinations of displacements, and what a random load still drives.
    """
    random = np.random.default_rng(0)
    width = min(probe.degrees, _WIDTH)
    points = [random.choice(probe.degrees, width, replace=False) for _ in range(_POINTS)]
    probe.find_rigid_modes()
    probe.set_load(random.standard_normal(probe.degrees))
    while True:
        dof = np.array([np.resize(point, width) for point in points])
        dof[_POINTS:, 1:] = -1
        probe.set_contact(dof, random.standard_normal(dof.shape))
        try:
            count = probe.condense().modes.shape[1]
            break
        except EquilibriumError as failure:
            if len(points) > probe.degrees + _POINTS:
                raise
            points.append(np.array([int(failure.message.split("degree of freedom ", 1)[1].split()[0])]))
    probe.set_load(np.zeros(probe.degrees))
    modes = [probe.recover(np.zeros(len(points)), motion) for motion in np.eye(count)]
    return np.reshape([mode / np.abs(mode).max() for mode in modes], (count, probe.degrees)).T


def free_motions(
    motions: Doubles, basis: Doubles, dof: NDArray[np.intc], most: Callable[[Doubles], str]
) -> dict[str, Doubles]:
    """Motions that nothing holds by their sentences, for each axis and each mechanism, whose `most` is told.

    The basis are translations and rotations of all nodes, whose degrees of freedom are `dof`.
    """
    if motions.shape[1] == 0:
        return {}
    dimensions = dof.shape[1]
    moved = np.where((dof >= 0)[..., None], motions[dof], 0.0).reshape(-1, motions.shape[1])
    basis[:, dimensions:] /= np.abs(basis[:, dimensions:]).max() or 1.0
    share = np.linalg.lstsq(basis, moved, rcond=None)[0]
    rigid = null_space(moved - basis @ share)
    share = share @ rigid
    shift, turn = share[:dimensions], share[dimensions:]
    still = null_space(turn)
    found = {
        f"nothing holds the structure along {axis}: it slides": rigid @ still @ part
        for axis, part in _directions(shift @ still, "xyz")
    }
    for axis, part in _directions(turn, "z" if dimensions == 2 else "xyz"):
        found[f"nothing keeps the structure from turning about {axis}"] = rigid @ part
    # Neither motions of the whole structure, nor seen at its nodes.
    for part in np.hstack([null_space(rigid.T), rigid @ null_space(share)]).T:
        found[f"nothing holds a mechanism that moves {most(motions @ part)} most"] = part
    return {sentence: motions @ part / np.abs(motions @ part).max() for sentence, part in found.items()}


def _directions(columns: Doubles, axes: str) -> Iterator[tuple[str, Doubles]]:
    """Axes in the space of the columns, vectors for what else is in it, and the columns' weights."""
    left, values, _ = np.linalg.svd(columns, full_matrices=False)
    space = left[:, values > _NOTHING]
    inside = np.linalg.norm(space @ space.T - np.eye(len(columns)), axis=0) < 1e-6
    named = [(axes[k], np.eye(len(columns))[k]) for k in np.flatnonzero(inside)]
    for vector in (space @ null_space(space[inside])).T:
        # Zero is added, so that none shows as -0.
        vector = vector * np.sign(vector[np.abs(vector).argmax()])
        named.append((f"({', '.join(f'{value + 0.0:g}' for value in vector.round(2))})", vector))
    combine = np.linalg.pinv(columns, rcond=_NOTHING)
    for axis, vector in named:
        yield axis, combine @ vector
