!> The gradient of an objective over all data of a contact problem, by one adjoint solve.
!>
!> On a contact set the equations are linear, and symmetric but for the sign of the modes:
!>
!>     | A + D   -R | | f |   | -g |
!>     | R^T      S | | q | = |  w |
!>
!> So the adjoint solution, by the transposed matrix, is a derivative of the solution itself, with the weights of the
!> objective in the places of the changes of gaps and loads, and every engine that has derivatives has gradients
!> (doc/theory.md).
module fuge_adjoint_solution
  use fuge_gradients_type, only: fuge_gradients
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: check_problem, fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_NO_EQUILIBRIUM, &
    FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE
  implicit none
  private

  public :: fuge_solve_adjoint

  !> A gradient that is smaller than its terms by this factor has lost too many digits.
  real(dp), parameter :: MOST_CANCELLED = 2.0_dp**10

contains

  !> The gradient of an objective J(force, gap, motion) at the last solution of `solver`, exact as long as the contact
  !> set stays, over all gaps, loads, and the other data of the problem, in the time of one derivative.
  !>
  !> `operator`, `problem` and `solution` those of the last solve. `weight` the partial derivatives of J by `force`
  !> (n), `gap` (n) and `motion` (m); those that are not allocated are zero. `gradients` see there. A solve with a
  !> factor takes triangular solves with it; after the iteration it takes products on the contact set, to the tolerance
  !> of the solve, one more if there are weights of open gaps, and one if displacements are small beside gaps or
  !> compliances. `info` is that of the solve, whose warnings hold for the gradient too, with these products added;
  !> FUGE_WARN_KINK if there is none, but points on the border between two states, which gradients%at_kink has. Errors,
  !> `gradients` untouched: FUGE_ERR_CALL_ORDER without a solution with a load, or if `solution` is not the last one;
  !> FUGE_ERR_SIZE; FUGE_ERR_NOT_FINITE; FUGE_ERR_OPTION where weights of motions differ between ranks; those of the
  !> derivative, FUGE_ERR_NO_EQUILIBRIUM if J depends on a motion that the contact does not resist; FUGE_ERR_OVERFLOW;
  !> those of the product. T. F. Conry and A. Seireg, J. Applied Mechanics 38 (1971), 387-392, design with such
  !> problems.
  subroutine fuge_solve_adjoint(solver, operator, problem, solution, weight, gradients, info)
    use fuge_adjoint_weights, only: adjoint_weights, check_weights, set_weights
    use fuge_kink_search, only: warn_of_kinks
    use fuge_problem_modes, only: prescribed_motions
    class(fuge_solver), intent(in) :: solver
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution, weight
    type(fuge_gradients), intent(inout) :: gradients
    type(fuge_info), intent(out) :: info
    type(adjoint_weights) :: weights
    type(fuge_gradients) :: new
    type(fuge_solution) :: adjoint
    type(point_space) :: space
    integer :: products

    space = operator%ranks()
    call check_solution(solver, operator, problem, solution, info)
    if (.not. info%failed()) call check_weights(weight, operator%points(), problem%mode_count(), info)
    call space%agree(info)
    if (info%failed()) return
    call set_weights(operator, problem, solution, weight, solver%thread_count(), space, weights, info)
    if (info%failed()) return
    products = info%products
    call solver%derivative(operator, merge(-(weights%given%force + weights%displacement), 0.0_dp, weights%held), &
                           merge(0.0_dp, -weights%motion, prescribed_motions(problem)), &
                           weights%lower .or. weights%upper, adjoint, info)
    if (info%status == FUGE_ERR_NO_EQUILIBRIUM) call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the objective depends on ' &
      //'a motion that the contact does not resist, and so has no gradient: leave weights of that motion out, and ' &
      //'those of the gaps that it moves')
    if (info%failed()) return
    info%products = info%products + products
    call allocate_gradients(problem, solution, new, info)
    call space%agree(info)
    if (info%failed()) return
    call set_gradients(problem, solution, weights, adjoint, space, new)
    call restore_load_gradients(solver, operator, weights, space, new, info)
    if (info%failed()) return
    call set_law_gradients(operator, problem, solution, weights, solver%thread_count(), space, new, info)
    if (.not. info%failed()) call multiply_gradients(weights%factor, space, new, info)
    if (info%failed()) return
    call warn_of_kinks(new%at_kink, space, info)
    call move_gradients(new, gradients)
  end subroutine fuge_solve_adjoint

  !> Refuse a problem and a solution that are not those of the last solve, as far as sizes and states tell.
  subroutine check_solution(solver, operator, problem, solution, info)
    class(fuge_solver), intent(in) :: solver
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info
    logical :: there

    there = allocated(solution%force) .and. allocated(solution%gap) .and. allocated(solution%motion) &
            .and. allocated(solution%state)
    if (there) there = solver%has_found(solution%state) .and. size(solution%force) == size(solution%state) &
                       .and. size(solution%gap) == size(solution%state)
    if (.not. there) then
      call report(info, FUGE_ERR_CALL_ORDER, 'the solution is not the last one of the solver, or had no load: solve ' &
                  //'with a load, and pass its problem and solution')
    else if (size(solution%state) /= operator%points() .or. size(solution%state) /= problem%points() &
             .or. size(solution%motion) /= problem%mode_count()) then
      call report(info, FUGE_ERR_SIZE, 'the solution has '//text(size(solution%state))//' point(s) and ' &
                  //text(size(solution%motion))//' motion(s), the problem '//text(problem%points())//' and ' &
                  //text(problem%mode_count())//', the operator '//text(operator%points())//' points: pass those of ' &
                  //'the last solve')
    else
      call check_problem(problem, operator%points(), info)
    end if
  end subroutine check_solution

  !> Arrays for the gradients of `problem`. Error: FUGE_ERR_MEMORY.
  subroutine allocate_gradients(problem, solution, gradients, info)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_gradients), intent(inout) :: gradients
    type(fuge_info), intent(inout) :: info
    integer :: m, n, stat

    n = size(solution%state)
    m = size(solution%motion)
    allocate (gradients%gap(n), gradients%load(m), gradients%compliance(n), gradients%motion_stiffness(m), &
              gradients%at_kink(n), stat=stat)
    if (allocated(problem%gap_upper) .and. stat == 0) allocate (gradients%gap_upper(n), stat=stat)
    if (allocated(problem%limit) .and. stat == 0) allocate (gradients%limit(n), stat=stat)
    if (allocated(problem%limit_upper) .and. stat == 0) allocate (gradients%limit_upper(n), stat=stat)
    call require_memory(stat, 'the gradients of', n, 'points', info)
  end subroutine allocate_gradients

  !> The gradients by gaps, loads and limits from the derivative `adjoint`.
  subroutine set_gradients(problem, solution, weights, adjoint, space, gradients)
    use fuge_adjoint_weights, only: adjoint_weights
    use fuge_problem_modes, only: prescribed_motions, resultants_of
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution, adjoint
    type(adjoint_weights), intent(in) :: weights
    type(point_space), intent(in) :: space
    type(fuge_gradients), intent(inout) :: gradients

    real(dp) :: of_held(size(solution%state))

    of_held = merge(-adjoint%force, 0.0_dp, weights%held)
    gradients%gap = of_held + weights%gap
    gradients%load = weights%constant*weights%translation - adjoint%motion
    ! Those of open gaps are in the weights of the motions already.
    if (any(prescribed_motions(problem))) where (prescribed_motions(problem)) gradients%load = weights%motion &
      - resultants_of(problem, of_held, space)
    associate (by_limit => weights%given%force + weights%displacement - adjoint%gap)
      if (allocated(gradients%limit)) gradients%limit = merge(by_limit, 0.0_dp, weights%lower)
      if (allocated(gradients%limit_upper)) gradients%limit_upper = merge(-by_limit, 0.0_dp, weights%upper)
    end associate
  end subroutine set_gradients

  !> Beside a large datum of the matrix, which the weights of open gaps leave out in the end, gradients by loads lose
  !> their digits: there they come from the derivative by the load, by which nothing cancels, and whose products are not
  !> counted. Errors: those of the derivative.
  subroutine restore_load_gradients(solver, operator, weights, space, gradients, info)
    use fuge_adjoint_weights, only: adjoint_weights
    class(fuge_solver), intent(in) :: solver
    class(fuge_operator), intent(in) :: operator
    type(adjoint_weights), intent(in) :: weights
    type(point_space), intent(in) :: space
    type(fuge_gradients), intent(inout) :: gradients
    type(fuge_info), intent(inout) :: info
    type(fuge_solution) :: change
    type(fuge_info) :: again
    real(dp) :: load_change(size(gradients%load)), no_change(size(gradients%gap))
    integer :: j

    no_change = 0.0_dp
    do j = 1, size(load_change)
      if (.not. abs(weights%constant*weights%translation(j)) > MOST_CANCELLED*abs(gradients%load(j))) cycle
      load_change = 0.0_dp
      load_change(j) = 1.0_dp
      call solver%derivative(operator, no_change, load_change, change, again)
      if (again%failed()) info = again
      if (info%failed()) return
      gradients%load(j) = space%total(dot_product(weights%given%force, change%force) &
                                      + dot_product(weights%given%gap, change%gap)) &
                          + dot_product(weights%given%motion, change%motion)
    end do
  end subroutine restore_load_gradients

  !> The gradients that follow from those by gaps and loads, and points at a kink. Errors: FUGE_ERR_MEMORY, those of the
  !> product.
  subroutine set_law_gradients(operator, problem, solution, weights, threads, space, gradients, info)
    use fuge_operator_products, only: multiply
    use fuge_threads, only: thread_team
    use fuge_adjoint_weights, only: adjoint_weights
    use fuge_kink_search, only: mark_kinks
    use fuge_law_gradients, only: displacement_is_lost, find_law_gradients, set_displacement
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(adjoint_weights), intent(in) :: weights
    integer, intent(in) :: threads
    type(point_space), intent(in) :: space
    type(fuge_gradients), intent(inout) :: gradients
    type(fuge_info), intent(inout) :: info
    type(thread_team) :: team
    real(dp), allocatable :: displacement(:)
    real(dp) :: constant
    integer :: stat

    allocate (displacement(size(solution%state)), stat=stat)
    call require_memory(stat, 'the displacements of', size(solution%state), 'points', info)
    call space%agree(info)
    if (info%failed()) return
    constant = operator%datum()*space%total(sum(solution%force))
    call set_displacement(problem, solution, constant, weights%translation, displacement)
    if (space%anywhere(displacement_is_lost(problem, solution, &
                                            space%largest(maxval(abs(displacement)))))) then
      call team%begin(threads)
      call multiply(operator, solution%force, displacement, info)
      call team%end()
      if (info%failed()) return
      if (.not. any(abs(weights%translation) > 0.0_dp)) displacement = displacement + constant
    end if
    call find_law_gradients(problem, solution, weights%given, displacement, constant, weights%translation, space, &
                            gradients)
    call mark_kinks(problem, solution, displacement, space, info, gradients%at_kink)
  end subroutine set_law_gradients

  !> Multiply the gradients by factor**2. Error: FUGE_ERR_OVERFLOW.
  subroutine multiply_gradients(factor, space, gradients, info)
    real(dp), intent(in) :: factor
    type(point_space), intent(in) :: space
    type(fuge_gradients), intent(inout) :: gradients
    type(fuge_info), intent(inout) :: info
    real(dp) :: limit

    limit = huge(limit)/max(factor, 1.0_dp)/max(factor, 1.0_dp)
    if (.not. space%everywhere(are_below(limit, gradients))) then
      call report(info, FUGE_ERR_OVERFLOW, 'a gradient is out of the range of double precision: choose other units, ' &
                  //'or divide the weights by a number')
      return
    end if
    gradients%gap = gradients%gap*factor*factor
    gradients%load = gradients%load*factor*factor
    gradients%compliance = gradients%compliance*factor*factor
    gradients%motion_stiffness = gradients%motion_stiffness*factor*factor
    gradients%log_modulus = gradients%log_modulus*factor*factor
    if (allocated(gradients%gap_upper)) gradients%gap_upper = gradients%gap_upper*factor*factor
    if (allocated(gradients%limit)) gradients%limit = gradients%limit*factor*factor
    if (allocated(gradients%limit_upper)) gradients%limit_upper = gradients%limit_upper*factor*factor
  end subroutine multiply_gradients

  !> Are all gradients at most `limit`, and numbers?
  pure function are_below(limit, gradients) result(below)
    real(dp), intent(in) :: limit
    type(fuge_gradients), intent(in) :: gradients
    logical :: below

    below = all(abs(gradients%gap) <= limit) .and. all(abs(gradients%load) <= limit) &
            .and. all(abs(gradients%compliance) <= limit) .and. all(abs(gradients%motion_stiffness) <= limit) &
            .and. abs(gradients%log_modulus) <= limit
    if (allocated(gradients%gap_upper)) below = below .and. all(abs(gradients%gap_upper) <= limit)
    if (allocated(gradients%limit)) below = below .and. all(abs(gradients%limit) <= limit)
    if (allocated(gradients%limit_upper)) below = below .and. all(abs(gradients%limit_upper) <= limit)
  end function are_below

  !> Move the arrays of `source` to `gradients`.
  pure subroutine move_gradients(source, gradients)
    type(fuge_gradients), intent(inout) :: source, gradients

    call move_alloc(source%gap, gradients%gap)
    call move_alloc(source%load, gradients%load)
    call move_alloc(source%compliance, gradients%compliance)
    call move_alloc(source%motion_stiffness, gradients%motion_stiffness)
    call move_alloc(source%gap_upper, gradients%gap_upper)
    call move_alloc(source%limit, gradients%limit)
    call move_alloc(source%limit_upper, gradients%limit_upper)
    call move_alloc(source%at_kink, gradients%at_kink)
    gradients%log_modulus = source%log_modulus
  end subroutine move_gradients

end module fuge_adjoint_solution
