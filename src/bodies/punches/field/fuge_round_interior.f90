!> Stresses and displacements in a half-space under a round punch.
module fuge_round_interior
  use fuge_axial_checks, only: check_axial_points
  use fuge_axial_field, only: axial_displacement, axial_stress, surface_field, INTEGRALS, POTENTIAL, SPREAD
  use fuge_constants, only: LARGEST_EXPONENT, PI
  use fuge_elastic_moduli, only: check_poisson, fuge_plane_modulus, FUGE_PLANE_STRAIN
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_round_contact_type, only: fuge_round_contact
  use fuge_status, only: fuge_info, report, FUGE_ERR_OVERFLOW
  implicit none
  private

  public :: fuge_round_displacement, fuge_round_stress

  !> In the contact the field of a lesser depth, relative to the distance from the axis, is that of the surface.
  real(dp), parameter :: LEAST_DEPTH = 2.0_dp**(-104)
  !> Depths below count as this one, relative to the radius, and so close to the axis is on it: squares stay in range.
  real(dp), parameter :: LEAST_LENGTH = 2.0_dp**(-300)

contains

  !> Stresses in a half-space under a round punch.
  !>
  !> `contact` of `fuge_solve_round_punch`. `poisson`: Poisson's ratio of the body, above -1 and up to 0.5. `pr`, `pz`
  !> >= 0 (points): distances from the axis, and depths; length. Out: `stress` (4, points): rr, tt (around the axis),
  !> zz, rz; force per length squared, tension positive. At the surface, pz = 0, they are the limits from inside. In the
  !> tip of a cone, where the pressure is infinite, zz is minus the largest number, and rr and tt are (1 + 2 poisson)/2
  !> times it. Without load all are 0.
  !> Accurate to rounding of the largest stress; zz relative to itself too, if chi' of `fuge_abel_transform` is nowhere
  !> negative, as for spheres, cones and other profiles that become steeper outwards.
  !> Errors, stress untouched: FUGE_ERR_MODULUS, FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH for a negative pr,
  !> FUGE_ERR_GRID for pz < 0, FUGE_ERR_OVERFLOW for points beyond 1e60 radii.
  pure subroutine fuge_round_stress(contact, poisson, pr, pz, stress, info)
    use fuge_abel_transform, only: abel_transform
    use fuge_round_field, only: new_round_rules, round_rules
    type(fuge_round_contact), intent(in) :: contact
    real(dp), intent(in) :: poisson, pr(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info
    type(round_rules) :: rules
    type(abel_transform) :: transform
    integer :: k

    call check_poisson(poisson, info)
    if (info%failed()) return
    call check_axial_points(pr, pz, contact%radius, shape(stress), 'stress', 4, info)
    if (info%failed()) return
    if (.not. contact%radius > 0.0_dp) then
      stress = 0.0_dp
      return
    end if
    transform = contact%abel()
    rules = new_round_rules(transform)
    do k = 1, size(pr)
      if (max(pr(k), pz(k)) > 0.0_dp .or. .not. transform%tip > 0.0_dp) then
        stress(:, k) = contact%e_star*(axial_stress(field_at(contact, transform, rules, pr(k), pz(k)), poisson)/PI)
      else
        stress(:, k) = -huge(1.0_dp)*[0.5_dp + poisson, 0.5_dp + poisson, 1.0_dp, 0.0_dp]
      end if
    end do
  end subroutine fuge_round_stress

  !> Displacements of a half-space under a round punch, at its surface and inside.
  !>
  !> `contact`, `poisson`, `pr` and `pz` as in `fuge_round_stress`; `young` > 0: Young's modulus of the body, force per
  !> length squared, +infinity for a rigid one. The modulus E* of the contact may hold the other body too. Out:
  !> `displacement` (2, points): away from the axis, and into the body; length. They vanish far away.
  !> Errors, displacement untouched: those of `fuge_round_stress`.
  pure subroutine fuge_round_displacement(contact, young, poisson, pr, pz, displacement, info)
    use fuge_abel_transform, only: abel_transform
    use fuge_round_field, only: new_round_rules, round_rules
    type(fuge_round_contact), intent(in) :: contact
    real(dp), intent(in) :: young, poisson, pr(:), pz(:)
    real(dp), intent(inout) :: displacement(:, :)
    type(fuge_info), intent(out) :: info
    type(round_rules) :: rules
    type(abel_transform) :: transform
    real(dp) :: modulus
    integer :: k

    modulus = 1.0_dp
    call fuge_plane_modulus(young, poisson, FUGE_PLANE_STRAIN, modulus, info)
    if (info%failed()) return
    call check_axial_points(pr, pz, contact%radius, shape(displacement), 'displacement', 2, info)
    call check_softness(contact, young, info)
    if (info%failed()) return
    if (.not. contact%radius > 0.0_dp) then
      displacement = 0.0_dp
      return
    end if
    transform = contact%abel()
    rules = new_round_rules(transform)
    do k = 1, size(pr)
      displacement(:, k) = axial_displacement(field_at(contact, transform, rules, pr(k), pz(k)), poisson, &
                                              pr(k)/contact%radius, pz(k)/contact%radius)
      displacement(:, k) = (contact%e_star/modulus)*(contact%radius*displacement(:, k)/PI)
    end do
  end subroutine fuge_round_displacement

  !> Refuse a body so soft beside the contact that its displacements overflow: FUGE_ERR_OVERFLOW.
  pure subroutine check_softness(contact, young, info)
    type(fuge_round_contact), intent(in) :: contact
    real(dp), intent(in) :: young
    type(fuge_info), intent(inout) :: info

    if (info%failed() .or. .not. young <= huge(young)) return
    if (exponent(contact%e_star) + max(0, exponent(contact%radius)) - exponent(young) > LARGEST_EXPONENT) &
      call report(info, FUGE_ERR_OVERFLOW, 'young = '//text(young)//' is out of range: choose other units')
  end subroutine check_softness

  !> The integrals of `fuge_axial_field` in units of E*/pi and the radius of the contact.
  pure function field_at(contact, transform, rules, pr, pz) result(field)
    use fuge_abel_transform, only: abel_transform
    use fuge_round_field, only: round_field, round_rules
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    type(round_rules), intent(in) :: rules
    real(dp), intent(in) :: pr, pz
    real(dp) :: field(INTEGRALS)
    real(dp) :: r, z

    r = pr/contact%radius
    z = pz/contact%radius
    if (r > 1.0_dp .and. z > 0.0_dp) then
      field = round_field(rules, transform, r, z)
    else if (z > LEAST_DEPTH*r) then
      field = round_field(rules, transform, merge(r, 0.0_dp, r >= LEAST_LENGTH), max(z, LEAST_LENGTH))
    else
      field = surface_field_at(contact, transform, rules, pr)
    end if
  end function field_at

  !> The same at the surface.
  pure function surface_field_at(contact, transform, rules, pr) result(field)
    use fuge_abel_transform, only: abel_transform
    use fuge_round_field, only: round_field, round_rules
    type(fuge_round_contact), intent(in) :: contact
    type(abel_transform), intent(in) :: transform
    type(round_rules), intent(in) :: rules
    real(dp), intent(in) :: pr
    real(dp) :: field(INTEGRALS)
    real(dp) :: r, pressure

    r = pr/contact%radius
    if (r >= LEAST_LENGTH) then
      field = round_field(rules, transform, r, 0.0_dp)
      pressure = contact%pressure(pr)/contact%e_star*PI
    else
      field = round_field(rules, transform, merge(LEAST_LENGTH, 0.0_dp, r > 0.0_dp), 0.0_dp)
      ! Beside a tip the pressure grows like the logarithm of 1/r; the spread is pi times its mean nearer to the axis.
      if (r > 0.0_dp) field(SPREAD) = field(SPREAD) + PI*transform%tip*log(LEAST_LENGTH/r)
      pressure = field(SPREAD)/PI - 0.5_dp*transform%tip
    end if
    field = surface_field(pressure, field(SPREAD), field(POTENTIAL))
  end function surface_field_at

end module fuge_round_interior
