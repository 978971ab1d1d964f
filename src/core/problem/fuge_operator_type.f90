!> The influence operator, abstract: displacements u = A f of the candidate points.
!>
!> Extend it for an operator of your own. A is symmetric and positive definite on the
!> forces with zero resultant; u is positive into the body.
module fuge_operator_type
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp, sp
  use fuge_point_space, only: point_space
  use fuge_status, only: FUGE_DONE, FUGE_ERR_OPTION, FUGE_ERR_SIZE, FUGE_ERR_UNSUPPORTED
  implicit none
  private

  !> Extend it: `points` and `apply` are required, the other procedures have defaults.
  type, abstract, public :: fuge_operator
  contains
    !> Number of candidate points n; 0 while the operator is not set.
    procedure(count_points), deferred :: points
    !> u = (A - datum) f.
    procedure(apply_to_forces), deferred :: apply
    !> The constant that `apply` subtracts from all coefficients of A. It changes
    !> v_0 only; left in A, a large constant costs the products their digits.
    procedure :: datum => no_datum
    !> The size of the terms of each displacement, by which its error is judged.
    procedure :: magnitude => largest_displacement
    !> `apply` and `magnitude` together; override it where one pass gives both.
    procedure :: apply_with_magnitude => apply_then_magnitude
    !> The least compliance between two points, which tells of points that nearly coincide.
    procedure :: least_pair_compliance => unknown_compliance
    !> Is there a preconditioner? Without one the conjugate gradients are not preconditioned.
    procedure :: has_preconditioner => without_preconditioner
    !> f = M u, with M symmetric, positive definite and close to the inverse of A.
    procedure :: precondition => copy_displacement
    !> Are displacements of open points of an area, continued from those of a contact set, good for the preconditioner?
    procedure :: extends_sets => extends_on_areas
    !> How fast displacements fall with the length of waves, on an area.
    procedure :: wave_slope => slope_of_half_space
    !> Is there a preconditioner of A on a bed?
    procedure :: has_preconditioner_on_bed => without_bed
    !> f = M u, with M symmetric, positive definite and close to the inverse of A + compliance.
    procedure :: precondition_on_bed => ignore_bed
    !> Are there products and a preconditioner in single precision?
    procedure :: has_single => without_single
    !> u = (A - datum) f in single precision.
    procedure :: apply_single => no_single
    !> f = M u in single precision.
    procedure :: precondition_single => no_single
    !> How much a spring gives way that all points press alike.
    procedure :: translation_spring => no_spring
    !> The size of the terms of the displacements, if it is the same for all points.
    procedure :: common_magnitude => no_common_magnitude
    !> The equal cells of a grid that the points are, in each direction.
    procedure :: grid => no_grid
    !> Does the surface go on beyond the grid, free, in each direction?
    procedure :: free_rim => no_free_rim
    !> The same body on wider cells, for nested iteration.
    procedure :: coarsen => no_coarser
    !> The coarser operator of `coarsen`, kept and owned by this one.
    procedure :: kept_coarser => none_kept
    !> The same body, but forces and displacements of a window of its cells only.
    procedure :: window => no_window
    !> Bounds of its eigenvalues and of the rounding of its products, by which solutions are proved.
    procedure :: bounds => no_bounds
    !> The processes that share the points.
    procedure :: ranks => no_other_ranks
    !> Which rows of the grid each of them has.
    procedure :: first_rows => all_rows_here
  end type fuge_operator

  !> What is certain of an operator; length per force.
  type, public :: operator_bounds
    !> Not above any eigenvalue of A on forces whose sum is zero, and on all forces. Unknown unless positive.
    real(dp) :: least_balanced = 0.0_dp, least = 0.0_dp
    !> Not below the 2-norm of A - datum, which has no negative eigenvalue but for rounding, and the same diagonal
    !> element for all points.
    real(dp) :: most = huge(1.0_dp)
    !> How far a displacement from `apply` is off at most, as a 2-norm of all points relative to that of the forces.
    real(dp) :: rounding = huge(1.0_dp)
    !> How far `datum` is off at most.
    real(dp) :: datum_rounding = 0.0_dp
  end type operator_bounds

  abstract interface
    !> Number of candidate points n; 0 while the operator is not set.
    pure function count_points(self) result(n)
      import :: fuge_operator
      class(fuge_operator), intent(in) :: self
      integer :: n
    end function count_points

    !> u = (A - datum) f: `force` (n), force; `displacement` (n), length. A `status` other than 0
    !> ends the solve: an error of `fuge_status` keeps its meaning, any other value becomes
    !> FUGE_ERR_CALLBACK with the value in the message. NaN and infinity are detected and
    !> need no status.
    subroutine apply_to_forces(self, force, displacement, status)
      import :: fuge_operator, dp
      class(fuge_operator), intent(in) :: self
      real(dp), intent(in) :: force(:)
      real(dp), intent(out) :: displacement(:)
      integer, intent(out) :: status
    end subroutine apply_to_forces
  end interface

