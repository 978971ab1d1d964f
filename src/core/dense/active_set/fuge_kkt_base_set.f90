!> The base set of a KKT system: the block of alpha on some points, made positive definite and factored.
!>
!> Alpha may be positive definite on the forces without resultant only. A constant taken out of all of it, where there
!> is a translation, or multiples of R R^T added to it, change the motions and not the forces, and can make the block
!> positive definite. Where it is singular, a regularisation is added to its diagonal.
module fuge_kkt_base_set
  use fuge_blocked_cholesky, only: factor_in_blocks
  use fuge_canonical_problem, only: canonical_problem
  use fuge_kinds, only: dp
  use fuge_lapack, only: dtrsv
  use fuge_status, only: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE
  use fuge_threads, only: run_in_parts, threads_here, work_in_parts
  implicit none
  private

  !> A pivot below this fraction of its diagonal, for each point of the base set, is rounding.
  real(dp), parameter, public :: PIVOT_TOLERANCE = 16.0_dp*epsilon(1.0_dp)
  !> A pivot below this fraction of its diagonal may be rounding that the pivots before it have made larger.
  real(dp), parameter :: SUSPECT_PIVOT = 1.0e-10_dp
  !> An energy below this fraction of its terms is rounding, which no refinement overcomes.
  real(dp), parameter :: ENERGY_TOLERANCE = 4.0_dp*epsilon(1.0_dp)
  !> Regularisations tried where alpha is singular, relative to its range.
  real(dp), parameter :: REGULARISATIONS(3) = [1.0e-12_dp, 1.0e-11_dp, 1.0e-10_dp]

  !> Threads share the gathering of blocks with as many points as this.
  integer, parameter :: MANY_POINTS = 384

  public :: stand_in_compliance

  !> Its components are for the factor that extends it.
  type, public :: kkt_base_set
    !> Points of the base set, and the position of each point in it (0: not in it).
    integer, allocatable :: base_set(:), position(:)
    !> Rigid modes, (n, m).
    real(dp), allocatable :: modes(:, :)
    !> Cholesky factor of alpha - datum + augmentation R R^T on the base set, the regularisation on its diagonal.
    real(dp), allocatable :: lower(:, :)
    !> Diagonal of the matrix that was factored, one for each point of the base set.
    real(dp), allocatable :: diagonal(:)
    !> Taken out of all of alpha where the first mode is a translation. It changes the motion only, and so does the
    !> augmentation along the modes.
    real(dp) :: datum = 0.0_dp
    real(dp) :: augmentation = 0.0_dp
    !> 0 unless alpha is singular on a base set: the forces are then not unique, and the regularisation picks those
    !> of least squares.
    real(dp) :: regularisation = 0.0_dp
    !> Largest diagonal over least pivot: a lower bound of the condition number.
    real(dp) :: pivot_ratio = 1.0_dp
  contains
    procedure :: factorise
    procedure :: augmentation_entries
  end type kkt_base_set

  !> The lower half of a block that is gathered, and the extremes of what each part has gathered.
  type, extends(work_in_parts) :: gathering
    real(dp), pointer, contiguous :: alpha(:, :) => null(), lower(:, :) => null()
    integer, pointer, contiguous :: points(:) => null()
    real(dp), allocatable :: least(:), most(:)
  contains
    procedure :: do_part => gather_part
  end type gathering

