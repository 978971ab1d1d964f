!> Cholesky factor of a sparse matrix by CHOLMOD, with chosen rows eliminated last.
module fuge_cholmod_factor
  use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_null_ptr, c_associated
  use fuge_compressed_columns, only: compressed_columns
  use fuge_kinds, only: dp
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY
  use fuge_stiffness_type, only: stiffness_factor
  implicit none
  private

  !> What fuge_cholmod_factorise returns.
  integer(c_int), parameter :: DONE = 0, NOT_DEFINITE = 1

  type, extends(stiffness_factor), public :: cholmod_factor
    type(c_ptr), private :: handle = c_null_ptr
  contains
    procedure :: factorise
    procedure :: solve
    procedure :: copy_schur_factor
    procedure :: replace_schur_factor
    final :: release
  end type cholmod_factor

  interface
    !> Factor and pivots (n). `order` (last): on entry the rows to eliminate last, on return their order of
    !> elimination; all zero if that order is not worthwhile for `columns` solves. `failed` is the row at which a
    !> factorisation stopped, else 0. Result: 0 done, 1 not definite, 2 no memory. The arguments are ten, because C
    !> takes the columns of the matrix as plain arrays.
    function cholmod_factorise(n, column, row, value, last, order, columns, factor, pivots, failed) &
      bind(c, name='fuge_cholmod_factorise') result(status)
      import :: c_int, c_double, c_ptr
      integer(c_int), intent(in), value :: n, last, columns
      integer(c_int), intent(in) :: column(*), row(*)
      real(c_double), intent(in) :: value(*)
      integer(c_int), intent(inout) :: order(*)
      type(c_ptr), intent(out) :: factor
      real(c_double), intent(out) :: pivots(*)
      integer(c_int), intent(out) :: failed
      integer(c_int) :: status
    end function cholmod_factorise

    function cholmod_solve(factor, n, columns, block) bind(c, name='fuge_cholmod_solve') result(status)
      import :: c_int, c_double, c_ptr
      type(c_ptr), intent(in), value :: factor
      integer(c_int), intent(in), value :: n, columns
      real(c_double), intent(inout) :: block(n, *)
      integer(c_int) :: status
    end function cholmod_solve

    !> The lower triangle of the last columns of the factor, the rest of `root` unchanged.
    subroutine cholmod_copy_last(factor, last, root) bind(c, name='fuge_cholmod_copy_last')
      import :: c_int, c_double, c_ptr
      type(c_ptr), intent(in), value :: factor
      integer(c_int), intent(in), value :: last
      real(c_double), intent(inout) :: root(last, *)
    end subroutine cholmod_copy_last

    !> Replace the lower triangle of the last columns of the factor by that of `root`, and the rows `isolated`, counted
    !> among the last ones, of all other columns by zero.
    subroutine cholmod_replace_last(factor, last, root, count, isolated) bind(c, name='fuge_cholmod_replace_last')
      import :: c_int, c_double, c_ptr
      type(c_ptr), intent(in), value :: factor
      integer(c_int), intent(in), value :: last, count
      real(c_double), intent(in) :: root(last, *)
      integer(c_int), intent(in) :: isolated(*)
    end subroutine cholmod_replace_last

    subroutine cholmod_free(factor) bind(c, name='fuge_cholmod_free')
      import :: c_ptr
      type(c_ptr), intent(in), value :: factor
    end subroutine cholmod_free
  end interface

contains

  !> Factorise a symmetric matrix, given by its upper triangle, with the rows `last` at the end of the order if that
  !> costs less than `columns` solves. Other arguments as in `fuge_stiffness_type`.
  subroutine factorise(self, matrix, last, columns, pivots, failed, status)
    class(cholmod_factor), intent(inout) :: self
    type(compressed_columns), intent(in) :: matrix
    integer, intent(in) :: last(:), columns
    real(dp), intent(out) :: pivots(:)
    integer, intent(out) :: failed, status
    integer(c_int), allocatable :: order(:)
    integer(c_int) :: outcome, stopped_at

    failed = 0
    status = FUGE_ERR_MEMORY
    allocate (order, source=int(last, c_int))
    outcome = cholmod_factorise(int(size(pivots), c_int), matrix%column, matrix%row, matrix%value, &
                                size(last, kind=c_int), order, int(columns, c_int), self%handle, pivots, stopped_at)
    failed = int(stopped_at)
    if (outcome == DONE .or. outcome == NOT_DEFINITE) status = FUGE_DONE
    if (outcome == DONE .and. all(order > 0) .and. size(order) > 0) self%last = int(order)
  end subroutine factorise

  !> Replace loads by displacements; arguments as in `fuge_stiffness_type`.
  subroutine solve(self, block, status)
    class(cholmod_factor), intent(in) :: self
    real(dp), intent(inout), contiguous :: block(:, :)
    integer, intent(out) :: status
    integer(c_int) :: outcome

    outcome = cholmod_solve(self%handle, int(size(block, 1), c_int), int(size(block, 2), c_int), block)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, outcome == DONE)
  end subroutine solve

  !> Factor of the Schur complement of `last`; arguments as in `fuge_stiffness_type`.
  subroutine copy_schur_factor(self, root, status)
    class(cholmod_factor), intent(in) :: self
    real(dp), allocatable, intent(out) :: root(:, :)
    integer, intent(out) :: status
    integer :: p, stat

    status = FUGE_ERR_MEMORY
    p = 0
    if (allocated(self%last)) p = size(self%last)
    allocate (root(p, p), stat=stat)
    if (stat /= 0) return
    root = 0.0_dp
    if (p > 0) call cholmod_copy_last(self%handle, int(p, c_int), root)
    status = FUGE_DONE
  end subroutine copy_schur_factor

  !> Replace the factor of the Schur complement of `last`; arguments as in `fuge_stiffness_type`.
  subroutine replace_schur_factor(self, root, isolated)
    class(cholmod_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: root(:, :)
    integer, intent(in) :: isolated(:)

    call cholmod_replace_last(self%handle, size(root, 2, kind=c_int), root, size(isolated, kind=c_int), &
                              int(isolated, c_int))
  end subroutine replace_schur_factor

  !> Free the factor of CHOLMOD.
  subroutine release(self)
    type(cholmod_factor), intent(inout) :: self

    if (c_associated(self%handle)) call cholmod_free(self%handle)
    self%handle = c_null_ptr
  end subroutine release

end module fuge_cholmod_factor