contains

  !> False by default.
  function without_preconditioner(self) result(preconditioned)
    class(fuge_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%points() < 0
  end function without_preconditioner

  !> `displacement` (n), length; `force` (n), force; `status` as for `apply`. Called only
  !> if `has_preconditioner` is true. The default is M = 1.
  subroutine copy_displacement(self, displacement, force, status)
    class(fuge_operator), intent(in) :: self
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    force = displacement
    status = merge(FUGE_DONE, FUGE_ERR_SIZE, self%points() == size(displacement))
  end subroutine copy_displacement

  !> True by default on the cells of an area: M is close to the inverse of A for all of them together.
  function extends_on_areas(self) result(extends)
    class(fuge_operator), intent(in) :: self
    logical :: extends

    extends = all(self%grid() > 1)
  end function extends_on_areas

  !> The slope s of waves of some cells of the grid that is 2**`levels` times coarser: pressure displaces the surface in
  !> proportion to q**-s. 1 by default, as on a half-space.
  function slope_of_half_space(self, levels) result(slope)
    class(fuge_operator), intent(in) :: self
    integer, intent(in) :: levels
    real(dp) :: slope

    slope = 1.0_dp
    if (levels < 0 .or. self%points() < 0) slope = 0.0_dp
  end function slope_of_half_space

  !> False by default: compliances of the points are then not part of the preconditioner.
  function without_bed(self) result(preconditioned)
    class(fuge_operator), intent(in) :: self
    logical :: preconditioned

    preconditioned = self%points() < 0
  end function without_bed

  !> As `precondition`, where all points have the same `compliance` >= 0 besides, length per force, as on a Winkler bed.
  !> Called only if `has_preconditioner_on_bed` is true.
  subroutine ignore_bed(self, compliance, displacement, force, status)
    class(fuge_operator), intent(in) :: self
    real(dp), intent(in) :: compliance, displacement(:)
    real(dp), intent(out) :: force(:)
    integer, intent(out) :: status

    call self%precondition(displacement, force, status)
    if (.not. compliance >= 0.0_dp) status = FUGE_ERR_OPTION
  end subroutine ignore_bed

  !> False by default: all products are in double precision.
  function without_single(self) result(single)
    class(fuge_operator), intent(in) :: self
    logical :: single

    single = self%points() < 0
  end function without_single

  !> As `apply`, or as `precondition`, with errors of some 1e-7 of the largest result and without `translation_spring`;
  !> called only if `has_single` is true.
  subroutine no_single(self, input, result, status)
    class(fuge_operator), intent(in) :: self
    real(sp), intent(in) :: input(:)
    real(sp), intent(out) :: result(:)
    integer, intent(out) :: status

    result = 0.0_sp
    status = merge(FUGE_ERR_UNSUPPORTED, FUGE_ERR_SIZE, self%points() == size(input))
  end subroutine no_single

  !> The displacement of all points per resultant by a spring that is a part of A, but of no product and no
  !> preconditioning in single precision; length per force, 0 by default.
  function no_spring(self) result(flexibility)
    class(fuge_operator), intent(in) :: self
    real(dp) :: flexibility

    flexibility = 0.0_dp*real(self%points(), dp)
  end function no_spring

  !> What `magnitude` would give every point, where `largest` is the largest magnitude of a displacement and `total` the
  !> sum of the magnitudes of the forces; negative, as in this default, where points differ, or may.
  function no_common_magnitude(self, largest, total) result(magnitude)
    class(fuge_operator), intent(in) :: self
    real(dp), intent(in) :: largest, total
    real(dp) :: magnitude

    magnitude = -1.0_dp
    if (self%points() < 0) magnitude = -(largest + total)
  end function no_common_magnitude

  !> [nx, ny] if the points are equal cells of a grid, the number i + nx*(j - 1) for the cell i of row j; [n, 1]
  !> for cells side by side. [0, 0], as in this default, if the positions of the points are unknown.
  function no_grid(self) result(cells)
    class(fuge_operator), intent(in) :: self
    integer :: cells(2)

    cells = min(self%points(), 0)
  end function no_grid

  !> False by default: points that are no cells have no rim, and the bodies may end with the grid.
  function no_free_rim(self) result(free)
    class(fuge_operator), intent(in) :: self
    logical :: free(2)

    free = self%points() < 0
  end function no_free_rim

  !> `coarse` has 1/2**levels of the cells in each direction of `grid`, rounded up. Each of them replaces
  !> 2**levels by 2**levels cells of this operator, the last one of a direction maybe fewer. Unallocated if
  !> there is no such operator, as in this default. Called only if the points are cells of a grid.
  subroutine no_coarser(self, levels, coarse)
    class(fuge_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), allocatable, intent(out) :: coarse

    if (self%points() < 0 .and. levels < 0) allocate (coarse, source=self)
  end subroutine no_coarser

  !> `coarse` as by `coarsen`, but owned by this operator and valid as long as it is; call it
  !> before `coarsen`. Not associated if none is kept, as in this default. Several threads may ask at once.
  subroutine none_kept(self, levels, coarse)
    class(fuge_operator), intent(in) :: self
    integer, intent(in) :: levels
    class(fuge_operator), pointer, intent(out) :: coarse

    nullify (coarse)
    if (self%points() < 0 .and. levels < 0) allocate (coarse, source=self)
  end subroutine none_kept

  !> `part` has the cells `first`(1) .. `last`(1) of the rows `first`(2) .. `last`(2) of `grid`, numbered anew from
  !> the first one, and gives exactly the displacements that this operator gives for forces on them only, but perhaps
  !> with another datum. Its own grid can be coarsened again. Unallocated if there is no such operator, as in this
  !> default, for cells that do not exist, and without memory.
  subroutine no_window(self, first, last, part)
    class(fuge_operator), intent(in) :: self
    integer, intent(in) :: first(2), last(2)
    class(fuge_operator), allocatable, intent(out) :: part

    if (self%points() < 0 .and. any(last < first)) allocate (part, source=self)
  end subroutine no_window

  !> Nothing is certain by default. `status` as for `apply`.
  subroutine no_bounds(self, bounds, status)
    class(fuge_operator), intent(in) :: self
    type(operator_bounds), intent(out) :: bounds
    integer, intent(out) :: status

    status = FUGE_DONE
    if (self%points() < 0) bounds%most = 0.0_dp
  end subroutine no_bounds

  !> Where ranks of MPI share the points, `points` and all arrays are those of this rank, `grid` is the whole one,
  !> and all ranks call a procedure together. Alone, as in this default, one process has them all.
  function no_other_ranks(self) result(space)
    class(fuge_operator), intent(in) :: self
    type(point_space) :: space

    if (self%points() < 0) nullify (space%group)
  end function no_other_ranks

  !> On the grid that is `levels` times coarser, 0 for that of this operator, rank r has the rows `first`(r) to
  !> `first`(r + 1) - 1; `first` (0:ranks). All on one rank, as in this default, unless ranks share the points.
  !> Unallocated without memory.
  subroutine all_rows_here(self, levels, first)
    class(fuge_operator), intent(in) :: self
    integer, intent(in) :: levels
    integer, allocatable, intent(out) :: first(:)
    integer :: cells(2), stat

    cells = self%grid()
    allocate (first(0:1), stat=stat)
    if (stat == 0) first = [1, (cells(2) - 1)/2**levels + 2]
  end subroutine all_rows_here

  !> A_ii + A_jj - 2 A_ij, length per force, the least of all pairs of points marked in `contact` (n) that the rigid
  !> `modes` (n, m) move alike: by so much equal and opposite forces on them move them apart. Huge, as in this default,
  !> where the coefficients are unknown.
  function unknown_compliance(self, contact, modes) result(compliance)
    class(fuge_operator), intent(in) :: self
    logical, intent(in) :: contact(:)
    real(dp), intent(in) :: modes(:, :)
    real(dp) :: compliance

    compliance = huge(compliance)
    if (self%points() < 0 .and. size(contact) < size(modes, 1)) compliance = 0.0_dp
  end function unknown_compliance

  !> 0 by default: `apply` subtracts nothing.
  function no_datum(self) result(datum)
    class(fuge_operator), intent(in) :: self
    real(dp) :: datum

    datum = 0.0_dp*real(self%points(), dp)
  end function no_datum

  !> `magnitude` (n), length: sum_j |A_ij - datum| |f_j| at each point, the size of the terms of
  !> its displacement before they cancel. `displacement` (n) is what `apply` returns for `force` (n);
  !> this default takes the largest displacement for all points.
  subroutine largest_displacement(self, force, displacement, magnitude)
    class(fuge_operator), intent(in) :: self
    real(dp), intent(in) :: force(:), displacement(:)
    real(dp), intent(out) :: magnitude(:)

    magnitude = 0.0_dp
    if (self%points() == size(force)) magnitude = maxval(abs(displacement))
  end subroutine largest_displacement

  !> `displacement` and `status` as from `apply`, and if that succeeds `magnitude` as from `magnitude`; all (n). The
  !> certificate calls it once for each solution.
  subroutine apply_then_magnitude(self, force, displacement, magnitude, status)
    class(fuge_operator), intent(in) :: self
    real(dp), intent(in) :: force(:)
    real(dp), intent(out) :: displacement(:), magnitude(:)
    integer, intent(out) :: status

    magnitude = 0.0_dp
    call self%apply(force, displacement, status)
    if (status /= FUGE_DONE) return
    ! A product that is not finite is refused; its magnitude would only raise an exception.
    if (is_finite_everywhere(displacement)) call self%magnitude(force, displacement, magnitude)
  end subroutine apply_then_magnitude

end module fuge_operator_type
