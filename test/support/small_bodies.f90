!> Stiffness matrices of small bodies, and a check of a solved contact by the whole body.
module small_bodies
  use fuge_body_type, only: fuge_body
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_solution
  implicit none
  private

  public :: chain, plane_block, beam, to_band, to_columns, contact_violation

contains

  !> Masses 1 .. n in a row, a spring of stiffness k between neighbours; if anchored, one
  !> more from mass 1 to the ground.
  pure function chain(n, k, anchored) result(stiffness)
    integer, intent(in) :: n
    real(dp), intent(in) :: k
    logical, intent(in) :: anchored
    real(dp) :: stiffness(n, n)
    integer :: i

    stiffness = 0.0_dp
    if (anchored) stiffness(1, 1) = k
    do i = 1, n - 1
      stiffness(i, i) = stiffness(i, i) + k
      stiffness(i + 1, i + 1) = stiffness(i + 1, i + 1) + k
      stiffness(i, i + 1) = -k
      stiffness(i + 1, i) = -k
    end do
  end function chain

  !> A beam of n elements of length h and bending stiffness e_i: deflection 2 i - 1 and
  !> rotation 2 i of node i = 1 .. n + 1, free.
  pure function beam(n, h, e_i) result(stiffness)
    integer, intent(in) :: n
    real(dp), intent(in) :: h, e_i
    real(dp) :: stiffness(2*n + 2, 2*n + 2), element(4, 4)
    integer :: e

    element = e_i/h**3*reshape([ &
      12.0_dp, 6*h, -12.0_dp, 6*h, 6*h, 4*h**2, -6*h, 2*h**2, &
      -12.0_dp, -6*h, 12.0_dp, -6*h, 6*h, 2*h**2, -6*h, 4*h**2], [4, 4])
    stiffness = 0.0_dp
    do e = 1, n
      associate (part => stiffness(2*e - 1:2*e + 2, 2*e - 1:2*e + 2))
        stiffness(2*e - 1:2*e + 2, 2*e - 1:2*e + 2) = part + element
      end associate
    end do
  end function beam

  !> nx by ny square elements in plane strain (E = 1, nu = 0.3), free: node (i, j), i = 0 ..
  !> nx, j = 0 .. ny, moves by degrees of freedom 2 (i + j (nx + 1)) + 1 and + 2.
  pure function plane_block(nx, ny) result(stiffness)
    integer, intent(in) :: nx, ny
    real(dp) :: stiffness(2*(nx + 1)*(ny + 1), 2*(nx + 1)*(ny + 1)), element(8, 8)
    integer :: dof(8), i, j, k

    element = square_element()
    stiffness = 0.0_dp
    do j = 0, ny - 1
      do i = 0, nx - 1
        associate (corner => i + j*(nx + 1))
          dof = [(2*corner + k, k=1, 4), (2*(corner + nx + 1) + k, k=1, 4)]
        end associate
        stiffness(dof, dof) = stiffness(dof, dof) + element
      end do
    end do
  end function plane_block

  !> Bilinear element of unit side, 2 by 2 points; nodes (0,0), (1,0), (0,1), (1,1).
  pure function square_element() result(element)
    real(dp) :: element(8, 8), strain(3, 8), law(3, 3), x, y, dx(4), dy(4)
    real(dp), parameter :: nu = 0.3_dp
    integer :: i, j, k

    law = 0.0_dp
    law(1, :2) = [1 - nu, nu]
    law(2, :2) = [nu, 1 - nu]
    law(3, 3) = 0.5_dp - nu
    law = law/((1 + nu)*(1 - 2*nu))
    element = 0.0_dp
    do j = -1, 1, 2
      do i = -1, 1, 2
        x = 0.5_dp + i/sqrt(12.0_dp)
        y = 0.5_dp + j/sqrt(12.0_dp)
        dx = [-(1 - y), 1 - y, -y, y]
        dy = [-(1 - x), -x, 1 - x, x]
        strain = 0.0_dp
        do k = 1, 4
          strain(1, 2*k - 1) = dx(k)
          strain(2, 2*k) = dy(k)
          strain(3, 2*k - 1:2*k) = [dy(k), dx(k)]
        end do
        element = element + 0.25_dp*matmul(transpose(strain), matmul(law, strain))
      end do
    end do
  end function square_element

  !> LAPACK's band storage of one triangle.
  pure function to_band(stiffness, width, upper) result(band)
    real(dp), intent(in) :: stiffness(:, :)
    integer, intent(in) :: width
    logical, intent(in) :: upper
    real(dp) :: band(width + 1, size(stiffness, 2))
    integer :: i, j

    band = 0.0_dp
    do j = 1, size(stiffness, 2)
      if (upper) then
        do i = max(1, j - width), j
          band(width + 1 + i - j, j) = stiffness(i, j)
        end do
      else
        do i = j, min(size(stiffness, 1), j + width)
          band(1 + i - j, j) = stiffness(i, j)
        end do
      end if
    end do
  end function to_band

  !> Compressed columns of a triangle ('U', 'L') or of all ('A'); rows descend and each entry is split
  !> in two, because the format allows any order and repeated entries.
  pure subroutine to_columns(stiffness, part, column, row, value)
    real(dp), intent(in) :: stiffness(:, :)
    character(len=1), intent(in) :: part
    integer, allocatable, intent(out) :: column(:), row(:)
    real(dp), allocatable, intent(out) :: value(:)
    integer :: i, j, n

    n = size(stiffness, 2)
    allocate (column(n + 1), row(0), value(0))
    column(1) = 1
    do j = 1, n
      do i = n, 1, -1
        if (part == 'U' .and. i > j .or. part == 'L' .and. i < j) cycle
        if (.not. abs(stiffness(i, j)) > 0.0_dp) cycle
        row = [row, i, i]
        value = [value, 0.25_dp*stiffness(i, j), 0.75_dp*stiffness(i, j)]
      end do
      column(j + 1) = size(row) + 1
    end do
  end subroutine to_columns

  !> Largest violation of the contact of the whole body with rigid ground at distance `gap`
  !> in the direction of the normals: K u = loads at what is not fixed, gaps and forces not
  !> negative, no force where there is a gap; each relative to its magnitude.
  pure function contact_violation(stiffness, body, gap, solution, u) result(violation)
    real(dp), intent(in) :: stiffness(:, :), gap(:), u(:)
    type(fuge_body), intent(in) :: body
    type(fuge_solution), intent(in) :: solution
    real(dp) :: violation, left(size(u)), opening(size(gap)), force_scale, length_scale
    integer :: i, k

    left = matmul(stiffness, u)
    force_scale = 0.0_dp
    do i = 1, size(u)
      force_scale = max(force_scale, sum(abs(stiffness(:, i)*u)))
    end do
    length_scale = max(maxval(abs(gap)), maxval(abs(u)))
    if (allocated(body%load)) left = left - body%load
    do i = 1, size(gap)
      opening(i) = gap(i)
      do k = 1, size(body%dof, 1)
        if (body%dof(k, i) < 1) cycle
        left(body%dof(k, i)) = left(body%dof(k, i)) - body%normal(k, i)*solution%force(i)
        opening(i) = opening(i) + body%normal(k, i)*u(body%dof(k, i))
      end do
    end do
    if (allocated(body%fixed)) left(body%fixed) = 0.0_dp
    violation = max(maxval(abs(left))/force_scale, -minval(opening)/length_scale, -minval(solution%force)/force_scale, &
                    maxval(solution%force/force_scale*abs(opening)/length_scale), &
                    maxval(abs(opening - solution%gap))/length_scale)
  end function contact_violation

end module small_bodies
