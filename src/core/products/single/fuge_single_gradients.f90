!> Projected, preconditioned conjugate gradients on a contact set in single precision.
!>
!> As fuge_projected_gradients. The forces and displacements that the steps add up to are in
!> double precision; whenever the residuals get so small that the errors of the products count, one product in double
!> precision gives the displacements anew and the residuals with them, and the directions go on (H. A. van der Vorst,
!> Q. Ye, Residual replacement strategies for Krylov subspace iterative methods, SIAM Journal on Scientific Computing
!> 22, 2000).
module fuge_single_gradients
  use fuge_conjugate_gradients, only: DECISIVE, NEARLY
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_iterate_lengths, only: iterate_lengths
  use fuge_kinds, only: dp, sp
  use fuge_operator_products, only: multiply_single
  use fuge_operator_type, only: fuge_operator
  use fuge_single_passes, only: point_pass, step_all, sum_curvature, turn_direction
  use fuge_single_preconditioner, only: single_preconditioner
  use fuge_single_state, only: components, given_way, move_by, refresh, restore_sum, single_state, SINGLE_ERROR
  use fuge_status, only: fuge_info
  implicit none
  private

  public :: estimate_compliance, run_single_gradients

  !> Residuals below the first multiple of the errors of the distances are replaced, unless these are below the second
  !> fraction of what is allowed.
  real(dp), parameter :: REPLACED = 100.0_dp, NEGLIGIBLE = 0.1_dp
  !> Directions go on after a replacement if the residuals were more than this multiple of their errors.
  real(dp), parameter :: RELATED = 10.0_dp
  !> Between two replacements residuals fall below this fraction, or at most this often they do not.
  real(dp), parameter :: HALVED = 0.5_dp
  integer, parameter :: MOST_ATTEMPTS = 1
  !> Steps and replacements at most.
  integer, parameter :: LIMIT = 1000
  !> The least eigenvalue of a preconditioned system of which no step has told one.
  real(dp), parameter :: TYPICAL_EIGENVALUE = 0.3_dp

  !> Replacements of one run: how many since the residual has halved, and the least one that a replacement gave.
  type :: replacement_count
    integer :: in_vain = 0
    real(dp) :: least = huge(1.0_dp)
  end type replacement_count

