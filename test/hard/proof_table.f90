!> The table of proofs in doc/stability.md.
!>
!> proof_table [number of problems of whole numbers, 20000 by default] writes it to the terminal.
program proof_table
  use, intrinsic :: iso_fortran_env, only: output_unit
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use hard_conditions, only: KINDS
  use proof_judge, only: judge_random_proofs, judge_whole_proofs, median_of, proof_counts, MOST_DECIMALS
  implicit none

  call run()

contains

  subroutine run()
    type(proof_counts) :: random, tied(0:MOST_DECIMALS), whole(0:MOST_DECIMALS)
    character(len=16) :: word
    integer :: decimals, kind, problems

    problems = 20000
    call get_command_argument(1, word)
    if (len_trim(word) > 0) read (word, *) problems
    call judge_whole_proofs(1, problems, .false., whole)
    call judge_whole_proofs(1, problems, .true., tied)
    write (output_unit, '(a)') '| condition | whole numbers | proved | times the error | with ties | bounded | ' &
      //'times the error | quadruple precision | proved | times the error | too low |'
    write (output_unit, '(a)') '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    do decimals = 2, 16, 2
      random = proof_counts()
      do kind = 1, KINDS
        call judge_random_proofs(kind, decimals, 500, random)
      end do
      write (output_unit, '(a)') '| 1e'//text(decimals)//trim(counted(whole(decimals), .true.)) &
        //trim(counted(tied(decimals), .false.))//trim(counted(random, .true.))//' | ' &
        //text(whole(decimals)%too_low + tied(decimals)%too_low + random%too_low)//' |'
    end do
  end subroutine run

  !> Answers, how many of them are proved, or bounded only, and how far the bounds are above the errors: the median and
  !> what 99 of 100 are below.
  function counted(counts, with_states) result(cells)
    type(proof_counts), intent(in) :: counts
    logical, intent(in) :: with_states
    character(len=48) :: cells
    integer :: good

    good = merge(counts%proved, counts%bounded, with_states)
    write (cells, '(a,i0,a,f0.1,a,es7.1,a,es7.1)') ' | ', counts%answers, ' | ', &
      100.0_dp*real(good, dp)/real(max(counts%answers, 1), dp), ' % | ', median_of(counts), ', ', &
      median_of(counts, 0.99_dp)
  end function counted

end program proof_table
