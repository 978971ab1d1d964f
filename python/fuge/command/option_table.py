"""The options of the command: one table for its help, its man page and its checks."""

from __future__ import annotations

import re
import textwrap
from typing import NamedTuple, Union

SUMMARY = "contact forces, gaps and pressures of elastic bodies, from files to a table"

SYNOPSIS = (
    "fuge --mesh FILE --stiffness FILE [--mesh FILE --stiffness FILE ..] --pair SURFACE:SURFACE\n"
    "     [--support NODES:DIRECTION] [--load NODES:DIRECTION=F] [RESULTS]",
    "fuge --stiffness FILE --contact FILE --gap FILE [MOTION] [RESULTS]",
    "fuge --alpha FILE|0 --gap FILE MOTION [RESULTS]",
    "fuge --deck FILE --stiffness FILE [RESULTS]",
    "fuge --surface FILE --pressure P[,P..] --modulus E [RESULTS]",
    "fuge JOB",
)


class Entry(NamedTuple):
    """An option as it is written, and what it means."""

    syntax: str
    text: str


class Group(NamedTuple):
    """Options of one kind of problem; a text among them is a paragraph."""

    title: str
    items: tuple[Union[Entry, str], ...]


GROUPS = (
    Group(
        "Job files",
        (
            "JOB is a file with one option a line; hyphens are not needed, comments begin with #, and paths begin at its "
            "folder. More options may stand before it and behind it.",
        ),
    ),
    Group(
        "Meshes in contact",
        (
            Entry("--body NAME", "begins a body; without it a second --mesh or --stiffness does, and its name is that of "
                  "the mesh's file"),
            Entry("--mesh FILE", "nodes, elements, sets, surfaces: input file of Abaqus or CalculiX"),
            Entry("--stiffness FILE", "CalculiX .sti with its .dof, Abaqus .mtx, Nastran DMIG or OP4, Matrix Market; a "
                  "body without one is rigid and stands still"),
            Entry("--rows FILE", "lines node.direction that name the rows of that matrix"),
            Entry("--matrix NAME", "which matrix of a file of Nastran, such as KAAX"),
            Entry("--pair CONTACT:OPPOSITE", "two surfaces, such as shaft.OUTER:hub.BORE, or OUTER:BORE where no other "
                  "body has the name; the nodes of the first one become points. With linear elements let it be the "
                  "coarser one, with quadratic ones the finer one"),
            "Of the --pair before them, or, before the first one, of all pairs",
            Entry("--tied", "glued where they are"),
            Entry("--play D", "a second stop, D above the first one; 0: sliding, not lifting off"),
            Entry("--clearance C", "added to the gaps; an interference is negative"),
            Entry("--faceted", "gaps of the faces as they are, not of the smooth bodies they stand for"),
            Entry("--crease DEGREES", "angle beyond which faces meet at an edge of such a body, else 25"),
            Entry("--node-to-face", "instead of mortar; fails the patch test"),
            Entry("--normals WHICH", "averaged (default), opposite, or a direction outwards: 0,0,1"),
            Entry("--reach L", "how far apart, or one inside the other, opposite points may be"),
            "Supports and loads; NODES: a set, a surface, or the number of a node, such as hub.BOTTOM or hub.17; axes "
            "are x, y, z or 1, 2, 3, and 4 to 6 for rotations. Motions that supports leave are resisted by the contact",
            Entry("--support NODES:XYZ", "held along these axes; NODES:z=U: displaced by U"),
            Entry("--load NODES:z=F", "the force F on each node, as *CLOAD; all loads are added"),
            Entry("--pressure SURFACE=P", "uniform; positive into the body; of elements CAX on the whole ring"),
            Entry("--supports [BODY=]FILE", "lines NODES,XYZ[,U], or an input file with *BOUNDARY; of BODY"),
            Entry("--loads [BODY=]FILE", "lines NODES,z,F, or an input file with *CLOAD; of BODY"),
            Entry("--exclude NODES", "no contact at these nodes of contact surfaces"),
        ),
    ),
    Group(
        "Matrices",
        (
            "n points and nd degrees of freedom, from 1; files of the Matrix Market format",
            Entry("--alpha FILE|0", "n x n: influence matrix, displacement per force; 0, or left out beside "
                  "--compliance: none, so that each point is a spring of its own, as on a Winkler bed"),
            Entry("--gap FILE", "n: initial gaps"),
            Entry("--play FILE", "n: distance of the second stop; -1: none, 0: tied"),
            Entry("--compliance FILE|D", "n: springs at the points, length per force; or one for all"),
            Entry("--limit FILE|F", "n: limit of each force, beyond which the point gives way; -1: none, 0: does not "
                  "push; or one for all"),
            Entry("--limit-upper FILE|F", "n: of the size of a force at the second stop, or of one that pulls at a tied "
                  "point; likewise"),
            Entry("--stiffness FILE", "nd x nd: stiffness matrix, in any format above"),
            Entry("--contact FILE", "n x nd: row i has the direction in which the force of point i acts on the body, "
                  "into it, in the columns of its degrees of freedom"),
            Entry("--fixed FILE", "k x 1: degrees of freedom held; k x 2: displacements too"),
            Entry("--external FILE", "nd: external forces on the body"),
            Entry("--floats", "the supports leave rigid motions, which the contact has to resist; with --deck and "
                  "--links always so"),
            Entry("--exclude POINTS", "no contact at these points, such as 3,7-9"),
            "MOTION of the rigid counter-body, one of (none with --stiffness: it stands still)",
            Entry("--load F", "pressed on with this force"),
            Entry("--approach V", "moved by this length"),
            Entry("--modes FILE", "n x m: how far each point closes per unit of each rigid motion"),
            Entry("--resultant FILE", "m: of the contact forces in each motion (both with --alpha)"),
            Entry("--motion K=Q", "motion K is prescribed, instead of its resultant"),
        ),
    ),
    Group(
        "One-way links of a structure",
        (
            "Gaps, supports that lift off, struts and cables, in all load cases; a case that fails does not harm the "
            "others. What supports leave free is a motion that the links have to resist",
            Entry("--deck FILE", "links, supports and load cases: bulk data of Nastran, or an input file of Abaqus or "
                  "CalculiX. What means contact or a load and is not read is an error"),
            Entry("--links FILE", "lines node_a,node_b,x,y,z,gap,play,stiffness,limit,name; node 0: the ground; from "
                  "gap on columns may be blank: no gap, no second stop, rigid, no limit. The link opens as node b "
                  "moves along x, y, z away from node a"),
            Entry("--cases FILE", "lines node.direction,F[,F..]: a column of forces for each load case; the first line "
                  "may name them"),
            Entry("--supports FILE", "lines node,xyz[,U]"),
            Entry("--stiffness FILE", "of the structure without these links, in any format above; with --rows and "
                  "--matrix as above"),
            Entry("--mesh FILE", "for --field, where the deck has none"),
            Entry("--long", "a line for each link in each case, instead of columns for the cases"),
            Entry("--reactions FILE", "table of the reactions of the supports in each case, and their envelope"),
        ),
    ),
    Group(
        "A measured surface, on which a flat rigid body is pressed",
        (
            Entry("--surface FILE", "heights, positive out of the body: lines of a grid, columns x y height, SDF or "
                  "another file of an instrument"),
            Entry("--pressure P[,P..]", "mean pressure on the whole surface, or several"),
            Entry("--load F[,F..]", "force on the whole surface, instead"),
            Entry("--modulus E", "combined modulus E* of both bodies, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; or, of one "
                  "body or of both:"),
            Entry("--young E[,E]", "Young's modulus"),
            Entry("--poisson N[,N]", "Poisson's ratio"),
            Entry("--level WHAT", "taken out of the heights: plane (default), mean, none"),
            Entry("--fill", "points that were not measured get the mean of their neighbours"),
            Entry("--scale S", "factor of all lengths of the file: 1e3 from m (as in SDF) to mm"),
            Entry("--height-scale S", "the same of the heights, where they have another unit"),
            Entry("--spacing H[,H]", "from point to point along x and y, where the file does not say"),
            Entry("--boundary WHAT", "the surface is periodic (default), free, periodic-x or periodic-y"),
            Entry("--element WHAT", "displacements: mean of a cell (default), or at its centre"),
        ),
    ),
    Group(
        "Every solve",
        (
            Entry("--threads N", "share its work; 0: all cores (default). They change no result"),
            Entry("--prove", "bounds of the error of each number, rounding included, and which states are proved: "
                  "columns of the table. They hold for the influence matrix as it is read or computed; not with --mesh"),
            Entry("--strict", "a warning gives exit code 5 instead of 0"),
        ),
    ),
    Group(
        "Results",
        (
            Entry("--output FILE", "table of forces, gaps, pressures, a line for each load of a surface, columns for "
                  "each load case of links; else on standard output"),
            Entry("--json FILE|-", "the same table as JSON; - for standard output, instead of the table"),
            Entry("--field FILE", "displacements: .vtu for ParaView (meshes), or a table; of a surface height, "
                  "pressure, gap under the last load: .vti, or a table x,y,.."),
            Entry("--plot FILE", "picture, such as .png or .pdf, by matplotlib: forces of points, the envelope of "
                  "links, the pressures of a surface"),
            Entry("--verbose", "each step, with its time, on standard error"),
            Entry("--version", "version (-V), and the libraries in it with their licences"),
            Entry("--help", "this list (-h)"),
        ),
    ),
)

