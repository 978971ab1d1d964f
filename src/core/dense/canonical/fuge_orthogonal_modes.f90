!> Rigid modes made orthogonal, body by body, and the way back to the given ones.
!>
!> Neither the units of the given modes nor a far-away point of reference then costs digits, and a small load on one
!> body keeps its digits beside a large one on another.
module fuge_orthogonal_modes
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgesv
  use fuge_pivoted_qr, only: orthonormalise, orthonormalise_in_order
  use fuge_point_space, only: point_space
  use fuge_shared_columns, only: orthonormalise_shared, swap_columns
  implicit none
  private

  public :: bodies_of_modes, make_orthogonal

  !> A mode is linearly dependent on the others if its remainder after projection is below this fraction.
  real(dp), parameter :: DEPENDENT = 1.0e-12_dp
  !> The constant vector lies in the span of the modes if its remainder is below this fraction.
  real(dp), parameter :: CONSTANT_TOLERANCE = 1.0e-13_dp

  !> The given modes as modes*coefficients*diag(units); not allocated where they are the same. Systems are solved
  !> without the units, which may be far apart.
  type, public :: mode_change
    !> (m, m), of order 1.
    real(dp), allocatable :: coefficients(:, :)
    !> The largest displacement of each given mode, (m); length per unit of its motion.
    real(dp), allocatable :: units(:)
  contains
    procedure :: given_motion
    procedure :: orthogonal_load
    procedure :: contributions
  end type mode_change

  !> A fault of the modes: the position of one that moves no point, or that is a combination of others; 0 if there is
  !> none. `stat` is not zero without memory.
  type, public :: mode_fault
    integer :: idle = 0, dependent = 0, stat = 0
  contains
    procedure :: found
  end type mode_fault

