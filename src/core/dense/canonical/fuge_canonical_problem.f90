!> The contact problem in the form that the dense engines solve.
!>
!> Prescribed motions are moved into the gaps, and the free rigid modes are made orthogonal, so that neither
!> their units nor a far-away point of reference costs digits. A resultant that no contact forces can
!> carry is refused here.
module fuge_canonical_problem
  use, intrinsic :: iso_c_binding, only: c_long_long
  use fuge_equilibrium, only: find_equilibrium, is_in_equilibrium, move_to_edge
  use fuge_equilibrium_report, only: report_no_equilibrium
  use fuge_given_motions, only: given_motions
  use fuge_kinds, only: dp
  use fuge_matrix_survey, only: matrix_survey, survey_matrix
  use fuge_number_text, only: index_text
  use fuge_orthogonal_modes, only: bodies_of_modes, make_orthogonal, mode_fault
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_MODES, FUGE_ERR_NO_EQUILIBRIUM, &
    FUGE_ERR_UNSUPPORTED
  implicit none
  private

  public :: make_canonical

  !> Loads may be wrong by this fraction of the largest one where modes were found numerically, but a resultant by no
  !> more than the second fraction of its own terms.
  real(dp), parameter :: ROUNDING_OF_MODES = 1.0e-11_dp, MOST_LACKING = 1.0e-6_dp

  !> c = gap + alpha f - modes q with R^T f = load; see `fuge_problem` for the conditions on f and c.
  type, extends(given_motions), public :: canonical_problem
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
    !> Free rigid modes made orthogonal, (n, m), of size about 1, and the resultants in them, (m).
    real(dp), allocatable :: modes(:, :), load(:)
    !> modes(:, 1) is 1 at every point: a constant in gaps or displacements changes that motion only.
    logical :: has_translation = .false.
    !> Forces at few points that are in equilibrium with the load, (n); not allocated if plain.
    real(dp), allocatable :: feasible_force(:)
    !> The motion in the free given modes that proves that there are none, (m); not allocated if there are.
    real(dp), allocatable :: unbalanced(:)
    !> The paper's problem: one translation, one-sided, all points.
    logical :: plain = .false.
    !> Number of the body of each point, (n), 0 for a point that no mode moves; not allocated for one body.
    integer, allocatable, private :: body(:)
  contains
    procedure :: set_again
    procedure :: set_matrix
    procedure :: largest_load
    procedure :: is_carried_by
    procedure :: force_scale
    procedure :: has_bodies
  end type canonical_problem

