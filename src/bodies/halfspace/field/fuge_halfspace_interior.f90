!> Stresses and displacements inside an elastic half-space, under uniform pressures on rectangles.
module fuge_halfspace_interior
  use fuge_area_field, only: add_area_field, area_field, new_area_field
  use fuge_elastic_moduli, only: check_poisson, fuge_plane_modulus, FUGE_PLANE_STRAIN
  use fuge_kinds, only: dp
  use fuge_pressed_area, only: check_area, pressed_area
  use fuge_status, only: fuge_info, require_memory
  use fuge_stress_checks, only: check_coordinate, check_depth, check_displacement_range, check_result
  implicit none
  private

  public :: check_points, fuge_halfspace_displacement, fuge_halfspace_stress, given_symmetry

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
    type(pressed_area) :: area
    type(area_field), allocatable :: field
    real(dp), allocatable :: found(:, :)
    logical :: symmetric(2)
    integer :: stat

    symmetric = given_symmetry(symmetric_x, symmetric_y)
    call check_area(x, y, width_x, width_y, force, symmetric, info)
    if (.not. info%failed()) call check_poisson(poisson, info)
    call check_points(px, py, pz, info)
    call check_result(shape(stress), 'stress', 6, size(pz), info)
    if (info%failed()) return
    allocate (field, found(6, size(pz)), stat=stat)
    if (stat == 0) call area%set(x, y, width_x, width_y, force, symmetric, stat)
    if (stat == 0) call new_area_field(area, poisson, field, stat)
    if (stat == 0) then
      found = 0.0_dp
      call add_area_field(field, px, py, pz, found, stat)
    end if
    call require_memory(stat, 'the stresses at', size(pz), 'points', info)
    if (stat == 0) stress = found
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
    type(pressed_area) :: area
    type(area_field), allocatable :: field
    real(dp), allocatable :: found(:, :)
    logical :: symmetric(2)
    integer :: stat

    symmetric = given_symmetry(symmetric_x, symmetric_y)
    call check_area(x, y, width_x, width_y, force, symmetric, info)
    call check_body(young, poisson, info)
    call check_displacement_range(force, min(minval(width_x), minval(width_y)), young, info)
    call check_points(px, py, pz, info)
    call check_result(shape(displacement), 'displacement', 3, size(pz), info)
    if (info%failed()) return
    allocate (field, found(3, size(pz)), stat=stat)
    if (stat == 0) call area%set(x, y, width_x, width_y, force, symmetric, stat)
    if (stat == 0) call new_area_field(area, poisson, field, stat)
    if (stat == 0) then
      found = 0.0_dp
      if (young <= huge(young)) call add_area_field(field, px, py, pz, found, stat)
    end if
    call require_memory(stat, 'the displacements at', size(pz), 'points', info)
    if (stat == 0) displacement = found/young
  end subroutine fuge_halfspace_displacement

  !> Refuse moduli of a body (FUGE_ERR_NOT_FINITE, FUGE_ERR_MODULUS).
  pure subroutine check_body(young, poisson, info)
    real(dp), intent(in) :: young, poisson
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: of_body
    real(dp) :: modulus

    if (info%failed()) return
    call fuge_plane_modulus(young, poisson, FUGE_PLANE_STRAIN, modulus, of_body)
    if (of_body%failed()) info = of_body
  end subroutine check_body

  !> Refuse points that are not in the body: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_GRID.
  pure subroutine check_points(px, py, pz, info)
    real(dp), intent(in) :: px(:), py(:), pz(:)
    type(fuge_info), intent(inout) :: info

    call check_depth(pz, 'pz', info)
    call check_coordinate(px, 'px', pz, info)
    call check_coordinate(py, 'py', pz, info)
  end subroutine check_points

  !> About x = 0, about y = 0; by default not.
  pure function given_symmetry(symmetric_x, symmetric_y) result(symmetric)
    logical, intent(in), optional :: symmetric_x, symmetric_y
    logical :: symmetric(2)

    symmetric = .false.
    if (present(symmetric_x)) symmetric(1) = symmetric_x
    if (present(symmetric_y)) symmetric(2) = symmetric_y
  end function given_symmetry

end module fuge_halfspace_interior
