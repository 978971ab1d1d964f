!> Approximate solutions of the equations of points at stops, by a Cholesky factor.
!>
!>     A e - R e_q = r      R^T e + S e_q = s
!>
!> With weights W of the motions B = A + R W R^T is definite on the points, and B e = r + R W s + R (1 - W S) e_q.
module fuge_set_factor
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgesv, dpotrf, dpotrs
  use fuge_scaled_contact, only: scaled_contact
  implicit none
  private

  type, public :: set_factor
    logical :: is_found = .false.
    real(dp), allocatable, private :: lower(:, :), modes(:, :), images(:, :), weight(:), stiffness(:)
  contains
    procedure :: find
    procedure :: solve
  end type set_factor

contains

  !> Factor the equations of `contact` at the points `place` for the motions `motion_place`. `stat` is not 0 without
  !> memory.
  subroutine find(self, contact, place, motion_place, stat)
    class(set_factor), intent(inout) :: self
    type(scaled_contact), intent(in) :: contact
    integer, intent(in) :: place(:), motion_place(:)
    integer, intent(out) :: stat
    integer :: info, j, k, m

    k = size(place)
    m = size(motion_place)
    allocate (self%lower(k, k), self%modes(k, m), self%images(k, m), self%weight(m), self%stiffness(m), stat=stat)
    if (stat /= 0) return
    self%modes = contact%modes(place, motion_place)
    self%weight = contact%weight(motion_place)
    self%stiffness = contact%stiffness(motion_place)
    do j = 1, k
      self%lower(j:, j) = contact%matrix(place(j:), place(j))
    end do
    do j = 1, m
      call add_outer(self%weight(j), self%modes(:, j), self%lower)
    end do
    self%is_found = .true.
    if (k < 1) return
    call dpotrf('L', k, self%lower, k, info)
    self%is_found = info == 0
    if (.not. self%is_found) return
    self%images = self%modes
    if (m > 0) call dpotrs('L', k, m, self%lower, k, self%images, k, info)
  end subroutine find

  !> Add factor x x^T to the lower triangle of a matrix.
  pure subroutine add_outer(factor, x, matrix)
    real(dp), intent(in) :: factor, x(:)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    integer :: j

    do j = 1, size(x)
      matrix(j:, j) = matrix(j:, j) + factor*x(j)*x(j:)
    end do
  end subroutine add_outer

  !> Solve for points (k) and motions (m): `unknowns` (k + m) are the right sides on entry.
  subroutine solve(self, unknowns)
    class(set_factor), intent(in) :: self
    real(dp), intent(inout) :: unknowns(:)
    real(dp) :: motion(size(self%weight), 1), points(size(self%modes, 1), 1), &
                small(size(self%weight), size(self%weight))
    integer :: i, info, j, k, m, pivots(size(self%weight))

    k = size(points)
    m = size(motion)
    motion(:, 1) = unknowns(k + 1:)
    points(:, 1) = unknowns(:k)
    do j = 1, m
      points(:, 1) = points(:, 1) + (self%weight(j)*motion(j, 1))*self%modes(:, j)
    end do
    if (k > 0) call dpotrs('L', k, 1, self%lower, k, points, k, info)
    do j = 1, m
      motion(j, 1) = motion(j, 1) - dot_product(points(:, 1), self%modes(:, j))
      do i = 1, m
        small(i, j) = dot_product(self%modes(:, i), self%images(:, j))*(1.0_dp - self%weight(j)*self%stiffness(j))
      end do
      small(j, j) = small(j, j) + self%stiffness(j)
    end do
    info = 0
    if (m > 0) call dgesv(m, 1, small, m, pivots, motion, m, info)
    ! Without a solution the residual is what it was.
    if (info /= 0) motion = 0.0_dp
    unknowns(:k) = points(:, 1)
    do j = 1, m
      unknowns(:k) = unknowns(:k) + ((1.0_dp - self%weight(j)*self%stiffness(j))*motion(j, 1))*self%images(:, j)
    end do
    unknowns(k + 1:) = motion(:, 1)
  end subroutine solve

end module fuge_set_factor
