!> The data of an elastic body except its stiffness: supports, load, rigid modes and contact
!> points; and their checks.
module fuge_body_type
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: fuge_info, report, FUGE_ERR_SIZE, FUGE_ERR_DOF, FUGE_ERR_MEMORY, FUGE_ERR_OPTION, &
    FUGE_ERR_OVERFLOW
  implicit none
  private

  public :: check_body, check_load_field, check_supports

  !> The data of a body with nd degrees of freedom, numbered from 1. Set components by name, since
  !> later versions may add some.
  !>
  !> Contact point i moves by u_i = sum over k of normal(k,i) u(dof(k,i)), and its contact
  !> force f_i acts on the body as normal(k,i) f_i at dof(k,i): `normal` points into the
  !> body. For a pair of bodies in one stiffness, each column has the degrees of freedom of both
  !> bodies, with normals of opposite directions. Points may move alike, such as a bolt and a gasket at one node.
  type, public :: fuge_body
    !> Fixed degrees of freedom. Not allocated: none.
    integer, allocatable :: fixed(:)
    !> Prescribed displacements of `fixed`, (size(fixed)). Not allocated: zero.
    real(dp), allocatable :: displacement(:)
    !> External load, (nd), force. Not allocated: none.
    real(dp), allocatable :: load(:)
    !> The body floats: find the rigid modes that its supports leave.
    logical :: floats = .false.
    !> Known rigid modes Z, (nd, m), for example by `fuge_rigid_modes`. Not allocated: none, unless
    !> the body floats.
    real(dp), allocatable :: rigid_modes(:, :)
    !> Degrees of freedom of the contact points, (width, n); unused places are 0.
    integer, allocatable :: dof(:, :)
    !> Normals: directions of the contact forces on the body, (width, n).
    real(dp), allocatable :: normal(:, :)
    !> Contact points that supports hold entirely are allowed, and move with the supports alone; otherwise they are
    !> refused.
    logical :: held_points = .false.
  end type fuge_body

