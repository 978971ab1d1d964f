!> The contact problem in the form that the dense engines solve.
!>
!> Prescribed motions are moved into the gaps, and the free rigid modes are made orthogonal, so that neither
!> their units nor a far-away point of reference costs digits. A resultant that no contact forces can
!> carry is refused here.
module fuge_canonical_problem
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgesv
  use fuge_number_text, only: index_text, text
  use fuge_pivoted_qr, only: orthonormalise, orthonormalise_in_order
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, report, FUGE_ERR_MEMORY, FUGE_ERR_MODES, FUGE_ERR_NO_EQUILIBRIUM
  implicit none
  private

  public :: make_canonical

  !> A mode is linearly dependent on the others if its remainder after projection is below this fraction.
  real(dp), parameter :: DEPENDENT = 1.0e-12_dp
  !> The constant vector lies in the span of the modes if its remainder is below this fraction.
  real(dp), parameter :: CONSTANT_TOLERANCE = 1.0e-13_dp

  !> c = gap + alpha f - modes q with R^T f = load; see `fuge_problem` for the conditions on f and c.
  type, public :: canonical_problem
    !> Influence matrix, (at least n rows, n columns), length per force; owned by the caller.
    real(dp), pointer, contiguous :: alpha(:, :) => null()
    !> Taken out of all of alpha, where it costs digits: the coefficient nearest to zero if there is a
    !> translation to take it up, else 0.
    real(dp) :: datum = 0.0_dp
    !> Initial gaps less the displacements by the prescribed motions, (n), length.
    real(dp), allocatable :: gap(:)
    !> Play, (n), length; huge where one-sided.
    real(dp), allocatable :: upper(:)
    !> Points that take no part in the contact, (n).
    logical, allocatable :: excluded(:)
    !> Free rigid modes made orthogonal, (n, m), of size about 1, and the resultants in them, (m).
    real(dp), allocatable :: modes(:, :), load(:)
    !> modes(:, 1) is 1 at every point: a constant in gaps or displacements changes that motion only.
    logical :: has_translation = .false.
    !> Forces at few points that are in equilibrium with the load, (n); not allocated if plain.
    real(dp), allocatable :: feasible_force(:)
    !> The paper's problem: one translation, one-sided, all points.
    logical :: plain = .false.
    !> Positions of the free modes among all, and their columns of R as modes*basis_change.
    integer, allocatable, private :: free(:)
    real(dp), allocatable, private :: basis_change(:, :)
    !> Columns of R whose motion is prescribed, (n, m), zero where free; not allocated if there are none.
    real(dp), allocatable, private :: prescribed_modes(:, :)
    logical, allocatable, private :: prescribed(:)
    !> Excluded points and their rows of R: the orthogonal modes are zero there.
    integer, allocatable, private :: excluded_points(:)
    real(dp), allocatable, private :: excluded_rows(:, :)
  contains
    procedure :: set_matrix
    procedure :: mode_count
    procedure :: is_tied
    procedure :: to_given_modes
    procedure :: largest_load
    procedure :: transform_change
    procedure :: set_excluded_gaps
    procedure :: dominant_mode
  end type canonical_problem

