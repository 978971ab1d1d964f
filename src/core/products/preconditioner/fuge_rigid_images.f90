!> The preconditioner applied to rigid motions of the contact set: the forces that displace its points almost rigidly.
!> With them a preconditioned residual is projected to forces without resultants.
!>
!> With B a basis of the rigid motions on the set and U = M B, P = I - U (B^T U)^-1 B^T projects forces along U to those
!> without resultants, and P M P^T is symmetric, whatever set U was computed for (doc/theory.md). So U is kept while the
!> set changes little.
module fuge_rigid_images
  use fuge_contact_segments, only: contact_segments, dot_over
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgesv
  use fuge_point_space, only: point_space
  implicit none
  private

  !> For one basis; `images` and `basis` count where the set that they were computed for and the present one overlap.
  type, public :: rigid_images
    !> B and U, (n, r).
    real(dp), allocatable :: basis(:, :), images(:, :)
    !> B^T U on the present set, (r, r).
    real(dp), allocatable, private :: products(:, :)
    !> The set for which U was computed, (n).
    logical, allocatable :: contact(:)
  contains
    procedure :: fits
    procedure :: measure
    procedure :: project_residual
    procedure :: project_force
  end type rigid_images

contains

  !> Are there images of `rank` motions for a set that differs from `contact` (n) in at most the fraction `close` of its
  !> points? `space` may share these.
  function fits(self, space, rank, contact, close)
    class(rigid_images), intent(in) :: self
    type(point_space), intent(in) :: space
    integer, intent(in) :: rank
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: close
    logical :: fits
    real(dp) :: counts(2)

    fits = allocated(self%images)
    if (fits) fits = size(self%images, 2) == rank
    if (.not. fits) return
    counts = real([count(contact .neqv. self%contact), count(contact)], dp)
    call space%add(counts)
    fits = counts(1) <= close*counts(2)
  end function fits

  !> Form B^T U on the set; `stat` is not 0 where memory is short, or where that is singular.
  subroutine measure(self, segments, stat)
    class(rigid_images), intent(inout) :: self
    type(contact_segments), intent(in) :: segments
    integer, intent(out) :: stat
    real(dp) :: test(size(self%images, 2))
    integer :: i, j, r

    r = size(self%images, 2)
    if (allocated(self%products)) deallocate (self%products)
    allocate (self%products(r, r), stat=stat)
    if (.not. segments%space%everywhere(stat == 0)) stat = max(stat, 1)
    if (stat /= 0) return
    do j = 1, r
      do i = 1, r
        self%products(i, j) = dot_over(segments, self%basis(:, i), self%images(:, j))
      end do
    end do
    test = 0.0_dp
    call solve(self%products, test, stat)
  end subroutine measure

  !> residual := P^T residual, (n), on the set.
  subroutine project_residual(self, segments, residual)
    class(rigid_images), intent(in) :: self
    type(contact_segments), intent(in) :: segments
    real(dp), intent(inout), contiguous :: residual(:)
    real(dp) :: factors(size(self%images, 2))
    integer :: i, stat

    do i = 1, size(factors)
      factors(i) = dot_over(segments, self%images(:, i), residual)
    end do
    call solve(transpose(self%products), factors, stat)
    call subtract_columns(segments, self%basis, factors, residual)
  end subroutine project_residual

  !> force := P force, (n), on the set.
  subroutine project_force(self, segments, force)
    class(rigid_images), intent(in) :: self
    type(contact_segments), intent(in) :: segments
    real(dp), intent(inout), contiguous :: force(:)
    real(dp) :: factors(size(self%images, 2))
    integer :: i, stat

    do i = 1, size(factors)
      factors(i) = dot_over(segments, self%basis(:, i), force)
    end do
    call solve(self%products, factors, stat)
    call subtract_columns(segments, self%images, factors, force)
  end subroutine project_force

  pure subroutine subtract_columns(segments, columns, factors, x)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: columns(:, :)
    real(dp), intent(in) :: factors(:)
    real(dp), intent(inout), contiguous :: x(:)
    integer :: i, j

    do i = 1, size(segments%first)
      associate (a => segments%first(i), b => segments%last(i))
        do j = 1, size(factors)
          x(a:b) = x(a:b) - factors(j)*columns(a:b, j)
        end do
      end associate
    end do
  end subroutine subtract_columns

  !> right := matrix**-1 right.
  subroutine solve(matrix, right, stat)
    real(dp), intent(in) :: matrix(:, :)
    real(dp), intent(inout) :: right(:)
    integer, intent(out) :: stat
    real(dp) :: copy(size(matrix, 1), size(matrix, 2))
    integer :: pivots(size(right))

    stat = 0
    copy = matrix
    if (size(right) > 0) call dgesv(size(right), 1, copy, size(right), pivots, right, size(right), stat)
  end subroutine solve

end module fuge_rigid_images
