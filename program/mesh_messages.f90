!> Messages of the library in the words of the files: nodes and names of bodies instead of their numbers.
module mesh_messages
  use fuge, only: fuge_info
  use mesh_body, only: model_body
  use number_words, only: number_text, read_integer
  implicit none
  private

  public :: explain

  character(len=*), parameter :: DOF_WORDS = 'degree of freedom ', BODY_WORDS = 'body '
  character(len=*), parameter :: AXES = 'xyz'

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
    if (at > 0) body = elastic_place(bodies, elastic)
    call find_number(info%message, DOF_WORDS, k, length, dof)
    if (k > 0) then
      if (size(first) > 0) then
        body = elastic_place(bodies, count(first < dof))
        dof = dof - first(max(count(first < dof), 1))
      end if
      if (body > 0) call name_node(bodies(body), dof, k, length, info%message)
    end if
    if (size(first) == 0) call name_bodies(bodies, info%message)
  end subroutine explain

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
      body = elastic_place(bodies, elastic)
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

  !> The place of an elastic body among all; 0 if there is none.
  pure function elastic_place(bodies, elastic) result(place)
    type(model_body), intent(in) :: bodies(:)
    integer, intent(in) :: elastic
    integer :: place

    place = 0
    if (elastic > 0) place = findloc(bodies%elastic, elastic, dim=1)
  end function elastic_place

  pure subroutine name_node(body, dof, at, length, message)
    type(model_body), intent(in) :: body
    integer, intent(in) :: dof, at, length
    character(len=*), intent(inout) :: message
    character(len=:), allocatable :: axis

    if (dof < 1 .or. dof > body%rows()) return
    associate (direction => body%direction_of_row(dof))
      axis = number_text(direction)
      if (direction >= 1 .and. direction <= len(AXES)) axis = AXES(direction:direction)
    end associate
    message = message(:at - 1)//'node '//body%name//'.'//number_text(body%node_of_row(dof))//' along '//axis &
      //message(at + length:)
  end subroutine name_node

end module mesh_messages
