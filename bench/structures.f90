!> Structures with one-way members and supports by the rules of programs that switch them on and off, and by fuge.
!>
!>     structures DIRECTORY [quick]
!>
!> The random structures of the tests, without limits and with springs in place of rigid supports, so that every rule
!> can treat them. Prints a Markdown table and writes DIRECTORY/one_sided.csv: trusses over the number of their cables.
!> An answer is wrong if a force is off by more than 1e-6 of the largest one; the forces are known from the tests' own
!> method in quadruple precision. A time is that from the stiffness matrix to the forces, the best of three.
program structures
  use, intrinsic :: iso_fortran_env, only: int64, output_unit
  use bench_switching, only: switch_members, DROP_ALL, DROP_AND_TAKE_BACK, DROP_WORST, ENDLESS, SETTLED, UNSTABLE
  use fuge, only: dp => fuge_dp, fuge_condensed, fuge_dense_operator, fuge_info, fuge_problem, fuge_solution, &
    fuge_solver
  use special_numbers, only: infinity
  use one_way_structures, only: add_member, add_row, begin_rows, condense_structure, one_way_structure
  use random_structures, only: draw_grillage, draw_pipe, draw_raft, draw_truss
  use structure_oracle, only: know_structure, known_structure
  implicit none

  !> fuge, after the rules.
  integer, parameter :: EXACT = DROP_AND_TAKE_BACK + 1
  character(len=28), parameter :: RULES(EXACT) = [character(len=28) :: 'dropped for good', &
    'dropped one by one for good', 'dropped and taken back', '**fuge**']
  character(len=10), parameter :: COLUMNS(EXACT) = [character(len=10) :: 'drop_all', 'drop_worst', 'take_back', 'fuge']
  !> Numbers of cables in the picture; those of them in the table.
  integer, parameter :: CABLES(9) = [4, 8, 14, 20, 26, 32, 40, 50, 60], IN_TABLE(3) = [14, 32, 60]
  !> Errors of forces above this fraction of the largest one are wrong; below the other one of the load there are none.
  real(dp), parameter :: WRONG = 1.0e-6_dp, NO_FORCE = 1.0e-4_dp
  !> Solves of each structure, of which the fastest counts.
  integer, parameter :: RUNS = 3

  !> What came out of many structures of one kind by one rule.
  type :: outcome_counts
    integer :: solved = 0, wrong = 0, unstable = 0, endless = 0
    real(dp) :: worst = 0.0_dp, time = 0.0_dp
  end type outcome_counts

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=16) :: word
    integer :: j, number, others, table

    call get_command_argument(1, directory)
    if (directory == '') error stop 'usage: structures DIRECTORY [quick]'
    call get_command_argument(2, word)
    number = merge(30, 1000, word == 'quick')
    others = merge(30, 5000, word == 'quick')
    open (newunit=table, file=trim(directory)//'/one_sided.csv', action='write', status='replace')
    write (table, '(a)') 'cables,rule,structures,wrong,unstable,endless,largest_error,time_s'
    write (output_unit, '(a)') '| structures | members are | wrong | largest error | unstable | endless | time | ' &
      //'over that of fuge |', '| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |'
    call measure('two storeys', 0, 1, table)
    do j = 1, size(CABLES)
      call measure('trusses', CABLES(j), number, table)
    end do
    call measure('grillages', 0, others, table)
    call measure('pipes', 0, others, table)
    call measure('rafts', 0, others, table)
    close (table)
  end subroutine run

  !> All rules on the first `number` structures of a kind that carry their load.
  subroutine measure(kind, members, number, table)
    character(len=*), intent(in) :: kind
    integer, intent(in) :: members, number, table
    type(outcome_counts) :: counts(EXACT)
    type(one_way_structure) :: structure
    type(known_structure) :: known
    integer :: k, taken, drawn

    taken = 0
    drawn = 0
    do while (taken < number)
      drawn = drawn + 1
      call draw(kind, drawn, members, structure)
      call know_structure(structure, known)
      if (.not. known%carried) cycle
      taken = taken + 1
      do k = 1, EXACT
        ! Guides with play begin open, and are never dropped alone.
        if (kind == 'pipes' .and. (k == DROP_ALL .or. k == DROP_WORST)) cycle
        call solve_once(structure, known, k, counts(k))
      end do
    end do
    do k = 1, EXACT
      if (counts(k)%solved < 1) cycle
      if (members > 0) write (table, '(i0,2a,4(a,i0),2(a,es8.2))') members, ',', trim(COLUMNS(k)), ',', &
        counts(k)%solved, ',', counts(k)%wrong, ',', counts(k)%unstable, ',', counts(k)%endless, ',', counts(k)%worst, &
        ',', counts(k)%time/real(number, dp)
      if (members == 0 .or. any(IN_TABLE == members)) call write_line(kind, members, k, counts)
    end do
  end subroutine measure

  subroutine write_line(kind, members, k, counts)
    character(len=*), intent(in) :: kind
    integer, intent(in) :: members, k
    type(outcome_counts), intent(in) :: counts(:)
    character(len=40) :: what

    what = kind
    if (members > 0) write (what, '(a,i0,a)') 'trusses, ', members, ' cables'
    if (k > 1 .and. counts(1)%solved > 0 .or. k == EXACT) what = ''
    write (output_unit, '(5a,i0,a,i0,a,es8.1,2(a,i0),2(a,f0.2),a)') '| ', trim(what), ' | ', trim(RULES(k)), ' | ', &
      counts(k)%wrong, ' of ', counts(k)%solved, ' | ', counts(k)%worst, ' | ', counts(k)%unstable, ' | ', &
      counts(k)%endless, ' | ', 1.0e6_dp*counts(k)%time/real(counts(k)%solved, dp), ' us | ', &
      counts(k)%time/counts(EXACT)%time, ' |'
    flush (output_unit)
  end subroutine write_line

  subroutine draw(kind, number, members, structure)
    character(len=*), intent(in) :: kind
    integer, intent(in) :: number, members
    type(one_way_structure), intent(out) :: structure
    real(dp) :: spring

    select case (kind)
    case ('two storeys')
      call set_storeys(structure)
      return
    case ('trusses')
      call draw_truss(number, members, structure)
    case ('grillages')
      call draw_grillage(number, structure)
    case ('pipes')
      call draw_pipe(number, structure)
    case default
      call draw_raft(number, structure)
    end select
    structure%limit = infinity()
    structure%limit_upper = infinity()
    ! Springs a thousand times as stiff as the stiffest member.
    spring = 1.0e-3_dp/maxval(structure%stiffness)
    where (.not. structure%compliance > 0.0_dp) structure%compliance = spring
  end subroutine draw

  !> The example of doc/one_sided.md: storeys that sway with a stiffness of 1, the lower one held to the left and the
  !> upper one to the right by cables of the same stiffness.
  subroutine set_storeys(structure)
    type(one_way_structure), intent(inout) :: structure

    call begin_rows(2, structure)
    call add_member([1], reshape([1.0_dp], [1, 1]), structure)
    call add_member([1, 2], reshape([1.0_dp, -1.0_dp, -1.0_dp, 1.0_dp], [2, 2]), structure)
    call add_row([1], [-1.0_dp], 0.0_dp, 1.0_dp, structure)
    call add_row([2], [1.0_dp], 0.0_dp, 1.0_dp, structure)
    structure%load = [-3.0_dp, 5.0_dp]
  end subroutine set_storeys

  !> Solve by a rule, or by fuge, and count.
  subroutine solve_once(structure, known, rule, counts)
    type(one_way_structure), intent(in) :: structure
    type(known_structure), intent(in) :: known
    integer, intent(in) :: rule
    type(outcome_counts), intent(inout) :: counts
    real(dp) :: force(structure%rows()), error, time
    integer(int64) :: began, ended, rate
    integer :: k, rounds, outcome

    time = huge(time)
    do k = 1, RUNS
      call system_clock(began, rate)
      if (rule == EXACT) then
        call solve_exactly(structure, force, outcome)
      else
        call switch_members(structure, rule, force, rounds, outcome)
      end if
      call system_clock(ended)
      time = min(time, real(ended - began, dp)/real(rate, dp))
    end do
    counts%time = counts%time + time
    counts%solved = counts%solved + 1
    select case (outcome)
    case (SETTLED)
      error = real(maxval(abs(force - known%force)), dp) &
              /max(real(maxval(abs(known%force)), dp), NO_FORCE*maxval(abs(structure%load)))
      if (error > WRONG) counts%wrong = counts%wrong + 1
      counts%worst = max(counts%worst, error)
    case (UNSTABLE)
      counts%unstable = counts%unstable + 1
    case (ENDLESS)
      counts%endless = counts%endless + 1
    end select
  end subroutine solve_once

  subroutine solve_exactly(structure, force, outcome)
    type(one_way_structure), intent(in) :: structure
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: outcome
    type(fuge_condensed), target :: condensed
    type(fuge_problem) :: problem
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    outcome = UNSTABLE
    call condense_structure(structure, condensed, problem, info)
    if (info%failed()) return
    call operator%set(condensed%alpha, info)
    if (.not. info%failed()) call solver%solve(operator, problem, solution, info)
    if (info%failed()) return
    force = solution%force
    outcome = SETTLED
  end subroutine solve_exactly

end program structures
