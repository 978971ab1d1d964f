!> The line on which a half-plane is pressed: the cells that carry a force, in a unit of length of the order of the
!> narrowest one.
!>
!> Its field is a sum over the cells: a plain one, or, once `gather` has put them into clusters, one over the cells
!> nearby and the clusters of all others.
module fuge_pressed_line
  use fuge_cell_clusters, only: cell_clusters
  use fuge_cell_elements, only: FUGE_HAT
  use fuge_cell_overlaps, only: check_overlaps
  use fuge_constants, only: LARGEST_EXPONENT, LARGEST_EXPONENT_OF_2, PI
  use fuge_halfplane_influence, only: check_halfplane
  use fuge_hat_field, only: add_hat_displacements, add_hats, hat_rules
  use fuge_heap_sort, only: heap_sort, reorder
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_OVERFLOW
  use fuge_stress_checks, only: check_forces
  use fuge_strip_field, only: add_strip_displacements, add_strips
  implicit none
  private

  public :: check_line

  !> A distance is at most 2**FARTHEST narrowest widths, 1.8e75.
  integer, parameter :: FARTHEST = 250

  !> The number of sums that give the stresses at a point, and the displacements.
  integer, parameter :: STRESSES = 3, DISPLACEMENTS = 4
  !> Fewer cells are never gathered.
  integer, parameter :: FEW_CELLS = 64
  !> The most clusters that can wait to be looked at: two for each halving of their number.
  integer, parameter :: MOST_WAITING = 2*bit_size(1)

  !> Strips or hats, in the caller's order until they are gathered.
  type, public :: pressed_line
    !> Lengths here are the caller's times 2**power.
    integer :: power = 0
    logical :: hats = .false.
    !> Symmetric about x = 0: half of each force acts on the mirror image of its cell.
    logical :: symmetric = .false.
    !> Centres, widths of strips or half bases of hats, and pressures, of hats at the peak.
    real(dp), allocatable :: centre(:), width(:), pressure(:)
    type(hat_rules) :: rules = hat_rules()
    type(cell_clusters) :: clusters = cell_clusters()
  contains
    procedure :: set
    procedure :: gather
    procedure :: find_stress
    procedure :: find_integrals
    procedure :: add_stresses
    procedure :: add_displacements
    procedure :: check_distances
    procedure :: check_range
    procedure, private :: check_pressure
  end type pressed_line

