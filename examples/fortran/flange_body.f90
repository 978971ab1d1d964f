!> What a finite element program knows beyond the stiffness, for the example `flange`: supports at an angle and the
!> forces of a pressure.
module flange_body
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: add_pressure, turn_stiffness, turn_vectors

contains

  !> Turn the degrees of freedom x and y of some nodes in space by an angle about z: what was u_x is then the
  !> displacement along (cos, sin), what was u_y that along (-sin, cos). Compressed columns, entries may be repeated.
  subroutine turn_stiffness(turned, angle, column, row, value)
    logical, intent(in) :: turned(:)
    real(dp), intent(in) :: angle
    integer, allocatable, intent(inout) :: column(:), row(:)
    real(dp), allocatable, intent(inout) :: value(:)
    integer, allocatable :: new_column(:), new_row(:), next(:)
    real(dp), allocatable :: new_value(:)
    integer :: i, j, p, to_column(2), to_row(2)
    real(dp) :: by_column(2), by_row(2)
    integer :: a, b, columns, rows

    allocate (new_column(size(column)))
    new_column = 0
    new_column(1) = 1
    do j = 1, size(column) - 1
      call turned_degrees(j, turned, angle, columns, to_column, by_column)
      do p = column(j), column(j + 1) - 1
        call turned_degrees(row(p), turned, angle, rows, to_row, by_row)
        new_column(to_column(:columns) + 1) = new_column(to_column(:columns) + 1) + rows
      end do
    end do
    do j = 2, size(new_column)
      new_column(j) = new_column(j) + new_column(j - 1)
    end do
    allocate (new_row(new_column(size(new_column)) - 1), new_value(new_column(size(new_column)) - 1))
    next = new_column(:size(new_column) - 1)
    do j = 1, size(column) - 1
      call turned_degrees(j, turned, angle, columns, to_column, by_column)
      do p = column(j), column(j + 1) - 1
        call turned_degrees(row(p), turned, angle, rows, to_row, by_row)
        do b = 1, columns
          do a = 1, rows
            i = next(to_column(b))
            new_row(i) = to_row(a)
            new_value(i) = by_row(a)*by_column(b)*value(p)
            next(to_column(b)) = i + 1
          end do
        end do
      end do
    end do
    call move_alloc(new_column, column)
    call move_alloc(new_row, row)
    call move_alloc(new_value, value)
  end subroutine turn_stiffness

  !> The degrees of freedom, after the turn, that one from before has a share in, and their factors.
  pure subroutine turned_degrees(dof, turned, angle, count, to, factor)
    integer, intent(in) :: dof
    logical, intent(in) :: turned(:)
    real(dp), intent(in) :: angle
    integer, intent(out) :: count, to(2)
    real(dp), intent(out) :: factor(2)
    integer :: axis

    axis = modulo(dof - 1, 3)
    count = 1
    to = dof
    factor = 1.0_dp
    if (axis == 2) return
    if (.not. turned((dof - 1)/3 + 1)) return
    count = 2
    to = [dof - axis, dof - axis + 1]
    factor = merge([cos(angle), -sin(angle)], [sin(angle), cos(angle)], axis == 0)
  end subroutine turned_degrees

  !> The components of forces at nodes as the turned degrees of freedom have them, (3, nodes). With the angle reversed:
  !> displacements back along x and y.
  pure subroutine turn_vectors(turned, angle, vector)
    logical, intent(in) :: turned(:)
    real(dp), intent(in) :: angle
    real(dp), intent(inout) :: vector(:, :)
    integer :: i

    do i = 1, size(turned)
      if (turned(i)) vector(:2, i) = [cos(angle)*vector(1, i) + sin(angle)*vector(2, i), &
                                      cos(angle)*vector(2, i) - sin(angle)*vector(1, i)]
    end do
  end subroutine turn_vectors

  !> Add the forces of a uniform pressure on faces of 4 or 8 nodes, counter-clockwise if seen from outside, to `force`
  !> (3, nodes).
  pure subroutine add_pressure(node, face, pressure, force)
    real(dp), intent(in) :: node(:, :), pressure
    integer, intent(in) :: face(:, :)
    real(dp), intent(inout) :: force(:, :)
    real(dp), parameter :: POINT(3) = [-sqrt(0.6_dp), 0.0_dp, sqrt(0.6_dp)]
    real(dp), parameter :: WEIGHT(3) = [5.0_dp, 8.0_dp, 5.0_dp]/9.0_dp
    real(dp) :: area(3), shape_of(8), slope(2, 8), tangent(3, 2)
    integer :: f, i, j, k, nodes

    nodes = size(face, 1)
    do f = 1, size(face, 2)
      do j = 1, 3
        do i = 1, 3
          call face_shapes(nodes, [POINT(i), POINT(j)], shape_of, slope)
          tangent = matmul(node(:, face(:, f)), transpose(slope(:, :nodes)))
          area = [tangent(2, 1)*tangent(3, 2) - tangent(3, 1)*tangent(2, 2), &
                  tangent(3, 1)*tangent(1, 2) - tangent(1, 1)*tangent(3, 2), &
                  tangent(1, 1)*tangent(2, 2) - tangent(2, 1)*tangent(1, 2)]
          do k = 1, nodes
            force(:, face(k, f)) = force(:, face(k, f)) - WEIGHT(i)*WEIGHT(j)*pressure*shape_of(k)*area
          end do
        end do
      end do
    end do
  end subroutine add_pressure

  !> Shape functions of a quadrangle of 4 or 8 nodes and their derivatives.
  pure subroutine face_shapes(nodes, at, value, slope)
    integer, intent(in) :: nodes
    real(dp), intent(in) :: at(2)
    real(dp), intent(out) :: value(8), slope(2, 8)
    real(dp), parameter :: X(2, 8) = reshape(real([-1, -1, 1, -1, 1, 1, -1, 1, 0, -1, 1, 0, 0, 1, -1, 0], dp), [2, 8])
    real(dp) :: factor(2), rise(2)
    integer :: a, k

    do k = 1, nodes
      do a = 1, 2
        if (abs(X(a, k)) > 0.0_dp) then
          factor(a) = 0.5_dp*(1.0_dp + X(a, k)*at(a))
          rise(a) = 0.5_dp*X(a, k)
        else
          factor(a) = 1.0_dp - at(a)**2
          rise(a) = -2.0_dp*at(a)
        end if
      end do
      value(k) = product(factor)
      slope(:, k) = [rise(1)*factor(2), factor(1)*rise(2)]
      if (nodes == 4 .or. k > 4) cycle
      slope(:, k) = slope(:, k)*(dot_product(X(:, k), at) - 1.0_dp) + value(k)*X(:, k)
      value(k) = value(k)*(dot_product(X(:, k), at) - 1.0_dp)
    end do
  end subroutine face_shapes

end module flange_body
