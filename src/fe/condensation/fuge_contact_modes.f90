!> The rigid modes of a body at its contact points: R = -H^T Z, the resultant w = Z^T p, and the
!> modes that no contact force resists.
module fuge_contact_modes
  use fuge_body_type, only: fuge_body
  use fuge_contact_normals, only: displacement_scale, point_displacement
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text
  use fuge_pivoted_qr, only: combine_independent, factorise_pivoted, numerical_rank, orthonormalise
  use fuge_smallest_eigenvalue, only: unscale
  use fuge_status, only: fuge_info, report, FUGE_ERR_NO_EQUILIBRIUM
  implicit none
  private

  public :: check_unresisted, find_contact_modes, load_resultant, remove_motions, split_rigid_modes

  !> Displacements of the contact points below this fraction of those of the body count as
  !> zero, and so does the work of a load below this fraction of its terms.
  real(dp), parameter :: MODE_TOLERANCE = 1.0e-8_dp
  !> Relative error of rigid modes that are exact except for rounding.
  real(dp), parameter, public :: ROUNDING_ERROR = 1.0e3_dp*epsilon(1.0_dp)

contains

  !> Split the rigid modes by pivoted QR of their values at the contact points: an independent
  !> subset, which the contact points resist, and combinations of the others with it that move
  !> no contact point.
  !>
  !> `rigid_modes` Z (degrees, m) and `modes` R (n, m). `scale` (degrees) and `point_scale` (n),
  !> from `displacement_scale`, make them dimensionless. `mode_error`: relative error of the
  !> rigid modes. `resisted` (m) marks the subset; `unresisted` (degrees, m - count(resisted)).
  !> `stat` is not zero without memory.
  subroutine split_rigid_modes(rigid_modes, modes, scale, point_scale, mode_error, resisted, unresisted, stat)
    real(dp), intent(in) :: rigid_modes(:, :), modes(:, :), scale(:), point_scale(:), mode_error
    logical, intent(out) :: resisted(:)
    real(dp), allocatable, intent(out) :: unresisted(:, :)
    integer, intent(out) :: stat
    real(dp), allocatable :: r(:, :), coefficients(:, :)
    real(dp) :: unit(size(resisted)), tau(size(resisted))
    integer :: order(size(resisted)), i, k, m, n, rank

    m = size(resisted)
    n = size(modes, 1)
    resisted = .true.
    allocate (r(n, m), stat=stat)
    if (stat == 0 .and. m < 1) allocate (unresisted(size(scale), 0), stat=stat)
    if (stat /= 0 .or. m < 1) return
    do k = 1, m
      unit(k) = maxval(abs(rigid_modes(:, k))*scale)
      ! A point that is held has no scale, and resists nothing.
      r(:, k) = 0.0_dp
      where (point_scale > 0.0_dp) r(:, k) = modes(:, k)/(unit(k)*point_scale)
    end do
    call factorise_pivoted(r, tau, order, stat)
    if (stat /= 0) return
    rank = numerical_rank(r, 0.0_dp, max(MODE_TOLERANCE, mode_error))
    resisted(order(rank + 1:)) = .false.
    allocate (coefficients(rank, m - rank), unresisted(size(scale), m - rank), stat=stat)
    if (stat /= 0) return
    ! z_k - Z_1 R_1^-1 r_k for each mode k beyond the rank.
    call combine_independent(r, rank, coefficients)
    do k = 1, m - rank
      unresisted(:, k) = rigid_modes(:, order(rank + k))/unit(order(rank + k))
      do i = 1, rank
        unresisted(:, k) = unresisted(:, k) - rigid_modes(:, order(i))*(coefficients(i, k)/unit(order(i)))
      end do
    end do
  end subroutine split_rigid_modes

  !> R = -H^T Z, `modes` (n, m). Where a mode does not move a point, R is set to exactly zero: a
  !> remainder of rounding size would let the point resist the mode with huge forces.
  !> `stat` is not zero without memory.
  subroutine find_contact_modes(body, rigid_modes, scale, mode_error, modes, stat)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: rigid_modes(:, :), scale(:), mode_error
    real(dp), allocatable, intent(out) :: modes(:, :)
    integer, intent(out) :: stat
    real(dp) :: point_scale(size(body%dof, 2)), largest
    integer :: i, j

    allocate (modes(size(body%dof, 2), size(rigid_modes, 2)), stat=stat)
    if (stat /= 0) return
    point_scale = displacement_scale(body, scale)
    do j = 1, size(rigid_modes, 2)
      largest = maxval(abs(rigid_modes(:, j))*scale)
      do i = 1, size(point_scale)
        modes(i, j) = -point_displacement(body%dof(:, i), body%normal(:, i), rigid_modes(:, j))
        if (abs(modes(i, j)) <= mode_error*largest*point_scale(i)) modes(i, j) = 0.0_dp
      end do
    end do
  end subroutine find_contact_modes

  !> w = Z^T p, (m). A sum whose terms cancel except for errors of the modes is set to exactly
  !> zero: of the wrong sign, contact could not balance it.
  pure function load_resultant(rigid_modes, load, scale, mode_error) result(work)
    real(dp), intent(in) :: rigid_modes(:, :), load(:), scale(:), mode_error
    real(dp) :: work(size(rigid_modes, 2))
    integer :: j

    do j = 1, size(work)
      work(j) = dot_product(rigid_modes(:, j), load)
      if (abs(work(j)) <= error_of_work(rigid_modes(:, j), load, scale, mode_error)) work(j) = 0.0_dp
    end do
  end function load_resultant

  !> Largest error in the work of a load that errors of the mode, relative to its largest
  !> displacement, can cause. The sum of the terms |z_i p_i| is no scale for it: for loads
  !> perpendicular to the mode it consists of error alone.
  pure function error_of_work(mode, load, scale, mode_error) result(work)
    real(dp), intent(in) :: mode(:), load(:), scale(:), mode_error
    real(dp) :: work, forces
    integer :: i

    forces = 0.0_dp
    do i = 1, size(load)
      if (scale(i) > 0.0_dp) forces = forces + abs(load(i))/scale(i)
    end do
    work = mode_error*maxval(abs(mode)*scale)*forces
  end function error_of_work

  !> Refuse a load that does work in one of the `unresisted` modes, (degrees, any number), which
  !> no contact force can balance (FUGE_ERR_NO_EQUILIBRIUM).
  pure subroutine check_unresisted(unresisted, load, scale, mode_error, info)
    real(dp), intent(in), allocatable :: unresisted(:, :)
    real(dp), intent(in) :: load(:), scale(:), mode_error
    type(fuge_info), intent(inout) :: info
    integer :: j, k

    if (.not. allocated(unresisted)) return
    do k = 1, size(unresisted, 2)
      if (abs(dot_product(unresisted(:, k), load)) <= MODE_TOLERANCE*sum(abs(unresisted(:, k)*load)) &
          + error_of_work(unresisted(:, k), load, scale, mode_error)) cycle
      j = maxloc(abs(unresisted(:, k))*scale, 1)
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the load drives a rigid motion that moves no contact point, ' &
                  //'and degree of freedom '//index_text(j) &
                  //' most: no contact force can resist it; fix that degree of freedom, or balance the load')
      return
    end do
  end subroutine check_unresisted

  !> Remove from displacements their projection on rigid `modes` (degrees, any number): multiplied by the `scale`
  !> (degrees) they become as small as they can in the mean of their squares. They then do not depend on where the
  !> modes were pinned. `stat` is not zero, and `displacement` unchanged, without memory.
  subroutine remove_motions(modes, scale, displacement, stat)
    real(dp), intent(in) :: modes(:, :), scale(:)
    real(dp), intent(inout) :: displacement(:)
    integer, intent(out) :: stat
    real(dp), allocatable :: y(:, :), projection(:)
    integer :: k, order(size(modes, 2)), rank

    stat = 0
    if (size(modes, 2) < 1) return
    allocate (y(size(modes, 1), size(modes, 2)), projection(size(modes, 1)), stat=stat)
    if (stat /= 0) return
    do k = 1, size(modes, 2)
      y(:, k) = modes(:, k)*scale
    end do
    call orthonormalise(y, 0.0_dp, order, rank, stat)
    if (stat /= 0) return
    do k = 1, size(y, 2)
      projection = y(:, k)*dot_product(y(:, k), displacement*scale)
      call unscale(projection, scale)
      displacement = displacement - projection
    end do
  end subroutine remove_motions

end module fuge_contact_modes
