!> Bodies from their stiffness matrices: the times of condensation, and of what follows it.
!>
!>     costs_bodies
!>
!> Blocks of square or cubic elements, held on one side, into whose opposite side a rigid parabola is pressed: from the
!> sparse stiffness matrix to the influence matrix of the contact points, a solve for their forces, and the
!> displacements of all degrees of freedom. Writes rows of a Markdown table with times, the errors that the library
!> reports for the forces and the displacements, and the memory of the condensed body. Processor time, the least of some
!> repetitions, one thread; OMP_THREAD_LIMIT=1 keeps CHOLMOD to it.
program costs_bodies
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_blocks, only: hold, make_mesh, mesh
  use bench_memory, only: forget_peak, peak_resident, resident
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_condense, fuge_condensed, fuge_dense_operator, fuge_info, fuge_problem, &
    fuge_solution, fuge_solver
  use fuge_sparse, only: fuge_sparse_stiffness
  implicit none

  !> Seconds for the repetitions of a condensation, and how deep the parabola is pressed: its height at the side is 1/4.
  real(dp), parameter :: BUDGET = 2.0_dp, DEPTH = 0.05_dp

  call run()

contains

  subroutine run()
    write (output_unit, '(a)') '| body | condensation | a solve | displacements | errors: forces, displacements | ' &
      //'memory |', '| --- | ---: | ---: | ---: | ---: | ---: |'
    call measure('2-D block', [100, 25, 0])
    call measure('2-D block', [400, 100, 0])
    call measure('3-D block', [14, 14, 14])
    call measure('3-D block', [28, 28, 28])
  end subroutine run

  subroutine measure(name, elements)
    character(len=*), intent(in) :: name
    integer, intent(in) :: elements(3)
    type(mesh) :: block
    type(fuge_sparse_stiffness) :: stiffness
    type(fuge_condensed), target :: condensed
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp) :: before, memory
    logical :: forgotten

    call make_mesh(elements, 1, block)
    call hold(block)
    deallocate (block%body%load)
    call stiffness%set(block%column, block%row, block%value, info)
    call check(info)
    call forget_peak(forgotten)
    before = resident()
    watch%budget = BUDGET
    do while (.not. watch%enough())
      call condensed%clear()
      call watch%start()
      call fuge_condense(stiffness, block%body, condensed, info)
      call watch%stop()
      call check(info)
    end do
    memory = -1.0_dp
    if (forgotten .and. before > 0.0_dp) memory = peak_resident() - before
    write (output_unit, '(a,2(i0,a),f0.1,a)', advance='no') '| '//name//', ', size(block%column) - 1, &
      ' degrees of freedom, ', size(condensed%alpha, 2), ' points | ', 1.0e3_dp*watch%best, ' ms |'
    call measure_contact(condensed, size(block%column) - 1, places(elements))
    if (memory < 0.0_dp) then
      write (output_unit, '(a)') ' - |'
    else
      write (output_unit, '(f7.0,a)') 1.0e-6_dp*memory, ' MB |'
    end if
    flush (output_unit)
  end subroutine measure

  !> `place`: where the contact points lie on the face, as fractions of its sides.
  subroutine measure_contact(condensed, degrees, place)
    type(fuge_condensed), intent(in), target :: condensed
    integer, intent(in) :: degrees
    real(dp), intent(in) :: place(:, :)
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info, recovery
    type(stopwatch) :: solving, recovering
    real(dp) :: gap(size(place, 2)), u(degrees)
    integer :: k

    gap = [(sum((place(:, k) - 0.5_dp)**2), k=1, size(gap))]
    problem%prescribed = [.true.]
    problem%motion = [DEPTH]
    call condensed%pose(gap, problem, info)
    call check(info)
    u = 0.0_dp
    do while (.not. solving%enough())
      call solver%reset()
      call solving%start()
      call operator%set(condensed%alpha, info)
      call solver%solve(operator, problem, solution, info)
      call solving%stop()
      call check(info)
    end do
    do while (.not. recovering%enough())
      call recovering%start()
      call condensed%recover(solution, u, recovery)
      call recovering%stop()
      call check(recovery)
    end do
    write (output_unit, '(2(1x,f0.2,a),2(es8.0,a))', advance='no') 1.0e3_dp*solving%best, ' ms |', &
      1.0e3_dp*recovering%best, ' ms | ', info%force_error, ',', recovery%residual, ' |'
  end subroutine measure_contact

  pure function places(elements) result(place)
    integer, intent(in) :: elements(3)
    real(dp), allocatable :: place(:, :)
    integer :: i, j, last

    ! The face of a 2-D block is a line.
    last = merge(elements(2), 0, elements(3) > 0)
    allocate (place(2, (elements(1) + 1)*(last + 1)), source=0.5_dp)
    do j = 0, last
      do i = 0, elements(1)
        place(1, 1 + i + j*(elements(1) + 1)) = real(i, dp)/real(elements(1), dp)
        if (last > 0) place(2, 1 + i + j*(elements(1) + 1)) = real(j, dp)/real(last, dp)
      end do
    end do
  end function places

  subroutine check(info)
    type(fuge_info), intent(in) :: info

    if (info%status == 0) return
    write (output_unit, '(a)') trim(info%message)
    error stop 'a call has failed or warned'
  end subroutine check

end program costs_bodies