contains

  elemental function found(self)
    class(mode_fault), intent(in) :: self
    logical :: found

    found = self%idle > 0 .or. self%dependent > 0 .or. self%stat /= 0
  end function found

  !> Modes of equal size that span the same motions and are orthogonal at the points that take part; the first is the
  !> constant 1 if that lies in the span of the modes of one body.
  !>
  !> `columns` (n, m) the given modes; `excluded` (n); where ranks, `sharing`, share the points, those of this rank.
  !> Out: `modes` (n, m), zero where excluded; `change`; `has_translation`: modes(:, 1) is the constant. All but
  !> `fault` are undefined if one was found.
  subroutine make_orthogonal(columns, excluded, modes, change, has_translation, fault, sharing)
    real(dp), intent(in) :: columns(:, :)
    logical, intent(in) :: excluded(:)
    real(dp), intent(out) :: modes(:, :)
    type(mode_change), intent(out) :: change
    logical, intent(out) :: has_translation
    type(mode_fault), intent(out) :: fault
    type(point_space), intent(in), optional :: sharing
    type(point_space) :: space
    real(dp), allocatable :: scaled(:, :)
    integer :: body(size(columns, 2)), j, m

    if (present(sharing)) space = sharing
    m = size(columns, 2)
    has_translation = .false.
    modes = 0.0_dp
    allocate (change%coefficients(m, m), change%units(m), scaled(size(columns, 1), m), stat=fault%stat)
    call share_fault(space, fault)
    if (fault%stat /= 0) return
    do j = 1, m
      scaled(:, j) = merge(0.0_dp, columns(:, j), excluded)
      change%units(j) = maxval(abs(scaled(:, j)))
    end do
    call space%raise(change%units)
    if (any(.not. change%units > 0.0_dp)) then
      fault%idle = minloc(change%units, dim=1)
      return
    end if
    do j = 1, m
      scaled(:, j) = scaled(:, j)/change%units(j)
    end do
    change%coefficients = 0.0_dp
    if (is_orthogonal(scaled, space)) then
      call keep_modes(scaled, excluded, space, modes, change%coefficients, has_translation)
      return
    end if
    body = bodies_of_modes(scaled, space)
    do j = 1, m
      if (body(j) == j) then
        call orthogonalise_body(columns, excluded, space, body == j, modes, change, has_translation, fault)
      end if
      if (fault%found()) return
    end do
  end subroutine make_orthogonal

  !> No rank has memory where one has none.
  subroutine share_fault(space, fault)
    type(point_space), intent(in) :: space
    type(mode_fault), intent(inout) :: fault

    if (space%anywhere(fault%stat /= 0)) fault%stat = 1
  end subroutine share_fault

  !> The modes of one body among the given ones (n, m), marked in `member` (m).
  subroutine orthogonalise_body(given, excluded, space, member, modes, change, has_translation, fault)
    real(dp), intent(in) :: given(:, :)
    logical, intent(in) :: excluded(:), member(:)
    type(point_space), intent(in) :: space
    real(dp), intent(inout) :: modes(:, :)
    type(mode_change), intent(inout) :: change
    logical, intent(inout) :: has_translation
    type(mode_fault), intent(inout) :: fault
    real(dp), allocatable :: own(:, :)
    real(dp) :: coefficients(count(member), count(member)), datum(count(member)), sense
    integer :: columns(count(member)), constant, j

    allocate (own(size(given, 1), size(columns)), stat=fault%stat)
    call share_fault(space, fault)
    if (fault%stat /= 0) return
    columns = pack([(j, j=1, size(member))], member)
    do j = 1, size(columns)
      own(:, j) = merge(0.0_dp, given(:, columns(j)), excluded)
    end do
    call find_datum(own, space, constant, datum)
    sense = 1.0_dp
    if (constant > 0) then
      do j = 1, size(columns)
        where (abs(own(:, constant)) > 0.0_dp) own(:, j) = own(:, j) - datum(j)
      end do
      if (space%anywhere(any(own(:, constant) < 0.0_dp))) sense = -1.0_dp
    end if
    do j = 1, size(columns)
      own(:, j) = own(:, j)/change%units(columns(j))
    end do
    call orthogonalise_columns(own, excluded, space, columns, modes, coefficients, has_translation, fault)
    if (fault%found()) return
    do j = 1, size(columns)
      ! The constant is 1 or -1 in its own unit.
      if (constant > 0) coefficients(:, j) = coefficients(:, j) + sense*(datum(j)/change%units(columns(j))) &
                                             *coefficients(:, constant)
    end do
    change%coefficients(columns, columns) = coefficients
  end subroutine orthogonalise_body

  !> `own` (n, k), the modes of one body, as basis*coefficients (k, k); the basis becomes the `columns` (k) of `modes`.
  subroutine orthogonalise_columns(own, excluded, space, columns, modes, coefficients, has_translation, fault)
    real(dp), intent(in) :: own(:, :)
    logical, intent(in) :: excluded(:)
    type(point_space), intent(in) :: space
    integer, intent(in) :: columns(:)
    real(dp), intent(inout) :: modes(:, :)
    real(dp), intent(out) :: coefficients(:, :)
    logical, intent(inout) :: has_translation
    type(mode_fault), intent(inout) :: fault
    real(dp), allocatable :: basis(:, :)
    real(dp) :: points
    integer :: order(size(columns)), i, j, rank, replaced

    coefficients = 0.0_dp
    allocate (basis, source=own, stat=fault%stat)
    call share_fault(space, fault)
    if (fault%stat /= 0) return
    if (space%is_alone()) then
      call orthonormalise(basis, DEPENDENT, order, rank, fault%stat)
    else
      call orthonormalise_shared(space, basis, DEPENDENT, .true., order, rank)
    end if
    if (fault%stat /= 0) return
    if (rank < size(columns)) then
      fault%dependent = columns(order(rank + 1))
      return
    end if
    call replace_by_constant(basis, excluded, space, replaced)
    if (replaced > 0) then
      has_translation = .true.
      do i = 1, replaced - 1
        do j = 1, size(columns) - 1
          call swap_columns(j, j + 1, basis)
        end do
      end do
      if (space%is_alone()) then
        call orthonormalise_in_order(basis, fault%stat)
      else
        call orthonormalise_shared(space, basis, 0.0_dp, .false., order, rank)
      end if
      if (fault%stat /= 0) return
    end if
    ! A point that no mode of the body moves must stay so in spite of rounding: its force contributes to no resultant.
    do j = 1, size(basis, 1)
      if (all(abs(own(j, :)) <= 0.0_dp)) basis(j, :) = 0.0_dp
    end do
    points = space%total(real(count(.not. excluded), dp))
    basis = basis*sqrt(points)
    if (replaced > 0) basis(:, 1) = merge(0.0_dp, 1.0_dp, excluded)
    modes(:, columns) = basis
    call find_coefficients(own, basis, points, space, coefficients, fault)
  end subroutine orthogonalise_columns

  !> The `datum` (m) of the modes of one body, the columns of `own` (n, m), which may be counted from far away. Where
  !> mode `constant` moves a point the datum is to be subtracted from them, which is exact; without that their rounding
  !> would be that of the distance.
  !>
  !> `constant` is 0, and so are all of `datum`, if no mode is a constant on the points that it moves. The ranks of
  !> `space` share the points.
  subroutine find_datum(own, space, constant, datum)
    real(dp), intent(in) :: own(:, :)
    type(point_space), intent(in) :: space
    integer, intent(out) :: constant
    real(dp), intent(out) :: datum(:)
    real(dp) :: extremes(2)
    integer :: j

    datum = 0.0_dp
    constant = 0
    do j = size(datum), 1, -1
      extremes = extremes_where(own(:, j), own(:, j), space)
      if (extremes(1) >= extremes(2)) constant = j
    end do
    if (constant == 0) return
    do j = 1, size(datum)
      if (j == constant) cycle
      extremes = extremes_where(own(:, j), own(:, constant), space)
      ! A difference of two numbers is exact if neither is more than twice the other one (P. H. Sterbenz, 1974).
      if (extremes(1) > 0.0_dp .and. extremes(2) <= 2.0_dp*extremes(1)) then
        datum(j) = extremes(2)
      else if (extremes(2) < 0.0_dp .and. extremes(1) >= 2.0_dp*extremes(2)) then
        datum(j) = extremes(1)
      end if
    end do
  end subroutine find_datum

  !> The least and the largest one of the values at points that `mode` (n) moves, (2).
  function extremes_where(values, mode, space) result(extremes)
    real(dp), intent(in) :: values(:), mode(:)
    type(point_space), intent(in) :: space
    real(dp) :: extremes(2)
    integer :: k

    extremes = -huge(extremes)
    do k = 1, size(values)
      if (abs(mode(k)) > 0.0_dp) extremes = max(extremes, [-values(k), values(k)])
    end do
    call space%raise(extremes)
    extremes(1) = -extremes(1)
  end function extremes_where

  !> The columns `own` (n, m) as basis*coefficients, (m, m). Sums over many points are rounded, which would make a tilt
  !> of a large motion: so what the first coefficients leave of the columns is expressed too.
  subroutine find_coefficients(own, basis, points, space, coefficients, fault)
    real(dp), intent(in) :: own(:, :), basis(:, :), points
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: coefficients(:, :)
    type(mode_fault), intent(inout) :: fault
    real(dp), allocatable :: remainder(:, :)
    real(dp) :: change(size(own, 2), size(own, 2)), products(size(own, 2)**2)
    integer :: i, j, m, pass

    m = size(own, 2)
    coefficients = 0.0_dp
    allocate (remainder(size(basis, 1), m), stat=fault%stat)
    call share_fault(space, fault)
    if (fault%stat /= 0) return
    remainder = own
    do pass = 1, 2
      products = [((dot_product(basis(:, i), remainder(:, j)), i=1, m), j=1, m)]
      call space%add(products)
      change = reshape(products, shape(change))/points
      coefficients = coefficients + change
      if (pass == 2) exit
      do j = 1, m
        do i = 1, m
          remainder(:, j) = remainder(:, j) - basis(:, i)*change(i, j)
        end do
      end do
    end do
  end subroutine find_coefficients

  !> Which modes belong together, (m): the number of the first mode of the body. Modes that move a common point belong
  !> to one body. `modes` (n, m), where ranks, `sharing`, share the points those of this rank.
  function bodies_of_modes(modes, sharing) result(body)
    real(dp), intent(in) :: modes(:, :)
    type(point_space), intent(in), optional :: sharing
    integer :: body(size(modes, 2))
    integer :: first, j, k, low, high

    body = [(j, j=1, size(body))]
    do k = 1, size(modes, 1)
      first = 0
      do j = 1, size(body)
        if (abs(modes(k, j)) <= 0.0_dp) cycle
        if (first == 0) first = j
        if (body(first) == body(j)) cycle
        low = min(body(first), body(j))
        high = max(body(first), body(j))
        where (body == high) body = low
      end do
      if (all(body == 1)) exit
    end do
    if (.not. present(sharing)) return
    if (.not. sharing%is_alone()) call join_bodies(sharing, body)
  end function bodies_of_modes

  !> Join bodies that any of the ranks has found to be one.
  subroutine join_bodies(space, body)
    type(point_space), intent(in) :: space
    integer, intent(inout) :: body(:)
    real(dp) :: joined(size(body)**2)
    integer :: i, j, k

    joined = [((merge(1.0_dp, 0.0_dp, body(i) == body(j)), i=1, size(body)), j=1, size(body))]
    call space%raise(joined)
    body = [(j, j=1, size(body))]
    ! Each pass takes the least number one mode further.
    do k = 1, size(body)
      do j = 1, size(body)
        body(j) = minval(body, mask=joined((j - 1)*size(body) + 1:j*size(body)) > 0.0_dp)
      end do
    end do
  end subroutine join_bodies

  !> Are the columns orthogonal to each other?
  function is_orthogonal(matrix, space) result(orthogonal)
    real(dp), intent(in) :: matrix(:, :)
    type(point_space), intent(in) :: space
    logical :: orthogonal
    real(dp) :: inner, lengths(size(matrix, 2))
    integer :: i, j

    lengths = [(length_of(matrix(:, j), space), j=1, size(matrix, 2))]
    orthogonal = .true.
    do j = 2, size(matrix, 2)
      do i = 1, j - 1
        inner = space%total(dot_product(matrix(:, i), matrix(:, j)))
        orthogonal = orthogonal .and. abs(inner) <= DEPENDENT*lengths(i)*lengths(j)
      end do
    end do
  end function is_orthogonal

  !> The norm of the values of all ranks.
  function length_of(values, space) result(length)
    real(dp), intent(in) :: values(:)
    type(point_space), intent(in) :: space
    real(dp) :: length

    length = norm2(values)
    if (.not. space%is_alone()) length = sqrt(space%total(length**2))
  end function length_of

  !> Keep orthogonal modes, `scaled` (n, m), but for their size; a constant one becomes the first.
  subroutine keep_modes(scaled, excluded, space, modes, coefficients, has_translation)
    real(dp), intent(in) :: scaled(:, :)
    logical, intent(in) :: excluded(:)
    type(point_space), intent(in) :: space
    real(dp), intent(inout) :: modes(:, :), coefficients(:, :)
    logical, intent(out) :: has_translation
    real(dp) :: unit
    integer :: first, j, m, position

    m = size(scaled, 2)
    first = 0
    do j = m, 1, -1
      if (is_constant(scaled(:, j), excluded, space)) first = j
    end do
    has_translation = first > 0
    do j = 1, m
      ! A cyclic shift brings the constant mode to the front.
      position = modulo(j - max(first, 1), m) + 1
      unit = length_of(scaled(:, j), space)/sqrt(space%total(real(count(.not. excluded), dp)))
      ! The constant is 1, not -1 or its rounding.
      if (j == first) unit = merge(-1.0_dp, 1.0_dp, space%anywhere(any(scaled(:, j) < 0.0_dp)))
      modes(:, position) = scaled(:, j)/unit
      if (j == first) modes(:, position) = merge(0.0_dp, 1.0_dp, excluded)
      coefficients(position, j) = unit
    end do
  end subroutine keep_modes

  function is_constant(values, excluded, space)
    real(dp), intent(in) :: values(:)
    logical, intent(in) :: excluded(:)
    type(point_space), intent(in) :: space
    logical :: is_constant

    is_constant = space%least(minval(values, mask=.not. excluded)) >= space%largest(maxval(values, mask=.not. excluded))
  end function is_constant

  !> Replace a column of an orthonormal basis by the constant vector if that lies in its span; `column` is 0 if it does
  !> not.
  subroutine replace_by_constant(basis, excluded, space, column)
    real(dp), intent(inout) :: basis(:, :)
    logical, intent(in) :: excluded(:)
    type(point_space), intent(in) :: space
    integer, intent(out) :: column
    real(dp) :: change(size(basis, 2)), components(size(basis, 2)), remainder(1), rest
    integer :: k, pass

    ! What the first sums over many points round off is expressed too; the third pass finds what remains.
    components = 0.0_dp
    do pass = 1, 3
      change = 0.0_dp
      remainder = 0.0_dp
      do k = 1, size(basis, 1)
        rest = merge(0.0_dp, 1.0_dp, excluded(k)) - dot_product(basis(k, :), components)
        change = change + rest*basis(k, :)
        remainder = remainder + rest**2
      end do
      if (pass == 3) exit
      call space%add(change)
      components = components + change
    end do
    call space%add(remainder)
    column = 0
    if (remainder(1) > CONSTANT_TOLERANCE**2*space%total(real(count(.not. excluded), dp))) return
    column = maxloc(abs(components), dim=1)
    basis(:, column) = merge(0.0_dp, 1.0_dp, excluded)/sqrt(space%total(real(count(.not. excluded), dp)))
  end subroutine replace_by_constant

  !> Motions in the given modes, (m), from `motion` (m) in the orthogonal ones.
  function given_motion(self, motion) result(given)
    class(mode_change), intent(in) :: self
    real(dp), intent(in) :: motion(:)
    real(dp) :: given(size(motion))

    given = motion
    if (allocated(self%units)) given = solve_small(self%coefficients, motion)/self%units
  end function given_motion

  !> Resultants in the orthogonal modes, (m), from `resultant` (m) in the given ones. `rounding` (m) is what the last
  !> digits of the given resultants and of the coefficients make of them.
  subroutine orthogonal_load(self, resultant, load, rounding)
    class(mode_change), intent(in) :: self
    real(dp), intent(in) :: resultant(:)
    real(dp), intent(out) :: load(:)
    real(dp), intent(out), optional :: rounding(:)
    real(dp) :: rows(size(load), size(load)), terms(size(load)), unit(size(load))
    integer :: j

    load = resultant
    if (present(rounding)) rounding = epsilon(load)*abs(load)
    if (.not. allocated(self%units)) return
    rows = transpose(self%coefficients)
    load = solve_small(rows, resultant/self%units)
    if (.not. present(rounding)) return
    terms = epsilon(terms)*(abs(resultant/self%units) + matmul(abs(rows), abs(load)))
    rounding = 0.0_dp
    do j = 1, size(load)
      unit = 0.0_dp
      unit(j) = terms(j)
      rounding = rounding + abs(solve_small(rows, unit))
    end do
  end subroutine orthogonal_load

  !> How much each given mode contributes to `motion` (m) in the orthogonal ones, as a length, (m).
  function contributions(self, motion)
    class(mode_change), intent(in) :: self
    real(dp), intent(in) :: motion(:)
    real(dp) :: contributions(size(motion))

    contributions = abs(motion)
    if (allocated(self%units)) contributions = abs(solve_small(self%coefficients, motion)) &
      *norm2(self%coefficients, dim=1)
  end function contributions

  !> The solution of a regular system.
  function solve_small(matrix, right) result(solution)
    real(dp), intent(in) :: matrix(:, :), right(:)
    real(dp) :: solution(size(right))
    real(dp) :: copy(size(matrix, 1), size(matrix, 2))
    integer :: pivots(size(right)), info

    copy = matrix
    solution = right
    if (size(right) > 0) call dgesv(size(right), 1, copy, size(right), pivots, solution, size(right), info)
  end function solve_small

end module fuge_orthogonal_modes
