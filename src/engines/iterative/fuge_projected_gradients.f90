!> Projected, preconditioned conjugate gradients on a given contact set.
!>
!> Only the forces of the set change. Under a load their sum is kept and the gaps of the set become
!> equal, their common value being the rigid motion; with a prescribed motion the gaps become zero.
module fuge_projected_gradients
  use fuge_contact_preconditioner, only: contact_preconditioner
  use fuge_contact_segments, only: center_over, contact_segments, dot_and_sum_over, max_abs_over, sum_over
  use fuge_contact_step, only: deepest_penetration, step_over
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  public :: compute_displacement, deformed_gap, evaluate_iterate, run_projected_gradients, start_iterate

  !> The contact set can be judged once the errors of the forces are below this fraction of the
  !> largest tension, or those of the gaps below this fraction of the deepest penetration.
  real(dp), parameter :: DECISIVE = 0.2_dp
  !> Exact conjugate gradients need as many iterations as there are points; rounded ones
  !> several times as many where alpha is badly conditioned.
  integer, parameter :: ITERATIONS_PER_POINT = 10
  integer, parameter :: EXTRA_ITERATIONS = 20
  !> Upper limit in any case: an operator that needs more needs a preconditioner.
  integer, parameter :: MAX_ITERATIONS = 20000
  !> Partial maxima are faster than one.
  integer, parameter :: LANES = 4
  !> A negative energy below this fraction of the magnitude of its terms is rounding.
  real(dp), parameter :: ROUNDING = 1.0e-10_dp

  !> Forces with their contact set and their errors. Under a load, forces and lengths are divided
  !> by the load; with a prescribed motion they are not scaled.
  type, public :: contact_iterate
    !> Forces, (n); their sum is 1 unless the motion is prescribed.
    real(dp), allocatable :: force(:)
    !> Displacements by these forces, (n); without the operator's datum unless the motion is
    !> prescribed.
    real(dp), allocatable :: displacement(:)
    !> The contact set, (n).
    logical, allocatable :: contact(:)
    !> The rigid motion is prescribed and already subtracted from the gaps.
    logical :: prescribed = .false.
    !> The rigid motion: the mean of gap plus displacement over the contact set; 0 if prescribed.
    real(dp) :: motion = 0.0_dp
    !> Largest magnitude of gap plus displacement less motion on the contact set.
    real(dp) :: residual_norm = huge(1.0_dp)
    !> Deepest penetration of an open point, 0 if none penetrates.
    real(dp) :: penetration = 0.0_dp
    !> Residuals are compared with this length: the least magnitude at a contact point, as in the
    !> certificate (|gap less rigid motion| plus the magnitude of the displacement).
    real(dp) :: least_magnitude = 0.0_dp
    !> Did run_projected_gradients reduce the residual to its tolerance?
    logical :: converged = .false.
    !> The segments of the contact set.
    type(contact_segments), private :: segments = contact_segments()
    !> Gap plus displacement less motion, and the search direction (force), (n); both are zero off
    !> the contact set.
    real(dp), allocatable, private :: residual(:), direction(:)
    !> In turn the preconditioned residual and the displacement by `direction`, (n).
    real(dp), allocatable, private :: work(:)
  end type contact_iterate

