!> The rigid motions of a contact set: a basis of them that is orthonormal on the set.
!>
!> Lengths on the set split into a rigid motion and the rest, which is orthogonal to all rigid motions; forces are
!> corrected by the least change that gives the resultants.
module fuge_mode_projection
  use fuge_contact_segments, only: contact_segments, dot_over
  use fuge_kinds, only: dp
  use fuge_point_chunks, only: chunked_pass
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  !> A mode is a combination of the others on the set if its remainder is below this fraction: modes about a far-away
  !> point have lost digits when they were made orthogonal.
  real(dp), parameter :: DEPENDENT = 1.0e-10_dp
  !> The error of a resultant counts as rounding up to this many units in the last place of its terms, times the root of
  !> their number.
  real(dp), parameter :: ROUNDINGS = 8.0_dp
  !> Where the remainder of each mode is at least this fraction of it, inner products of the modes tell the basis to
  !> eight digits or more.
  real(dp), parameter :: CLEARLY_INDEPENDENT = 1.0e-3_dp
  !> Several partial sums are faster than one.
  integer, parameter :: LANES = 4

  !> Set it for a contact set; it belongs to that set only.
  type, public :: mode_projection
    !> modes*coefficients at all points, (n, m), the first `rank` columns orthonormal on the set; length. Only if
    !> `has_basis`.
    real(dp), allocatable :: basis(:, :)
    logical :: has_basis = .false.
    !> Without a basis the coefficients are enough, where they can be told without one.
    logical :: needs_basis = .true.
    !> (m, m), the first `rank` columns.
    real(dp), allocatable :: coefficients(:, :)
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

  !> Over the contact: subtracts from the force the motion with the `weights` (m), if there are any, and finds the
  !> resultants of the force, (m), and with `terms` the sums of the magnitudes of their terms; or without a force the
  !> inner products of the modes.
  type, extends(chunked_pass) :: mode_pass
    real(dp), pointer, contiguous :: modes(:, :) => null(), force(:) => null()
    type(contact_segments), pointer :: segments => null()
    real(dp), allocatable :: weights(:)
    logical :: terms = .false.
  contains
    procedure :: do_chunk
  end type mode_pass

