!> What many load cases of one structure cost.
!>
!>     load_cases
!>
!> A truss of the tests with 200 cables, a girder on 200 bearings that press only, and the raft of the examples, 40 x 40
!> plates on a bed that does not pull, under random combinations of 12 basic loads: from the stiffness matrix to forces,
!> displacements and their envelopes. Writes rows of a Markdown table. Processor time, one thread, the least of some
!> repetitions. OMP_NUM_THREADS=1 keeps CHOLMOD and BLAS to one thread.
program load_cases
  use, intrinsic :: iso_fortran_env, only: int64, output_unit
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_band_stiffness, fuge_body, fuge_case_solutions, fuge_condense, fuge_condensed, &
    fuge_dense_operator, fuge_dense_stiffness, fuge_envelope, fuge_find_envelope, fuge_info, fuge_load_cases, &
    fuge_problem, fuge_solve_cases, fuge_solver, fuge_stiffness
  use fuge_sparse, only: fuge_sparse_stiffness
  use one_way_structures, only: one_way_structure
  use raft_plates, only: raft_stiffness
  use random_draws, only: uniform
  use random_structures, only: draw_truss
  implicit none

  !> Loads that combinations are made of.
  integer, parameter :: BASIC = 12
  integer, parameter :: CABLES = 200, BEARINGS = 200, PLATES = 40

  !> One-way links: their gaps and compliances, (links).
  type :: link_laws
    real(dp), allocatable :: gap(:), compliance(:)
  end type link_laws

  !> Times in seconds, and what came out.
  type :: costs
    type(stopwatch) :: condensing, solving, recovering
    real(dp) :: residual = 0.0_dp
    integer :: least = 0, most = 0, iterations = 0
  end type costs

  call run()

