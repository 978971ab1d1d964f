!> Stiffness matrices in the memory of C. They are read when everything is known that they are checked against.
module fuge_c_stiffness_sources
  use, intrinsic :: iso_c_binding, only: c_int, c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_c_types, only: from_zero
  use fuge_status, only: fuge_info, require_memory
  use fuge_stiffness_band, only: fuge_band_stiffness
  use fuge_stiffness_dense, only: fuge_dense_stiffness
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  type, abstract, public :: stiffness_source
  contains
    !> The stiffness matrix in the storage in which it is to be factorised.
    procedure(read_stiffness), deferred :: read
    !> The same in compressed columns that count from 1, as in `fuge_elastic_body`.
    procedure(copy_columns), deferred :: columns
  end type stiffness_source

  abstract interface
    subroutine read_stiffness(self, stiffness, info)
      import :: stiffness_source, fuge_stiffness, fuge_info
      class(stiffness_source), intent(in) :: self
      class(fuge_stiffness), allocatable, intent(out) :: stiffness
      type(fuge_info), intent(out) :: info
    end subroutine read_stiffness

    !> Error: FUGE_ERR_MEMORY.
    subroutine copy_columns(self, column, row, value, info)
      import :: stiffness_source, fuge_info, c_double
      class(stiffness_source), intent(in) :: self
      integer, allocatable, intent(out) :: column(:), row(:)
      real(c_double), allocatable, intent(out) :: value(:)
      type(fuge_info), intent(inout) :: info
    end subroutine copy_columns
  end interface

  type, extends(stiffness_source), public :: dense_source
    real(c_double), pointer :: matrix(:, :) => null()
  contains
    procedure :: read => read_dense
    procedure :: columns => dense_columns
  end type dense_source

  !> LAPACK's band storage with `width` diagonals beside the main one.
  type, extends(stiffness_source), public :: band_source
    real(c_double), pointer :: band(:, :) => null()
    integer :: width = 0
    logical :: upper = .true.
  contains
    procedure :: read => read_band
    procedure :: columns => band_columns
  end type band_source

  !> Compressed columns that count from 0, whose factor has the kind of storage of `storage`.
  type, extends(stiffness_source), public :: columns_source
    integer(c_int), pointer :: column(:) => null(), row(:) => null()
    real(c_double), pointer :: value(:) => null()
    class(fuge_stiffness), allocatable :: storage
  contains
    procedure :: read => read_columns
    procedure :: columns => columns_from_one
  end type columns_source

contains

  subroutine read_dense(self, stiffness, info)
    class(dense_source), intent(in) :: self
    class(fuge_stiffness), allocatable, intent(out) :: stiffness
    type(fuge_info), intent(out) :: info
    type(fuge_dense_stiffness), allocatable :: dense

    allocate (dense)
    call dense%set(self%matrix, info)
    call move_alloc(dense, stiffness)
  end subroutine read_dense

  !> The entries that are not zero; NaN is one.
  subroutine dense_columns(self, column, row, value, info)
    class(dense_source), intent(in) :: self
    integer, allocatable, intent(out) :: column(:), row(:)
    real(c_double), allocatable, intent(out) :: value(:)
    type(fuge_info), intent(inout) :: info
    integer :: i, j, n

    n = size(self%matrix, 2)
    call make_columns(n, count(.not. abs(self%matrix(:n, :)) <= 0.0_c_double, kind=int64), column, row, value, info)
    if (info%failed()) return
    column(1) = 1
    do j = 1, n
      column(j + 1) = column(j)
      do i = 1, n
        if (abs(self%matrix(i, j)) <= 0.0_c_double) cycle
        row(column(j + 1)) = i
        value(column(j + 1)) = self%matrix(i, j)
        column(j + 1) = column(j + 1) + 1
      end do
    end do
  end subroutine dense_columns

  !> Room for compressed columns. Error: FUGE_ERR_MEMORY, also for more entries than an integer counts.
  pure subroutine make_columns(degrees, entries, column, row, value, info)
    integer, intent(in) :: degrees
    integer(int64), intent(in) :: entries
    integer, allocatable, intent(inout) :: column(:), row(:)
    real(c_double), allocatable, intent(inout) :: value(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    stat = 1
    if (entries <= huge(degrees)) allocate (column(degrees + 1), row(entries), value(entries), stat=stat)
    call require_memory(stat, 'a copy of the stiffness of', degrees, 'degrees of freedom', info)
  end subroutine make_columns

  subroutine read_band(self, stiffness, info)
    class(band_source), intent(in) :: self
    class(fuge_stiffness), allocatable, intent(out) :: stiffness
    type(fuge_info), intent(out) :: info
    type(fuge_band_stiffness), allocatable :: band

    allocate (band)
    call band%set(self%band, self%upper, info, self%width)
    call move_alloc(band, stiffness)
  end subroutine read_band

  !> One triangle, the zeros within the band included.
  subroutine band_columns(self, column, row, value, info)
    class(band_source), intent(in) :: self
    integer, allocatable, intent(out) :: column(:), row(:)
    real(c_double), allocatable, intent(out) :: value(:)
    type(fuge_info), intent(inout) :: info
    integer :: first, i, j, last, n

    n = size(self%band, 2)
    call make_columns(n, n*(self%width + 1_int64), column, row, value, info)
    if (info%failed()) return
    column(1) = 1
    do j = 1, n
      first = merge(max(1, j - self%width), j, self%upper)
      last = merge(j, min(n, j + self%width), self%upper)
      column(j + 1) = column(j) + last - first + 1
      row(column(j):column(j + 1) - 1) = [(i, i=first, last)]
      ! The first row of the band is that of the diagonal, or as many rows above it as the band is wide.
      i = merge(self%width, 0, self%upper) + 1 - j
      value(column(j):column(j + 1) - 1) = self%band(i + first:i + last, j)
    end do
  end subroutine band_columns

  subroutine read_columns(self, stiffness, info)
    class(columns_source), intent(in) :: self
    class(fuge_stiffness), allocatable, intent(out) :: stiffness
    type(fuge_info), intent(out) :: info

    allocate (stiffness, mold=self%storage)
    call stiffness%set_columns(from_zero(self%column), from_zero(self%row), self%value, info)
  end subroutine read_columns

  subroutine columns_from_one(self, column, row, value, info)
    class(columns_source), intent(in) :: self
    integer, allocatable, intent(out) :: column(:), row(:)
    real(c_double), allocatable, intent(out) :: value(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    call make_columns(size(self%column) - 1, size(self%row, kind=int64), column, row, value, info)
    if (info%failed()) return
    column = from_zero(self%column)
    do k = 1, size(row)
      row(k) = from_zero(self%row(k))
      value(k) = self%value(k)
    end do
  end subroutine columns_from_one

end module fuge_c_stiffness_sources
