!> The load cases that are most alike, to start one from the contact set of another.
!>
!> Forces, gaps and motions grow with gaps and loads, and the contact set depends on the direction of these data alone.
!> So cases are alike where their data, as vectors, have nearly the same direction. Cases are mostly combinations of a
!> few: the components of their directions in an orthonormal basis of these, by pivoted Gram-Schmidt, describe them, and
!> all pairs of thousands of cases cost little beside their solves.
module fuge_nearest_case
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemm
  use fuge_load_cases_type, only: fuge_load_cases
  use fuge_problem_type, only: fuge_problem
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> Vectors of the basis, at most.
  integer, parameter :: MOST_VECTORS = 16
  !> Cases whose products with all before them are formed together.
  integer, parameter :: BLOCK = 64
  !> What is left of all directions outside the basis, when it needs no more vectors.
  real(dp), parameter :: NOTHING_LEFT = 1.0e-12_dp

  !> Directions of the data of all cases.
  type, public :: case_directions
    private
    !> Components of each direction, (components, cases), and their products with those of `first`, `first` + 1, ..,
    !> (cases, BLOCK).
    real(dp), allocatable :: component(:, :), product(:, :)
    !> Cases that others are not to start from, (cases).
    logical, allocatable :: left_out(:)
    integer :: first = 0
  contains
    procedure :: set
    procedure :: leave_out
    procedure :: most_like
  end type case_directions

  !> Scales that make gaps and loads of all cases comparable, so that units do not matter; zero where there are none.
  type :: case_scales
    real(dp) :: gap = 0.0_dp
    real(dp), allocatable :: load(:)
    !> Length of the data of each case, (cases); 0 where they are not finite, too: the solve refuses them.
    real(dp), allocatable :: length(:)
  end type case_scales

