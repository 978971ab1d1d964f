!> The KKT system of a contact set, factored so that sets near an earlier one are cheap.
!>
!> On the contact set the gaps are given and R^T f = w: a symmetric system in the forces, bordered by the rigid
!> modes. The block of alpha is factored once for a base set (Cholesky). A set that differs in a few points is the
!> base set with more borders: a removed point by the condition f_k = 0, an added one by its column of alpha.
!> Eliminating the base set leaves a small symmetric indefinite system, the Schur complement, factored anew for each
!> set. Once base sets of one matrix have cost as much as its inverse, that takes their place where most points are in
!> contact.
module fuge_kkt_factor
  use, intrinsic :: iso_c_binding, only: c_long_long
  use fuge_blocked_cholesky, only: solve_in_blocks
  use fuge_canonical_problem, only: canonical_problem
  use fuge_kinds, only: dp
  use fuge_kkt_base_set, only: kkt_base_set, PIVOT_TOLERANCE
  use fuge_kkt_inverse, only: kkt_inverse
  use fuge_lapack, only: dgemv, dpotrf, dsyrk, dsytrf, dsytrs, dtrsv
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  implicit none
  private

  !> A factor has at most FEWEST_BORDERS borders, and one more for every POINTS_PER_BORDER points of the base set. With
  !> more of them a new base set is cheaper.
  integer, parameter :: FEWEST_BORDERS = 16
  integer, parameter :: POINTS_PER_BORDER = 8
  !> An inverse solves sets that lack one in POINTS_PER_REMOVED points at most: with more of them removed, the Schur
  !> complement is no smaller than the set.
  integer, parameter :: POINTS_PER_REMOVED = 2
  !> Stiffness of the springs that resist a mode which the contact set leaves free, relative to the mode's own
  !> stiffness. Forces stay in equilibrium wherever equilibrium exists.
  real(dp), parameter :: SOFT_SPRING = 1.0e-14_dp

  !> The base set and its factor, with borders.
  type, extends(kkt_base_set), public :: kkt_factor
    private
    !> The matrix that was factored, 0 if that is not known.
    integer(c_long_long) :: stamp = 0
    !> The points of the set, (n).
    logical, allocatable :: contact(:)
    !> lower**(-1) times each border, and the key of the border: a point added (1 .. n), a mode (n+1 .. n+m) or a
    !> point removed (< 0).
    real(dp), allocatable :: border(:, :)
    integer, allocatable :: keys(:)
    integer :: borders = 0
    !> Factor of the Schur complement.
    real(dp), allocatable :: schur(:, :)
    integer, allocatable :: pivots(:)
    !> Inverse of the block of all points, which are the base set then, in place of `lower` and `border`.
    type(kkt_inverse) :: inverse = kkt_inverse()
    !> Later solves with the same matrix are likely, as there was one before: an inverse may be worth its cost.
    logical, public :: expects_solves = .false.
    !> The matrix cannot be inverted without the loss of digits that matter.
    logical :: inverse_failed = .false.
    !> Multiplications for base sets and borders, since later solves are likely or since the last inverse, that an
    !> inverse would have saved, less those that it would not.
    real(dp) :: spent = 0.0_dp
  contains
    procedure :: set
    procedure :: is_set
    procedure :: belongs_to
    procedure :: solve
  end type kkt_factor

