!> Round bodies: time of a coefficient of rings, and of a round punch, least of many repetitions.
!>
!> Prints rows of Markdown tables to standard output. A coefficient is compared with 1/sqrt(x), which every method needs
!> at least; CPU time.
program round_bodies
  use fuge, only: dp => fuge_dp, fuge_info, fuge_polynomial_profile, fuge_power_profile, fuge_ring_matrix, &
    fuge_round_contact, fuge_smooth_profile, fuge_solve_round_punch, FUGE_DONE, FUGE_MEAN
  implicit none

  integer, parameter :: REPETITIONS = 7, SOLVES = 50
  type(fuge_polynomial_profile) :: polynomial
  type(fuge_power_profile) :: powers

  print '(a)', '| rings | 1/sqrt(x) | coefficient | ratio |', '| --- | --- | --- | --- |'
  call measure_rings(100)
  call measure_rings(500)
  call measure_rings(2000)
  print '(/,a,/,a)', '| round punch | time | coefficients | residual |', '| --- | --- | --- | --- |'
  polynomial%upper = 2.0_dp
  polynomial%coefficients = [0.0_dp, 0.0_dp, 0.5_dp]
  call measure_punch('sphere', polynomial, 1.0_dp)
  call measure_punch('sphere, a contact of 1e-4 of the profile', polynomial, 1.0e-11_dp)
  polynomial%coefficients = [0.0_dp, 1.0_dp]
  call measure_punch('cone', polynomial, 1.0_dp)
  polynomial%coefficients = [0.0_dp, 0.0_dp, -1.0_dp, 0.0_dp, 1.0_dp]
  call measure_punch('r^4 - r^2, its dimple closed', polynomial, 5.0_dp)
  powers%upper = 2.0_dp
  powers%coefficients = [1.0_dp]
  powers%powers = [1.5_dp]
  call measure_punch('r^1.5', powers, 1.0_dp)
  powers%powers = [2.0_dp]
  powers%starts = [0.5_dp]
  call measure_punch('flat end with a rounded edge', powers, 1.0_dp)

contains

  subroutine measure_rings(n)
    integer, intent(in) :: n
    real(dp), allocatable :: radius(:), alpha(:, :), other(:, :)
    real(dp) :: start, bound, time, each
    type(fuge_info) :: info
    integer :: j, k

    allocate (alpha(n, n), other(n, n))
    radius = [(real(k, dp), k=0, n)]
    bound = huge(bound)
    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      do j = 1, n
        other(j:, j) = 1.0_dp/sqrt(radius(j + 1:)**2 + radius(j + 1)**2)
        other(j, j:) = other(j:, j)
      end do
      bound = min(bound, seconds() - start)
      start = seconds()
      call fuge_ring_matrix(radius, 1.0_dp, FUGE_MEAN, alpha, info)
      time = min(time, seconds() - start)
    end do
    if (info%status /= FUGE_DONE .or. any(other > 1.0_dp)) error stop 'no coefficients'
    each = 1.0e9_dp/(0.5_dp*real(n, dp)*real(n + 1, dp))
    print '(a,i0,a,f6.1,a,f7.1,a,f6.1,a)', '| ', n, ' | ', each*bound, ' ns | ', each*time, ' ns | ', time/bound, ' |'
  end subroutine measure_rings

  subroutine measure_punch(name, profile, load)
    character(len=*), intent(in) :: name
    class(fuge_smooth_profile), intent(in) :: profile
    real(dp), intent(in) :: load
    type(fuge_round_contact) :: contact
    type(fuge_info) :: info
    real(dp) :: start, time
    integer :: j, k

    time = huge(time)
    do k = 1, REPETITIONS
      start = seconds()
      do j = 1, SOLVES
        call fuge_solve_round_punch(profile, 1.0_dp, contact, info, load=load)
      end do
      time = min(time, seconds() - start)
    end do
    if (info%status /= FUGE_DONE) error stop 'the punch was not solved'
    print '(3a,f7.1,a,i0,a,es7.1,a)', '| ', name, ' | ', 1.0e6_dp*time/SOLVES, ' us | ', size(contact%coefficients()), &
      ' | ', info%residual, ' |'
  end subroutine measure_punch

  real(dp) function seconds()
    call cpu_time(seconds)
  end function seconds

end program round_bodies
