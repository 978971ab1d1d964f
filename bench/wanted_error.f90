!> Contact to a wanted error: the error that was wanted, the estimate, the true error and the time, beside the best call
!> with a given grid, known in hindsight.
!>
!>     wanted_error [FOLDER [COARSER]]
!>     wanted_error held NUMBER
!>
!> The second form counts how often the estimate held, for so many random rough lines and wanted errors of 1e-2 and
!> 1e-3, against a grid of 2^17 cells. The first one has the time:
!>
!> Contacts with closed forms, and rough ones compared with a fine grid, `COARSER` times coarser to try it. Wanted
!> errors of 1e-2, 1e-3 and 1e-4 on lines, 3e-2, 1e-2 and 3e-3 on areas; the errors are shares of the load in the wrong
!> place. The calls of hindsight have the coarsest grid whose true error is below the wanted one: equal cells by FFT, in
!> powers of two; on a free line with one contact graded cells between its exact ends, 1.25 times more of them at a
!> time; a smooth punch without a grid, where the profile allows it. The time of a round punch is told, but not
!> compared: that the body is round is not known to the others. All times are from the gap as a function to the forces
!> of cells; one thread. Writes a Markdown table, and FOLDER/accuracy.csv: contact, lines or areas, wanted, estimated
!> and true error, seconds, seconds in hindsight.
program wanted_error
  use, intrinsic :: iso_fortran_env, only: output_unit
  use bench_problems, only: whole
  use bench_wanted_contacts, only: AREAS, E_STAR, LINES, make_contact, make_random_line, &
    solve_equal_cells, wanted_contact
  use bench_watch, only: stopwatch
  use fuge, only: dp => fuge_dp, fuge_graded_cells, fuge_halfplane_matrix, fuge_info, fuge_polynomial_profile, &
    fuge_pressing, fuge_resolved_contact, fuge_round_contact, fuge_smooth_contact, fuge_solve_area, fuge_solve_dense, &
    fuge_solve_line, fuge_solve_round_punch, fuge_solve_smooth_punch, FUGE_BY_EQUAL_CELLS, FUGE_BY_SERIES, &
    FUGE_END_CORNER, FUGE_END_EDGE, FUGE_MEAN, FUGE_PERIODIC, FUGE_WARN_ACCURACY
  implicit none

  real(dp), parameter :: WANTED(3) = [1.0e-2_dp, 1.0e-3_dp, 1.0e-4_dp], &
    WANTED_AREA(3) = [3.0e-2_dp, 1.0e-2_dp, 3.0e-3_dp]
  !> No search is longer.
  real(dp), parameter :: MOST_SECONDS = 20.0_dp
  !> Finest grids in hindsight, on a side of an area; more graded ones have no advantage.
  integer, parameter :: FINEST_LINE = 2**18, FINEST_AREA = 2048, MOST_GRADED = 2000

  !> The fastest call of hindsight.
  type :: known_call
    character(len=80) :: name = 'none'
    real(dp) :: time = huge(1.0_dp)
  end type known_call

  call run()

