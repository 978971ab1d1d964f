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

  !> Cells that stand for a pressure: of a smooth punch for each coefficient, and at least; of a round one.
  integer, parameter :: CELLS_EACH = 4, FEWEST_CELLS = 64, ROUND_CELLS = 512

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
    use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
    use fuge_peak_search, only: find_peak
    use fuge_pressed_cells, only: pressed_cells
    class(fuge_smooth_punch_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(pressed_cells) :: cells
    integer :: number

    number = 0
    if (allocated(self%contact%coefficients) .and. self%contact%half_width > 0.0_dp) &
      number = max(FEWEST_CELLS, CELLS_EACH*size(self%contact%coefficients))
    call collect_pressure(number, self%contact%half_width, cells, info)
    if (info%failed()) return
    cells%centre = self%contact%anchor + (self%contact%offset + cells%centre)
    cells%pressure = self%contact%pressure(cells%centre(1, :))
    if (self%plane_state == FUGE_PLANE_STRAIN) cells%surface_factor = 1.0_dp - 2.0_dp*self%poisson
    call find_peak(self, cells, measure, peak, info)
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
    if (.not. info%failed()) call fuge_round_stress(self%contact, self%poisson, place(1, :), place(3, :), component, &
                                                    info)
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

  !> In the tip of a cone and along an edge of the punch within the contact the pressure p is infinite like a logarithm,
  !> and so is every stress, but not in the same ratio: in a tip rr = tt = -(1/2 + poisson) p beside zz = -p, and along
  !> an edge tt = poisson (rr + zz). Unless poisson = 0.5 the measures are infinite with them.
  subroutine round_largest(self, measure, peak, info)
    use fuge_peak_search, only: find_peak, singular_peak
    use fuge_pressed_cells, only: pressed_cells
    class(fuge_round_punch_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(pressed_cells) :: cells
    real(dp) :: singular_radius

    singular_radius = -1.0_dp
    if (self%poisson < 0.5_dp) singular_radius = radius_of_singularity(self%contact)
    if (singular_radius >= 0.0_dp) then
      peak = singular_peak([singular_radius, 0.0_dp, 0.0_dp])
      return
    end if
    call collect_pressure(merge(ROUND_CELLS, 0, self%contact%radius > 0.0_dp), self%contact%radius, cells, info)
    if (info%failed()) return
    cells%symmetric(1) = .true.
    cells%pressure = self%contact%pressure(abs(cells%centre(1, :)))
    cells%surface_factor = 1.0_dp - 2.0_dp*self%poisson
    ! At the rim the stress at the surface has a cusp.
    cells%surface = reshape([self%contact%radius], [1, 1])
    call find_peak(self, cells, measure, peak, info)
  end subroutine round_largest

  !> Where the pressure of a round punch is infinite: 0 in a tip, the radius of an edge, -1 nowhere.
  pure function radius_of_singularity(contact) result(radius)
    use fuge_abel_transform, only: abel_transform
    type(fuge_round_contact), intent(in) :: contact
    real(dp) :: radius
    type(abel_transform) :: transform
    integer :: k

    radius = -1.0_dp
    if (.not. contact%radius > 0.0_dp) return
    transform = contact%abel()
    if (abs(transform%tip) > 0.0_dp) radius = 0.0_dp
    if (.not. allocated(transform%edges) .or. radius >= 0.0_dp) return
    do k = 1, size(transform%edges)
      if (transform%edges(k)%power == 1 .and. abs(transform%edges(k)%factor) > 0.0_dp) &
        radius = contact%radius*transform%edges(k)%start
    end do
  end function radius_of_singularity

  !> A `number` of cells for a continuous pressure from -`reach` to `reach`, narrow at both ends. FUGE_ERR_MEMORY.
  pure subroutine collect_pressure(number, reach, cells, info)
    use fuge_constants, only: PI
    use fuge_pressed_cells, only: allocate_cells, pressed_cells
    integer, intent(in) :: number
    real(dp), intent(in) :: reach
    type(pressed_cells), intent(out) :: cells
    type(fuge_info), intent(out) :: info
    real(dp) :: left, right
    integer :: k

    call allocate_cells(1, number, cells, info)
    if (info%failed()) return
    cells%continuous = .true.
    do k = 1, number
      left = -reach*cos(PI*(real(k - 1, dp)/real(number, dp)))
      right = -reach*cos(PI*(real(k, dp)/real(number, dp)))
      cells%centre(1, k) = 0.5_dp*(left + right)
      cells%width(1, k) = right - left
    end do
  end subroutine collect_pressure

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
