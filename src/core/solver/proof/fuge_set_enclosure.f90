!> The solution of the equations of contact for given states of the points, enclosed.
!>
!> With the points W at stops, forces f of the others known, and e the change of the solution from what is claimed,
!>
!>     A e - R e_q = r = c - g - A f + R q      R^T e + S e_q = w - R^T f - S q
!>
!> hold in the rows of W, e = 0 elsewhere, and c changes by A e - R e_q - r in the other rows. Corrections by an
!> approximate factor make e, until what they leave of r, in sums with thirty digits, bounds the rest by the least
!> eigenvalue (`fuge_energy_bound`). So no inverse is needed, and the eigenvalue need not be known well.
module fuge_set_enclosure
  use fuge_claimed_states, only: point_claim
  use fuge_energy_bound, only: energy_bound
  use fuge_kinds, only: dp
  use fuge_lapack, only: dgemv
  use fuge_rounding_bounds, only: absolute_product, absolute_sums, gamma_bound, norm_bound, raised, LEAST, UNIT_ROUNDOFF
  use fuge_scaled_contact, only: scaled_contact
  use fuge_set_factor, only: set_factor
  use fuge_cascaded_sums, only: cascaded_sums
  implicit none
  private

  public :: add_columns, enclose_set, fill_equations

  integer, parameter :: MOST_CORRECTIONS = 8
  !> Products with corrections below this fraction of the solution are rounded.
  real(dp), parameter :: NEGLIGIBLE = 2.0_dp**(-44)
  !> Sums have room for this multiple of their first terms.
  real(dp), parameter :: ROOM = 4.0_dp
  !> A bound of this fraction of the largest unknown is as small as it need be.
  real(dp), parameter :: SMALL = 2.0_dp**(-60)

  !> The solution for the states: each number is within its radius of what is claimed and its change. All in scaled
  !> units.
  type, public :: set_enclosure
    !> Points at stops, and free motions: the unknowns, in this order.
    integer, allocatable :: place(:), motion_place(:)
    !> Is there one solution for the states? And are what the states give of forces and gaps in range?
    logical :: is_enclosed = .false., in_range = .true.
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

  !> What is added to the claimed forces and motions, (n + m, corrections), and what that leaves of the equations, (n +
  !> m), known up to `error`.
  type :: corrected_solution
    real(dp), allocatable :: correction(:, :), residual(:), error(:)
    integer :: corrections = 0
    !> The sums of the terms of the equations, their bounds when they were started, and the rounding of products that
    !> are not part of the sums.
    type(cascaded_sums) :: of_points, of_motions
    real(dp), allocatable :: most(:), rounding(:)
  end type corrected_solution

