!> The equations of a contact set, factored so that near-by sets are cheap.
!>
!> On the contact set the gaps are given and R^T F = w: a symmetric system in the forces,
!> bordered by the rigid motions. The block of alpha is factored once for a base
!> set (Cholesky). A set that differs in a few points is the base with more
!> borders: a removed point by the condition F_k = 0, an added one by its column of
!> alpha. Eliminating the base leaves a small symmetric indefinite system, factored
!> anew for each set.
module fuge_kkt_factor
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv, dpotrf, dsyrk, dsytrf, dsytrs, dtrsm, dtrsv
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  !> Borders allowed: so many, and one for each 8 points of the base. With more a new
  !> base is cheaper.
  integer, parameter :: LEAST_BORDERS = 16
  integer, parameter :: BASE_PER_BORDER = 8
  !> Springs that hold a motion which the contact set leaves free, relative to its own
  !> stiffness: forces stay those of equilibrium, as far as there is any.
  real(dp), parameter :: SPRING = 1.0e-14_dp
  !> A pivot below this part of its diagonal, for each point of the base, is rounding.
  real(dp), parameter :: PIVOT_TOLERANCE = 16.0_dp*epsilon(1.0_dp)
  !> Ridges tried where alpha is singular, relative to its range.
  real(dp), parameter :: RIDGES(3) = [1.0e-12_dp, 1.0e-11_dp, 1.0e-10_dp]

  type, public :: contact_factor
    private
    !> Points of the base set, and where a point stands in it (0: not there).
    integer, allocatable :: base(:), place(:)
    !> Rigid motions, (n, m).
    real(dp), allocatable :: modes(:, :)
    !> Cholesky factor of alpha - datum + stiffening R R^T on the base, plus the ridge.
    real(dp), allocatable :: lower(:, :)
    !> Taken from all of alpha where the first motion is a translation, and added along
    !> the motions where it is not: only the motions see them.
    real(dp), public :: datum = 0.0_dp
    real(dp) :: stiffening = 0.0_dp
    !> 0 unless alpha is singular on a base: then its forces are not unique, and the
    !> ridge picks those of the least squares.
    real(dp), public :: ridge = 0.0_dp
    !> Largest diagonal over least pivot: a lower bound of the condition number.
    real(dp), public :: spread = 1.0_dp
    !> lower**(-1) times each border, and what the border is: a point added (1 .. n), a
    !> motion (n+1 .. n+m) or a point removed (< 0).
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

  !> Prepare for a contact set (n); at least one point if there is one motion only.
  !>
  !> `modes` (n, m) rigid motions, `constant` if the first one is 1 at all points.
  !> Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE.
  subroutine set(self, alpha, modes, constant, contact, status)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :), modes(:, :)
    logical, intent(in) :: constant, contact(:)
    integer, intent(out) :: status
    logical :: singular
    integer :: borders

    borders = huge(borders)
    if (allocated(self%base)) borders = size(modes, 2) + count(contact .neqv. (self%place > 0))
    if (allocated(self%keys)) then
      if (borders <= size(self%keys)) then
        call amend(self, alpha, contact, singular)
        if (.not. singular) then
          status = FUGE_DONE
          return
        end if
      end if
    end if
    call build(self, alpha, modes, constant, contact, status)
    if (status /= FUGE_DONE) return
    call amend(self, alpha, contact, singular)
    if (singular) status = FUGE_ERR_NOT_DEFINITE
  end subroutine set

  !> Is there a factor to solve with?
  pure function is_set(self)
    class(contact_factor), intent(in) :: self
    logical :: is_set

    is_set = allocated(self%base)
  end function is_set

  !> Take the contact set as the new base and factor its block.
  subroutine build(self, alpha, modes, constant, contact, status)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :), modes(:, :)
    logical, intent(in) :: constant, contact(:)
    integer, intent(out) :: status
    integer, parameter :: DATUMS = 10
    real(dp) :: nearest, range
    integer :: attempt
    logical :: done

    call choose_base(self, modes, contact, status)
    if (status /= FUGE_DONE) return
    self%datum = 0.0_dp
    self%stiffening = 0.0_dp
    call extremes(alpha, self%base, nearest, range)
    ! Any datum will do that makes the block positive definite; alpha's own if it can.
    if (abs(nearest) <= range .or. .not. constant) then
      call factor_base(self, alpha, 0.0_dp, done)
      if (done) return
    end if
    do attempt = 0, DATUMS - 1
      if (constant) self%datum = nearest - range*real(8**attempt - 1, dp)
      ! One translation needs no more than the datum; other motions stiffen alpha too.
      if (size(modes, 2) > merge(1, 0, constant) .and. (attempt > 0 .or. .not. constant)) then
        self%stiffening = range*real(8**attempt, dp)
      end if
      call factor_base(self, alpha, 0.0_dp, done)
      if (done) return
    end do
    if (constant) self%datum = nearest - range
    self%stiffening = merge(range, 0.0_dp, size(modes, 2) > merge(1, 0, constant))
    do attempt = 1, size(RIDGES)
      call factor_base(self, alpha, RIDGES(attempt)*range, done)
      if (done) return
    end do
    call release(self)
    status = FUGE_ERR_NOT_DEFINITE
  end subroutine build

  subroutine choose_base(self, modes, contact, status)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: contact(:)
    integer, intent(out) :: status
    integer :: i, m, limit, stat

    m = count(contact)
    limit = LEAST_BORDERS + m/BASE_PER_BORDER + size(modes, 2)
    call release(self)
    allocate (self%base(m), self%place(size(contact)), self%lower(m, m), self%border(m, limit), &
              self%keys(limit), self%small(limit, limit), self%pivots(limit), &
              self%modes(size(modes, 1), size(modes, 2)), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) then
      call release(self)
      return
    end if
    self%modes = modes
    self%base = pack([(i, i=1, size(contact))], contact)
    self%place = 0
    self%place(self%base) = [(i, i=1, m)]
  end subroutine choose_base

  pure subroutine release(self)
    class(contact_factor), intent(inout) :: self

    self%borders = 0
    if (allocated(self%base)) deallocate (self%base)
    if (allocated(self%place)) deallocate (self%place)
    if (allocated(self%modes)) deallocate (self%modes)
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
      if (self%stiffening > 0.0_dp) then
        self%lower(j:, j) = self%lower(j:, j) + along_motions(self, self%base(j:), self%base(j))
      end if
      self%lower(j, j) = self%lower(j, j) + ridge
      diagonal(j) = self%lower(j, j)
    end do
    self%ridge = ridge
    self%spread = 1.0_dp
    done = .true.
    if (m < 1) return
    call dpotrf('L', m, self%lower, m, info)
    done = info == 0
    if (.not. done) return
    do j = 1, m
      done = done .and. self%lower(j, j)**2 > PIVOT_TOLERANCE*real(m, dp)*diagonal(j)
      if (done) self%spread = max(self%spread, maxval(diagonal)/self%lower(j, j)**2)
    end do
  end subroutine factor_base

  !> What is added to the coefficients of `rows` in a column of alpha along the motions.
  pure function along_motions(self, rows, column) result(added)
    class(contact_factor), intent(in) :: self
    integer, intent(in) :: rows(:), column
    real(dp) :: added(size(rows))
    integer :: j

    added = 0.0_dp
    do j = 1, size(self%modes, 2)
      added = added + (self%stiffening*self%modes(column, j))*self%modes(rows, j)
    end do
  end function along_motions

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
    if (size(points) < 1) then
      least = 0.0_dp
      most = 0.0_dp
    end if
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
    integer :: wanted(size(self%modes, 2) + count(contact .neqv. (self%place > 0)))
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
    if (self%borders >= first_new .and. m > 0) then
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

    do j = 1, size(self%modes, 2)
      keys(j) = size(contact) + j
    end do
    j = size(self%modes, 2)
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

    if (is_motion(self, key)) then
      column = -self%modes(self%base, key - size(self%place))
    else if (key < 0) then
      column = 0.0_dp
      column(self%place(-key)) = -1.0_dp
    else
      column = alpha(self%base, key) - self%datum
      if (self%stiffening > 0.0_dp) column = column + along_motions(self, self%base, key)
    end if
  end subroutine fill_border

  !> Does the border belong to a rigid motion?
  elemental function is_motion(self, key) result(motion)
    class(contact_factor), intent(in) :: self
    integer, intent(in) :: key
    logical :: motion

    motion = key > size(self%place)
  end function is_motion

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
    singular = .false.
    if (p < 1) return
    if (m > 0) call dsyrk('L', 'T', p, m, -1.0_dp, self%border, m, 1.0_dp, self%small, limit)
    call hold_free_motions(self, alpha)
    do j = 1, p
      if (self%keys(j) < 0 .or. is_motion(self, self%keys(j))) cycle
      singular = singular .or. self%small(j, j) <= PIVOT_TOLERANCE*real(m, dp)*diagonal(j)
      if (.not. singular) self%spread = max(self%spread, diagonal(j)/self%small(j, j))
    end do
    if (singular) return
    call dsytrf('L', p, self%small, limit, self%pivots, work, size(work), info)
    singular = info /= 0
    if (.not. singular) singular = negatives(self) /= count(self%keys(:p) < 0 .or. &
                                                                 is_motion(self, self%keys(:p)))
  end subroutine factor_small

  !> Several motions may be more than a contact set can hold: weak springs do then. One
  !> translation is always held.
  pure subroutine hold_free_motions(self, alpha)
    class(contact_factor), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :)
    real(dp) :: stiffness, largest
    integer :: j

    if (size(self%modes, 2) == 1 .and. size(self%base) > 0 .and. all(abs(self%modes - 1.0_dp) <= 0.0_dp)) return
    largest = 0.0_dp
    do j = 1, self%borders
      if (is_motion(self, self%keys(j))) largest = max(largest, abs(self%small(j, j)))
    end do
    if (.not. largest > 0.0_dp) then
      ! No contact at all: the stiffness that any would have.
      do j = 1, size(self%place)
        largest = max(largest, abs(alpha(j, j)))
      end do
      if (largest > 0.0_dp) largest = 1.0_dp/largest
    end if
    do j = 1, self%borders
      if (.not. is_motion(self, self%keys(j))) cycle
      stiffness = abs(self%small(j, j))
      if (stiffness <= SPRING*largest) stiffness = largest
      self%small(j, j) = self%small(j, j) - SPRING*stiffness
    end do
  end subroutine hold_free_motions

  !> Negative eigenvalues of the small system: one for each rigid motion and one for each
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
    integer :: n

    n = size(self%place)
    entry = 0.0_dp
    if (min(row, column) < 0 .or. min(row, column) > n) return
    if (max(row, column) > n) then
      entry = -self%modes(min(row, column), max(row, column) - n)
    else
      entry = alpha(row, column) - self%datum
      if (self%stiffening > 0.0_dp) entry = entry + sum(along_motions(self, [row], column))
      if (row == column) entry = entry + self%ridge
    end if
  end function corner

  !> Forces (n) and motions (m) with (alpha - datum) F - R q = -gap on the contact set,
  !> R^T F = load, F = 0 elsewhere. `gap` (n), read on the set only; `load` (m).
  subroutine solve(self, gap, load, force, motion)
    class(contact_factor), intent(in) :: self
    real(dp), intent(in) :: gap(:), load(:)
    real(dp), intent(out) :: force(:), motion(:)
    real(dp) :: in_base(size(self%base)), outer(self%borders)
    integer :: j, m, n, p, info

    m = size(self%base)
    n = size(self%place)
    p = self%borders
    in_base = -gap(self%base)
    outer = 0.0_dp
    do j = 1, p
      if (is_motion(self, self%keys(j))) then
        outer(j) = -load(self%keys(j) - n)
      else if (self%keys(j) > 0) then
        outer(j) = -gap(self%keys(j))
      else
        ! The gap of a removed point is no condition; a large one would only cost digits.
        in_base(self%place(-self%keys(j))) = 0.0_dp
      end if
    end do
    if (m > 0) call dtrsv('L', 'N', 'N', m, self%lower, m, in_base, 1)
    if (m > 0 .and. p > 0) call dgemv('T', m, p, -1.0_dp, self%border, m, in_base, 1, 1.0_dp, outer, 1)
    if (p > 0) call dsytrs('L', p, 1, self%small, size(self%small, 1), self%pivots, outer, p, info)
    if (m > 0 .and. p > 0) call dgemv('N', m, p, -1.0_dp, self%border, m, outer, 1, 1.0_dp, in_base, 1)
    if (m > 0) call dtrsv('L', 'T', 'N', m, self%lower, m, in_base, 1)

    force = 0.0_dp
    force(self%base) = in_base
    do j = 1, p
      if (is_motion(self, self%keys(j))) then
        motion(self%keys(j) - n) = outer(j) - self%stiffening*load(self%keys(j) - n)
      else if (self%keys(j) > 0) then
        force(self%keys(j)) = outer(j)
      else
        force(-self%keys(j)) = 0.0_dp
      end if
    end do
  end subroutine solve

end module fuge_kkt_factor
