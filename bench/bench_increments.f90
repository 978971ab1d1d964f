!> The load in increments, as finite element programs apply it: each begins with the contact set of the last one, and
!> changes the states of points until forces and gaps agree with them.
!>
!> Of a set A f + a = v on its points and the sum of f = F are solved: with a matrix by a Cholesky factor of its block
!> for each set, with products by conjugate gradients from the forces before. All points whose state is wrong change it
!> at once; where that does not get better, the worst one alone.
module bench_increments
  use bench_lapack, only: dpotrf, dpotrs, dsymv
  use fuge, only: dp => fuge_dp, fuge_operator
  implicit none
  private

  !> Wrong are forces below this part of the largest one, and gaps below this part of the largest change of a gap.
  real(dp), parameter :: NOTHING = 1.0e-12_dp, NOTHING_BY_PRODUCTS = 1.0e-8_dp
  !> Sets in an increment that may have no fewer wrong points than the best one before.
  integer, parameter :: PATIENCE = 5
  !> Conjugate gradients: residual over the range of the displacements, in an increment and in the last one.
  real(dp), parameter :: LOOSE = 1.0e-8_dp, TIGHT = 1.0e-11_dp
  integer, parameter :: MOST_STEPS = 2000

  !> A load history: what is solved, the present set, and what it has cost. Give gap, load, and alpha or operator.
  type, public :: load_history
    real(dp), allocatable :: gap(:)
    real(dp) :: load = 0.0_dp
    real(dp), pointer :: alpha(:, :) => null()
    class(fuge_operator), pointer :: operator => null()
    !> Sets that each increment may have; 0: as many as it needs.
    integer :: most_sets = 0
    integer :: sets = 0, products = 0
    logical, allocatable :: contact(:)
    real(dp), allocatable :: force(:)
  contains
    procedure :: apply_in
  end type load_history

