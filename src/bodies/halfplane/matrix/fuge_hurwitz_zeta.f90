!> The Hurwitz zeta function, for sums over periodic images.
module fuge_hurwitz_zeta
  use fuge_kinds, only: dp
  implicit none
  private

  public :: hurwitz_zeta

  !> B_2j/(2j)!, j = 1 .. 10, with the Bernoulli numbers B_2j.
  real(dp), parameter :: BERNOULLI(10) = [ &
    1.0_dp/12.0_dp, -1.0_dp/720.0_dp, 1.0_dp/30240.0_dp, -1.0_dp/1209600.0_dp, 1.0_dp/47900160.0_dp, &
    -691.0_dp/1307674368000.0_dp, 1.0_dp/74724249600.0_dp, -3617.0_dp/10670622842880000.0_dp, &
    43867.0_dp/5109094217170944000.0_dp, -174611.0_dp/802857662698291200000.0_dp]

contains

  !> zeta(s, a), the sum of (a + k)^-s over k = 0, 1, 2, ..., to rounding.
  !>
  !> `s` >= 2, `a` > 0. By the Euler-Maclaurin formula (NIST Digital Library of Mathematical
  !> Functions, 25.11.5 and 2.10.1): terms one by one while a + k < 10 + s, then the formula,
  !> whose omitted corrections are below 1e-17 of the rest.
  elemental function hurwitz_zeta(s, a) result(zeta)
    integer, intent(in) :: s
    real(dp), intent(in) :: a
    real(dp) :: zeta
    real(dp) :: head, tail, factor, argument
    integer :: j, k, terms

    terms = 0
    if (a < real(10 + s, dp)) terms = ceiling(real(10 + s, dp) - a)
    argument = a + real(terms, dp)
    tail = 0.0_dp
    factor = argument**(-s - 1)*real(s, dp)
    do j = 1, size(BERNOULLI)
      tail = tail + BERNOULLI(j)*factor
      factor = factor*(real(s + 2*j - 1, dp)/argument)*(real(s + 2*j, dp)/argument)
    end do
    head = 0.0_dp
    ! Smallest terms first.
    do k = terms - 1, 0, -1
      head = head + 1.0_dp/(a + real(k, dp))**s
    end do
    zeta = head + (tail + argument**(-s)*(argument/real(s - 1, dp) + 0.5_dp))
  end function hurwitz_zeta

end module fuge_hurwitz_zeta
