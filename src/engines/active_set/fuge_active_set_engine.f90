!> The engines for a dense matrix, from checked data to an answer and its words.
module fuge_active_set_engine
  use fuge_block_pivoting, only: run_active_set
  use fuge_input_checks, only: LARGEST_EXPONENT
  use fuge_kkt_factor, only: contact_factor
  use fuge_definiteness, only: check_definite
  use fuge_history_type, only: fuge_history
  use fuge_kinds, only: dp
  use fuge_free_modes, only: find_free_way
  use fuge_monitor_type, only: fuge_monitor
  use fuge_options_type, only: fuge_options
  use fuge_initial_set, only: guess_contact_set
  use fuge_problem_type, only: fuge_solution
  use fuge_canonical_problem, only: canonical_problem
  use fuge_initial_states, only: guess_sides
  use fuge_status, only: fuge_info, fuge_status_text, report, FUGE_DONE, FUGE_WARN_NOT_UNIQUE, &
    FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_OVERFLOW
  use fuge_paper_tableau, only: run_phase_one
  use fuge_number_text, only: text
  implicit none
  private

  public :: solve_by_tableau, solve_by_active_set, check_scene, check_magnitudes

  !> Pivots or sets allowed for each row when the caller sets no limit.
  integer, parameter, public :: ITERATIONS_PER_ROW = 50
  !> A negative energy below this part of the coefficients is rounding.
  real(dp), parameter :: PAIR_TOLERANCE = 1.0e-12_dp
  character(len=*), parameter :: PLAIN_FORCES = 'with zero sum'
  character(len=*), parameter :: GENERAL_FORCES = 'without resultant in the free motions'

