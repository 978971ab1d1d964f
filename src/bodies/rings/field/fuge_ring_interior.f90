!> Stresses and displacements in a half-space under forces on rings about one axis.
!>
!> They are those of J. Boussinesq's force (K. L. Johnson, Contact Mechanics, 1985, section 3.2), integrated over
!> the rings; for a disc A. E. H. Love (Phil. Trans. R. Soc. A 228, 1929, 377) has them in closed form.
module fuge_ring_interior
  use fuge_axial_checks, only: check_axial_points
  use fuge_axial_field, only: axial_displacement, axial_stress, INTEGRALS, POTENTIAL, SIDEWARD
  use fuge_constants, only: LARGEST_EXPONENT
  use fuge_elastic_moduli, only: check_poisson, fuge_plane_modulus, FUGE_PLANE_STRAIN
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text, text
  use fuge_ring_field, only: new_ring_rules, ring_field, ring_rules
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_OVERFLOW
  use fuge_stress_checks, only: check_displacement_range, check_forces
  implicit none
  private

  public :: fuge_ring_interior_displacement, fuge_ring_stress

contains

  !> Stresses in a half-space under forces on rings.
  !>
  !> `radius` (n + 1), increasing and not negative, length: ring k lies between radius(k) and radius(k + 1), a disc if
  !> radius(1) = 0. `force` (n): the resultants of uniform pressures, positive into the body. `poisson`: Poisson's
  !> ratio of the body, above -1 and up to 0.5. `pr`, `pz` >= 0 (points): distances from the axis, and depths; length.
  !> Out: `stress` (4, points): rr, tt (around the axis), zz, rz; force per length squared, tension positive.
  !> At the surface, pz = 0, they are the limits from inside. There the pressure jumps at the edge of a ring, and zz, rr
  !> and tt jump by as much (tt by 2 poisson times it): at an edge they are the mean of both sides.
  !> Accurate to rounding, zz in relation to itself where all forces have one sign.
  !> Errors, stress untouched: FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH for radii that do not increase, a ring
  !> thinner than 1e-7 of its radius, a negative radius or pr, FUGE_ERR_GRID for pz < 0, FUGE_ERR_MODULUS,
  !> FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY.
  pure subroutine fuge_ring_stress(radius, force, poisson, pr, pz, stress, info)
    real(dp), intent(in) :: radius(:), force(:), poisson, pr(:), pz(:)
    real(dp), intent(inout) :: stress(:, :)
    type(fuge_info), intent(out) :: info
    type(ring_rules), allocatable :: rules
    real(dp) :: field(INTEGRALS)
    integer :: k

    call check_poisson(poisson, info)
    call check_ring_forces(radius, force, info)
    if (info%failed()) return
    call check_axial_points(pr, pz, radius(size(radius)), shape(stress), 'stress', 4, info)
    call start_rules(rules, info)
    if (info%failed()) return
    do k = 1, size(pr)
      field = field_of_rings(rules, radius, force, pr(k), pz(k))
      stress(:, k) = axial_stress(field, poisson)
    end do
  end subroutine fuge_ring_stress

  !> Displacements of a half-space under forces on rings, at its surface and inside.
  !>
  !> `radius`, `force`, `poisson`, `pr` and `pz` as in `fuge_ring_stress`; `young` > 0: Young's modulus of the body,
  !> force per length squared, +infinity for a rigid one. Out: `displacement` (2, points): away from the axis, and
  !> into the body; length. They vanish far away. At pz = 0 the second one is that of `fuge_ring_displacement` for
  !> e_star = young/(1 - poisson**2).
  !> Errors, displacement untouched: those of `fuge_ring_stress`.
  pure subroutine fuge_ring_interior_displacement(radius, force, young, poisson, pr, pz, displacement, info)
    real(dp), intent(in) :: radius(:), force(:), young, poisson, pr(:), pz(:)
    real(dp), intent(inout) :: displacement(:, :)
    type(fuge_info), intent(out) :: info
    type(ring_rules), allocatable :: rules
    real(dp) :: field(INTEGRALS), modulus
    integer :: k

    modulus = 1.0_dp
    call fuge_plane_modulus(young, poisson, FUGE_PLANE_STRAIN, modulus, info)
    call check_ring_forces(radius, force, info)
    if (info%failed()) return
    call check_displacement_range(force, minval(radius(2:) - radius(:size(force))), young, info)
    call check_axial_points(pr, pz, radius(size(radius)), shape(displacement), 'displacement', 2, info)
    call start_rules(rules, info)
    if (info%failed()) return
    do k = 1, size(pr)
      field = field_of_rings(rules, radius, force, pr(k), pz(k))
      displacement(:, k) = axial_displacement(field, poisson, pr(k), pz(k))/modulus
    end do
  end subroutine fuge_ring_interior_displacement

  !> Refuse radii of no rings, forces that are not finite or not one for each ring, and pressures out of range.
  pure subroutine check_ring_forces(radius, force, info)
    use fuge_ring_influence, only: check_rings
    real(dp), intent(in) :: radius(:), force(:)
    type(fuge_info), intent(inout) :: info
    integer :: k

    if (info%failed()) return
    call check_rings(radius, info)
    call check_forces(force, size(radius) - 1, 'rings, one less than there are radii', info)
    if (info%failed()) return
    do k = 1, size(force)
      if (exponent(force(k)) - exponent(radius(k + 1) - radius(k)) - exponent(radius(k + 1)) <= LARGEST_EXPONENT) cycle
      call report(info, FUGE_ERR_OVERFLOW, 'the pressure of force('//index_text(k)//') = '//text(force(k)) &
                  //' on its ring is out of range: choose other units')
      return
    end do
  end subroutine check_ring_forces

  pure subroutine start_rules(rules, info)
    type(ring_rules), allocatable, intent(out) :: rules
    type(fuge_info), intent(inout) :: info
    integer :: stat

    if (info%failed()) return
    allocate (rules, stat=stat)
    call require_memory(stat, 'the quadrature rules', info)
    if (stat == 0) rules = new_ring_rules()
  end subroutine start_rules

  !> The sum of the fields of all rings at one point, in the caller's units.
  pure function field_of_rings(rules, radius, force, r, z) result(total)
    type(ring_rules), intent(in) :: rules
    real(dp), intent(in) :: radius(:), force(:), r, z
    real(dp) :: total(INTEGRALS)
    real(dp) :: field(INTEGRALS)
    integer :: k, unit

    total = 0.0_dp
    unit = exponent(max(radius(size(radius)), r, z))
    do k = 1, size(force)
      if (.not. abs(force(k)) > 0.0_dp) cycle
      field = ring_field(rules, scale(radius(k), -unit), scale(radius(k + 1), -unit), scale(r, -unit), scale(z, -unit))
      field = scale(field, -unit)*force(k)
      total = total + field
    end do
    field = scale(total, -unit)
    field([POTENTIAL, SIDEWARD]) = total([POTENTIAL, SIDEWARD])
    total = field
  end function field_of_rings

end module fuge_ring_interior
