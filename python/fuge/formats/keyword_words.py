"""Keywords of Abaqus and CalculiX that a deck with gaps may have, and what they may say of themselves.

A keyword that is not known here to be harmless for a linear static problem could change the answer, and is refused.
"""

from __future__ import annotations

from fuge.errors import FileError
from fuge.formats.keyword import Block, complete, squeezed

# Nodes, elements and sets are read with the mesh.
_READ = "BOUNDARY CLOAD ELEMENT ELSET ENDSTEP GAP NODE NSET STEP SURFACE"

# Linear materials, sections, constraints and springs are in the stiffness matrix; masses and dampers have no effect.
_MODEL = """
    AMPLITUDE BEAMGENERALSECTION BEAMSECTION CENTROID CONDUCTIVITY COUPLING DAMPING DASHPOT DENSITY DISTRIBUTING
    DISTRIBUTINGCOUPLING DISTRIBUTION DISTRIBUTIONTABLE ELASTIC EMBEDDEDELEMENT EQUATION EXPANSION FAILSTRAIN
    FAILSTRESS GLOBALDAMPING HEADING HOURGLASSSTIFFNESS INITIALCONDITIONS KINEMATIC KINEMATICCOUPLING MASS MATERIAL
    MEMBRANESECTION MODALDAMPING MPC NODALTHICKNESS NONSTRUCTURALMASS NORMAL ORIENTATION PHYSICALCONSTANTS RELEASE
    RIGIDBODY ROTARYINERTIA SECTIONCONTROLS SECTIONORIGIN SHEARCENTER SHELLGENERALSECTION SHELLSECTION
    SHELLTOSOLIDCOUPLING SOLIDSECTION SPECIFICHEAT SPRING TIE TRANSVERSESHEAR TRANSVERSESHEARSTIFFNESS UNITSYSTEM
"""

_OUTPUT_AND_SOLVER = """
    CONTACTFILE CONTACTOUTPUT CONTACTPRINT CONTROLS DIAGNOSTICS ELEMENTOUTPUT ELFILE ELPRINT ENERGYFILE ENERGYOUTPUT
    ENERGYPRINT FILEFORMAT FILEOUTPUT FILTER INCREMENTATIONOUTPUT INTEGRATEDOUTPUT INTEGRATEDOUTPUTSECTION MODALFILE
    MODALOUTPUT MODALPRINT MONITOR NODEFILE NODEOUTPUT NODEPRINT OUTPUT POSTOUTPUT PREPRINT PRINT RESTART SECTIONFILE
    SECTIONPRINT SOLVERCONTROLS SURFACEOUTPUT TIMEPOINTS USEROUTPUTVARIABLES WAVEFRONTMINIMIZATION
"""

# Steps of these procedures are load cases.
STATIC = frozenset(["STATIC", "VISCO"])

# Linear perturbations hand nothing on to later steps.
PERTURBATIONS = frozenset(
    """
    BUCKLE COMPLEXFREQUENCY FREQUENCY GREEN MATRIXGENERATE MODALDYNAMIC RANDOMRESPONSE RESPONSESPECTRUM
    STEADYSTATEDYNAMICS SUBSTRUCTUREGENERATE
    """.split()
)

_OTHER_PROCEDURES = """
    ANNEAL CFD COUPLEDTHERMAL-ELECTRICAL CRACKPROPAGATION DIRECTCYCLIC DYNAMIC DYNAMICTEMPERATURE-DISPLACEMENT
    ELECTROMAGNETIC ELECTROMAGNETICS FEASIBLEDIRECTION HEATTRANSFER MASSDIFFUSION NOANALYSIS ROBUSTDESIGN SENSITIVITY
    STEADYSTATETRANSPORT
"""

PROCEDURES = STATIC | PERTURBATIONS | frozenset(_OTHER_PROCEDURES.split())

_ALLOWED = PROCEDURES | frozenset((_READ + _MODEL + _OUTPUT_AND_SOLVER).split())

