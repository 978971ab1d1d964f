! The stand-in's runner: tally of the tests, report of a failed assertion, values as text.
! The module state is the tally of the one test program; it is not thread-safe.
module funit_report
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use, intrinsic :: iso_fortran_env, only: output_unit
  implicit none
  private

  public :: dp, SourceLocation, anyExceptions, report, text, list, run_test, summary

  integer, parameter :: dp = kind(1.0d0)

  type :: SourceLocation
    character(len=256) :: file_name = '<unknown>'
    integer :: line = 0
  end type SourceLocation

  integer :: tests_run = 0
  integer :: tests_failed = 0
  integer :: exceptions = 0 ! of the running test
  character(len=256) :: test_name = ' '

  interface text
    module procedure text_integer, text_logical, text_double
  end interface text

  abstract interface
    subroutine test_procedure()
    end subroutine test_procedure
  end interface

contains

  ! Runs one test; when its set-up fails, the test and the clean-up are left out.
  subroutine run_test(name, test, before, after)
    character(len=*), intent(in) :: name
    procedure(test_procedure) :: test
    procedure(test_procedure), optional :: before, after

    test_name = name
    exceptions = 0
    if (present(before)) call before()
    if (.not. anyExceptions()) then
      call test()
      if (present(after)) call after()
    end if
    tests_run = tests_run + 1
    if (anyExceptions()) tests_failed = tests_failed + 1
  end subroutine run_test

  ! A program that has run no test has shown nothing, so it has not passed.
  subroutine summary(passed)
    logical, intent(out) :: passed

    passed = tests_run > 0 .and. tests_failed == 0
    if (passed) then
      write (output_unit, '(a,i0,a)') 'OK (', tests_run, merge(' test) ', ' tests)', tests_run == 1)
    else
      write (output_unit, '(a)') 'FAILURES!!!'
      write (output_unit, '(a,i0,a,i0)') 'Tests run: ', tests_run, ', failures: ', tests_failed
    end if
  end subroutine summary

  ! True once an assertion of the running test has failed.
  logical function anyExceptions()
    anyExceptions = exceptions > 0
  end function anyExceptions

  ! Reports one failed assertion; expected and found are left out where they say nothing.
  subroutine report(assertion, location, message, expected, found, at)
    character(len=*), intent(in) :: assertion
    type(SourceLocation), intent(in), optional :: location
    character(len=*), intent(in), optional :: message, expected, found
    integer, intent(in), optional :: at(:)
    type(SourceLocation) :: place

    if (present(location)) place = location
    exceptions = exceptions + 1
    write (output_unit, '(2a)') 'Failure in: ', trim(test_name)
    write (output_unit, '(3a,i0,a)') '  Location: [', trim(place%file_name), ':', place%line, ']'
    write (output_unit, '(3a)') '  ', assertion, ' failed'
    if (present(message)) write (output_unit, '(2a)') '  ', trim(message)
    if (present(expected)) write (output_unit, '(2a)') '    expected: ', expected
    if (present(found)) write (output_unit, '(2a)') '    found:    ', found
    if (present(at)) then
      if (size(at) > 0) write (output_unit, '(2a)') '    at index: ', list(at)
    end if
    flush (output_unit) ! a later crash must not take the report with it
  end subroutine report

  pure function list(values)
    integer, intent(in) :: values(:)
    character(len=:), allocatable :: list
    integer :: i

    list = '['
    do i = 1, size(values)
      if (i > 1) list = list//','
      list = list//text(values(i))
    end do
    list = list//']'
  end function list

  pure function text_integer(value) result(string)
    integer, intent(in) :: value
    character(len=:), allocatable :: string
    character(len=20) :: buffer

    write (buffer, '(i0)') value
    string = trim(buffer)
  end function text_integer

  pure function text_logical(value) result(string)
    logical, intent(in) :: value
    character(len=:), allocatable :: string

    string = trim(merge('true ', 'false', value))
  end function text_logical

  ! All digits of a double; infinities are spelled alike under every compiler.
  pure function text_double(value) result(string)
    real(dp), intent(in) :: value
    character(len=:), allocatable :: string
    character(len=24) :: buffer

    if (ieee_is_nan(value)) then
      string = 'NaN'
    else if (.not. ieee_is_finite(value)) then
      string = trim(merge('-Infinity', 'Infinity ', value < 0.0_dp))
    else
      write (buffer, '(es24.16e3)') value
      string = trim(adjustl(buffer))
    end if
  end function text_double

end module funit_report
