!> The operator's preconditioner on a contact set, in single precision, projected to forces without resultants.
!>
!> With B a basis of the rigid motions on the set and U = M B, P = 1 - U (B^T U)^-1 B^T projects forces along U to those
!> without resultants, and P M P^T is symmetric, whatever set U was computed for (doc/theory.md). So U is kept while the
!> set changes little.
!>
!> A spring on the translation, u = r (r^T f)/s for r = 1, is a part of the operator: with K = r^T U + s in the place of
!> r^T U the same is the inverse of M^-1 + r r^T/s (M. A. Woodbury), which is not singular.
module fuge_single_preconditioner
  use fuge_contact_iterate, only: contact_iterate
  use fuge_contact_scene, only: contact_scene
  use fuge_kinds, only: dp, sp
  use fuge_lapack, only: dgesv
  use fuge_operator_products, only: precondition_single
  use fuge_operator_type, only: fuge_operator
  use fuge_set_extension, only: set_extension, wave_slopes
  use fuge_single_passes, only: center_residuals, mark_contact, point_pass, sum_energy, sum_images, sum_with_images
  use fuge_single_state, only: single_state
  use fuge_status, only: fuge_info
  implicit none
  private

  !> state%images is kept while at most this fraction of the set has changed since it was computed, and of one motion
  !> while the set is at most that fraction of the points: residuals have to be centred then, in two more passes over
  !> the set.
  real(dp), parameter :: CLOSE = 0.05_dp, SMALL = 0.3_dp

  type, public :: single_preconditioner
    !> Points that have changed since state%images was computed, at most; negative: it never was.
    integer, private :: changed = -1
    !> Rigid motions that it was computed for.
    integer, private :: motions = 0
    !> Nothing has changed since the last `set`.
    logical, private :: current = .false.
    !> Gives residuals to open points too, and forces of these to the set.
    type(set_extension), private :: extension
    !> B^T U on the present set, (motions, motions).
    real(dp), allocatable, private :: products(:, :)
  contains
    procedure :: set
    procedure :: note_changes
    procedure :: apply
  end type single_preconditioner

