!> The certificate of a path: both ends of each of its pieces, held against the conditions of the contact problem by
!> the certificate of a solve.
!>
!> On a piece forces, gaps and motions are linear in the parameter and the states stay. So a piece satisfies the
!> conditions all along, its middle included, and its rates are right, if both of its ends do with the states and the
!> rates of the piece. Forces are taken from the path's engine, all else from the entries of the path and the caller's
!> data. The forces at the ends of several pieces are multiplied with the matrix at once.
module fuge_path_certificate
  use fuge_certificate, only: find_violation, fuge_violation
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm
  use fuge_matrix_operator, only: fuge_dense_operator
  use fuge_operator_type, only: fuge_operator
  use fuge_options_type, only: fuge_options
  use fuge_path_claims, only: find_gaps, force_beside_state, rounded_sum, set_loads
  use fuge_path_type, only: fuge_path
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_status, only: fuge_info, FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  !> The forces at this many ends of pieces are multiplied at once.
  integer, parameter :: ENDS = 48
  !> This many columns of the matrix are gathered at a time.
  integer, parameter :: COLUMNS = 64

  !> An operator whose product with the forces at hand is known.
  type, extends(fuge_operator) :: known_product
    type(fuge_dense_operator) :: matrix
    real(dp), allocatable :: displacement(:)
    !> Sizes of the terms of each displacement are added up; otherwise the displacement, which is at most as large,
    !> stands for them.
    logical :: adds_terms = .false.
  contains
    procedure :: points => points_of_matrix
    procedure :: apply => give_displacement
    procedure :: datum => datum_of_matrix
    procedure :: magnitude => give_magnitude
  end type known_product

  type, public :: path_certificate
    !> The largest violation so far and the parameter of its piece, the products so far, and an error if there is one.
    real(dp) :: residual = 0.0_dp, worst_parameter = 0.0_dp
    integer :: products = 0
    type(fuge_info) :: info
    !> The problem, whose resultants and prescribed motions follow the line from `first` (m) by `rate` (m) per unit of
    !> the parameter.
    type(fuge_problem), private :: problem
    real(dp), allocatable, private :: first(:), rate(:)
    !> Parameters are as exact as parameter + origin.
    real(dp), private :: origin = 0.0_dp
    type(known_product), private :: product
    !> Forces at the ends that wait, (n, ENDS), in use `waiting`, their parameters, and the entry of the path that
    !> begins there; 0 where a piece ends only.
    real(dp), allocatable, private :: force(:, :)
    real(dp), private :: parameter(ENDS) = 0.0_dp
    integer, private :: entry(ENDS) = 0, waiting = 0
  contains
    procedure :: start
    procedure :: add
    procedure :: add_end
    procedure :: finish
  end type path_certificate

