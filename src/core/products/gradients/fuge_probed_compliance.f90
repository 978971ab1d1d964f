!> The least compliance of a contact set: by how little forces without resultants displace it.
!>
!> Conjugate gradients see only those forces that the residual requires. Where alpha is badly conditioned, or the start
!> was exact, others that hardly displace anything do not show, although they may be wrong by much. Random lengths
!> require all forces. Points that are open by no more than the equations are wrong, or than the gaps and motions are
!> rounded, may as well be in contact, and count.
module fuge_probed_compliance
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_conjugate_gradients, only: conjugate_gradients
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_preconditioner, only: contact_preconditioner
  use fuge_contact_scene, only: contact_scene, OUT_OF_REACH
  use fuge_contact_segments, only: add_scaled_over, contact_segments, dot_over, max_abs_over
  use fuge_contact_set, only: contact_set
  use fuge_deformed_gaps, only: deformed_gap, overlap_at
  use fuge_iterate_evaluation, only: remove_rigid_part
  use fuge_iteration_progress, only: tell_progress
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_null_direction, only: find_softness, softness_so_far, stores_no_energy
  use fuge_operator_type, only: fuge_operator
  use fuge_projected_gradients, only: precondition_residual
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: probe_compliance

  !> Points touch if they are open by no more than this many times the error of the equations.
  real(dp), parameter :: WITHIN = 4.0_dp
  !> The smallest value of Lanczos is looked at after FIRST_LOOK steps, then after every STRIDE more, up to MOST_STEPS.
  integer, parameter :: FIRST_LOOK = 2, STRIDE = 3
  integer, parameter :: MOST_STEPS = 60
  !> The monitor hears of a long search once in this many steps.
  integer, parameter :: STEPS_OF_A_REPORT = 10
  !> The smallest value has settled if it is above this fraction of the one before.
  real(dp), parameter :: SETTLED = 0.7_dp

  !> Conjugate gradients for random lengths, and the points that they are on.
  type :: compliance_probe
    type(contact_set) :: set
    type(conjugate_gradients) :: gradients
  end type compliance_probe