contains

  !> The canonical form of a checked problem, without its matrix. Errors: FUGE_ERR_MEMORY, FUGE_ERR_MODES for
  !> linearly dependent modes, FUGE_ERR_NO_EQUILIBRIUM. Ranks, `sharing`, may share the points: then all of them call
  !> it, with the same errors, and FUGE_ERR_UNSUPPORTED for modes of several bodies. Forces in equilibrium are looked
  !> for unless they are given, `balance` (n).
  subroutine make_canonical(problem, canonical, info, sharing, balance)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(out) :: canonical
    type(fuge_info), intent(inout) :: info
    type(point_space), intent(in), optional :: sharing
    real(dp), intent(in), optional :: balance(:)
    integer :: j, n, m, stat

    if (present(sharing)) canonical%space = sharing
    n = problem%points()
    canonical%plain = problem%is_plain()
    allocate (canonical%gap(n), stat=stat)
    if (stat == 0) call canonical%set_stops(problem, stat)
    if (stat == 0) then
      canonical%gap = problem%gap
      canonical%free = [(j, j=1, problem%mode_count())]
      if (allocated(problem%prescribed)) canonical%free = pack(canonical%free, .not. problem%prescribed)
      m = size(canonical%free)
      allocate (canonical%modes(n, m), canonical%load(m), stat=stat)
    end if
    call require_memory(stat, 'the modes of', n, 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call canonical%set_motions(problem, canonical%gap, info)
    if (info%failed()) return
    if (.not. allocated(problem%modes)) then
      canonical%has_translation = m == 1
      canonical%modes = 1.0_dp
      if (m == 1) canonical%load = problem%resultant
    else if (m > 0) then
      call orthogonalise(problem%modes, canonical, info)
    end if
    if (info%failed() .or. canonical%plain) return
    allocate (canonical%feasible_force(n), stat=stat)
    call require_memory(stat, 'the equilibrium of', n, 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    canonical%feasible_force = 0.0_dp
    if (present(balance)) canonical%feasible_force = balance
    call require_equilibrium(problem, canonical, info, present(balance))
  end subroutine make_canonical

  !> Take the gaps and the load of another checked problem of the paper's kind, if this is one of as many points; all
  !> else is the same then. `is_set` tells whether it was.
  pure subroutine set_again(self, problem, is_set)
    class(canonical_problem), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    logical, intent(out) :: is_set

    is_set = self%plain .and. problem%is_plain() .and. self%has_motions()
    if (is_set) is_set = size(self%gap) == size(problem%gap)
    if (.not. is_set) return
    self%gap = problem%gap
    self%load = problem%resultant
  end subroutine set_again

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
      call report(info, FUGE_ERR_MODES, 'mode '//index_text(canonical%free(fault%idle)) &
                  //' moves no point that may carry a force: leave the mode out, or prescribe its motion')
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

    carried = self%plain
    if (.not. carried) carried = modes_are_carried_by(self, force)
  end function is_carried_by

  !> As `is_carried_by`, mode by mode.
  pure function modes_are_carried_by(self, force) result(carried)
    type(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: force(:)
    logical :: carried
    real(dp) :: noise(1), of_bodies(size(force))
    integer :: j

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
  end function modes_are_carried_by

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

  !> Find forces in equilibrium, or report that there are none; `is_known` tells that `feasible_force` is one already.
  subroutine require_equilibrium(problem, canonical, info, is_known)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(inout) :: canonical
    type(fuge_info), intent(inout) :: info
    logical, intent(in) :: is_known
    real(dp) :: remainder(size(canonical%load)), rounding(size(canonical%load))
    integer :: body(size(canonical%load)), j

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
    if (is_known) return
    remainder = 0.0_dp
    do j = 1, size(body)
      if (body(j) == j) call balance_body(body == j, rounding, canonical, remainder, info)
      if (info%failed()) return
    end do
    if (.not. any(abs(remainder) > 0.0_dp)) return
    if (lacks_next_to_nothing(problem, canonical, remainder)) then
      canonical%load = canonical%load - remainder
    else
      canonical%unbalanced = canonical%change%given_motion(remainder)
      call report_no_equilibrium(problem, canonical%free, canonical%change, canonical%excluded, &
                                 any(canonical%upper < huge(1.0_dp) .and. .not. canonical%excluded), remainder, &
                                 canonical%space, info)
    end if
  end subroutine require_equilibrium

  !> Is the `remainder` (m) of the loads, which the forces found lack, next to nothing? A load that needs forces of just
  !> zero is taken beyond what the points can carry by the rounding of modes that were found numerically: by a small
  !> fraction of the loads, and also of each resultant of the caller or of its terms, of which it would otherwise leave
  !> little.
  function lacks_next_to_nothing(problem, canonical, remainder) result(lacks)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: remainder(:)
    logical :: lacks
    real(dp) :: sums(2*size(canonical%free)), row(size(canonical%free))
    integer :: k, m

    m = size(canonical%free)
    sums = 0.0_dp
    row = 1.0_dp
    do k = 1, size(canonical%feasible_force)
      if (allocated(problem%modes)) row = problem%modes(k, canonical%free)
      sums = sums + [row, abs(row)]*[spread(canonical%feasible_force(k), 1, m), &
                                     spread(abs(canonical%feasible_force(k)), 1, m)]
    end do
    call canonical%space%add(sums)
    associate (resultant => problem%resultant(canonical%free))
      lacks = maxval(abs(remainder)) <= ROUNDING_OF_MODES*maxval(abs(canonical%load)) &
              .and. all(abs(resultant - sums(:m)) <= MOST_LACKING*max(abs(resultant), sums(m + 1:)))
    end associate
  end function lacks_next_to_nothing

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
    real(dp), allocatable :: modes(:, :), least(:), most(:), force(:)
    real(dp), dimension(count(member)) :: rest, noise
    integer :: columns(count(member)), j, n, stat

    n = size(canonical%gap)
    allocate (modes(n, size(columns)), least(n), most(n), force(n), stat=stat)
    call require_memory(stat, 'the equilibrium of', n, 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    columns = pack([(j, j=1, size(member))], member)
    modes = canonical%modes(:, columns)
    call canonical%force_bounds(least, most)
    do j = 1, n
      if (any(abs(modes(j, :)) > 0.0_dp)) cycle
      least(j) = 0.0_dp
      most(j) = 0.0_dp
    end do
    ! The orthogonal modes of a body share their rounding.
    noise = max(rounding(columns), epsilon(noise)*maxval(abs(canonical%load(columns))))
    call find_equilibrium(modes, canonical%load(columns), least, most, force, rest, noise, canonical%space)
    if (any(abs(rest) > 0.0_dp)) then
      remainder(columns) = rest
    else if (.not. canonical%has_limits()) then
      call move_to_edge(canonical%space, modes, noise, canonical%load, columns, force, info)
    end if
    if (.not. info%failed()) canonical%feasible_force = canonical%feasible_force + force
  end subroutine balance_body

end module fuge_canonical_problem
