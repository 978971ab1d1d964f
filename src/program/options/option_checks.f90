!> Which options of the program `fuge` go together.
module option_checks
  use command_line, only: arguments, refuse
  use file_access, only: prepare_file, remove_file, same_file
  use fuge_core, only: fuge_info
  use option_table, only: INPUTS
  implicit none
  private

  public :: check_input, check_options

  !> What is asked for.
  integer, parameter, public :: WITH_ALPHA = 1, WITH_MATRICES = 2, WITH_MESHES = 3, WITH_SURFACE = 4, &
    WITH_DECK = 5
  character(len=*), parameter :: NEEDED(5) = [character(len=24) :: '--alpha', '--stiffness', '--mesh and --pair', &
    '--surface', '--deck or --links']

  !> What each of these options needs: one of the five.
  character(len=12), parameter :: ONLY_ALPHA(3) = [character(len=12) :: 'modes', 'motion', 'resultant']
  character(len=12), parameter :: ONLY_MATRICES(4) = [character(len=12) :: 'contact', 'external', 'fixed', 'floats']
  character(len=12), parameter :: ONLY_MESHES(11) = [character(len=12) :: 'body', 'clearance', 'crease', 'faceted', &
    'loads', 'node-to-face', 'normals', 'pair', 'reach', 'support', 'tied']
  character(len=12), parameter :: MESHES_OR_DECK(3) = [character(len=12) :: 'matrix', 'mesh', 'supports']
  character(len=12), parameter :: ONLY_DECK(3) = [character(len=12) :: 'cases', 'deck', 'links']
  character(len=12), parameter :: NOT_DECK(5) = [character(len=12) :: 'approach', 'exclude', 'gap', 'load', 'play']
  character(len=12), parameter :: ONLY_SURFACE(11) = [character(len=12) :: 'boundary', 'element', 'fill', &
    'height-scale', 'level', 'modulus', 'poisson', 'scale', 'spacing', 'surface', 'young']
  character(len=12), parameter :: NOT_ALPHA(2) = [character(len=12) :: 'field', 'rows']
  character(len=12), parameter :: LAWS(3) = [character(len=12) :: 'compliance', 'limit', 'limit-upper']
  character(len=12), parameter :: NOT_SURFACE(5) = [character(len=12) :: 'approach', 'exclude', 'gap', 'play', 'rows']

  !> Options that bodies may have each, but a deck once.
  character(len=12), parameter :: SINGLE(5) = [character(len=12) :: 'matrix', 'mesh', 'rows', 'stiffness', 'supports']

  !> Options whose value is the path of a result.
  character(len=*), parameter :: RESULTS(2) = ['output', 'field ']

