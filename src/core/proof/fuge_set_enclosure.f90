!> The solution of the equations of contact for given states of the points, enclosed.
!>
!> With the points W at stops, forces f of the others known, and e the change of the solution from what is claimed,
!>
!>     A e - R e_q = r = c - g - A f + R q      R^T e + S e_q = w - R^T f - S q
!>
!> hold in the rows of W, e = 0 elsewhere, and c changes by A e - R e_q - r in the other rows.
module fuge_set_enclosure
  use fuge_claimed_states, only: point_claim
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv
  use fuge_rounding_bounds, only: absolute_product, absolute_sums, gamma_bound, raised, UNIT_ROUNDOFF
  use fuge_scaled_contact, only: scaled_contact
  use fuge_triple_sums, only: triple_sums
  use fuge_verified_inverse, only: verified_inverse
  implicit none
  private

  public :: add_columns, enclose_set

  !> The solution for the states: each number is within its radius of what is claimed and its change. All in scaled units.
  type, public :: set_enclosure
    !> Points at stops, and free motions: the unknowns, in this order.
    integer, allocatable :: place(:), motion_place(:)
    !> Is there one solution for the states?
    logical :: is_enclosed = .false.
    !> What is claimed: forces, known ones where they are, and gaps, those of the stops, (n).
    real(dp), allocatable :: force(:), gap(:)
    !> Changes and radii of forces, gaps (n) and motions (m).
    real(dp), allocatable :: force_change(:), force_radius(:), gap_change(:), gap_radius(:), motion_change(:), &
                             motion_radius(:)
  contains
    procedure :: spread
    procedure :: force_range
    procedure :: gap_range
  end type set_enclosure

