!> Solves random structures with one-way rows by an engine, and prints where it is not right.
!>
!> compare_structures [last] [first] [engine]: structures `first` to `last`, by default 1 to 10000, by tableau,
!> active_set (the default) or iterative. It ends with an error if the engine is wrong.
program compare_structures
  use, intrinsic :: iso_fortran_env, only: output_unit
  use fuge_kinds, only: dp
  use fuge_options_type, only: FUGE_ACTIVE_SET, FUGE_ITERATIVE, FUGE_TABLEAU
  use one_way_structures, only: one_way_structure
  use random_structures, only: draw_structure
  use structure_judge, only: judge_structure, structure_verdict
  use structure_oracle, only: know_structure, known_structure
  implicit none

  character(len=12), parameter :: KINDS(4) = [character(len=12) :: 'truss', 'grillage', 'pipe', 'raft']
  !> The reference itself fulfils the equations to the rounding of the modes in double precision.
  real(dp), parameter :: REFERENCE = 1.0e-11_dp

  call run()

contains

  subroutine run()
    type(one_way_structure) :: structure
    type(known_structure) :: known
    type(structure_verdict) :: verdict
    character(len=12) :: engine
    integer :: floating, kind, last, method, number, of_kind(4), off, refused, warned, wrong
    real(dp) :: violation, worst(4)

    last = argument(1, 10000)
    engine = 'active_set'
    if (command_argument_count() > 2) call get_command_argument(3, engine)
    method = FUGE_ACTIVE_SET
    if (engine == 'tableau') method = FUGE_TABLEAU
    if (engine == 'iterative') method = FUGE_ITERATIVE
    of_kind = 0
    worst = 0.0_dp
    floating = 0
    off = 0
    refused = 0
    warned = 0
    wrong = 0
    violation = 0.0_dp
    do number = argument(2, 1), last
      call draw_structure(number, structure)
      call know_structure(structure, known)
      kind = findloc(KINDS, structure%kind, dim=1)
      of_kind(kind) = of_kind(kind) + 1
      if (structure%floats) floating = floating + 1
      if (known%carried) violation = max(violation, real(known%violation, dp))
      if (.not. known%violation <= REFERENCE .or. (known%motions > 0 .neqv. structure%floats)) then
        off = off + 1
        write (output_unit, '(i7,1x,a,a,i0,a,es9.1)') number, structure%kind, ' reference, motions ', known%motions, &
          ', violation ', real(known%violation, dp)
      end if
      call judge_structure(structure, known, method, verdict)
      if (.not. known%carried) refused = refused + 1
      if (verdict%status > 0) warned = warned + 1
      worst(kind) = max(worst(kind), verdict%error)
      if (verdict%fault == '') cycle
      wrong = wrong + 1
      write (output_unit, '(i7,3(a,i0),5(1x,a))') number, ' n', structure%rows(), ' m', known%motions, ' status ', &
        verdict%status, structure%kind, trim(verdict%fault), trim(verdict%details)
      flush (output_unit)
    end do
    do kind = 1, size(KINDS)
      write (output_unit, '(a,i7,a,es9.1)') KINDS(kind), of_kind(kind), ', largest error of a force ', worst(kind)
    end do
    write (output_unit, '(4(i0,a),es8.1,a,i0)') wrong, ' wrong of ', sum(of_kind), '; ', floating, ' float, ', &
      refused, ' cannot be carried; reference off by at most ', violation, ', warnings ', warned
    if (wrong + off > 0) error stop 1
  end subroutine run

  integer function argument(place, default)
    integer, intent(in) :: place, default
    character(len=32) :: word

    argument = default
    if (command_argument_count() < place) return
    call get_command_argument(place, word)
    read (word, *) argument
  end function argument

end program compare_structures