contains

  !> Find the directions of `cases`, which fit `problem`. Error: FUGE_ERR_MEMORY.
  subroutine set(self, cases, problem, info)
    class(case_directions), intent(inout) :: self
    type(fuge_load_cases), intent(in) :: cases
    type(fuge_problem), intent(in) :: problem
    type(fuge_info), intent(inout) :: info
    type(case_scales) :: scales
    integer :: number, stat

    number = cases%number()
    allocate (self%component(MOST_VECTORS + 1, number), self%product(number, BLOCK), self%left_out(number), &
              scales%length(number), scales%load(problem%mode_count()), stat=stat)
    call require_memory(stat, 'the directions of', number, 'load cases', info)
    if (stat /= 0) return
    self%component = 0.0_dp
    self%left_out = .false.
    self%first = 0
    call find_scales(cases, scales)
    if (.not. any(scales%length > 0.0_dp)) return
    call find_components(cases, scales, self%component(:MOST_VECTORS, :), info)
    ! Stops and limits do not grow with the loads.
    if (allocated(problem%gap_upper) .or. problem%has_limits() .or. allocated(problem%prescribed)) &
      call add_size(scales%length, self%component)
  end subroutine set

  !> No other case is to start from case `k`, which has no solution.
  pure subroutine leave_out(self, k)
    class(case_directions), intent(inout) :: self
    integer, intent(in) :: k

    if (allocated(self%left_out)) self%left_out(k) = .true.
  end subroutine leave_out

  !> The case before `k` that is most like it; 0 if there is none, or if the directions are not set. Cases are asked for
  !> in turn.
  function most_like(self, k)
    class(case_directions), intent(inout) :: self
    integer, intent(in) :: k
    integer :: most_like
    integer :: columns, components

    most_like = 0
    if (k < 2 .or. .not. allocated(self%component)) return
    if (k < self%first .or. k >= self%first + BLOCK .or. self%first < 1) then
      self%first = k
      columns = min(BLOCK, size(self%component, 2) - k + 1)
      components = size(self%component, 1)
      call dgemm('T', 'N', k + columns - 1, columns, components, 1.0_dp, self%component, components, &
                 self%component(:, k:), components, 0.0_dp, self%product, size(self%product, 1))
    end if
    ! Of equal ones the last, whose factor is at hand.
    most_like = maxloc(self%product(:k - 1, k - self%first + 1), dim=1, mask=.not. self%left_out(:k - 1), back=.true.)
  end function most_like

  !> The largest gap, the largest load of each motion, and with these units the length of the data of each case.
  pure subroutine find_scales(cases, scales)
    type(fuge_load_cases), intent(in) :: cases
    type(case_scales), intent(inout) :: scales
    integer :: j, k

    scales%load = 0.0_dp
    scales%length = 0.0_dp
    do k = 1, size(scales%length)
      if (.not. is_finite(cases, k)) cycle
      if (allocated(cases%load)) scales%load = max(scales%load, abs(cases%load(:, k)))
      if (allocated(cases%gap)) scales%gap = max(scales%gap, maxval(abs(cases%gap(:, k))))
    end do
    do k = 1, size(scales%length)
      if (.not. is_finite(cases, k)) cycle
      if (scales%gap > 0.0_dp) scales%length(k) = norm2(cases%gap(:, k)/scales%gap)
      do j = 1, size(scales%load)
        if (scales%load(j) > 0.0_dp) scales%length(k) = hypot(scales%length(k), cases%load(j, k)/scales%load(j))
      end do
    end do
  end subroutine find_scales

  !> Are all data of case `k` finite?
  pure function is_finite(cases, k)
    type(fuge_load_cases), intent(in) :: cases
    integer, intent(in) :: k
    logical :: is_finite

    is_finite = .true.
    if (allocated(cases%gap)) is_finite = all(ieee_is_finite(cases%gap(:, k)))
    if (allocated(cases%load)) is_finite = is_finite .and. all(ieee_is_finite(cases%load(:, k)))
  end function is_finite

  !> Components of the directions, (vectors, cases). The next vector of the basis is the direction of which most is
  !> left. Error: FUGE_ERR_MEMORY.
  subroutine find_components(cases, scales, component, info)
    type(fuge_load_cases), intent(in) :: cases
    type(case_scales), intent(in) :: scales
    real(dp), intent(inout) :: component(:, :)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: left(:), basis(:, :), row(:)
    integer :: d, n, pivot, stat

    n = size(scales%load)
    if (allocated(cases%gap)) n = n + size(cases%gap, 1)
    allocate (left(size(scales%length)), row(size(scales%length)), basis(n, size(component, 1)), stat=stat)
    call require_memory(stat, 'the directions of', size(scales%length), 'load cases', info)
    if (stat /= 0) return
    left = merge(1.0_dp, 0.0_dp, scales%length > 0.0_dp)
    do d = 1, size(component, 1)
      pivot = maxloc(left, dim=1)
      if (.not. left(pivot) > NOTHING_LEFT) return
      basis(:, d) = direction(cases, scales, n, pivot) - matmul(basis(:, :d - 1), component(:d - 1, pivot))
      basis(:, d) = basis(:, d)/norm2(basis(:, d))
      call project(cases, scales, basis(:, d), row)
      component(d, :) = row
      left = left - row**2
    end do
  end subroutine find_components

  !> Direction of the data of one case, of length 1, with `n` components.
  pure function direction(cases, scales, n, which)
    type(fuge_load_cases), intent(in) :: cases
    type(case_scales), intent(in) :: scales
    integer, intent(in) :: n, which
    real(dp) :: direction(n)
    integer :: j, m

    m = size(scales%load)
    direction = 0.0_dp
    do j = 1, m
      if (scales%load(j) > 0.0_dp) direction(j) = cases%load(j, which)/scales%load(j)
    end do
    if (scales%gap > 0.0_dp) direction(m + 1:) = cases%gap(:, which)/scales%gap
    direction = direction/scales%length(which)
  end function direction

  !> Product of the direction of each case with one `vector`, (cases).
  pure subroutine project(cases, scales, vector, row)
    type(fuge_load_cases), intent(in) :: cases
    type(case_scales), intent(in) :: scales
    real(dp), intent(in) :: vector(:)
    real(dp), intent(out) :: row(:)
    integer :: j, k, m

    m = size(scales%load)
    row = 0.0_dp
    do k = 1, size(row)
      if (.not. scales%length(k) > 0.0_dp) cycle
      if (scales%gap > 0.0_dp) row(k) = dot_product(vector(m + 1:), cases%gap(:, k)/scales%gap)
      do j = 1, m
        if (scales%load(j) > 0.0_dp) row(k) = row(k) + vector(j)*(cases%load(j, k)/scales%load(j))
      end do
      row(k) = row(k)/scales%length(k)
    end do
  end subroutine project

  !> Let the size of the data count beside their direction: what does not grow with them becomes one component more.
  pure subroutine add_size(length, component)
    real(dp), intent(in) :: length(:)
    real(dp), intent(inout) :: component(:, :)
    real(dp) :: largest, slope
    integer :: k, last

    largest = maxval(length)
    last = size(component, 1)
    do k = 1, size(length)
      slope = length(k)/largest
      component(:, k) = slope*component(:, k)
      component(last, k) = 1.0_dp
      component(:, k) = component(:, k)/hypot(slope, 1.0_dp)
    end do
  end subroutine add_size

end module fuge_nearest_case
