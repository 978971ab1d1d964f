!> The factor of the contact set on a path, where sets follow one another that differ in few points.
!>
!> As long as points only join, under one translation, the Cholesky factor of alpha grows by a row for each of them,
!> which costs one triangular solve. From the first older point that leaves on, and in all other cases, it is the KKT
!> factor of the active set.
module fuge_path_factor
  use fuge_canonical_problem, only: canonical_problem
  use fuge_kinds, only: dp
  use fuge_kkt_factor, only: kkt_factor
  use fuge_kkt_solution, only: solve_set
  use fuge_lapack, only: dpotrf, dtrsv
  use fuge_status, only: FUGE_DONE
  implicit none
  private

  !> Ratio of the pivots below which a solution in double precision is exact enough.
  real(dp), parameter :: WELL_CONDITIONED = 1.0e2_dp
  !> A pivot below this fraction of its diagonal is rounding.
  real(dp), parameter :: PIVOT_TOLERANCE = 1.0e-12_dp
  !> At first there is room for this many rows.
  integer, parameter :: FIRST_ROOM = 64

  type, public :: path_factor
    private
    !> Points in the order of the rows, how many, and which (n) they are. Used while `grows`.
    logical :: grows = .true.
    integer, allocatable :: points(:)
    logical, allocatable :: has(:)
    integer :: rows = 0
    !> Cholesky factor of alpha less the datum of the problem, and its inverse times a unit translation.
    real(dp), allocatable :: lower(:, :), unit(:)
    !> Largest diagonal and least pivot.
    real(dp) :: largest = 0.0_dp, least = huge(1.0_dp)
    type(kkt_factor) :: kkt
  contains
    procedure :: set
    procedure :: solve
    procedure :: is_well_conditioned
    procedure :: needs_refinement
  end type path_factor

