!> Forces and motion of a given contact set, solved with its factor and refined to the last digits.
module fuge_kkt_solution
  use fuge_canonical_problem, only: canonical_problem
  use fuge_compensated_sums, only: add_column, add_terms, add_two_columns, bias_above, compensated_dot
  use fuge_displacements, only: displacement_magnitude, displacement_magnitude_at
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_refinement_error, only: error_left, make_random_errors, LARGEST, RANDOM_SIGNS
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  public :: find_force_error, refine_solution, solve_set, translation_at_shallowest

  !> An expected correction below this fraction of the largest force is left out.
  real(dp), parameter :: EXACT_ENOUGH = 0.1_dp*epsilon(1.0_dp)
  !> A correction of the forces below this fraction of the largest is rounding.
  real(dp), parameter :: NO_CHANGE = 8.0_dp*epsilon(1.0_dp)
  !> A refinement makes at most this many corrections.
  integer, parameter :: REFINEMENTS = 10
  !> A first correction beyond this fraction of the largest force shows a condition with which the rounding of
  !> residuals counts.
  real(dp), parameter :: RESIDUALS_COUNT = 1.0e-10_dp
  !> Rounding of a residual relative to its terms: the lower halves of the products are summed in double precision.
  real(dp), parameter :: RESIDUAL_ROUNDING = 2.0_dp**(-79)
  !> At most this many rows are gathered at a time.
  integer, parameter :: PANEL = 256
  !> Where fewer than one in this many rows is left out, it costs less to use all of them than to gather the others.
  integer, parameter :: ROWS_PER_GAP = 5
  !> Threads share residuals with more coefficients than this, in groups of ROWS points.
  real(dp), parameter :: SHARED = 2.0_dp**16
  integer, parameter :: ROWS = 16
  !> The terms of at most this many points are compared.
  integer, parameter :: CANDIDATES = 8

  !> Arrays of a refinement, kept so that small problems do not spend their time on allocations.
  type, public :: refinement_arrays
    !> The rounding errors of the gaps of `refine_solution`, (n), length; zero unless they are set.
    real(dp), allocatable :: gap_rounding(:)
    !> The last refinement: the largest force before it, the largest changes by its corrections, how many there were,
    !> and whether the last one was applied.
    real(dp) :: changes(0:REFINEMENTS) = 0.0_dp
    integer, private :: corrections = 0
    logical, private :: taken = .true.
    !> (n).
    real(dp), allocatable, private :: residual(:), correction(:), high(:), low(:), column(:)
    integer, allocatable, private :: points(:), loaded(:)
    !> (m).
    real(dp), allocatable, private :: missing(:), shift(:)
  contains
    procedure :: fit
  end type refinement_arrays

  !> Columns that are added to residuals, of which each part has some points.
  type, extends(work_in_parts) :: residual_work
    real(dp), pointer, contiguous :: alpha(:, :) => null(), force(:) => null(), high(:) => null(), low(:) => null()
    integer, pointer, contiguous :: points(:) => null(), loaded(:) => null()
  contains
    procedure :: do_part => add_part
  end type residual_work