contains

  !> Enclose the solution of `contact` for the `claims` (n): is_enclosed, if the equations have one. `stat` is not 0
  !> without memory.
  subroutine enclose_set(contact, claims, enclosure, stat)
    type(scaled_contact), intent(in) :: contact
    type(point_claim), intent(in) :: claims(:)
    type(set_enclosure), intent(inout) :: enclosure
    integer, intent(out) :: stat
    type(corrected_solution) :: corrected
    type(energy_bound) :: energy
    type(set_factor) :: factor
    real(dp) :: points, motions
    integer :: k, m, n

    n = contact%points
    m = contact%motions
    allocate (corrected%residual(n + m), corrected%error(n + m), corrected%correction(n + m, MOST_CORRECTIONS), &
              corrected%most(n + m), corrected%rounding(n + m), &
              enclosure%force(n), enclosure%gap(n), enclosure%force_change(n), enclosure%force_radius(n), &
              enclosure%gap_change(n), enclosure%gap_radius(n), enclosure%motion_change(m), &
              enclosure%motion_radius(m), stat=stat)
    if (stat /= 0) return
    enclosure%place = pack([(k, k=1, n)], claims%at_stop)
    enclosure%motion_place = pack([(k, k=1, m)], contact%free)
    enclosure%in_range = contact%is_in_range(merge(0.0_dp, claims%known, claims%at_stop), &
                                             merge(claims%known, 0.0_dp, claims%at_stop))
    if (.not. enclosure%in_range) return
    enclosure%force = contact%scaled_force(merge(0.0_dp, claims%known, claims%at_stop))
    where (claims%at_stop) enclosure%force = contact%force
    enclosure%gap = contact%scaled_length(merge(claims%known, 0.0_dp, claims%at_stop))
    where (.not. claims%at_stop) enclosure%gap = contact%claimed_gap
    call energy%prepare(contact, enclosure%place, enclosure%motion_place, stat)
    if (stat == 0 .and. energy%is_held) call factor%find(contact, enclosure%place, enclosure%motion_place, stat)
    if (stat /= 0 .or. .not. factor%is_found) return
    call correct(contact, enclosure, factor, energy, corrected, points, motions, stat)
    enclosure%is_enclosed = points < huge(1.0_dp) .and. motions < huge(1.0_dp)
    if (stat == 0 .and. enclosure%is_enclosed) call take_corrections(contact, corrected, points, motions, enclosure)
  end subroutine enclose_set

  !> Correct the solution until bounds of the rest, 2-norms of `points` and `motions`, are small or no longer fall.
  subroutine correct(contact, enclosure, factor, energy, corrected, points, motions, stat)
    type(scaled_contact), intent(in) :: contact
    type(set_enclosure), intent(in) :: enclosure
    type(set_factor), intent(in) :: factor
    type(energy_bound), intent(in) :: energy
    type(corrected_solution), intent(inout) :: corrected
    real(dp), intent(out) :: points, motions
    integer, intent(out) :: stat
    integer :: unknowns(size(enclosure%place) + size(enclosure%motion_place))
    real(dp) :: before, rest(size(unknowns)), small_enough

    unknowns = [enclosure%place, contact%points + enclosure%motion_place]
    small_enough = SMALL*maxval([abs(enclosure%force), abs(contact%motion)])
    before = huge(1.0_dp)
    points = huge(1.0_dp)
    motions = huge(1.0_dp)
    call start_sums(contact, enclosure, corrected, stat)
    do
      if (stat /= 0) return
      call find_residual(contact, corrected)
      if (.not. all(abs(corrected%residual(unknowns)) <= huge(1.0_dp))) then
        points = huge(1.0_dp)
        return
      end if
      associate (k => size(enclosure%place), left => abs(corrected%residual(unknowns)) + corrected%error(unknowns))
        call energy%bound(norm_bound(raised(left(:k), 2)), norm_bound(raised(left(k + 1:), 2)), points, motions)
      end associate
      if (.not. max(points, motions) < 0.25_dp*before .or. max(points, motions) <= small_enough) return
      if (corrected%corrections == MOST_CORRECTIONS) return
      before = max(points, motions)
      rest = corrected%residual(unknowns)
      call factor%solve(rest)
      if (.not. all(abs(rest) <= huge(1.0_dp))) return
      corrected%corrections = corrected%corrections + 1
      corrected%correction(:, corrected%corrections) = 0.0_dp
      corrected%correction(unknowns, corrected%corrections) = rest
      call add_correction(contact, enclosure, corrected, stat)
    end do
  end subroutine correct

  !> The changes of forces, motions and gaps, and their radii.
  subroutine take_corrections(contact, corrected, points, motions, enclosure)
    type(scaled_contact), intent(in) :: contact
    type(corrected_solution), intent(in) :: corrected
    real(dp), intent(in) :: points, motions
    type(set_enclosure), intent(inout) :: enclosure
    real(dp) :: change(contact%points + contact%motions), radius(size(change)), rigid(contact%points)

    associate (steps => corrected%corrections, n => contact%points, m => contact%motions)
      change = sum(corrected%correction(:, :steps), dim=2)
      radius = gamma_bound(steps + 1)*sum(abs(corrected%correction(:, :steps)), dim=2)
      enclosure%force_change = change(:n)
      enclosure%motion_change = change(n + 1:)
      enclosure%force_radius = 0.0_dp
      enclosure%motion_radius = 0.0_dp
      enclosure%force_radius(enclosure%place) = points
      enclosure%motion_radius(enclosure%motion_place) = motions
      call absolute_product(contact%matrix, enclosure%force_radius, enclosure%gap_radius)
      call absolute_product(contact%modes, enclosure%motion_radius, rigid)
      enclosure%force_radius = raised(enclosure%force_radius + radius(:n), steps + 3)
      enclosure%motion_radius = raised(enclosure%motion_radius + radius(n + 1:), steps + 3)
      enclosure%gap_change = -corrected%residual(:n)
      enclosure%gap_radius = raised(enclosure%gap_radius + rigid + corrected%error(:n), 4)
      enclosure%gap_change(enclosure%place) = 0.0_dp
      enclosure%gap_radius(enclosure%place) = 0.0_dp
    end associate
  end subroutine take_corrections

  !> The equations: A, -R above R^T, S.
  pure subroutine fill_equations(contact, place, motion_place, matrix)
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
  end subroutine fill_equations

  !> Start the sums of the equations with all corrections that there are. `stat` is not 0 without memory.
  subroutine start_sums(contact, enclosure, corrected, stat)
    type(scaled_contact), intent(in) :: contact
    type(set_enclosure), intent(in) :: enclosure
    type(corrected_solution), intent(inout) :: corrected
    integer, intent(out) :: stat
    integer :: j

    call find_terms(contact, enclosure, corrected, corrected%most)
    corrected%most = ROOM*corrected%most
    corrected%rounding = 0.0_dp
    associate (n => contact%points)
      call corrected%of_points%start(corrected%most(:n), stat)
      if (stat == 0) call corrected%of_motions%start(corrected%most(n + 1:), stat)
      if (stat /= 0) return
      call corrected%of_points%add(enclosure%gap)
      call corrected%of_points%add(-contact%gap)
      call corrected%of_motions%add(contact%resultant)
      call subtract(contact, enclosure%force, contact%motion, corrected%of_points, corrected%of_motions)
      do j = 1, corrected%corrections
        call subtract(contact, corrected%correction(:n, j), corrected%correction(n + 1:, j), corrected%of_points, &
                      corrected%of_motions)
      end do
    end associate
  end subroutine start_sums

  !> Add the last correction to the sums: small ones by rounded products, those for which there is no room by starting
  !> anew. `stat` is not 0 without memory.
  subroutine add_correction(contact, enclosure, corrected, stat)
    type(scaled_contact), intent(in) :: contact
    type(set_enclosure), intent(in) :: enclosure
    type(corrected_solution), intent(inout) :: corrected
    integer, intent(out) :: stat
    real(dp) :: image(contact%points + contact%motions), largest, none(size(image)), radius(size(image)), &
                terms(size(image))
    integer :: j

    stat = 0
    call find_terms(contact, enclosure, corrected, terms)
    if (any(2.0_dp*terms > corrected%most)) then
      call start_sums(contact, enclosure, corrected, stat)
      return
    end if
    associate (n => contact%points, last => corrected%correction(:, corrected%corrections))
      largest = max(maxval(abs(enclosure%force)), maxval(abs([contact%motion, 0.0_dp])))
      if (maxval(abs(last)) > NEGLIGIBLE*largest) then
        call subtract(contact, last(:n), last(n + 1:), corrected%of_points, corrected%of_motions)
        return
      end if
      none = 0.0_dp
      call add_columns(contact, last(:n), last(n + 1:), none(:n), none(n + 1:), image(:n), radius(:n))
      do j = 1, contact%motions
        image(n + j) = dot_product(contact%modes(:, j), last(:n)) + contact%stiffness(j)*last(n + j)
        radius(n + j) = gamma_bound(n + 4)*(dot_product(abs(contact%modes(:, j)), abs(last(:n))) &
                                            + contact%stiffness(j)*abs(last(n + j)))
      end do
      call corrected%of_points%add(-image(:n))
      call corrected%of_motions%add(-image(n + 1:))
      ! What the rounding of A + D took counts, too.
      radius(:n) = radius(:n) + abs(contact%diagonal_rest*last(:n))
      corrected%rounding = raised(corrected%rounding + raised(radius, n + 8), 2)
    end associate
  end subroutine add_correction

  !> What the corrected solution leaves of the equations.
  pure subroutine find_residual(contact, corrected)
    type(scaled_contact), intent(in) :: contact
    type(corrected_solution), intent(inout) :: corrected

    associate (n => contact%points)
      call corrected%of_points%finish(corrected%residual(:n), corrected%error(:n))
      call corrected%of_motions%finish(corrected%residual(n + 1:), corrected%error(n + 1:))
      corrected%error = raised(corrected%error + corrected%rounding, 2)
    end associate
  end subroutine find_residual

  !> Subtract A f - R q and R^T f + S q.
  pure subroutine subtract(contact, force, motion, of_points, of_motions)
    type(scaled_contact), intent(in) :: contact
    real(dp), intent(in) :: force(:), motion(:)
    type(cascaded_sums), intent(inout) :: of_points, of_motions
    integer :: j

    do j = 1, contact%points
      if (.not. abs(force(j)) > 0.0_dp) cycle
      call of_points%add_products(contact%matrix(:, j), -force(j))
      if (abs(contact%diagonal_rest(j)) > 0.0_dp) call of_points%add_dot(j, contact%diagonal_rest(j:j), -force(j:j))
    end do
    do j = 1, contact%motions
      call of_points%add_products(contact%modes(:, j), motion(j))
      call of_motions%add_dot(j, contact%modes(:, j), -force)
      call of_motions%add_dot(j, contact%stiffness(j:j), -motion(j:j))
    end do
  end subroutine subtract

  !> Upper bounds of the sums of the magnitudes of the terms of each equation, (n + m).
  subroutine find_terms(contact, enclosure, corrected, terms)
    type(scaled_contact), intent(in) :: contact
    type(set_enclosure), intent(in) :: enclosure
    type(corrected_solution), intent(in) :: corrected
    real(dp), intent(out), contiguous :: terms(:)
    real(dp) :: force(contact%points), motion(contact%motions), rigid(contact%points)

    associate (n => contact%points, steps => corrected%corrections)
      force = raised(abs(enclosure%force) + sum(abs(corrected%correction(:n, :steps)), dim=2), steps + 1)
      motion = raised(abs(contact%motion) + sum(abs(corrected%correction(n + 1:, :steps)), dim=2), steps + 1)
      call absolute_product(contact%matrix, force, terms(:n))
      call absolute_product(contact%modes, motion, rigid)
      terms(:n) = raised(terms(:n) + rigid + abs(enclosure%gap) + abs(contact%gap) &
                         + abs(contact%diagonal_rest*force), 6)
      call absolute_sums(contact%modes, force, terms(n + 1:))
      terms(n + 1:) = raised(terms(n + 1:) + abs(contact%resultant) + contact%stiffness*motion, 5)
      ! A sum without terms needs a bias all the same.
      terms = terms + LEAST
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
