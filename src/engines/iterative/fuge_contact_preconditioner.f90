!> The preconditioner of an operator cut to a contact set: what preconditions the conjugate
!> gradients there.
!>
!> Cut to one stretch of contact the preconditioner is the inverse of the cut operator but for
!> a few directions. Cut to many it makes too much of forces that change from stretch to
!> stretch but little within each: seen from afar these are a smooth load that sinks much
!> deeper than the preconditioner believes. Then the cells are taken together, sixteen by
!> sixteen, and again: each grid's own preconditioner sees what varies within sixteen cells of
!> it, the next one sees the means. doc/theory.md shows that the sum of these parts is
!> symmetric and positive definite.
module fuge_contact_preconditioner
  use fuge_kinds, only: dp
  use fuge_operator_type, only: fuge_operator
  use fuge_operator_products, only: precondition
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  use fuge_contact_segments, only: stretches, total
  use fuge_number_text, only: text
  implicit none
  private

  !> So many doublings of the cells lie between one level and the next.
  integer, parameter :: DOUBLINGS = 4
  integer, parameter :: CELLS = 2**DOUBLINGS
  !> Fewer stretches of contact than this need one level only: each of them adds one
  !> direction or two that conjugate gradients have to find.
  integer, parameter :: MANY_STRETCHES = 16
  !> More levels than any grid has.
  integer, parameter :: MOST_LEVELS = 8

  type :: preconditioner_level
    !> Not allocated on the finest level, where the caller has it.
    class(fuge_operator), allocatable :: operator
    !> Points in contact in each cell: how often it counts.
    real(dp), allocatable :: weight(:)
    !> 1 where a cell has points in contact, else 0. On the finest level the weight is that.
    real(dp), allocatable :: present(:)
    !> A length, zero off the contact: work space.
    real(dp), allocatable :: length(:)
  end type preconditioner_level

  !> Forces on the cells of a level, apart from it because they are what it makes.
  type :: level_force
    real(dp), allocatable :: values(:)
  end type level_force

  type, public :: contact_preconditioner
    !> Made when several levels are wanted.
    type(preconditioner_level), allocatable, private :: levels(:)
    type(level_force), allocatable, private :: forces(:)
    !> The present set, (n).
    logical, allocatable, private :: contact(:)
    !> Levels in use for the present set; 0 without a preconditioner.
    integer, private :: depth = 0
    !> Forces that sink all contact points alike, nearly, and their sum.
    real(dp), allocatable, private :: even(:)
    real(dp), private :: sum_of_even = 1.0_dp
    !> Stands for the preconditioner where the operator has none; force per length.
    real(dp), private :: stiffness = 1.0_dp
    !> Preconditioner applications on coarser grids, as parts of one on this grid.
    real(dp) :: coarse_share = 0.0_dp
  contains
    procedure :: set
    procedure :: apply
  end type contact_preconditioner

