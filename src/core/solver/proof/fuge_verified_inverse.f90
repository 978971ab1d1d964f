!> The inverse of a matrix with bounds of its error.
!>
!> With an approximate inverse Y of K let G = I - Y K. If |G| v < v for some v > 0, then K is not singular, and column j
!> of the inverse is off by at most alpha |G| v, where alpha is the largest of |Y_ij|/(v - |G| v)_i (S. M. Rump,
!> Verification methods: rigorous results using floating-point arithmetic, Acta Numerica 19, 2010, section 10; S. Oishi
!> and S. M. Rump, Numerische Mathematik 90, 2002). v is found by the power method, so that it is as good as a Perron
!> vector. The numbers of K are scaled by the caller to about 1.
module fuge_verified_inverse
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm, dgetrf, dgetri
  use fuge_rounding_bounds, only: absolute_product, gamma_bound, raised, LEAST
  implicit none
  private

  !> Steps of the power method.
  integer, parameter :: MOST_STEPS = 6
  !> A largest ratio of |G| v and v that is small enough.
  real(dp), parameter :: SMALL_DEFECT = 1.0e-3_dp
  !> Components of v are at least this fraction of the largest.
  real(dp), parameter :: LEAST_WEIGHT = 1.0e-8_dp

  !> The inverse of a matrix of order p. It is proved that there is one where `is_proved`.
  type, public :: verified_inverse
    !> Y, (p, p).
    real(dp), allocatable :: approximate(:, :)
    logical :: is_proved = .false.
    !> v - |G| v, not above it, and |G| v, not below it, (p).
    real(dp), allocatable, private :: margin(:), defect(:)
  contains
    procedure :: find
    procedure :: column_error
  end type verified_inverse

contains

  !> Find the inverse of `matrix` (p, p), whose elements are known up to `radius` (p, p), if it is given. `stat` is not
  !> 0 without memory.
  subroutine find(self, matrix, stat, radius)
    class(verified_inverse), intent(inout) :: self
    real(dp), intent(in), contiguous :: matrix(:, :)
    integer, intent(out) :: stat
    real(dp), intent(in), contiguous, optional :: radius(:, :)
    real(dp), allocatable :: defect(:, :), v(:)
    integer :: p, step

    self%is_proved = .false.
    p = size(matrix, 1)
    if (allocated(self%approximate)) deallocate (self%approximate, self%margin, self%defect)
    allocate (self%approximate(p, p), self%margin(p), self%defect(p), defect(p, p), v(p), stat=stat)
    if (stat /= 0) return
    call invert(matrix, self%approximate, self%is_proved, stat)
    if (stat /= 0 .or. .not. self%is_proved) return
    call find_defect(self%approximate, matrix, defect)
    v = 1.0_dp
    do step = 1, MOST_STEPS
      call bound_defect(self%approximate, matrix, defect, v, self%defect)
      if (present(radius)) call add_radius(self%approximate, radius, v, self%defect)
      if (.not. all(self%defect <= huge(1.0_dp))) exit
      if (all(self%defect <= SMALL_DEFECT*v)) exit
      if (step < MOST_STEPS) v = max(self%defect/maxval(self%defect), LEAST_WEIGHT)
    end do
    self%margin = (v - self%defect)*(1.0_dp - epsilon(1.0_dp))
    self%is_proved = all(self%margin > 0.0_dp)
  end subroutine find

  !> The approximate inverse of `matrix`; without one, is_found is false.
  subroutine invert(matrix, inverse, is_found, stat)
    real(dp), intent(in), contiguous :: matrix(:, :)
    real(dp), intent(inout), contiguous :: inverse(:, :)
    logical, intent(out) :: is_found
    integer, intent(out) :: stat
    real(dp), allocatable :: work(:)
    integer, allocatable :: pivots(:)
    real(dp) :: wanted(1)
    integer :: info, p

    p = size(matrix, 1)
    inverse = matrix
    is_found = .true.
    stat = 0
    if (p < 1) return
    allocate (pivots(p), stat=stat)
    if (stat /= 0) return
    call dgetrf(p, p, inverse, p, pivots, info)
    is_found = info == 0
    if (.not. is_found) return
    call dgetri(p, inverse, p, pivots, wanted, -1, info)
    allocate (work(int(wanted(1))), stat=stat)
    if (stat /= 0) return
    call dgetri(p, inverse, p, pivots, work, size(work), info)
    is_found = info == 0 .and. all(abs(inverse) <= huge(1.0_dp))
  end subroutine invert

  !> I - Y K, in double precision.
  subroutine find_defect(inverse, matrix, defect)
    real(dp), intent(in), contiguous :: inverse(:, :), matrix(:, :)
    real(dp), intent(out), contiguous :: defect(:, :)
    integer :: j, p

    p = size(matrix, 1)
    if (p < 1) return
    defect = 0.0_dp
    do j = 1, p
      defect(j, j) = 1.0_dp
    end do
    call dgemm('N', 'N', p, p, p, -1.0_dp, inverse, p, matrix, p, 1.0_dp, defect, p)
  end subroutine find_defect

  !> An upper bound of |G| v.
  subroutine bound_defect(inverse, matrix, defect, v, bound)
    real(dp), intent(in), contiguous :: inverse(:, :), matrix(:, :), defect(:, :)
    real(dp), intent(in) :: v(:)
    real(dp), intent(out) :: bound(:)
    real(dp) :: image(size(v)), rounding(size(v))
    integer :: p

    p = size(v)
    call absolute_product(matrix, v, image)
    image = gamma_bound(p + 4)*image
    call absolute_product(inverse, raised(image, 3), rounding)
    call absolute_product(defect, v, bound)
    ! The subtraction from 1 rounds too.
    bound = raised(bound + rounding + gamma_bound(p + 4)*v, 4)
  end subroutine bound_defect

  !> Add to the bound of |G| v what it may be more for matrices within the `radius`: |Y| radius v.
  subroutine add_radius(inverse, radius, v, bound)
    real(dp), intent(in), contiguous :: inverse(:, :), radius(:, :)
    real(dp), intent(in) :: v(:)
    real(dp), intent(inout) :: bound(:)
    real(dp) :: more(size(v)), spread(size(v))

    call absolute_product(radius, v, spread)
    call absolute_product(inverse, spread, more)
    bound = raised(bound + more, 2)
  end subroutine add_radius

  !> How far column `j` of the inverse is at most from that of Y, (p).
  pure function column_error(self, j) result(error)
    class(verified_inverse), intent(in) :: self
    integer, intent(in) :: j
    real(dp) :: error(size(self%margin))

    error = raised(largest_ratio(abs(self%approximate(:, j)), self%margin)*self%defect, 3) + LEAST
  end function column_error

  !> The largest ratio, rounded up.
  pure function largest_ratio(values, scale) result(ratio)
    real(dp), intent(in) :: values(:), scale(:)
    real(dp) :: ratio

    ratio = raised(maxval(values/scale), 2)
  end function largest_ratio

end module fuge_verified_inverse
