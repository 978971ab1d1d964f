!> u - atan(u), by which an angle falls short of its tangent, without cancellation.
module fuge_arc_excess
  use fuge_kinds, only: dp
  implicit none
  private

  public :: arc_excess, arc_excesses

  !> Terms of the series, whose argument is at most tan(pi/8)**2 = 0.172.
  integer, parameter :: TERMS = 20

contains

  !> u - atan(u) of each u in 0 .. 1, accurate to rounding.
  !>
  !> With u = 2 s/(1 - s**2), so that atan(u) = 2 atan(s), it is 2 s**3/(1 - s**2) + 2 (s - atan(s)): both are positive,
  !> and the series of s - atan(s) converges quickly. Each term is computed for the whole array, so that it is
  !> vectorised.
  pure subroutine arc_excesses(n, u, excess)
    integer, intent(in) :: n
    real(dp), intent(in) :: u(n)
    real(dp), intent(out) :: excess(n)
    integer :: j, k
    real(dp), parameter :: COEFFICIENT(0:TERMS) = [((-1)**k/real(2*k + 3, dp), k=0, TERMS)]
    real(dp) :: s(n), square(n)

    do j = 1, n
      s(j) = u(j)/(1.0_dp + sqrt(1.0_dp + u(j)**2))
      square(j) = s(j)**2
      excess(j) = COEFFICIENT(TERMS)
    end do
    do k = TERMS - 1, 0, -1
      do j = 1, n
        excess(j) = excess(j)*square(j) + COEFFICIENT(k)
      end do
    end do
    do j = 1, n
      excess(j) = 2.0_dp*s(j)*square(j)*(1.0_dp/(1.0_dp - square(j)) + excess(j))
    end do
  end subroutine arc_excesses

  !> The same of one u.
  pure function arc_excess(u) result(excess)
    real(dp), intent(in) :: u
    real(dp) :: excess
    real(dp) :: one(1)

    call arc_excesses(1, [u], one)
    excess = one(1)
  end function arc_excess

end module fuge_arc_excess
