!> Elastic bodies with their own meshes in contact, from stiffness matrices and surfaces to forces, pressures and
!> displacements in one call.
module fuge_bodies_solution
  use fuge_body_joining, only: fuge_join_bodies, fuge_joined_bodies
  use fuge_condensation, only: fuge_condense, fuge_condensed
  use fuge_contact_pairs_type, only: fuge_contact_pairs, move_pairs
  use fuge_elastic_body_type, only: fuge_elastic_body, fuge_surface_pair
  use fuge_joined_names, only: name_bodies, name_motions, names_motion
  use fuge_kinds, only: dp
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_options_type, only: fuge_options
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_solver_type, only: fuge_solver
  use fuge_status, only: composed_message, fuge_info, report, require_memory, FUGE_DONE
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  public :: fuge_solve_bodies

  !> Bodies in contact; n contact points.
  type, public :: fuge_bodies_contact
    !> Where the contact points are: pair, node, opposite face, direction, area, initial gap.
    type(fuge_contact_pairs) :: pairs
    !> Contact forces, (n), force; negative only at an upper stop and at tied points, where they are the components
    !> along the axes of the force of the contact surface on the opposite one.
    real(dp), allocatable :: force(:)
    !> Gaps under load, (n), length.
    real(dp), allocatable :: gap(:)
    !> Pressures, (n): force over area.
    real(dp), allocatable :: pressure(:)
    !> Motions in the rigid modes that are free, (m); their displacements are part of `displacement`.
    real(dp), allocatable :: motion(:)
    !> Displacements of all degrees of freedom, length: that of degree of freedom j of body k is
    !> displacement(first(k) + j).
    real(dp), allocatable :: displacement(:)
    !> Degrees of freedom before those of each body, (bodies + 1).
    integer, allocatable :: first(:)
    !> The points that touch, (n): those with a contact force.
    logical, allocatable :: touching(:)
  end type fuge_bodies_contact

