!> Influence coefficients and eigenvalues of equal cells side by side on a body whose surface is a mixture of Gaussians,
!> in plane strain.
module fuge_mixture_line
  use fuge_constants, only: PI
  use fuge_gaussian_cells, only: fill_gaussian_sums, gaussian_share
  use fuge_graded_series, only: graded_function, graded_series
  use fuge_kinds, only: dp
  use fuge_wave_mixture, only: wave_mixture
  implicit none
  private

  public :: tabulate_distances, tabulate_waves

  !> A sum over the nodes of a rule.
  type, extends(graded_function), abstract :: sum_of_gaussians
    real(dp), allocatable :: node(:), weight(:)
    !> Averages over a cell, 1 or 2.
    integer :: power = 2
  end type sum_of_gaussians

  !> Of distances, in cells, with what all longer t add.
  type, extends(sum_of_gaussians) :: sum_at_distances
    real(dp) :: constant = 0.0_dp
  contains
    procedure :: evaluate => evaluate_distances
  end type sum_at_distances

  !> Of waves of 0, 1, .. periods in `length` cells.
  type, extends(sum_of_gaussians) :: sum_of_waves
    integer :: length = 1
  contains
    procedure :: evaluate => evaluate_waves
  end type sum_of_waves

contains

  !> `coefficient`: at the distances of 0 .. `last` cells the displacement by a force on a cell of the width `spacing`,
  !> times e_star, per length of the cells. As on a half-plane it falls like the logarithm of the distance in cells,
  !> unless the base is rigid. `power`: averages over a cell, 1 or 2. `stat` as in an allocate statement.
  subroutine tabulate_distances(body, spacing, power, last, coefficient, stat)
    type(wave_mixture), intent(in) :: body
    real(dp), intent(in) :: spacing
    integer, intent(in) :: power, last
    type(graded_series), intent(inout) :: coefficient
    integer, intent(out) :: stat
    type(sum_at_distances) :: f

    call body%make_rule(spacing, spacing*real(last + 1, dp), 1, f%node, f%weight, stat)
    if (stat /= 0) return
    f%power = power
    f%constant = 2.0_dp/PI*body%line_constant(spacing, f%node, f%weight)
    f%weight = 4.0_dp/sqrt(PI)*f%weight
    call coefficient%build(f, .true., last, stat)
  end subroutine tabulate_distances

  !> `eigenvalue`, times e_star: of the waves of 0 .. `length`/2 periods on a circle of `length` cells. The first one is
  !> that of constant forces if the base is rigid, otherwise 0: displacements count from the mean then.
  subroutine tabulate_waves(body, spacing, power, length, eigenvalue, stat)
    type(wave_mixture), intent(in) :: body
    real(dp), intent(in) :: spacing
    integer, intent(in) :: power, length
    type(graded_series), intent(inout) :: eigenvalue
    integer, intent(out) :: stat
    type(sum_of_waves) :: f

    call body%make_rule(spacing, spacing*real(length, dp), 0, f%node, f%weight, stat)
    if (stat /= 0) return
    f%power = power
    f%length = length
    f%weight = 4.0_dp/sqrt(PI)*f%weight
    call eigenvalue%build(f, .false., length/2, stat)
    call eigenvalue%set_first(merge(sum(f%weight), 0.0_dp, body%has_rigid_base()))
  end subroutine tabulate_waves

  subroutine evaluate_distances(self, x, values)
    class(sum_at_distances), intent(in) :: self
    real(dp), intent(in), contiguous :: x(:)
    real(dp), intent(out), contiguous :: values(:)
    integer :: k

    values = self%constant
    do k = 1, size(self%node)
      values = values + self%weight(k)*gaussian_share(self%node(k), self%power, x)
    end do
  end subroutine evaluate_distances

  subroutine evaluate_waves(self, x, values)
    class(sum_of_waves), intent(in) :: self
    real(dp), intent(in), contiguous :: x(:)
    real(dp), intent(out), contiguous :: values(:)
    real(dp) :: sums(size(x))
    integer :: k

    values = 0.0_dp
    do k = 1, size(self%node)
      call fill_gaussian_sums(x/real(self%length, dp), self%node(k), self%power, sums)
      values = values + self%weight(k)*sums
    end do
  end subroutine evaluate_waves

end module fuge_mixture_line
