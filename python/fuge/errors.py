"""Status codes, exceptions and warnings.

A call that cannot do what it is asked for raises :class:`Error`, or one of its subclasses, and changes nothing; a
result that has to be taken with care comes with :class:`Warning`, through Python's module ``warnings``. Both have the
status and the message of the library: what is wrong, where, and how to mend it. Points, rows and degrees of freedom
count from 0 in messages.
"""

from __future__ import annotations

import sys
import warnings
from enum import auto
from pathlib import Path

from fuge._library import Constants, function


class Status(Constants):
    """The result of a call of the library, an ``IntEnum``; doc/errors.md has a line for each."""

    DONE = auto()
    WARN_RESIDUAL = auto()
    WARN_NOT_UNIQUE = auto()
    WARN_ILL_CONDITIONED = auto()
    WARN_PAIRS = auto()
    WARN_NO_CONTACT = auto()
    WARN_CASES = auto()
    WARN_NOT_PROVED = auto()
    WARN_KINK = auto()
    WARN_UNREACHABLE = auto()
    WARN_ACCURACY = auto()
    ERR_SIZE = auto()
    ERR_POINTER = auto()
    ERR_NOT_FINITE = auto()
    ERR_WIDTH = auto()
    ERR_MODULUS = auto()
    ERR_ELEMENT = auto()
    ERR_GRID = auto()
    ERR_NOT_SYMMETRIC = auto()
    ERR_NOT_DEFINITE = auto()
    ERR_NO_EQUILIBRIUM = auto()
    ERR_ITERATION_LIMIT = auto()
    ERR_MEMORY = auto()
    ERR_CALL_ORDER = auto()
    ERR_OPTION = auto()
    ERR_UNSUPPORTED = auto()
    ERR_OVERFLOW = auto()
    ERR_CALLBACK = auto()
    ERR_CANCELLED = auto()
    ERR_FILE = auto()
    ERR_GAP = auto()
    ERR_MODES = auto()
    ERR_DOF = auto()
    ERR_MESH = auto()
    ERR_LAW = auto()

    @property
    def text(self) -> str:
        """General meaning of the status."""
        return str(function("fuge_status_text")(int(self)).decode())


class Error(Exception):
    """A call that failed, and changed nothing.

    Attributes
    ----------
    status : Status
        Which kind of error it is.
    message : str
        What is wrong, where, and how to mend it.
    """

    def __init__(self, message: str, status: Status) -> None:
        super().__init__(message)
        self.status = status
        self.message = message

    def __reduce__(self) -> tuple[type[Error], tuple[str, Status]]:
        return type(self), (self.message, self.status)


class InputError(Error, ValueError):
    """An argument has a value, a shape or a size that is not allowed."""


class MatrixError(InputError):
    """An influence or stiffness matrix is not symmetric, or not positive definite."""


class EquilibriumError(Error):
    """No contact forces can be in equilibrium with the load."""


class LimitError(Error, ArithmeticError):
    """The iteration limit was reached, or numbers are too large or too small for double precision."""


class OutOfMemoryError(Error, MemoryError):
    """There is not enough memory."""


class CallOrderError(Error, RuntimeError):
    """A call came before another one that it requires."""


class UnsupportedError(Error, NotImplementedError):
    """This engine or operator cannot solve this kind of problem."""


class CallbackError(Error, RuntimeError):
    """A function of the caller returned NaN or infinity. An exception in it is raised as it is."""


class CancelledError(Error):
    """The progress function cancelled the solve."""


class FileError(Error, OSError):
    """A file cannot be read or written; the message has the file, the line and the reason."""


class Warning(UserWarning):
    """A result that has to be taken with care.

    Attributes
    ----------
    status : Status
    message : str
    """

    def __init__(self, message: str, status: Status) -> None:
        super().__init__(message)
        self.status = status
        self.message = message

    def __reduce__(self) -> tuple[type[Warning], tuple[str, Status]]:
        return type(self), (self.message, self.status)


class ResidualWarning(Warning):
    """The residual, or an estimated error, is above the tolerance."""


class NotUniqueWarning(Warning):
    """The solution is one of many; the message says whether forces or motions are not unique."""


class IllConditionedWarning(Warning):
    """The equations hold, but the forces may be far off."""


class PairsWarning(Warning):
    """A node is a contact point of two pairs."""


class NoContactWarning(Warning):
    """No point of the bodies is in contact: loads and supports open all gaps."""


class FileWarning(Warning):
    """Something in a file has no effect, or may be meant in another way; the message has the file and the line."""


class CasesWarning(Warning):
    """Some load cases failed or have a warning; the others have their solutions."""


class NotProvedWarning(Warning):
    """Bounds of the error of a solution are infinite, because they cannot be proved; the solution stays as it is."""


class KinkWarning(Warning):
    """Points lie on the border between two states, so the objective has a kink: the gradient is that of one side."""


class UnreachableWarning(Warning):
    """Some points cannot have the pressure wanted; the gaps are those for the nearest one that they can have."""


class AccuracyWarning(Warning):
    """The estimated error is above the wanted one; the message says what was reached, and why no more."""


class GridWarning(Warning):
    """The contact reaches the rim of its grid: unless the bodies end there, the grid is too small.

    Where they do end there, as a roller does, turn it off:
    ``warnings.filterwarnings("ignore", category=fuge.GridWarning)``.
    """


_ERRORS: dict[Status, type[Error]] = {
    Status.ERR_NOT_SYMMETRIC: MatrixError,
    Status.ERR_NOT_DEFINITE: MatrixError,
    Status.ERR_NO_EQUILIBRIUM: EquilibriumError,
    Status.ERR_ITERATION_LIMIT: LimitError,
    Status.ERR_OVERFLOW: LimitError,
    Status.ERR_MEMORY: OutOfMemoryError,
    Status.ERR_CALL_ORDER: CallOrderError,
    Status.ERR_UNSUPPORTED: UnsupportedError,
    Status.ERR_CALLBACK: CallbackError,
    Status.ERR_CANCELLED: CancelledError,
    Status.ERR_FILE: FileError,
}

_WARNINGS: dict[Status, type[Warning]] = {
    Status.WARN_RESIDUAL: ResidualWarning,
    Status.WARN_NOT_UNIQUE: NotUniqueWarning,
    Status.WARN_ILL_CONDITIONED: IllConditionedWarning,
    Status.WARN_PAIRS: PairsWarning,
    Status.WARN_NO_CONTACT: NoContactWarning,
    Status.WARN_CASES: CasesWarning,
    Status.WARN_NOT_PROVED: NotProvedWarning,
    Status.WARN_KINK: KinkWarning,
    Status.WARN_UNREACHABLE: UnreachableWarning,
    Status.WARN_ACCURACY: AccuracyWarning,
}

_PACKAGE = str(Path(__file__).parent)


def _callers_level() -> int:
    """The `stacklevel` of the code outside this package, as seen by the caller of this function."""
    level = 1
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        frame = frame.f_back
        level += 1
    return level


def error(status: Status, message: str) -> Error:
    """The exception for a status."""
    return _ERRORS.get(status, InputError)(message, status)


def finish(code: int, message: str) -> None:
    """Raise or warn as the status of a call demands."""
    if code == 0:
        return
    status = Status(code)
    message = message or status.text
    if code < 0:
        raise error(status, message)
    warn(_WARNINGS[status](message, status))


def warn(warning: Warning) -> None:
    """Warn at the place outside this package that has called it."""
    warnings.warn(warning, stacklevel=_callers_level())
