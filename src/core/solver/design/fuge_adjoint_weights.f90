!> The weights of an objective on a contact set: the right-hand side of the adjoint equations.
module fuge_adjoint_weights
  use fuge_contact_states, only: is_at_stop
  use fuge_displacements, only: add_displacement_at
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_law_gradients, only: find_limited
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_number_text, only: text
  use fuge_operator_products, only: multiply
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_problem_modes, only: free_translation, resultant_terms, resultants_of
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_shared_problem, only: differ
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_OPTION, FUGE_ERR_SIZE
  use fuge_threads, only: thread_team
  implicit none
  private

  public :: check_weights, set_weights

  !> The sum of weights that cancel may be rounded by this many units in the last place of its terms.
  real(dp), parameter :: ROUNDINGS = 64.0_dp

  !> Weights of the objective on a contact set, and what follows from them.
  type, public :: adjoint_weights
    !> Partial derivatives by all forces, gaps and motions, zero where there are none, divided by factor**2 so that the
    !> largest is about 1; `factor` is a power of 2.
    type(fuge_solution) :: given
    real(dp) :: factor = 1.0_dp
    !> Those by the gaps that are free, (n), and by the motions with which these move, (m).
    real(dp), allocatable :: gap(:), motion(:)
    !> Displacements by the weights of the gaps as forces, (A + D) gap, (n), where a gap or a force is fixed by its
    !> point, less a constant that a translation takes up; length times the unit of the weights.
    real(dp), allocatable :: displacement(:)
    real(dp) :: constant = 0.0_dp
    !> That translation, (m); zero if there is none.
    real(dp), allocatable :: translation(:)
    !> Is the gap given by a stop, or the force by the limit of the lower or the upper stop, (n)?
    logical, allocatable :: held(:), lower(:), upper(:)
  end type adjoint_weights

contains

  !> Refuse weights that do not fit `n` points and `m` motions.
  subroutine check_weights(weight, n, m, info)
    type(fuge_solution), intent(in) :: weight
    integer, intent(in) :: n, m
    type(fuge_info), intent(inout) :: info

    call check_values(weight%force, n, 'force_weight', info)
    if (.not. info%failed()) call check_values(weight%gap, n, 'gap_weight', info)
    if (.not. info%failed()) call check_values(weight%motion, m, 'motion_weight', info)
  end subroutine check_weights

  pure subroutine check_values(values, expected, name, info)
    real(dp), intent(in), allocatable :: values(:)
    integer, intent(in) :: expected
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(values)) return
    if (size(values) /= expected) then
      call report(info, FUGE_ERR_SIZE, name//' has '//text(size(values))//' value(s): it needs '//text(expected))
    else
      call check_finite(values, name, info)
    end if
  end subroutine check_values

  !> The weights on what is free on the contact set: gaps of open points are those by forces and motions, so their
  !> weights are weights on these. Errors: FUGE_ERR_MEMORY, FUGE_ERR_OPTION, those of the product.
  subroutine set_weights(operator, problem, solution, weight, threads, space, weights, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution, weight
    integer, intent(in) :: threads
    type(point_space), intent(in) :: space
    type(adjoint_weights), intent(inout) :: weights
    type(fuge_info), intent(inout) :: info
    type(thread_team) :: team

    call allocate_weights(size(solution%state), problem%mode_count(), weights, info)
    call space%agree(info)
    if (info%failed()) return
    call scale_weights(weight, space, weights)
    if (differ(weights%given%motion, space)) then
      call report(info, FUGE_ERR_OPTION, 'motion_weight differs between the ranks')
      return
    end if
    weights%held = is_at_stop(solution%state)
    call find_limited(problem, solution, weights%lower, weights%upper)
    weights%translation = free_translation(problem, space)
    weights%gap = merge(0.0_dp, weights%given%gap, weights%held)
    weights%motion = weights%given%motion
    weights%displacement = 0.0_dp
    if (.not. space%anywhere(any(abs(weights%gap) > 0.0_dp))) return
    call team%begin(threads)
    call displace_by_weights(operator, problem, space, weights, info)
    call team%end()
    if (info%failed()) return
    weights%motion = weights%given%motion - resultants_of(problem, weights%gap, space)
    ! A motion whose weights cancel is not in the objective.
    where (abs(weights%motion) <= ROUNDINGS*epsilon(1.0_dp)*(abs(weights%given%motion) &
                                                             + resultant_terms(problem, weights%gap, space)))
      weights%motion = 0.0_dp
    end where
  end subroutine set_weights

  subroutine allocate_weights(n, m, weights, info)
    integer, intent(in) :: n, m
    type(adjoint_weights), intent(inout) :: weights
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (weights%given%force(n), weights%given%gap(n), weights%given%motion(m), weights%gap(n), &
              weights%motion(m), weights%displacement(n), weights%translation(m), weights%held(n), weights%lower(n), &
              weights%upper(n), stat=stat)
    call require_memory(stat, 'the weights of', n, 'points', info)
  end subroutine allocate_weights

  !> The weights with a largest of about 1: the gradient is linear in them, and their range is left to the data.
  subroutine scale_weights(weight, space, weights)
    type(fuge_solution), intent(in) :: weight
    type(point_space), intent(in) :: space
    type(adjoint_weights), intent(inout) :: weights
    real(dp) :: inverse, largest

    weights%given%force = 0.0_dp
    weights%given%gap = 0.0_dp
    weights%given%motion = 0.0_dp
    if (allocated(weight%force)) weights%given%force = weight%force
    if (allocated(weight%gap)) weights%given%gap = weight%gap
    if (allocated(weight%motion)) weights%given%motion = weight%motion
    largest = space%largest(max(maxval(abs(weights%given%force)), maxval(abs(weights%given%gap)), &
                                maxval(abs(weights%given%motion))))
    if (.not. largest > 0.0_dp) return
    weights%factor = scale(1.0_dp, exponent(largest)/2)
    inverse = 1.0_dp/weights%factor
    weights%given%force = weights%given%force*inverse*inverse
    weights%given%gap = weights%given%gap*inverse*inverse
    weights%given%motion = weights%given%motion*inverse*inverse
  end subroutine scale_weights

  !> (A + D) w at the points whose gap or force is fixed, for weights w of the open gaps.
  subroutine displace_by_weights(operator, problem, space, weights, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    type(adjoint_weights), intent(inout) :: weights
    type(fuge_info), intent(inout) :: info
    real(dp) :: constant

    select type (operator)
    class is (fuge_dense_operator)
      ! Of a symmetric matrix the columns of these points only, which are their rows.
      call add_displacement_at(operator%alpha, operator%datum(), abs(weights%gap) > 0.0_dp, &
                               .not. (weights%held .or. weights%lower .or. weights%upper), weights%gap, &
                               weights%displacement)
    class default
      call multiply(operator, weights%gap, weights%displacement, info)
    end select
    if (info%failed()) return
    constant = operator%datum()*space%total(sum(weights%gap))
    if (any(abs(weights%translation) > 0.0_dp)) then
      weights%constant = constant
    else
      weights%displacement = weights%displacement + constant
    end if
    if (allocated(problem%compliance)) weights%displacement = weights%displacement + problem%compliance*weights%gap
  end subroutine displace_by_weights

end module fuge_adjoint_weights
