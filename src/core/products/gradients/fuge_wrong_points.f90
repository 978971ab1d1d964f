!> Points in the wrong state: in contact although their force is beyond the range that the stop gives it, as one that
!> pulls away from it; open although they penetrate a stop; or at the limit of their force although the gap has come
!> back to the stop. How many there are, which are worst, and their exchange.
module fuge_wrong_points
  use fuge_conjugate_gradients, only: conjugate_gradients
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_set, only: contact_set, excess_of, leave_stop, return_to_stop
  use fuge_deformed_gaps, only: deformed_gap, is_below, overlap_at
  use fuge_iterate_pass, only: iterate_pass
  use fuge_kinds, only: dp
  use fuge_limited_points, only: choose_limited_contact
  use fuge_point_chunks, only: chunked_pass
  use fuge_shared_exchange, only: exchange_in_line
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: change_state, choose_contact, count_wrong_points, deepest_open_point, exchange_wrong_points, &
    greatest_tension, tension_is_decided

  !> Partial maxima are faster than one.
  integer, parameter :: LANES = 4

  !> Marks the wrong points of `iterate`, and measures its states or exchanges the wrong points.
  type, extends(chunked_pass) :: exchange_pass
    type(contact_scene), pointer :: scene => null()
    type(contact_iterate), pointer :: iterate => null()
    real(dp) :: noise = 0.0_dp
    logical, pointer, contiguous :: tensile(:) => null(), penetrating(:) => null()
    real(dp), pointer, contiguous :: measure(:) => null()
  contains
    procedure :: do_chunk => mark_and_exchange
  end type exchange_pass

