!> One factorisation for a body that floats: its rigid modes, its pins and its factor with them.
!>
!> K + D is factorised, where D stiffens the degrees of freedom that are eliminated last: those that contact touches and
!> some scattered over the body, enough to resist every rigid motion. D changes the Schur complement S of
!> those alone, by D itself. The null space of S is that of K at these degrees of freedom, and pins among them only
!> change the factor of S.
module fuge_floating_factor
  use fuge_body_type, only: fuge_body
  use fuge_condensed_influence, only: touched_degrees
  use fuge_contact_normals, only: pin_scale
  use fuge_kinds, only: dp
  use fuge_lapack, only: dpotrf, dsyrk
  use fuge_rigid_body_modes, only: choose_pins, find_rigid_modes
  use fuge_status, only: fuge_info, FUGE_DONE
  use fuge_stiffness_dense, only: fuge_dense_stiffness
  use fuge_stiffness_type, only: fuge_stiffness, stiffness_factor
  implicit none
  private

  public :: factorise_floating

  !> Number of degrees of freedom, scattered over the bodies, from which pins may be chosen besides those that contact
  !> touches. 24 are enough for a block that floats upon another one.
  integer, parameter :: SCATTERED = 36
  !> D relative to the diagonal of K. Not larger than the diagonal, so that no digits are lost when it is subtracted.
  real(dp), parameter :: STIFFENING = 1.0_dp

contains

  !> `fixed` (degrees) and `scale` (degrees), the square root of the diagonal of K, zero where fixed, describe the body;
  !> the factor is that without `fixed` and `pins`. `found`: false if K, its softness or its storage does not allow this
  !> way, or without memory; `pins` and `factor` are not allocated then.
  subroutine factorise_floating(stiffness, body, fixed, scale, factor, pins, found)
    class(fuge_stiffness), intent(inout) :: stiffness
    type(fuge_body), intent(in) :: body
    logical, intent(in) :: fixed(:)
    real(dp), intent(in) :: scale(:)
    class(stiffness_factor), allocatable, intent(out) :: factor
    integer, allocatable, intent(out) :: pins(:)
    logical, intent(out) :: found
    real(dp), allocatable, target :: schur(:, :)
    real(dp) :: pivot
    integer :: status, weakest

    found = .false.
    stiffness%last = with_scattered(touched_degrees(body, fixed), fixed)
    stiffness%columns = size(body%dof, 2)
    stiffness%stiffening = STIFFENING
    call stiffness%factorise(fixed, 0.0_dp, factor, pivot, weakest, status)
    stiffness%stiffening = 0.0_dp
    if (.not. allocated(factor)) return
    if (allocated(factor%last)) then
      call find_schur(factor, scale, schur, status)
      if (status == FUGE_DONE) call pin(pin_scale(body, scale), scale, schur, factor, pins, found)
    end if
    if (.not. found) deallocate (factor)
  end subroutine factorise_floating

  !> `touched` and up to `SCATTERED` other degrees of freedom that are not `fixed`, ascending.
  pure function with_scattered(touched, fixed) result(last)
    integer, intent(in) :: touched(:)
    logical, intent(in) :: fixed(:)
    integer, allocatable :: last(:)
    logical, allocatable :: marked(:)
    integer :: j, k

    allocate (marked(size(fixed)))
    marked = .false.
    marked(touched) = .true.
    do k = 1, SCATTERED
      ! The golden ratio spreads any number of indices evenly; k is added for displacements in all directions, since
      ! such indices may all be even.
      j = int(modulo(real(k, dp)*0.5_dp*(sqrt(5.0_dp) - 1.0_dp), 1.0_dp)*real(size(fixed), dp)) + k
      j = 1 + modulo(j, size(fixed))
      marked(j) = .not. fixed(j)
    end do
    last = pack([(j, j=1, size(fixed))], marked)
  end function with_scattered

  !> The Schur complement S of the last degrees of freedom, both triangles. `status` is not FUGE_DONE without memory.
  subroutine find_schur(factor, scale, schur, status)
    class(stiffness_factor), intent(in) :: factor
    real(dp), intent(in) :: scale(:)
    real(dp), allocatable, intent(out) :: schur(:, :)
    integer, intent(out) :: status
    real(dp), allocatable :: root(:, :)
    integer :: i, j, p

    call factor%copy_schur_factor(root, status)
    p = size(factor%last)
    if (status == FUGE_DONE) allocate (schur(p, p), stat=status)
    if (status /= FUGE_DONE) return
    root = transpose(root)
    schur = 0.0_dp
    call dsyrk('U', 'T', p, p, 1.0_dp, root, p, 0.0_dp, schur, p)
    do j = 1, p
      schur(j, j) = schur(j, j) - STIFFENING*scale(factor%last(j))**2
      do i = 1, j - 1
        schur(j, i) = schur(i, j)
      end do
    end do
  end subroutine find_schur

  !> Choose the pins by the rigid modes of S, and let the factor have them.
  subroutine pin(pin_scale, scale, schur, factor, pins, found)
    real(dp), intent(in) :: pin_scale(:), scale(:)
    real(dp), intent(inout), target :: schur(:, :)
    class(stiffness_factor), intent(inout) :: factor
    integer, allocatable, intent(out) :: pins(:)
    logical, intent(out) :: found
    type(fuge_dense_stiffness) :: dense
    type(fuge_info) :: info
    logical, allocatable :: fixed(:)
    real(dp), allocatable :: modes(:, :)
    integer, allocatable :: isolated(:)
    integer :: p, status

    found = .false.
    p = size(schur, 2)
    allocate (fixed(p))
    fixed = .false.
    call dense%set(schur, info)
    if (.not. info%failed()) call find_rigid_modes(dense, fixed, scale(factor%last), modes, info, &
                                                   real(size(scale), dp)/real(p, dp))
    if (.not. info%failed()) call choose_pins(pin_scale(factor%last), modes, isolated, info)
    if (info%failed()) return
    call isolate(isolated, schur)
    call dpotrf('L', p, schur, p, status)
    found = status == 0
    if (.not. found) return
    call factor%replace_schur_factor(schur, isolated)
    pins = factor%last(isolated)
  end subroutine pin

  !> Replace rows and columns of a matrix by those of the identity.
  pure subroutine isolate(isolated, matrix)
    integer, intent(in) :: isolated(:)
    real(dp), intent(inout) :: matrix(:, :)
    integer :: k

    do k = 1, size(isolated)
      matrix(isolated(k), :) = 0.0_dp
      matrix(:, isolated(k)) = 0.0_dp
      matrix(isolated(k), isolated(k)) = 1.0_dp
    end do
  end subroutine isolate

end module fuge_floating_factor
