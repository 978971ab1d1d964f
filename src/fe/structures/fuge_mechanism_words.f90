!> A mechanism in words: which links open or give way, and how the structure moves.
module fuge_mechanism_words
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_links_type, only: fuge_links
  use fuge_nodal_modes, only: fuge_rigid_modes
  use fuge_number_text, only: index_text, text
  use fuge_lapack, only: dgelsy
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE, FUGE_DONE
  implicit none
  private

  public :: fuge_describe_mechanism

  !> Openings and displacements below this fraction of the largest are none.
  real(dp), parameter :: NOTHING = 1.0e-8_dp
  !> Names of links that are listed, most.
  integer, parameter :: MOST_NAMES = 8

contains

  !> Describe displacements of a mechanism, as `fuge_find_mechanism` returns them, in the message of `info`, whose
  !> status is FUGE_DONE: which links open, and the translation or the rotation of the structure, or, where it does not
  !> move as a rigid body, the degree of freedom that moves most.
  !>
  !> `position` (2 or 3, nodes), length; `dof` (2 or 3, nodes) displacements of the nodes along the axes, 0 for those
  !> that do not move. Without nodes only the links are described. Errors: FUGE_ERR_SIZE,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_MEMORY.
  subroutine fuge_describe_mechanism(links, u, position, dof, info)
    type(fuge_links), intent(in) :: links
    real(dp), intent(in) :: u(:), position(:, :)
    integer, intent(in) :: dof(:, :)
    type(fuge_info), intent(out) :: info
    character(len=:), allocatable :: words
    integer :: k

    if (any(shape(position) /= shape(dof)) .or. all(size(dof, 1) /= [2, 3])) then
      call report(info, FUGE_ERR_SIZE, 'position and dof need a row for each of two or three axes, and a column for ' &
                  //'each node')
    else if (any(dof < 0) .or. any(dof > size(u))) then
      call report(info, FUGE_ERR_SIZE, 'dof has a number that is none of the '//text(size(u))//' degrees of freedom')
    else if (links%last_degree() > size(u)) then
      call report(info, FUGE_ERR_SIZE, 'a link has degree of freedom '//index_text(links%last_degree())//': u has ' &
                  //text(size(u))//' value(s)')
    end if
    if (.not. info%failed()) call check_finite(u, 'u', info)
    do k = 1, size(position, 2)
      if (.not. info%failed()) call check_finite(position(:, k), 'position', info)
    end do
    if (info%failed()) return
    if (.not. any(abs(u) > 0.0_dp)) then
      call report(info, FUGE_DONE, 'nothing moves: the links balance the loads')
      return
    end if
    call list_openings(links, u, words)
    if (size(dof) > 0) call add_movement(u, position, dof, words, info)
    if (.not. info%failed()) call report(info, FUGE_DONE, words)
  end subroutine fuge_describe_mechanism

  !> Which links open, and which give way because their forces are at the limit.
  subroutine list_openings(links, u, words)
    type(fuge_links), intent(in) :: links
    real(dp), intent(in) :: u(:)
    character(len=:), allocatable, intent(out) :: words
    real(dp) :: opening(links%count()), least

    opening = links%openings(u)
    least = NOTHING*maxval(abs(u))
    words = ''
    call list_links(links, opening > least, 'opens', 'open', words)
    if (any(opening < -least) .and. words /= '') words = words//'; '
    call list_links(links, opening < -least, 'gives way', 'give way', words)
    if (words == '') words = 'no link opens'
  end subroutine list_openings

  !> Add 'link a, link b and 3 more open' for those `chosen` (n); nothing if there are none.
  subroutine list_links(links, chosen, one_does, several_do, words)
    type(fuge_links), intent(in) :: links
    logical, intent(in) :: chosen(:)
    character(len=*), intent(in) :: one_does, several_do
    character(len=:), allocatable, intent(inout) :: words
    integer :: k, listed, number

    number = count(chosen)
    if (number < 1) return
    listed = 0
    do k = 1, size(chosen)
      if (.not. chosen(k)) cycle
      listed = listed + 1
      if (listed > MOST_NAMES) exit
      if (listed > 1 .and. listed == number) then
        words = words//' and '
      else if (listed > 1) then
        words = words//', '
      end if
      words = words//trim(links%name(k))
    end do
    if (number > MOST_NAMES) words = words//' and '//text(number - MOST_NAMES)//' more'
    if (number == 1) then
      words = words//' '//one_does
    else
      words = words//' '//several_do
    end if
  end subroutine list_links

  !> '; the structure moves along y', '; .. turns about z', or what moves most.
  subroutine add_movement(u, position, dof, words, info)
    real(dp), intent(in) :: u(:), position(:, :)
    integer, intent(in) :: dof(:, :)
    character(len=:), allocatable, intent(inout) :: words
    type(fuge_info), intent(inout) :: info
    real(dp) :: share(3*size(dof, 1) - 3)
    integer :: d
    logical :: rigid

    d = size(dof, 1)
    call find_rigid_part(u, position, dof, share, rigid, info)
    if (info%failed()) return
    if (.not. rigid) then
      words = words//'; the structure is a mechanism, and degree of freedom '//index_text(maxloc(abs(u), dim=1)) &
              //' moves most'
    else if (any(share(d + 1:) > NOTHING)) then
      words = words//'; the structure turns about '//axes_text(share(d + 1:), d)
    else
      words = words//'; the structure moves along '//axes_text(share(:d), 3)
    end if
  end subroutine add_movement

  !> The axes with a share in a movement. In the plane (d = 2) it turns about z.
  pure function axes_text(share, d) result(words)
    real(dp), intent(in) :: share(:)
    integer, intent(in) :: d
    character(len=13) :: words
    character(len=1), parameter :: AXES(3) = ['x', 'y', 'z']
    integer :: k

    words = ''
    if (d == 2) words = 'z'
    if (d == 2) return
    do k = 1, size(share)
      if (.not. share(k) > NOTHING) cycle
      if (words /= '') words = trim(words)//' and'
      words = adjustl(trim(words)//' '//AXES(k))
    end do
  end function axes_text

  !> Largest displacement of a node by each rigid motion in `u`, relative to the largest displacement of a node;
  !> `rigid`: nothing else is in `u` at the nodes.
  subroutine find_rigid_part(u, position, dof, share, rigid, info)
    real(dp), intent(in) :: u(:), position(:, :)
    integer, intent(in) :: dof(:, :)
    real(dp), intent(out) :: share(:)
    logical, intent(out) :: rigid
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: modes(:, :), factor(:, :), nodal(:), rest(:)
    real(dp) :: work(64*(2 + 2*size(share))), largest
    integer :: pivots(size(share)), j, rank, stat, status

    share = 0.0_dp
    rigid = .false.
    allocate (modes(size(position), size(share)), factor(size(position), size(share)), nodal(size(dof)), &
              rest(max(size(dof), size(share))), stat=stat)
    call require_memory(stat, 'the rigid motions of', size(dof, 2), 'nodes', info)
    if (stat /= 0) return
    modes = fuge_rigid_modes(position)
    nodal = 0.0_dp
    do j = 1, size(dof)
      associate (place => dof(1 + mod(j - 1, size(dof, 1)), 1 + (j - 1)/size(dof, 1)))
        if (place > 0) nodal(j) = u(place)
      end associate
    end do
    largest = maxval(abs(nodal))
    if (.not. largest > 0.0_dp) return
    do j = 1, size(share)
      if (any(abs(modes(:, j)) > 0.0_dp)) modes(:, j) = modes(:, j)/maxval(abs(modes(:, j)))
    end do
    factor = modes
    rest = 0.0_dp
    rest(:size(nodal)) = nodal/largest
    pivots = 0
    call dgelsy(size(nodal), size(share), 1, factor, size(nodal), rest, size(rest), pivots, NOTHING, rank, work, &
                size(work), status)
    share = rest(:size(share))
    rigid = all(abs(nodal/largest - matmul(modes, share)) <= NOTHING)
    share = abs(share)
  end subroutine find_rigid_part

end module fuge_mechanism_words
