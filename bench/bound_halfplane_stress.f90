!> Time of stresses and displacements at points of a half-plane, against the plain sum over points and cells: its
!> operations alone, for line loads, 13 of them and one division for a pair, in vectors.
!>
!>     bound_halfplane_stress [n]
!>
!> n points under n cells, 10000 unless given. Prints rows | problem | bound | fuge | ratio | wanted | error | to
!> standard output, times for a point in microseconds; the bound is measured on some of the points. The error is the
!> largest difference from the plain sum: of zz relative to itself, or of the displacements relative to the largest one.
!> Both sides alternate and the least time of each counts, because other programs may run.
program bound_halfplane_stress
  use fuge, only: dp => fuge_dp, fuge_field, fuge_halfplane_field, fuge_info, FUGE_HAT, FUGE_MEAN, FUGE_PLANE_STRAIN
  implicit none

  integer, parameter :: REPETITIONS = 7
  !> Points that are computed in the plain way.
  integer, parameter :: SOME = 200
  integer :: n, stat
  character(len=20) :: argument

  n = 10000
  call get_command_argument(1, argument)
  if (len_trim(argument) > 0) read (argument, *, iostat=stat) n
  call measure('strips', n, FUGE_MEAN, .false.)
  call measure('hats', n, FUGE_HAT, .false.)
  call measure('strips, displacements', n, FUGE_MEAN, .true.)
  call measure('hats, displacements', n, FUGE_HAT, .true.)

contains

  !> Forces of the cylinder with a rough surface; points everywhere above and beside, down to a third of the width.
  subroutine measure(name, n, element, displaced)
    character(len=*), intent(in) :: name
    integer, intent(in) :: n, element
    logical, intent(in) :: displaced
    type(fuge_halfplane_field) :: field
    type(fuge_info) :: info
    real(dp), allocatable :: x(:), width(:), force(:), place(:, :), found(:, :), plain(:, :)
    real(dp) :: start, bound, time, error
    integer :: components, k

    components = merge(3, 6, displaced)
    allocate (x(n), width(n), force(n), place(3, n), found(components, n), plain(components, n))
    do k = 1, n
      x(k) = real(k, dp) - 0.5_dp*n
      width(k) = 1.0_dp
      force(k) = sqrt(max(0.0_dp, 1.0_dp - (2.0_dp*x(k)/n)**2))*(1.0_dp + sin(real(k, dp)**2))
      place(:, k) = [0.7_dp*n*sin(1.618_dp*k), 0.0_dp, 0.3_dp*n*(0.5_dp + 0.5_dp*sin(2.718_dp*k))**3]
    end do
    call field%set_cells(x, width, force, element, 1.0_dp, 0.3_dp, FUGE_PLANE_STRAIN, info)
    if (info%failed()) error stop 'no field'
    bound = huge(bound)
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      call line_loads(x, force, place(1, :SOME), place(3, :SOME), plain(:, :SOME))
      bound = min(bound, (seconds() - start)/SOME)
      start = seconds()
      call evaluate(field, place, found)
      time = min(time, (seconds() - start)/n)
    end do
    ! The plain sum takes this few points at a time.
    do k = 1, SOME, 10
      call evaluate(field, place(:, k:k + 9), plain(:, k:k + 9))
    end do
    if (displaced) then
      error = maxval(abs(found(:, :SOME) - plain(:, :SOME)))/maxval(abs(plain(:, :SOME)))
    else
      error = maxval(abs(found(3, :SOME)/plain(3, :SOME) - 1.0_dp))
    end if
    print '(2a,i0,2(a,f9.3),a,f7.4,a,es8.1,a)', '| '//name, ', ', n, ' | ', 1.0e6_dp*bound, ' µs | ', 1.0e6_dp*time, &
      ' µs | ', time/bound, ' | 3.0 | ', error, ' |'
  end subroutine measure

  subroutine evaluate(field, place, found)
    class(fuge_field), intent(in) :: field
    real(dp), intent(in) :: place(:, :)
    real(dp), intent(inout) :: found(:, :)
    type(fuge_info) :: info

    if (size(found, 1) == 6) then
      call field%stress(place, found, info)
    else
      call field%displacement(place, found, info)
    end if
    if (info%status /= 0) error stop 'no stresses'
  end subroutine evaluate

  !> The stresses under line loads at the middles of the cells, the inner loop over the points.
  subroutine line_loads(x, force, px, pz, stress)
    real(dp), intent(in) :: x(:), force(:), px(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    real(dp), dimension(size(px)) :: xx, zz, xz
    real(dp) :: along, across, inverse
    integer :: j, k

    xx = 0.0_dp
    zz = 0.0_dp
    xz = 0.0_dp
    do j = 1, size(x)
      do k = 1, size(px)
        along = px(k) - x(j)
        inverse = 1.0_dp/(along**2 + pz(k)**2)
        across = pz(k)*inverse
        along = along*inverse
        xx(k) = xx(k) + force(j)*along**2
        zz(k) = zz(k) + force(j)*across**2
        xz(k) = xz(k) + force(j)*(along*across)
      end do
    end do
    stress(1, :) = xx + xz
    stress(2, :) = zz
  end subroutine line_loads

  !> CPU time.
  function seconds() result(time)
    real(dp) :: time

    call cpu_time(time)
  end function seconds

end program bound_halfplane_stress