contains

  !> Refuse cells and forces that press no line: errors of `fuge_halfplane_matrix`, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE.
  pure subroutine check_line(x, width, force, element, symmetric, info)
    real(dp), intent(in) :: x(:), width(:), force(:)
    integer, intent(in) :: element
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info

    call check_halfplane(x, width, 1.0_dp, element, symmetric, info)
    if (.not. info%failed()) call check_overlaps(x, width, symmetric, info)
    call check_forces(force, size(x), 'cells', info)
  end subroutine check_line

  !> Take the cells with a force, of those that `check_line` accepts. FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  pure subroutine set(self, x, width, force, element, symmetric, info)
    class(pressed_line), intent(inout) :: self
    real(dp), intent(in) :: x(:), width(:), force(:)
    integer, intent(in) :: element
    logical, intent(in) :: symmetric
    type(fuge_info), intent(inout) :: info
    integer :: k, n, number, stat

    if (info%failed()) return
    self%symmetric = symmetric
    number = count(abs(force) > 0.0_dp)
    allocate (self%centre(number), self%width(number), self%pressure(number), stat=stat)
    call require_memory(stat, '', number, 'cells with a force', info)
    if (stat /= 0) return
    if (number == 0) return
    self%power = -exponent(minval(width, abs(force) > 0.0_dp))
    self%hats = element == FUGE_HAT
    if (self%hats) call self%rules%prepare()
    n = 0
    do k = 1, size(x)
      if (.not. abs(force(k)) > 0.0_dp) cycle
      call self%check_range(x(k), 'x', k, info)
      call self%check_range(width(k), 'width', k, info)
      call self%check_pressure(force(k), k, info)
      if (info%failed()) return
      n = n + 1
      self%centre(n) = scale(x(k), self%power)
      self%width(n) = scale(width(k), self%power)
      self%pressure(n) = force(k)/self%width(n)
    end do
  end subroutine set

  !> Refuse points that are too far away (FUGE_ERR_OVERFLOW).
  pure subroutine check_distances(self, px, pz, info)
    class(pressed_line), intent(in) :: self
    real(dp), intent(in) :: px(:), pz(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(pz)
      if (info%failed()) return
      call self%check_range(px(k), 'px', k, info)
      call self%check_range(pz(k), 'pz', k, info)
    end do
  end subroutine check_distances

  !> Refuse a length that is too large beside the narrowest width (FUGE_ERR_OVERFLOW).
  pure subroutine check_range(self, length, name, k, info)
    class(pressed_line), intent(in) :: self
    real(dp), intent(in) :: length
    character(len=*), intent(in) :: name
    integer, intent(in) :: k
    type(fuge_info), intent(inout) :: info

    ! The exponent of 0 is 0.
    if (info%failed() .or. exponent(length) + self%power <= FARTHEST .or. .not. abs(length) > 0.0_dp) return
    call report(info, FUGE_ERR_OVERFLOW, name//'('//index_text(k)//') = '//text(length) &
                //' is more than 1e75 times the narrowest width: leave it out')
  end subroutine check_range

  !> Refuse a force that is out of range, or its pressure on the narrowest width (FUGE_ERR_OVERFLOW).
  pure subroutine check_pressure(self, force, k, info)
    class(pressed_line), intent(in) :: self
    real(dp), intent(in) :: force
    integer, intent(in) :: k
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (exponent(force) <= LARGEST_EXPONENT_OF_2 .and. exponent(force) + self%power <= LARGEST_EXPONENT) return
    call report(info, FUGE_ERR_OVERFLOW, 'force('//index_text(k)//') = '//text(force) &
                //', or its pressure on the narrowest width, is out of range: choose other units')
  end subroutine check_pressure

  !> Order many cells and put them into clusters. FUGE_ERR_MEMORY.
  pure subroutine gather(self, info)
    class(pressed_line), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    integer :: n

    if (info%failed()) return
    n = size(self%centre)
    if (n < FEW_CELLS) return
    if (any(self%centre(2:) < self%centre(:n - 1))) call sort(self, info)
    if (.not. info%failed()) call self%clusters%build(self%centre, self%width, merge(1.0_dp, 0.5_dp, self%hats), info)
    if (.not. info%failed()) call self%clusters%fill(self%centre, self%width, self%pressure, self%hats)
  end subroutine gather

  !> Order the cells by their centres. FUGE_ERR_MEMORY.
  pure subroutine sort(self, info)
    class(pressed_line), intent(inout) :: self
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: order(:)
    real(dp), allocatable :: work(:)
    integer :: k, n, stat

    n = size(self%centre)
    allocate (order(n), work(n), stat=stat)
    call require_memory(stat, 'the order of', n, 'cells', info)
    if (stat /= 0) return
    do k = 1, n
      order(k) = k
    end do
    call heap_sort(self%centre, order)
    call reorder(order, self%centre, work)
    call reorder(order, self%width, work)
    call reorder(order, self%pressure, work)
  end subroutine sort

  !> The stresses xx, zz and xz at a point, both in the caller's units.
  pure subroutine find_stress(self, px, pz, stress)
    class(pressed_line), intent(in) :: self
    real(dp), intent(in) :: px, pz
    real(dp), intent(out) :: stress(3)
    real(dp) :: total(STRESSES), image(STRESSES), scaled(2)

    scaled = scale([px, pz], self%power)
    total = 0.0_dp
    call self%add_stresses(scaled(1), scaled(2), total)
    if (self%symmetric) then
      image = 0.0_dp
      call self%add_stresses(-scaled(1), scaled(2), image)
      total = 0.5_dp*(total + [image(1), image(2), -image(3)])
    end if
    ! Nothing is 0, not -0.
    stress = 0.0_dp - scale(total/PI, self%power)
  end subroutine find_stress

  !> The integrals of ln(r), z**2/r**2, x z/r**2 and atan(x/z) over the pressure, which give the displacements at a
  !> point in the caller's units; r is in the unit of the cells.
  pure subroutine find_integrals(self, px, pz, integral)
    class(pressed_line), intent(in) :: self
    real(dp), intent(in) :: px, pz
    real(dp), intent(out) :: integral(DISPLACEMENTS)
    real(dp) :: image(DISPLACEMENTS), scaled(2)

    scaled = scale([px, pz], self%power)
    integral = 0.0_dp
    call self%add_displacements(scaled(1), scaled(2), integral)
    if (.not. self%symmetric) return
    image = 0.0_dp
    call self%add_displacements(-scaled(1), scaled(2), image)
    integral = 0.5_dp*(integral + [image(:2), -image(3:)])
  end subroutine find_integrals

  !> Add -pi times the stresses xx, zz and xz at a point to `total`; lengths and areas in the unit of the cells.
  pure subroutine add_stresses(self, px, pz, total)
    class(pressed_line), intent(in) :: self
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(STRESSES)

    call add_clusters(self, STRESSES, px, pz, total)
  end subroutine add_stresses

  !> Add the integrals of ln(r), z**2/r**2, x z/r**2 and atan(x/z) over the pressure to `total`.
  pure subroutine add_displacements(self, px, pz, total)
    class(pressed_line), intent(in) :: self
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(DISPLACEMENTS)

    call add_clusters(self, DISPLACEMENTS, px, pz, total)
  end subroutine add_displacements

  !> Add the `sums`, STRESSES or DISPLACEMENTS, over the clusters that are far and the cells of the others.
  pure subroutine add_clusters(self, sums, px, pz, total)
    class(pressed_line), intent(in) :: self
    integer, intent(in) :: sums
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(sums)
    integer :: waiting(MOST_WAITING), number, k

    if (self%clusters%number == 0) then
      call add_cells(self, sums, 1, size(self%centre), px, pz, total)
      return
    end if
    number = 1
    waiting(1) = 1
    do while (number > 0)
      k = waiting(number)
      number = number - 1
      if (self%clusters%is_far(k, px, pz)) then
        if (sums == STRESSES) call self%clusters%add_stress(k, px, pz, total)
        if (sums == DISPLACEMENTS) call self%clusters%add_displacement(k, px, pz, total)
      else if (self%clusters%child(k) == 0) then
        call add_cells(self, sums, self%clusters%first(k), self%clusters%last(k), px, pz, total)
      else
        waiting(number + 1:number + 2) = self%clusters%child(k) + [0, 1]
        number = number + 2
      end if
    end do
  end subroutine add_clusters

  !> Add the sums over the cells `first` to `last`. Halves of many cells are added up apart, which keeps the rounding
  !> of the sum small.
  pure recursive subroutine add_cells(self, sums, first, last, px, pz, total)
    class(pressed_line), intent(in) :: self
    integer, intent(in) :: sums, first, last
    real(dp), intent(in) :: px, pz
    real(dp), intent(inout) :: total(sums)
    real(dp) :: half_sum(sums)
    integer :: half

    if (last - first >= FEW_CELLS) then
      half_sum = 0.0_dp
      half = first + (last - first)/2
      call add_cells(self, sums, first, half, px, pz, half_sum)
      total = total + half_sum
      half_sum = 0.0_dp
      call add_cells(self, sums, half + 1, last, px, pz, half_sum)
      total = total + half_sum
      return
    end if
    associate (centre => self%centre(first:last), width => self%width(first:last), &
               pressure => self%pressure(first:last))
      if (sums == STRESSES .and. self%hats) then
        call add_hats(self%rules, centre, width, pressure, px, pz, total)
      else if (sums == STRESSES) then
        call add_strips(centre, width, pressure, px, pz, total)
      else if (self%hats) then
        call add_hat_displacements(centre, width, pressure, px, pz, total)
      else
        call add_strip_displacements(centre, width, pressure, px, pz, total)
      end if
    end associate
  end subroutine add_cells

end module fuge_pressed_line
