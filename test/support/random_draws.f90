!> Random numbers of the minimal standard generator, one at a time, and values without a pattern. Each function with a
!> seed advances it, so that an expression must not call two of them.
module random_draws
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  use general_reference, only: draw
  implicit none
  private

  public :: seed_of, uniform, decimal, chance, one_of
  public :: irregular, some_forces

contains

  !> A seed for this number; neighbours share no pattern.
  pure function seed_of(number) result(seed)
    integer, intent(in) :: number
    integer(int64) :: seed
    real(dp) :: discarded(20)

    seed = 1_int64 + mod(48271_int64*int(number, int64), 2147483646_int64)
    call draw(seed, discarded)
  end function seed_of

  !> Between `low` and `high`.
  function uniform(seed, low, high) result(value)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: low, high
    real(dp) :: value
    real(dp) :: drawn(1)

    call draw(seed, drawn)
    value = low + (high - low)*drawn(1)
  end function uniform

  !> Between 10**low and 10**high, the exponent uniform.
  function decimal(seed, low, high) result(value)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: low, high
    real(dp) :: value

    value = 10.0_dp**uniform(seed, low, high)
  end function decimal

  !> True with this probability.
  function chance(seed, probability) result(happens)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: probability
    logical :: happens

    happens = uniform(seed, 0.0_dp, 1.0_dp) < probability
  end function chance

  !> 1 .. n.
  function one_of(seed, n) result(number)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: n
    integer :: number

    number = min(1 + int(uniform(seed, 0.0_dp, real(n, dp))), n)
  end function one_of

  !> Irregular numbers between -1/4 and 1, the same in every run.
  pure function irregular(n) result(values)
    integer, intent(in) :: n
    real(dp) :: values(n)
    integer :: k

    values = [(1.25_dp*modulo(0.618033988749895_dp*real(k, dp)**2, 1.0_dp) - 0.25_dp, k=1, n)]
  end function irregular

  !> Forces of both signs, some of them 0, by the generator of the compiler.
  function some_forces(n) result(force)
    integer, intent(in) :: n
    real(dp) :: force(n)
    integer(int64) :: seed

    seed = seed_of(n)
    call draw(seed, force)
    where (force < 0.3_dp) force = 0.0_dp
    force = force - 0.1_dp
    if (n == 1) force = 2.0_dp
  end function some_forces

end module random_draws
