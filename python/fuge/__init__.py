"""fuge: frictionless elastic contact, exactly and with a certificate.

    >>> import fuge
    >>> contact = fuge.solve([[0.2, 0.1], [0.1, 0.2]], gap=[0.0, 1.0], load=2.0)
    >>> contact.force, contact.gap, contact.approach
    (array([2., 0.]), array([0. , 0.8]), 0.4)

Units are yours, as long as they are consistent; points count from 0. Errors are exceptions (:class:`Error`), warnings
those of Python (:class:`Warning`). The interpreter lock is released during calls, so that threads run side by side.
What follows is a map; ``help(fuge.solve)`` and the like have parameters, shapes and units.

How the bodies deform: an operator, whose ``operator @ force`` are displacements::

    a matrix, displacement per force        used as it is, or DenseOperator(alpha)
    HalfplaneOperator(n, spacing, e_star)   line contact, equal cells, by FFT
    HalfspaceOperator(nx, ny, dx, dy, e_star)   an area, equal cells, by FFT
    LayeredHalfplaneOperator, LayeredHalfspaceOperator   the same for coated and layered bodies: Layers
    graded_layers                           moduli that vary over the depth: GradedLayers
    coating_limits                          how thin a coating is not felt, how thick it hides the rest: CoatingLimits
    CallbackOperator(n, apply)              a function of your own
    Operator, GridOperator, Cells           the base of all, that of those by FFT, and their cells
    halfplane_matrix, halfspace_matrix, ring_matrix   matrices of cells, rectangles, and rings about an axis
    graded_cells                            cells that are narrow at the edges of a contact
    plane_modulus, combined_modulus         the modulus e_star of two bodies
    displacement_shares, ring_displacement  shares of the bodies in the displacements; the surface beside rings

Solving: gaps and a load, a prescribed approach, or several rigid motions::

    solve(operator, gap, load)              one problem; the result is a Contact with its Info
    Solver(operator)                        one solve after the other; a Derivative, and the History of the tableau
    Solver.prove, solve(prove=True)         bounds of the error of each number: a Proof
    Solver.vjp, Contact.vjp                 the gradient of an objective over all data: Gradients
    Solver.gap_for_pressure                 gaps for a wanted pressure: a WantedContact
    envelope(values)                        the Envelope of load cases, which Solver and Body solve: Cases
    load_path(alpha, gap, load)             all loads at which a point changes its PointState: a Path
    contact_edges(x, width, force, element) edges finer than the grid: ContactEdges, each of an EdgeKind
    hertz_ellipse                           Hertz in closed form: HertzContact
    solve_line, solve_area                  to a wanted error, from a gap as a function: a ResolvedContact with its
                                            Level of each solve; numbers with an error are an Estimate
    solve_lcp(M, q), solve_qp(P, q, G, h, A, b)   problems without a contact: LcpSolution, QpSolution
    solve_smooth_punch                      one interval under a smooth profile, without a grid: SmoothContact
    solve_round_punch, solve_round_powers   the same for punches of revolution: RoundContact; both are a PunchContact

Bodies of finite elements::

    Body(stiffness).condense()              one body condensed to its contact points: Condensed
    Links                                   supports that lift off, gaps, cables and struts of a structure
    Cases.table, Cases.envelope_table       results of load cases with names: a Table
    remove_member                           a stiffness matrix without a member, whose place a link takes
    ElasticBodies().solve()                 several bodies in one call: BodiesContact; join gives JoinedBodies
    ContactPairs, Surface                   contact points of two surfaces whose meshes need not match
    Mesh, read_mesh, join_meshes            meshes, and their pictures for ParaView
    Deck, read_deck                         one-way links and load cases from decks
    rigid_modes                             rigid motions of nodes
    CompressedColumns                       sparse matrices by their arrays

Surfaces, profiles and matrices in files::

    read_surface(path), fill_surface, level_surface, write_surface   measured heights: SurfaceHeights
    read_profile, sample_profile, level_profile
    read_stiffness(path)                    of CalculiX, Abaqus, Nastran or Matrix Market: StiffnessFile
    read_matrix, write_matrix, read_sparse, write_sparse   Matrix Market
    write_results, write_volume              pressures, gaps and stresses on grids for ParaView

Stresses and displacements in the bodies::

    contact.field(young=, poisson=)         the Field of a contact; contact.field() with layers
    Field.halfplane, Field.halfspace, Field.rings            of cells and forces
    Field.halfplane_grid, Field.halfspace_grid
    Field.stress, Field.displacement        at points
    Field.grid_stress, Field.grid_displacement               below the cells of a grid, at depths, by FFT
    Field.largest                           the largest stress: StressPeak
    Field.interfaces                        what cracks coatings: InterfaceStress
    von_mises, tresca, mean_stress, principal_stresses       of tensors

Pictures by matplotlib, one call each on what a solve returns::

    plot.map, plot.line, plot.gap, plot.stress, plot.path, plot.levels

What can go wrong: each error and warning has a Status and a message that says how to mend it::

    Error: InputError, MatrixError, EquilibriumError, LimitError, UnsupportedError, CallOrderError, FileError,
        OutOfMemoryError, CallbackError, CancelledError
    Warning: ResidualWarning, NotUniqueWarning, IllConditionedWarning, GridWarning, PairsWarning,
        NoContactWarning, FileWarning, CasesWarning, NotProvedWarning, KinkWarning, UnreachableWarning,
        AccuracyWarning
"""

