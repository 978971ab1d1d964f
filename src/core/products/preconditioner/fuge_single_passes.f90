!> The passes over the points of a search in single precision. Large arrays do not stay in the cache from one pass to
!> the next, so that reading them takes longer than the arithmetic: each is read as seldom as possible.
!>
!> Forces and gaps are in double precision. The distances of the points from the stop, those in contact also as the
!> residuals that the preconditioner takes, search directions and what products give are in single precision; sums are
!> in double precision, chunk by chunk (fuge_point_chunks).
module fuge_single_passes
  use fuge_contact_segments, only: contact_segments
  use fuge_kinds, only: dp, sp
  use fuge_point_chunks, only: chunked_pass
  use fuge_single_kernels, only: add_and_sum, inner_and_sum, inner_product, move_distances, project_and_turn, &
    step_forces
  implicit none
  private

  public :: add_moves, center_residuals, exchange_points, give_displacements, mark_contact, scale_forces, set_forces, &
    settle_distances, start_distances, step_all, sum_curvature, sum_energy, sum_contact_forces, &
    sum_forces, sum_gaps, sum_uniform, sum_with_uniform, take_displacements, turn_direction

  !> What the passes read and change, all (n): pointers to the arrays of one search.
  type, extends(chunked_pass), public :: point_pass
    real(dp), pointer, contiguous :: gap(:) => null(), force(:) => null(), displacement(:) => null()
    logical, pointer, contiguous :: contact(:) => null()
    real(sp), pointer, contiguous :: distance(:) => null(), residual(:) => null(), direction(:) => null(), &
      work(:) => null(), uniform(:) => null()
    type(contact_segments), pointer :: segments => null()
    !> What a pass needs besides.
    real(dp) :: factor = 0.0_dp, ratio = 0.0_dp, motion = 0.0_dp, noise = 0.0_dp, shift = 0.0_dp
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

  !> Do `operation` on all chunks; it finds `results` numbers in each.
  subroutine go(self, operation, results)
    class(point_pass), intent(inout) :: self
    procedure(chunk_operation) :: operation
    integer, intent(in) :: results

    self%operation => operation
    call self%run(size(self%gap), results)
  end subroutine go

  subroutine do_chunk(self, k, first, last)
    class(point_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last

    call self%operation(self, k, first, last)
  end subroutine do_chunk

  !> Contact where forces push. Found: the sum of these forces, and the largest magnitude of a gap.
  subroutine sum_forces(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    pass%contact(first:last) = pass%force(first:last) > 0.0_dp
    pass%found(:, k) = [sum(pass%force(first:last), mask=pass%contact(first:last)), &
                        maxval(abs(pass%gap(first:last)))]
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

  !> Tensile points leave the contact, points that penetrate by more than `noise` join it; distances are too large by
  !> `shift`. Found: how many did, the sum of the forces in the new contact, and its points.
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
        if (pass%force(i) < 0.0_dp) then
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

  !> Found: the sum of gaps and `work`, the displacements, over the contact, and the largest displacement.
  subroutine sum_gaps(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: total
    integer :: i, j

    total = 0.0_dp
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      do i = pass%segments%first(j), pass%segments%last(j)
        total = total + (pass%gap(i) + real(pass%work(i), dp))
      end do
    end do
    pass%found(:, k) = [total, real(maxval(abs(pass%work(first:last))), dp)]
  end subroutine sum_gaps

  !> Distances from gaps and `work`, the displacements, less `motion`.
  subroutine start_distances(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (k > 0) pass%distance(first:last) = real((pass%gap(first:last) - pass%motion) &
                                                + real(pass%work(first:last), dp), sp)
  end subroutine start_distances

  !> Distances from gaps and displacements less `motion`. Found: their sum over the contact, and the largest magnitude
  !> of a displacement.
  subroutine take_displacements(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    pass%distance(first:last) = real((pass%gap(first:last) - pass%motion) + pass%displacement(first:last), sp)
    pass%found(:, k) = [sum_over_contact(pass, k, pass%distance), maxval(abs(pass%displacement(first:last)))]
  end subroutine take_displacements

  !> Displacements from distances, which are too large by `shift`. Found: the largest magnitude of one.
  subroutine give_displacements(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    pass%displacement(first:last) = (real(pass%distance(first:last), dp) - pass%shift) &
                                    - (pass%gap(first:last) - pass%motion)
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

  !> Add `work`, the displacements by a change of the forces, to the distances. Found: their sum over the contact, and
  !> the largest change.
  subroutine add_moves(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: largest

    call add_and_sum(last - first + 1, pass%work(first:last), pass%distance(first:last), largest)
    pass%found(:, k) = [sum_over_contact(pass, k, pass%distance), largest]
  end subroutine add_moves

  !> Subtract `shift` from the distances; those in the contact are the residuals, which are zero off it. Found: the
  !> largest residual, the deepest penetration, and minus the least magnitude of a gap less `motion` in the contact.
  subroutine settle_distances(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
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
        least = min(least, abs(pass%gap(i) - pass%motion))
      else
        pass%residual(i) = 0.0_sp
        deepest = max(deepest, -pass%distance(i))
      end if
    end do
    pass%found(:, k) = [real(residuals, dp), real(deepest, dp), -least]
  end subroutine settle_distances

  !> The direction is 1 in the contact and 0 off it.
  subroutine mark_contact(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (k > 0) pass%direction(first:last) = merge(1.0_sp, 0.0_sp, pass%contact(first:last))
  end subroutine mark_contact

  !> Found: the sum of `uniform` over the contact.
  subroutine sum_uniform(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last

    if (last >= first) pass%found(1, k) = sum_over_contact(pass, k, pass%uniform)
  end subroutine sum_uniform

  !> Found: the inner product of residuals and `uniform` over the contact.
  subroutine sum_with_uniform(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    integer :: j

    if (last < first) return
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        pass%found(1, k) = pass%found(1, k) + inner_product(b - a + 1, pass%residual(a:b), pass%uniform(a:b))
      end associate
    end do
  end subroutine sum_with_uniform

  !> Subtract `shift` from the residuals in the contact.
  subroutine center_residuals(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    integer :: j

    if (last < first) return
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        pass%residual(a:b) = pass%residual(a:b) - real(pass%shift, sp)
      end associate
    end do
  end subroutine center_residuals

  !> Found: the inner product of the residuals and the preconditioned ones, `work`, and the sum of these over the
  !> contact.
  subroutine sum_energy(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: found(3)
    integer :: j

    found = 0.0_dp
    if (last < first) return
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        call inner_and_sum(b - a + 1, pass%residual(a:b), pass%work(a:b), found)
      end associate
    end do
    pass%found(:, k) = found(:2)
  end subroutine sum_energy

  !> direction = (work - factor*uniform) + ratio*direction in the contact; with the ratio 0 also zero off it. Found: the
  !> largest magnitude of the first term.
  subroutine turn_direction(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(sp) :: largest
    integer :: j

    if (.not. pass%ratio > 0.0_dp) pass%direction(first:last) = 0.0_sp
    largest = 0.0_sp
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        call project_and_turn(b - a + 1, real(pass%factor, sp), real(pass%ratio, sp), pass%work(a:b), &
                              pass%uniform(a:b), pass%direction(a:b), largest)
      end associate
    end do
    pass%found(1, k) = real(largest, dp)
  end subroutine turn_direction

  !> Found: the inner product of the direction and its displacements, `work`, over the contact, and the sum and the
  !> largest magnitude of these.
  subroutine sum_curvature(pass, k, first, last)
    class(point_pass), intent(inout) :: pass
    integer, intent(in) :: k, first, last
    real(dp) :: found(3)
    integer :: j

    found = 0.0_dp
    if (last < first) return
    do j = pass%segments%before(k) + 1, pass%segments%before(k + 1)
      associate (a => pass%segments%first(j), b => pass%segments%last(j))
        call inner_and_sum(b - a + 1, pass%direction(a:b), pass%work(a:b), found)
      end associate
    end do
    pass%found(:, k) = found
  end subroutine sum_curvature

  !> Subtract `factor` times the direction from the forces in the contact, and `factor` times `work`, less `shift`, from
  !> all distances. Found: the sum and the largest magnitude of the new residuals, the deepest penetration, and the
  !> largest tension.
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
    pass%found(:, k) = [total, real(largest, dp), real(deepest, dp), tension]
  end subroutine step_all

end module fuge_single_passes
