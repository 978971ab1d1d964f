!> The rigid motions of a body that floats: the motions Z with K Z = 0, found or given, and
!> the degrees of freedom to pin so that the rest is definite.
!>
!> Lengths and angles are compared after scaling with the square root s of the diagonal of
!> K, so that no answer depends on the units of a degree of freedom.
module fuge_rigid_body_modes
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_lapack, only: dsyev
  use fuge_pivoted_qr, only: factorise_pivoted, numerical_rank, orthonormalise
  use fuge_smallest_eigenvalue, only: unscale
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE, FUGE_ERR_MEMORY, FUGE_ERR_MODES, FUGE_ERR_NOT_DEFINITE
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  use fuge_number_text, only: text
  implicit none
  private

  public :: find_motions, check_motions, choose_pins, unit_at_pins

  !> Keeps the factor of the floating body definite: far above rounding, far below the
  !> elastic modes of any mesh that double precision can solve.
  real(dp), parameter :: SHIFT = 1.0e-12_dp
  !> Solves with the shifted factor: each divides what is elastic by (stiffness + SHIFT)/SHIFT.
  integer, parameter :: SWEEPS = 5
  !> Motions sought at first; one body has six, and something elastic should be among them.
  integer, parameter :: FIRST_BLOCK = 8
  !> A stiffness below so many roundings is none.
  real(dp), parameter :: NO_STIFFNESS = 20.0_dp*epsilon(1.0_dp)
  !> What is softest of the elastic motions is mixed into those found in the ratio of
  !> NO_STIFFNESS to its stiffness, because K itself is rounded; so much is too much.
  real(dp), parameter :: LARGEST_ERROR = 1.0e-4_dp
  !> Largest force that a given motion may meet, relative to its parts.
  real(dp), parameter :: MOTION_TOLERANCE = 1.0e-8_dp
  !> Below, given motions depend on each other.
  real(dp), parameter :: RANK_TOLERANCE = 1.0e-10_dp

