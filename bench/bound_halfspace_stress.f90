!> Time of the stresses at points of a half-space under many cells, against that of a plain sum: of one point force for
!> each cell, the fewest operations that any sum over cells can have, and of the cells themselves, to rounding.
!>
!> Prints rows | problem | forces | cells | fuge | ratio | error | to standard output: times in seconds for all points,
!> the ratio to the forces, and the error of fuge relative to the largest stress of the point. Plain sums are
!> measured at some of the points. All sides alternate and the least time of each counts, because other programs may
!> run.
program bound_halfspace_stress
  use fuge, only: dp => fuge_dp, fuge_halfspace_field, fuge_info
  use fuge_point_forces, only: add_force_stresses
  use fuge_rectangle_field, only: new_rectangle_rules, rectangle_rules, rectangle_stress
  implicit none

  integer, parameter :: REPETITIONS = 3, SOME = 500, FEW = 20
  real(dp), parameter :: POISSON = 0.3_dp
  real(dp), allocatable :: x(:), y(:), width(:), force(:), px(:), py(:), pz(:)

  call make_cells(100)
  call make_points(10000)
  pz = pz*50.0_dp
  call measure('in the body')
  py = 50.0_dp
  call measure('a section')
  call make_points(10000)
  pz = 1.0_dp
  call measure('one cell deep')
  pz = 0.0_dp
  call measure('on the surface')
  call make_cells(300)
  call make_points(10000)
  pz = pz*150.0_dp
  call measure('in the body')

contains

  !> n x n unit cells with a rough ball's forces.
  subroutine make_cells(n)
    integer, intent(in) :: n
    integer :: i, j
    real(dp) :: middle

    middle = 0.5_dp*real(n + 1, dp)
    x = [((real(i, dp) - 0.5_dp, i=1, n), j=1, n)]
    y = [((real(j, dp) - 0.5_dp, i=1, n), j=1, n)]
    width = [(1.0_dp, i=1, n**2)]
    force = [(((1.0_dp + sin(real(i**2 + j, dp))) &
               *exp(-2.0_dp*((real(i, dp) - middle)**2 + (real(j, dp) - middle)**2)/middle**2), i=1, n), j=1, n)]
  end subroutine make_cells

  !> Points below all cells, depths between 0 and 1.
  subroutine make_points(number)
    integer, intent(in) :: number
    integer :: k

    px = [(sqrt(real(size(x), dp))*modulo(0.6180339887_dp*real(k, dp), 1.0_dp), k=1, number)]
    py = [(sqrt(real(size(x), dp))*modulo(0.4142135624_dp*real(k, dp), 1.0_dp), k=1, number)]
    pz = [(modulo(0.7320508076_dp*real(k, dp), 1.0_dp), k=1, number)]
  end subroutine make_points

  subroutine measure(name)
    character(len=*), intent(in) :: name
    real(dp) :: stress(6, size(pz)), sums(SOME, 6), plain(6, FEW), start, forces, cells, time, error
    type(fuge_halfspace_field) :: field
    type(fuge_info) :: info
    integer :: k, point

    call field%set_rectangles(x, y, width, width, force, 1.0_dp, POISSON, info)
    if (info%failed()) error stop 1
    forces = huge(forces)
    cells = huge(cells)
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      sums = 0.0_dp
      call add_force_stresses(x + 0.01_dp, y, force, POISSON, px(:SOME), py(:SOME), pz(:SOME), sums)
      forces = min(forces, (seconds() - start)*real(size(pz)/SOME, dp))
      start = seconds()
      call field%stress(transpose(reshape([px, py, pz], [size(px), 3])), stress, info)
      time = min(time, seconds() - start)
      if (info%failed()) error stop 1
      start = seconds()
      call sum_cells(plain)
      cells = min(cells, (seconds() - start)*real(size(pz)/FEW, dp))
    end do
    error = 0.0_dp
    do k = 1, FEW
      point = (size(pz)/FEW)*k
      error = max(error, maxval(abs(stress(:, point) - plain(:, k)))/maxval(abs(plain(:, k))))
    end do
    print '(3a, i0, a, i0, a, 3(f10.3, a), f8.2, a, es9.1, a)', '| ', name, ', ', size(pz), ' points under ', size(x), &
      ' cells |', forces, ' |', cells, ' |', time, ' |', time/forces, ' |', error, ' |'
    if (.not. sum(abs(sums)) > 0.0_dp) error stop 2
  end subroutine measure

  !> The stresses at a few points, cell by cell.
  subroutine sum_cells(plain)
    real(dp), intent(out) :: plain(6, FEW)
    type(rectangle_rules) :: rules
    integer :: i, k, point

    call new_rectangle_rules(rules)
    plain = 0.0_dp
    do k = 1, FEW
      point = (size(pz)/FEW)*k
      do i = 1, size(x)
        plain(:, k) = plain(:, k) + force(i)*rectangle_stress(rules, px(point) - x(i), py(point) - y(i), pz(point), &
                                                              0.5_dp, 0.5_dp, POISSON)
      end do
    end do
  end subroutine sum_cells

  function seconds() result(time)
    real(dp) :: time
    integer, parameter :: int64 = selected_int_kind(18)
    integer(int64) :: count, rate

    call system_clock(count, rate)
    time = real(count, dp)/real(rate, dp)
  end function seconds

end program bound_halfspace_stress