contains

  !> The least `compliance` of the contact set, length per force: that of iterate%gradients, or less if conjugate
  !> gradients find less for random lengths on the points that touch; the least positive number where the operator is
  !> singular there.
  !>
  !> `rounding` is the length that rounding leaves open of gaps and motions. A few products, none where the forces
  !> follow from equilibrium alone, at most MOST_STEPS and one more; `monitor` may cancel. Errors: FUGE_ERR_MEMORY,
  !> FUGE_ERR_CANCELLED, those of the operator.
  subroutine probe_compliance(operator, scene, rounding, monitor, iterate, compliance, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: rounding
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(out) :: compliance
    type(fuge_info), intent(inout) :: info
    type(contact_preconditioner) :: preconditioner
    type(compliance_probe) :: probe
    real(dp) :: value

    compliance = iterate%gradients%least_compliance
    value = -1.0_dp
    call start_probe(scene, rounding, iterate, probe, info)
    if (info%failed() .or. follow_from_equilibrium(scene, probe%set)) return
    call preconditioner%set(operator, probe%set%contact, .not. scene%prescribed, maxval(abs(iterate%displacement)), &
                            info)
    if (allocated(scene%modes) .and. .not. info%failed()) then
      call preconditioner%set_modes(operator, probe%set%projection, probe%set%segments, probe%set%contact, info)
    end if
    if (.not. info%failed()) call find_smallest_value(operator, scene, iterate, monitor, preconditioner, probe, value, &
                                                      info)
    if (info%failed() .or. value < 0.0_dp) return
    value = max(value, tiny(value))
    if (compliance > 0.0_dp) value = min(value, compliance)
    compliance = value
  end subroutine probe_compliance

  !> The points that `touch` (n): the contact set, and those whose distance from a stop is within the error of the
  !> equations and the `rounding` of gaps and motions.
  subroutine mark_possible_contact(scene, rounding, iterate, touch)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: rounding
    type(contact_iterate), intent(in) :: iterate
    logical, intent(out) :: touch(:)
    real(dp) :: open, gap
    integer :: k
    logical :: limits

    limits = scene%has_limits()
    touch = iterate%contact
    associate (lengths => iterate%lengths)
      open = WITHIN*(max(lengths%residual_norm, lengths%penetration) + lengths%rounding &
                     + epsilon(open)*lengths%largest_magnitude) + rounding
    end associate
    do k = 1, size(touch)
      if (touch(k) .or. scene%gap(k) >= OUT_OF_REACH) cycle
      if (limits) then
        ! The force of a point that has given way is known.
        if (iterate%limited(k) /= 0) then
          touch(k) = overlap_at(scene, iterate, k) >= -open
          cycle
        end if
      end if
      gap = deformed_gap(scene%gap(k), iterate%displacement(k), iterate%motion)
      touch(k) = gap <= open
      if (allocated(scene%play)) touch(k) = touch(k) .or. gap >= scene%play(k) - open
    end do
  end subroutine mark_possible_contact

  !> Are the forces of the set those of equilibrium alone, whatever the operator?
  pure function follow_from_equilibrium(scene, set) result(follow)
    type(contact_scene), intent(in) :: scene
    type(contact_set), intent(in) :: set
    logical :: follow
    integer :: resultants

    resultants = merge(0, 1, scene%prescribed)
    if (allocated(scene%modes)) resultants = set%projection%rank
    follow = set%segments%points <= resultants
  end function follow_from_equilibrium

  !> Random lengths on the points that touch, less the rigid motion in them. `rounding` as for `probe_compliance`.
  !> Error: FUGE_ERR_MEMORY.
  subroutine start_probe(scene, rounding, iterate, probe, info)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: rounding
    type(contact_iterate), intent(in) :: iterate
    type(compliance_probe), intent(inout) :: probe
    type(fuge_info), intent(inout) :: info
    integer(int64) :: seed
    integer :: k, n, stat

    n = size(iterate%contact)
    associate (set => probe%set, gradients => probe%gradients)
      allocate (gradients%residual(n), gradients%direction(n), gradients%work(n), set%contact(n), stat=stat)
      call require_memory(stat, 'the estimated error of', n, 'forces', info)
      call scene%rows%agree(info)
      if (stat /= 0 .or. info%failed()) return
      gradients%softness = iterate%gradients%softness
      if (.not. gradients%softness > 0.0_dp) then
        gradients%softness = softness_so_far(scene, iterate%force, iterate%displacement)
      end if
      call mark_possible_contact(scene, rounding, iterate, set%contact)
      set%segments%space = scene%rows%point_space
      call set%segments%find(set%contact, info)
      if (allocated(scene%modes) .and. .not. info%failed()) call set%projection%set(scene%modes, set%segments, info)
      if (info%failed()) return
      gradients%direction = 0.0_dp
      ! The minimal standard generator (S. K. Park, K. W. Miller, Communications of the ACM 31, 1988).
      ! Ranks have lengths of their own.
      seed = 1043618065_int64 + scene%rows%number()
      do k = 1, n
        seed = mod(16807_int64*seed, 2147483647_int64)
        gradients%residual(k) = merge(2.0_dp*real(seed, dp)/2147483647.0_dp - 1.0_dp, 0.0_dp, set%contact(k))
      end do
      call remove_rigid_part(scene, set, gradients%residual)
    end associate
  end subroutine start_probe

  !> Conjugate gradients from the random lengths on, until the smallest value of Lanczos has settled: the compliance
  !> that it stands for, 0 where the operator is singular, negative where no lengths are left. Of a long search
  !> `monitor` hears as of one more iteration on `iterate`, and may cancel. Errors: those of the
  !> operator and of its preconditioner, FUGE_ERR_MEMORY, FUGE_ERR_CANCELLED.
  subroutine find_smallest_value(operator, scene, iterate, monitor, preconditioner, probe, value, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(in) :: iterate
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_preconditioner), intent(inout) :: preconditioner
    type(compliance_probe), intent(inout) :: probe
    real(dp), intent(out) :: value
    type(fuge_info), intent(inout) :: info
    real(dp) :: amplification, curvature, energy, first, last, previous
    integer :: step

    last = huge(last)
    previous = 1.0_dp
    value = -1.0_dp
    associate (set => probe%set, gradients => probe%gradients)
      do step = 1, MOST_STEPS
        call precondition_residual(operator, scene, preconditioner, set, gradients, energy, info)
        if (info%failed()) return
        if (step == 1) then
          if (.not. energy > 0.0_dp) return
          first = energy
          amplification = max_abs_over(set%segments, gradients%work)/max_abs_over(set%segments, gradients%residual)
        end if
        ! Without energy left only rounding would follow.
        if (.not. energy > epsilon(first)*first) exit
        call add_scaled_over(set%segments, energy/previous, gradients%work, gradients%direction)
        call compute_displacement(operator, scene%counts_datum(), gradients%direction, gradients%work, info)
        if (.not. info%failed()) call find_softness(operator, scene, set%segments, iterate%force, &
                                                    iterate%displacement, gradients, info)
        value = 0.0_dp
        if (info%failed()) return
        curvature = dot_over(set%segments, gradients%direction, gradients%work)
        if (.not. curvature > 0.0_dp) return
        if (stores_no_energy(set%segments, gradients, curvature)) return
        call gradients%lanczos%add(energy/curvature, energy/previous)
        previous = energy
        if (modulo(step, STRIDE) == FIRST_LOOK) then
          value = gradients%lanczos%smallest()
          if (value > SETTLED*last) exit
          last = value
        end if
        if (modulo(step, STEPS_OF_A_REPORT) == 0) then
          call tell_progress(scene, iterate, monitor, info)
          if (info%failed()) return
        end if
        call subtract_over(set%segments, energy/curvature, gradients%work, gradients%residual)
        call remove_rigid_part(scene, set, gradients%residual)
      end do
      value = gradients%lanczos%smallest()/amplification
    end associate
  end subroutine find_smallest_value

  !> Subtract `factor` times `change` from `lengths`, both (n), on the set.
  pure subroutine subtract_over(segments, factor, change, lengths)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: change(:)
    real(dp), intent(inout), contiguous :: lengths(:)
    integer :: i

    do i = 1, size(segments%first)
      associate (a => segments%first(i), b => segments%last(i))
        lengths(a:b) = lengths(a:b) - factor*change(a:b)
      end associate
    end do
  end subroutine subtract_over

end module fuge_probed_compliance
