!> The operator of points and motions on springs, so that the iteration needs no springs of its own.
!>
!> Compliances D add D f to the displacements. A free motion on a spring of the stiffness s under the resultant w is
!> q = (w - r.f)/s, r being its mode: the prescribed motion w/s, and r (r.f)/s more of displacement. So the operator is
!> A + D + R S^-1 R^T, and the problem has prescribed motions where it has springs.
!>
!> The preconditioner is that of A on a bed of equal compliances, where the operator has one. Compliances that differ
!> are sorted into a few beds, each of similar ones: restricted to its points, the preconditioner on each bed is as
!> close to the inverse there as that of A is on a contact set. Points whose springs outweigh all displacements by A
!> have the inverse of their compliance. The few motions on springs are left to the conjugate gradients, which need
!> about one step for each.
module fuge_spring_operator
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_kinds, only: dp, sp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: copy_problem, fuge_problem
  use fuge_shared_rows, only: rows_of, shared_rows
  use fuge_shared_transfer, only: restrict_rows
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW
  implicit none
  private

  !> Compliances that differ by less than this factor belong to one bed.
  real(dp), parameter :: SIMILAR = 10.0_dp
  !> Springs outweigh the displacements by A from this multiple of the compliance of its longest wave on.
  real(dp), parameter :: OUTWEIGHS = 3.0_dp

  !> What a grid of springs stands on that no operator keeps.
  type :: owned_operator
    class(fuge_operator), allocatable :: operator
  end type owned_operator

  !> Call `set_springs`, then `attach` it to an operator. Copies are allowed of one that is detached.
  type, extends(fuge_operator), public :: spring_operator
    private
    !> The operator without springs: that of the caller, or `owned`, in memory of its own.
    class(fuge_operator), pointer :: attached => null()
    type(owned_operator), pointer :: owned => null()
    !> Compliance of each point, (n), length per force; not allocated: none.
    real(dp), allocatable :: compliance(:)
    !> Modes of the motions on springs, (n, s), and what their springs give way by, (s), motion per resultant; not
    !> allocated: none.
    real(dp), allocatable :: modes(:, :), flexibility(:)
    !> The numbers of these motions, (s); not allocated on coarser grids and windows, nor without such springs.
    integer, allocatable :: motion(:)
    !> The compliance of each bed, length per force; not allocated: none.
    real(dp), allocatable :: beds(:)
    !> The number of the bed of each point, (n), 0 where its spring outweighs A; not allocated: all are on the first
    !> one.
    integer, allocatable :: bed_of(:)
    !> There is one spring, and all points move alike on it.
    logical :: is_translation = .false.
  contains
    procedure :: set_springs
    procedure :: attach
    procedure :: detach
    procedure :: fix_motions
    procedure :: prescribe_motions
    procedure :: find_motions
    procedure :: points
    procedure :: apply
    procedure :: datum
    procedure :: magnitude => find_magnitude
    procedure :: least_pair_compliance
    procedure :: has_preconditioner
    procedure :: extends_sets
    procedure :: wave_slope
    procedure :: precondition
    procedure :: has_single
    procedure :: apply_single
    procedure :: precondition_single
    procedure :: translation_spring
    procedure :: common_magnitude
    procedure :: grid
    procedure :: free_rim
    procedure :: coarsen
    procedure :: window
    procedure :: ranks
    procedure :: first_rows
    procedure, private :: add_springs
    procedure, private :: add_magnitudes
    procedure, private :: prepare
    final :: destroy
  end type spring_operator

