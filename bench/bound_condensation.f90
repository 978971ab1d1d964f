!> Condensation of sparse bodies beside its bound, one factorisation of the same stiffness matrix.
!>
!>     bound_condensation
!>
!> The bound analyses and factorises the matrix by CHOLMOD in its own order, with the supports fixed, and a floating
!> body with as many pins as it has rigid modes. A condensation gives alpha, the gaps by a load, the rigid modes and the
!> checks of the stiffness. Both are measured alternately, and the fastest run of each counts. Writes rows of a Markdown
!> table. CHOLMOD starts threads of its own whatever OMP_NUM_THREADS says; OMP_THREAD_LIMIT=1 prevents that.
program bound_condensation
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_blocks, only: float, hold, make_mesh, mesh
  use bench_problems, only: whole
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_condense, fuge_condensed, fuge_info
  use fuge_sparse, only: fuge_sparse_stiffness
  use fuge_stiffness_type, only: stiffness_factor
  implicit none

  real(dp), parameter :: WANTED = 1.2_dp
  !> Seconds for the repetitions of one row.
  real(dp), parameter :: PATIENCE = 6.0_dp

  call run()

contains

  subroutine run()
    type(mesh) :: block

    write (output_unit, '(a)') '| problem | bound | fuge | ratio | wanted |', '| --- | ---: | ---: | ---: | ---: |'
    call make_mesh([400, 100, 0], 1, block)
    call hold(block)
    call measure('2-D block', block)
    call make_mesh([400, 100, 0], 1, block)
    call float(block)
    call measure('2-D block, floating', block)
    call make_mesh([200, 100, 0], 2, block)
    call hold(block)
    call measure('two 2-D blocks', block)
    call make_mesh([14, 14, 14], 1, block)
    call hold(block)
    call measure('3-D block', block)
    call make_mesh([14, 14, 14], 1, block)
    call float(block)
    call measure('3-D block, floating', block)
  end subroutine run

  subroutine measure(name, block)
    character(len=*), intent(in) :: name
    type(mesh), intent(in) :: block
    type(fuge_sparse_stiffness) :: stiffness
    type(fuge_condensed) :: condensed
    type(fuge_info) :: info
    type(stopwatch) :: bound, condensation
    class(stiffness_factor), allocatable :: factor
    logical :: constrained(size(block%column) - 1)
    real(dp) :: pivots(size(constrained))
    integer :: failed, status

    call stiffness%set(block%column, block%row, block%value, info)
    if (info%failed()) error stop 'the stiffness is refused'
    constrained = .false.
    if (allocated(block%body%fixed)) constrained(block%body%fixed) = .true.
    constrained(block%pinned) = .true.
    bound%budget = PATIENCE/2
    do while (.not. bound%enough() .or. bound%runs < 8)
      call bound%start()
      call stiffness%cholesky(constrained, 0.0_dp, factor, pivots, failed, status)
      call bound%stop()
      if (failed /= 0) error stop 'the bound has not been factorised'
      deallocate (factor)
      call condensation%start()
      call fuge_condense(stiffness, block%body, condensed, info)
      call condensation%stop()
      if (info%status /= 0) error stop 'not condensed'
      call condensed%clear()
    end do
    write (output_unit, '(a, 2(es9.2, a), f6.2, a, f4.1, a)') '| '//name//', '//whole(size(constrained)) &
      //' degrees of freedom, '//whole(size(condensed%alpha, 2))//' points | ', bound%best, ' s | ', &
      condensation%best, ' s | ', condensation%best/bound%best, ' | ', WANTED, ' |'
    flush (output_unit)
  end subroutine measure

end program bound_condensation
