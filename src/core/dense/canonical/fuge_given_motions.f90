!> The motions that a caller gives, free ones and prescribed ones, and the rows of the modes at excluded points: what is
!> needed to get from the orthogonal modes of the dense engines to the caller's.
module fuge_given_motions
  use fuge_kinds, only: dp
  use fuge_orthogonal_modes, only: mode_change
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, require_memory
  use fuge_stops_and_limits, only: stops_and_limits
  implicit none
  private

  type, extends(stops_and_limits), public :: given_motions
    !> The ranks that share the points; the arrays are those of this one.
    type(point_space) :: space = point_space()
    !> Positions of the free modes among all, and how to get from the orthogonal ones to those given.
    integer, allocatable :: free(:)
    type(mode_change) :: change = mode_change()
    !> Columns of R whose motion is prescribed, (n, m), zero where free; not allocated if there are none.
    real(dp), allocatable, private :: prescribed_modes(:, :)
    logical, allocatable, private :: prescribed(:)
    !> Excluded points and their rows of R: the orthogonal modes are zero there.
    integer, allocatable, private :: excluded_points(:)
    real(dp), allocatable, private :: excluded_rows(:, :)
  contains
    procedure :: set_motions
    procedure :: has_motions
    procedure :: mode_count
    procedure :: to_given_modes
    procedure :: dominant_mode
    procedure :: transform_change
    procedure :: largest_loads
    procedure :: set_excluded_gaps
    procedure :: set_excluded_gaps_from
  end type given_motions

