!> Rigid motions that the contact does not resist: they are not unique, though the forces are.
module fuge_unresisted_motions
  use fuge_canonical_problem, only: canonical_problem
  use fuge_contact_solution, only: contact_solution
  use fuge_contact_states, only: is_at_stop, FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER, FUGE_OPEN
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_number_text, only: index_text
  use fuge_pivoted_qr, only: orthogonal_complement
  use fuge_point_space, only: point_space
  use fuge_shared_columns, only: gather_spanning_rows
  use fuge_status, only: fuge_info, report, require_memory, FUGE_WARN_NOT_UNIQUE, FUGE_ERR_NO_EQUILIBRIUM
  implicit none
  private

  public :: find_unresisted_motion, find_unresisted_basis, is_resisted, mark_loaded, refuse_unresisted, &
    report_unresisted_motion, without_unresisted

  !> Rows of the modes that differ by less than this fraction count as one.
  real(dp), parameter :: DEPENDENT = 1.0e-12_dp
  !> Where each mode, less its components in those before, keeps this fraction of the longest one on the resisting
  !> points, these resist all motions: its square is far from the rounding of inner products.
  real(dp), parameter :: CLEARLY_INDEPENDENT = 1.0e-3_dp
  !> A force below this fraction of the loads that it may carry is rounding.
  real(dp), parameter :: NO_FORCE = 1.0e-14_dp
  !> Of many forces that are at their limits the last one carries what the sum of the others leaves of the load, with
  !> about this many units in its last place, times the root of their number, of rounding.
  real(dp), parameter :: ROUNDINGS = 64.0_dp
  !> A resultant in an unresisted motion below this fraction of its terms counts as zero.
  real(dp), parameter :: NO_LOAD = 1.0e-10_dp

