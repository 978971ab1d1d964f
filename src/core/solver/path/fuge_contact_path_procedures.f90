!> How the course of a contact is followed.
submodule(fuge_contact_path) fuge_contact_path_procedures
  use fuge_active_set_engine, only: solve_by_active_set
  use fuge_canonical_problem, only: canonical_problem, make_canonical
  use fuge_contact_solution, only: allocate_solution, contact_solution
  use fuge_input_checks, only: check_finite
  use fuge_kkt_factor, only: kkt_factor
  use fuge_matrix_checks, only: check_largest, check_pairs
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_matrix_survey, only: matrix_survey
  use fuge_monitor_type, only: monitor_relay
  use fuge_number_text, only: text
  use fuge_options_type, only: fuge_options
  use fuge_parametric_pivoting, only: follow_line
  use fuge_path_certificate, only: path_certificate
  use fuge_path_position, only: load_line, path_position, position_at
  use fuge_path_type, only: move_path, trim_path
  use fuge_problem_bounds, only: begins_with_one
  use fuge_problem_type, only: check_problem, check_load, copy_problem, set_problem
  use fuge_spring_matrix, only: extend_problem, spring_matrix
  use fuge_status, only: composed_message, fuge_status_text, report, require_memory, FUGE_DONE, &
    FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_SIZE, FUGE_ERR_UNSUPPORTED, FUGE_WARN_RESIDUAL
  implicit none

  !> Resultants at the start larger than their change by more than this factor cost parameters no more digits: ties
  !> would be lost, but events that differ are kept apart.
  real(dp), parameter :: LARGEST_ORIGIN = 1.0e3_dp

