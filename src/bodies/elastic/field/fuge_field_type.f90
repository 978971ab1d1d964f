!> Stresses and displacements in a body under a contact: one interface for all bodies.
module fuge_field_type
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_UNSUPPORTED
  use fuge_stress_field, only: stress_field
  use fuge_stress_peak_type, only: check_measure, fuge_interface_stress, fuge_stress_peak
  implicit none
  private

  public :: require_places

  !> What is known in a body under the forces of a contact: a child for each kind of body, made by its `set` procedures.
  !>
  !> Places are x, y, z, length, z >= 0 into the body. In a plane y does not count, and displacements along it are 0;
  !> about an axis x is the radius and y the circumference. Tensors are xx, yy, zz, yz, xz, xy, force per length
  !> squared, tension positive: under a pressure p at z = 0 zz is -p. Displacements are positive along their axes.
  type, abstract, extends(stress_field), public :: fuge_field
    !> For children: has it been set, is it known at any place?
    logical :: is_set = .false., has_places = .true.
    !> For children: below how many cells of a grid is it known?
    integer :: cells = 0
  contains
    procedure :: stress
    procedure :: displacement
    procedure :: grid_stress
    procedure :: grid_displacement
    procedure :: largest
    procedure :: interfaces
    !> What a child knows, its arguments checked: `find_stress` and displacements at places.
    procedure(at_places), deferred :: find_displacement
    !> The largest stress.
    procedure(find_peak), deferred :: find_largest
    !> Stresses below a grid.
    procedure :: find_grid_stress => no_grid
    !> Displacements below a grid.
    procedure :: find_grid_displacement => no_grid
    !> The largest stresses of interfaces.
    procedure :: find_interfaces => no_interfaces
  end type fuge_field

  abstract interface
    subroutine at_places(self, place, below, values, info)
      import :: fuge_field, dp, fuge_info
      class(fuge_field), intent(in) :: self
      real(dp), intent(in) :: place(:, :)
      logical, intent(in) :: below(:)
      real(dp), intent(inout) :: values(:, :)
      type(fuge_info), intent(out) :: info
    end subroutine at_places

    subroutine find_peak(self, measure, peak, info)
      import :: fuge_field, fuge_info, fuge_stress_peak
      class(fuge_field), intent(in) :: self
      integer, intent(in) :: measure
      type(fuge_stress_peak), intent(inout) :: peak
      type(fuge_info), intent(out) :: info
    end subroutine find_peak
  end interface

