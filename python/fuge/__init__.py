"""fuge: frictionless elastic contact, exactly and with a certificate.

    >>> import fuge
    >>> contact = fuge.solve([[0.2, 0.1], [0.1, 0.2]], gap=[0.0, 1.0], load=2.0)
    >>> contact.force, contact.gap, contact.approach
    (array([2., 0.]), array([0. , 0.8]), 0.4)

Units are yours, as long as they are consistent; points count from 0. Errors are exceptions (:class:`Error`), warnings
those of Python (:class:`Warning`). The interpreter lock is released during calls, so that threads run side by side.
"""

from fuge import _library
from fuge.errors import (
    CallbackError,
    CallOrderError,
    CancelledError,
    EquilibriumError,
    Error,
    FileError,
    IllConditionedWarning,
    InputError,
    LimitError,
    MatrixError,
    NotUniqueWarning,
    OutOfMemoryError,
    PairsWarning,
    ResidualWarning,
    Status,
    UnsupportedError,
    Warning,
)
from fuge.halfplane import (
    ContactEdges,
    EdgeKind,
    combined_modulus,
    contact_edges,
    displacement_shares,
    halfplane_matrix,
    plane_modulus,
)
from fuge.halfspace import HertzContact, halfspace_matrix, hertz_ellipse, ring_displacement, ring_matrix
from fuge.operators import CallbackOperator, DenseOperator, HalfplaneOperator, HalfspaceOperator, Operator
from fuge.path import Path, PointState, load_path
from fuge.solver import Contact, Derivative, History, Info, Solver, solve

__version__ = _library.version()

__all__ = [
    "CallOrderError",
    "CallbackError",
    "CallbackOperator",
    "CancelledError",
    "Contact",
    "ContactEdges",
    "DenseOperator",
    "Derivative",
    "EdgeKind",
    "EquilibriumError",
    "Error",
    "FileError",
    "HalfplaneOperator",
    "HalfspaceOperator",
    "HertzContact",
    "History",
    "IllConditionedWarning",
    "Info",
    "InputError",
    "LimitError",
    "MatrixError",
    "NotUniqueWarning",
    "Operator",
    "OutOfMemoryError",
    "PairsWarning",
    "Path",
    "PointState",
    "ResidualWarning",
    "Solver",
    "Status",
    "UnsupportedError",
    "Warning",
    "combined_modulus",
    "contact_edges",
    "displacement_shares",
    "halfplane_matrix",
    "halfspace_matrix",
    "hertz_ellipse",
    "load_path",
    "plane_modulus",
    "ring_displacement",
    "ring_matrix",
    "solve",
]
