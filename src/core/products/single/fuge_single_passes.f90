!> The passes over the points of a search in single precision. Large arrays do not stay in the cache from one pass to
!> the next, so that reading them takes longer than the arithmetic: each is read as seldom as possible.
!>
!> Forces and gaps are in double precision. The distances of the points from the stop, those in contact also as the
!> residuals that the preconditioner takes, search directions and what products give are in single precision; sums are
!> in double precision, chunk by chunk (fuge_point_chunks).
module fuge_single_passes
  use fuge_contact_scene, only: OUT_OF_REACH
  use fuge_contact_segments, only: contact_segments
  use fuge_kinds, only: dp, sp
  use fuge_point_chunks, only: chunked_pass
  use fuge_point_space, only: point_space
  use fuge_single_kernels, only: add_and_sum, add_components, find_excess, find_force_excess, inner_and_sum, &
    move_distances, project_and_turn, step_forces, subtract_column
  implicit none
  private

  public :: add_moves, center_residuals, exchange_points, give_displacements, mark_contact, move_rigidly, note_basis, &
    scale_forces, set_forces, settle_distances, start_distances, step_all, sum_curvature, sum_energy, &
    sum_contact_forces, sum_direction, sum_forces, sum_gaps, sum_images, sum_with_images, take_change, &
    take_displacements, turn_direction

  !> Points of which a column is computed in the nearest cache.
  integer, parameter :: BLOCK_SIZE = 512
  !> The distance of points that take no part: no displacement closes it.
  real(dp), parameter, public :: FAR = 1.0e30_dp

  !> What the passes read and change, all (n): pointers to the arrays of one search.
  !>
  !> Rigid motions that are free are the columns of `basis`, orthonormal on the contact; where there is just one
  !> translation it is not associated, and its column is one of ones. Results that follow from each column are the last
  !> ones that a pass finds, `columns` of them.
  type, extends(chunked_pass), public :: point_pass
    real(dp), pointer, contiguous :: gap(:) => null(), force(:) => null(), displacement(:) => null()
    logical, pointer, contiguous :: contact(:) => null()
    real(sp), pointer, contiguous :: distance(:) => null(), residual(:) => null(), direction(:) => null(), &
      work(:) => null()
    type(contact_segments), pointer :: segments => null()
    !> The ranks that share the points.
    type(point_space) :: space = point_space()
    !> Forces that displace all points of the contact as the columns of the basis do, almost; (n, columns).
    real(sp), pointer, contiguous :: images(:, :) => null(), basis(:, :) => null()
    integer :: columns = 1
    !> One translation at most, one stop at all points.
    logical :: is_plain = .false.
    !> One of them.
    integer :: column = 1
    !> Of the columns: what a pass needs.
    real(dp), allocatable :: factors(:)
    !> The modes of the scene, (n, m), and motions in them, (m), where there are any.
    real(dp), pointer, contiguous :: modes(:, :) => null()
    real(dp), allocatable :: motions(:)
    !> Of these the columns of the basis, (m, columns).
    real(dp), allocatable :: coefficients(:, :)
    !> Where points may have two stops, or forces have limits: the stop from which distances count, and the range of the
    !> force of a point in contact, else of its distance.
    real(dp), pointer, contiguous :: stop(:) => null()
    real(sp), pointer, contiguous :: least(:) => null(), most(:) => null()
    logical :: all_points = .false., needs_terms = .false.
    !> Forces before a change.
    real(dp), pointer, contiguous :: before(:) => null()
    !> What a pass needs besides.
    real(dp) :: factor = 0.0_dp, ratio = 0.0_dp, motion = 0.0_dp, noise = 0.0_dp, shift = 0.0_dp, tension = 0.0_dp
    procedure(chunk_operation), pointer, nopass :: operation => null()
  contains
    procedure :: do_chunk
    procedure :: go
  end type point_pass

  abstract interface
    !> Chunk `k`, the points `first` .. `last`.
    subroutine chunk_operation(pass, k, first, last)
      import :: point_pass
      class(point_pass), intent(inout) :: pass
      integer, intent(in) :: k, first, last
    end subroutine chunk_operation
  end interface