contains

  !> Factor the system of the points marked in `contact` (n), at least one of them if there is one mode only.
  !>
  !> `status`: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE.
  subroutine set(self, canonical, contact, status)
    class(kkt_factor), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: contact(:)
    integer, intent(out) :: status
    logical :: singular
    integer :: borders

    borders = huge(borders)
    if (allocated(self%contact)) then
      if (all(self%contact .eqv. contact)) then
        status = FUGE_DONE
        return
      end if
      ! Until the factor is that of the new set.
      deallocate (self%contact)
    end if
    if (allocated(self%base_set)) then
      borders = size(canonical%modes, 2) + count(contact .neqv. (self%position > 0))
      ! An inverse has no points to add.
      if (self%inverse%is_set .and. any(contact .and. self%position < 1)) borders = huge(borders)
    end if
    if (allocated(self%keys)) then
      if (borders <= size(self%keys)) then
        call update_borders(self, canonical%alpha, contact, singular)
        if (.not. singular) then
          status = FUGE_DONE
          allocate (self%contact, source=contact)
          return
        end if
      end if
    end if
    self%stamp = canonical%stamp
    if (is_worth_inverse(self, canonical%excluded, contact)) then
      call invert_all(self, canonical, contact, singular)
      if (.not. singular) then
        status = FUGE_DONE
        allocate (self%contact, source=contact)
        return
      end if
    end if
    call make_room(self, count(contact), FEWEST_BORDERS + count(contact)/POINTS_PER_BORDER + size(canonical%modes, 2), &
                   status)
    if (status == FUGE_DONE) call self%factorise(canonical, contact, status)
    if (status /= FUGE_DONE) return
    call count_cost(self, real(count(contact), dp)**3/3.0_dp)
    call update_borders(self, canonical%alpha, contact, singular)
    if (singular) then
      status = FUGE_ERR_NOT_DEFINITE
    else
      allocate (self%contact, source=contact)
    end if
  end subroutine set

  !> Count multiplications for the base set or its borders, if later solves are likely.
  pure subroutine count_cost(self, multiplications)
    class(kkt_factor), intent(inout) :: self
    real(dp), intent(in) :: multiplications
    logical :: saved

    if (.not. self%expects_solves) return
    saved = size(self%position) - size(self%base_set) <= size(self%position)/POINTS_PER_REMOVED
    self%spent = max(self%spent + merge(multiplications, -multiplications, saved), 0.0_dp)
  end subroutine count_cost

  !> Is it time for an inverse? It costs the third power of the number of points, no more than has been spent then, and
  !> pays where most points are in contact.
  pure function is_worth_inverse(self, excluded, contact) result(worth)
    class(kkt_factor), intent(in) :: self
    logical, intent(in) :: excluded(:), contact(:)
    logical :: worth
    integer :: points

    worth = .false.
    if (self%inverse_failed .or. .not. (self%expects_solves .and. any(contact))) return
    points = count(contact .or. .not. excluded)
    worth = self%spent >= real(points, dp)**3 .and. points - count(contact) <= points/POINTS_PER_REMOVED
  end function is_worth_inverse

  !> Invert the block of all points, and form the system of those in contact. `failed` where the inverse would cost
  !> digits that matter, or without memory.
  subroutine invert_all(self, canonical, contact, failed)
    class(kkt_factor), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: contact(:)
    logical, intent(out) :: failed
    integer :: status

    self%spent = 0.0_dp
    self%inverse_failed = .true.
    failed = .true.
    call make_room(self, 0, size(canonical%modes, 2) + size(contact)/POINTS_PER_REMOVED, status)
    if (status == FUGE_DONE) call self%factorise(canonical, contact .or. .not. canonical%excluded, status)
    if (status /= FUGE_DONE .or. self%regularisation > 0.0_dp) return
    call self%inverse%set(self%lower, self%diagonal, self%modes(self%base_set, :))
    if (.not. self%inverse%is_set) return
    self%inverse_failed = .false.
    call update_borders(self, canonical%alpha, contact, failed)
  end subroutine invert_all

  !> Is it a factor of the same matrix with the same modes, as far as that is known, and not regularised?
  pure function belongs_to(self, canonical)
    class(kkt_factor), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    logical :: belongs_to

    belongs_to = allocated(self%base_set) .and. self%stamp > 0 .and. self%stamp == canonical%stamp &
                 .and. .not. self%regularisation > 0.0_dp
    if (belongs_to) belongs_to = size(self%modes, 1) == size(canonical%modes, 1) &
                                 .and. size(self%modes, 2) == size(canonical%modes, 2)
    if (belongs_to) belongs_to = .not. any(abs(self%modes - canonical%modes) > 0.0_dp)
  end function belongs_to

  !> Is there a factor to solve with?
  pure function is_set(self)
    class(kkt_factor), intent(in) :: self
    logical :: is_set

    is_set = allocated(self%base_set)
  end function is_set

  !> Make room for `limit` borders of `points` points. Error: FUGE_ERR_MEMORY.
  pure subroutine make_room(self, points, limit, status)
    class(kkt_factor), intent(inout) :: self
    integer, intent(in) :: points, limit
    integer, intent(out) :: status
    integer :: stat

    self%borders = 0
    if (self%inverse%is_set) self%inverse = kkt_inverse()
    if (allocated(self%border)) deallocate (self%border)
    if (allocated(self%keys)) deallocate (self%keys)
    if (allocated(self%schur)) deallocate (self%schur)
    if (allocated(self%pivots)) deallocate (self%pivots)
    allocate (self%border(points, limit), self%keys(limit), self%schur(limit, limit), self%pivots(limit), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0 .and. allocated(self%base_set)) deallocate (self%base_set)
  end subroutine make_room

  !> Form the borders of a set near the base set; those that it shares with the last set are kept.
  subroutine update_borders(self, alpha, contact, singular)
    class(kkt_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :)
    logical, intent(in) :: contact(:)
    logical, intent(out) :: singular
    integer :: target_keys(size(self%modes, 2) + count(contact .neqv. (self%position > 0)))

    target_keys = border_keys(self, contact, size(target_keys))
    if (self%inverse%is_set) then
      self%borders = size(target_keys)
      self%keys(:self%borders) = target_keys
    else
      call form_borders(self, alpha, target_keys)
    end if
    call factor_schur(self, alpha, singular)
  end subroutine update_borders

  !> Keep the borders of the last set that have these keys, and form the others.
  subroutine form_borders(self, alpha, target_keys)
    class(kkt_factor), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :)
    integer, intent(in) :: target_keys(:)
    integer :: first_new, j, m

    m = size(self%base_set)
    call keep_borders(self, target_keys)
    first_new = self%borders + 1
    do j = 1, size(target_keys)
      if (any(self%keys(:self%borders) == target_keys(j))) cycle
      self%borders = self%borders + 1
      self%keys(self%borders) = target_keys(j)
      call fill_border(self, alpha, target_keys(j), self%border(:, self%borders))
    end do
    if (self%borders >= first_new .and. m > 0) then
      call solve_in_blocks(self%lower, self%border(:, first_new:self%borders))
      call count_cost(self, real(m, dp)**2*real(self%borders - first_new + 1, dp))
    end if
  end subroutine form_borders

  pure function border_keys(self, contact, number) result(keys)
    class(kkt_factor), intent(in) :: self
    logical, intent(in) :: contact(:)
    integer, intent(in) :: number
    integer :: keys(number)
    integer :: j, k

    do j = 1, size(self%modes, 2)
      keys(j) = size(contact) + j
    end do
    j = size(self%modes, 2)
    do k = 1, size(contact)
      if (contact(k) .eqv. self%position(k) > 0) cycle
      j = j + 1
      keys(j) = merge(k, -k, contact(k))
    end do
  end function border_keys

  pure subroutine keep_borders(self, target_keys)
    class(kkt_factor), intent(inout) :: self
    integer, intent(in) :: target_keys(:)
    integer :: j, kept

    kept = 0
    do j = 1, self%borders
      if (.not. any(target_keys == self%keys(j))) cycle
      kept = kept + 1
      if (kept == j) cycle
      self%keys(kept) = self%keys(j)
      self%border(:, kept) = self%border(:, j)
    end do
    self%borders = kept
  end subroutine keep_borders

  pure subroutine fill_border(self, alpha, key, column)
    class(kkt_factor), intent(in) :: self
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(in) :: key
    real(dp), intent(inout) :: column(:)

    if (is_mode(self, key)) then
      column = -self%modes(self%base_set, key - size(self%position))
    else if (key < 0) then
      column = 0.0_dp
      column(self%position(-key)) = -1.0_dp
    else
      column = alpha(self%base_set, key) - self%datum
      if (self%augmentation > 0.0_dp) column = column + self%augmentation_entries(self%base_set, key)
    end if
  end subroutine fill_border

  !> Does the border belong to a rigid mode?
  elemental function is_mode(self, key) result(mode)
    class(kkt_factor), intent(in) :: self
    integer, intent(in) :: key
    logical :: mode

    mode = key > size(self%position)
  end function is_mode

  !> Form and factor the Schur complement of the base set in the borders. `singular` if an added point depends on the
  !> base set.
  subroutine factor_schur(self, alpha, singular)
    class(kkt_factor), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :)
    logical, intent(out) :: singular
    real(dp) :: work(64*self%borders)
    integer :: p, info

    p = self%borders
    singular = .false.
    if (p < 1) return
    if (self%inverse%is_set) then
      call self%inverse%fill_schur(removed_positions(self), self%schur)
    else
      call fill_schur(self, alpha, singular)
    end if
    call add_soft_springs(self, alpha)
    if (singular) return
    call dsytrf('L', p, self%schur, size(self%schur, 1), self%pivots, work, size(work), info)
    singular = info /= 0
    if (.not. singular) singular = negative_eigenvalues(self) /= count(self%keys(:p) < 0 .or. &
                                                                 is_mode(self, self%keys(:p)))
  end subroutine factor_schur

  !> Form the Schur complement from the borders. `singular` as for `factor_schur`.
  subroutine fill_schur(self, alpha, singular)
    class(kkt_factor), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :)
    logical, intent(out) :: singular
    real(dp) :: diagonal(self%borders)
    integer :: i, j, m, p

    m = size(self%base_set)
    p = self%borders
    do j = 1, p
      do i = j, p
        self%schur(i, j) = border_entry(self, alpha, self%keys(i), self%keys(j))
      end do
      diagonal(j) = self%schur(j, j)
    end do
    if (m > 0) call dsyrk('L', 'T', p, m, -1.0_dp, self%border, m, 1.0_dp, self%schur, size(self%schur, 1))
    call check_added(self, diagonal, singular)
  end subroutine fill_schur

  !> Positions in the base set of the points removed, in the order of their borders, which follow those of all modes
  !> where there is an inverse.
  pure function removed_positions(self) result(positions)
    class(kkt_factor), intent(in) :: self
    integer :: positions(self%borders - size(self%modes, 2))

    positions = self%position(-self%keys(size(self%modes, 2) + 1:self%borders))
  end function removed_positions

  !> Are the points added singular beyond the base set, one by one or together? Their block of the Schur complement has
  !> a Cholesky factor with pivots beyond rounding if not. `diagonal` (borders) is that of alpha.
  subroutine check_added(self, diagonal, singular)
    class(kkt_factor), intent(inout) :: self
    real(dp), intent(in) :: diagonal(:)
    logical, intent(out) :: singular
    real(dp), allocatable :: block(:, :)
    real(dp) :: own
    integer :: added(count(self%keys(:self%borders) > 0 .and. .not. is_mode(self, self%keys(:self%borders))))
    integer :: i, j, points, info

    singular = .false.
    if (size(added) < 1) return
    added = pack([(j, j=1, self%borders)], &
                 self%keys(:self%borders) > 0 .and. .not. is_mode(self, self%keys(:self%borders)))
    allocate (block(size(added), size(added)), stat=info)
    singular = info /= 0
    if (singular) return
    do j = 1, size(added)
      do i = j, size(added)
        block(i, j) = self%schur(max(added(i), added(j)), min(added(i), added(j)))
      end do
    end do
    call dpotrf('L', size(added), block, size(added), info)
    singular = info /= 0
    points = size(self%base_set) + size(added)
    do j = 1, size(added)
      if (singular) return
      own = diagonal(added(j))
      ! As in the base set, but without a solve for the forces that the point requires.
      if (self%augmentation > 0.0_dp .and. size(self%diagonal) > 0) own = max(own, maxval(self%diagonal))
      singular = block(j, j)**2 <= PIVOT_TOLERANCE*real(points, dp)*own
      if (.not. singular) self%pivot_ratio = max(self%pivot_ratio, diagonal(added(j))/block(j, j)**2)
    end do
  end subroutine check_added

  !> Several modes may be more than a contact set can resist; soft springs resist those left. One translation is always
  !> resisted.
  pure subroutine add_soft_springs(self, alpha)
    class(kkt_factor), intent(inout) :: self
    real(dp), intent(in) :: alpha(:, :)
    real(dp) :: stiffness, largest
    integer :: j

    if (size(self%modes, 2) == 1 .and. size(self%base_set) > 0 .and. all(abs(self%modes - 1.0_dp) <= 0.0_dp)) return
    largest = 0.0_dp
    do j = 1, self%borders
      if (is_mode(self, self%keys(j))) largest = max(largest, abs(self%schur(j, j)))
    end do
    if (.not. largest > 0.0_dp) then
      ! Without any contact, take the stiffness that a single contact point would have.
      do j = 1, size(self%position)
        largest = max(largest, abs(alpha(j, j)))
      end do
      ! Where alpha is zero, no spring is too stiff.
      if (.not. largest > 0.0_dp) largest = 1.0_dp
      largest = 1.0_dp/largest
    end if
    do j = 1, self%borders
      if (.not. is_mode(self, self%keys(j))) cycle
      stiffness = abs(self%schur(j, j))
      if (stiffness <= SOFT_SPRING*largest) stiffness = largest
      self%schur(j, j) = self%schur(j, j) - SOFT_SPRING*stiffness
    end do
  end subroutine add_soft_springs

  !> Number of negative eigenvalues of the Schur complement: one for each mode and one for each point removed if alpha
  !> is positive definite on the forces of the set without resultant.
  pure function negative_eigenvalues(self) result(number)
    class(kkt_factor), intent(in) :: self
    integer :: number
    integer :: j

    number = 0
    j = 1
    do while (j <= self%borders)
      ! A block of two has one eigenvalue of each sign.
      if (self%pivots(j) < 0 .or. self%schur(j, j) < 0.0_dp) number = number + 1
      j = j + merge(1, 2, self%pivots(j) > 0)
    end do
  end function negative_eigenvalues

  !> Entry of the bordered matrix where two borders meet.
  pure function border_entry(self, alpha, row, column) result(entry)
    class(kkt_factor), intent(in) :: self
    real(dp), intent(in) :: alpha(:, :)
    integer, intent(in) :: row, column
    real(dp) :: entry
    integer :: n

    n = size(self%position)
    entry = 0.0_dp
    if (min(row, column) < 0 .or. min(row, column) > n) return
    if (max(row, column) > n) then
      entry = -self%modes(min(row, column), max(row, column) - n)
    else
      entry = alpha(row, column) - self%datum
      if (self%augmentation > 0.0_dp) entry = entry + sum(self%augmentation_entries([row], column))
      if (row == column) entry = entry + self%regularisation
    end if
  end function border_entry

  !> Forces (n) and motions (m) with (alpha - datum) f - R q = -gap on the contact set, R^T f = load, and f = 0
  !> elsewhere. `gap` (n), read on the set only; `load` (m).
  subroutine solve(self, gap, load, force, motion)
    class(kkt_factor), intent(in) :: self
    real(dp), intent(in) :: gap(:), load(:)
    real(dp), intent(out) :: force(:), motion(:)
    real(dp) :: in_base_set(size(self%base_set)), outer(self%borders)
    integer :: j, n, p, info

    n = size(self%position)
    p = self%borders
    in_base_set = -gap(self%base_set)
    outer = 0.0_dp
    do j = 1, p
      if (is_mode(self, self%keys(j))) then
        outer(j) = -load(self%keys(j) - n)
      else if (self%keys(j) > 0) then
        outer(j) = -gap(self%keys(j))
      else
        ! The gap of a removed point is no condition; a large one would only cost digits.
        in_base_set(self%position(-self%keys(j))) = 0.0_dp
      end if
    end do
    if (self%inverse%is_set) then
      call self%inverse%eliminate(removed_positions(self), in_base_set, outer)
    else
      call eliminate(self, in_base_set, outer)
    end if
    if (p == 1) then
      outer = outer/self%schur(1, 1)
    else if (p > 0) then
      call dsytrs('L', p, 1, self%schur, size(self%schur, 1), self%pivots, outer, p, info)
    end if
    if (self%inverse%is_set) then
      call self%inverse%substitute(removed_positions(self), outer, in_base_set)
    else
      call substitute(self, outer, in_base_set)
    end if

    force = 0.0_dp
    force(self%base_set) = in_base_set
    do j = 1, p
      if (is_mode(self, self%keys(j))) then
        motion(self%keys(j) - n) = outer(j) - self%augmentation*load(self%keys(j) - n)
      else if (self%keys(j) > 0) then
        force(self%keys(j)) = outer(j)
      else
        force(-self%keys(j)) = 0.0_dp
      end if
    end do
  end subroutine solve

  !> Forward elimination of the base set: its right-hand side `in_base_set`, and what is left of that of the borders,
  !> `outer`.
  subroutine eliminate(self, in_base_set, outer)
    class(kkt_factor), intent(in) :: self
    real(dp), intent(inout), contiguous :: in_base_set(:), outer(:)
    integer :: m, p

    m = size(in_base_set)
    p = size(outer)
    if (m > 0) call dtrsv('L', 'N', 'N', m, self%lower, m, in_base_set, 1)
    if (m > 0 .and. p > 0) call dgemv('T', m, p, -1.0_dp, self%border, m, in_base_set, 1, 1.0_dp, outer, 1)
  end subroutine eliminate

  !> Back substitution: from the solution `outer` of the Schur complement to the forces `in_base_set`.
  subroutine substitute(self, outer, in_base_set)
    class(kkt_factor), intent(in) :: self
    real(dp), intent(in), contiguous :: outer(:)
    real(dp), intent(inout), contiguous :: in_base_set(:)
    integer :: m, p

    m = size(in_base_set)
    p = size(outer)
    if (m > 0 .and. p > 0) call dgemv('N', m, p, -1.0_dp, self%border, m, outer, 1, 1.0_dp, in_base_set, 1)
    if (m > 0) call dtrsv('L', 'T', 'N', m, self%lower, m, in_base_set, 1)
  end subroutine substitute

end module fuge_kkt_factor