# Why keywords that many decks have are refused.
_REASONS = {
    "is not read here: of contact the gap elements are, and each *STEP is a load case": """
        CHANGEFRICTION CLEARANCE CONTACT CONTACTINCLUSIONS CONTACTINTERFERENCE CONTACTPAIR LOADCASE MODELCHANGE
        RIGIDSURFACE SLIDELINE SURFACEBEHAVIOR SURFACEINTERACTION
    """,
    "is not read: give its forces at nodes by *CLOAD": """
        BASEMOTION CFLUX DFLUX DLOAD DSLOAD FIELD FILM INERTIARELIEF RADIATE SLOAD SWELLING TEMPERATURE
    """,
    "is not read here: give struts and cables as GAPUNI with a stiffness, or in a table of links": """
        CONNECTORLOCK CONNECTORSTOP NOCOMPRESSION NOTENSION
    """,
    "is not read here: the structure is linear but for its links": """
        CREEP HYPERELASTIC HYPERFOAM IMPERFECTION PLASTIC USERMATERIAL VISCOELASTIC
    """,
    "is not read: gaps with friction are not, fuge has no friction": "FRICTION",
    "is not read here: directions are x, y and z": "TRANSFORM",
}

# Parameters that are read, or change nothing, of keywords whose other ones could change the answer.
_PARAMETERS = {
    "BOUNDARY": "OP TYPE",
    "CLOAD": "OP",
    "ELASTIC": "DEPENDENCIES MODULI TYPE",
    "GAP": "ELSET",
    "INITIALCONDITIONS": "TYPE",
    "MATERIAL": "NAME RTOL",
    "MPC": "",
    "RESTART": "FREQUENCY NUMBERINTERVAL OVERLAY TIMEMARKS WRITE",
    "SHELLGENERALSECTION": """
        COMPOSITE CONTROLS DENSITY DEPENDENCIES ELSET LAYUP MATERIAL NODALTHICKNESS OFFSET ORIENTATION POISSON
        STACKDIRECTION SYMMETRIC THICKNESSMODULUS ZERO
    """,
    "SPRING": "COMPLEXSTIFFNESS DEPENDENCIES ELSET ORIENTATION RTOL",
    "STATIC": "DIRECT EXPLICIT SOLVER TIMERESET TOTALTIMEATSTART",
    "STEP": "AMPLITUDE CONVERTSDI EXTRAPOLATION INC NAME NLGEOM PERTURBATION SOLVER UNSYMM",
    "TIE": "ADJUST NAME NOROTATION POSITIONTOLERANCE TYPE",
    "VISCO": "CETOL DIRECT",
}

# Values of parameters that may only have these.
_VALUES = {
    ("BOUNDARY", "OP"): ("MOD", "NEW"),
    ("BOUNDARY", "TYPE"): ("DISPLACEMENT",),
    ("CLOAD", "OP"): ("MOD", "NEW"),
    ("INITIALCONDITIONS", "TYPE"): ("FIELD", "TEMPERATURE", "VELOCITY"),
    ("STEP", "NLGEOM"): ("NO", "YES"),
}

# What to do instead of a parameter that is not read.
_REMEDIES = {
    "BOUNDARY": ": write the values at the end of the step",
    "CLOAD": ": write the values at the end of the step",
    "INITIALCONDITIONS": ": give the forces of initial stresses at nodes by *CLOAD",
    "SPRING": ": give one-way springs as GAPUNI with a stiffness, or in a table of links",
}


def check_keyword(block: Block) -> None:
    """Refuse a keyword that is not known to be harmless.

    Raises
    ------
    FileError
    """
    if block.keyword in _ALLOWED:
        return
    unknown = "is not read, and could change the answer: leave it out if it does not"
    reason = next((text for text, words in _REASONS.items() if block.keyword in words.split()), unknown)
    raise block.refuse(f"*{block.keyword} {reason}" if block.keyword else "data stand before the first keyword")


def parameters_of(block: Block) -> dict[str, str]:
    """The parameters of a keyword, their names written out, and their values where only some words are allowed.

    Raises
    ------
    FileError
        A parameter or its value is not known to be harmless.
    """
    names = _PARAMETERS.get(block.keyword)
    if names is None:
        return block.parameters
    remedy = _REMEDIES.get(block.keyword, "")
    try:
        found = block.named(names.split())
    except FileError as refused:
        raise FileError(refused.message + remedy, refused.status) from None
    for name, value in found.items():
        values = _VALUES.get((block.keyword, name), ())
        if values and value:
            word = complete(squeezed(value), values)
            if word is None:
                raise block.refuse(f"*{block.keyword}: {name}={squeezed(value)} is not read{remedy}")
            found[name] = word
    return found