contains

  !> Solve the contact of elastic bodies from their stiffness matrices, surfaces, supports and loads.
  !>
  !> `stiffness` chooses the storage and takes the matrix of all bodies: fuge_sparse_stiffness for all but small ones,
  !> fuge_dense_stiffness, or fuge_band_stiffness. `bodies` and `surface_pairs` as in `fuge_join_bodies`. `contact` is
  !> replaced on success or warning; info%residual is the certificate of the contact forces. `options` of the solver.
  !> Bodies may float: rigid motions that supports leave are found; displacements have no part of those that contact
  !> does not resist, such as sliding along a plane. For further loads on the same bodies use `fuge_join_bodies`, which
  !> names the steps: there the factor is kept.
  !> Memory and time beyond the factor of K grow with the contact points, those that can touch, not with the surfaces:
  !> options%reach of a pair limits them.
  !> Warnings: those of `solve` of fuge_solver; else that of `fuge_condense`, of `recover` of fuge_condensed, or
  !> FUGE_WARN_PAIRS; FUGE_WARN_NO_CONTACT, where no point touches and all gaps open.
  !> Errors, `contact` unchanged, name the body or the pair: those of `fuge_join_bodies`, `fuge_condense` and `solve`;
  !> degrees of freedom are those of the body named.
  subroutine fuge_solve_bodies(stiffness, bodies, surface_pairs, contact, info, options)
    class(fuge_stiffness), intent(inout) :: stiffness
    type(fuge_elastic_body), intent(in) :: bodies(:)
    type(fuge_surface_pair), intent(in) :: surface_pairs(:)
    type(fuge_bodies_contact), intent(inout) :: contact
    type(fuge_info), intent(out) :: info
    type(fuge_options), intent(in), optional :: options
    type(fuge_options) :: chosen
    type(fuge_joined_bodies) :: joined
    type(fuge_condensed), target :: condensed
    type(fuge_solution) :: solution
    type(fuge_info) :: condensation, recovery, pairing
    real(dp), allocatable :: displacement(:), pressure(:)
    logical, allocatable :: touching(:)
    integer :: stat

    if (present(options)) chosen = options
    call fuge_join_bodies(bodies, surface_pairs, joined, info)
    pairing = info
    if (.not. info%failed()) call stiffness%set_columns(joined%column, joined%row, joined%value, info)
    if (info%failed()) return
    allocate (displacement(joined%first(size(joined%first))), pressure(joined%pairs%points()), &
              touching(joined%pairs%points()), stat=stat)
    call require_memory(stat, '', joined%first(size(joined%first)), 'displacements', info)
    if (stat /= 0) return
    call fuge_condense(stiffness, joined%body, condensed, info)
    condensation = info
    if (.not. info%failed()) then
      call solve(joined, condensed, chosen, solution, info)
      if (names_motion(info)) call name_motions(owners(joined, condensed), info)
    end if
    recovery = info
    if (.not. info%failed()) call condensed%recover(solution, displacement, recovery)
    call condensed%clear()
    if (recovery%failed()) then
      info = recovery
      call name_bodies(joined%first, info)
      return
    end if
    call take_warning(condensation, info)
    call take_warning(recovery, info)
    call name_bodies(joined%first, info)
    call take_warning(pairing, info)
    call joined%warn_of_opening(solution, displacement, info)
    pressure = solution%force/joined%pairs%area
    touching = abs(solution%force) > 0.0_dp
    call move_alloc(displacement, contact%displacement)
    call move_alloc(pressure, contact%pressure)
    call move_alloc(touching, contact%touching)
    call move_contact(joined, solution, contact)
  end subroutine fuge_solve_bodies

  !> Solve the contact problem of the condensed bodies.
  subroutine solve(joined, condensed, options, solution, info)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_condensed), intent(in), target :: condensed
    type(fuge_options), intent(in) :: options
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(inout) :: info
    type(fuge_problem) :: problem
    type(fuge_dense_operator) :: alpha
    type(fuge_solver) :: solver

    call joined%pose(condensed, problem, info)
    if (.not. info%failed()) call alpha%set(condensed%alpha, info)
    if (.not. info%failed()) call solver%solve(alpha, problem, solution, info, options)
  end subroutine solve

  !> The body that each free rigid motion moves.
  function owners(joined, condensed) result(owner)
    type(fuge_joined_bodies), intent(in) :: joined
    type(fuge_condensed), intent(in) :: condensed
    integer :: owner(size(condensed%resultant))
    type(fuge_solution) :: motion
    type(fuge_info) :: info
    real(dp), allocatable :: u(:), moved(:)
    real(dp) :: largest, here
    integer :: j, k, stat

    owner = 0
    allocate (u(size(joined%body%load)), moved(size(joined%body%load)), motion%force(joined%pairs%points()), &
              motion%motion(size(owner)), stat=stat)
    if (stat /= 0) return
    motion%force = 0.0_dp
    motion%motion = 0.0_dp
    call condensed%recover(motion, u, info)
    do j = 1, size(owner)
      motion%motion = 0.0_dp
      motion%motion(j) = 1.0_dp
      if (.not. info%failed()) call condensed%recover(motion, moved, info)
      if (info%failed()) return
      largest = 0.0_dp
      do k = 1, size(joined%first) - 1
        here = maxval(abs(moved(joined%first(k) + 1:joined%first(k + 1)) - u(joined%first(k) + 1:joined%first(k + 1))))
        if (here > largest) owner(j) = k
        largest = max(largest, here)
      end do
    end do
  end function owners

  !> Take over a warning if there is none yet.
  pure subroutine take_warning(other, info)
    type(fuge_info), intent(in) :: other
    type(fuge_info), intent(inout) :: info

    if (info%status /= FUGE_DONE .or. other%status == FUGE_DONE) return
    call report(info, other%status, composed_message(other))
  end subroutine take_warning

  !> Move what joining and the solver have found to the results.
  pure subroutine move_contact(joined, solution, contact)
    type(fuge_joined_bodies), intent(inout) :: joined
    type(fuge_solution), intent(inout) :: solution
    type(fuge_bodies_contact), intent(inout) :: contact

    call move_pairs(joined%pairs, contact%pairs)
    call move_alloc(solution%force, contact%force)
    call move_alloc(solution%gap, contact%gap)
    call move_alloc(solution%motion, contact%motion)
    call move_alloc(joined%first, contact%first)
  end subroutine move_contact

end module fuge_bodies_solution
