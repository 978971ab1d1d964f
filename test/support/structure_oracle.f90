!> Forces of structures with one-way rows in quadruple precision, from their stiffness matrix. Of the library only the
!> kinds are used, and nothing of condensation.
!>
!> Gaussian elimination of the displacements leaves a linear complementarity problem in the forces of the rows and the
!> motions of a mechanism, whose matrix is positive semidefinite. Lemke's method solves it, with the lexicographic rule
!> against ties (R. W. Cottle, J.-S. Pang, R. E. Stone, The Linear Complementarity Problem, 1992, sections 4.4, 4.9), or
!> finds that no forces carry the load.
module structure_oracle
  use, intrinsic :: iso_fortran_env, only: qp => real128
  use fuge_kinds, only: dp
  use one_way_structures, only: one_way_structure
  implicit none
  private

  public :: know_structure

  !> Pivots of the stiffness below this fraction of its diagonal are those of a mechanism: its entries have the rounding
  !> of double precision.
  real(qp), parameter :: NO_STIFFNESS = 1.0e-11_qp
  !> In quadruple precision entries and differences below this fraction are rounding.
  real(qp), parameter :: ROUNDING = 1.0e-22_qp

  !> What is known of a structure.
  type, public :: known_structure
    !> Are there forces in equilibrium with the load?
    logical :: carried = .false.
    !> Motions that the members leave.
    integer :: motions = 0
    !> Forces and gaps of the rows, (n), and displacements, (nd).
    real(qp), allocatable :: force(:), gap(:), displacement(:)
    !> The largest of what is left of K u = p + H f and of the distances from the law of a row, each relative.
    real(qp) :: violation = 0.0_qp
  end type known_structure

  !> The rows without the displacements: gaps are g + A f - R q, R^T f = w; and how to find the displacements.
  type :: reduced_rows
    real(qp), allocatable :: a(:, :), r(:, :), g(:), w(:)
    !> Rows of the elimination; its pivots, in their order, and the other degrees of freedom.
    real(qp), allocatable :: eliminated(:, :)
    integer, allocatable :: pivots(:), others(:)
  end type reduced_rows

  !> Find z >= 0, M z + q >= 0, z.(M z + q) = 0. `point` and `sign` say which force a variable is.
  type :: complementarity
    real(qp), allocatable :: m(:, :), q(:), z(:)
    integer, allocatable :: point(:), sign(:)
    logical :: solved = .false.
  end type complementarity

