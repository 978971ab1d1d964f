!> Sets and surfaces of a mesh while its file is read: labels as the file has them, with the lines where they stand.
!>
!> A set takes memory for what the file says of it. A range of GENERATE is one item, and what other sets give to a set
!> is taken once: sets that name each other would double at each line.
module fuge_draft_sets
  use fuge_heap_sort, only: heap_sort
  use fuge_integer_list, only: integer_list
  use fuge_kinds, only: dp
  use fuge_mesh_type, only: NAME_LENGTH
  use fuge_name_table, only: name_table
  use fuge_row_table, only: row_table
  implicit none
  private

  public :: labels_in_range

  !> In place of a line: a range of labels that GENERATE made, which need not exist.
  integer, parameter, public :: GENERATED = 0

  !> Members of a set or faces of a surface.
  type, public :: draft_set
    character(len=NAME_LENGTH) :: name = ''
    !> Label, face (of a surface only), line and file of each member; of a range the first and the last label, GENERATED
    !> and the step.
    type(integer_list) :: label, face, line, file
    !> The set takes members of others. Then `known` has the members that it has already, to take each one once; a range
    !> is in it as a negative face, its number in `ranges`.
    logical, private :: tracked = .false.
    type(row_table), private :: known, ranges
    !> The sets from which members were taken, each with the face: the number of members taken, and the `state` then.
    type(row_table), private :: sources
    type(integer_list), private :: taken, state
  contains
    procedure :: append
    procedure :: begin_taking
    procedure, private :: track
    procedure, private :: is_known
  end type draft_set

  !> Sets of one kind.
  type, public :: draft_sets
    type(draft_set), allocatable :: set(:)
    type(name_table), private :: names
  contains
    procedure :: count => count_sets
    procedure :: named
    procedure :: known
  end type draft_sets

contains

  pure function count_sets(self) result(count)
    class(draft_sets), intent(in) :: self
    integer :: count

    count = self%names%count
  end function count_sets

  !> The number of the set with a name, a new one if there is none.
  pure subroutine named(self, name, number, status)
    class(draft_sets), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer, intent(out) :: number
    integer, intent(inout) :: status
    type(draft_set), allocatable :: longer(:)
    integer :: before, k

    before = self%names%count
    number = self%known(name)
    if (number > 0 .or. status /= 0) return
    if (.not. allocated(self%set)) then
      allocate (self%set(8), stat=status)
    else if (before == size(self%set)) then
      allocate (longer(2*before), stat=status)
      if (status /= 0) return
      do k = 1, before
        call move_set(self%set(k), longer(k))
      end do
      call move_alloc(longer, self%set)
    end if
    call self%names%number_of(name, number, status)
    if (status == 0) self%set(number)%name = name
  end subroutine named

  !> The number of the set with a name, 0 if there is none.
  pure function known(self, name) result(number)
    class(draft_sets), intent(in) :: self
    character(len=*), intent(in) :: name
    integer :: number

    number = self%names%find(name)
  end function known

  pure subroutine move_set(from, to)
    type(draft_set), intent(inout) :: from, to

    to%name = from%name
    to%tracked = from%tracked
    call move_list(from%label, to%label)
    call move_list(from%face, to%face)
    call move_list(from%line, to%line)
    call move_list(from%file, to%file)
    call move_list(from%taken, to%taken)
    call move_list(from%state, to%state)
    call from%known%move_to(to%known)
    call from%ranges%move_to(to%ranges)
    call from%sources%move_to(to%sources)
  end subroutine move_set

  pure subroutine move_list(from, to)
    type(integer_list), intent(inout) :: from, to

    to%count = from%count
    call move_alloc(from%item, to%item)
  end subroutine move_list

  !> Add a member, or a range: its first and last label, GENERATED and the step. Of a set that takes members of others
  !> only a new one.
  pure subroutine append(self, label, face, line, file, status)
    class(draft_set), intent(inout) :: self
    integer, intent(in) :: label, face, line, file
    integer, intent(inout) :: status
    logical :: is_known

    is_known = .false.
    if (self%tracked) call self%is_known(label, face, line, file, is_known, status)
    if (is_known) return
    call self%label%append(label, status)
    call self%face%append(face, status)
    call self%line%append(line, status)
    call self%file%append(file, status)
  end subroutine append

  !> Was there such a member? It is kept as one in any case.
  pure subroutine is_known(self, label, face, line, file, known, status)
    class(draft_set), intent(inout) :: self
    integer, intent(in) :: label, face, line, file
    logical, intent(out) :: known
    integer, intent(inout) :: status
    integer :: before, number, range

    known = .false.
    if (status /= 0) return
    before = self%known%count
    range = 0
    if (line == GENERATED) call self%ranges%number_of(face, file, range, status)
    ! Faces are never so far below 0.
    if (status == 0) call self%known%number_of(label, merge(-100 - range, face, line == GENERATED), number, status)
    known = self%known%count == before
  end subroutine is_known

  !> From now on each member is taken once.
  pure subroutine track(self, status)
    class(draft_set), intent(inout) :: self
    integer, intent(inout) :: status
    logical :: known
    integer :: k

    if (self%tracked) return
    do k = 1, self%label%count
      call self%is_known(self%label%item(k), self%face%item(k), self%line%item(k), self%file%item(k), known, status)
    end do
    self%tracked = status == 0
  end subroutine track

  !> The set takes the members of the set `other`, which has `count`, in a mesh whose `state` is a number that changes
  !> with what they mean: those from number `first` on are new.
  pure subroutine begin_taking(self, other, face, count, state, first, status)
    class(draft_set), intent(inout) :: self
    integer, intent(in) :: other, face, count, state
    integer, intent(out) :: first
    integer, intent(inout) :: status
    integer :: before, number

    first = 1
    call self%track(status)
    if (status /= 0) return
    before = self%sources%count
    call self%sources%number_of(other, face, number, status)
    if (number > before) then
      call self%taken%append(0, status)
      call self%state%append(state, status)
    end if
    if (status /= 0) return
    if (self%state%item(number) == state) first = self%taken%item(number) + 1
    self%taken%item(number) = count
    self%state%item(number) = state
  end subroutine begin_taking

  !> Ascending labels first, first + step, .. , last that a table has. Time and memory are those of the table, or of the
  !> range if that is shorter.
  pure subroutine labels_in_range(table, first, last, step, labels, status)
    type(row_table), intent(in) :: table
    integer, intent(in) :: first, last, step
    type(integer_list), intent(out) :: labels
    integer, intent(inout) :: status
    integer, allocatable :: order(:)
    integer :: k

    if ((last - first)/step <= table%count) then
      do k = 0, (last - first)/step
        if (table%find(first + k*step, 0) > 0) call labels%append(first + k*step, status)
      end do
      return
    end if
    do k = 1, table%count
      if (table%node(k) < first .or. table%node(k) > last) cycle
      if (modulo(table%node(k) - first, step) == 0) call labels%append(table%node(k), status)
    end do
    if (labels%count < 2 .or. status /= 0) return
    allocate (order(labels%count), stat=status)
    if (status /= 0) return
    order = [(k, k=1, labels%count)]
    call heap_sort(real(labels%item(:labels%count), dp), order)
    labels%item(:labels%count) = labels%item(order)
  end subroutine labels_in_range

end module fuge_draft_sets
