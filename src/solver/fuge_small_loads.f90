!> Problems whose loads are so small that what they displace is lost beside the lengths, or leaves the range of double
!> precision.
!>
!> A contact problem is homogeneous: s times all lengths and loads give s times the solution. And where displacements
!> are far below the rounding of the lengths, as if the bodies were rigid, forces are proportional to the loads alone.
!> So such a problem has the forces of one with larger loads, which the engines can solve. All factors are powers of
!> two, which round nothing.
module fuge_small_loads
  use fuge_constants, only: LARGEST_EXPONENT_OF_2
  use fuge_data_scales, only: data_length, is_prescribed
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_ranks, only: shared_ranks
  implicit none
  private

  public :: has_translation, lower_solution, place_body, raise_loads

  !> Lengths and loads below 2**LEAST_EXPONENT have squares that leave the range.
  integer, parameter :: LEAST_EXPONENT = 16 - LARGEST_EXPONENT_OF_2

  !> From a problem to the one with raised loads.
  type, public :: load_scaling
    !> Lengths were multiplied by 2**lengths, loads by 2**loads >= 2**lengths.
    integer :: lengths = 0, loads = 0
    !> What was subtracted from the gaps before; length.
    real(dp) :: datum = 0.0_dp
  end type load_scaling

contains

  !> The problem with larger loads, `raised`; `is_raised` is false if they need not be larger.
  !>
  !> `most_ratio`: as a power of two, how often lengths may contain the load. Where plays or prescribed motions make
  !> forces too, loads beyond that ratio are nothing beside these forces: they are left out. The arrays of `raised` are
  !> its own; without memory for them `is_raised` is false.
  subroutine raise_loads(problem, ranks, most_ratio, raised, scaling, is_raised)
    type(fuge_problem), intent(in) :: problem
    type(shared_ranks), intent(in) :: ranks
    integer, intent(in) :: most_ratio
    type(fuge_problem), intent(out) :: raised
    type(load_scaling), intent(out) :: scaling
    logical, intent(out) :: is_raised
    real(dp) :: length, load
    integer :: excess, largest, stat

    is_raised = .false.
    call measure(problem, ranks, length, load, stat)
    if (ranks%anywhere(stat /= 0) .or. .not. load > 0.0_dp) return
    largest = exponent(load)
    if (length > 0.0_dp) largest = max(largest, exponent(length))
    excess = max(largest - exponent(load) - most_ratio, 0)
    if (largest < LEAST_EXPONENT) scaling%lengths = -largest
    scaling%loads = scaling%lengths + excess
    if (scaling%loads == 0) return
    call copy_problem(problem, raised, stat)
    if (ranks%anywhere(stat /= 0)) return
    if (has_translation(problem)) scaling%datum = ranks%least(lowest_gap(problem))
    raised%gap = scale(problem%gap - scaling%datum, scaling%lengths)
    if (allocated(raised%gap_upper)) then
      where (raised%gap_upper < huge(length)) raised%gap_upper = scale(raised%gap_upper, scaling%lengths)
    end if
    if (allocated(raised%motion)) raised%motion = scale(raised%motion, scaling%lengths)
    if (excess > 0 .and. (allocated(problem%gap_upper) .or. allocated(problem%prescribed))) then
      raised%resultant = 0.0_dp
      scaling%loads = scaling%lengths
    else
      raised%resultant = scale(raised%resultant, scaling%loads)
    end if
    is_raised = .true.
  end subroutine raise_loads

  !> A copy with checked allocations; `stat` is not 0 without memory.
  pure subroutine copy_problem(problem, copy, stat)
    type(fuge_problem), intent(in) :: problem
    type(fuge_problem), intent(inout) :: copy
    integer, intent(out) :: stat

    allocate (copy%gap, source=problem%gap, stat=stat)
    if (stat == 0) allocate (copy%resultant, source=problem%resultant, stat=stat)
    if (stat == 0 .and. allocated(problem%gap_upper)) allocate (copy%gap_upper, source=problem%gap_upper, stat=stat)
    if (stat == 0 .and. allocated(problem%excluded)) allocate (copy%excluded, source=problem%excluded, stat=stat)
    if (stat == 0 .and. allocated(problem%modes)) allocate (copy%modes, source=problem%modes, stat=stat)
    if (stat == 0 .and. allocated(problem%prescribed)) allocate (copy%prescribed, source=problem%prescribed, stat=stat)
    if (stat == 0 .and. allocated(problem%motion)) allocate (copy%motion, source=problem%motion, stat=stat)
  end subroutine copy_problem

  !> The largest length of the data, and the largest load; 0 where no point takes part. `stat` is not 0 without memory.
  subroutine measure(problem, ranks, length, load, stat)
    type(fuge_problem), intent(in) :: problem
    type(shared_ranks), intent(in) :: ranks
    real(dp), intent(out) :: length, load
    integer, intent(out) :: stat
    real(dp), allocatable :: none(:), unit(:)
    logical, allocatable :: included(:)
    real(dp) :: arm
    integer :: j, n

    length = 0.0_dp
    load = 0.0_dp
    n = problem%points()
    allocate (none(n), unit(n), included(n), stat=stat)
    if (ranks%anywhere(stat /= 0)) return
    included = .true.
    if (allocated(problem%excluded)) included = .not. problem%excluded
    if (.not. ranks%anywhere(any(included))) return
    none = 0.0_dp
    unit = 1.0_dp
    length = data_length(problem, unit, none, included, ranks)
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) cycle
      arm = 1.0_dp
      if (allocated(problem%modes)) arm = maxval(abs(problem%modes(:, j)), mask=included)
      if (arm > 0.0_dp) load = max(load, abs(problem%resultant(j))/arm)
    end do
  end subroutine measure

  !> The least gap of the points that are not excluded; huge without points.
  pure function lowest_gap(problem) result(lowest)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: lowest
    integer :: k

    lowest = huge(lowest)
    do k = 1, problem%points()
      if (takes_part(problem, k)) lowest = min(lowest, problem%gap(k))
    end do
  end function lowest_gap

  !> One free translation of all points: a constant in the gaps changes its motion only.
  pure function has_translation(problem)
    type(fuge_problem), intent(in) :: problem
    logical :: has_translation

    has_translation = .not. (allocated(problem%modes) .or. is_prescribed(problem, 1))
  end function has_translation

  !> Is point `k` not excluded?
  pure function takes_part(problem, k)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: k
    logical :: takes_part

    takes_part = .true.
    if (allocated(problem%excluded)) takes_part = .not. problem%excluded(k)
  end function takes_part

  !> From the solution of the raised problem to that of the given one, in place: its size.
  !>
  !> `change`: the derivative of the raised solution by its loads, times these; not allocated where it is not known.
  !> It takes back what the loads in excess displace.
  pure subroutine lower_solution(scaling, problem, solution, change)
    type(load_scaling), intent(in) :: scaling
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(inout) :: solution
    type(fuge_solution), intent(in) :: change
    real(dp) :: excess
    integer :: k

    if (allocated(change%gap)) then
      excess = 1.0_dp - scale(1.0_dp, scaling%lengths - scaling%loads)
      do k = 1, size(solution%gap)
        if (.not. takes_part(problem, k)) then
          solution%gap(k) = solution%gap(k) - excess*change%gap(k)
        else if (solution%gap(k) > 0.0_dp) then
          solution%gap(k) = max(solution%gap(k) - excess*change%gap(k), 0.0_dp)
        end if
      end do
      solution%motion = solution%motion - excess*change%motion
    end if
    solution%force = scale(solution%force, -scaling%loads)
    solution%gap = scale(solution%gap, -scaling%lengths)
    solution%motion = scale(solution%motion, -scaling%lengths)
    if (has_translation(problem)) solution%motion = solution%motion + scaling%datum
    if (allocated(problem%prescribed)) where (problem%prescribed) solution%motion = problem%motion
  end subroutine lower_solution

  !> For one translation: gaps and approach from the forces, whose `displacement` (n), length, is that by the given
  !> operator. The contact point with the largest force tells the approach.
  subroutine place_body(problem, displacement, ranks, solution)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: displacement(:)
    type(shared_ranks), intent(in) :: ranks
    type(fuge_solution), intent(inout) :: solution
    real(dp) :: key, reference(2)
    integer :: k

    k = maxloc(solution%force, dim=1)
    key = huge(key)
    reference = 0.0_dp
    if (k > 0) then
      key = -solution%force(k)
      reference = [problem%gap(k), displacement(k)]
    end if
    call ranks%take_from_least(key, reference)
    solution%motion = reference(1) + reference(2)
    do k = 1, size(displacement)
      if (solution%force(k) > 0.0_dp) cycle
      solution%gap(k) = (problem%gap(k) - reference(1)) + (displacement(k) - reference(2))
      if (takes_part(problem, k)) solution%gap(k) = max(solution%gap(k), 0.0_dp)
    end do
  end subroutine place_body

end module fuge_small_loads
