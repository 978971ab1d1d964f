!> Forces, approach and gaps of a given contact set, by LAPACK with iterative
!> refinement: what an engine found by pivots is solved once more, so that their
!> rounding does not stay in the answer.
module fuge_contact_set
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpotrf, dsysvx
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  public :: solve_contact_set, check_definite

contains

  !> Solve c_k = 0 on the contact set with sum F = load, then the gaps elsewhere.
  !>
  !> `alpha` (at least n rows, n columns), `gap` (n), `load` > 0, `contact` (n) with
  !> at least one point; out: `force` (n), `gap_out` (n), `approach`. The constants
  !> of alpha and gap that only a rigid motion sees are taken out first and given
  !> back to the approach, so that a remote datum costs no digits of the forces.
  !> Negative forces and gaps are set to zero: rounding where the set is right,
  !> seen by the certificate where it is not.
  !> Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE (singular on this set).
  subroutine solve_contact_set(alpha, gap, load, contact, force, gap_out, approach, status)
    real(dp), intent(in) :: alpha(:, :), gap(:), load
    logical, intent(in) :: contact(:)
    real(dp), intent(out) :: force(:), gap_out(:), approach
    integer, intent(out) :: status
    real(dp), allocatable :: matrix(:, :), rhs(:), unknown(:)
    integer, allocatable :: points(:)
    real(dp) :: lowest, middle, unit, local_approach
    integer :: i, j, m, stat

    points = pack([(i, i=1, size(gap))], contact)
    m = size(points)
    allocate (matrix(m + 1, m + 1), rhs(m + 1), unknown(m + 1), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return

    lowest = minval(gap)
    middle = middle_of(alpha, points)
    unit = max(largest_deviation(alpha, points, middle)*load, maxval(gap(points) - lowest))
    if (.not. unit > 0.0_dp) unit = 1.0_dp
    ! Unknowns F/load and (v_0 - constants)/unit: entries of order 1.
    do j = 1, m
      matrix(:m, j) = (alpha(points, points(j)) - middle)*(load/unit)
      matrix(m + 1, j) = -1.0_dp
    end do
    matrix(:m, m + 1) = -1.0_dp
    matrix(m + 1, m + 1) = 0.0_dp
    rhs(:m) = -(gap(points) - lowest)/unit
    rhs(m + 1) = -1.0_dp
    call solve_symmetric(matrix, rhs, unknown, status)
    if (status /= FUGE_DONE) return

    force = 0.0_dp
    force(points) = max(unknown(:m), 0.0_dp)*load
    local_approach = unknown(m + 1)*unit
    gap_out = (gap - lowest) - local_approach
    do j = 1, m
      gap_out = gap_out + (alpha(:size(gap), points(j)) - middle)*force(points(j))
    end do
    gap_out = max(gap_out, 0.0_dp)
    gap_out(points) = 0.0_dp
    approach = local_approach + middle*load + lowest
  end subroutine solve_contact_set

  !> Middle of the range of the contact block: a constant that is safe to subtract.
  pure function middle_of(alpha, points) result(middle)
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(in) :: points(:)
    real(dp) :: middle
    real(dp) :: least, most
    integer :: j

    least = huge(least)
    most = -huge(most)
    do j = 1, size(points)
      least = min(least, minval(alpha(points, points(j))))
      most = max(most, maxval(alpha(points, points(j))))
    end do
    middle = 0.5_dp*least + 0.5_dp*most
  end function middle_of

  pure function largest_deviation(alpha, points, middle) result(deviation)
    real(dp), intent(in) :: alpha(:, :), middle
    integer, intent(in) :: points(:)
    real(dp) :: deviation
    integer :: j

    deviation = 0.0_dp
    do j = 1, size(points)
      deviation = max(deviation, maxval(abs(alpha(points, points(j)) - middle)))
    end do
  end function largest_deviation

  subroutine solve_symmetric(matrix, rhs, unknown, status)
    real(dp), intent(in) :: matrix(:, :), rhs(:)
    real(dp), intent(out) :: unknown(:)
    integer, intent(out) :: status
    real(dp), allocatable :: factor(:, :), work(:)
    integer, allocatable :: pivots(:), iwork(:)
    real(dp) :: rcond, forward(1), backward(1)
    integer, parameter :: BLOCK_SIZE = 64
    integer :: n, info, stat

    n = size(rhs)
    allocate (factor(n, n), work(BLOCK_SIZE*n + 3*n), pivots(n), iwork(n), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) return
    call dsysvx('N', 'L', n, 1, matrix, n, factor, n, pivots, rhs, n, unknown, n, rcond, &
                forward, backward, work, size(work), iwork, info)
    ! n+1 only warns of a large condition number: the certificate judges that.
    if (info > 0 .and. info <= n) status = FUGE_ERR_NOT_DEFINITE
  end subroutine solve_symmetric

  !> Is alpha positive definite on the forces with zero sum? Then the answer is
  !> unique (paper, section 4). `deficient` is 0, or the first point that breaks it.
  !>
  !> With f_1 = -(f_2 + .. + f_n) the form is that of the matrix
  !> alpha_ij - alpha_i1 - alpha_1j + alpha_11, i, j = 2..n: its Cholesky factor
  !> exists or not, whatever the datum of alpha. Error: FUGE_ERR_MEMORY.
  subroutine check_definite(alpha, deficient, status)
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(out) :: deficient, status
    real(dp), allocatable :: form(:, :), energy(:)
    integer :: n, j, stat, info

    n = size(alpha, 2)
    deficient = 0
    allocate (form(n - 1, n - 1), energy(n - 1), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0 .or. n == 1) return
    do j = 2, n
      form(:, j - 1) = (alpha(2:n, j) - alpha(1, j)) - (alpha(2:n, 1) - alpha(1, 1))
      energy(j - 1) = form(j - 1, j - 1)
    end do
    call dpotrf('L', n - 1, form, n - 1, info)
    if (info > 0) deficient = info + 1
    ! What is left of the diagonal may be rounding: then it is zero.
    do j = 1, merge(info, n, info > 0) - 1
      if (form(j, j)**2 > real(n, dp)*epsilon(energy)*energy(j)) cycle
      deficient = j + 1
      exit
    end do
  end subroutine check_definite

end module fuge_contact_set
