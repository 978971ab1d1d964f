!> A stiffness matrix K as condensation needs it: its diagonal, its products, and its Cholesky
!> factor with enough degrees of freedom constrained. Each kind of storage extends it.
module fuge_stiffness_type
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  !> Cholesky factor of a stiffness matrix without the constrained degrees of freedom.
  type, abstract, public :: stiffness_factor
    !> The degrees of freedom that have been eliminated last, in that order. Not allocated: no such order.
    integer, allocatable :: last(:)
  contains
    !> Replace loads by displacements.
    procedure(solve_for_block), deferred :: solve
    procedure :: copy_schur_factor
    procedure :: replace_schur_factor
  end type stiffness_factor

  !> A symmetric stiffness matrix, force per displacement.
  type, abstract, public :: fuge_stiffness
    !> Degrees of freedom to eliminate last, not constrained, so that the factor ends with that of their Schur
    !> complement. Not allocated: any order. A storage that cannot choose its order ignores them.
    integer, allocatable :: last(:)
    !> Number of solves that are saved if `last` is eliminated last: that order is used if it costs less than these.
    integer :: columns = 0
    !> The diagonal terms of `last` are multiplied by 1 + `stiffening` before the factorisation.
    real(dp) :: stiffening = 0.0_dp
  contains
    !> Copy a matrix in compressed columns, whatever the storage.
    procedure(set_compressed_columns), deferred :: set_columns
    !> Number of degrees of freedom; 0 before the matrix is set.
    procedure(count_degrees), deferred :: degrees
    !> The diagonal of K.
    procedure(get_diagonal), deferred :: diagonal
    !> K u, and |K| |u|, which scales the rounding error of K u.
    procedure(multiply_vector), deferred :: multiply
    !> Cholesky factor and all its pivots, in the storage of the extension.
    procedure(factorise_storage), deferred :: cholesky
    procedure :: can_order
    procedure :: copy_columns
    procedure :: factorise
  end type fuge_stiffness

  abstract interface
    !> Copy a stiffness matrix in compressed columns, counted from 1; nothing else refers to the arrays afterwards.
    !>
    !> `column` (degrees + 1), `row` and `value` (column(degrees + 1) - 1): column j holds the entries
    !> column(j) .. column(j + 1) - 1, force per displacement. The rows of a column may be in any order, repeated
    !> entries are added; the matrix has both triangles, or one of them.
    !> Errors, the stiffness unchanged: FUGE_ERR_SIZE, FUGE_ERR_DOF for a row out of range, FUGE_ERR_NOT_FINITE,
    !> FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_MEMORY.
    subroutine set_compressed_columns(self, column, row, value, info)
      import :: fuge_stiffness, fuge_info, dp
      class(fuge_stiffness), intent(inout) :: self
      integer, intent(in) :: column(:), row(:)
      real(dp), intent(in) :: value(:)
      type(fuge_info), intent(out) :: info
    end subroutine set_compressed_columns

    !> Number of degrees of freedom; 0 before the matrix is set.
    pure function count_degrees(self) result(degrees)
      import :: fuge_stiffness
      class(fuge_stiffness), intent(in) :: self
      integer :: degrees
    end function count_degrees

    !> The diagonal of K: `terms` (degrees), force per displacement.
    pure subroutine get_diagonal(self, terms)
      import :: fuge_stiffness, dp
      class(fuge_stiffness), intent(in) :: self
      real(dp), intent(out) :: terms(:)
    end subroutine get_diagonal

    !> `u` (degrees); `product` = K u and `magnitude` = |K| |u|, (degrees), force.
    pure subroutine multiply_vector(self, u, product, magnitude)
      import :: fuge_stiffness, dp
      class(fuge_stiffness), intent(in) :: self
      real(dp), intent(in) :: u(:)
      real(dp), intent(out) :: product(:), magnitude(:)
    end subroutine multiply_vector

    !> Cholesky factor of K with the `constrained` rows and columns (degrees) replaced by those
    !> of the identity, and each other diagonal term multiplied by 1 + `shift`.
    !>
    !> `pivots` (degrees): squares of the diagonal of the factor. `failed` is the degree of
    !> freedom at which a factorisation stopped because K is not definite, else 0.
    !> `status` is FUGE_DONE or FUGE_ERR_MEMORY. `factor` is allocated if `status` is FUGE_DONE
    !> and `failed` is 0.
    subroutine factorise_storage(self, constrained, shift, factor, pivots, failed, status)
      import :: fuge_stiffness, stiffness_factor, dp
      class(fuge_stiffness), intent(in) :: self
      logical, intent(in) :: constrained(:)
      real(dp), intent(in) :: shift
      class(stiffness_factor), allocatable, intent(out) :: factor
      real(dp), intent(out) :: pivots(:)
      integer, intent(out) :: failed, status
    end subroutine factorise_storage

    !> `block` (degrees, any number): on entry loads, zero where constrained; on return
    !> displacements, zero where constrained. `status` is FUGE_DONE or FUGE_ERR_MEMORY.
    subroutine solve_for_block(self, block, status)
      import :: stiffness_factor, dp
      class(stiffness_factor), intent(in) :: self
      real(dp), intent(inout), contiguous :: block(:, :)
      integer, intent(out) :: status
    end subroutine solve_for_block
  end interface

