"""The options of the command: its help, from which its checks and its man page are made."""

from __future__ import annotations

# Blocks between blank lines: what the command is, how it is called, and groups with a title. Options stand in the
# columns of _SYNTAX, what they mean behind them; other lines of a group are remarks.
HELP = """\
fuge: contact forces, gaps and pressures of elastic bodies, from files to a table

  fuge --mesh FILE --stiffness FILE [--mesh FILE --stiffness FILE ..] --pair SURFACE:SURFACE
       [--support NODES:DIRECTION] [--load NODES:DIRECTION=F] [RESULTS]
  fuge --stiffness FILE --contact FILE --gap FILE [MOTION] [RESULTS]
  fuge --alpha FILE|0 --gap FILE MOTION [RESULTS]
  fuge --deck FILE --stiffness FILE [RESULTS]
  fuge --surface FILE --pressure P[,P..] --modulus E [RESULTS]
  fuge JOB

Job files
JOB has one option a line; hyphens are not needed, comments begin with #, and paths begin at its
folder. More options may stand before it and behind it

Meshes in contact
  --body NAME             begins a body; without it a second --mesh or --stiffness does, and its
                          name is that of the mesh's file
  --mesh FILE             nodes, elements, sets, surfaces: input file of Abaqus or CalculiX
  --stiffness FILE        CalculiX .sti with its .dof, Abaqus .mtx, Nastran DMIG or OP4, Matrix
                          Market; a body without one is rigid and stands still
  --rows FILE             lines node.direction that name the rows of that matrix
  --matrix NAME           which matrix of a file of Nastran, such as KAAX
  --pair CONTACT:OPPOSITE two surfaces, such as shaft.OUTER:hub.BORE, or OUTER:BORE where no
                          other body has the name; the nodes of the first one become points.
                          With linear elements let it be the coarser one, with quadratic ones
                          the finer one
Of the --pair before them, or, before the first one, of all pairs
  --tied                  glued where they are
  --play D                a second stop, D above the first one; 0: sliding, not lifting off
  --clearance C           added to the gaps; an interference is negative
  --faceted               gaps of the faces as they are, not of the smooth bodies they stand for
  --crease DEGREES        angle beyond which faces meet at an edge of such a body, else 25
  --node-to-face          instead of mortar; fails the patch test
  --normals WHICH         averaged (default), opposite, or a direction outwards: 0,0,1
  --reach L               how far apart, or one inside the other, opposite points may be
Supports and loads; NODES: a set, a surface, or the number of a node, such as hub.BOTTOM or
hub.17; axes are x, y, z or 1, 2, 3, and 4 to 6 for rotations. Motions that supports leave are
resisted by the contact
  --support NODES:XYZ     held along these axes; NODES:z=U: displaced by U
  --load NODES:z=F        the force F on each node, as *CLOAD; all loads are added
  --pressure SURFACE=P    uniform; positive into the body; of elements CAX on the whole ring
  --supports [BODY=]FILE  lines NODES,XYZ[,U], or an input file with *BOUNDARY; of BODY
  --loads [BODY=]FILE     lines NODES,z,F, or an input file with *CLOAD; of BODY
  --exclude NODES         no contact at these nodes of contact surfaces

Matrices
n points and nd degrees of freedom, from 1; files of the Matrix Market format
  --alpha FILE|0          n x n: influence matrix, displacement per force; 0, or left out beside
                          --compliance: none, so that each point is a spring of its own, as on a
                          Winkler bed
  --gap FILE              n: initial gaps
  --play FILE             n: distance of the second stop; -1: none, 0: tied
  --compliance FILE|D     n: springs at the points, length per force; or one for all
  --limit FILE|F          n: limit of each force, beyond which the point gives way; -1: none, 0:
                          does not push; or one for all
  --limit-upper FILE|F    n: of the size of a force at the second stop, or of one that pulls at
                          a tied point; likewise
  --stiffness FILE        nd x nd: stiffness matrix, in any format above
  --contact FILE          n x nd: row i has the direction in which the force of point i acts on
                          the body, into it, in the columns of its degrees of freedom
  --fixed FILE            k x 1: degrees of freedom held; k x 2: displacements too
  --external FILE         nd: external forces on the body
  --floats                the supports leave rigid motions, which the contact has to resist;
                          with --deck and --links always so
  --exclude POINTS        no contact at these points, such as 3,7-9
MOTION of the rigid counter-body, one of (none with --stiffness: it stands still)
  --load F                pressed on with this force
  --approach V            moved by this length
  --modes FILE            n x m: how far each point closes per unit of each rigid motion
  --resultant FILE        m: of the contact forces in each motion (both with --alpha)
  --motion K=Q            motion K is prescribed, instead of its resultant

One-way links of a structure
Gaps, supports that lift off, struts and cables, in all load cases; a case that fails does not
harm the others. What supports leave free is a motion that the links have to resist
  --deck FILE             links, supports and load cases: bulk data of Nastran, or an input file
                          of Abaqus or CalculiX. What means contact or a load and is not read is
                          an error
  --links FILE            lines node_a,node_b,x,y,z,gap,play,stiffness,limit,name; node 0: the
                          ground; from gap on columns may be blank: no gap, no second stop,
                          rigid, no limit. The link opens as node b moves along x, y, z away
                          from node a
  --cases FILE            lines node.direction,F[,F..]: a column of forces for each load case;
                          the first line may name them
  --supports FILE         lines node,xyz[,U]
  --stiffness FILE        of the structure without these links, in any format above; with --rows
                          and --matrix as above
  --mesh FILE             for --field, where the deck has none
  --long                  a line for each link in each case, instead of columns for the cases
  --reactions FILE        table of the reactions of the supports in each case, and their
                          envelope

A measured surface, on which a flat rigid body is pressed
  --surface FILE          heights, positive out of the body: lines of a grid, columns x y
                          height, SDF or another file of an instrument
  --pressure P[,P..]      mean pressure on the whole surface, or several
  --load F[,F..]          force on the whole surface, instead
  --modulus E             combined modulus E* of both bodies, 1/E* = (1 - nu1^2)/E1 + (1 -
                          nu2^2)/E2; or, of one body or of both:
  --young E[,E]           Young's modulus
  --poisson N[,N]         Poisson's ratio
  --level WHAT            taken out of the heights: plane (default), mean, none
  --fill                  points that were not measured get the mean of their neighbours
  --scale S               factor of all lengths of the file: 1e3 from m (as in SDF) to mm
  --height-scale S        the same of the heights, where they have another unit
  --spacing H[,H]         from point to point along x and y, where the file does not say
  --boundary WHAT         the surface is periodic (default), free, periodic-x or periodic-y
  --element WHAT          displacements: mean of a cell (default), or at its centre

Every solve
  --threads N             share its work; 0: all cores (default). They change no result
  --prove                 bounds of the error of each number, rounding included, and which
                          states are proved: columns of the table. They hold for the influence
                          matrix as it is read or computed; not with --mesh
  --strict                a warning gives exit code 5 instead of 0

Results
  --output FILE           table of forces, gaps, pressures, a line for each load of a surface,
                          columns for each load case of links; else on standard output
  --json FILE|-           the same table as JSON; - for standard output, instead of the table
  --field FILE            displacements: .vtu for ParaView (meshes), or a table; of a surface
                          height, pressure, gap under the last load: .vti, or a table x,y,..
  --plot FILE             picture, such as .png or .pdf, by matplotlib: forces of points, the
                          envelope of links, the pressures of a surface
  --verbose               each step, with its time, on standard error
  --version               version (-V), and the libraries in it with their licences
  --help                  this list (-h)
Units are yours, as long as they agree. Tables are CSV with comments after #, written whole or
not at all. Warnings are on standard error and in the table

Exit status
0: done; 2: an option is wrong; 3: a file or a value is wrong; 4: there is no solution, or some
load cases have none, and the table has the others; 5: a warning, with --strict; 1: an
unexpected error; 130: Ctrl-C
"""

_SYNTAX = slice(2, 26)


def split_entry(line: str) -> tuple[str, str]:
    """An option as it is written, empty unless the line begins one, and what the line says."""
    return line[_SYNTAX].strip() if line.startswith("  --") else "", line[_SYNTAX.stop if line[0] == " " else 0 :]


_WORDS = [split_entry(line)[0].split() for line in HELP.splitlines() if line.startswith("  --")]

# Names of the options without their hyphens.
NAMES = sorted({words[0][2:] for words in _WORDS})
WITHOUT_VALUE = [words[0][2:] for words in _WORDS if len(words) == 1]
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
RESULTS = "output field reactions json plot".split()
