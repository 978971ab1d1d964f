!> The largest stress in a half-space about an axis, under rings and under round punches.
module fuge_round_peak_search
  use fuge_component_field, only: component_field
  use fuge_constants, only: PI
  use fuge_elastic_moduli, only: check_poisson
  use fuge_kinds, only: dp
  use fuge_pressed_cells, only: allocate_cells, pressed_cells
  use fuge_pressure_rims, only: find_singular_rim
  use fuge_ring_interior, only: fuge_ring_stress
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_round_interior, only: fuge_round_stress
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_peak_type, only: check_measure, fuge_stress_peak
  implicit none
  private

  public :: fuge_ring_peak, fuge_round_peak

  type, extends(component_field) :: field_of_rings
    real(dp), allocatable :: radius(:), force(:)
  contains
    procedure :: components => components_under_rings
  end type field_of_rings

  type, extends(component_field) :: field_of_punch
    type(fuge_round_contact) :: contact
  contains
    procedure :: components => components_under_punch
  end type field_of_punch

  !> Cells that stand for the pressure of a round punch, an even number so that none lies on the axis.
  integer, parameter :: PUNCH_CELLS = 512

contains

  !> The largest von Mises or Tresca stress in a half-space under forces on rings, and where it is.
  !>
  !> `radius`, `force` and `poisson` as for `fuge_ring_stress`; `measure` FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA.
  !> Out: `peak`, its place being the distance from the axis, 0 and the depth. Value and place are those of the field of
  !> these forces, the value to 1e-10 or better and the place to its root.
  !>
  !> The pressure jumps from ring to ring, and close to the surface the stresses follow the rings rather than the
  !> contact. At the surface the search therefore takes the middles of rings and of equal ones beside them, and below it
  !> depths from a quarter of the width of a ring on; what may lie between is not resolved by the rings.
  !>
  !> Where the pressure grows towards an edge of the contact like that of a flat punch, the stress of the exact solution
  !> is infinite and any largest value would be one of the rings: then the location is FUGE_PEAK_SINGULAR, the value
  !> +infinity, the place that edge and the tensor NaN. The forces of seven rings at the edge decide, in a disc of less
  !> than six rings those of four; edges of annuli with less than twelve rings are not judged. Without forces value,
  !> place and tensor are 0. Errors, `peak` untouched: those of `fuge_ring_stress`; FUGE_ERR_OPTION for `measure`.
  subroutine fuge_ring_peak(radius, force, poisson, measure, peak, info)
    use fuge_peak_search, only: find_peak, singular_peak
    real(dp), intent(in) :: radius(:), force(:), poisson
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(field_of_rings) :: field
    type(pressed_cells) :: cells
    real(dp) :: nowhere(0), nothing(4, 0), edge(2)
    logical :: singular
    integer :: stat

    nowhere = 0.0_dp
    call fuge_ring_stress(radius, force, poisson, nowhere, nowhere, nothing, info)
    call check_measure(measure, info)
    if (info%failed()) return
    call collect_rings(radius, force, cells, info)
    cells%surface_factor = 1.0_dp - 2.0_dp*poisson
    call find_singular_rim(cells, singular, edge, info)
    if (info%failed()) return
    if (singular) then
      peak = singular_peak([abs(edge(1)), 0.0_dp, 0.0_dp])
      return
    end if
    allocate (field%radius(size(radius)), field%force(size(force)), stat=stat)
    call require_memory(stat, '', size(force), 'rings', info)
    if (stat /= 0) return
    field%radius = radius
    field%force = force
    field%about_axis = .true.
    field%poisson = poisson
    call find_peak(field, cells, measure, peak, info)
    if (.not. info%failed()) peak%place(1) = abs(peak%place(1))
  end subroutine fuge_ring_peak

  !> The largest von Mises or Tresca stress in a half-space under a round punch, and where it is.
  !>
  !> `contact` of `fuge_solve_round_punch`; `poisson` of the body, above -1 and up to 0.5; `measure`
  !> FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA. Out: `peak`, the value to 1e-12 or better and its place, the
  !> distance from the axis, 0 and the depth, to its root; where the stress has a cusp, as at the rim of a sphere on a
  !> body with a negative Poisson's ratio, to 1e-6.
  !>
  !> In the tip of a cone and along an edge of the punch within the contact the pressure p is infinite like a logarithm,
  !> and so is every stress, but not in the same ratio: in a tip rr = tt = -(1/2 + poisson) p beside zz = -p, and along
  !> an edge tt = poisson (rr + zz). Unless poisson = 0.5 the measures are infinite with them: then the location is
  !> FUGE_PEAK_SINGULAR, the value +infinity, the place that tip or edge and the tensor NaN. Without load value, place
  !> and tensor are 0. Errors, `peak` untouched: FUGE_ERR_OPTION for `measure`; FUGE_ERR_MODULUS, FUGE_ERR_NOT_FINITE
  !> for `poisson`; FUGE_ERR_MEMORY.
  subroutine fuge_round_peak(contact, poisson, measure, peak, info)
    use fuge_peak_search, only: find_peak, singular_peak
    type(fuge_round_contact), intent(in) :: contact
    real(dp), intent(in) :: poisson
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(field_of_punch) :: field
    type(pressed_cells) :: cells
    real(dp) :: singular_radius

    call check_poisson(poisson, info)
    call check_measure(measure, info)
    if (info%failed()) return
    singular_radius = -1.0_dp
    if (poisson < 0.5_dp) singular_radius = radius_of_singularity(contact)
    if (singular_radius >= 0.0_dp) then
      peak = singular_peak([singular_radius, 0.0_dp, 0.0_dp])
      return
    end if
    field%contact = contact
    field%about_axis = .true.
    field%poisson = poisson
    call collect_pressure(contact, cells, info)
    cells%surface_factor = 1.0_dp - 2.0_dp*poisson
    call find_peak(field, cells, measure, peak, info)
    if (.not. info%failed()) peak%place(1) = abs(peak%place(1))
  end subroutine fuge_round_peak

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

  !> The rings with a force, on both sides of the axis.
  pure subroutine collect_rings(radius, force, cells, info)
    real(dp), intent(in) :: radius(:), force(:)
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    real(dp) :: width
    integer :: k, number

    number = 2*count(abs(force) > 0.0_dp)
    call allocate_cells(1, number, cells, info)
    if (info%failed()) return
    cells%symmetric(1) = .true.
    cells%spreads = .true.
    number = 0
    do k = 1, size(force)
      if (.not. abs(force(k)) > 0.0_dp) cycle
      width = radius(k + 1) - radius(k)
      number = number + 2
      cells%centre(1, number - 1:number) = (radius(k) + 0.5_dp*width)*[1.0_dp, -1.0_dp]
      cells%width(1, number - 1:number) = width
      cells%pressure(number - 1:number) = force(k)/width/(PI*(radius(k) + radius(k + 1)))
    end do
  end subroutine collect_rings

  !> Cells for the pressure of a round punch on both sides of the axis, narrow at the rim; none without load.
  pure subroutine collect_pressure(contact, cells, info)
    type(fuge_round_contact), intent(in) :: contact
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    real(dp) :: inner, outer
    integer :: k, number

    number = 0
    if (contact%radius > 0.0_dp) number = PUNCH_CELLS
    call allocate_cells(1, number, cells, info)
    if (info%failed()) return
    cells%continuous = .true.
    cells%symmetric(1) = .true.
    cells%spreads = .true.
    do k = 1, number
      inner = -contact%radius*cos(PI*(real(k - 1, dp)/real(number, dp)))
      outer = -contact%radius*cos(PI*(real(k, dp)/real(number, dp)))
      cells%centre(1, k) = 0.5_dp*(inner + outer)
      cells%width(1, k) = outer - inner
    end do
    cells%pressure = contact%pressure(abs(cells%centre(1, :)))
    if (number > 0) cells%rim = reshape([contact%radius], [1, 1])
  end subroutine collect_pressure

  subroutine components_under_rings(self, px, pz, stress, info)
    class(field_of_rings), intent(inout) :: self
    real(dp), intent(in) :: px(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info

    call fuge_ring_stress(self%radius, self%force, self%poisson, px, pz, stress, info)
  end subroutine components_under_rings

  subroutine components_under_punch(self, px, pz, stress, info)
    class(field_of_punch), intent(inout) :: self
    real(dp), intent(in) :: px(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info

    call fuge_round_stress(self%contact, self%poisson, px, pz, stress, info)
  end subroutine components_under_punch

end module fuge_round_peak_search
