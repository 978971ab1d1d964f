!> The preconditioner of the conjugate gradients on a contact set: that of the operator,
!> restricted to the set.
!>
!> Restricted to one contact segment, the operator's preconditioner is the inverse of the
!> restricted operator except in a few directions. Restricted to many segments it overestimates
!> the stiffness of forces that vary from segment to segment but little within one: to it they are
!> short waves, in truth a smooth load. So there is a hierarchy of levels (fuge_preconditioner_levels) on a line, and on
!> an area residuals are extended to open points (fuge_extended_preconditioner).
module fuge_contact_preconditioner
  use fuge_contact_segments, only: contact_segments, dot_over, max_abs_over, subtract_and_dot_over, &
    sum_over
  use fuge_extended_preconditioner, only: extended_preconditioner
  use fuge_kinds, only: dp
  use fuge_mode_projection, only: mode_projection
  use fuge_number_text, only: text
  use fuge_operator_products, only: precondition
  use fuge_operator_type, only: fuge_operator
  use fuge_point_chunks, only: chunk_count, chunked_pass
  use fuge_preconditioner_levels, only: apply_levels, count_contacts, create_level, exists, level_force, &
    preconditioner_level
  use fuge_point_space, only: point_space
  use fuge_rigid_images, only: rigid_images
  use fuge_shared_exchange, only: count_segments
  use fuge_shared_rows, only: rows_of, shared_rows
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  !> With fewer contact segments than this one level is enough: each segment adds only one or two
  !> directions for the conjugate gradients to resolve.
  integer, parameter :: MANY_SEGMENTS = 16
  !> `uniform` is kept while at most this fraction of the set has changed since it was computed.
  real(dp), parameter :: CLOSE = 0.05_dp
  !> A negative energy below this fraction of the magnitude of its terms is rounding.
  real(dp), parameter :: ROUNDING = 1.0e-10_dp
  !> More levels than any grid has.
  integer, parameter :: MAX_LEVELS = 8

  !> Set it for a contact set, then apply it any number of times.
  type, public :: contact_preconditioner
    !> Created for the first set with many segments.
    type(preconditioner_level), allocatable, private :: levels(:)
    type(level_force), allocatable, private :: forces(:)
    !> On areas, for the present set.
    type(extended_preconditioner), private :: extended
    logical, private :: is_extended = .false.
    !> The contact set for which `uniform` was computed, (n).
    logical, allocatable, private :: contact(:)
    !> Number of levels used for this set; 0 where the operator has no preconditioner.
    integer, private :: depth = 0
    !> The preconditioner applied to a unit residual on the whole set, (n): forces that displace
    !> all its points almost equally; and their sum over the present set.
    real(dp), allocatable, private :: uniform(:)
    !> `uniform` is that of the present set.
    logical, private :: has_uniform = .false.
    !> The present set is not that of `uniform`, but close to it.
    logical, private :: is_close = .false.
    !> A residual, (n), zero off the present set; allocated if it is needed.
    real(dp), allocatable, private :: centred(:)
    real(dp), private :: sum_of_uniform = 1.0_dp
    !> Takes the role of `uniform` where there are several rigid modes.
    type(rigid_images), private :: rigid = rigid_images()
    !> Force per length that stands for the preconditioner where the operator has none.
    real(dp), private :: stiffness = 1.0_dp
    logical, private :: has_stiffness = .false.
    !> Applications on coarser levels, each counted as its fraction of one on the finest.
    real(dp) :: coarse_share = 0.0_dp
  contains
    procedure :: set
    procedure :: set_modes
    procedure :: apply
    procedure :: apply_with_modes
  end type contact_preconditioner

  !> Gives `values`: 1 on the set `contact` and 0 off it; or `source`; or on `segments` `source` less `mean`.
  type, extends(chunked_pass) :: value_pass
    real(dp), pointer, contiguous :: values(:) => null(), source(:) => null()
    logical, pointer, contiguous :: contact(:) => null()
    type(contact_segments), pointer :: segments => null()
    real(dp) :: mean = 0.0_dp
  contains
    procedure :: do_chunk => give_values
  end type value_pass

