!> Surfaces moved to the origin, where their coordinates do not swamp their shape.
module fuge_near_origin
  use fuge_kinds, only: dp
  use fuge_surface_mesh_type, only: face_size, fuge_surface_mesh
  implicit none
  private

  public :: way_to_origin, move_surface

contains

  !> The way by which two surfaces are moved to the origin, (dimensions); zero where they are near it.
  !>
  !> A multiple of a power of two that is not smaller than the extent of the surfaces: the sum of a position and the way
  !> is exact but for digits below the rounding error of that extent.
  pure function way_to_origin(contact, opposite) result(way)
    type(fuge_surface_mesh), intent(in) :: contact, opposite
    real(dp) :: way(size(contact%node, 1)), lower(size(way)), upper(size(way)), step

    lower = huge(1.0_dp)
    upper = -huge(1.0_dp)
    call enclose(contact, lower, upper)
    call enclose(opposite, lower, upper)
    step = scale(1.0_dp, exponent(maxval(upper - lower)))
    way = -step*anint((0.5_dp*lower + 0.5_dp*upper)/step)
  end function way_to_origin

  !> Widen a box until it holds a surface.
  pure subroutine enclose(surface, lower, upper)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp), intent(inout) :: lower(:), upper(:)
    integer :: f, k

    do f = 1, size(surface%face, 2)
      do k = 1, face_size(surface, f)
        lower = min(lower, surface%node(:, surface%face(k, f)))
        upper = max(upper, surface%node(:, surface%face(k, f)))
      end do
    end do
  end subroutine enclose

  !> Copy a surface, moved by `way`. `stat` is not zero without memory.
  pure subroutine move_surface(surface, way, moved, stat)
    type(fuge_surface_mesh), intent(in) :: surface
    real(dp), intent(in) :: way(:)
    type(fuge_surface_mesh), intent(out) :: moved
    integer, intent(out) :: stat
    integer :: f, i, k

    allocate (moved%node, source=surface%node, stat=stat)
    if (stat == 0) allocate (moved%face, source=surface%face, stat=stat)
    if (stat == 0 .and. allocated(surface%dof)) allocate (moved%dof, source=surface%dof, stat=stat)
    if (stat /= 0) return
    ! Only nodes of faces are read.
    do f = 1, size(surface%face, 2)
      do k = 1, face_size(surface, f)
        i = surface%face(k, f)
        moved%node(:, i) = surface%node(:, i) + way
      end do
    end do
  end subroutine move_surface

end module fuge_near_origin