contains

  !> Apply the load in as many equal `increments`.
  subroutine apply_in(self, increments)
    class(load_history), intent(inout) :: self
    integer, intent(in) :: increments
    integer :: k, n

    n = size(self%gap)
    self%contact = self%gap <= minval(self%gap)
    if (allocated(self%force)) deallocate (self%force)
    allocate (self%force(n), source=0.0_dp)
    self%sets = 0
    self%products = 0
    do k = 1, increments
      call find_set(self, self%load*real(k, dp)/real(increments, dp), merge(TIGHT, LOOSE, k == increments))
    end do
  end subroutine apply_in

  !> Forces under the load so far, from the present set on.
  subroutine find_set(self, load, tolerance)
    type(load_history), intent(inout) :: self
    real(dp), intent(in) :: load, tolerance
    real(dp) :: gap(size(self%gap))
    logical :: wrong(size(self%gap))
    integer :: fewest, found, patience_left, rounds

    gap = 0.0_dp
    fewest = huge(fewest)
    patience_left = PATIENCE
    rounds = 0
    do
      rounds = rounds + 1
      self%sets = self%sets + 1
      if (associated(self%alpha)) then
        call solve_by_factor(self, load, gap)
      else
        call solve_by_gradients(self, load, tolerance, gap)
      end if
      wrong = wrong_points(self, gap)
      found = count(wrong)
      if (found == 0) exit
      if (found < fewest) then
        fewest = found
        patience_left = PATIENCE
      else
        patience_left = patience_left - 1
      end if
      if (patience_left < 0) call keep_worst(self, gap, wrong)
      self%contact = self%contact .neqv. wrong
      if (rounds == self%most_sets) exit
    end do
  end subroutine find_set

  !> In contact under tension, or open and penetrated.
  function wrong_points(self, gap) result(wrong)
    type(load_history), intent(in) :: self
    real(dp), intent(in) :: gap(:)
    logical :: wrong(size(gap))
    real(dp) :: part

    part = merge(NOTHING, NOTHING_BY_PRODUCTS, associated(self%alpha))
    wrong = merge(self%force < -part*maxval(self%force), gap < -part*maxval(abs(gap - self%gap)), self%contact)
    ! The last point stays.
    if (count(self%contact .and. .not. wrong) == 0 .and. .not. any(wrong .and. .not. self%contact)) wrong = .false.
  end function wrong_points

  subroutine keep_worst(self, gap, wrong)
    type(load_history), intent(in) :: self
    real(dp), intent(in) :: gap(:)
    logical, intent(inout) :: wrong(:)
    integer :: worst

    worst = maxloc(merge(-self%force/maxval(self%force), -gap/maxval(abs(gap)), self%contact), dim=1, mask=wrong)
    wrong = .false.
    wrong(worst) = .true.
  end subroutine keep_worst

  !> `force` and `gap` of the set by a factor of its block.
  subroutine solve_by_factor(self, load, gap)
    type(load_history), intent(inout) :: self
    real(dp), intent(in) :: load
    real(dp), intent(inout) :: gap(:)
    real(dp), allocatable :: block(:, :), right(:, :)
    integer, allocatable :: set(:)
    real(dp) :: approach
    integer :: info, j, k, m, n

    n = size(gap)
    set = pack([(k, k=1, n)], self%contact)
    m = size(set)
    allocate (block(m, m), right(m, 2))
    do j = 1, m
      block(j:, j) = self%alpha(set(j:), set(j))
    end do
    right(:, 1) = self%gap(set)
    right(:, 2) = 1.0_dp
    call dpotrf('L', m, block, m, info)
    if (info /= 0) error stop 'the contact block is not positive definite'
    call dpotrs('L', m, 2, block, m, right, m, info)
    approach = (load + sum(right(:, 1)))/sum(right(:, 2))
    self%force = 0.0_dp
    self%force(set) = approach*right(:, 2) - right(:, 1)
    gap = self%gap
    call dsymv('L', n, 1.0_dp, self%alpha, n, self%force, 1, 1.0_dp, gap, 1)
    gap = gap - approach
    self%products = self%products + 1
  end subroutine solve_by_factor

  !> The same by conjugate gradients that keep the sum of the forces.
  subroutine solve_by_gradients(self, load, tolerance, gap)
    type(load_history), intent(inout) :: self
    real(dp), intent(in) :: load, tolerance
    real(dp), intent(inout) :: gap(:)
    real(dp), allocatable :: change(:), direction(:), of_one(:), residual(:), response(:), step(:)
    real(dp) :: decrease, decrease_before, length
    integer :: k, n, points

    n = size(gap)
    points = count(self%contact)
    allocate (change(n), direction(n), of_one(n), residual(n), response(n), step(n), source=0.0_dp)
    where (.not. self%contact) self%force = 0.0_dp
    where (self%contact) self%force = self%force + (load - sum(self%force))/points
    call multiply(self, self%force, response)
    residual = -(self%gap + response)
    call precondition(self, merge(1.0_dp, 0.0_dp, self%contact), of_one)
    decrease_before = 1.0_dp
    do k = 1, MOST_STEPS
      call center(self%contact, residual)
      if (maxval(abs(residual)) <= tolerance*(maxval(response) - minval(response))) exit
      call precondition(self, residual, change)
      change = change - sum(change)/sum(of_one)*of_one
      decrease = sum(residual*change)
      direction = change + merge(decrease/decrease_before, 0.0_dp, k > 1)*direction
      call multiply(self, direction, step)
      length = decrease/sum(direction*step)
      self%force = self%force + length*direction
      response = response + length*step
      residual = residual - length*step
      decrease_before = decrease
    end do
    gap = self%gap + response
    gap = gap - sum(gap, mask=self%contact)/points
  end subroutine solve_by_gradients

  !> Nothing beyond the set; in it, less the mean.
  pure subroutine center(contact, residual)
    logical, intent(in) :: contact(:)
    real(dp), intent(inout) :: residual(:)
    real(dp) :: mean

    mean = sum(residual, mask=contact)/count(contact)
    residual = merge(residual - mean, 0.0_dp, contact)
  end subroutine center

  subroutine multiply(self, force, displacement)
    type(load_history), intent(inout) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer :: status

    call self%operator%apply(force, displacement, status)
    if (status /= 0) error stop 'no product'
    self%products = self%products + 1
  end subroutine multiply

  subroutine precondition(self, displacement, force)
    type(load_history), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer :: status

    call self%operator%precondition(displacement, force, status)
    if (status /= 0) error stop 'no preconditioning'
    where (.not. self%contact) force = 0.0_dp
  end subroutine precondition

end module bench_increments
