!> Load steps: forces to start from, extrapolated from the last two solutions, and the judgement whether they are a
!> better start than coarser grids.
!>
!> Along a sequence of resultants or prescribed motions the forces in the contact are smooth. At its edges the gap
!> grows with the power 3/2 of the distance, so that gap**(2/3) is linear in the position of the edge: where it
!> extrapolates to a negative value, the point joins the contact set.
module fuge_warm_start
  use fuge_data_scales, only: is_prescribed
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunked_pass
  use fuge_problem_type, only: fuge_problem, fuge_solution
  use fuge_point_space, only: point_space
  implicit none
  private

  !> Forces are extrapolated by at most this many times the last step.
  real(dp), parameter :: FARTHEST = 3.0_dp
  !> Steps of several resultants or motions are in line if they differ by less than this fraction of their length.
  real(dp), parameter :: IN_LINE = 0.5_dp
  !> The last forces are scaled with the resultants up to this factor, either way.
  real(dp), parameter :: LARGEST_FACTOR = 2.0_dp
  !> The expected cost of a start from the last solutions may exceed that of a start from coarser grids by this
  !> fraction of what the coarser grids cost: the norm of its errors does not tell how many points change their state.
  real(dp), parameter :: MARGIN = 0.4_dp
  !> After a start that cost more than coarser grids would have, the error has to be smaller by the first factor; each
  !> solve from coarser grids takes back the second one.
  real(dp), parameter :: STRICTER = 0.25_dp, LAXER = 2.0_dp
  !> After a start that was refused, steps of more than the first factor times its length are not tried, and each solve
  !> raises that by the second one.
  real(dp), parameter :: SHORTER = 0.8_dp, LONGER = 1.05_dp
  !> A start with a relative error above this saves nothing.
  real(dp), parameter :: USELESS = 0.5_dp

  !> A solved problem.
  type :: load_step
    !> Forces, (n); where a one-sided point has none, its gap with the negative sign.
    real(dp), allocatable :: values(:)
    !> Resultants and motions in all modes, (m).
    real(dp), allocatable :: resultant(:), motion(:)
    !> Numbers that differ for different gaps, modes and points.
    real(dp) :: fingerprint(6) = 0.0_dp
  end type load_step

  !> Places of the last solution and of the one before.
  integer, parameter :: NEWEST = 1, OLDER = 2

  !> The last two solutions of a solver, and what the last solve from coarser grids cost.
  type, public :: load_history
    !> An array, because gfortran 12 frees one component of a type alone where it frees what holds a `class`.
    type(load_step), private :: kept(2)
    !> Relative error at which the finest grid started after the coarser ones, and products: on the coarser grids,
    !> and on the finest one for each power of ten of the error.
    real(dp), private :: cold_error = huge(1.0_dp), coarse_products = 0.0_dp, products_per_decade = 1.0_dp
    !> All its products.
    integer, private :: cold_products = huge(1)
    !> No start with a larger error is accepted.
    real(dp), private :: greatest_error = USELESS
    !> Length of the step, relative, if the start is extrapolated along it, otherwise negative; and the least one that
    !> is not tried.
    real(dp), private :: step_length = -1.0_dp, too_long = huge(1.0_dp)
    !> The last solve started from earlier solutions.
    logical :: started_warm = .false.
  contains
    procedure :: store
    procedure :: predict
    procedure :: record_cold
    procedure :: record_warm
    procedure :: judge
    procedure :: forget
  end type load_history

  !> Finds the largest magnitude of `values`, or with a `scale` their mixed sum.
  type, extends(chunked_pass) :: mixed_pass
    real(dp), pointer :: values(:) => null()
    real(dp) :: scale = 0.0_dp
  contains
    procedure :: do_chunk => mix_chunk
  end type mixed_pass

  !> Gives the `values` of a step: forces, or where there are none and points have one stop, minus the gaps.
  type, extends(chunked_pass) :: step_pass
    real(dp), pointer, contiguous :: force(:) => null(), gap(:) => null(), values(:) => null()
  contains
    procedure :: do_chunk => store_chunk
  end type step_pass

  !> Extrapolates forces (extrapolate_forces).
  type, extends(chunked_pass) :: extrapolation
    real(dp), pointer, contiguous :: last(:) => null(), before(:) => null(), force(:) => null()
    real(dp) :: steps = 0.0_dp, greatest = 0.0_dp
    logical :: two_sided = .false.
  contains
    procedure :: do_chunk => extrapolate_chunk
  end type extrapolation

