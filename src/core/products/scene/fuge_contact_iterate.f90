!> Forces on the points of a grid with their contact set, the displacements by them and their errors.
module fuge_contact_iterate
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_contact_segments, only: center_over, contact_segments, max_abs_over, sum_over
  use fuge_contact_step, only: deepest_penetration
  use fuge_kinds, only: dp
  use fuge_lanczos_values, only: lanczos_values
  use fuge_mode_projection, only: mode_projection
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator
  use fuge_point_chunks, only: chunk_count, chunked_pass
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: compute_displacement, deformed_gap, evaluate_iterate, find_least_magnitude, &
    find_penetration, is_accurate, largest_rigid_magnitude, overlap_at, project_residual, relative_error, &
    remove_rigid_part, rounding_force, start_iterate

  !> Gaps less rigid displacements may be rounded by this many units in the last place of their terms.
  real(dp), parameter, public :: RIGID_ROUNDINGS = 2.0_dp
  !> Displacements below this fraction of the gaps are rounding.
  real(dp), parameter :: NO_LENGTH = 1.0e-14_dp

  !> Forces with their contact set and their errors. Under a load, forces and lengths are divided
  !> by the load; with a prescribed motion they are not scaled.
  type, public :: contact_iterate
    !> Forces, (n); their sum is 1 unless the motion is prescribed.
    real(dp), allocatable :: force(:)
    !> Displacements by these forces, (n); without the operator's datum unless the motion is
    !> prescribed, and less the rigid displacement `rigid_motion` where there are modes.
    real(dp), allocatable :: displacement(:)
    !> The contact set, (n).
    logical, allocatable :: contact(:)
    !> The contact is at the upper stop, (n); allocated where points have one.
    logical, allocatable :: at_upper(:)
    !> Points whose force is at its limit of the lower stop, 1, or of the upper one, -1, else 0, (n): they are open, but
    !> have a force. Allocated where forces have limits.
    integer, allocatable :: limited(:)
    !> The rigid motion: the mean of gap plus displacement over the contact set; 0 if prescribed.
    real(dp) :: motion = 0.0_dp
    !> Motions in the modes of the scene, (m); allocated where it has any.
    real(dp), allocatable :: rigid_motion(:)
    !> Largest magnitude of gap plus displacement less motion on the contact set.
    real(dp) :: residual_norm = huge(1.0_dp)
    !> With modes: the largest residual norm since the last projection of the residual.
    real(dp) :: unprojected = 0.0_dp
    !> Deepest penetration of an open point, 0 if none penetrates.
    real(dp) :: penetration = 0.0_dp
    !> Residuals are compared with this length: the least magnitude at a contact point, as in the
    !> certificate (|gap less rigid motion| plus the magnitude of the displacement).
    real(dp) :: least_magnitude = 0.0_dp
    !> The largest magnitude of a displacement at a contact point, as the certificate forms it.
    real(dp) :: largest_magnitude = 0.0_dp
    !> Lengths up to this are rounding of the gaps and of rigid displacements, beside which there may be no others; 0
    !> where there are no modes.
    real(dp) :: rounding = 0.0_dp
    !> Tensions up to this are rounding.
    real(dp) :: tension_noise = 0.0_dp
    !> The largest displacement by forces of size 1, as far as it has been needed; 0 before; length per force.
    real(dp) :: softness = 0.0_dp
    !> Forces of the set that store no energy grow without bound, so that there is no solution.
    logical :: unbounded = .false.
    !> The greater of residual norm and penetration over the least magnitude, for the forces to start from; negative
    !> before that is known.
    real(dp) :: start_error = -1.0_dp
    !> run_projected_gradients has reduced the residual to its tolerance.
    logical :: converged = .false.
    !> The least compliance of this contact set that conjugate gradients have found, length per force: the smallest
    !> value of `lanczos` over `amplification`; 0 before any step.
    real(dp) :: least_compliance = 0.0_dp
    !> The largest preconditioned residual over the largest residual, of one that is nearly small enough; force per
    !> length; 0 before any step.
    real(dp) :: amplification = 0.0_dp
    !> The coefficients of the conjugate gradients of the last call that made steps.
    type(lanczos_values) :: lanczos = lanczos_values()
    !> The rigid motions on the contact set.
    type(mode_projection) :: projection = mode_projection()
    !> The segments of the contact set.
    type(contact_segments) :: segments = contact_segments()
    !> Gap plus displacement less motion, and the search direction (force), (n); both are zero off
    !> the contact set.
    real(dp), allocatable :: residual(:), direction(:)
    !> Forces at the start of the last run of conjugate gradients, (n); allocated where they may grow without bound.
    real(dp), allocatable :: start(:)
    !> In turn the preconditioned residual and the displacement by `direction`, (n).
    real(dp), allocatable :: work(:)
  end type contact_iterate

  !> A pass over the points of an iterate, of which one chunk takes no more than its loop.
  type, extends(chunked_pass), public :: iterate_pass
    type(contact_scene), pointer :: scene => null()
    type(contact_iterate), pointer :: iterate => null()
    !> A number that the operation needs.
    real(dp) :: value = 0.0_dp
    procedure(chunk_operation), pointer, nopass :: operation => null()
  contains
    procedure :: go
    procedure :: do_chunk
  end type iterate_pass

  !> Finds the sum of the forces, then adds `shift` to the displacements.
  type, extends(chunked_pass) :: datum_pass
    real(dp), pointer, contiguous :: force(:) => null(), displacement(:) => null()
    real(dp) :: shift = 0.0_dp
  contains
    procedure :: do_chunk => do_datum
  end type datum_pass

  abstract interface
    !> Chunk `k`, the points `first` .. `last`; what it finds is added to `found`, which is zero before, or raises it.
    subroutine chunk_operation(pass, k, first, last, found)
      import :: dp, iterate_pass
      class(iterate_pass), intent(inout) :: pass
      integer, intent(in) :: k, first, last
      real(dp), intent(inout) :: found(:)
    end subroutine chunk_operation
  end interface