contains

  !> The basis for `modes` (n, m) on the set with these segments. Error: FUGE_ERR_MEMORY.
  subroutine set(self, modes, segments, info)
    class(mode_projection), intent(inout) :: self
    real(dp), intent(in), contiguous :: modes(:, :)
    type(contact_segments), intent(in) :: segments
    type(fuge_info), intent(inout) :: info
    integer :: j, m, stat
    logical :: done

    m = size(modes, 2)
    stat = 0
    if (.not. allocated(self%coefficients)) allocate (self%coefficients(m, m), stat=stat)
    call require_memory(stat, 'the coefficients of', m, 'rigid motions', info)
    call segments%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    self%has_basis = .false.
    if (.not. self%needs_basis) then
      call find_coefficients(self, modes, segments, done)
      if (done) return
    end if
    self%has_basis = .true.
    if (.not. allocated(self%basis)) allocate (self%basis(size(modes, 1), m), stat=stat)
    call require_memory(stat, 'the rigid motions of', size(modes, 1), 'points', info)
    call segments%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    self%rank = 0
    do j = 1, m
      call append(self, modes(:, j), j, segments)
    end do
  end subroutine set

  !> The coefficients from the inner products of the modes; `done` if these are clearly independent on the set.
  subroutine find_coefficients(self, modes, segments, done)
    class(mode_projection), intent(inout) :: self
    real(dp), intent(in), contiguous, target :: modes(:, :)
    type(contact_segments), intent(in), target :: segments
    logical, intent(out) :: done
    type(mode_pass) :: pass
    real(dp) :: inner(size(modes, 2), size(modes, 2)), sums(size(modes, 2)**2), size_after
    integer :: i, j, m, n

    done = .true.
    m = size(modes, 2)
    pass%modes => modes
    pass%segments => segments
    call pass%run(size(modes, 1), m*m)
    sums = [(pass%total(i), i=1, m*m)]
    call segments%space%add(sums)
    inner = reshape(sums, [m, m])
    do j = 1, m
      associate (column => self%coefficients(:, j))
        column = 0.0_dp
        column(j) = 1.0_dp
        do n = 1, 2
          do i = 1, j - 1
            column = column - dot_product(self%coefficients(:, i), matmul(inner, column))*self%coefficients(:, i)
          end do
        end do
        size_after = dot_product(column, matmul(inner, column))
        done = size_after > CLEARLY_INDEPENDENT**2*inner(j, j)
        if (.not. done) return
        column = column/sqrt(size_after)
      end associate
    end do
    self%rank = m
  end subroutine find_coefficients

  subroutine do_chunk(self, k, first, last)
    class(mode_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: i, j, m, s

    if (last < first) return
    m = size(self%modes, 2)
    do s = self%segments%before(k) + 1, self%segments%before(k + 1)
      associate (a => self%segments%first(s), b => self%segments%last(s), modes => self%modes)
        if (.not. associated(self%force)) then
          do j = 1, m
            do i = 1, j
              call add_inner(b - a + 1, modes(a:b, i), modes(a:b, j), self%found(m*(j - 1) + i, k))
            end do
          end do
          cycle
        end if
        if (allocated(self%weights)) then
          do j = 1, m
            self%force(a:b) = self%force(a:b) - self%weights(j)*modes(a:b, j)
          end do
        end if
        do j = 1, m
          call add_inner(b - a + 1, modes(a:b, j), self%force(a:b), self%found(j, k))
          if (self%terms) self%found(m + j, k) = self%found(m + j, k) + sum(abs(modes(a:b, j)*self%force(a:b)))
        end do
      end associate
    end do
    if (associated(self%force)) return
    do j = 1, m
      do i = j + 1, m
        self%found(m*(j - 1) + i, k) = self%found(m*(i - 1) + j, k)
      end do
    end do
  end subroutine do_chunk

  !> `inner` gains the inner product of `x` and `y`.
  pure subroutine add_inner(n, x, y, inner)
    integer, intent(in) :: n
    real(dp), intent(in) :: x(n), y(n)
    real(dp), intent(inout) :: inner
    real(dp) :: partial(LANES)
    integer :: i

    partial = 0.0_dp
    do i = 1, n - LANES + 1, LANES
      partial = partial + x(i:i + LANES - 1)*y(i:i + LANES - 1)
    end do
    do i = n - modulo(n, LANES) + 1, n
      partial(1) = partial(1) + x(i)*y(i)
    end do
    inner = inner + sum(partial)
  end subroutine add_inner

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
    real(dp), intent(in), contiguous, target :: modes(:, :)
    real(dp), intent(in) :: load(:)
    type(contact_segments), intent(in), target :: segments
    real(dp), intent(inout), contiguous, target :: force(:)
    logical, intent(out) :: possible
    type(mode_pass) :: pass
    real(dp) :: missing(size(load)), terms(size(load)), factors(size(load))
    integer :: trial

    pass%modes => modes
    pass%force => force
    pass%segments => segments
    do trial = 1, 2
      call find_missing(pass, load, missing, terms)
      factors = 0.0_dp
      factors(:self%rank) = -matmul(missing, self%coefficients(:, :self%rank))
      if (self%has_basis) then
        call self%subtract_on(segments, factors, force)
      else
        pass%weights = matmul(self%coefficients(:, :self%rank), factors(:self%rank))
      end if
    end do
    pass%terms = .true.
    call find_missing(pass, load, missing, terms)
    possible = all(abs(missing) <= ROUNDINGS*epsilon(missing)*sqrt(real(segments%points, dp)) &
                   *max(terms, maxval(abs(load))))
  end subroutine correct_resultants

  !> The largest of the least forces on the set that make resultants up to `load` (m) in `modes` (n, m), of any sign: a
  !> bound.
  function largest_force(self, modes, segments, load) result(force)
    class(mode_projection), intent(in) :: self
    real(dp), intent(in) :: modes(:, :)
    type(contact_segments), intent(in) :: segments
    real(dp), intent(in) :: load(:)
    real(dp) :: force
    real(dp) :: factors(self%rank)
    integer :: i, k

    force = 0.0_dp
    factors = [(sum(load*abs(self%coefficients(:, i))), i=1, self%rank)]
    do i = 1, size(segments%first)
      do k = segments%first(i), segments%last(i)
        if (self%has_basis) then
          force = max(force, sum(factors*abs(self%basis(k, :self%rank))))
        else
          force = max(force, sum(factors*abs(matmul(modes(k, :), self%coefficients(:, :self%rank)))))
        end if
      end do
    end do
    force = segments%space%largest(force)
  end function largest_force

  !> The resultants that the force of `pass` lacks, `missing`, and the magnitudes of their `terms`, (m).
  subroutine find_missing(pass, load, missing, terms)
    type(mode_pass), intent(inout) :: pass
    real(dp), intent(in) :: load(:)
    real(dp), intent(out) :: missing(:), terms(:)
    real(dp) :: sums(merge(2, 1, pass%terms)*size(load))
    integer :: j

    call pass%run(size(pass%force), size(sums))
    sums = [(pass%total(j), j=1, size(sums))]
    call pass%segments%space%add(sums)
    missing = load - sums(:size(load))
    terms = abs(load)
    if (pass%terms) terms = terms + sums(size(load) + 1:)
  end subroutine find_missing

end module fuge_mode_projection
