!> An estimate of the error of forces from the residual that they leave, and from the rounding of products, gaps and
!> motions.
!>
!> The residual is a backward error: where the operator is nearly singular on the contact, small residuals belong to
!> large errors. Divided by the smallest value of Lanczos, the preconditioned residual bounds the error in the norm of
!> the preconditioner (doc/theory.md). The rounding of gaps and motions under a light load is such a residual too,
!> although the equations may hold exactly with it.
module fuge_iteration_error
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_contact_segments, only: contact_segments, max_abs_over
  use fuge_kinds, only: dp
  use fuge_least_magnitude, only: largest_rigid_magnitude
  use fuge_motion_rounding, only: exact_modes, gap_rounding_at, load_rounding, mode_rounding_at
  use fuge_problem_type, only: fuge_problem, fuge_solution
  implicit none
  private

  public :: estimated_force_error, find_rounding

contains

  !> The largest error of the forces over the largest force; no unit, at most 1.
  !>
  !> `iterate` as evaluated last. The preconditioned residual is estimated from those before;
  !> `pair_compliance` as least_pair_compliance of fuge_operator, because conjugate gradients do not see forces that
  !> hardly displace anything; `length` and `force` as from `find_rounding`. Costs two passes over the contact, and
  !> no product.
  function estimated_force_error(iterate, pair_compliance, length, force) result(error)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: pair_compliance, length, force
    real(dp) :: error
    real(dp) :: compliance, largest, open

    error = 0.0_dp
    largest = max_abs_over(iterate%segments, iterate%force)
    if (.not. largest > 0.0_dp) return
    error = min(epsilon(error) + force/largest, 1.0_dp)
    ! Half of it, because the pair has the norm sqrt(2).
    compliance = 0.5_dp*pair_compliance
    if (iterate%gradients%least_compliance > 0.0_dp) then
      compliance = min(compliance, iterate%gradients%least_compliance)
    else if (compliance >= 0.5_dp*huge(error)) then
      ! Forces that follow from equilibrium alone take no step.
      return
    end if
    open = max(iterate%lengths%residual_norm, iterate%lengths%penetration) + length &
           + epsilon(error)*iterate%lengths%largest_magnitude
    if (open < compliance*largest) then
      error = min(max(open/compliance/largest, epsilon(error)) + force/largest, 1.0_dp)
    else
      error = 1.0_dp
    end if
  end function estimated_force_error

  !> The rounding in the scene of a problem that has been solved: of the gaps and motions at the contact, a `length`,
  !> and of the resultants, a `force`, both in units of the scene, whose unit of force is `load`.
  !>
  !> `canonical` belongs to the problem if the scene has modes; `solution` in the units of the problem.
  subroutine find_rounding(problem, canonical, scene, load, iterate, solution, length, force)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: load
    type(contact_iterate), intent(in) :: iterate
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(out) :: length, force
    logical :: exact(problem%mode_count())

    exact = exact_modes(problem, scene%rows%point_space)
    length = epsilon(length)*largest_rigid_magnitude(scene, iterate)
    if (allocated(problem%prescribed) .or. .not. all(exact)) then
      length = length + largest_rounding(problem, exact, iterate%segments, solution%motion)/load
    end if
    force = 0.0_dp
    if (all(exact) .or. .not. allocated(scene%modes)) return
    associate (rounding => load_rounding(problem, exact, solution%force, scene%rows%point_space))
      force = iterate%projection%largest_force(scene%modes, iterate%segments, &
                                               canonical%largest_loads(rounding/load))
    end associate
  end subroutine find_rounding

  !> The largest length on the contact set that is lost in modes and prescribed motions.
  function largest_rounding(problem, exact, segments, motion) result(largest)
    type(fuge_problem), intent(in) :: problem
    logical, intent(in) :: exact(:)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: motion(:)
    real(dp) :: largest
    integer :: i, k

    largest = 0.0_dp
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i)
        largest = max(largest, mode_rounding_at(problem, exact, motion, k) + abs(gap_rounding_at(problem, k)))
      end do
    end do
    largest = segments%space%largest(largest)
  end function largest_rounding

end module fuge_iteration_error
