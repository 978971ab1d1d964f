!> Stresses and displacements inside an elastic half-space, under uniform pressures on rectangles.
module fuge_halfspace_interior
  use fuge_area_field, only: add_area_field, area_field, new_area_field
  use fuge_constants, only: LARGEST_EXPONENT, LARGEST_EXPONENT_OF_4
  use fuge_elastic_moduli, only: check_poisson, fuge_plane_modulus, FUGE_PLANE_STRAIN
  use fuge_halfplane_influence, only: FUGE_MEAN
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_rectangle_checks, only: check_places
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW
  use fuge_stress_checks, only: check_coordinate, check_depth, check_displacement_range, check_forces, check_result
  implicit none
  private

  public :: check_loaded_rectangles, fuge_halfspace_displacement, fuge_halfspace_stress

contains

  !> Stresses at points of a half-space under the forces of rectangles, each a uniform pressure.
  !>
  !> `x`, `y` (n) centres and `width_x`, `width_y` (n) widths of the rectangles, length; `force` (n), force, positive
  !> where it presses; `poisson` Poisson's ratio, in (-1, 0.5]; `px`, `py`, `pz` (points) in any number, pz >= 0 the
  !> depth; out: `stress` (6, points): xx, yy, zz, yz, xz, xy, tension positive, z into the body, force/length**2.
  !> `symmetric_x` (default .false.): about x = 0; pass only the rectangles with x >= 0, of which each force is the
  !> sum over a rectangle and its mirror image (a rectangle at 0 is its own image). `symmetric_y` likewise.
  !>
  !> At z = 0 stresses are limits from inside. They jump at edges between different pressures: on the edge xx, yy and zz
  !> are the means of both sides, and at a corner those around it; xz and yz are zero on the surface, and straight below
  !> an edge they tend to the difference of the pressures over pi. At a corner xy is infinite if poisson < 0.5 and
  !> the pressures around it do not balance: its logarithm is left out.
  !> Rectangles may overlap: their pressures add up. Far ones are taken in clusters. Errors are a few 1e-14 of the sum
  !> of the magnitudes of the terms at most, and for zz, yz and xz each of its own sum.
  !> Errors, `stress` untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS for `poisson`,
  !> FUGE_ERR_GRID for pz < 0, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY. Source: A. E. H. Love 1929; K. L. Johnson, Contact
  !> Mechanics, 1985, sections 3.2 and 3.4. Thirteen arguments: the order is that of the C interface.
  pure subroutine fuge_halfspace_stress(x, y, width_x, width_y, force, poisson, px, py, pz, stress, info, symmetric_x, &
                                        symmetric_y)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), poisson, px(:), py(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    type(area_field), allocatable :: field
    real(dp), allocatable :: found(:, :)
    logical :: symmetric(2)
    integer :: stat

    symmetric = given_symmetry(symmetric_x, symmetric_y)
    call check_loaded_rectangles(x, y, width_x, width_y, force, symmetric, info)
    if (.not. info%failed()) call check_poisson(poisson, info)
    call check_points(px, py, pz, info)
    call check_result(shape(stress), 'stress', 6, size(pz), info)
    if (info%failed()) return
    allocate (field, found(6, size(pz)), stat=stat)
    if (stat == 0) call new_area_field(x, y, width_x, width_y, force, symmetric, poisson, field, stat)
    if (stat == 0) then
      found = 0.0_dp
      call add_area_field(field, px, py, pz, found, stat)
    end if
    if (stat == 0) then
      stress = found
    else
      call report_memory(size(x), size(pz), info)
    end if
  end subroutine fuge_halfspace_stress

  !> Displacements at points of a half-space under the forces of rectangles, each a uniform pressure.
  !>
  !> `young` Young's modulus, > 0, force per length squared, +infinity for a rigid body, and `poisson` Poisson's ratio,
  !> in (-1, 0.5], of the body; out: `displacement` (3, points) along x, y, z, that along z positive into the body,
  !> length; all else as in `fuge_halfspace_stress`. Displacements vanish far away. Those along z at the centres of the
  !> rectangles, z = 0, are `fuge_halfspace_matrix` (FUGE_CENTRE, e_star = young/(1 - poisson**2)) times `force`.
  !> Errors, `displacement` untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS,
  !> FUGE_ERR_GRID for pz < 0, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY. Source: A. E. H. Love 1929; K. L. Johnson, Contact
  !> Mechanics, 1985, sections 3.2 and 3.4. Fourteen arguments: the order is that of the C interface.
  pure subroutine fuge_halfspace_displacement(x, y, width_x, width_y, force, young, poisson, px, py, pz, displacement, &
                                              info, symmetric_x, symmetric_y)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:), young, poisson, px(:), py(:), pz(:)
    real(dp), intent(inout) :: displacement(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: symmetric_x, symmetric_y
    type(area_field), allocatable :: field
    real(dp), allocatable :: found(:, :)
    logical :: symmetric(2)
    integer :: stat

    symmetric = given_symmetry(symmetric_x, symmetric_y)
    call check_loaded_rectangles(x, y, width_x, width_y, force, symmetric, info)
    call check_body(width_x, width_y, force, young, poisson, info)
    call check_points(px, py, pz, info)
    call check_result(shape(displacement), 'displacement', 3, size(pz), info)
    if (info%failed()) return
    allocate (field, found(3, size(pz)), stat=stat)
    if (stat == 0) call new_area_field(x, y, width_x, width_y, force, symmetric, poisson, field, stat)
    if (stat == 0) then
      found = 0.0_dp
      if (young <= huge(young)) call add_area_field(field, px, py, pz, found, stat)
    end if
    if (stat == 0) then
      displacement = found/young
    else
      call report_memory(size(x), size(pz), info)
    end if
  end subroutine fuge_halfspace_displacement

  !> Refuse rectangles and forces that are no load: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH,
  !> FUGE_ERR_OVERFLOW.
  pure subroutine check_loaded_rectangles(x, y, width_x, width_y, force, symmetric, info)
    real(dp), intent(in) :: x(:), y(:), width_x(:), width_y(:), force(:)
    logical, intent(in) :: symmetric(2)
    type(fuge_info), intent(inout) :: info
    integer :: k, reach

    call check_places(x, y, width_x, width_y, FUGE_MEAN, symmetric, info)
    if (info%failed()) return
    call check_forces(force, size(x), 'rectangles', info)
    if (info%failed()) return
    reach = exponent(max(maxval(abs(x)), maxval(abs(y)), maxval(width_x), maxval(width_y)))
    do k = 1, size(x)
      if (min(exponent(width_x(k)), exponent(width_y(k))) < reach - LARGEST_EXPONENT_OF_4) then
        call report(info, FUGE_ERR_OVERFLOW, 'rectangle '//index_text(k)//' of widths '//text(width_x(k))//' and ' &
                    //text(width_y(k))//' is too small beside the others')
      else if (exponent(force(k)) - exponent(width_x(k)) - exponent(width_y(k)) > LARGEST_EXPONENT) then
        call report(info, FUGE_ERR_OVERFLOW, 'the pressure of rectangle '//index_text(k)//' under force(' &
                    //index_text(k)//') = '//text(force(k))//' is out of range: choose another unit of force')
      end if
      if (info%failed()) return
    end do
  end subroutine check_loaded_rectangles

  !> Refuse moduli of a body (FUGE_ERR_NOT_FINITE, FUGE_ERR_MODULUS), and those by which displacements overflow
  !> (FUGE_ERR_OVERFLOW).
  pure subroutine check_body(width_x, width_y, force, young, poisson, info)
    real(dp), intent(in) :: width_x(:), width_y(:), force(:), young, poisson
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: of_body
    real(dp) :: modulus

    if (info%failed()) return
    call fuge_plane_modulus(young, poisson, FUGE_PLANE_STRAIN, modulus, of_body)
    if (of_body%failed()) info = of_body
    call check_displacement_range(force, min(minval(width_x), minval(width_y)), young, info)
  end subroutine check_body

  pure subroutine check_points(px, py, pz, info)
    real(dp), intent(in) :: px(:), py(:), pz(:)
    type(fuge_info), intent(inout) :: info

    call check_depth(pz, 'pz', info)
    call check_coordinate(px, 'px', pz, info)
    call check_coordinate(py, 'py', pz, info)
  end subroutine check_points

  pure function given_symmetry(symmetric_x, symmetric_y) result(symmetric)
    logical, intent(in), optional :: symmetric_x, symmetric_y
    logical :: symmetric(2)

    symmetric = .false.
    if (present(symmetric_x)) symmetric(1) = symmetric_x
    if (present(symmetric_y)) symmetric(2) = symmetric_y
  end function given_symmetry

  pure subroutine report_memory(n, points, info)
    integer, intent(in) :: n, points
    type(fuge_info), intent(inout) :: info

    call report(info, FUGE_ERR_MEMORY, 'no memory for '//text(n)//' rectangle(s) and '//text(points)//' point(s)')
  end subroutine report_memory

end module fuge_halfspace_interior
