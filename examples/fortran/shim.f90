!> A shim that makes the pressure in a bolted joint even: its thickness at each point, by least squares.
!>
!>     shim [elements along each part, 1, 2, .. [folder for its tables]]
!>
!> The joint of the example `flange`, metal on metal with eight bolts M20: tightened, it has three times the mean
!> pressure around the bolts, and is open in places. A shim of varying thickness lies in the joint; the nut is turned
!> until the mean pressure is what it was, as far as the shim allows. With 78 or 262 parameters, the thickness at each
!> point and the turn of the nut, a step of the fit takes one contact solve.
!>
!> Known: any pressure can be had, by one set of gaps, so a shim that may be of any thickness, or the flange machined to
!> it, makes the pressure even to rounding. A shim between bounds cannot; the further apart they are, the better. The
!> shim is as stiff as the flanges, and does not bend. Then comes an internal pressure, for which the shim was not made.
!> For the picture it writes shim_map.dat.
program shim
  use example_output, only: create_file
  use example_stiffness, only: IS_SPARSE
  use example_verdict, only: verdict
  use flange_model, only: HEAD, JOINT, NUT, UPPER
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_solution
  use profile_fit, only: fit_contact, fit_result, fit_rules, fitted_case
  use shim_field, only: build_joint, neighbour_differences, press, shimmed_joint, want_even_pressure
  implicit none

  !> How much shorter the shank is than both flanges, mm, and an internal pressure, N/mm2.
  real(dp), parameter :: SHORTENING = 0.12_dp, INSIDE = 12.0_dp
  integer, parameter :: NO_SHIM = 1, ANY_SHIM = 2, SHIMS = 4
  character(len=*), parameter :: NAMES(SHIMS) = &
    ['none             ', 'any thickness    ', 'from 0 to 60 um  ', 'from 0 to 30 um  ']
  !> Largest thickness, micrometres; without bounds if it is huge.
  real(dp), parameter :: THICKEST(SHIMS) = [0.0_dp, huge(1.0_dp), 60.0_dp, 30.0_dp]
  !> Of a step of 1 micrometre between neighbours, beside relative errors of the pressure.
  real(dp), parameter :: SMOOTHNESS = 1.0e-3_dp

  type :: shimmed_state
    !> Thickness, micrometres, and pressure over the wanted one at each point of the joint.
    real(dp), allocatable :: thickness(:), pressure(:)
    !> Forces of head and nut for one bolt, N; shares of the joint that are open, tightened and with pressure inside.
    real(dp) :: head = 0.0_dp, nut = 0.0_dp, open = 0.0_dp, open_inside = 0.0_dp
    type(fit_result) :: fit
  end type shimmed_state

  call run()

