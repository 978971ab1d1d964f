!> Parameters of the gaps that give a wanted contact: least squares by Gauss and Newton, for the examples `crown`,
!> `shim` and `punch_from_area`.
!>
!> What is wanted are values of forces and of gaps under load at each point. A step needs one contact solve of each load
!> case. The linear problem for the step takes conjugate gradients: a product with the Jacobian is one derivative of the
!> solution, one with its transpose is one adjoint solve, both on the contact set of that solve. So neither depends on
!> the number of parameters, and no Jacobian of the solution is ever formed.
module profile_fit
  use fuge, only: dp => fuge_dp, fuge_gradients, fuge_info, fuge_operator, fuge_options, fuge_problem, fuge_solution, &
    fuge_solve_adjoint, fuge_solver
  implicit none
  private

  public :: fit_contact

  !> How far the linear problem of a step is solved: its gradient relative to that at the start.
  real(dp), parameter :: GRADIENT_LEFT = 5.0e-2_dp
  !> Changes of the set of parameters at their bounds in a step, and halvings of a step.
  integer, parameter :: MOST_SETS = 20, MOST_HALVINGS = 6

  !> Gaps that depend on parameters. Extend it. The parameters should be of similar effect: they are not scaled.
  type, abstract, public :: shaped_gap
  contains
    procedure(shape_gap), deferred :: set_gap
  end type shaped_gap

  !> One load of the contact, and the residual of each point: by_force*force + by_gap*gap - wanted, without a unit.
  type, public :: fitted_case
    !> Its loads and laws; the fit sets its gaps.
    type(fuge_problem) :: problem
    !> (n) each.
    real(dp), allocatable :: by_force(:), by_gap(:), wanted(:)
  end type fitted_case

  type, public :: fit_rules
    !> Bounds of the parameters, (p). Not allocated: none.
    real(dp), allocatable :: lower(:), upper(:)
    !> Tikhonov's regularisation: the products of these rows with the parameters are residuals too, (rows, p). Not
    !> allocated: none.
    real(dp), allocatable :: smoothness(:, :)
    !> The fit ends with a step that lowers the sum of squares by less than this share of it.
    real(dp) :: least_decrease = 1.0e-3_dp
    !> And below this share of the first one the sum of squares is as good as zero.
    real(dp) :: negligible = 1.0e-14_dp
    !> Most contact solves of each load case.
    integer :: most_solves = 19
    type(fuge_options) :: options
  end type fit_rules

  type, public :: fit_result
    real(dp), allocatable :: parameter(:)
    !> Of each load case.
    type(fuge_solution), allocatable :: solution(:)
    !> Sums of squares with the first and the last parameters.
    real(dp) :: first_sum = 0.0_dp, last_sum = 0.0_dp
    !> Contact solves of each load case, and derivatives and adjoint solves of all of them.
    integer :: solves = 0, derivatives = 0
  end type fit_result

  !> The contact with some parameters, from which the next step is made.
  type :: fit_state
    type(fitted_case), allocatable :: cases(:)
    type(fuge_solver), allocatable :: solver(:)
    type(fuge_solution), allocatable :: solution(:)
    type(fit_rules) :: rules
    real(dp), allocatable :: parameter(:)
    !> Residuals of the points, case by case, then those of the smoothness.
    real(dp), allocatable :: residual(:)
    !> Derivatives of the gaps by the parameters, (n, p).
    real(dp), allocatable :: by_parameter(:, :)
    integer :: solves = 0, derivatives = 0
  end type fit_state

  abstract interface

    !> The gaps (n) for `parameter` (p), length, and their derivatives by the parameters, (n, p).
    subroutine shape_gap(self, parameter, gap, by_parameter)
      import :: dp, shaped_gap
      class(shaped_gap), intent(in) :: self
      real(dp), intent(in) :: parameter(:)
      real(dp), intent(out) :: gap(:), by_parameter(:, :)
    end subroutine shape_gap

  end interface

