!> The course of a contact along a line of loads: the type, and how entries are added.
module fuge_path_type
  use fuge_contact_states, only: FUGE_OPEN
  use fuge_growing_arrays, only: resize
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: append_entry, move_path, start_path, trim_path

  !> The events along a line of loads, in their order, after an entry for the start.
  !>
  !> Points that change together have an entry each; motion, rate and contacts are then those after all
  !> of them. The parameter is the load F_0 (force) for `fuge_load_path`, and runs from 0 to 1 for `fuge_follow_path`.
  type, public :: fuge_path
    !> Entries in use, the start included.
    integer :: entries = 0
    !> States at the start, (n): FUGE_AT_LOWER_STOP (tied points too), FUGE_OPEN, FUGE_AT_UPPER_STOP, or where the force
    !> has reached its limit FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER.
    integer, allocatable :: start(:)
    !> Parameter of each entry, ascending, 0 at the start.
    real(dp), allocatable :: parameter(:)
    !> The point that changes, 0 for the start, and its new state; or a point that touches without force, and its state,
    !> where only motions that nothing resists turn.
    integer, allocatable :: point(:), state(:)
    !> Points at a stop or at their limit from there on.
    integer, allocatable :: contacts(:)
    !> Motions q there, and dq/d(parameter) from there to the next entry, (m, entries), prescribed ones included. A
    !> motion that nothing resists may jump; the value is that after the jump. For `fuge_load_path` q is the approach
    !> v_0, and 1/rate the contact stiffness dF_0/dv_0.
    real(dp), allocatable :: motion(:, :), rate(:, :)
  contains
    procedure :: states
  end type fuge_path

contains

  !> States (n) of all points after an entry.
  pure function states(self, entry)
    class(fuge_path), intent(in) :: self
    integer, intent(in) :: entry
    integer :: states(size(self%start))
    integer :: k

    states = self%start
    do k = 1, min(entry, self%entries)
      if (self%point(k) > 0) states(self%point(k)) = self%state(k)
    end do
  end function states

  !> Begin a path with the states (n) at the start, and allocate some entries of m motions. `status`: FUGE_DONE or
  !> FUGE_ERR_MEMORY.
  pure subroutine start_path(state, m, path, status)
    integer, intent(in) :: state(:), m
    type(fuge_path), intent(out) :: path
    integer, intent(out) :: status
    integer :: stat

    allocate (path%start(size(state)), path%motion(m, 0), path%rate(m, 0), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    path%start = state
    call resize_path(path, size(state) + 8, status)
  end subroutine start_path

  !> Add an entry. `motion` and `rate` (m); `point` is 0 for the start. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  pure subroutine append_entry(path, parameter, point, state, motion, rate, status)
    type(fuge_path), intent(inout) :: path
    real(dp), intent(in) :: parameter, motion(:), rate(:)
    integer, intent(in) :: point, state(:)
    integer, intent(out) :: status

    status = FUGE_DONE
    if (path%entries == size(path%point)) call resize_path(path, 2*path%entries, status)
    if (status /= FUGE_DONE) return
    path%entries = path%entries + 1
    associate (last => path%entries)
      path%parameter(last) = parameter
      path%motion(:, last) = motion
      path%rate(:, last) = rate
      path%point(last) = point
      path%state(last) = FUGE_OPEN
      if (point > 0) path%state(last) = state(point)
      path%contacts(last) = count(state /= FUGE_OPEN)
    end associate
  end subroutine append_entry

  !> Free the memory beyond the last entry. `status`: FUGE_DONE or FUGE_ERR_MEMORY.
  pure subroutine trim_path(path, status)
    type(fuge_path), intent(inout) :: path
    integer, intent(out) :: status

    call resize_path(path, path%entries, status)
  end subroutine trim_path

  !> Replace `path` by another one, which is left empty.
  pure subroutine move_path(source, path)
    type(fuge_path), intent(inout) :: source, path

    path%entries = source%entries
    source%entries = 0
    call move_alloc(source%start, path%start)
    call move_alloc(source%parameter, path%parameter)
    call move_alloc(source%motion, path%motion)
    call move_alloc(source%rate, path%rate)
    call move_alloc(source%point, path%point)
    call move_alloc(source%state, path%state)
    call move_alloc(source%contacts, path%contacts)
  end subroutine move_path

  !> Change the number of entries for which there is memory, and keep those in use.
  pure subroutine resize_path(path, entries, status)
    type(fuge_path), intent(inout) :: path
    integer, intent(in) :: entries
    integer, intent(out) :: status
    integer :: stat

    stat = 0
    call resize(path%parameter, entries, stat)
    call resize(path%motion, entries, stat)
    call resize(path%rate, entries, stat)
    call resize(path%state, entries, stat)
    call resize(path%contacts, entries, stat)
    ! Last, because its length tells how many entries all of them have room for.
    call resize(path%point, entries, stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
  end subroutine resize_path

end module fuge_path_type
