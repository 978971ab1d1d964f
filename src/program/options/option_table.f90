!> The options of the program `fuge`, and its help.
module option_table
  implicit none
  private

  public :: may_repeat, option_number, takes_value

  !> The names of the options, after two hyphens.
  character(len=12), parameter, public :: OPTION_NAMES(54) = [character(len=12) :: &
    'alpha', 'approach', 'body', 'boundary', 'cases', 'clearance', 'compliance', 'contact', 'crease', 'deck', &
    'element', 'exclude', 'external', 'faceted', 'field', 'fill', 'fixed', 'floats', 'gap', 'height-scale', 'help', &
    'level', 'limit', 'limit-upper', 'links', 'load', 'loads', 'matrix', 'mesh', 'modes', 'modulus', 'motion', &
    'node-to-face', 'normals', 'output', 'pair', 'play', 'poisson', 'pressure', 'prove', 'reach', 'resultant', &
    'rows', 'scale', 'spacing', 'stiffness', 'support', 'supports', 'surface', 'threads', 'tied', 'verbose', &
    'version', 'young']
  !> Those without a value.
  character(len=12), parameter :: WITHOUT_VALUE(9) = [character(len=12) :: &
    'faceted', 'fill', 'floats', 'help', 'node-to-face', 'prove', 'tied', 'verbose', 'version']
  !> Those that may be given again: of another body or pair, or one more support.
  character(len=12), parameter :: REPEATED(21) = [character(len=12) :: &
    'body', 'clearance', 'crease', 'exclude', 'faceted', 'load', 'loads', 'matrix', 'mesh', 'motion', 'node-to-face', &
    'normals', 'pair', 'play', 'pressure', 'reach', 'rows', 'stiffness', 'support', 'supports', 'tied']
  !> Those whose value is the path of an input.
  character(len=12), parameter, public :: INPUTS(20) = [character(len=12) :: &
    'alpha', 'cases', 'compliance', 'contact', 'deck', 'external', 'fixed', 'gap', 'limit', 'limit-upper', 'links', &
    'loads', 'mesh', 'modes', 'play', 'resultant', 'rows', 'stiffness', 'supports', 'surface']

  !> What `fuge --help` prints.
  character(len=*), parameter, public :: HELP(104) = [character(len=96) :: &
    'fuge: contact forces, gaps and pressures of elastic bodies, from files to a table', &
    '', &
    '  fuge --mesh FILE --stiffness FILE [--mesh FILE --stiffness FILE ..] --pair SURFACE:SURFACE', &
    '       [--support NODES:DIRECTION] [--load NODES:DIRECTION=F] [--output FILE] [--field FILE]', &
    '  fuge --stiffness FILE --contact FILE --gap FILE [MOTION] [--output FILE] [--field FILE]', &
    '  fuge --alpha FILE --gap FILE MOTION [--output FILE]', &
    '  fuge --deck FILE --stiffness FILE [--output FILE] [--field FILE]', &
    '  fuge --surface FILE --pressure P[,P..] --modulus E [--output FILE] [--field FILE]', &
    '  fuge JOB', &
    '', &
    'JOB: a file with one option a line, hyphens not needed, comments after #; paths begin at its', &
    'folder', &
    '', &
    'Meshes in contact', &
    '  --body NAME             begins a body; without it a second --mesh or --stiffness does, and', &
    '                          its name is that of the mesh''s file', &
    '  --mesh FILE             nodes, elements, sets, surfaces: input file of Abaqus or CalculiX', &
    '  --stiffness FILE        CalculiX .sti, Abaqus .mtx, Nastran DMIG or OP4, Matrix Market; a', &
    '                          body without one is rigid and stands still', &
    '  --rows FILE             lines node.direction that name the rows of that matrix', &
    '  --matrix NAME           which matrix of a file of Nastran', &
    '  --pair CONTACT:OPPOSITE two surfaces, such as shaft.OUTER:hub.BORE, or OUTER:BORE where no', &
    '                          other body has the name; the nodes of the first one become points', &
    'Of the --pair before them, or, before the first one, of all pairs', &
    '  --tied                  glued', &
    '  --play D                a second stop, D above the first one; 0: sliding, not lifting off', &
    '  --clearance C           added to the gaps; an interference is negative', &
    '  --faceted               gaps of the faces as they are, not of the smooth bodies they stand for', &
    '  --crease DEGREES        angle beyond which faces meet at an edge of such a body, else 25', &
    '  --node-to-face          instead of mortar; fails the patch test', &
    '  --normals WHICH         averaged (default), opposite, or a direction: 0,0,1', &
    '  --reach L               how far apart opposite points may be', &
    'Supports and loads; NODES: a set, or the number of a node, such as hub.BOTTOM or hub.17', &
    '  --support NODES:XYZ     held along these axes; NODES:z=U: displaced by U', &
    '  --load NODES:z=F        the force F on each node, as *CLOAD; all loads are added', &
    '  --pressure SURFACE=P    uniform; positive into the body', &
    '  --supports [BODY=]FILE  lines NODES,XYZ[,U], or an input file with *BOUNDARY; of BODY', &
    '  --loads [BODY=]FILE     lines NODES,z,F, or an input file with *CLOAD; of BODY', &
    '  --exclude NODES         no contact at these nodes', &
    '', &
    'Matrices; n points, nd degrees of freedom from 1', &
    '  --alpha FILE            n x n    influence matrix, displacement per force', &
    '  --gap FILE              n        initial gaps', &
    '  --play FILE             n        distance of the second stop; -1: none, 0: tied', &
    '  --compliance FILE|D     n        springs at the points, length per force; or one for all', &
    '  --limit FILE|F          n        limit of each force; -1: none, 0: does not push', &
    '  --limit-upper FILE|F    n        of the size of a force at the second stop, or of one that', &
    '                          pulls at a tied point; likewise', &
    '  --stiffness FILE        nd x nd  stiffness matrix, in any format above', &
    '  --contact FILE          n x nd   row i: direction in which the force of point i acts on', &
    '                          the body, into it, in the columns of its degrees of freedom', &
    '  --fixed FILE            k x 1    degrees of freedom held; k x 2: displacements too', &
    '  --external FILE         nd       external forces on the body', &
    '  --floats                the supports leave rigid motions, which the contact has to resist', &
    '  --exclude POINTS        no contact at these points, such as 3,7-9', &
    'MOTION of the rigid counter-body, one of (none with --stiffness: it stands still)', &
    '  --load F                pressed on with this force', &
    '  --approach V            moved by this length', &
    '  --modes FILE            n x m    how far each point closes per unit of each rigid motion', &
    '  --resultant FILE        m        of the contact forces in each motion (both with --alpha)', &
    '  --motion K=Q            motion K is prescribed, instead of its resultant', &
    '', &
    'One-way links of a structure: gaps, supports that lift off, cables; in all load cases', &
    '  --deck FILE             links, supports and load cases: bulk data of Nastran, or an input file', &
    '                          of Abaqus or CalculiX', &
    '  --links FILE            lines node_a,node_b,x,y,z,gap,play,stiffness,limit; node 0: the ground', &
    '  --cases FILE            lines node.direction,F[,F..]: a column of forces for each load case', &
    '  --supports FILE         lines node,xyz[,U]', &
    '  --stiffness FILE        of the structure without these links, in any format above; with --rows', &
    '                          and --matrix as above', &
    '  --mesh FILE             for --field, where the deck has none', &
    '', &
    'A measured surface, on which a flat rigid body is pressed', &
    '  --surface FILE          heights: lines of a grid, columns x y height, or SDF', &
    '  --pressure P[,P..]      mean pressure on the whole surface, or several', &
    '  --load F[,F..]          force on the whole surface, instead', &
    '  --modulus E             combined modulus E* of both bodies; or, of one body or of both:', &
    '  --young E[,E]           Young''s modulus', &
    '  --poisson N[,N]         Poisson''s ratio', &
    '  --level WHAT            taken out of the heights: plane (default), mean, none', &
    '  --fill                  points that were not measured get the mean of their neighbours', &
    '  --scale S               factor of all lengths of the file: 1e3 from m (as in SDF) to mm', &
    '  --height-scale S        the same of the heights, where they have another unit', &
    '  --spacing H[,H]         from point to point along x and y, where the file does not say', &
    '  --boundary WHAT         the surface is periodic (default), free, periodic-x or periodic-y', &
    '  --element WHAT          displacements: mean of a cell (default), or at its centre', &
    '', &
    'Every solve', &
    '  --threads N             share its work; 0: all cores (default). They change no result', &
    '', &
    'Results', &
    '  --output FILE           table of forces, gaps, pressures, a line for each load of a surface,', &
    '                          columns for each load case of links; else on standard output', &
    '  --field FILE            displacements: .vtu for ParaView (meshes), or a table; of a surface', &
    '                          height, pressure, gap under the last load: .vti, or a table x,y,..', &
    '  --prove                 bounds of the error of each number, and which states are proved:', &
    '                          columns of the table; with --alpha, --contact or --surface', &
    '  --verbose               each step, with its time, on standard error', &
    '  --version               version, and the libraries in it with their licences', &
    '  --help', &
    '', &
    'Units are yours, as long as they agree. Tables are CSV with comments after #. Exit status 0:', &
    'done; a warning is on standard error and in the table. 1: an error, which is on standard error;', &
    'of load cases the table has those that are solved.']

contains

  !> Number of the option with this name; 0 if there is none.
  pure function option_number(name) result(which)
    character(len=*), intent(in) :: name
    integer :: which

    do which = size(OPTION_NAMES), 1, -1
      if (name == OPTION_NAMES(which)) return
    end do
    which = 0
  end function option_number

  pure function takes_value(which)
    integer, intent(in) :: which
    logical :: takes_value

    takes_value = all(WITHOUT_VALUE /= OPTION_NAMES(which))
  end function takes_value

  !> May the option be given more than once?
  pure function may_repeat(which)
    integer, intent(in) :: which
    logical :: may_repeat

    may_repeat = any(REPEATED == OPTION_NAMES(which))
  end function may_repeat

end module option_table
