!> The rigid motions of a contact set: a basis of them that is orthonormal on the set.
!>
!> Lengths on the set split into a rigid motion and the rest, which is orthogonal to all rigid motions; forces are
!> corrected by the least change that gives the resultants.
module fuge_mode_projection
  use fuge_contact_segments, only: contact_segments, dot_over
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> A mode is a combination of the others on the set if its remainder is below this fraction: modes about a far-away
  !> point have lost digits when they were made orthogonal.
  real(dp), parameter :: DEPENDENT = 1.0e-10_dp
  !> The error of a resultant counts as rounding up to this many units in the last place of its terms, times the root of
  !> their number.
  real(dp), parameter :: ROUNDINGS = 8.0_dp

  !> Set it for a contact set; it belongs to that set only.
  type, public :: mode_projection
    !> modes*coefficients at all points, (n, m), the first `rank` columns orthonormal on the set; length.
    real(dp), allocatable :: basis(:, :)
    !> (m, m), the first `rank` columns.
    real(dp), allocatable, private :: coefficients(:, :)
    !> Number of motions that the set resists.
    integer :: rank = 0
  contains
    procedure :: set
    procedure :: components
    procedure :: subtract_on
    procedure :: subtract
    procedure :: motion
    procedure :: correct_resultants
    procedure :: largest_force
  end type mode_projection

