!> Counts the values of an example that are compared with known answers; says at its end how many are right.
module example_verdict
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use fuge, only: dp => fuge_dp
  implicit none
  private

  type, public :: verdict
    private
    integer :: compared = 0, right = 0
    !> The largest relative error; below zero if there is none.
    real(dp) :: worst = -1.0_dp
  contains
    generic :: compare => compare_value, compare_values
    procedure :: hold
    procedure :: give
    procedure, private :: compare_value
    procedure, private :: compare_values
  end type verdict

contains

  !> Count the relative error of `what`, right if it is not beyond `allowed`. Not-a-number is wrong.
  subroutine compare_value(self, error, allowed, what)
    class(verdict), intent(inout) :: self
    real(dp), intent(in) :: error, allowed
    character(len=*), intent(in) :: what

    if (ieee_is_nan(error)) then
      call self%hold(.false., what)
      self%worst = huge(error)
    else
      call self%hold(abs(error) <= allowed, what)
      self%worst = max(self%worst, abs(error))
    end if
  end subroutine compare_value

  subroutine compare_values(self, error, allowed, what)
    class(verdict), intent(inout) :: self
    real(dp), intent(in) :: error(:), allowed
    character(len=*), intent(in) :: what
    integer :: k

    do k = 1, size(error)
      call self%compare_value(error(k), allowed, what)
    end do
  end subroutine compare_values

  !> Count something that is known to be so.
  subroutine hold(self, is_so, what)
    class(verdict), intent(inout) :: self
    logical, intent(in) :: is_so
    character(len=*), intent(in) :: what

    self%compared = self%compared + 1
    if (is_so) self%right = self%right + 1
    if (.not. is_so) print '(2a)', 'wrong: ', what
  end subroutine hold

  !> Print the last line of the output, which script/demo shows; stop if a value is wrong or none was compared.
  subroutine give(self, reference)
    class(verdict), intent(in) :: self
    character(len=*), intent(in) :: reference
    character(len=32) :: worst

    worst = ''
    if (.not. self%worst < 0.0_dp) write (worst, '(a,es7.1)') ', worst ', self%worst
    print '(/,a,i0,a,i0,3a)', 'verdict: ', self%right, ' of ', self%compared, ' ', reference, trim(worst)
    if (self%right < self%compared .or. self%compared == 0) error stop 'a value is not the known one'
  end subroutine give

end module example_verdict
