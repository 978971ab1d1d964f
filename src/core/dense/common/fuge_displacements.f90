!> Displacements of the points by rigid motions and by contact forces.
!>
!> Elastic displacements are those of alpha less `datum`, the coefficient nearest to zero: a constant in all of alpha
!> that changes the translation only and, taken out first, costs no digits. Columns of points without force are not
!> read; the others are read four at a time, because the displacements would otherwise be loaded and stored for each.
module fuge_displacements
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv, dsymv
  use fuge_marked_runs, only: next_run
  use fuge_threads, only: run_in_parts, share, threads_here, work_in_parts
  implicit none
  private

  public :: add_displacement_at, add_elastic_displacement, add_open_displacement, add_rough_product, &
    displacement_magnitude, displacement_magnitude_at, rigid_displacement

  !> Runs of points in contact, or open, that are shorter than this on average are not worth a loop each.
  integer, parameter :: SHORT_RUN = 16
  !> Runs of columns from this length on are left to BLAS, where rounding does not matter.
  integer, parameter :: LONG_RUN = 8
  !> Into so many sums a row times forces is split.
  integer, parameter :: SUMS_SIDE_BY_SIDE = 8
  !> Threads share displacements with more coefficients than this, in groups of ROWS points.
  real(dp), parameter :: SHARED = 2.0_dp**17
  integer, parameter :: ROWS = 16
  !> Displacements are added at all points, or at those that are not passed over: one by one, or where they lie side by
  !> side together.
  integer, parameter :: ALL_POINTS = 0, POINT_BY_POINT = 1, IN_RUNS = 2
  !> With force at more than this fraction of the points, half of the matrix is read instead of columns.
  real(dp), parameter :: MANY = 0.6_dp

  !> Displacements to be added, of which each part has some points.
  type, extends(work_in_parts) :: displacement_work
    real(dp), pointer, contiguous :: alpha(:, :) => null(), u(:) => null()
    real(dp), pointer, contiguous :: force(:) => null()
    logical, pointer :: contact(:) => null(), passed_over(:) => null()
    real(dp) :: datum = 0.0_dp
    integer :: way = ALL_POINTS
  contains
    procedure :: do_part => add_part
  end type displacement_work