contains

  !> Do `operation` on all chunks. `found`: `sums` sums over the chunks, then maxima.
  subroutine go(self, operation, sums, found)
    class(iterate_pass), intent(inout) :: self
    procedure(chunk_operation) :: operation
    integer, intent(in) :: sums
    real(dp), intent(out) :: found(:)
    integer :: i, n

    ! Where only search directions count, there are no forces.
    if (allocated(self%iterate%force)) then
      n = size(self%iterate%force)
    else
      n = size(self%iterate%work)
    end if
    if (chunk_count(n) == 1) then
      found = 0.0_dp
      call operation(self, 1, 1, n, found)
      return
    end if
    self%operation => operation
    call self%run(n, size(found))
    do i = 1, size(found)
      if (i <= sums) then
        found(i) = self%total(i)
      else
        found(i) = self%largest(i)
      end if
    end do
  end subroutine go

  subroutine do_chunk(self, k, first, last)
    class(iterate_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    call self%operation(self, k, first, last, self%found(:, k))
  end subroutine do_chunk

  !> Allocate all arrays for the points of a scene and set the forces to start from: `start` (n), scaled as in
  !> contact_iterate, if there are any; else equal forces, or none if the motion is prescribed, or the least forces
  !> that have the resultants. Errors: FUGE_ERR_MEMORY.
  subroutine start_iterate(iterate, scene, start, info)
    type(contact_iterate), intent(inout) :: iterate
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in), optional :: start(:)
    type(fuge_info), intent(inout) :: info
    integer :: n, stat

    n = size(scene%gap)
    allocate (iterate%force(n), iterate%displacement(n), iterate%contact(n), iterate%residual(n), &
              iterate%direction(n), iterate%work(n), stat=stat)
    if (stat == 0 .and. allocated(scene%play)) allocate (iterate%at_upper(n), stat=stat)
    if (stat == 0 .and. scene%has_limits()) allocate (iterate%limited(n), stat=stat)
    if (stat == 0 .and. scene%prescribed) allocate (iterate%start(n), stat=stat)
    if (stat == 0 .and. allocated(scene%modes)) allocate (iterate%rigid_motion(size(scene%load)), stat=stat)
    call require_memory(stat, 'the work space of', n, 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    iterate%segments%space = scene%rows%point_space
    if (allocated(iterate%at_upper)) iterate%at_upper = .false.
    if (allocated(iterate%limited)) then
      iterate%limited = 0
      ! Where the start puts all points at their limits, their distances are needed before the first product.
      iterate%displacement = 0.0_dp
    end if
    if (present(start)) then
      iterate%force = start
    else if (allocated(scene%modes)) then
      call find_least_forces(scene, iterate, info)
    else if (scene%prescribed) then
      iterate%force = 0.0_dp
    else
      iterate%force = 1.0_dp/real(scene%points(), dp)
    end if
  end subroutine start_iterate

  !> The least forces at the points that take part, of either sign, that have the resultants.
  subroutine find_least_forces(scene, iterate, info)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    logical :: possible

    iterate%contact = .true.
    if (allocated(scene%excluded)) iterate%contact = .not. scene%excluded
    iterate%force = 0.0_dp
    call iterate%segments%find(iterate%contact, info)
    if (.not. info%failed()) call iterate%projection%set(scene%modes, iterate%segments, info)
    if (.not. info%failed()) call iterate%projection%correct_resultants(scene%modes, scene%load, iterate%segments, &
                                                                        iterate%force, possible)
  end subroutine find_least_forces

  !> Evaluate motion, residual, penetration and least magnitude from the forces, displacements and
  !> contact set of `iterate`, whose forces are feasible. Error: FUGE_ERR_MEMORY.
  subroutine evaluate_iterate(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info

    call iterate%segments%find(iterate%contact, info)
    if (info%failed()) return
    call set_residual(scene, iterate)
    iterate%motion = 0.0_dp
    ! The projection of large numbers is rounded: the second one removes what is left.
    call project_residual(scene, iterate)
    call project_residual(scene, iterate)
    iterate%penetration = find_penetration(scene, iterate)
    call find_least_magnitude(operator, scene, iterate, info)
    if (info%failed()) return
    if (iterate%start_error < 0.0_dp) iterate%start_error = relative_error(iterate)
  end subroutine evaluate_iterate

  !> The greater of residual norm and penetration over the least magnitude; huge where that is zero.
  pure function relative_error(iterate) result(error)
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: error

    error = max(iterate%residual_norm, iterate%penetration)
    if (error > 0.0_dp) then
      if (iterate%least_magnitude > 0.0_dp .and. error < iterate%least_magnitude*sqrt(huge(error))) then
        error = error/iterate%least_magnitude
      else
        error = huge(error)
      end if
    end if
  end function relative_error

  !> Gap plus displacement less the stop, before rigid motions are subtracted.
  subroutine set_residual(scene, iterate)
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(inout), target :: iterate
    type(iterate_pass) :: pass
    real(dp) :: none(0)

    pass%scene => scene
    pass%iterate => iterate
    call pass%go(set_residuals, 0, none)
  end subroutine set_residual

  !> The residuals of a chunk. Finds nothing.
  subroutine set_residuals(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: end_before, i, j

    found = 0.0_dp
    associate (scene => pass%scene, iterate => pass%iterate, segments => pass%iterate%segments)
      end_before = first - 1
      do i = segments%before(k) + 1, segments%before(k + 1)
        iterate%residual(end_before + 1:segments%first(i) - 1) = 0.0_dp
        end_before = segments%last(i)
        ! A loop, because array assignments between components of pointers go through a copy.
        do j = segments%first(i), end_before
          iterate%residual(j) = scene%gap(j) + iterate%displacement(j)
        end do
      end do
      iterate%residual(end_before + 1:last) = 0.0_dp
      if (.not. allocated(scene%play)) return
      do i = first, last
        if (iterate%contact(i) .and. iterate%at_upper(i)) iterate%residual(i) = iterate%residual(i) - scene%play(i)
      end do
    end associate
  end subroutine set_residuals

  !> Move the rigid part of the residual into the motion, unless that is prescribed: left in the
  !> residual, its rounding error would grow and swamp the rest.
  subroutine project_residual(scene, iterate)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    real(dp), allocatable :: factors(:)
    real(dp) :: mean

    if (allocated(scene%modes)) then
      allocate (factors(size(scene%load)))
      call iterate%projection%components(iterate%segments, iterate%residual, factors)
      call iterate%projection%subtract_on(iterate%segments, factors, iterate%residual)
      call iterate%projection%subtract(factors, iterate%displacement)
      iterate%rigid_motion = iterate%rigid_motion + iterate%projection%motion(factors)
      iterate%residual_norm = max_abs_over(iterate%segments, iterate%residual)
      iterate%unprojected = iterate%residual_norm
      return
    end if
    mean = 0.0_dp
    if (.not. scene%prescribed) mean = sum_over(iterate%segments, iterate%residual)/real(iterate%segments%points, dp)
    call center_over(iterate%segments, mean, iterate%residual, iterate%residual_norm)
    iterate%motion = iterate%motion + mean
  end subroutine project_residual

  !> Subtract from `values` (n), on the contact set, their components in the free rigid motions: with modes in those of
  !> the set, of which `projection` is the basis, else in the translation unless it is prescribed.
  subroutine remove_rigid_part(scene, projection, segments, values)
    type(contact_scene), intent(in) :: scene
    type(mode_projection), intent(in) :: projection
    type(contact_segments), intent(in) :: segments
    real(dp), intent(inout), contiguous :: values(:)
    real(dp), allocatable :: factors(:)
    real(dp) :: mean, largest_ignored

    if (allocated(scene%modes)) then
      allocate (factors(size(scene%load)))
      call projection%components(segments, values, factors)
      call projection%subtract_on(segments, factors, values)
    else if (.not. scene%prescribed) then
      mean = sum_over(segments, values)/real(segments%points, dp)
      call center_over(segments, mean, values, largest_ignored)
    end if
  end subroutine remove_rigid_part

  !> The deepest penetration of an open point, through either stop; 0 if none penetrates.
  function find_penetration(scene, iterate) result(depth)
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(in), target :: iterate
    real(dp) :: depth
    type(iterate_pass) :: pass
    real(dp) :: deepest(1)

    if (.not. allocated(scene%play)) then
      depth = deepest_penetration(iterate%segments, scene%gap, iterate%motion, iterate%displacement)
      return
    end if
    pass%scene => scene
    pass%iterate => iterate
    if (scene%has_limits()) then
      call pass%go(find_overlaps, 0, deepest)
      depth = scene%rows%largest(deepest(1))
    else
      depth = deepest_penetration(iterate%segments, scene%gap, iterate%motion, iterate%displacement)
      call pass%go(penetrate_upper_stops, 0, deepest)
      depth = scene%rows%largest(max(depth, deepest(1)))
    end if
  end function find_penetration

  !> Found: the largest overlap of a point that is not in contact.
  subroutine find_overlaps(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) return
    do i = first, last
      if (.not. pass%iterate%contact(i)) found(1) = max(found(1), overlap_at(pass%scene, pass%iterate, i))
    end do
  end subroutine find_overlaps

  !> Found: the deepest penetration of an open point through its upper stop.
  subroutine penetrate_upper_stops(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) return
    associate (scene => pass%scene, iterate => pass%iterate)
      do i = first, last
        if (iterate%contact(i) .or. scene%play(i) >= huge(1.0_dp) .or. scene%gap(i) >= OUT_OF_REACH) cycle
        found(1) = max(found(1), deformed_gap(scene%gap(i), iterate%displacement(i), iterate%motion) - scene%play(i))
      end do
    end associate
  end subroutine penetrate_upper_stops

  !> How far point `k`, which is not in contact, is on the wrong side of a stop, where forces have limits: an open point
  !> beyond it, one at its limit before it; not positive if it is not.
  pure function overlap_at(scene, iterate, k) result(overlap)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    real(dp) :: overlap
    real(dp) :: gap

    overlap = 0.0_dp
    if (scene%gap(k) >= OUT_OF_REACH) return
    gap = deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion)
    select case (iterate%limited(k))
    case (1)
      overlap = gap
    case (-1)
      overlap = scene%play(k) - gap
    case default
      if (scene%limit(k) > 0.0_dp) overlap = -gap
      if (scene%play(k) < huge(gap)) overlap = max(overlap, gap - scene%play(k))
    end select
  end function overlap_at

  !> The least magnitude as the certificate forms it, over the contact points: the size of the gap less the rigid
  !> displacement plus the magnitude of the elastic one. Without contact 0, because nothing is rounded. Error:
  !> FUGE_ERR_MEMORY.
  subroutine find_least_magnitude(operator, scene, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: elastic(:)
    real(dp) :: offset

    if (scene%prescribed .or. allocated(scene%modes)) call new_lengths(scene, elastic, info)
    if (info%failed()) return
    offset = 0.0_dp
    ! As in the certificate, without the displacement by the datum, which cancels against the motion.
    if (scene%counts_datum()) offset = operator%datum()*scene%rows%total(sum(iterate%force))
    if (allocated(scene%modes)) then
      iterate%rounding = RIGID_ROUNDINGS*epsilon(offset)*largest_rigid_magnitude(scene, iterate)
      call add_magnitudes(operator, scene, offset, iterate, elastic, info)
      if (info%failed()) return
      iterate%least_magnitude = least_over(iterate%segments, iterate%work)
    else if (scene%prescribed) then
      elastic = iterate%displacement - offset
      call operator%magnitude(iterate%force, elastic, iterate%work)
      iterate%least_magnitude = least_sum(scene, iterate, offset)
    else
      call operator%magnitude(iterate%force, iterate%displacement, iterate%work)
      iterate%least_magnitude = least_sum(scene, iterate, -iterate%motion)
    end if
    iterate%largest_magnitude = max_abs_over(iterate%segments, iterate%work)
  end subroutine find_least_magnitude

  !> Room for a length at each point, (n). Error: FUGE_ERR_MEMORY.
  subroutine new_lengths(scene, lengths, info)
    type(contact_scene), intent(in) :: scene
    real(dp), allocatable, intent(out) :: lengths(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (lengths(size(scene%gap)), stat=stat)
    call require_memory(stat, 'the rigid motions of', size(scene%gap), 'points', info)
    call scene%rows%agree(info)
  end subroutine new_lengths

  !> The magnitudes of scenes with modes, in iterate%work (n). On return `elastic` (n) has the displacement without its
  !> rigid part. Error: FUGE_ERR_MEMORY.
  subroutine add_magnitudes(operator, scene, offset, iterate, elastic, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: offset
    type(contact_iterate), intent(inout) :: iterate
    real(dp), intent(out) :: elastic(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: rigid(:)
    integer :: j

    call new_lengths(scene, rigid, info)
    if (info%failed()) return
    rigid = 0.0_dp
    do j = 1, size(iterate%rigid_motion)
      rigid = rigid + iterate%rigid_motion(j)*scene%modes(:, j)
    end do
    elastic = (iterate%displacement + rigid) - offset
    call operator%magnitude(iterate%force, elastic, iterate%work)
    iterate%work = abs((scene%gap - rigid) + offset) + iterate%work
  end subroutine add_magnitudes

  !> The largest magnitude of a gap and a rigid displacement, the sum of their terms, on the contact set.
  function largest_rigid_magnitude(scene, iterate) result(largest)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: largest, rigid
    integer :: i, k

    largest = 0.0_dp
    rigid = abs(iterate%motion)
    do i = 1, size(iterate%segments%first)
      do k = iterate%segments%first(i), iterate%segments%last(i)
        if (allocated(scene%modes)) rigid = sum(abs(scene%modes(k, :)*iterate%rigid_motion))
        largest = max(largest, abs(scene%gap(k)) + rigid)
      end do
    end do
    largest = scene%rows%largest(largest)
  end function largest_rigid_magnitude

  !> Is the residual within `tolerance`, relative to the least magnitude, or rounding?
  pure function is_accurate(iterate, tolerance)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: tolerance
    logical :: is_accurate

    is_accurate = iterate%residual_norm <= tolerance*iterate%least_magnitude + iterate%rounding
  end function is_accurate

  !> The least of |gap + offset| + magnitude, iterate%work, over the segments, 0 if there are none.
  function least_sum(scene, iterate, offset) result(least)
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(in), target :: iterate
    real(dp), intent(in) :: offset
    real(dp) :: least
    type(iterate_pass) :: pass
    real(dp) :: found(1)

    pass%scene => scene
    pass%iterate => iterate
    pass%value = offset
    call pass%go(find_least_sum, 0, found)
    least = merge(-found(1), 0.0_dp, iterate%segments%points > 0)
    least = iterate%segments%space%least(least)
  end function least_sum

  !> Found: minus the least sum of a chunk.
  subroutine find_least_sum(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    real(dp) :: least
    integer :: i, j

    ! A rank without points must not lower the least sum of the others.
    found(1) = -huge(least)
    if (last < first) return
    least = huge(least)
    associate (segments => pass%iterate%segments, gap => pass%scene%gap, magnitude => pass%iterate%work)
      do i = segments%before(k) + 1, segments%before(k + 1)
        do j = segments%first(i), segments%last(i)
          least = min(least, abs(gap(j) + pass%value) + magnitude(j))
        end do
      end do
    end associate
    found(1) = -least
  end subroutine find_least_sum

  !> The least of `values` (n) over the segments, 0 if there are none.
  function least_over(segments, values) result(least)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: values(:)
    real(dp) :: least
    integer :: i

    least = merge(huge(least), 0.0_dp, segments%points > 0)
    do i = 1, size(segments%first)
      least = min(least, minval(values(segments%first(i):segments%last(i))))
    end do
    least = segments%space%least(least)
  end function least_over

  !> Forces up to this one are rounding: 0 if there is a load to compare them with; without one, the largest force that
  !> displaces nothing beside the gaps.
  function rounding_force(scene, iterate) result(rounding)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp) :: rounding
    real(dp) :: length

    rounding = 0.0_dp
    if (.not. scene%is_unloaded()) return
    rounding = tiny(rounding)
    length = maxval(abs(scene%gap), mask=scene%gap < OUT_OF_REACH)
    if (allocated(scene%play)) length = max(length, maxval(scene%play, mask=scene%play < huge(length) &
                                                           .and. scene%gap < OUT_OF_REACH))
    length = scene%rows%largest(length)
    if (.not. length > 0.0_dp) then
      ! Without lengths there are no forces.
      rounding = huge(rounding)
    else if (iterate%softness > 0.0_dp) then
      rounding = max(rounding, NO_LENGTH*(length/iterate%softness))
    end if
  end function rounding_force

  !> Displacements by `force`, both (n), and by the operator's datum if `with_datum`. Errors: those of the operator.
  subroutine compute_displacement(operator, with_datum, force, displacement, info)
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: with_datum
    real(dp), intent(in), contiguous :: force(:)
    real(dp), intent(inout), contiguous :: displacement(:)
    type(fuge_info), intent(inout) :: info
    type(point_space) :: space

    call multiply(operator, force, displacement, info)
    if (.not. with_datum .or. info%failed()) return
    space = operator%ranks()
    if (chunk_count(size(force)) == 1) then
      displacement = displacement + operator%datum()*space%total(sum(force))
    else
      call add_datum(operator%datum(), space, force, displacement)
    end if
  end subroutine compute_displacement

  !> Add to the displacements of several chunks those by the `datum`.
  subroutine add_datum(datum, space, force, displacement)
    real(dp), intent(in) :: datum
    type(point_space), intent(in) :: space
    real(dp), intent(in), contiguous, target :: force(:)
    real(dp), intent(inout), contiguous, target :: displacement(:)
    type(datum_pass) :: pass

    pass%force => force
    call pass%run(size(force), 1)
    pass%shift = datum*space%total(pass%total(1))
    pass%displacement => displacement
    call pass%run(size(force), 1)
  end subroutine add_datum

  subroutine do_datum(self, k, first, last)
    class(datum_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (associated(self%displacement)) then
      self%displacement(first:last) = self%displacement(first:last) + self%shift
    else
      self%found(1, k) = sum(self%force(first:last))
    end if
  end subroutine do_datum

  !> Gap of a point in the deformed state; negative where the point penetrates. Scaled as in
  !> contact_iterate.
  elemental function deformed_gap(reduced_gap, displacement, motion) result(gap)
    real(dp), intent(in) :: reduced_gap, displacement, motion
    real(dp) :: gap

    gap = (reduced_gap - motion) + displacement
  end function deformed_gap

end module fuge_contact_iterate
