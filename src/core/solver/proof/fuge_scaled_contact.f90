!> A contact problem with a matrix and its solution in units that are powers of two, in which no number is far from 1:
!> scaling rounds nothing, and what underflows is negligible.
!>
!> A point k has the power p_k, so that A_ij becomes 2**(p_i + p_j) A_ij, f_k becomes 2**(-p_k - u) f_k and c_k becomes
!> 2**(p_k - u) c_k, where u belongs to all. A motion j has the power t_j, so that R_kj becomes 2**(p_k + t_j) R_kj, q_j
!> becomes 2**(-t_j - u) q_j and w_j becomes 2**(t_j - u) w_j. The powers give A + R W R^T, W a diagonal matrix of
!> weights, a diagonal of about 1: that is definite where A is on forces without resultants.
module fuge_scaled_contact
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_rounding_bounds, only: absolute_product, gamma_bound, raised
  use fuge_verified_definite, only: prove_definite
  implicit none
  private

  public :: scale_contact

  !> Weight of a free motion, for coefficients and rigid displacements up to 1: more than a datum of A can take.
  real(dp), parameter :: WEIGHT = 2.0_dp
  !> The power of zero: below all others, which can be subtracted from it.
  integer, parameter :: NO_POWER = -2**30
  !> Factors below 2 to this power and their products are in range.
  integer, parameter :: MOST_POWER = 400
  !> How often it is raised, by a factor of four.
  integer, parameter :: MOST_RAISES = 40
  !> The factor by which it is raised where that does not make A definite, and how often.
  real(dp), parameter :: RAISE = 64.0_dp
  integer, parameter :: TRIES = 4
  !> Most matrices are far from singular: the first try proves a larger eigenvalue, which makes bounds sharper.
  real(dp), parameter :: LARGE_MARGIN = 256.0_dp, SMALL_MARGIN = 1.5_dp

  type, public :: scaled_contact
    integer :: points = 0, motions = 0
    integer, allocatable :: point_power(:), motion_power(:)
    integer :: unit = 0
    !> A + D, whose lower triangle is that of the caller's A, and what the rounding of A + D took, (n).
    real(dp), allocatable :: matrix(:, :), diagonal_rest(:)
    !> R (n, m), S (m), and the weights W, 0 for prescribed motions, (m).
    real(dp), allocatable :: modes(:, :), stiffness(:), weight(:)
    !> Initial gaps and resultants.
    real(dp), allocatable :: gap(:), resultant(:)
    !> The solution's. A prescribed motion is that of the problem.
    real(dp), allocatable :: force(:), claimed_gap(:), motion(:)
    !> Not above the least eigenvalue of A + R W R^T on the points that can have a force, once it is proved to be
    !> definite.
    real(dp) :: least = 0.0_dp
    !> Which points can have a force, (n), and which motions are free, (m)?
    logical, allocatable :: included(:), free(:)
  contains
    procedure :: prove_uniqueness
    procedure :: is_in_range
    procedure :: scaled_force
    procedure :: scaled_length
    procedure :: force_of
    procedure :: length_of
    procedure :: motion_of
  end type scaled_contact

