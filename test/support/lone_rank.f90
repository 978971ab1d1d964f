! Operators of a group that has one rank: solves take the way of ranks that share the points, without MPI.
module lone_rank
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: rank_group, point_space
  use fuge_status, only: fuge_info, FUGE_DONE
  implicit none
  private

  ! `sums` counts what was combined, to show that the group was asked.
  type, extends(rank_group), public :: lone_group
    integer, pointer :: sums => null()
  contains
    procedure :: members => one
    procedure :: number => zero
    procedure :: add => leave_values
    procedure :: raise => leave_values
    procedure :: exchange => return_values
    procedure :: agree => leave_info
  end type lone_group

  ! Cells of a grid in a group, after `join` and until `leave`.
  type, extends(fuge_operator), public :: lone_operator
    integer :: cells(2) = 0
    class(rank_group), pointer :: group => null()
  contains
    procedure :: points => count_cells
    procedure :: apply => copy_force
    procedure :: grid => own_cells
    procedure :: ranks => own_group
    procedure :: join
    procedure :: leave
  end type lone_operator

  ! A half-space in a group, or without one: in both cases without products in single precision.
  type, extends(fuge_operator), public :: lone_surface
    type(fuge_halfspace_operator) :: surface
    class(rank_group), pointer :: group => null()
  contains
    procedure :: points => count_surface
    procedure :: apply => apply_surface
    procedure :: datum => surface_datum
    procedure :: magnitude => surface_magnitude
    procedure :: common_magnitude
    procedure :: has_preconditioner
    procedure :: precondition => precondition_surface
    procedure :: has_preconditioner_on_bed
    procedure :: precondition_on_bed
    procedure :: wave_slope => surface_slope
    procedure :: grid => surface_grid
    procedure :: free_rim => surface_rim
    procedure :: coarsen => coarsen_surface
    procedure :: window => surface_window
    procedure :: ranks => surface_group
  end type lone_surface

contains

  pure function one(self) result(number)
    class(lone_group), intent(in) :: self
    integer :: number

    number = merge(1, 0, associated(self%sums) .or. .true.)
  end function one

  pure function zero(self) result(number)
    class(lone_group), intent(in) :: self
    integer :: number

    number = self%members() - 1
  end function zero

  subroutine leave_values(self, values)
    class(lone_group), intent(in) :: self
    real(dp), intent(inout), contiguous :: values(:)

    if (associated(self%sums) .and. size(values) > 0) self%sums = self%sums + 1
  end subroutine leave_values

  subroutine return_values(self, to, sent, from, received)
    class(lone_group), intent(in) :: self
    integer, intent(in) :: to(0:), from(0:)
    real(dp), intent(in), contiguous :: sent(:)
    real(dp), intent(inout), contiguous, asynchronous :: received(:)

    if (self%members() == size(to) .and. to(0) == from(0)) received(:from(0)) = sent(:to(0))
  end subroutine return_values

  subroutine leave_info(self, info)
    class(lone_group), intent(in) :: self
    type(fuge_info), intent(inout) :: info

    if (self%members() < 1) info = fuge_info()
  end subroutine leave_info

  pure function count_cells(self) result(n)
    class(lone_operator), intent(in) :: self
    integer :: n

    n = product(self%cells)
  end function count_cells

  subroutine copy_force(self, force, displacement, status)
    class(lone_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    displacement = force
    status = merge(FUGE_DONE, 1, self%points() == size(force))
  end subroutine copy_force

  function own_cells(self) result(cells)
    class(lone_operator), intent(in) :: self
    integer :: cells(2)

    cells = self%cells
  end function own_cells

  function own_group(self) result(space)
    class(lone_operator), intent(in) :: self
    type(point_space) :: space

    space%group => self%group
  end function own_group

  subroutine join(self)
    class(lone_operator), intent(inout) :: self

    allocate (lone_group :: self%group)
  end subroutine join

  subroutine leave(self)
    class(lone_operator), intent(inout) :: self

    deallocate (self%group)
  end subroutine leave

  pure function count_surface(self) result(n)
    class(lone_surface), intent(in) :: self
    integer :: n

    n = self%surface%points()
  end function count_surface

  subroutine apply_surface(self, force, displacement, status)
    class(lone_surface), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call self%surface%apply(force, displacement, status)
  end subroutine apply_surface

  function surface_datum(self) result(datum)
    class(lone_surface), intent(in) :: self
    real(dp) :: datum

    datum = self%surface%datum()
  end function surface_datum

  subroutine surface_magnitude(self, force, displacement, magnitude)
    class(lone_surface), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)

    call self%surface%magnitude(force, displacement, magnitude)
  end subroutine surface_magnitude

  function common_magnitude(self, largest, total) result(magnitude)
    class(lone_surface), intent(in) :: self
    real(dp), intent(in) :: largest, total
    real(dp) :: magnitude

    magnitude = self%surface%common_magnitude(largest, total)
  end function common_magnitude

  function has_preconditioner(self) result(preconditioned)
    class(lone_surface), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%surface%has_preconditioner()
  end function has_preconditioner

  subroutine precondition_surface(self, displacement, force, status)
    class(lone_surface), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%surface%precondition(displacement, force, status)
  end subroutine precondition_surface

  function has_preconditioner_on_bed(self) result(preconditioned)
    class(lone_surface), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%surface%has_preconditioner_on_bed()
  end function has_preconditioner_on_bed

  subroutine precondition_on_bed(self, compliance, displacement, force, status)
    class(lone_surface), intent(in) :: self
    real(dp), intent(in) :: compliance, displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%surface%precondition_on_bed(compliance, displacement, force, status)
  end subroutine precondition_on_bed

  function surface_slope(self, levels) result(slope)
    class(lone_surface), intent(in) :: self
    integer, intent(in) :: levels
    real(dp) :: slope

    slope = self%surface%wave_slope(levels)
  end function surface_slope

  function surface_grid(self) result(cells)
    class(lone_surface), intent(in) :: self
    integer :: cells(2)

    cells = self%surface%grid()
  end function surface_grid

  function surface_rim(self) result(free)
    class(lone_surface), intent(in) :: self
    logical :: free(2)

    free = self%surface%free_rim()
  end function surface_rim

  subroutine coarsen_surface(self, levels, coarse)
    class(lone_surface), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse
    class(fuge_operator), allocatable :: wider

    call self%surface%coarsen(levels, wider)
    call share(self, wider, coarse)
  end subroutine coarsen_surface

  subroutine surface_window(self, first, last, part)
    class(lone_surface), intent(in) :: self
    integer, intent(in) :: first(2), last(2)
    class(fuge_operator), allocatable, intent(out) :: part
    class(fuge_operator), allocatable :: smaller

    call self%surface%window(first, last, smaller)
    call share(self, smaller, part)
  end subroutine surface_window

  ! `shared`: the half-space `surface`, if there is one, in the group of `self`.
  subroutine share(self, surface, shared)
    class(lone_surface), intent(in) :: self
    class(fuge_operator), allocatable, intent(in) :: surface
    class(fuge_operator), allocatable, intent(out) :: shared
    type(lone_surface), allocatable :: one_surface

    if (.not. allocated(surface)) return
    allocate (one_surface)
    select type (surface)
    type is (fuge_halfspace_operator)
      one_surface%surface = surface
    end select
    one_surface%group => self%group
    call move_alloc(one_surface, shared)
  end subroutine share

  function surface_group(self) result(space)
    class(lone_surface), intent(in) :: self
    type(point_space) :: space

    space%group => self%group
  end function surface_group

end module lone_rank
