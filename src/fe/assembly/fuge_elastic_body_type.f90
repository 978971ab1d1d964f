!> The bodies of a contact problem, each with its own stiffness and its own numbers, the pairs of their surfaces, and
!> their checks.
module fuge_elastic_body_type
  use fuge_body_type, only: check_load_field, check_supports, fuge_body
  use fuge_contact_pairs_type, only: fuge_pair_options
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_ERR_CALL_ORDER, FUGE_ERR_DOF, &
    FUGE_ERR_NOT_DEFINITE, FUGE_ERR_SIZE
  use fuge_surface_mesh_type, only: fuge_surface_mesh
  use fuge_symmetric_columns, only: symmetric_columns
  implicit none
  private

  public :: check_pair_numbers, copy_data, put_before, take_body

  !> An elastic body: its stiffness matrix, and of `fuge_body` the supports, the load and the rigid modes that the
  !> supports leave; set those for all bodies that float, or for none: then they are found. What else a `fuge_body` has
  !> does not count here: contact points are those of the surfaces. Degrees of freedom count from 1 in each body. Set
  !> components by name, since later versions may add some.
  type, extends(fuge_body), public :: fuge_elastic_body
    !> Stiffness matrix in compressed columns: column j holds the entries
    !> column(j) .. column(j + 1) - 1 of `row` and `value`. Repeated entries are added; both triangles, or one of them.
    integer, allocatable :: column(:), row(:)
    !> The entries, force per displacement.
    real(dp), allocatable :: value(:)
  end type fuge_elastic_body

  !> Two surfaces that may touch. Set components by name, since later versions may add some.
  type, public :: fuge_surface_pair
    !> The body of the contact surface; 0: it is rigid and held in space.
    integer :: contact_body = 1
    !> The body of the opposite surface, which may be the same one; 0: it is rigid and held in space.
    integer :: opposite_body = 2
    !> The surface whose nodes become contact points, with the degrees of freedom of its own body.
    type(fuge_surface_mesh) :: contact
    !> The surface across from it, with the degrees of freedom of its own body.
    type(fuge_surface_mesh) :: opposite
    !> How they are paired: method, normals, play, tied or not.
    type(fuge_pair_options) :: options
  end type fuge_surface_pair