contains

  !> Factor the system of the points marked in `contact` (n). `status`: that of the KKT factor.
  subroutine set(self, canonical, contact, status)
    class(path_factor), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: contact(:)
    integer, intent(out) :: status

    status = FUGE_DONE
    if (self%grows) call grow(self, canonical, contact)
    if (.not. self%grows) call self%kkt%set(canonical, contact, status)
  end subroutine set

  !> Add the new points; where that is not possible, the factor grows no more.
  subroutine grow(self, canonical, contact)
    class(path_factor), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: contact(:)
    integer :: k, stat

    self%grows = canonical%has_translation .and. size(canonical%modes, 2) == 1 .and. any(contact)
    if (self%grows .and. allocated(self%has)) then
      call drop_last(self, contact)
      self%grows = .not. any(self%has .and. .not. contact)
    end if
    stat = 0
    if (self%grows .and. .not. allocated(self%has)) then
      allocate (self%has(size(contact)), self%points(size(contact)), self%unit(size(contact)), stat=stat)
      if (stat == 0) self%has = .false.
    end if
    if (self%grows .and. stat == 0) call make_room(self, count(contact), stat)
    self%grows = self%grows .and. stat == 0
    if (self%grows .and. self%rows == 0) then
      call factor_first(self, canonical, contact)
    else
      do k = 1, size(contact)
        if (.not. self%grows) exit
        if (contact(k) .and. .not. self%has(k)) call add_row(self, canonical, k)
      end do
    end if
    if (self%grows .or. .not. allocated(self%has)) return
    deallocate (self%has, self%points, self%unit)
    if (allocated(self%lower)) deallocate (self%lower)
  end subroutine grow

  !> Drop the last points as long as they are not in contact: those that have been tried for one set only.
  pure subroutine drop_last(self, contact)
    class(path_factor), intent(inout) :: self
    logical, intent(in) :: contact(:)

    do while (self%rows > 0)
      if (contact(self%points(self%rows))) exit
      self%has(self%points(self%rows)) = .false.
      self%rows = self%rows - 1
    end do
  end subroutine drop_last

  !> Make room for `rows` rows.
  subroutine make_room(self, rows, stat)
    class(path_factor), intent(inout) :: self
    integer, intent(in) :: rows
    integer, intent(out) :: stat
    real(dp), allocatable :: larger(:, :)
    integer :: room

    stat = 0
    room = 0
    if (allocated(self%lower)) room = size(self%lower, 1)
    if (rows <= room) return
    room = min(max(2*room, rows, FIRST_ROOM), size(self%has))
    allocate (larger(room, room), stat=stat)
    if (stat /= 0) return
    if (self%rows > 0) larger(:self%rows, :self%rows) = self%lower(:self%rows, :self%rows)
    call move_alloc(larger, self%lower)
  end subroutine make_room

  !> Factor the first set as a whole.
  subroutine factor_first(self, canonical, contact)
    class(path_factor), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    logical, intent(in) :: contact(:)
    integer :: info, j, k, m

    m = count(contact)
    self%points(:m) = pack([(k, k=1, size(contact))], contact)
    do j = 1, m
      self%lower(j:m, j) = canonical%alpha(self%points(j:m), self%points(j)) - canonical%datum
      self%largest = max(self%largest, self%lower(j, j))
    end do
    call dpotrf('L', m, self%lower, size(self%lower, 1), info)
    self%grows = info == 0
    if (.not. self%grows) return
    do j = 1, m
      self%least = min(self%least, self%lower(j, j)**2)
    end do
    self%grows = self%least > PIVOT_TOLERANCE*self%largest
    self%rows = m
    self%has = contact
    self%unit(:m) = 1.0_dp
    call dtrsv('L', 'N', 'N', m, self%lower, size(self%lower, 1), self%unit, 1)
  end subroutine factor_first

  !> Add the row of a point.
  subroutine add_row(self, canonical, point)
    class(path_factor), intent(inout) :: self
    type(canonical_problem), intent(in) :: canonical
    integer, intent(in) :: point
    real(dp) :: row(self%rows), diagonal, pivot
    integer :: m

    m = self%rows
    ! By a column, which lies together in memory; alpha is symmetric but for rounding.
    row = canonical%alpha(self%points(:m), point) - canonical%datum
    call dtrsv('L', 'N', 'N', m, self%lower, size(self%lower, 1), row, 1)
    diagonal = canonical%alpha(point, point) - canonical%datum
    pivot = diagonal - dot_product(row, row)
    self%largest = max(self%largest, diagonal)
    self%least = min(self%least, pivot)
    self%grows = pivot > PIVOT_TOLERANCE*self%largest
    if (.not. self%grows) return
    self%lower(m + 1, :m) = row
    self%lower(m + 1, m + 1) = sqrt(pivot)
    self%unit(m + 1) = (1.0_dp - dot_product(row, self%unit(:m)))/self%lower(m + 1, m + 1)
    self%points(m + 1) = point
    self%has(point) = .true.
    self%rows = m + 1
  end subroutine add_row

  !> Forces (n) and motions (m) with gap + (alpha - datum) f - R q = 0 on the contact set and R^T f = load, with the
  !> datum of the problem. `gap` (n) is read on the set only.
  subroutine solve(self, canonical, gap, load, force, motion)
    class(path_factor), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    real(dp), intent(in) :: gap(:), load(:)
    real(dp), intent(out) :: force(:), motion(:)
    real(dp) :: solution(self%rows)
    integer :: m

    if (.not. self%grows) then
      call solve_set(self%kkt, canonical%datum, gap, load, force, motion)
      return
    end if
    m = self%rows
    solution = -gap(self%points(:m))
    if (any(abs(solution) > 0.0_dp)) call dtrsv('L', 'N', 'N', m, self%lower, size(self%lower, 1), solution, 1)
    associate (unit => self%unit(:m))
      motion(1) = (load(1) - dot_product(unit, solution))/dot_product(unit, unit)
      solution = solution + motion(1)*unit
    end associate
    call dtrsv('L', 'T', 'N', m, self%lower, size(self%lower, 1), solution, 1)
    force = 0.0_dp
    force(self%points(:m)) = solution
  end subroutine solve

  !> Is a residual in double precision exact enough?
  pure function is_well_conditioned(self) result(well)
    class(path_factor), intent(in) :: self
    logical :: well

    if (self%grows) then
      well = self%largest < WELL_CONDITIONED*self%least
    else
      well = self%kkt%pivot_ratio < WELL_CONDITIONED .and. .not. self%kkt%regularisation > 0.0_dp
    end if
  end function is_well_conditioned

  !> May a solution have lost more than the last digits? With other modes than one translation of all points, the soft
  !> springs of the KKT factor cost digits of the motions.
  pure function needs_refinement(self, canonical) result(needs)
    class(path_factor), intent(in) :: self
    type(canonical_problem), intent(in) :: canonical
    logical :: needs

    needs = .not. self%is_well_conditioned()
    if (size(canonical%modes, 2) > 0) needs = needs .or. size(canonical%modes, 2) > 1 .or. &
      .not. canonical%has_translation
  end function needs_refinement

end module fuge_path_factor
