!> Elastic bodies, each with its own stiffness matrix, and pairs of their surfaces become one contact problem.
!>
!> The degrees of freedom of the bodies follow each other, so that the stiffness matrix of all is block-diagonal, and
!> surfaces are paired with their degrees of freedom shifted. Rigid motions that supports leave are part of the
!> unknowns, whichever bodies have them.
module fuge_body_joining
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use, intrinsic :: iso_fortran_env, only: int64
  use fuge_body_type, only: fuge_body
  use fuge_condensation, only: fuge_condensed
  use fuge_contact_pairs_type, only: fuge_contact_pairs, move_pairs
  use fuge_elastic_body_type, only: fuge_elastic_body, fuge_surface_pair, take_body
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_CALL_ORDER, &
    FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_WARN_NO_CONTACT
  implicit none
  private

  public :: fuge_join_bodies

  !> All bodies as one, ready for condensation.
  type, public :: fuge_joined_bodies
    !> Stiffness matrix of all bodies in compressed columns, the upper triangle: for set_columns of any stiffness.
    integer, allocatable :: column(:), row(:)
    !> The entries, force per displacement.
    real(dp), allocatable :: value(:)
    !> Supports, loads and contact points for `fuge_condense`; free rigid motions are found.
    type(fuge_body) :: body
    !> The contact points.
    type(fuge_contact_pairs) :: pairs
    !> Degrees of freedom before those of each body, (bodies + 1): degree of freedom j of body k is j + first(k) here,
    !> and the last element is their total number.
    integer, allocatable :: first(:)
  contains
    procedure :: pose
    procedure :: warn_of_opening
  end type fuge_joined_bodies

  !> Gaps that open by less than this fraction of the largest displacement may open by rounding.
  real(dp), parameter :: NO_OPENING = 1.0e-6_dp

