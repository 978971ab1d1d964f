!> The table of estimated and true errors of forces in doc/stability.md.
!>
!> force_error_table [number of problems a row, 500 by default [tableau | active_set | iterative]] writes it to the
!> terminal, by default that of the active set.
program force_error_table
  use, intrinsic :: iso_fortran_env, only: output_unit
  use fuge_number_text, only: text
  use fuge_options_type, only: FUGE_ACTIVE_SET, FUGE_ITERATIVE, FUGE_TABLEAU
  use hard_conditions, only: KINDS, KIND_NAMES
  use hard_estimates, only: estimate_counts, judge_problems
  implicit none

  call run()

contains

  subroutine run()
    type(estimate_counts) :: counts
    character(len=16) :: word
    integer :: kind, decimals, method, trials

    trials = 500
    call get_command_argument(1, word)
    if (len_trim(word) > 0) read (word, *) trials
    call get_command_argument(2, word)
    select case (word)
    case ('tableau')
      method = FUGE_TABLEAU
    case ('iterative')
      method = FUGE_ITERATIVE
    case default
      method = FUGE_ACTIVE_SET
    end select
    write (output_unit, '(a)') '| problem | condition | answers | largest error | below 1/30 | 1/30 .. 1/3 | 1/3 .. 3' &
      //' | 3 .. 100 | above 100 | silent | false |'
    write (output_unit, '(a)') '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    do kind = 1, KINDS
      do decimals = 2, 16, 2
        call judge_problems(kind, decimals, trials, counts, method)
        write (output_unit, '(a,es7.1,a)') '| '//trim(KIND_NAMES(kind))//' | 1e'//text(decimals)//' | ' &
          //text(counts%answers)//' | ', counts%largest_error, ' | '//text(counts%far_below)//' | ' &
          //text(counts%below)//' | '//text(counts%near)//' | '//text(counts%above)//' | '//text(counts%far_above) &
          //' | '//text(counts%silent)//' | '//text(counts%false_warnings)//' |'
      end do
    end do
  end subroutine run

end program force_error_table
