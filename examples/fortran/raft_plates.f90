!> A rectangular raft of thin plates: its stiffness matrix, as a finite element program would supply it.
!>
!> Rectangular elements with twelve degrees of freedom after Adini, Clough and Melosh (O. C. Zienkiewicz, The Finite
!> Element Method, 1977, 10.4): a deflection and two slopes at each node.
module raft_plates
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: node_number, plate_stiffness, raft_stiffness

contains

  !> Stiffness of a raft of `plates` elements along each side, as compressed columns of both triangles: column j holds
  !> `row(p)` and `value(p)` for `column(j)` <= p < `column(j + 1)`, an entry for each element that adds to it.
  !>
  !> `width` of an element, length; `rigidity` E t**3/(12 (1 - poisson**2)), force times length. Node k has the
  !> deflection 3 k - 2 and the slopes along x and y, 3 k - 1 and 3 k.
  pure subroutine raft_stiffness(plates, width, rigidity, poisson, column, row, value)
    integer, intent(in) :: plates
    real(dp), intent(in) :: width, rigidity, poisson
    integer, allocatable, intent(out) :: column(:), row(:)
    real(dp), allocatable, intent(out) :: value(:)
    integer, allocatable :: next(:)
    real(dp) :: element(12, 12)
    integer :: degrees, dof(12), i, j, k

    degrees = 3*(plates + 1)**2
    element = plate_stiffness(width, width, rigidity, poisson)
    allocate (column(degrees + 1), source=0)
    do j = 1, plates
      do i = 1, plates
        dof = plate_dof(i, j, plates)
        column(dof + 1) = column(dof + 1) + 12
      end do
    end do
    column(1) = 1
    do k = 1, degrees
      column(k + 1) = column(k) + column(k + 1)
    end do
    allocate (row(column(degrees + 1) - 1), value(column(degrees + 1) - 1))
    next = column(:degrees)
    do j = 1, plates
      do i = 1, plates
        dof = plate_dof(i, j, plates)
        do k = 1, 12
          row(next(dof(k)):next(dof(k)) + 11) = dof
          value(next(dof(k)):next(dof(k)) + 11) = element(:, k)
          next(dof(k)) = next(dof(k)) + 12
        end do
      end do
    end do
  end subroutine raft_stiffness

  !> Number of the node in column i and line j of nodes, from 1.
  elemental function node_number(i, j, plates) result(number)
    integer, intent(in) :: i, j, plates
    integer :: number

    number = i + (j - 1)*(plates + 1)
  end function node_number

  !> Degrees of freedom of the plate in column i and line j of plates.
  pure function plate_dof(i, j, plates) result(dof)
    integer, intent(in) :: i, j, plates
    integer :: dof(12)
    integer :: node(4)

    node = node_number([i, i + 1, i, i + 1], [j, j, j + 1, j + 1], plates)
    dof(1::3) = 3*node - 2
    dof(2::3) = 3*node - 1
    dof(3::3) = 3*node
  end function plate_dof

  !> A plate of a by b: deflection and slopes (w, dw/dx, dw/dy) of the corners (0, 0), (a, 0), (0, b), (a, b).
  pure function plate_stiffness(a, b, rigidity, poisson) result(stiffness)
    real(dp), intent(in) :: a, b, rigidity, poisson
    real(dp) :: stiffness(12, 12)
    !> Gauss's rule with three points on -1 .. 1.
    real(dp), parameter :: PLACE(3) = [-sqrt(0.6_dp), 0.0_dp, sqrt(0.6_dp)]
    real(dp), parameter :: WEIGHT(3) = [5.0_dp, 8.0_dp, 5.0_dp]/9.0_dp
    real(dp) :: curvature(3, 12), law(3, 3)
    integer :: j, k

    law = rigidity*reshape([1.0_dp, poisson, 0.0_dp, poisson, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                            0.5_dp*(1.0_dp - poisson)], [3, 3])
    stiffness = 0.0_dp
    do j = 1, 3
      do k = 1, 3
        curvature = curvatures(PLACE(j), PLACE(k), 0.5_dp*a, 0.5_dp*b)
        stiffness = stiffness + 0.25_dp*a*b*WEIGHT(j)*WEIGHT(k)*matmul(transpose(curvature), matmul(law, curvature))
      end do
    end do
  end function plate_stiffness

  !> w_xx, w_yy and 2 w_xy, (3, 12), of the shape functions at the point x, y of -1 .. 1; `a`, `b` half the sides.
  pure function curvatures(x, y, a, b) result(curvature)
    real(dp), intent(in) :: x, y, a, b
    real(dp) :: curvature(3, 12)
    !> Corners.
    real(dp), parameter :: RIGHT(4) = [-1.0_dp, 1.0_dp, -1.0_dp, 1.0_dp], UPPER(4) = [-1.0_dp, -1.0_dp, 1.0_dp, 1.0_dp]
    real(dp) :: s, t
    integer :: k

    do k = 1, 4
      s = RIGHT(k)*x
      t = UPPER(k)*y
      curvature(:, 3*k - 2) = [-0.75_dp*s*(1.0_dp + t)/a**2, -0.75_dp*t*(1.0_dp + s)/b**2, &
                               0.25_dp*RIGHT(k)*UPPER(k)*(4.0_dp - 3.0_dp*(x**2 + y**2))/(a*b)]
      curvature(:, 3*k - 1) = [0.25_dp*RIGHT(k)*(1.0_dp + 3.0_dp*s)*(1.0_dp + t)/a, 0.0_dp, &
                               0.25_dp*UPPER(k)*(1.0_dp + s)*(3.0_dp*s - 1.0_dp)/b]
      curvature(:, 3*k) = [0.0_dp, 0.25_dp*UPPER(k)*(1.0_dp + 3.0_dp*t)*(1.0_dp + s)/b, &
                           0.25_dp*RIGHT(k)*(1.0_dp + t)*(3.0_dp*t - 1.0_dp)/a]
    end do
  end function curvatures

end module raft_plates
