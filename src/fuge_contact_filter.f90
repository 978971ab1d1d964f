!> The filter of an operator cut to a contact set: what preconditions the conjugate
!> gradients there.
!>
!> Cut to one stretch of contact the filter is the inverse of the cut operator but for
!> a few directions. Cut to many it makes too much of forces that change from stretch to
!> stretch but little within each: seen from afar these are a smooth load that sinks much
!> deeper than the filter believes. Then the cells are taken together, sixteen by
!> sixteen, and again: each grid's own filter sees what varies within sixteen cells of
!> it, the next one sees the means (a decomposition orthogonal in the number of points
!> in contact, so that the sum of the parts stays symmetric and positive definite).
module fuge_contact_filter
  use fuge_grids, only: grid_family
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_products, only: precondition
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  use fuge_text, only: text
  implicit none
  private

  !> So many doublings of the cells lie between one level and the next.
  integer, parameter :: DOUBLINGS = 4
  integer, parameter :: CELLS = 2**DOUBLINGS
  !> Fewer stretches of contact than this need one level only.
  integer, parameter :: MANY_STRETCHES = 16

  type :: filter_level
    !> Points in contact in each cell.
    real(dp), allocatable :: weight(:)
    !> Work space: a length, and on coarser levels the force that it asks for.
    real(dp), allocatable :: length(:), force(:)
  end type filter_level

  type, public :: contact_filter
    type(filter_level), allocatable, private :: levels(:)
    !> Levels in use for the present set; 0 without a filter.
    integer, private :: depth = 0
    !> Forces that sink all contact points alike, nearly, and their sum.
    real(dp), allocatable, private :: even(:)
    real(dp), private :: total = 1.0_dp
    !> Stands for the filter where the operator has none; force per length.
    real(dp), private :: stiffness = 1.0_dp
    !> Filter applications on coarser grids, as parts of one on this grid.
    real(dp) :: coarse_share = 0.0_dp
  contains
    procedure :: set
    procedure :: apply
  end type contact_filter

