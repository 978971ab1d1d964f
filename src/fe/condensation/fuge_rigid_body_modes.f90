!> The rigid modes of a floating body, the null space Z of K: computed, or supplied and checked;
!> and the degrees of freedom to pin so that K becomes positive definite.
!>
!> Displacements and rotations are compared after scaling with s, the square root of the diagonal
!> of K, so that no result depends on the units of a degree of freedom.
module fuge_rigid_body_modes
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_lapack, only: dsyev
  use fuge_number_text, only: index_text, text
  use fuge_pivoted_qr, only: factorise_pivoted, numerical_rank, orthonormalise
  use fuge_smallest_eigenvalue, only: unscale
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE, FUGE_ERR_MEMORY, FUGE_ERR_MODES, &
    FUGE_ERR_NOT_DEFINITE
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  implicit none
  private

  public :: check_rigid_modes, choose_pins, find_pin_loads, find_rigid_modes

  !> Makes K + SHIFT diag(K) of a floating body positive definite: far above rounding, far below
  !> the elastic modes of any mesh that can be solved in double precision.
  real(dp), parameter :: SHIFT = 1.0e-12_dp
  !> Steps of the subspace iteration; each divides an elastic mode of the relative stiffness k by
  !> (k + SHIFT)/SHIFT.
  integer, parameter :: SWEEPS = 5
  !> Modes of the first subspace: the six of one body, and an elastic one to compare them with.
  integer, parameter :: FIRST_BLOCK = 8
  !> A stiffness below this fraction of its terms counts as zero.
  real(dp), parameter :: NO_STIFFNESS = 20.0_dp*epsilon(1.0_dp)
  !> Largest acceptable fraction of the softest elastic mode in a computed rigid mode. Because K
  !> is rounded, that fraction is NO_STIFFNESS over the relative stiffness of the elastic mode.
  real(dp), parameter :: LARGEST_ERROR = 1.0e-4_dp
  !> Largest force K z on a supplied rigid mode z, relative to its terms |K| |z|.
  real(dp), parameter :: FORCE_TOLERANCE = 1.0e-8_dp
  !> Modes whose remainder after elimination is below this fraction are linearly dependent.
  real(dp), parameter :: RANK_TOLERANCE = 1.0e-10_dp

