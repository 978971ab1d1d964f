!> The load cases of a structure with one-way links.
!>
!> Cases with the same supports share one condensation: with u_s the displacements of the supports, zero elsewhere, the
!> load p - K u_s on the held structure has the displacements u - u_s.
module deck_cases
  use chosen_stiffness, only: stored_stiffness
  use deck_model, only: structure
  use fuge, only: dp => fuge_dp, fuge_body, fuge_case_solutions, fuge_condense, fuge_condensed, fuge_deck_supports, &
    fuge_dense_operator, fuge_find_mechanism, fuge_info, fuge_load_cases, fuge_problem, fuge_solve_cases, fuge_solver, &
    FUGE_ERR_NO_EQUILIBRIUM
  use number_words, only: number_text, read_integer
  use progress_log, only: progress
  implicit none
  private

  public :: solve_cases

  !> Words of the library before the number of a contact point.
  character(len=*), parameter :: POINT_WORDS = 'contact point '
  !> Links that a mechanism opens, most that are named, and openings that are none where the largest displacement is 1.
  integer, parameter :: MOST_NAMES = 4
  real(dp), parameter :: NO_OPENING = 1.0e-8_dp

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
    !> Held rows, and the displacements of all rows, (rows, members): zero where not held.
    logical, allocatable :: held(:)
    real(dp), allocatable :: displaced(:, :)
  end type case_group

