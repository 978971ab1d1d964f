!> The largest stresses under a contact: in the body, at the surface and at the interfaces of layers.
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
    !> In a body of layers: 1 is the top one, the last number the substrate; layers that are bonded to the same material
    !> are one with it. Below which cell of the grid. Otherwise 0.
    integer :: layer = 0, cell = 0
  end type fuge_stress_peak

  !> The largest stresses of the surface or of an interface, force per length squared, and the numbers of the cells
  !> above them.
  type, public :: fuge_interface_stress
    !> Length.
    real(dp) :: depth = 0.0_dp
    !> The largest principal stress, tension positive, above the interface and below it; at the surface, and at a rigid
    !> base, both are those in the layers.
    real(dp) :: tension_above = 0.0_dp, tension_below = 0.0_dp
    !> Below which cells they are.
    integer :: cell_above = 0, cell_below = 0
    !> The largest shear stress between both sides, and the largest stress that opens the interface, zz.
    real(dp) :: shear = 0.0_dp, opening = 0.0_dp
    !> Below which cells they are.
    integer :: cell_of_shear = 0, cell_of_opening = 0
  end type fuge_interface_stress

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
