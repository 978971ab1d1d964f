!> The state of a search in single precision: what it needs besides forces and contact, and how exact that is.
module fuge_single_state
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_feasible_forces, only: keep_resultants
  use fuge_kinds, only: dp, sp
  use fuge_least_magnitude, only: RIGID_ROUNDINGS
  use fuge_operator_products, only: multiply, multiply_single
  use fuge_operator_type, only: fuge_operator
  use fuge_single_passes, only: add_moves, move_rigidly, note_basis, point_pass, scale_forces, settle_distances, &
    start_distances, sum_contact_forces, sum_direction, sum_gaps, take_displacements
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: components, given_way, move_by, move_forces, refresh, restore_sum, start_displacements

  !> Products in single precision have errors of this fraction of their largest result.
  real(dp), parameter, public :: SINGLE_ERROR = 5.0e-7_dp

  !> Distances are computed anew at most this often, until the motion is known to all digits.
  integer, parameter :: MOST_ATTEMPTS = 4

  type, public :: single_state
    !> Distances from the stop, (n): gaps and displacements less the motion, plus `offset`. Those in the contact are the
    !> residuals, (n), zero off it.
    real(sp), allocatable :: distance(:), residual(:)
    !> Of each free rigid motion.
    real(dp), allocatable :: offset(:)
    !> Search direction; what the last product gave, (n).
    real(sp), allocatable :: direction(:), work(:)
    !> Forces that displace the points of the contact almost as each free rigid motion does, (n, columns), and with
    !> modes these motions, orthonormal on the contact.
    real(sp), allocatable :: images(:, :), basis(:, :)
    !> Number of free rigid motions that the contact resists, and of the columns that passes go over, one at least.
    integer :: motions = 1, columns = 1
    !> The largest element of the basis.
    real(dp) :: peak = 1.0_dp
    !> Where points may have two stops or forces limits: the stop of each point from which its distance counts, and the
    !> range of its force in contact, else of its distance, (n).
    real(dp), allocatable :: stop(:)
    real(sp), allocatable :: least(:), most(:)
    !> The distances may have this error.
    real(dp) :: drift = 0.0_dp
    !> The largest magnitude of a displacement, as the last whole product gave it.
    real(dp) :: largest = 0.0_dp
    !> All points displace each other by so much per force, on a spring that is a part of the operator; 0: none.
    real(dp) :: flexibility = 0.0_dp
    !> The sum of the magnitudes of the forces.
    real(dp) :: total = 1.0_dp
    !> A product has given what is not a number; maxima do not show it.
    logical :: is_lost = .false.
    !> The displacements of the iterate are those of its forces, from a product in double precision.
    logical :: is_exact = .false.
  contains
    procedure :: start
    procedure :: take_basis
    procedure :: note_total
    procedure :: point_to
  end type single_state

