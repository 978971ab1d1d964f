!> Waves on a layer that is bonded to a rigid base, for ContactMechanics, which divides by zero if it is incompressible.
!>
!>     layered_waves DIRECTORY
!>
!> writes DIRECTORY/layered_waves.csv: Poisson's ratio, thickness, the two wave numbers over 2 pi, and the displacement
!> of the surface per pressure. The modulus is E = 1, the period is 1 x 1. The wave 0, 0 is the mean pressure: its
!> displacement comes from a product on a periodic grid.
program layered_waves
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use fuge, only: dp => fuge_dp, fuge_halfspace_operator, fuge_info, fuge_layered_body, FUGE_PERIODIC
  implicit none

  real(dp), parameter :: PI = acos(-1.0_dp)
  real(dp), parameter :: POISSON(4) = [0.0_dp, 0.3_dp, 0.49_dp, 0.4999_dp]
  real(dp), parameter :: THICKNESS(3) = [1.0e-3_dp, 0.1_dp, 10.0_dp]
  !> Waves up to this many in a period along each direction; cells of the periodic grid along a side.
  integer, parameter :: SHORTEST = 32, CELLS = 16

  call run()

contains

  subroutine run()
    type(fuge_layered_body) :: body
    type(fuge_info) :: info
    character(len=256) :: directory
    real(dp) :: compliance(1), rigid
    integer :: file, i, j, k, l, status

    call get_command_argument(1, directory)
    if (directory == '') error stop 'usage: layered_waves DIRECTORY'
    open (newunit=file, file=trim(directory)//'/layered_waves.csv', status='replace', action='write', iostat=status)
    if (status /= 0) error stop 'the directory does not exist or cannot be written to'
    write (file, '(a)') 'poisson,thickness,i,j,compliance'
    rigid = ieee_value(rigid, ieee_positive_inf)
    do k = 1, size(POISSON)
      do l = 1, size(THICKNESS)
        call body%set(THICKNESS(l:l), [1.0_dp, rigid], [POISSON(k), 0.0_dp], info)
        if (info%failed()) error stop 'no layer'
        write (file, '(2(es23.16,","),2(i0,","),es23.16)') POISSON(k), THICKNESS(l), 0, 0, mean_compliance(body)
        do i = 1, SHORTEST
          do j = 0, i
            call body%find_compliances([2.0_dp*PI*hypot(real(i, dp), real(j, dp))], compliance, info)
            if (info%failed()) error stop 'no wave'
            write (file, '(2(es23.16,","),2(i0,","),es23.16)') POISSON(k), THICKNESS(l), i, j, compliance
          end do
        end do
      end do
    end do
    close (file)
  end subroutine run

  !> Displacement of a periodic surface under the pressure 1.
  function mean_compliance(body) result(compliance)
    type(fuge_layered_body), intent(in) :: body
    real(dp) :: compliance
    type(fuge_halfspace_operator) :: operator
    type(fuge_info) :: info
    real(dp) :: displacement(CELLS**2)
    integer :: status

    call operator%set(CELLS, CELLS, 1.0_dp/CELLS, 1.0_dp/CELLS, body%e_star(), info, boundary=FUGE_PERIODIC, &
                      body=body%surface())
    if (info%failed()) error stop 'no grid'
    call operator%apply(spread(1.0_dp/CELLS**2, 1, CELLS**2), displacement, status)
    if (status /= 0) error stop 'no product'
    compliance = displacement(1)
  end function mean_compliance

end program layered_waves
