!> The lengths and forces of the caller's data, with which a solution is compared.
module fuge_data_scales
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use fuge_point_space, only: point_space
  implicit none
  private

  public :: data_length, free_resultant, is_loaded, is_prescribed, largest_by_mode, largest_of_body

contains

  !> The lengths that the data have: the range of the gaps (their size, but for one translation that nothing holds)
  !> under the prescribed motions, the plays, and what the loads displace.
  !>
  !> Of the points that take part: `arms` (m), the largest displacement by a unit of each motion, 1 for one translation;
  !> `extremes`, the largest of the magnitude of a gap less the prescribed motions, of this gap, of minus this gap, of
  !> the terms of A f, and of the plays that are finite, -huge without any. `total` > 0 is the sum of the magnitudes of
  !> the forces that make these terms; loads that are smaller displace less.
  pure function data_length(problem, arms, extremes, total) result(length)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: arms(:), extremes(5), total
    real(dp) :: length
    real(dp) :: load
    integer :: j

    load = 0.0_dp
    do j = 1, size(arms)
      if (arms(j) > 0.0_dp) load = max(load, abs(free_resultant(problem, j))/arms(j))
    end do
    length = extremes(1)
    if (.not. allocated(problem%modes)) then
      if (.not. (is_prescribed(problem, 1) .or. any(problem%motions_on_springs()))) length = extremes(2) + extremes(3)
    end if
    length = max(length, extremes(5)) + min(load/total, 1.0_dp)*extremes(4)
  end function data_length

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

  !> Does a resultant other than zero act on point `k`, in some mode that moves it? `resultants` (m) as from
  !> `free_resultant`.
  pure function is_loaded(modes, resultants, k) result(loaded)
    real(dp), intent(in) :: modes(:, :), resultants(:)
    integer, intent(in) :: k
    logical :: loaded
    integer :: j

    loaded = .false.
    do j = 1, size(resultants)
      loaded = abs(modes(k, j)) > 0.0_dp .and. abs(resultants(j)) > 0.0_dp
      if (loaded) return
    end do
  end function is_loaded

  !> Is the motion in this mode prescribed instead of its resultant?
  pure function is_prescribed(problem, mode) result(prescribed)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: mode
    logical :: prescribed

    prescribed = .false.
    if (.not. allocated(problem%prescribed)) return
    ! The caller's array may begin with another number than 1.
    prescribed = problem%prescribed(lbound(problem%prescribed, 1) + mode - 1)
  end function is_prescribed

  !> The resultant in this mode; 0 where its motion is prescribed.
  pure function free_resultant(problem, mode) result(resultant)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: mode
    real(dp) :: resultant

    resultant = 0.0_dp
    if (.not. is_prescribed(problem, mode)) resultant = problem%resultant(lbound(problem%resultant, 1) + mode - 1)
  end function free_resultant

end module fuge_data_scales
