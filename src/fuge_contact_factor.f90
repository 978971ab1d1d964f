!> The equations of a contact set, factored so that near-by sets are cheap.
!>
!> On the contact set c_k = 0 and sum F = load: a symmetric system in the forces,
!> bordered by the rigid motion. The block of alpha is factored once for a base
!> set (Cholesky). A set that differs in a few points is the base with more
!> borders: a removed point by the condition F_k = 0, an added one by its column of
!> alpha. Eliminating the base leaves a small symmetric indefinite system, factored
!> anew for each set.
module fuge_contact_factor
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv, dpotrf, dsyrk, dsytrf, dsytrs, dtrsm, dtrsv
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  !> Borders allowed: so many, and one for each 8 points of the base. With more a new
  !> base is cheaper.
  integer, parameter :: LEAST_BORDERS = 16
  integer, parameter :: BASE_PER_BORDER = 8
  !> Key of the border that belongs to the rigid motion.
  integer, parameter :: RIGID = 0
  !> A pivot below this part of its diagonal, for each point of the base, is rounding.
  real(dp), parameter :: PIVOT_TOLERANCE = 16.0_dp*epsilon(1.0_dp)
  !> Ridges tried where alpha is singular, relative to its range.
  real(dp), parameter :: RIDGES(3) = [1.0e-12_dp, 1.0e-11_dp, 1.0e-10_dp]

  type, public :: contact_factor
    private
    !> Points of the base set, and where a point stands in it (0: not there).
    integer, allocatable :: base(:), place(:)
    !> Cholesky factor of alpha(base, base) - datum, plus the ridge on the diagonal.
    real(dp), allocatable :: lower(:, :)
    !> Taken from all of alpha; the rigid border makes the forces independent of it.
    real(dp), public :: datum = 0.0_dp
    !> 0 unless alpha is singular on a base: then its forces are not unique, and the
    !> ridge picks those of the least squares.
    real(dp), public :: ridge = 0.0_dp
    !> Largest diagonal over least pivot: a lower bound of the condition number.
    real(dp), public :: spread = 1.0_dp
    !> lower**(-1) times each border, and what the border is: RIGID, a point added
    !> (> 0) or a point removed (< 0).
    real(dp), allocatable :: border(:, :)
    integer, allocatable :: keys(:)
    integer :: borders = 0
    !> Factor of the small system.
    real(dp), allocatable :: small(:, :)
    integer, allocatable :: pivots(:)
  contains
    procedure :: set
    procedure :: is_set
    procedure :: solve
  end type contact_factor

