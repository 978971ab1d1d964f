"""What a run says and gives: steps on standard error, warnings, and results for tables and pictures."""

from __future__ import annotations

import sys
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

from fuge.command.errors import counted_from_one
from fuge.command.tables import Table, number_text
from fuge.errors import Status, Warning


class Log:
    """Steps, warnings and notes on standard error.

    Steps have lines of their own with --verbose; otherwise the last one shows on a terminal, by rich where that is
    installed, and nowhere else.
    """

    def __init__(self, verbose: bool) -> None:
        self._verbose = verbose
        self._begin = time.monotonic()
        self._display: Any = None if verbose else _terminal_display()
        self.warned = False

    def __enter__(self) -> Log:
        if self._display is not None:
            self._display.start()
        return self

    def __exit__(self, *_: object) -> None:
        if self._display is not None:
            self._display.stop()

    @property
    def progress(self) -> Callable[[int, float, int], None] | None:
        """A function for ``progress`` of solvers, where somebody looks on."""
        return None if self._display is None else self._iterated

    def say(self, step: str) -> None:
        """A step that is done."""
        if self._verbose:
            print_error(f"fuge:{time.monotonic() - self._begin:9.2f} s  {step}")
        elif self._display is not None:
            self._display.update(step)

    def warn(self, message: str) -> None:
        """A result that has to be taken with care."""
        self.warned = True
        print_error(f"fuge: warning: {message}")

    def note(self, message: str) -> None:
        """A remark that is no warning."""
        print_error(f"fuge: note: {message}")

    def _iterated(self, iteration: int, residual: float, contacts: int) -> None:
        self._display.update(f"iteration {iteration}, {contacts} points in contact, residual {residual:.1e}")


def print_error(line: str) -> None:
    """Print a line on standard error, if there is one."""
    with suppress(OSError, ValueError):
        print(line, file=sys.stderr, flush=True)


def _terminal_display() -> Any:
    """A line of rich on a terminal, or None."""
    with suppress(ImportError, AttributeError):
        if sys.stderr.isatty():
            return import_module("rich.console").Console(stderr=True, markup=False).status("fuge")
    return None


@dataclass
class Report:
    """What is said of a solution: the first warning, remarks without one, and the residual."""

    log: Log
    status: Status = Status.DONE
    message: str = ""
    residual: float = 0.0
    notes: list[str] = field(default_factory=list)

    def take(self, status: Status, message: str) -> None:
        """A status of the library, from 0, with its message: a warning, or a remark, once."""
        text = counted_from_one(message)
        if status > 0:
            self.log.warn(text)
            if self.status == Status.DONE:
                self.status, self.message = status, text
        elif text and text not in self.notes:
            self.log.note(text)
            self.notes.append(text)

    def take_all(self, warned: list[Warning]) -> None:
        """Warnings of the package."""
        for warning in warned:
            self.take(warning.status, warning.message)

    def comments(self, contacts: int | None = None) -> list[str]:
        """Status, message, residual and number of contacts for the head of a table."""
        remarks = "; ".join(self.notes)
        return outcome_comments(self.status, self.message or remarks, self.residual, contacts)


def outcome_comments(status: Status, message: str, residual: float, contacts: int | None = None) -> list[str]:
    """Status, message, which may be a remark without a warning, residual and number of contacts of a solution."""
    lines = [f"status: {int(status)}, {status.text}"]
    if status != Status.DONE or message:
        lines.append(f"message: {message}")
    lines.append(f"residual: {number_text(residual, 2, 9)}")
    return lines if contacts is None else [*lines, f"contacts: {contacts}"]


@contextmanager
def caught() -> Iterator[list[Warning]]:
    """A list that gets the warnings of the package, which are not shown."""
    found: list[Warning] = []
    with warnings.catch_warnings(record=True) as records:
        warnings.simplefilter("ignore")
        warnings.simplefilter("always", Warning)
        yield found
    found += [record.message for record in records if isinstance(record.message, Warning)]


@dataclass
class Outcome:
    """The results of a run.

    `write_field` and `draw` get the path of --field, and axes of matplotlib; without `draw` the forces of the table are
    drawn. `failure` tells of load cases without a solution.
    """

    table: Table
    write_field: Callable[[str], None] | None = None
    draw: Callable[[Any], None] | None = None
    reactions: Table | None = None
    failure: str = ""