contains

  !> Take the compliances of `problem`, whose points `space` may share, and the springs of the motions marked in
  !> `on_spring` (m). Errors: FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW for a stiffness so small that its compliance overflows.
  subroutine set_springs(self, problem, on_spring, space, info)
    class(spring_operator), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    logical, intent(in) :: on_spring(:)
    type(point_space), intent(in) :: space
    type(fuge_info), intent(inout) :: info
    real(dp) :: arm(size(on_spring))
    integer :: j, n, springs, stat

    call clear(self)
    n = problem%points()
    springs = count(on_spring)
    stat = 0
    if (allocated(problem%compliance)) allocate (self%compliance(n), stat=stat)
    if (springs > 0 .and. stat == 0) allocate (self%modes(n, springs), self%flexibility(springs), &
                                                  self%motion(springs), stat=stat)
    call require_memory(stat, 'the springs of', n, 'points', info)
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    if (allocated(problem%compliance)) self%compliance = problem%compliance
    arm = problem%arms()
    call space%raise(arm)
    springs = 0
    do j = 1, size(on_spring)
      if (.not. on_spring(j)) cycle
      springs = springs + 1
      self%motion(springs) = j
      self%modes(:, springs) = 1.0_dp
      if (allocated(problem%modes)) self%modes(:, springs) = problem%modes(:, j)
      associate (stiffness => problem%motion_stiffness(j), load => abs(problem%resultant(j)))
        if (max(0, exponent(load), 2*exponent(arm(j)), exponent(arm(j)) + exponent(load)) - exponent(stiffness) &
            > LARGEST_EXPONENT) then
          call report(info, FUGE_ERR_OVERFLOW, 'motion_stiffness reaches down to '//text(stiffness) &
                      //': choose units in which it is larger, or 0 for no spring')
          return
        end if
        self%flexibility(springs) = 1.0_dp/stiffness
      end associate
    end do
  end subroutine set_springs

  !> Forget springs and operator.
  subroutine clear(self)
    class(spring_operator), intent(inout) :: self

    call self%detach()
    if (allocated(self%compliance)) deallocate (self%compliance)
    if (allocated(self%modes)) deallocate (self%modes, self%flexibility, self%motion)
  end subroutine clear

  !> Let the springs stand on `operator`, which must be a target for as long as this one is used.
  subroutine attach(self, operator)
    class(spring_operator), intent(inout) :: self
    class(fuge_operator), intent(in), target :: operator

    self%attached => operator
    call self%prepare()
  end subroutine attach

  !> Forget the operator.
  subroutine detach(self)
    class(spring_operator), intent(inout) :: self

    self%attached => null()
    if (associated(self%owned)) deallocate (self%owned)
  end subroutine detach

  impure elemental subroutine destroy(self)
    type(spring_operator), intent(inout) :: self

    call self%detach()
  end subroutine destroy

  !> Number of points.
  pure function points(self) result(n)
    class(spring_operator), intent(in) :: self
    integer :: n

    n = 0
    if (associated(self%attached)) n = self%attached%points()
  end function points

  !> u = (A - datum + D + R S^-1 R^T) f; see `fuge_operator`.
  subroutine apply(self, force, displacement, status)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    call self%attached%apply(force, displacement, status)
    if (is_done_everywhere(self, status)) call self%add_springs(force, displacement)
  end subroutine apply

  !> Did all ranks succeed? All of them ask, or others would wait for those that did not.
  function is_done_everywhere(self, status) result(done)
    class(spring_operator), intent(in) :: self
    integer, intent(in) :: status
    logical :: done
    type(point_space) :: space

    space = self%ranks()
    done = space%everywhere(status == FUGE_DONE)
  end function is_done_everywhere

  !> Add the displacements by the springs to `displacement` (n).
  subroutine add_springs(self, force, displacement)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: displacement(:)
    type(point_space) :: space
    real(dp) :: resultant
    integer :: j

    if (allocated(self%compliance)) displacement = displacement + self%compliance*force
    if (.not. allocated(self%modes)) return
    space = self%ranks()
    do j = 1, size(self%flexibility)
      resultant = space%total(dot_product(self%modes(:, j), force))
      displacement = displacement + (self%flexibility(j)*resultant)*self%modes(:, j)
    end do
  end subroutine add_springs

  !> Add the sizes of their terms to `magnitude` (n).
  subroutine add_magnitudes(self, force, magnitude)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(inout) :: magnitude(:)
    type(point_space) :: space
    real(dp) :: resultant
    integer :: j

    if (allocated(self%compliance)) magnitude = magnitude + self%compliance*abs(force)
    if (.not. allocated(self%modes)) return
    space = self%ranks()
    do j = 1, size(self%flexibility)
      resultant = space%total(sum(abs(self%modes(:, j)*force)))
      magnitude = magnitude + (self%flexibility(j)*resultant)*abs(self%modes(:, j))
    end do
  end subroutine add_magnitudes

  !> The constant that is subtracted from all coefficients of A.
  function datum(self)
    class(spring_operator), intent(in) :: self
    real(dp) :: datum

    datum = self%attached%datum()
  end function datum

  !> See `fuge_operator`.
  subroutine find_magnitude(self, force, displacement, magnitude)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)

    call self%attached%magnitude(force, displacement, magnitude)
    call self%add_magnitudes(force, magnitude)
  end subroutine find_magnitude

  !> The least of the pairs of A and twice the compliance, if that is the same at all points in contact: springs move no
  !> two points together. Otherwise unknown, because nothing tells which pair is the least.
  function least_pair_compliance(self, contact, modes) result(compliance)
    class(spring_operator), intent(in) :: self
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: modes(:, :)
    real(dp) :: compliance
    type(point_space) :: space
    real(dp) :: extremes(2)

    compliance = self%attached%least_pair_compliance(contact, modes)
    if (.not. allocated(self%compliance) .or. compliance >= huge(compliance)) return
    space = self%ranks()
    if (.not. space%anywhere(any(contact))) return
    extremes = [space%least(minval(self%compliance, mask=contact)), &
                space%largest(maxval(self%compliance, mask=contact))]
    if (extremes(2) > extremes(1)) then
      compliance = huge(compliance)
    else
      compliance = compliance + 2.0_dp*extremes(1)
    end if
  end function least_pair_compliance

  function has_preconditioner(self) result(preconditioned)
    class(spring_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%attached%has_preconditioner()
  end function has_preconditioner

  !> Not on beds, which leave the displacement of each point to its own force.
  function extends_sets(self) result(extends)
    class(spring_operator), intent(in) :: self
    logical :: extends

    extends = .not. allocated(self%compliance)
    if (extends) extends = self%attached%extends_sets()
  end function extends_sets

  function wave_slope(self, levels) result(slope)
    class(spring_operator), intent(in) :: self
    integer, intent(in) :: levels
    real(dp) :: slope

    slope = self%attached%wave_slope(levels)
  end function wave_slope

  !> Where A has, and all points move alike on the only spring.
  function has_single(self) result(single)
    class(spring_operator), intent(in) :: self
    logical :: single

    single = self%translation_spring() > 0.0_dp
    if (single) single = self%attached%has_single()
  end function has_single

  function translation_spring(self) result(flexibility)
    class(spring_operator), intent(in) :: self
    real(dp) :: flexibility

    flexibility = 0.0_dp
    if (self%is_translation) flexibility = self%flexibility(1)
  end function translation_spring

  !> That of A: the spring is left to who asks for `translation_spring`, as in `precondition_single`.
  subroutine apply_single(self, input, result, status)
    class(spring_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call self%attached%apply_single(input, result, status)
  end subroutine apply_single

  subroutine precondition_single(self, input, result, status)
    class(spring_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    call self%attached%precondition_single(input, result, status)
  end subroutine precondition_single

  !> Where all points move alike on the only spring.
  function common_magnitude(self, largest, total) result(magnitude)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: largest, total
    real(dp) :: magnitude

    magnitude = -1.0_dp
    if (self%is_translation) magnitude = self%attached%common_magnitude(largest, total)
    if (magnitude > 0.0_dp) magnitude = magnitude + self%flexibility(1)*total
  end function common_magnitude

  !> The sum over the beds of the preconditioner of A on each of them, restricted to its points.
  subroutine precondition(self, displacement, force, status)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status
    real(dp), allocatable :: on_bed(:), share(:)
    integer :: bed, stat

    if (.not. allocated(self%bed_of)) then
      call precondition_on(self, 1, displacement, force, status)
      return
    end if
    force = 0.0_dp
    allocate (on_bed(size(displacement)), share(size(displacement)), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (.not. is_done_everywhere(self, status)) return
    where (self%bed_of == 0) force = displacement/self%compliance
    do bed = 1, size(self%beds)
      on_bed = merge(displacement, 0.0_dp, self%bed_of == bed)
      call precondition_on(self, bed, on_bed, share, status)
      if (.not. is_done_everywhere(self, status)) return
      where (self%bed_of == bed) force = share
    end do
  end subroutine precondition

  !> The preconditioner of A on one bed, where the operator has one; else that of A.
  subroutine precondition_on(self, bed, displacement, force, status)
    class(spring_operator), intent(in) :: self
    integer, intent(in) :: bed
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status
    logical :: on_bed

    on_bed = self%attached%has_preconditioner_on_bed()
    if (on_bed .and. allocated(self%beds)) then
      call self%attached%precondition_on_bed(self%beds(bed), displacement, force, status)
    else
      call self%attached%precondition(displacement, force, status)
    end if
  end subroutine precondition_on

  !> See `fuge_operator`.
  function grid(self) result(cells)
    class(spring_operator), intent(in) :: self
    integer :: cells(2)

    cells = self%attached%grid()
  end function grid

  !> See `fuge_operator`.
  function free_rim(self) result(free)
    class(spring_operator), intent(in) :: self
    logical :: free(2)

    free = self%attached%free_rim()
  end function free_rim

  !> See `fuge_operator`.
  function ranks(self) result(space)
    class(spring_operator), intent(in) :: self
    type(point_space) :: space

    space = self%attached%ranks()
  end function ranks

  !> See `fuge_operator`.
  subroutine first_rows(self, levels, first)
    class(spring_operator), intent(in) :: self
    integer, intent(in) :: levels
    integer, allocatable, intent(out) :: first(:)

    call self%attached%first_rows(levels, first)
  end subroutine first_rows

  !> Wider cells on springs: the force of a cell stands for equal ones on its points, which displace it by their mean.
  subroutine coarsen(self, levels, coarse)
    class(spring_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse
    type(spring_operator), allocatable :: wider
    type(shared_rows) :: rows, coarse_rows
    type(point_space) :: space
    type(fuge_info) :: info
    real(dp), allocatable :: mode(:)
    integer :: cells(2), j, stat

    space = self%ranks()
    allocate (wider, stat=stat)
    if (.not. space%everywhere(stat == 0)) return
    call self%attached%kept_coarser(levels, wider%attached)
    if (.not. associated(wider%attached)) then
      allocate (wider%owned, stat=stat)
      if (.not. space%everywhere(stat == 0)) return
      call self%attached%coarsen(levels, wider%owned%operator)
      if (allocated(wider%owned%operator)) wider%attached => wider%owned%operator
    end if
    if (.not. associated(wider%attached)) return
    cells = self%grid()
    call rows_of(self%attached, 0, rows, info)
    if (.not. info%failed()) call rows_of(self%attached, levels, coarse_rows, info)
    if (allocated(self%compliance) .and. .not. info%failed()) then
      call restrict_rows(rows, coarse_rows, cells, levels, self%compliance, wider%compliance, info)
      if (allocated(wider%compliance)) wider%compliance = wider%compliance/real(product(min(2**levels, cells)), dp)
    end if
    if (allocated(self%modes) .and. .not. info%failed()) then
      allocate (wider%modes(wider%points(), size(self%modes, 2)), wider%flexibility(size(self%modes, 2)), stat=stat)
      call require_memory(stat, 'the springs of', wider%points(), 'cells', info)
      call rows%agree(info)
      do j = 1, size(self%modes, 2)
        if (.not. info%failed()) call restrict_rows(rows, coarse_rows, cells, levels, self%modes(:, j), mode, info)
        if (info%failed()) return
        wider%modes(:, j) = mode
      end do
      wider%flexibility = self%flexibility
    end if
    if (info%failed()) return
    call wider%prepare()
    call move_alloc(wider, coarse)
  end subroutine coarsen

  !> See `fuge_operator`; not where ranks share the points.
  subroutine window(self, first, last, part)
    class(spring_operator), intent(in) :: self
    integer, intent(in) :: first(2), last(2)
    class(fuge_operator), allocatable, intent(out) :: part
    type(spring_operator), allocatable :: inside
    type(point_space) :: space
    integer :: cells(2), j, n, stat

    space = self%ranks()
    if (.not. space%is_alone()) return
    allocate (inside, stat=stat)
    if (stat /= 0) return
    allocate (inside%owned, stat=stat)
    if (stat /= 0) return
    call self%attached%window(first, last, inside%owned%operator)
    if (.not. allocated(inside%owned%operator)) return
    inside%attached => inside%owned%operator
    cells = self%grid()
    n = inside%points()
    if (allocated(self%compliance)) then
      allocate (inside%compliance(n), stat=stat)
      if (stat /= 0) return
      call copy_box(cells(1), first, last, self%compliance, inside%compliance)
    end if
    if (allocated(self%modes)) then
      allocate (inside%modes(n, size(self%modes, 2)), inside%flexibility(size(self%modes, 2)), stat=stat)
      if (stat /= 0) return
      do j = 1, size(self%modes, 2)
        call copy_box(cells(1), first, last, self%modes(:, j), inside%modes(:, j))
      end do
      inside%flexibility = self%flexibility
    end if
    call inside%prepare()
    call move_alloc(inside, part)
  end subroutine window

  !> The `values` in the columns first(1) .. last(1) of the rows first(2) .. last(2), of `columns` each.
  pure subroutine copy_box(columns, first, last, values, inside)
    integer, intent(in) :: columns, first(2), last(2)
    real(dp), intent(in), contiguous :: values(:)
    real(dp), intent(out), contiguous :: inside(:)
    integer :: begin, j, n

    n = last(1) - first(1) + 1
    do j = first(2), last(2)
      begin = columns*(j - 1) + first(1)
      inside(n*(j - first(2)) + 1:n*(j - first(2) + 1)) = values(begin:begin + n - 1)
    end do
  end subroutine copy_box

  !> Sort the compliances into beds. Where memory is short all points are on one.
  subroutine prepare(self)
    class(spring_operator), intent(inout) :: self
    type(point_space) :: space
    real(dp) :: extremes(2), waves(2)
    logical :: on_beds
    integer :: stat

    self%is_translation = allocated(self%modes) .and. .not. allocated(self%compliance)
    if (self%is_translation) self%is_translation = size(self%modes, 2) == 1
    space = self%ranks()
    if (self%is_translation) self%is_translation = space%everywhere(.not. any(abs(self%modes - 1.0_dp) > 0.0_dp))
    if (allocated(self%beds)) deallocate (self%beds)
    if (allocated(self%bed_of)) deallocate (self%bed_of)
    if (.not. allocated(self%compliance)) return
    if (.not. self%attached%has_preconditioner()) return
    extremes = [-minval(self%compliance), maxval(self%compliance)]
    call space%raise(extremes)
    waves = wave_compliances(self%attached, space)
    on_beds = self%attached%has_preconditioner_on_bed()
    if (on_beds .and. max(-extremes(1), waves(1))*SIMILAR > extremes(2)) then
      call average_beds(self, space, 1)
      return
    end if
    allocate (self%bed_of(size(self%compliance)), stat=stat)
    if (.not. space%everywhere(stat == 0)) then
      if (allocated(self%bed_of)) deallocate (self%bed_of)
      call average_beds(self, space, 1)
    else if (on_beds) then
      self%bed_of = 1 + int(log(max(min(self%compliance, OUTWEIGHS*waves(2)), waves(1))/waves(1))/log(SIMILAR))
      where (self%compliance > OUTWEIGHS*waves(2)) self%bed_of = 0
      call average_beds(self, space, int(space%largest(real(maxval(self%bed_of), dp))))
    else
      self%bed_of = merge(0, 1, self%compliance > sqrt(waves(1)*waves(2)))
      call average_beds(self, space, 1)
    end if
  end subroutine prepare

  !> The mean compliance of the points of each of `count` beds; 0 where there are none.
  subroutine average_beds(self, space, count)
    class(spring_operator), intent(inout) :: self
    type(point_space), intent(in) :: space
    integer, intent(in) :: count
    real(dp) :: sums(count), points(count)
    integer :: bed, k

    sums = 0.0_dp
    points = 0.0_dp
    do k = 1, size(self%compliance)
      bed = 1
      if (allocated(self%bed_of)) bed = self%bed_of(k)
      if (bed < 1) cycle
      sums(bed) = sums(bed) + self%compliance(k)
      points(bed) = points(bed) + 1.0_dp
    end do
    call space%add(sums)
    call space%add(points)
    self%beds = sums/max(points, 1.0_dp)
  end subroutine average_beds

  !> About the displacement per force of the shortest and of the longest wave by the operator, as its preconditioner has
  !> them; 1 where it has no such numbers.
  function wave_compliances(operator, space) result(compliance)
    class(fuge_operator), intent(in) :: operator
    type(point_space), intent(in) :: space
    real(dp) :: compliance(2)
    real(dp), allocatable :: wave(:), force(:)
    real(dp) :: counts(0:space%members() - 1), stiffness
    integer :: before, j, k, n, stat, status

    compliance = 1.0_dp
    n = operator%points()
    counts = 0.0_dp
    counts(space%number()) = real(n, dp)
    call space%add(counts)
    ! Points of the ranks before this one, at which the shortest wave begins.
    before = int(sum(counts(:space%number() - 1)))
    allocate (wave(n), force(n), stat=stat)
    if (.not. space%everywhere(stat == 0)) return
    do j = 1, 2
      do k = 1, n
        wave(k) = merge(real(1 - 2*modulo(before + k, 2), dp), 1.0_dp, j == 1)
      end do
      call operator%precondition(wave, force, status)
      if (.not. space%everywhere(status == FUGE_DONE)) return
      if (.not. space%everywhere(all(abs(force) <= huge(force)/real(max(n, 1), dp)))) return
      stiffness = space%total(dot_product(wave, force))/real(space%total_count(n), dp)
      if (stiffness > tiny(stiffness)) compliance(j) = 1.0_dp/stiffness
    end do
    compliance(2) = max(compliance(1), compliance(2))
  end function wave_compliances

  !> `fixed`: `problem` without springs, but with prescribed motions where these are on springs of this operator. The
  !> others have the resultants `load` (m). Error: FUGE_ERR_MEMORY.
  subroutine fix_motions(self, problem, load, fixed, info)
    class(spring_operator), intent(in) :: self
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: load(:)
    type(fuge_problem), intent(out) :: fixed
    type(fuge_info), intent(inout) :: info

    call copy_problem(problem, fixed, info)
    if (info%failed()) return
    if (allocated(fixed%compliance)) deallocate (fixed%compliance)
    if (allocated(fixed%motion_stiffness)) deallocate (fixed%motion_stiffness)
    fixed%resultant = load
    if (.not. allocated(self%motion)) return
    if (.not. allocated(fixed%prescribed)) fixed%prescribed = spread(.false., 1, size(load))
    fixed%motion = merge(problem%prescribed_motion(), load, fixed%prescribed)
    call self%prescribe_motions(fixed%motion)
    fixed%prescribed(self%motion) = .true.
  end subroutine fix_motions

  !> In `loads` (m), resultants or changes of them, replace those of motions on springs by the motions that they are
  !> without contact, w/s.
  pure subroutine prescribe_motions(self, loads)
    class(spring_operator), intent(in) :: self
    real(dp), intent(inout) :: loads(:)
    integer :: k

    if (.not. allocated(self%motion)) return
    do k = 1, size(self%motion)
      loads(self%motion(k)) = self%flexibility(k)*loads(self%motion(k))
    end do
  end subroutine prescribe_motions

  !> In `motion` (m) set those on springs, (w - r.f)/s, of the resultants w, `load` (m), and the `force` f (n).
  subroutine find_motions(self, load, force, motion)
    class(spring_operator), intent(in) :: self
    real(dp), intent(in) :: load(:), force(:)
    real(dp), intent(inout) :: motion(:)
    type(point_space) :: space
    integer :: j, k

    if (.not. allocated(self%motion)) return
    space = self%ranks()
    do k = 1, size(self%motion)
      j = self%motion(k)
      motion(j) = self%flexibility(k)*(load(j) - space%total(dot_product(self%modes(:, k), force)))
    end do
  end subroutine find_motions

end module fuge_spring_operator
