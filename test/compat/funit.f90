! What a translated .pf file uses: a small stand-in for the part of pFUnit that
! README.md lists. This module holds the assertions other than assertEqual.
module funit
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use funit_equal, only: assertEqual
  use funit_report, only: anyExceptions, dp, report, SourceLocation, text
  use funit_report, only: fuge_compat_run_test => run_test, fuge_compat_summary => summary
  implicit none
  private

  public :: SourceLocation, anyExceptions
  public :: assertEqual, assertNotEqual, assertRelativelyEqual
  public :: assertTrue, assertFalse, assertFail, assertIsNaN, assertIsFinite
  public :: assertLessThan, assertLessThanOrEqual
  public :: assertGreaterThan, assertGreaterThanOrEqual
  ! Used by generated code only; the prefix keeps them apart from names in a test.
  public :: fuge_compat_run_test, fuge_compat_summary

  interface assertLessThan
    module procedure less_integer, less_double
  end interface assertLessThan

  interface assertLessThanOrEqual
    module procedure less_or_equal_integer, less_or_equal_double
  end interface assertLessThanOrEqual

  interface assertGreaterThan
    module procedure greater_integer, greater_double
  end interface assertGreaterThan

  interface assertGreaterThanOrEqual
    module procedure greater_or_equal_integer, greater_or_equal_double
  end interface assertGreaterThanOrEqual

contains

  subroutine assertNotEqual(expected, found, location, message)
    integer, intent(in) :: expected, found
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (expected /= found) return
    call report('assertNotEqual', location, message, 'not '//text(expected), text(found))
  end subroutine assertNotEqual

  ! Relative to the expected value: nothing, not even zero, is relatively equal to zero,
  ! and nothing to an infinity.
  subroutine assertRelativelyEqual(expected, found, tolerance, location, message)
    real(dp), intent(in) :: expected, found, tolerance
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message
    real(dp) :: magnitude

    if (ieee_is_finite(expected) .and. ieee_is_finite(found)) then
      magnitude = abs(expected)
      if (magnitude > 0.0_dp .and. abs(found - expected) <= tolerance*magnitude) return
    end if
    call report('assertRelativelyEqual', location, message, text(expected), &
                text(found)//' (relative tolerance '//text(tolerance)//')')
  end subroutine assertRelativelyEqual

  subroutine assertTrue(condition, message, location)
    logical, intent(in) :: condition
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. condition) call report('assertTrue', location, message, 'true', 'false')
  end subroutine assertTrue

  subroutine assertFalse(condition, message, location)
    logical, intent(in) :: condition
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (condition) call report('assertFalse', location, message, 'false', 'true')
  end subroutine assertFalse

  subroutine assertFail(message, location)
    character(len=*), intent(in) :: message
    type(SourceLocation), intent(in), optional :: location

    call report('assertFail', location, message)
  end subroutine assertFail

  subroutine assertIsNaN(x, message, location)
    real(dp), intent(in) :: x
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. ieee_is_nan(x)) call report('assertIsNaN', location, message, 'NaN', text(x))
  end subroutine assertIsNaN

  subroutine assertIsFinite(x, message, location)
    real(dp), intent(in) :: x
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. ieee_is_finite(x)) call report('assertIsFinite', location, message, 'finite', text(x))
  end subroutine assertIsFinite

  subroutine less_integer(a, b, location, message)
    integer, intent(in) :: a, b
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (a < b) return
    call report('assertLessThan', location, message, text(a)//' < '//text(b))
  end subroutine less_integer

  subroutine less_double(a, b, location, message)
    real(dp), intent(in) :: a, b
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (ordered(a, b)) then
      if (a < b) return
    end if
    call report('assertLessThan', location, message, text(a)//' < '//text(b))
  end subroutine less_double

  subroutine less_or_equal_integer(a, b, location, message)
    integer, intent(in) :: a, b
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (a <= b) return
    call report('assertLessThanOrEqual', location, message, text(a)//' <= '//text(b))
  end subroutine less_or_equal_integer

  subroutine less_or_equal_double(a, b, location, message)
    real(dp), intent(in) :: a, b
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (ordered(a, b)) then
      if (a <= b) return
    end if
    call report('assertLessThanOrEqual', location, message, text(a)//' <= '//text(b))
  end subroutine less_or_equal_double

  subroutine greater_integer(a, b, location, message)
    integer, intent(in) :: a, b
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (a > b) return
    call report('assertGreaterThan', location, message, text(a)//' > '//text(b))
  end subroutine greater_integer

  subroutine greater_double(a, b, location, message)
    real(dp), intent(in) :: a, b
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (ordered(a, b)) then
      if (a > b) return
    end if
    call report('assertGreaterThan', location, message, text(a)//' > '//text(b))
  end subroutine greater_double

  subroutine greater_or_equal_integer(a, b, location, message)
    integer, intent(in) :: a, b
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (a >= b) return
    call report('assertGreaterThanOrEqual', location, message, text(a)//' >= '//text(b))
  end subroutine greater_or_equal_integer

  subroutine greater_or_equal_double(a, b, location, message)
    real(dp), intent(in) :: a, b
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message

    if (ordered(a, b)) then
      if (a >= b) return
    end if
    call report('assertGreaterThanOrEqual', location, message, text(a)//' >= '//text(b))
  end subroutine greater_or_equal_double

  ! NaN is ordered with nothing, and comparing it would trip floating point traps.
  pure logical function ordered(a, b)
    real(dp), intent(in) :: a, b

    ordered = .not. (ieee_is_nan(a) .or. ieee_is_nan(b))
  end function ordered

end module funit
