!> What knows the stresses in a body, as the search for the largest one sees it.
module fuge_stress_field
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  implicit none
  private

  !> A field of stresses in a body, anywhere in it.
  type, abstract, public :: stress_field
  contains
    !> Stresses at places.
    procedure(stresses_at_places), deferred :: find_stress
  end type stress_field

  abstract interface
    !> `values` (6, points): xx, yy, zz, yz, xz, xy at `place` (3, points), x, y, z >= 0; tension is positive.
    !>
    !> Fields in a plane have y = 0 and no yz, xy; those about an axis take x >= 0 as the radius. `below` (points): at
    !> an interface of layers, just below it.
    subroutine stresses_at_places(self, place, below, values, info)
      import :: stress_field, dp, fuge_info
      class(stress_field), intent(in) :: self
      real(dp), intent(in) :: place(:, :)
      logical, intent(in) :: below(:)
      real(dp), intent(inout) :: values(:, :)
      type(fuge_info), intent(out) :: info
    end subroutine stresses_at_places
  end interface

end module fuge_stress_field
