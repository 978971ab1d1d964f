!> The engine that needs nothing but products with the operator.
!>
!> Conjugate gradients solve the equations of a contact set just well enough to tell
!> which points pull and which penetrate; those change sides, and so on until none is
!> left and the residual is as small as asked for. An operator with coarser grids starts
!> there. Where changes of many points at once do not get on, forces only push and one point
!> joins at a time, down the energy: that ends (see fuge_block_pivoting).
module fuge_iterative_engine
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_contact_set_search, only: demands, find_contact, restart
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options, iteration_limit
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_projected_gradients, only: iterate, make_iterate, measure, deflect, open_gap
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_OVERFLOW, FUGE_ERR_NO_EQUILIBRIUM
  use fuge_number_text, only: text
  implicit none
  private

  public :: solve_by_iteration

  !> Forces of the last solve are a start if their gaps are off by less than this part of
  !> the least length.
  real(dp), parameter :: GOOD_START = 0.2_dp
  !> Displacements by even forces below this part of their terms are rounding.
  real(dp), parameter :: SINGULAR = 1.0e-12_dp

contains

  !> From checked data to an answer and its words.
  !>
  !> `problem` checked, plain with a load > 0, or with the translation prescribed; `part`
  !> (n) if allocated forces to start from, as parts of the load if there is one, and on
  !> return those of the answer; `answer` allocated. Errors: FUGE_ERR_MEMORY,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_NO_EQUILIBRIUM,
  !> FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_CALLBACK, FUGE_ERR_CANCELLED.
  subroutine solve_by_iteration(operator, problem, options, monitor, part, answer, info)
    class(fuge_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: part(:)
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    type(iterate) :: state
    type(demands) :: wanted
    real(dp), allocatable :: reduced_gap(:)
    real(dp) :: lowest, load
    integer :: n, stat

    n = operator%points()
    call check_magnitude(problem, info)
    if (info%failed()) return
    ! Made anew at the end, to have the memory until then.
    if (allocated(answer%force)) deallocate (answer%force, answer%gap)
    allocate (reduced_gap(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the gaps of '//text(n)//' points')
      return
    end if
    wanted%limit = iteration_limit(options, n + 1)

    wanted%held = .not. problem%is_plain()
    ! Gaps are counted from the prescribed motion, or from the lowest.
    lowest = minval(problem%gap)
    load = 1.0_dp
    if (wanted%held) lowest = problem%motion(1)
    if (.not. wanted%held) load = problem%resultant(1)
    reduced_gap = (problem%gap - lowest)/load
    if (wanted%held) call check_approach(operator, problem%motion(1), reduced_gap, info)
    if (allocated(part) .and. .not. info%failed()) call judge_start(operator, wanted, reduced_gap, part, info)
    if (.not. (info%failed() .or. allocated(part))) call climb(operator, wanted, reduced_gap, monitor, part, info)
    if (.not. info%failed()) call make_iterate(state, n, info)
    if (info%failed()) return
    call set_start(wanted, part, state)
    wanted%tolerance = options%tolerance
    wanted%only_start = .false.
    call find_contact(operator, wanted, reduced_gap, monitor, state, info)
    if (info%failed()) return
    allocate (answer%force(n), answer%gap(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the forces and gaps of '//text(n)//' points')
      return
    end if
    ! What is left of a force that should have become zero.
    where (state%force <= 4.0_dp*epsilon(1.0_dp)*maxval(state%force)) state%force = 0.0_dp
    answer%force = load*state%force
    answer%gap = load*max(open_gap(reduced_gap, state%displacement, state%motion), 0.0_dp)
    where (state%contact) answer%gap = 0.0_dp
    answer%motion = lowest
    if (.not. wanted%held) answer%motion = (load*state%motion + operator%datum()*sum(answer%force)) + lowest
    call move_alloc(state%force, part)
  end subroutine solve_by_iteration

  !> Even forces may displace nothing, as on a periodic surface: then an approach at which
  !> the mean gap is closed cannot be held. Errors: FUGE_ERR_NO_EQUILIBRIUM,
  !> FUGE_ERR_MEMORY, those of the operator.
  subroutine check_approach(operator, approach, reduced_gap, info)
    class(fuge_operator), intent(in) :: operator
    real(dp), intent(in) :: approach
    real(dp), intent(in), contiguous :: reduced_gap(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: force(:), displacement(:), terms(:)
    real(dp) :: mean
    integer :: n, stat

    n = size(reduced_gap)
    mean = sum(reduced_gap)/real(n, dp)
    if (mean > 0.0_dp) return
    allocate (force(n), displacement(n), terms(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to judge the approach of '//text(n)//' points')
      return
    end if
    force = 1.0_dp
    call deflect(operator, .true., force, displacement, info)
    if (info%failed()) return
    call operator%magnitude(force, displacement, terms)
    if (sum(displacement) > SINGULAR*sum(terms)) return
    call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'even forces displace nothing (a periodic surface), so no forces hold ' &
                //'the approach '//text(approach)//' at which the mean gap is closed: prescribe less than ' &
                //text(approach + mean)//', or a load')
  end subroutine check_approach

  !> Forces to start with: those given; else even ones, none if the motion is held.
  pure subroutine set_start(wanted, start, state)
    type(demands), intent(in) :: wanted
    real(dp), intent(in), allocatable :: start(:)
    type(iterate), intent(inout) :: state

    state%held = wanted%held
    if (allocated(start)) then
      state%force = start
    else if (wanted%held) then
      state%force = 0.0_dp
    else
      state%force = 1.0_dp/real(size(state%force), dp)
    end if
  end subroutine set_start

  !> Forget forces to start from that are far from the answer: coarser grids start better.
  subroutine judge_start(operator, wanted, reduced_gap, part, info)
    class(fuge_operator), intent(in) :: operator
    type(demands), intent(in) :: wanted
    real(dp), intent(in), contiguous :: reduced_gap(:)
    real(dp), allocatable, intent(inout) :: part(:)
    type(fuge_info), intent(inout) :: info
    type(iterate) :: state

    if (.not. operator%in_row()) return
    call make_iterate(state, size(part), info)
    if (info%failed()) return
    call set_start(wanted, part, state)
    state%contact = part > 0.0_dp
    call restart(operator, state, info)
    if (.not. info%failed()) call measure(operator, reduced_gap, state, info)
    if (info%failed()) return
    if (max(state%residual, state%penetration) > GOOD_START*state%least_length) deallocate (part)
  end subroutine judge_start

  !> Refuse gaps that overflow when divided by the load.
  pure subroutine check_magnitude(problem, info)
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: excess

    if (.not. problem%is_plain()) then
      excess = exponent(maxval(abs(problem%gap - problem%motion(1))))
    else
      excess = exponent(maxval(problem%gap) - minval(problem%gap)) - exponent(problem%resultant(1))
    end if
    ! Squares of lengths are formed.
    if (2*excess > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'the gaps are 2**'//text(excess)//' times the load: choose units in which ' &
                  //'they are nearer to it')
    end if
  end subroutine check_magnitude

  !> Forces to start from on the finest grid: those of the coarsest one, carried from grid
  !> to grid. `start` (n) stays unallocated where there are no coarser grids.
  subroutine climb(operator, wanted, reduced_gap, monitor, start, info)
    class(fuge_operator), intent(in) :: operator
    type(demands), intent(in) :: wanted
    real(dp), intent(in) :: reduced_gap(:)
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    type(fuge_info), intent(inout) :: info
    class(fuge_operator), allocatable :: coarse
    real(dp) :: products, preconditionings
    integer :: k

    products = 0.0_dp
    preconditionings = 0.0_dp
    do k = digits(operator%points()) - 1, 1, -1
      call operator%coarsen(k, coarse)
      if (.not. allocated(coarse)) cycle
      if (coarse%points() /= (operator%points() - 1)/2**k + 1) cycle
      call climb_onto(coarse, wanted, reduced_gap, 2**k, monitor, start, products, preconditionings, info)
      if (info%failed()) exit
    end do
    if (allocated(start) .and. .not. info%failed()) call refine_grid(size(reduced_gap), start, info)
    info%products = info%products + ceiling(products)
    info%preconditionings = info%preconditionings + ceiling(preconditionings)
  end subroutine climb

  !> Solve on one coarser grid. `start` are the forces of the grid before, then those of
  !> this one; `products` and `preconditionings` grow by their share of the finest grid's.
  subroutine climb_onto(coarse, wanted, reduced_gap, width, monitor, start, products, preconditionings, info)
    class(fuge_operator), intent(in) :: coarse
    type(demands), intent(in) :: wanted
    real(dp), intent(in) :: reduced_gap(:)
    integer, intent(in) :: width
    class(fuge_monitor), intent(inout) :: monitor
    real(dp), allocatable, intent(inout) :: start(:)
    real(dp), intent(inout) :: products, preconditionings
    type(fuge_info), intent(inout) :: info
    type(iterate) :: state
    type(fuge_info) :: counted
    real(dp), allocatable :: coarse_gap(:)
    real(dp) :: share
    integer :: n

    n = coarse%points()
    call restrict_gap(reduced_gap, width, n, coarse_gap, info)
    if (.not. info%failed()) call make_iterate(state, n, info)
    if (allocated(start) .and. .not. info%failed()) call refine_grid(n, start, info)
    if (info%failed()) return
    call set_start(wanted, start, state)
    counted%iterations = info%iterations
    call find_contact(coarse, wanted, coarse_gap, monitor, state, counted)
    info%iterations = counted%iterations
    share = real(n, dp)/real(size(reduced_gap), dp)
    products = products + share*real(counted%products, dp)
    preconditionings = preconditionings + share*real(counted%preconditionings, dp)
    if (counted%failed()) then
      call report(info, counted%status, 'on the grid of '//text(n)//' points: '//counted%message)
    else
      call move_alloc(state%force, start)
    end if
  end subroutine climb_onto

  !> Forces of a grid carried to the next finer one, of n points.
  pure subroutine refine_grid(n, force, info)
    integer, intent(in) :: n
    real(dp), allocatable, intent(inout) :: force(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: fine(:)
    integer :: stat

    if (size(force) /= (n + 1)/2) then
      ! A grid in between is missing.
      deallocate (force)
      return
    end if
    allocate (fine(n), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the start on '//text(n)//' points')
      return
    end if
    call interpolate(force, fine)
    call move_alloc(fine, force)
  end subroutine refine_grid

  !> Linear between the centres of the coarse cells, each of which had the forces of two.
  pure subroutine interpolate(coarse, fine)
    real(dp), intent(in) :: coarse(:)
    real(dp), intent(out) :: fine(:)
    integer :: k, last

    last = size(coarse)
    do k = 1, last
      fine(2*k - 1) = 0.375_dp*coarse(k) + 0.125_dp*coarse(max(k - 1, 1))
      if (2*k <= size(fine)) fine(2*k) = 0.375_dp*coarse(k) + 0.125_dp*coarse(min(k + 1, last))
    end do
  end subroutine interpolate

  !> Mean of the gaps over the cells of a coarser grid.
  pure subroutine restrict_gap(reduced_gap, width, cells, coarse, info)
    real(dp), intent(in) :: reduced_gap(:)
    integer, intent(in) :: width, cells
    real(dp), allocatable, intent(out) :: coarse(:)
    type(fuge_info), intent(inout) :: info
    integer :: first, last, k, stat

    allocate (coarse(cells), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the gaps on '//text(cells)//' cells')
      return
    end if
    do k = 1, cells
      first = (k - 1)*width + 1
      last = min(k*width, size(reduced_gap))
      coarse(k) = sum(reduced_gap(first:last))/real(last - first + 1, dp)
    end do
  end subroutine restrict_gap

end module fuge_iterative_engine
