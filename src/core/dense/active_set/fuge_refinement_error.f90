!> How far the forces of a contact set are from the exact ones, from what its refinement changed.
module fuge_refinement_error
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_kinds, only: dp
  implicit none
  private

  public :: error_left, make_random_errors

  !> Rounding errors of random signs may add up to this many times what one choice of signs shows.
  real(dp), parameter, public :: RANDOM_SIGNS = 3.0_dp
  !> The sum of a slow geometric series of corrections counts as at most this many times the last one.
  real(dp), parameter :: SLOWEST = 100.0_dp
  !> Errors above this one all count as this one, so that sums and quotients of errors do not overflow.
  real(dp), parameter, public :: LARGEST = huge(1.0_dp)/(2.0_dp*SLOWEST)

contains

  !> The largest error of a force after a refinement, from the largest `changes` of a force: that of the solution
  !> itself, which is its largest force, then those of the corrections in turn; at least one correction. `taken`: the
  !> last one was applied, so that it is no longer an error, but the next one would be. The rounding of the forces to
  !> double precision is included.
  !>
  !> Each solve with the factor has about the same relative error. So corrections shrink by one factor, until they are
  !> the noise of the residual. The last one that is not taken is that noise if the ones before it shrank fast, and the
  !> beginning of a series if they did not.
  pure function error_left(changes, taken) result(error)
    real(dp), intent(in) :: changes(0:)
    logical, intent(in) :: taken
    real(dp) :: error
    integer :: last

    last = ubound(changes, 1)
    if (.not. changes(last) <= LARGEST) then
      ! Also where it is NaN.
      error = LARGEST
    else if (taken) then
      error = changes(last)*ratio(changes(last), changes(last - 1))
    else
      error = changes(last)
      if (last > 1) error = error/max(1.0_dp - ratio(changes(last - 1), changes(last - 2)), 1.0_dp/SLOWEST)
    end if
    error = error + 0.5_dp*epsilon(error)*changes(0)
  end function error_left

  !> How far a correction has shrunk beside the one before it, at most 1; 0 if it is zero.
  pure function ratio(change, before)
    real(dp), intent(in) :: change, before
    real(dp) :: ratio

    ratio = 0.0_dp
    if (change > 0.0_dp) ratio = 1.0_dp
    if (change < before) ratio = change/before
  end function ratio

  !> Replace bounds of rounding errors, `errors` (n), by errors within them: of either sign, without a pattern that a
  !> matrix could have too, and the same in each call.
  pure subroutine make_random_errors(errors)
    real(dp), intent(inout) :: errors(:)
    integer(int64) :: seed
    integer :: k

    ! The minimal standard generator (S. K. Park, K. W. Miller, Communications of the ACM 31, 1988).
    seed = 1043618065_int64
    do k = 1, size(errors)
      seed = mod(16807_int64*seed, 2147483647_int64)
      errors(k) = errors(k)*(2.0_dp*real(seed, dp)/2147483647.0_dp - 1.0_dp)
    end do
  end subroutine make_random_errors

end module fuge_refinement_error
