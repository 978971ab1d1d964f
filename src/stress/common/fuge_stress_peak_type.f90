!> The largest stress under a contact, as the search reports it.
module fuge_stress_peak_type
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION
  implicit none
  private

  public :: check_measure

  !> `measure`: von Mises stress.
  integer, parameter, public :: FUGE_MEASURE_VON_MISES = 0
  !> `measure`: Tresca stress, twice the largest shear stress.
  integer, parameter, public :: FUGE_MEASURE_TRESCA = 1

  !> `location`: the largest stress lies below the surface.
  integer, parameter, public :: FUGE_PEAK_INSIDE = 0
  !> `location`: the largest stress lies at the surface.
  integer, parameter, public :: FUGE_PEAK_SURFACE = 1
  !> `location`: the stress is infinite at an edge of the contact, as under a corner of a punch, or in a tip.
  integer, parameter, public :: FUGE_PEAK_SINGULAR = 2

  !> A largest stress. Without forces, and before a search, value, place and tensor are 0.
  type, public :: fuge_stress_peak
    !> The von Mises or Tresca stress; force per length squared. +infinity where it is singular.
    real(dp) :: value = 0.0_dp
    !> Where it lies: x, y, z, length, z into the body; y = 0 in a plane. About an axis: the radius, 0, z.
    real(dp) :: place(3) = 0.0_dp
    !> FUGE_PEAK_INSIDE, FUGE_PEAK_SURFACE or FUGE_PEAK_SINGULAR.
    integer :: location = FUGE_PEAK_INSIDE
    !> The stresses there, xx, yy, zz, yz, xz, xy; about an axis x is the radius. NaN where they are singular.
    real(dp) :: tensor(6) = 0.0_dp
  end type fuge_stress_peak

contains

  !> Refuse an unknown measure (FUGE_ERR_OPTION), unless an error is known already.
  pure subroutine check_measure(measure, info)
    integer, intent(in) :: measure
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    if (all(measure /= [FUGE_MEASURE_VON_MISES, FUGE_MEASURE_TRESCA])) call report(info, FUGE_ERR_OPTION, 'measure = ' &
      //text(measure)//' is unknown: use FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA')
  end subroutine check_measure

end module fuge_stress_peak_type
