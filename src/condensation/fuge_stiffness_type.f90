!> A stiffness matrix K as condensation sees it: its products, and its Cholesky factor once
!> enough degrees of freedom are held. Extended by each way to store K.
module fuge_stiffness_type
  use fuge_kinds, only: dp
  implicit none
  private

  !> Cholesky factor of a stiffness matrix whose held degrees of freedom are cut out.
  type, abstract, public :: stiffness_factor
  contains
    !> Replace loads (degrees, any number) by displacements; those held have to be zero and stay so.
    procedure(solve_for_block), deferred :: solve
  end type stiffness_factor

  !> A symmetric stiffness matrix, force per displacement.
  type, abstract, public :: fuge_stiffness
  contains
    !> Number of degrees of freedom, 0 before the matrix is set.
    procedure(count_degrees), deferred :: degrees
    !> The diagonal.
    procedure(get_diagonal), deferred :: diagonal
    !> K u, and |K| |u|, by which the rounding of K u is judged.
    procedure(multiply_vector), deferred :: multiply
    !> Cholesky factor without the rows and columns `held`.
    procedure(factorise_free), deferred :: factorise
  end type fuge_stiffness

  abstract interface
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

    !> `held` (degrees): .true. for the rows and columns that are cut out. Each diagonal term
    !> is taken 1 + `shift` times. `pivot` is the least pivot relative to its diagonal term, at
    !> the degree of freedom `weakest`; where the matrix is not definite, pivot <= 0 and
    !> `factor` is not allocated. Status: FUGE_DONE or FUGE_ERR_MEMORY.
    subroutine factorise_free(self, held, shift, factor, pivot, weakest, status)
      import :: fuge_stiffness, stiffness_factor, dp
      class(fuge_stiffness), intent(in) :: self
      logical, intent(in) :: held(:)
      real(dp), intent(in) :: shift
      class(stiffness_factor), allocatable, intent(out) :: factor
      real(dp), intent(out) :: pivot
      integer, intent(out) :: weakest, status
    end subroutine factorise_free

    !> `block` (degrees, any number): loads in, displacements out; status: FUGE_DONE or FUGE_ERR_MEMORY.
    subroutine solve_for_block(self, block, status)
      import :: stiffness_factor, dp
      class(stiffness_factor), intent(in) :: self
      real(dp), intent(inout), contiguous :: block(:, :)
      integer, intent(out) :: status
    end subroutine solve_for_block
  end interface

end module fuge_stiffness_type
