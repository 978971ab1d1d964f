!> The load in 10, 50 and 100 increments with a search of the contact in each, beside one solve.
!>
!>     increments [quick]
!>
!> prints a table. Both sides have the same matrix or the same products; the time of one solve is that of operator and
!> solver, the time of increments that of all of them, without the operator. The error is that of the pressure, the
!> fraction of the load in the wrong place: against the forces of the same grid, in double precision refined.
program increments
  use bench_increments, only: load_history
  use bench_problems, only: bench_problem, add_matrix, contact_problem, make_known, make_random, uniform_edges, whole
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_halfplane_operator, fuge_info, fuge_operator, fuge_options, &
    fuge_problem, fuge_solution, fuge_solver, FUGE_MEAN
  implicit none

  integer, parameter :: SIZES(3) = [64, 256, 1024], RANDOM_SIZES(2) = [200, 800], LINES(2) = [12, 16]
  integer, parameter :: COUNTS(3) = [10, 50, 100]
  real(dp), parameter :: OF_LINES = 1.0e-10_dp, OF_REFERENCE = 1.0e-13_dp

  call run()

contains

  subroutine run()
    type(bench_problem), target :: problem
    character(len=8) :: word
    logical :: quick
    integer :: k

    call get_command_argument(1, word)
    quick = word == 'quick'
    write (*, '(a)') '| problem | load | contact sets | products | time | times one solve | error of the pressure |'
    write (*, '(a)') '| --- | --- | ---: | ---: | ---: | ---: | ---: |'
    do k = 1, merge(2, size(SIZES), quick)
      call make_known('quartic', FUGE_MEAN, uniform_edges(SIZES(k)), problem)
      call add_matrix(problem)
      call compare_matrix('quartic '//whole(SIZES(k))//', matrix', problem)
    end do
    do k = 1, merge(1, size(RANDOM_SIZES), quick)
      call make_random(RANDOM_SIZES(k), problem)
      call compare_matrix('random '//whole(RANDOM_SIZES(k))//', matrix', problem)
    end do
    do k = 1, merge(1, size(LINES), quick)
      call make_known('quartic', FUGE_MEAN, uniform_edges(2**LINES(k)), problem)
      call compare_line('quartic 2^'//whole(LINES(k))//', FFT', problem)
    end do
  end subroutine run

  subroutine compare_matrix(name, problem)
    character(len=*), intent(in) :: name
    type(bench_problem), intent(in), target :: problem
    type(load_history) :: history
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:), reference(:)
    integer :: k

    allocate (force(problem%points()), source=0.0_dp)
    do while (.not. watch%enough())
      call watch%start()
      call operator%set(problem%alpha, info)
      call solve_cold(operator, problem, 1.0e-10_dp, force, info)
      call watch%stop()
    end do
    reference = refined(problem, force)
    call write_line(name, 'at once, fuge', info%iterations, info%products, watch%best, watch%best, &
                    error_of(force, reference))
    history%gap = problem%gap
    history%load = problem%load
    history%alpha => problem%alpha
    do k = 1, size(COUNTS)
      call apply_history(history, COUNTS(k), 0, watch%best, reference)
    end do
    do k = 1, size(COUNTS)
      call apply_history(history, COUNTS(k), 1, watch%best, reference)
    end do
  end subroutine compare_matrix

  subroutine compare_line(name, problem)
    character(len=*), intent(in) :: name
    type(bench_problem), intent(in) :: problem
    type(load_history) :: history
    type(fuge_halfplane_operator), target :: operator
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:), reference(:)
    integer :: k

    allocate (force(problem%points()), source=0.0_dp)
    allocate (reference(problem%points()), source=0.0_dp)
    do while (.not. watch%enough())
      call watch%start()
      call operator%set(problem%points(), problem%width(1), problem%e_star, info, problem%element, problem%boundary)
      call solve_cold(operator, problem, OF_LINES, force, info)
      call watch%stop()
    end do
    k = info%iterations
    call write_head(name, 'at once, fuge', k, info%products, watch%best, watch%best)
    call solve_cold(operator, problem, OF_REFERENCE, reference, info)
    call write_error(error_of(force, reference))
    history%gap = problem%gap
    history%load = problem%load
    history%operator => operator
    do k = 1, size(COUNTS)
      call apply_history(history, COUNTS(k), 0, watch%best, reference)
    end do
  end subroutine compare_line

  !> The row of one load history; `most` sets in each increment, 0 for as many as it needs.
  subroutine apply_history(history, count, most, at_once, reference)
    type(load_history), intent(inout) :: history
    integer, intent(in) :: count, most
    real(dp), intent(in) :: at_once, reference(:)
    type(stopwatch) :: watch

    history%most_sets = most
    do while (.not. watch%enough())
      call watch%start()
      call history%apply_in(count)
      call watch%stop()
    end do
    call write_line('', whole(count)//' increments'//trim(merge(', one set each', repeat(' ', 14), most == 1)), &
                    history%sets, history%products, watch%best, at_once, error_of(history%force, reference))
  end subroutine apply_history

  subroutine solve_cold(operator, problem, tolerance, force, info)
    class(fuge_operator), intent(in) :: operator
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: tolerance
    real(dp), intent(inout) :: force(:)
    type(fuge_info), intent(out) :: info
    type(fuge_problem) :: contact
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver

    contact = contact_problem(problem)
    call solver%solve(operator, contact, solution, info, fuge_options(tolerance=tolerance))
    if (info%failed()) error stop 'not solved'
    force = solution%force
  end subroutine solve_cold

  !> Forces of the same contact set by its factor, with two steps of refinement.
  function refined(problem, force) result(exact)
    use bench_lapack, only: dpotrf, dpotrs
    type(bench_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    real(dp), allocatable :: exact(:)
    real(dp), allocatable :: block(:, :), factor(:, :), right(:, :), found(:)
    integer, allocatable :: set(:)
    real(dp) :: approach
    integer :: info, k, m, round

    set = pack([(k, k=1, size(force))], force > 0.0_dp)
    m = size(set)
    block = problem%alpha(set, set)
    factor = block
    call dpotrf('L', m, factor, m, info)
    if (info /= 0) error stop 'the contact block is not positive definite'
    allocate (right(m, 2), found(m))
    found = 0.0_dp
    do round = 1, 3
      right(:, 1) = -problem%gap(set) - matmul(block, found)
      right(:, 2) = 1.0_dp
      call dpotrs('L', m, 2, factor, m, right, m, info)
      approach = (problem%load - sum(found) - sum(right(:, 1)))/sum(right(:, 2))
      found = found + right(:, 1) + approach*right(:, 2)
    end do
    allocate (exact(size(force)), source=0.0_dp)
    exact(set) = found
  end function refined

  pure function error_of(force, reference) result(error)
    real(dp), intent(in) :: force(:), reference(:)
    real(dp) :: error

    error = sum(abs(force - reference))/sum(reference)
  end function error_of

  subroutine write_line(name, load, sets, products, time, at_once, error)
    character(len=*), intent(in) :: name, load
    integer, intent(in) :: sets, products
    real(dp), intent(in) :: time, at_once, error

    call write_head(name, load, sets, products, time, at_once)
    call write_error(error)
  end subroutine write_line

  subroutine write_head(name, load, sets, products, time, at_once)
    character(len=*), intent(in) :: name, load
    integer, intent(in) :: sets, products
    real(dp), intent(in) :: time, at_once
    character(len=24) :: ratio

    ratio = ''
    if (time > at_once) write (ratio, '(f12.1)') time/at_once
    write (*, '(2(a,i0),a,f0.3,a)', advance='no') '| '//name//' | '//load//' | ', sets, ' | ', products, ' | ', &
      1.0e6_dp*time, ' us | '//trim(adjustl(ratio))//' | '
  end subroutine write_head

  subroutine write_error(error)
    real(dp), intent(in) :: error

    write (*, '(es8.1,a)') error, ' |'
  end subroutine write_error

end program increments