contains

  !> Allocate the arrays for n points and m motions, unless they fit. `stat` as from allocate.
  pure subroutine fit(self, n, m, stat)
    class(refinement_arrays), intent(inout) :: self
    integer, intent(in) :: n, m
    integer, intent(out) :: stat

    stat = 0
    if (allocated(self%missing)) then
      if (size(self%residual) == n .and. size(self%missing) == m) return
      deallocate (self%residual, self%correction, self%high, self%low, self%column, self%points, self%loaded, &
                  self%missing, self%shift, self%gap_rounding)
    end if
    allocate (self%residual(n), self%correction(n), self%high(n), self%low(n), self%column(n), self%points(n), &
              self%loaded(n), self%missing(m), self%shift(m), self%gap_rounding(n), stat=stat)
    if (stat /= 0) return
    self%residual = 0.0_dp
    self%gap_rounding = 0.0_dp
  end subroutine fit

  !> Forces (n) and motions (m) with reduced_gap + (alpha - datum) f - R q = 0 on the contact set of `factor` and
  !> R^T f = load, not refined. `reduced_gap` (n), length; `load` (m); `datum` is zero unless the first mode is a
  !> translation.
  subroutine solve_set(factor, datum, reduced_gap, load, force, motion)
    type(kkt_factor), intent(in) :: factor
    real(dp), intent(in) :: datum, reduced_gap(:), load(:)
    real(dp), intent(out) :: force(:), motion(:)

    call factor%solve(reduced_gap, load, force, motion)
    call change_datum(factor%datum - datum, load, motion)
  end subroutine solve_set

  !> Another constant taken out of alpha moves the translation.
  pure subroutine change_datum(difference, load, motion)
    real(dp), intent(in) :: difference, load(:)
    real(dp), intent(inout) :: motion(:)

    if (abs(difference) > 0.0_dp) motion(1) = motion(1) + difference*load(1)
  end subroutine change_datum

  !> The translation recomputed from the contact point with the smallest terms, so that a translation of exactly zero is
  !> returned as zero. For the plain problem.
  pure function translation_at_shallowest(alpha, datum, reduced_gap, contact, force, motion) result(translation)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, reduced_gap(:), force(:), motion
    logical, intent(in) :: contact(:)
    real(dp) :: translation
    integer :: j, k

    k = shallowest_point(alpha, datum, reduced_gap, contact, force, motion)
    translation = reduced_gap(k)
    do j = 1, size(contact)
      if (contact(j)) translation = translation + (alpha(j, k) - datum)*force(j)
    end do
  end function translation_at_shallowest

  !> The contact point with the smallest terms: those of its displacement add up to its depth at least, so that few
  !> points need to be looked at, those of the least depth first.
  pure function shallowest_point(alpha, datum, reduced_gap, contact, force, motion) result(point)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, reduced_gap(:), force(:), motion
    logical, intent(in) :: contact(:)
    integer :: point
    real(dp) :: depth, least_depth, last_depth, least, noise, terms
    integer :: candidate, j, next

    ! A point whose force may be rounding does not count as in contact.
    noise = sqrt(epsilon(noise))*maxval(force)
    point = maxloc(force, dim=1)
    least = huge(least)
    last_depth = -1.0_dp
    do candidate = 1, CANDIDATES
      next = 0
      least_depth = 0.5_dp*least
      do j = 1, size(contact)
        if (.not. (contact(j) .and. force(j) > noise)) cycle
        depth = abs(reduced_gap(j) - motion)
        if (depth <= last_depth .or. depth >= least_depth) cycle
        least_depth = depth
        next = j
      end do
      if (next == 0) exit
      last_depth = least_depth
      terms = least_depth + displacement_magnitude_at(alpha, datum, contact, force, next)
      if (terms >= least) cycle
      least = terms
      point = next
    end do
  end function shallowest_point

  !> Iterative refinement of forces and motion on the contact set.
  !>
  !> Residuals have 24 digits of their terms, and see errors of the forces that double precision cannot. With the
  !> `regularisation` of the factor the system solved is that of the regularised alpha, with 0 that of alpha. `gap` (n)
  !> as in `solve_set`; `arrays` that `fit`, with the rounding of the gaps.
  subroutine refine_solution(canonical, gap, factor, regularisation, contact, arrays, force, motion)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), regularisation
    type(kkt_factor), intent(in) :: factor
    logical, intent(in) :: contact(:)
    type(refinement_arrays), intent(inout) :: arrays
    real(dp), intent(inout), contiguous :: force(:), motion(:)
    real(dp) :: change, last, largest
    integer :: loaded, points, step
    logical :: settled

    call list_points(contact, arrays%points, points)
    ! Points at their limits have forces that do not change.
    call list_points(contact .or. abs(force) > 0.0_dp, arrays%loaded, loaded)
    call fill_gaps(arrays%points, points)
    last = maxval(abs(force))
    arrays%changes(0) = last
    do step = 1, REFINEMENTS
      call find_residual(canonical, gap, arrays%gap_rounding, regularisation, arrays%points(:points), &
                         arrays%loaded(:loaded), force, motion, arrays%high(:points), arrays%low(:points), &
                         arrays%column(:points), arrays%residual, arrays%missing)
      call factor%solve(arrays%residual, arrays%missing, arrays%correction, arrays%shift)
      change = maxval(abs(arrays%correction))
      arrays%changes(step) = change
      arrays%corrections = step
      arrays%taken = change <= 0.5_dp*last .or. (step == 1 .and. change <= huge(change))
      ! With a regularised factor forces may be exact before the motions are.
      settled = factor%regularisation > 0.0_dp .and. change <= NO_CHANGE*maxval(abs(force))
      arrays%taken = arrays%taken .or. settled
      if (.not. arrays%taken) exit
      force = force + arrays%correction
      call change_datum(factor%datum - canonical%datum, arrays%missing, arrays%shift)
      motion = motion + arrays%shift
      largest = maxval(abs(force))
      ! Corrections shrink by about the same factor each time, so that of the last one tells the next.
      if (settled .and. any(abs(arrays%shift) > epsilon(change)*maxval(abs(motion)))) cycle
      if (change <= EXACT_ENOUGH*largest) exit
      if (last > 0.0_dp) then
        if (change*(change/last) <= EXACT_ENOUGH*largest) exit
      end if
      last = change
    end do
  end subroutine refine_solution

  !> The largest error of a force that the last refinement has left, an estimate. Arguments as for `refine_solution`,
  !> `force` and `motion` what it returned.
  !>
  !> Where the first correction is so large that the rounding of residuals counts, it is found by one more solve with
  !> the factor, for residuals of the size of that rounding and of either sign.
  subroutine find_force_error(canonical, gap, factor, force, motion, arrays, error)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), force(:), motion(:)
    type(kkt_factor), intent(in) :: factor
    type(refinement_arrays), intent(inout) :: arrays
    real(dp), intent(out) :: error
    integer :: j

    error = error_left(arrays%changes(:arrays%corrections), arrays%taken)
    if (arrays%changes(1)*(canonical%survey%largest() + abs(canonical%datum)) <= &
        RESIDUALS_COUNT*arrays%changes(0)*(canonical%survey%most - canonical%survey%least)) return
    arrays%residual = abs(gap) + abs(canonical%datum)*sum(abs(force)) &
                      + displacement_magnitude(canonical%alpha, 0.0_dp, abs(force) > 0.0_dp, force)
    do j = 1, size(motion)
      arrays%residual = arrays%residual + abs(canonical%modes(:, j)*motion(j))
      arrays%missing(j) = RESIDUAL_ROUNDING*sum(abs(canonical%modes(:, j)*force))
    end do
    call make_random_errors(arrays%residual)
    arrays%residual = RANDOM_SIGNS*RESIDUAL_ROUNDING*arrays%residual
    call factor%solve(arrays%residual, arrays%missing, arrays%correction, arrays%shift)
    error = error + maxval(abs(arrays%correction))
    ! Also where it is NaN.
    if (.not. error <= LARGEST) error = LARGEST
  end subroutine find_force_error

  !> The points marked in `contact` (n), the first `number` of `points` (n).
  pure subroutine list_points(contact, points, number)
    logical, intent(in) :: contact(:)
    integer, intent(inout) :: points(:)
    integer, intent(out) :: number
    integer :: j

    number = 0
    do j = 1, size(contact)
      if (.not. contact(j)) cycle
      number = number + 1
      points(number) = j
    end do
  end subroutine list_points

  !> Add the points between the first `number` of `points` (n), if they are few: residuals are not read there.
  pure subroutine fill_gaps(points, number)
    integer, intent(inout) :: points(:), number
    integer :: first, j, span

    if (number < 1) return
    first = points(1)
    span = points(number) - first + 1
    if ((span - number)*ROWS_PER_GAP >= span) return
    do j = 1, span
      points(j) = first + j - 1
    end do
    number = span
  end subroutine fill_gaps

  !> Residuals of the gaps (n), at the `points` of the contact and few others, and of equilibrium (m); `loaded` are the
  !> points that may have a force. `high`, `low` and `column` are work space as long as `points`. The arguments are
  !> thirteen, because three of them are work space that the caller keeps.
  subroutine find_residual(canonical, gap, gap_rounding, regularisation, points, loaded, force, motion, high, &
                                low, column, residual, missing)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), gap_rounding(:), regularisation
    integer, intent(in), contiguous :: points(:), loaded(:)
    real(dp), intent(in), contiguous :: force(:), motion(:)
    real(dp), intent(inout), contiguous :: high(:), low(:), column(:)
    real(dp), intent(inout) :: residual(:), missing(:)
    real(dp) :: shift_high(1), shift_low(1), bias
    integer :: j, k

    bias = bias_above(largest_sum(canonical, gap, regularisation, force, motion))
    high = bias
    low = 0.0_dp
    shift_high = bias
    shift_low = 0.0_dp
    ! Forces at limits may be the only ones: there is no gap to close then.
    if (size(points) > 0) then
      do j = 1, size(loaded)
        if (abs(force(loaded(j))) > 0.0_dp) call add_column([canonical%datum], -force(loaded(j)), shift_high, shift_low)
      end do
      call add_all_columns(canonical%alpha, points, loaded, force, high, low)
    end if
    ! The datum times the sum of the forces.
    column = shift_high(1) - bias
    call add_terms(column, high, low)
    do k = 1, size(points)
      column(k) = gap(points(k))
    end do
    call add_terms(column, high, low)
    do k = 1, size(points)
      column(k) = regularisation*force(points(k))
    end do
    call add_terms(column, high, low)
    do k = 1, size(points)
      low(k) = low(k) + (shift_low(1) + gap_rounding(points(k)))
    end do
    do j = 1, size(motion)
      do k = 1, size(points)
        column(k) = canonical%modes(points(k), j)
      end do
      call add_column(column, -motion(j), high, low)
      missing(j) = compensated_dot(canonical%load(j), canonical%modes(:, j), force)
    end do
    do k = 1, size(points)
      residual(points(k)) = (high(k) - bias) + low(k)
    end do
  end subroutine find_residual

  !> Add the columns of the `loaded` points at the `points`, times their forces; threads share the points if there are
  !> many.
  subroutine add_all_columns(alpha, points, loaded, force, high, low)
    real(dp), intent(in), target, contiguous :: alpha(:, :), force(:)
    integer, intent(in), target, contiguous :: points(:), loaded(:)
    real(dp), intent(inout), target, contiguous :: high(:), low(:)
    type(residual_work) :: work
    integer :: parts

    work%alpha => alpha
    work%force => force
    work%points => points
    work%loaded => loaded
    work%high => high
    work%low => low
    parts = 1
    if (real(size(points), dp)*real(size(loaded), dp) > SHARED) parts = threads_here()
    call run_in_parts(parts, work)
  end subroutine add_all_columns

  !> The points of one part.
  subroutine add_part(self, part, parts)
    class(residual_work), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, last

    call share((size(self%points) + ROWS - 1)/ROWS, part, parts, first, last)
    first = ROWS*first + 1
    last = min(ROWS*(last + 1), size(self%points))
    if (first > last) return
    call add_pairs_of_columns(self%alpha, self%points(first:last), self%loaded, self%force, self%high(first:last), &
                              self%low(first:last))
  end subroutine add_part

  !> As `add_all_columns`, two columns at a time.
  pure subroutine add_pairs_of_columns(alpha, points, loaded, force, high, low)
    real(dp), intent(in), contiguous :: alpha(:, :), force(:)
    integer, intent(in), contiguous :: points(:), loaded(:)
    real(dp), intent(inout), contiguous :: high(:), low(:)
    integer :: j, waiting

    waiting = 0
    do j = 1, size(loaded)
      if (.not. abs(force(loaded(j))) > 0.0_dp) cycle
      if (waiting == 0) then
        waiting = loaded(j)
        cycle
      end if
      call add_columns(alpha, points, waiting, loaded(j), [force(waiting), force(loaded(j))], high, low)
      waiting = 0
    end do
    if (waiting > 0) call add_columns(alpha, points, waiting, waiting, [force(waiting), 0.0_dp], high, low)
  end subroutine add_pairs_of_columns

  !> Add two columns at the `points`, times their `forces`.
  pure subroutine add_columns(alpha, points, first, second, forces, high, low)
    real(dp), intent(in), contiguous :: alpha(:, :)
    integer, intent(in), contiguous :: points(:)
    integer, intent(in) :: first, second
    real(dp), intent(in) :: forces(2)
    real(dp), intent(inout), contiguous :: high(:), low(:)
    real(dp), dimension(PANEL) :: one, other
    integer :: from, k, last, panel_size

    from = points(1)
    last = points(size(points))
    if (last - from + 1 == size(points)) then
      ! Points side by side need not be gathered.
      call add_two_columns(alpha(from:last, first), alpha(from:last, second), forces, high, low)
      return
    end if
    do from = 1, size(points), PANEL
      panel_size = min(PANEL, size(points) - from + 1)
      do k = 1, panel_size
        one(k) = alpha(points(from + k - 1), first)
        other(k) = alpha(points(from + k - 1), second)
      end do
      call add_two_columns(one(:panel_size), other(:panel_size), forces, &
                           high(from:from + panel_size - 1), low(from:from + panel_size - 1))
    end do
  end subroutine add_columns

  !> A bound of the sums of the residuals.
  pure function largest_sum(canonical, gap, regularisation, force, motion) result(most)
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), regularisation, force(:), motion(:)
    real(dp) :: most
    integer :: j

    most = maxval(abs(gap)) + (canonical%survey%largest() + abs(canonical%datum) + regularisation)*sum(abs(force))
    do j = 1, size(motion)
      most = most + maxval(abs(canonical%modes(:, j)))*abs(motion(j))
    end do
    most = min(most, huge(most))
  end function largest_sum

end module fuge_kkt_solution
