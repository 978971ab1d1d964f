!> The shim of the example `shim`: the joint of the example `flange` with a thickness at each of its points.
module shim_field
  use flange_mesh, only: flange_cells, flange_sizes
  use flange_model, only: build, flange_joint, JOINT, NUT
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_info, fuge_problem, fuge_solution, fuge_solver
  use profile_fit, only: fitted_case, shaped_gap
  implicit none
  private

  public :: build_joint, neighbour_differences, press, want_even_pressure

  real(dp), parameter :: MICROMETRE = 1.0e-3_dp
  !> A gap under load that counts as much as the whole pressure: about what a point alone yields under it, so that the
  !> residual of a point that opens goes on as it has fallen.
  real(dp), parameter :: OPENING = 1.0_dp*MICROMETRE

  !> The parameters are the thickness at the points of the joint, and at last how far the nut is turned on, micrometres.
  type, extends(shaped_gap), public :: shimmed_joint
    type(flange_joint) :: model
    !> Loads and gaps without a shim, tightened and without internal pressure.
    type(fuge_problem) :: problem
    !> The points of the joint.
    integer, allocatable :: point(:)
  contains
    procedure :: set_gap => set_shimmed_gap
  end type shimmed_joint

contains

  !> The joint of hexahedra of 20 nodes, `fine` along each part; the shank of its bolt is shorter than both flanges by
  !> `shortening`, mm.
  subroutine build_joint(fine, shortening, joined, info)
    integer, intent(in) :: fine
    real(dp), intent(in) :: shortening
    type(shimmed_joint), intent(inout) :: joined
    type(fuge_info), intent(out) :: info
    type(flange_cells) :: cells(3)
    integer :: i

    cells(:2) = flange_cells(order=2, beside=fine, above=2*fine, around=2*fine, between=fine, wall=2*fine, &
                             inside=fine, outside=fine, height=2*fine, tube=3*fine)
    cells(3) = flange_cells(order=2, beside=fine, above=2*fine, around=fine, height=2*fine)
    call build(cells, flange_sizes(), shortening, joined%model)
    call joined%model%joined%pose(joined%model%condensed, joined%problem, info)
    if (info%failed()) return
    associate (pair => joined%model%joined%pairs%pair)
      joined%point = pack([(i, i=1, size(pair))], pair == JOINT)
    end associate
  end subroutine build_joint

  subroutine set_shimmed_gap(self, parameter, gap, by_parameter)
    class(shimmed_joint), intent(in) :: self
    real(dp), intent(in) :: parameter(:)
    real(dp), intent(out) :: gap(:), by_parameter(:, :)
    integer :: k

    by_parameter = 0.0_dp
    do k = 1, size(self%point)
      by_parameter(self%point(k), k) = -MICROMETRE
    end do
    where (self%model%joined%pairs%pair == NUT) by_parameter(:, size(parameter)) = -MICROMETRE
    gap = self%problem%gap + matmul(by_parameter, parameter)
  end subroutine set_shimmed_gap

  !> The wish for this pressure at all points of the joint. The residuals are relative errors, weighted by areas. The
  !> force of an open point has no derivative: without a residual of its gap it would stay open.
  subroutine want_even_pressure(joined, pressure, wish)
    type(shimmed_joint), intent(in) :: joined
    real(dp), intent(in) :: pressure
    type(fitted_case), intent(out) :: wish
    real(dp) :: share(joined%problem%points())

    wish%problem = joined%problem
    associate (pairs => joined%model%joined%pairs)
      share = merge(sqrt(pairs%area/sum(pairs%area, mask=pairs%pair == JOINT)), 0.0_dp, pairs%pair == JOINT)
      wish%by_force = share/(pressure*pairs%area)
    end associate
    wish%by_gap = -share/OPENING
    wish%wanted = share
  end subroutine want_even_pressure

  !> The joint with a shim under an internal pressure, N/mm2.
  subroutine press(joined, operator, parameter, pressure, solution, info)
    type(shimmed_joint), intent(inout) :: joined
    type(fuge_dense_operator), intent(in) :: operator
    real(dp), intent(in) :: parameter(:), pressure
    type(fuge_solution), intent(inout) :: solution
    type(fuge_info), intent(out) :: info
    type(fuge_problem) :: problem
    type(fuge_solver) :: solver
    real(dp) :: gap(operator%points()), by_parameter(operator%points(), size(parameter))

    call joined%set_gap(parameter, gap, by_parameter)
    call joined%model%condensed%set_load(pressure*joined%model%unit_load, info)
    if (info%failed()) return
    call joined%model%joined%pose(joined%model%condensed, problem, info)
    if (info%failed()) return
    problem%gap = problem%gap + gap - joined%problem%gap
    call solver%solve(operator, problem, solution, info)
  end subroutine press

  !> Differences of the thickness between neighbours on the mesh of the joint, times `weight`, (edges, parameters).
  subroutine neighbour_differences(joined, weight, smoothness)
    type(shimmed_joint), intent(in) :: joined
    real(dp), intent(in) :: weight
    real(dp), allocatable, intent(out) :: smoothness(:, :)
    integer :: number(size(joined%model%mesh(1)%node, 2)), around(8), e, f, k

    number = 0
    number(joined%model%joined%pairs%node(joined%point)) = [(k, k=1, size(joined%point))]
    associate (face => joined%model%joint_face)
      allocate (smoothness(8*size(face, 2), size(joined%point) + 1))
      smoothness = 0.0_dp
      do f = 1, size(face, 2)
        around = number(face([1, 5, 2, 6, 3, 7, 4, 8], f))
        do k = 1, 8
          e = 8*(f - 1) + k
          smoothness(e, around(k)) = weight
          smoothness(e, around(modulo(k, 8) + 1)) = -weight
        end do
      end do
    end associate
  end subroutine neighbour_differences

end module shim_field
