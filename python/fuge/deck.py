"""One-way links and load cases: what decks and tables say beside the mesh and the stiffness matrix."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge import _arrays
from fuge.errors import InputError, Status
from fuge.formats.text import PathLike, Place, Reason
from fuge.links import Links
from fuge.stiffness_rows import RowNames, StiffnessFile

# A component of the unit vector of a link is rounding up to this size, so that it needs no row.
_NO_COMPONENT = 16.0 * float(np.finfo(float).eps)

Dof = tuple[int, int]
"""A node and a direction: 1 to 3 along x, y, z, 4 to 6 about them, 0 of a scalar point."""


@dataclass(frozen=True)
class DeckLink:
    """A one-way link between two nodes; node 0 is the ground.

    It opens by direction . (u_b - u_a): its gap is `gap` plus that, and its force, not negative, acts on node b along
    `direction` and on node a against it. A strut has the direction from a to b, a cable that from b to a.
    """

    name: str
    node_a: int
    node_b: int
    direction: tuple[float, float, float]
    gap: float = 0.0
    play: float = math.inf
    compliance: float = 0.0
    limit: float = math.inf
    place: Place | None = None

    def __str__(self) -> str:
        return self.name if self.place is None else f"{self.place}, {self.name}"


class Condition(NamedTuple):
    """A force or a displacement, and where it is given."""

    value: float
    place: Place
    step: int


class Conditions(dict[Dof, Condition]):
    """Forces or displacements of a load case; one of a later step takes the place of that of an earlier one."""

    def add(self, dof: Dof, value: float, place: Place, step: int = 0) -> None:
        """Add a force to those of the same step."""
        before = self.get(dof)
        if before is not None and before.step == step:
            value += before.value
        self[dof] = Condition(value, place, step)

    def hold(self, dof: Dof, value: float, place: Place, step: int = 0) -> None:
        """Prescribe a displacement; Reason if the same step prescribes another one."""
        before = self.get(dof)
        if before is not None and before.step == step and before.value != value:
            raise Reason(
                f"node {dof[0]} is displaced by {value:g} in direction {dof[1]}, but by {before.value:g} in "
                f"{before.place}"
            )
        self[dof] = Condition(value, place, step)


@dataclass
class DeckCase:
    """A load case: a subcase of Nastran, a step of Abaqus or CalculiX, a column of a table."""

    name: str
    loads: Conditions = field(default_factory=Conditions)
    supports: Conditions = field(default_factory=Conditions)


class Deck:
    """One-way links between nodes, and load cases with their supports.

    Made by :func:`read_deck`; ``Deck()`` is empty, for tables. The stiffness matrix must not have the links. A link
    opens by the displacement of node b less that of node a along its direction; its force, not negative, acts on node b
    along the direction and on node a against it.

    Attributes
    ----------
    paths : list of str
        All files that have been read.
    """

    def __init__(self) -> None:
        self._links: list[DeckLink] = []
        self._cases: list[DeckCase] = []
        # Supports of the model itself, as of all load cases that a table adds.
        self._supports = Conditions()
        self.paths: list[str] = []

    def __repr__(self) -> str:
        cases = ", ".join(self.case_names[:3]) + (", .." if len(self._cases) > 3 else "")
        return f"<Deck: {len(self._links)} links, {len(self._cases)} load cases{': ' * bool(cases)}{cases}>"

    @property
    def link_names(self) -> list[str]:
        """Card and number, such as CGAP 12, or names of a table."""
        return [link.name for link in self._links]

    @property
    def case_names(self) -> list[str]:
        """Such as SUBCASE 3, STEP 3, or the name of a step."""
        return [case.name for case in self._cases]

    @property
    def node_a(self) -> NDArray[np.intc]:
        """Number of the first node of each link in the file; 0: the ground."""
        return np.array([link.node_a for link in self._links], dtype=np.intc)

    @property
    def node_b(self) -> NDArray[np.intc]:
        """Number of the second node of each link in the file; 0: the ground."""
        return np.array([link.node_b for link in self._links], dtype=np.intc)

    @property
    def direction(self) -> NDArray[np.float64]:
        """Unit vectors, shape (links, 3)."""
        return np.array([link.direction for link in self._links], dtype=float).reshape(-1, 3)

    @property
    def gap(self) -> NDArray[np.float64]:
        """Gaps without load, length; negative: an interference."""
        return np.array([link.gap for link in self._links], dtype=float)

    @property
    def play(self) -> NDArray[np.float64]:
        """Distances of a second stop, length; infinite: none."""
        return np.array([link.play for link in self._links], dtype=float)

    @property
    def compliance(self) -> NDArray[np.float64]:
        """Of the links themselves, length per force; 0: rigid."""
        return np.array([link.compliance for link in self._links], dtype=float)

    @property
    def limit(self) -> NDArray[np.float64]:
        """Limits of the forces; infinite: none."""
        return np.array([link.limit for link in self._links], dtype=float)

    def read_links(self, path: PathLike) -> None:
        """Add the links of a table.

        Columns have the names node_a, node_b, x, y, z, gap, play, stiffness, limit and name, in this order or in that
        of a heading. Node 0 is the ground; x, y, z is a direction of any length, along which the link opens. Blank or
        missing from gap on: no gap, one-sided, rigid, no limit, link and its number; so are -1 as a play or limit and 0
        as a stiffness. Columns stand between commas, semicolons or tabs, else between blanks; comments go from # on.

        Raises
        ------
        FileError
            The message has the file, the line and the reason; the deck is unchanged.
        """
        from fuge.formats.deck_tables import read_links

        read_links(self, path)

    def read_supports(self, path: PathLike) -> None:
        """Add the supports of a table to the model, for cases to come, and to all load cases.

        Columns node, directions, such as xyz or 123, and displacement or rotation, 0 if it is blank; in this order or
        in that of a heading, as of :meth:`read_links`.

        Raises
        ------
        FileError
            As of :meth:`read_links`; also if a support contradicts one of the deck.
        """
        from fuge.formats.deck_tables import read_supports

        read_supports(self, path)

    def read_cases(self, path: PathLike) -> None:
        """Add the load cases of a table, with the supports of the model.

        Lines node.direction, such as 17.3, and a force or a moment for each case; a heading names the cases, behind a
        word for the first column. Separators are those of :meth:`read_links`.

        Raises
        ------
        FileError
            As of :meth:`read_links`.
        """
        from fuge.formats.deck_tables import read_cases

        read_cases(self, path)

    def links(self, stiffness: StiffnessFile) -> Links:
        """The links with their laws and names, for :meth:`Body.set_links`; link k is ``link_names[k]``.

        Parameters
        ----------
        stiffness : StiffnessFile
            The matrix of the structure without the links, whose rows have names. Programs leave out the rows of
            supports: a row that it does not have must be held in every load case, or, if there is none, by the
            supports of the model.

        Raises
        ------
        InputError
            There is no link, rows have no names or the same name, no row moves a link, or a row is missing at a
            degree of freedom that is not held.
        """
        if not self._links:
            raise InputError("the deck has no one-way link", Status.ERR_SIZE)
        rows = stiffness.row_names
        links = Links()
        for link in self._links:
            dof_a = self._rows_of(link, link.node_a, rows)
            dof_b = self._rows_of(link, link.node_b, rows)
            if max(dof_a + dof_b) < 0:
                raise InputError(f"{link}: no row of the matrix moves it", Status.ERR_DOF)
            links.add_gap(
                dof_a,
                dof_b,
                link.direction,
                gap=link.gap,
                play=link.play,
                compliance=link.compliance,
                limit=link.limit,
                limit_upper=link.limit,
                name=link.name,
            )
        return links

    def _rows_of(self, link: DeckLink, node: int, rows: RowNames) -> list[int]:
        """Rows of a node along the axes in which the link has a component; -1 where it does not move."""
        found = []
        for axis, component in enumerate(link.direction, 1):
            row = rows.find(node, axis) if node and component != 0.0 else -1
            if row < 0 and node and abs(component) > _NO_COMPONENT:
                self._check_held(link, (node, axis))
            found.append(row)
        return found

    def _check_held(self, link: DeckLink, dof: Dof) -> None:
        """Refuse a degree of freedom without a row unless every load case holds it: the matrix is that of all."""
        free = [f"{case.name} has no support" for case in self._cases if dof not in case.supports]
        if not self._cases and dof not in self._supports:
            free = ["no support is"]
        if free:
            reason = f"the matrix has no row of node {dof[0]}, direction {dof[1]}, but {free[0]} there"
            raise InputError(f"{link}: {reason}", Status.ERR_DOF)

    def loads(self, stiffness: StiffnessFile) -> NDArray[np.float64]:
        """External forces of the load cases, (cases, rows). Forces at supports go into these, and have no effect."""
        rows = stiffness.row_names
        loads = np.zeros((len(self._cases), len(rows)))
        for k, case in enumerate(self._cases):
            for dof, load in case.loads.items():
                row = rows.find(*dof)
                if row >= 0:
                    loads[k, row] = load.value
                elif load.value != 0.0 and dof not in case.supports:
                    raise _no_row(case, dof, load, "a force, but no support and")
        return loads

    def supports(self, case: int, stiffness: StiffnessFile) -> tuple[NDArray[np.intc], NDArray[np.float64]]:
        """Degrees of freedom that a load case holds, and their displacements, for :meth:`Body.fix`.

        Cases that hold the same ones need one :meth:`Body.condense`, and `supports` of :meth:`Body.solve_cases`.
        """
        number = _arrays.integer("case", case)
        if not 0 <= number < len(self._cases):
            raise InputError(f"load case {number} is outside 0 .. {len(self._cases) - 1}", Status.ERR_SIZE)
        rows, chosen = stiffness.row_names, self._cases[number]
        held = list(_held_rows(chosen, rows))
        dof = np.array([row for row, _ in held], dtype=np.intc)
        return dof, np.array([displacement for _, displacement in held], dtype=float)


def _held_rows(case: DeckCase, rows: RowNames) -> Iterator[tuple[int, float]]:
    """Supports without a row are held in the matrix already, unless they are displaced."""
    for dof, support in case.supports.items():
        row = rows.find(*dof)
        if row >= 0:
            yield row, support.value
        elif support.value != 0.0:
            raise _no_row(case, dof, support, "a displacement, but")


def _no_row(case: DeckCase, dof: Dof, condition: Condition, has: str) -> InputError:
    reason = f"node {dof[0]}, direction {dof[1]} has {has} no row in the matrix"
    return InputError(f"{condition.place}, {case.name}: {reason}", Status.ERR_DOF)