contains

  !> Forget all solutions.
  pure subroutine forget(self)
    class(load_history), intent(inout) :: self

    call clear(self%kept(NEWEST))
    call clear(self%kept(OLDER))
    self%cold_error = huge(1.0_dp)
    self%cold_products = huge(1)
    self%greatest_error = USELESS
    self%too_long = huge(1.0_dp)
    self%started_warm = .false.
  end subroutine forget

  pure subroutine clear(step)
    type(load_step), intent(out) :: step

    step%fingerprint = 0.0_dp
  end subroutine clear

  !> Keep a solution, of points that `space` may share. Where memory is short all are forgotten.
  subroutine store(self, problem, space, solution)
    class(load_history), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    type(fuge_solution), intent(in), target :: solution
    type(load_step), target :: step
    type(step_pass) :: pass
    logical :: forgotten
    integer :: j, stat

    allocate (step%values(problem%points()), step%resultant(problem%mode_count()), step%motion(problem%mode_count()), &
              stat=stat)
    forgotten = space%anywhere(stat /= 0)
    if (forgotten .or. stat /= 0) then
      call self%forget()
      return
    end if
    ! The arrays of a solution may begin with another number than 1.
    pass%force(1:size(solution%force)) => solution%force
    if (.not. allocated(problem%gap_upper)) pass%gap(1:size(solution%gap)) => solution%gap
    pass%values => step%values
    call pass%run(size(step%values), 0)
    do j = 1, size(step%resultant)
      if (.not. is_prescribed(problem, j)) then
        step%resultant(j) = problem%resultant(j)
      else if (allocated(problem%modes)) then
        step%resultant(j) = space%total(dot_product(problem%modes(:, j), solution%force))
      else
        step%resultant(j) = space%total(sum(solution%force))
      end if
    end do
    step%motion = solution%motion
    step%fingerprint = fingerprint(problem, space)
    if (differs(step, self%kept(NEWEST))) call move_step(self%kept(NEWEST), self%kept(OLDER))
    call move_step(step, self%kept(NEWEST))
  end subroutine store

  subroutine store_chunk(self, k, first, last)
    class(step_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: i

    if (k < 1) return
    do i = first, last
      self%values(i) = self%force(i)
      if (.not. associated(self%gap)) cycle
      if (.not. abs(self%force(i)) > 0.0_dp) self%values(i) = -max(self%gap(i), 0.0_dp)
    end do
  end subroutine store_chunk

  pure subroutine move_step(from, to)
    type(load_step), intent(inout) :: from, to

    call move_alloc(from%values, to%values)
    call move_alloc(from%resultant, to%resultant)
    call move_alloc(from%motion, to%motion)
    to%fingerprint = from%fingerprint
  end subroutine move_step

  !> Is `step` another problem than `last`? The same one again gives no direction to extrapolate in.
  pure function differs(step, last)
    type(load_step), intent(in) :: step, last
    logical :: differs

    differs = .true.
    if (.not. allocated(last%values)) return
    if (size(last%motion) /= size(step%motion)) return
    differs = any(abs(step%resultant - last%resultant) > sqrt(epsilon(1.0_dp))*abs(last%resultant)) &
              .or. any(abs(step%motion - last%motion) > sqrt(epsilon(1.0_dp))*abs(last%motion)) &
              .or. any(abs(step%fingerprint - last%fingerprint) > 0.0_dp)
  end function differs

  !> Sums that hardly any change of gaps, plays, modes, limits or excluded points leaves as they are.
  function fingerprint(problem, space) result(sums)
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    real(dp) :: sums(6)
    integer :: j

    sums = 0.0_dp
    sums(1) = mixed_sum(problem%gap)
    if (allocated(problem%gap_upper)) sums(2) = mixed_sum(min(problem%gap_upper, huge(1.0_dp)))
    if (allocated(problem%excluded)) sums(3) = mixed_sum(merge(1.0_dp, 0.0_dp, problem%excluded))
    if (allocated(problem%limit)) sums(5) = mixed_sum(min(problem%limit, huge(1.0_dp)))
    if (allocated(problem%limit_upper)) sums(6) = mixed_sum(min(problem%limit_upper, huge(1.0_dp)))
    if (allocated(problem%modes)) then
      do j = 1, size(problem%modes, 2)
        sums(4) = sums(4) + real(j, dp)*mixed_sum(problem%modes(:, j))
      end do
    end if
    call space%add(sums)
  end function fingerprint

  !> A sum with weights that depend on the position; scaled, so that it does not overflow.
  function mixed_sum(values) result(total)
    real(dp), intent(in), target :: values(:)
    real(dp) :: total
    type(mixed_pass) :: pass

    total = 0.0_dp
    if (size(values) < 1) return
    pass%values => values
    call pass%run(size(values), 1)
    pass%scale = pass%largest(1)
    if (.not. pass%scale > 0.0_dp) return
    call pass%run(size(values), 1)
    total = pass%total(1)/real(size(values), dp) + exponent(pass%scale) + fraction(pass%scale)
  end function mixed_sum

  subroutine mix_chunk(self, k, first, last)
    class(mixed_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    real(dp) :: total
    integer :: i

    if (.not. self%scale > 0.0_dp) then
      self%found(1, k) = maxval(abs(self%values(first:last)))
      return
    end if
    total = 0.0_dp
    do i = first, last
      total = total + real(1 + modulo(i, 61), dp)*(self%values(i)/self%scale)
    end do
    self%found(1, k) = total
  end subroutine mix_chunk

  !> Forces to start from, `start` (n), in the units of the problem; unallocated if there are none, or if the step is so
  !> long that they were refused before.
  !>
  !> Extrapolated if resultants and prescribed motions go on in the direction of the last step, or back, and nothing
  !> else has changed; otherwise the last forces, scaled with the resultants.
  subroutine predict(self, problem, space, start)
    class(load_history), intent(inout), target :: self
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    real(dp), allocatable, intent(inout), target :: start(:)
    type(extrapolation) :: pass
    real(dp) :: steps
    logical :: extrapolate
    integer :: stat

    if (allocated(start)) deallocate (start)
    if (.not. space%everywhere(fits(self%kept(NEWEST), problem))) return
    call find_steps(self, problem, space, steps, extrapolate)
    if (self%step_length >= self%too_long) then
      self%too_long = LONGER*self%too_long
      return
    end if
    allocate (start(problem%points()), stat=stat)
    if (space%anywhere(stat /= 0)) then
      if (allocated(start)) deallocate (start)
      return
    end if
    if (extrapolate) then
      pass%last => self%kept(NEWEST)%values
      pass%before => self%kept(OLDER)%values
      pass%force => start
      pass%steps = steps
      pass%greatest = space%largest(maxval(self%kept(NEWEST)%values))
      pass%two_sided = allocated(problem%gap_upper)
      call pass%run(size(start), 0)
    else
      start = load_factor(self%kept(NEWEST), problem)*self%kept(NEWEST)%values
      if (.not. allocated(problem%gap_upper)) start = max(start, 0.0_dp)
    end if
  end subroutine predict

  subroutine extrapolate_chunk(self, k, first, last)
    class(extrapolation), intent(inout) :: self
    integer, intent(in) :: k, first, last

    if (k > 0) call extrapolate_forces(self%last(first:last), self%before(first:last), self%steps, self%two_sided, &
                                       self%greatest, self%force(first:last))
  end subroutine extrapolate_chunk

  !> Does a solution have the size of the problem?
  pure function fits(step, problem)
    type(load_step), intent(in) :: step
    type(fuge_problem), intent(in) :: problem
    logical :: fits

    fits = allocated(step%values)
    if (fits) fits = size(step%values) == problem%points() .and. size(step%motion) == problem%mode_count()
  end function fits

  !> How many times the last step it is to the new problem; negative: back. `extrapolate` if the last two solutions show
  !> the way there. Sets self%step_length.
  subroutine find_steps(self, problem, space, steps, extrapolate)
    class(load_history), intent(inout) :: self
    type(fuge_problem), intent(in) :: problem
    type(point_space), intent(in) :: space
    real(dp), intent(out) :: steps
    logical, intent(out) :: extrapolate
    real(dp), dimension(problem%mode_count()) :: new, last, before, scale
    real(dp) :: sums(size(self%kept(NEWEST)%fingerprint))

    steps = 0.0_dp
    extrapolate = .false.
    self%step_length = -1.0_dp
    sums = fingerprint(problem, space)
    if (problem%mode_count() < 1 .or. any(abs(self%kept(NEWEST)%fingerprint - sums) > 0.0_dp)) return
    last = controls(problem, self%kept(NEWEST)%resultant, self%kept(NEWEST)%motion)
    new = controls(problem, problem%resultant, problem%motion)
    scale = max(abs(last), abs(new))
    where (.not. scale > 0.0_dp) scale = 1.0_dp
    new = new/scale - last/scale
    if (.not. space%everywhere(fits(self%kept(OLDER), problem))) return
    if (any(abs(self%kept(OLDER)%fingerprint - sums) > 0.0_dp)) return
    before = controls(problem, self%kept(OLDER)%resultant, self%kept(OLDER)%motion)
    ! The motions of the last two solves may be far apart where the new one only has resultants, and vice versa.
    if (any(abs(before)/sqrt(huge(steps)) > scale)) return
    before = last/scale - before/scale
    extrapolate = norm2(before) > sqrt(epsilon(steps))*norm2(new)
    if (.not. extrapolate) return
    steps = dot_product(new, before)/dot_product(before, before)
    extrapolate = abs(steps) <= FARTHEST .and. norm2(new - steps*before) <= IN_LINE*norm2(new)
    if (extrapolate) self%step_length = norm2(new)
  end subroutine find_steps

  !> The prescribed values, (m): motions where prescribed, else resultants. `resultant` and `motion` (m), or unallocated
  !> if there are none.
  pure function controls(problem, resultant, motion)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in), allocatable :: resultant(:), motion(:)
    real(dp) :: controls(problem%mode_count())
    integer :: j

    controls = 0.0_dp
    do j = 1, size(controls)
      if (is_prescribed(problem, j)) then
        controls(j) = motion(j)
      else
        controls(j) = resultant(j)
      end if
    end do
  end function controls

  !> By which factor the free resultants have grown; 1 if they have turned, or changed too much.
  pure function load_factor(last, problem) result(factor)
    type(load_step), intent(in) :: last
    type(fuge_problem), intent(in) :: problem
    real(dp) :: factor
    real(dp) :: scale, old
    integer :: j

    factor = 0.0_dp
    old = 0.0_dp
    do j = 1, problem%mode_count()
      if (is_prescribed(problem, j)) cycle
      scale = max(abs(last%resultant(j)), abs(problem%resultant(j)))
      if (.not. scale > 0.0_dp) cycle
      factor = factor + (last%resultant(j)/scale)*(problem%resultant(j)/scale)
      old = old + (last%resultant(j)/scale)**2
    end do
    if (factor <= old*LARGEST_FACTOR .and. factor*LARGEST_FACTOR >= old .and. old > 0.0_dp) then
      factor = factor/old
    else
      factor = 1.0_dp
    end if
  end function load_factor

  !> Forces `steps` steps beyond the last ones; on points with play, `two_sided`, of either sign.
  !>
  !> A point that joins gets a force that is only large enough to be seen beside the `largest` one. All (n).
  pure subroutine extrapolate_forces(last, before, steps, two_sided, largest, force)
    real(dp), intent(in) :: last(:), before(:), steps, largest
    logical, intent(in) :: two_sided
    real(dp), intent(out) :: force(:)
    real(dp) :: shrinkage, joining
    integer :: k

    if (two_sided) then
      force = last + steps*(last - before)
      return
    end if
    joining = epsilon(joining)*largest
    shrinkage = 0.0_dp
    if (steps > 0.0_dp) shrinkage = (steps/(1.0_dp + steps))**1.5_dp
    do k = 1, size(last)
      force(k) = max(last(k), 0.0_dp)
      force(k) = max(force(k) + steps*(force(k) - max(before(k), 0.0_dp)), 0.0_dp)
      if (last(k) <= 0.0_dp .and. before(k) < 0.0_dp) then
        ! gap**(2/3) extrapolates to zero where the gap has shrunk by this factor.
        if (-last(k) < shrinkage*(-before(k))) force(k) = joining
      end if
    end do
  end subroutine extrapolate_forces

  !> Keep what a solve cost that started on coarser grids.
  !>
  !> `error` with which the finest grid started and `tolerance` with which it ended, relative; `coarse_products` and
  !> `fine_products` in products of the finest grid.
  pure subroutine record_cold(self, error, tolerance, coarse_products, fine_products)
    class(load_history), intent(inout) :: self
    real(dp), intent(in) :: error, tolerance
    integer, intent(in) :: coarse_products, fine_products

    self%cold_error = error
    self%coarse_products = real(coarse_products, dp)
    self%cold_products = coarse_products + fine_products
    self%products_per_decade = real(fine_products, dp)/max(log10(max(error, tolerance)) - log10(tolerance), 1.0_dp)
    self%greatest_error = min(LAXER*self%greatest_error, USELESS)
  end subroutine record_cold

  !> Learn from the `products` of a solve that started from earlier solutions, with the relative error `error`.
  pure subroutine record_warm(self, error, products)
    class(load_history), intent(inout) :: self
    real(dp), intent(in) :: error
    integer, intent(in) :: products

    if (products > self%cold_products) self%greatest_error = STRICTER*error
  end subroutine record_warm

  !> Set self%started_warm: whether a start with this relative error is expected to cost less than coarser grids.
  pure subroutine judge(self, error)
    class(load_history), intent(inout) :: self
    real(dp), intent(in) :: error

    self%started_warm = error <= self%greatest_error
    if (self%started_warm .and. error > self%cold_error) then
      self%started_warm = (log10(error) - log10(max(self%cold_error, tiny(error))))*self%products_per_decade &
                          <= MARGIN*self%coarse_products
    end if
    if (.not. self%step_length > 0.0_dp) return
    self%too_long = huge(1.0_dp)
    if (.not. self%started_warm) self%too_long = SHORTER*self%step_length
  end subroutine judge

end module fuge_warm_start
