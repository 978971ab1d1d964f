!> The normals H of the contact points, (degrees, n): H f and H^T u.
module fuge_contact_normals
  use fuge_body_type, only: fuge_body
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text
  use fuge_status, only: fuge_info, report, FUGE_ERR_DOF
  implicit none
  private

  public :: add_contact_forces, add_point_force, check_free_points, displacement_scale, is_held, pin_scale, &
    point_displacement

contains

  !> Add the forces of all contact points, H f, to the loads `load` (degrees); `force` (n).
  pure subroutine add_contact_forces(body, force, load)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: load(:)
    integer :: i

    do i = 1, size(force)
      call add_point_force(body%dof(:, i), body%normal(:, i), force(i), load)
    end do
  end subroutine add_contact_forces

  !> Add the force of one contact point, a column of H times `force`, to the loads `load`
  !> (degrees).
  pure subroutine add_point_force(dof, normal, force, load)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: normal(:), force
    real(dp), intent(inout) :: load(:)
    integer :: k

    do k = 1, size(dof)
      if (dof(k) > 0) load(dof(k)) = load(dof(k)) + normal(k)*force
    end do
  end subroutine add_point_force

  !> Displacement of a contact point, a row of H^T u, in the displacements `u` (degrees).
  pure function point_displacement(dof, normal, u) result(displacement)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: normal(:), u(:)
    real(dp) :: displacement
    integer :: k

    displacement = 0.0_dp
    do k = 1, size(dof)
      if (dof(k) > 0) displacement = displacement + normal(k)*u(dof(k))
    end do
  end function point_displacement

  !> Displacement of each contact point, (n), when every scaled degree of freedom moves by one in
  !> the sense that adds to it; `scale` (degrees), zero where fixed.
  pure function displacement_scale(body, scale) result(length)
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
  end function displacement_scale

  !> The `scale` (degrees) for the choice of pins, reduced where contact forces act: a pin there
  !> would remove the influence of the force.
  pure function pin_scale(body, scale) result(reduced)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: scale(:)
    real(dp), allocatable :: reduced(:)
    integer :: i, k

    reduced = scale
    do i = 1, size(body%dof, 2)
      do k = 1, size(body%dof, 1)
        ! Not times 1e-3 again: a degree of freedom may belong to several points.
        if (body%dof(k, i) > 0) reduced(body%dof(k, i)) = 1.0e-3_dp*scale(body%dof(k, i))
      end do
    end do
  end function pin_scale

  !> Refuse a contact point all of whose degrees of freedom are `constrained` (FUGE_ERR_DOF).
  pure subroutine check_free_points(body, constrained, info)
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: constrained(:)
    type(fuge_info), intent(inout) :: info
    integer :: i

    do i = 1, size(body%dof, 2)
      if (.not. is_held(body%dof(:, i), body%normal(:, i), constrained)) cycle
      call report(info, FUGE_ERR_DOF, 'contact point '//index_text(i)//' cannot move in the direction of its force, ' &
                  //'because of the supports: leave it out, or free degree of freedom ' &
                  //index_text(maxval(body%dof(:, i))))
      return
    end do
  end subroutine check_free_points

  !> Does a contact point move with no degree of freedom but those that are `constrained` (degrees)?
  pure function is_held(dof, normal, constrained) result(held)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: normal(:)
    logical, intent(in) :: constrained(:)
    logical :: held
    integer :: k

    held = .true.
    do k = 1, size(dof)
      if (dof(k) < 1) cycle
      held = held .and. (constrained(dof(k)) .or. .not. abs(normal(k)) > 0.0_dp)
    end do
  end function is_held

end module fuge_contact_normals
