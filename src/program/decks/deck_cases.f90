!> The load cases of a structure with one-way links: those with the same supports share one condensation.
module deck_cases
  use chosen_stiffness, only: stored_stiffness
  use deck_model, only: structure
  use fuge_core, only: dp => fuge_dp, fuge_case_solutions, fuge_dense_operator, fuge_info, fuge_load_cases, &
    fuge_options, fuge_problem, fuge_solve_cases, fuge_solver, FUGE_ERR_NO_EQUILIBRIUM
  use fuge_fe, only: fuge_body, fuge_condense, fuge_condensed, fuge_describe_mechanism, fuge_find_mechanism
  use fuge_files, only: fuge_deck_supports
  use number_words, only: number_text, read_integer
  use progress_log, only: progress
  implicit none
  private

  public :: solve_cases

  !> Words of the library before the number of a contact point.
  character(len=*), parameter :: POINT_WORDS = 'contact point '

  !> A column for each case; `report` tells those that have a solution.
  type, public :: case_results
    !> Of the links, (links, cases).
    real(dp), allocatable :: force(:, :), gap(:, :)
    integer, allocatable :: state(:, :)
    !> Of the degrees of freedom, (rows, cases).
    real(dp), allocatable :: displacement(:, :)
    type(fuge_info), allocatable :: report(:)
  end type case_results

  !> Cases with the same supports.
  type :: case_group
    integer, allocatable :: member(:)
    !> Held rows, and their displacements, (fixed, members).
    integer, allocatable :: fixed(:)
    real(dp), allocatable :: displacement(:, :)
  end type case_group