contains

  !> Find all modes without stiffness that do not move the `fixed` degrees of freedom: subspace
  !> iteration with the inverse of K + SHIFT diag(K), in a subspace that grows until it contains an
  !> elastic mode.
  !>
  !> `fixed` (degrees); `scale` is s, (degrees), zero where fixed; `rigid_modes` (degrees, number
  !> of modes). `share`: the number of degrees of freedom for which each one stands, with their rounding errors, in a
  !> Schur complement; 1 by default. Errors: FUGE_ERR_NOT_DEFINITE if K is indefinite, or if an elastic mode is too soft
  !> to be told from the rigid ones; FUGE_ERR_MEMORY.
  subroutine find_rigid_modes(stiffness, fixed, scale, rigid_modes, info, share)
    class(fuge_stiffness), intent(in) :: stiffness
    logical, intent(in) :: fixed(:)
    real(dp), intent(in) :: scale(:)
    real(dp), allocatable, intent(out) :: rigid_modes(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), intent(in), optional :: share
    class(stiffness_factor), allocatable :: factor
    real(dp), allocatable :: y(:, :), quotient(:), magnitudes(:)
    real(dp) :: error, error_share, pivot
    integer :: rigid, free, status, width, weakest

    error = 0.0_dp
    error_share = 1.0_dp
    if (present(share)) error_share = share
    free = count(.not. fixed)
    if (free == 0) then
      allocate (rigid_modes(size(fixed), 0), stat=status)
      call require_memory(status, 'the modes of the body', info)
      return
    end if
    call stiffness%factorise(fixed, error_share*SHIFT, factor, pivot, weakest, status)
    if (status /= 0) then
      call report(info, status, 'no memory for the factor of the stiffness matrix')
    else if (pivot <= 0.0_dp) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the stiffness matrix is not positive semidefinite: displacing ' &
                  //'degree of freedom '//index_text(weakest)//' releases energy; look for wrong signs or inverted ' &
                  //'elements')
    end if
    if (info%failed()) return
    width = min(FIRST_BLOCK, free)
    do
      call find_softest_modes(stiffness, factor, scale, width, y, quotient, magnitudes, status)
      call require_memory(status, '', width, 'modes of the body', info)
      if (status /= 0) return
      rigid = count(quotient <= error_share*NO_STIFFNESS*magnitudes)
      if (rigid < width .or. width == free) exit
      width = min(2*width, free)
    end do
    if (rigid < width .and. rigid > 0) error = error_share*NO_STIFFNESS*magnitudes(1)/quotient(rigid + 1)
    if (error > LARGEST_ERROR) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the body floats, and an elastic mode is so soft (' &
                  //text(quotient(rigid + 1))//' of the diagonal) that the rigid modes cannot be told from it: ' &
                  //'supply the rigid modes')
      return
    end if
    rigid_modes = y(:, :rigid)
  end subroutine find_rigid_modes

  !> The `width` softest modes y (degrees, width), their Rayleigh `quotient` (width) y^T K y
  !> relative to the diagonal of K, ascending, and the `magnitudes` (width) of its terms, all
  !> equal to the largest. `status` is not zero without memory.
  subroutine find_softest_modes(stiffness, factor, scale, width, y, quotient, magnitudes, status)
    class(fuge_stiffness), intent(in) :: stiffness
    class(stiffness_factor), intent(in) :: factor
    real(dp), intent(in) :: scale(:)
    integer, intent(in) :: width
    real(dp), allocatable, intent(out) :: y(:, :), quotient(:), magnitudes(:)
    integer, intent(out) :: status
    integer :: order(width), j, k, n, rank, sweep

    n = size(scale)
    allocate (y(n, width), quotient(width), magnitudes(width), stat=status)
    if (status /= 0) return
    ! Any start that is not orthogonal to the softest modes.
    do k = 1, width
      do j = 1, n
        y(j, k) = modulo(real(j, dp)*sqrt(real(k, dp) + 0.7_dp), 1.0_dp) - 0.5_dp
        if (.not. scale(j) > 0.0_dp) y(j, k) = 0.0_dp
      end do
    end do
    do sweep = 1, SWEEPS
      call orthonormalise(y, 0.0_dp, order, rank, status)
      if (status /= 0) return
      do k = 1, width
        y(:, k) = y(:, k)*scale
      end do
      call factor%solve(y, status)
      if (status /= 0) return
      do k = 1, width
        y(:, k) = y(:, k)*scale
      end do
    end do
    call orthonormalise(y, 0.0_dp, order, rank, status)
    if (status /= 0) return
    call rotate_to_ritz_vectors(stiffness, scale, y, quotient, magnitudes, status)
  end subroutine find_softest_modes

  !> Rayleigh-Ritz procedure: replace the scaled orthonormal modes y by the eigenvectors of K in
  !> their span, unscaled. Results as in `find_softest_modes`.
  subroutine rotate_to_ritz_vectors(stiffness, scale, y, quotient, magnitudes, status)
    class(fuge_stiffness), intent(in) :: stiffness
    real(dp), intent(in) :: scale(:)
    real(dp), intent(inout) :: y(:, :)
    real(dp), intent(out) :: quotient(:), magnitudes(:)
    integer, intent(out) :: status
    real(dp), allocatable :: product(:), magnitude(:), z(:), ritz(:, :), work(:)
    integer :: k, width

    width = size(y, 2)
    allocate (product(size(y, 1)), magnitude(size(y, 1)), z(size(y, 1)), ritz(width, width), work(8*width), stat=status)
    if (status /= 0) return
    do k = 1, width
      z = y(:, k)
      call unscale(z, scale)
      call stiffness%multiply(z, product, magnitude)
      call unscale(product, scale)
      call unscale(magnitude, scale)
      ritz(:, k) = matmul(product, y)
      magnitudes(k) = dot_product(magnitude, abs(y(:, k)))
    end do
    magnitudes = maxval(magnitudes)
    call dsyev('V', 'U', width, ritz, width, quotient, work, size(work), status)
    if (status /= 0) return
    y = matmul(y, ritz)
    do k = 1, width
      call unscale(y(:, k), scale)
    end do
  end subroutine rotate_to_ritz_vectors

  !> Refuse supplied rigid modes that the stiffness resists, or that move `fixed` degrees of
  !> freedom.
  !>
  !> `fixed` (degrees); `scale` (degrees), s, also where fixed; `rigid_modes` (degrees, m).
  !> Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_MODES, FUGE_ERR_MEMORY.
  subroutine check_rigid_modes(stiffness, fixed, scale, rigid_modes, info)
    class(fuge_stiffness), intent(in) :: stiffness
    logical, intent(in) :: fixed(:)
    real(dp), intent(in) :: scale(:), rigid_modes(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: product(:), magnitude(:)
    real(dp) :: force, largest
    integer :: j, k, stat

    if (size(rigid_modes, 1) /= size(scale)) then
      call report(info, FUGE_ERR_SIZE, 'rigid_modes has '//text(size(rigid_modes, 1))//' rows: it needs one for ' &
                  //'each of '//text(size(scale))//' degrees of freedom')
      return
    end if
    allocate (product(size(scale)), magnitude(size(scale)), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory to check the rigid modes')
    do k = 1, size(rigid_modes, 2)
      if (info%failed()) return
      call check_finite(rigid_modes(:, k), 'mode '//index_text(k)//' at degree of freedom ', info)
      if (info%failed()) return
      j = maxloc(abs(rigid_modes(:, k))*scale, 1, fixed)
      if (j > 0) then
        if (abs(rigid_modes(j, k))*scale(j) > RANK_TOLERANCE*maxval(abs(rigid_modes(:, k))*scale)) then
          call report(info, FUGE_ERR_MODES, 'mode '//index_text(k)//' moves degree of freedom '//index_text(j) &
                      //', which is fixed: a rigid motion leaves the supports at rest')
          return
        end if
      end if
      call stiffness%multiply(rigid_modes(:, k), product, magnitude)
      call unscale(product, scale)
      call unscale(magnitude, scale)
      force = maxval(abs(product))
      largest = maxval(magnitude)
      j = maxloc(abs(product), 1)
      if (force <= FORCE_TOLERANCE*largest) cycle
      call report(info, FUGE_ERR_MODES, 'mode '//index_text(k)//' is not rigid: the stiffness resists ' &
                  //'it at degree of freedom '//index_text(j)//', with a force of ' &
                  //text(force/largest)//' of its largest term')
    end do
  end subroutine check_rigid_modes

  !> Choose one degree of freedom to pin for each rigid mode, so that the pinned body has none:
  !> the columns that pivoted QR of the scaled modes selects.
  !>
  !> `scale` (degrees): s, zero where fixed, smaller where a pin should rather not be;
  !> `rigid_modes` (degrees, m); `pins` (m). Errors: FUGE_ERR_MODES if modes are linearly
  !> dependent, FUGE_ERR_MEMORY.
  subroutine choose_pins(scale, rigid_modes, pins, info)
    real(dp), intent(in) :: scale(:), rigid_modes(:, :)
    integer, allocatable, intent(out) :: pins(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: rows(:, :), tau(:)
    integer, allocatable :: order(:)
    real(dp) :: largest
    integer :: k, m, n, stat

    n = size(scale)
    m = size(rigid_modes, 2)
    allocate (rows(m, n), order(n), tau(m), stat=stat)
    if (stat == 0) then
      do k = 1, m
        rows(k, :) = rigid_modes(:, k)*scale
        largest = maxval(abs(rows(k, :)))
        if (largest > 0.0_dp) rows(k, :) = rows(k, :)/largest
      end do
      call factorise_pivoted(rows, tau, order, stat)
    end if
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to choose the degrees of freedom to pin')
    else if (numerical_rank(rows, RANK_TOLERANCE, 0.0_dp) < m) then
      call report(info, FUGE_ERR_MODES, 'the '//text(m)//' rigid modes of the body are linearly dependent: ' &
                  //'leave out modes that are zero or combinations of others')
    end if
    if (info%failed()) return
    pins = order(:m)
  end subroutine choose_pins

  !> The loads -K_fp, `block` (degrees, size(pins)), under which the body with its pins held takes the shape of the
  !> rigid modes that displace pin k by one and no other pin, Z_f = -K_ff^-1 K_fp. Elastic modes that the subspace
  !> iteration has left in the rigid modes vanish. `constrained` (degrees): supports and pins.
  subroutine find_pin_loads(stiffness, constrained, pins, block)
    class(fuge_stiffness), intent(in) :: stiffness
    logical, intent(in) :: constrained(:)
    integer, intent(in) :: pins(:)
    real(dp), intent(out), contiguous :: block(:, :)
    integer :: k

    call stiffness%copy_columns(pins, block)
    do k = 1, size(pins)
      where (constrained)
        block(:, k) = 0.0_dp
      else where
        block(:, k) = -block(:, k)
      end where
    end do
  end subroutine find_pin_loads

end module fuge_rigid_body_modes