contains

  !> `tensor` (6, points) at `place` (3, points).
  !>
  !> `below` (points), in layers: at an interface, just below it; default .false., just above. Errors, `tensor`
  !> untouched: FUGE_ERR_CALL_ORDER for a field that is not set, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_GRID for
  !> z < 0, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY; FUGE_ERR_UNSUPPORTED for the field of a periodic grid, which is known
  !> below the centres of its cells only.
  subroutine stress(self, place, tensor, info, below)
    class(fuge_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    real(dp), intent(inout) :: tensor(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    logical, allocatable :: lower(:)

    call check_places(self, place, shape(tensor), 6, 'tensor', info)
    call find_sides(size(place, 2), lower, info, below)
    if (.not. info%failed()) call self%find_stress(place, lower, tensor, info)
  end subroutine stress

  !> `u` (3, points), length, at `place` (3, points); all else as of `stress`.
  subroutine displacement(self, place, u, info, below)
    class(fuge_field), intent(in) :: self
    real(dp), intent(in) :: place(:, :)
    real(dp), intent(inout) :: u(:, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    logical, allocatable :: lower(:)

    call check_places(self, place, shape(u), 3, 'u', info)
    call find_sides(size(place, 2), lower, info, below)
    if (.not. info%failed()) call self%find_displacement(place, lower, u, info)
  end subroutine displacement

  !> `tensor` (6, cells, depths) below the centres of the cells of a grid, by FFT.
  !>
  !> `depth` >= 0, in any order, length; `below` (depths) as of `stress`. Errors, `tensor` untouched: those of `stress`;
  !> FUGE_ERR_UNSUPPORTED for a field that was not set by a grid, and in a library without FFTW.
  subroutine grid_stress(self, depth, tensor, info, below)
    class(fuge_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    real(dp), intent(inout) :: tensor(:, :, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    logical, allocatable :: lower(:)

    call check_grid(self, shape(tensor), 6, size(depth), 'tensor', info)
    call find_sides(size(depth), lower, info, below)
    if (.not. info%failed()) call self%find_grid_stress(depth, lower, tensor, info)
  end subroutine grid_stress

  !> `u` (3, cells, depths), length, below the centres of the cells of a grid; all else as of `grid_stress`.
  subroutine grid_displacement(self, depth, u, info, below)
    class(fuge_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    real(dp), intent(inout) :: u(:, :, :)
    type(fuge_info), intent(out) :: info
    logical, intent(in), optional :: below(:)
    logical, allocatable :: lower(:)

    call check_grid(self, shape(u), 3, size(depth), 'u', info)
    call find_sides(size(depth), lower, info, below)
    if (.not. info%failed()) call self%find_grid_displacement(depth, lower, u, info)
  end subroutine grid_displacement

  !> The largest von Mises or Tresca stress and where it is.
  !>
  !> `measure`: FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA. Where the pressure of the contact is infinite so is the
  !> stress, and `peak%location` is FUGE_PEAK_SINGULAR. Otherwise the relative error is below 1e-6, and below 1e-3 where
  !> the stress has a cusp, as at the surface beside the rim of a contact. Uniform pressure jumps from cell to cell, so
  !> that on cells depths count from a quarter of a cell on; in layers it is the largest below the centres of the cells
  !> of a grid. Of symmetric models it is that at x >= 0, y >= 0. Cells tell singular edges by the forces of up to seven
  !> at an edge, on rectangles in three rows side by side; edges of very small pieces of contact are not judged. Errors,
  !> `peak` untouched: those of `stress`, FUGE_ERR_OPTION for `measure`, FUGE_ERR_OVERFLOW if no stress is finite.
  subroutine largest(self, measure, peak, info)
    class(fuge_field), intent(in) :: self
    integer, intent(in) :: measure
    type(fuge_stress_peak), intent(inout) :: peak
    type(fuge_info), intent(out) :: info

    call check_set(self, info)
    call check_measure(measure, info)
    if (.not. info%failed()) call self%find_largest(measure, peak, info)
  end subroutine largest

  !> The largest stresses of the surface and of the interfaces of layers, from above, below the cells of a grid.
  !>
  !> Errors, `peaks` untouched: those of `grid_stress`; FUGE_ERR_UNSUPPORTED for a body without layers.
  subroutine interfaces(self, peaks, info)
    class(fuge_field), intent(in) :: self
    type(fuge_interface_stress), allocatable, intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info

    call check_set(self, info)
    if (.not. info%failed()) call self%find_interfaces(peaks, info)
  end subroutine interfaces

  pure subroutine check_set(field, info)
    class(fuge_field), intent(in) :: field
    type(fuge_info), intent(inout) :: info

    if (.not. field%is_set) call report(info, FUGE_ERR_CALL_ORDER, 'the field is empty: set it first')
  end subroutine check_set

  !> For children: refuse the field of a periodic grid.
  pure subroutine require_places(field, info)
    class(fuge_field), intent(in) :: field
    type(fuge_info), intent(inout) :: info

    if (.not. field%has_places) call report(info, FUGE_ERR_UNSUPPORTED, 'the field of a periodic grid is known below ' &
                                            //'the centres of its cells only: take grid_stress and grid_displacement')
  end subroutine require_places

  !> Refuse a field that does not know any place, and arrays that do not fit each other.
  pure subroutine check_places(field, place, sizes, components, name, info)
    class(fuge_field), intent(in) :: field
    real(dp), intent(in) :: place(:, :)
    integer, intent(in) :: sizes(2), components
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    call check_set(field, info)
    if (info%failed()) return
    call require_places(field, info)
    if (info%failed()) return
    if (size(place, 1) /= 3) then
      call report(info, FUGE_ERR_SIZE, 'place has '//text(size(place, 1))//' rows: each point has x, y, z')
    else if (any(sizes /= [components, size(place, 2)])) then
      call report(info, FUGE_ERR_SIZE, name//' is '//text(sizes(1))//' by '//text(sizes(2))//': it needs ' &
                  //text(components)//' rows and '//text(size(place, 2))//' columns')
    end if
  end subroutine check_places

  !> Refuse a field that is not that of a grid, and an array that does not fit it.
  pure subroutine check_grid(field, sizes, components, depths, name, info)
    class(fuge_field), intent(in) :: field
    integer, intent(in) :: sizes(3), components, depths
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    call check_set(field, info)
    if (info%failed()) return
    if (field%cells == 0) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'the field is not that of a grid: set it by a grid, or take stress and ' &
                  //'displacement at places')
    else if (any(sizes /= [components, field%cells, depths])) then
      call report(info, FUGE_ERR_SIZE, name//' is '//text(sizes(1))//' by '//text(sizes(2))//' by '//text(sizes(3)) &
                  //': it needs '//text(components)//' by '//text(field%cells)//' cells by '//text(depths)//' depths')
    end if
  end subroutine check_grid

  !> On which side of an interface each of `count` points or depths is: above it unless `below` is given.
  pure subroutine find_sides(count, lower, info, below)
    integer, intent(in) :: count
    logical, allocatable, intent(out) :: lower(:)
    type(fuge_info), intent(inout) :: info
    logical, intent(in), optional :: below(:)
    integer :: stat

    if (info%failed()) return
    if (present(below)) then
      if (size(below) /= count) call report(info, FUGE_ERR_SIZE, 'below has '//text(size(below))//' values, but ' &
                                            //text(count)//' are needed')
      if (info%failed()) return
    end if
    allocate (lower(count), stat=stat)
    call require_memory(stat, 'results at', count, 'points', info)
    if (stat /= 0) return
    lower = .false.
    if (present(below)) lower = below
  end subroutine find_sides

  subroutine no_grid(self, depth, below, values, info)
    class(fuge_field), intent(in) :: self
    real(dp), intent(in) :: depth(:)
    logical, intent(in) :: below(:)
    real(dp), intent(inout) :: values(:, :, :)
    type(fuge_info), intent(out) :: info

    call report(info, FUGE_ERR_UNSUPPORTED, 'the body has no grid: '//text(size(values, 1) + size(depth) + size(below) &
                                                                           + self%cells))
  end subroutine no_grid

  subroutine no_interfaces(self, peaks, info)
    class(fuge_field), intent(in) :: self
    type(fuge_interface_stress), allocatable, intent(inout) :: peaks(:)
    type(fuge_info), intent(out) :: info

    if (self%is_set .or. allocated(peaks)) call report(info, FUGE_ERR_UNSUPPORTED, 'a body without layers has no ' &
                                                       //'interfaces')
  end subroutine no_interfaces

end module fuge_field_type
