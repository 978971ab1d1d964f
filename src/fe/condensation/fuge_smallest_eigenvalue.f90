!> How near to singular a factored stiffness is: its smallest eigenvalue after scaling to a unit
!> diagonal, by inverse iteration. The least pivot does not measure that: rounding errors
!> accumulate up to the last pivot, and a body eliminated from its free end has no small pivot.
module fuge_smallest_eigenvalue
  use fuge_kinds, only: dp
  use fuge_lapack, only: dtrsv
  use fuge_status, only: FUGE_DONE
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  implicit none
  private

  public :: find_smallest_eigenvalue, unscale

  !> Steps of the inverse iteration, and of that on a Schur complement.
  integer, parameter :: STEPS = 3, SCHUR_STEPS = 4

contains

  !> `quotient`: Rayleigh quotient y^T K y of the softest mode y relative to the magnitude of its
  !> terms, |y|^T |K| |y|; `weakest`: the degree of freedom that y moves most.
  !>
  !> If the factor ends with a Schur complement, a single step from the softest mode of this complement is taken. It is
  !> enough to see that K is not nearly singular; a small quotient may be several times too large.
  !> `scale` (degrees): square root of the diagonal of K, zero where constrained. `status` is not
  !> zero without memory.
  !> `loads` (degrees, any number), zero where constrained, are replaced by displacements: solved for together with the
  !> first step, they cost little.
  subroutine find_smallest_eigenvalue(stiffness, factor, scale, loads, quotient, weakest, status)
    class(fuge_stiffness), intent(in) :: stiffness
    class(stiffness_factor), intent(in) :: factor
    real(dp), intent(in) :: scale(:)
    real(dp), intent(inout) :: loads(:, :)
    real(dp), intent(out) :: quotient
    integer, intent(out) :: weakest, status
    real(dp), allocatable :: block(:, :), y(:), product(:), magnitude(:)
    integer :: j, step

    quotient = 1.0_dp
    weakest = 0
    allocate (block(size(scale), 1 + size(loads, 2)), y(size(scale)), product(size(scale)), magnitude(size(scale)), &
              stat=status)
    if (status /= FUGE_DONE) return
    ! Any start that is not orthogonal to the softest mode.
    do j = 1, size(scale)
      y(j) = modulo(real(j, dp)*sqrt(2.0_dp), 1.0_dp) - 0.3_dp
    end do
    if (allocated(factor%last)) call add_softest_of_schur(factor, scale, y, status)
    block(:, 2:) = loads
    do step = 1, merge(1, STEPS, allocated(factor%last))
      y = y*scale
      block(:, 1) = y/max(maxval(abs(y)), tiny(y))
      if (status == FUGE_DONE .and. step == 1) call factor%solve(block, status)
      if (status == FUGE_DONE .and. step > 1) call factor%solve(block(:, :1), status)
      if (status /= FUGE_DONE) return
      y = block(:, 1)*scale
    end do
    loads = block(:, 2:)
    if (.not. any(scale > 0.0_dp)) return
    y = y/maxval(abs(y))
    weakest = maxloc(abs(y), 1)
    call unscale(y, scale)
    call stiffness%multiply(y, product, magnitude)
    ! Both are sums over all degrees of freedom, but the constrained ones do not move.
    quotient = dot_product(y, product)/dot_product(abs(y), magnitude)
  end subroutine find_smallest_eigenvalue

  !> Add to y (degrees) the softest mode of the Schur complement of the last degrees of freedom, as large as y: its
  !> extension to all others is close to the softest mode of K, unless that leaves those at rest.
  subroutine add_softest_of_schur(factor, scale, y, status)
    class(stiffness_factor), intent(in) :: factor
    real(dp), intent(in) :: scale(:)
    real(dp), intent(inout) :: y(:)
    integer, intent(out) :: status
    real(dp), allocatable :: root(:, :), t(:)
    integer :: p, step

    call factor%copy_schur_factor(root, status)
    if (status /= FUGE_DONE) return
    p = size(root, 1)
    t = y(factor%last)
    do step = 1, SCHUR_STEPS
      t = t*scale(factor%last)
      t = t/maxval(abs(t))
      call dtrsv('L', 'N', 'N', p, root, p, t, 1)
      call dtrsv('L', 'T', 'N', p, root, p, t, 1)
      t = t*scale(factor%last)
    end do
    y(factor%last) = y(factor%last) + t*(norm2(y)/norm2(t))
  end subroutine add_softest_of_schur

  !> Divide y (degrees) by the scale; y becomes zero where the scale is zero.
  pure subroutine unscale(y, scale)
    real(dp), intent(inout) :: y(:)
    real(dp), intent(in) :: scale(:)

    where (scale > 0.0_dp)
      y = y/scale
    else where
      y = 0.0_dp
    end where
  end subroutine unscale

end module fuge_smallest_eigenvalue