contains

  !> Solve all cases. One that fails does not harm the others. Errors: those of the supports and of the matrix.
  subroutine solve_cases(model, results, log, info)
    type(structure), intent(in) :: model
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
      group%held = held(:, k)
      group%displaced = displaced(:, group%member)
      call solve_group(model, stiffness, group, results)
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
  subroutine solve_group(model, stiffness, group, results)
    type(structure), intent(in) :: model
    type(stored_stiffness), intent(in) :: stiffness
    type(case_group), intent(in) :: group
    type(case_results), intent(inout) :: results
    type(fuge_body) :: body
    type(fuge_case_solutions) :: solutions
    type(fuge_condensed) :: condensed
    type(fuge_info) :: condensation, step
    integer, allocatable :: points(:)
    real(dp), allocatable :: loads(:, :)
    integer :: j

    points = pack([(j, j=1, model%deck%link_count())], &
                  [(moves(model%body, j, group%held), j=1, model%deck%link_count())])
    body%dof = model%body%dof(:, points)
    body%normal = model%body%normal(:, points)
    body%fixed = pack([(j, j=1, size(group%held))], group%held)
    body%floats = .true.
    call fuge_condense(stiffness, body, condensed, condensation)
    call name_link(model, points, condensation%message)
    step = condensation
    loads = group_loads(model, group)
    if (.not. step%failed()) call solve_contact(model, group, points, condensed, loads, solutions, step)
    if (.not. step%failed()) call recover(group, points, condensed, loads, solutions, results, step)
    call condensed%clear()
    do j = 1, size(group%member)
      associate (k => group%member(j))
        if (allocated(solutions%report)) results%report(k) = solutions%report(j)
        if (step%failed()) results%report(k) = step
        if (results%report(k)%status == 0) call take_warning(condensation, step, results%report(k))
        if (results%report(k)%failed()) cycle
        results%force(:, k) = solutions%force(:, j)
        results%gap(:, k) = solutions%gap(:, j)
        results%state(:, k) = solutions%state(:, j)
      end associate
    end do
  end subroutine solve_group

  !> Does a link move at all, with these rows `held`?
  pure function moves(body, link, held)
    type(fuge_body), intent(in) :: body
    integer, intent(in) :: link
    logical, intent(in) :: held(:)
    logical :: moves
    integer :: k

    moves = .false.
    do k = 1, size(body%dof, 1)
      if (body%dof(k, link) < 1) cycle
      moves = moves .or. (abs(body%normal(k, link)) > 0.0_dp .and. .not. held(body%dof(k, link)))
    end do
  end function moves

  !> A warning of the condensation, or else of the displacements, for a case without one.
  pure subroutine take_warning(condensation, recovery, report)
    type(fuge_info), intent(in) :: condensation, recovery
    type(fuge_info), intent(inout) :: report

    if (condensation%status /= 0) then
      report%status = condensation%status
      report%message = condensation%message
    else if (recovery%status /= 0) then
      report%status = recovery%status
      report%message = recovery%message
    end if
  end subroutine take_warning

  !> The name of the link, instead of the number of its point, in a message.
  pure subroutine name_link(model, points, message)
    type(structure), intent(in) :: model
    integer, intent(in) :: points(:)
    character(len=*), intent(inout) :: message
    integer :: begin, length, point
    logical :: valid

    begin = index(message, POINT_WORDS)
    if (begin == 0) return
    begin = begin + len(POINT_WORDS)
    length = verify(message(begin:), '0123456789') - 1
    call read_integer(message(begin:begin + length - 1), point, valid)
    if (.not. valid .or. point < 1 .or. point > size(points)) return
    message = message(:begin - len(POINT_WORDS) - 1)//trim(model%deck%links(points(point))%name) &
      //message(begin + length:)
  end subroutine name_link

  !> The loads of a group, (rows, members), those of its displaced supports included.
  pure function group_loads(model, group) result(loads)
    type(structure), intent(in) :: model
    type(case_group), intent(in) :: group
    real(dp) :: loads(size(group%held), size(group%member))
    integer :: i, j, k

    loads = model%loads(:, group%member)
    do j = 1, size(loads, 2)
      do i = 1, size(loads, 1)
        if (.not. abs(group%displaced(i, j)) > 0.0_dp) cycle
        do k = model%column(i), model%column(i + 1) - 1
          loads(model%row(k), j) = loads(model%row(k), j) - model%value(k)*group%displaced(i, j)
        end do
      end do
      where (group%held) loads(:, j) = 0.0_dp
    end do
  end function group_loads

  !> Forces and gaps of the links in the cases of a group. Links that are held at both ends are no `points` of the
  !> condensed structure; they move with their supports alone.
  subroutine solve_contact(model, group, points, condensed, loads, solutions, info)
    type(structure), intent(in) :: model
    type(case_group), intent(in) :: group
    integer, intent(in) :: points(:)
    type(fuge_condensed), intent(in) :: condensed
    real(dp), intent(in) :: loads(:, :)
    type(fuge_case_solutions), intent(inout) :: solutions
    type(fuge_info), intent(inout) :: info
    type(fuge_dense_operator) :: operator
    type(fuge_load_cases) :: cases, of_points
    type(fuge_problem) :: posed, problem
    type(fuge_solver) :: solver
    type(fuge_info) :: solving
    real(dp), allocatable, target :: alpha(:, :)
    real(dp) :: no_gap(size(points))
    integer :: i, j, n

    no_gap = 0.0_dp
    call condensed%pose_cases(no_gap, loads, posed, of_points, info)
    if (info%failed()) return
    n = model%deck%link_count()
    cases = of_points
    problem = model%problem
    problem%resultant = condensed%resultant
    allocate (alpha(n, n), problem%modes(n, size(condensed%resultant)))
    alpha = 0.0_dp
    alpha(points, points) = condensed%alpha
    problem%modes = 0.0_dp
    problem%modes(points, :) = condensed%modes
    deallocate (cases%gap)
    allocate (cases%gap(n, size(loads, 2)))
    do j = 1, size(loads, 2)
      do i = 1, n
        cases%gap(i, j) = model%problem%gap(i) + support_opening(model%body, i, group%displaced(:, j))
      end do
      cases%gap(points, j) = cases%gap(points, j) + of_points%gap(:, j)
    end do
    call operator%set(alpha, info)
    if (.not. info%failed()) call fuge_solve_cases(solver, operator, problem, cases, solutions, solving)
    if (solving%failed()) info = solving
    if (info%failed()) return
    posed%gap_upper = model%deck%links(points)%play
    do j = 1, size(loads, 2)
      if (solutions%report(j)%status /= FUGE_ERR_NO_EQUILIBRIUM .or. .not. allocated(cases%load)) cycle
      posed%resultant = cases%load(:, j)
      call explain_mechanism(model, condensed, posed, solutions%report(j))
    end do
  end subroutine solve_contact

  !> Say which links open, and which node moves most, in a case whose loads no link resists.
  subroutine explain_mechanism(model, condensed, posed, report)
    type(structure), intent(in) :: model
    type(fuge_condensed), intent(in) :: condensed
    type(fuge_problem), intent(in) :: posed
    type(fuge_info), intent(inout) :: report
    type(fuge_info) :: search
    real(dp) :: u(model%degrees())
    character(len=:), allocatable :: words
    integer :: k, open, row

    call fuge_find_mechanism(condensed, posed, u, search)
    if (search%failed()) return
    if (.not. any(abs(u) > 0.0_dp)) return
    row = maxloc(abs(u), dim=1)
    open = 0
    words = ''
    do k = 1, model%deck%link_count()
      if (.not. support_opening(model%body, k, u) > NO_OPENING) cycle
      open = open + 1
      if (open <= MOST_NAMES) words = words//', '//trim(model%deck%links(k)%name)
    end do
    if (open > MOST_NAMES) words = words//' and '//number_text(open - MOST_NAMES)//' more'
    report%message = 'nothing holds the structure against these loads: node '//number_text(model%node(row)) &
      //' moves most, in direction '//number_text(model%direction(row))
    if (open > 0) report%message = trim(report%message)//'; these links open: '//words(3:)
  end subroutine explain_mechanism

  !> How far displaced supports open a link.
  pure function support_opening(body, link, displaced) result(opening)
    type(fuge_body), intent(in) :: body
    integer, intent(in) :: link
    real(dp), intent(in) :: displaced(:)
    real(dp) :: opening
    integer :: k

    opening = 0.0_dp
    do k = 1, size(body%dof, 1)
      if (body%dof(k, link) > 0) opening = opening + body%normal(k, link)*displaced(body%dof(k, link))
    end do
  end function support_opening

  !> Displacements of all rows in the cases that are solved.
  subroutine recover(group, points, condensed, loads, solutions, results, info)
    type(case_group), intent(in) :: group
    integer, intent(in) :: points(:)
    type(fuge_condensed), intent(in) :: condensed
    real(dp), intent(in) :: loads(:, :)
    type(fuge_case_solutions), intent(in) :: solutions
    type(case_results), intent(inout) :: results
    type(fuge_info), intent(inout) :: info
    type(fuge_case_solutions) :: of_points
    real(dp), allocatable :: displacement(:, :)

    allocate (displacement(size(loads, 1), size(loads, 2)))
    of_points = solutions
    of_points%force = solutions%force(points, :)
    call condensed%recover_cases(loads, of_points, displacement, info)
    if (.not. info%failed()) results%displacement(:, group%member) = displacement + group%displaced
  end subroutine recover

end module deck_cases