contains

  !> Prepare for a contact set (n), at least one point.
  !> Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE.
  subroutine set(self, alpha, contact, status)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :)
    logical, intent(in) :: contact(:)
    integer, intent(out) :: status
    logical :: singular
    integer :: borders

    borders = huge(borders)
    if (allocated(self%base)) borders = 1 + count(contact .neqv. (self%place > 0))
    if (allocated(self%keys)) then
      if (borders <= size(self%keys)) then
        call amend(self, alpha, contact, singular)
        if (.not. singular) then
          status = FUGE_DONE
          return
        end if
      end if
    end if
    call build(self, alpha, contact, status)
    if (status /= FUGE_DONE) return
    call amend(self, alpha, contact, singular)
    if (singular) status = FUGE_ERR_NOT_DEFINITE
  end subroutine set

  !> Is there a factor to solve with?
  pure function is_set(self)
    class(contact_factor), intent(in) :: self
    logical :: is_set

    is_set = self%borders > 0
  end function is_set

  !> Take the contact set as the new base and factor its block.
  subroutine build(self, alpha, contact, status)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :)
    logical, intent(in) :: contact(:)
    integer, intent(out) :: status
    integer, parameter :: DATUMS = 10
    real(dp) :: nearest, range
    integer :: attempt
    logical :: done

    call choose_base(self, contact, status)
    if (status /= FUGE_DONE) return
    call extremes(alpha, self%base, nearest, range)
    ! Any datum will do that makes the block positive definite; alpha's own if it can.
    if (abs(nearest) <= range) then
      self%datum = 0.0_dp
      call factor_base(self, alpha, 0.0_dp, done)
      if (done) return
    end if
    do attempt = 0, DATUMS - 1
      self%datum = nearest - range*real(8**attempt - 1, dp)
      call factor_base(self, alpha, 0.0_dp, done)
      if (done) return
    end do
    self%datum = nearest - range
    do attempt = 1, size(RIDGES)
      call factor_base(self, alpha, RIDGES(attempt)*range, done)
      if (done) return
    end do
    call release(self)
    status = FUGE_ERR_NOT_DEFINITE
  end subroutine build

  subroutine choose_base(self, contact, status)
    class(contact_factor), intent(inout) :: self
    logical, intent(in) :: contact(:)
    integer, intent(out) :: status
    integer :: i, m, limit, stat

    m = count(contact)
    limit = LEAST_BORDERS + m/BASE_PER_BORDER
    call release(self)
    allocate (self%base(m), self%place(size(contact)), self%lower(m, m), self%border(m, limit), &
              self%keys(limit), self%small(limit, limit), self%pivots(limit), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) then
      call release(self)
      return
    end if
    self%base = pack([(i, i=1, size(contact))], contact)
    self%place = 0
    self%place(self%base) = [(i, i=1, m)]
  end subroutine choose_base

  pure subroutine release(self)
    class(contact_factor), intent(inout) :: self

    self%borders = 0
    if (allocated(self%base)) deallocate (self%base)
    if (allocated(self%place)) deallocate (self%place)
    if (allocated(self%lower)) deallocate (self%lower)
    if (allocated(self%border)) deallocate (self%border)
    if (allocated(self%keys)) deallocate (self%keys)
    if (allocated(self%small)) deallocate (self%small)
    if (allocated(self%pivots)) deallocate (self%pivots)
  end subroutine release

  subroutine factor_base(self, alpha, ridge, done)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: ridge
    logical, intent(out) :: done
    real(dp) :: diagonal(size(self%base))
    integer :: i, j, m, info

    m = size(self%base)
    do j = 1, m
      do i = j, m
        self%lower(i, j) = alpha(self%base(i), self%base(j)) - self%datum
      end do
      self%lower(j, j) = self%lower(j, j) + ridge
      diagonal(j) = self%lower(j, j)
    end do
    self%ridge = ridge
    call dpotrf('L', m, self%lower, m, info)
    done = info == 0
    if (.not. done) return
    self%spread = 1.0_dp
    do j = 1, m
      done = done .and. self%lower(j, j)**2 > PIVOT_TOLERANCE*real(m, dp)*diagonal(j)
      if (done) self%spread = max(self%spread, maxval(diagonal)/self%lower(j, j)**2)
    end do
  end subroutine factor_base

  !> Coefficient of a block nearest to zero, and the range of its coefficients; for
  !> equal ones, as of a single point, a range of their own size.
  pure subroutine extremes(alpha, points, nearest, range)
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(in) :: points(:)
    real(dp), intent(out) :: nearest, range
    real(dp) :: least, most
    integer :: j

    least = huge(least)
    most = -huge(most)
    do j = 1, size(points)
      least = min(least, minval(alpha(points(j:), points(j))))
      most = max(most, maxval(alpha(points(j:), points(j))))
    end do
    range = most - least
    if (.not. range > 0.0_dp) then
      range = merge(abs(least), 1.0_dp, abs(least) > 0.0_dp)
      most = least
      least = least - range
    end if
    ! The coefficient nearest to zero, 0 if there are both signs: taken from a
    ! coefficient it costs no digits.
    nearest = max(least, 0.0_dp) + min(most, 0.0_dp)
  end subroutine extremes

  !> Borders for a set near the base, kept from before where they can be.
  subroutine amend(self, alpha, contact, singular)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :)
    logical, intent(in) :: contact(:)
    logical, intent(out) :: singular
    integer :: wanted(1 + count(contact .neqv. (self%place > 0)))
    integer :: first_new, j, m

    m = size(self%base)
    wanted = keys_of(self, contact, size(wanted))
    call keep_borders(self, wanted)
    first_new = self%borders + 1
    do j = 1, size(wanted)
      if (any(self%keys(:self%borders) == wanted(j))) cycle
      self%borders = self%borders + 1
      self%keys(self%borders) = wanted(j)
      call fill_border(self, alpha, wanted(j), self%border(:, self%borders))
    end do
    if (self%borders >= first_new) then
      call dtrsm('L', 'L', 'N', 'N', m, self%borders - first_new + 1, 1.0_dp, self%lower, m, &
                 self%border(:, first_new:), m)
    end if
    call factor_small(self, alpha, singular)
  end subroutine amend

  pure function keys_of(self, contact, number) result(keys)
    class(contact_factor), intent(in) :: self
    logical, intent(in) :: contact(:)
    integer, intent(in) :: number
    integer :: keys(number)
    integer :: j, k

    keys(1) = RIGID
    j = 1
    do k = 1, size(contact)
      if (contact(k) .eqv. self%place(k) > 0) cycle
      j = j + 1
      keys(j) = merge(k, -k, contact(k))
    end do
  end function keys_of

  pure subroutine keep_borders(self, wanted)
    class(contact_factor), intent(inout) :: self
    integer, intent(in) :: wanted(:)
    integer :: j, kept

    kept = 0
    do j = 1, self%borders
      if (.not. any(wanted == self%keys(j))) cycle
      kept = kept + 1
      if (kept == j) cycle
      self%keys(kept) = self%keys(j)
      self%border(:, kept) = self%border(:, j)
    end do
    self%borders = kept
  end subroutine keep_borders

  pure subroutine fill_border(self, alpha, key, column)
    class(contact_factor), intent(in) :: self
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(in) :: key
    real(dp), intent(inout) :: column(:)

    if (key == RIGID) then
      column = -1.0_dp
    else if (key < 0) then
      column = 0.0_dp
      column(self%place(-key)) = -1.0_dp
    else
      column = alpha(self%base, key) - self%datum
    end if
  end subroutine fill_border

  !> What is left of the borders once the base is eliminated. `singular` when an
  !> added point depends on the base.
  subroutine factor_small(self, alpha, singular)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :)
    logical, intent(out) :: singular
    real(dp) :: work(64*self%borders), diagonal(self%borders)
    integer :: i, j, m, p, limit, info

    m = size(self%base)
    p = self%borders
    limit = size(self%small, 1)
    do j = 1, p
      do i = j, p
        self%small(i, j) = corner(self, alpha, self%keys(i), self%keys(j))
      end do
      diagonal(j) = self%small(j, j)
    end do
    call dsyrk('L', 'T', p, m, -1.0_dp, self%border, m, 1.0_dp, self%small, limit)
    singular = .false.
    do j = 1, p
      if (self%keys(j) <= 0) cycle
      singular = singular .or. self%small(j, j) <= PIVOT_TOLERANCE*real(m, dp)*diagonal(j)
      if (.not. singular) self%spread = max(self%spread, diagonal(j)/self%small(j, j))
    end do
    if (singular) return
    call dsytrf('L', p, self%small, limit, self%pivots, work, size(work), info)
    singular = info /= 0
    if (.not. singular) singular = negatives(self) /= count(self%keys(:p) <= 0)
  end subroutine factor_small

  !> Negative eigenvalues of the small system: one for the rigid motion and one for each
  !> point removed if alpha is positive definite on the set, on forces with zero sum.
  pure function negatives(self) result(number)
    class(contact_factor), intent(in) :: self
    integer :: number
    integer :: j

    number = 0
    j = 1
    do while (j <= self%borders)
      ! A block of two has one eigenvalue of each sign.
      if (self%pivots(j) < 0 .or. self%small(j, j) < 0.0_dp) number = number + 1
      j = j + merge(1, 2, self%pivots(j) > 0)
    end do
  end function negatives

  !> Entry of the bordered matrix between two borders.
  pure function corner(self, alpha, row, column) result(entry)
    class(contact_factor), intent(in) :: self
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(in) :: row, column
    real(dp) :: entry

    entry = 0.0_dp
    if (row > 0 .and. column > 0) then
      entry = alpha(row, column) - self%datum
      if (row == column) entry = entry + self%ridge
    else if (max(row, column) > 0 .and. min(row, column) == RIGID) then
      entry = -1.0_dp
    end if
  end function corner

  !> Forces (n) and motion with (alpha - datum) F - motion = -gap on the contact set,
  !> sum F = load, F = 0 elsewhere. `gap` (n), read on the set only.
  subroutine solve(self, gap, load, force, motion)
    class(contact_factor), intent(in) :: self
    real(dp), intent(in) :: gap(:), load
    real(dp), intent(out) :: force(:), motion
    real(dp) :: in_base(size(self%base)), outer(self%borders)
    integer :: j, m, p, info

    m = size(self%base)
    p = self%borders
    in_base = -gap(self%base)
    outer = 0.0_dp
    do j = 1, p
      if (self%keys(j) == RIGID) outer(j) = -load
      if (self%keys(j) > 0) outer(j) = -gap(self%keys(j))
      ! The gap of a removed point is no condition; a large one would only cost digits.
      if (self%keys(j) < 0) in_base(self%place(-self%keys(j))) = 0.0_dp
    end do
    call dtrsv('L', 'N', 'N', m, self%lower, m, in_base, 1)
    call dgemv('T', m, p, -1.0_dp, self%border, m, in_base, 1, 1.0_dp, outer, 1)
    call dsytrs('L', p, 1, self%small, size(self%small, 1), self%pivots, outer, p, info)
    call dgemv('N', m, p, -1.0_dp, self%border, m, outer, 1, 1.0_dp, in_base, 1)
    call dtrsv('L', 'T', 'N', m, self%lower, m, in_base, 1)

    force = 0.0_dp
    force(self%base) = in_base
    motion = 0.0_dp
    do j = 1, p
      if (self%keys(j) == RIGID) motion = outer(j)
      if (self%keys(j) > 0) force(self%keys(j)) = outer(j)
      if (self%keys(j) < 0) force(-self%keys(j)) = 0.0_dp
    end do
  end subroutine solve

end module fuge_contact_factor
