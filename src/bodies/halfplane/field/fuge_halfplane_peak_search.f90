!> The largest stress in a half-plane, under cells and under smooth punches.
module fuge_halfplane_peak_search
  use fuge_component_field, only: component_field
  use fuge_constants, only: PI
  use fuge_elastic_moduli, only: FUGE_PLANE_STRAIN
  use fuge_kinds, only: dp
  use fuge_pressed_cells, only: allocate_cells, is_own_image, pressed_cells
  use fuge_pressed_line, only: check_line, pressed_line
  use fuge_pressure_rims, only: find_singular_rim
  use fuge_smooth_contact_type, only: fuge_smooth_contact
  use fuge_smooth_interior, only: fuge_smooth_stress
  use fuge_status, only: fuge_info
  use fuge_stress_measures, only: check_plane
  use fuge_stress_peak_type, only: check_measure, fuge_stress_peak
  implicit none
  private

  public :: fuge_halfplane_peak, fuge_smooth_peak

  type, extends(component_field) :: field_of_line
    type(pressed_line) :: line
  contains
    procedure :: components => components_under_line
  end type field_of_line

  type, extends(component_field) :: field_of_punch
    type(fuge_smooth_contact) :: contact
  contains
    procedure :: components => components_under_punch
  end type field_of_punch

  !> Cells that stand for the pressure of a smooth punch: for each coefficient, and at least.
  integer, parameter :: CELLS_EACH = 4, FEWEST_CELLS = 64

