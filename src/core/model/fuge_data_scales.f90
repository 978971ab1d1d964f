!> The lengths and forces of the caller's data, with which a solution is compared.
module fuge_data_scales
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use fuge_point_space, only: point_space
  implicit none
  private

  public :: data_length, is_loaded, is_prescribed, largest_by_mode, largest_of_body

contains

  !> The lengths that the data have: the range of the gaps (their size, but for one translation) under the prescribed
  !> motions, the plays, and what the loads displace.
  !>
  !> `force` (n), not all zero, makes the terms `elastic` (n) of A f; loads that are smaller displace less. `included`
  !> (n) marks the points that take part. `space` may share the points.
  function data_length(problem, force, elastic, included, space) result(length)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:), elastic(:)
    logical, intent(in) :: included(:)
    type(point_space), intent(in) :: space
    real(dp) :: length
    real(dp) :: extremes(4), gap, load, arm
    integer :: j, k

    load = 0.0_dp
    do j = 1, problem%mode_count()
      arm = 1.0_dp
      if (allocated(problem%modes)) arm = space%largest(maxval(abs(problem%modes(:, j)), mask=included))
      if (is_prescribed(problem, j)) cycle
      if (arm > 0.0_dp) load = max(load, abs(problem%resultant(j))/arm)
    end do
    extremes = -huge(extremes)
    do k = 1, size(elastic)
      if (.not. included(k)) cycle
      gap = gap_less_motions(problem, k)
      extremes = max(extremes, [abs(gap), gap, -gap, elastic(k)])
    end do
    call space%raise(extremes)
    length = extremes(1)
    if (.not. allocated(problem%modes)) then
      if (.not. is_prescribed(problem, 1)) length = extremes(2) + extremes(3)
    end if
    if (allocated(problem%gap_upper)) length = max(length, &
      space%largest(maxval(problem%gap_upper, mask=included .and. problem%gap_upper < huge(length))))
    length = length + min(load/space%total(sum(abs(force))), 1.0_dp)*extremes(4)
  end function data_length

  !> The gap of point `k` less the displacements by the prescribed motions.
  pure function gap_less_motions(problem, k) result(gap)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: k
    real(dp) :: gap
    integer :: j

    gap = problem%gap(k)
    if (.not. allocated(problem%prescribed)) return
    do j = 1, problem%mode_count()
      if (.not. is_prescribed(problem, j)) cycle
      if (allocated(problem%modes)) then
        gap = gap - problem%modes(k, j)*problem%motion(j)
      else
        gap = gap - problem%motion(j)
      end if
    end do
  end function gap_less_motions

  !> For each mode, the largest magnitude of `values` (n) at the points that it moves, (m), for `largest_of_body`.
  !> Ranks, `sharing`, may share the points.
  function largest_by_mode(modes, values, sharing) result(largest)
    real(dp), intent(in) :: modes(:, :), values(:)
    type(point_space), intent(in), optional :: sharing
    real(dp) :: largest(size(modes, 2))
    integer :: j

    largest = [(maxval(abs(values), mask=abs(modes(:, j)) > 0.0_dp), j=1, size(largest))]
    if (present(sharing)) call sharing%raise(largest)
  end function largest_by_mode

  !> The largest magnitude among the points that some mode moves together with point `k`; 0 if no mode moves it.
  !> `by_mode` (m) as from `largest_by_mode`.
  pure function largest_of_body(modes, by_mode, k) result(largest)
    real(dp), intent(in) :: modes(:, :), by_mode(:)
    integer, intent(in) :: k
    real(dp) :: largest
    integer :: j

    largest = 0.0_dp
    do j = 1, size(by_mode)
      if (abs(modes(k, j)) > 0.0_dp) largest = max(largest, by_mode(j))
    end do
  end function largest_of_body

  !> Does a resultant other than zero act on point `k`, in some free mode that moves it?
  pure function is_loaded(problem, k) result(loaded)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: k
    logical :: loaded
    integer :: j

    loaded = .false.
    do j = 1, size(problem%modes, 2)
      if (.not. abs(problem%modes(k, j)) > 0.0_dp) cycle
      if (is_prescribed(problem, j)) cycle
      loaded = abs(problem%resultant(j)) > 0.0_dp
      if (loaded) return
    end do
  end function is_loaded

  !> Is the motion in this mode prescribed instead of its resultant?
  pure function is_prescribed(problem, mode) result(prescribed)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: mode
    logical :: prescribed

    prescribed = .false.
    if (allocated(problem%prescribed)) prescribed = problem%prescribed(mode)
  end function is_prescribed

end module fuge_data_scales
