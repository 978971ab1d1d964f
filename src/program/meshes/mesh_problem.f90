!> Contact of bodies with meshes: from the files to the tables.
module mesh_problem
  use chosen_stiffness, only: stored_stiffness
  use command_line, only: arguments, refuse
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_options, fuge_problem, fuge_solution
  use fuge_fe, only: fuge_condense, fuge_condensed, fuge_elastic_body, fuge_join_bodies, fuge_joined_bodies, &
    fuge_surface_pair
  use mesh_body, only: model_body, read_bodies, refuse_memory
  use mesh_conditions, only: take_conditions
  use mesh_fields, only: check_fields, write_fields
  use mesh_messages, only: explain, explain_motion
  use mesh_names, only: find_nodes
  use mesh_pairs, only: find_pairs, mesh_node, model_pair
  use mesh_table, only: write_points
  use number_words, only: number_text
  use problem_solution, only: solve, take_warning
  use progress_log, only: progress
  implicit none
  private

  public :: solve_meshes

contains

  !> --mesh and --pair.
  subroutine solve_meshes(given, options, log, info)
    type(arguments), intent(in) :: given
    type(fuge_options), intent(in) :: options
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(model_body), allocatable :: bodies(:)
    type(model_pair), allocatable :: pairs(:)
    type(fuge_joined_bodies) :: joined
    type(fuge_condensed), target :: condensed
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_info) :: joining, condensation, opening, recovery
    real(dp), allocatable :: displacement(:)
    integer :: status

    call read_bodies(given, bodies, log, info)
    if (.not. info%failed()) call check_fields(given%file('field'), bodies, info)
    if (.not. info%failed()) call find_pairs(given, bodies, pairs, info)
    if (.not. info%failed()) call take_conditions(given, bodies, info)
    if (.not. info%failed()) call join(bodies, pairs, joined, log, info)
    joining = info
    if (.not. info%failed()) call condense(joined, condensed, bodies, log, info)
    condensation = info
    if (.not. info%failed()) call joined%pose(condensed, problem, info)
    if (.not. info%failed()) call take_excluded(given, bodies, pairs, joined, problem, info)
    if (.not. info%failed()) then
      call solve(condensed%alpha, problem, options, solution, log, info)
      call explain_motion(bodies, joined, condensed, info)
    end if
    if (info%failed()) return
    allocate (displacement(joined%first(size(joined%first))), stat=status)
    if (status /= 0) then
      call refuse_memory('the displacements', info)
      return
    end if
    call condensed%recover(solution, displacement, recovery)
    call condensed%clear()
    if (recovery%failed()) then
      info = recovery
      return
    end if
    call take_warning(condensation, info)
    call take_warning(recovery, info)
    call take_warning(joining, info)
    call joined%warn_of_opening(solution, displacement, opening)
    call take_warning(opening, info)
    call log%say('displacements are found')
    if (given%has('field')) call write_fields(given%file('field'), bodies, pairs, joined, solution, displacement, info)
    if (.not. info%failed()) call write_points(given%file('output'), bodies, pairs, joined, problem, solution, info)
  end subroutine solve_meshes

  !> All bodies as one, with the gaps of their pairs. The matrices of the bodies move away.
  subroutine join(bodies, pairs, joined, log, info)
    type(model_body), intent(inout) :: bodies(:)
    type(model_pair), intent(inout) :: pairs(:)
    type(fuge_joined_bodies), intent(inout) :: joined
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(fuge_elastic_body), allocatable :: elastic(:)
    type(fuge_surface_pair), allocatable :: surfaces(:)
    integer :: i, k

    allocate (elastic(maxval(bodies%elastic)), surfaces(size(pairs)))
    do k = 1, size(bodies)
      if (bodies(k)%elastic > 0) call move_matrix(bodies(k)%matrix, elastic(bodies(k)%elastic))
    end do
    do k = 1, size(pairs)
      surfaces(k) = pairs(k)%surfaces
    end do
    call fuge_join_bodies(elastic, surfaces, joined, info)
    call explain(bodies, [integer ::], info)
    if (info%failed()) return
    call log%say(number_text(joined%pairs%points())//' contact points, ' &
                 //number_text(size(joined%pairs%unpaired_node))//' nodes without an opposite')
    do k = 1, size(pairs)
      call pairs(k)%set_axes(joined%first)
    end do
    do i = 1, joined%pairs%points()
      associate (pair => pairs(joined%pairs%pair(i)))
        if (.not. pair%options%tied) joined%pairs%gap(i) = joined%pairs%gap(i) + pair%clearance
      end associate
    end do
  end subroutine join

  pure subroutine move_matrix(from, to)
    type(fuge_elastic_body), intent(inout) :: from, to

    call move_alloc(from%column, to%column)
    call move_alloc(from%row, to%row)
    call move_alloc(from%value, to%value)
    call move_alloc(from%fixed, to%fixed)
    call move_alloc(from%displacement, to%displacement)
    call move_alloc(from%load, to%load)
  end subroutine move_matrix

  !> The influence matrix of all contact points.
  subroutine condense(joined, condensed, bodies, log, info)
    type(fuge_joined_bodies), intent(inout) :: joined
    type(fuge_condensed), intent(inout) :: condensed
    type(model_body), intent(in) :: bodies(:)
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(stored_stiffness) :: stiffness

    call stiffness%set_columns(joined%column, joined%row, joined%value, info)
    if (.not. info%failed()) then
      deallocate (joined%column, joined%row, joined%value)
      call fuge_condense(stiffness, joined%body, condensed, info)
    end if
    call explain(bodies, joined%first, info)
    if (.not. info%failed()) call log%say(number_text(joined%first(size(joined%first)))//' degrees of freedom are ' &
                                          //'condensed, '//number_text(size(condensed%resultant))//' rigid motions')
  end subroutine condense

  !> Points at the nodes that --exclude names.
  subroutine take_excluded(given, bodies, pairs, joined, problem, info)
    type(arguments), intent(in) :: given
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), intent(in) :: pairs(:)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info
    logical, allocatable :: named(:)
    integer, allocatable :: nodes(:)
    integer :: body, found, i, k

    k = given%position('exclude')
    if (k == 0) return
    allocate (problem%excluded(joined%pairs%points()), source=.false.)
    do while (k > 0)
      call find_nodes(given%settings(k)%value, given%settings(k)%source, bodies, body, nodes, info)
      if (info%failed()) return
      allocate (named(size(bodies(body)%mesh%node)), source=.false.)
      named(nodes) = .true.
      found = 0
      do i = 1, joined%pairs%points()
        if (pairs(joined%pairs%pair(i))%body(1) /= body) cycle
        if (.not. named(mesh_node(bodies(body), joined%pairs%node(i)))) cycle
        problem%excluded(i) = .true.
        found = found + 1
      end do
      if (found == 0) call refuse(given%settings(k)%source//': no node there is a contact point, a node of the first ' &
                                  //'surface of a pair', info)
      if (info%failed()) return
      deallocate (named)
      k = given%position('exclude', k)
    end do
    if (all(problem%excluded)) call refuse('--exclude leaves no contact point', info)
  end subroutine take_excluded

end module mesh_problem