contains

  !> Find the parameters of `shape` for which the sum of the squared residuals of all `cases` is least, from `start`
  !> (p), which has to keep the bounds. An error of a solve ends the fit, and leaves `result` as it was.
  subroutine fit_contact(shape, operator, cases, rules, start, result, info)
    class(shaped_gap), intent(in) :: shape
    class(fuge_operator), intent(in) :: operator
    type(fitted_case), intent(in) :: cases(:)
    type(fit_rules), intent(in) :: rules
    real(dp), intent(in) :: start(:)
    type(fit_result), intent(inout) :: result
    type(fuge_info), intent(out) :: info
    type(fit_state) :: state
    real(dp) :: first_sum, last_sum, new_sum
    real(dp), allocatable :: step(:)
    logical :: is_lower

    state%cases = cases
    state%rules = rules
    allocate (state%solver(size(cases)), state%solution(size(cases)))
    allocate (state%by_parameter(operator%points(), size(start)))
    call solve_with(state, shape, operator, start, info)
    if (info%failed()) return
    first_sum = sum(state%residual**2)
    last_sum = first_sum
    do while (state%solves < rules%most_solves .and. last_sum > rules%negligible*first_sum)
      call find_step(state, operator, step, info)
      if (info%failed()) return
      call take_step(state, shape, operator, step, is_lower, info)
      if (info%failed()) return
      new_sum = sum(state%residual**2)
      if (.not. is_lower .or. last_sum - new_sum < rules%least_decrease*last_sum) exit
      last_sum = new_sum
    end do
    last_sum = sum(state%residual**2)
    result = fit_result(state%parameter, state%solution, first_sum, last_sum, state%solves, state%derivatives)
  end subroutine fit_contact

  !> The contact with these parameters.
  subroutine solve_with(state, shape, operator, parameter, info)
    type(fit_state), intent(inout) :: state
    class(shaped_gap), intent(in) :: shape
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: parameter(:)
    type(fuge_info), intent(out) :: info
    real(dp) :: gap(operator%points())
    integer :: k

    call shape%set_gap(parameter, gap, state%by_parameter)
    state%parameter = parameter
    state%solves = state%solves + 1
    if (allocated(state%residual)) deallocate (state%residual)
    allocate (state%residual(residuals(state)))
    do k = 1, size(state%cases)
      state%cases(k)%problem%gap = gap
      call state%solver(k)%solve(operator, state%cases(k)%problem, state%solution(k), info, state%rules%options)
      if (info%failed()) return
      state%residual(rows_of(state, k, 1):rows_of(state, k + 1, 0)) &
        = measured(state%cases(k), state%solution(k)) - state%cases(k)%wanted
    end do
    call set_smoothness(state, parameter, state%residual)
  end subroutine solve_with

  !> Number of residuals.
  pure function residuals(state) result(rows)
    type(fit_state), intent(in) :: state
    integer :: rows

    rows = rows_of(state, size(state%cases) + 1, 0)
    if (allocated(state%rules%smoothness)) rows = rows + size(state%rules%smoothness, 1)
  end function residuals

  !> The residual number `j` of load case k.
  pure function rows_of(state, k, j) result(row)
    type(fit_state), intent(in) :: state
    integer, intent(in) :: k, j
    integer :: row

    row = (k - 1)*size(state%by_parameter, 1) + j
  end function rows_of

  !> What the residuals of a load case see of a solution, or of the change of one.
  pure function measured(one, solution) result(value)
    type(fitted_case), intent(in) :: one
    type(fuge_solution), intent(in) :: solution
    real(dp) :: value(size(one%wanted))

    value = one%by_force*solution%force + one%by_gap*solution%gap
  end function measured

  !> The residuals of the smoothness, the last ones.
  pure subroutine set_smoothness(state, parameter, residual)
    type(fit_state), intent(in) :: state
    real(dp), intent(in) :: parameter(:)
    real(dp), intent(inout) :: residual(:)

    if (.not. allocated(state%rules%smoothness)) return
    residual(rows_of(state, size(state%cases) + 1, 1):) = matmul(state%rules%smoothness, parameter)
  end subroutine set_smoothness

  !> How the residuals change with the parameters: a derivative for each load case.
  subroutine apply_jacobian(state, operator, change, product, info)
    type(fit_state), intent(inout) :: state
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: change(:)
    real(dp), intent(out) :: product(:)
    type(fuge_info), intent(out) :: info
    type(fuge_solution) :: solution_change
    real(dp) :: gap_change(operator%points())
    integer :: k

    gap_change = matmul(state%by_parameter, change)
    do k = 1, size(state%cases)
      call state%solver(k)%derivative(operator, gap_change, spread(0.0_dp, 1, size(state%solution(k)%motion)), &
                                      solution_change, info)
      if (info%failed()) return
      product(rows_of(state, k, 1):rows_of(state, k + 1, 0)) = measured(state%cases(k), solution_change)
    end do
    state%derivatives = state%derivatives + size(state%cases)
    call set_smoothness(state, change, product)
  end subroutine apply_jacobian

  !> The gradient over the parameters of the scalar product of `weight` with the residuals: an adjoint solve for each
  !> load case.
  subroutine apply_transposed(state, operator, weight, gradient, info)
    type(fit_state), intent(inout) :: state
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: weight(:)
    real(dp), intent(out) :: gradient(:)
    type(fuge_info), intent(out) :: info
    type(fuge_gradients) :: by_case
    type(fuge_solution) :: on_solution
    real(dp) :: by_gap(operator%points())
    integer :: k

    by_gap = 0.0_dp
    do k = 1, size(state%cases)
      associate (one => state%cases(k), own => weight(rows_of(state, k, 1):rows_of(state, k + 1, 0)))
        on_solution%force = one%by_force*own
        on_solution%gap = one%by_gap*own
        call fuge_solve_adjoint(state%solver(k), operator, one%problem, state%solution(k), on_solution, by_case, info)
      end associate
      if (info%failed()) return
      by_gap = by_gap + by_case%gap
    end do
    state%derivatives = state%derivatives + size(state%cases)
    gradient = matmul(by_gap, state%by_parameter)
    if (allocated(state%rules%smoothness)) gradient = gradient &
      + matmul(weight(rows_of(state, size(state%cases) + 1, 1):), state%rules%smoothness)
  end subroutine apply_transposed

  !> The step to the least sum of squares of the linear problem within the bounds, J. J. More and G. Toraldo (1991):
  !> conjugate gradients for the parameters that no bound holds; the way that they find is bent at the bounds, and
  !> halved until it lowers the sum.
  subroutine find_step(state, operator, step, info)
    type(fit_state), intent(inout) :: state
    class(fuge_operator), intent(in) :: operator
    real(dp), allocatable, intent(inout) :: step(:)
    type(fuge_info), intent(out) :: info
    real(dp), dimension(size(state%parameter)) :: gradient, least, most, way
    real(dp) :: residual(size(state%residual))
    logical :: is_free(size(state%parameter))
    real(dp) :: enough
    integer :: k

    least = -huge(least)
    most = huge(most)
    if (allocated(state%rules%lower)) least = state%rules%lower - state%parameter
    if (allocated(state%rules%upper)) most = state%rules%upper - state%parameter
    step = spread(0.0_dp, 1, size(state%parameter))
    residual = state%residual
    do k = 0, MOST_SETS
      call apply_transposed(state, operator, residual, gradient, info)
      if (info%failed()) return
      is_free = .not. ((step <= least .and. gradient > 0.0_dp) .or. (step >= most .and. gradient < 0.0_dp))
      if (k == 0) enough = GRADIENT_LEFT*norm2(pack(gradient, is_free))
      if (norm2(pack(gradient, is_free)) <= enough) exit
      call minimise_on_free(state, operator, is_free, enough, residual, gradient, way, info)
      if (info%failed()) return
      call go_within_bounds(state, operator, way, least, most, step, residual, info)
      if (info%failed()) return
    end do
  end subroutine find_step

  !> The way to the least sum of squares over the free components, until their gradient is not above `enough`:
  !> conjugate gradients for least squares, M. R. Hestenes and E. Stiefel (1952). `residual` and `gradient` are those at
  !> its start.
  subroutine minimise_on_free(state, operator, is_free, enough, residual, gradient, way, info)
    type(fit_state), intent(inout) :: state
    class(fuge_operator), intent(in) :: operator
    logical, intent(in) :: is_free(:)
    real(dp), intent(in) :: enough, residual(:), gradient(:)
    real(dp), intent(out) :: way(:)
    type(fuge_info), intent(out) :: info
    real(dp) :: direction(size(way)), now(size(way)), left(size(residual)), product(size(residual))
    real(dp) :: last_square, length, square
    integer :: k

    way = 0.0_dp
    left = residual
    now = gradient
    direction = merge(-now, 0.0_dp, is_free)
    square = sum(direction**2)
    do k = 1, 2*count(is_free)
      call apply_jacobian(state, operator, direction, product, info)
      if (info%failed()) return
      if (.not. sum(product**2) > 0.0_dp) exit
      length = square/sum(product**2)
      way = way + length*direction
      left = left + length*product
      call apply_transposed(state, operator, left, now, info)
      if (info%failed()) return
      last_square = square
      square = sum(now**2, mask=is_free)
      if (square <= enough**2) exit
      direction = merge(square/last_square*direction - now, 0.0_dp, is_free)
    end do
  end subroutine minimise_on_free

  !> Go from `step` along the `way`, or half of it, and so on, as the bounds allow, to a lower sum of squares.
  subroutine go_within_bounds(state, operator, way, least, most, step, residual, info)
    type(fit_state), intent(inout) :: state
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: way(:), least(:), most(:)
    real(dp), intent(inout) :: step(:), residual(:)
    type(fuge_info), intent(out) :: info
    real(dp) :: change(size(step)), product(size(residual))
    integer :: k

    do k = 0, MOST_HALVINGS
      change = min(max(step + 0.5_dp**k*way, least), most) - step
      call apply_jacobian(state, operator, change, product, info)
      if (info%failed()) return
      if (sum((residual + product)**2) < sum(residual**2)) exit
    end do
    step = min(max(step + change, least), most)
    residual = residual + product
  end subroutine go_within_bounds

  !> Take the step, or half of it, and so on, until the sum of squares is lower. Without any such step the parameters
  !> stay.
  subroutine take_step(state, shape, operator, step, is_lower, info)
    type(fit_state), intent(inout) :: state
    class(shaped_gap), intent(in) :: shape
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: step(:)
    logical, intent(out) :: is_lower
    type(fuge_info), intent(out) :: info
    type(fuge_solution) :: solution(size(state%cases))
    real(dp) :: parameter(size(step)), residual(size(state%residual))
    integer :: k

    parameter = state%parameter
    residual = state%residual
    solution = state%solution
    is_lower = .false.
    do k = 0, MOST_HALVINGS
      call solve_with(state, shape, operator, parameter + 0.5_dp**k*step, info)
      if (info%failed()) return
      is_lower = sum(state%residual**2) < sum(residual**2)
      if (is_lower .or. state%solves >= state%rules%most_solves) exit
    end do
    if (is_lower) return
    state%parameter = parameter
    state%residual = residual
    state%solution = solution
  end subroutine take_step

end module profile_fit