# "as" exports a name, as __all__ would; but with that help(fuge) would have the whole text of each.
from fuge import _library, plot as plot
from fuge.accuracy import (
    Estimate as Estimate,
    Level as Level,
    ResolvedContact as ResolvedContact,
    solve_area as solve_area,
    solve_line as solve_line,
)
from fuge.bodies import BodiesContact as BodiesContact, ElasticBodies as ElasticBodies, JoinedBodies as JoinedBodies
from fuge.body import Body as Body, Condensed as Condensed, rigid_modes as rigid_modes
from fuge.cases import Cases as Cases, Envelope as Envelope, envelope as envelope
from fuge.cells import Cells as Cells
from fuge.columns import CompressedColumns as CompressedColumns
from fuge.contact import Contact as Contact, Derivative as Derivative, History as History, Info as Info
from fuge.deck import Deck as Deck
from fuge.design import Gradients as Gradients, WantedContact as WantedContact
from fuge.errors import (
    AccuracyWarning as AccuracyWarning,
    CallbackError as CallbackError,
    CallOrderError as CallOrderError,
    CancelledError as CancelledError,
    CasesWarning as CasesWarning,
    EquilibriumError as EquilibriumError,
    Error as Error,
    FileError as FileError,
    FileWarning as FileWarning,
    GridWarning as GridWarning,
    IllConditionedWarning as IllConditionedWarning,
    InputError as InputError,
    KinkWarning as KinkWarning,
    LimitError as LimitError,
    MatrixError as MatrixError,
    NoContactWarning as NoContactWarning,
    NotProvedWarning as NotProvedWarning,
    NotUniqueWarning as NotUniqueWarning,
    OutOfMemoryError as OutOfMemoryError,
    PairsWarning as PairsWarning,
    ResidualWarning as ResidualWarning,
    Status as Status,
    UnreachableWarning as UnreachableWarning,
    UnsupportedError as UnsupportedError,
    Warning as Warning,
)
from fuge.field import Field as Field, InterfaceStress as InterfaceStress, StressPeak as StressPeak
from fuge.formats.decks import read_deck as read_deck
from fuge.formats.matrix_market import (
    read_matrix as read_matrix,
    read_sparse as read_sparse,
    write_matrix as write_matrix,
    write_sparse as write_sparse,
)
from fuge.formats.mesh_input import read_mesh as read_mesh
from fuge.formats.profiles import read_profile as read_profile
from fuge.formats.stiffness import read_stiffness as read_stiffness
from fuge.formats.surfaces import (
    SurfaceHeights as SurfaceHeights,
    read_surface as read_surface,
    write_surface as write_surface,
)
from fuge.halfplane import (
    ContactEdges as ContactEdges,
    EdgeKind as EdgeKind,
    combined_modulus as combined_modulus,
    contact_edges as contact_edges,
    displacement_shares as displacement_shares,
    graded_cells as graded_cells,
    halfplane_matrix as halfplane_matrix,
    plane_modulus as plane_modulus,
)
from fuge.halfspace import (
    HertzContact as HertzContact,
    halfspace_matrix as halfspace_matrix,
    hertz_ellipse as hertz_ellipse,
    ring_displacement as ring_displacement,
    ring_matrix as ring_matrix,
)
from fuge.heights import (
    fill_surface as fill_surface,
    level_profile as level_profile,
    level_surface as level_surface,
    sample_profile as sample_profile,
)
from fuge.layered_operators import (
    LayeredHalfplaneOperator as LayeredHalfplaneOperator,
    LayeredHalfspaceOperator as LayeredHalfspaceOperator,
)
from fuge.layers import (
    CoatingLimits as CoatingLimits,
    GradedLayers as GradedLayers,
    Layers as Layers,
    coating_limits as coating_limits,
    graded_layers as graded_layers,
)
from fuge.links import Links as Links, remove_member as remove_member
from fuge.mesh import Mesh as Mesh, join_meshes as join_meshes
from fuge.operators import (
    CallbackOperator as CallbackOperator,
    DenseOperator as DenseOperator,
    GridOperator as GridOperator,
    HalfplaneOperator as HalfplaneOperator,
    HalfspaceOperator as HalfspaceOperator,
    Operator as Operator,
)
from fuge.pairs import ContactPairs as ContactPairs, Surface as Surface
from fuge.path import Path as Path, PointState as PointState, load_path as load_path
from fuge.programs import (
    LcpSolution as LcpSolution,
    QpSolution as QpSolution,
    solve_lcp as solve_lcp,
    solve_qp as solve_qp,
)
from fuge.proof import Proof as Proof
from fuge.results import write_results as write_results, write_volume as write_volume
from fuge.smooth import (
    PunchContact as PunchContact,
    RoundContact as RoundContact,
    SmoothContact as SmoothContact,
    solve_round_powers as solve_round_powers,
    solve_round_punch as solve_round_punch,
    solve_smooth_punch as solve_smooth_punch,
)
from fuge.solver import Solver as Solver, solve as solve
from fuge.stiffness_rows import StiffnessFile as StiffnessFile
from fuge.stress_measures import (
    mean_stress as mean_stress,
    principal_stresses as principal_stresses,
    tresca as tresca,
    von_mises as von_mises,
)
from fuge.tables import Table as Table

__version__ = _library.version()