contains

  subroutine run()
    write (output_unit, '(a)') '| structure | degrees of freedom | links | cases | of them carry | condensation | ' &
      //'solves | displacements, envelopes | a case | sets a case | residual |', &
      '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
    call measure_truss(1000)
    call measure_truss(10000)
    call measure_girder(1000)
    call measure_raft(500)
  end subroutine run

  !> Crossing cables in a frame of bars.
  subroutine measure_truss(cases)
    integer, intent(in) :: cases
    type(one_way_structure), target :: structure
    type(fuge_dense_stiffness) :: stiffness
    type(fuge_body) :: body
    type(fuge_info) :: info
    real(dp), allocatable :: loads(:, :)

    call draw_truss(1, CABLES, structure)
    call stiffness%set(structure%stiffness, info)
    call check(info)
    body%floats = structure%floats
    body%dof = structure%dof
    body%normal = structure%normal
    allocate (loads(structure%degrees(), cases))
    call combine(1, 1.0_dp, 0.0_dp, loads)
    call measure('truss with cables', stiffness, body, link_laws(structure%gap, structure%compliance), loads)
  end subroutine measure_truss

  !> Beam elements of length 1, with a bearing below each node but the outermost ones.
  subroutine measure_girder(cases)
    integer, intent(in) :: cases
    integer, parameter :: DEGREES = 2*(BEARINGS + 2)
    type(fuge_band_stiffness) :: stiffness
    type(fuge_body) :: body
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
    call rest_on([(2*i + 1, i=1, BEARINGS)], body)
    call combine(2, 0.6_dp, 2.0_dp, loads)
    call measure('girder on bearings', stiffness, body, even_bed(BEARINGS, 1.0e-2_dp), loads)
  end subroutine measure_girder

  subroutine measure_raft(cases)
    integer, intent(in) :: cases
    integer, parameter :: NODES = (PLATES + 1)**2
    type(fuge_sparse_stiffness) :: stiffness
    type(fuge_body) :: body
    type(fuge_info) :: info
    real(dp) :: loads(3*NODES, cases)
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
    integer :: k

    call raft_stiffness(PLATES, 1.0_dp, 1.0e2_dp, 0.2_dp, column, row, value)
    call stiffness%set(column, row, value, info)
    call check(info)
    call rest_on([(3*k - 2, k=1, NODES)], body)
    call combine(3, 0.8_dp, 0.2_dp, loads)
    call measure('raft on a bed', stiffness, body, even_bed(NODES, 1.0_dp), loads)
  end subroutine measure_raft

  !> Bearings alone, below these degrees of freedom, hold the body.
  subroutine rest_on(dof, body)
    integer, intent(in) :: dof(:)
    type(fuge_body), intent(inout) :: body

    body%floats = .true.
    body%dof = reshape(dof, [1, size(dof)])
    body%normal = spread(spread(1.0_dp, 1, size(dof)), 1, 1)
  end subroutine rest_on

  pure function even_bed(links, compliance) result(laws)
    integer, intent(in) :: links
    real(dp), intent(in) :: compliance
    type(link_laws) :: laws

    allocate (laws%gap(links), source=0.0_dp)
    allocate (laws%compliance(links), source=compliance)
  end function even_bed

  !> Random combinations, with factors from 0 to 1.5, of basic loads, and the `weight` of each deflection, every
  !> `step`th degree of freedom from the first on. A basic load acts on a twentieth of them, with forces from -20 to
  !> `lift` times 20.
  subroutine combine(step, lift, weight, loads)
    integer, intent(in) :: step
    real(dp), intent(in) :: lift, weight
    real(dp), intent(out) :: loads(:, :)
    real(dp) :: base(size(loads, 1), BASIC), factors(BASIC, size(loads, 2))
    integer(int64) :: seed
    integer :: b, j, k

    seed = 7_int64
    base = 0.0_dp
    do b = 1, BASIC
      do j = 1, size(loads, 1), step
        if (uniform(seed, 0.0_dp, 1.0_dp) < 0.05_dp) base(j, b) = 20.0_dp*uniform(seed, -1.0_dp, lift)
      end do
    end do
    do k = 1, size(factors, 2)
      do b = 1, BASIC
        factors(b, k) = uniform(seed, 0.0_dp, 1.5_dp)
      end do
    end do
    loads = matmul(base, factors)
    loads(1::step, :) = loads(1::step, :) - weight
  end subroutine combine

  subroutine measure(name, stiffness, body, laws, loads)
    character(len=*), intent(in) :: name
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    type(link_laws), intent(in) :: laws
    real(dp), intent(in) :: loads(:, :)
    type(costs) :: cost

    do while (.not. cost%solving%enough())
      call solve_all(stiffness, body, laws, loads, cost)
    end do
    associate (cases => size(loads, 2))
      write (output_unit, '(3a,5(i0,a),3(f0.3,a),f0.3,a,f0.1,a,es8.1,a)') '| ', name, ' | ', size(loads, 1), ' | ', &
        size(laws%gap), ' | ', cases, ' | ', cost%least, ' to ', cost%most, ' | ', cost%condensing%best, ' s | ', &
        cost%solving%best, ' s | ', cost%recovering%best, ' s | ', 1.0e3_dp*cost%solving%best/cases, ' ms | ', &
        real(cost%iterations, dp)/cases, ' | ', cost%residual, ' |'
    end associate
    flush (output_unit)
  end subroutine measure

  !> From the stiffness matrix to the envelopes, once more.
  subroutine solve_all(stiffness, body, laws, loads, cost)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    type(link_laws), intent(in) :: laws
    real(dp), intent(in) :: loads(:, :)
    type(costs), intent(inout) :: cost
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
    call fuge_condense(stiffness, body, condensed, info)
    call check(info)
    allocate (problem%modes(size(laws%gap), 0), problem%resultant(0))
    problem%compliance = laws%compliance
    call condensed%pose_cases(laws%gap, loads, problem, combinations, info)
    call check(info)
    call cost%condensing%stop()
    call cost%solving%start()
    call operator%set(condensed%alpha, info)
    call check(info)
    call fuge_solve_cases(solver, operator, problem, combinations, solutions, info)
    call check(info)
    call cost%solving%stop()
    cost%residual = info%residual
    cost%iterations = info%iterations
    call cost%recovering%start()
    allocate (u(size(loads, 1), size(loads, 2)), source=0.0_dp)
    call condensed%recover_cases(loads, solutions, u, info)
    call check(info)
    call fuge_find_envelope(solutions%force, forces, info)
    call check(info)
    call fuge_find_envelope(u, displacements, info)
    call check(info)
    call cost%recovering%stop()
    cost%least = minval(count(solutions%force > 0.0_dp, dim=1))
    cost%most = maxval(count(solutions%force > 0.0_dp, dim=1))
  end subroutine solve_all

  !> Stop on an error; a warning of displacements that have lost digits is none.
  subroutine check(info)
    type(fuge_info), intent(in) :: info

    if (.not. info%failed()) return
    write (output_unit, '(a)') trim(info%message)
    error stop 'a structure was not solved'
  end subroutine check

end program load_cases
