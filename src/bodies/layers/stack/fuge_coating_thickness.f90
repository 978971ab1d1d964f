!> From which thickness on a coating is felt, and from which on the body below it is not.
module fuge_coating_thickness
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_value
  use fuge_effective_modulus, only: check_radius, punch_factor
  use fuge_kinds, only: dp
  use fuge_layer_stack, only: bond_layers, layer_stack
  use fuge_layered_body_type, only: check_layers
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION
  implicit none
  private

  public :: fuge_find_coating_limits

  !> Powers of ten above and below the contact radius in which limits are looked for, and steps in each of them. With
  !> the largest ratio of moduli and the least share the limits are 1e-15 and 1e12 radii.
  integer, parameter :: DECADES = 16, STEPS_PER_DECADE = 2
  !> The range of the share.
  real(dp), parameter :: LEAST_SHARE = 1.0e-6_dp, LARGEST_SHARE = 1.0_dp
  !> Bisections of the logarithm of the thickness, to 1e-11.
  integer, parameter :: BISECTIONS = 36

contains

  !> Below which thickness a bonded coating is not felt under a contact, and above which the substrate is not.
  !>
  !> `young` (2), force per length squared, and `poisson` (2), 0 .. 0.5: of the coating and of the half-space below it,
  !> which may be rigid, of an infinite modulus. `radius` > 0 of the contact, length. `share`, 1e-6 .. 1: what counts as
  !> not felt, the largest relative change of the effective modulus of `fuge_find_effective_modulus`.
  !>
  !> `thin`: up to this thickness, length, the effective modulus is that of the substrate, changed by less than
  !> `share`; infinite if a coating of any thickness is not felt, 0 if one of any thickness is, as on a rigid base, or
  !> one of 1e-16 radii. `thick`: from this thickness on it is that of a half-space of the coating's material; 0 if it
  !> always is, infinite if at 1e16 radii it is not. Both are found by bisection of the change over the logarithm of
  !> the thickness, where it first exceeds the share.
  !>
  !> Errors, thin and thick untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH for the radius,
  !> FUGE_ERR_MODULUS, FUGE_ERR_OPTION for the share, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  subroutine fuge_find_coating_limits(young, poisson, radius, share, thin, thick, info)
    real(dp), intent(in) :: young(:), poisson(:), radius, share
    real(dp), intent(inout) :: thin, thick
    type(fuge_info), intent(out) :: info
    type(layer_stack) :: stack
    real(dp) :: below, limit
    integer :: stat

    call check_layers([1.0_dp], young, poisson, info)
    if (info%failed()) return
    call check_radius(radius, 'radius', info)
    if (info%failed()) return
    if (ieee_is_nan(share)) then
      call report(info, FUGE_ERR_NOT_FINITE, 'share is not a number')
    else if (share < LEAST_SHARE .or. share > LARGEST_SHARE) then
      call report(info, FUGE_ERR_OPTION, 'share = '//text(share)//' is not in '//text(LEAST_SHARE)//' .. ' &
                  //text(LARGEST_SHARE))
    end if
    if (info%failed()) return
    call bond_layers([1.0_dp], young, poisson, stack, stat)
    call require_memory(stat, 'a coating', info)
    if (stat /= 0) return
    limit = stack%factor_of_longest()
    below = 0.0_dp
    if (limit > 0.0_dp) below = radius*limit_from(stack, share, limit, -1)
    thick = radius*limit_from(stack, share, 1.0_dp, 1)
    thin = below
  end subroutine fuge_find_coating_limits

  !> The thickness for the radius 1 at which the change from the T of `limit` first exceeds `share`, from thin
  !> coatings on if `side` is -1, from thick ones on if it is 1.
  function limit_from(stack, share, limit, side) result(thickness)
    type(layer_stack), intent(in) :: stack
    real(dp), intent(in) :: share, limit
    integer, intent(in) :: side
    real(dp) :: thickness
    real(dp) :: felt, middle, unfelt
    integer :: k
    logical :: found

    unfelt = real(side*DECADES, dp)
    found = .false.
    do k = 0, 2*DECADES*STEPS_PER_DECADE
      felt = real(side, dp)*(real(DECADES, dp) - real(k, dp)/real(STEPS_PER_DECADE, dp))
      found = is_felt(felt)
      if (found) exit
      unfelt = felt
    end do
    if (k == 0 .or. .not. found) then
      ! Felt at the end where the search begins, the limit is beyond that; never felt, it is beyond the other one.
      thickness = 0.0_dp
      if (found .eqv. side > 0) thickness = ieee_value(thickness, ieee_positive_inf)
      return
    end if
    do k = 1, BISECTIONS
      middle = 0.5_dp*(felt + unfelt)
      if (is_felt(middle)) then
        felt = middle
      else
        unfelt = middle
      end if
    end do
    thickness = 10.0_dp**unfelt

  contains

    !> Does a coating of the thickness 10**`exponent` change the effective modulus by more than the share?
    function is_felt(exponent)
      real(dp), intent(in) :: exponent
      logical :: is_felt

      ! Waves and thickness count by their product only.
      is_felt = abs(limit/punch_factor(stack, 10.0_dp**(-exponent)) - 1.0_dp) > share
    end function is_felt

  end function limit_from

end module fuge_coating_thickness
