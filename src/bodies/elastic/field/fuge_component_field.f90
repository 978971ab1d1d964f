!> A field of stress that is known by its components in a plane, or about an axis, and seen as a field of tensors.
module fuge_component_field
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_field, only: stress_field
  use fuge_stress_measures, only: fuge_halfplane_tensor, fuge_round_tensor
  implicit none
  private

  !> A child finds the components. About an axis the places lie on both sides of it.
  type, abstract, extends(stress_field), public :: component_field
    logical :: about_axis = .false.
    !> In a plane only: FUGE_PLANE_STRAIN or FUGE_PLANE_STRESS.
    integer :: plane_state = 0
    real(dp) :: poisson = 0.0_dp
  contains
    procedure :: stresses => tensors
    procedure(find_components), deferred :: components
  end type component_field

  abstract interface
    !> `stress` (3, points): xx, zz, xz at `px` along the surface and `pz` into the body; or (4, points): rr, tt, zz, rz
    !> at the distances `px` >= 0 from the axis.
    subroutine find_components(self, px, pz, stress, info)
      import :: component_field, dp, fuge_info
      class(component_field), intent(inout) :: self
      real(dp), intent(in) :: px(:), pz(:)
      real(dp), intent(inout) :: stress(:, :)
      type(fuge_info), intent(out) :: info
    end subroutine find_components
  end interface

contains

  subroutine tensors(self, place, stress, info)
    class(component_field), intent(inout) :: self
    real(dp), intent(in) :: place(:, :)
    real(dp), intent(out) :: stress(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: component(:, :)
    integer :: stat

    if (info%failed()) return
    allocate (component(merge(4, 3, self%about_axis), size(place, 2)), stat=stat)
    call require_memory(stat, 'stresses at', size(place, 2), 'points', info)
    if (stat /= 0) return
    if (self%about_axis) then
      call self%components(abs(place(1, :)), place(3, :), component, info)
      if (.not. info%failed()) call fuge_round_tensor(component, stress, info)
    else
      call self%components(place(1, :), place(3, :), component, info)
      if (.not. info%failed()) call fuge_halfplane_tensor(component, self%plane_state, self%poisson, stress, info)
    end if
  end subroutine tensors

end module fuge_component_field
