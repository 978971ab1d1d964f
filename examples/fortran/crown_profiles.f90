!> The roller of the example `crown`, and the families of profiles from which the fit takes its crown.
module crown_profiles
  use fuge, only: dp => fuge_dp
  use profile_fit, only: shaped_gap
  implicit none
  private

  public :: lundberg, set_grid, set_splines

  real(dp), parameter :: PI = acos(-1.0_dp)
  !> N, mm: steel on steel.
  real(dp), parameter, public :: E_STAR = 1.15e5_dp, RADIUS = 10.0_dp, LENGTH = 20.0_dp, LOAD = 1.0e4_dp
  !> Half width and largest pressure of a roller without ends.
  real(dp), parameter, public :: HALF_WIDTH = sqrt(4.0_dp*LOAD/LENGTH*RADIUS/(PI*E_STAR))
  real(dp), parameter, public :: LINE_PRESSURE = 2.0_dp*LOAD/LENGTH/(PI*HALF_WIDTH)
  !> G. Lundberg's logarithm (1939), with the finite ends of K. L. Johnson and R. Gohar (1981).
  real(dp), parameter, public :: LUNDBERG_HEIGHT = LOAD/(PI*E_STAR*LENGTH), &
    LUNDBERG_FACTOR = 1.0_dp - exp(-0.5_dp)*HALF_WIDTH/LENGTH
  !> A gap where there is no roller, mm.
  real(dp), parameter :: NO_BODY = 1.0_dp

  !> A grid over the contact; the roller ends at the edges of cells.
  type, public :: crown_grid
    !> Cells across and along, and their widths.
    integer :: across = 0, along = 0
    real(dp) :: width = 0.0_dp, spacing = 0.0_dp
    !> Centres of the cells across, along, and of all of them, (n).
    real(dp), allocatable :: x(:), y(:), x_of(:), y_of(:)
    !> Is a row of cells on the roller? And a cell, (n)?
    logical, allocatable :: has_roller(:), is_roller(:)
    !> The gaps of a straight roller, (n), mm.
    real(dp), allocatable :: straight(:)
  end type crown_grid

  !> -h ln(1 - k (2y/L)**2); the parameters are h over that of Lundberg, and -ln(1 - k), which is the drop at the very
  !> ends over h.
  type, extends(shaped_gap), public :: logarithmic_crown
    type(crown_grid) :: grid
  contains
    procedure :: set_gap => set_logarithmic_gap
  end type logarithmic_crown

  !> Cubic B-splines, the same at both ends; the parameters are their heights, micrometres.
  type, extends(shaped_gap), public :: free_crown
    real(dp), allocatable :: straight(:)
    !> Gaps by splines of the height 1, (n, p), mm.
    real(dp), allocatable :: share(:, :)
  contains
    procedure :: set_gap => set_free_gap
  end type free_crown

contains

  !> A grid with `rows` rows of cells on the roller.
  pure subroutine set_grid(across, rows, grid)
    integer, intent(in) :: across, rows
    type(crown_grid), intent(out) :: grid
    !> Half width of the grid over that of the contact; rows beyond each end.
    real(dp), parameter :: COVERED = 1.6_dp
    integer, parameter :: BEYOND = 2
    integer :: i, j

    grid%across = across
    grid%along = rows + 2*BEYOND
    grid%width = 2.0_dp*COVERED*HALF_WIDTH/real(across, dp)
    grid%spacing = LENGTH/real(rows, dp)
    grid%x = [(grid%width*(real(i, dp) - 0.5_dp*real(across + 1, dp)), i=1, across)]
    grid%y = [(grid%spacing*(real(j, dp) - 0.5_dp*real(grid%along + 1, dp)), j=1, grid%along)]
    grid%x_of = [(grid%x, j=1, grid%along)]
    grid%y_of = [(spread(grid%y(j), 1, across), j=1, grid%along)]
    grid%has_roller = abs(grid%y) < 0.5_dp*LENGTH
    grid%is_roller = abs(grid%y_of) < 0.5_dp*LENGTH
    grid%straight = grid%x_of**2/(2.0_dp*RADIUS) + merge(0.0_dp, NO_BODY, grid%is_roller)
  end subroutine set_grid

  !> The parameters of a logarithmic crown by Lundberg's formula, for a multiple of the load.
  pure function lundberg(multiple) result(parameter)
    real(dp), intent(in) :: multiple
    real(dp) :: parameter(2)

    parameter = [multiple, -log(1.0_dp - LUNDBERG_FACTOR)]
  end function lundberg

  subroutine set_logarithmic_gap(self, parameter, gap, by_parameter)
    class(logarithmic_crown), intent(in) :: self
    real(dp), intent(in) :: parameter(:)
    real(dp), intent(out) :: gap(:), by_parameter(:, :)
    real(dp) :: height, left, square
    integer :: i

    height = parameter(1)*LUNDBERG_HEIGHT
    by_parameter = 0.0_dp
    gap = self%grid%straight
    do i = 1, size(gap)
      if (.not. self%grid%is_roller(i)) cycle
      square = (2.0_dp*self%grid%y_of(i)/LENGTH)**2
      left = 1.0_dp - (1.0_dp - exp(-parameter(2)))*square
      gap(i) = gap(i) - height*log(left)
      by_parameter(i, 1) = -LUNDBERG_HEIGHT*log(left)
      by_parameter(i, 2) = height*exp(-parameter(2))*square/left
    end do
  end subroutine set_logarithmic_gap

  subroutine set_free_gap(self, parameter, gap, by_parameter)
    class(free_crown), intent(in) :: self
    real(dp), intent(in) :: parameter(:)
    real(dp), intent(out) :: gap(:), by_parameter(:, :)

    gap = self%straight + matmul(self%share, parameter)
    by_parameter = self%share
  end subroutine set_free_gap

  !> A free crown of `splines` splines. They become narrow towards the ends, where the profile is steep: at a distance d
  !> from an end their knots are equally spaced in d**(2/3).
  pure subroutine set_splines(grid, splines, crown)
    type(crown_grid), intent(in) :: grid
    integer, intent(in) :: splines
    type(free_crown), intent(out) :: crown
    real(dp), parameter :: MICROMETRE = 1.0e-3_dp
    real(dp) :: place
    integer :: i, j

    crown%straight = grid%straight
    allocate (crown%share(size(grid%straight), splines))
    crown%share = 0.0_dp
    do i = 1, size(grid%straight)
      if (.not. grid%is_roller(i)) cycle
      place = real(splines - 1, dp)*(1.0_dp - (1.0_dp - 2.0_dp*abs(grid%y_of(i))/LENGTH)**(2.0_dp/3.0_dp))
      do j = 1, splines
        ! With its mirror image, so that the middle is level.
        crown%share(i, j) = MICROMETRE*(spline(place - real(j, dp)) + spline(place + real(j, dp)))
      end do
    end do
  end subroutine set_splines

  !> The cubic B-spline on knots at integers.
  elemental function spline(t) result(value)
    real(dp), intent(in) :: t
    real(dp) :: value

    value = max(0.0_dp, 2.0_dp - abs(t))**3/6.0_dp - 2.0_dp*max(0.0_dp, 1.0_dp - abs(t))**3/3.0_dp
  end function spline

end module crown_profiles
