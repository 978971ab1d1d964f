!> Bounds of e and e_q with A e - R e_q = r, R^T e + S e_q = s, from the least eigenvalue of A + R W R^T.
!>
!> The work of the residuals is the energy, e . A e + e_q . S e_q = e . r + e_q . s. With W S <= 1/2 it is not below
!> e . (A + R W R^T) e - 2 s . W s, and so not below lambda |e|**2 - 2 s . W s. The other way round
!> R e_q = A e - r and S e_q = s - R^T e bound e_q, if R and S together move each motion.
module fuge_energy_bound
  use fuge_kinds, only: dp
  use fuge_rounding_bounds, only: absolute_product, gamma_bound, norm_bound, raised, UNIT_ROUNDOFF
  use fuge_scaled_contact, only: scaled_contact
  use fuge_verified_definite, only: prove_definite
  use fuge_lapack, only: dsyev
  implicit none
  private

  !> The least part of the computed eigenvalue that is proved.
  real(dp), parameter :: PART = 0.5_dp

  type, public :: energy_bound
    !> Do the points hold all motions?
    logical :: is_held = .false.
    !> Not above the least eigenvalue; not below the 2-norms of A and of R; the largest weight.
    real(dp), private :: least = 0.0_dp, matrix_norm = 0.0_dp, modes_norm = 0.0_dp, weight = 0.0_dp
    !> Not above the least singular value of R and S together.
    real(dp), private :: held = 0.0_dp
  contains
    procedure :: prepare
    procedure :: bound
  end type energy_bound

contains

  !> Prepare for the points `place` and the motions `motion_place` of `contact`. `stat` is not 0 without memory.
  subroutine prepare(self, contact, place, motion_place, stat)
    class(energy_bound), intent(inout) :: self
    type(scaled_contact), intent(in) :: contact
    integer, intent(in) :: place(:), motion_place(:)
    integer, intent(out) :: stat
    real(dp), allocatable :: gram(:, :), modes(:, :), sums(:), terms(:)
    integer :: j, m

    m = size(motion_place)
    allocate (modes(size(place), m), gram(m, m), sums(contact%points), terms(contact%points), stat=stat)
    if (stat /= 0) return
    self%least = contact%least
    self%weight = maxval([0.0_dp, contact%weight(motion_place)])
    terms = 0.0_dp
    terms(place) = 1.0_dp
    call absolute_product(contact%matrix, terms, sums)
    ! What the rounding of A + D took counts, too.
    self%matrix_norm = raised(maxval([0.0_dp, sums(place)]), 4)
    modes = contact%modes(place, motion_place)
    self%modes_norm = 0.0_dp
    do j = 1, m
      self%modes_norm = raised(self%modes_norm + norm_bound(modes(:, j)), 2)
      gram(:, j) = matmul(modes(:, j), modes)
      gram(j, j) = gram(j, j) + contact%stiffness(motion_place(j))**2
    end do
    call find_held(gram, size(place), self%held)
    self%is_held = self%held > 0.0_dp .or. m == 0
  end subroutine prepare

  !> A lower bound of the least singular value of which `gram` (m, m) has the squares, sums of `terms` products, at most
  !> 1 each; 0 if none is proved.
  subroutine find_held(gram, terms, held)
    real(dp), intent(in), contiguous :: gram(:, :)
    integer, intent(in) :: terms
    real(dp), intent(out) :: held
    real(dp) :: copy(size(gram, 1), size(gram, 1)), values(size(gram, 1)), work(8*size(gram, 1) + 8), error
    integer :: info, j, m
    logical :: is_proved

    m = size(gram, 1)
    held = 0.0_dp
    if (m < 1) return
    copy = gram
    call dsyev('N', 'L', m, copy, m, values, work, size(work), info)
    if (info /= 0 .or. .not. values(1) > 0.0_dp) return
    copy = gram
    do j = 1, m
      copy(j, j) = copy(j, j) - PART*values(1)
    end do
    error = raised(gamma_bound(terms + 8)*real(m, dp)*real(terms + 1, dp), 4)
    call prove_definite(copy, error, is_proved)
    if (is_proved) held = sqrt(PART*values(1))*(1.0_dp - 4.0_dp*UNIT_ROUNDOFF)
  end subroutine find_held

  !> Bounds of the 2-norms of e and e_q, from those of r and s.
  pure subroutine bound(self, point_residual, motion_residual, points, motions)
    class(energy_bound), intent(in) :: self
    real(dp), intent(in) :: point_residual, motion_residual
    real(dp), intent(out) :: points, motions
    real(dp) :: constant, linear, per_motion

    per_motion = 0.0_dp
    if (self%held > 0.0_dp) per_motion = raised(1.0_dp/self%held, 1)
    linear = point_residual + (self%matrix_norm + self%modes_norm)*motion_residual*per_motion
    linear = raised(linear/self%least, 6)
    constant = (point_residual + motion_residual)*per_motion/self%least
    constant = sqrt(motion_residual)*sqrt(constant + 2.0_dp*self%weight*motion_residual/self%least)
    points = raised(linear + constant, 12)
    motions = raised(((self%matrix_norm + self%modes_norm)*points + point_residual + motion_residual)*per_motion, 8)
  end subroutine bound

end module fuge_energy_bound
