!> How exact rigid motions are: the rounding of modes in gaps and resultants, and that of gaps less prescribed motions.
!>
!> Engines solve with modes that they made orthogonal, and with gaps less the prescribed motions. Where modes nearly
!> agree, the point of reference is far away, or motions are far larger than displacements, the rounding of these is the
!> largest error of the forces.
module fuge_motion_rounding
  use fuge_compensated_sums, only: difference_rounding
  use fuge_data_scales, only: is_prescribed
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use fuge_point_space, only: point_space
  implicit none
  private

  public :: exact_modes, gap_rounding_at, load_rounding, mode_rounding_at

contains

  !> Which modes are not rounded, (m): those with entries that are 0 or one other value, and constant on their body. A
  !> mode that is not constant changes when modes are made orthogonal, whatever its entries. `sharing`: the ranks that
  !> share the points.
  function exact_modes(problem, sharing) result(exact)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in), optional :: sharing
    logical :: exact(problem%mode_count())
    type(point_space) :: space
    real(dp) :: extremes(2)
    integer :: j, k

    exact = .true.
    if (.not. allocated(problem%modes)) return
    if (present(sharing)) space = sharing
    do j = 1, size(exact)
      associate (mode => problem%modes(:, j))
        extremes = [maxval(mode, mask=abs(mode) > 0.0_dp), -minval(mode, mask=abs(mode) > 0.0_dp)]
      end associate
      call space%raise(extremes)
      exact(j) = extremes(1) <= -extremes(2)
      do k = 1, size(exact)
        if (k /= j .and. exact(j)) exact(j) = is_constant_beside(problem%modes(:, j), problem%modes(:, k), space)
      end do
    end do
  end function exact_modes

  !> Does a mode move either no point that the `other` one moves, or all of them?
  function is_constant_beside(mode, other, space) result(constant)
    real(dp), intent(in) :: mode(:), other(:)
    type(point_space), intent(in) :: space
    logical :: constant
    real(dp) :: found(2)
    integer :: k

    found = 0.0_dp
    do k = 1, size(mode)
      if (abs(other(k)) > 0.0_dp) found(merge(1, 2, abs(mode(k)) > 0.0_dp)) = 1.0_dp
    end do
    call space%raise(found)
    constant = .not. all(found > 0.0_dp)
  end function is_constant_beside

  !> How much the last digits of the modes change the gap of point `k`, length, under `motion` (m); `exact` (m) as from
  !> `exact_modes`.
  pure function mode_rounding_at(problem, exact, motion, k) result(length)
    type(fuge_problem), intent(in) :: problem
    logical, intent(in) :: exact(:)
    real(dp), intent(in) :: motion(:)
    integer, intent(in) :: k
    real(dp) :: length
    integer :: j

    length = 0.0_dp
    do j = 1, size(motion)
      if (.not. exact(j)) length = length + epsilon(length)*abs(problem%modes(k, j)*motion(j))
    end do
  end function mode_rounding_at

  !> How much the last digits of the modes change the resultants of `force` (n), (m); nothing where a motion is
  !> prescribed.
  function load_rounding(problem, exact, force, sharing) result(load)
    type(fuge_problem), intent(in) :: problem
    logical, intent(in) :: exact(:)
    real(dp), intent(in) :: force(:)
    type(point_space), intent(in), optional :: sharing
    real(dp) :: load(size(exact))
    integer :: j

    load = 0.0_dp
    do j = 1, size(exact)
      if (exact(j) .or. is_prescribed(problem, j)) cycle
      load(j) = epsilon(load)*sum(abs(problem%modes(:, j)*force))
    end do
    if (present(sharing)) call sharing%add(load)
  end function load_rounding

  !> The rounding error of the gap of point `k` less the prescribed motions, subtracted one after the other; without the
  !> rounding of the products.
  pure function gap_rounding_at(problem, k) result(rounding)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: k
    real(dp) :: rounding
    real(dp) :: gap, displacement, rest
    integer :: j

    rounding = 0.0_dp
    gap = problem%gap(k)
    do j = 1, problem%mode_count()
      if (.not. is_prescribed(problem, j)) cycle
      displacement = problem%motion(j)
      if (allocated(problem%modes)) displacement = problem%motion(j)*problem%modes(k, j)
      rest = gap - displacement
      rounding = rounding + difference_rounding(gap, displacement, rest)
      gap = rest
    end do
  end function gap_rounding_at

end module fuge_motion_rounding
