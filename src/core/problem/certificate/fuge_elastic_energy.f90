!> The elastic energy of a solution, for its certificate.
module fuge_elastic_energy
  use fuge_kinds, only: dp
  use fuge_problem_type, only: fuge_problem
  implicit none
  private

  public :: elastic_energy, energy_units

contains

  !> Units in which forces and displacements are summed up, of the `largest` ones: powers of two up to these, so that no
  !> product overflows and none of the large ones is lost.
  pure function energy_units(largest) result(units)
    real(dp), intent(in) :: largest(2)
    real(dp) :: units(2)

    units = scale(1.0_dp, max(exponent(largest), minexponent(units)) - 1)
  end function energy_units

  !> Half the work of the forces on their displacements and of the springs on the motions; huge where it would overflow.
  !>
  !> `work` is that of the forces on the displacements in `units`, without the `datum`; `load` is the sum of the forces;
  !> `motion` (m).
  pure function elastic_energy(problem, motion, work, units, load, datum) result(energy)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: motion(:), work, units(2), load, datum
    real(dp) :: energy
    real(dp) :: most, on_spring, total, works(2)
    integer :: j

    works = [bounded_product(bounded_product(units(1), work), units(2)), &
             bounded_product(bounded_product(datum, load), load)]
    ! A sum of as many works as these and those of all motions does not overflow.
    most = huge(energy)/real(2 + size(motion), dp)
    energy = huge(energy)
    if (any(abs(works) >= most)) return
    total = sum(works)
    do j = 1, size(motion)
      on_spring = bounded_product(problem%spring_load(j, motion(j)), motion(j))
      if (abs(on_spring) >= most) return
      total = total + on_spring
    end do
    energy = 0.5_dp*total
  end function elastic_energy

  !> The product of two numbers, or the largest number of its sign where it would overflow.
  elemental function bounded_product(a, b) result(product)
    real(dp), intent(in) :: a, b
    real(dp) :: product
    !> The product of two smaller numbers does not overflow.
    real(dp), parameter :: SAFE_FACTOR = 2.0_dp**(maxexponent(product)/2 - 1)

    if (max(abs(a), abs(b)) < SAFE_FACTOR) then
      product = a*b
    else if (.not. (abs(a) > 0.0_dp .and. abs(b) > 0.0_dp)) then
      product = 0.0_dp
    else if (exponent(a) + exponent(b) > maxexponent(product)) then
      product = sign(huge(product), a)*sign(1.0_dp, b)
    else
      product = a*b
    end if
  end function bounded_product

end module fuge_elastic_energy
