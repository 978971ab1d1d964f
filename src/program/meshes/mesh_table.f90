!> The table of contact points of meshes.
module mesh_table
  use contact_table, only: put_status, state_word
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_problem, fuge_solution
  use fuge_fe, only: fuge_joined_bodies
  use mesh_body, only: model_body
  use mesh_pairs, only: mesh_node, model_pair
  use number_words, only: number_text
  use text_table, only: table
  implicit none
  private

  public :: write_points

  !> Nodes without an opposite that are listed on a line.
  integer, parameter :: NODES_ON_A_LINE = 20

contains

  !> A line for each contact point; on standard output if `path` is empty.
  subroutine write_points(path, bodies, pairs, joined, problem, solution, info)
    character(len=*), intent(in) :: path
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), intent(in) :: pairs(:)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    integer :: k

    call csv%create(path, info)
    if (info%failed()) return
    call put_status(csv, info)
    do k = 1, size(pairs)
      call put_pair(csv, k, bodies, pairs(k), joined, solution)
    end do
    call csv%put('pair,body,node,x,y,z,nx,ny,nz,area,force,pressure,gap,state')
    do k = 1, joined%pairs%points()
      call put_point(csv, k, bodies, pairs, joined, problem, solution)
    end do
    call csv%finish(info)
  end subroutine write_points

  !> What a pair is, the force on its contact surface, and the nodes that have no opposite.
  subroutine put_pair(csv, k, bodies, pair, joined, solution)
    type(table), intent(inout) :: csv
    integer, intent(in) :: k
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), intent(in) :: pair
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_solution), intent(in) :: solution
    character(len=:), allocatable :: list
    character(len=90) :: values
    real(dp) :: force(3)
    integer :: i, listed

    force = 0.0_dp
    do i = 1, joined%pairs%points()
      if (joined%pairs%pair(i) /= k) cycle
      force = force + solution%force(i)*pair%action(joined%pairs, i)
    end do
    write (values, '(3(es24.16e3,:,'',''))') force
    call csv%put('# pair '//number_text(k)//': '//pair%name//', force on '//bodies(pair%body(1))%name//': '//values)
    list = ''
    listed = 0
    do i = 1, size(joined%pairs%unpaired_node)
      if (joined%pairs%unpaired_pair(i) /= k) cycle
      list = list//' '//number_text(node_number(bodies(pair%body(1)), joined%pairs%unpaired_node(i)))
      listed = listed + 1
      if (listed < NODES_ON_A_LINE) cycle
      call csv%put('# pair '//number_text(k)//', nodes without an opposite:'//list)
      list = ''
      listed = 0
    end do
    if (listed > 0) call csv%put('# pair '//number_text(k)//', nodes without an opposite:'//list)
  end subroutine put_pair

  !> The number in the file of the node at an index of the arrays of a surface.
  pure function node_number(body, at) result(number)
    type(model_body), intent(in) :: body
    integer, intent(in) :: at
    integer :: number

    number = body%mesh%node(mesh_node(body, at))
  end function node_number

  subroutine put_point(csv, i, bodies, pairs, joined, problem, solution)
    type(table), intent(inout) :: csv
    integer, intent(in) :: i
    type(model_body), intent(in) :: bodies(:)
    type(model_pair), intent(in) :: pairs(:)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    character(len=320) :: values
    real(dp) :: direction(3)
    integer :: node

    associate (found => joined%pairs, body => bodies(pairs(joined%pairs%pair(i))%body(1)))
      node = mesh_node(body, found%node(i))
      direction = 0.0_dp
      direction(:size(found%direction, 1)) = found%direction(:, i)
      write (values, '(10(es24.16e3,'',''))') body%mesh%position(:, node), direction, found%area(i), &
        solution%force(i), solution%force(i)/found%area(i), solution%gap(i)
      call csv%put(number_text(found%pair(i))//','//body%name//','//number_text(body%mesh%node(node))//',' &
                   //trim(values)//trim(state_word(i, problem, solution)))
    end associate
  end subroutine put_point

end module mesh_table