contains

  !> The canonical form of a checked problem, without its matrix. Errors: FUGE_ERR_MEMORY, FUGE_ERR_MODES for
  !> linearly dependent modes, FUGE_ERR_NO_EQUILIBRIUM.
  subroutine make_canonical(problem, canonical, info)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(out) :: canonical
    type(fuge_info), intent(inout) :: info
    integer :: j, n, m, stat

    n = problem%points()
    canonical%plain = problem%is_plain()
    allocate (canonical%gap(n), canonical%upper(n), canonical%excluded(n), stat=stat)
    if (stat == 0) then
      canonical%gap = problem%gap
      canonical%upper = huge(1.0_dp)
      canonical%excluded = .false.
      if (allocated(problem%gap_upper)) canonical%upper = min(problem%gap_upper, huge(1.0_dp))
      if (allocated(problem%excluded)) canonical%excluded = problem%excluded
      canonical%free = [(j, j=1, problem%mode_count())]
      if (allocated(problem%prescribed)) canonical%free = pack(canonical%free, .not. problem%prescribed)
      m = size(canonical%free)
      allocate (canonical%modes(n, m), canonical%load(m), canonical%basis_change(m, m), stat=stat)
    end if
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory for the modes of '//text(n)//' points')
      return
    end if
    call apply_prescribed(problem, canonical)
    call collect_excluded(problem, canonical)
    if (.not. allocated(problem%modes)) then
      canonical%has_translation = m == 1
      canonical%modes = 1.0_dp
      canonical%basis_change = 1.0_dp
      if (m == 1) canonical%load = problem%resultant
    else if (m > 0) then
      call orthogonalise(problem%modes(:, canonical%free), problem%resultant(canonical%free), canonical, info)
    end if
    if (.not. (info%failed() .or. canonical%plain)) call require_equilibrium(problem, canonical, info)
  end subroutine make_canonical

  !> Subtract the displacements by the prescribed motions from the gaps.
  pure subroutine apply_prescribed(problem, canonical)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(inout) :: canonical
    integer :: j

    allocate (canonical%prescribed(problem%mode_count()))
    canonical%prescribed = .false.
    if (.not. allocated(problem%prescribed)) return
    canonical%prescribed = problem%prescribed
    allocate (canonical%prescribed_modes(problem%points(), problem%mode_count()))
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
    integer :: k

    canonical%excluded_points = pack([(k, k=1, size(canonical%excluded))], canonical%excluded)
    allocate (canonical%excluded_rows(size(canonical%excluded_points), problem%mode_count()))
    canonical%excluded_rows = 1.0_dp
    if (allocated(problem%modes)) canonical%excluded_rows = problem%modes(canonical%excluded_points, :)
  end subroutine collect_excluded

  !> Replace the free modes `columns` (n, m) by modes of equal size that are orthogonal at the points that take part;
  !> the first is the constant 1 if that lies in their span.
  subroutine orthogonalise(columns, resultant, canonical, info)
    real(dp), intent(in) :: columns(:, :), resultant(:)
    type(canonical_problem), intent(inout) :: canonical
    type(fuge_info), intent(inout) :: info
    real(dp) :: scales(size(columns, 2)), basis(size(columns, 1), size(columns, 2))
    integer :: order(size(columns, 2)), m, rank, replaced, stat

    m = size(columns, 2)
    basis = columns
    where (spread(canonical%excluded, 2, m)) basis = 0.0_dp
    scales = maxval(abs(basis), dim=1)
    if (any(.not. scales > 0.0_dp)) then
      call report(info, FUGE_ERR_MODES, 'mode '//index_text(canonical%free(minloc(scales, dim=1)))//' moves no point')
      return
    end if
    basis = basis/spread(scales, 1, size(basis, 1))
    if (is_orthogonal(basis)) then
      ! With several bodies, combining the modes would cost the smallest resultant its digits.
      call keep_modes(basis, scales, resultant, canonical)
      return
    end if
    call orthonormalise(basis, DEPENDENT, order, rank, stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to make the modes orthogonal')
      return
    else if (rank < m) then
      call report(info, FUGE_ERR_MODES, 'mode '//index_text(canonical%free(order(rank + 1))) &
                  //' is a combination of the other modes: leave it out')
      return
    end if
    call replace_by_constant(basis, canonical%excluded, replaced)
    canonical%has_translation = replaced > 0
    if (canonical%has_translation) then
      basis = cshift(basis, replaced - 1, dim=2)
      call orthonormalise_in_order(basis, stat)
      if (stat /= 0) then
        call report(info, FUGE_ERR_MEMORY, 'no memory to make the modes orthogonal')
        return
      end if
    end if
    ! A point that no mode moves must stay so in spite of rounding: its force contributes to no resultant.
    where (spread(all(abs(columns) <= 0.0_dp, dim=2), 2, m)) basis = 0.0_dp
    basis = basis*sqrt(real(count(.not. canonical%excluded), dp))
    if (canonical%has_translation) basis(:, 1) = merge(0.0_dp, 1.0_dp, canonical%excluded)
    canonical%modes = basis
    canonical%basis_change = matmul(transpose(basis), columns)/real(count(.not. canonical%excluded), dp)
    call solve_small(transpose(canonical%basis_change), resultant, canonical%load)
  end subroutine orthogonalise

  !> Are the columns orthogonal to each other?
  pure function is_orthogonal(matrix) result(orthogonal)
    real(dp), intent(in) :: matrix(:, :)
    logical :: orthogonal
    integer :: i, j

    orthogonal = .true.
    do j = 2, size(matrix, 2)
      do i = 1, j - 1
        orthogonal = orthogonal .and. abs(dot_product(matrix(:, i), matrix(:, j))) &
                     <= DEPENDENT*norm2(matrix(:, i))*norm2(matrix(:, j))
      end do
    end do
  end function is_orthogonal

  !> Keep orthogonal modes, `columns` (n, m) divided by `scales` (m), but for their size; a constant one becomes the
  !> first.
  pure subroutine keep_modes(columns, scales, resultant, canonical)
    real(dp), intent(in) :: columns(:, :), scales(:), resultant(:)
    type(canonical_problem), intent(inout) :: canonical
    real(dp) :: unit
    integer :: first, j, m, position

    m = size(scales)
    first = 0
    do j = m, 1, -1
      if (is_constant(columns(:, j), canonical%excluded)) first = j
    end do
    canonical%has_translation = first > 0
    canonical%basis_change = 0.0_dp
    do j = 1, m
      ! A cyclic shift brings the constant mode to the front.
      position = modulo(j - max(first, 1), m) + 1
      unit = norm2(columns(:, j))/sqrt(real(count(.not. canonical%excluded), dp))
      ! The constant is 1, not -1.
      if (j == first .and. any(columns(:, j) < 0.0_dp)) unit = -unit
      canonical%modes(:, position) = columns(:, j)/unit
      if (j == first) canonical%modes(:, position) = merge(0.0_dp, 1.0_dp, canonical%excluded)
      canonical%basis_change(position, j) = scales(j)*unit
      canonical%load(position) = resultant(j)/(scales(j)*unit)
    end do
  end subroutine keep_modes

  pure function is_constant(values, excluded)
    real(dp), intent(in) :: values(:)
    logical, intent(in) :: excluded(:)
    logical :: is_constant

    is_constant = minval(values, mask=.not. excluded) >= maxval(values, mask=.not. excluded)
  end function is_constant

  !> Replace a column of an orthonormal basis by the constant vector if that lies in its span; `column` is 0 if it does
  !> not.
  pure subroutine replace_by_constant(basis, excluded, column)
    real(dp), intent(inout) :: basis(:, :)
    logical, intent(in) :: excluded(:)
    integer, intent(out) :: column
    real(dp) :: ones(size(basis, 1)), components(size(basis, 2))

    ones = merge(0.0_dp, 1.0_dp, excluded)
    components = matmul(ones, basis)
    column = 0
    if (maxval(abs(ones - matmul(basis, components))) > CONSTANT_TOLERANCE*real(size(basis, 1), dp)) return
    column = maxloc(abs(components), dim=1)
    basis(:, column) = ones/sqrt(sum(ones))
  end subroutine replace_by_constant

  subroutine solve_small(matrix, right, solution)
    real(dp), intent(in) :: matrix(:, :), right(:)
    real(dp), intent(out) :: solution(:)
    real(dp) :: copy(size(matrix, 1), size(matrix, 2))
    integer :: pivots(size(right)), info

    copy = matrix
    solution = right
    call dgesv(size(right), 1, copy, size(right), pivots, solution, size(right), info)
  end subroutine solve_small

  !> Set the influence matrix: `alpha` as in the type, `datum` its coefficient nearest to zero.
  subroutine set_matrix(self, alpha, datum)
    class(canonical_problem), intent(inout) :: self
    real(dp), intent(in), pointer, contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum

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

  !> All motions in the caller's modes and order, `motion` (m): the free ones from `free_motion` in the orthogonal
  !> modes, the prescribed ones from `prescribed_motion` (m).
  subroutine to_given_modes(self, prescribed_motion, free_motion, motion)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: prescribed_motion(:), free_motion(:)
    real(dp), intent(out) :: motion(:)
    real(dp) :: free(size(free_motion))

    motion = merge(prescribed_motion, 0.0_dp, self%prescribed)
    if (size(free_motion) < 1) return
    call solve_small(self%basis_change, free_motion, free)
    motion(self%free) = free
  end subroutine to_given_modes

  !> The number, among the caller's modes, of the one that contributes most to a motion in the orthogonal modes.
  function dominant_mode(self, free_motion) result(mode)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: free_motion(:)
    integer :: mode
    real(dp) :: free(size(free_motion))

    call solve_small(self%basis_change, free_motion, free)
    mode = self%free(maxloc(abs(free)*sqrt(sum(self%basis_change**2, dim=1)), dim=1))
  end function dominant_mode

  !> Changes of gaps (n) and of resultants or prescribed motions (m), as changes of the gaps and loads of the canonical
  !> problem.
  subroutine transform_change(self, gap_change, load_change, reduced_gap, load)
    class(canonical_problem), intent(in) :: self
    real(dp), intent(in) :: gap_change(:), load_change(:)
    real(dp), allocatable, intent(out) :: reduced_gap(:), load(:)

    reduced_gap = gap_change
    if (allocated(self%prescribed_modes)) then
      reduced_gap = reduced_gap - matmul(self%prescribed_modes, merge(load_change, 0.0_dp, self%prescribed))
    end if
    allocate (load(size(self%free)))
    if (size(load) > 0) call solve_small(transpose(self%basis_change), load_change(self%free), load)
  end subroutine transform_change

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

  !> Find forces in equilibrium, or report that there are none.
  subroutine require_equilibrium(problem, canonical, info)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(inout) :: canonical
    type(fuge_info), intent(inout) :: info
    real(dp) :: remainder(size(canonical%load))
    integer :: stat

    allocate (canonical%feasible_force(size(canonical%gap)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to look for equilibrium')
      return
    end if
    canonical%feasible_force = 0.0_dp
    if (size(canonical%load) < 1) return
    if (all(canonical%excluded)) then
      ! Without a load too: gaps could not be counted from any point.
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'all points are excluded: nothing resists the free motions; ' &
                  //'prescribe them, or let points take part')
      return
    end if
    call find_equilibrium(canonical%modes, canonical%load, .not. canonical%excluded, &
                          canonical%upper < huge(1.0_dp) .and. .not. canonical%excluded, &
                          canonical%feasible_force, remainder)
    if (any(abs(remainder) > 0.0_dp)) call report_no_equilibrium(problem, canonical, remainder, info)
  end subroutine require_equilibrium

  !> Name the resultant that no contact forces can carry.
  subroutine report_no_equilibrium(problem, canonical, remainder, info)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: remainder(:)
    type(fuge_info), intent(inout) :: info
    real(dp) :: motion(size(remainder))
    integer :: worst

    if (.not. allocated(problem%modes)) then
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'resultant '//text(problem%resultant(1))//' is negative: contact ' &
                  //'forces can only push, so it must be >= 0')
    else
      call report_line_of_action(problem, canonical, 1, 2, info)
      if (.not. info%failed()) call report_line_of_action(problem, canonical, 2, 1, info)
      if (info%failed()) return
      associate (w => problem%resultant(canonical%free), r => problem%modes(:, canonical%free))
        call solve_small(canonical%basis_change, remainder, motion)
        worst = maxloc(abs(motion*maxval(abs(r), dim=1)), dim=1)
        call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'no forces that push give the resultant '//text(w(worst)) &
                    //' in motion '//index_text(canonical%free(worst)) &
                    //' together with the others: moving along it by ' &
                    //text(motion(worst))//' closes no contact, but the resultants do work')
      end associate
    end if
  end subroutine report_no_equilibrium

  !> With one translation and one tilt, report the line of action if it lies outside of the contact points. Not for
  !> points with play or tied ones, which carry any line of action.
  subroutine report_line_of_action(problem, canonical, translation, tilt, info)
    type(fuge_problem), intent(in) :: problem
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: translation, tilt
    type(fuge_info), intent(inout) :: info
    real(dp) :: x(size(canonical%gap))

    if (size(canonical%free) /= 2 .or. any(canonical%upper < huge(x) .and. .not. canonical%excluded)) return
    associate (w => problem%resultant(canonical%free), unit => problem%modes(:, canonical%free(translation)))
      if (.not. (minval(unit) > 0.0_dp .and. maxval(unit) <= minval(unit) .and. w(translation) > 0.0_dp)) return
      x = problem%modes(:, canonical%free(tilt))/unit
      call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the line of action passes at '//text(w(tilt)/w(translation)) &
                  //', but the points reach from '//text(minval(x, mask=.not. canonical%excluded))//' to ' &
                  //text(maxval(x, mask=.not. canonical%excluded))//' only: move the load between them')
    end associate
  end subroutine report_line_of_action

end module fuge_canonical_problem