contains

  !> Solve all cases. One that fails does not harm the others. Errors: those of the supports and of the matrix.
  subroutine solve_cases(model, options, results, log, info)
    type(structure), intent(in) :: model
    type(fuge_options), intent(in) :: options
    type(case_results), intent(out) :: results
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(stored_stiffness) :: stiffness
    type(case_group) :: group
    logical, allocatable :: held(:, :)
    real(dp), allocatable :: displaced(:, :)
    logical, allocatable :: solved(:)
    integer :: cases, j, k, links

    cases = model%deck%case_count()
    links = model%deck%link_count()
    call find_supports(model, held, displaced, info)
    if (.not. info%failed()) call stiffness%set_columns(model%column, model%row, model%value, info)
    if (info%failed()) return
    allocate (results%force(links, cases), results%gap(links, cases), results%displacement(model%degrees(), cases))
    allocate (results%state(links, cases), results%report(cases), solved(cases))
    results%force = 0.0_dp
    results%gap = 0.0_dp
    results%displacement = 0.0_dp
    results%state = 0
    solved = .false.
    do k = 1, cases
      if (solved(k)) cycle
      do j = k, cases
        solved(j) = solved(j) .or. all(held(:, j) .eqv. held(:, k))
      end do
      group%member = pack([(j, j=k, cases)], [(all(held(:, j) .eqv. held(:, k)), j=k, cases)])
      group%fixed = pack([(j, j=1, size(held, 1))], held(:, k))
      group%displacement = displaced(group%fixed, group%member)
      call solve_group(model, stiffness, group, options, results)
      call log%say(number_text(count(solved))//' load cases are solved')
    end do
  end subroutine solve_cases

  !> Which rows each case holds, and their displacements, (rows, cases).
  subroutine find_supports(model, held, displaced, info)
    type(structure), intent(in) :: model
    logical, allocatable, intent(out) :: held(:, :)
    real(dp), allocatable, intent(out) :: displaced(:, :)
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: fixed(:)
    real(dp), allocatable :: displacement(:)
    integer :: k

    allocate (held(model%degrees(), model%deck%case_count()), source=.false.)
    allocate (displaced(model%degrees(), model%deck%case_count()), source=0.0_dp)
    do k = 1, model%deck%case_count()
      call fuge_deck_supports(model%deck, k, model%node, model%direction, fixed, displacement, info)
      if (info%failed()) return
      held(fixed, k) = .true.
      displaced(fixed, k) = displacement
    end do
  end subroutine find_supports

  !> Solve the cases of a group.
  subroutine solve_group(model, stiffness, group, options, results)
    type(structure), intent(in) :: model
    type(stored_stiffness), intent(in) :: stiffness
    type(case_group), intent(in) :: group
    type(fuge_options), intent(in) :: options
    type(case_results), intent(inout) :: results
    type(fuge_body) :: body
    type(fuge_case_solutions) :: solutions
    type(fuge_condensed), target :: condensed
    type(fuge_info) :: condensation, step
    real(dp), allocatable :: u(:, :)
    integer :: j

    body%fixed = group%fixed
    body%floats = .true.
    call model%links%attach(body, step)
    if (.not. step%failed()) call fuge_condense(stiffness, body, condensed, step)
    call name_link(model, step%message)
    condensation = step
    allocate (u(model%degrees(), size(group%member)))
    if (.not. step%failed()) call solve_contact(model, group, condensed, options, solutions, step)
    if (.not. step%failed()) &
      call condensed%recover_cases(model%loads(:, group%member), solutions, u, step, group%displacement)
    call condensed%clear()
    do j = 1, size(group%member)
      associate (k => group%member(j))
        if (allocated(solutions%report)) results%report(k) = solutions%report(j)
        if (step%failed()) results%report(k) = step
        if (results%report(k)%failed()) cycle
        if (condensation%status /= 0 .and. results%report(k)%status == 0) then
          results%report(k)%status = condensation%status
          results%report(k)%message = condensation%message
        end if
        results%force(:, k) = solutions%force(:, j)
        results%gap(:, k) = solutions%gap(:, j)
        results%state(:, k) = solutions%state(:, j)
        results%displacement(:, k) = u(:, j)
      end associate
    end do
  end subroutine solve_group

  !> The name of the link, instead of the number of its point, in a message.
  pure subroutine name_link(model, message)
    type(structure), intent(in) :: model
    character(len=*), intent(inout) :: message
    integer :: begin, length, link
    logical :: valid

    begin = index(message, POINT_WORDS)
    if (begin == 0) return
    begin = begin + len(POINT_WORDS)
    length = verify(message(begin:), '0123456789') - 1
    call read_integer(message(begin:begin + length - 1), link, valid)
    if (.not. valid .or. link < 1 .or. link > model%deck%link_count()) return
    message = message(:begin - len(POINT_WORDS) - 1)//trim(model%deck%links(link)%name)//message(begin + length:)
  end subroutine name_link

  !> Forces and gaps of the links in the cases of a group.
  subroutine solve_contact(model, group, condensed, options, solutions, info)
    type(structure), intent(in) :: model
    type(case_group), intent(in) :: group
    type(fuge_condensed), intent(in), target :: condensed
    type(fuge_options), intent(in) :: options
    type(fuge_case_solutions), intent(inout) :: solutions
    type(fuge_info), intent(inout) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_load_cases) :: cases
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_info) :: posing
    integer :: j

    call model%links%pose_cases(condensed, model%loads(:, group%member), problem, cases, info, group%displacement)
    posing = info
    if (.not. info%failed()) call operator%set(condensed%alpha, info)
    if (.not. info%failed()) call fuge_solve_cases(solver, operator, problem, cases, solutions, info, &
                                                        options)
    if (info%failed()) return
    do j = 1, size(group%member)
      if (solutions%report(j)%message == '') solutions%report(j)%message = posing%message
      if (solutions%report(j)%status /= FUGE_ERR_NO_EQUILIBRIUM .or. .not. allocated(cases%load)) cycle
      problem%gap = cases%gap(:, j)
      problem%resultant = cases%load(:, j)
      call explain_mechanism(model, condensed, problem, solutions%report(j))
    end do
  end subroutine solve_contact

  !> Say which links open, and which node moves most, in a case whose loads no link resists.
  subroutine explain_mechanism(model, condensed, problem, report)
    type(structure), intent(in) :: model
    type(fuge_condensed), intent(in) :: condensed
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: report
    type(fuge_info) :: search
    real(dp) :: nowhere(3, 0), u(model%degrees())
    integer :: row

    nowhere = 0.0_dp
    call fuge_find_mechanism(condensed, problem, u, search)
    if (search%failed()) return
    if (.not. any(abs(u) > 0.0_dp)) return
    row = maxloc(abs(u), dim=1)
    call fuge_describe_mechanism(model%links, u, nowhere, int(nowhere), search)
    report%message = 'nothing holds the structure against these loads: '//trim(search%message)//'; node ' &
      //number_text(model%node(row))//' moves most, in direction '//number_text(model%direction(row))
  end subroutine explain_mechanism

end module deck_cases