contains

  !> Scale; `alpha` (lda, n). `stat` is not 0 without memory. `is_suited` is false where a diagonal element of
  !> A + R W R^T is not positive, elements differ too much in size, or there are too many points for the bounds.
  subroutine scale_contact(alpha, problem, solution, contact, is_suited, stat)
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(scaled_contact), intent(inout) :: contact
    logical, intent(out) :: is_suited
    integer, intent(out) :: stat
    integer :: m, n

    is_suited = .false.
    n = problem%points()
    m = problem%mode_count()
    allocate (contact%point_power(n), contact%motion_power(m), contact%matrix(n, n), contact%diagonal_rest(n), &
              contact%modes(n, m), contact%stiffness(m), contact%weight(m), contact%gap(n), contact%resultant(m), &
              contact%force(n), contact%claimed_gap(n), contact%motion(m), contact%included(n), contact%free(m), &
              stat=stat)
    if (stat /= 0) return
    contact%points = n
    contact%motions = m
    contact%included = .true.
    if (allocated(problem%excluded)) contact%included = .not. problem%excluded
    contact%free = .true.
    if (allocated(problem%prescribed)) contact%free = .not. problem%prescribed
    contact%modes = 1.0_dp
    if (allocated(problem%modes)) contact%modes = problem%modes
    call take_matrix(alpha, problem, contact)
    call choose_powers(problem, contact, is_suited)
    is_suited = is_suited .and. n < 2**20
    if (.not. is_suited) return
    call scale_operator(contact)
    is_suited = all(abs(contact%matrix) <= huge(1.0_dp)) .and. all(abs(contact%modes) <= huge(1.0_dp))
    if (.not. is_suited) return
    call scale_vectors(problem, solution, contact)
  end subroutine scale_contact

  !> A + D of the lower triangle, both triangles.
  pure subroutine take_matrix(alpha, problem, contact)
    real(dp), intent(in), contiguous :: alpha(:, :)
    type(fuge_problem), intent(in) :: problem
    type(scaled_contact), intent(inout) :: contact
    real(dp) :: from_compliance, sum
    integer :: j

    do j = 1, contact%points
      contact%matrix(j:, j) = alpha(j:contact%points, j)
    end do
    contact%diagonal_rest = 0.0_dp
    if (.not. allocated(problem%compliance)) return
    associate (compliance => problem%compliance)
      do j = 1, contact%points
        sum = contact%matrix(j, j) + compliance(lbound(compliance, 1) + j - 1)
        from_compliance = sum - contact%matrix(j, j)
        contact%diagonal_rest(j) = (contact%matrix(j, j) - (sum - from_compliance)) &
                                   + (compliance(lbound(compliance, 1) + j - 1) - from_compliance)
        contact%matrix(j, j) = sum
      end do
    end associate
  end subroutine take_matrix

  !> The powers of points and motions, and the weights.
  pure subroutine choose_powers(problem, contact, is_suited)
    type(fuge_problem), intent(in) :: problem
    type(scaled_contact), intent(inout) :: contact
    logical, intent(out) :: is_suited
    real(dp) :: diagonal, largest
    integer :: first(size(contact%motion_power)), j, k, start

    largest = 0.0_dp
    do j = 1, contact%points
      if (contact%included(j)) largest = max(largest, maxval(abs(contact%matrix(j:, j)), contact%included(j:)))
    end do
    start = -half(exponent(largest))
    contact%point_power = start
    contact%stiffness = problem%stiffnesses()
    call choose_motion_powers(contact)
    first = contact%motion_power
    do j = 1, contact%motions
      contact%weight(j) = 0.0_dp
      if (contact%free(j)) contact%weight(j) = &
        min(WEIGHT, 0.49_dp/max(scale(contact%stiffness(j), 2*first(j)), tiny(1.0_dp)))
    end do
    call raise_weights(contact, start)
    is_suited = .true.
    do k = 1, contact%points
      if (.not. contact%included(k)) cycle
      diagonal = weighted_diagonal(contact, k, start)
      is_suited = is_suited .and. diagonal > 0.0_dp
      if (diagonal > 0.0_dp) contact%point_power(k) = start - half(exponent(diagonal))
    end do
    call choose_motion_powers(contact)
    contact%weight = scale(contact%weight, 2*(first - contact%motion_power))
    call choose_excluded_powers(contact)
  end subroutine choose_powers

  !> Raise the weights of motions without springs until no diagonal element is negative where there is a datum.
  pure subroutine raise_weights(contact, start)
    type(scaled_contact), intent(inout) :: contact
    integer, intent(in) :: start
    logical :: is_negative
    integer :: k, times

    do times = 1, MOST_RAISES
      is_negative = .false.
      do k = 1, contact%points
        if (.not. contact%included(k)) cycle
        if (weighted_diagonal(contact, k, start) <= -scale(contact%matrix(k, k), 2*start)) is_negative = .true.
      end do
      if (.not. is_negative) exit
      where (.not. contact%stiffness > 0.0_dp) contact%weight = 4.0_dp*contact%weight
    end do
  end subroutine raise_weights

  !> Diagonal element `k` of A + R W R^T, where all points and motions have the power that they `start` from.
  pure function weighted_diagonal(contact, k, start) result(diagonal)
    type(scaled_contact), intent(in) :: contact
    integer, intent(in) :: k, start
    real(dp) :: diagonal

    diagonal = scale(contact%matrix(k, k), 2*start) &
               + sum(contact%weight*scale(contact%modes(k, :), start + contact%motion_power)**2)
  end function weighted_diagonal

  !> Half of an integer, rounded down.
  elemental function half(number)
    integer, intent(in) :: number
    integer :: half

    half = (number - modulo(number, 2))/2
  end function half

  !> Powers of motions by which no included point is displaced by more than 1, and no stiffness is above 1.
  pure subroutine choose_motion_powers(contact)
    type(scaled_contact), intent(inout) :: contact
    integer :: j, largest

    do j = 1, contact%motions
      ! By exponents, because the numbers themselves may not be in range before they are scaled.
      largest = -huge(largest)
      if (contact%stiffness(j) > 0.0_dp) largest = half(exponent(contact%stiffness(j)) + 1)
      largest = max(largest, maxval(exponent(contact%modes(:, j)) + contact%point_power, &
                                    contact%included .and. abs(contact%modes(:, j)) > 0.0_dp))
      contact%motion_power(j) = 0
      if (largest > -huge(largest)) contact%motion_power(j) = -largest
    end do
  end subroutine choose_motion_powers

  !> Powers of excluded points, by which no force or motion displaces them by more than about 1.
  pure subroutine choose_excluded_powers(contact)
    type(scaled_contact), intent(inout) :: contact
    integer :: j, k, largest

    do k = 1, contact%points
      if (contact%included(k)) cycle
      largest = -huge(largest)
      do j = 1, contact%points
        associate (element => contact%matrix(max(j, k), min(j, k)))
          if (contact%included(j) .and. abs(element) > 0.0_dp) &
            largest = max(largest, exponent(element) + contact%point_power(j))
        end associate
      end do
      largest = max(largest, maxval(exponent(contact%modes(k, :)) + contact%motion_power, &
                                    abs(contact%modes(k, :)) > 0.0_dp))
      if (largest > -huge(largest)) contact%point_power(k) = -largest
    end do
  end subroutine choose_excluded_powers

  !> Multiply the lower triangle by factors of rows and columns that are powers of two, which rounds nothing.
  pure subroutine multiply_lower(factor, matrix)
    real(dp), intent(in) :: factor(:)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    integer :: j

    do j = 1, size(factor)
      matrix(j:, j) = matrix(j:, j)*(factor(j:)*factor(j))
    end do
  end subroutine multiply_lower

  !> As multiply_lower, where factors may be out of range. Elements of two excluded points are of no use.
  pure subroutine scale_lower(contact)
    type(scaled_contact), intent(inout) :: contact
    integer :: j

    do j = 1, contact%points
      where (contact%included(j:) .or. contact%included(j))
        contact%matrix(j:, j) = scale(contact%matrix(j:, j), contact%point_power(j:) + contact%point_power(j))
      else where
        contact%matrix(j:, j) = 0.0_dp
      end where
    end do
  end subroutine scale_lower

  !> Copy the lower triangle to the upper one, a block after the other, each of which stays in cache.
  pure subroutine mirror(matrix)
    real(dp), intent(inout), contiguous :: matrix(:, :)
    integer, parameter :: BLOCK = 32
    integer :: first, j, last, row

    do first = 1, size(matrix, 2), BLOCK
      last = min(first + BLOCK - 1, size(matrix, 2))
      do row = 1, first - 1, BLOCK
        do j = first, last
          matrix(row:row + BLOCK - 1, j) = matrix(j, row:row + BLOCK - 1)
        end do
      end do
      do j = first, last
        matrix(first:j - 1, j) = matrix(j, first:j - 1)
      end do
    end do
  end subroutine mirror

  !> Excluded points have no forces: their columns, which may be of any size, are set to zero.
  pure subroutine scale_operator(contact)
    type(scaled_contact), intent(inout) :: contact
    integer :: j

    associate (n => contact%points, power => contact%point_power)
      if (all(contact%included) .and. maxval(abs(power)) < MOST_POWER) then
        call multiply_lower(scale(1.0_dp, power), contact%matrix)
      else
        call scale_lower(contact)
      end if
      call mirror(contact%matrix)
      do j = 1, n
        if (.not. contact%included(j)) contact%matrix(:, j) = 0.0_dp
        if (.not. contact%included(j)) contact%diagonal_rest(j) = 0.0_dp
      end do
      contact%diagonal_rest = scale(contact%diagonal_rest, 2*power)
      do j = 1, contact%motions
        contact%modes(:, j) = scale(contact%modes(:, j), power + contact%motion_power(j))
      end do
      contact%stiffness = scale(contact%stiffness, 2*contact%motion_power)
    end associate
  end subroutine scale_operator

  !> Gaps, resultants and the solution, in the unit of the largest.
  pure subroutine scale_vectors(problem, solution, contact)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(scaled_contact), intent(inout) :: contact
    integer :: largest

    contact%gap = problem%gap
    contact%claimed_gap = solution%gap
    contact%force = solution%force
    contact%motion = solution%motion
    if (allocated(problem%prescribed)) where (problem%prescribed) contact%motion = problem%motion
    contact%resultant = problem%resultants()
    largest = max(largest_power(contact%gap, contact%point_power), &
                  largest_power(contact%claimed_gap, contact%point_power), &
                  largest_power(contact%force, -contact%point_power), &
                  largest_power(contact%motion, -contact%motion_power), &
                  largest_power(contact%resultant, contact%motion_power))
    contact%unit = 0
    if (largest > NO_POWER) contact%unit = largest
    contact%gap = contact%scaled_length(contact%gap)
    contact%claimed_gap = contact%scaled_length(contact%claimed_gap)
    contact%force = contact%scaled_force(contact%force)
    contact%motion = scale(contact%motion, -contact%motion_power - contact%unit)
    contact%resultant = scale(contact%resultant, contact%motion_power - contact%unit)
  end subroutine scale_vectors

  !> The exponent of the largest value, each scaled by its power.
  pure function largest_power(values, power) result(largest)
    real(dp), intent(in) :: values(:)
    integer, intent(in) :: power(:)
    integer :: largest

    largest = maxval([NO_POWER, exponent(values) + power], [.true., abs(values) > 0.0_dp])
  end function largest_power

  !> Are these forces and lengths of all points far from overflow in scaled units?
  pure function is_in_range(self, force, length)
    class(scaled_contact), intent(in) :: self
    real(dp), intent(in) :: force(:), length(:)
    logical :: is_in_range

    is_in_range = largest_power(force, -self%point_power) - self%unit < MOST_POWER &
                  .and. largest_power(length, self%point_power) - self%unit < MOST_POWER
  end function is_in_range

  !> Forces of all points in scaled units.
  pure function scaled_force(self, force) result(scaled)
    class(scaled_contact), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp) :: scaled(size(force))

    scaled = scale(force, -self%point_power - self%unit)
  end function scaled_force

  !> Lengths of all points in scaled units.
  pure function scaled_length(self, length) result(scaled)
    class(scaled_contact), intent(in) :: self
    real(dp), intent(in) :: length(:)
    real(dp) :: scaled(size(length))

    scaled = scale(length, self%point_power - self%unit)
  end function scaled_length

  !> Bounds of forces of all points, from scaled units.
  pure function force_of(self, scaled) result(force)
    class(scaled_contact), intent(in) :: self
    real(dp), intent(in) :: scaled(:)
    real(dp) :: force(size(scaled))

    force = scaled_up(scaled, self%point_power + self%unit)
  end function force_of

  !> Bounds of lengths of all points, from scaled units.
  pure function length_of(self, scaled) result(length)
    class(scaled_contact), intent(in) :: self
    real(dp), intent(in) :: scaled(:)
    real(dp) :: length(size(scaled))

    length = scaled_up(scaled, self%unit - self%point_power)
  end function length_of

  !> Bounds of all motions, from scaled units.
  pure function motion_of(self, scaled) result(motion)
    class(scaled_contact), intent(in) :: self
    real(dp), intent(in) :: scaled(:)
    real(dp) :: motion(size(scaled))

    motion = scaled_up(scaled, self%motion_power + self%unit)
  end function motion_of

  !> A bound times 2**power, not rounded down where it underflows.
  elemental function scaled_up(bound, power) result(scaled)
    real(dp), intent(in) :: bound
    integer, intent(in) :: power
    real(dp) :: scaled

    scaled = scale(bound, power)
    if (bound > 0.0_dp) scaled = max(scaled, tiny(scaled))
  end function scaled_up

  !> Is it proved that A + D is positive definite on all forces of included points whose resultants in the free motions
  !> without springs are zero, and that with the springs no others are without energy? `stat` is not 0 without memory.
  subroutine prove_uniqueness(self, is_proved, stat)
    class(scaled_contact), intent(inout) :: self
    logical, intent(out) :: is_proved
    integer, intent(out) :: stat
    real(dp), allocatable :: form(:, :)
    integer, allocatable :: place(:)
    real(dp) :: terms
    integer :: k, p, try

    is_proved = .false.
    p = count(self%included)
    allocate (form(p, p), place(p), stat=stat)
    if (stat /= 0) return
    place(:) = pack([(k, k=1, self%points)], self%included)
    do try = 1, TRIES
      if (try > 2) then
        where (.not. self%stiffness > 0.0_dp) self%weight = RAISE*self%weight
      end if
      call fill_form(self, place, form)
      call sum_terms(self, terms)
      ! Each element has so many roundings, A + D one more.
      call prove_definite(form, gamma_bound(3*self%motions + 4)*terms, is_proved, &
                          merge(LARGE_MARGIN, SMALL_MARGIN, try == 1), self%least)
      if (is_proved) exit
    end do
  end subroutine prove_uniqueness

  !> The lower triangle of A + R W R^T on the points `place` (p).
  pure subroutine fill_form(contact, place, form)
    type(scaled_contact), intent(in) :: contact
    integer, intent(in) :: place(:)
    real(dp), intent(inout), contiguous :: form(:, :)
    integer :: j, k

    do j = 1, size(place)
      if (size(place) == contact%points) then
        form(j:, j) = contact%matrix(j:, j)
      else
        form(j:, j) = contact%matrix(place(j:), place(j))
      end if
      do k = 1, contact%motions
        if (contact%weight(k) > 0.0_dp) form(j:, j) = form(j:, j) + (contact%weight(k)*contact%modes(place(j), k)) &
                                                      *contact%modes(place(j:), k)
      end do
    end do
  end subroutine fill_form

  !> An upper bound of the 2-norm of the matrix that has the magnitudes of the terms of that form as its elements.
  pure subroutine sum_terms(contact, terms)
    class(scaled_contact), intent(in) :: contact
    real(dp), intent(out) :: terms
    real(dp) :: ones(contact%points), rows(contact%points)
    integer :: k

    ones = merge(1.0_dp, 0.0_dp, contact%included)
    call absolute_product(contact%matrix, ones, rows)
    terms = maxval(rows, contact%included)
    if (.not. any(contact%included)) terms = 0.0_dp
    do k = 1, contact%motions
      terms = terms + contact%weight(k)*maxval(abs(contact%modes(:, k))*ones)*sum(abs(contact%modes(:, k))*ones)
    end do
    terms = raised(terms, contact%points + 3*contact%motions + 4)
  end subroutine sum_terms

end module fuge_scaled_contact