contains

  !> Allocate all arrays for the points of `scene`. Error: FUGE_ERR_MEMORY.
  subroutine start(self, scene, info)
    class(single_state), intent(inout) :: self
    type(contact_scene), intent(in) :: scene
    type(fuge_info), intent(inout) :: info
    integer :: n, stat

    n = size(scene%gap)
    self%motions = merge(0, 1, scene%prescribed)
    self%columns = 1
    if (allocated(scene%modes)) self%columns = max(size(scene%load), 1)
    self%offset = spread(0.0_dp, 1, self%columns)
    allocate (self%distance(n), self%residual(n), self%direction(n), self%work(n), self%images(n, self%columns), &
              stat=stat)
    if (stat == 0 .and. allocated(scene%modes)) allocate (self%basis(n, self%columns), stat=stat)
    if (stat == 0 .and. allocated(scene%play)) allocate (self%stop(n), self%least(n), self%most(n), stat=stat)
    call require_memory(stat, 'the work space of', n, 'points', info)
    call scene%rows%agree(info)
    if (info%failed()) return
    if (allocated(self%basis)) self%basis = 0.0_sp
    if (.not. allocated(self%stop)) return
    self%stop = 0.0_dp
    self%distance = 0.0_sp
  end subroutine start

  !> The basis of the rigid motions of the contact, iterate%projection. With another number of motions there are no
  !> images.
  subroutine take_basis(self, scene, iterate)
    class(single_state), intent(inout), target :: self
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(in), target :: iterate
    type(point_pass) :: pass
    integer :: i, j

    if (.not. allocated(scene%modes)) return
    self%motions = iterate%projection%rank
    self%columns = max(self%motions, 1)
    self%offset = spread(0.0_dp, 1, self%columns)
    call self%point_to(scene, iterate, pass)
    if (iterate%projection%has_basis) then
      pass%modes => iterate%projection%basis(:, :self%columns)
      pass%coefficients = reshape([((merge(1.0_dp, 0.0_dp, i == j), i=1, self%columns), j=1, self%motions)], &
                                  [self%columns, self%motions])
    else
      pass%modes => scene%modes
      pass%coefficients = iterate%projection%coefficients
    end if
    call pass%go(note_basis, 1, 0)
    self%peak = pass%largest(1)
    if (self%motions == 0) self%basis = 0.0_sp
  end subroutine take_basis

  !> The sum of the forces, where a spring gives way to it.
  subroutine note_total(self, scene, iterate)
    class(single_state), intent(inout), target :: self
    type(contact_scene), intent(in), target :: scene
    type(contact_iterate), intent(in), target :: iterate
    type(point_pass) :: pass

    if (.not. self%flexibility > 0.0_dp) return
    call self%point_to(scene, iterate, pass)
    call pass%go(sum_contact_forces, 0, 1)
    self%total = pass%total(1)
  end subroutine note_total

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
    pass%space = scene%rows%point_space
    pass%distance => self%distance
    pass%residual => self%residual
    pass%direction => self%direction
    pass%work => self%work
    pass%images => self%images(:, :self%columns)
    pass%columns = self%columns
    pass%is_plain = scene%is_simple()
    pass%motion = iterate%motion
    if (.not. allocated(pass%factors)) pass%factors = spread(0.0_dp, 1, self%columns)
    if (allocated(self%basis)) pass%basis => self%basis(:, :self%columns)
    if (allocated(self%stop)) then
      pass%stop => self%stop
      pass%least => self%least
      pass%most => self%most
    end if
  end subroutine point_to

  !> Let a pass subtract the rigid motion with these `motions` in the modes.
  subroutine point_to_modes(scene, motions, pass)
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: motions(:)
    type(point_pass), intent(inout) :: pass

    pass%modes => scene%modes
    pass%motions = motions
  end subroutine point_to_modes

  !> Distances of the forces to start from. Errors: those of the operator, FUGE_ERR_MEMORY.
  subroutine start_displacements(operator, scene, state, iterate, info)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass
    real(dp), allocatable :: none(:)

    state%direction = real(iterate%force, sp)
    call multiply_single(operator, state%direction, state%work, info)
    if (.not. info%failed()) call find_segments(scene, iterate, info)
    if (info%failed()) return
    call state%point_to(scene, iterate, pass)
    call pass%go(sum_gaps, 1, state%columns)
    state%is_lost = .not. abs(pass%total(2)) <= huge(1.0_dp)
    if (state%is_lost) return
    state%largest = pass%largest(1)
    state%drift = SINGLE_ERROR*state%largest
    call move_by(scene, components(state, iterate, pass, 1), iterate)
    pass%motion = iterate%motion
    if (allocated(scene%modes)) call point_to_modes(scene, iterate%rigid_motion, pass)
    call pass%go(start_distances, 0, 0)
    allocate (none(state%motions), source=0.0_dp)
    call settle(operator, scene, none, given_way(scene, .true., state, iterate), state, iterate)
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
    if (.not. info%failed()) call find_segments(scene, iterate, info)
    if (info%failed()) return
    call state%point_to(scene, iterate, pass)
    call pass%go(add_moves, 1, state%columns)
    state%is_lost = .not. abs(pass%total(2)) <= huge(1.0_dp)
    if (state%is_lost) return
    state%drift = state%drift + SINGLE_ERROR*pass%largest(1)
    call settle(operator, scene, components(state, iterate, pass, 1), given_way(scene, .true., state, iterate), state, &
                iterate)
  end subroutine move_forces

  !> The displacement of the spring by the forces state%direction, at `all_points` or in the contact only.
  function given_way(scene, all_points, state, iterate) result(displacement)
    type(contact_scene), intent(in), target :: scene
    logical, intent(in) :: all_points
    type(single_state), intent(in), target :: state
    type(contact_iterate), intent(in), target :: iterate
    real(dp) :: displacement
    type(point_pass) :: pass

    displacement = 0.0_dp
    if (.not. state%flexibility > 0.0_dp) return
    call state%point_to(scene, iterate, pass)
    pass%all_points = all_points
    call pass%go(sum_direction, 0, 1)
    displacement = state%flexibility*pass%total(1)
  end function given_way

  !> The segments of the contact; with modes those for which feasible forces were found. Error: FUGE_ERR_MEMORY.
  subroutine find_segments(scene, iterate, info)
    type(contact_scene), intent(in) :: scene
    type(contact_iterate), intent(inout) :: iterate
    type(fuge_info), intent(inout) :: info

    if (.not. allocated(scene%modes)) call iterate%segments%find(iterate%contact, info)
  end subroutine find_segments

  !> The motions that take up distances in the contact whose components are the totals of `pass` from number
  !> `before` + 1 on: the mean, where one translation is free; (motions).
  pure function components(state, iterate, pass, before)
    type(single_state), intent(in) :: state
    type(contact_iterate), intent(in) :: iterate
    type(point_pass), intent(in) :: pass
    integer, intent(in) :: before
    real(dp) :: components(state%motions)
    integer :: j

    components = [(pass%total(before + j), j=1, state%motions)]
    if (.not. allocated(state%basis)) components = components/real(iterate%segments%points, dp)
  end function components

  !> Add `factors` times the free rigid motions of the contact to the motion.
  pure subroutine move_by(scene, factors, iterate)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in) :: factors(:)
    type(contact_iterate), intent(inout) :: iterate
    real(dp), allocatable :: all_factors(:)

    if (allocated(scene%modes)) then
      allocate (all_factors(size(scene%load)), source=0.0_dp)
      all_factors(:size(factors)) = factors
      iterate%rigid_motion = iterate%rigid_motion + iterate%projection%motion(all_factors)
    else
      iterate%motion = iterate%motion + sum(factors)
    end if
  end subroutine move_by

  !> Forces with the resultants, from which steps in single precision lead away by rounding: with the sum 1, where one
  !> translation is free.
  subroutine restore_sum(scene, state, iterate)
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(in), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass
    real(dp) :: load

    if (allocated(scene%modes)) then
      call keep_resultants(scene, iterate%contact_set)
      return
    end if
    if (scene%prescribed) return
    call state%point_to(scene, iterate, pass)
    call pass%go(sum_contact_forces, 0, 1)
    load = 1.0_dp
    if (scene%has_limits()) load = load - scene%rows%total(sum(iterate%force, mask=.not. iterate%contact))
    if (.not. abs(pass%total(1) - load) < 0.01_dp*load) return
    pass%factor = load/pass%total(1)
    if (scene%has_limits()) then
      where (iterate%contact) iterate%force = pass%factor*iterate%force
    else
      call pass%go(scale_forces, 0, 0)
    end if
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
    real(dp) :: means(state%motions)
    integer :: attempt

    if (.not. multiplied) call multiply(operator, iterate%force, iterate%displacement, info)
    if (.not. info%failed()) call find_segments(scene, iterate, info)
    if (info%failed()) return
    state%is_exact = .true.
    if (allocated(scene%modes)) call take_out_motion(scene, multiplied, state, iterate)
    do attempt = 1, MOST_ATTEMPTS
      state%drift = 0.0_dp
      state%offset = 0.0_dp
      call state%point_to(scene, iterate, pass)
      call pass%go(take_displacements, 1, state%columns)
      if (.not. allocated(scene%modes)) state%largest = pass%largest(1)
      means = components(state, iterate, pass, 1)
      call settle(operator, scene, means, 0.0_dp, state, iterate)
      if (allocated(scene%modes)) call move_displacements(scene, means, state, iterate)
      ! Distances from another motion were rounded as far as it was off.
      if (state%peak*sum(abs(means)) <= iterate%lengths%residual_norm) exit
    end do
  end subroutine refresh

  !> Displacements less the rigid motion, where they are `multiplied` already, or by the product; state%largest is that
  !> of the product.
  subroutine take_out_motion(scene, multiplied, state, iterate)
    type(contact_scene), intent(in), target :: scene
    logical, intent(in) :: multiplied
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass

    call state%point_to(scene, iterate, pass)
    if (multiplied) then
      call point_to_modes(scene, -iterate%rigid_motion, pass)
      call pass%go(move_rigidly, 1, 0)
    end if
    call point_to_modes(scene, iterate%rigid_motion, pass)
    call pass%go(move_rigidly, 1, 0)
    state%largest = pass%largest(1)
  end subroutine take_out_motion

  !> Displacements less `factors` times the free rigid motions of the contact.
  subroutine move_displacements(scene, factors, state, iterate)
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: factors(:)
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass
    real(dp) :: all_factors(size(scene%load))

    all_factors = 0.0_dp
    all_factors(:size(factors)) = factors
    call state%point_to(scene, iterate, pass)
    call point_to_modes(scene, iterate%projection%motion(all_factors), pass)
    call pass%go(move_rigidly, 1, 0)
  end subroutine move_displacements

  !> Residuals, penetration and least magnitude, where distances in the contact have the rigid motion `means`, and all
  !> of them have to grow by `rise`.
  subroutine settle(operator, scene, means, rise, state, iterate)
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    real(dp), intent(in) :: means(:), rise
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(inout), target :: iterate
    type(point_pass) :: pass

    call state%note_total(scene, iterate)
    call move_by(scene, means - state%offset(:size(means)), iterate)
    state%offset = 0.0_dp
    call state%point_to(scene, iterate, pass)
    if (.not. allocated(state%basis)) pass%shift = sum(means) - rise
    pass%factors(:size(means)) = means
    if (allocated(scene%modes)) call point_to_modes(scene, iterate%rigid_motion, pass)
    associate (lengths => iterate%lengths)
      pass%needs_terms = state%is_exact .or. .not. lengths%rounding > 0.0_dp
      call pass%go(settle_distances, 4, 0)
      lengths%residual_norm = pass%largest(1)
      ! Of so few points the rigid motion takes up all distances.
      if (iterate%segments%points <= state%motions) lengths%residual_norm = 0.0_dp
      lengths%penetration = pass%largest(2)
      lengths%largest_magnitude = operator%common_magnitude(state%largest, state%total)
      lengths%least_magnitude = 0.0_dp
      if (iterate%segments%points > 0) lengths%least_magnitude = lengths%largest_magnitude - pass%largest(3)
      pass%needs_terms = pass%needs_terms .and. allocated(scene%modes)
      if (pass%needs_terms) lengths%rounding = RIGID_ROUNDINGS*epsilon(1.0_dp)*pass%largest(4)
      ! Distances are rounded as long as they are large.
      state%drift = state%drift + epsilon(1.0_sp)*(state%peak*sum(abs(means)) + abs(rise) + lengths%residual_norm)
      call lengths%note_start()
    end associate
  end subroutine settle

end module fuge_single_state
