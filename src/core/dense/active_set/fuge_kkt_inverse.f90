!> The inverse of the block of all points, by which sets that lack some of them need no factor of their own.
!>
!> The inverse times the gaps gives the forces of all points together. Multiples of its columns take away those of the
!> points removed: the multipliers solve a small system, the block of the inverse on these points, bordered by the rigid
!> modes. That is the Schur complement of `kkt_factor`, whose borders need no computation here. Where many load cases
!> open few of many points, this saves a triangular solve for each point removed, and the factors of sets far from the
!> last one.
module fuge_kkt_inverse
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv, dpotri, dsymv
  implicit none
  private

  !> An inverse has lost as many digits as the condition number has, and refinement has to win them back: the largest
  !> diagonal of the block times that of its inverse is at most this.
  real(dp), parameter :: MOST_CONDITION = 1.0e6_dp
  !> Columns that are added in one pass.
  integer, parameter :: COLUMNS = 4

  type, public :: kkt_inverse
    private
    !> There is an inverse.
    logical, public :: is_set = .false.
    !> Inverse of the block, (points, points), both triangles.
    real(dp), allocatable :: inverse(:, :)
    !> Rigid modes at the points, and the inverse times them, (points, m).
    real(dp), allocatable :: modes(:, :), mode_image(:, :)
  contains
    procedure :: set
    procedure :: fill_schur
    procedure :: eliminate
    procedure :: substitute
  end type kkt_inverse

contains

  !> Invert the block whose Cholesky factor is `lower` and whose diagonal is `diagonal`; `modes` (points, m) are the
  !> rigid modes. `lower` is taken over, and lost. Not set if the block is too badly conditioned, or without memory.
  subroutine set(self, lower, diagonal, modes)
    class(kkt_inverse), intent(inout) :: self
    real(dp), intent(inout), allocatable :: lower(:, :)
    real(dp), intent(in) :: diagonal(:)
    real(dp), intent(in), contiguous :: modes(:, :)
    real(dp), allocatable :: image(:, :)
    integer :: info, j, n, stat

    n = size(diagonal)
    ! The diagonal of the inverse is no less than one over the least pivot.
    if (.not. maxval(diagonal) <= MOST_CONDITION*minval([(lower(j, j)**2, j=1, n)])) return
    allocate (image(n, size(modes, 2)), stat=stat)
    if (stat /= 0) return
    call dpotri('L', n, lower, n, info)
    if (info /= 0) return
    if (.not. maxval(diagonal)*maxval([(lower(j, j), j=1, n)]) <= MOST_CONDITION) return
    do j = 2, n
      lower(:j - 1, j) = lower(j, :j - 1)
    end do
    do j = 1, size(modes, 2)
      call dsymv('L', n, 1.0_dp, lower, n, modes(:, j), 1, 0.0_dp, image(:, j), 1)
    end do
    allocate (self%modes, source=modes, stat=stat)
    if (stat /= 0) return
    call move_alloc(image, self%mode_image)
    call move_alloc(lower, self%inverse)
    self%is_set = .true.
  end subroutine set

  !> The lower triangle of the Schur complement of all modes and, after them, of the points `removed`.
  pure subroutine fill_schur(self, removed, schur)
    class(kkt_inverse), intent(in) :: self
    integer, intent(in) :: removed(:)
    real(dp), intent(inout) :: schur(:, :)
    integer :: i, j, m

    m = size(self%modes, 2)
    do j = 1, m
      do i = j, m
        schur(i, j) = -dot_product(self%modes(:, i), self%mode_image(:, j))
      end do
      do i = 1, size(removed)
        schur(m + i, j) = -self%mode_image(removed(i), j)
      end do
    end do
    do j = 1, size(removed)
      do i = j, size(removed)
        schur(m + i, m + j) = -self%inverse(removed(i), removed(j))
      end do
    end do
  end subroutine fill_schur

  !> The forces of all points without borders from the right-hand side, `points`, and what they leave of that of the
  !> borders, `outer`: modes first, then the points `removed`.
  subroutine eliminate(self, removed, points, outer)
    class(kkt_inverse), intent(in) :: self
    integer, intent(in) :: removed(:)
    real(dp), intent(inout), contiguous :: points(:), outer(:)
    real(dp) :: right(size(points))
    integer :: m, n

    n = size(points)
    m = size(self%modes, 2)
    right = points
    call dsymv('L', n, 1.0_dp, self%inverse, n, right, 1, 0.0_dp, points, 1)
    if (m > 0) call dgemv('T', n, m, 1.0_dp, self%modes, n, points, 1, 1.0_dp, outer, 1)
    outer(m + 1:) = outer(m + 1:) + points(removed)
  end subroutine eliminate

  !> The forces of all points with the borders, from those without and the solution `outer` of the Schur complement.
  subroutine substitute(self, removed, outer, points)
    class(kkt_inverse), intent(in) :: self
    integer, intent(in) :: removed(:)
    real(dp), intent(in), contiguous :: outer(:)
    real(dp), intent(inout), contiguous :: points(:)
    integer :: j, m, n, whole

    n = size(points)
    m = size(self%modes, 2)
    if (m > 0) call dgemv('N', n, m, 1.0_dp, self%mode_image, n, outer, 1, 1.0_dp, points, 1)
    whole = size(removed) - modulo(size(removed), COLUMNS)
    do j = 1, whole, COLUMNS
      points = points + ((self%inverse(:, removed(j))*outer(m + j) + self%inverse(:, removed(j + 1))*outer(m + j + 1)) &
                         + (self%inverse(:, removed(j + 2))*outer(m + j + 2) &
                            + self%inverse(:, removed(j + 3))*outer(m + j + 3)))
    end do
    do j = whole + 1, size(removed)
      points = points + self%inverse(:, removed(j))*outer(m + j)
    end do
  end subroutine substitute

end module fuge_kkt_inverse