contains

  !> Begin with the caller's matrix and problem; `first` and `rate` (m) and `origin` as in the type.
  subroutine start(self, operator, problem, first, rate, origin)
    class(path_certificate), intent(out) :: self
    type(fuge_dense_operator), intent(in) :: operator
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: first(:), rate(:), origin
    integer :: stat

    self%product%matrix = operator
    self%problem = problem
    self%first = first
    self%rate = rate
    self%origin = origin
    allocate (self%force(problem%points(), ENDS), self%product%displacement(problem%points()), stat=stat)
    if (stat /= 0) self%info%status = FUGE_ERR_MEMORY
  end subroutine start

  !> Take the forces (n) at a parameter where the piece of the last entry of the path begins or goes on, and the piece
  !> before it ends unless `add_end` has been called for that end.
  subroutine add(self, parameter, force, path)
    class(path_certificate), intent(inout) :: self
    real(dp), intent(in) :: parameter, force(:)
    type(fuge_path), intent(in) :: path

    call add_forces(self, parameter, force, path%entries, path)
  end subroutine add

  !> Take the forces (n) where the piece of the last entry of the path ends, if the next one begins with others.
  subroutine add_end(self, parameter, force, path)
    class(path_certificate), intent(inout) :: self
    real(dp), intent(in) :: parameter, force(:)
    type(fuge_path), intent(in) :: path

    call add_forces(self, parameter, force, 0, path)
  end subroutine add_end

  !> Take the forces (n) at the end of the path, at the parameter `last`, and check what waits.
  subroutine finish(self, force, last, path)
    class(path_certificate), intent(inout) :: self
    real(dp), intent(in) :: force(:), last
    type(fuge_path), intent(in) :: path

    call add_forces(self, last, force, 0, path)
    if (.not. self%info%failed()) call check(self, path)
  end subroutine finish

  subroutine add_forces(self, parameter, force, entry, path)
    type(path_certificate), intent(inout) :: self
    real(dp), intent(in) :: parameter, force(:)
    integer, intent(in) :: entry
    type(fuge_path), intent(in) :: path

    if (self%info%failed()) return
    self%waiting = self%waiting + 1
    self%parameter(self%waiting) = parameter
    self%force(:, self%waiting) = force
    self%entry(self%waiting) = entry
    if (self%waiting == ENDS) call check(self, path)
  end subroutine add_forces

  !> Check the pieces whose ends wait; the last end goes on waiting, because the next piece may begin there.
  subroutine check(self, path)
    type(path_certificate), intent(inout) :: self
    type(fuge_path), intent(in) :: path
    real(dp) :: displacement(size(self%force, 1), self%waiting)
    integer :: k

    call multiply_at_once(self%product%matrix, self%force(:, :self%waiting), displacement)
    self%products = self%products + self%waiting
    do k = 1, self%waiting - 1
      if (self%entry(k) == 0) cycle
      call check_piece(self, path, k, displacement(:, k:k + 1))
    end do
    self%parameter(1) = self%parameter(self%waiting)
    self%force(:, 1) = self%force(:, self%waiting)
    self%entry(1) = self%entry(self%waiting)
    self%waiting = 1
  end subroutine check

  !> Check the piece from the end that waits at `k` to the next one, with the displacements (n, 2) there; one shorter
  !> than the rounding of its parameter has no inside.
  !>
  !> Where the forces fall to zero at an end, they are rounding there, and nothing is left to compare them with: the
  !> check is then made a little inside; nearer to the end where bodies without any force move, whose gaps are all that
  !> is there to check.
  subroutine check_piece(self, path, k, displacement)
    type(path_certificate), intent(inout) :: self
    type(fuge_path), intent(in) :: path
    integer, intent(in) :: k
    real(dp), intent(in) :: displacement(:, :)
    real(dp), parameter :: INSIDE = 0.0625_dp, NEAR_END = 2.0_dp**(-10), SHORTEST = 1.0e-12_dp, VANISHING = 1.0e-3_dp
    real(dp) :: largest(2), fraction, least

    associate (first => self%parameter(k), last => self%parameter(k + 1))
      if (last - first <= SHORTEST*(last + self%origin)) return
      largest = maxval(abs(self%force(:, k:k + 1)), dim=1)
      least = merge(0.0_dp, NEAR_END, maxval(largest) > 0.0_dp)
      fraction = merge(INSIDE, least, largest(1) < VANISHING*largest(2))
      if (fraction > 0.0_dp .or. .not. goes_on(self, path, k)) call check_at(self, path, k, fraction, displacement)
      fraction = merge(INSIDE, least, largest(2) < VANISHING*largest(1))
      call check_at(self, path, k, 1.0_dp - fraction, displacement)
    end associate
  end subroutine check_piece

  !> Does the piece begin with the forces and, but for the last digit, the motions with which the one before it ends?
  !> Then the check of that end is one of this beginning too.
  pure function goes_on(self, path, k)
    type(path_certificate), intent(in) :: self
    type(fuge_path), intent(in) :: path
    integer, intent(in) :: k
    logical :: goes_on
    integer :: before

    goes_on = .false.
    if (k < 2) return
    before = self%entry(k - 1)
    if (before == 0) return
    associate (at_end => path%motion(:, before) + (self%parameter(k) - path%parameter(before))*path%rate(:, before), &
               at_begin => path%motion(:, self%entry(k)))
      goes_on = all(abs(at_end - at_begin) <= 4.0_dp*epsilon(at_end)*abs(at_begin))
    end associate
  end function goes_on

  !> Hold a piece against the conditions at the `fraction` of it from 0, its beginning, to 1, its end.
  subroutine check_at(self, path, k, fraction, displacement)
    type(path_certificate), intent(inout) :: self
    type(fuge_path), intent(in) :: path
    integer, intent(in) :: k
    real(dp), intent(in) :: fraction, displacement(:, :)
    type(fuge_solution) :: solution
    type(fuge_violation) :: violation
    real(dp) :: parameter, worst
    integer :: entry

    if (self%info%failed()) return
    entry = self%entry(k)
    parameter = (1.0_dp - fraction)*self%parameter(k) + fraction*self%parameter(k + 1)
    self%product%displacement = (1.0_dp - fraction)*displacement(:, 1) + fraction*displacement(:, 2)
    allocate (solution%force, source=forces_at(self, k, fraction))
    allocate (solution%motion, source=rounded_sum(path%motion(:, entry), &
                                                  (parameter - path%parameter(entry))*path%rate(:, entry)))
    call set_loads(self%first, self%rate, parameter, self%origin, self%problem, solution)
    allocate (solution%gap(size(solution%force)))
    call find_gaps(self%problem, self%product%matrix%datum(), path%states(entry), self%product%displacement, solution)
    self%product%adds_terms = .false.
    call find_violation(self%product, self%problem, solution, violation, self%info)
    if (violation%worst() > warns_above() .and. .not. self%info%failed()) then
      self%product%adds_terms = .true.
      call find_violation(self%product, self%problem, solution, violation, self%info)
    end if
    if (self%info%failed()) return
    worst = max(violation%worst(), force_beside_state(self%problem, path%states(entry), solution%force))
    if (worst <= self%residual) return
    self%residual = worst
    self%worst_parameter = path%parameter(entry)
  end subroutine check_at

  !> The forces (n) at the `fraction` of a piece. What an end would lose if its parameter were another one by rounding
  !> is no force.
  pure function forces_at(self, k, fraction) result(force)
    type(path_certificate), intent(in) :: self
    integer, intent(in) :: k
    real(dp), intent(in) :: fraction
    real(dp) :: force(size(self%force, 1))
    real(dp), parameter :: LAST_DIGITS = 8.0_dp*epsilon(1.0_dp)

    associate (first => self%parameter(k), last => self%parameter(k + 1), at_first => self%force(:, k), &
               at_last => self%force(:, k + 1))
      force = (1.0_dp - fraction)*at_first + fraction*at_last
      where (abs(force)*(last - first) <= LAST_DIGITS*(last + self%origin)*abs(at_last - at_first)) force = 0.0_dp
    end associate
  end function forces_at

  pure function warns_above() result(tolerance)
    real(dp) :: tolerance
    type(fuge_options) :: defaults

    tolerance = defaults%tolerance
  end function warns_above

  !> (A - datum) F, for all columns of `force` (n, any number) at once.
  subroutine multiply_at_once(operator, force, displacement)
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: force(:, :)
    real(dp), intent(out) :: displacement(:, :)
    real(dp), allocatable :: columns_of_matrix(:, :), factors(:, :)
    real(dp) :: datum
    logical :: has_force(size(force, 1))
    integer :: j, k, n, used

    n = size(force, 1)
    datum = operator%datum()
    has_force = .false.
    do k = 1, size(force, 2)
      has_force = has_force .or. abs(force(:, k)) > 0.0_dp
    end do
    allocate (columns_of_matrix(n, COLUMNS), factors(COLUMNS, size(force, 2)))
    displacement = 0.0_dp
    used = 0
    do j = 1, n
      if (has_force(j)) then
        used = used + 1
        columns_of_matrix(:, used) = operator%alpha(:n, j) - datum
        factors(used, :) = force(j, :)
      end if
      if (used == 0 .or. (used < COLUMNS .and. j < n)) cycle
      call dgemm('N', 'N', n, size(force, 2), used, 1.0_dp, columns_of_matrix, n, factors, COLUMNS, 1.0_dp, &
                 displacement, n)
      used = 0
    end do
  end subroutine multiply_at_once

  pure function points_of_matrix(self) result(n)
    class(known_product), intent(in) :: self
    integer :: n

    n = self%matrix%points()
  end function points_of_matrix

  !> The known displacement. Nothing is done with `force` (n), which it belongs to.
  subroutine give_displacement(self, force, displacement, status)
    class(known_product), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer, intent(out) :: status

    displacement = self%displacement
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, size(force) == size(displacement))
  end subroutine give_displacement

  function datum_of_matrix(self) result(datum)
    class(known_product), intent(in) :: self
    real(dp) :: datum

    datum = self%matrix%datum()
  end function datum_of_matrix

  !> Sizes of the terms of the displacements, or less.
  subroutine give_magnitude(self, force, displacement, magnitude)
    class(known_product), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)

    if (self%adds_terms) then
      call self%matrix%magnitude(force, displacement, magnitude)
    else
      magnitude = abs(displacement)
    end if
  end subroutine give_magnitude

end module fuge_path_certificate