contains

  !> Take the points marked in `contact` (n) as the base set and factor its block; matrix and modes are those of
  !> `canonical`. `status`: FUGE_DONE, FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE; after an error there is no base set.
  subroutine factorise(self, canonical, contact, status)
    class(kkt_base_set), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: contact(:)
    integer, intent(out) :: status
    integer, parameter :: DATUMS = 10, REGULAR_DATUMS = 4
    real(dp) :: nearest_to_zero, range
    integer :: attempt, k
    logical :: is_definite, is_gathered, augments

    call choose_base_set(self, canonical%modes, contact, status)
    if (status /= FUGE_DONE) return
    self%datum = 0.0_dp
    self%augmentation = 0.0_dp
    call gather_block(self, canonical%alpha, nearest_to_zero, range)
    if (.not. range > 0.0_dp) range = stand_in_compliance(canonical)
    ! For one translation the datum is enough; for other modes alpha is augmented too.
    augments = size(canonical%modes, 2) > merge(1, 0, canonical%has_translation)
    ! Any datum that makes the block positive definite is right; alpha's own is taken if it does.
    is_gathered = .true.
    if (abs(nearest_to_zero) <= range .or. .not. canonical%has_translation) then
      call factor_base_set(self, canonical%alpha, 0.0_dp, is_gathered, is_definite)
      if (is_definite) return
    end if
    do attempt = 0, DATUMS - 1
      if (canonical%has_translation) self%datum = nearest_to_zero - range*real(8**attempt - 1, dp)
      if (augments .and. (attempt > 0 .or. .not. canonical%has_translation)) then
        self%augmentation = range*real(8**attempt, dp)
      end if
      call factor_base_set(self, canonical%alpha, 0.0_dp, is_gathered, is_definite)
      if (is_definite) return
    end do
    do attempt = 0, REGULAR_DATUMS - 1
      if (canonical%has_translation) self%datum = nearest_to_zero - range*real(8**attempt, dp)
      self%augmentation = merge(range*real(8**attempt, dp), 0.0_dp, augments)
      do k = 1, size(REGULARISATIONS)
        call factor_base_set(self, canonical%alpha, REGULARISATIONS(k)*range, is_gathered, is_definite)
        if (is_definite) return
      end do
      if (.not. (canonical%has_translation .or. augments)) exit
    end do
    call deallocate_all(self)
    status = FUGE_ERR_NOT_DEFINITE
  end subroutine factorise

  subroutine choose_base_set(self, modes, contact, status)
    class(kkt_base_set), intent(inout) :: self
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: contact(:)
    integer, intent(out) :: status
    integer :: i, m, stat

    m = count(contact)
    call deallocate_all(self)
    allocate (self%base_set(m), self%position(size(contact)), self%lower(m, m), self%diagonal(m), &
              self%modes(size(modes, 1), size(modes, 2)), stat=stat)
    status = merge(FUGE_DONE, FUGE_ERR_MEMORY, stat == 0)
    if (stat /= 0) then
      call deallocate_all(self)
      return
    end if
    self%modes = modes
    self%position = 0
    m = 0
    do i = 1, size(contact)
      if (.not. contact(i)) cycle
      m = m + 1
      self%base_set(m) = i
      self%position(i) = m
    end do
  end subroutine choose_base_set

  pure subroutine deallocate_all(self)
    class(kkt_base_set), intent(inout) :: self

    if (allocated(self%base_set)) deallocate (self%base_set)
    if (allocated(self%position)) deallocate (self%position)
    if (allocated(self%modes)) deallocate (self%modes)
    if (allocated(self%lower)) deallocate (self%lower)
    if (allocated(self%diagonal)) deallocate (self%diagonal)
  end subroutine deallocate_all

  !> Factor the block of the base set. With `is_gathered` it has just been gathered; then it no longer is.
  subroutine factor_base_set(self, alpha, regularisation, is_gathered, is_definite)
    class(kkt_base_set), intent(inout) :: self
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: regularisation
    logical, intent(inout) :: is_gathered
    logical, intent(out) :: is_definite
    real(dp) :: largest, least_ignored, range_ignored
    integer :: j, m, info

    m = size(self%base_set)
    if (.not. is_gathered) call gather_block(self, alpha, least_ignored, range_ignored)
    is_gathered = .false.
    do j = 1, m
      if (abs(self%datum) > 0.0_dp) self%lower(j:, j) = self%lower(j:, j) - self%datum
      if (self%augmentation > 0.0_dp) then
        self%lower(j:, j) = self%lower(j:, j) + self%augmentation_entries(self%base_set(j:), self%base_set(j))
      end if
      self%lower(j, j) = self%lower(j, j) + regularisation
      self%diagonal(j) = self%lower(j, j)
    end do
    self%regularisation = regularisation
    self%pivot_ratio = 1.0_dp
    is_definite = .true.
    if (m < 1) return
    call factor_in_blocks(self%lower, info)
    is_definite = info == 0
    if (.not. is_definite) return
    largest = maxval(self%diagonal)
    do j = 1, m
      is_definite = is_definite .and. self%lower(j, j)**2 > PIVOT_TOLERANCE*real(m, dp)*self%diagonal(j)
      if (is_definite) self%pivot_ratio = max(self%pivot_ratio, largest/self%lower(j, j)**2)
    end do
    if (is_definite) is_definite = .not. any_pivot_is_rounding(self)
  end subroutine factor_base_set

  !> Is a pivot of the base set the rounding of the terms of an energy? The least one tells, unless an augmentation
  !> hides it beside the large pivots that it makes itself.
  function any_pivot_is_rounding(self) result(rounding)
    class(kkt_base_set), intent(in) :: self
    logical :: rounding
    real(dp) :: suspect
    integer :: j

    if (self%augmentation > 0.0_dp) then
      suspect = SUSPECT_PIVOT*maxval(self%diagonal)
      do j = 1, size(self%diagonal)
        rounding = self%lower(j, j)**2 <= suspect
        if (rounding) rounding = pivot_is_rounding(self, j, PIVOT_TOLERANCE*real(size(self%diagonal), dp))
        if (rounding) return
      end do
    else
      j = minloc([(self%lower(j, j)**2/self%diagonal(j), j=1, size(self%diagonal))], dim=1)
      rounding = self%lower(j, j)**2 <= SUSPECT_PIVOT*self%diagonal(j)
      if (rounding) rounding = pivot_is_rounding(self, j, ENERGY_TOLERANCE)
    end if
  end function any_pivot_is_rounding

  !> Is pivot `j` of the base set below the fraction `tolerance` of its terms? It is the energy of a force of 1 at its
  !> point and the forces that this one requires at the points before it, which may be far larger.
  function pivot_is_rounding(self, j, tolerance) result(rounding)
    class(kkt_base_set), intent(in) :: self
    integer, intent(in) :: j
    real(dp), intent(in) :: tolerance
    logical :: rounding
    real(dp) :: force(j)

    force = 0.0_dp
    force(j) = self%lower(j, j)
    call dtrsv('L', 'T', 'N', j, self%lower, size(self%lower, 1), force, 1)
    rounding = self%lower(j, j)**2 <= tolerance*sum(self%diagonal(:j)*force**2)
  end function pivot_is_rounding

  !> The augmentation's entries in the given rows of a column of alpha.
  pure function augmentation_entries(self, rows, column) result(added)
    class(kkt_base_set), intent(in) :: self
    integer, intent(in) :: rows(:), column
    real(dp) :: added(size(rows))
    integer :: j

    added = 0.0_dp
    do j = 1, size(self%modes, 2)
      added = added + (self%augmentation*self%modes(column, j))*self%modes(rows, j)
    end do
  end function augmentation_entries

  !> A compliance for a block that has none: the largest of alpha, or where alpha is zero one by which the loads
  !> or the limits of forces displace as much as the least gap or play; 1 without forces or lengths.
  pure function stand_in_compliance(canonical) result(compliance)
    type(canonical_problem), intent(in) :: canonical
    real(dp) :: compliance
    real(dp) :: datum, force, length
    integer :: k

    compliance = canonical%survey%largest()
    if (compliance > 0.0_dp) return
    compliance = 1.0_dp
    datum = 0.0_dp
    if (canonical%has_translation) datum = minval(canonical%gap, mask=.not. canonical%excluded)
    length = huge(length)
    do k = 1, size(canonical%gap)
      if (canonical%excluded(k)) cycle
      if (abs(canonical%gap(k) - datum) > 0.0_dp) length = min(length, abs(canonical%gap(k) - datum))
      if (canonical%upper(k) > 0.0_dp) length = min(length, canonical%upper(k))
    end do
    force = canonical%largest_load()
    if (canonical%has_limits()) force = max(force, maxval(canonical%limit, mask=canonical%limit < huge(force)), &
                                            maxval(canonical%limit_upper, mask=canonical%limit_upper < huge(force)))
    if (length < huge(length) .and. force > 0.0_dp) then
      compliance = max(length/force, tiny(compliance)/epsilon(compliance)**2)
    end if
  end function stand_in_compliance

  !> Gather the block of the base set; its coefficient that is nearest to zero, and the range of its coefficients.
  !> Equal coefficients, as of a single point, have a range of their own size, which is 0 for no compliance at all.
  subroutine gather_block(self, alpha, nearest_to_zero, range)
    class(kkt_base_set), intent(inout), target :: self
    real(dp), intent(in), target, contiguous :: alpha(:, :)
    real(dp), intent(out) :: nearest_to_zero, range
    type(gathering) :: work
    real(dp) :: least, most
    integer :: parts

    parts = 1
    if (size(self%base_set) >= MANY_POINTS) parts = threads_here()
    work%alpha => alpha
    work%points => self%base_set
    work%lower => self%lower
    allocate (work%least(parts), work%most(parts))
    call run_in_parts(parts, work)
    least = minval(work%least)
    most = maxval(work%most)
    if (size(self%base_set) < 1) then
      least = 0.0_dp
      most = 0.0_dp
    end if
    range = most - least
    if (.not. range > 0.0_dp) then
      range = abs(least)
      most = least
      least = least - range
    end if
    ! Zero if there are both signs. Taking out such a coefficient costs no digits.
    nearest_to_zero = max(least, 0.0_dp) + min(most, 0.0_dp)
  end subroutine gather_block

  !> Gathers columns part, part + parts, .. and their extremes.
  subroutine gather_part(self, part, parts)
    class(gathering), intent(inout) :: self
    integer, intent(in) :: part, parts
    real(dp) :: least, most
    integer :: j

    least = huge(least)
    most = -huge(most)
    do j = part + 1, size(self%points), parts
      call gather_column(self%alpha(:, self%points(j)), self%points(j:), self%lower(j:, j), least, most)
    end do
    self%least(part + 1) = least
    self%most(part + 1) = most
  end subroutine gather_part

  !> `gathered` is the `column` at the `points`; `least` and `most` go along.
  pure subroutine gather_column(column, points, gathered, least, most)
    real(dp), intent(in), contiguous :: column(:)
    integer, intent(in), contiguous :: points(:)
    real(dp), intent(inout), contiguous :: gathered(:)
    real(dp), intent(inout) :: least, most
    integer :: i, first

    first = points(1)
    if (points(size(points)) - first + 1 == size(points)) then
      gathered = column(first:first + size(points) - 1)
    else
      do i = 1, size(points)
        gathered(i) = column(points(i))
      end do
    end if
    do i = 1, size(points)
      least = min(least, gathered(i))
      most = max(most, gathered(i))
    end do
  end subroutine gather_column

end module fuge_kkt_base_set