contains

  !> Set the motions of a checked problem, and subtract the displacements by the prescribed ones from the gaps (n); all
  !> else but `change` is set before. Error: FUGE_ERR_MEMORY.
  subroutine set_motions(self, problem, gap, info)
    class(given_motions), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(inout) :: gap(:)
    type(fuge_info), intent(inout) :: info

    call allocate_rows(self, problem, info)
    if (info%failed()) return
    call apply_prescribed(self, problem, gap)
    call collect_excluded(self, problem)
  end subroutine set_motions

  !> Have the motions of a problem been set?
  pure function has_motions(self)
    class(given_motions), intent(in) :: self
    logical :: has_motions

    has_motions = allocated(self%excluded_rows)
  end function has_motions

  !> Allocate the rows and columns of R that are kept. Error: FUGE_ERR_MEMORY.
  subroutine allocate_rows(self, problem, info)
    class(given_motions), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: excluded, m, n, stat

    n = problem%points()
    m = problem%mode_count()
    excluded = count(self%excluded)
    allocate (self%prescribed(m), self%excluded_points(excluded), self%excluded_rows(excluded, m), &
              stat=stat)
    if (stat == 0 .and. allocated(problem%prescribed)) allocate (self%prescribed_modes(n, m), stat=stat)
    call require_memory(stat, 'the motions of', n, 'points', info)
    call self%space%agree(info)
  end subroutine allocate_rows

  !> Subtract the displacements by the prescribed motions from the gaps (n).
  pure subroutine apply_prescribed(self, problem, gap)
    class(given_motions), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(inout) :: gap(:)
    integer :: j

    self%prescribed = .false.
    if (.not. allocated(problem%prescribed)) return
    self%prescribed = problem%prescribed
    self%prescribed_modes = 0.0_dp
    do j = 1, problem%mode_count()
      if (.not. problem%prescribed(j)) cycle
      self%prescribed_modes(:, j) = 1.0_dp
      if (allocated(problem%modes)) self%prescribed_modes(:, j) = problem%modes(:, j)
      gap = gap - problem%motion(j)*self%prescribed_modes(:, j)
    end do
  end subroutine apply_prescribed

  !> Keep the rows of R at the excluded points.
  pure subroutine collect_excluded(self, problem)
    class(given_motions), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    integer :: k, row

    self%excluded_rows = 1.0_dp
    row = 0
    do k = 1, size(self%excluded)
      if (.not. self%excluded(k)) cycle
      row = row + 1
      self%excluded_points(row) = k
      if (allocated(problem%modes)) self%excluded_rows(row, :) = problem%modes(k, :)
    end do
  end subroutine collect_excluded

  !> Number of modes, prescribed ones included.
  pure function mode_count(self) result(m)
    class(given_motions), intent(in) :: self
    integer :: m

    m = 0
    if (allocated(self%prescribed)) m = size(self%prescribed)
  end function mode_count

  !> All motions in the caller's modes and order, `motion` (m): the free ones from `free_motion` in the orthogonal
  !> modes, the prescribed ones from `prescribed_motion` (m).
  subroutine to_given_modes(self, prescribed_motion, free_motion, motion)
    class(given_motions), intent(in) :: self
    real(dp), intent(in) :: prescribed_motion(:), free_motion(:)
    real(dp), intent(out) :: motion(:)

    motion = merge(prescribed_motion, 0.0_dp, self%prescribed)
    motion(self%free) = self%change%given_motion(free_motion)
  end subroutine to_given_modes

  !> The number, among the caller's modes, of the one that contributes most to a motion in the orthogonal modes.
  function dominant_mode(self, free_motion) result(mode)
    class(given_motions), intent(in) :: self
    real(dp), intent(in) :: free_motion(:)
    integer :: mode

    mode = self%free(maxloc(self%change%contributions(free_motion), dim=1))
  end function dominant_mode

  !> Changes of gaps (n) and of resultants or prescribed motions (m), as changes of the gaps and loads of the canonical
  !> problem. Error: FUGE_ERR_MEMORY.
  subroutine transform_change(self, gap_change, load_change, reduced_gap, load, info)
    class(given_motions), intent(in) :: self
    real(dp), intent(in) :: gap_change(:), load_change(:)
    real(dp), allocatable, intent(out) :: reduced_gap(:), load(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: rigid(:)
    integer :: stat

    allocate (reduced_gap(size(gap_change)), load(size(self%free)), stat=stat)
    if (stat == 0 .and. allocated(self%prescribed_modes)) allocate (rigid(size(gap_change)), stat=stat)
    call require_memory(stat, 'changes of', size(gap_change), 'gaps', info)
    call self%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    reduced_gap = gap_change
    if (allocated(self%prescribed_modes)) then
      rigid = matmul(self%prescribed_modes, merge(load_change, 0.0_dp, self%prescribed))
      reduced_gap = reduced_gap - rigid
    end if
    call self%change%orthogonal_load(load_change(self%free), load)
  end subroutine transform_change

  !> The largest loads of the canonical problem for resultants up to `load` (m), of any sign.
  function largest_loads(self, load) result(largest)
    class(given_motions), intent(in) :: self
    real(dp), intent(in) :: load(:)
    real(dp) :: largest(size(self%free))
    real(dp) :: unit(size(self%free)), change(size(self%free))
    integer :: j

    largest = 0.0_dp
    do j = 1, size(largest)
      unit = 0.0_dp
      unit(j) = load(self%free(j))
      call self%change%orthogonal_load(unit, change)
      largest = largest + abs(change)
    end do
  end function largest_loads

  !> Set the gaps c = g + A f - R q at the excluded points, of `gap` g (n), `force` (n) and all motions (m), or of
  !> changes of these.
  pure subroutine set_excluded_gaps(self, alpha, gap, force, motion, gap_out)
    class(given_motions), intent(in) :: self
    real(dp), intent(in) :: alpha(:, :), gap(:), force(:), motion(:)
    real(dp), intent(inout) :: gap_out(:)
    integer :: k

    do k = 1, size(self%excluded_points)
      associate (point => self%excluded_points(k))
        gap_out(point) = gap(point) + sum(alpha(point, :)*force) - sum(self%excluded_rows(k, :)*motion)
      end associate
    end do
  end subroutine set_excluded_gaps

  !> As `set_excluded_gaps`, from the displacements A f (n).
  pure subroutine set_excluded_gaps_from(self, displacement, gap, motion, gap_out)
    class(given_motions), intent(in) :: self
    real(dp), intent(in) :: displacement(:), gap(:), motion(:)
    real(dp), intent(inout) :: gap_out(:)
    integer :: k

    do k = 1, size(self%excluded_points)
      associate (point => self%excluded_points(k))
        gap_out(point) = (gap(point) + displacement(point)) - sum(self%excluded_rows(k, :)*motion)
      end associate
    end do
  end subroutine set_excluded_gaps_from

end module fuge_given_motions
