!> Linear structures with members and supports that carry in one direction only: their data, assembly, and the contact
!> problem that they pose.
module one_way_structures
  use fuge_body_type, only: fuge_body
  use fuge_condensation, only: fuge_condense, fuge_condensed
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info
  use fuge_stiffness_dense, only: fuge_dense_stiffness
  use special_numbers, only: infinity
  implicit none
  private

  public :: add_member, add_row, begin_rows, condense_structure

  !> A structure of nd degrees of freedom and its n one-way rows, members or supports. Row i moves by
  !> u_i = sum over k of normal(k, i) u(dof(k, i)), its gap is gap(i) + u_i, and its force pushes in the direction of
  !> `normal`. A degree of freedom 0 is held.
  type, public :: one_way_structure
    integer :: number = 0
    character(len=12) :: kind = ''
    !> Stiffness of all but the one-way rows, (nd, nd), and the load, (nd).
    real(dp), allocatable :: stiffness(:, :), load(:)
    !> Is the structure a mechanism without its rows?
    logical :: floats = .false.
    !> Rows, (width, n).
    integer, allocatable :: dof(:, :)
    real(dp), allocatable :: normal(:, :)
    !> Their law, (n): slack, play, length per force, largest force at the lower and at the upper stop.
    real(dp), allocatable :: gap(:), play(:), compliance(:), limit(:), limit_upper(:)
  contains
    procedure :: degrees
    procedure :: rows
    procedure :: row_displacement
    procedure :: is_one_sided
  end type one_way_structure

  !> Degrees of freedom of a row.
  integer, parameter :: WIDTH = 4

contains

  pure integer function degrees(self)
    class(one_way_structure), intent(in) :: self

    degrees = size(self%load)
  end function degrees

  pure integer function rows(self)
    class(one_way_structure), intent(in) :: self

    rows = size(self%gap)
  end function rows

  !> Displacement of row `i` if the structure is displaced by `u`, (nd).
  pure function row_displacement(self, i, u) result(moved)
    class(one_way_structure), intent(in) :: self
    integer, intent(in) :: i
    real(dp), intent(in) :: u(:)
    real(dp) :: moved
    integer :: k

    moved = 0.0_dp
    do k = 1, size(self%dof, 1)
      if (self%dof(k, i) > 0) moved = moved + self%normal(k, i)*u(self%dof(k, i))
    end do
  end function row_displacement

  !> Has no row a second stop or a limit?
  pure logical function is_one_sided(self)
    class(one_way_structure), intent(in) :: self

    is_one_sided = minval([self%play, self%limit]) > huge(1.0_dp)
  end function is_one_sided

  !> A structure of `degrees` degrees of freedom without members, loads and rows.
  pure subroutine begin_rows(degrees, structure)
    integer, intent(in) :: degrees
    type(one_way_structure), intent(inout) :: structure

    allocate (structure%stiffness(degrees, degrees), structure%load(degrees), structure%dof(WIDTH, 0), &
              structure%normal(WIDTH, 0), structure%gap(0), structure%play(0), structure%compliance(0), &
              structure%limit(0), structure%limit_upper(0))
    structure%stiffness = 0.0_dp
    structure%load = 0.0_dp
  end subroutine begin_rows

  !> Add the stiffness of a two-way member; `dof` 0 is held.
  pure subroutine add_member(dof, member, structure)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: member(:, :)
    type(one_way_structure), intent(inout) :: structure
    integer :: j, k

    do j = 1, size(dof)
      if (dof(j) < 1) cycle
      do k = 1, size(dof)
        if (dof(k) > 0) structure%stiffness(dof(k), dof(j)) = structure%stiffness(dof(k), dof(j)) &
                                                              + 0.5_dp*(member(k, j) + member(j, k))
      end do
    end do
  end subroutine add_member

  !> Add a one-way row without a second stop and without limits.
  pure subroutine add_row(dof, normal, gap, compliance, structure)
    integer, intent(in) :: dof(:)
    real(dp), intent(in) :: normal(:), gap, compliance
    type(one_way_structure), intent(inout) :: structure
    integer :: all_dof(WIDTH, size(structure%gap) + 1)
    real(dp) :: all_normals(WIDTH, size(structure%gap) + 1)
    integer :: n

    n = size(structure%gap)
    all_dof(:, :n) = structure%dof
    all_normals(:, :n) = structure%normal
    all_dof(:, n + 1) = 0
    all_normals(:, n + 1) = 0.0_dp
    all_dof(:size(dof), n + 1) = dof
    all_normals(:size(dof), n + 1) = merge(normal, 0.0_dp, dof > 0)
    structure%dof = all_dof
    structure%normal = all_normals
    structure%gap = [structure%gap, gap]
    structure%play = [structure%play, infinity()]
    structure%compliance = [structure%compliance, compliance]
    structure%limit = [structure%limit, infinity()]
    structure%limit_upper = [structure%limit_upper, infinity()]
  end subroutine add_row

  !> The influence matrix of the rows, and the contact problem.
  subroutine condense_structure(structure, condensed, problem, info)
    type(one_way_structure), intent(in), target :: structure
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_problem), intent(out) :: problem
    type(fuge_info), intent(out) :: info
    type(fuge_dense_stiffness) :: stiffness
    type(fuge_body) :: body

    call stiffness%set(structure%stiffness, info)
    if (info%failed()) return
    body%load = structure%load
    body%floats = structure%floats
    body%dof = structure%dof
    body%normal = structure%normal
    call fuge_condense(stiffness, body, condensed, info)
    if (info%failed()) return
    ! A structure that does not float has no motions.
    if (size(condensed%resultant) < 1) allocate (problem%modes(structure%rows(), 0), problem%resultant(0))
    call condensed%pose(structure%gap, problem, info)
    if (info%failed()) return
    problem%compliance = structure%compliance
    if (minval(structure%play) <= huge(1.0_dp)) problem%gap_upper = structure%play
    if (minval(structure%limit) <= huge(1.0_dp)) problem%limit = structure%limit
    if (minval(structure%limit_upper) <= huge(1.0_dp)) problem%limit_upper = structure%limit_upper
  end subroutine condense_structure

end module one_way_structures