contains

  !> The largest von Mises or Tresca stress in a half-plane under forces on its cells, and where it is.
  !>
  !> `x`, `width`, `force`, `element` and `symmetric` as for `fuge_halfplane_stress`; `plane_state` and `poisson` of the
  !> body as for `fuge_halfplane_tensor`; `measure` FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA. Out: `peak`, of a
  !> symmetric model at x >= 0. Value and place are those of the field of these forces, the value to 1e-10 or better and
  !> the place to its root.
  !>
  !> Uniform pressure jumps from cell to cell, and close to the surface the stresses follow the cells rather than the
  !> contact. With FUGE_CENTRE and FUGE_MEAN the search therefore takes the middles of cells at the surface, and below
  !> it depths from a quarter of the width of a cell on; what may lie between is not resolved by the cells. With
  !> FUGE_HAT it takes all depths.
  !>
  !> Where the pressure grows towards an edge of the contact like that of a flat punch, the stress of the exact solution
  !> is infinite and any largest value would be one of the grid: then the location is FUGE_PEAK_SINGULAR, the value
  !> +infinity, the place that edge and the tensor NaN. The forces of seven cells at the edge decide, in a contact of
  !> less than twelve cells in one piece those of its half; edges of pieces with less than twelve cells are not judged.
  !> Without forces value, place and tensor are 0.
  !>
  !> Ten arguments: the cells, the body, the measure, the result. Errors, `peak` untouched: those of
  !> `fuge_halfplane_stress` and `fuge_halfplane_tensor`; FUGE_ERR_OPTION for `measure`; FUGE_ERR_MEMORY.
  subroutine fuge_halfplane_peak(x, width, force, element, plane_state, poisson, measure, peak, info, symmetric)
    use fuge_peak_search, only: find_peak, singular_peak
    real(dp), intent(in) :: x(:), width(:), force(:), poisson
    integer, intent(in) :: element, plane_state, measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric
    type(field_of_line) :: field
    type(pressed_cells) :: cells
    real(dp) :: edge(2)
    logical :: folded, singular

    folded = .false.
    if (present(symmetric)) folded = symmetric
    call check_line(x, width, force, element, folded, info)
    call field%line%set(x, width, force, element, folded, info)
    call check_plane(plane_state, poisson, info)
    call check_measure(measure, info)
    if (info%failed()) return
    call collect_cells(field%line, cells, info)
    call find_singular_rim(cells, singular, edge, info)
    if (info%failed()) return
    if (singular) then
      peak = singular_peak([edge(1), 0.0_dp, 0.0_dp])
    else
      if (plane_state == FUGE_PLANE_STRAIN) cells%surface_factor = 1.0_dp - 2.0_dp*poisson
      field%plane_state = plane_state
      field%poisson = poisson
      call field%line%gather(info)
      call find_peak(field, cells, measure, peak, info)
    end if
    if (folded .and. .not. info%failed()) call to_right_half(peak)
  end subroutine fuge_halfplane_peak

  !> The largest von Mises or Tresca stress in a half-plane under a smooth punch, and where it is.
  !>
  !> `contact` of `fuge_solve_smooth_punch`; `plane_state` and `poisson` of the body as for `fuge_halfplane_tensor`;
  !> `measure` FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA. Out: `peak`, the value to rounding of the field and the
  !> place to 1e-7 of its depth. Its location is never FUGE_PEAK_SINGULAR. Without force value, place and tensor are 0.
  !> Errors, `peak` untouched: FUGE_ERR_OPTION for `plane_state` and `measure`; FUGE_ERR_MODULUS, FUGE_ERR_NOT_FINITE
  !> for `poisson`; FUGE_ERR_MEMORY.
  subroutine fuge_smooth_peak(contact, plane_state, poisson, measure, peak, info)
    use fuge_peak_search, only: find_peak
    type(fuge_smooth_contact), intent(in) :: contact
    integer, intent(in) :: plane_state, measure
    real(dp), intent(in) :: poisson
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    type(field_of_punch) :: field
    type(pressed_cells) :: cells

    call check_plane(plane_state, poisson, info)
    call check_measure(measure, info)
    if (info%failed()) return
    field%contact = contact
    field%plane_state = plane_state
    field%poisson = poisson
    call cells_of_punch(contact, cells, info)
    if (plane_state == FUGE_PLANE_STRAIN) cells%surface_factor = 1.0_dp - 2.0_dp*poisson
    call find_peak(field, cells, measure, peak, info)
  end subroutine fuge_smooth_peak

  !> The cells of the line, of a symmetric one those on both sides.
  pure subroutine collect_cells(line, cells, info)
    type(pressed_line), intent(in) :: line
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    integer :: k, number

    number = size(line%centre)
    if (line%symmetric) number = number + count(.not. is_own_image(line%centre, line%width))
    call allocate_cells(1, number, cells, info)
    if (info%failed()) return
    cells%continuous = line%hats
    cells%symmetric(1) = line%symmetric
    number = 0
    do k = 1, size(line%centre)
      number = number + 1
      cells%centre(1, number) = scale(line%centre(k), -line%power)
      cells%width(1, number) = scale(line%width(k), -line%power)
      cells%pressure(number) = scale(line%pressure(k), line%power)
      if (.not. line%symmetric .or. is_own_image(line%centre(k), line%width(k))) cycle
      cells%pressure(number) = 0.5_dp*cells%pressure(number)
      number = number + 1
      cells%centre(1, number) = -cells%centre(1, number - 1)
      cells%width(1, number) = cells%width(1, number - 1)
      cells%pressure(number) = cells%pressure(number - 1)
    end do
  end subroutine collect_cells

  !> Cells for the pressure of a smooth punch, narrow at both ends; none without force.
  pure subroutine cells_of_punch(contact, cells, info)
    type(fuge_smooth_contact), intent(in) :: contact
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    real(dp) :: left, right
    integer :: k, number

    number = 0
    if (allocated(contact%coefficients) .and. contact%half_width > 0.0_dp) &
      number = max(FEWEST_CELLS, CELLS_EACH*size(contact%coefficients))
    call allocate_cells(1, number, cells, info)
    if (info%failed()) return
    cells%continuous = .true.
    do k = 1, number
      left = -cos(PI*real(k - 1, dp)/real(number, dp))
      right = -cos(PI*real(k, dp)/real(number, dp))
      cells%centre(1, k) = contact%anchor + (contact%offset + 0.5_dp*(left + right)*contact%half_width)
      cells%width(1, k) = (right - left)*contact%half_width
    end do
    cells%pressure = contact%pressure(cells%centre(1, :))
  end subroutine cells_of_punch

  !> The mirror image on the side of a symmetric model.
  pure subroutine to_right_half(peak)
    type(fuge_stress_peak), intent(inout) :: peak

    if (peak%place(1) >= 0.0_dp) return
    peak%place(1) = -peak%place(1)
    peak%tensor(5) = -peak%tensor(5)
  end subroutine to_right_half

  subroutine components_under_line(self, px, pz, stress, info)
    class(field_of_line), intent(inout) :: self
    real(dp), intent(in) :: px(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info
    integer :: k

    do k = 1, size(pz)
      call self%line%find_stress(px(k), pz(k), stress(:, k))
    end do
  end subroutine components_under_line

  subroutine components_under_punch(self, px, pz, stress, info)
    class(field_of_punch), intent(inout) :: self
    real(dp), intent(in) :: px(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info

    call fuge_smooth_stress(self%contact, px, pz, stress, info)
  end subroutine components_under_punch

end module fuge_halfplane_peak_search
