!> Transposition of a matrix whose rows are shared by the ranks of a communicator, by FFTW; the only module that calls
!> FFTW's part for MPI.
!>
!> The matrix has elements of several numbers each. A rank has a block of rows, and afterwards a block of columns.
module fuge_slab_transpose
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int, c_int32_t, c_intptr_t, c_loc, c_null_ptr, c_ptr
  use fuge_fft, only: begin_planning, end_planning
  use fuge_rank_communicator, only: mpi_is_running, rank_communicator
  use mpi_f08, only: MPI_Comm
  implicit none
  private

  public :: local_numbers

  integer(c_int), parameter :: FFTW_MEASURE = 0, FFTW_ESTIMATE = 64, FFTW_DESTROY_INPUT = 1

  !> Transposition there and back, between two buffers of each rank. It must not be copied.
  type, public :: slab_transpose
    type(c_ptr), private :: there = c_null_ptr, back = c_null_ptr
  contains
    procedure :: set
    procedure :: forth
    procedure :: back_again
    procedure :: free
  end type slab_transpose

  interface
    subroutine fftw_mpi_init() bind(c, name='fftw_mpi_init')
    end subroutine fftw_mpi_init

    function fftw_local_size(dimensions, n, numbers, block0, block1, comm, count0, start0, count1, start1) &
      bind(c, name='fftw_mpi_local_size_many_transposed_f03') result(size)
      import :: c_int, c_int32_t, c_intptr_t
      integer(c_int), intent(in), value :: dimensions
      integer(c_intptr_t), intent(in) :: n(*)
      integer(c_intptr_t), intent(in), value :: numbers, block0, block1
      integer(c_int32_t), intent(in), value :: comm
      integer(c_intptr_t), intent(out) :: count0, start0, count1, start1
      integer(c_intptr_t) :: size
    end function fftw_local_size

    function fftw_plan_transpose(n0, n1, numbers, block0, block1, in, out, comm, flags) &
      bind(c, name='fftw_mpi_plan_many_transpose_f03') result(plan)
      import :: c_int, c_int32_t, c_intptr_t, c_ptr
      integer(c_intptr_t), intent(in), value :: n0, n1, numbers, block0, block1
      type(c_ptr), intent(in), value :: in, out
      integer(c_int32_t), intent(in), value :: comm
      integer(c_int), intent(in), value :: flags
      type(c_ptr) :: plan
    end function fftw_plan_transpose

    subroutine fftw_execute_transpose(plan, in, out) bind(c, name='fftw_mpi_execute_r2r')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan, in, out
    end subroutine fftw_execute_transpose

    subroutine fftw_destroy_plan(plan) bind(c, name='fftw_destroy_plan')
      import :: c_ptr
      type(c_ptr), intent(in), value :: plan
    end subroutine fftw_destroy_plan
  end interface

contains

  !> How many real numbers each buffer of a transposition has to hold: `rows` by `columns` elements of `numbers`
  !> numbers, in blocks (2) of rows and of columns. The first call starts FFTW's part for MPI.
  function local_numbers(group, rows, columns, numbers, blocks) result(count)
    type(rank_communicator), intent(in) :: group
    integer, intent(in) :: rows, columns, numbers, blocks(2)
    integer(c_intptr_t) :: count
    integer(c_intptr_t) :: count0, count1, start0, start1
    type(MPI_Comm) :: comm

    comm = group%comm()
    call begin_planning()
    call fftw_mpi_init()
    count = fftw_local_size(2_c_int, int([rows, columns], c_intptr_t), int(numbers, c_intptr_t), &
                            int(blocks(1), c_intptr_t), int(blocks(2), c_intptr_t), int(comm%MPI_VAL, c_int32_t), &
                            count0, start0, count1, start1)
    call end_planning()
    count = max(count, 1_c_intptr_t)
  end function local_numbers

  !> Plan for a matrix as for `local_numbers`, between these buffers; all ranks of the group call it. `planned` is false
  !> without memory.
  subroutine set(self, group, rows, columns, numbers, blocks, measured, one, other, planned)
    class(slab_transpose), intent(inout) :: self
    type(rank_communicator), intent(in) :: group
    integer, intent(in) :: rows, columns, numbers, blocks(2)
    logical, intent(in) :: measured
    real(c_double), intent(inout), contiguous, target :: one(:), other(:)
    logical, intent(out) :: planned
    integer(c_intptr_t) :: n(2), b(2)
    type(MPI_Comm) :: comm
    integer(c_int) :: flags

    comm = group%comm()
    n = int([rows, columns], c_intptr_t)
    b = int(blocks, c_intptr_t)
    flags = merge(FFTW_MEASURE, FFTW_ESTIMATE, measured) + FFTW_DESTROY_INPUT
    call self%free()
    call begin_planning()
    call fftw_mpi_init()
    self%there = fftw_plan_transpose(n(1), n(2), int(numbers, c_intptr_t), b(1), b(2), c_loc(one), c_loc(other), &
                                     int(comm%MPI_VAL, c_int32_t), flags)
    self%back = fftw_plan_transpose(n(2), n(1), int(numbers, c_intptr_t), b(2), b(1), c_loc(other), c_loc(one), &
                                    int(comm%MPI_VAL, c_int32_t), flags)
    call end_planning()
    planned = c_associated(self%there) .and. c_associated(self%back)
  end subroutine set

  !> From rows to columns; `from`, whose contents are lost, and `to` are the buffers of `set`, or others as aligned.
  subroutine forth(self, from, to)
    class(slab_transpose), intent(in) :: self
    real(c_double), intent(inout), contiguous, target :: from(:), to(:)

    call fftw_execute_transpose(self%there, c_loc(from), c_loc(to))
  end subroutine forth

  !> From columns to rows.
  subroutine back_again(self, from, to)
    class(slab_transpose), intent(in) :: self
    real(c_double), intent(inout), contiguous, target :: from(:), to(:)

    call fftw_execute_transpose(self%back, c_loc(from), c_loc(to))
  end subroutine back_again

  !> Destroy the plans, unless MPI has ended, which they need.
  subroutine free(self)
    class(slab_transpose), intent(inout) :: self

    if (mpi_is_running()) then
      call begin_planning()
      if (c_associated(self%there)) call fftw_destroy_plan(self%there)
      if (c_associated(self%back)) call fftw_destroy_plan(self%back)
      call end_planning()
    end if
    self%there = c_null_ptr
    self%back = c_null_ptr
  end subroutine free

end module fuge_slab_transpose