contains

  !> Enclose the solution of `contact` for the `claims` (n), by the `inverse` of the equations. `is_proved`: the equations have one, and it is enclosed.
  !> `stat` is not 0 without memory.
  subroutine enclose_set(contact, claims, enclosure, inverse, is_proved, stat)
    type(scaled_contact), intent(in) :: contact
    type(point_claim), intent(in) :: claims(:)
    type(set_enclosure), intent(inout) :: enclosure
    type(verified_inverse), intent(inout) :: inverse
    logical, intent(out) :: is_proved
    integer, intent(out) :: stat
    real(dp), allocatable :: error(:), matrix(:, :), middle(:), radius(:), residual(:)
    integer :: k, m, n, p

    n = contact%points
    m = contact%motions
    is_proved = .false.
    allocate (residual(n + m), error(n + m), enclosure%force(n), enclosure%gap(n), enclosure%force_change(n), &
              enclosure%force_radius(n), enclosure%gap_change(n), enclosure%gap_radius(n), enclosure%motion_change(m), &
              enclosure%motion_radius(m), stat=stat)
    if (stat /= 0) return
    enclosure%place = pack([(k, k=1, n)], claims%at_stop)
    enclosure%motion_place = pack([(k, k=1, m)], contact%free)
    enclosure%force = contact%scaled_force(merge(0.0_dp, claims%known, claims%at_stop))
    where (claims%at_stop) enclosure%force = contact%force
    enclosure%gap = contact%scaled_length(merge(claims%known, 0.0_dp, claims%at_stop))
    where (.not. claims%at_stop) enclosure%gap = contact%claimed_gap
    p = size(enclosure%place) + size(enclosure%motion_place)
    allocate (matrix(p, p), middle(p), radius(p), stat=stat)
    if (stat /= 0) return
    call fill_matrix(contact, enclosure%place, enclosure%motion_place, matrix)
    call inverse%find(matrix, stat)
    is_proved = inverse%is_proved
    if (stat /= 0 .or. .not. is_proved) return
    deallocate (matrix)
    call find_residual(contact, enclosure%force, enclosure%gap, residual, error, stat)
    if (stat /= 0) return
    associate (unknowns => [enclosure%place, n + enclosure%motion_place])
      call inverse%enclose(residual(unknowns), error(unknowns), middle, radius)
    end associate
    is_proved = all(abs(middle) <= huge(1.0_dp)) .and. all(radius <= huge(1.0_dp))
    if (.not. is_proved) return
    call enclosure%spread(middle, radius)
    call find_gaps(contact, residual(:n), error(:n), enclosure)
  end subroutine enclose_set

  !> The equations: A, -R above R^T, S.
  pure subroutine fill_matrix(contact, place, motion_place, matrix)
    type(scaled_contact), intent(in) :: contact
    integer, intent(in) :: place(:), motion_place(:)
    real(dp), intent(out) :: matrix(:, :)
    integer :: j, k

    k = size(place)
    do j = 1, k
      matrix(:k, j) = contact%matrix(place, place(j))
      matrix(k + 1:, j) = contact%modes(place(j), motion_place)
    end do
    do j = 1, size(motion_place)
      matrix(:k, k + j) = -contact%modes(place, motion_place(j))
      matrix(k + 1:, k + j) = 0.0_dp
      matrix(k + j, k + j) = contact%stiffness(motion_place(j))
    end do
  end subroutine fill_matrix

  !> What is left of the equations by `force` and `gap` (n): `residual` (n + m), known up to `error`. `stat` is not 0
  !> without memory.
  subroutine find_residual(contact, force, gap, residual, error, stat)
    type(scaled_contact), intent(in) :: contact
    real(dp), intent(in), contiguous :: force(:), gap(:)
    real(dp), intent(out), contiguous :: residual(:), error(:)
    integer, intent(out) :: stat
    real(dp) :: terms(contact%points + contact%motions)
    type(triple_sums) :: of_motions, of_points
    integer :: j

    call find_terms(contact, force, gap, terms)
    associate (n => contact%points)
      call of_points%start(terms(:n), stat)
      if (stat == 0) call of_motions%start(terms(n + 1:), stat)
      if (stat /= 0) return
      call of_points%add(gap)
      call of_points%add(-contact%gap)
      do j = 1, n
        if (abs(force(j)) > 0.0_dp) call of_points%add_products(contact%matrix(:, j), -force(j))
      end do
      do j = 1, n
        if (abs(contact%diagonal_rest(j)) > 0.0_dp) call of_points%add_dot(j, contact%diagonal_rest(j:j), -force(j:j))
      end do
      do j = 1, contact%motions
        call of_points%add_products(contact%modes(:, j), contact%motion(j))
        call of_motions%add_dot(j, contact%modes(:, j), -force)
        call of_motions%add_dot(j, contact%stiffness(j:j), -contact%motion(j:j))
      end do
      call of_motions%add(contact%resultant)
      call of_points%finish(residual(:n), error(:n))
      call of_motions%finish(residual(n + 1:), error(n + 1:))
    end associate
  end subroutine find_residual

  !> Upper bounds of the sums of the magnitudes of the terms of each equation, (n + m).
  subroutine find_terms(contact, force, gap, terms)
    type(scaled_contact), intent(in) :: contact
    real(dp), intent(in), contiguous :: force(:), gap(:)
    real(dp), intent(out), contiguous :: terms(:)
    real(dp) :: rigid(contact%points)

    associate (n => contact%points)
      call absolute_product(contact%matrix, abs(force), terms(:n))
      call absolute_product(contact%modes, abs(contact%motion), rigid)
      terms(:n) = raised(terms(:n) + rigid + abs(gap) + abs(contact%gap) + abs(contact%diagonal_rest*force), 6)
      call absolute_sums(contact%modes, abs(force), terms(n + 1:))
      terms(n + 1:) = raised(terms(n + 1:) + abs(contact%resultant) + contact%stiffness*abs(contact%motion), 5)
    end associate
  end subroutine find_terms

  !> Give the unknowns to points and motions.
  pure subroutine spread(enclosure, middle, radius)
    class(set_enclosure), intent(inout) :: enclosure
    real(dp), intent(in) :: middle(:), radius(:)

    associate (k => size(enclosure%place))
      enclosure%force_change = 0.0_dp
      enclosure%force_radius = 0.0_dp
      enclosure%motion_change = 0.0_dp
      enclosure%motion_radius = 0.0_dp
      enclosure%force_change(enclosure%place) = middle(:k)
      enclosure%force_radius(enclosure%place) = radius(:k)
      enclosure%motion_change(enclosure%motion_place) = middle(k + 1:)
      enclosure%motion_radius(enclosure%motion_place) = radius(k + 1:)
    end associate
  end subroutine spread

  !> The gaps of the points that are not at stops.
  subroutine find_gaps(contact, residual, error, enclosure)
    type(scaled_contact), intent(in) :: contact
    real(dp), intent(in) :: residual(:), error(:)
    type(set_enclosure), intent(inout) :: enclosure

    call add_columns(contact, enclosure%force_change, enclosure%motion_change, enclosure%force_radius, &
                     enclosure%motion_radius, enclosure%gap_change, enclosure%gap_radius)
    enclosure%gap_change = enclosure%gap_change - residual
    enclosure%gap_radius = raised(enclosure%gap_radius + error + UNIT_ROUNDOFF*abs(enclosure%gap_change), 4)
    enclosure%gap_change(enclosure%place) = 0.0_dp
    enclosure%gap_radius(enclosure%place) = 0.0_dp
  end subroutine find_gaps

  !> `displacement` (n) = A f - R q, and its `radius`, for f and q within their radii of `force` (n) and `motion` (m).
  subroutine add_columns(contact, force, motion, force_radius, motion_radius, displacement, radius)
    type(scaled_contact), intent(in) :: contact
    real(dp), intent(in) :: force(:), motion(:), force_radius(:), motion_radius(:)
    real(dp), intent(out), contiguous :: displacement(:), radius(:)
    real(dp) :: rigid(size(force)), rounding
    integer :: m, n

    n = size(force)
    m = size(motion)
    rounding = gamma_bound(n + m + 6)
    displacement = 0.0_dp
    call dgemv('N', n, n, 1.0_dp, contact%matrix, n, force, 1, 0.0_dp, displacement, 1)
    if (m > 0) call dgemv('N', n, m, -1.0_dp, contact%modes, n, motion, 1, 1.0_dp, displacement, 1)
    call absolute_product(contact%matrix, raised(force_radius + rounding*abs(force), 2), radius)
    call absolute_product(contact%modes, raised(motion_radius + rounding*abs(motion), 2), rigid)
    radius = raised(radius + rigid, 2)
  end subroutine add_columns

  !> The range of the force of point `k`, (2).
  pure function force_range(self, k) result(range)
    class(set_enclosure), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: range(2)

    range = outward(self%force(k), self%force_change(k), self%force_radius(k))
  end function force_range

  !> The range of the gap of point `k`, (2).
  pure function gap_range(self, k) result(range)
    class(set_enclosure), intent(in) :: self
    integer, intent(in) :: k
    real(dp) :: range(2)

    range = outward(self%gap(k), self%gap_change(k), self%gap_radius(k))
  end function gap_range

  !> All numbers within `radius` of base + change.
  pure function outward(base, change, radius) result(range)
    real(dp), intent(in) :: base, change, radius
    real(dp) :: range(2)
    real(dp) :: around, centre

    centre = base + change
    around = raised(radius + 4.0_dp*UNIT_ROUNDOFF*(abs(centre) + radius), 4)
    range = [centre - around, centre + around]
  end function outward

end module fuge_set_enclosure
