!> A half-space under rows of rectangles that repeat along one direction: the mean along the rows.
!>
!> The mean of unit pressure on every n-th cell of a row is a strip of pressure 1/n on a half-plane, in plane strain.
module fuge_halfspace_mean_rows
  use fuge_cell_elements, only: FUGE_CENTRE
  use fuge_constants, only: PI
  use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
  use fuge_halfplane_interior, only: fuge_halfplane_displacement, fuge_halfplane_stress
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: mean_displacements, mean_stresses

contains

  !> `stress` (6, n), xx .. xy, at the distances of 0 .. n - 1 cells across rows along x (`direction` 1) or y (2), under
  !> unit pressure on one of `period` cells.
  !>
  !> `depth` in units of the width of a row. FUGE_ERR_MEMORY.
  subroutine mean_stresses(direction, period, poisson, depth, stress, info)
    integer, intent(in) :: direction, period
    real(dp), intent(in) :: poisson, depth
    real(dp), intent(out) :: stress(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: offset(:), level(:), plane(:, :)
    integer :: across

    call prepare(size(stress, 2), 3, depth, offset, level, plane, info)
    if (.not. info%failed()) call fuge_halfplane_stress([0.0_dp], [1.0_dp], [1.0_dp], FUGE_CENTRE, offset, level, &
                                                        plane, info, .false.)
    stress = 0.0_dp
    if (info%failed()) return
    plane = plane/real(period, dp)
    across = 3 - direction
    stress(across, :) = plane(1, :)
    stress(direction, :) = poisson*(plane(1, :) + plane(2, :))
    stress(3, :) = plane(2, :)
    ! yz or xz.
    stress(merge(4, 5, direction == 1), :) = plane(3, :)
  end subroutine mean_stresses

  !> `displacement` (3, n) along x, y, z, times Young's modulus and divided by the width of a row; otherwise as
  !> `mean_stresses`. The displacement along z is zero at the surface at the distance of 2 n cells.
  subroutine mean_displacements(direction, period, poisson, depth, displacement, info)
    integer, intent(in) :: direction, period
    real(dp), intent(in) :: poisson, depth
    real(dp), intent(out) :: displacement(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: offset(:), level(:), plane(:, :)
    real(dp) :: datum
    integer :: n

    n = size(displacement, 2)
    call prepare(n, 2, depth, offset, level, plane, info)
    if (.not. info%failed()) call fuge_halfplane_displacement([0.0_dp], [1.0_dp], [1.0_dp], FUGE_CENTRE, 1.0_dp, &
                                                              poisson, &
                                                              FUGE_PLANE_STRAIN, offset, level, plane, info, .false.)
    displacement = 0.0_dp
    if (info%failed()) return
    ! From the D of one cell to that of all.
    datum = 2.0_dp*(1.0_dp - poisson)*(1.0_dp + poisson)/PI*log(real(n, dp))
    displacement(3 - direction, :) = plane(1, :)/real(period, dp)
    displacement(3, :) = (plane(2, :) + datum)/real(period, dp)
  end subroutine mean_displacements

  !> Points at the distances 0 .. n - 1 and a result for them. FUGE_ERR_MEMORY.
  pure subroutine prepare(n, components, depth, offset, level, plane, info)
    integer, intent(in) :: n, components
    real(dp), intent(in) :: depth
    real(dp), allocatable, intent(out) :: offset(:), level(:), plane(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: k, stat

    allocate (offset(n), level(n), plane(components, n), stat=stat)
    call require_memory(stat, '', n, 'cells', info)
    if (stat /= 0) return
    do k = 1, n
      offset(k) = real(k - 1, dp)
    end do
    level = depth
  end subroutine prepare

end module fuge_halfspace_mean_rows
