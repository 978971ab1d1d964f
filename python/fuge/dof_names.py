"""Names of degrees of freedom and of links, for messages and tables."""

from __future__ import annotations

import re
from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from fuge.stiffness_rows import StiffnessFile

_NUMBERED = re.compile(r"\b(contact point|point|degree of freedom|motion) (\d+)\b")


class DofNames:
    """Names of the rows of a stiffness matrix, by node and direction where it is a StiffnessFile."""

    def __init__(self, stiffness: Any) -> None:
        self._rows = stiffness if isinstance(stiffness, StiffnessFile) else None

    def __getitem__(self, dof: int) -> str:
        """Node and direction, such as '12.3', where they are known, else the number."""
        place = self._place(dof)
        return str(dof) if place is None else "{}.{}".format(*place)

    def words(self, dof: int) -> str:
        """The degree of freedom in a sentence."""
        place = self._place(dof)
        return f"degree of freedom {dof}" + ("" if place is None else " (node {}, direction {})".format(*place))

    def most(self, displacement: NDArray[np.float64]) -> str:
        """The degree of freedom that moves most, the first one of several."""
        size = np.abs(displacement)
        return self.words(int(np.argmax(size > (1.0 - 1e-6) * size.max())))

    def in_message(self, message: str, links: Sequence[str] = (), motion: Callable[[int], str] | None = None) -> str:
        """The message with names of links in place of numbers of points; `motion` tells what a motion is."""

        def name(match: re.Match[str]) -> str:
            kind, number = match[1], int(match[2])
            if kind == "degree of freedom":
                return self.words(number)
            if kind == "motion":
                return match[0] if motion is None else f"{match[0]}, {motion(number)},"
            return links[number] if number < len(links) else match[0]

        return _NUMBERED.sub(name, message)

    def _place(self, dof: int) -> tuple[int, int] | None:
        rows = self._rows
        if rows is None or not 0 <= dof < len(rows.node) or rows.node[dof] == 0:
            return None
        return int(rows.node[dof]), int(rows.direction[dof])
