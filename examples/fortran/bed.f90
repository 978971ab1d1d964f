!> A beam on a bed that does not pull, pressed by a force at each end.
!>
!>     bed [folder for its tables]
!>
!> The bed of modulus k resists where the beam, of bending stiffness EI, goes down, and lets go where it goes up: each
!> point has a spring, its compliance, and one-sided contact. Up to the length pi/lambda, lambda = (k/4EI)**(1/4), the
!> whole beam rests on the bed; a longer one lifts off in the middle, whatever the force is (M. Hetenyi, Beams on
!> Elastic Foundation, 1946). Both states have closed forms, with which lengths, deflections and moments are compared.
!> Then the strength of the bed is limited: it gives way at the ends first, and carries no more than its strength.
!> Lengths are in units of 1/lambda, forces in units of the force F at one end, k = 1 and EI = 1/4.
!> For the picture it writes bed_length.csv, bed_shape.csv and bed_limit.csv.
program bed
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_problem, fuge_solution, fuge_solver, &
    FUGE_ERR_NO_EQUILIBRIUM, FUGE_LIMITED_LOWER
  implicit none

  integer, parameter :: POINTS = 241
  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Discretisation: the bed is lumped at points, the edge of contact lies at one of them.
  real(dp), parameter :: ALLOWED = 2.0e-3_dp

  !> What is known of one length, or found for it.
  type :: bending
    !> Length of the contact at one end, half of the beam where it does not lift off.
    real(dp) :: contact = 0.0_dp
    !> How deep the ends are pressed into the bed, and the middle.
    real(dp) :: end_depth = 0.0_dp, middle_depth = 0.0_dp
    !> Bending moment in the middle.
    real(dp) :: moment = 0.0_dp
  end type bending

  call run()