contains

  !> The contact set that the forces to start from suggest; tied points always belong to it. Where a load must be
  !> carried and there are no such forces, as when the contact of the last solve is excluded now, it is every point that
  !> takes part.
  subroutine choose_contact(scene, set)
    type(contact_scene), intent(in), target :: scene
    type(contact_set), intent(inout), target :: set
    type(iterate_pass) :: pass
    real(dp) :: points(1)

    if (scene%has_limits()) then
      call choose_limited_contact(scene, set)
      return
    end if
    pass%scene => scene
    pass%set => set
    call pass%go(choose_points, size(scene%gap), 1, points)
    if (scene%prescribed) return
    if (scene%rows%anywhere(points(1) > 0.0_dp)) return
    set%contact = .true.
    if (allocated(scene%excluded)) set%contact = .not. scene%excluded
  end subroutine choose_contact

  !> Contact where forces suggest it. Found: the number of these points.
  subroutine choose_points(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) return
    associate (scene => pass%scene, contact => pass%set%contact, force => pass%set%force)
      contact(first:last) = force(first:last) > 0.0_dp
      if (allocated(scene%play)) then
        do i = first, last
          associate (at_upper => pass%set%at_upper(i))
            at_upper = force(i) < 0.0_dp .and. scene%play(i) < huge(1.0_dp) .and. .not. scene%is_tied(i)
            contact(i) = contact(i) .or. at_upper .or. scene%is_tied(i)
          end associate
        end do
      end if
      if (allocated(scene%excluded)) contact(first:last) = contact(first:last) .and. .not. scene%excluded(first:last)
      found(1) = real(count(contact(first:last)), dp)
    end associate
  end subroutine choose_points

  !> Number of points in the contact set whose force is beyond the range that the stop gives it, and of others that are
  !> on the wrong side of a stop by more than `noise`.
  function count_wrong_points(scene, noise, iterate) result(wrong)
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: noise
    type(contact_iterate), intent(in), target :: iterate
    integer :: wrong
    type(iterate_pass) :: pass
    real(dp) :: found(1)

    pass%scene => scene
    pass%iterate => iterate
    pass%value = noise
    call pass%go(count_in_chunk, size(scene%gap), 1, found)
    wrong = scene%rows%total_count(nint(found(1)))
  end function count_wrong_points

  !> Found: the number of wrong points; the value of the pass is the noise.
  subroutine count_in_chunk(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i, wrong

    if (k < 1) return
    wrong = 0
    associate (scene => pass%scene, iterate => pass%iterate)
      if (.not. allocated(scene%play)) then
        do i = first, last
          if (pulls_or_penetrates(iterate%contact(i), iterate%force(i), iterate%tension_noise, scene%gap(i), &
                                  iterate%displacement(i), iterate%motion, pass%value)) wrong = wrong + 1
        end do
      else
        do i = first, last
          if (is_wrong(scene, pass%value, iterate, i)) wrong = wrong + 1
        end do
      end if
    end associate
    found(1) = real(wrong, dp)
  end subroutine count_in_chunk

  !> Does a point with one stop pull, in contact, by more than `tension`, or penetrate, open, by more than `noise`?
  pure function pulls_or_penetrates(contact, force, tension, gap, displacement, motion, noise) result(wrong)
    logical, intent(in) :: contact
    real(dp), intent(in) :: force, tension, gap, displacement, motion, noise
    logical :: wrong

    wrong = merge(force < -tension, deformed_gap(gap, displacement, motion) < -noise, contact)
  end function pulls_or_penetrates

  !> Is the force of point `k`, in contact, beyond its range, or is the point, not in contact, on the wrong side of a
  !> stop by more than `noise`?
  pure function is_wrong(scene, noise, iterate, k)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: noise
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    logical :: is_wrong

    if (iterate%contact(k)) then
      is_wrong = excess_of(scene, iterate%contact_set, k, iterate%force(k)) > iterate%tension_noise
    else
      is_wrong = overlap_at(scene, iterate, k) > noise
    end if
  end function is_wrong

  !> Point `k`, in the wrong state, takes the neighbouring state.
  pure subroutine change_state(scene, k, iterate)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: k
    type(contact_iterate), intent(inout) :: iterate

    if (iterate%contact(k)) then
      call leave_stop(scene, k, iterate%contact_set)
    else
      call return_to_stop(scene, is_below(scene, iterate, k), k, iterate%contact_set)
    end if
  end subroutine change_state

  !> Each point in the wrong state, by more than `noise` if it is not in contact, takes the neighbouring state; with
  !> `extrapolate`, for forces without limits only, more points leave the contact set and fewer join it, as
  !> fuge_set_exchange explains. Error: FUGE_ERR_MEMORY.
  subroutine exchange_wrong_points(scene, noise, extrapolate, iterate, info)
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: noise
    logical, intent(in) :: extrapolate
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(exchange_pass) :: pass
    logical, allocatable, target :: tensile(:), penetrating(:)
    real(dp), allocatable, target :: measure(:)
    integer :: stat

    stat = 0
    ! Allocated here only: during the products the operator may need the memory.
    if (extrapolate) allocate (tensile(size(scene%gap)), penetrating(size(scene%gap)), measure(size(scene%gap)), &
                               stat=stat)
    call require_memory(stat, 'the contact set of', size(scene%gap), 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    pass%scene => scene
    pass%iterate => iterate
    pass%noise = noise
    if (extrapolate) then
      pass%tensile => tensile
      pass%penetrating => penetrating
      pass%measure => measure
    end if
    call pass%run(size(scene%gap), 0)
    if (.not. extrapolate) return
    call exchange_in_line(scene%rows, tensile, penetrating, measure, iterate%contact, info)
    if (info%failed()) return
    call keep_tied(scene, iterate%contact)
  end subroutine exchange_wrong_points

  !> Mark the tensile and the penetrating points of a chunk and measure their states, or exchange these points.
  subroutine mark_and_exchange(self, k, first, last)
    class(exchange_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: i
    logical :: wrong

    if (k < 1) return
    associate (scene => self%scene, iterate => self%iterate)
      do i = first, last
        if (.not. allocated(scene%play)) then
          wrong = pulls_or_penetrates(iterate%contact(i), iterate%force(i), iterate%tension_noise, scene%gap(i), &
                                      iterate%displacement(i), iterate%motion, self%noise)
        else
          wrong = is_wrong(scene, self%noise, iterate, i)
        end if
        if (associated(self%measure)) then
          self%tensile(i) = wrong .and. iterate%contact(i)
          self%penetrating(i) = wrong .and. .not. iterate%contact(i)
          self%measure(i) = measure_of(scene, iterate, i)
          if (self%penetrating(i) .and. allocated(scene%play)) iterate%at_upper(i) = .not. is_below(scene, iterate, i)
        else if (wrong) then
          call change_state(scene, i, iterate)
        end if
      end do
    end associate
  end subroutine mark_and_exchange

  !> The measure of exchange_extrapolated for point `k`: the force in contact, open the distance from the stop that the
  !> point is nearer to.
  pure function measure_of(scene, iterate, k) result(measure)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    integer, intent(in) :: k
    real(dp) :: measure

    if (iterate%contact(k)) then
      measure = iterate%force(k)
      if (.not. allocated(iterate%at_upper)) return
      if (iterate%at_upper(k)) measure = -measure
      return
    end if
    measure = deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion)
    if (.not. allocated(scene%play)) return
    if (scene%play(k) < huge(1.0_dp)) measure = min(measure, scene%play(k) - measure)
  end function measure_of

  !> Tied points that the extrapolation released come back.
  pure subroutine keep_tied(scene, contact)
    type(contact_scene), intent(in) :: scene
    logical, intent(inout) :: contact(:)
    integer :: k

    if (.not. allocated(scene%play)) return
    do k = 1, size(contact)
      if (.not. contact(k)) contact(k) = scene%is_tied(k)
    end do
  end subroutine keep_tied

  !> The point, of those not in contact and not locked, that is furthest on the wrong side of a stop, by more than
  !> `noise`; 0 if there is none, or where it is another rank's.
  function deepest_open_point(scene, iterate, noise, locked) result(deepest)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: noise
    logical, intent(in) :: locked(:)
    integer :: deepest
    real(dp) :: depth, greatest
    integer :: k

    deepest = 0
    greatest = noise
    do k = 1, size(scene%gap)
      if (iterate%contact(k) .or. locked(k)) cycle
      depth = overlap_at(scene, iterate, k)
      if (depth <= greatest) cycle
      deepest = k
      greatest = depth
    end do
    call scene%rows%keep_least(-greatest, deepest)
  end function deepest_open_point

  !> The greatest tension in the contact set, or excess of a force over its range; 0 if there is none.
  function greatest_tension(scene, set) result(tension)
    type(contact_scene), intent(in), target :: scene
    type(contact_set), intent(in), target :: set
    real(dp) :: tension
    type(iterate_pass) :: pass
    real(dp) :: greatest(1)

    pass%scene => scene
    pass%set => set
    call pass%go(find_tension, size(scene%gap), 0, greatest)
    tension = scene%rows%largest(greatest(1))
  end function greatest_tension

  !> Found: the greatest tension.
  subroutine find_tension(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) return
    associate (scene => pass%scene, set => pass%set)
      if (.not. allocated(scene%play)) then
        found(1) = max(0.0_dp, -minval(set%force(first:last)))
        return
      end if
      do i = first, last
        if (set%contact(i)) found(1) = max(found(1), excess_of(scene, set, i, set%force(i)))
      end do
      if (found(1) <= set%tension_noise) found(1) = 0.0_dp
    end associate
  end subroutine find_tension

  !> Are the forces accurate enough to tell which of them will be tensile: is their error below the fraction `decisive`
  !> of the greatest tension? The preconditioned residual, gradients%work, estimates their error.
  function tension_is_decided(scene, set, gradients, decisive) result(decided)
    type(contact_scene), intent(in), target :: scene
    type(contact_set), intent(in), target :: set
    type(conjugate_gradients), intent(in), target :: gradients
    real(dp), intent(in) :: decisive
    logical :: decided
    type(iterate_pass) :: pass
    real(dp) :: extremes(2)

    pass%scene => scene
    pass%set => set
    pass%gradients => gradients
    if (allocated(scene%play)) then
      call pass%go(find_errors_of_ranges, size(scene%gap), 0, extremes)
    else
      call pass%go(find_errors, size(scene%gap), 0, extremes)
    end if
    call scene%rows%raise(extremes)
    decided = extremes(1) <= decisive*extremes(2)
  end function tension_is_decided

  !> Found: the largest error of the forces of points that may have two stops or limits, and their greatest excess over
  !> their ranges without it.
  subroutine find_errors_of_ranges(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    integer :: i

    if (k < 1) return
    associate (scene => pass%scene, set => pass%set, gradients => pass%gradients)
      do i = first, last
        if (.not. set%contact(i)) cycle
        found(1) = max(found(1), abs(gradients%work(i)))
        found(2) = max(found(2), excess_of(scene, set, i, set%force(i) - gradients%work(i)))
      end do
    end associate
  end subroutine find_errors_of_ranges

  !> As find_errors_of_ranges, of points with one stop.
  subroutine find_errors(pass, k, first, last, found)
    class(iterate_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(inout) :: found(:)
    real(dp) :: force_error(LANES), tension(LANES), values(LANES)
    integer :: i, j

    if (last < first) return
    force_error = 0.0_dp
    tension = 0.0_dp
    associate (segments => pass%set%segments, work => pass%gradients%work, force => pass%set%force)
      do i = segments%before(k) + 1, segments%before(k + 1)
        associate (a => segments%first(i), b => segments%last(i))
          do j = a, b - LANES + 1, LANES
            values = abs(work(j:j + LANES - 1))
            force_error = merge(values, force_error, values > force_error)
            values = work(j:j + LANES - 1) - force(j:j + LANES - 1)
            tension = merge(values, tension, values > tension)
          end do
          do j = b - modulo(b - a + 1, LANES) + 1, b
            force_error(1) = max(force_error(1), abs(work(j)))
            tension(1) = max(tension(1), work(j) - force(j))
          end do
        end associate
      end do
    end associate
    found = [maxval(force_error), maxval(tension)]
  end subroutine find_errors

end module fuge_wrong_points
