!> Messages of the library in the words of the files: nodes and names of bodies instead of their numbers.
module mesh_messages
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_solution, FUGE_ERR_NO_EQUILIBRIUM
  use fuge_fe, only: fuge_condensed, fuge_joined_bodies
  use mesh_body, only: model_body
  use number_words, only: number_text, read_integer
  implicit none
  private

  public :: explain, explain_motion

  character(len=*), parameter :: DOF_WORDS = 'degree of freedom ', BODY_WORDS = 'body ', MOTION_WORDS = 'motion '
  character(len=*), parameter :: AXES = 'xyz'
  !> Differences of displacements below this fraction of the largest one count as zero.
  real(dp), parameter :: ROUNDING = 1.0e-6_dp

contains

  !> Replace `body 2` by its name, and say which node a degree of freedom is. `first`: degrees of freedom before those
  !> of each elastic body, if they are numbered in all bodies; empty if in the one body that the message names.
  pure subroutine explain(bodies, first, info)
    type(model_body), intent(in) :: bodies(:)
    integer, intent(in) :: first(:)
    type(fuge_info), intent(inout) :: info
    integer :: at, body, dof, elastic, k, length

    if (info%status == 0) return
    body = 0
    call find_number(info%message, BODY_WORDS, at, length, elastic)
    if (at > 0) body = body_number(bodies, elastic)
    call find_number(info%message, DOF_WORDS, k, length, dof)
    if (k > 0) then
      if (size(first) > 0) then
        body = body_number(bodies, count(first < dof))
        dof = dof - first(max(count(first < dof), 1))
      end if
      if (body > 0) call name_node(bodies(body), dof, k, length, info%message)
    end if
    if (size(first) == 0) call name_bodies(bodies, info%message)
  end subroutine explain

  !> Say, instead of the number of a motion without equilibrium, which body moves how.
  subroutine explain_motion(bodies, joined, condensed, info)
    type(model_body), intent(in) :: bodies(:)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_condensed), intent(in) :: condensed
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: moved(:)
    integer :: at, body, elastic, length, motion

    if (info%status /= FUGE_ERR_NO_EQUILIBRIUM) return
    call find_number(info%message, MOTION_WORDS, at, length, motion)
    if (at == 0) return
    call find_displacement(joined, condensed, motion, moved)
    if (.not. allocated(moved)) return
    elastic = count(joined%first < maxloc(abs(moved), dim=1))
    body = body_number(bodies, elastic)
    if (body == 0) return
    info%message = 'body '//bodies(body)%name//', ' &
      //motion_text(bodies(body), moved(joined%first(elastic) + 1:joined%first(elastic + 1))) &
      //': its loads move it that way without closing a contact, so that no contact forces can balance them: hold it ' &
      //'by --support, or turn the loads'
  end subroutine explain_motion

  !> The displacements by a unit of a rigid motion; unallocated without memory.
  subroutine find_displacement(joined, condensed, motion, moved)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_condensed), intent(in) :: condensed
    integer, intent(in) :: motion
    real(dp), allocatable, intent(out) :: moved(:)
    type(fuge_solution) :: rigid
    type(fuge_info) :: info
    real(dp), allocatable :: rest(:)
    integer :: status

    if (motion < 1 .or. motion > size(condensed%resultant)) return
    allocate (moved(size(joined%body%load)), rest(size(joined%body%load)), rigid%force(joined%pairs%points()), &
              rigid%motion(size(condensed%resultant)), stat=status)
    if (status == 0) then
      rigid%force = 0.0_dp
      rigid%motion = 0.0_dp
      call condensed%recover(rigid, rest, info)
      rigid%motion(motion) = 1.0_dp
      if (.not. info%failed()) call condensed%recover(rigid, moved, info)
      if (.not. info%failed()) then
        moved = moved - rest
        return
      end if
    end if
    if (allocated(moved)) deallocate (moved)
  end subroutine find_displacement

  !> What a rigid motion of a body is, from the displacements of its rows.
  pure function motion_text(body, moved) result(text)
    type(model_body), intent(in) :: body
    real(dp), intent(in) :: moved(:)
    character(len=:), allocatable :: text
    real(dp) :: least(len(AXES)), most(len(AXES))
    integer :: axis, row

    least = huge(1.0_dp)
    most = -huge(1.0_dp)
    do row = 1, size(moved)
      axis = body%direction_of_row(row)
      if (axis < 1 .or. axis > len(AXES)) cycle
      least(axis) = min(least(axis), moved(row))
      most(axis) = max(most(axis), moved(row))
    end do
    ! Axes that no row has.
    where (least > most)
      least = 0.0_dp
      most = 0.0_dp
    end where
    axis = maxloc(max(-least, most), dim=1)
    text = 'a rotation'
    if (all(most - least <= ROUNDING*maxval(abs(moved)))) then
      text = 'displacement aslant'
      if (all(max(-least, most) <= ROUNDING*maxval(abs(moved)) .or. [1, 2, 3] == axis)) &
        text = 'displacement along '//AXES(axis:axis)
    end if
  end function motion_text

  !> Replace the numbers of bodies by their names.
  pure subroutine name_bodies(bodies, message)
    type(model_body), intent(in) :: bodies(:)
    character(len=*), intent(inout) :: message
    integer :: at, begin, body, elastic, length

    begin = 1
    do
      call find_number(message(begin:), BODY_WORDS, at, length, elastic)
      if (at == 0) exit
      begin = begin + at + len(BODY_WORDS) - 1
      body = body_number(bodies, elastic)
      if (body > 0) message = message(:begin - 1)//bodies(body)%name//message(begin + length - len(BODY_WORDS):)
    end do
  end subroutine name_bodies

  !> Where `words` with a number behind them are in a message; 0 if nowhere. `length`: of both.
  pure subroutine find_number(message, words, at, length, number)
    character(len=*), intent(in) :: message, words
    integer, intent(out) :: at, length, number
    integer :: digits
    logical :: valid

    at = index(message, words)
    length = 0
    number = 0
    if (at == 0) return
    digits = verify(message(at + len(words):)//' ', '0123456789') - 1
    call read_integer(message(at + len(words):at + len(words) + digits - 1), number, valid)
    if (.not. valid) at = 0
    length = len(words) + digits
  end subroutine find_number

  !> The number among all bodies of the body with this number among the elastic ones; 0 if there is none.
  pure function body_number(bodies, elastic) result(number)
    type(model_body), intent(in) :: bodies(:)
    integer, intent(in) :: elastic
    integer :: number

    number = 0
    if (elastic > 0) number = findloc(bodies%elastic, elastic, dim=1)
  end function body_number

  pure subroutine name_node(body, dof, at, length, message)
    type(model_body), intent(in) :: body
    integer, intent(in) :: dof, at, length
    character(len=*), intent(inout) :: message
    character(len=:), allocatable :: axis

    if (dof < 1 .or. dof > body%degrees()) return
    associate (direction => body%direction_of_row(dof))
      axis = number_text(direction)
      if (direction >= 1 .and. direction <= len(AXES)) axis = AXES(direction:direction)
    end associate
    message = message(:at - 1)//'node '//body%name//'.'//number_text(body%node_of_row(dof))//' along '//axis &
      //message(at + length:)
  end subroutine name_node

end module mesh_messages
