!> Displacements of the points by rigid motions and by contact forces.
!>
!> Elastic displacements are those of alpha less `datum`, the coefficient nearest to zero: a constant in all of alpha
!> that changes the translation only and, taken out first, costs no digits.
module fuge_displacements
  use fuge_kinds, only: dp
  implicit none
  private

  public :: add_elastic_displacement, displacement_magnitude, largest_contribution, rigid_displacement

contains

  !> R q at each point, (n).
  pure function rigid_displacement(modes, motion) result(displacement)
    real(dp), intent(in), contiguous :: modes(:, :)
    real(dp), intent(in) :: motion(:)
    real(dp) :: displacement(size(modes, 1))
    integer :: j

    displacement = 0.0_dp
    do j = 1, size(motion)
      displacement = displacement + modes(:, j)*motion(j)
    end do
  end function rigid_displacement

  !> u := u + (alpha - datum) f, with the columns of the contact only.
  !>
  !> Not by BLAS: taking the datum out of each coefficient keeps the digits of the product.
  pure subroutine add_elastic_displacement(alpha, datum, contact, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: u(:)
    integer :: j, n

    n = size(u)
    do j = 1, n
      if (contact(j)) u = u + (alpha(:n, j) - datum)*force(j)
    end do
  end subroutine add_elastic_displacement

  !> sum_j |alpha_kj - datum| |f_j|, (n): the size of the terms of a displacement, which may cancel.
  pure function displacement_magnitude(alpha, datum, contact, force) result(magnitude)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    real(dp) :: magnitude(size(contact))
    integer :: j

    magnitude = 0.0_dp
    do j = 1, size(contact)
      if (contact(j)) magnitude = magnitude + abs((alpha(:size(contact), j) - datum)*force(j))
    end do
  end function displacement_magnitude

  !> The contribution of the largest force to these magnitudes, (n): less than all, at the cost of one column.
  pure function largest_contribution(alpha, datum, force) result(magnitude)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    real(dp) :: magnitude(size(force))
    integer :: k

    k = maxloc(abs(force), dim=1)
    magnitude = abs((alpha(:size(force), k) - datum)*force(k))
  end function largest_contribution

end module fuge_displacements