contains

  !> Find all motions without stiffness that leave `fixed` at rest: subspace iteration with
  !> the inverse of K + SHIFT diag(K), until an elastic one turns up.
  !>
  !> `scale` is s, zero where fixed; `motions` (degrees, number found). Errors: FUGE_ERR_NOT_DEFINITE where K resists a
  !> motion negatively, or so little that it may be rounding; FUGE_ERR_MEMORY.
  subroutine find_motions(stiffness, fixed, scale, motions, info)
    class(fuge_stiffness), intent(in) :: stiffness
    logical, intent(in) :: fixed(:)
    real(dp), intent(in) :: scale(:)
    real(dp), allocatable, intent(out) :: motions(:, :)
    type(fuge_info), intent(inout) :: info
    class(stiffness_factor), allocatable :: factor
    real(dp), allocatable :: y(:, :), quotient(:), noise(:)
    real(dp) :: error, pivot
    integer :: found, free, status, width, weakest

    error = 0.0_dp
    free = count(.not. fixed)
    call stiffness%factorise(fixed, SHIFT, factor, pivot, weakest, status)
    if (status /= 0) then
      call report(info, status, 'no memory for the factor of the stiffness matrix')
    else if (pivot <= 0.0_dp) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the stiffness matrix is not positive semidefinite: a motion of ' &
                  //'degree of freedom '//text(weakest)//' gains energy; look for wrong signs or elements turned ' &
                  //'inside out')
    end if
    if (info%failed()) return
    width = min(FIRST_BLOCK, free)
    do
      call lowest_motions(stiffness, factor, scale, width, y, quotient, noise, status)
      if (status /= 0) then
        call report(info, FUGE_ERR_MEMORY, 'no memory for '//text(width)//' motions of the body')
        return
      end if
      found = count(quotient <= NO_STIFFNESS*noise)
      if (found < width .or. width == free) exit
      width = min(2*width, free)
    end do
    if (found < width .and. found > 0) error = NO_STIFFNESS*noise(1)/quotient(found + 1)
    if (error > LARGEST_ERROR) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the body floats, and an elastic motion is so soft (' &
                  //text(quotient(found + 1))//' of the diagonal) that rigid ones are hard to tell from it: give the ' &
                  //'rigid motions as modes')
      return
    end if
    motions = y(:, :found)
  end subroutine find_motions

  !> The `width` softest motions y (degrees, width), their stiffness relative to the
  !> diagonal of K, ascending, and the parts of which that is the sum.
  subroutine lowest_motions(stiffness, factor, scale, width, y, quotient, noise, status)
    class(fuge_stiffness), intent(in) :: stiffness
    class(stiffness_factor), intent(in) :: factor
    real(dp), intent(in) :: scale(:)
    integer, intent(in) :: width
    real(dp), allocatable, intent(out) :: y(:, :), quotient(:), noise(:)
    integer, intent(out) :: status
    integer :: order(width), j, k, n, rank, sweep

    n = size(scale)
    allocate (y(n, width), quotient(width), noise(width), stat=status)
    if (status /= 0) return
    ! Any start will do that is not orthogonal to what is sought.
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
    call rotate_to_softest(stiffness, scale, y, quotient, noise, status)
  end subroutine lowest_motions

  !> Rayleigh and Ritz: the stiffness of the scaled motions y among each other; y is then
  !> rotated, and unscaled.
  subroutine rotate_to_softest(stiffness, scale, y, quotient, noise, status)
    class(fuge_stiffness), intent(in) :: stiffness
    real(dp), intent(in) :: scale(:)
    real(dp), intent(inout) :: y(:, :)
    real(dp), intent(out) :: quotient(:), noise(:)
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
      noise(k) = dot_product(magnitude, abs(y(:, k)))
    end do
    noise = maxval(noise)
    call dsyev('V', 'U', width, ritz, width, quotient, work, size(work), status)
    if (status /= 0) return
    y = matmul(y, ritz)
    do k = 1, width
      call unscale(y(:, k), scale)
    end do
  end subroutine rotate_to_softest

  !> Refuse given motions that the body resists, or that move what is fixed.
  !>
  !> `motions` (degrees, m). Errors: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_MODES,
  !> FUGE_ERR_MEMORY.
  subroutine check_motions(stiffness, fixed, scale, motions, info)
    class(fuge_stiffness), intent(in) :: stiffness
    logical, intent(in) :: fixed(:)
    real(dp), intent(in) :: scale(:), motions(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: product(:), magnitude(:)
    real(dp) :: force, parts
    integer :: j, k, stat

    if (size(motions, 1) /= size(scale)) then
      call report(info, FUGE_ERR_SIZE, 'modes has '//text(size(motions, 1))//' rows: it needs one for each of ' &
                  //text(size(scale))//' degrees of freedom')
      return
    end if
    allocate (product(size(scale)), magnitude(size(scale)), stat=stat)
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory to check the modes')
    do k = 1, size(motions, 2)
      if (info%failed()) return
      call check_finite(motions(:, k), 'mode '//text(k)//' ', info)
      if (info%failed()) return
      j = maxloc(abs(motions(:, k))*scale, 1, fixed)
      if (j > 0) then
        if (abs(motions(j, k))*scale(j) > RANK_TOLERANCE*maxval(abs(motions(:, k))*scale)) then
          call report(info, FUGE_ERR_MODES, 'mode '//text(k)//' moves degree of freedom '//text(j)//', which is ' &
                      //'fixed: a rigid motion leaves the supports at rest')
          return
        end if
      end if
      call stiffness%multiply(motions(:, k), product, magnitude)
      call unscale(product, scale)
      call unscale(magnitude, scale)
      force = maxval(abs(product))
      parts = maxval(magnitude)
      j = maxloc(abs(product), 1)
      if (force > MOTION_TOLERANCE*parts) call report(info, FUGE_ERR_MODES, 'mode '//text(k)//' is not rigid: the ' &
        //'stiffness resists it at degree of freedom '//text(j)//' with '//text(force/parts)//' of its parts')
    end do
  end subroutine check_motions

  !> Choose for each motion a degree of freedom to pin, so that none is left: the pivots of
  !> the scaled motions.
  !>
  !> `scale` is s, zero where fixed; `pins` (m). Errors: FUGE_ERR_MODES where motions depend
  !> on each other, FUGE_ERR_MEMORY.
  subroutine choose_pins(scale, motions, pins, info)
    real(dp), intent(in) :: scale(:), motions(:, :)
    integer, allocatable, intent(out) :: pins(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: rows(:, :), tau(:)
    integer, allocatable :: order(:)
    real(dp) :: largest
    integer :: k, m, n, stat

    n = size(scale)
    m = size(motions, 2)
    allocate (rows(m, n), order(n), tau(m), stat=stat)
    if (stat == 0) then
      do k = 1, m
        rows(k, :) = motions(:, k)*scale
        largest = maxval(abs(rows(k, :)))
        if (largest > 0.0_dp) rows(k, :) = rows(k, :)/largest
      end do
      call factorise_pivoted(rows, tau, order, stat)
    end if
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to look for degrees of freedom that hold the body')
    else if (numerical_rank(rows, RANK_TOLERANCE, 0.0_dp) < m) then
      call report(info, FUGE_ERR_MODES, 'the '//text(m)//' modes of the body depend on each other, or one moves ' &
                  //'nothing: leave out what the others make up')
    end if
    if (info%failed()) return
    pins = order(:m)
  end subroutine choose_pins

  !> Motion k moves pin k by one, and no other pin: by the stiffness with the pins held, and
  !> so without what the motions found have of elastic ones.
  !>
  !> `motions` (degrees, size(pins)), `held` with supports and pins. Error: FUGE_ERR_MEMORY.
  subroutine unit_at_pins(stiffness, factor, held, pins, motions, info)
    class(fuge_stiffness), intent(in) :: stiffness
    class(stiffness_factor), intent(in) :: factor
    logical, intent(in) :: held(:)
    integer, intent(in) :: pins(:)
    real(dp), intent(inout), contiguous :: motions(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: unit(:), magnitude(:)
    integer :: k, stat

    allocate (unit(size(held)), magnitude(size(held)), stat=stat)
    if (stat == 0) then
      do k = 1, size(pins)
        unit = 0.0_dp
        unit(pins(k)) = -1.0_dp
        call stiffness%multiply(unit, motions(:, k), magnitude)
        where (held) motions(:, k) = 0.0_dp
      end do
      call factor%solve(motions, stat)
    end if
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the motions of the body')
    do k = 1, size(pins)
      motions(pins(k), k) = 1.0_dp
    end do
  end subroutine unit_at_pins

end module fuge_rigid_body_modes
