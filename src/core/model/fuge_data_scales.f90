!> What an answer is compared with: lengths and forces that the caller's data have.
module fuge_data_scales
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use fuge_point_space, only: point_space
  implicit none
  private

  public :: data_length, is_loaded, is_prescribed, largest_of_bodies

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
    real(dp) :: gap(size(elastic)), extremes(4), load, arm
    integer :: j

    gap = problem%gap
    load = 0.0_dp
    do j = 1, problem%mode_count()
      arm = 1.0_dp
      if (allocated(problem%modes)) arm = space%largest(maxval(abs(problem%modes(:, j)), mask=included))
      if (.not. is_prescribed(problem, j)) then
        if (arm > 0.0_dp) load = max(load, abs(problem%resultant(j))/arm)
      else if (allocated(problem%modes)) then
        gap = gap - problem%modes(:, j)*problem%motion(j)
      else
        gap = gap - problem%motion(j)
      end if
    end do
    extremes = [maxval(abs(gap), mask=included), maxval(gap, mask=included), -minval(gap, mask=included), &
                maxval(elastic, mask=included)]
    call space%raise(extremes)
    length = extremes(1)
    if (.not. allocated(problem%modes)) then
      if (.not. is_prescribed(problem, 1)) length = extremes(2) + extremes(3)
    end if
    if (allocated(problem%gap_upper)) length = max(length, &
      space%largest(maxval(problem%gap_upper, mask=included .and. problem%gap_upper < huge(length))))
    length = length + min(load/space%total(sum(abs(force))), 1.0_dp)*extremes(4)
  end function data_length

  !> At each point, the largest of `values` (>= 0) among the points that some mode moves together
  !> with it; 0 for a point that no mode moves. Ranks, `sharing`, may share the points.
  function largest_of_bodies(modes, values, sharing) result(largest)
    real(dp), intent(in) :: modes(:, :), values(:)
    type(point_space), intent(in), optional :: sharing
    real(dp) :: largest(size(values)), of_mode(size(modes, 2))
    integer :: j

    of_mode = [(maxval(values, mask=abs(modes(:, j)) > 0.0_dp), j=1, size(of_mode))]
    if (present(sharing)) call sharing%raise(of_mode)
    largest = 0.0_dp
    do j = 1, size(modes, 2)
      where (abs(modes(:, j)) > 0.0_dp) largest = max(largest, of_mode(j))
    end do
  end function largest_of_bodies

  !> Does a resultant other than zero act on the point, (n), in some free mode that moves it?
  pure function is_loaded(problem) result(loaded)
    type(fuge_problem), intent(in) :: problem
    logical :: loaded(size(problem%modes, 1))
    integer :: j

    loaded = .false.
    do j = 1, size(problem%modes, 2)
      if (is_prescribed(problem, j)) cycle
      if (abs(problem%resultant(j)) > 0.0_dp) loaded = loaded .or. abs(problem%modes(:, j)) > 0.0_dp
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
