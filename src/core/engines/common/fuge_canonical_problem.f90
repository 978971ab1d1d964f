!> The contact problem in the form that the dense engines solve.
!>
!> Prescribed motions are moved into the gaps, and the free rigid modes are made orthogonal, so that neither
!> their units nor a far-away point of reference costs digits. A resultant that no contact forces can
!> carry is refused here.
module fuge_canonical_problem
  use, intrinsic :: iso_c_binding, only: c_long_long
  use fuge_equilibrium, only: is_in_equilibrium
  use fuge_equilibrium_report, only: report_no_equilibrium
  use fuge_contact_states, only: FUGE_AT_LOWER_STOP, FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER, FUGE_OPEN
  use fuge_kinds, only: dp
  use fuge_limited_equilibrium, only: find_limited_equilibrium
  use fuge_matrix_survey, only: matrix_survey, survey_matrix
  use fuge_number_text, only: index_text
  use fuge_orthogonal_modes, only: bodies_of_modes, make_orthogonal, mode_change, mode_fault
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem
  use fuge_shared_equilibrium, only: find_shared_equilibrium, move_to_edge
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_MODES, FUGE_ERR_NO_EQUILIBRIUM, &
    FUGE_ERR_UNSUPPORTED
  implicit none
  private

  public :: make_canonical

  !> c = gap + alpha f - modes q with R^T f = load; see `fuge_problem` for the conditions on f and c.
  type, public :: canonical_problem
    !> Influence matrix, (at least n rows, n columns), length per force; owned by the caller.
    real(dp), pointer, contiguous :: alpha(:, :) => null()
    !> Its survey, and the number that tells it from other matrices, 0 if there is none.
    type(matrix_survey) :: survey = matrix_survey()
    integer(c_long_long) :: stamp = 0
    !> Taken out of all of alpha, where it costs digits: the coefficient nearest to zero if there is a
    !> translation to take it up, else 0.
    real(dp) :: datum = 0.0_dp
    !> Initial gaps less the displacements by the prescribed motions, (n), length.
    real(dp), allocatable :: gap(:)
    !> Play, (n), length; huge where one-sided.
    real(dp), allocatable :: upper(:)
    !> Limits of the forces at both stops, (n), force, huge where there is none; not allocated without limits.
    real(dp), allocatable :: limit(:), limit_upper(:)
    !> Points that take no part in the contact, (n): their forces are limited to zero.
    logical, allocatable :: excluded(:)
    !> Free rigid modes made orthogonal, (n, m), of size about 1, and the resultants in them, (m).
    real(dp), allocatable :: modes(:, :), load(:)
    !> modes(:, 1) is 1 at every point: a constant in gaps or displacements changes that motion only.
    logical :: has_translation = .false.
    !> Forces at few points that are in equilibrium with the load, (n); not allocated if plain.
    real(dp), allocatable :: feasible_force(:)
    !> The paper's problem: one translation, one-sided, all points.
    logical :: plain = .false.
    !> The ranks that share the points; the arrays are those of this one.
    type(point_space) :: space = point_space()
    !> Number of the body of each point, (n), 0 for a point that no mode moves; not allocated for one body.
    integer, allocatable, private :: body(:)
    !> Positions of the free modes among all, and how to get from `modes` to those given.
    integer, allocatable, private :: free(:)
    type(mode_change), private :: change = mode_change()
    !> Columns of R whose motion is prescribed, (n, m), zero where free; not allocated if there are none.
    real(dp), allocatable, private :: prescribed_modes(:, :)
    logical, allocatable, private :: prescribed(:)
    !> Excluded points and their rows of R: the orthogonal modes are zero there.
    integer, allocatable, private :: excluded_points(:)
    real(dp), allocatable, private :: excluded_rows(:, :)
  contains
    procedure :: set_again
    procedure :: set_matrix
    procedure :: mode_count
    procedure :: is_tied
    procedure :: has_limits
    procedure :: pushes
    procedure :: slack
    procedure :: force_range
    procedure :: to_given_modes
    procedure :: largest_load
    procedure :: is_carried_by
    procedure :: force_scale
    procedure :: has_bodies
    procedure :: transform_change
    procedure :: largest_loads
    procedure :: set_excluded_gaps
    procedure :: set_excluded_gaps_from
    procedure :: dominant_mode
  end type canonical_problem