contains

  !> Prepare for a contact set; does nothing if it is the same set as before, and little if it is close to it.
  !>
  !> `contact` (n); `zero_sum` whether it will be applied with zero sums; `compliance` a typical displacement per force,
  !> used where the operator has no preconditioner. Errors: FUGE_ERR_MEMORY; FUGE_ERR_NOT_DEFINITE for a preconditioner
  !> that is not positive definite; those of `precondition`.
  subroutine set(self, operator, contact, zero_sum, compliance, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    logical, intent(in), contiguous :: contact(:)
    logical, intent(in) :: zero_sum
    real(dp), intent(in) :: compliance
    type(fuge_info), intent(inout) :: info
    type(contact_segments) :: segments
    type(point_space) :: space

    space = operator%ranks()
    if (.not. operator%has_preconditioner()) then
      ! Only avoids overflow: conjugate gradients do not depend on a factor. The first one is kept, so that what they
      ! find on one set can be compared with another.
      if (self%has_stiffness .or. .not. compliance >= tiny(compliance)) return
      self%stiffness = 1.0_dp/compliance
      self%has_stiffness = .true.
      return
    end if
    if (self%depth > 0 .and. .not. self%is_close .and. (self%has_uniform .or. .not. zero_sum)) then
      if (space%everywhere(all(contact .eqv. self%contact))) return
    end if
    segments%space = space
    call segments%find(contact, info)
    self%is_extended = operator%extends_sets()
    if (self%is_extended .and. .not. info%failed()) call self%extended%set(operator, contact, info)
    if (self%depth == 1 .and. self%has_uniform .and. zero_sum .and. .not. info%failed()) then
      call keep_uniform(self, segments, contact)
      if (self%is_close) return
    end if
    self%is_close = .false.
    if (.not. info%failed()) call prepare_levels(self, operator, contact, info)
    self%has_uniform = zero_sum
    if (info%failed() .or. .not. zero_sum) return
    if (self%depth == 1) then
      call precondition_unit(self, operator, contact, info)
    else
      self%levels(1)%residual = self%levels(1)%weight
      call apply_levels(self%levels(:self%depth), self%forces, operator, self%uniform, self%coarse_share, info)
    end if
    if (info%failed()) return
    self%sum_of_uniform = sum_over(segments, self%uniform)
    if (segments%points > 0 .and. .not. self%sum_of_uniform > 0.0_dp) then
      call report(info, FUGE_ERR_NOT_DEFINITE, &
                  'the preconditioner of the operator is not positive definite: equal lengths ' &
                  //'on the contact set have the energy '//text(self%sum_of_uniform))
    end if
  end subroutine set

  !> Keep the forces `uniform` of a set for one that is close to it, if there is room for a residual and if
  !> their sum stays positive.
  subroutine keep_uniform(self, segments, contact)
    class(contact_preconditioner), intent(inout) :: self
    type(contact_segments), intent(in) :: segments
    logical, intent(in) :: contact(:)
    real(dp) :: total
    integer :: changed, stat

    changed = segments%space%total_count(count(contact .neqv. self%contact))
    self%is_close = real(changed, dp) <= CLOSE*real(segments%points, dp)
    if (.not. self%is_close) return
    stat = 0
    if (.not. allocated(self%centred)) allocate (self%centred(size(contact)), stat=stat)
    if (stat == 0) self%centred = 0.0_dp
    total = sum_over(segments, self%uniform)
    self%is_close = segments%space%everywhere(stat == 0) .and. total > 0.0_dp
    if (self%is_close) self%sum_of_uniform = total
  end subroutine keep_uniform

  !> After `set`, prepare for the rigid motions of the set; does little if it is close to that of the last time.
  !>
  !> `projection` and `segments` those of the set `contact` (n). Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE, those
  !> of `precondition`.
  subroutine set_modes(self, operator, projection, segments, contact, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(mode_projection), intent(in) :: projection
    type(contact_segments), intent(in) :: segments
    logical, intent(in) :: contact(:)
    type(fuge_info), intent(inout) :: info
    integer :: j, stat

    if (self%depth == 0) return
    if (self%rigid%fits(segments%space, projection%rank, contact, CLOSE)) then
      call self%rigid%measure(segments, stat)
      if (stat == 0) return
    end if
    self%rigid = rigid_images()
    stat = 0
    if (.not. allocated(self%centred)) allocate (self%centred(size(contact)), stat=stat)
    if (stat == 0) allocate (self%rigid%basis(size(contact), projection%rank), &
                             self%rigid%images(size(contact), projection%rank), &
                             self%rigid%contact(size(contact)), stat=stat)
    call require_memory(stat, 'the rigid motions of', size(contact), 'points', info)
    call segments%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    self%rigid%contact = contact
    do j = 1, projection%rank
      self%rigid%basis(:, j) = projection%basis(:, j)
      self%centred = merge(projection%basis(:, j), 0.0_dp, contact)
      call apply_unprojected(self, operator, segments, self%centred, self%rigid%images(:, j), info)
      if (info%failed()) return
    end do
    self%centred = 0.0_dp
    call self%rigid%measure(segments, stat)
    if (stat /= 0) call report(info, FUGE_ERR_NOT_DEFINITE, 'the preconditioner of the operator is not positive ' &
                               //'definite: rigid displacements of the contact set have no energy')
  end subroutine set_modes

  !> Forces on the contact set whose displacements are close to `residual`; projected to zero sum
  !> if `zero_sum`.
  !>
  !> `segments` those of the contact set; `residual` (n), length, zero off the set; `force` (n),
  !> undefined off the set; `energy` their inner product over the set. Errors: those of `precondition`.
  subroutine apply(self, operator, segments, zero_sum, residual, force, energy, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_segments), intent(in) :: segments
    logical, intent(in) :: zero_sum
    real(dp), intent(in), contiguous :: residual(:)
    real(dp), intent(inout), contiguous :: force(:)
    real(dp), intent(out) :: energy
    type(fuge_info), intent(inout) :: info
    real(dp) :: factor

    energy = 0.0_dp
    if (self%is_close .and. zero_sum) then
      call center(self, segments, residual)
      call precondition_on_set(self, operator, self%centred, force, info)
    else
      call apply_unprojected(self, operator, segments, residual, force, info)
    end if
    if (info%failed()) return
    if (self%depth == 0 .or. .not. zero_sum) then
      energy = dot_over(segments, residual, force)
      return
    end if
    factor = sum_over(segments, force)/self%sum_of_uniform
    call subtract_and_dot_over(segments, factor, self%uniform, force, residual, energy)
  end subroutine apply

  !> As `apply`, projected to forces without resultants in the modes of `projection`; after `set_modes`.
  subroutine apply_with_modes(self, operator, segments, projection, residual, force, energy, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_segments), intent(in) :: segments
    type(mode_projection), intent(in) :: projection
    real(dp), intent(in), contiguous :: residual(:)
    real(dp), intent(inout), contiguous :: force(:)
    real(dp), intent(out) :: energy
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: factors(:)
    real(dp) :: largest

    energy = 0.0_dp
    if (self%depth == 0) then
      call apply_unprojected(self, operator, segments, residual, force, info)
    else
      self%centred = residual
      call self%rigid%project_residual(segments, self%centred)
      call apply_unprojected(self, operator, segments, self%centred, force, info)
      if (.not. info%failed()) call self%rigid%project_force(segments, force)
    end if
    if (info%failed()) return
    ! Resultants left by rounding would add up.
    largest = max_abs_over(segments, force)
    allocate (factors(size(projection%basis, 2)))
    call projection%components(segments, force, factors)
    call projection%subtract_on(segments, factors, force)
    energy = dot_over(segments, residual, force)
    if (.not. energy < 0.0_dp) return
    if (abs(energy) <= ROUNDING*largest*max_abs_over(segments, residual)) energy = 0.0_dp
  end subroutine apply_with_modes

  !> The preconditioner of the set, without a projection. `residual` (n) is zero off the set, `force` (n) undefined
  !> there.
  subroutine apply_unprojected(self, operator, segments, residual, force, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: residual(:)
    real(dp), intent(inout), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info
    integer :: i

    if (self%depth == 1) then
      call precondition_on_set(self, operator, residual, force, info)
    else if (self%depth > 1) then
      call copy_values(residual, self%levels(1)%residual)
      call apply_levels(self%levels(:self%depth), self%forces, operator, force, self%coarse_share, info)
    else
      do i = 1, size(segments%first)
        associate (a => segments%first(i), b => segments%last(i))
          force(a:b) = self%stiffness*residual(a:b)
        end associate
      end do
    end if
  end subroutine apply_unprojected

  !> The residual less that mean for which `uniform` does no work: with the same projection before and after it the
  !> preconditioner is symmetric, whatever set `uniform` was computed for (doc/theory.md).
  subroutine center(self, segments, residual)
    class(contact_preconditioner), intent(inout), target :: self
    type(contact_segments), intent(in), target :: segments
    real(dp), intent(in), contiguous, target :: residual(:)
    type(value_pass) :: pass

    pass%mean = dot_over(segments, residual, self%uniform)/self%sum_of_uniform
    pass%segments => segments
    pass%source => residual
    pass%values => self%centred
    if (segments%are_in_one_chunk()) then
      call pass%do_chunk(1, 1, size(residual))
    else
      call pass%run(size(residual), 0)
    end if
  end subroutine center

  !> In loops, because array assignments between pointers go through a copy.
  subroutine give_values(self, k, first, last)
    class(value_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: i, j

    if (associated(self%contact)) then
      do j = first, last
        self%values(j) = merge(1.0_dp, 0.0_dp, self%contact(j))
      end do
    else if (associated(self%segments)) then
      do i = self%segments%before(k) + 1, self%segments%before(k + 1)
        do j = self%segments%first(i), self%segments%last(i)
          self%values(j) = self%source(j) - self%mean
        end do
      end do
    else
      do j = first, last
        self%values(j) = self%source(j)
      end do
    end if
  end subroutine give_values

  !> values = source, both (n).
  subroutine copy_values(source, values)
    real(dp), intent(in), contiguous, target :: source(:)
    real(dp), intent(inout), contiguous, target :: values(:)
    type(value_pass) :: pass

    if (chunk_count(size(values)) == 1) then
      values = source
      return
    end if
    pass%source => source
    pass%values => values
    call pass%run(size(values), 0)
  end subroutine copy_values

  !> Store the contact set; where it is many segments of a line of cells also create the levels that do not exist yet
  !> and count the contact points in their cells.
  subroutine prepare_levels(self, operator, contact, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: contact(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space
    integer :: n, stat

    n = operator%points()
    stat = 0
    if (.not. allocated(self%contact)) allocate (self%contact(n), self%uniform(n), stat=stat)
    if (stat == 0) self%contact = contact
    self%depth = 1
    space = operator%ranks()
    if (space%everywhere(stat == 0)) call find_levels(self, operator, contact, stat, info)
    call require_memory(stat, 'the preconditioner of', n, 'points', info)
    call space%agree(info)
    if (self%depth > 1 .and. .not. info%failed()) call count_contacts(self%levels(:self%depth), contact, info)
  end subroutine prepare_levels

  !> As many levels, self%depth, as the contact set needs; `stat` is not 0 without memory on this rank.
  subroutine find_levels(self, operator, contact, stat, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: contact(:)
    integer, intent(out) :: stat
    type(fuge_info), intent(inout) :: info
    type(shared_rows) :: rows
    type(point_space) :: space
    integer :: l, n

    stat = 0
    if (.not. any(operator%grid() == 1)) return
    call rows_of(operator, 0, rows, info)
    if (info%failed()) return
    if (count_segments(rows, contact) < MANY_SEGMENTS) return
    n = size(contact)
    space = operator%ranks()
    if (.not. allocated(self%levels)) then
      allocate (self%levels(MAX_LEVELS), self%forces(MAX_LEVELS), stat=stat)
      if (stat == 0) allocate (self%levels(1)%weight(n), self%levels(1)%residual(n), stat=stat)
      if (stat == 0) self%levels(1)%rows = rows
    end if
    do l = 2, MAX_LEVELS
      if (.not. space%everywhere(stat == 0)) return
      call create_level(operator, l, self%levels(l), self%forces(l), stat)
      if (.not. space%everywhere(stat == 0)) return
      if (.not. exists(self%levels(l))) exit
      self%depth = l
    end do
  end subroutine find_levels

  !> `uniform`: the preconditioner applied to 1 on the contact set and 0 elsewhere.
  subroutine precondition_unit(self, operator, contact, info)
    class(contact_preconditioner), intent(inout), target :: self
    class(fuge_operator), intent(in) :: operator
    logical, intent(in), contiguous, target :: contact(:)
    type(fuge_info), intent(inout) :: info
    type(value_pass) :: pass
    type(point_space) :: space
    real(dp), allocatable, target :: unit(:)
    integer :: stat

    allocate (unit(size(contact)), stat=stat)
    call require_memory(stat, 'the preconditioner of', size(contact), 'points', info)
    space = operator%ranks()
    call space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    pass%contact => contact
    pass%values => unit
    call pass%run(size(unit), 0)
    call precondition_on_set(self, operator, unit, self%uniform, info)
  end subroutine precondition_unit

  !> The operator's preconditioner on the present set: `residual` (n) is zero off the set, `force` (n) undefined there.
  subroutine precondition_on_set(self, operator, residual, force, info)
    class(contact_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in), contiguous :: residual(:)
    real(dp), intent(inout), contiguous :: force(:)
    type(fuge_info), intent(inout) :: info

    if (self%is_extended) then
      call self%extended%apply(operator, residual, force, info)
    else
      call precondition(operator, residual, force, info)
    end if
  end subroutine precondition_on_set

end module fuge_contact_preconditioner