contains

  !> The basis for `modes` (n, m) on the set with these segments. Error: FUGE_ERR_MEMORY.
  subroutine set(self, modes, segments, info)
    class(mode_projection), intent(inout) :: self
    real(dp), intent(in), contiguous :: modes(:, :)
    type(contact_segments), intent(in) :: segments
    type(fuge_info), intent(inout) :: info
    integer :: j, m, stat

    m = size(modes, 2)
    stat = 0
    if (.not. allocated(self%basis)) allocate (self%basis(size(modes, 1), m), self%coefficients(m, m), stat=stat)
    call require_memory(stat, 'the rigid motions of', size(modes, 1), 'points', info)
    call segments%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    self%rank = 0
    do j = 1, m
      call append(self, modes(:, j), j, segments)
    end do
  end subroutine set

  !> Append mode number `j` to the basis, unless it is a combination of those before it on the set.
  subroutine append(self, mode, j, segments)
    class(mode_projection), intent(inout) :: self
    real(dp), intent(in), contiguous :: mode(:)
    integer, intent(in) :: j
    type(contact_segments), intent(in) :: segments
    real(dp) :: component, usual_size, size_after
    integer :: i, pass, r

    ! Not that on the set, where all that is left of a mode may be rounding.
    usual_size = segments%space%largest(maxval(abs(mode)))*sqrt(real(segments%points, dp))
    if (.not. usual_size > 0.0_dp) return
    r = self%rank + 1
    self%basis(:, r) = mode
    self%coefficients(:, r) = 0.0_dp
    self%coefficients(j, r) = 1.0_dp
    ! Twice, because what the first projection leaves is rounded.
    do pass = 1, 2
      do i = 1, self%rank
        component = dot_over(segments, self%basis(:, i), self%basis(:, r))
        self%basis(:, r) = self%basis(:, r) - component*self%basis(:, i)
        self%coefficients(:, r) = self%coefficients(:, r) - component*self%coefficients(:, i)
      end do
    end do
    size_after = sqrt(dot_over(segments, self%basis(:, r), self%basis(:, r)))
    if (.not. size_after > DEPENDENT*usual_size) return
    self%basis(:, r) = self%basis(:, r)/size_after
    self%coefficients(:, r) = self%coefficients(:, r)/size_after
    self%rank = r
  end subroutine append

  !> Components of `x` (n) on the set in the basis: the `factors` (m) of its columns, zero beyond the rank.
  subroutine components(self, segments, x, factors)
    class(mode_projection), intent(in) :: self
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in), contiguous :: x(:)
    real(dp), intent(out) :: factors(:)
    integer :: i

    factors = 0.0_dp
    do i = 1, self%rank
      factors(i) = dot_over(segments, self%basis(:, i), x)
    end do
  end subroutine components

  !> Subtract the motion with these factors from `x` (n) on the set.
  pure subroutine subtract_on(self, segments, factors, x)
    class(mode_projection), intent(in) :: self
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: factors(:)
    real(dp), intent(inout), contiguous :: x(:)
    integer :: i, j

    do i = 1, size(segments%first)
      associate (a => segments%first(i), b => segments%last(i))
        do j = 1, self%rank
          x(a:b) = x(a:b) - factors(j)*self%basis(a:b, j)
        end do
      end associate
    end do
  end subroutine subtract_on

  !> Subtract the motion with these factors from `x` (n) at all points.
  pure subroutine subtract(self, factors, x)
    class(mode_projection), intent(in) :: self
    real(dp), intent(in) :: factors(:)
    real(dp), intent(inout), contiguous :: x(:)
    integer :: j

    do j = 1, self%rank
      x = x - factors(j)*self%basis(:, j)
    end do
  end subroutine subtract

  !> The motion (m) in the modes that has these factors in the basis.
  pure function motion(self, factors)
    class(mode_projection), intent(in) :: self
    real(dp), intent(in) :: factors(:)
    real(dp) :: motion(size(factors))
    integer :: i

    motion = 0.0_dp
    do i = 1, self%rank
      motion = motion + factors(i)*self%coefficients(:, i)
    end do
  end function motion

  !> Change `force` (n) on the set by the least that gives the resultants `load` (m) in `modes` (n, m); `possible` if
  !> the set can carry them, with forces of either sign.
  subroutine correct_resultants(self, modes, load, segments, force, possible)
    class(mode_projection), intent(in) :: self
    real(dp), intent(in), contiguous :: modes(:, :)
    real(dp), intent(in) :: load(:)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(inout), contiguous :: force(:)
    logical, intent(out) :: possible
    real(dp) :: missing(size(load)), terms(size(load)), factors(size(load))
    integer :: pass

    do pass = 1, 2
      call find_missing(modes, load, segments, force, missing, terms)
      factors = 0.0_dp
      factors(:self%rank) = -matmul(missing, self%coefficients(:, :self%rank))
      call self%subtract_on(segments, factors, force)
    end do
    call find_missing(modes, load, segments, force, missing, terms)
    possible = all(abs(missing) <= ROUNDINGS*epsilon(missing)*sqrt(real(segments%points, dp)) &
                   *max(terms, maxval(abs(load))))
  end subroutine correct_resultants

  !> The largest of the least forces on the set that make resultants up to `load` (m), of any sign: a bound.
  function largest_force(self, segments, load) result(force)
    class(mode_projection), intent(in) :: self
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: load(:)
    real(dp) :: force
    real(dp) :: factors(self%rank)
    integer :: i, k

    force = 0.0_dp
    factors = [(sum(load*abs(self%coefficients(:, i))), i=1, self%rank)]
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i)
        force = max(force, sum(factors*abs(self%basis(k, :self%rank))))
      end do
    end do
    force = segments%space%largest(force)
  end function largest_force

  !> The resultants that `force` (n) lacks, `missing`, and the magnitudes of their `terms`, (m).
  subroutine find_missing(modes, load, segments, force, missing, terms)
    real(dp), intent(in), contiguous :: modes(:, :), force(:)
    real(dp), intent(in) :: load(:)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(out) :: missing(:)
    real(dp), intent(out), contiguous :: terms(:)
    integer :: i, j, k

    terms = 0.0_dp
    do j = 1, size(load)
      missing(j) = load(j) - dot_over(segments, modes(:, j), force)
      do i = 1, size(segments%first)
        do k = segments%first(i), segments%last(i)
          terms(j) = terms(j) + abs(modes(k, j)*force(k))
        end do
      end do
    end do
    call segments%space%add(terms)
    terms = terms + abs(load)
  end subroutine find_missing

end module fuge_mode_projection
