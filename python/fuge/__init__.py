"""fuge: frictionless elastic contact, exactly and with a certificate.

    >>> import fuge
    >>> contact = fuge.solve([[0.2, 0.1], [0.1, 0.2]], gap=[0.0, 1.0], load=2.0)
    >>> contact.force, contact.gap, contact.approach
    (array([2., 0.]), array([0. , 0.8]), 0.4)

Units are yours, as long as they are consistent; points count from 0. Errors are exceptions (:class:`Error`), warnings
those of Python (:class:`Warning`). The interpreter lock is released during calls, so that threads run side by side.
"""

from fuge import _library
from fuge.bodies import BodiesContact, ElasticBodies, JoinedBodies
from fuge.body import Body, Condensed, rigid_modes
from fuge.columns import CompressedColumns
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
from fuge.files import (
    StiffnessFile,
    SurfaceHeights,
    level_profile,
    level_surface,
    read_matrix,
    read_profile,
    read_sparse,
    read_stiffness,
    read_surface,
    sample_profile,
    write_fields,
    write_matrix,
    write_sparse,
    write_surface,
    write_volume,
)
from fuge.halfplane import (
    ContactEdges,
    EdgeKind,
    combined_modulus,
    contact_edges,
    displacement_shares,
    graded_cells,
    halfplane_matrix,
    plane_modulus,
)
from fuge.halfspace import HertzContact, halfspace_matrix, hertz_ellipse, ring_displacement, ring_matrix
from fuge.mesh import Mesh, join_meshes, read_mesh
from fuge.operators import CallbackOperator, DenseOperator, HalfplaneOperator, HalfspaceOperator, Operator
from fuge.pairs import ContactPairs, Surface
from fuge.path import Path, PointState, load_path
from fuge.smooth import RoundContact, SmoothContact, solve_round_powers, solve_round_punch, solve_smooth_punch
from fuge.solver import Contact, Derivative, History, Info, Solver, solve
from fuge.stress import (
    halfplane_displacement,
    halfplane_stress,
    halfspace_displacement,
    halfspace_stress,
    ring_interior_displacement,
    ring_stress,
)
from fuge.stress_grid import (
    halfplane_displacement_grid,
    halfplane_stress_grid,
    halfspace_displacement_grid,
    halfspace_stress_grid,
)
from fuge.stress_measures import halfplane_tensor, mean_stress, principal_stresses, round_tensor, tresca, von_mises
from fuge.stress_peak import StressPeak, halfplane_peak, halfspace_peak, ring_peak

__version__ = _library.version()

__all__ = [
    "BodiesContact",
    "Body",
    "CallOrderError",
    "CallbackError",
    "CallbackOperator",
    "CancelledError",
    "CompressedColumns",
    "Condensed",
    "Contact",
    "ContactEdges",
    "ContactPairs",
    "DenseOperator",
    "Derivative",
    "EdgeKind",
    "ElasticBodies",
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
    "JoinedBodies",
    "LimitError",
    "MatrixError",
    "Mesh",
    "NotUniqueWarning",
    "Operator",
    "OutOfMemoryError",
    "PairsWarning",
    "Path",
    "PointState",
    "ResidualWarning",
    "RoundContact",
    "SmoothContact",
    "Solver",
    "Status",
    "StiffnessFile",
    "StressPeak",
    "Surface",
    "SurfaceHeights",
    "UnsupportedError",
    "Warning",
    "combined_modulus",
    "contact_edges",
    "displacement_shares",
    "graded_cells",
    "halfplane_displacement",
    "halfplane_displacement_grid",
    "halfplane_matrix",
    "halfplane_peak",
    "halfplane_stress",
    "halfplane_stress_grid",
    "halfplane_tensor",
    "halfspace_displacement",
    "halfspace_displacement_grid",
    "halfspace_matrix",
    "halfspace_peak",
    "halfspace_stress",
    "halfspace_stress_grid",
    "hertz_ellipse",
    "join_meshes",
    "level_profile",
    "level_surface",
    "load_path",
    "mean_stress",
    "plane_modulus",
    "principal_stresses",
    "read_matrix",
    "read_mesh",
    "read_profile",
    "read_sparse",
    "read_stiffness",
    "read_surface",
    "rigid_modes",
    "ring_displacement",
    "ring_interior_displacement",
    "ring_matrix",
    "ring_peak",
    "ring_stress",
    "round_tensor",
    "sample_profile",
    "solve",
    "solve_round_powers",
    "solve_round_punch",
    "solve_smooth_punch",
    "tresca",
    "von_mises",
    "write_fields",
    "write_matrix",
    "write_sparse",
    "write_surface",
    "write_volume",
]