NOTES = (
    "Units are yours, as long as they agree. Tables are CSV with comments after #. Warnings are on standard error and in "
    "the table.",
    "Exit status 0: done; 2: an option is wrong; 3: a file or a value is wrong; 4: there is no solution, or some load "
    "cases have none, and the table has the others; 5: a warning, with --strict; 1: an unexpected error; 130: Ctrl-C.",
)

_ENTRIES = [item for group in GROUPS for item in group.items if isinstance(item, Entry)]


def _names(entries: list[Entry]) -> tuple[str, ...]:
    return tuple(sorted({re.split("[ ]", entry.syntax)[0][2:] for entry in entries}))


# Names of the options without their hyphens.
NAMES = _names(_ENTRIES)
WITHOUT_VALUE = _names([entry for entry in _ENTRIES if " " not in entry.syntax])
# Those that may be given again: of another body or pair, or one more support.
REPEATED = (
    "body clearance crease exclude faceted load loads matrix mesh motion node-to-face normals pair play pressure reach "
    "rows stiffness support supports tied"
).split()
# Those whose value is the path of an input, or of a result.
INPUTS = (
    "alpha cases compliance contact deck external fixed gap limit limit-upper links loads mesh modes play resultant "
    "rows stiffness supports surface"
).split()
RESULTS = ("output", "field", "reactions", "json", "plot")

_WIDTH, _COLUMN = 96, 26


def help_text() -> str:
    """What fuge --help prints."""
    lines = [f"fuge: {SUMMARY}", ""]
    lines += textwrap.indent("\n".join(SYNOPSIS), "  ").split("\n")
    for group in GROUPS:
        lines += ["", group.title]
        for item in group.items:
            lines += _entry_lines(item) if isinstance(item, Entry) else textwrap.wrap(item, _WIDTH)
    for note in NOTES:
        lines += ["", *textwrap.wrap(note, _WIDTH)]
    return "\n".join(lines)


def _entry_lines(entry: Entry) -> list[str]:
    begin = f"  {entry.syntax}".ljust(_COLUMN - 1) + " "
    return textwrap.wrap(entry.text, _WIDTH, initial_indent=begin, subsequent_indent=" " * _COLUMN)