contains

  !> A motion (m) of the bodies that changes no force of the solution, or zero if there is none: the
  !> motion of the solution is unique then. Error: FUGE_ERR_MEMORY.
  subroutine find_unresisted_motion(canonical, solution, motion, info)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    real(dp), intent(out) :: motion(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: basis(:, :), work(:), least(:), most(:)
    logical, allocatable, dimension(:) :: loaded, resists_closing, resists_opening
    integer :: j, n, sense, stat

    motion = 0.0_dp
    n = size(solution%state)
    allocate (work(n), least(n), most(n), loaded(n), resists_closing(n), resists_opening(n), stat=stat)
    call require_memory(stat, 'the motions of', n, 'points', info)
    call canonical%space%agree(info)
    if (stat /= 0 .or. info%failed()) return
    call mark_loaded(canonical, solution, work, loaded)
    call find_unresisted_basis(canonical%modes, loaded, basis, canonical%space)
    if (size(basis, 2) < 1) return
    call find_resistance(canonical, solution, loaded, work, resists_closing, resists_opening)
    least = merge(-huge(least), 0.0_dp, resists_opening)
    most = merge(huge(most), 0.0_dp, resists_closing)
    do j = 1, size(basis, 2)
      do sense = 1, -1, -2
        call find_equilibrium(canonical%modes, sense*basis(:, j), least, most, work, motion, sharing=canonical%space)
        if (any(abs(motion) > 0.0_dp)) return
      end do
    end do
  end subroutine find_unresisted_motion

  !> The senses in which points (n) resist a motion: `loaded` ones in both; one that touches without force, or whose
  !> force is at its limit, in one only. `scale` (n) of the forces.
  subroutine find_resistance(canonical, solution, loaded, scale, resists_closing, resists_opening)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    logical, intent(in) :: loaded(:)
    real(dp), intent(in) :: scale(:)
    logical, intent(out) :: resists_closing(:), resists_opening(:)
    real(dp), dimension(size(loaded)) :: least, most
    real(dp) :: noise
    integer :: k

    call canonical%force_range(solution%state, least, most)
    noise = no_room(canonical)
    do k = 1, size(loaded)
      associate (state => solution%state(k), force => solution%force(k), gap => solution%gap(k))
        if (canonical%excluded(k)) then
          resists_closing(k) = .false.
          resists_opening(k) = .false.
        else if (is_at_stop(state)) then
          resists_closing(k) = loaded(k) .or. most(k) - force > noise*scale(k)
          resists_opening(k) = loaded(k) .or. force - least(k) > noise*scale(k)
        else
          resists_closing(k) = (state == FUGE_OPEN .and. gap <= 0.0_dp .and. canonical%pushes(k)) &
                               .or. (state == FUGE_LIMITED_UPPER .and. gap <= canonical%upper(k))
          resists_opening(k) = (state == FUGE_OPEN .and. gap >= canonical%upper(k)) &
                               .or. (state == FUGE_LIMITED_LOWER .and. gap >= 0.0_dp)
        end if
      end associate
    end do
  end subroutine find_resistance

  !> Warn of a motion that the contact does not resist, by the mode that dominates it. An earlier warning in `info` is
  !> that of forces that are not unique. Error: FUGE_ERR_MEMORY.
  subroutine report_unresisted_motion(canonical, solution, info)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: forces
    real(dp) :: motion(size(canonical%load))

    if (size(motion) < 1) return
    forces = 'the forces are unique'
    if (info%status == FUGE_WARN_NOT_UNIQUE) forces = 'nor are the forces unique, because alpha is singular there'
    call find_unresisted_motion(canonical, solution, motion, info)
    if (info%failed() .or. .not. any(abs(motion) > 0.0_dp)) return
    call report(info, FUGE_WARN_NOT_UNIQUE, 'the contact does not resist motion ' &
                //index_text(canonical%dominant_mode(motion)) &
                //': its value, and the gaps that it moves, are one of many possible; '//forces)
  end subroutine report_unresisted_motion

  !> Points that are tied, or that carry more force than rounding makes, are `loaded` (n); `scale` (n) is work space.
  subroutine mark_loaded(canonical, solution, scale, loaded)
    type(canonical_problem), intent(in) :: canonical
    type(contact_solution), intent(in) :: solution
    real(dp), intent(out) :: scale(:)
    logical, intent(out) :: loaded(:)
    real(dp), allocatable :: least(:), most(:)
    real(dp) :: noise
    integer :: j

    scale = 0.0_dp
    do j = 1, size(canonical%load)
      scale = max(scale, abs(canonical%modes(:, j)*canonical%load(j)))
    end do
    ! Without a load of its own a body may be squeezed between stops; the loads may also nearly cancel at a point.
    if (canonical%has_bodies()) then
      scale = max(scale, canonical%force_scale(solution%force))
    else
      scale = max(scale, canonical%space%largest(maxval(abs(solution%force))))
    end if
    loaded = is_at_stop(solution%state) .and. (abs(solution%force) > NO_FORCE*scale &
                                               .or. .not. canonical%upper > 0.0_dp)
    if (.not. canonical%has_limits()) return
    allocate (least(size(loaded)), most(size(loaded)))
    call canonical%force_range(solution%state, least, most)
    noise = no_room(canonical)
    loaded = loaded .and. solution%force - least > noise*scale .and. most - solution%force > noise*scale
  end subroutine mark_loaded

  !> A force nearer to its limit than this fraction of its scale may be there.
  function no_room(canonical) result(fraction)
    type(canonical_problem), intent(in) :: canonical
    real(dp) :: fraction

    fraction = sqrt(real(canonical%space%total_count(size(canonical%gap)), dp))
    fraction = max(NO_FORCE, ROUNDINGS*epsilon(fraction)*fraction)
  end function no_room

  !> An orthonormal basis of the motions q with R q = 0 at the points marked in `resists` (n).
  !>
  !> `modes` R (n, m) with columns of about the same size; `basis` (m, number of such motions). Where ranks, `sharing`,
  !> share the points, the arguments are those of this rank, and all ranks call it.
  subroutine find_unresisted_basis(modes, resists, basis, sharing)
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: resists(:)
    real(dp), allocatable, intent(out) :: basis(:, :)
    type(point_space), intent(in), optional :: sharing
    type(point_space) :: space
    real(dp), allocatable :: rows(:, :), spanning(:, :)
    integer :: m, status

    if (present(sharing)) space = sharing
    m = size(modes, 2)
    if (are_clearly_resisted(modes, resists, space)) then
      allocate (basis(m, 0))
      return
    end if
    allocate (rows(m, count(resists)), spanning(m, m*space%members()), stat=status)
    if (space%everywhere(status == 0)) then
      call pack_rows(modes, resists, rows)
      if (space%is_alone()) then
        call orthogonal_complement(rows, DEPENDENT, basis, status)
        return
      end if
      call gather_spanning_rows(space, rows, spanning, status)
      if (status == 0) then
        call orthogonal_complement(spanning, DEPENDENT, basis, status)
        return
      end if
    end if
    ! Without memory no motion counts as unresisted.
    allocate (basis(m, 0))
  end subroutine find_unresisted_basis

  !> Are the modes so far from dependent at the points marked in `resists` (n) that their inner products there tell it?
  !> That takes one pass over large arrays. False tells nothing.
  function are_clearly_resisted(modes, resists, space) result(resisted)
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: resists(:)
    type(point_space), intent(in) :: space
    logical :: resisted
    real(dp) :: inner(size(modes, 2), size(modes, 2)), products(size(inner)), least
    integer :: j, k

    inner = 0.0_dp
    do k = 1, size(resists)
      if (.not. resists(k)) cycle
      do j = 1, size(modes, 2)
        inner(:, j) = inner(:, j) + modes(k, :)*modes(k, j)
      end do
    end do
    products = reshape(inner, shape(products))
    call space%add(products)
    inner = reshape(products, shape(inner))
    least = CLEARLY_INDEPENDENT**2*maxval(products)
    resisted = .true.
    ! Cholesky's elimination leaves the squares of the remaining lengths on the diagonal.
    do j = 1, size(inner, 2)
      resisted = resisted .and. inner(j, j) > least
      if (.not. resisted) return
      do k = j + 1, size(inner, 2)
        inner(j + 1:, k) = inner(j + 1:, k) - inner(j + 1:, j)*(inner(j, k)/inner(j, j))
      end do
    end do
  end function are_clearly_resisted

  !> The rows of the `modes` (n, m) at the points `marked` (n), as the columns of `rows`.
  pure subroutine pack_rows(modes, marked, rows)
    real(dp), intent(in) :: modes(:, :)
    logical, intent(in) :: marked(:)
    real(dp), intent(out) :: rows(:, :)
    integer :: column, k

    column = 0
    do k = 1, size(marked)
      if (.not. marked(k)) cycle
      column = column + 1
      rows(:, column) = modes(k, :)
    end do
  end subroutine pack_rows

  !> The motion (m) less its component in the `basis` of the unresisted ones.
  pure function without_unresisted(motion, basis) result(rest)
    real(dp), intent(in) :: motion(:), basis(:, :)
    real(dp) :: rest(size(motion))
    integer :: j

    rest = motion
    do j = 1, size(basis, 2)
      rest = rest - dot_product(basis(:, j), motion)*basis(:, j)
    end do
  end function without_unresisted

  !> Refuse changes `load` (m) of the resultants in a motion of the `basis` of the unresisted ones
  !> (FUGE_ERR_NO_EQUILIBRIUM).
  pure subroutine refuse_unresisted(load, basis, info)
    real(dp), intent(in) :: load(:), basis(:, :)
    type(fuge_info), intent(inout) :: info

    if (is_resisted(load, basis)) return
    call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'the contact does not resist the motions that these resultants act ' &
                //'in: they would turn the body over, whatever the size of the change')
  end subroutine refuse_unresisted

  !> Do the resultants `load` (m) act in none of the unresisted motions, of which `basis` is an orthonormal basis?
  !>
  !> Each motion is judged by its own terms, because another body may carry far larger resultants, whose rounding does
  !> not count.
  pure function is_resisted(load, basis) result(resisted)
    real(dp), intent(in) :: load(:), basis(:, :)
    logical :: resisted
    real(dp) :: rounding
    integer :: j

    resisted = .true.
    if (size(basis, 2) < 1) return
    rounding = 64.0_dp*epsilon(rounding)*maxval(abs(load))
    do j = 1, size(basis, 2)
      resisted = resisted .and. abs(dot_product(basis(:, j), load)) <= max(rounding, &
                                                                           NO_LOAD*sum(abs(basis(:, j)*load)))
    end do
  end function is_resisted

end module fuge_unresisted_motions