contains

  !> R q at each point, (n).
  pure function rigid_displacement(modes, motion) result(displacement)
    real(dp), intent(in), contiguous :: modes(:, :)
    real(dp), intent(in) :: motion(:)
    real(dp) :: displacement(size(modes, 1))
    integer :: j

    displacement = 0.0_dp
    do j = 1, size(motion)
      displacement = displacement + modes(:, j)*motion(j)
    end do
  end function rigid_displacement

  !> u := u + (alpha - datum) f, with the columns of the contact only.
  !>
  !> Not by BLAS: taking the datum out of each coefficient keeps the digits of the product.
  subroutine add_elastic_displacement(alpha, datum, contact, force, u)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    real(dp), intent(in), target, contiguous :: force(:)
    real(dp), intent(in) :: datum
    logical, intent(in), target :: contact(:)
    real(dp), intent(inout), target, contiguous :: u(:)

    call add_in_parts(alpha, datum, contact, contact, force, ALL_POINTS, u)
  end subroutine add_elastic_displacement

  !> As `add_elastic_displacement`, but at the points that are not `passed_over` (n) only, where u stays as it is.
  subroutine add_displacement_at(alpha, datum, contact, passed_over, force, u)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    real(dp), intent(in), target, contiguous :: force(:)
    real(dp), intent(in) :: datum
    logical, intent(in), target :: contact(:), passed_over(:)
    real(dp), intent(inout), target, contiguous :: u(:)

    ! Of a symmetric matrix columns and rows are the same: the fewer of them.
    if (count(contact) < count(.not. passed_over)) then
      call add_to_some(alpha, datum, contact, passed_over, force, u)
    else
      call add_in_parts(alpha, datum, contact, passed_over, force, POINT_BY_POINT, u)
    end if
  end subroutine add_displacement_at

  !> By columns, to a copy of u where that stays as it is.
  subroutine add_to_some(alpha, datum, contact, passed_over, force, u)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    real(dp), intent(in), target, contiguous :: force(:)
    real(dp), intent(in) :: datum
    logical, intent(in), target :: contact(:), passed_over(:)
    real(dp), intent(inout), contiguous :: u(:)
    real(dp), target :: added(size(u))

    added = u
    call add_in_parts(alpha, datum, contact, contact, force, ALL_POINTS, added)
    where (.not. passed_over) u = added
  end subroutine add_to_some

  !> As `add_elastic_displacement`, but needed at open points only; what is added to u at points in contact is left
  !> undefined. Forces are zero at open points.
  !>
  !> Few open points are multiplied one by one, by their columns, which are their rows too; of more, the rows alone are
  !> read where they lie side by side.
  subroutine add_open_displacement(alpha, datum, contact, force, u)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    real(dp), intent(in), target, contiguous :: force(:)
    real(dp), intent(in) :: datum
    logical, intent(in), target :: contact(:)
    real(dp), intent(inout), target, contiguous :: u(:)
    integer :: n

    n = size(u)
    if (2*count(contact) > n) then
      call add_in_parts(alpha, datum, contact, contact, force, POINT_BY_POINT, u)
    else if (count(contact(2:) .neqv. contact(:n - 1))*SHORT_RUN > n) then
      call add_in_parts(alpha, datum, contact, contact, force, ALL_POINTS, u)
    else
      call add_in_parts(alpha, datum, contact, contact, force, IN_RUNS, u)
    end if
  end subroutine add_open_displacement

  !> Add displacements at the points that `way` tells; threads share the points if there are many.
  subroutine add_in_parts(alpha, datum, contact, passed_over, force, way, u)
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    real(dp), intent(in), target, contiguous :: force(:)
    real(dp), intent(in) :: datum
    logical, intent(in), target :: contact(:), passed_over(:)
    integer, intent(in) :: way
    real(dp), intent(inout), target, contiguous :: u(:)
    type(displacement_work) :: work
    integer :: parts

    work%alpha => alpha
    work%datum = datum
    work%contact => contact
    work%passed_over => passed_over
    work%force => force
    work%u => u
    work%way = way
    parts = 1
    if (real(size(u), dp)**2 > SHARED) then
      if (count_products(contact, passed_over, way) > SHARED) parts = threads_here()
    end if
    call run_in_parts(parts, work)
  end subroutine add_in_parts

  !> How many coefficients are read?
  pure function count_products(contact, passed_over, way) result(products)
    logical, intent(in) :: contact(:), passed_over(:)
    integer, intent(in) :: way
    real(dp) :: products

    products = real(count(contact), dp)*real(merge(size(contact), count(.not. passed_over), way == ALL_POINTS), dp)
  end function count_products

  !> The points of one part.
  subroutine add_part(self, part, parts)
    class(displacement_work), intent(inout) :: self
    integer, intent(in) :: part, parts
    integer :: first, last, n

    n = size(self%contact)
    call share((n + ROWS - 1)/ROWS, part, parts, first, last)
    first = ROWS*first + 1
    last = min(ROWS*(last + 1), n)
    if (first > last) return
    select case (self%way)
    case (POINT_BY_POINT)
      call add_at_points(self%alpha, self%datum, self%contact, self%passed_over, self%force, first, last, self%u)
    case (IN_RUNS)
      call add_in_open_runs(self%alpha, self%datum, self%contact, self%force, first, last, self%u)
    case default
      call add_in_rows(self%alpha, self%datum, self%contact, self%force, first, last, self%u)
    end select
  end subroutine add_part

  !> Add displacements at the points out of `first` to `last` that are not passed over, one by one.
  pure subroutine add_at_points(alpha, datum, contact, passed_over, force, first, last, u)
    real(dp), intent(in), contiguous :: alpha(:, :), force(:)
    real(dp), intent(in) :: datum
    logical, intent(in) :: contact(:), passed_over(:)
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: u(:)
    integer :: from, k, to

    from = findloc_contact(contact, 1, size(contact))
    to = findloc_contact(contact, size(contact), 1)
    do k = first, last
      if (passed_over(k)) cycle
      u(k) = u(k) + displacement_at(alpha(from:to, k), datum, force(from:to))
    end do
  end subroutine add_at_points

  !> Add displacements at the open points out of `first` to `last`, where they lie side by side in one sweep.
  pure subroutine add_in_open_runs(alpha, datum, contact, force, first, last, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: u(:)
    integer :: from, to

    to = first - 1
    do
      call next_run(.not. contact(:last), to + 1, from, to)
      if (from > last) exit
      call add_in_rows(alpha, datum, contact, force, from, to, u)
    end do
  end subroutine add_in_open_runs

  !> The first point in contact on the way from one point to another; the last one of them if there is none.
  pure function findloc_contact(contact, from, to) result(point)
    logical, intent(in) :: contact(:)
    integer, intent(in) :: from, to
    integer :: point

    do point = from, to, sign(1, to - from)
      if (contact(point)) return
    end do
    point = to
  end function findloc_contact

  !> (row - datum).force, in sums that the processor adds side by side.
  pure function displacement_at(row, datum, force) result(displacement)
    real(dp), intent(in), contiguous :: row(:), force(:)
    real(dp), intent(in) :: datum
    real(dp) :: displacement, sums(SUMS_SIDE_BY_SIDE)
    integer :: j, k

    sums = 0.0_dp
    do k = 0, size(force) - SUMS_SIDE_BY_SIDE, SUMS_SIDE_BY_SIDE
      do j = 1, SUMS_SIDE_BY_SIDE
        sums(j) = sums(j) + (row(k + j) - datum)*force(k + j)
      end do
    end do
    displacement = sum(sums)
    do k = size(force) - modulo(size(force), SUMS_SIDE_BY_SIDE) + 1, size(force)
      displacement = displacement + (row(k) - datum)*force(k)
    end do
  end function displacement_at

  !> The rows `first` to `last` of `add_elastic_displacement`.
  pure subroutine add_in_rows(alpha, datum, contact, force, first, last, u)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    integer, intent(in) :: first, last
    real(dp), intent(inout), contiguous :: u(:)
    integer :: columns(4), j, waiting

    waiting = 0
    do j = 1, size(contact)
      if (.not. contact(j)) cycle
      if (.not. abs(force(j)) > 0.0_dp) cycle
      waiting = waiting + 1
      columns(waiting) = j
      if (waiting < 4) cycle
      call add_four(alpha(first:last, columns(1)), alpha(first:last, columns(2)), alpha(first:last, columns(3)), &
                    alpha(first:last, columns(4)), datum, force(columns), u(first:last))
      waiting = 0
    end do
    do j = 1, waiting
      call add_one(alpha(first:last, columns(j)), datum, force(columns(j)), u(first:last))
    end do
  end subroutine add_in_rows

  pure subroutine add_four(a, b, c, d, datum, force, u)
    real(dp), intent(in), contiguous :: a(:), b(:), c(:), d(:)
    real(dp), intent(in) :: datum, force(4)
    real(dp), intent(inout), contiguous :: u(:)
    integer :: i

    do i = 1, size(u)
      u(i) = u(i) + (((a(i) - datum)*force(1) + (b(i) - datum)*force(2)) &
                     + ((c(i) - datum)*force(3) + (d(i) - datum)*force(4)))
    end do
  end subroutine add_four

  pure subroutine add_one(a, datum, force, u)
    real(dp), intent(in), contiguous :: a(:)
    real(dp), intent(in) :: datum, force
    real(dp), intent(inout), contiguous :: u(:)
    integer :: i

    do i = 1, size(u)
      u(i) = u(i) + (a(i) - datum)*force
    end do
  end subroutine add_one

  !> sum_j |alpha_kj - datum| |f_j|, (n): the size of the terms of a displacement, which may cancel.
  pure function displacement_magnitude(alpha, datum, contact, force) result(magnitude)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    real(dp) :: magnitude(size(contact))
    integer :: j

    magnitude = 0.0_dp
    do j = 1, size(contact)
      if (contact(j)) magnitude = magnitude + abs((alpha(:size(contact), j) - datum)*force(j))
    end do
  end function displacement_magnitude

  !> As `displacement_magnitude`, at point k only.
  pure function displacement_magnitude_at(alpha, datum, contact, force, k) result(magnitude)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, force(:)
    logical, intent(in) :: contact(:)
    integer, intent(in) :: k
    real(dp) :: magnitude
    integer :: j

    magnitude = 0.0_dp
    do j = 1, size(contact)
      if (contact(j)) magnitude = magnitude + abs((alpha(j, k) - datum)*force(j))
    end do
  end function displacement_magnitude_at

  !> u := u + factor alpha f, (n), for a guess: with the digits that BLAS leaves, and where many points have force
  !> from half of the matrix. Columns without force are not read otherwise.
  subroutine add_rough_product(alpha, factor, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :), force(:)
    real(dp), intent(in) :: factor
    real(dp), intent(inout), contiguous :: u(:)
    integer :: n

    n = size(u)
    if (real(count(abs(force) > 0.0_dp), dp) > MANY*real(n, dp)) then
      call dsymv('L', n, factor, alpha, size(alpha, 1), force, 1, 1.0_dp, u, 1)
    else if (any(abs(force) > 0.0_dp)) then
      call add_some_columns(alpha, factor, force, u)
    end if
  end subroutine add_rough_product

  !> u := u + factor alpha f, with the columns of the points only that have a force.
  subroutine add_some_columns(alpha, factor, force, u)
    real(dp), intent(in), contiguous :: alpha(:, :), force(:)
    real(dp), intent(in) :: factor
    real(dp), intent(inout), contiguous :: u(:)
    logical :: rest(size(force))
    integer :: first, last, n

    n = size(u)
    rest = abs(force) > 0.0_dp
    last = 0
    do
      call next_run(rest, last + 1, first, last)
      if (first > n) exit
      if (last - first + 1 < LONG_RUN) cycle
      call dgemv('N', n, last - first + 1, factor, alpha(:, first:last), size(alpha, 1), force(first:last), 1, &
                 1.0_dp, u, 1)
      rest(first:last) = .false.
    end do
    if (any(rest)) call add_in_parts(alpha, 0.0_dp, rest, rest, factor*force, ALL_POINTS, u)
  end subroutine add_some_columns

end module fuge_displacements