contains

  !> The canonical form of a checked problem, without its matrix. Errors: FUGE_ERR_MEMORY, FUGE_ERR_MODES for
  !> linearly dependent modes, FUGE_ERR_NO_EQUILIBRIUM. Ranks, `sharing`, may share the points: then all of them call
  !> it, with the same errors, and FUGE_ERR_UNSUPPORTED for modes of several bodies.
  subroutine make_canonical(problem, canonical, info, sharing)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(out) :: canonical
    type(fuge_info), intent(inout) :: info
    type(point_space), intent(in), optional :: sharing
    integer :: j, n, m, stat

    if (present(sharing)) canonical%space = sharing
    n = problem%points()
    canonical%plain = problem%is_plain()
    allocate (canonical%gap(n), canonical%upper(n), canonical%excluded(n), stat=stat)
    if (stat == 0) then
      canonical%gap = problem%gap
      canonical%upper = huge(1.0_dp)
      canonical%excluded = .false.
      if (allocated(problem%gap_upper)) canonical%upper = min(problem%gap_upper, huge(1.0_dp))
      if (allocated(problem%excluded)) canonical%excluded = problem%excluded
      if (problem%has_limits()) call set_limits(problem, canonical, stat)
    end if
    if (stat == 0) then
      canonical%free = [(j, j=1, problem%mode_count())]
      if (allocated(problem%prescribed)) canonical%free = pack(canonical%free, .not. problem%prescribed)
      m = size(canonical%free)
      allocate (canonical%modes(n, m), canonical%load(m), stat=stat)
    end if
    call require_memory(stat, 'the modes of', n, 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call allocate_rows(problem, canonical, info)
    if (info%failed()) return
    call apply_prescribed(problem, canonical)
    call collect_excluded(problem, canonical)
    if (.not. allocated(problem%modes)) then
      canonical%has_translation = m == 1
      canonical%modes = 1.0_dp
      if (m == 1) canonical%load = problem%resultant
    else if (m > 0) then
      call orthogonalise(problem%modes, canonical, info)
    end if
    if (.not. (info%failed() .or. canonical%plain)) call require_equilibrium(problem, canonical, info)
  end subroutine make_canonical

  !> Set the limits of the forces, and exclude the points that they leave no force. `stat` as from allocate.
  pure subroutine set_limits(problem, canonical, stat)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(inout) :: canonical
    integer, intent(out) :: stat
    integer :: n

    n = size(canonical%gap)
    allocate (canonical%limit(n), canonical%limit_upper(n), stat=stat)
    if (stat /= 0) return
    canonical%limit = huge(1.0_dp)
    canonical%limit_upper = huge(1.0_dp)
    if (allocated(problem%limit)) canonical%limit = min(problem%limit, huge(1.0_dp))
    if (allocated(problem%limit_upper)) canonical%limit_upper = min(problem%limit_upper, huge(1.0_dp))
    ! A stop without force is none.
    where (.not. canonical%limit_upper > 0.0_dp) canonical%upper = huge(1.0_dp)
    where (.not. (canonical%limit > 0.0_dp .or. canonical%upper < huge(1.0_dp))) canonical%excluded = .true.
  end subroutine set_limits

  !> Take the gaps and the load of another checked problem of the paper's kind, if this is one of as many points; all
  !> else is the same then. `is_set` tells whether it was.
  pure subroutine set_again(self, problem, is_set)
    class(canonical_problem), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    logical, intent(out) :: is_set

    is_set = self%plain .and. problem%is_plain() .and. allocated(self%excluded_rows)
    if (is_set) is_set = size(self%gap) == size(problem%gap)
    if (.not. is_set) return
    self%gap = problem%gap
    self%load = problem%resultant
  end subroutine set_again

  !> Allocate the rows and columns of R that are kept. Error: FUGE_ERR_MEMORY.
  subroutine allocate_rows(problem, canonical, info)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(inout) :: canonical
    type(fuge_info), intent(inout) :: info
    integer :: excluded, m, n, stat

    n = problem%points()
    m = problem%mode_count()
    excluded = count(canonical%excluded)
    allocate (canonical%prescribed(m), canonical%excluded_points(excluded), canonical%excluded_rows(excluded, m), &
              stat=stat)
    if (stat == 0 .and. allocated(problem%prescribed)) allocate (canonical%prescribed_modes(n, m), stat=stat)
    call require_memory(stat, 'the motions of', n, 'points', info)
    call canonical%space%agree(info)
  end subroutine allocate_rows

  !> Subtract the displacements by the prescribed motions from the gaps.
  pure subroutine apply_prescribed(problem, canonical)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(inout) :: canonical
    integer :: j

    canonical%prescribed = .false.
    if (.not. allocated(problem%prescribed)) return
    canonical%prescribed = problem%prescribed
    canonical%prescribed_modes = 0.0_dp
    do j = 1, problem%mode_count()
      if (.not. problem%prescribed(j)) cycle
      canonical%prescribed_modes(:, j) = 1.0_dp
      if (allocated(problem%modes)) canonical%prescribed_modes(:, j) = problem%modes(:, j)
      canonical%gap = canonical%gap - problem%motion(j)*canonical%prescribed_modes(:, j)
    end do
  end subroutine apply_prescribed

  !> Keep the rows of R at the excluded points.
  pure subroutine collect_excluded(problem, canonical)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(inout) :: canonical
    integer :: k, row

    canonical%excluded_rows = 1.0_dp
    row = 0
    do k = 1, size(canonical%excluded)
      if (.not. canonical%excluded(k)) cycle
      row = row + 1
      canonical%excluded_points(row) = k
      if (allocated(problem%modes)) canonical%excluded_rows(row, :) = problem%modes(k, :)
    end do
  end subroutine collect_excluded

  !> Replace the free ones of the `modes` (n, all) by orthogonal ones.
  subroutine orthogonalise(modes, canonical, info)
    real(dp), intent(in) :: modes(:, :)
    type(canonical_problem), intent(inout) :: canonical
    type(fuge_info), intent(inout) :: info
    type(mode_fault) :: fault
    real(dp), allocatable :: columns(:, :)
    integer :: j, stat

    allocate (columns(size(modes, 1), size(canonical%free)), stat=stat)
    call require_memory(stat, 'the modes of', size(modes, 1), 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    do j = 1, size(canonical%free)
      columns(:, j) = modes(:, canonical%free(j))
    end do
    call make_orthogonal(columns, canonical%excluded, canonical%modes, canonical%change, canonical%has_translation, &
                         fault, canonical%space)
    if (fault%stat /= 0) then
      call require_memory(fault%stat, 'orthogonal modes of', size(modes, 1), 'points', info)
    else if (fault%idle > 0) then
      call report(info, FUGE_ERR_MODES, 'mode '//index_text(canonical%free(fault%idle))//' moves no point')
    else if (fault%dependent > 0) then
      call report(info, FUGE_ERR_MODES, 'mode '//index_text(canonical%free(fault%dependent)) &
                  //' is a combination of the other modes: leave it out')
    end if
  end subroutine orthogonalise

  !> Set the influence matrix: `alpha` as in the type, `datum` its coefficient nearest to zero, `survey` that of
  !> the matrix; without one it is surveyed here. `stamp` tells it from other matrices; without one factors are not
  !> kept.
  subroutine set_matrix(self, alpha, datum, survey, stamp)
    class(canonical_problem), intent(inout) :: self
    real(dp), intent(in), pointer, contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum
    type(matrix_survey), intent(in), optional :: survey
    integer(c_long_long), intent(in), optional :: stamp

    self%stamp = 0
    if (present(stamp)) self%stamp = stamp
    if (present(survey)) then
      self%survey = survey
    else
      call survey_matrix(alpha, self%survey)
    end if
    self%alpha => alpha
    ! Without a translation nothing takes up a constant taken out of alpha.
    self%datum = merge(datum, 0.0_dp, self%has_translation)
  end subroutine set_matrix

  !> Points whose gap stays zero whatever their force, (n).
  pure function is_tied(self) result(tied)
    class(canonical_problem), intent(in) :: self
    logical :: tied(size(self%gap))

    tied = self%upper <= 0.0_dp .and. .not. self%excluded
  end function is_tied

  !> Do forces have limits?
  pure function has_limits(self)
    class(canonical_problem), intent(in) :: self
    logical :: has_limits

    has_limits = allocated(self%limit)
  end function has_limits

  !> Has the lower stop of point `k` a force?
  pure function pushes(self, k)
    class(canonical_problem), intent(in) :: self
    integer, intent(in) :: k
    logical :: pushes

    pushes = .true.
    if (allocated(self%limit)) pushes = self%limit(k) > 0.0_dp
  end function pushes

  !> How far point `k`, which is not at a stop, is from the nearest one that it may come to, length: negative for an
  !> open point beyond a stop, and for a limited one before its stop.
  pure function slack(self, k, state, gap) result(length)
    class(canonical_problem), intent(in) :: self
    integer, intent(in) :: k, state
    real(dp), intent(in) :: gap
    real(dp) :: length

    select case (state)
    case (FUGE_LIMITED_LOWER)
      length = -gap
    case (FUGE_LIMITED_UPPER)
      length = gap - self%upper(k)
    case default
      length = self%upper(k) - gap
      if (self%pushes(k)) length = min(length, gap)
    end select
  end function slack

  !> The least and the largest force of each point (n) in the state that it has, `state` (n), force. Open points have
  !> none, limited ones that of their limit, tied ones either sign.
  pure subroutine force_range(self, state, least, most)
    class(canonical_problem), intent(in) :: self
    integer, intent(in) :: state(:)
    real(dp), intent(out) :: least(:), most(:)
    integer :: k

    least = 0.0_dp
    most = 0.0_dp
    do k = 1, size(state)
      if (state(k) > FUGE_OPEN) most(k) = self%limit(k)
      if (state(k) < FUGE_OPEN) least(k) = -self%limit_upper(k)
      if (state(k) == FUGE_LIMITED_LOWER) least(k) = most(k)
      if (state(k) == FUGE_LIMITED_UPPER) most(k) = least(k)
      if (state(k) == FUGE_AT_LOWER_STOP .and. .not. self%upper(k) > 0.0_dp) least(k) = -self%limit_upper(k)
    end do
  end subroutine force_range

  !> Number of modes, prescribed ones included.
  pure function mode_count(self) result(m)
    class(canonical_problem), intent(in) :: self
    integer :: m

    m = 0
    if (allocated(self%prescribed)) m = size(self%prescribed)
  end function mode_count

  !> The largest resultant, which bounds the products with alpha.
  pure function largest_load(self) result(load)
    class(canonical_problem), intent(in) :: self
    real(dp) :: load

    load = 0.0_dp
    if (size(self%load) > 0) load = maxval(abs(self%load))
  end function largest_load

  !> Are these forces (n) in equilibrium with the load?
  pure function is_carried_by(self, force) result(carried)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: force(:)
    logical :: carried
    real(dp) :: noise(1), of_bodies(size(force))
    integer :: j

    carried = self%plain
    if (carried) return
    of_bodies = 0.0_dp
    do j = 1, size(self%load)
      of_bodies = merge(max(of_bodies, abs(self%load(j))), of_bodies, abs(self%modes(:, j)) > 0.0_dp)
    end do
    carried = .true.
    do j = 1, size(self%load)
      ! The loads of one body are rounded together, those of others are not.
      noise = epsilon(noise)*maxval(of_bodies, mask=abs(self%modes(:, j)) > 0.0_dp)
      carried = carried .and. is_in_equilibrium(self%modes(:, j:j), self%load(j:j), noise, force, &
                                                self%load(j:j) - dot_product(force, self%modes(:, j)))
    end do
  end function is_carried_by

  !> Are there several bodies, of which each may have a load of its own?
  pure function has_bodies(self)
    class(canonical_problem), intent(in) :: self
    logical :: has_bodies

    has_bodies = allocated(self%body)
  end function has_bodies

  !> The force with which each of the forces (n) is compared, (n): the largest one of the body if there is a load on it,
  !> else the largest of all, beside which they may be rounding.
  pure function force_scale(self, force) result(scale)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp) :: scale(size(force))
    integer :: j

    scale = maxval(abs(force))
    if (.not. allocated(self%body)) return
    do j = 1, size(self%load)
      if (.not. abs(self%load(j)) > 0.0_dp) cycle
      associate (own => self%body == maxval(self%body, mask=abs(self%modes(:, j)) > 0.0_dp))
        where (own) scale = maxval(abs(force), mask=own)
      end associate
    end do
    where (.not. scale > 0.0_dp) scale = maxval(abs(force))
  end function force_scale

  !> All motions in the caller's modes and order, `motion` (m): the free ones from `free_motion` in the orthogonal
  !> modes, the prescribed ones from `prescribed_motion` (m).
  subroutine to_given_modes(self, prescribed_motion, free_motion, motion)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: prescribed_motion(:), free_motion(:)
    real(dp), intent(out) :: motion(:)

    motion = merge(prescribed_motion, 0.0_dp, self%prescribed)
    motion(self%free) = self%change%given_motion(free_motion)
  end subroutine to_given_modes

  !> The number, among the caller's modes, of the one that contributes most to a motion in the orthogonal modes.
  function dominant_mode(self, free_motion) result(mode)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: free_motion(:)
    integer :: mode

    mode = self%free(maxloc(self%change%contributions(free_motion), dim=1))
  end function dominant_mode

  !> Changes of gaps (n) and of resultants or prescribed motions (m), as changes of the gaps and loads of the canonical
  !> problem. Error: FUGE_ERR_MEMORY.
  subroutine transform_change(self, gap_change, load_change, reduced_gap, load, info)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: gap_change(:), load_change(:)
    real(dp), allocatable, intent(out) :: reduced_gap(:), load(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: rigid(:)
    integer :: stat

    allocate (reduced_gap(size(gap_change)), load(size(self%free)), stat=stat)
    if (stat == 0 .and. allocated(self%prescribed_modes)) allocate (rigid(size(gap_change)), stat=stat)
    call require_memory(stat, 'changes of', size(gap_change), 'gaps', info)
    call self%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    reduced_gap = gap_change
    if (allocated(self%prescribed_modes)) then
      rigid = matmul(self%prescribed_modes, merge(load_change, 0.0_dp, self%prescribed))
      reduced_gap = reduced_gap - rigid
    end if
    call self%change%orthogonal_load(load_change(self%free), load)
  end subroutine transform_change

  !> The largest loads of the canonical problem for resultants up to `load` (m), of any sign.
  function largest_loads(self, load) result(largest)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: load(:)
    real(dp) :: largest(size(self%free))
    real(dp) :: unit(size(self%free)), change(size(self%free))
    integer :: j

    largest = 0.0_dp
    do j = 1, size(largest)
      unit = 0.0_dp
      unit(j) = load(self%free(j))
      call self%change%orthogonal_load(unit, change)
      largest = largest + abs(change)
    end do
  end function largest_loads

  !> Set the gaps c = g + A f - R q at the excluded points, of `gap` g (n), `force` (n) and all motions (m), or of
  !> changes of these.
  pure subroutine set_excluded_gaps(self, alpha, gap, force, motion, gap_out)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: alpha(:, :), gap(:), force(:), motion(:)
    real(dp), intent(inout) :: gap_out(:)
    integer :: k

    do k = 1, size(self%excluded_points)
      associate (point => self%excluded_points(k))
        gap_out(point) = gap(point) + sum(alpha(point, :)*force) - sum(self%excluded_rows(k, :)*motion)
      end associate
    end do
  end subroutine set_excluded_gaps

  !> As `set_excluded_gaps`, from the displacements A f (n).
  pure subroutine set_excluded_gaps_from(self, displacement, gap, motion, gap_out)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: displacement(:), gap(:), motion(:)
    real(dp), intent(inout) :: gap_out(:)
    integer :: k

    do k = 1, size(self%excluded_points)
      associate (point => self%excluded_points(k))
        gap_out(point) = (gap(point) + displacement(point)) - sum(self%excluded_rows(k, :)*motion)
      end associate
    end do
  end subroutine set_excluded_gaps_from

  !> Find forces in equilibrium, or report that there are none.
  subroutine require_equilibrium(problem, canonical, info)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(inout) :: canonical
    type(fuge_info), intent(inout) :: info
    real(dp) :: remainder(size(canonical%load)), rounding(size(canonical%load))
    integer :: body(size(canonical%load)), j, stat

    allocate (canonical%feasible_force(size(canonical%gap)), stat=stat)
    call require_memory(stat, 'the equilibrium of', size(canonical%gap), 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    canonical%feasible_force = 0.0_dp
    if (size(canonical%load) < 1) return
    if (canonical%space%everywhere(all(canonical%excluded))) then
      ! Without a load too: gaps could not be counted from any point.
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'all points are excluded: nothing resists the free motions; ' &
                  //'prescribe them, or let points take part')
      return
    end if
    call canonical%change%orthogonal_load(problem%resultant(canonical%free), canonical%load, rounding)
    body = bodies_of_modes(canonical%modes, canonical%space)
    if (any(body > 1) .and. .not. canonical%space%is_alone()) then
      call report(info, FUGE_ERR_UNSUPPORTED, 'mode '//index_text(canonical%free(maxloc(body, dim=1)))//' moves no ' &
                  //'point that mode '//index_text(canonical%free(1))//' moves: ranks share one body, so solve each ' &
                  //'body by itself, or all of them on one rank')
      return
    end if
    if (any(body > 1)) call number_points(body, canonical)
    remainder = 0.0_dp
    do j = 1, size(body)
      if (body(j) == j) call balance_body(body == j, rounding, canonical, remainder, info)
      if (info%failed()) return
    end do
    if (any(abs(remainder) > 0.0_dp)) then
      call report_no_equilibrium(problem, canonical%free, canonical%change, canonical%excluded, &
                                 any(canonical%upper < huge(1.0_dp) .and. .not. canonical%excluded), remainder, &
                                 canonical%space, info)
    end if
  end subroutine require_equilibrium

  !> The body of each point is that of the modes that move it. `body` (m).
  pure subroutine number_points(body, canonical)
    integer, intent(in) :: body(:)
    type(canonical_problem), intent(inout) :: canonical
    integer :: j

    allocate (canonical%body(size(canonical%gap)))
    canonical%body = 0
    do j = 1, size(body)
      where (abs(canonical%modes(:, j)) > 0.0_dp) canonical%body = body(j)
    end do
  end subroutine number_points

  !> Find forces in equilibrium with the loads on one body, whose modes are marked in `member` (m).
  !>
  !> `rounding` (m) is that of the loads; `remainder` (m) gets the proof that there are no such forces. Error:
  !> FUGE_ERR_MEMORY.
  subroutine balance_body(member, rounding, canonical, remainder, info)
    logical, intent(in) :: member(:)
    real(dp), intent(in) :: rounding(:)
    type(canonical_problem), intent(inout) :: canonical
    real(dp), intent(inout) :: remainder(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: modes(:, :), force(:)
    real(dp), dimension(count(member)) :: rest, noise
    logical, allocatable :: pushes(:), pulls(:)
    integer :: columns(count(member)), j, n, stat

    n = size(canonical%gap)
    allocate (modes(n, size(columns)), force(n), pushes(n), pulls(n), stat=stat)
    call require_memory(stat, 'the equilibrium of', n, 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    columns = pack([(j, j=1, size(member))], member)
    modes = canonical%modes(:, columns)
    do j = 1, n
      pushes(j) = any(abs(modes(j, :)) > 0.0_dp) .and. .not. canonical%excluded(j)
    end do
    pulls = pushes .and. canonical%upper < huge(1.0_dp)
    ! The orthogonal modes of a body share their rounding.
    noise = max(rounding(columns), epsilon(noise)*maxval(abs(canonical%load(columns))))
    if (canonical%has_limits()) then
      call find_limited_equilibrium(modes, canonical%load(columns), merge(-canonical%limit_upper, 0.0_dp, pulls), &
                                    merge(canonical%limit, 0.0_dp, pushes), noise, force, rest)
    else
      call find_shared_equilibrium(canonical%space, modes, canonical%load(columns), pushes, pulls, force, rest, noise)
    end if
    if (any(abs(rest) > 0.0_dp)) then
      remainder(columns) = rest
      return
    end if
    if (.not. canonical%has_limits()) then
      call move_to_edge(canonical%space, modes, noise, canonical%load, columns, force, info)
    end if
    if (.not. info%failed()) canonical%feasible_force = canonical%feasible_force + force
  end subroutine balance_body

end module fuge_canonical_problem
