!> What many load cases of one structure cost.
!>
!>     load_cases
!>
!> A girder on 200 bearings that press only, whose cases are random combinations of 12 basic ones, and the raft of the
!> examples, 40 x 40 plates on a bed that does not pull under 500 combinations: from the stiffness matrix to forces,
!> displacements and their envelopes. Writes rows of a Markdown table. Processor time, one thread; the least of some
!> repetitions for the girder.
program load_cases
  use, intrinsic :: iso_fortran_env, only: int64, output_unit
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_band_stiffness, fuge_body, fuge_case_solutions, fuge_condense, fuge_condensed, &
    fuge_dense_operator, fuge_envelope, fuge_find_envelope, fuge_hard_law, fuge_info, fuge_link_law, fuge_links, &
    fuge_load_cases, fuge_problem, fuge_solve_cases, fuge_solver, fuge_stiffness
  use fuge_sparse, only: fuge_sparse_stiffness
  use raft_plates, only: raft_stiffness
  use random_draws, only: uniform
  implicit none

  !> Loads that combinations are made of.
  integer, parameter :: BASIC = 12
  integer, parameter :: BEARINGS = 200, PLATES = 40

  !> Times in seconds, and what came out.
  type :: costs
    type(stopwatch) :: condensing, solving, recovering
    real(dp) :: residual = 0.0_dp
    integer :: open_most = 0, open_least = huge(1), points = 0, degrees = 0, cases = 0
  end type costs

  call run()

