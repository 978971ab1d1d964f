!> Waves of pressure on a body with one layer: the factor T by which they displace its surface more, or less, than that
!> of a half-space of the layer's material.
!>
!>     layer_waves [- [folder for its table]]
!>
!> Soft and stiff layers bonded to a half-space, and layers on a rigid base, bonded and sliding, over t = q h, wave
!> number times thickness. Each T is compared with its closed form. With m = G1/G2, the ratio of the shear moduli,
!>
!>     l = 1 - 4 (1 - nu1)/(1 + m (3 - 4 nu2)),    k = (m - 1)/(m - 1 + 4 (1 - nu1)),    e = exp(-2 t),
!>     bonded            T = (1 + 4 t k e - l k e**2)/(1 - (l + k + 4 k t**2) e + l k e**2),
!>     bonded, rigid     T = ((3 - 4 nu) sinh 2t - 2 t)/((3 - 4 nu) cosh 2t + 2 t**2 + 5 - 12 nu + 8 nu**2),
!>     sliding, rigid    T = (cosh 2t - 1)/(sinh 2t + 2 t).
!>
!> For the picture it writes layer_waves.csv.
program layer_waves
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_info, fuge_layered_body
  implicit none

  integer, parameter :: WAVES = 97, BODIES = 7
  !> Values of t, in equal ratios.
  real(dp), parameter :: LONGEST = 0.01_dp, SHORTEST = 10.0_dp
  !> Of the layer; the ratios of Young's moduli, layer over half-space, 0 on a rigid base.
  real(dp), parameter :: POISSON(BODIES) = [0.3_dp, 0.3_dp, 0.3_dp, 0.3_dp, 0.3_dp, 0.5_dp, 0.3_dp]
  real(dp), parameter :: RATIO(BODIES) = [0.01_dp, 0.1_dp, 10.0_dp, 100.0_dp, 0.0_dp, 0.0_dp, 0.0_dp]
  logical, parameter :: BONDED(BODIES) = [.true., .true., .true., .true., .true., .true., .false.]
  real(dp), parameter :: POISSON_BELOW = 0.3_dp

  call run()

contains

  subroutine run()
    type(fuge_layered_body) :: body
    type(verdict) :: known
    type(fuge_info) :: info
    real(dp) :: below, factor(WAVES, BODIES), t(WAVES)
    integer :: file, i, k

    t = [(LONGEST*(SHORTEST/LONGEST)**(real(i - 1, dp)/(WAVES - 1)), i=1, WAVES)]
    do k = 1, BODIES
      below = ieee_value(below, ieee_positive_inf)
      if (RATIO(k) > 0.0_dp) below = 1.0_dp/RATIO(k)
      ! With the thickness 1 the wave number is t.
      call body%set([1.0_dp], [1.0_dp, below], [POISSON(k), POISSON_BELOW], info, bonded=BONDED(k:k))
      if (info%failed()) error stop 'no layers'
      factor(:, k) = body%factor_of_wave(t)
      do i = 1, WAVES
        call known%compare(factor(i, k)/closed_form(k, t(i)) - 1.0_dp, 1.0e-11_dp, 'a wave')
      end do
    end do
    print '(a)', '       t      soft 0.01      soft 0.1      stiff 10     stiff 100  rigid, bonded  bonded, 0.5' &
      //'       sliding'
    print '(f8.3,7f14.8)', (t(i), factor(i, :), i=1, WAVES, 16)
    call create_file('layer_waves.csv', 2, file)
    write (file, '(a)') 't,soft_100,soft_10,stiff_10,stiff_100,bonded,incompressible,sliding'
    do i = 1, WAVES
      write (file, '(*(es16.8,:,","))') t(i), factor(i, :)
    end do
    close (file)
    call known%give('as in closed form')
  end subroutine run

  !> T of the body `k`, as above.
  pure function closed_form(k, t) result(factor)
    integer, intent(in) :: k
    real(dp), intent(in) :: t
    real(dp) :: factor
    real(dp) :: decay, first, m, nu, second

    nu = POISSON(k)
    if (RATIO(k) > 0.0_dp) then
      m = RATIO(k)*(1.0_dp + POISSON_BELOW)/(1.0_dp + nu)
      first = 1.0_dp - 4.0_dp*(1.0_dp - nu)/(1.0_dp + m*(3.0_dp - 4.0_dp*POISSON_BELOW))
      second = (m - 1.0_dp)/(m - 1.0_dp + 4.0_dp*(1.0_dp - nu))
      decay = exp(-2.0_dp*t)
      factor = (1.0_dp + 4.0_dp*t*second*decay - first*second*decay**2) &
               /(1.0_dp - (first + second + 4.0_dp*second*t**2)*decay + first*second*decay**2)
    else if (BONDED(k)) then
      factor = ((3.0_dp - 4.0_dp*nu)*sinh(2.0_dp*t) - 2.0_dp*t) &
               /((3.0_dp - 4.0_dp*nu)*cosh(2.0_dp*t) + 2.0_dp*t**2 + 5.0_dp - 12.0_dp*nu + 8.0_dp*nu**2)
    else
      factor = (cosh(2.0_dp*t) - 1.0_dp)/(sinh(2.0_dp*t) + 2.0_dp*t)
    end if
  end function closed_form

end program layer_waves