contains

  subroutine run()
    character(len=200) :: folder, word
    integer :: coarser, k, unit

    folder = ''
    coarser = 1
    unit = -1
    if (command_argument_count() > 0) call get_command_argument(1, folder)
    if (command_argument_count() > 1) then
      call get_command_argument(2, word)
      read (word, *) coarser
    end if
    if (folder == 'held') then
      call count_held(coarser)
      return
    end if
    if (folder /= '') then
      open (newunit=unit, file=trim(folder)//'/accuracy.csv', action='write')
      write (unit, '(a)') 'contact,kind,wanted,estimate,true,seconds,hindsight'
    end if
    write (output_unit, '(a)') &
      '| contact | wanted error | estimate | true error | time | by | best given grid | its time |', &
      '| --- | ---: | ---: | ---: | ---: | --- | --- | ---: |'
    do k = 1, size(LINES)
      call measure(LINES(k), WANTED, coarser, unit)
    end do
    do k = 1, size(AREAS)
      call measure(AREAS(k), WANTED_AREA, coarser, unit)
    end do
  end subroutine run

  !> How often is the estimate not below the true error, and by what factor is it above?
  subroutine count_held(number)
    integer, intent(in) :: number
    type(wanted_contact) :: contact
    type(fuge_resolved_contact) :: found
    type(fuge_info) :: info
    real(dp) :: ratio(2*number), share, next
    !> Smaller differences are those of the fine grid.
    real(dp), parameter :: REFERENCE_ERROR = 2.0e-5_dp
    integer :: j, k

    do k = 1, size(ratio)
      if (modulo(k, 2) == 1) call make_random_line((k + 1)/2, contact)
      call solve_once(contact, WANTED(1 + modulo(k, 2)), found, info)
      share = contact%wrong_share(found%x, found%width_x, found%y, found%width_y, found%force)
      ratio(k) = found%pressure_error/share
      if (share <= REFERENCE_ERROR) ratio(k) = max(1.0_dp, ratio(k))
      if (ratio(k) < 1.0_dp) print '(a,i0,a,2(es7.1,a),f4.2,2a,a,2l2)', 'profile ', (k + 1)/2, ', wanted ', &
        WANTED(1 + modulo(k, 2)), ', estimate ', found%pressure_error, ', ', ratio(k), ' times the true error: ', &
        way(found, info), merge(', periodic', ', free    ', contact%boundary == FUGE_PERIODIC), found%at_rim(:2)
    end do
    print '(i0,a,i0)', count(ratio >= 1.0_dp), ' held of ', size(ratio)
    do k = 2, size(ratio)
      next = ratio(k)
      j = k - 1
      do while (j >= 1)
        if (ratio(j) <= next) exit
        ratio(j + 1) = ratio(j)
        j = j - 1
      end do
      ratio(j + 1) = next
    end do
    print '(a,3f8.2)', 'estimate over true error: least, median, largest ', ratio(1), ratio(number), ratio(2*number)
  end subroutine count_held

  subroutine measure(name, errors, coarser, unit)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: errors(:)
    integer, intent(in) :: coarser, unit
    type(wanted_contact) :: contact
    type(fuge_resolved_contact) :: found
    type(fuge_info) :: info
    type(known_call) :: known
    real(dp) :: seconds, true_error
    integer :: k

    call make_contact(name, coarser, contact)
    do k = 1, size(errors)
      call solve_to(contact, errors(k), found, seconds, info)
      true_error = contact%wrong_share(found%x, found%width_x, found%y, found%width_y, found%force)
      known = best_known(contact, errors(k))
      write (output_unit, '(a,3(es7.1,a),7a)') '| '//contact%name//' | ', errors(k), ' | ', found%pressure_error, &
        ' | ', true_error, ' | ', in_milliseconds(seconds), ' | ', way(found, info), ' | ', trim(known%name), ' | ', &
        in_milliseconds(known%time)//' |'
      flush (output_unit)
      if (unit == -1) cycle
      write (unit, '(4a,4(es10.4,a))', advance='no') contact%name, ',', merge('area', 'line', contact%is_area), ',', &
        errors(k), ',', found%pressure_error, ',', true_error, ',', seconds, ','
      if (known%time < huge(1.0_dp)) then
        write (unit, '(es10.4)') known%time
      else
        write (unit, '(a)') 'NaN'
      end if
      flush (unit)
    end do
  end subroutine measure

  function in_milliseconds(seconds) result(words)
    real(dp), intent(in) :: seconds
    character(len=:), allocatable :: words
    character(len=16) :: buffer

    if (seconds >= huge(1.0_dp)) then
      buffer = ''
    else if (seconds < 0.01_dp) then
      write (buffer, '(f8.3,a)') 1.0e3_dp*seconds, ' ms'
    else
      write (buffer, '(f8.1,a)') 1.0e3_dp*seconds, ' ms'
    end if
    words = trim(adjustl(buffer))
  end function in_milliseconds

  !> Method and cells, and whether the wanted error was not reached.
  function way(found, info) result(words)
    type(fuge_resolved_contact), intent(in) :: found
    type(fuge_info), intent(in) :: info
    character(len=:), allocatable :: words

    if (found%method == FUGE_BY_SERIES) then
      words = 'series'
    else
      words = whole(size(found%x))
      if (size(found%y) > 1) words = words//' x '//whole(size(found%y))
      words = words//merge(' equal ', ' graded', found%method == FUGE_BY_EQUAL_CELLS)
    end if
    words = trim(words)
    if (info%status == FUGE_WARN_ACCURACY) words = words//', not reached'
  end function way

  subroutine solve_to(contact, error, found, seconds, info)
    type(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: error
    type(fuge_resolved_contact), intent(inout) :: found
    real(dp), intent(out) :: seconds
    type(fuge_info), intent(out) :: info
    type(stopwatch) :: watch

    do while (.not. watch%enough())
      call watch%start()
      call solve_once(contact, error, found, info)
      call watch%stop()
    end do
    seconds = watch%best
  end subroutine solve_to

  subroutine solve_once(contact, error, found, info)
    type(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: error
    type(fuge_resolved_contact), intent(inout) :: found
    type(fuge_info), intent(out) :: info
    type(fuge_pressing) :: pressing

    pressing%e_star = E_STAR
    pressing%load = contact%load
    pressing%boundary = contact%boundary
    pressing%accuracy = error
    pressing%most_seconds = MOST_SECONDS
    if (contact%is_area) then
      call fuge_solve_area(contact, contact%lower, contact%upper, pressing, found, info)
    else
      call fuge_solve_line(contact, contact%lower(1), contact%upper(1), pressing, found, info)
    end if
    if (info%failed()) error stop 'a contact was not solved'
  end subroutine solve_once

  function best_known(contact, error) result(best)
    type(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: error
    type(known_call) :: best
    type(known_call) :: punch

    call try_punch(contact, punch)
    if (.not. contact%is_area .and. punch%time < huge(1.0_dp)) then
      best = punch
      return
    end if
    call try_graded_cells(contact, error, best)
    call try_equal_cells(contact, error, best)
    ! A round punch is known to be round, which the solves on grids are not told.
    if (punch%time < huge(1.0_dp)) best%name = trim(best%name)//' (round punch: '//in_milliseconds(punch%time)//')'
  end function best_known

  !> Smooth and round contacts without a grid, to rounding.
  subroutine try_punch(contact, best)
    type(wanted_contact), intent(in) :: contact
    type(known_call), intent(inout) :: best
    type(fuge_polynomial_profile) :: profile
    type(fuge_smooth_contact) :: line
    type(fuge_round_contact) :: area
    type(fuge_info) :: info
    type(stopwatch) :: watch
    real(dp), allocatable :: coefficients(:)

    select case (contact%name)
    case ('cylinder', 'sphere')
      coefficients = [0.0_dp, 0.0_dp, 0.5_dp]
    case ('quartic')
      coefficients = [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp]
    case ('cone')
      coefficients = [0.0_dp, 0.5_dp]
    case default
      return
    end select
    profile%lower = merge(0.0_dp, contact%lower(1), contact%is_area)
    profile%upper = contact%upper(1)
    profile%coefficients = coefficients
    do while (.not. watch%enough())
      call watch%start()
      if (contact%is_area) then
        call fuge_solve_round_punch(profile, E_STAR, area, info, load=contact%load)
      else
        call fuge_solve_smooth_punch(profile, E_STAR, contact%load, line, info)
      end if
      call watch%stop()
      if (info%failed()) error stop 'a punch was not solved'
    end do
    best%name = merge('round punch ', 'smooth punch', contact%is_area)
    best%time = watch%best
  end subroutine try_punch

  !> Graded cells between the exact ends of the contact.
  subroutine try_graded_cells(contact, error, best)
    type(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: error
    type(known_call), intent(inout) :: best
    type(stopwatch) :: watch
    real(dp), allocatable :: x(:), width(:), force(:)
    real(dp) :: cells

    if (contact%is_area .or. contact%boundary == FUGE_PERIODIC .or. contact%is_rough()) return
    cells = 12.0_dp
    do while (cells < real(MOST_GRADED, dp))
      watch = stopwatch()
      do while (.not. watch%enough())
        call watch%start()
        call solve_graded_cells(contact, nint(cells), x, width, force)
        call watch%stop()
        if (watch%best > best%time) exit
      end do
      if (watch%best > best%time) return
      if (contact%wrong_share(x, width, [0.0_dp], [1.0_dp], force) <= error) then
        best%name = whole(size(x))//' graded'
        best%time = watch%best
        return
      end if
      cells = 1.25_dp*cells
    end do
  end subroutine try_graded_cells

  subroutine solve_graded_cells(contact, n, x, width, force)
    type(wanted_contact), intent(in) :: contact
    integer, intent(in) :: n
    real(dp), allocatable, intent(out) :: x(:), width(:), force(:)
    real(dp), parameter :: PLACE = 0.5_dp/sqrt(3.0_dp)
    real(dp), allocatable :: alpha(:, :), left(:), right(:), open(:)
    real(dp) :: approach
    type(fuge_info) :: info
    integer :: half, status

    half = n/2
    allocate (x(2*half), width(2*half))
    associate (a => contact%a)
      select case (contact%name)
      case ('wedge')
        call fuge_graded_cells(-a, 0.0_dp, [FUGE_END_EDGE, FUGE_END_CORNER], [2, 0], x(:half), width(:half), info)
        call fuge_graded_cells(0.0_dp, a, [FUGE_END_CORNER, FUGE_END_EDGE], [0, 2], x(half + 1:), width(half + 1:), &
                               info)
      case ('face', 'jumps')
        call fuge_graded_cells(-a, a, [FUGE_END_CORNER, FUGE_END_CORNER], [0, 0], x, width, info)
      case default
        call fuge_graded_cells(-a, a, [FUGE_END_EDGE, FUGE_END_EDGE], [2, 2], x, width, info)
      end select
    end associate
    allocate (alpha(2*half, 2*half), left(2*half), right(2*half), force(2*half), open(2*half))
    call contact%evaluate(x - PLACE*width, 0.0_dp*x, left, status)
    call contact%evaluate(x + PLACE*width, 0.0_dp*x, right, status)
    call fuge_halfplane_matrix(x, width, E_STAR, FUGE_MEAN, alpha, info)
    if (.not. info%failed()) call fuge_solve_dense(alpha, 0.5_dp*(left + right), contact%load, force, open, approach, &
                                                   info)
    if (info%failed()) error stop 'graded cells were not solved'
  end subroutine solve_graded_cells

  !> Equal cells by FFT, in powers of two.
  subroutine try_equal_cells(contact, error, best)
    type(wanted_contact), intent(in) :: contact
    real(dp), intent(in) :: error
    type(known_call), intent(inout) :: best
    type(stopwatch) :: watch
    real(dp), allocatable :: force(:)
    real(dp) :: tolerance
    logical :: solved
    integer :: cells(2), k

    tolerance = max(1.0e-12_dp, min(1.0e-6_dp, 1.0e-3_dp*error))
    cells = [32, 1]
    if (contact%is_area) cells = 16
    do while (cells(1) <= merge(FINEST_AREA, FINEST_LINE, contact%is_area))
      watch = stopwatch()
      do while (.not. watch%enough())
        call watch%start()
        call solve_equal_cells(contact, cells, tolerance, force, solved)
        call watch%stop()
        if (.not. solved) return
        if (watch%best > best%time) exit
      end do
      if (watch%best > best%time) return
      associate (width => (contact%upper - contact%lower)/real(cells, dp))
        if (contact%wrong_share([(contact%lower(1) + width(1)*(real(k, dp) - 0.5_dp), k=1, cells(1))], &
                                spread(width(1), 1, cells(1)), &
                                [(merge(contact%lower(2) + width(2)*(real(k, dp) - 0.5_dp), 0.0_dp, contact%is_area), &
                                  k=1, cells(2))], spread(width(2), 1, cells(2)), force) <= error) then
          best%name = whole(cells(1))
          if (contact%is_area) best%name = trim(best%name)//' x '//whole(cells(2))
          best%name = trim(best%name)//' equal'
          best%time = watch%best
          return
        end if
      end associate
      cells(1) = 2*cells(1)
      if (contact%is_area) cells(2) = cells(1)
    end do
  end subroutine try_equal_cells

end program wanted_error