contains

  !> Join elastic bodies and the pairs of their surfaces to one contact problem.
  !>
  !> `bodies` and `surface_pairs`, at least one of each; a surface may be rigid (body 0), and both may be of one body.
  !> Then
  !>
  !>     call stiffness%set_columns(joined%column, joined%row, joined%value, info)    sparse, dense or band
  !>     call fuge_condense(stiffness, joined%body, condensed, info)
  !>     call joined%pose(condensed, problem, info)
  !>     call alpha%set(condensed%alpha, info);  call solver%solve(alpha, problem, solution, info)
  !>     call condensed%recover(solution, displacement, info)
  !>     call joined%warn_of_opening(solution, displacement, info)
  !>
  !> `fuge_solve_bodies` does all this; the steps are for further loads (condensed%set_load, then pose again) and for
  !> problems with more than this, such as excluded points. Bodies may float: joined%body%floats is set, unless a body
  !> has rigid_modes. Points at which supports hold both surfaces are left out. O(n log n) for n faces and entries.
  !> Warning: FUGE_WARN_PAIRS, a node is a contact point of two pairs. Errors, `joined` unchanged, name the body or the
  !> pair: FUGE_ERR_SIZE, FUGE_ERR_CALL_ORDER, FUGE_ERR_DOF, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW,
  !> FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ELEMENT, FUGE_ERR_OPTION, FUGE_ERR_MEMORY; FUGE_ERR_GAP
  !> for a negative play, or where supports hold two surfaces inside each other; FUGE_ERR_MESH as `fuge_find_pairs`, and
  !> for a surface that looks into its body: that is known where its nodes are not only those of its faces, because the
  !> matrix couples each face with the element behind it.
  subroutine fuge_join_bodies(bodies, surface_pairs, joined, info)
    use fuge_body_surfaces, only: greatest_extent, pair_surfaces
    use fuge_face_sides, only: check_face_sides
    use fuge_held_points, only: leave_out_held
    use fuge_symmetric_columns, only: symmetric_columns
    type(fuge_elastic_body), intent(in) :: bodies(:)
    type(fuge_surface_pair), intent(in) :: surface_pairs(:)
    type(fuge_joined_bodies), intent(inout) :: joined
    type(fuge_info), intent(out) :: info
    type(fuge_joined_bodies) :: found
    type(symmetric_columns) :: matrices(size(bodies))
    type(fuge_body) :: own(size(bodies))
    type(fuge_info) :: warning
    integer :: stat

    if (size(bodies) < 1 .or. size(surface_pairs) < 1) then
      call report(info, FUGE_ERR_SIZE, 'there are '//text(size(bodies))//' bodies and '//text(size(surface_pairs)) &
                  //' pairs of surfaces: at least one of each is needed')
      return
    end if
    allocate (found%first(size(bodies) + 1), stat=stat)
    call require_memory(stat, '', size(bodies), 'bodies', info)
    if (.not. info%failed()) call take_bodies(bodies, matrices, own, found%first, info)
    if (.not. info%failed()) call join_columns(matrices, found, info)
    if (.not. info%failed()) call join_supports(own, found%first, found%body, info)
    if (.not. info%failed()) call pair_surfaces(surface_pairs, found%first, found%pairs, info)
    warning = info
    if (.not. info%failed()) call check_face_sides(surface_pairs, matrices, info)
    if (.not. info%failed()) call leave_out_held(found%body, found%first(size(found%first)), &
                                                 greatest_extent(surface_pairs), found%pairs, info)
    if (.not. info%failed()) call set_points(found, info)
    if (info%failed()) return
    call report(info, warning%status, composed_message(warning))
    call move_joined(found, joined)
  end subroutine fuge_join_bodies

  !> Pose the contact problem of all bodies after their condensation: gaps, plays, and the rigid motions that are free.
  !>
  !> Excluded points of `problem` are unchanged. Errors: FUGE_ERR_CALL_ORDER before `fuge_join_bodies` or
  !> `fuge_condense`; FUGE_ERR_SIZE if `condensed` is of other bodies.
  subroutine pose(self, condensed, problem, info)
    class(fuge_joined_bodies), intent(in) :: self
    type(fuge_condensed), intent(in) :: condensed
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(out) :: info

    if (self%pairs%points() < 1) then
      call report(info, FUGE_ERR_CALL_ORDER, 'no bodies have been joined: call fuge_join_bodies first')
    else
      call condensed%pose(self%pairs%gap, problem, info)
    end if
    if (info%failed()) return
    ! Nothing moves freely but the bodies, not even a rigid surface.
    problem%modes = condensed%modes
    problem%resultant = condensed%resultant
    if (allocated(problem%prescribed)) deallocate (problem%prescribed)
    if (allocated(problem%motion)) deallocate (problem%motion)
    if (allocated(problem%motion_stiffness)) deallocate (problem%motion_stiffness)
    if (allocated(problem%gap_upper)) deallocate (problem%gap_upper)
    if (any(self%pairs%gap_upper < ieee_value(1.0_dp, ieee_positive_inf))) problem%gap_upper = self%pairs%gap_upper
  end subroutine pose

  !> Warn if no point touches and every gap opens: loads and supports pull, or all surfaces look into their bodies.
  !>
  !> After `recover` of fuge_condensed, with the `solution` and the `displacement` of all degrees of freedom. `info` has
  !> FUGE_WARN_NO_CONTACT then, unless it has another warning or an error.
  pure subroutine warn_of_opening(self, solution, displacement, info)
    class(fuge_joined_bodies), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: displacement(:)
    type(fuge_info), intent(inout) :: info

    if (info%status /= FUGE_DONE .or. any(abs(solution%force) > 0.0_dp)) return
    if (.not. any(abs(displacement) > 0.0_dp)) return
    if (minval(solution%gap - self%pairs%gap) <= NO_OPENING*maxval(abs(displacement))) return
    call report(info, FUGE_WARN_NO_CONTACT, 'no point touches, and loads and supports open every gap: if they ' &
                //'press, the surfaces of each pair look into their bodies: reverse the order of the nodes of all ' &
                //'their faces')
  end subroutine warn_of_opening

  !> Take over all bodies, and count their degrees of freedom.
  pure subroutine take_bodies(bodies, matrices, own, first, info)
    use fuge_symmetric_columns, only: symmetric_columns
    type(fuge_elastic_body), intent(in) :: bodies(:)
    type(symmetric_columns), intent(inout) :: matrices(:)
    type(fuge_body), intent(inout) :: own(:)
    integer, intent(out) :: first(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    first = 0
    do k = 1, size(bodies)
      call take_body(bodies(k), k, matrices(k), own(k), info)
      if (info%failed()) return
      if (int(first(k), int64) + int(matrices(k)%degrees(), int64) >= int(huge(1), int64)) then
        call report(info, FUGE_ERR_OVERFLOW, 'the bodies up to body '//index_text(k)//' have more degrees of freedom ' &
                    //'than the integers have numbers')
        return
      end if
      first(k + 1) = first(k) + matrices(k)%degrees()
    end do
  end subroutine take_bodies

  !> The block-diagonal stiffness matrix.
  pure subroutine join_columns(matrices, joined, info)
    use fuge_symmetric_columns, only: symmetric_columns
    type(symmetric_columns), intent(in) :: matrices(:)
    type(fuge_joined_bodies), intent(inout) :: joined
    type(fuge_info), intent(inout) :: info
    integer(int64) :: entries
    integer :: begin, k, stat

    entries = 0_int64
    do k = 1, size(matrices)
      entries = entries + int(size(matrices(k)%upper%row), int64)
    end do
    stat = 1
    if (entries < int(huge(1), int64)) &
      allocate (joined%column(joined%first(size(joined%first)) + 1), joined%row(entries), joined%value(entries), &
                stat=stat)
    call require_memory(stat, 'the stiffness matrix of all bodies', info)
    if (stat /= 0) return
    begin = 0
    joined%column(1) = 1
    do k = 1, size(matrices)
      associate (upper => matrices(k)%upper, first => joined%first(k))
        joined%column(first + 2:joined%first(k + 1) + 1) = upper%column(2:) + begin
        joined%row(begin + 1:begin + size(upper%row)) = upper%row + first
        joined%value(begin + 1:begin + size(upper%row)) = upper%value
        begin = begin + size(upper%row)
      end associate
    end do
  end subroutine join_columns

  !> Supports, loads and rigid modes of all bodies.
  pure subroutine join_supports(own, first, body, info)
    type(fuge_body), intent(in) :: own(:)
    integer, intent(in) :: first(:)
    type(fuge_body), intent(inout) :: body
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: modes(:, :)
    integer :: degrees, k, mode_count, stat, supports

    degrees = first(size(first))
    supports = 0
    mode_count = 0
    body%floats = .true.
    do k = 1, size(own)
      if (allocated(own(k)%fixed)) supports = supports + size(own(k)%fixed)
      if (.not. allocated(own(k)%rigid_modes)) cycle
      mode_count = mode_count + size(own(k)%rigid_modes, 2)
      body%floats = .false.
    end do
    allocate (body%fixed(supports), body%displacement(supports), body%load(degrees), modes(degrees, mode_count), &
              stat=stat)
    call require_memory(stat, 'supports and loads of', degrees, 'degrees of freedom', info)
    if (stat /= 0) return
    body%displacement = 0.0_dp
    body%load = 0.0_dp
    modes = 0.0_dp
    supports = 0
    mode_count = 0
    do k = 1, size(own)
      call copy_supports(own(k), first(k), body, supports)
      if (.not. allocated(own(k)%rigid_modes)) cycle
      associate (own_modes => own(k)%rigid_modes)
        modes(first(k) + 1:first(k + 1), mode_count + 1:mode_count + size(own_modes, 2)) = own_modes
        mode_count = mode_count + size(own_modes, 2)
      end associate
    end do
    if (.not. body%floats) call move_alloc(modes, body%rigid_modes)
  end subroutine join_supports

  !> Copy the supports and the load of one body, whose degrees of freedom follow `first`, behind the `supports` that are
  !> there.
  pure subroutine copy_supports(own, first, body, supports)
    type(fuge_body), intent(in) :: own
    integer, intent(in) :: first
    type(fuge_body), intent(inout) :: body
    integer, intent(inout) :: supports
    integer :: n

    if (allocated(own%load)) body%load(first + 1:first + size(own%load)) = own%load
    if (.not. allocated(own%fixed)) return
    n = size(own%fixed)
    body%fixed(supports + 1:supports + n) = own%fixed + first
    if (allocated(own%displacement)) body%displacement(supports + 1:supports + n) = own%displacement
    supports = supports + n
  end subroutine copy_supports

  !> Hand the contact points to the body.
  pure subroutine set_points(joined, info)
    type(fuge_joined_bodies), intent(inout) :: joined
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (joined%body%dof, source=joined%pairs%dof, stat=stat)
    if (stat == 0) allocate (joined%body%normal, source=joined%pairs%normal, stat=stat)
    call require_memory(stat, 'the contact points', info)
  end subroutine set_points

  !> Move all components without a copy.
  pure subroutine move_joined(source, destination)
    type(fuge_joined_bodies), intent(inout) :: source, destination

    call move_alloc(source%column, destination%column)
    call move_alloc(source%row, destination%row)
    call move_alloc(source%value, destination%value)
    call move_alloc(source%first, destination%first)
    call move_alloc(source%body%fixed, destination%body%fixed)
    call move_alloc(source%body%displacement, destination%body%displacement)
    call move_alloc(source%body%load, destination%body%load)
    call move_alloc(source%body%rigid_modes, destination%body%rigid_modes)
    call move_alloc(source%body%dof, destination%body%dof)
    call move_alloc(source%body%normal, destination%body%normal)
    destination%body%floats = source%body%floats
    call move_pairs(source%pairs, destination%pairs)
  end subroutine move_joined

end module fuge_body_joining
