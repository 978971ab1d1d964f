!> The state of a search in single precision: what it needs besides forces and contact, and how exact that is.
module fuge_single_state
  use fuge_contact_iterate, only: contact_iterate, relative_error
  use fuge_contact_scene, only: contact_scene
  use fuge_kinds, only: dp, sp
  use fuge_operator_products, only: multiply, multiply_single
  use fuge_operator_type, only: fuge_operator
  use fuge_single_passes, only: add_moves, point_pass, scale_forces, settle_distances, start_distances, &
    sum_contact_forces, sum_gaps, take_displacements
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: mean_in_contact, move_forces, refresh, restore_sum, start_displacements

  !> Products in single precision have errors of this fraction of their largest result.
  real(dp), parameter, public :: SINGLE_ERROR = 5.0e-7_dp

  !> Distances are computed anew at most this often, until the motion is known to all digits.
  integer, parameter :: MOST_ATTEMPTS = 4

  type, public :: single_state
    !> Distances from the stop, (n): gaps and displacements less the motion, plus `offset`. Those in the contact are the
    !> residuals, (n), zero off it.
    real(sp), allocatable :: distance(:), residual(:)
    real(dp) :: offset = 0.0_dp
    !> Search direction; what the last product gave; forces that displace all points of the contact almost equally; (n).
    real(sp), allocatable :: direction(:), work(:), uniform(:)
    !> The distances may have this error.
    real(dp) :: drift = 0.0_dp
    !> The largest magnitude of a displacement, as the last whole product gave it.
    real(dp) :: largest = 0.0_dp
    !> The largest tension.
    real(dp) :: tension = 0.0_dp
    !> A product has given what is not a number; maxima do not show it.
    logical :: is_lost = .false.
    !> The displacements of the iterate are those of its forces, from a product in double precision.
    logical :: is_exact = .false.
  contains
    procedure :: start
    procedure :: point_to
  end type single_state

contains

  !> Allocate all arrays for `n` points. Error: FUGE_ERR_MEMORY.
  subroutine start(self, n, info)
    class(single_state), intent(inout) :: self
    integer, intent(in) :: n
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (self%distance(n), self%residual(n), self%direction(n), self%work(n), self%uniform(n), stat=stat)
    call require_memory(stat, 'the work space of', n, 'points', info)
  end subroutine start

  !> Point a pass to the arrays, none of which may be moved while it is in use.
  subroutine point_to(self, scene, iterate, pass)
    class(single_state), intent(in), target :: self
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(in), target :: iterate
    type(point_pass), intent(inout) :: pass

    pass%gap => scene%gap
    pass%force => iterate%force
    pass%displacement => iterate%displacement
    pass%contact => iterate%contact
    pass%segments => iterate%segments
    pass%distance => self%distance
    pass%residual => self%residual
    pass%direction => self%direction
    pass%work => self%work
    pass%uniform => self%uniform
    pass%motion = iterate%motion
  end subroutine point_to

  !> Distances of the forces to start from. Errors: those of the operator, FUGE_ERR_MEMORY.
  subroutine start_displacements(operator, scene, state, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass

    state%direction = real(iterate%force, sp)
    call multiply_single(operator, state%direction, state%work, info)
    if (.not. info%failed()) call iterate%segments%find(iterate%contact, info)
    if (info%failed()) return
    call state%point_to(scene, iterate, pass)
    call pass%go(sum_gaps, 2)
    state%is_lost = .not. abs(pass%total(1)) <= huge(1.0_dp)
    if (state%is_lost) return
    state%largest = pass%largest(2)
    state%drift = SINGLE_ERROR*state%largest
    iterate%motion = mean_in_contact(iterate, pass%total(1))
    pass%motion = iterate%motion
    call pass%go(start_distances, 0)
    call settle(operator, scene, 0.0_dp, state, iterate)
  end subroutine start_displacements

  !> Distances of forces that have changed by state%direction, and of a new contact. Errors: those of the operator,
  !> FUGE_ERR_MEMORY.
  subroutine move_forces(operator, scene, state, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass

    state%is_exact = .false.
    call multiply_single(operator, state%direction, state%work, info)
    if (.not. info%failed()) call iterate%segments%find(iterate%contact, info)
    if (info%failed()) return
    call state%point_to(scene, iterate, pass)
    call pass%go(add_moves, 2)
    state%is_lost = .not. abs(pass%total(1)) <= huge(1.0_dp)
    if (state%is_lost) return
    state%drift = state%drift + SINGLE_ERROR*pass%largest(2)
    call settle(operator, scene, mean_in_contact(iterate, pass%total(1)), state, iterate)
  end subroutine move_forces

  !> The mean of distances over the contact, where they have the sum `total`: what a free translation takes up.
  elemental function mean_in_contact(iterate, total) result(mean)
    type(contact_iterate), intent(in) :: iterate
    real(dp), intent(in) :: total
    real(dp) :: mean

    mean = 0.0_dp
    if (.not. iterate%prescribed) mean = total/real(iterate%segments%points, dp)
  end function mean_in_contact

  !> Forces of sum 1, from which steps in single precision lead away by rounding, unless the motion is prescribed.
  subroutine restore_sum(scene, state, iterate)
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(in), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass

    if (scene%prescribed) return
    call state%point_to(scene, iterate, pass)
    call pass%go(sum_contact_forces, 1)
    if (.not. abs(pass%total(1) - 1.0_dp) < 0.01_dp) return
    pass%factor = 1.0_dp/pass%total(1)
    call pass%go(scale_forces, 0)
  end subroutine restore_sum

  !> Distances by a product in double precision, unless `multiplied`: then the iterate has its displacements. Errors:
  !> those of the operator, FUGE_ERR_MEMORY.
  subroutine refresh(operator, scene, multiplied, state, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    logical, intent(in) :: multiplied
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass
    real(dp) :: mean
    integer :: attempt

    if (.not. multiplied) call multiply(operator, iterate%force, iterate%displacement, info)
    if (.not. info%failed()) call iterate%segments%find(iterate%contact, info)
    if (info%failed()) return
    state%is_exact = .true.
    do attempt = 1, MOST_ATTEMPTS
      state%drift = 0.0_dp
      state%offset = 0.0_dp
      call state%point_to(scene, iterate, pass)
      call pass%go(take_displacements, 2)
      state%largest = pass%largest(2)
      mean = mean_in_contact(iterate, pass%total(1))
      call settle(operator, scene, mean, state, iterate)
      ! Distances from another motion were rounded as far as it was off.
      if (abs(mean) <= iterate%residual_norm) exit
    end do
  end subroutine refresh

  !> Residuals, penetration and least magnitude, where the mean distance in the contact is `mean`.
  subroutine settle(operator, scene, mean, state, iterate)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: mean
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass

    iterate%motion = iterate%motion + (mean - state%offset)
    state%offset = 0.0_dp
    call state%point_to(scene, iterate, pass)
    pass%shift = mean
    call pass%go(settle_distances, 3)
    iterate%residual_norm = pass%largest(1)
    iterate%penetration = pass%largest(2)
    iterate%largest_magnitude = operator%common_magnitude(state%largest, 1.0_dp)
    iterate%least_magnitude = 0.0_dp
    if (iterate%segments%points > 0) iterate%least_magnitude = iterate%largest_magnitude - pass%largest(3)
    ! Distances are rounded as long as they are large.
    state%drift = state%drift + epsilon(1.0_sp)*(abs(mean) + iterate%residual_norm)
    if (iterate%start_error < 0.0_dp) iterate%start_error = relative_error(iterate)
  end subroutine settle

end module fuge_single_state
