!> A contact problem from matrices in files: an influence matrix, or the stiffness matrix of a body and its contact
!> points.
module matrix_problem
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
  use command_line, only: arguments, refuse
  use contact_table, only: write_contact, write_displacements
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_options, fuge_problem, fuge_proof, fuge_solution, FUGE_ERR_MODES
  use matrix_body, only: elastic_body
  use matrix_files, only: read_square, read_vector, read_modes
  use number_words, only: number_text, read_integer, read_real
  use problem_solution, only: prove, solve, take_warning
  use progress_log, only: progress
  implicit none
  private

  public :: solve_body, solve_influence

contains

  !> --alpha.
  subroutine solve_influence(given, options, log, info)
    type(arguments), intent(in) :: given
    type(fuge_options), intent(in) :: options
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable, target :: alpha(:, :)
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_proof) :: proof

    call read_square(given%file('alpha'), alpha, info)
    if (info%failed()) return
    call log%say('influence matrix of '//number_text(size(alpha, 1))//' points is read')
    call read_vector(given%file('gap'), size(alpha, 1), problem%gap, info)
    call take_points(given, problem, info)
    if (.not. info%failed()) call solve(alpha, problem, options, solution, log, info)
    if (given%has('prove') .and. .not. info%failed()) call prove(alpha, problem, solution, proof, log, info)
    if (.not. info%failed()) call write_contact(given%file('output'), problem, solution, proof, info)
  end subroutine solve_influence

  !> --stiffness and --contact.
  subroutine solve_body(given, options, log, info)
    type(arguments), intent(in) :: given
    type(fuge_options), intent(in) :: options
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(elastic_body), target :: body
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_proof) :: proof
    type(fuge_info) :: condensation, recovery
    real(dp), allocatable :: displacement(:)

    call body%read(given, log, condensation)
    info = condensation
    if (info%failed()) return
    call read_vector(given%file('gap'), body%points(), problem%gap, info)
    call take_points(given, problem, info)
    if (.not. info%failed()) call body%pose(problem, info)
    if (.not. info%failed()) call solve(body%condensed%alpha, problem, options, solution, log, info)
    if (size(body%condensed%resultant) > 0) call explain_motions(info)
    if (info%failed()) return
    if (given%has('prove')) call prove(body%condensed%alpha, problem, solution, proof, log, info)
    if (info%failed()) return
    call take_warning(condensation, info)
    if (given%has('field')) then
      call body%recover(solution, displacement, recovery)
      if (.not. recovery%failed()) call write_displacements(given%file('field'), displacement, recovery)
      if (recovery%failed()) then
        info = recovery
        return
      end if
      call take_warning(recovery, info)
    end if
    call write_contact(given%file('output'), problem, solution, proof, info)
  end subroutine solve_body

  !> Of a body that floats, the library counts motions together with those of the counter-body, which the files do not
  !> name: say in the words of the options which motions depend on each other.
  subroutine explain_motions(info)
    type(fuge_info), intent(inout) :: info

    if (info%status /= FUGE_ERR_MODES) return
    if (index(info%message, 'moves no point') > 0) then
      info%message = 'a rigid motion of the body that floats, or of the counter-body, moves no point that may touch: ' &
        //'exclude fewer points, or hold the body by --fixed'
    else
      info%message = 'the body floats (--floats) and the counter-body is free under its load (--load): nothing ' &
        //'resists a motion of both together; prescribe the counter-body by --approach, or hold the body by --fixed'
    end if
  end subroutine explain_motions

  !> What belongs to the points: plays, springs, limits of the forces, excluded ones and motions.
  subroutine take_points(given, problem, info)
    type(arguments), intent(in) :: given
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info

    if (.not. info%failed()) call take_play(given, problem, info)
    if (.not. info%failed()) call take_law(given, 'compliance', size(problem%gap), problem%compliance, info)
    if (.not. info%failed()) call take_limit(given, 'limit', size(problem%gap), problem%limit, info)
    if (.not. info%failed()) call take_limit(given, 'limit-upper', size(problem%gap), problem%limit_upper, info)
    if (.not. info%failed()) call take_excluded(given, problem, info)
    if (.not. info%failed()) call take_motion(given, problem, info)
  end subroutine take_points

  !> Second stops; -1 is none.
  subroutine take_play(given, problem, info)
    type(arguments), intent(in) :: given
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info

    if (.not. given%has('play')) return
    call read_vector(given%file('play'), size(problem%gap), problem%gap_upper, info)
    if (.not. info%failed()) call set_infinite(problem%gap_upper)
  end subroutine take_play

  !> Limits of forces; -1 is none.
  subroutine take_limit(given, name, n, values, info)
    type(arguments), intent(in) :: given
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    real(dp), allocatable, intent(inout) :: values(:)
    type(fuge_info), intent(inout) :: info

    call take_law(given, name, n, values, info)
    if (allocated(values)) call set_infinite(values)
  end subroutine take_limit

  !> A value for each of `n` points, from a file or one for all. Not allocated without the option `name`.
  subroutine take_law(given, name, n, values, info)
    type(arguments), intent(in) :: given
    character(len=*), intent(in) :: name
    integer, intent(in) :: n
    real(dp), allocatable, intent(inout) :: values(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: value
    logical :: is_number

    if (.not. given%has(name)) return
    call read_real(given%settings(given%position(name))%value, value, is_number)
    if (is_number) then
      allocate (values(n), source=value)
    else
      call read_vector(given%file(name), n, values, info)
    end if
  end subroutine take_law

  !> Where a file has -1 there is no stop and no limit.
  subroutine set_infinite(values)
    real(dp), intent(inout) :: values(:)

    where (abs(values + 1.0_dp) <= 0.0_dp) values = ieee_value(1.0_dp, ieee_positive_inf)
  end subroutine set_infinite

  !> Points that --exclude names.
  subroutine take_excluded(given, problem, info)
    type(arguments), intent(in) :: given
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: k

    k = given%position('exclude')
    if (k == 0) return
    allocate (problem%excluded(size(problem%gap)), source=.false.)
    do while (k > 0 .and. .not. info%failed())
      call exclude(given%settings(k)%value, given%settings(k)%source, problem%excluded, info)
      k = given%position('exclude', k)
    end do
  end subroutine take_excluded

  !> Exclude points of a list such as 3,7-9.
  subroutine exclude(list, source, excluded, info)
    character(len=*), intent(in) :: list, source
    logical, intent(inout) :: excluded(:)
    type(fuge_info), intent(inout) :: info
    integer :: first, hyphen, last, begin, length
    logical :: valid, valid_last

    begin = 1
    do while (begin <= len(list) + 1)
      length = index(list(begin:)//',', ',') - 1
      associate (item => list(begin:begin + length - 1))
        hyphen = index(item, '-')
        if (hyphen > 1) then
          call read_integer(item(:hyphen - 1), first, valid)
          call read_integer(item(hyphen + 1:), last, valid_last)
          valid = valid .and. valid_last .and. first <= last
        else
          call read_integer(item, first, valid)
          last = first
        end if
        if (.not. valid) then
          call refuse(source//': "'//item//'" is no number of a point and no range such as 7-9', info)
        else if (first < 1 .or. last > size(excluded)) then
          call refuse(source//': "'//item//'" is not within 1 to '//number_text(size(excluded)), info)
        end if
      end associate
      if (info%failed()) return
      excluded(first:last) = .true.
      begin = begin + length + 1
    end do
  end subroutine exclude

  !> Rigid motions of the counter-body.
  subroutine take_motion(given, problem, info)
    type(arguments), intent(in) :: given
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info
    real(dp) :: value

    if (given%has('modes')) then
      call read_modes(given%file('modes'), given%file('resultant'), size(problem%gap), problem, info)
      if (.not. info%failed()) call prescribe(given, problem, info)
    else if (given%has('load')) then
      call given%number(given%position('load'), value, info)
      problem%resultant = [value]
    else if (given%has('approach')) then
      call given%number(given%position('approach'), value, info)
      problem%resultant = [0.0_dp]
      problem%prescribed = [.true.]
      problem%motion = [value]
    else
      allocate (problem%modes(size(problem%gap), 0), problem%resultant(0))
    end if
  end subroutine take_motion

  !> Motions that --motion prescribes.
  subroutine prescribe(given, problem, info)
    type(arguments), intent(in) :: given
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info
    integer :: k, mode, split
    logical :: valid, valid_value
    real(dp) :: value

    k = given%position('motion')
    if (k == 0) return
    allocate (problem%prescribed(size(problem%modes, 2)), source=.false.)
    allocate (problem%motion(size(problem%modes, 2)), source=0.0_dp)
    do while (k > 0 .and. .not. info%failed())
      associate (word => given%settings(k)%value, source => given%settings(k)%source)
        split = index(word//'=', '=')
        call read_integer(word(:split - 1), mode, valid)
        call read_real(word(min(split, len(word)) + 1:), value, valid_value)
        if (.not. (valid .and. valid_value)) then
          call refuse(source//': the number of a motion and its value are needed, like 2=0.1', info)
        else if (mode < 1 .or. mode > size(problem%prescribed)) then
          call refuse(source//': "'//given%file('modes')//'" has '//number_text(size(problem%prescribed))//' motions', &
                      info)
        else if (problem%prescribed(mode)) then
          call refuse(source//': motion '//number_text(mode)//' is given twice', info)
        else
          problem%prescribed(mode) = .true.
          problem%motion(mode) = value
        end if
      end associate
      k = given%position('motion', k)
    end do
  end subroutine prescribe

end module matrix_problem