contains

  subroutine run()
    write (output_unit, '(a)') '| structure | degrees of freedom | links | cases | open | condensation | solves | ' &
      //'displacements, envelopes | a case | residual |', &
      '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    call measure_girder(1000)
    call measure_girder(10000)
    call measure_raft(500)
  end subroutine run

  !> A girder of beam elements of length 1 with a bearing below each node but the outermost ones.
  subroutine measure_girder(cases)
    integer, intent(in) :: cases
    integer, parameter :: DEGREES = 2*(BEARINGS + 2)
    type(fuge_band_stiffness) :: stiffness
    type(fuge_links) :: links
    type(costs) :: cost
    type(fuge_info) :: info
    real(dp), target :: band(4, DEGREES)
    real(dp) :: element(4, 4), loads(DEGREES, cases)
    integer :: e, i, j

    element = reshape([12.0_dp, 6.0_dp, -12.0_dp, 6.0_dp, 6.0_dp, 4.0_dp, -6.0_dp, 2.0_dp, &
                       -12.0_dp, -6.0_dp, 12.0_dp, -6.0_dp, 6.0_dp, 2.0_dp, -6.0_dp, 4.0_dp], [4, 4])
    band = 0.0_dp
    do e = 1, DEGREES - 3, 2
      do j = 1, 4
        do i = j, 4
          band(1 + i - j, e + j - 1) = band(1 + i - j, e + j - 1) + element(i, j)
        end do
      end do
    end do
    call stiffness%set(band, .false., info)
    call check(info)
    do i = 1, BEARINGS
      call add_bearing(2*i + 1, 1.0e-2_dp, links)
    end do
    call combine(DEGREES, 2, loads)
    do while (.not. cost%solving%enough())
      call solve_all(stiffness, links, loads, cost)
    end do
    call write_row('girder on bearings', cost)
  end subroutine measure_girder

  subroutine measure_raft(cases)
    integer, intent(in) :: cases
    integer, parameter :: DEGREES = 3*(PLATES + 1)**2
    type(fuge_sparse_stiffness) :: stiffness
    type(fuge_links) :: links
    type(costs) :: cost
    type(fuge_info) :: info
    real(dp) :: loads(DEGREES, cases)
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
    integer :: k

    call raft_stiffness(PLATES, 1.0_dp, 1.0e2_dp, 0.2_dp, column, row, value)
    call stiffness%set(column, row, value, info)
    call check(info)
    do k = 1, DEGREES/3
      call add_bearing(3*k - 2, 1.0_dp, links)
    end do
    call combine(DEGREES, 3, loads)
    call solve_all(stiffness, links, loads, cost)
    call write_row('raft on a bed', cost)
  end subroutine measure_raft

  subroutine add_bearing(dof, compliance, links)
    integer, intent(in) :: dof
    real(dp), intent(in) :: compliance
    type(fuge_links), intent(inout) :: links
    type(fuge_link_law) :: law
    type(fuge_info) :: info

    law = fuge_hard_law()
    law%compliance = compliance
    call links%add_support([dof], [1.0_dp], info, law)
    call check(info)
  end subroutine add_bearing

  !> Weight, and random combinations of basic loads: forces on a twentieth of the deflections, every `step`th degree of
  !> freedom from the first on, of both signs, but all together downwards.
  subroutine combine(degrees, step, loads)
    integer, intent(in) :: degrees, step
    real(dp), intent(out) :: loads(:, :)
    real(dp) :: base(degrees, BASIC), factors(BASIC, size(loads, 2))
    integer(int64) :: seed
    integer :: b, j, k

    seed = 7_int64
    base = 0.0_dp
    do b = 1, BASIC
      do j = 1, degrees, step
        if (uniform(seed, 0.0_dp, 1.0_dp) < 0.05_dp) base(j, b) = uniform(seed, -20.0_dp, 12.0_dp)
      end do
    end do
    do k = 1, size(factors, 2)
      do b = 1, BASIC
        factors(b, k) = uniform(seed, 0.0_dp, 1.5_dp)
      end do
    end do
    loads = matmul(base, factors)
    loads(1::step, :) = loads(1::step, :) - 2.0_dp
  end subroutine combine

  !> From the stiffness matrix to the envelopes, once more.
  subroutine solve_all(stiffness, links, loads, cost)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_links), intent(in) :: links
    real(dp), intent(in) :: loads(:, :)
    type(costs), intent(inout) :: cost
    type(fuge_body) :: body
    type(fuge_condensed), target :: condensed
    type(fuge_problem) :: problem
    type(fuge_load_cases) :: combinations
    type(fuge_case_solutions) :: solutions
    type(fuge_dense_operator) :: operator
    type(fuge_solver) :: solver
    type(fuge_envelope) :: forces, displacements
    type(fuge_info) :: info
    real(dp), allocatable :: u(:, :)

    call cost%condensing%start()
    body%floats = .true.
    call links%attach(body, info)
    call check(info)
    call fuge_condense(stiffness, body, condensed, info)
    call check(info)
    call links%pose_cases(condensed, loads, problem, combinations, info)
    call check(info)
    call cost%condensing%stop()
    call cost%solving%start()
    call operator%set(condensed%alpha, info)
    call check(info)
    call fuge_solve_cases(solver, operator, problem, combinations, solutions, info)
    call check(info)
    call cost%solving%stop()
    cost%residual = info%residual
    call cost%recovering%start()
    allocate (u(size(loads, 1), size(loads, 2)), source=0.0_dp)
    call condensed%recover_cases(loads, solutions, u, info)
    call check(info)
    call fuge_find_envelope(solutions%force, forces, info)
    call check(info)
    call fuge_find_envelope(u, displacements, info)
    call check(info)
    call cost%recovering%stop()
    cost%open_least = minval(count(.not. solutions%force > 0.0_dp, dim=1))
    cost%open_most = maxval(count(.not. solutions%force > 0.0_dp, dim=1))
    cost%points = size(solutions%force, 1)
    cost%degrees = size(loads, 1)
    cost%cases = size(loads, 2)
  end subroutine solve_all

  subroutine write_row(name, cost)
    character(len=*), intent(in) :: name
    type(costs), intent(in) :: cost

    write (output_unit, '(3a,5(i0,a),3(f0.3,a),f0.3,a,es8.1,a)') '| ', name, ' | ', cost%degrees, ' | ', cost%points, &
      ' | ', cost%cases, ' | ', cost%open_least, ' to ', cost%open_most, ' | ', cost%condensing%best, ' s | ', &
      cost%solving%best, ' s | ', cost%recovering%best, ' s | ', 1.0e3_dp*cost%solving%best/cost%cases, ' ms | ', &
      cost%residual, ' |'
    flush (output_unit)
  end subroutine write_row

  subroutine check(info)
    type(fuge_info), intent(in) :: info

    if (info%status == 0) return
    write (output_unit, '(a)') trim(info%message)
    error stop 'a structure was not solved'
  end subroutine check

end program load_cases
