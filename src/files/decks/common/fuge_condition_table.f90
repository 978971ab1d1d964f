!> Forces or supports of a load case while they are collected: one value for each degree of freedom.
module fuge_condition_table
  use fuge_deck_type, only: fuge_deck_value, place_text
  use fuge_growing_arrays, only: make_room
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_row_table, only: row_table
  implicit none
  private

  public :: DIRECTION_NAMES

  !> Directions 1 to 6 for messages.
  character(len=*), parameter :: DIRECTION_NAMES(6) = [character(len=7) :: 'x', 'y', 'z', 'about x', 'about y', &
    'about z']

  !> Values at degrees of freedom. Each has the number of the step that gave it: a value of a later step takes the place
  !> of that of an earlier one.
  type, public :: condition_table
    type(row_table), private :: names
    real(dp), allocatable, private :: value(:)
    !> File, line and step.
    integer, allocatable, private :: origin(:, :)
  contains
    procedure :: add
    procedure :: hold
    procedure :: displace
    procedure :: copy_to
    procedure, private :: place_of
  end type condition_table

contains

  !> The row of a degree of freedom, `is_new` if it has none yet and gets one with the value 0 of step 0.
  pure subroutine place_of(self, node, direction, row, is_new, status)
    class(condition_table), intent(inout) :: self
    integer, intent(in) :: node, direction
    integer, intent(out) :: row
    logical, intent(out) :: is_new
    integer, intent(inout) :: status
    integer :: before

    row = 0
    is_new = .false.
    before = self%names%count
    if (.not. allocated(self%origin) .and. status == 0) allocate (self%origin(3, 0), stat=status)
    if (status == 0) call make_room(self%value, before, status)
    if (status == 0) call make_room(self%origin, before, status)
    if (status == 0) call self%names%number_of(node, direction, row, status)
    if (status /= 0) return
    is_new = row > before
    if (.not. is_new) return
    self%value(row) = 0.0_dp
    self%origin(:, row) = 0
  end subroutine place_of

  !> Add a force to those of the same step. `origin`: file, line, step. `status` is not zero without memory.
  pure subroutine add(self, node, direction, value, origin, status)
    class(condition_table), intent(inout) :: self
    integer, intent(in) :: node, direction, origin(3)
    real(dp), intent(in) :: value
    integer, intent(inout) :: status
    integer :: row
    logical :: is_new

    call self%place_of(node, direction, row, is_new, status)
    if (status /= 0) return
    if (self%origin(3, row) < origin(3)) self%value(row) = 0.0_dp
    self%value(row) = self%value(row) + value
    self%origin(:, row) = origin
  end subroutine add

  !> Prescribe a displacement; `reason` if the same step prescribes another one, with its place in one of the `paths`.
  pure subroutine hold(self, node, direction, value, origin, paths, reason, status)
    class(condition_table), intent(inout) :: self
    integer, intent(in) :: node, direction, origin(3)
    real(dp), intent(in) :: value
    character(len=*), intent(in) :: paths
    character(len=:), allocatable, intent(inout) :: reason
    integer, intent(inout) :: status
    character(len=:), allocatable :: place
    integer :: row
    logical :: is_new

    if (allocated(reason)) return
    call self%place_of(node, direction, row, is_new, status)
    if (status /= 0) return
    if (.not. is_new .and. self%origin(3, row) == origin(3) .and. abs(self%value(row) - value) > 0.0_dp) then
      call place_text(paths, self%origin(1, row), self%origin(2, row), place)
      reason = 'node '//text(node)//' is displaced by '//text(value)//' in direction '//text(direction) &
        //', but by '//text(self%value(row))//' in '//place
      return
    end if
    self%value(row) = value
    self%origin(:, row) = origin
  end subroutine hold

  !> Change the displacement of a degree of freedom that is held; `found` tells whether it is.
  pure subroutine displace(self, node, direction, value, found)
    class(condition_table), intent(inout) :: self
    integer, intent(in) :: node, direction
    real(dp), intent(in) :: value
    logical, intent(out) :: found
    integer :: row

    row = self%names%find(node, direction)
    found = row > 0
    if (found) self%value(row) = value
  end subroutine displace

  !> All values, in the order in which their degrees of freedom came first. `status` is not zero without memory.
  pure subroutine copy_to(self, values, status)
    class(condition_table), intent(in) :: self
    type(fuge_deck_value), allocatable, intent(out) :: values(:)
    integer, intent(inout) :: status
    integer :: k

    if (status /= 0) return
    allocate (values(self%names%count), stat=status)
    if (status /= 0) return
    do k = 1, size(values)
      values(k) = fuge_deck_value(self%names%node(k), self%names%direction(k), self%value(k), self%origin(2, k), &
                                  self%origin(1, k))
    end do
  end subroutine copy_to

end module fuge_condition_table
