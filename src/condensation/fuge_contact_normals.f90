!> The contact points of a body among its degrees of freedom: N f and N^T u.
module fuge_contact_normals
  use fuge_body_type, only: fuge_body
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, report, FUGE_ERR_DOF
  use fuge_number_text, only: text
  implicit none
  private

  public :: add_contact_forces, add_force, check_free_points, keep_off, moved, softness

contains

  !> Add the forces of all contact points to a field of loads.
  pure subroutine add_contact_forces(body, force, field)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: field(:)
    integer :: i

    do i = 1, size(force)
      call add_force(body%dof(:, i), body%normal(:, i), force(i), field)
    end do
  end subroutine add_contact_forces

  !> Add the force of one contact point to a field of loads: N f.
  pure subroutine add_force(dof, normal, force, field)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: normal(:), force
    real(dp), intent(inout) :: field(:)
    integer :: k

    do k = 1, size(dof)
      if (dof(k) > 0) field(dof(k)) = field(dof(k)) + normal(k)*force
    end do
  end subroutine add_force

  !> How far a contact point moves in a field of displacements: N^T u.
  pure function moved(dof, normal, field) result(distance)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: normal(:), field(:)
    real(dp) :: distance
    integer :: k

    distance = 0.0_dp
    do k = 1, size(dof)
      if (dof(k) > 0) distance = distance + normal(k)*field(dof(k))
    end do
  end function moved

  !> How far each contact point moves when all scaled degrees of freedom move by one, (n).
  pure function softness(body, scale) result(length)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: scale(:)
    real(dp) :: length(size(body%dof, 2))
    integer :: i, k

    length = 0.0_dp
    do i = 1, size(length)
      do k = 1, size(body%dof, 1)
        if (body%dof(k, i) < 1) cycle
        if (scale(body%dof(k, i)) > 0.0_dp) length(i) = length(i) + abs(body%normal(k, i))/scale(body%dof(k, i))
      end do
    end do
  end function softness

  !> The scale for the choice of pins: they had better not be where contact forces act, whose
  !> influence they would take away.
  pure function keep_off(body, scale) result(preferred)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: scale(:)
    real(dp), allocatable :: preferred(:)
    integer :: i, k

    preferred = scale
    do i = 1, size(body%dof, 2)
      do k = 1, size(body%dof, 1)
        ! From the scale, because a degree of freedom may belong to several points.
        if (body%dof(k, i) > 0) preferred(body%dof(k, i)) = 1.0e-3_dp*scale(body%dof(k, i))
      end do
    end do
  end function keep_off

  !> Refuse a contact point all of whose degrees of freedom are held (FUGE_ERR_DOF).
  pure subroutine check_free_points(body, held, info)
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: held(:)
    type(fuge_info), intent(inout) :: info
    integer :: i, k
    logical :: moves

    do i = 1, size(body%dof, 2)
      moves = .false.
      do k = 1, size(body%dof, 1)
        if (body%dof(k, i) < 1) cycle
        moves = moves .or. (abs(body%normal(k, i)) > 0.0_dp .and. .not. held(body%dof(k, i)))
      end do
      if (moves) cycle
      call report(info, FUGE_ERR_DOF, 'contact point '//text(i)//' is held by the supports in the direction of its ' &
                  //'force: leave it out, or free degree of freedom '//text(maxval(body%dof(:, i))))
      return
    end do
  end subroutine check_free_points

end module fuge_contact_normals