contains

  subroutine know_structure(structure, known)
    type(one_way_structure), intent(in) :: structure
    type(known_structure), intent(out) :: known
    type(reduced_rows) :: reduced
    type(complementarity) :: problem
    real(qp), allocatable :: unit(:), turn(:), motion(:)
    integer :: k, m

    call reduce(structure, reduced)
    known%motions = size(reduced%w)
    m = known%motions
    call choose_units(structure, reduced, unit, turn)
    call pose(structure, reduced, unit, turn, problem)
    call solve_by_lemke(problem)
    known%carried = problem%solved
    if (.not. problem%solved) return
    allocate (known%force(structure%rows()))
    known%force = 0.0_qp
    do k = 1, size(problem%point)
      if (problem%point(k) < 1) cycle
      associate (f => known%force(problem%point(k)))
        f = f + problem%sign(k)*problem%z(k)*unit(problem%point(k))
      end associate
    end do
    allocate (motion(m))
    if (m > 0) motion = turn*(problem%z(size(problem%z) - m:size(problem%z) - 1) - problem%z(size(problem%z)))
    call find_displacement(structure, reduced, known%force, motion, known%displacement)
    call check(structure, known)
  end subroutine know_structure

  !> Eliminate the displacements from the rows K u - H f - p = 0 and -H^T u - g = -c.
  pure subroutine reduce(structure, reduced)
    type(one_way_structure), intent(in) :: structure
    type(reduced_rows), intent(out) :: reduced
    real(qp) :: work(structure%degrees() + structure%rows(), structure%degrees() + structure%rows() + 1)
    real(qp) :: factor(size(work, 1)), left(structure%degrees())
    logical :: done(structure%degrees())
    integer :: active(size(work, 1)), i, j, k, n, nd, number, pivot

    n = structure%rows()
    nd = structure%degrees()
    work = 0.0_qp
    work(:nd, :nd) = real(structure%stiffness, qp)
    work(:nd, nd + n + 1) = -real(structure%load, qp)
    work(nd + 1:, nd + n + 1) = -real(structure%gap, qp)
    do i = 1, n
      do k = 1, size(structure%dof, 1)
        j = structure%dof(k, i)
        if (j > 0) work(j, nd + i) = work(j, nd + i) - real(structure%normal(k, i), qp)
      end do
      work(nd + i, :nd) = work(:nd, nd + i)
    end do
    done = .false.
    allocate (reduced%pivots(0))
    do
      left = [(work(k, k)/real(structure%stiffness(k, k), qp), k=1, nd)]
      pivot = maxloc(left, dim=1, mask=.not. done)
      if (pivot < 1) exit
      if (.not. left(pivot) > NO_STIFFNESS) exit
      done(pivot) = .true.
      reduced%pivots = [reduced%pivots, pivot]
      number = 0
      do i = 1, nd + n
        if (i <= nd) then
          if (done(i)) cycle
        end if
        if (.not. abs(work(i, pivot)) > 0.0_qp) cycle
        number = number + 1
        active(number) = i
        factor(number) = work(i, pivot)/work(pivot, pivot)
      end do
      do j = 1, nd + n + 1
        if (j <= nd) then
          if (done(j)) cycle
        end if
        if (.not. abs(work(pivot, j)) > 0.0_qp) cycle
        do k = 1, number
          work(active(k), j) = work(active(k), j) - factor(k)*work(pivot, j)
        end do
      end do
    end do
    reduced%others = pack([(k, k=1, nd)], .not. done)
    reduced%a = -work(nd + 1:, nd + 1:nd + n)
    reduced%r = work(nd + 1:, reduced%others)
    reduced%g = -work(nd + 1:, nd + n + 1)
    reduced%w = -work(reduced%others, nd + n + 1)
    reduced%eliminated = work(:nd, :)
  end subroutine reduce

  !> Units of the forces of the rows, in which the diagonal of A + D is 1, and of the motions.
  pure subroutine choose_units(structure, reduced, unit, turn)
    type(one_way_structure), intent(in) :: structure
    type(reduced_rows), intent(in) :: reduced
    real(qp), allocatable, intent(out) :: unit(:), turn(:)
    real(qp) :: largest
    integer :: j, k

    allocate (turn(size(reduced%w)))
    unit = [(max(reduced%a(k, k), 0.0_qp) + real(structure%compliance(k), qp), k=1, structure%rows())]
    largest = maxval(unit)
    if (.not. largest > 0.0_qp) largest = 1.0_qp
    unit = 1.0_qp/sqrt(merge(unit, largest, unit > NO_STIFFNESS*largest))
    do j = 1, size(turn)
      turn(j) = 1.0_qp/max(maxval(abs(reduced%r(:, j)*unit)), tiny(1.0_qp))
    end do
  end subroutine choose_units

  !> The complementarity problem: forces of the first and of the second stop with their gaps, what is beyond a limit
  !> with what is left to it, and motions, with equilibrium, as differences q_j - q_0.
  pure subroutine pose(structure, reduced, unit, turn, problem)
    type(one_way_structure), intent(in) :: structure
    type(reduced_rows), intent(in) :: reduced
    real(qp), intent(in) :: unit(:), turn(:)
    type(complementarity), intent(out) :: problem
    real(qp) :: gaps(structure%rows(), structure%rows()), modes(structure%rows(), size(turn))
    integer :: i, k, last, m, n
    integer, allocatable :: forces(:)

    n = structure%rows()
    m = size(turn)
    gaps = reduced%a
    do k = 1, n
      gaps(k, k) = gaps(k, k) + real(structure%compliance(k), qp)
    end do
    do k = 1, n
      gaps(:, k) = gaps(:, k)*unit*unit(k)
    end do
    do k = 1, m
      modes(:, k) = reduced%r(:, k)*unit*turn(k)
    end do
    problem%point = [(k, k=1, n), pack([(k, k=1, n)], structure%play <= huge(1.0_dp))]
    last = size(problem%point)
    problem%sign = [(merge(1, -1, k <= n), k=1, last)]
    ! A limit for each of these forces, 0 without.
    forces = [(merge(k, 0, limit_of(structure, problem, k) <= huge(1.0_qp)), k=1, last)]
    forces = pack(forces, forces > 0)
    k = last + size(forces) + merge(m + 1, 0, m > 0)
    allocate (problem%m(k, k), problem%q(k), problem%z(k))
    problem%m = 0.0_qp
    problem%q = 0.0_qp
    do k = 1, last
      do i = 1, last
        problem%m(i, k) = problem%sign(i)*gaps(problem%point(i), problem%point(k))*problem%sign(k)
      end do
      associate (point => problem%point(k))
        problem%q(k) = problem%sign(k)*reduced%g(point)*unit(point)
        if (problem%sign(k) < 0) problem%q(k) = problem%q(k) + real(structure%play(point), qp)*unit(point)
      end associate
    end do
    do k = 1, size(forces)
      problem%m(forces(k), last + k) = 1.0_qp
      problem%m(last + k, forces(k)) = -1.0_qp
      problem%q(last + k) = limit_of(structure, problem, forces(k))/unit(problem%point(forces(k)))
    end do
    i = last + size(forces)
    do k = 1, m
      problem%m(i + k, :last) = problem%sign*modes(problem%point, k)
      problem%m(i + m + 1, :last) = problem%m(i + m + 1, :last) - problem%m(i + k, :last)
      problem%q(i + k) = -reduced%w(k)*turn(k)
    end do
    if (m > 0) then
      problem%q(i + m + 1) = -sum(problem%q(i + 1:i + m))
      problem%m(:last, i + 1:) = -transpose(problem%m(i + 1:, :last))
    end if
    problem%point = [problem%point, [(0, k=last + 1, size(problem%q))]]
    problem%sign = [problem%sign, [(0, k=last + 1, size(problem%q))]]
  end subroutine pose

  !> The limit of a force.
  pure function limit_of(structure, problem, k) result(limit)
    type(one_way_structure), intent(in) :: structure
    type(complementarity), intent(in) :: problem
    integer, intent(in) :: k
    real(qp) :: limit

    limit = real(structure%limit(problem%point(k)), qp)
    if (problem%sign(k) < 0) limit = real(structure%limit_upper(problem%point(k)), qp)
  end function limit_of

  !> Lemke's method: w - M z - z_0 = q in a tableau of the columns w, z, z_0 and q.
  pure subroutine solve_by_lemke(problem)
    type(complementarity), intent(inout) :: problem
    real(qp) :: tableau(size(problem%q), 2*size(problem%q) + 2), size_of
    integer :: basis(size(problem%q)), entering, k, leaving, n, row, step

    n = size(problem%q)
    problem%z = 0.0_qp
    problem%solved = minval(problem%q) >= 0.0_qp
    if (problem%solved) return
    size_of = maxval(abs(problem%q))
    tableau(:, :n) = 0.0_qp
    do k = 1, n
      tableau(k, k) = 1.0_qp
      basis(k) = k
    end do
    tableau(:, n + 1:2*n) = -problem%m
    tableau(:, 2*n + 1) = -1.0_qp
    tableau(:, 2*n + 2) = problem%q/size_of
    entering = 2*n + 1
    row = lowest_row(tableau)
    do step = 1, 100*(n + 10)
      leaving = basis(row)
      call exchange(row, entering, tableau)
      basis(row) = entering
      problem%solved = leaving == 2*n + 1
      if (problem%solved) exit
      entering = leaving + merge(n, -n, leaving <= n)
      row = first_row(basis, entering, tableau)
      if (row < 1) return
    end do
    do k = 1, n
      if (basis(k) > n .and. basis(k) <= 2*n) problem%z(basis(k) - n) = max(tableau(k, 2*n + 2), 0.0_qp)*size_of
    end do
  end subroutine solve_by_lemke

  !> The row with the lowest right-hand side; of equal ones the last, the lexicographic order of the unit matrix.
  pure integer function lowest_row(tableau) result(row)
    real(qp), intent(in) :: tableau(:, :)

    row = minloc(tableau(:, size(tableau, 2)), dim=1, back=.true.)
  end function lowest_row

  !> The row that limits the entering column, that of z_0 among equals; 0 if none does.
  pure integer function first_row(basis, entering, tableau) result(row)
    integer, intent(in) :: basis(:), entering
    real(qp), intent(in) :: tableau(:, :)
    real(qp) :: least, largest, values(size(basis))
    logical :: tied(size(basis))
    integer :: j

    row = 0
    associate (column => tableau(:, entering), right => tableau(:, size(tableau, 2)))
      largest = maxval(abs(column))
      tied = column > ROUNDING*max(largest, 1.0_qp)
      if (.not. any(tied)) return
      values = huge(1.0_qp)
      where (tied) values = right/column
      do j = 0, size(basis)
        least = minval(values, mask=tied)
        tied = tied .and. values <= least + ROUNDING*max(abs(least), 1.0_qp)
        if (j == 0) then
          row = findloc(tied .and. basis == 2*size(basis) + 1, .true., dim=1)
          if (row > 0) return
        end if
        if (count(tied) == 1 .or. j == size(basis)) exit
        where (tied) values = tableau(:, j + 1)/column
      end do
    end associate
    row = findloc(tied, .true., dim=1)
  end function first_row

  !> Pivot.
  pure subroutine exchange(row, entering, tableau)
    integer, intent(in) :: row, entering
    real(qp), intent(inout) :: tableau(:, :)
    real(qp) :: column(size(tableau, 1))
    integer :: j

    column = tableau(:, entering)
    column(row) = column(row) - 1.0_qp
    do j = 1, size(tableau, 2)
      if (.not. abs(tableau(row, j)) > 0.0_qp .or. j == entering) cycle
      tableau(:, j) = tableau(:, j) - column*(tableau(row, j)/tableau(row, entering))
    end do
    tableau(:, entering) = 0.0_qp
    tableau(row, entering) = 1.0_qp
  end subroutine exchange

  !> Displacements from forces and motions.
  pure subroutine find_displacement(structure, reduced, force, motion, u)
    type(one_way_structure), intent(in) :: structure
    type(reduced_rows), intent(in) :: reduced
    real(qp), intent(in) :: force(:), motion(:)
    real(qp), allocatable, intent(out) :: u(:)
    real(qp) :: left
    integer :: i, j, k, nd

    nd = structure%degrees()
    allocate (u(nd))
    u = 0.0_qp
    u(reduced%others) = motion
    do k = size(reduced%pivots), 1, -1
      i = reduced%pivots(k)
      associate (row => reduced%eliminated(i, :))
        left = -row(size(row)) - sum(row(nd + 1:nd + size(force))*force) - sum(row(reduced%others)*motion)
        do j = k + 1, size(reduced%pivots)
          left = left - row(reduced%pivots(j))*u(reduced%pivots(j))
        end do
        u(i) = left/row(i)
      end associate
    end do
  end subroutine find_displacement

  !> The gaps, and how far forces and displacements are from the equations and from the law.
  pure subroutine check(structure, known)
    type(one_way_structure), intent(in) :: structure
    type(known_structure), intent(inout) :: known
    real(qp) :: left(structure%degrees()), terms(structure%degrees()), length, largest
    integer :: i, k

    left = -real(structure%load, qp)
    terms = abs(left)
    do k = 1, size(left)
      left = left + real(structure%stiffness(:, k), qp)*known%displacement(k)
      terms = terms + abs(real(structure%stiffness(:, k), qp)*known%displacement(k))
    end do
    known%gap = real(structure%gap, qp)
    length = 0.0_qp
    do i = 1, structure%rows()
      do k = 1, size(structure%dof, 1)
        associate (dof => structure%dof(k, i), normal => real(structure%normal(k, i), qp))
          if (dof < 1) cycle
          left(dof) = left(dof) - normal*known%force(i)
          terms(dof) = terms(dof) + abs(normal*known%force(i))
          known%gap(i) = known%gap(i) + normal*known%displacement(dof)
          length = max(length, abs(known%gap(i)), abs(normal*known%displacement(dof)))
        end associate
      end do
      known%gap(i) = known%gap(i) + structure%compliance(i)*known%force(i)
    end do
    largest = max(maxval(abs(known%force)), ROUNDING*maxval(abs(structure%load)), real(tiny(1.0_dp), qp))
    ! Where all rows are closed and rigid, lengths are compared with those of the load.
    length = max(length, NO_STIFFNESS*maxval(abs(structure%load))/maxval(structure%stiffness), &
                 real(tiny(1.0_dp), qp))
    known%violation = maxval(abs(left))/max(maxval(terms), tiny(1.0_qp))
    do i = 1, structure%rows()
      known%violation = max(known%violation, distance_from_law(structure, i, known%force(i), known%gap(i), largest, &
                                                               length))
    end do
  end subroutine check

  !> Distance of a force and a gap, in units of `largest` and `length`, from the steps of their law.
  pure function distance_from_law(structure, i, force, gap, largest, length) result(distance)
    type(one_way_structure), intent(in) :: structure
    integer, intent(in) :: i
    real(qp), intent(in) :: force, gap, largest, length
    real(qp) :: distance
    real(qp) :: beyond, limit, play, upper

    play = real(min(structure%play(i), huge(1.0_dp)), qp)
    limit = real(min(structure%limit(i), huge(1.0_dp)), qp)
    upper = real(min(structure%limit_upper(i), huge(1.0_dp)), qp)
    ! Closed, open, limited, and the same at the upper stop.
    distance = max(abs(gap)/length, -force/largest, (force - limit)/largest)
    distance = min(distance, max(abs(force)/largest, -gap/length, (gap - play)/length))
    distance = min(distance, max(abs(force - limit)/largest, gap/length))
    beyond = gap - play
    distance = min(distance, max(abs(beyond)/length, force/largest, (-force - upper)/largest))
    distance = min(distance, max(abs(force + upper)/largest, -beyond/length))
  end function distance_from_law

end module structure_oracle
