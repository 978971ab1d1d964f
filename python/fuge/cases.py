"""Load cases of one contact problem, and their envelope."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fuge import _arrays
from fuge._calls import call
from fuge.contact import Info
from fuge.errors import NotProvedWarning, Status, error, finish, warn
from fuge.formats.text import PathLike
from fuge.path import PointState
from fuge.proof import Proof
from fuge.tables import Table

TableKind = Literal["links", "reactions"]

_NAMED = {"links": "link", "reactions": "support"}

_STATES: dict[int, str] = {
    PointState.OPEN: "open",
    PointState.AT_LOWER_STOP: "contact",
    PointState.AT_UPPER_STOP: "upper",
    PointState.LIMITED_LOWER: "limited",
    PointState.LIMITED_UPPER: "limited",
}


@dataclass(frozen=True, eq=False)
class Cases:
    """Solutions of load cases; row k is case k. Rows of cases that failed are NaN, and their points are open.

    Attributes
    ----------
    force : ndarray, shape (cases, n)
        Contact forces.
    gap : ndarray, shape (cases, n)
        Gaps under load; length.
    motion : ndarray, shape (cases, m)
        Rigid motions, free and prescribed.
    state : ndarray of int, shape (cases, n)
        State of each point, a value of :class:`PointState`.
    status : ndarray of int, shape (cases,)
        The :class:`Status` of each solve; negative: it failed.
    info : tuple of Info
        Report of each case, with its certificate.
    message : tuple of str
        What the library remarks on each case, or why it failed; mostly empty.
    displacement : ndarray, shape (cases, degrees), or None
        Displacements of all degrees of freedom, if :meth:`Body.solve_cases` has solved the cases.
    reaction : ndarray, shape (cases, fixed), or None
        Forces of the supports on the body, likewise, in the order of :meth:`Body.fix`.
    names : tuple of str
        Names of the cases.
    links : tuple of str
        Names of the links; empty for points without names.
    supports : tuple of str
        Degrees of freedom of the reactions: node and direction, such as '12.3', where they are known, else the number.
    proof : tuple of Proof or None
        Bounds for each case, None for one that failed, if they were asked for by ``prove=True``; else empty.
    """

    force: NDArray[np.float64]
    gap: NDArray[np.float64]
    motion: NDArray[np.float64]
    state: NDArray[np.intc]
    status: NDArray[np.intc]
    info: tuple[Info, ...]
    message: tuple[str, ...]
    displacement: NDArray[np.float64] | None = None
    reaction: NDArray[np.float64] | None = None
    names: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    supports: tuple[str, ...] = ()
    proof: tuple[Proof | None, ...] = ()

    def __len__(self) -> int:
        """Number of cases."""
        return self.status.size

    def __repr__(self) -> str:
        failed = int(np.count_nonzero(self.status < 0))
        what = "links" if self.links else "points"
        return f"<Cases: {len(self)} load cases of {self.force.shape[1]} {what}, {failed} failed>"

    def table(self, kind: TableKind = "links") -> Table:
        """A row for each case and link, or for each case and support; ``pandas.DataFrame(cases.table())`` takes it.

        Parameters
        ----------
        kind : {'links', 'reactions'}

        Returns
        -------
        Table
            The columns case, link, force, gap and state ('contact', 'open', 'upper' for a second stop, 'limited',
            'failed'), and force_bound and gap_bound if the cases are proved; or case, support and reaction.
        """
        names, values = self._columns(kind)
        columns: dict[str, NDArray[Any]] = {
            "case": np.repeat(np.array(self.names, dtype=object), len(names)),
            _NAMED[kind]: np.tile(np.array(names, dtype=object), len(self)),
            **{name: value.reshape(-1) for name, value in values.items()},
        }
        if kind == "links":
            states = np.array([_STATES[k] for k in self.state.reshape(-1).tolist()], dtype=object)
            columns["state"] = np.where(np.repeat(self.status < 0, len(names)), "failed", states)
            for name in ("force_bound", "gap_bound") if self.proof else ():
                bounds = [getattr(proof, name, np.full(len(names), np.nan)).reshape(-1) for proof in self.proof]
                columns[name] = np.concatenate(bounds)
        return Table(columns)

    def envelope_table(self, kind: TableKind = "links") -> Table:
        """A row for each link, or for each support, with the smallest and the largest value and their cases.

        Parameters
        ----------
        kind : {'links', 'reactions'}

        Returns
        -------
        Table
            The columns link, smallest_force, smallest_force_case, largest_force, largest_force_case and the same for
            the gap; or support, smallest_reaction and so on. No case has a value: NaN, and no name.
        """
        names, values = self._columns(kind)
        columns = {_NAMED[kind]: np.array(names, dtype=object)}
        called = np.array([*self.names, ""], dtype=object)
        for name, value in values.items():
            found = envelope(value)
            for end in ("smallest", "largest"):
                columns[f"{end}_{name}"] = getattr(found, end)
                columns[f"{end}_{name}_case"] = called[getattr(found, f"{end}_case")]
        return Table(columns)

    def write(self, path: PathLike, kind: TableKind = "links") -> None:
        """Write the table as comma-separated values; see :meth:`table` and :meth:`Table.write`."""
        self.table(kind).write(path)

    def _columns(self, kind: str) -> tuple[Sequence[str], dict[str, NDArray[np.float64]]]:
        """Names of the links or supports, and their values, (cases, names)."""
        if kind not in _NAMED:
            raise error(Status.ERR_OPTION, f"kind is {kind!r}, but must be one of 'links', 'reactions'")
        if kind == "links":
            values = {name: getattr(self, name).reshape(len(self), -1) for name in ("force", "gap")}
            return self.links or [f"point {k}" for k in range(values["force"].shape[1])], values
        if self.reaction is None:
            raise error(Status.ERR_CALL_ORDER, "only the cases of Body.solve_cases have reactions")
        return self.supports, {"reaction": self.reaction}


@dataclass(frozen=True, eq=False)
class Envelope:
    """The smallest and the largest value of each column over all cases.

    Attributes
    ----------
    smallest, largest : ndarray, shape (n,)
        NaN where all values are NaN.
    smallest_case, largest_case : ndarray of int, shape (n,)
        The first case that has the value; -1 where all values are NaN.
    """

    smallest: NDArray[np.float64]
    largest: NDArray[np.float64]
    smallest_case: NDArray[np.intc]
    largest_case: NDArray[np.intc]

    def __repr__(self) -> str:
        if np.isnan(self.smallest).all():
            return f"<Envelope: {self.smallest.size} columns without values>"
        return (
            f"<Envelope: {self.smallest.size} columns, {np.nanmin(self.smallest):.6g} to {np.nanmax(self.largest):.6g}>"
        )


def checked_names(names: Sequence[str], number: int) -> tuple[str, ...]:
    """As many names as there are load cases or supports."""
    if isinstance(names, str) or len(names) != number:
        raise error(Status.ERR_SIZE, f"names must have {number} elements, but is {names!r:.60}")
    return tuple(map(str, names))


def reported(cases: Cases, k: int, status: Status, message: str) -> Cases:
    """The cases with another report of case k."""
    cases.status[k] = status
    infos, messages = list(cases.info), list(cases.message)
    infos[k], messages[k] = replace(infos[k], status=status), message
    return replace(cases, info=tuple(infos), message=tuple(messages))


def warn_of_cases(cases: Cases) -> None:
    """Warn if a case failed or has a warning, with the message of the first one, and if bounds are infinite."""
    failed, warned = cases.status < 0, cases.status > 0
    if np.any(failed | warned):
        first = int(np.flatnonzero(failed if failed.any() else warned)[0])
        counts = f"{failed.sum()} of {len(cases)} load cases failed, {warned.sum()} have a warning"
        finish(Status.WARN_CASES, f"{counts}; {cases.names[first]}: {cases.message[first]}")
    unknown = [k for k, proof in enumerate(cases.proof) if proof is not None and not proof.bounded]
    if unknown:
        counts = f"the bounds of {len(unknown)} of {len(cases)} load cases are infinite"
        message = cases.proof[unknown[0]].message  # type: ignore[union-attr]
        warn(NotProvedWarning(f"{counts}; {cases.names[unknown[0]]}: {message}", Status.WARN_NOT_PROVED))


def envelope(values: ArrayLike) -> Envelope:
    """The envelope of load cases, as of the forces in :class:`Cases` or of displacements.

    Parameters
    ----------
    values : array_like, shape (cases, n)
        Row k is case k. NaN, as in cases that failed, does not count.

    Returns
    -------
    Envelope

    Raises
    ------
    InputError
        There is no case.
    """
    rows = _arrays.doubles("values", values, (None, None))
    cases, n = rows.shape
    smallest, largest = np.empty(n), np.empty(n)
    smallest_case, largest_case = np.empty(n, dtype=np.intc), np.empty(n, dtype=np.intc)
    call("fuge_find_envelope", n, cases, rows, smallest, largest, smallest_case, largest_case)
    return Envelope(smallest, largest, smallest_case, largest_case)