contains

  !> The paper's engine: Phase I finds the contact set, and the numbers are solved
  !> anew on it, which also mends points that the rounding of the pivots misjudged.
  !>
  !> `alpha` (at least n rows, n columns), `datum` its coefficient nearest to zero, `canonical` of
  !> a checked problem; `state` (n) and `factor` belong to the answer on return.
  subroutine solve_by_tableau(alpha, datum, canonical, options, monitor, history, state, factor, answer, info)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    type(fuge_history), intent(inout) :: history
    integer, intent(out) :: state(:)
    type(contact_factor), intent(inout) :: factor
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    integer :: limit, sets, status

    state = 0
    call check_solvable(alpha, datum, canonical, info)
    if (info%failed()) return
    limit = limit_of(options, size(state) + size(canonical%load))
    call run_phase_one(alpha, datum, canonical, options%pivot_rule, limit, options%keep_history, monitor, history, &
                       state, &
                       info%iterations, status)
    ! Only a limit that was asked for ends the solve; otherwise the set so far will do.
    if (status == FUGE_ERR_ITERATION_LIMIT .and. options%max_iterations == 0) status = FUGE_DONE
    if (status /= FUGE_DONE) then
      call explain(status, limit, count(state /= 0), info)
    else
      call solve_from(alpha, datum, canonical, limit_of(fuge_options(), size(state) + 1), monitor, state, factor, &
                      answer, &
                      sets, info)
    end if
  end subroutine solve_by_tableau

  !> Block principal pivoting. `state` (n): on entry a guess, or none to have one made; on
  !> return the contact set, with its `factor`. `answer%motion` are the motions of the scene.
  subroutine solve_by_active_set(alpha, datum, canonical, options, monitor, state, factor, answer, info)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    type(fuge_options), intent(in) :: options
    class(fuge_monitor), intent(inout) :: monitor
    integer, intent(inout) :: state(:)
    type(contact_factor), intent(inout) :: factor
    type(fuge_solution), intent(inout) :: answer
    type(fuge_info), intent(inout) :: info
    logical :: contact(size(state))
    integer :: sets

    call check_magnitudes(alpha(:size(alpha, 2), :), largest_load(canonical), info)
    ! Opposite forces are in equilibrium only where all motions move both points alike.
    if (canonical%plain .and. .not. info%failed()) call check_pairs(alpha, info)
    if (info%failed()) return
    ! A guess from another problem may know of stops and points that are no more.
    where (canonical%excluded) state = 0
    where (canonical%upper >= huge(1.0_dp)) state = max(state, 0)
    if (.not. any(state /= 0)) then
      if (canonical%plain) then
        call guess_contact_set(alpha, canonical%gap, canonical%load(1), contact, info%products)
        state = merge(1, 0, contact)
      else
        state = merge(1, 0, abs(canonical%start) > 0.0_dp .or. canonical%gap < 0.0_dp)
        call guess_sides(alpha, canonical, state, info%products)
      end if
    end if
    call solve_from(alpha, datum, canonical, limit_of(options, size(state) + 1), monitor, state, factor, answer, sets, &
                    info)
    info%iterations = sets
  end subroutine solve_by_active_set

  !> The size of the resultants, which decides what products with alpha can reach.
  pure function largest_load(canonical) result(load)
    type(canonical_problem), intent(in) :: canonical
    real(dp) :: load

    load = 0.0_dp
    if (size(canonical%load) > 0) load = maxval(abs(canonical%load))
  end function largest_load

  !> From a contact set, found or guessed, to the answer and its words. `sets` counts
  !> those tried.
  subroutine solve_from(alpha, datum, canonical, limit, monitor, state, factor, answer, sets, info)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    integer, intent(inout) :: state(:)
    type(contact_factor), intent(inout) :: factor
    type(fuge_solution), intent(inout) :: answer
    integer, intent(out) :: sets
    type(fuge_info), intent(inout) :: info
    real(dp) :: constant
    integer :: more, status

    ! Without a translation nothing takes up a constant taken out of alpha.
    constant = merge(datum, 0.0_dp, canonical%has_translation)
    call run_active_set(alpha, constant, canonical, limit, monitor, factor, state, answer%force, answer%gap, &
                        answer%motion, sets, status)
    if (status == FUGE_DONE .and. factor%ridge > 0.0_dp) then
      ! A set tried on the way was singular; the last one need not be.
      factor = contact_factor()
      call run_active_set(alpha, constant, canonical, limit, monitor, factor, state, answer%force, answer%gap, &
                          answer%motion, more, status)
      sets = sets + more
    end if
    call explain(status, limit, count(state /= 0), info)
    if (status == FUGE_DONE .and. factor%ridge > 0.0_dp) then
      call report(info, FUGE_WARN_NOT_UNIQUE, 'alpha is singular on the contact: gaps and approach are unique, ' &
                  //'the forces are not; those given are near the least squares')
    else if (status == FUGE_DONE .and. .not. canonical%plain) then
      call report_free_way(canonical, state, answer, info)
    end if
  end subroutine solve_from

  !> Name a motion that the contact does not hold.
  subroutine report_free_way(canonical, state, answer, info)
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: state(:)
    type(fuge_solution), intent(in) :: answer
    type(fuge_info), intent(inout) :: info
    real(dp) :: way(size(canonical%load))

    if (size(way) < 1) return
    call find_free_way(canonical, state, answer%force, answer%gap, way)
    if (.not. any(abs(way) > 0.0_dp)) return
    call report(info, FUGE_WARN_NOT_UNIQUE, 'the contact does not hold motion '//text(canonical%named_motion(way)) &
                //': its value, and the gaps that it moves, are one of many possible; the forces are unique')
  end subroutine report_free_way

  !> What can be refused before anything is factored: FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_NOT_DEFINITE.
  pure subroutine check_scene(alpha, load, info)
    real(dp), intent(in) :: alpha(:, :), load
    type(fuge_info), intent(inout) :: info

    call check_magnitudes(alpha(:size(alpha, 2), :), load, info)
    if (.not. info%failed()) call check_pairs(alpha, info)
  end subroutine check_scene

  !> Refuse an alpha for which a pair of opposite forces gains energy: the cheap part
  !> of definiteness. The contact block itself is seen when it is factored.
  pure subroutine check_pairs(alpha, info)
    real(dp), intent(in) :: alpha(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp) :: own(size(alpha, 2)), energy
    integer :: i, j

    own = [(alpha(j, j), j=1, size(own))]
    do j = 1, size(own)
      do i = j + 1, size(own)
        energy = (own(i) - alpha(i, j)) + (own(j) - alpha(i, j))
        if (energy >= -PAIR_TOLERANCE*(abs(own(i)) + abs(own(j)))) cycle
        call report(info, FUGE_ERR_NOT_DEFINITE, 'alpha is not positive definite: opposite forces at points ' &
                    //text(j)//' and '//text(i)//' store the negative energy '//text(0.5_dp*energy) &
                    //' per force squared; look for a wrong sign')
        return
      end do
    end do
  end subroutine check_pairs

  pure function limit_of(options, rows) result(limit)
    type(fuge_options), intent(in) :: options
    integer, intent(in) :: rows
    integer :: limit

    limit = options%max_iterations
    if (limit == 0) limit = ITERATIONS_PER_ROW*rows
  end function limit_of

  !> Put an engine's status into words.
  pure subroutine explain(status, limit, contacts, info)
    integer, intent(in) :: status, limit, contacts
    type(fuge_info), intent(inout) :: info

    select case (status)
    case (FUGE_DONE)
      return
    case (FUGE_ERR_ITERATION_LIMIT)
      call report(info, status, text(limit)//' iterations were not enough: raise max_iterations (0 allows ' &
                  //text(ITERATIONS_PER_ROW)//' for each row)')
    case (FUGE_ERR_NOT_DEFINITE)
      call report(info, status, 'alpha is singular on the contact set of '//text(contacts) &
                  //' points: remove points that move together')
    case default
      call report(info, status, fuge_status_text(status))
    end select
  end subroutine explain

  !> Refuse what the tableau does not solve: numbers that overflow
  !> (FUGE_ERR_OVERFLOW), an alpha without a unique answer (FUGE_ERR_NOT_DEFINITE).
  subroutine check_solvable(alpha, datum, canonical, info)
    real(dp), intent(in) :: alpha(:, :), datum
    type(canonical_problem), intent(in) :: canonical
    type(fuge_info), intent(inout) :: info
    real(dp) :: constant
    integer :: deficient, status

    call check_magnitudes(alpha(:size(alpha, 2), :), largest_load(canonical), info)
    if (info%failed()) return
    constant = merge(datum, 0.0_dp, canonical%has_translation .and. .not. canonical%plain)
    call check_definite(alpha, constant, canonical%modes, canonical%excluded, deficient, status)
    if (status /= FUGE_DONE) then
      call report(info, status, 'no memory to factor alpha')
    else if (deficient > 0) then
      call report(info, FUGE_ERR_NOT_DEFINITE, 'alpha is not positive definite on forces '//kind_of_forces(canonical) &
                  //': point '//text(deficient)//' and others carry some that store no energy; look for a repeated ' &
                  //'point or a wrong sign at point '//text(deficient))
    end if
  end subroutine check_solvable

  pure function kind_of_forces(canonical) result(words)
    type(canonical_problem), intent(in) :: canonical
    character(len=merge(len(PLAIN_FORCES), len(GENERAL_FORCES), canonical%plain)) :: words

    words = GENERAL_FORCES
    if (canonical%plain) words = PLAIN_FORCES
  end function kind_of_forces

  !> Refuse an alpha whose products with the load leave the range of double precision,
  !> at either end.
  pure subroutine check_magnitudes(alpha, load, info)
    real(dp), intent(in) :: alpha(:, :), load
    type(fuge_info), intent(inout) :: info
    real(dp) :: largest
    integer :: deflection

    largest = maxval(abs(alpha))
    deflection = exponent(largest) + exponent(load)
    if (abs(deflection) > LARGEST_EXPONENT .or. abs(exponent(largest)) > LARGEST_EXPONENT) then
      call report(info, FUGE_ERR_OVERFLOW, 'alpha reaches '//text(largest)//' and alpha times load 2**' &
                  //text(deflection)//': choose units in which they are nearer to 1')
    end if
  end subroutine check_magnitudes

end module fuge_active_set_engine
