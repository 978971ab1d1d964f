!> The influence matrix alpha = H^T G H of the contact points of a body, G the inverse of the stiffness matrix K without
!> the constrained degrees of freedom.
!>
!> If the factor of K ends with the degrees of freedom that H touches, the last rows of H, C, and the factor L of their
!> Schur complement are all that alpha needs: with X = L^-1 C, alpha = X^T X. Otherwise each point costs a solve.
module fuge_condensed_influence
  use fuge_body_type, only: fuge_body
  use fuge_contact_normals, only: add_point_force, point_displacement
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_lapack, only: dsyrk, dtrsm
  use fuge_number_text, only: index_text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_DONE, FUGE_ERR_OVERFLOW
  use fuge_stiffness_type, only: stiffness_factor
  implicit none
  private

  public :: find_influence, touched_degrees

  !> Number of right-hand sides that are solved together.
  integer, parameter :: BLOCK = 64

contains

  !> The degrees of freedom, not `constrained` (degrees), at which contact forces act, ascending.
  pure function touched_degrees(body, constrained) result(touched)
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: constrained(:)
    integer, allocatable :: touched(:)
    logical, allocatable :: marked(:)
    integer :: i, j, k

    allocate (marked(size(constrained)))
    marked = .false.
    do i = 1, size(body%dof, 2)
      do k = 1, size(body%dof, 1)
        if (body%dof(k, i) > 0) marked(body%dof(k, i)) = .not. constrained(body%dof(k, i))
      end do
    end do
    allocate (touched(count(marked)))
    j = 0
    do i = 1, size(marked)
      if (.not. marked(i)) cycle
      j = j + 1
      touched(j) = i
    end do
  end function touched_degrees

  !> alpha (n, n) from the factor of K without the `constrained` (degrees). Errors: FUGE_ERR_OVERFLOW, which names the
  !> point, and FUGE_ERR_MEMORY.
  subroutine find_influence(body, constrained, factor, alpha, info)
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: constrained(:)
    class(stiffness_factor), intent(in) :: factor
    real(dp), allocatable, intent(out) :: alpha(:, :)
    type(fuge_info), intent(inout) :: info
    integer :: j, n, stat

    n = size(body%dof, 2)
    allocate (alpha(n, n), stat=stat)
    if (stat == 0 .and. allocated(factor%last)) then
      call multiply_by_schur_factor(body, constrained, factor, alpha, stat)
    else if (stat == 0) then
      call solve_for_points(body, constrained, factor, alpha, stat)
    end if
    call require_memory(stat, 'the influence matrix of', n, 'contact points', info)
    if (stat /= 0) return
    do j = 1, n
      if (is_finite_everywhere(alpha(:, j)) .and. alpha(j, j) < huge(1.0_dp)) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'the influence of contact point '//index_text(j) &
                  //' overflows: choose other units, or normals of length one')
      return
    end do
  end subroutine find_influence

  !> alpha (n, n) by solves, a block of columns at a time. `status` is not FUGE_DONE without memory.
  subroutine solve_for_points(body, constrained, factor, alpha, status)
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: constrained(:)
    class(stiffness_factor), intent(in) :: factor
    real(dp), intent(inout) :: alpha(:, :)
    integer, intent(out) :: status
    real(dp), allocatable :: columns(:, :)
    integer :: first, i, j, last, n

    n = size(alpha, 2)
    allocate (columns(size(constrained), min(BLOCK, n)), stat=status)
    if (status /= 0) return
    do first = 1, n, BLOCK
      last = min(first + BLOCK - 1, n)
      columns = 0.0_dp
      do j = first, last
        call add_point_force(body%dof(:, j), body%normal(:, j), 1.0_dp, columns(:, j - first + 1))
        where (constrained) columns(:, j - first + 1) = 0.0_dp
      end do
      call factor%solve(columns(:, :last - first + 1), status)
      if (status /= FUGE_DONE) return
      do j = first, last
        do i = 1, n
          alpha(i, j) = point_displacement(body%dof(:, i), body%normal(:, i), columns(:, j - first + 1))
        end do
      end do
    end do
    do j = 2, n
      do i = 1, j - 1
        alpha(i, j) = 0.5_dp*(alpha(i, j) + alpha(j, i))
        alpha(j, i) = alpha(i, j)
      end do
    end do
  end subroutine solve_for_points

  !> alpha (n, n) = X^T X. `status` is not FUGE_DONE without memory.
  subroutine multiply_by_schur_factor(body, constrained, factor, alpha, status)
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: constrained(:)
    class(stiffness_factor), intent(in) :: factor
    real(dp), intent(inout) :: alpha(:, :)
    integer, intent(out) :: status
    real(dp), allocatable :: product(:, :), root(:, :), x(:, :)
    integer, allocatable :: first(:), points(:)
    integer :: i, j, n

    n = size(alpha, 2)
    call factor%copy_schur_factor(root, status)
    if (status == FUGE_DONE) call gather_normals(body, constrained, factor%last, x, points, first, status)
    if (status == FUGE_DONE) allocate (product(n, n), stat=status)
    if (status /= FUGE_DONE) return
    call solve_staircase(size(x, 1), n, root, first, x)
    call square_staircase(size(x, 1), n, x, first, product)
    do j = 1, n
      do i = 1, j
        alpha(points(i), points(j)) = product(i, j)
        alpha(points(j), points(i)) = product(i, j)
      end do
    end do
  end subroutine multiply_by_schur_factor

  !> C, `x` (size(last), n), zero where constrained, its columns ordered by their first rows, a staircase: column j
  !> belongs to contact point points(j) and begins at row first(j), beyond the last one if the point cannot move. `stat`
  !> is not zero without memory.
  pure subroutine gather_normals(body, constrained, last, x, points, first, stat)
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: constrained(:)
    integer, intent(in) :: last(:)
    real(dp), allocatable, intent(out) :: x(:, :)
    integer, allocatable, intent(out) :: points(:), first(:)
    integer, intent(out) :: stat
    integer, allocatable :: row(:), begin(:), begun(:)
    integer :: i, j, k, n

    n = size(body%dof, 2)
    allocate (x(size(last), n), points(n), first(n), begin(n), begun(0:size(last) + 1), &
              row(0:maxval([last, body%dof])), stat=stat)
    if (stat /= 0) return
    row = 0
    ! Pins may be among the last degrees of freedom.
    row(last) = merge(0, [(k, k=1, size(last))], constrained(last))
    begun = 0
    do i = 1, n
      begin(i) = min(minval(row(body%dof(:, i)), row(body%dof(:, i)) > 0), size(last) + 1)
      begun(begin(i)) = begun(begin(i)) + 1
    end do
    ! Number of columns that begin above a row, then that of the columns placed so far.
    do k = 1, size(last) + 1
      begun(k) = begun(k) + begun(k - 1)
    end do
    x = 0.0_dp
    do i = n, 1, -1
      j = begun(begin(i))
      begun(begin(i)) = j - 1
      points(j) = i
      first(j) = begin(i)
      do k = 1, size(body%dof, 1)
        associate (r => row(body%dof(k, i)))
          if (r > 0) x(r, j) = x(r, j) + body%normal(k, i)
        end associate
      end do
    end do
  end subroutine gather_normals

  !> Replace the staircase C in `x` by L^-1 C, which has the same steps; L is the lower triangle `root`.
  subroutine solve_staircase(p, n, root, first, x)
    integer, intent(in) :: p, n, first(n)
    real(dp), intent(in) :: root(p, p)
    real(dp), intent(inout) :: x(p, n)
    integer :: i, j

    do j = 1, n, BLOCK
      i = first(j)
      if (i > p) return
      call dtrsm('L', 'L', 'N', 'N', p - i + 1, min(BLOCK, n - j + 1), 1.0_dp, root(i, i), p, x(i, j), p)
    end do
  end subroutine solve_staircase

  !> The upper triangle of X^T X, `product` (n, n); the other one is zero.
  subroutine square_staircase(p, n, x, first, product)
    integer, intent(in) :: p, n, first(n)
    real(dp), intent(in) :: x(p, n)
    real(dp), intent(out) :: product(n, n)
    integer :: columns, i, rows

    product = 0.0_dp
    columns = 0
    do i = 1, p, BLOCK
      rows = min(BLOCK, p - i + 1)
      do while (columns < n)
        if (first(columns + 1) >= i + rows) exit
        columns = columns + 1
      end do
      call dsyrk('U', 'T', columns, rows, 1.0_dp, x(i, 1), p, 1.0_dp, product, n)
    end do
  end subroutine square_staircase

end module fuge_condensed_influence
