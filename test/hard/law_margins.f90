!> Whether limited forces can carry resultants, and how far these are within what they carry, from the extreme motions.
module law_margins
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge_problem_type, only: fuge_problem
  use law_programs, only: limits_of, list_motions, modes_of_free, NONE
  implicit none
  private

  public :: carried_margin

  !> Products of a row of modes and a direction count as zero below this fraction of their terms.
  real(qp), parameter :: ORTHOGONAL = 1.0e-28_qp

contains

  !> How far the resultants are within what the limits carry, relative to its size: of all motions without springs the
  !> least work of the limits less that of the resultants, over both. Negative: no forces carry them; 0: only those at
  !> their limits. The motions that decide are orthogonal to all but one of the rows of modes or of the unit vectors.
  pure function carried_margin(problem) result(margin)
    type(fuge_problem), intent(in) :: problem
    real(qp) :: margin
    real(qp), allocatable :: direction(:, :), modes(:, :), stiffness(:)
    real(qp) :: motion(3)
    integer, allocatable :: free(:)
    integer :: i, j, m, n

    margin = 1.0_qp
    call list_motions(problem, free, stiffness)
    free = pack(free, .not. stiffness > 0.0_qp)
    m = size(free)
    if (m < 1) return
    n = problem%points()
    allocate (modes(n, m), direction(n + m, m))
    modes = real(modes_of_free(problem, free), qp)
    direction = 0.0_qp
    do j = 1, m
      if (maxval(abs(modes(:, j))) > 0.0_qp) modes(:, j) = modes(:, j)/unit_of(modes(:, j))
      direction(:n, j) = modes(:, j)
      direction(n + j, j) = 1.0_qp
    end do
    do i = 1, n + m
      do j = 1, n + m
        motion = 0.0_qp
        select case (m)
        case (1)
          motion(1) = 1.0_qp
        case (2)
          motion(:2) = [-direction(i, 2), direction(i, 1)]
        case default
          motion = cross(direction(i, :), direction(j, :))
        end select
        margin = min(margin, work_margin(problem, free, modes, motion(:m)), &
                     work_margin(problem, free, modes, -motion(:m)))
        if (m < 3) exit
      end do
    end do
  end function carried_margin

  !> The power of two at the largest of these values.
  pure function unit_of(values) result(unit)
    real(qp), intent(in) :: values(:)
    real(qp) :: unit

    unit = scale(1.0_qp, exponent(maxval(abs(values))))
  end function unit_of

  pure function cross(a, b) result(product)
    real(qp), intent(in) :: a(:), b(:)
    real(qp) :: product(3)

    product = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  !> Work of the forces at their limits less that of the resultants, over both; 1 where a force without a limit works,
  !> or nothing does. `modes` are in units of their own.
  pure function work_margin(problem, free, modes, motion) result(margin)
    type(fuge_problem), intent(in) :: problem
    integer, intent(in) :: free(:)
    real(qp), intent(in) :: modes(:, :), motion(:)
    real(qp) :: margin
    real(qp) :: column(problem%points(), size(free)), limits(2), closing, terms, work, of_resultants
    integer :: j, k

    margin = 1.0_qp
    if (.not. maxval(abs(motion)) > 0.0_qp) return
    work = 0.0_qp
    terms = 0.0_qp
    do k = 1, size(modes, 1)
      closing = sum(modes(k, :)*motion)
      if (abs(closing) <= ORTHOGONAL*sum(abs(modes(k, :)*motion))) cycle
      limits = limits_of(problem, k)
      limits(1) = merge(limits(1), limits(2), closing > 0.0_qp)
      if (limits(1) >= NONE) return
      work = work + limits(1)*abs(closing)
    end do
    column = real(modes_of_free(problem, free), qp)
    of_resultants = 0.0_qp
    do j = 1, size(free)
      if (.not. maxval(abs(column(:, j))) > 0.0_qp) column(1, j) = 1.0_qp
      associate (part => motion(j)*real(problem%resultant(free(j)), qp)/unit_of(column(:, j)))
        of_resultants = of_resultants + part
        terms = terms + abs(part)
      end associate
    end do
    terms = terms + work
    if (terms > 0.0_qp) margin = (work - of_resultants)/terms
  end function work_margin

end module law_margins