contains

  !> `points` have joined or left the contact.
  elemental subroutine note_changes(self, points)
    class(single_preconditioner), intent(inout) :: self
    integer, intent(in) :: points

    if (self%changed >= 0) self%changed = self%changed + points
    self%current = self%current .and. points == 0
  end subroutine note_changes

  !> Prepare for the contact set of `iterate`. Errors: those of the operator.
  subroutine set(self, operator, scene, state, iterate, info)
    class(single_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(in), target :: iterate
    type(fuge_info), intent(inout) :: info

    if (self%current) return
    call self%extension%set(scene%rows, operator%grid(), iterate%contact, info, wave_slopes(operator))
    if (info%failed()) return
    if (state%motions > 0 .or. state%flexibility > 0.0_dp) then
      call set_images(self, operator, scene, state, iterate, info)
    else
      if (self%changed < 0) state%images = 0.0_sp
      self%changed = 0
    end if
    self%current = .not. info%failed()
  end subroutine set

  !> Compute state%images, unless those of a set which is close to this one serve. Errors: those of the operator.
  subroutine set_images(self, operator, scene, state, iterate, info)
    class(single_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(in), target :: iterate
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass
    real(dp) :: points
    integer :: j
    logical :: serves

    points = real(iterate%segments%points, dp)
    ! With a spring the images of another set do not keep it symmetric.
    serves = self%changed > 0 .and. self%motions == state%motions .and. .not. state%flexibility > 0.0_dp
    serves = serves .and. real(self%changed, dp) <= CLOSE*points
    if (serves .and. (points <= SMALL*real(scene%points(), dp) .or. state%motions > 1)) then
      call find_products(self, scene, state, iterate, serves)
      if (serves) return
    end if
    call state%point_to(scene, iterate, pass)
    do j = 1, state%columns
      pass%column = j
      call pass%go(mark_contact, 0, 0)
      call self%extension%extend(state%direction)
      call precondition_single(operator, state%direction, state%images(:, j), info)
      if (info%failed()) return
      call self%extension%collect(state%images(:, j))
    end do
    self%changed = 0
    self%motions = state%motions
    call find_products(self, scene, state, iterate, serves)
  end subroutine set_images

  !> B^T U on the present set; it `serves` if `solve` can do with it.
  subroutine find_products(self, scene, state, iterate, serves)
    class(single_preconditioner), intent(inout) :: self
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(in), target :: state
    type(contact_iterate), intent(in), target :: iterate
    logical, intent(out) :: serves
    type(point_pass) :: pass
    real(dp) :: test(columns_of(state))
    integer :: i, j, m

    m = columns_of(state)
    call state%point_to(scene, iterate, pass)
    call pass%go(sum_images, 0, m**2)
    if (allocated(self%products)) deallocate (self%products)
    allocate (self%products(m, m))
    do j = 1, m
      do i = 1, m
        self%products(i, j) = pass%total(m*(j - 1) + i)
      end do
    end do
    if (state%flexibility > 0.0_dp) self%products = self%products + 1.0_dp/state%flexibility
    test = 0.0_dp
    call solve(self%products, test, serves)
  end subroutine find_products

  !> Number of rigid motions that are free or on a spring.
  pure function columns_of(state) result(columns)
    type(single_state), intent(in) :: state
    integer :: columns

    columns = state%motions
    if (state%flexibility > 0.0_dp) columns = 1
  end function columns_of

  !> right := matrix**-1 right; not `possible` where the matrix is singular, or one number that is not positive.
  subroutine solve(matrix, right, possible)
    real(dp), intent(in) :: matrix(:, :)
    real(dp), intent(inout) :: right(:)
    logical, intent(out) :: possible
    real(dp) :: copy(size(right), size(right))
    integer :: pivots(size(right)), stat

    if (size(right) == 1) then
      possible = matrix(1, 1) > 0.0_dp
      if (possible) right = right/matrix(1, 1)
      return
    end if
    copy = matrix
    call dgesv(size(right), 1, copy, size(right), pivots, right, size(right), stat)
    possible = stat == 0
  end subroutine solve

  !> state%work less `factors` times state%images: forces on the contact whose displacements are close to the residuals
  !> and which have no resultants; where no motion is free the forces are state%work. `energy`: their inner product with
  !> the residuals, 0 where the images leave a motion out. Errors: those of the operator.
  subroutine apply(self, operator, scene, state, iterate, factors, energy, info)
    class(single_preconditioner), intent(inout) :: self
    class(fuge_operator), intent(in) :: operator
    type(contact_scene), intent(in), target :: scene
    type(single_state), intent(inout), target :: state
    type(contact_iterate), intent(in), target :: iterate
    real(dp), allocatable, intent(out) :: factors(:)
    real(dp), intent(out) :: energy
    type(fuge_info), intent(inout) :: info
    type(point_pass) :: pass
    real(dp) :: resultants(columns_of(state))
    logical :: possible
    integer :: j, m

    allocate (factors(state%columns), source=0.0_dp)
    energy = 0.0_dp
    m = columns_of(state)
    call state%point_to(scene, iterate, pass)
    if (self%changed > 0) then
      call pass%go(sum_with_images, 0, state%columns)
      resultants = [(pass%total(j), j=1, m)]
      call solve(transpose(self%products), resultants, possible)
      pass%factors(:m) = resultants
      pass%shift = resultants(1)
      call pass%go(center_residuals, 0, 0)
    end if
    call self%extension%extend(state%residual)
    call precondition_single(operator, state%residual, state%work, info)
    if (info%failed()) return
    call self%extension%collect(state%work)
    call pass%go(sum_energy, 0, 1 + state%columns)
    energy = pass%total(1)
    if (m == 0) return
    resultants = [(pass%total(1 + j), j=1, m)]
    factors(:m) = resultants
    call solve(self%products, factors(:m), possible)
    if (.not. possible) then
      energy = 0.0_dp
      return
    end if
    ! The inner products of the images and the residuals are those of the basis and `work`, or zero if they are centred.
    if (self%changed == 0) energy = energy - dot_product(factors(:m), resultants)
  end subroutine apply

end module fuge_single_preconditioner