contains

  module procedure fuge_load_path
    type(fuge_problem) :: problem
    type(load_line) :: line

    call set_problem(gap, load, problem, info)
    if (info%failed()) return
    select type (operator)
    class is (fuge_dense_operator)
      call check_start(operator, problem, info)
      if (info%failed()) return
      if (load > 0.0_dp) call check_matrix(operator, load, info)
      if (.not. info%failed()) call set_problem(gap, 0.0_dp, problem, info)
      line%last = load
      if (info%failed()) return
      line%start = [0.0_dp]
      line%rate = [1.0_dp]
      call follow(operator, problem, operator, problem, line, path, info)
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'the load path needs the coefficients of a dense operator')
    end select
  end procedure fuge_load_path

  module procedure fuge_follow_path
    type(fuge_problem) :: copy

    select type (operator)
    class is (fuge_dense_operator)
      call check_start(operator, problem, info)
      if (info%failed()) return
      if (begins_with_one(problem)) then
        call follow_from_one(operator, problem, finish, path, info)
      else
        call copy_problem(problem, copy, info)
        if (.not. info%failed()) call follow_from_one(operator, copy, finish, path, info)
      end if
    class default
      call report(info, FUGE_ERR_UNSUPPORTED, 'the path needs the coefficients of a dense operator')
    end select
  end procedure fuge_follow_path

  !> Follow a problem whose arrays begin with 1.
  subroutine follow_from_one(operator, problem, finish, path, info)
    type(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: finish(:)
    type(fuge_path), intent(inout) :: path
    type(fuge_info), intent(inout) :: info

    if (problem%has_springs()) then
      call follow_with_springs(operator, problem, finish, path, info)
    else
      call follow_to_finish(operator, problem, operator, problem, finish, path, info)
    end if
  end subroutine follow_from_one

  !> Compliances and springs on motions become parts of a matrix, and the path is that of the problem without them.
  subroutine follow_with_springs(operator, problem, finish, path, info)
    type(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: finish(:)
    type(fuge_path), intent(inout) :: path
    type(fuge_info), intent(inout) :: info
    type(spring_matrix), target :: springs
    type(fuge_dense_operator) :: with_springs
    type(fuge_problem) :: extended

    call springs%set(operator, problem, info)
    if (.not. info%failed()) call extend_problem(problem, extended, info)
    if (.not. info%failed() .and. extended%is_plain()) call check_load(extended%resultant(1), info)
    if (info%failed()) return
    call springs%as_operator(with_springs)
    call follow_to_finish(operator, problem, with_springs, extended, finish, path, info)
  end subroutine follow_with_springs

  !> From the resultants and prescribed motions of a checked problem to those of `finish` (m). `operator` and `problem`
  !> of the caller, `with_springs` and `extended` the same with springs as parts of the matrix.
  subroutine follow_to_finish(operator, problem, with_springs, extended, finish, path, info)
    type(fuge_dense_operator), intent(in) :: operator, with_springs
    type(fuge_problem), intent(in) :: problem, extended
    real(dp), intent(in) :: finish(:)
    type(fuge_path), intent(inout) :: path
    type(fuge_info), intent(inout) :: info
    type(load_line) :: line

    call check_finish(with_springs, extended, finish, info)
    if (info%failed()) return
    line%start = start_values(problem)
    line%rate = finish - line%start
    line%last = 1.0_dp
    line%origin = 1.0_dp + min(size_ratio(line%start, line%rate), LARGEST_ORIGIN)
    if (extended%points() > problem%points()) then
      line%given = problem
      line%extended = extended
    end if
    call follow(operator, problem, with_springs, extended, line, path, info)
  end subroutine follow_to_finish

  !> Refuse an operator that is not set, and a problem that does not fit it.
  subroutine check_start(operator, problem, info)
    class(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info

    if (operator%points() < 1) then
      call report(info, FUGE_ERR_SIZE, 'the operator has no points: set it before')
    else
      call check_problem(problem, operator%points(), info)
    end if
  end subroutine check_start

  !> Refuse a matrix that is out of range or by whose coefficients a pair of points gains energy.
  pure subroutine check_matrix(operator, load, info)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: load
    type(fuge_info), intent(inout) :: info
    type(matrix_survey) :: survey

    survey = operator%known()
    call check_largest(survey%largest(), load, info)
    if (.not. (survey%pairs_hold .or. info%failed())) call check_pairs(operator%alpha, info)
  end subroutine check_matrix

  !> Refuse an end that no path leads to.
  pure subroutine check_finish(operator, problem, finish, info)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: finish(:)
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info
    type(matrix_survey) :: survey

    survey = operator%known()
    if (size(finish) /= problem%mode_count()) then
      call report(info, FUGE_ERR_SIZE, 'finish has '//text(size(finish))//' value(s): it needs ' &
                  //text(problem%mode_count()))
    else if (size(finish) > 0) then
      call check_finite(finish, 'finish', info)
      if (.not. info%failed()) call check_largest(survey%largest(), maxval(abs(finish)), info)
      if (.not. info%failed() .and. problem%is_plain()) call check_load(finish(1), info)
    end if
  end subroutine check_finish

  !> Resultants at the start, where prescribed the motions, (m).
  pure function start_values(problem) result(values)
    type(fuge_problem), intent(in) :: problem
    real(dp) :: values(problem%mode_count())

    values = 0.0_dp
    if (allocated(problem%resultant)) values = problem%resultant
    if (allocated(problem%prescribed)) where (problem%prescribed) values = problem%motion
  end function start_values

  !> The largest value over the largest change, at most LARGEST_ORIGIN; 0 without values.
  pure function size_ratio(values, changes) result(ratio)
    real(dp), intent(in) :: values(:), changes(:)
    real(dp) :: ratio, largest, change

    ratio = 0.0_dp
    if (size(values) < 1) return
    largest = maxval(abs(values))
    change = maxval(abs(changes))
    if (largest > LARGEST_ORIGIN*change) then
      ratio = LARGEST_ORIGIN
    else if (change > 0.0_dp) then
      ratio = largest/change
    end if
  end function size_ratio

  !> Follow a checked problem along a line whose start, rate and end are set; the rest of `line` is set here. `operator`
  !> and `problem` of the caller, with which the path is certified, `with_springs` and `extended` as for
  !> `follow_to_finish`.
  subroutine follow(operator, problem, with_springs, extended, line, path, info)
    type(fuge_dense_operator), intent(in) :: operator, with_springs
    type(fuge_problem), intent(in) :: problem, extended
    type(load_line), intent(inout) :: line
    type(fuge_path), intent(inout) :: path
    type(fuge_info), intent(inout) :: info
    type(canonical_problem) :: canonical
    type(path_certificate) :: certificate
    type(path_position) :: position
    type(fuge_path) :: followed
    real(dp), allocatable :: no_change(:)
    integer :: stat, status

    call make_canonical(extended, canonical, info)
    if (info%failed()) return
    call canonical%set_matrix(with_springs%alpha, with_springs%datum(), with_springs%known())
    line%points = problem%points()
    allocate (no_change(extended%points()), stat=stat)
    call require_memory(stat, 'changes of', problem%points(), 'gaps', info)
    if (stat /= 0) return
    no_change = 0.0_dp
    call canonical%transform_change(no_change, line%rate, line%reduced_gap_rate, line%load_rate, info)
    if (info%failed()) return
    if (canonical%has_translation) line%gap_datum = minval(canonical%gap, mask=.not. canonical%excluded)
    line%flexibility = canonical%survey%largest()
    call find_start(line, canonical, position, info)
    if (info%failed()) return
    call certificate%start(operator, problem, line%start, line%rate, line%origin)
    call follow_line(canonical, line, position, followed, certificate, status)
    if (status == FUGE_DONE) call certificate%finish(position%force(:line%points), line%last, followed)
    if (status == FUGE_DONE) call trim_path(followed, status)
    call explain_end(status, followed%entries, position%parameter, info)
    if (.not. info%failed()) call report_certificate(certificate, info)
    if (info%failed()) return
    info%iterations = followed%entries - 1
    info%contacts = followed%contacts(followed%entries)
    call move_path(followed, path)
  end subroutine follow

  !> The solution at the start. The datum of the gaps is subtracted from those of the problem and, with the datum of
  !> alpha, from its translation.
  subroutine find_start(line, canonical, position, info)
    type(load_line), intent(in) :: line
    type(canonical_problem), intent(inout) :: canonical
    type(path_position), intent(out) :: position
    type(fuge_info), intent(inout) :: info
    type(contact_solution) :: solution
    type(kkt_factor) :: factor
    type(monitor_relay) :: no_monitor
    integer :: status

    call allocate_solution(size(canonical%gap), size(canonical%load), solution, info)
    if (info%failed()) return
    if (starts_unloaded(canonical)) then
      solution%force = 0.0_dp
      solution%motion = 0.0_dp
      canonical%gap = canonical%gap - line%gap_datum
      solution%gap = canonical%gap
    else
      call solve_by_active_set(canonical, fuge_options(), no_monitor, factor, solution, info)
      if (info%failed()) return
      ! The path itself chooses where unresisted motions begin; only the forces have to be unique.
      if (.not. factor%regularisation > 0.0_dp) call report(info, FUGE_DONE, '')
      canonical%gap = canonical%gap - line%gap_datum
      if (canonical%has_translation) solution%motion(1) = solution%motion(1) - (line%gap_datum &
          + canonical%datum*canonical%load(1))
    end if
    call position_at(canonical, line, solution, position, status)
    if (status /= FUGE_DONE) call report(info, status, fuge_status_text(status))
  end subroutine find_start

  !> Is it the plain problem without a load, where the bodies just touch?
  pure function starts_unloaded(canonical)
    type(canonical_problem), intent(in) :: canonical
    logical :: starts_unloaded

    starts_unloaded = canonical%plain
    if (starts_unloaded) starts_unloaded = .not. canonical%load(1) > 0.0_dp
  end function starts_unloaded

  !> Put the status at the end of a path into words.
  pure subroutine explain_end(status, entries, parameter, info)
    integer, intent(in) :: status, entries
    real(dp), intent(in) :: parameter
    type(fuge_info), intent(inout) :: info

    if (status == FUGE_ERR_NO_EQUILIBRIUM) then
      call report(info, status, &
                  'equilibrium ends at parameter '//text(parameter)//' of the path: choose an end before it')
    else if (status /= FUGE_DONE) then
      call report(info, status, 'after '//text(max(entries - 1, 0))//' events: '//fuge_status_text(status))
    end if
  end subroutine explain_end

  !> The largest violation of all pieces is the residual of the path; above the tolerance of a solve it is a warning.
  subroutine report_certificate(certificate, info)
    type(path_certificate), intent(in) :: certificate
    type(fuge_info), intent(inout) :: info
    type(fuge_options) :: defaults

    if (certificate%info%failed()) then
      call report(info, certificate%info%status, composed_message(certificate%info))
      return
    end if
    info%products = info%products + certificate%products
    info%residual = certificate%residual
    if (info%residual > defaults%tolerance) then
      call report(info, FUGE_WARN_RESIDUAL, 'residual '//text(info%residual)//' after parameter ' &
                  //text(certificate%worst_parameter)//' of the path is above the tolerance ' &
                  //text(defaults%tolerance)//': the operator may be too badly conditioned for double precision')
    end if
  end subroutine report_certificate

end submodule fuge_contact_path_procedures
