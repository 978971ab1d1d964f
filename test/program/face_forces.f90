!> Forces of a pressure on single faces, known in closed form.
program face_forces
  use face_pressures, only: add_face_forces
  use fuge_kinds, only: dp
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> A square of side 2 and a triangle of area 1/2, in the plane z = 1, seen from above; then the middles of their
  !> sides.
  real(dp), parameter :: SQUARE(3, 8) = reshape(real([ &
    0, 0, 1, 2, 0, 1, 2, 2, 1, 0, 2, 1, 1, 0, 1, 2, 1, 1, 1, 2, 1, 0, 1, 1], dp), [3, 8])
  real(dp), parameter :: TRIANGLE(3, 6) = 0.5_dp*reshape(real([ &
    0, 0, 2, 2, 0, 2, 0, 2, 2, 1, 0, 2, 1, 1, 2, 0, 1, 2], dp), [3, 6])
  !> From (1, 0) to (3, 0): the body above is to the left.
  real(dp), parameter :: EDGE(2, 3) = reshape([1.0_dp, 0.0_dp, 3.0_dp, 0.0_dp, 2.0_dp, 0.0_dp], [2, 3])

  call expect('quadrangle', SQUARE(:, :4), .false., -[1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp])
  call expect('quadrangle of eight', SQUARE, .false., -4.0_dp/12.0_dp*[-1.0_dp, -1.0_dp, -1.0_dp, -1.0_dp, 4.0_dp, &
                                                                        4.0_dp, 4.0_dp, 4.0_dp])
  call expect('triangle', TRIANGLE(:, :3), .false., -[1.0_dp, 1.0_dp, 1.0_dp]/6.0_dp)
  call expect('triangle of six', TRIANGLE, .false., -[0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp, 1.0_dp]/6.0_dp)
  call expect('edge', EDGE(:, :2), .false., [1.0_dp, 1.0_dp])
  call expect('edge of three', EDGE, .false., [1.0_dp, 1.0_dp, 4.0_dp]/3.0_dp)
  call expect('ring', EDGE(:, :2), .true., 2.0_dp*PI*[2.0_dp*1.0_dp + 3.0_dp, 1.0_dp + 2.0_dp*3.0_dp]/3.0_dp)
  call expect('ring of three', EDGE, .true., 2.0_dp*PI*[1.0_dp, 3.0_dp, 8.0_dp]/3.0_dp)
  call expect_closed()

contains

  !> The forces have to be `expected` along the last axis, and zero along the others.
  subroutine expect(name, x, on_ring, expected)
    character(len=*), intent(in) :: name
    real(dp), intent(in) :: x(:, :), expected(:)
    logical, intent(in) :: on_ring
    real(dp) :: force(size(x, 1), size(x, 2))

    force = 0.0_dp
    call add_face_forces(x, on_ring, force)
    force(size(x, 1), :) = force(size(x, 1), :) - expected
    if (maxval(abs(force)) <= 1.0e-14_dp*maxval(abs(expected))) return
    print '(2a,es10.2)', name, ' is off by ', maxval(abs(force))
    error stop 'other forces'
  end subroutine expect

  !> A pressure around a cube whose sides are bent has no resultant.
  subroutine expect_closed()
    integer, parameter :: CORNERS(4, 6) = reshape([1, 4, 3, 2, 5, 6, 7, 8, 1, 2, 6, 5, 2, 3, 7, 6, 3, 4, 8, 7, &
                                                   4, 1, 5, 8], [4, 6])
    real(dp) :: corner(3, 8), force(3, 8), total(3), x(3, 8)
    integer :: f, j, k

    corner = reshape(real([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], dp), [3, 8])
    total = 0.0_dp
    do f = 1, 6
      x(:, :4) = corner(:, CORNERS(:, f))
      do k = 1, 4
        j = modulo(k, 4) + 1
        x(:, 4 + k) = 0.5_dp*(x(:, k) + x(:, j)) + 0.1_dp*[x(3, k) + x(3, j), x(1, k)*x(1, j), x(2, k) + x(2, j)]
      end do
      force = 0.0_dp
      call add_face_forces(x, .false., force)
      total = total + sum(force, 2)
    end do
    print '(a,3es10.2)', 'resultant of a closed surface', total
    if (maxval(abs(total)) > 1.0e-14_dp) error stop 'a resultant'
  end subroutine expect_closed

end program face_forces
