!> Residual and errors of forces on an area, the same for all solvers, from the forces alone and by a product of its
!> own: exact coefficients of Love on a free half-space, the spectrum on a periodic one.
module bench_surface_judge
  use bench_records, only: bench_row
  use bench_surfaces, only: bench_surface
  use bench_transforms, only: grid_transform
  use fuge, only: dp => fuge_dp, FUGE_FREE
  use fuge_halfspace_table, only: fill_halfspace_table
  implicit none
  private

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> Points count as in contact above this fraction of the largest force: some solvers leave small forces elsewhere.
  real(dp), parameter :: IN_CONTACT = 1.0e-9_dp

  !> Displacements of a surface: `prepare`, then `judge`.
  type, public :: surface_judge
    private
    type(grid_transform) :: transform
    real(dp), allocatable :: eigenvalue(:, :)
  contains
    procedure :: prepare
    procedure :: judge
    procedure :: free
  end type surface_judge

contains

  !> `by_waves`: on a periodic surface the displacement of a wave of forces is that of a sine, 2/(E* |q|), as in
  !> solvers that count waves instead of cells.
  subroutine prepare(self, surface, by_waves)
    class(surface_judge), intent(inout) :: self
    type(bench_surface), intent(in) :: surface
    logical, intent(in) :: by_waves

    call self%free()
    if (surface%boundary == FUGE_FREE) then
      call prepare_free(self, surface)
    else
      call self%transform%create(surface%n, surface%n)
      self%eigenvalue = wave_eigenvalues(surface, by_waves)
    end if
  end subroutine prepare

  !> The circulant of twice as many cells in each direction.
  subroutine prepare_free(self, surface)
    type(surface_judge), intent(inout) :: self
    type(bench_surface), intent(in) :: surface
    real(dp), allocatable :: table(:, :)
    integer :: n, j, stat

    n = surface%n
    allocate (table(0:n, 0:n))
    call fill_halfspace_table([surface%cell(), surface%cell()], 1.0_dp, surface%element, table, stat)
    if (stat /= 0) error stop 'no coefficients'
    call self%transform%create(2*n, 2*n)
    do j = 0, 2*n - 1
      self%transform%values(:n, j + 1) = table(:n - 1, min(j, 2*n - j))
      self%transform%values(n + 1:2*n, j + 1) = table(n:1:-1, min(j, 2*n - j))
    end do
    call self%transform%forward()
    self%eigenvalue = real(self%transform%waves, dp)/real(2*n, dp)**2
  end subroutine prepare_free

  pure function wave_eigenvalues(surface, by_waves) result(eigenvalue)
    type(bench_surface), intent(in) :: surface
    logical, intent(in) :: by_waves
    real(dp) :: eigenvalue(surface%n/2 + 1, surface%n)
    integer :: n, k, m
    real(dp) :: value

    n = surface%n
    eigenvalue = 0.0_dp
    do m = 0, n/2
      ! The cells are squares: x and y may change places.
      do k = max(m, 1), n/2
        if (by_waves) then
          value = 1.0_dp/hypot(real(k, dp), real(m, dp))
        else
          value = sum_of_aliases(real(k, dp)/real(n, dp), real(m, dp)/real(n, dp))/real(n, dp)
        end if
        eigenvalue(1 + k, 1 + m) = value/(PI*surface%side)
        eigenvalue(1 + m, 1 + k) = eigenvalue(1 + k, 1 + m)
      end do
    end do
    do m = 1, n/2 - 1
      eigenvalue(:, n + 1 - m) = eigenvalue(:, 1 + m)
    end do
  end function wave_eigenvalues

  !> The sum of sinc(x + i) sinc(y + j)/hypot(x + i, y + j) over all integers, 0 <= y <= x <= 1/2, x > 0: constant
  !> pressure on the cells, displacement at their centres. The terms alternate, so that a smooth end leaves no error.
  pure function sum_of_aliases(x, y) result(total)
    real(dp), intent(in) :: x, y
    real(dp) :: total
    integer, parameter :: MOST = 40
    real(dp) :: along(-MOST:MOST), across, distance(-MOST:MOST)
    integer :: k

    distance = [(x + k, k=-MOST, MOST)]
    along = [(alternating_weight(k, MOST), k=-MOST, MOST)]*sin(PI*x)/(PI*distance)
    distance = distance**2
    total = 0.0_dp
    do k = -MOST, MOST
      across = alternating_weight(k, MOST)*sin(PI*y)/(PI*(y + k + tiny(y)))
      ! Constant along y: only one term is not zero.
      if (y <= 0.0_dp) across = merge(1.0_dp, 0.0_dp, k == 0)
      if (abs(across) > 0.0_dp) total = total + across*sum(along/sqrt(distance + (y + k)**2))
    end do
  end function sum_of_aliases

  !> The sign of term `k`, times 1 in the middle, and nothing at +- `most`.
  pure function alternating_weight(k, most) result(weight)
    integer, intent(in) :: k, most
    real(dp) :: weight

    weight = 0.5_dp*erfc(12.0_dp*(real(abs(k), dp)/most - 0.5_dp))
    if (modulo(k, 2) == 1) weight = -weight
  end function alternating_weight

  !> Fill residual, errors and number of points in contact of `force` (n*n) in `row`.
  subroutine judge(self, surface, force, row)
    class(surface_judge), intent(inout) :: self
    type(bench_surface), intent(in) :: surface
    real(dp), intent(in) :: force(:)
    type(bench_row), intent(inout) :: row
    real(dp), allocatable :: gap(:)
    logical, allocatable :: limited(:)
    real(dp) :: scale, approach, peak

    allocate (gap(size(force)), limited(size(force)))
    limited = .false.
    if (surface%hardness > 0.0_dp) limited = force >= (1.0_dp - IN_CONTACT)*surface%largest_force()
    call displace(self, surface%n, force, gap)
    scale = max(maxval(gap) - minval(gap), surface%load/surface%side)
    gap = gap + surface%gap
    approach = maxval(gap)
    if (.not. all(limited)) approach = sum(max(force, 0.0_dp)*gap, mask=.not. limited) &
      /max(sum(max(force, 0.0_dp), mask=.not. limited), tiny(approach))
    gap = gap - approach
    ! Points at their limit give way.
    where (limited) gap = max(gap, 0.0_dp)
    peak = maxval(force)
    row%unknowns = count(force > IN_CONTACT*peak)
    row%residual = max(-minval(gap)/scale, maxval(abs(gap), mask=force > IN_CONTACT*peak)/scale, -minval(force)/peak, &
                       abs(sum(force)/surface%load - 1.0_dp))
    if (surface%hardness > 0.0_dp) then
      row%limited = count(limited)
      row%residual = max(row%residual, peak/surface%largest_force() - 1.0_dp)
    end if
    if (surface%contact_radius > 0.0_dp) call find_errors(surface, force, approach, row)
  end subroutine judge

  !> Against Hertz: of the pressure the sum of the errors of the cells' forces over the load.
  subroutine find_errors(surface, force, approach, row)
    type(bench_surface), intent(in) :: surface
    real(dp), intent(in) :: force(:), approach
    type(bench_row), intent(inout) :: row
    real(dp), allocatable :: exact(:)

    allocate (exact, source=surface%exact_forces())
    row%error_pressure = sum(abs(force - exact))/surface%load
    row%error_force = maxval(abs(force - exact))/maxval(exact)
    row%error_peak = abs(maxval(force)/maxval(exact) - 1.0_dp)
    row%error_approach = abs(approach/surface%approach - 1.0_dp)
    row%error_half_width = abs(sqrt(row%unknowns/PI)*surface%cell()/surface%contact_radius - 1.0_dp)
  end subroutine find_errors

  !> `displacement` (n*n) by `force` (n*n).
  subroutine displace(self, n, force, displacement)
    type(surface_judge), intent(inout) :: self
    integer, intent(in) :: n
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:)
    integer :: j

    associate (transform => self%transform)
      transform%values = 0.0_dp
      do j = 1, n
        transform%values(:n, j) = force(n*(j - 1) + 1:n*j)
      end do
      call transform%forward()
      transform%waves = self%eigenvalue*transform%waves
      call transform%backward()
      do j = 1, n
        displacement(n*(j - 1) + 1:n*j) = transform%values(:n, j)
      end do
    end associate
  end subroutine displace

  subroutine free(self)
    class(surface_judge), intent(inout) :: self

    call self%transform%free()
    if (allocated(self%eigenvalue)) deallocate (self%eigenvalue)
  end subroutine free

end module bench_surface_judge
