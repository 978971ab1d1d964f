!> The elastic energy of a solution, for its certificate.
module fuge_elastic_energy
  use fuge_kinds, only: dp
  use fuge_point_space, only: point_space
  use fuge_problem_type, only: fuge_problem, fuge_solution
  implicit none
  private

  public :: elastic_energy

contains

  !> Half the work of the forces on the `displacement` (n) by them, which lacks the `datum`, and of the springs on the
  !> motions; huge where it would overflow.
  function elastic_energy(problem, solution, displacement, datum, space) result(energy)
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: displacement(:), datum
    type(point_space), intent(in) :: space
    real(dp) :: energy
    real(dp) :: inverse(2), largest(2), sums(2), unit(2), works(2)
    real(dp) :: largest_force, largest_length, load, most, total, work
    integer :: j, k

    largest_force = 0.0_dp
    largest_length = 0.0_dp
    do k = 1, size(displacement)
      largest_force = max(largest_force, abs(solution%force(k)))
      largest_length = max(largest_length, abs(displacement(k)))
    end do
    largest = [largest_force, largest_length]
    call space%raise(largest)
    ! Powers of two up to the largest ones, so that no product overflows and none of the large ones is lost.
    unit = scale(1.0_dp, max(exponent(largest), minexponent(unit)) - 1)
    inverse = 1.0_dp/unit
    work = 0.0_dp
    load = 0.0_dp
    do k = 1, size(displacement)
      if (.not. abs(solution%force(k)) > 0.0_dp) cycle
      work = work + (solution%force(k)*inverse(1))*(displacement(k)*inverse(2))
      load = load + solution%force(k)
    end do
    sums = [work, load]
    call space%add(sums)
    works = [bounded_product(bounded_product(unit(1), sums(1)), unit(2)), &
             bounded_product(bounded_product(datum, sums(2)), sums(2))]
    ! A sum of as many works as these and those of all motions does not overflow.
    most = huge(energy)/real(2 + size(solution%motion), dp)
    energy = huge(energy)
    if (any(abs(works) >= most)) return
    total = sum(works)
    do j = 1, size(solution%motion)
      work = bounded_product(problem%spring_load(j, solution%motion(j)), solution%motion(j))
      if (abs(work) >= most) return
      total = total + work
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
