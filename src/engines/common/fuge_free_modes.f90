!> Rigid motions that contact does not hold: they are not unique, forces are.
module fuge_free_modes
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_pivoted_qr, only: orthogonal_complement
  use fuge_canonical_problem, only: canonical_problem
  implicit none
  private

  public :: find_loose, without_loose, find_free_way

  !> Rows of the modes that differ by less than this part are one.
  real(dp), parameter :: DEPENDENT = 1.0e-12_dp

  !> A force below this part of the loads that it may carry is rounding.
  real(dp), parameter :: NO_FORCE = 1.0e-14_dp

contains

  !> A way (m) in which the bodies of an answer can move without a change of force, or zero
  !> if there is none: the motions are unique then.
  !>
  !> `state` (n), `force` (n) and `gap` (n) of the answer in `canonical`.
  subroutine find_free_way(canonical, state, force, gap, way)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: force(:), gap(:)
    real(dp), intent(out) :: way(:)
    real(dp), allocatable :: base(:, :)
    real(dp) :: work(size(state))
    logical :: held(size(state)), pushes(size(state)), pulls(size(state))
    integer :: j

    way = 0.0_dp
    held = holds(canonical, state, force)
    call find_loose(canonical%modes, held, base)
    ! Points that touch without force bar one sense.
    pushes = held .or. ((state > 0 .or. gap <= 0.0_dp) .and. .not. canonical%excluded)
    pulls = held .or. ((state < 0 .or. gap >= canonical%upper) .and. .not. canonical%excluded)
    do j = 1, size(base, 2)
      call find_equilibrium(canonical%modes, base(:, j), pushes, pulls, work, way)
      if (any(abs(way) > 0.0_dp)) return
      call find_equilibrium(canonical%modes, -base(:, j), pushes, pulls, work, way)
      if (any(abs(way) > 0.0_dp)) return
    end do
  end subroutine find_free_way

  !> Points (n) that are tied, or that carry more force than rounding makes.
  pure function holds(canonical, state, force) result(held)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    real(dp), intent(in) :: force(:)
    logical :: held(size(state))
    real(dp) :: measure(size(state))
    integer :: j

    measure = 0.0_dp
    do j = 1, size(canonical%load)
      measure = max(measure, abs(canonical%modes(:, j)*canonical%load(j)))
    end do
    ! Without a load of its own a body may be squeezed between stops.
    where (.not. measure > 0.0_dp) measure = maxval(abs(force))
    held = state /= 0 .and. (abs(force) > NO_FORCE*measure .or. .not. canonical%upper > 0.0_dp)
  end function holds

  !> An orthonormal base of the motions q with R q = 0 at the points `held` (n).
  !>
  !> `modes` R (n, m) with columns of about the same size; `base` (m, number of loose motions).
  subroutine find_loose(modes, held, base)
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: held(:)
    real(dp), allocatable, intent(out) :: base(:, :)
    real(dp) :: rows(size(modes, 2), count(held))
    integer :: j, status

    rows = transpose(modes(pack([(j, j=1, size(held))], held), :))
    ! Without memory no motion counts as loose.
    call orthogonal_complement(rows, DEPENDENT, base, status)
  end subroutine find_loose

  !> The motion (m) less its part in the `base` of the loose ones.
  pure function without_loose(motion, base) result(rest)
    real(dp), intent(in) :: motion(:), base(:, :)
    real(dp) :: rest(size(motion))
    integer :: j

    rest = motion
    do j = 1, size(base, 2)
      rest = rest - dot_product(base(:, j), motion)*base(:, j)
    end do
  end function without_loose

end module fuge_free_modes
