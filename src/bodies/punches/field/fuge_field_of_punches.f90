!> The fields under smooth and round punches, to rounding.
module fuge_field_of_punches
  use fuge_field_type, only: fuge_field
  use fuge_kinds, only: dp
  use fuge_punch_contact_type, only: punch_contact
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_peak_type, only: fuge_stress_peak
  implicit none
  private

  public :: make_punch_field

  !> In a half-plane under a smooth punch; made by `set`.
  type, extends(fuge_field), public :: fuge_smooth_punch_field
    private
    type(fuge_smooth_contact) :: contact
    real(dp) :: young = 0.0_dp, poisson = 0.0_dp
    integer :: plane_state = 0
  contains
    procedure :: set => set_smooth
    procedure :: find_stress => smooth_stress
    procedure :: find_displacement => smooth_displacement
    procedure :: find_largest => smooth_largest
  end type fuge_smooth_punch_field

  !> In a half-space under a round punch; made by `set`.
  type, extends(fuge_field), public :: fuge_round_punch_field
    private
    type(fuge_round_contact) :: contact
    real(dp) :: young = 0.0_dp, poisson = 0.0_dp
  contains
    procedure :: set => set_round
    procedure :: find_stress => round_stress
    procedure :: find_displacement => round_displacement
    procedure :: find_largest => round_largest
  end type fuge_round_punch_field

contains

  !> The field under a punch of either kind; `plane_state` counts under a smooth one only. Errors: those of its `set`.
  subroutine make_punch_field(contact, young, poisson, plane_state, field, info)
    class(punch_contact), intent(in) :: contact
    real(dp), intent(in) :: young, poisson
    integer, intent(in) :: plane_state
    class(fuge_field), allocatable, intent(out) :: field
    type(fuge_info), intent(out) :: info
    type(fuge_smooth_punch_field), allocatable :: smooth
    type(fuge_round_punch_field), allocatable :: round

    select type (contact)
    class is (fuge_smooth_contact)
      allocate (smooth)
      call smooth%set(contact, young, poisson, plane_state, info)
      call move_alloc(smooth, field)
    class is (fuge_round_contact)
      allocate (round)
      call round%set(contact, young, poisson, info)
      call move_alloc(round, field)
    end select
  end subroutine make_punch_field

  !> `contact` of `fuge_solve_smooth_punch`; `young`, `poisson`, `plane_state` of the body as for `fuge_plane_modulus`.
  !>
  !> Errors, the field unchanged: FUGE_ERR_MODULUS, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW.
  subroutine set_smooth(self, contact, young, poisson, plane_state, info)
    use fuge_smooth_interior, only: fuge_smooth_displacement
    class(fuge_smooth_punch_field), intent(inout) :: self
    type(fuge_smooth_contact), intent(in) :: contact
    real(dp), intent(in) :: young, poisson
    integer, intent(in) :: plane_state
    type(fuge_info), intent(out) :: info
    real(dp) :: nowhere(2, 0)

    ! The checks of a field at no point.
    call fuge_smooth_displacement(contact, young, poisson, plane_state, nowhere(1, :), nowhere(2, :), nowhere, info)
    if (info%failed()) return
    self%contact = contact
    self%young = young
    self%poisson = poisson
    self%plane_state = plane_state
    self%is_set = .true.
  end subroutine set_smooth

  subroutine smooth_stress(self, place, below, values, info)
    use fuge_smooth_interior, only: fuge_smooth_stress
    use fuge_stress_measures, only: fuge_halfplane_tensor
    class(fuge_smooth_punch_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)

    call make_components(3, size(below), component, info)
    if (.not. info%failed()) call fuge_smooth_stress(self%contact, place(1, :), place(3, :), component, info)
    if (.not. info%failed()) call fuge_halfplane_tensor(component, self%plane_state, self%poisson, values, info)
  end subroutine smooth_stress

  subroutine smooth_displacement(self, place, below, values, info)
    use fuge_smooth_interior, only: fuge_smooth_displacement
    class(fuge_smooth_punch_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)

    call make_components(2, size(below), component, info)
    if (.not. info%failed()) call fuge_smooth_displacement(self%contact, self%young, self%poisson, self%plane_state, &
                                                           place(1, :), place(3, :), component, info)
    if (info%failed()) return
    values(1:3:2, :) = component
    values(2, :) = 0.0_dp
  end subroutine smooth_displacement

  subroutine smooth_largest(self, measure, peak, info)
    use fuge_halfplane_peak_search, only: fuge_smooth_peak
    class(fuge_smooth_punch_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info

    call fuge_smooth_peak(self%contact, self%plane_state, self%poisson, measure, peak, info)
  end subroutine smooth_largest

  !> `contact` of `fuge_solve_round_punch` or `fuge_solve_round_powers`; `young`, force per length squared, which may be
  !> infinite, and `poisson` of the body.
  !>
  !> Errors, the field unchanged: FUGE_ERR_MODULUS, FUGE_ERR_OVERFLOW.
  subroutine set_round(self, contact, young, poisson, info)
    use fuge_round_interior, only: fuge_round_displacement
    class(fuge_round_punch_field), intent(inout) :: self
    type(fuge_round_contact), intent(in) :: contact
    real(dp), intent(in) :: young, poisson
    type(fuge_info), intent(out) :: info
    real(dp) :: nowhere(2, 0)

    call fuge_round_displacement(contact, young, poisson, nowhere(1, :), nowhere(2, :), nowhere, info)
    if (info%failed()) return
    self%contact = contact
    self%young = young
    self%poisson = poisson
    self%is_set = .true.
  end subroutine set_round

  subroutine round_stress(self, place, below, values, info)
    use fuge_round_interior, only: fuge_round_stress
    use fuge_stress_measures, only: fuge_round_tensor
    class(fuge_round_punch_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)

    call make_components(4, size(below), component, info)
    if (.not. info%failed()) call fuge_round_stress(self%contact, self%poisson, place(1, :), place(3, :), component, info)
    if (.not. info%failed()) call fuge_round_tensor(component, values, info)
  end subroutine round_stress

  subroutine round_displacement(self, place, below, values, info)
    use fuge_round_interior, only: fuge_round_displacement
    class(fuge_round_punch_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :)
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: component(:, :)

    call make_components(2, size(below), component, info)
    if (.not. info%failed()) call fuge_round_displacement(self%contact, self%young, self%poisson, place(1, :), &
                                                          place(3, :), component, info)
    if (info%failed()) return
    values(1:3:2, :) = component
    values(2, :) = 0.0_dp
  end subroutine round_displacement

  subroutine round_largest(self, measure, peak, info)
    use fuge_round_peak_search, only: fuge_round_peak
    class(fuge_round_punch_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info

    call fuge_round_peak(self%contact, self%poisson, measure, peak, info)
  end subroutine round_largest

  !> Room for the components at so many points; FUGE_ERR_MEMORY.
  subroutine make_components(components, points, component, info)
    integer, intent(in) :: components, points
    real(dp), allocatable, intent(out) :: component(:, :)
    type(fuge_info), intent(out) :: info
    integer :: stat

    allocate (component(components, points), stat=stat)
    call require_memory(stat, 'results at', points, 'points', info)
  end subroutine make_components

end module fuge_field_of_punches
