!> Solves random contacts to a wanted error, and prints where the estimate is below the true error.
!>
!> compare_accuracy lines|areas [last] [first] [n]: numbers `first` to `last`, by default 1 to 2000 and 1 to 300; areas
!> against `n` x `n` cells, by default 1024.
program compare_accuracy
  use, intrinsic :: iso_fortran_env, only: output_unit
  use accuracy_judge, only: accuracy_verdict, approach_falls_short, falls_short, judge_area, judge_line
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_WARN_ACCURACY
  use random_gaps, only: AREAS, LINES
  implicit none

  call run()

contains

  subroutine run()
    type(accuracy_verdict) :: verdict
    character(len=8) :: word
    integer :: number, k, counts(7, 10)
    real(dp) :: seconds(2)
    logical :: lines_wanted

    call get_command_argument(1, word)
    lines_wanted = word /= 'areas'
    counts = 0
    seconds = 0.0_dp
    do number = argument(3, 1), argument(2, merge(2000, 300, lines_wanted))
      if (lines_wanted) then
        call judge_line(number, verdict)
        k = findloc(LINES, verdict%family, dim=1)
      else
        call judge_area(number, argument(4, 1024), verdict)
        k = findloc(AREAS, verdict%family, dim=1)
      end if
      seconds = seconds + verdict%seconds
      associate (contact => verdict%contact)
        counts(:, k) = counts(:, k) + merge(1, 0, [.true., verdict%info%failed(), verdict%info%status > FUGE_DONE, &
          falls_short(verdict, 1.0_dp), falls_short(verdict, 1.0_dp/3.0_dp), approach_falls_short(verdict, 1.0_dp), &
          approach_falls_short(verdict, 1.0_dp/3.0_dp)])
        if (verdict%info%failed()) then
          write (output_unit, '(i6,1x,a,i4,1x,a)') number, verdict%family, verdict%info%status, &
            trim(verdict%info%message)
        else if (falls_short(verdict, 1.0_dp) .or. approach_falls_short(verdict, 1.0_dp) &
                 .or. all(verdict%info%status /= [FUGE_DONE, FUGE_WARN_ACCURACY])) then
          write (output_unit, '(i6,1x,a,i3,5es10.2,i8,3(1x,l1),1x,a)') number, verdict%family, verdict%info%status, &
            verdict%pressing%accuracy, contact%pressure_error, verdict%error, contact%approach_error, &
            verdict%approach_error, size(contact%x), allocated(verdict%pressing%moment), &
            allocated(verdict%pressing%approach), verdict%pressing%boundary /= 0, contact%choice
        end if
      end associate
    end do
    write (output_unit, '(a)') 'family: all, failed, warned; pressure below, below a third; approach below, a third'
    do k = 1, merge(size(LINES), size(AREAS), lines_wanted)
      write (output_unit, '(a,7i6)') merge(LINES(min(k, size(LINES))), AREAS(min(k, size(AREAS))), lines_wanted), &
        counts(:, k)
    end do
    write (output_unit, '(a,7i6)') 'all             ', sum(counts, dim=2)
    write (output_unit, '(a,2f10.2)') 'seconds of solves and of references', seconds
  end subroutine run

  integer function argument(k, default)
    integer, intent(in) :: k, default
    character(len=12) :: word
    integer :: status

    argument = default
    call get_command_argument(k, word, status=status)
    if (status == 0 .and. word /= '') read (word, *, iostat=status) argument
  end function argument

end program compare_accuracy
