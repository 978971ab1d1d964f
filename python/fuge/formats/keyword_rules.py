"""What decks of Abaqus and CalculiX may have beside the gaps, supports and loads that are read.

What is not known here to be harmless for a linear static problem could change the answer, and is refused.
"""

from __future__ import annotations

import re

from fuge.errors import FileError
from fuge.formats import keyword_names as names
from fuge.formats.keyword import Block, complete, split_items, squeezed
from fuge.formats.text import quoted

GAP_TYPES = ("GAPUNI", "GAPCYL", "GAPSPHER")

_READ = "BOUNDARY CLOAD ENDSTEP GAP STEP".split()
_ALLOWED = {*names.MESH, *names.PROCEDURES, *names.MODEL, *names.OUTPUT_AND_SOLVER, *_READ}

_UNKNOWN = "is not read, and could change the answer: leave it out if it does not"
_UNREAD_LOAD = "is not read: give its forces at nodes by *CLOAD"
_STRUTS = "give struts and cables as GAPUNI with a stiffness, or in a table of links"

_UNREAD_LOADS = "BASEMOTION CFLUX DFLUX DLOAD DSLOAD FIELD FILM INERTIARELIEF RADIATE SLOAD SWELLING TEMPERATURE"

# Why keywords of the model that many decks have are refused.
_REASONS = {
    "is not read here: of contact the gap elements are, and each *STEP is a load case": """
        CHANGEFRICTION CLEARANCE CONTACT CONTACTINCLUSIONS CONTACTINTERFERENCE CONTACTPAIR LOADCASE MODELCHANGE
        RIGIDSURFACE SLIDELINE SURFACEBEHAVIOR SURFACEINTERACTION
    """,
    f"is not read here: {_STRUTS}": "CONNECTORLOCK CONNECTORSTOP NOCOMPRESSION NOTENSION",
    "is not read here: materials are linear": "CREEP HYPERELASTIC HYPERFOAM PLASTIC USERMATERIAL VISCOELASTIC",
    "is not read: gaps with friction are not, fuge has no friction": "FRICTION",
    "is not read here: directions are x, y and z": "TRANSFORM",
}

# A step that is no load case does not excuse these.
MODEL = {*names.MODEL, *" ".join(_REASONS.values()).split()}

# Parameters that are read, or change nothing, of keywords whose other ones could change the answer.
_PARAMETERS = {
    "BOUNDARY": "OP TYPE",
    "CLOAD": "OP",
    "ELASTIC": "DEPENDENCIES MODULI TYPE",
    "ELEMENT": "ELSET INPUT TYPE",
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

# Solids, plates, shells, membranes, bars, beams, springs, dampers, masses and rigid bodies.
_LINEAR_ELEMENT = re.compile(
    r"C3D|CPS|CPE|CAX|CGAX|SAX|MAX|MGAX|M3D|S[34689]|SC[68]|STRI|SFM|US[34]|T[23]D|B[23][1-4]|PIPE[23]|ELBOW|SPRING|"
    r"DASHPOT|MASS|ROTARYI|R2D|R3D|RAX|RB[23]D|DCOUP"
)

# Constraints that are equations; blank or 0 where the nodes of one go on.
_LINEAR_CONSTRAINTS = ("", "0", "BEAM", "LINEAR", "LINK", "MEANROT", "PIN", "PLANE", "QUADRATIC", "STRAIGHT", "TIE")

# What to do instead of a parameter that is not read.
_REMEDIES = {
    "BOUNDARY": ": write the values at the end of the step",
    "CLOAD": ": write the values at the end of the step",
    "INITIALCONDITIONS": ": give the forces of initial stresses at nodes by *CLOAD",
    "SPRING": ": give one-way springs as GAPUNI with a stiffness, or in a table of links",
}


def parameters_of(block: Block) -> dict[str, str]:
    """The parameters of a keyword, their names written out, and their values where only some words are allowed."""
    keyword = block.keyword
    if keyword not in _ALLOWED:
        unread = _UNREAD_LOAD if keyword in _UNREAD_LOADS.split() else _UNKNOWN
        reason = next((text for text, words in _REASONS.items() if keyword in words.split()), unread)
        raise block.refuse(f"*{keyword} {reason}" if keyword else "data stand before the first keyword")
    known, remedy = _PARAMETERS.get(keyword), _REMEDIES.get(keyword, "")
    if known is None:
        return block.parameters
    try:
        found = block.named(known.split())
    except FileError as refused:
        raise FileError(refused.message + remedy, refused.status) from None
    for name, value in found.items():
        words = _VALUES.get((keyword, name))
        if words and value:
            word = complete(squeezed(value), words)
            if word is None:
                reason = f"{name}={quoted(value)} is not read, only {', '.join(words)}"
                raise block.refuse(f"*{keyword}: {reason}{remedy if name == 'TYPE' else ''}")
            found[name] = word
    return found


def check_element(block: Block, parameters: dict[str, str]) -> None:
    """Refuse connectors, gaskets and other elements that may not be linear."""
    kind = squeezed(parameters.get("TYPE", ""))
    if kind not in GAP_TYPES and not _LINEAR_ELEMENT.match(kind):
        raise block.refuse(f"elements of type {quoted(kind)} are not read here: of gaps {', '.join(GAP_TYPES)} are")


def check_material(block: Block, parameters: dict[str, str]) -> None:
    """Refuse materials of CalculiX for one sign."""
    if parameters.get("NAME", "").upper().startswith(("COMPRESSION_ONLY", "TENSION_ONLY")):
        raise block.refuse(f"materials for one sign only are not read: {_STRUTS}")


def check_constraint(block: Block, parameters: dict[str, str]) -> None:
    """Refuse constraints that may be no linear equations."""
    for index, line in enumerate(block.lines):
        kind = split_items(line)[0][0].upper()
        if kind not in _LINEAR_CONSTRAINTS:
            raise block.refuse(f"*MPC of type {quoted(kind)} is not read: it may be no linear equation", index)