contains

  !> Refuse data that do not fit a body with `degrees` degrees of freedom.
  !>
  !> Errors: FUGE_ERR_SIZE; FUGE_ERR_DOF for a degree of freedom out of range or repeated;
  !> FUGE_ERR_NOT_FINITE; FUGE_ERR_OVERFLOW; FUGE_ERR_OPTION for rigid modes that are both supplied
  !> and to be found; FUGE_ERR_MEMORY.
  pure subroutine check_body(body, degrees, info)
    type(fuge_body), intent(in) :: body
    integer, intent(in) :: degrees
    type(fuge_info), intent(inout) :: info

    if (body%floats .and. allocated(body%rigid_modes)) call report(info, FUGE_ERR_OPTION, 'both rigid_modes and ' &
      //'floats are set: supply the rigid modes, or set floats to have them found')
    if (.not. info%failed()) call check_supports(body, degrees, info)
    if (info%failed()) return
    if (allocated(body%load)) call check_load_field(body%load, degrees, info)
    if (.not. info%failed()) call check_contact(body, degrees, info)
  end subroutine check_body

  !> Refuse an external load of another size than `degrees` (FUGE_ERR_SIZE), not finite
  !> (FUGE_ERR_NOT_FINITE) or out of range (FUGE_ERR_OVERFLOW).
  pure subroutine check_load_field(load, degrees, info)
    real(dp), intent(in) :: load(:)
    integer, intent(in) :: degrees
    type(fuge_info), intent(inout) :: info

    if (size(load) /= degrees) then
      call report(info, FUGE_ERR_SIZE, 'load has '//text(size(load))//' value(s): it needs one for each of ' &
                  //text(degrees)//' degrees of freedom')
    else
      call check_finite(load, 'load', info)
      if (.not. info%failed()) call check_range(load, 'load', LARGEST_EXPONENT, info)
    end if
  end subroutine check_load_field

  !> Refuse fixed degrees of freedom that are out of range or repeated, and displacements that do
  !> not fit them.
  pure subroutine check_supports(body, degrees, info)
    type(fuge_body), intent(in) :: body
    integer, intent(in) :: degrees
    type(fuge_info), intent(inout) :: info
    integer, allocatable :: fixed_by(:)
    integer :: k, stat

    if (allocated(body%displacement) .and. .not. allocated(body%fixed)) call report(info, FUGE_ERR_SIZE, &
      'displacement is set, but fixed is not: displacements belong to fixed degrees of freedom')
    if (.not. allocated(body%fixed) .or. info%failed()) return
    if (allocated(body%displacement)) then
      if (size(body%displacement) /= size(body%fixed)) then
        call report(info, FUGE_ERR_SIZE, 'displacement has '//text(size(body%displacement))//' value(s): it needs ' &
                    //'one for each of '//text(size(body%fixed))//' fixed degrees of freedom')
      else
        call check_finite(body%displacement, 'displacement', info)
      end if
      if (info%failed()) return
    end if
    allocate (fixed_by(degrees), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to check the supports')
      return
    end if
    fixed_by = 0
    do k = 1, size(body%fixed)
      associate (dof => body%fixed(k))
        if (dof < 1 .or. dof > degrees) then
          call report(info, FUGE_ERR_DOF, 'fixed('//index_text(k)//') = '//index_text(dof)//' is not one of the ' &
                      //text(degrees)//' degrees of freedom')
          return
        else if (fixed_by(dof) > 0) then
          call report(info, FUGE_ERR_DOF, 'fixed('//index_text(fixed_by(dof))//') and fixed('//index_text(k) &
                      //') are both degree of freedom '//index_text(dof)//': remove one of them')
          return
        end if
        fixed_by(dof) = k
      end associate
    end do
  end subroutine check_supports

  !> Refuse contact points without data or out of range. Points that move alike pass: compliances, gaps and stops decide
  !> whether their forces are unique, and the solver knows these.
  pure subroutine check_contact(body, degrees, info)
    type(fuge_body), intent(in) :: body
    integer, intent(in) :: degrees
    type(fuge_info), intent(inout) :: info
    integer :: i

    if (.not. (allocated(body%dof) .and. allocated(body%normal))) then
      call report(info, FUGE_ERR_SIZE, 'there are no contact points: dof and normal define them')
    else if (size(body%dof) < 1) then
      call report(info, FUGE_ERR_SIZE, 'dof is empty: at least one contact point is needed')
    else if (any(shape(body%dof) /= shape(body%normal))) then
      call report(info, FUGE_ERR_SIZE, 'normal is '//text(size(body%normal, 1))//' by '//text(size(body%normal, 2)) &
                  //', dof '//text(size(body%dof, 1))//' by '//text(size(body%dof, 2))//': they need the same shape')
    end if
    if (info%failed()) return
    do i = 1, size(body%dof, 2)
      call check_point(body%dof(:, i), body%normal(:, i), i, degrees, info)
      if (info%failed()) return
    end do
  end subroutine check_contact

  !> Refuse a contact point whose normal is unusable, or whose degrees of freedom are out of range,
  !> repeated or all absent.
  pure subroutine check_point(dof, normal, i, degrees, info)
    integer, intent(in) :: dof(:), i, degrees
    real(dp), intent(in) :: normal(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    call check_finite(normal, 'contact point '//index_text(i)//': normal', info)
    ! alpha contains squares of normals.
    if (.not. info%failed()) call check_range(normal, 'contact point '//index_text(i)//': normal', &
                                              LARGEST_EXPONENT/4, info)
    if (info%failed()) return
    do k = 1, size(dof)
      if (dof(k) < 0 .or. dof(k) > degrees) then
        call report(info, FUGE_ERR_DOF, 'contact point '//index_text(i)//': dof('//index_text(k)//') = ' &
                    //index_text(dof(k))//' is not one of the '//text(degrees)//' degrees of freedom')
      else if (dof(k) > 0 .and. any(dof(:k - 1) == dof(k))) then
        call report(info, FUGE_ERR_DOF, 'contact point '//index_text(i)//' names degree of freedom ' &
                    //index_text(dof(k))//' twice: add up its normals')
      end if
      if (info%failed()) return
    end do
    if (.not. any(dof > 0 .and. abs(normal) > 0.0_dp)) call report(info, FUGE_ERR_DOF, 'contact point '//index_text(i) &
      //' moves with no degree of freedom: it needs at least one with a normal other than zero')
  end subroutine check_point

  !> Refuse values other than zero outside the range 2**-`most` .. 2**`most`
  !> (FUGE_ERR_OVERFLOW).
  pure subroutine check_range(values, name, most, info)
    real(dp), intent(in) :: values(:)
    character(len=*), intent(in) :: name
    integer, intent(in) :: most
    type(fuge_info), intent(inout) :: info
    integer :: k

    do k = 1, size(values)
      if (.not. abs(values(k)) > 0.0_dp .or. abs(exponent(values(k))) <= most) cycle
      call report(info, FUGE_ERR_OVERFLOW, name//'('//index_text(k)//') = '//text(values(k))//' is out of range: ' &
                  //'choose other units')
      return
    end do
  end subroutine check_range

end module fuge_body_type
