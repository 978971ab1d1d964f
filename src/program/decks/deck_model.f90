!> A structure with one-way links: what the deck, its tables and the stiffness matrix have.
module deck_model
  use command_line, only: arguments, refuse
  use fuge_core, only: dp => fuge_dp, fuge_info
  use fuge_fe, only: fuge_links
  use fuge_files, only: fuge_deck, fuge_deck_links, fuge_deck_loads, fuge_read_cases, fuge_read_deck, fuge_read_links, &
    fuge_read_stiffness, fuge_read_supports
  use number_words, only: number_text
  use option_checks, only: check_input
  use progress_log, only: progress
  implicit none
  private

  type, public :: structure
    type(fuge_deck) :: deck
    !> The stiffness matrix in compressed columns, and the names of its rows.
    integer, allocatable :: column(:), row(:), node(:), direction(:)
    real(dp), allocatable :: value(:)
    type(fuge_links) :: links
    !> Forces, (rows, cases).
    real(dp), allocatable :: loads(:, :)
  contains
    procedure :: read => read_structure
    procedure :: degrees
  end type structure

contains

  !> Number of degrees of freedom.
  pure function degrees(self)
    class(structure), intent(in) :: self
    integer :: degrees

    degrees = 0
    if (allocated(self%node)) degrees = size(self%node)
  end function degrees

  !> Read all files.
  subroutine read_structure(self, given, log, info)
    class(structure), intent(inout) :: self
    type(arguments), intent(in) :: given
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: name

    if (given%has('deck')) call fuge_read_deck(given%file('deck'), self%deck, info)
    if (given%has('links') .and. .not. info%failed()) call fuge_read_links(given%file('links'), self%deck, info)
    if (given%has('supports') .and. .not. info%failed()) &
      call fuge_read_supports(given%file('supports'), self%deck, info)
    if (given%has('cases') .and. .not. info%failed()) call fuge_read_cases(given%file('cases'), self%deck, info)
    if (.not. info%failed()) call check_deck(given, self%deck, info)
    if (info%failed()) return
    call log%say('deck: '//number_text(self%deck%link_count())//' one-way links, ' &
                 //number_text(self%deck%case_count())//' load cases')
    name = ''
    if (given%has('matrix')) name = given%settings(given%position('matrix'))%value
    call fuge_read_stiffness(given%file('stiffness'), self%column, self%row, self%value, self%node, self%direction, &
                             info, names_path=given%file('rows'), name=name)
    if (info%failed()) return
    call log%say('stiffness matrix of '//number_text(self%degrees())//' rows is read')
    if (all(self%node == 0)) then
      call refuse('"'//given%file('stiffness')//'" has rows without names: give the node and the direction of each ' &
                  //'by --rows', info)
      return
    end if
    call fuge_deck_links(self%deck, self%node, self%direction, self%links, info)
    if (.not. info%failed()) call fuge_deck_loads(self%deck, self%node, self%direction, self%loads, info)
  end subroutine read_structure

  !> Refuse results that would overwrite a file of the deck, and a deck without links or load cases.
  subroutine check_deck(given, deck, info)
    type(arguments), intent(in) :: given
    type(fuge_deck), intent(in) :: deck
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: path
    integer :: k

    do k = 1, deck%file_count()
      call deck%get_file(k, path)
      call check_input(given, path, 'the same file as of --deck or of one that it includes', info)
    end do
    if (info%failed()) return
    if (deck%link_count() < 1) then
      call refuse('no one-way link: the deck has no CGAP, no CBUSH1D with a table, and no GAPUNI, and --links gives ' &
                  //'none', info)
    else if (deck%case_count() < 1) then
      call refuse('no load case: the deck has no SUBCASE, no only load set and no static *STEP, and --cases gives ' &
                  //'none', info)
    end if
  end subroutine check_deck

end module deck_model
