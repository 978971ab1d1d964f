!> The largest stress in a half-space under rectangles.
module fuge_halfspace_peak_search
  use fuge_area_field, only: add_area_field, area_field, new_area_field
  use fuge_elastic_moduli, only: check_poisson
  use fuge_kinds, only: dp
  use fuge_pressed_cells, only: allocate_cells, is_own_image, pressed_cells
  use fuge_pressure_rims, only: find_singular_rim
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_field, only: stress_field
  use fuge_stress_peak_type, only: check_measure, fuge_stress_peak
  implicit none
  private

  public :: fuge_halfspace_peak

  type, extends(stress_field) :: field_of_rectangles
    type(area_field) :: area
  contains
    procedure :: stresses
  end type field_of_rectangles

  !> Rectangles longer than LONGEST widths are cut for the search, into at most MOST_PIECES pieces.
  real(dp), parameter :: LONGEST = 4.0_dp
  integer, parameter :: MOST_PIECES = 32

contains

  !> The largest von Mises or Tresca stress in a half-space under forces on rectangles, and where it is.
  !>
  !> `x`, `y`, `width_x`, `width_y`, `force`, `poisson`, `symmetric_x` and `symmetric_y` as for `fuge_halfspace_stress`;
  !> `measure` FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA. Out: `peak`, of a symmetric model at x >= 0, y >= 0. Value
  !> and place are those of the field of these forces, the value to 1e-10 or better and the place to its root.
  !>
  !> The pressure jumps from rectangle to rectangle, and close to the surface the stresses follow the rectangles rather
  !> than the contact; at their corners one is infinite. At the surface the search therefore takes the middles of
  !> rectangles and of equal ones beside them, and below it depths from a quarter of the lesser width on: what may lie
  !> between is not resolved by the rectangles. At the surface it takes all of them where that can compete, which is
  !> with Poisson's ratios up to 0.1 or so.
  !>
  !> Where the pressure grows towards an edge of the contact like that of a flat punch, the stress of the exact solution
  !> is infinite and any largest value would be one of the grid: then the location is FUGE_PEAK_SINGULAR, the value
  !> +infinity, the place that edge and the tensor NaN. The forces of five to seven rectangles at the edge decide, in
  !> three rows side by side; pieces of the contact with less than eight rectangles in a row are not judged. Without
  !> forces value, place and tensor are 0.
  !>
  !> Eleven arguments: the rectangles, the body, the measure, the result. Errors, `peak` untouched: those of
  !> `fuge_halfspace_stress`; FUGE_ERR_OPTION for `measure`; FUGE_ERR_MEMORY.
  subroutine fuge_halfspace_peak(x, y, width_x, width_y, force, poisson, measure, peak, info, symmetric_x, symmetric_y)
    use fuge_peak_search, only: singular_peak
    use fuge_pressed_area, only: check_area, pressed_area
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), poisson
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    type(pressed_area) :: area
    type(pressed_cells) :: cells
    real(dp) :: edge(2)
    logical :: singular, symmetric(2)
    integer :: stat

    symmetric = .false.
    if (present(symmetric_x)) symmetric(1) = symmetric_x
    if (present(symmetric_y)) symmetric(2) = symmetric_y
    call check_area(x, y, width_x, width_y, force, symmetric, info)
    if (.not. info%failed()) call check_poisson(poisson, info)
    call check_measure(measure, info)
    if (info%failed()) return
    call area%set(x, y, width_x, width_y, force, symmetric, stat)
    call require_memory(stat, 'the area of', size(x), 'rectangles', info)
    call collect_cells(area, cells, info)
    cells%surface_factor = 1.0_dp - 2.0_dp*poisson
    call find_singular_rim(cells, singular, edge, info)
    if (info%failed()) return
    if (singular) then
      peak = singular_peak([edge, 0.0_dp])
    else
      call divide_long(cells, info)
      call search(area, poisson, cells, measure, peak, info)
    end if
    if (info%failed()) return
    if (symmetric(1) .and. peak%place(1) < 0.0_dp) call reflect(1, peak)
    if (symmetric(2) .and. peak%place(2) < 0.0_dp) call reflect(2, peak)
  end subroutine fuge_halfspace_peak

  !> The search in the field of the area, which is used up.
  subroutine search(area, poisson, cells, measure, peak, info)
    use fuge_peak_search, only: find_peak
    use fuge_pressed_area, only: pressed_area
    type(pressed_area), intent(inout) :: area
    real(dp), intent(in) :: poisson
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(inout) :: info
    type(field_of_rectangles), allocatable :: field
    integer :: stat

    allocate (field, stat=stat)
    if (stat == 0) call new_area_field(area, poisson, field%area, stat)
    call require_memory(stat, 'the field of', size(cells%pressure), 'rectangles', info)
    if (stat /= 0) return
    call find_peak(field, cells, measure, peak, info)
  end subroutine search

  !> The rectangles of the area. Of one that is its own image but for rounding the image is left out.
  pure subroutine collect_cells(area, cells, info)
    use fuge_pressed_area, only: pressed_area
    type(pressed_area), intent(in) :: area
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    integer :: k, number, side(2)

    if (info%failed()) return
    number = 0
    do k = 1, area%count
      if (all(doubled_sides(area, k) >= 0)) number = number + 1
    end do
    call allocate_cells(2, number, cells, info)
    if (info%failed()) return
    cells%symmetric = area%symmetric
    cells%spreads = .true.
    number = 0
    do k = 1, area%count
      side = doubled_sides(area, k)
      if (any(side < 0)) cycle
      number = number + 1
      cells%centre(:, number) = area%place_of(k)
      cells%width(:, number) = area%width_of(k)
      cells%pressure(number) = area%pressure_of(k, product(1 + side))
    end do
  end subroutine collect_cells

  !> Along each axis: 1 if the image of the rectangle lies on it but for rounding, -1 if it is this image, otherwise 0.
  pure function doubled_sides(area, k) result(side)
    use fuge_pressed_area, only: pressed_area
    type(pressed_area), intent(in) :: area
    integer, intent(in) :: k
    integer :: side(2)
    real(dp) :: place(2)

    place = area%place_of(k)
    side = 0
    where (area%symmetric .and. is_own_image(place, area%width_of(k)) .and. abs(place) > 0.0_dp) &
      side = nint(sign(1.0_dp, place))
  end function doubled_sides

  !> Cut long rectangles, because the largest stress may lie below any part of them.
  pure subroutine divide_long(cells, info)
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    type(pressed_cells) :: divided
    integer :: along, i, k, number, pieces

    number = 0
    do k = 1, size(cells%pressure)
      number = number + pieces_of(cells%width(:, k))
    end do
    if (number == size(cells%pressure) .or. info%failed()) return
    call allocate_cells(2, number, divided, info)
    if (info%failed()) return
    number = 0
    do k = 1, size(cells%pressure)
      pieces = pieces_of(cells%width(:, k))
      along = maxloc(cells%width(:, k), dim=1)
      do i = 1, pieces
        number = number + 1
        divided%centre(:, number) = cells%centre(:, k)
        divided%width(:, number) = cells%width(:, k)
        divided%width(along, number) = cells%width(along, k)/real(pieces, dp)
        divided%centre(along, number) = cells%centre(along, k) &
                                        + 0.5_dp*real(2*i - 1 - pieces, dp)*divided%width(along, number)
        divided%pressure(number) = cells%pressure(k)
      end do
    end do
    call move_alloc(divided%centre, cells%centre)
    call move_alloc(divided%width, cells%width)
    call move_alloc(divided%pressure, cells%pressure)
  end subroutine divide_long

  !> Into how many pieces a rectangle of this width is cut.
  pure function pieces_of(width) result(pieces)
    real(dp), intent(in) :: width(2)
    integer :: pieces

    pieces = ceiling(min(real(MOST_PIECES, dp), maxval(width)/LONGEST/minval(width)))
    ! Odd, because one of the middles is that of the whole.
    if (modulo(pieces, 2) == 0) pieces = pieces + 1
  end function pieces_of

  !> The mirror image along an axis.
  pure subroutine reflect(axis, peak)
    integer, intent(in) :: axis
    type(fuge_stress_peak), intent(inout) :: peak

    peak%place(axis) = -peak%place(axis)
    ! xz or yz, and xy.
    peak%tensor(6 - axis) = -peak%tensor(6 - axis)
    peak%tensor(6) = -peak%tensor(6)
  end subroutine reflect

  subroutine stresses(self, place, stress, info)
    class(field_of_rectangles), intent(inout) :: self
    real(dp), intent(in) :: place(:, :)
    real(dp), intent(out) :: stress(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    stress = 0.0_dp
    if (info%failed()) return
    call add_area_field(self%area, place(1, :), place(2, :), place(3, :), stress, stat)
    call require_memory(stat, 'stresses at', size(place, 2), 'points', info)
  end subroutine stresses

end module fuge_halfspace_peak_search
