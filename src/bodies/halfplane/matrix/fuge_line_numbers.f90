!> The numbers that spectra of a line of cells are made of, of a half-plane in closed form, of another body from few
!> sums over Gaussians.
module fuge_line_numbers
  use fuge_cell_elements, only: FUGE_CENTRE, FUGE_FREE
  use fuge_constants, only: PI
  use fuge_graded_series, only: graded_series
  use fuge_halfplane_line, only: halfplane_line, inverse_eigenvalue, log_of_distance
  use fuge_kinds, only: dp
  use fuge_mixture_line, only: tabulate_distances, tabulate_waves
  implicit none
  private

  type, public :: line_numbers
    private
    type(halfplane_line) :: line
    !> Cells of the circle.
    integer :: length = 1
    type(graded_series) :: distances, waves
  contains
    procedure :: prepare
    procedure :: inverse_of_wave
    procedure :: at_distance
    procedure :: split
  end type line_numbers

contains

  !> Prepare for the cells of `line` on a circle of `length` cells. `stat` as in an allocate statement.
  subroutine prepare(self, line, length, stat)
    class(line_numbers), intent(inout) :: self
    type(halfplane_line), intent(in) :: line
    integer, intent(in) :: length
    integer, intent(out) :: stat
    integer :: power

    self%line = line
    self%length = length
    stat = 0
    if (.not. line%body%is_set()) return
    power = merge(1, 2, line%element == FUGE_CENTRE)
    call tabulate_waves(line%body, line%spacing, power, length, self%waves, stat)
    ! For the constant any positive number is valid; that of the longest wave has the right size.
    if (stat == 0 .and. .not. line%body%has_rigid_base()) then
      call self%waves%set_first(merge(self%waves%value_at(min(1, length/2)), 1.0_dp, length > 1))
    end if
    if (stat == 0 .and. line%boundary == FUGE_FREE) &
      call tabulate_distances(line%body, line%spacing, power, length, self%distances, stat)
  end subroutine prepare

  !> The eigenvalue of the preconditioner for the wave of `periods` periods, over the length of the circle.
  elemental function inverse_of_wave(self, periods) result(eigenvalue)
    class(line_numbers), intent(in) :: self
    integer, intent(in) :: periods
    real(dp) :: eigenvalue

    if (self%line%body%is_set()) then
      eigenvalue = self%line%e_star/(self%waves%value_at(periods)*real(self%length, dp))
    else
      eigenvalue = inverse_eigenvalue(self%line, self%length, periods)
    end if
  end function inverse_of_wave

  !> The influence of two cells `apart` cells from each other, in units of -2/(pi e_star): on a half-plane the logarithm
  !> of their distance in cells.
  elemental function at_distance(self, apart) result(logarithm)
    class(line_numbers), intent(in) :: self
    integer, intent(in) :: apart
    real(dp) :: logarithm

    if (self%line%body%is_set()) then
      logarithm = -0.5_dp*PI*self%distances%value_at(apart)
    else
      logarithm = log_of_distance(self%line, apart)
    end if
  end function at_distance

  !> Coefficients of a free surface are `factor` times those numbers less their `mean`, which makes this `datum`.
  pure subroutine split(self, mean, factor, datum)
    class(line_numbers), intent(in) :: self
    real(dp), intent(in) :: mean
    real(dp), intent(out) :: factor, datum
    real(dp) :: far

    factor = -2.0_dp/(PI*self%line%e_star)
    ! In units of the spacing, as the coefficients: the D of the matrix is 2 n.
    far = log(2.0_dp*real(self%line%cells, dp))
    if (self%line%body%is_set()) far = self%line%body%limit*far
    datum = factor*(mean - far)
  end subroutine split

end module fuge_line_numbers
