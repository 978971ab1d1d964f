!> The largest stress in a half-space under rectangles.
module fuge_halfspace_peak_search
  use fuge_area_field, only: add_area_field, area_field, new_area_field
  use fuge_elastic_moduli, only: check_poisson
  use fuge_halfspace_interior, only: check_loaded_rectangles
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_peak_search, only: find_peak, singular_peak
  use fuge_pressed_cells, only: allocate_cells, is_own_image, pressed_cells
  use fuge_pressure_rims, only: find_singular_rim
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY
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

contains

  !> The largest von Mises or Tresca stress in a half-space under forces on rectangles, and where it is.
  !>
  !> `x`, `y`, `width_x`, `width_y`, `force`, `poisson`, `symmetric_x` and `symmetric_y` as for `fuge_halfspace_stress`;
  !> `measure` FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA. Out: `peak`, of a symmetric model at x >= 0, y >= 0. Value
  !> and place are those of the field of these forces, the value to 1e-10 or better and the place to its root.
  !>
  !> The pressure jumps from rectangle to rectangle, and close to the surface the stresses follow the rectangles rather
  !> than the contact; at their corners one is infinite. The search therefore takes the middles of rectangles at the
  !> surface, and below it depths from a quarter of the lesser width on: what may lie between is not resolved by the
  !> rectangles.
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
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), poisson
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    type(pressed_cells) :: cells
    real(dp) :: edge(2)
    logical :: singular, symmetric(2)

    symmetric = .false.
    if (present(symmetric_x)) symmetric(1) = symmetric_x
    if (present(symmetric_y)) symmetric(2) = symmetric_y
    call check_loaded_rectangles(x, y, width_x, width_y, force, symmetric, info)
    if (.not. info%failed()) call check_poisson(poisson, info)
    call check_measure(measure, info)
    if (info%failed()) return
    call collect_cells(x, y, width_x, width_y, force, symmetric, cells, info)
    call find_singular_rim(cells, singular, edge, info)
    if (info%failed()) return
    if (singular) then
      peak = singular_peak([edge, 0.0_dp])
    else
      call search(x, y, width_x, width_y, force, poisson, cells, measure, peak, info)
    end if
    if (info%failed()) return
    if (symmetric(1) .and. peak%place(1) < 0.0_dp) call reflect(1, peak)
    if (symmetric(2) .and. peak%place(2) < 0.0_dp) call reflect(2, peak)
  end subroutine fuge_halfspace_peak

  !> The search with the field of the rectangles; arguments as above.
  subroutine search(x, y, width_x, width_y, force, poisson, cells, measure, peak, info)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), poisson
    type(pressed_cells), intent(in) :: cells
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(inout) :: info
    type(field_of_rectangles), allocatable :: field
    integer :: stat

    allocate (field, stat=stat)
    if (stat == 0) call new_area_field(x, y, width_x, width_y, force, cells%symmetric, poisson, field%area, stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the field of '//text(size(x))//' rectangles')
      return
    end if
    call find_peak(field, cells, measure, peak, info)
  end subroutine search

  !> The rectangles with a force, of a symmetric model with their mirror images.
  pure subroutine collect_cells(x, y, width_x, width_y, force, symmetric, cells, info)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:)
    logical, intent(in) :: symmetric(2)
    type(pressed_cells), intent(inout) :: cells
    type(fuge_info), intent(inout) :: info
    integer :: i, j, k, images(2), number

    number = 0
    do k = 1, size(x)
      if (abs(force(k)) > 0.0_dp) number = number + product(images_of(x(k), y(k), width_x(k), width_y(k), symmetric))
    end do
    call allocate_cells(2, number, cells, info)
    if (info%failed()) return
    cells%symmetric = symmetric
    number = 0
    do k = 1, size(x)
      if (.not. abs(force(k)) > 0.0_dp) cycle
      images = images_of(x(k), y(k), width_x(k), width_y(k), symmetric)
      do j = 1, images(2)
        do i = 1, images(1)
          number = number + 1
          cells%centre(:, number) = [merge(x(k), -x(k), i == 1), merge(y(k), -y(k), j == 1)]
          cells%width(:, number) = [width_x(k), width_y(k)]
          cells%pressure(number) = force(k)/real(product(images), dp)/width_x(k)/width_y(k)
        end do
      end do
    end do
  end subroutine collect_cells

  !> Along each axis: one rectangle, or two with the mirror image.
  pure function images_of(x, y, width_x, width_y, symmetric) result(images)
    real(dp), intent(in) :: x, y, width_x, width_y
    logical, intent(in) :: symmetric(2)
    integer :: images(2)

    images = merge(2, 1, symmetric .and. .not. [is_own_image(x, width_x), is_own_image(y, width_y)])
  end function images_of

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
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for stresses at '//text(size(place, 2))//' points')
  end subroutine stresses

end module fuge_halfspace_peak_search