contains

  !> Allocate all arrays for n points and set the forces to start from: `start` (n), scaled as in
  !> contact_iterate, if it is allocated; else equal forces, or none if the motion is prescribed.
  !> Error: FUGE_ERR_MEMORY.
  pure subroutine start_iterate(iterate, n, prescribed, start, info)
    type(contact_iterate), intent(inout) :: iterate
    integer, intent(in) :: n
    logical, intent(in) :: prescribed
    real(dp), intent(in), allocatable :: start(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (iterate%force(n), iterate%displacement(n), iterate%contact(n), iterate%residual(n), &
              iterate%direction(n), iterate%work(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the work space of '//text(n)//' points')
      return
    end if
    iterate%prescribed = prescribed
    if (allocated(start)) then
      iterate%force = start
    else if (prescribed) then
      iterate%force = 0.0_dp
    else
      iterate%force = 1.0_dp/real(n, dp)
    end if
  end subroutine start_iterate

  !> Iterate towards the forces for which the gaps of the contact set are equal, or zero if the
  !> motion is prescribed.
  !>
  !> `reduced_gap` (n) scaled as in contact_iterate; `iterate` in: forces, displacements and
  !> contact set; out: new forces and displacements (the latter by recurrence). Ends when the
  !> residual norm is at most `tolerance` times the least magnitude (then iterate%converged);
  !> unless `to_tolerance`, already when the residual is small enough to tell which points are
  !> in tension and which penetrate; or when only rounding is left, or at the limit of
  !> iterations. Errors: those of the operator, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_MEMORY.
  subroutine run_projected_gradients(operator, preconditioner, reduced_gap, tolerance, to_tolerance, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_preconditioner), intent(inout) :: preconditioner
    real(dp), intent(in), contiguous :: reduced_gap(:)
    real(dp), intent(in) :: tolerance
    logical, intent(in) :: to_tolerance
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: energy, previous, step_length
    integer :: iteration, limit
    logical :: preconditioned

    iterate%converged = .false.
    preconditioned = operator%has_preconditioner()
    call evaluate_iterate(operator, reduced_gap, iterate, info)
    if (info%failed()) return
    limit = min(ITERATIONS_PER_POINT*min(iterate%segments%points, MAX_ITERATIONS) + EXTRA_ITERATIONS, MAX_ITERATIONS)
    iterate%direction = 0.0_dp
    previous = 1.0_dp
    do iteration = 0, limit
      iterate%converged = iterate%residual_norm <= tolerance*iterate%least_magnitude
      if (iterate%converged .or. iteration == limit) return
      if (iteration > 0 .and. .not. to_tolerance) then
        if (iterate%residual_norm <= DECISIVE*iterate%penetration) return
      end if
      call preconditioner%apply(operator, iterate%segments, .not. iterate%prescribed, iterate%residual, iterate%work, &
                                energy, info)
      if (info%failed()) return
      if (iteration > 0 .and. preconditioned .and. .not. to_tolerance) then
        if (tension_is_decided(iterate)) return
      end if
      if (.not. energy > 0.0_dp) then
        call check_preconditioner_energy(iterate, energy, info)
        return
      end if
      call update_direction(iterate%segments, energy/previous, iterate%work, iterate%direction)
      previous = energy
      call advance_along_direction(operator, reduced_gap, energy, iterate, step_length, info)
      if (.not. step_length > 0.0_dp) return
      if (.not. (to_tolerance .or. preconditioned)) then
        ! Without a preconditioner the last step stands for the error of the forces.
        if (step_length*max_abs_over(iterate%segments, iterate%direction) <= DECISIVE*(-minval(iterate%force))) return
      end if
    end do
  end subroutine run_projected_gradients

  !> Evaluate motion, residual, penetration and least magnitude from the forces, displacements and
  !> contact set of `iterate`. `reduced_gap` (n). Error: FUGE_ERR_MEMORY.
  subroutine evaluate_iterate(operator, reduced_gap, iterate, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in), contiguous :: reduced_gap(:)
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp) :: offset

    call iterate%segments%find(iterate%contact, info)
    if (info%failed()) return
    call set_residual(reduced_gap, iterate)
    iterate%motion = 0.0_dp
    call project_residual(iterate)
    ! The mean of large numbers is rounded: the second projection removes what is left of it.
    call project_residual(iterate)
    iterate%penetration = deepest_penetration(iterate%segments, reduced_gap, iterate%motion, iterate%displacement)
    offset = -iterate%motion
    if (iterate%prescribed) offset = operator%datum()*sum(iterate%force)
    if (iterate%prescribed) then
      ! As in the certificate, without the displacement by the datum, which cancels against the motion.
      call operator%magnitude(iterate%force, iterate%displacement - offset, iterate%work)
    else
      call operator%magnitude(iterate%force, iterate%displacement, iterate%work)
    end if
    iterate%least_magnitude = find_least_magnitude(iterate, offset, reduced_gap, iterate%work)
  end subroutine evaluate_iterate

  !> The residual before its mean is subtracted.
  pure subroutine set_residual(reduced_gap, iterate)
    real(dp), intent(in), contiguous :: reduced_gap(:)
    type(contact_iterate), intent(inout) :: iterate
    integer :: i, last

    last = 0
    do i = 1, size(iterate%segments%first)
      iterate%residual(last + 1:iterate%segments%first(i) - 1) = 0.0_dp
      last = iterate%segments%last(i)
      associate (a => iterate%segments%first(i))
        iterate%residual(a:last) = reduced_gap(a:last) + iterate%displacement(a:last)
      end associate
    end do
    iterate%residual(last + 1:) = 0.0_dp
  end subroutine set_residual

  !> The least magnitude as the certificate forms it, over the contact points: |reduced gap +
  !> offset| plus the magnitude of the displacement. Without contact 0, because nothing is rounded.
  pure function find_least_magnitude(iterate, offset, reduced_gap, magnitude) result(least)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: offset
    real(dp), intent(in), contiguous :: reduced_gap(:), magnitude(:)
    real(dp) :: least
    integer :: i, k

    least = merge(huge(least), 0.0_dp, iterate%segments%points > 0)
    do i = 1, size(iterate%segments%first)
      do k = iterate%segments%first(i), iterate%segments%last(i)
        least = min(least, abs(reduced_gap(k) + offset) + magnitude(k))
      end do
    end do
  end function find_least_magnitude

  !> Displacements by `force`, both (n). Only with a prescribed motion is the operator's datum
  !> included; otherwise the free motion absorbs it. Errors: those of the operator.
  subroutine compute_displacement(operator, prescribed, force, displacement, info)
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: prescribed
    real(dp), intent(in), contiguous :: force(:)
    real(dp), intent(inout), contiguous :: displacement(:)
    type(fuge_info), intent(inout) :: info

    call multiply(operator, force, displacement, info)
    if (prescribed .and. .not. info%failed()) displacement = displacement + operator%datum()*sum(force)
  end subroutine compute_displacement

  !> direction = correction + factor*direction on the contact set.
  pure subroutine update_direction(segments, factor, correction, direction)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: factor
    real(dp), intent(in), contiguous :: correction(:)
    real(dp), intent(inout), contiguous :: direction(:)
    integer :: i, k

    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i)
        direction(k) = correction(k) + factor*direction(k)
      end do
    end do
  end subroutine update_direction

  !> Go to the minimum of the energy along the search direction.
  !>
  !> `energy` is the inner product of the residual and the preconditioned residual;
  !> `step_length` is 0 where the curvature is not positive, or after an error. Errors: those of
  !> the operator, FUGE_ERR_NOT_DEFINITE.
  subroutine advance_along_direction(operator, reduced_gap, energy, iterate, step_length, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in), contiguous :: reduced_gap(:)
    real(dp), intent(in) :: energy
    type(contact_iterate), intent(inout) :: iterate
    real(dp), intent(out) :: step_length
    type(fuge_info), intent(inout) :: info
    real(dp) :: curvature, total

    step_length = 0.0_dp
    call compute_displacement(operator, iterate%prescribed, iterate%direction, iterate%work, info)
    if (info%failed()) return
    call dot_and_sum_over(iterate%segments, iterate%direction, iterate%work, curvature, total)
    if (curvature > 0.0_dp) then
      step_length = energy/curvature
      if (iterate%prescribed) total = 0.0_dp
      call take_step(reduced_gap, step_length, total/real(iterate%segments%points, dp), iterate)
    else
      call check_curvature(iterate, curvature, info)
    end if
  end subroutine advance_along_direction

  !> Subtract `step_length` times the search direction from the forces, and update what follows
  !> from them. `mean` is that of the displacements by the direction over the contact set; 0 if the
  !> motion is prescribed.
  pure subroutine take_step(reduced_gap, step_length, mean, iterate)
    real(dp), intent(in), contiguous :: reduced_gap(:)
    real(dp), intent(in) :: step_length, mean
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: rest, total

    iterate%motion = iterate%motion - step_length*mean
    call step_over(iterate%segments, step_length, step_length*mean, reduced_gap, iterate%motion, iterate%direction, &
                   iterate%work, iterate%force, iterate%displacement, iterate%residual, total, iterate%residual_norm, &
                   iterate%penetration)
    if (iterate%prescribed) return
    ! What rounding leaves of the mean would grow, and without a preconditioner change the sum of the forces.
    rest = total/real(iterate%segments%points, dp)
    call center_over(iterate%segments, rest, iterate%residual, iterate%residual_norm)
    iterate%motion = iterate%motion + rest
  end subroutine take_step

  !> Move the mean of the residual into the motion, unless that is prescribed: left in the
  !> residual, its rounding error would grow and swamp the rest.
  pure subroutine project_residual(iterate)
    type(contact_iterate), intent(inout) :: iterate
    real(dp) :: mean

    mean = 0.0_dp
    if (.not. iterate%prescribed) mean = sum_over(iterate%segments, iterate%residual)/real(iterate%segments%points, dp)
    call center_over(iterate%segments, mean, iterate%residual, iterate%residual_norm)
    iterate%motion = iterate%motion + mean
  end subroutine project_residual

  !> Are the forces accurate enough to tell which of them will be tensile? The preconditioned
  !> residual, in iterate%work, estimates their error.
  pure function tension_is_decided(iterate) result(decided)
    type(contact_iterate), intent(in) :: iterate
    logical :: decided
    real(dp) :: force_error(LANES), tension(LANES), values(LANES)
    integer :: i, k

    force_error = 0.0_dp
    tension = 0.0_dp
    do i = 1, size(iterate%segments%first)
      do k = iterate%segments%first(i), iterate%segments%last(i) - LANES + 1, LANES
        values = abs(iterate%work(k:k + LANES - 1))
        force_error = merge(values, force_error, values > force_error)
        values = iterate%work(k:k + LANES - 1) - iterate%force(k:k + LANES - 1)
        tension = merge(values, tension, values > tension)
      end do
      do k = iterate%segments%last(i) - modulo(iterate%segments%last(i) - iterate%segments%first(i) + 1, LANES) + 1, &
          iterate%segments%last(i)
        force_error(1) = max(force_error(1), abs(iterate%work(k)))
        tension(1) = max(tension(1), iterate%work(k) - iterate%force(k))
      end do
    end do
    decided = maxval(force_error) <= DECISIVE*maxval(tension)
  end function tension_is_decided

  !> Gap of a point in the deformed state; negative where the point penetrates. Scaled as in
  !> contact_iterate.
  elemental function deformed_gap(reduced_gap, displacement, motion) result(gap)
    real(dp), intent(in) :: reduced_gap, displacement, motion
    real(dp) :: gap

    gap = (reduced_gap - motion) + displacement
  end function deformed_gap

  !> The preconditioned residual has no positive energy: either the residual is nothing but
  !> rounding, or the preconditioner is not positive definite (FUGE_ERR_NOT_DEFINITE).
  pure subroutine check_preconditioner_energy(iterate, energy, info)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: energy
    type(fuge_info), intent(inout) :: info

    if (energy >= -ROUNDING*max_abs_over(iterate%segments, iterate%residual) &
        *max_abs_over(iterate%segments, iterate%work)) return
    call report(info, FUGE_ERR_NOT_DEFINITE, &
                'preconditioner '//text(info%preconditionings)//': lengths with the negative energy ' &
                //text(energy)//': the preconditioner of the operator is not positive definite')
  end subroutine check_preconditioner_energy

  !> The search direction has no positive curvature: either its displacements are nothing but
  !> rounding, or the operator is not positive definite (FUGE_ERR_NOT_DEFINITE).
  pure subroutine check_curvature(iterate, curvature, info)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: curvature
    type(fuge_info), intent(inout) :: info
    real(dp) :: length, force

    ! Where the operator is singular, the displacements by the direction are rounding errors of
    ! iterate%displacement.
    length = max(maxval(abs(iterate%displacement)), max_abs_over(iterate%segments, iterate%work))
    force = max_abs_over(iterate%segments, iterate%direction)
    if (curvature >= -ROUNDING*length*force*max(1.0_dp, real(iterate%segments%points, dp)*force)) return
    call report(info, FUGE_ERR_NOT_DEFINITE, 'product '//text(info%products)//': forces on the contact store the ' &
                //'negative energy '//text(0.5_dp*curvature)//': the operator is not positive definite')
  end subroutine check_curvature

end module fuge_projected_gradients
