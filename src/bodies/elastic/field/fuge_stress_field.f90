!> A field of stress under a contact, as the search for its largest value sees it.
module fuge_stress_field
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  private

  !> Something that knows the stresses in a body at any depth z >= 0.
  type, abstract, public :: stress_field
  contains
    procedure(field_stresses), deferred :: stresses
  end type stress_field

  abstract interface
    !> `stress` (6, points): xx, yy, zz, yz, xz, xy at `place` (3, points), x, y, z in the caller's coordinates.
    !>
    !> Evaluating may fill what a field stores for the next points.
    !> Fields in a plane have y = 0 and no yz, xy; those with an axis take x as the radius. Tension is positive.
    subroutine field_stresses(self, place, stress, info)
      import :: stress_field, dp, fuge_info
      class(stress_field), intent(inout) :: self
      real(dp), intent(in) :: place(:, :)
      real(dp), intent(out) :: stress(:, :)
      type(fuge_info), intent(inout) :: info
    end subroutine field_stresses
  end interface

end module fuge_stress_field