contains

  !> Find out what is asked for, and refuse what does not go with it, and results where nothing can be written.
  !> Errors: FUGE_ERR_OPTION, FUGE_ERR_FILE.
  subroutine check_options(given, kind, info)
    type(arguments), intent(in) :: given
    integer, intent(out) :: kind
    type(fuge_info), intent(inout) :: info

    kind = WITH_MATRICES
    if (given%has('mesh') .or. given%has('pair')) kind = WITH_MESHES
    if (given%has('alpha')) kind = WITH_ALPHA
    if (given%has('surface')) kind = WITH_SURFACE
    if (given%has('deck') .or. given%has('links')) kind = WITH_DECK
    if (count([given%has('alpha'), given%has('stiffness') .or. given%has('mesh') .or. kind == WITH_DECK, &
               given%has('surface')]) /= 1) then
      call refuse('one of --alpha, --stiffness and --surface is needed', info)
    else if (kind == WITH_SURFACE) then
      call check_surface(given, info)
    else if (kind == WITH_DECK) then
      call check_deck(given, info)
    else if (kind == WITH_MESHES) then
      call check_meshes(given, info)
    else
      call check_matrices(given, kind, info)
    end if
    if (kind /= WITH_ALPHA) call check_absent(given, ONLY_ALPHA, NEEDED(WITH_ALPHA), info)
    if (kind /= WITH_MATRICES) call check_absent(given, ONLY_MATRICES, '--stiffness without --mesh', info)
    if (kind /= WITH_MESHES) call check_absent(given, ONLY_MESHES, NEEDED(WITH_MESHES), info)
    if (kind /= WITH_MESHES .and. kind /= WITH_DECK) call check_absent(given, MESHES_OR_DECK, NEEDED(WITH_MESHES), info)
    if (kind /= WITH_DECK) call check_absent(given, ONLY_DECK, NEEDED(WITH_DECK), info)
    if (kind /= WITH_SURFACE) call check_absent(given, ONLY_SURFACE, NEEDED(WITH_SURFACE), info)
    if (kind /= WITH_MESHES .and. kind /= WITH_SURFACE) &
      call check_absent(given, ['pressure'], trim(NEEDED(WITH_MESHES))//', or '//NEEDED(WITH_SURFACE), info)
    if (kind /= WITH_ALPHA .and. kind /= WITH_MATRICES) call check_absent(given, LAWS, '--alpha or --contact', info)
    if (kind == WITH_MESHES .or. kind == WITH_DECK) &
      call check_absent(given, ['prove'], '--alpha, --contact or --surface', info)
    if (kind == WITH_SURFACE) call check_absent(given, NOT_SURFACE, 'matrices or meshes', info)
    if (kind == WITH_ALPHA) call check_absent(given, NOT_ALPHA, NEEDED(WITH_MATRICES), info)
    if (.not. info%failed()) call check_results(given, info)
  end subroutine check_options

  subroutine check_matrices(given, kind, info)
    type(arguments), intent(in) :: given
    integer, intent(in) :: kind
    type(fuge_info), intent(inout) :: info
    integer :: motions

    motions = count([given%has('load'), given%has('approach'), given%has('modes')])
    if (.not. given%has('gap')) then
      call refuse('--gap is needed', info)
    else if (kind == WITH_ALPHA .and. (given%has('modes') .neqv. given%has('resultant'))) then
      call refuse('--modes and --resultant go together', info)
    else if (kind == WITH_ALPHA .and. motions /= 1) then
      call refuse('one of --load, --approach and --modes is needed', info)
    else if (given%has('motion') .and. .not. given%has('modes')) then
      call refuse('--motion needs --modes', info)
    else if (kind == WITH_MATRICES .and. motions > 1) then
      call refuse('with --stiffness no more than one of --load and --approach is possible', info)
    else if (kind == WITH_MATRICES .and. .not. given%has('contact')) then
      call refuse('--contact, or --mesh and --pair, are needed with --stiffness', info)
    end if
    call check_single(given, 'load', info)
    call check_single(given, 'play', info)
    call check_single(given, 'stiffness', info)
  end subroutine check_matrices

  subroutine check_deck(given, info)
    type(arguments), intent(in) :: given
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (.not. given%has('stiffness')) call refuse('--stiffness is needed: the matrix of the structure without its ' &
                                                  //'one-way links', info)
    call check_absent(given, NOT_DECK, 'another problem than --deck and --links', info)
    do k = 1, size(SINGLE)
      call check_single(given, trim(SINGLE(k)), info)
    end do
  end subroutine check_deck

  subroutine check_surface(given, info)
    type(arguments), intent(in) :: given
    type(fuge_info), intent(inout) :: info

    if (given%has('pressure') .eqv. given%has('load')) then
      call refuse('with --surface one of --pressure and --load is needed', info)
    else if (given%has('modulus') .eqv. (given%has('young') .or. given%has('poisson'))) then
      call refuse('with --surface either --modulus, or --young and --poisson, are needed', info)
    else if (given%has('young') .neqv. given%has('poisson')) then
      call refuse('--young and --poisson go together', info)
    end if
    call check_single(given, 'load', info)
    call check_single(given, 'pressure', info)
  end subroutine check_surface

  subroutine check_meshes(given, info)
    type(arguments), intent(in) :: given
    type(fuge_info), intent(inout) :: info

    if (.not. given%has('mesh')) then
      call refuse('--pair needs --mesh, the mesh with the surfaces', info)
    else if (.not. given%has('pair')) then
      call refuse('--mesh needs --pair, the surfaces in contact', info)
    else if (.not. given%has('stiffness')) then
      call refuse('--stiffness is needed: at least one body has to be elastic', info)
    end if
    call check_absent(given, [character(len=12) :: 'gap', 'approach'], '--alpha or --contact', info)
  end subroutine check_meshes

  !> Refuse results that would overwrite an input, or each other. A result that does not exist is made for a moment,
  !> because only then its names can be compared. Errors: FUGE_ERR_OPTION; FUGE_ERR_FILE where nothing can be
  !> written.
  subroutine check_results(given, info)
    type(arguments), intent(in) :: given
    type(fuge_info), intent(inout) :: info
    logical :: made(size(RESULTS))
    integer :: k

    made = .false.
    if (allocated(given%job)) call check_input(given, given%job, 'it is the job file', info)
    do k = 1, given%count
      if (any(given%settings(k)%name == INPUTS)) call check_option(given, k, info)
    end do
    do k = 1, size(RESULTS)
      if (given%has(RESULTS(k)) .and. .not. info%failed()) call prepare_file(given%file(RESULTS(k)), made(k), info)
    end do
    if (given%has('field') .and. .not. info%failed()) call check_input(given, given%file('field'), &
                                                                       'the same file as of --field', info, 'field')
    do k = 1, size(RESULTS)
      if (made(k)) call remove_file(given%file(RESULTS(k)))
    end do
  end subroutine check_results

  !> Refuse results that would overwrite the file of option k, or another that is read with it.
  subroutine check_option(given, k, info)
    type(arguments), intent(in) :: given
    integer, intent(in) :: k
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: path, reason

    path = given%path(k)
    reason = 'the same file as of --'//trim(given%settings(k)%name)
    call check_input(given, path, reason, info)
    if (given%settings(k)%name == 'stiffness') &
      call check_input(given, path(:max(len(path) - 4, 0))//'.dof', reason, info)
    if (any(given%settings(k)%name == [character(len=12) :: 'loads', 'supports'])) &
      call check_input(given, given%path(k, index(given%settings(k)%value, '=')), reason, info)
  end subroutine check_option

  !> Refuse a result, but for the one of the option `own`, in the file at `path`: `reason`. Without --output that is
  !> standard output.
  subroutine check_input(given, path, reason, info, own)
    type(arguments), intent(in) :: given
    character(len=*), intent(in) :: path, reason
    type(fuge_info), intent(inout) :: info
    character(len=*), intent(in), optional :: own
    character(len=:), allocatable :: result
    logical :: is_same
    integer :: at, k

    do k = 1, size(RESULTS)
      if (info%failed()) return
      if (present(own)) then
        if (own == RESULTS(k)) cycle
      end if
      at = given%position(RESULTS(k))
      result = given%file(RESULTS(k))
      if (at > 0 .and. len_trim(result) == 0) then
        call refuse(given%settings(at)%source//' needs a path', info)
      else if (at > 0) then
        is_same = same_file(result, path)
        if (result == path .and. index(path, '/dev/') /= 1) is_same = .true.
        if (is_same) call refuse(given%settings(at)%source//': '//reason, info)
      else if (RESULTS(k) == 'output') then
        if (same_file('', path)) call refuse('standard output: '//reason//', use --output', info)
      end if
    end do
  end subroutine check_input

  !> Refuse an option that only meshes may give again.
  subroutine check_single(given, name, info)
    type(arguments), intent(in) :: given
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. .not. given%has(name)) return
    if (given%position(name, given%position(name)) > 0) call refuse('--'//name//' is given twice', info)
  end subroutine check_single

  !> Refuse options that need others.
  subroutine check_absent(given, names, needed, info)
    type(arguments), intent(in) :: given
    character(len=*), intent(in) :: names(:), needed
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(names)
      if (info%failed()) return
      if (given%has(trim(names(k)))) call refuse('--'//trim(names(k))//' needs '//trim(needed), info)
    end do
  end subroutine check_absent

end module option_checks