contains

  subroutine run()
    type(shimmed_joint), target :: joined
    type(fuge_dense_operator) :: operator
    type(fuge_info) :: info
    type(shimmed_state) :: state(SHIMS)
    real(dp) :: wanted
    integer :: k

    call build_joint(elements_given(), SHORTENING, joined, info)
    call require(info)
    call operator%set(joined%model%condensed%alpha, info)
    call require(info)
    call find_mean(joined, operator, wanted)
    print '(a,i0,a,f6.2,a)', 'Tightened joint, ', joined%problem%points(), ' contact points, mean pressure ', wanted, &
      ' N/mm2'
    print '(a,f4.0,a)', 'Open: tightened, and with', INSIDE, ' N/mm2 inside'
    print '(/,2a)', 'shim               thickness [um]   pressure over mean: largest   least   open [%]   inside [%]', &
      '   bolt [kN]   solves   derivatives'
    do k = 1, SHIMS
      call find_shim(joined, operator, wanted, k, state(k))
      print '(a,2f8.1,f29.3,f8.3,f11.1,f13.1,f12.2,i9,i14)', NAMES(k), minval(state(k)%thickness), &
        maxval(state(k)%thickness), maxval(state(k)%pressure), minval(state(k)%pressure), 100.0_dp*state(k)%open, &
        100.0_dp*state(k)%open_inside, 1.0e-3_dp*state(k)%head, state(k)%fit%solves, state(k)%fit%derivatives
    end do
    call write_map(joined, state)
    call check(state)
  end subroutine run

  !> Elements along each part; 1 where they are few.
  integer function elements_given() result(count)
    character(len=32) :: argument
    integer :: status

    count = merge(2, 1, IS_SPARSE)
    call get_command_argument(1, argument)
    if (argument == '') return
    read (argument, *, iostat=status) count
    if (status /= 0 .or. count < 1) error stop 'the number of elements is 1, 2, ..'
  end function elements_given

  !> The mean pressure in the joint without a shim.
  subroutine find_mean(joined, operator, wanted)
    type(shimmed_joint), intent(inout) :: joined
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(out) :: wanted
    type(fuge_solution) :: solution
    type(fuge_info) :: info

    call press(joined, operator, spread(0.0_dp, 1, size(joined%point) + 1), 0.0_dp, solution, info)
    call require(info)
    associate (pairs => joined%model%joined%pairs)
      wanted = sum(solution%force, mask=pairs%pair == JOINT)/sum(pairs%area, mask=pairs%pair == JOINT)
    end associate
  end subroutine find_mean

  !> Find shim number k. The nut may be turned as far as need be.
  subroutine find_shim(joined, operator, wanted, k, state)
    type(shimmed_joint), intent(inout) :: joined
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: wanted
    integer, intent(in) :: k
    type(shimmed_state), intent(out) :: state
    type(fit_rules) :: rules
    type(fitted_case) :: wish(1)
    type(fuge_info) :: info
    real(dp) :: start
    integer :: points

    points = size(joined%point)
    start = 0.0_dp
    if (k /= ANY_SHIM) then
      ! An even shim in the middle of the bounds, as the joint without one.
      start = 0.5_dp*THICKEST(k)
      rules%lower = [spread(0.0_dp, 1, points), -huge(wanted)]
      rules%upper = [spread(THICKEST(k), 1, points), huge(wanted)]
      call neighbour_differences(joined, SMOOTHNESS, rules%smoothness)
    end if
    if (k == NO_SHIM) rules%most_solves = 1
    call want_even_pressure(joined, wanted, wish(1))
    call fit_contact(joined, operator, wish, rules, [spread(start, 1, points), -start], state%fit, info)
    call require(info)
    call set_state(joined, operator, wanted, state)
  end subroutine find_shim

  !> What the table shows.
  subroutine set_state(joined, operator, wanted, state)
    type(shimmed_joint), intent(inout) :: joined
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: wanted
    type(shimmed_state), intent(inout) :: state
    type(fuge_solution) :: loaded
    type(fuge_info) :: info

    call press(joined, operator, state%fit%parameter, INSIDE, loaded, info)
    call require(info)
    associate (pairs => joined%model%joined%pairs, force => state%fit%solution(1)%force)
      state%thickness = state%fit%parameter(:size(joined%point))
      state%pressure = force(joined%point)/(pairs%area(joined%point)*wanted)
      state%head = 2.0_dp*sum(force, mask=pairs%pair == HEAD)
      state%nut = 2.0_dp*sum(force, mask=pairs%pair == NUT)
      associate (area => pairs%area(joined%point))
        state%open = sum(area, mask=.not. state%pressure > 0.0_dp)/sum(area)
        state%open_inside = sum(area, mask=.not. loaded%force(joined%point) > 0.0_dp)/sum(area)
      end associate
    end associate
  end subroutine set_state

  !> Thickness and pressure of all shims, on the faces of the joint: their corners and the middles of their edges.
  subroutine write_map(joined, state)
    type(shimmed_joint), intent(in) :: joined
    type(shimmed_state), intent(in) :: state(:)
    real(dp) :: at_node(2 + 2*size(state), size(joined%model%mesh(UPPER)%node, 2))
    real(dp) :: value(size(at_node, 1), 9)
    integer :: f, file, i, k

    at_node = 0.0_dp
    at_node(:2, :) = joined%model%mesh(UPPER)%node(:2, :)
    associate (node => joined%model%joined%pairs%node(joined%point))
      do k = 1, size(state)
        at_node(2*k + 1, node) = state(k)%thickness
        at_node(2*k + 2, node) = state(k)%pressure
      end do
    end associate
    call create_file('shim_map.dat', 2, file)
    do f = 1, size(joined%model%joint_face, 2)
      value(:, [1, 3, 9, 7, 2, 6, 8, 4]) = at_node(:, joined%model%joint_face(:, f))
      value(:, 5) = 0.5_dp*sum(value(:, [2, 6, 8, 4]), 2) - 0.25_dp*sum(value(:, [1, 3, 9, 7]), 2)
      do i = 1, 9
        write (file, '(*(es14.6))') value(:, i)
        if (modulo(i, 3) == 0) write (file, '()')
      end do
      write (file, '()')
    end do
    close (file)
  end subroutine write_map

  subroutine check(state)
    type(shimmed_state), intent(in) :: state(:)
    type(verdict) :: known
    integer :: k

    call known%compare(state(ANY_SHIM)%pressure - 1.0_dp, 1.0e-6_dp, 'the pressure with a shim of any thickness')
    call known%compare(state(ANY_SHIM)%head/state(NO_SHIM)%head - 1.0_dp, 1.0e-6_dp, 'the force of the bolt')
    do k = 1, size(state)
      call known%hold(abs(state(k)%head/state(k)%nut - 1.0_dp) <= 1.0e-10_dp, 'the equilibrium of the bolt')
      call known%hold(state(k)%fit%solves < 20, 'fewer than 20 solves')
    end do
    do k = ANY_SHIM + 1, size(state)
      call known%hold(all(state(k)%thickness >= 0.0_dp .and. state(k)%thickness <= THICKEST(k)), 'the bounds')
      call known%hold(state(k)%fit%last_sum > state(k - 1)%fit%last_sum, 'a narrower choice, a better shim')
      call known%hold(maxval(state(k)%pressure) < 0.7_dp*maxval(state(NO_SHIM)%pressure), 'a lower pressure')
      call known%hold(minval(state(k)%pressure) > 0.3_dp, 'no place that is hardly pressed')
    end do
    call known%give('as even as can be')
  end subroutine check

  subroutine require(info)
    type(fuge_info), intent(in) :: info

    if (.not. info%failed()) return
    print '(a)', trim(info%message)
    error stop 'the joint was not solved'
  end subroutine require

end program shim