contains

  !> Iterate towards forces for which the gaps of the contact set are equal, as run_projected_gradients does; the
  !> iterate is evaluated. `lost`: rounding has taken over, and another method has to go on. The arguments are nine,
  !> those of run_projected_gradients, the state and `lost`. Errors: those of the operator, FUGE_ERR_MEMORY.
  subroutine run_single_gradients(operator, preconditioner, scene, tolerance, to_tolerance, state, iterate, lost, info)
    class(fuge_operator), intent(in) :: operator
    type(single_preconditioner), intent(inout) :: preconditioner
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: tolerance
    logical, intent(in) :: to_tolerance
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    logical, intent(out) :: lost
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass
    type(replacement_count) :: replacements
    real(dp), allocatable :: factors(:)
    real(dp) :: energy, largest, previous, ratio, step_length, tension
    integer :: iteration, steps
    logical :: goes_on, judges

    lost = .false.
    goes_on = .false.
    iterate%gradients%converged = .false.
    call iterate%gradients%lanczos%restart()
    previous = 1.0_dp
    tension = 0.0_dp
    steps = 0
    do iteration = 0, LIMIT
      if (has_lost_digits(state%drift, iterate%lengths, residual_needed(iterate%lengths, tolerance, to_tolerance))) then
        ! Residuals of the size of their errors were others than those that replace them.
        goes_on = goes_on .and. iterate%lengths%residual_norm > RELATED*state%drift
        call replace_residuals(operator, scene, replacements, state, iterate, lost, info)
        if (lost .or. info%failed()) return
        cycle
      end if
      iterate%gradients%converged = iterate%lengths%is_accurate(tolerance)
      judges = steps > 0 .and. .not. to_tolerance
      if (iterate%gradients%converged) return
      if (judges .and. iterate%lengths%residual_norm <= DECISIVE*iterate%lengths%penetration) return
      call preconditioner%apply(operator, scene, state, iterate, factors, energy, info)
      lost = .not. energy > 0.0_dp
      if (lost .or. info%failed()) return
      ratio = 0.0_dp
      if (goes_on) ratio = energy/previous
      call state%point_to(scene, iterate, pass)
      pass%factors = factors
      pass%ratio = ratio
      call pass%go(turn_direction, 1, 0)
      largest = pass%largest(1)
      if (steps == 0 .or. iterate%lengths%is_accurate(NEARLY*tolerance)) then
        iterate%gradients%amplification = largest/iterate%lengths%residual_norm
      end if
      if (judges .and. largest <= DECISIVE*tension) return
      call multiply_single(operator, state%direction, state%work, info)
      if (info%failed()) return
      call step(scene, energy, state, iterate, step_length, tension)
      lost = .not. step_length > 0.0_dp
      if (lost) return
      call iterate%gradients%lanczos%add(step_length, ratio)
      previous = energy
      goes_on = .true.
      steps = steps + 1
    end do
    lost = .true.
  end subroutine run_single_gradients

  !> Are residuals so small that the errors of the products count, and larger than what is `needed` allows?
  elemental function has_lost_digits(drift, lengths, needed) result(lost)
    real(dp), intent(in) :: drift, needed
    type(iterate_lengths), intent(in) :: lengths
    logical :: lost

    lost = lengths%residual_norm < REPLACED*drift .and. drift > NEGLIGIBLE*needed
  end function has_lost_digits

  !> Replace the residuals by those of a product in double precision. `lost`: they get no smaller, because they are
  !> rounding in double precision. Errors: those of the operator, FUGE_ERR_MEMORY.
  subroutine replace_residuals(operator, scene, replacements, state, iterate, lost, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(replacement_count), intent(inout) :: replacements
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    logical, intent(out) :: lost
    type(fuge_info), intent(inout) :: info

    lost = .false.
    call restore_sum(scene, state, iterate)
    call refresh(operator, scene, .false., state, iterate, info)
    if (info%failed()) return
    replacements%in_vain = replacements%in_vain + 1
    if (iterate%lengths%residual_norm < HALVED*replacements%least) replacements%in_vain = 0
    lost = replacements%in_vain > MOST_ATTEMPTS
    replacements%least = min(replacements%least, iterate%lengths%residual_norm)
  end subroutine replace_residuals

  !> The residual at which the iteration stops, as far as its distances tell: that of the tolerance, or one that lets
  !> the set be judged.
  elemental function residual_needed(lengths, tolerance, to_tolerance)
    type(iterate_lengths), intent(in) :: lengths
    real(dp), intent(in) :: tolerance
    logical, intent(in) :: to_tolerance
    real(dp) :: residual_needed

    residual_needed = tolerance*lengths%least_magnitude
    if (.not. to_tolerance) residual_needed = max(residual_needed, DECISIVE*lengths%penetration)
  end function residual_needed

  !> The least compliance where the forces to start from need no step: from the preconditioned residual, which stands
  !> for their error. Errors: those of the operator.
  subroutine estimate_compliance(operator, preconditioner, scene, state, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(single_preconditioner), intent(inout) :: preconditioner
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass
    real(dp), allocatable :: factors(:)
    real(dp) :: energy

    if (.not. iterate%lengths%residual_norm > 0.0_dp) return
    call preconditioner%apply(operator, scene, state, iterate, factors, energy, info)
    if (info%failed()) return
    call state%point_to(scene, iterate, pass)
    pass%factors = factors
    call pass%go(turn_direction, 1, 0)
    if (.not. pass%largest(1) > 0.0_dp) return
    iterate%gradients%least_compliance = TYPICAL_EIGENVALUE*iterate%lengths%residual_norm/pass%largest(1)
  end subroutine estimate_compliance

  !> Go to the minimum of the energy along the search direction, whose displacements are state%work; `step_length` is 0
  !> where the curvature is not positive, or nothing but rounding; `tension` becomes the largest one after the step.
  subroutine step(scene, energy, state, iterate, step_length, tension)
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: energy
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    real(dp), intent(out) :: step_length
    real(dp), intent(inout) :: tension
    type(point_pass) :: pass
    real(dp) :: means(state%motions)
    real(dp) :: curvature, rise
    integer :: m

    step_length = 0.0_dp
    m = state%motions
    call state%point_to(scene, iterate, pass)
    call pass%go(sum_curvature, 1, 1 + state%columns)
    curvature = pass%total(2)
    rise = given_way(scene, .false., state, iterate)
    if (state%flexibility > 0.0_dp) curvature = curvature + rise*(rise/state%flexibility)
    if (.not. (curvature > 0.0_dp .and. curvature <= huge(curvature))) return
    if (iterate%gradients%lanczos%is_suspect(curvature/energy)) return
    step_length = energy/curvature
    means = step_length*components(state, iterate, pass, 2)
    state%drift = state%drift + SINGLE_ERROR*step_length*pass%largest(1) + epsilon(1.0_sp)*iterate%lengths%residual_norm
    call move_by(scene, -means, iterate)
    pass%factor = step_length
    pass%factors(:m) = means - state%offset(:m)
    if (.not. allocated(state%basis)) pass%shift = sum(pass%factors(:m)) - step_length*rise
    state%is_exact = .false.
    call pass%go(step_all, 3, state%columns)
    ! A motion left by rounding would grow.
    state%offset(:m) = components(state, iterate, pass, 3)
    call move_by(scene, state%offset(:m), iterate)
    iterate%lengths%residual_norm = pass%largest(1)
    iterate%lengths%penetration = pass%largest(2)
    tension = pass%largest(3)
  end subroutine step

end module fuge_single_gradients