contains

  !> Make ready for a contact set.
  !>
  !> `operator` that of grid `grid` of `family`, 0 for the finest; `contact` (n), not
  !> empty; `softness` a typical length per force, used where the operator has no filter.
  !> Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE for a filter that is not positive
  !> definite, those of the filter.
  subroutine set(self, operator, family, grid, contact, softness, info)
    class(contact_filter), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(grid_family), intent(in) :: family
    integer, intent(in) :: grid
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: softness
    type(fuge_info), intent(inout) :: info

    if (.not. operator%has_filter()) then
      self%stiffness = 1.0_dp/softness
      return
    end if
    if (self%depth > 0) then
      if (all(contact .eqv. self%levels(1)%weight > 0.0_dp)) return
    end if
    if (.not. allocated(self%levels)) call make_room(self, family, grid, size(contact), info)
    if (info%failed()) return
    self%depth = 1
    if (count_stretches(contact) >= MANY_STRETCHES) self%depth = size(self%levels)
    call weigh(self, contact)
    self%levels(1)%length = self%levels(1)%weight
    call filter_from(self, operator, family, grid, 1, self%even, info)
    if (info%failed()) return
    self%total = sum(self%even)
    if (.not. self%total > 0.0_dp) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the filter of the operator is not positive definite: equal lengths ' &
                  //'on the contact set have the energy '//text(self%total))
    end if
  end subroutine set

  !> Forces with zero sum on the contact set, near those that take `length` away.
  !>
  !> `operator`, `family`, `grid` as for `set`; `length` (n), zero off the contact; `force`
  !> (n), zero there too. Errors: those of the filter.
  subroutine apply(self, operator, family, grid, length, force, info)
    class(contact_filter), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(grid_family), intent(in) :: family
    integer, intent(in) :: grid
    real(dp), intent(in) :: length(:)
    real(dp), intent(out) :: force(:)
    type(fuge_info), intent(inout) :: info

    if (self%depth == 0) then
      force = self%stiffness*length
    else
      self%levels(1)%length = length
      call filter_from(self, operator, family, grid, 1, force, info)
      if (.not. info%failed()) force = force - (sum(force)/self%total)*self%even
    end if
  end subroutine apply

  !> Arrays for this grid and for every sixteenth of the coarser ones.
  subroutine make_room(self, family, grid, n, info)
    class(contact_filter), intent(inout) :: self
    type(grid_family), intent(in) :: family
    integer, intent(in) :: grid, n
    type(fuge_info), intent(inout) :: info
    integer :: cells, l, stat

    cells = n
    allocate (self%levels(1 + (size(family%coarse) - grid)/DOUBLINGS), self%even(n), stat=stat)
    if (stat == 0) allocate (self%levels(1)%weight(n), self%levels(1)%length(n), stat=stat)
    do l = 2, size(self%levels)
      if (stat /= 0) exit
      cells = family%coarse(grid + DOUBLINGS*(l - 1))%operator%points()
      allocate (self%levels(l)%weight(cells), self%levels(l)%length(cells), self%levels(l)%force(cells), stat=stat)
    end do
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the preconditioner of '//text(n)//' points')
  end subroutine make_room

  !> Count the points in contact in the cells of every level.
  subroutine weigh(self, contact)
    class(contact_filter), intent(inout) :: self
    logical, intent(in) :: contact(:)
    integer :: l

    self%levels(1)%weight = merge(1.0_dp, 0.0_dp, contact)
    do l = 2, self%depth
      call sum_cells(self%levels(l - 1)%weight, self%levels(l)%weight)
    end do
  end subroutine weigh

  !> Force per point by the filters of level `l` and all coarser ones; its length is in
  !> levels(l)%length and is used up.
  recursive subroutine filter_from(self, operator, family, grid, l, force, info)
    class(contact_filter), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(grid_family), intent(in) :: family
    integer, intent(in) :: grid, l
    real(dp), intent(out) :: force(:)
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: counted

    if (l < self%depth) then
      call mean_of_cells(self%levels(l)%weight, self%levels(l)%length, self%levels(l + 1)%weight, &
                         self%levels(l + 1)%length)
      call add_to_cells(-1.0_dp, self%levels(l + 1)%length, self%levels(l)%weight, self%levels(l)%length)
    end if
    if (l == 1) then
      call precondition(operator, self%levels(1)%length, force, info)
    else
      associate (coarse => family%coarse(grid + DOUBLINGS*(l - 1))%operator)
        call precondition(coarse, self%levels(l)%length, force, counted)
      end associate
      self%coarse_share = self%coarse_share + real(size(force), dp)/real(operator%points(), dp)
      if (counted%failed()) call report(info, counted%status, counted%message)
    end if
    if (info%failed()) return
    call spread_over_points(self%levels(l)%weight, force)
    if (l == self%depth) return
    call mean_of_cells(self%levels(l)%weight, force, self%levels(l + 1)%weight, self%levels(l + 1)%force)
    call add_to_cells(-1.0_dp, self%levels(l + 1)%force, self%levels(l)%weight, force)
    call filter_from(self, operator, family, grid, l + 1, self%levels(l + 1)%force, info)
    call add_to_cells(1.0_dp, self%levels(l + 1)%force, self%levels(l)%weight, force)
  end subroutine filter_from

  !> Sums over groups of sixteen; the last group may be short.
  pure subroutine sum_cells(fine, coarse)
    real(dp), intent(in) :: fine(:)
    real(dp), intent(out) :: coarse(:)
    integer :: k

    do k = 1, size(coarse)
      coarse(k) = sum(fine((k - 1)*CELLS + 1:min(k*CELLS, size(fine))))
    end do
  end subroutine sum_cells

  !> Means over groups of sixteen, each point counted `weight` times; 0 without any.
  pure subroutine mean_of_cells(weight, fine, coarse_weight, coarse)
    real(dp), intent(in) :: weight(:), fine(:), coarse_weight(:)
    real(dp), intent(out) :: coarse(:)
    integer :: first, last, k

    do k = 1, size(coarse)
      coarse(k) = 0.0_dp
      if (.not. coarse_weight(k) > 0.0_dp) cycle
      first = (k - 1)*CELLS + 1
      last = min(k*CELLS, size(fine))
      coarse(k) = dot_product(weight(first:last), fine(first:last))/coarse_weight(k)
    end do
  end subroutine mean_of_cells

  !> Add `factor` times each group's value at its points in contact.
  pure subroutine add_to_cells(factor, coarse, weight, fine)
    real(dp), intent(in) :: factor, coarse(:), weight(:)
    real(dp), intent(inout) :: fine(:)
    integer :: i, k

    do k = 1, size(coarse)
      do i = (k - 1)*CELLS + 1, min(k*CELLS, size(fine))
        if (weight(i) > 0.0_dp) fine(i) = fine(i) + factor*coarse(k)
      end do
    end do
  end subroutine add_to_cells

  !> The force on a cell is shared by its points in contact.
  pure subroutine spread_over_points(weight, force)
    real(dp), intent(in) :: weight(:)
    real(dp), intent(inout) :: force(:)

    where (weight > 0.0_dp)
      force = force/weight
    elsewhere
      force = 0.0_dp
    end where
  end subroutine spread_over_points

  pure function count_stretches(contact) result(stretches)
    logical, intent(in) :: contact(:)
    integer :: stretches
    integer :: n

    n = size(contact)
    stretches = count(contact(2:n) .and. .not. contact(1:n - 1))
    if (contact(1)) stretches = stretches + 1
  end function count_stretches

end module fuge_contact_filter