contains

  subroutine run()
    type(verdict) :: known

    call all_lengths(known)
    call write_shapes()
    call limit_strength(known)
    call known%give('against closed forms')
  end subroutine run

  !> From a short beam, nearly rigid, to one that rests on the bed near its ends only.
  subroutine all_lengths(known)
    type(verdict), intent(inout) :: known
    type(bending) :: exact, found
    type(fuge_solution) :: solution
    real(dp) :: length, lengths(26), x(POINTS)
    integer :: file, k

    ! With that of lift-off, where the curve of the picture has its corner.
    lengths = [(0.25_dp*real(k, dp), k=4, 12), PI, (0.25_dp*real(k, dp), k=13, 28)]
    call create_file('bed_length.csv', 1, file)
    write (file, '(a)') 'length,contact/length,exact,depth of the ends,exact,of the middle,exact,moment,exact'
    print '(a)', 'length   contact/length  exact    ends  exact   middle   exact   moment   exact'
    do k = 1, size(lengths)
      length = lengths(k)
      call press(length, solution, x)
      found = bending_of(length, solution, x)
      exact = exact_bending(length)
      write (file, '(es14.7,8('','',es14.7))') length, 2.0_dp*found%contact/length, 2.0_dp*exact%contact/length, &
        found%end_depth, exact%end_depth, found%middle_depth, exact%middle_depth, found%moment, exact%moment
      print '(f6.2,f15.4,f9.4,f8.4,f7.4,2f9.5,2f9.5)', length, 2.0_dp*found%contact/length, &
        2.0_dp*exact%contact/length, found%end_depth, exact%end_depth, found%middle_depth, exact%middle_depth, &
        found%moment, exact%moment
      call known%compare(2.0_dp*(found%contact - exact%contact)/length, 1.0_dp/real(POINTS - 1, dp), 'contact')
      call known%compare(found%end_depth/exact%end_depth - 1.0_dp, ALLOWED, 'depth of the ends')
      call known%compare((found%middle_depth - exact%middle_depth)/exact%end_depth, ALLOWED, 'depth of the middle')
      call known%compare(found%moment/exact%moment - 1.0_dp, ALLOWED, 'moment')
    end do
    close (file)
  end subroutine all_lengths

  !> The shapes of a beam that rests on the bed, of one that is about to lift off, and of one that has.
  subroutine write_shapes()
    real(dp), parameter :: LENGTHS(3) = [2.0_dp, PI, 5.0_dp]
    type(fuge_solution) :: solution
    real(dp) :: x(POINTS)
    integer :: file, j, k

    call create_file('bed_shape.csv', 1, file)
    write (file, '(a)') 'length,x,depth'
    do j = 1, size(LENGTHS)
      call press(LENGTHS(j), solution, x)
      do k = 1, POINTS, 4
        write (file, '(es14.7,2('','',es14.7))') LENGTHS(j), x(k) - 0.5_dp*LENGTHS(j), depth(LENGTHS(j), solution, k)
      end do
    end do
    close (file)
  end subroutine write_shapes

  !> A bed whose strength has a limit, as soil has: the forces are as large as the bed can carry at most.
  subroutine limit_strength(known)
    type(verdict), intent(inout) :: known
    real(dp), parameter :: LENGTH = 3.0_dp, STRENGTHS(4) = [2.0_dp, 1.2_dp, 0.9_dp, 0.7_dp]
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    real(dp) :: x(POINTS), weight(POINTS)
    integer :: file, j, k, limited

    weight = weights(LENGTH)
    call create_file('bed_limit.csv', 1, file)
    write (file, '(a)') 'strength,x,pressure'
    print '(/,a)', 'strength   points at the limit   depth of the ends'
    do j = 1, size(STRENGTHS)
      call press(LENGTH, solution, x, STRENGTHS(j), info)
      limited = count(solution%state == FUGE_LIMITED_LOWER)
      print '(f8.2,i15,f25.4)', STRENGTHS(j), limited, &
        solution%force(1)/weight(1) - solution%gap(1)
      do k = 1, POINTS, 2
        write (file, '(es14.7,2('','',es14.7))') STRENGTHS(j), x(k) - 0.5_dp*LENGTH, solution%force(k)/weight(k)
      end do
      call known%compare(sum(solution%force) - 2.0_dp, 1.0e-12_dp, 'equilibrium')
      call known%hold(all(solution%force <= STRENGTHS(j)*weight*(1.0_dp + 1.0e-12_dp)), 'the strength is not exceeded')
    end do
    close (file)
    ! The strength times the length is all that the bed carries.
    call press(LENGTH, solution, x, 1.999_dp/LENGTH, info)
    call known%hold(info%status == FUGE_ERR_NO_EQUILIBRIUM, 'a load beyond the strength is refused')
    print '(a)', trim(info%message)
  end subroutine limit_strength

  !> The shares of the points in the length.
  pure function weights(length) result(weight)
    real(dp), intent(in) :: length
    real(dp) :: weight(POINTS)

    weight = length/real(POINTS - 1, dp)
    weight([1, POINTS]) = 0.5_dp*weight([1, POINTS])
  end function weights

  !> The contact of a beam of this `length` at `x` (POINTS); `strength` of the bed, force per length, unlimited without
  !> it. Without `info` the program stops where there is no solution.
  subroutine press(length, solution, x, strength, info)
    real(dp), intent(in) :: length
    type(fuge_solution), intent(inout) :: solution
    real(dp), intent(out) :: x(:)
    real(dp), intent(in), optional :: strength
    type(fuge_info), intent(out), optional :: info
    real(dp), allocatable, target :: alpha(:, :)
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    type(fuge_info) :: report
    integer :: j, k

    x = [(length*real(k - 1, dp)/real(POINTS - 1, dp), k=1, POINTS)]
    allocate (alpha(POINTS, POINTS))
    ! A unit force bends a beam of EI = 1/4 by |x - x_j|**3/3, but for rigid motions, which are the modes.
    do j = 1, POINTS
      alpha(:, j) = [(abs(x(k) - x(j))**3/3.0_dp, k=1, POINTS)]
    end do
    call operator%set(alpha, report)
    if (report%failed()) error stop 'no influence matrix'
    ! The forces at the ends press towards the bed, against the contact forces.
    problem%gap = -(alpha(:, 1) + alpha(:, POINTS))
    problem%compliance = 1.0_dp/weights(length)
    if (present(strength)) problem%limit = strength*weights(length)
    problem%modes = reshape([[(1.0_dp, k=1, POINTS)], x - 0.5_dp*length], [POINTS, 2])
    problem%resultant = [2.0_dp, 0.0_dp]
    call solver%solve(operator, problem, solution, report)
    if (present(info)) then
      info = report
    else if (report%status /= 0) then
      error stop 'no solution'
    end if
  end subroutine press

  !> How deep the bed is pressed in at point `k`; above it the gap, negative.
  pure function depth(length, solution, k)
    real(dp), intent(in) :: length
    type(fuge_solution), intent(in) :: solution
    integer, intent(in) :: k
    real(dp) :: depth
    real(dp) :: weight(POINTS)

    weight = weights(length)
    depth = solution%force(k)/weight(k) - solution%gap(k)
  end function depth

  pure function bending_of(length, solution, x) result(found)
    real(dp), intent(in) :: length
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: x(:)
    type(bending) :: found
    integer, parameter :: MIDDLE = (POINTS + 1)/2
    integer :: touching

    touching = count(solution%force(:MIDDLE) > 0.0_dp)
    found%contact = 0.5_dp*length
    if (touching < MIDDLE) found%contact = (real(touching, dp) - 0.5_dp)*length/real(POINTS - 1, dp)
    found%end_depth = depth(length, solution, 1)
    found%middle_depth = depth(length, solution, MIDDLE)
    ! That of the bed, to the left of the middle, less that of the force.
    found%moment = 0.5_dp*length - sum(solution%force(:MIDDLE - 1)*(0.5_dp*length - x(:MIDDLE - 1)))
  end function bending_of

  !> Closed forms, with full contact or lifted off.
  pure function exact_bending(length) result(exact)
    real(dp), intent(in) :: length
    type(bending) :: exact
    real(dp) :: above, below, middle
    integer :: k

    if (length <= PI) then
      exact = on_the_bed(length)
      return
    end if
    ! The shorter the contact, the longer the beam.
    below = 0.1_dp
    above = 0.5_dp*PI
    do k = 1, 60
      middle = 0.5_dp*(below + above)
      if (length_of(middle) < length) then
        above = middle
      else
        below = middle
      end if
    end do
    exact = lifted_off(middle)
  end function exact_bending

  pure function on_the_bed(length) result(exact)
    real(dp), intent(in) :: length
    type(bending) :: exact
    real(dp) :: below

    below = sinh(length) + sin(length)
    exact%contact = 0.5_dp*length
    exact%end_depth = 2.0_dp*(cosh(length) + cos(length))/below
    exact%middle_depth = 4.0_dp*cosh(0.5_dp*length)*cos(0.5_dp*length)/below
    exact%moment = 2.0_dp*sinh(0.5_dp*length)*sin(0.5_dp*length)/below
  end function on_the_bed

  !> The length of a beam that touches over `contact` at each end. A beam whose ends alone would touch has none.
  pure function length_of(contact) result(length)
    real(dp), intent(in) :: contact
    real(dp) :: length
    real(dp) :: shape(0:2)

    shape = shape_at(contact)
    length = huge(length)
    if (shape(2) > 0.0_dp .and. shape(1) < 0.0_dp) length = 2.0_dp*(contact - shape(1)/shape(2))
  end function length_of

  pure function lifted_off(contact) result(exact)
    real(dp), intent(in) :: contact
    type(bending) :: exact
    real(dp) :: free, shape(0:2)

    shape = shape_at(contact)
    exact%contact = contact
    exact%end_depth = shape(0)
    ! Between the contacts the moment is constant, and the slope falls to zero in the middle.
    free = -shape(1)/shape(2)
    exact%middle_depth = 0.5_dp*shape(1)*free
    exact%moment = 0.25_dp*shape(2)
  end function lifted_off

  !> Of a beam that lifts off after the length b: the depth of its end, and slope and curvature at b, where depth and
  !> shear force are zero. By the functions of A. N. Krylov, each of which is the derivative of the next.
  pure function shape_at(b) result(shape)
    real(dp), intent(in) :: b
    real(dp) :: shape(0:2)
    real(dp) :: y(4), depth, determinant, slope

    y = [cosh(b)*cos(b), 0.5_dp*(cosh(b)*sin(b) + sinh(b)*cos(b)), 0.5_dp*sinh(b)*sin(b), &
         0.25_dp*(cosh(b)*sin(b) - sinh(b)*cos(b))]
    ! depth y_1 + slope y_2 + 4 y_4 = 0 and depth y_2 + slope y_3 = y_1.
    determinant = y(1)*y(3) - y(2)**2
    depth = (-4.0_dp*y(4)*y(3) - y(1)*y(2))/determinant
    slope = (y(1)**2 + 4.0_dp*y(4)*y(2))/determinant
    shape(0) = depth
    shape(1) = -4.0_dp*depth*y(4) + slope*y(1) + 4.0_dp*y(3)
    shape(2) = -4.0_dp*depth*y(3) - 4.0_dp*slope*y(4) + 4.0_dp*y(2)
  end function shape_at

end program bed
