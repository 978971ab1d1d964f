!> What products of a grid whose rows ranks share have in common: transforms of its lines, and buffers.
module fuge_slab_plan
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_intptr_t, c_null_ptr, c_ptr
  use fuge_fft, only: allocate_values, release_buffer
  use fuge_grid_plan, only: grid_plan, stored_waves
  use fuge_number_text, only: text
  use fuge_rank_communicator, only: rank_communicator
  use fuge_slab_exchange, only: slab_exchange
  use fuge_slab_rows, only: block_of_pairs, block_of_waves
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: COLUMNS, NUMBERS

  !> Columns that are convolved together, so that a row of them fills whole lines of the cache.
  integer, parameter :: COLUMNS = 8
  !> Real numbers of an element of an exchange: one wave of both rows of a pair.
  integer, parameter :: NUMBERS = 4
  !> Numbers in a line of the buffers, which are allocated in lines.
  integer, parameter :: STRIDE = 1024

  !> It must not be copied.
  type, public :: slab_plan
    !> Transforms of the lines; plan%cells are those of the whole grid.
    type(grid_plan) :: plan
    !> The ranks that have rows.
    type(rank_communicator) :: group
    !> Pairs of rows of all ranks, in a block, and of this rank; its rows.
    integer :: all_pairs = 0, block = 0, pairs = 0, owned_rows = 0
    !> Transforms of the pairs of rows of this rank, for the other ranks, and of all pairs, the waves of this rank.
    real(c_double), pointer, contiguous :: by_rows(:) => null(), by_columns(:) => null()
    !> Columns, and two lines for work.
    real(c_double), pointer, contiguous :: lines(:, :) => null()
    type(c_ptr), private :: memory(3) = c_null_ptr
  contains
    procedure :: set
    procedure :: describe_exchange
    procedure :: free
  end type slab_plan

contains

  !> Plan for `cells` (2) of the whole grid on circles of `length` (2), or twice that where `padded` (2), shared by the
  !> ranks of `group`. Errors, on any rank: FUGE_ERR_MEMORY.
  subroutine set(self, group, cells, length, padded, ranks, measured, info)
    class(slab_plan), intent(inout) :: self
    type(rank_communicator), intent(in) :: group
    integer, intent(in) :: cells(2), length(2), ranks
    logical, intent(in) :: padded(2), measured
    type(fuge_info), intent(inout) :: info
    type(slab_exchange) :: exchange
    integer(c_intptr_t) :: most(2)
    integer :: k, status(3)

    call self%plan%set(cells, length, info, measured)
    if (info%failed()) return
    self%group = group
    self%all_pairs = (cells(2) + 1)/2
    self%block = block_of_pairs(cells, ranks)
    self%pairs = max(min(self%block, self%all_pairs - group%number()*self%block), 0)
    self%owned_rows = min(2*self%pairs, cells(2) - 2*group%number()*self%block)
    most = 1
    do k = 1, 2
      ! Those of a product, and those of the preconditioner.
      call self%describe_exchange(padded(1) .and. k == 1, exchange)
      most = max(most, [exchange%numbers_by_rows(), exchange%numbers_by_columns()])
    end do
    call allocate_line(most(1), self%memory(1), self%by_rows, status(1))
    call allocate_line(most(2), self%memory(2), self%by_columns, status(2))
    call allocate_values(2*max(maxval(length), 2*self%all_pairs) + 2, COLUMNS + 2, self%memory(3), self%lines, &
                         status(3))
    call require_memory(maxval(abs(status)), 'transforms of '//text(length(1))//' by', length(2), 'values', info)
  end subroutine set

  !> The exchange of a product whose circle along x is `padded` or not.
  subroutine describe_exchange(self, padded, exchange)
    class(slab_plan), intent(in) :: self
    logical, intent(in) :: padded
    type(slab_exchange), intent(inout) :: exchange
    integer :: waves

    waves = stored_waves(self%plan%length(1), padded)
    call exchange%describe(self%group, self%all_pairs, waves, NUMBERS, &
                           [self%block, block_of_waves(waves, self%group%members())])
  end subroutine describe_exchange

  !> `values`: at least `numbers` real numbers, aligned for FFTW. `status` as for allocate_values.
  subroutine allocate_line(numbers, memory, values, status)
    integer(c_intptr_t), intent(in) :: numbers
    type(c_ptr), intent(out) :: memory
    real(c_double), pointer, contiguous, intent(out) :: values(:)
    integer, intent(out) :: status
    real(c_double), pointer, contiguous :: table(:, :)
    integer :: columns

    columns = int((numbers - 1)/STRIDE + 1)
    call allocate_values(STRIDE, columns, memory, table, status)
    nullify (values)
    if (status == 0) call c_f_pointer(memory, values, [int(STRIDE, c_intptr_t)*columns])
  end subroutine allocate_line

  !> Free the buffers.
  subroutine free(self)
    class(slab_plan), intent(inout) :: self
    integer :: k

    do k = 1, size(self%memory)
      if (c_associated(self%memory(k))) call release_buffer(self%memory(k))
      self%memory(k) = c_null_ptr
    end do
    nullify (self%by_rows, self%by_columns, self%lines)
  end subroutine free

end module fuge_slab_plan
