!> Expectations of several values, each for one assertion on one line of a test: `unexpected` returns '' where all is as
!> expected, otherwise words that tell what is not. So
!>
!>     @assertEqual('', unexpected(info, FUGE_ERR_SIZE, 'gap has 2 values'))
!>
!> reports the line of the test and the values, by pFUnit as by the stand-in for it.
module expectations
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: FUGE_MESSAGE_LENGTH, fuge_info
  implicit none
  private

  public :: add_difference, add_excess, add_words, marked_solution, relative_difference, unexpected

  interface unexpected
    module procedure unexpected_outcome, unexpected_values, unexpected_solution
  end interface unexpected

  !> The largest difference, relative to the largest of the expected values, which must not all be zero.
  interface relative_difference
    module procedure relative_difference_1, relative_difference_2
  end interface relative_difference

  integer, parameter, public :: REPORT_LENGTH = 3*FUGE_MESSAGE_LENGTH

contains

  !> An outcome with this status, and a message that has these words somewhere, begins like this, or is this.
  pure function unexpected_outcome(info, status, has, begins, message) result(report)
    type(fuge_info), intent(in) :: info
    integer, intent(in) :: status
    character(len=*), intent(in), optional :: has, begins, message
    character(len=REPORT_LENGTH) :: report

    report = ''
    if (info%status /= status) report = 'status '//text(info%status)//' instead of '//text(status)
    if (present(has)) then
      if (index(info%message, has) == 0) call add_words('nowhere "'//has//'"', report)
    end if
    if (present(begins)) then
      if (index(info%message, begins) /= 1) call add_words('not at the beginning "'//begins//'"', report)
    end if
    if (present(message)) then
      if (info%message /= message) call add_words('not "'//message//'"', report)
    end if
    if (report /= '') call add_words('in the message "'//trim(info%message)//'"', report)
  end function unexpected_outcome

  !> A solution with these forces, gaps and motions up to `tolerance`, 0 where that is not given; gaps and motions up to
  !> `lengths` where that is given.
  pure function unexpected_values(found, force, gap, motion, tolerance, lengths) result(report)
    type(fuge_solution), intent(in) :: found
    real(dp), intent(in) :: force(:), gap(:), motion(:)
    real(dp), intent(in), optional :: tolerance, lengths
    character(len=REPORT_LENGTH) :: report
    real(dp) :: of_forces, of_lengths

    of_forces = 0.0_dp
    if (present(tolerance)) of_forces = tolerance
    of_lengths = of_forces
    if (present(lengths)) of_lengths = lengths
    report = ''
    if (.not. (allocated(found%force) .and. allocated(found%gap) .and. allocated(found%motion))) then
      report = 'there is no solution'
      return
    end if
    call add_difference('force', found%force, force, of_forces, report)
    call add_difference('gap', found%gap, gap, of_lengths, report)
    call add_difference('motion', found%motion, motion, of_lengths, report)
  end function unexpected_values

  !> The same solution as `expected`, as above.
  pure function unexpected_solution(found, expected, tolerance, lengths) result(report)
    type(fuge_solution), intent(in) :: found, expected
    real(dp), intent(in), optional :: tolerance, lengths
    character(len=REPORT_LENGTH) :: report

    report = unexpected_values(found, expected%force, expected%gap, expected%motion, tolerance, lengths)
  end function unexpected_solution

  !> No solution: what a refused solve must leave as it is.
  pure function marked_solution() result(solution)
    type(fuge_solution) :: solution
    real(dp), parameter :: MARK = -12345.0_dp

    solution = fuge_solution([MARK], [MARK, MARK], [MARK, MARK, MARK])
  end function marked_solution

  !> Add the first value that is not as expected, or another number of values.
  pure subroutine add_difference(name, found, expected, tolerance, report)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: found(:), expected(:), tolerance
    character(len=*), intent(inout) :: report
    integer :: k

    if (size(found) /= size(expected)) then
      call add_words(text(size(found))//' instead of '//text(size(expected))//' values of '//name, report)
    else
      k = findloc(is_close(found, expected, tolerance), .false., dim=1)
      if (k == 0) return
      call add_words(name//'('//text(k)//') = '//text(found(k))//' instead of '//text(expected(k))//', difference '// &
                     text(found(k) - expected(k)), report)
    end if
  end subroutine add_difference

  !> Add a value that is above its bound, or not a number.
  pure subroutine add_excess(name, value, bound, report)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: value, bound
    character(len=*), intent(inout) :: report

    if (.not. ieee_is_nan(value)) then
      if (value <= bound) return
    end if
    call add_words(name//' '//text(value)//' above '//text(bound), report)
  end subroutine add_excess

  !> Equal values come first: the difference of infinities is not a number, which trips floating-point traps.
  elemental function is_close(found, expected, tolerance)
    real(dp), intent(in) :: found, expected, tolerance
    logical :: is_close

    is_close = .false.
    if (ieee_is_nan(found) .or. ieee_is_nan(expected)) return
    is_close = .not. (found < expected .or. found > expected)
    if (.not. is_close) is_close = abs(found - expected) <= tolerance
  end function is_close

  !> Add to what is not as expected.
  pure subroutine add_words(words, report)
    character(len=*), intent(in) :: words
    character(len=*), intent(inout) :: report

    if (report == '') then
      report = words
    else
      report = trim(report)//', '//words
    end if
  end subroutine add_words

  pure function relative_difference_1(found, expected) result(difference)
    real(dp), intent(in) :: found(:), expected(:)
    real(dp) :: difference

    difference = maxval(abs(found - expected))/maxval(abs(expected))
  end function relative_difference_1

  pure function relative_difference_2(found, expected) result(difference)
    real(dp), intent(in) :: found(:, :), expected(:, :)
    real(dp) :: difference

    difference = maxval(abs(found - expected))/maxval(abs(expected))
  end function relative_difference_2

end module expectations
