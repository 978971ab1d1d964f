!> Influence matrices that several tests share, the places of their points and the modes of a rigid body on them.
module influence_matrices
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_cell_elements, only: FUGE_MEAN
  use fuge_halfplane_influence, only: fuge_halfplane_matrix, mean_log
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, FUGE_DONE
  use general_reference, only: draw, integers
  implicit none
  private

  public :: halfplane, overlapping_halfplane, cell_middles, tilting_modes
  public :: identity, tridiagonal, string, ring_of_springs, coupled_springs, exponential_bed
  public :: draw_bed, draw_integer_bed, integer_bed, add_to_diagonal, beam_deflection, beam_influence
  public :: matrix_of, columns_of

  !> Products with a matrix alone, as with a callback: no preconditioner, no grid, no magnitude.
  type, extends(fuge_operator), public :: products_only
    real(dp), allocatable :: matrix(:, :)
    real(dp) :: constant = 0.0_dp
  contains
    procedure :: points
    procedure :: apply
    procedure :: datum
  end type products_only

contains

  pure function points(self) result(n)
    class(products_only), intent(in) :: self
    integer :: n

    n = 0
    if (allocated(self%matrix)) n = size(self%matrix, 2)
  end function points

  subroutine apply(self, force, displacement, status)
    class(products_only), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    displacement = matmul(self%matrix, force)
    status = 0
  end subroutine apply

  function datum(self)
    class(products_only), intent(in) :: self
    real(dp) :: datum

    datum = self%constant
  end function datum

  !> The half-plane of plane modulus 1, by default mean displacements of cells with uniform pressure.
  pure function halfplane(x, width, element) result(alpha)
    real(dp), intent(in) :: x(:), width
    integer, intent(in), optional :: element
    real(dp) :: alpha(size(x), size(x))
    type(fuge_info) :: info
    integer :: chosen

    chosen = FUGE_MEAN
    if (present(element)) chosen = element
    call fuge_halfplane_matrix(x, spread(width, 1, size(x)), 1.0_dp, chosen, alpha, info)
  end function halfplane

  !> The same for cells that overlap, which fuge_halfplane_matrix refuses; `x` ascending.
  pure function overlapping_halfplane(x, width) result(alpha)
    real(dp), intent(in) :: x(:), width
    real(dp) :: alpha(size(x), size(x))
    integer :: j

    do j = 1, size(x)
      alpha(:, j) = -2.0_dp/acos(-1.0_dp)*(mean_log(x - x(j), width, width) - log(2.0_dp*(x(size(x)) - x(1) + width)))
    end do
  end function overlapping_halfplane

  !> The middles of n cells around 0, symmetric to the last digit.
  pure function cell_middles(n, spacing) result(x)
    integer, intent(in) :: n
    real(dp), intent(in) :: spacing
    real(dp) :: x(n)
    integer :: k

    x = [(spacing*(real(k, dp) - 0.5_dp*real(n + 1, dp)), k=1, n)]
  end function cell_middles

  !> A translation and the tilt about 0 of points at x, and with `y` the tilt about the other axis.
  pure function tilting_modes(x, y) result(modes)
    real(dp), intent(in) :: x(:)
    real(dp), intent(in), optional :: y(:)
    real(dp), allocatable :: modes(:, :)

    allocate (modes(size(x), merge(3, 2, present(y))))
    modes(:, 1) = 1.0_dp
    modes(:, 2) = x
    if (present(y)) modes(:, 3) = y
  end function tilting_modes

  pure function identity(n) result(matrix)
    integer, intent(in) :: n
    real(dp) :: matrix(n, n)

    matrix = 0.0_dp
    call add_to_diagonal(matrix, 1.0_dp)
  end function identity

  !> 2 on the diagonal, -1 beside it.
  pure function tridiagonal(n) result(alpha)
    integer, intent(in) :: n
    real(dp) :: alpha(n, n)
    integer :: i, j

    do j = 1, n
      alpha(:, j) = [(real(merge(2, merge(-1, 0, abs(i - j) == 1), i == j), dp), i=1, n)]
    end do
  end function tridiagonal

  !> A stretched string: alpha falls linearly with the distance, in whole numbers where x and `top` are whole.
  pure function string(x, top) result(alpha)
    real(dp), intent(in) :: x(:), top
    real(dp) :: alpha(size(x), size(x))
    integer :: j

    do j = 1, size(x)
      alpha(:, j) = top - abs(x - x(j))
    end do
  end function string

  !> A ring of springs, each of which also displaces 7 neighbours on either side.
  pure function ring_of_springs(n) result(alpha)
    integer, intent(in) :: n
    real(dp) :: alpha(n, n)
    integer :: i, j, distance

    do j = 1, n
      do i = 1, n
        distance = min(abs(i - j), n - abs(i - j))
        alpha(i, j) = real(max(0, 8 - distance) + merge(1, 0, i == j), dp)
      end do
    end do
  end function ring_of_springs

  !> A bed of springs of compliance 1 that displace each other, less the farther they are apart.
  pure function coupled_springs(n) result(alpha)
    integer, intent(in) :: n
    real(dp) :: alpha(n, n)
    integer :: i, j

    do j = 1, n
      alpha(:, j) = [(1.0_dp/(1.0_dp + 0.3_dp*real(abs(i - j), dp)), i=1, n)]
    end do
  end function coupled_springs

  !> Displacements that decay exponentially with the distance of points at x.
  pure function exponential_bed(x, decay) result(alpha)
    real(dp), intent(in) :: x(:), decay
    real(dp) :: alpha(size(x), size(x))
    integer :: i, j

    do j = 1, size(x)
      alpha(:, j) = [(exp(-decay*abs(x(i) - x(j))), i=1, size(x))]
    end do
  end function exponential_bed

  !> B B^T + `diagonal` I + `datum`, where B has random numbers between `low` and `high`.
  pure subroutine draw_bed(seed, low, high, diagonal, alpha, datum)
    integer(int64), intent(inout) :: seed
    real(dp), intent(in) :: low, high, diagonal
    real(dp), intent(out) :: alpha(:, :)
    real(dp), intent(in), optional :: datum
    real(dp) :: b(size(alpha, 2), size(alpha, 2))
    integer :: k

    do k = 1, size(b, 2)
      call draw(seed, b(:, k))
    end do
    b = low + (high - low)*b
    alpha = matmul(b, transpose(b))
    alpha = 0.5_dp*(alpha + transpose(alpha))
    if (present(datum)) alpha = alpha + datum
    call add_to_diagonal(alpha, diagonal)
  end subroutine draw_bed

  !> B B^T + `diagonal` I, where B has random whole numbers from -`most` to `most`.
  pure subroutine draw_integer_bed(seed, most, diagonal, alpha)
    integer(int64), intent(inout) :: seed
    integer, intent(in) :: most, diagonal
    real(dp), intent(out) :: alpha(:, :)
    real(dp) :: b(size(alpha, 2), size(alpha, 2))
    integer :: k

    do k = 1, size(b, 2)
      call integers(seed, -most, most, b(:, k))
    end do
    alpha = matmul(b, transpose(b))
    call add_to_diagonal(alpha, real(diagonal, dp))
  end subroutine draw_integer_bed

  !> B B^T + n I, where B has random whole numbers from -2 to 2; `start` is the seed.
  pure function integer_bed(n, start) result(alpha)
    integer, intent(in) :: n
    integer(int64), intent(in) :: start
    real(dp) :: alpha(n, n)
    integer(int64) :: seed

    seed = start
    call draw_integer_bed(seed, 2, n, alpha)
  end function integer_bed

  pure subroutine add_to_diagonal(matrix, value)
    real(dp), intent(inout) :: matrix(:, :)
    real(dp), intent(in) :: value
    integer :: k

    do k = 1, size(matrix, 2)
      matrix(k, k) = matrix(k, k) + value
    end do
  end subroutine add_to_diagonal

  !> The deflection at x by a unit force at s of a beam of length and stiffness 1, on two supports or `clamped` at 0.
  pure function beam_deflection(x, s, clamped) result(d)
    real(dp), intent(in) :: x, s
    logical, intent(in) :: clamped
    real(dp) :: d
    real(dp) :: a, b

    a = min(x, s)
    b = max(x, s)
    if (clamped) then
      d = a**2*(3.0_dp*b - a)/6.0_dp
    else
      d = a*(1.0_dp - b)*(1.0_dp - a**2 - (1.0_dp - b)**2)/6.0_dp
    end if
  end function beam_deflection

  !> Such a beam at n points at equal distances, without the supports.
  pure function beam_influence(n, clamped) result(alpha)
    integer, intent(in) :: n
    logical, intent(in) :: clamped
    real(dp) :: alpha(n, n)
    real(dp) :: x(n)
    integer :: i, j

    x = [(real(i, dp)/real(merge(n, n + 1, clamped), dp), i=1, n)]
    do j = 1, n
      alpha(:, j) = [(beam_deflection(x(i), x(j), clamped), i=1, n)]
    end do
  end function beam_influence

  !> The matrix of an operator, made symmetric to the last digit.
  function matrix_of(op) result(alpha)
    class(fuge_operator), intent(in) :: op
    real(dp), allocatable :: alpha(:, :)

    alpha = columns_of(op, .false.)
    alpha = 0.5_dp*(alpha + transpose(alpha)) + op%datum()
  end function matrix_of

  !> The products of an operator, which lack its datum, or its `preconditioned` displacements, with each unit vector.
  function columns_of(op, preconditioned) result(columns)
    class(fuge_operator), intent(in) :: op
    logical, intent(in) :: preconditioned
    real(dp), allocatable :: columns(:, :)
    real(dp) :: unit(op%points())
    integer :: k, status

    allocate (columns(op%points(), op%points()))
    do k = 1, op%points()
      unit = 0.0_dp
      unit(k) = 1.0_dp
      if (preconditioned) then
        call op%precondition(unit, columns(:, k), status)
      else
        call op%apply(unit, columns(:, k), status)
      end if
      if (status /= FUGE_DONE) error stop 'fuge: an operator fails in a test that needs its matrix'
    end do
  end function columns_of

end module influence_matrices
