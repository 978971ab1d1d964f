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
  use fuge_stretches, only: stretches, total
  use fuge_text, only: text
  implicit none
  private

  !> So many doublings of the cells lie between one level and the next.
  integer, parameter :: DOUBLINGS = 4
  integer, parameter :: CELLS = 2**DOUBLINGS
  !> Fewer stretches of contact than this need one level only.
  integer, parameter :: MANY_STRETCHES = 16

  type :: filter_level
    !> Points in contact in each cell; 1 where there are any, else 0 (of the finest level
    !> that is the weight).
    real(dp), allocatable :: weight(:), present(:)
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
    type(stretches) :: over

    if (.not. operator%has_filter()) then
      ! Only to stay in range: conjugate gradients do not depend on it.
      self%stiffness = 1.0_dp
      if (softness > 0.0_dp) self%stiffness = 1.0_dp/softness
      return
    end if
    if (self%depth > 0) then
      if (all(contact .eqv. self%levels(1)%weight > 0.0_dp)) return
    end if
    if (.not. allocated(self%levels)) call make_room(self, family, grid, size(contact), info)
    if (.not. info%failed()) call over%find(contact, info)
    if (info%failed()) return
    self%depth = 1
    if (size(over%first) >= MANY_STRETCHES) self%depth = size(self%levels)
    call weigh(self, contact)
    self%levels(1)%length = self%levels(1)%weight
    call filter_from(self, operator, family, grid, 1, self%even, info)
    if (info%failed()) return
    self%total = total(over, self%even)
    if (.not. self%total > 0.0_dp) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'the filter of the operator is not positive definite: equal lengths ' &
                  //'on the contact set have the energy '//text(self%total))
    end if
  end subroutine set

  !> Forces with zero sum on the contact set, near those that take `length` away.
  !>
  !> `operator`, `family`, `grid` as for `set`; `over` the stretches of its set; `length`
  !> (n) and `force` (n) on them, elsewhere they may be anything. Errors: those of the filter.
  subroutine apply(self, operator, family, grid, over, length, force, info)
    class(contact_filter), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(grid_family), intent(in) :: family
    integer, intent(in) :: grid
    type(stretches), intent(in) :: over
    real(dp), intent(in), contiguous :: length(:)
    real(dp), intent(inout), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: excess
    integer :: i

    excess = 0.0_dp
    if (self%depth > 0) then
      do i = 1, size(over%first)
        self%levels(1)%length(over%first(i):over%last(i)) = length(over%first(i):over%last(i))
      end do
      call filter_from(self, operator, family, grid, 1, force, info)
      if (info%failed()) return
      excess = total(over, force)/self%total
    end if
    do i = 1, size(over%first)
      associate (a => over%first(i), b => over%last(i))
        if (self%depth > 0) then
          force(a:b) = force(a:b) - excess*self%even(a:b)
        else
          force(a:b) = self%stiffness*length(a:b)
        end if
      end associate
    end do
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
      allocate (self%levels(l)%weight(cells), self%levels(l)%present(cells), self%levels(l)%length(cells), &
                self%levels(l)%force(cells), stat=stat)
    end do
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the preconditioner of '//text(n)//' points')
  end subroutine make_room

  !> Count the points in contact in the cells of every level.
  subroutine weigh(self, contact)
    class(contact_filter), intent(inout) :: self
    logical, intent(in) :: contact(:)
    integer :: k, l

    self%levels(1)%weight = merge(1.0_dp, 0.0_dp, contact)
    do l = 2, self%depth
      associate (fine => self%levels(l - 1)%weight, level => self%levels(l))
        do k = 1, size(level%weight)
          level%weight(k) = sum(fine((k - 1)*CELLS + 1:min(k*CELLS, size(fine))))
        end do
        level%present = min(level%weight, 1.0_dp)
      end associate
    end do
  end subroutine weigh

  !> Force per point by the filters of level `l` and all coarser ones; its length is in
  !> levels(l)%length, zero off the contact, and is used up. Off the contact the forces
  !> mean nothing.
  recursive subroutine filter_from(self, operator, family, grid, l, force, info)
    class(contact_filter), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(grid_family), intent(in) :: family
    integer, intent(in) :: grid, l
    real(dp), intent(inout), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: counted

    if (l < self%depth) then
      call mean_of_cells(self%levels(l)%weight, self%levels(l)%length, self%levels(l + 1)%weight, &
                         self%levels(l + 1)%length)
      if (l == 1) then
        call add_to_cells(-1.0_dp, self%levels(2)%length, self%levels(1)%weight, self%levels(1)%length)
      else
        call add_to_cells(-1.0_dp, self%levels(l + 1)%length, self%levels(l)%present, self%levels(l)%length)
      end if
    end if
    if (l == 1) then
      call precondition(operator, self%levels(1)%length, force, info)
    else
      associate (coarse => family%coarse(grid + DOUBLINGS*(l - 1))%operator)
        call precondition(coarse, self%levels(l)%length, force, counted)
      end associate
      self%coarse_share = self%coarse_share + real(size(force), dp)/real(operator%points(), dp)
      if (counted%failed()) call report(info, counted%status, counted%message)
      ! The force on a cell is shared by its points in contact.
      where (self%levels(l)%weight > 0.0_dp) force = force/self%levels(l)%weight
    end if
    if (info%failed() .or. l == self%depth) return
    call mean_of_cells(self%levels(l)%weight, force, self%levels(l + 1)%weight, self%levels(l + 1)%force)
    call add_everywhere(-1.0_dp, self%levels(l + 1)%force, force)
    call filter_from(self, operator, family, grid, l + 1, self%levels(l + 1)%force, info)
    call add_everywhere(1.0_dp, self%levels(l + 1)%force, force)
  end subroutine filter_from

  !> Means over groups of sixteen, each point counted `weight` times; 0 without any.
  pure subroutine mean_of_cells(weight, fine, coarse_weight, coarse)
    real(dp), intent(in), contiguous :: weight(:), fine(:), coarse_weight(:)
    real(dp), intent(inout), contiguous :: coarse(:)
    integer :: first, last, k

    do k = 1, size(coarse)
      coarse(k) = 0.0_dp
      if (.not. coarse_weight(k) > 0.0_dp) cycle
      first = (k - 1)*CELLS + 1
      last = min(k*CELLS, size(fine))
      coarse(k) = sum(weight(first:last)*fine(first:last))/coarse_weight(k)
    end do
  end subroutine mean_of_cells

  !> Add `factor` times each group's value where `present` is 1.
  pure subroutine add_to_cells(factor, coarse, present, fine)
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: coarse(:), present(:)
    real(dp), intent(inout), contiguous :: fine(:)
    real(dp) :: value
    integer :: i, k

    do k = 1, size(coarse)
      value = factor*coarse(k)
      if (.not. abs(value) > 0.0_dp) cycle
      do i = (k - 1)*CELLS + 1, min(k*CELLS, size(fine))
        fine(i) = fine(i) + value*present(i)
      end do
    end do
  end subroutine add_to_cells

  !> The same at all points of groups in contact: for forces, which count there only.
  pure subroutine add_everywhere(factor, coarse, fine)
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: coarse(:)
    real(dp), intent(inout), contiguous :: fine(:)
    integer :: i, k

    do k = 1, size(coarse)
      if (.not. abs(coarse(k)) > 0.0_dp) cycle
      do i = (k - 1)*CELLS + 1, min(k*CELLS, size(fine))
        fine(i) = fine(i) + factor*coarse(k)
      end do
    end do
  end subroutine add_everywhere

end module fuge_contact_filter