contains

  !> Do `operation` on all chunks; it finds numbers of which the largest count, `maxima` of them, then others that are
  !> added up, `sums`. Where ranks share the points, the results are those of all ranks.
  subroutine go(self, operation, maxima, sums)
    class(point_pass), intent(inout) :: self
    procedure(chunk_operation) :: operation
    integer, intent(in) :: maxima, sums
    real(dp) :: results(maxima + sums)
    integer :: i

    self%operation => operation
    call self%run(size(self%gap), maxima + sums)
    if (self%space%is_alone()) return
    results = [(self%largest(i), i=1, maxima), (self%total(i), i=maxima + 1, maxima + sums)]
    if (maxima > 0) call self%space%raise(results(:maxima))
    if (sums > 0) call self%space%add(results(maxima + 1:))
    do i = 1, maxima + sums
      self%found(i, :) = merge(results(i), 0.0_dp, i <= maxima)
      self%found(i, 1) = results(i)
    end do
  end subroutine go

  subroutine do_chunk(self, k, first, last)
    class(point_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    call self%operation(self, k, first, last)
  end subroutine do_chunk

  !> Gaps of a chunk from the stops of its points, less the rigid displacements.
  subroutine undeformed_gaps(pass, first, last, gaps)
    class(point_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(out) :: gaps(first:)
    integer :: j

    gaps(first:last) = min(pass%gap(first:last) - pass%motion, FAR)
    if (associated(pass%modes)) then
      do j = 1, size(pass%motions)
        gaps(first:last) = gaps(first:last) - pass%motions(j)*pass%modes(first:last, j)
      end do
    end if
    if (associated(pass%stop)) gaps(first:last) = gaps(first:last) - pass%stop(first:last)
  end subroutine undeformed_gaps

  !> Found, from number `before` + 1 on: the components over the contact of chunk `k` of `values` (n) in the basis.
  subroutine find_components(pass, k, values, before)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, before
    real(sp), intent(in), contiguous :: values(:)
    real(dp) :: found(pass%columns)
    integer :: i

    if (.not. associated(pass%basis)) then
      pass%found(before + 1, k) = sum_over_contact(pass, k, values)
      return
    end if
    found = 0.0_dp
    do i = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(i), b => pass%segments%last(i))
        call add_components(a, b, size(values), pass%columns, values, pass%basis, found)
      end associate
    end do
    pass%found(before + 1:before + pass%columns, k) = found
  end subroutine find_components

  !> Subtract `factors` times the columns of the basis from the `values` of a chunk.
  subroutine subtract_rigid(pass, first, last, factors, values)
    class(point_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(in) :: factors(:)
    real(sp), intent(inout), contiguous :: values(:)
    integer :: j

    do j = 1, pass%columns
      call subtract_column(last - first + 1, real(factors(j), sp), pass%basis(first:last, j), values(first:last))
    end do
  end subroutine subtract_rigid

  !> Contact where forces push and points take part. Found: the largest magnitude of a gap, and the sum of these forces.
  subroutine sum_forces(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    pass%contact(first:last) = pass%force(first:last) > 0.0_dp .and. pass%gap(first:last) < OUT_OF_REACH
    pass%found(:, k) = [maxval(abs(pass%gap(first:last)), mask=pass%gap(first:last) < OUT_OF_REACH), &
                        sum(pass%force(first:last), mask=pass%contact(first:last))]
  end subroutine sum_forces

  !> Found: the sum of the forces in the contact.
  subroutine sum_contact_forces(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    integer :: j

    if (last < first) return
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      pass%found(1, k) = pass%found(1, k) + sum(pass%force(pass%segments%first(j):pass%segments%last(j)))
    end do
  end subroutine sum_contact_forces

  !> Multiply the forces by `factor`.
  subroutine scale_forces(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (k > 0) pass%force(first:last) = pass%factor*pass%force(first:last)
  end subroutine scale_forces

  !> Points that pull by more than `tension` leave the contact, those that penetrate by more than `noise` join it;
  !> distances are too large by `shift`. Found: how many did, the sum of the forces in the new contact, and its points.
  subroutine exchange_points(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: total
    real(sp) :: least
    integer :: i, points, wrong

    total = 0.0_dp
    points = 0
    wrong = 0
    least = real(pass%shift - pass%noise, sp)
    do i = first, last
      if (pass%contact(i)) then
        if (pass%force(i) < -pass%tension) then
          pass%contact(i) = .false.
          wrong = wrong + 1
        else
          total = total + pass%force(i)
          points = points + 1
        end if
      else if (pass%distance(i) < least) then
        pass%contact(i) = .true.
        wrong = wrong + 1
        points = points + 1
      end if
    end do
    pass%found(:, k) = [real(wrong, dp), total, real(points, dp)]
  end subroutine exchange_points

  !> Forces that push in the contact and are zero off it, times `factor`; `direction` is the change. With a `factor`
  !> that is not positive all points have equal forces, `shift`, in contact.
  subroutine set_forces(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: force
    integer :: i

    if (k < 1) return
    if (.not. pass%factor > 0.0_dp) then
      pass%contact(first:last) = .true.
      pass%direction(first:last) = real(pass%shift - pass%force(first:last), sp)
      pass%force(first:last) = pass%shift
      return
    end if
    do i = first, last
      force = 0.0_dp
      if (pass%contact(i)) force = pass%factor*max(pass%force(i), 0.0_dp)
      pass%direction(i) = real(force - pass%force(i), sp)
      pass%force(i) = force
    end do
  end subroutine set_forces

  !> The direction is the change of the forces. Found: the largest magnitude of a force, and the sum of them.
  subroutine take_change(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    pass%direction(first:last) = real(pass%force(first:last) - pass%before(first:last), sp)
    pass%found(:, k) = [maxval(abs(pass%force(first:last))), sum(abs(pass%force(first:last)))]
  end subroutine take_change

  !> The basis: the modes times the `coefficients`. Found: the largest magnitude.
  subroutine note_basis(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: column(BLOCK_SIZE), largest(BLOCK_SIZE)
    integer :: begin, i, j, n

    largest = 0.0_dp
    do begin = first, last, BLOCK_SIZE
      n = min(BLOCK_SIZE, last - begin + 1)
      do j = 1, size(pass%coefficients, 2)
        column(:n) = pass%coefficients(1, j)*pass%modes(begin:begin + n - 1, 1)
        do i = 2, size(pass%coefficients, 1)
          column(:n) = column(:n) + pass%coefficients(i, j)*pass%modes(begin:begin + n - 1, i)
        end do
        pass%basis(begin:begin + n - 1, j) = real(column(:n), sp)
        largest(:n) = max(largest(:n), abs(column(:n)))
      end do
    end do
    pass%found(1, k) = maxval(largest)
  end subroutine note_basis

  !> Subtract the `motions` in the modes from the displacements. Found: the largest of these before.
  subroutine move_rigidly(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    integer :: j

    pass%found(1, k) = maxval(abs(pass%displacement(first:last)))
    do j = 1, size(pass%motions)
      pass%displacement(first:last) = pass%displacement(first:last) - pass%motions(j)*pass%modes(first:last, j)
    end do
  end subroutine move_rigidly

  !> Found: the largest of `work`, the displacements, and the components over the contact of gaps with them.
  subroutine sum_gaps(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: gaps(first:last)
    integer :: c, i, j

    call undeformed_gaps(pass, first, last, gaps)
    pass%found(1, k) = real(maxval(abs(pass%work(first:last))), dp)
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      do i = pass%segments%first(j), pass%segments%last(j)
        gaps(i) = gaps(i) + real(pass%work(i), dp)
        if (.not. associated(pass%basis)) pass%found(2, k) = pass%found(2, k) + gaps(i)
      end do
      if (.not. associated(pass%basis)) cycle
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        do c = 1, pass%columns
          pass%found(1 + c, k) = pass%found(1 + c, k) + dot_product(gaps(a:b), real(pass%basis(a:b, c), dp))
        end do
      end associate
    end do
  end subroutine sum_gaps

  !> Distances from gaps and `work`, the displacements, less the rigid motion.
  subroutine start_distances(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: gaps(first:last)

    if (k < 1) return
    call undeformed_gaps(pass, first, last, gaps)
    pass%distance(first:last) = real(gaps(first:last) + real(pass%work(first:last), dp), sp)
  end subroutine start_distances

  !> Distances from gaps and displacements less the motion. Found: the largest magnitude of a displacement, and the
  !> components of distances over the contact.
  subroutine take_displacements(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: gaps(first:last)

    if (pass%is_plain) then
      pass%distance(first:last) = real((pass%gap(first:last) - pass%motion) + pass%displacement(first:last), sp)
    else
      call undeformed_gaps(pass, first, last, gaps)
      pass%distance(first:last) = real(gaps + pass%displacement(first:last), sp)
    end if
    pass%found(1, k) = maxval(abs(pass%displacement(first:last)))
    call find_components(pass, k, pass%distance, 1)
  end subroutine take_displacements

  !> Displacements from distances, which are too large by `shift`, or by `factors` times the basis. Found: the largest
  !> magnitude of one.
  subroutine give_displacements(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: gaps(first:last)
    integer :: j

    call undeformed_gaps(pass, first, last, gaps)
    pass%displacement(first:last) = (real(pass%distance(first:last), dp) - pass%shift) - gaps(first:last)
    if (associated(pass%basis)) then
      do j = 1, pass%columns
        pass%displacement(first:last) = pass%displacement(first:last) &
                                        - pass%factors(j)*real(pass%basis(first:last, j), dp)
      end do
    end if
    pass%found(1, k) = maxval(abs(pass%displacement(first:last)))
  end subroutine give_displacements

  !> The sum of `values` (n) over the contact points of chunk k.
  function sum_over_contact(pass, k, values) result(total)
    class(point_pass), intent(in) :: pass
    integer, intent(in) :: k
    real(sp), intent(in), contiguous :: values(:)
    real(dp) :: total
    integer :: i, j

    total = 0.0_dp
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      do i = pass%segments%first(j), pass%segments%last(j)
        total = total + real(values(i), dp)
      end do
    end do
  end function sum_over_contact

  !> Add `work`, the displacements by a change of the forces, to the distances. Found: the largest change, and the
  !> components of the distances over the contact.
  subroutine add_moves(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    call add_and_sum(last - first + 1, pass%work(first:last), pass%distance(first:last), pass%found(1, k))
    call find_components(pass, k, pass%distance, 1)
  end subroutine add_moves

  !> Subtract `shift`, or `factors` times the basis, from the distances; those in the contact are the residuals, which
  !> are zero off it. Found: the largest residual, the deepest penetration, minus the least magnitude of an undeformed
  !> gap in the contact, and, if it is needed, where there are modes the largest sum of the magnitudes of its terms.
  subroutine settle_distances(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(sp) :: deepest
    real(dp), allocatable :: gaps(:)

    if (associated(pass%basis)) call subtract_rigid(pass, first, last, pass%factors, pass%distance)
    if (associated(pass%modes) .or. associated(pass%stop)) then
      allocate (gaps(first:last))
      call undeformed_gaps(pass, first, last, gaps)
      if (associated(pass%stop)) gaps = gaps + pass%stop(first:last)
      call settle_points(pass, k, first, last, gaps, 0.0_dp)
    else
      call settle_points(pass, k, first, last, pass%gap(first:last), pass%motion)
    end if
    if (associated(pass%least)) then
      call measure_excess(pass, k, first, last, deepest)
      pass%found(2, k) = real(deepest, dp)
    end if
    if (associated(pass%modes) .and. pass%needs_terms) call find_terms(pass, first, last, pass%found(4, k))
  end subroutine settle_distances

  !> What settle_distances does at the points of a chunk, whose gaps less `motion` are undeformed.
  subroutine settle_points(pass, k, first, last, gaps, motion)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp), intent(in) :: gaps(first:last), motion
    real(dp) :: least
    real(sp) :: deepest, residuals, shift
    integer :: i

    least = huge(least)
    residuals = 0.0_sp
    deepest = 0.0_sp
    shift = real(pass%shift, sp)
    do i = first, last
      pass%distance(i) = pass%distance(i) - shift
      if (pass%contact(i)) then
        pass%residual(i) = pass%distance(i)
        residuals = max(residuals, abs(pass%distance(i)))
        least = min(least, abs(gaps(i) - motion))
      else
        pass%residual(i) = 0.0_sp
        deepest = max(deepest, -pass%distance(i))
      end if
    end do
    pass%found(:3, k) = [real(residuals, dp), real(deepest, dp), -least]
  end subroutine settle_points

  !> The largest sum of the magnitudes of a gap in the contact and its rigid displacements, of a chunk.
  subroutine find_terms(pass, first, last, largest)
    class(point_pass), intent(in) :: pass
    integer, intent(in) :: first, last
    real(dp), intent(out) :: largest
    real(dp) :: terms(first:last)
    integer :: j

    terms = abs(pass%gap(first:last))
    do j = 1, size(pass%motions)
      terms = terms + abs(pass%motions(j)*pass%modes(first:last, j))
    end do
    largest = max(0.0_dp, maxval(terms, mask=pass%contact(first:last)))
  end subroutine find_terms

  !> `excess`: how far distances of points of a chunk that are not in contact are out of their ranges, and `tension`,
  !> how far forces are in contact; none if not positive.
  subroutine measure_excess(pass, k, first, last, excess, tension)
    class(point_pass), intent(in) :: pass
    integer, intent(in) :: k, first, last
    real(sp), intent(out) :: excess
    real(dp), intent(out), optional :: tension
    integer :: after, j

    excess = 0.0_sp
    if (present(tension)) tension = 0.0_dp
    after = first - 1
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        call find_excess(a - 1 - after, pass%distance(after + 1:a - 1), pass%least(after + 1:a - 1), &
                         pass%most(after + 1:a - 1), excess)
        if (present(tension)) call find_force_excess(b - a + 1, pass%force(a:b), pass%least(a:b), pass%most(a:b), &
                                                     tension)
        after = b
      end associate
    end do
    call find_excess(last - after, pass%distance(after + 1:last), pass%least(after + 1:last), &
                     pass%most(after + 1:last), excess)
  end subroutine measure_excess

  !> The direction is 1 in the contact, or column number `column` of the basis, and 0 off it.
  subroutine mark_contact(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (k < 1) return
    if (associated(pass%basis)) then
      pass%direction(first:last) = merge(pass%basis(first:last, pass%column), 0.0_sp, pass%contact(first:last))
    else
      pass%direction(first:last) = merge(1.0_sp, 0.0_sp, pass%contact(first:last))
    end if
  end subroutine mark_contact

  !> Found: the components of each of the images over the contact, one after the other.
  subroutine sum_images(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    integer :: j

    if (last < first) return
    do j = 1, pass%columns
      call find_components(pass, k, pass%images(:, j), pass%columns*(j - 1))
    end do
  end subroutine sum_images

  !> Found: the inner products of residuals and each of the images over the contact.
  subroutine sum_with_images(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    integer :: j

    if (last < first) return
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        call add_components(a, b, size(pass%residual), pass%columns, pass%residual, pass%images, pass%found(:, k))
      end associate
    end do
  end subroutine sum_with_images

  !> Subtract `shift`, or `factors` times the basis, from the residuals in the contact.
  subroutine center_residuals(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    integer :: j

    if (last < first) return
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        if (associated(pass%basis)) then
          call subtract_rigid(pass, a, b, pass%factors, pass%residual)
        else
          pass%residual(a:b) = pass%residual(a:b) - real(pass%shift, sp)
        end if
      end associate
    end do
  end subroutine center_residuals

  !> `found` over the contact of chunk `k`: the inner product of `x` (n) and `work`, the sum of `work`, and its largest
  !> magnitude.
  subroutine inner_over_contact(pass, k, x, found)
    class(point_pass), intent(in) :: pass
    integer, intent(in) :: k
    real(sp), intent(in), contiguous :: x(:)
    real(dp), intent(out) :: found(3)
    integer :: j

    found = 0.0_dp
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        call inner_and_sum(b - a + 1, x(a:b), pass%work(a:b), found)
      end associate
    end do
  end subroutine inner_over_contact

  !> Found: the inner product of the residuals and the preconditioned ones, `work`, and the components of these over the
  !> contact.
  subroutine sum_energy(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: found(3)

    if (last < first) return
    call inner_over_contact(pass, k, pass%residual, found)
    pass%found(:2, k) = found(:2)
    if (associated(pass%basis)) then
      pass%found(2, k) = 0.0_dp
      call find_components(pass, k, pass%work, 1)
    end if
  end subroutine sum_energy

  !> direction = (work - factors*images) + ratio*direction in the contact; with the ratio 0 also zero off it. Found: the
  !> largest magnitude of the first term.
  subroutine turn_direction(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(sp) :: largest
    integer :: c, j

    if (.not. pass%ratio > 0.0_dp) pass%direction(first:last) = 0.0_sp
    largest = 0.0_sp
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        do c = 2, pass%columns
          call subtract_column(b - a + 1, real(pass%factors(c), sp), pass%images(a:b, c), pass%work(a:b))
        end do
        call project_and_turn(b - a + 1, real(pass%factors(1), sp), real(pass%ratio, sp), pass%work(a:b), &
                              pass%images(a:b, 1), pass%direction(a:b), largest)
      end associate
    end do
    pass%found(1, k) = real(largest, dp)
  end subroutine turn_direction

  !> Found: the sum of the direction over the contact, or over `all_points`.
  subroutine sum_direction(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (pass%all_points) then
      pass%found(1, k) = sum(real(pass%direction(first:last), dp))
    else
      pass%found(1, k) = sum_over_contact(pass, k, pass%direction)
    end if
  end subroutine sum_direction

  !> Found: the largest magnitude of the displacements by the direction, `work`, over the contact, the inner product of
  !> both, and the components of these.
  subroutine sum_curvature(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: found(3)

    if (last < first) return
    call inner_over_contact(pass, k, pass%direction, found)
    pass%found(:3, k) = [found(3), found(1), found(2)]
    if (associated(pass%basis)) then
      pass%found(3, k) = 0.0_dp
      call find_components(pass, k, pass%work, 2)
    end if
  end subroutine sum_curvature

  !> Subtract `factor` times the direction from the forces in the contact, and `factor` times `work`, less `shift` or
  !> `factors` times the basis, from all distances. Found: the largest magnitude of the new residuals, the deepest
  !> penetration, the largest tension, and the components of the new residuals.
  subroutine step_all(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: tension, total
    real(sp) :: deepest, factor, largest, shift
    integer :: after, j

    total = 0.0_dp
    tension = 0.0_dp
    deepest = 0.0_sp
    largest = 0.0_sp
    factor = real(pass%factor, sp)
    shift = real(pass%shift, sp)
    if (associated(pass%basis)) call subtract_rigid(pass, first, last, pass%factors/pass%factor, pass%work)
    after = first - 1
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        call move_distances(a - 1 - after, factor, shift, pass%work(after + 1:a - 1), pass%distance(after + 1:a - 1), &
                            deepest)
        call step_forces(b - a + 1, pass%factor, factor, shift, pass%direction(a:b), pass%work(a:b), pass%force(a:b), &
                         pass%distance(a:b), pass%residual(a:b), total, largest, tension)
        after = b
      end associate
    end do
    call move_distances(last - after, factor, shift, pass%work(after + 1:last), pass%distance(after + 1:last), deepest)
    if (associated(pass%least)) call measure_excess(pass, k, first, last, deepest, tension)
    pass%found(:4, k) = [real(largest, dp), real(deepest, dp), tension, total]
    if (associated(pass%basis)) then
      pass%found(4, k) = 0.0_dp
      call find_components(pass, k, pass%residual, 3)
    end if
  end subroutine step_all

end module fuge_single_passes