contains

  !> Lower Cholesky factor of the Schur complement of `last`: `root` (size(last), size(last)), zero above the diagonal.
  !> A storage that chooses its order overrides it; without `last` the root is empty.
  subroutine copy_schur_factor(self, root, status)
    class(stiffness_factor), intent(in) :: self
    real(dp), allocatable, intent(out) :: root(:, :)
    integer, intent(out) :: status

    status = FUGE_ERR_MEMORY
    if (allocated(self%last)) return
    allocate (root(0, 0))
    status = FUGE_DONE
  end subroutine copy_schur_factor

  !> Replace the factor of the Schur complement of `last` by `root` (size(last), size(last)), lower, of which the rows
  !> and columns `isolated` (any number) are those of the identity: these degrees of freedom become constrained.
  !> A storage that chooses its order overrides it.
  subroutine replace_schur_factor(self, root, isolated)
    class(stiffness_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: root(:, :)
    integer, intent(in) :: isolated(:)

    if (allocated(self%last) .and. size(root) < size(isolated)) deallocate (self%last)
  end subroutine replace_schur_factor

  !> Does the storage choose its order of elimination, and so take `last` into account?
  pure function can_order(self)
    class(fuge_stiffness), intent(in) :: self
    logical :: can_order

    can_order = .false.
    if (self%degrees() < 1) return
  end function can_order

  !> `block` (degrees, size(chosen)): the columns `chosen` of K.
  subroutine copy_columns(self, chosen, block)
    class(fuge_stiffness), intent(in) :: self
    integer, intent(in) :: chosen(:)
    real(dp), intent(out), contiguous :: block(:, :)
    real(dp), allocatable :: unit(:), magnitude(:)
    integer :: k

    allocate (unit(size(block, 1)), magnitude(size(block, 1)))
    do k = 1, size(chosen)
      unit = 0.0_dp
      unit(chosen(k)) = 1.0_dp
      call self%multiply(unit, block(:, k), magnitude)
    end do
  end subroutine copy_columns

  !> Cholesky factor of K without the `constrained` rows and columns (degrees), and its least
  !> pivot.
  !>
  !> Each diagonal term of K is multiplied by 1 + `shift`. `pivot` is the least pivot relative
  !> to the diagonal term of K, at the degree of freedom `weakest`, which is 0 if no pivot is
  !> less than 1. If K is not definite, `pivot` is 0 and `factor` is not allocated.
  !> `status` is FUGE_DONE or FUGE_ERR_MEMORY.
  subroutine factorise(self, constrained, shift, factor, pivot, weakest, status)
    class(fuge_stiffness), intent(in) :: self
    logical, intent(in) :: constrained(:)
    real(dp), intent(in) :: shift
    class(stiffness_factor), allocatable, intent(out) :: factor
    real(dp), intent(out) :: pivot
    integer, intent(out) :: weakest, status
    real(dp), allocatable :: pivots(:), terms(:)
    integer :: stat

    pivot = 0.0_dp
    weakest = 0
    status = FUGE_ERR_MEMORY
    allocate (pivots(size(constrained)), terms(size(constrained)), stat=stat)
    if (stat /= 0) return
    call self%cholesky(constrained, shift, factor, pivots, weakest, status)
    if (.not. allocated(factor)) return
    call self%diagonal(terms)
    call find_least_pivot(pivots, terms, constrained, pivot, weakest)
    ! A factor L D L^T is computed to the end even if K is indefinite.
    if (.not. pivot > 0.0_dp) deallocate (factor)
  end subroutine factorise

  !> The least of the pivots relative to the diagonal `terms`; the first that is not positive
  !> ends the search.
  pure subroutine find_least_pivot(pivots, terms, constrained, pivot, weakest)
    real(dp), intent(in) :: pivots(:), terms(:)
    logical, intent(in) :: constrained(:)
    real(dp), intent(out) :: pivot
    integer, intent(out) :: weakest
    integer :: j

    pivot = 1.0_dp
    weakest = 0
    do j = 1, size(pivots)
      if (constrained(j) .or. pivots(j) >= pivot*terms(j)) cycle
      pivot = pivots(j)/terms(j)
      weakest = j
      ! NaN is not positive either.
      if (pivot > 0.0_dp) cycle
      pivot = 0.0_dp
      exit
    end do
  end subroutine find_least_pivot

end module fuge_stiffness_type