contains

  !> Take over the data of body `k` after their checks: the upper triangle of its stiffness, supports and load.
  !>
  !> Errors, which name the body: FUGE_ERR_CALL_ORDER without a stiffness; FUGE_ERR_SIZE, FUGE_ERR_DOF,
  !> FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_NOT_SYMMETRIC; FUGE_ERR_NOT_DEFINITE for a free degree of freedom
  !> without stiffness; FUGE_ERR_MEMORY.
  pure subroutine take_body(body, k, matrix, own, info)
    type(fuge_elastic_body), intent(in) :: body
    integer, intent(in) :: k
    type(symmetric_columns), intent(inout) :: matrix
    type(fuge_body), intent(inout) :: own
    type(fuge_info), intent(inout) :: info

    if (.not. (allocated(body%column) .and. allocated(body%row) .and. allocated(body%value))) then
      call report(info, FUGE_ERR_CALL_ORDER, 'there is no stiffness: column, row and value are needed')
    else
      call matrix%set(body%column, body%row, body%value, info)
    end if
    if (.not. info%failed()) call copy_data(body%fuge_body, own, info)
    if (.not. info%failed()) call check_supports(own, matrix%degrees(), info)
    if (allocated(own%load) .and. .not. info%failed()) call check_load_field(own%load, matrix%degrees(), info)
    if (.not. info%failed()) call check_diagonal(matrix, own, info)
    if (allocated(own%rigid_modes) .and. .not. info%failed()) then
      if (size(own%rigid_modes, 1) /= matrix%degrees()) call report(info, FUGE_ERR_SIZE, 'rigid_modes has ' &
        //text(size(own%rigid_modes, 1))//' rows: it needs one for each of '//text(matrix%degrees()) &
        //' degrees of freedom')
    end if
    call put_before('body '//index_text(k)//': ', info)
  end subroutine take_body

  !> Copy supports, load and rigid modes of a body.
  pure subroutine copy_data(body, own, info)
    type(fuge_body), intent(in) :: body
    type(fuge_body), intent(inout) :: own
    type(fuge_info), intent(inout) :: info
    integer :: stat

    stat = 0
    if (allocated(body%fixed)) allocate (own%fixed, source=body%fixed, stat=stat)
    if (allocated(body%displacement) .and. stat == 0) allocate (own%displacement, source=body%displacement, stat=stat)
    if (allocated(body%load) .and. stat == 0) allocate (own%load, source=body%load, stat=stat)
    if (allocated(body%rigid_modes) .and. stat == 0) allocate (own%rigid_modes, source=body%rigid_modes, stat=stat)
    call require_memory(stat, 'copies of supports, load and rigid modes', info)
  end subroutine copy_data

  !> Refuse a free degree of freedom without stiffness.
  pure subroutine check_diagonal(matrix, own, info)
    type(symmetric_columns), intent(in) :: matrix
    type(fuge_body), intent(in) :: own
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: terms(:)
    integer :: j, stat

    allocate (terms(matrix%degrees()), stat=stat)
    call require_memory(stat, '', matrix%degrees(), 'degrees of freedom', info)
    if (stat /= 0) return
    call matrix%diagonal(terms)
    if (allocated(own%fixed)) terms(own%fixed) = 1.0_dp
    do j = 1, size(terms)
      if (terms(j) > 0.0_dp) cycle
      call report(info, FUGE_ERR_NOT_DEFINITE, 'degree of freedom '//index_text(j)//' has the stiffness ' &
                  //text(terms(j))//' on the diagonal: make it positive, or fix the degree of freedom')
      return
    end do
  end subroutine check_diagonal

  !> Refuse a pair of surfaces whose bodies or degrees of freedom do not exist. `degrees`: degrees of freedom of each
  !> body. Errors: FUGE_ERR_SIZE, FUGE_ERR_DOF.
  pure subroutine check_pair_numbers(pair, degrees, info)
    type(fuge_surface_pair), intent(in) :: pair
    integer, intent(in) :: degrees(:)
    type(fuge_info), intent(inout) :: info

    call check_surface_numbers(pair%contact, pair%contact_body, 'contact', degrees, info)
    if (.not. info%failed()) call check_surface_numbers(pair%opposite, pair%opposite_body, 'opposite', degrees, info)
    if (info%failed()) return
    if (pair%contact_body == 0 .and. pair%opposite_body == 0) &
      call report(info, FUGE_ERR_SIZE, 'both surfaces are rigid: at least one of them has to belong to a body')
  end subroutine check_pair_numbers

  pure subroutine check_surface_numbers(surface, body, name, degrees, info)
    type(fuge_surface_mesh), intent(in) :: surface
    integer, intent(in) :: body, degrees(:)
    character(len=*), intent(in) :: name
    type(fuge_info), intent(inout) :: info
    integer :: i

    if (body < 0 .or. body > size(degrees)) then
      call report(info, FUGE_ERR_SIZE, name//'_body = '//index_text(body)//' is not one of the '//text(size(degrees)) &
                  //' bodies')
    else if (body == 0) then
      if (.not. allocated(surface%dof)) return
      if (any(surface%dof > 0)) call report(info, FUGE_ERR_DOF, 'the '//name//' surface has degrees of freedom, but ' &
        //'belongs to no body: set '//name//'_body, or leave its dof out if it is rigid')
    else if (.not. allocated(surface%dof)) then
      call report(info, FUGE_ERR_DOF, 'the '//name//' surface has no dof: its nodes need the degrees of freedom of ' &
                  //'body '//index_text(body))
    else if (size(surface%dof) > 0) then
      if (maxval(surface%dof) <= degrees(body)) return
      i = maxloc(maxval(surface%dof, 1), 1)
      call report(info, FUGE_ERR_DOF, 'node '//index_text(i)//' of the '//name//' surface has degree of freedom ' &
                  //index_text(maxval(surface%dof(:, i)))//', but body '//index_text(body)//' has only ' &
                  //text(degrees(body)))
    end if
  end subroutine check_surface_numbers

  !> Put text before the message of an error.
  pure subroutine put_before(prefix, info)
    character(len=*), intent(in) :: prefix
    type(fuge_info), intent(inout) :: info

    if (info%failed()) call report(info, info%status, prefix//composed_message(info))
  end subroutine put_before

end module fuge_elastic_body_type
