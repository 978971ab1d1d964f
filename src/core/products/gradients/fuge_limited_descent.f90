!> Projected gradients for forces with limits, where exchanges of points stop making progress.
!>
!> Where nearly all points are open or at their limit, those between are few, and exchanges of points overshoot; the
!> energy falls all the same. Each step goes along the gaps, is projected on the
!> forces within their limits that have the load, and ends at the least energy on its way (spectral projected gradients:
!> E. G. Birgin, J. M. Martinez, M. Raydan, SIAM Journal on Optimization 10, 2000, with the exact step of a quadratic
!> energy; the step along the gaps is that of J. Barzilai and J. M. Borwein).
module fuge_limited_descent
  use fuge_contact_displacement, only: compute_displacement
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_iteration_progress, only: tell_progress
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor
  use fuge_operator_type, only: fuge_operator
  use fuge_point_space, only: point_space
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: descend_within_limits

  !> Steps at most, each with one product.
  integer, parameter :: STEPS = 1000
  !> The monitor hears of every so many steps.
  integer, parameter :: REPORTED = 10
  !> The sets are settled when at most this fraction of the points has changed its state in each of so many steps.
  real(dp), parameter :: FEW = 1.0e-4_dp
  integer, parameter :: SETTLED = 20
  !> Forces this near to zero or to their limits, as fractions of these, are there; and the error of the load after a
  !> projection, as its fraction.
  real(dp), parameter :: ROUNDING = 1.0e-12_dp, LOAD_ROUNDING = 1.0e-14_dp
  !> Forces before a projection, below zero, as multiples of the load: none so far below gets one.
  real(dp), parameter :: FARTHEST = 1.0e6_dp
  !> Shifts tried for a projection; bisection alone needs about half of them.
  integer, parameter :: SHIFTS = 100

contains

  !> Lower the energy of the forces of `iterate`, feasible, with their displacements; the scene fits a window. Errors:
  !> FUGE_ERR_MEMORY, FUGE_ERR_CANCELLED, those of the operator.
  subroutine descend_within_limits(operator, scene, monitor, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in) :: scene
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: direction(:), change(:), most(:)
    real(dp) :: curvature, length, load, share, slope, sums(3)
    integer :: changed, n, quiet, stat, step

    n = size(scene%gap)
    allocate (direction(n), change(n), most(n), stat=stat)
    call require_memory(stat, 'projected gradients of', n, 'points', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    most = scene%limit
    load = scene%rows%total(sum(iterate%force))
    length = scene%rows%largest(maxval(abs(iterate%force))) &
             /max(scene%rows%largest(maxval(abs(iterate%displacement))), tiny(length))
    quiet = 0
    do step = 1, STEPS
      ! The gradient of the energy but for the motion, which the projection takes out.
      direction = iterate%force - length*(scene%gap + iterate%displacement)
      if (scene%prescribed) then
        direction = min(max(direction, 0.0_dp), most)
      else
        ! So that sums of forces and shifts do not overflow.
        direction = max(direction, -FARTHEST*load)
        call project_on_load(scene%rows%point_space, load, most, direction)
      end if
      changed = scene%rows%total_count(count((direction > 0.0_dp .neqv. iterate%force > 0.0_dp) .or. &
                                             (direction >= most .neqv. iterate%force >= most)))
      direction = direction - iterate%force
      call compute_displacement(operator, scene%counts_datum(), direction, change, info)
      if (info%failed()) return
      sums = [dot_product(direction, scene%gap + iterate%displacement), dot_product(direction, change), &
              dot_product(direction, direction)]
      call scene%rows%add(sums)
      slope = -sums(1)
      curvature = sums(2)
      if (.not. (slope > 0.0_dp .and. curvature > 0.0_dp)) exit
      share = min(slope/curvature, 1.0_dp)
      iterate%force = iterate%force + share*direction
      iterate%displacement = iterate%displacement + share*change
      if (mod(step, REPORTED) == 0) call tell_progress(scene, iterate, monitor, info)
      if (info%failed()) return
      length = sums(3)/curvature
      quiet = merge(quiet + 1, 0, real(changed, dp) <= FEW*real(scene%points(), dp))
      if (quiet >= SETTLED) exit
    end do
    ! Steps leave forces beside their limits by rounding.
    where (iterate%force >= (1.0_dp - ROUNDING)*most) iterate%force = most
    where (iterate%force <= ROUNDING*min(most, load)) iterate%force = 0.0_dp
  end subroutine descend_within_limits

  !> The nearest `forces` (n) within 0 .. `most` (n) whose sum is `load`: all are shifted alike, and cut. `space` may
  !> share the points.
  subroutine project_on_load(space, load, most, forces)
    type(point_space), intent(in) :: space
    real(dp), intent(in) :: load, most(:)
    real(dp), intent(inout) :: forces(:)
    real(dp) :: least, greatest, shift, total, slope, sums(2)
    integer :: k, step

    least = -space%largest(maxval(forces))
    greatest = space%largest(maxval(min(most, load) - forces))
    shift = min(max(0.0_dp, least), greatest)
    do step = 1, SHIFTS
      sums = 0.0_dp
      do k = 1, size(forces)
        sums(1) = sums(1) + min(max(forces(k) + shift, 0.0_dp), most(k))
        if (forces(k) + shift > 0.0_dp .and. forces(k) + shift < most(k)) sums(2) = sums(2) + 1.0_dp
      end do
      call space%add(sums)
      total = sums(1)
      slope = sums(2)
      if (abs(total - load) <= LOAD_ROUNDING*load) exit
      if (total < load) least = max(least, shift)
      if (total > load) greatest = min(greatest, shift)
      if (.not. greatest > least) exit
      if (slope > 0.0_dp) then
        shift = shift + (load - total)/slope
        if (.not. (shift > least .and. shift < greatest)) shift = 0.5_dp*(least + greatest)
      else
        shift = 0.5_dp*(least + greatest)
      end if
    end do
    forces = min(max(forces + shift, 0.0_dp), most)
  end subroutine project_on_load

end module fuge_limited_descent