contains

  !> Make ready for a contact set.
  !>
  !> `contact` (n); `softness` a typical length per force, used where the
  !> operator has no preconditioner. Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE for a preconditioner
  !> that is not positive definite, those of the preconditioner.
  subroutine set(self, operator, contact, softness, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: softness
    type(fuge_info), intent(inout) :: info
    type(stretches) :: over

    if (.not. operator%has_preconditioner()) then
      ! Only to stay in range: conjugate gradients do not depend on it.
      self%stiffness = 1.0_dp
      if (softness >= tiny(softness)) self%stiffness = 1.0_dp/softness
      return
    end if
    if (self%depth > 0) then
      if (all(contact .eqv. self%contact)) return
    end if
    call over%find(contact, info)
    if (.not. info%failed()) call make_ready(self, operator, contact, size(over%first) >= MANY_STRETCHES, info)
    if (info%failed()) return
    if (self%depth == 1) then
      call precondition_equal(operator, contact, self%even, info)
    else
      self%levels(1)%length = self%levels(1)%weight
      call precondition_from(self%levels(:self%depth), self%forces, operator, self%even, self%coarse_share, info)
    end if
    if (info%failed()) return
    self%sum_of_even = total(over, self%even)
    if (over%points > 0 .and. .not. self%sum_of_even > 0.0_dp) then
      call report(info, FUGE_ERR_NOT_DEFINITE, &
                  'the preconditioner of the operator is not positive definite: equal lengths ' &
                  //'on the contact set have the energy '//text(self%sum_of_even))
    end if
  end subroutine set

  !> Forces on the contact set near those that take `length` away; with zero sum if
  !> `balanced`.
  !>
  !> `over` the stretches of its set; `length` (n), zero off them; `force` (n), off them
  !> anything. Errors: those of the preconditioner.
  subroutine apply(self, operator, over, balanced, length, force, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(stretches), intent(in) :: over
    logical, intent(in) :: balanced
    real(dp), intent(in), contiguous :: length(:)
    real(dp), intent(inout), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: excess
    integer :: i

    excess = 0.0_dp
    if (self%depth == 1) then
      call precondition(operator, length, force, info)
    else if (self%depth > 1) then
      self%levels(1)%length = length
      call precondition_from(self%levels(:self%depth), self%forces, operator, force, self%coarse_share, info)
    end if
    if (info%failed()) return
    if (self%depth > 0 .and. balanced) excess = total(over, force)/self%sum_of_even
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

  !> Remember the set, and make all levels there are if `many` stretches want them.
  subroutine make_ready(self, operator, contact, many, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: contact(:), many
    type(fuge_info), intent(inout) :: info
    integer :: l, n, stat

    n = operator%points()
    stat = 0
    if (.not. allocated(self%contact)) allocate (self%contact(n), self%even(n), stat=stat)
    if (stat == 0) self%contact = contact
    self%depth = 1
    if (many .and. stat == 0) then
      if (.not. allocated(self%levels)) then
        allocate (self%levels(MOST_LEVELS), self%forces(MOST_LEVELS), stat=stat)
        if (stat == 0) allocate (self%levels(1)%weight(n), self%levels(1)%length(n), stat=stat)
      end if
      do l = 2, MOST_LEVELS
        if (stat == 0) call make_level(operator, l, self%levels(l), self%forces(l), stat)
        if (stat /= 0 .or. .not. allocated(self%levels(l)%operator)) exit
        self%depth = l
      end do
      if (self%depth > 1 .and. stat == 0) call weigh(self%levels(:self%depth), contact)
    end if
    if (stat /= 0) call report(info, FUGE_ERR_MEMORY, 'no memory for the preconditioner of '//text(n)//' points')
  end subroutine make_ready

  !> A level of coarser cells, if it is not there yet and the operator has it.
  subroutine make_level(operator, number, level, force, stat)
    class(fuge_operator), intent(in) :: operator
    integer, intent(in) :: number
    type(preconditioner_level), intent(inout) :: level
    type(level_force), intent(inout) :: force
    integer, intent(out) :: stat
    class(fuge_operator), allocatable :: coarse

    stat = 0
    if (allocated(level%operator)) return
    call operator%coarsen(DOUBLINGS*(number - 1), coarse)
    if (.not. is_usable(coarse, (operator%points() - 1)/CELLS**(number - 1) + 1)) return
    call move_alloc(coarse, level%operator)
    allocate (level%weight(level%operator%points()), level%present(level%operator%points()), &
              level%length(level%operator%points()), force%values(level%operator%points()), stat=stat)
    if (stat /= 0) deallocate (level%operator)
  end subroutine make_level

  !> What the preconditioner makes of equal lengths on the set.
  subroutine precondition_equal(operator, contact, force, info)
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: contact(:)
    real(dp), intent(inout), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: length(:)
    integer :: stat

    allocate (length(size(contact)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the preconditioner of '//text(size(contact))//' points')
    else
      length = merge(1.0_dp, 0.0_dp, contact)
      call precondition(operator, length, force, info)
    end if
  end subroutine precondition_equal

  !> A coarser grid of the right number of cells with a preconditioner.
  function is_usable(coarse, cells) result(usable)
    class(fuge_operator), intent(in), allocatable :: coarse
    integer, intent(in) :: cells
    logical :: usable

    usable = allocated(coarse)
    if (usable) usable = coarse%points() == cells
    if (usable) usable = coarse%has_preconditioner()
  end function is_usable

  !> Count the points in contact in the cells of every level.
  pure subroutine weigh(levels, contact)
    type(preconditioner_level), intent(inout) :: levels(:)
    logical, intent(in) :: contact(:)
    integer :: k, l

    levels(1)%weight = merge(1.0_dp, 0.0_dp, contact)
    do l = 2, size(levels)
      do k = 1, size(levels(l)%weight)
        levels(l)%weight(k) = sum(levels(l - 1)%weight((k - 1)*CELLS + 1:min(k*CELLS, size(levels(l - 1)%weight))))
      end do
      levels(l)%present = min(levels(l)%weight, 1.0_dp)
    end do
  end subroutine weigh

  !> Force on each point by the preconditionings of these levels; the length is in
  !> levels(1)%length, zero off the contact, and is used up. Off the contact the forces
  !> mean nothing. `operator` that of the finest grid.
  recursive subroutine precondition_from(levels, forces, operator, force, coarse_share, info)
    type(preconditioner_level), intent(inout) :: levels(:)
    type(level_force), intent(inout) :: forces(:)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(inout), contiguous :: force(:)
    real(dp), intent(inout) :: coarse_share
    type(fuge_info), intent(inout) :: info

    if (size(levels) > 1) then
      call mean_of_cells(levels(1)%weight, levels(1)%length, levels(2)%weight, levels(2)%length)
      if (allocated(levels(1)%present)) then
        call subtract_cells(levels(2)%length, levels(1)%present, levels(1)%length)
      else
        call subtract_cells(levels(2)%length, levels(1)%weight, levels(1)%length)
      end if
    end if
    if (allocated(levels(1)%operator)) then
      call precondition_coarse(levels(1), operator%points(), force, coarse_share, info)
    else
      call precondition(operator, levels(1)%length, force, info)
    end if
    if (info%failed() .or. size(levels) == 1) return
    call mean_of_cells(levels(1)%weight, force, levels(2)%weight, forces(2)%values)
    call add_cells(-1.0_dp, forces(2)%values, force)
    call precondition_from(levels(2:), forces(2:), operator, forces(2)%values, coarse_share, info)
    call add_cells(1.0_dp, forces(2)%values, force)
  end subroutine precondition_from

  !> The preconditioner of a coarser grid; the force on a cell is shared by its points in contact.
  subroutine precondition_coarse(level, points, force, coarse_share, info)
    type(preconditioner_level), intent(in) :: level
    integer, intent(in) :: points
    real(dp), intent(inout), contiguous :: force(:)
    real(dp), intent(inout) :: coarse_share
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: coarse

    call precondition(level%operator, level%length, force, coarse)
    coarse_share = coarse_share + real(size(force), dp)/real(points, dp)
    if (coarse%failed()) call report(info, coarse%status, 'on the grid of '//text(size(force))//' cells: ' &
                                     //coarse%message)
    where (level%weight > 0.0_dp) force = force/level%weight
  end subroutine precondition_coarse

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

  !> Take each group's value off where `present` is 1.
  pure subroutine subtract_cells(coarse, present, fine)
    real(dp), intent(in), contiguous :: coarse(:), present(:)
    real(dp), intent(inout), contiguous :: fine(:)
    integer :: i, k

    do k = 1, size(coarse)
      if (.not. abs(coarse(k)) > 0.0_dp) cycle
      do i = (k - 1)*CELLS + 1, min(k*CELLS, size(fine))
        fine(i) = fine(i) - coarse(k)*present(i)
      end do
    end do
  end subroutine subtract_cells

  !> Add `factor` times each group's value to all of it: for forces, which count at the
  !> contact only.
  pure subroutine add_cells(factor, coarse, fine)
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
  end subroutine add_cells

end module fuge_contact_preconditioner
