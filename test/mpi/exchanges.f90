! The exchange of points of a line, its segments, its groups of cells, and what extends the contact set of an area do
! not depend on how ranks share the line or the rows.
program exchanges
  use fuge_kinds, only: dp, sp
  use fuge_level_groups, only: add_to_groups, compute_group_means, subtract_from_groups, sum_over_groups, GROUP
  use fuge_mpi, only: fuge_mpi_halfplane_operator
  use fuge_set_exchange, only: exchange_extrapolated
  use fuge_set_extension, only: set_extension
  use fuge_shared_exchange, only: count_segments, exchange_in_line
  use fuge_shared_rows, only: shared_rows
  use fuge_status, only: fuge_info, FUGE_DONE
  use mpi_f08
  use rank_checks, only: begin_checks, end_checks, expect
  implicit none

  integer, parameter :: TRIALS = 1500, AREAS = 60

  call begin_checks()
  call run()
  call end_checks()

contains

  subroutine run()
    type(fuge_mpi_halfplane_operator) :: line
    type(shared_rows) :: rows
    type(fuge_info) :: info
    real(dp) :: random(3)
    integer :: n, seed_size, trial

    call random_seed(size=seed_size)
    call random_seed(put=spread(7919, 1, seed_size))
    call line%set(64, 1.0_dp, 1.0_dp, MPI_COMM_WORLD, info)
    call expect(info%status == FUGE_DONE, trim(info%message))
    rows%point_space = line%ranks()
    if (rows%is_alone()) return
    do trial = 1, TRIALS
      call random_number(random)
      n = 1 + int(80*random(1))
      call share(n, rows)
      call compare_sets(n, 1 + int(12*random(2)), 0.2_dp + 0.8_dp*random(3), rows)
      if (modulo(trial, 10) == 0) call compare_groups(8*n, rows)
    end do
    ! Of some grids ranks share two coarser ones, of others one or none.
    do trial = 1, AREAS
      call random_number(random)
      call compare_extensions([32 + int(600*random(1)), 32 + int(600*random(2))], random(3), rows)
    end do
  end subroutine run

  ! Values of a random set extended to the cells of an area and collected from there, by one process and by ranks.
  subroutine compare_extensions(cells, density, rows)
    integer, intent(in) :: cells(2)
    real(dp), intent(in) :: density
    type(shared_rows), intent(inout) :: rows
    type(set_extension) :: alone, shared
    type(shared_rows) :: all_rows
    type(fuge_info) :: info
    real(dp), allocatable :: random(:)
    real(sp), allocatable :: here(:), values(:)
    logical, allocatable :: contact(:)
    integer :: first, last

    allocate (random(product(cells)))
    call random_number(random)
    contact = random < density**3
    call random_number(random)
    values = merge(real(random - 0.5_dp, sp), 0.0_sp, contact)
    call share(cells(2), rows)
    rows%cells = cells
    first = cells(1)*(rows%first(rows%number()) - 1) + 1
    last = cells(1)*(rows%first(rows%number() + 1) - 1)
    here = values(first:last)
    call alone%set(all_rows, cells, contact, info)
    call shared%set(rows, cells, contact(first:last), info)
    call alone%extend(values)
    call shared%extend(here)
    call expect(info%status == FUGE_DONE, trim(info%message))
    call expect(all(abs(here - values(first:last)) <= 1.0e-6_sp), 'extended values')
    values = values*real(random, sp)
    here = here*real(random(first:last), sp)
    call alone%collect(values)
    call shared%collect(here)
    call expect(all(abs(here - values(first:last)) <= 1.0e-5_sp*maxval(abs(values))), 'collected values')
  end subroutine compare_extensions

  ! Any cells of each rank, or none.
  subroutine share(n, rows)
    integer, intent(in) :: n
    type(shared_rows), intent(inout) :: rows
    real(dp) :: random
    integer :: r

    rows%cells = [1, n]
    if (allocated(rows%first)) deallocate (rows%first)
    allocate (rows%first(0:rows%members()))
    rows%first(0) = 1
    do r = 1, rows%members()
      call random_number(random)
      rows%first(r) = min(rows%first(r - 1) + int(2.5_dp*n*random/rows%members()), n + 1)
    end do
    rows%first(rows%members()) = n + 1
  end subroutine share

  ! Sets of runs of at most `longest` cells, open or in contact, of which the part `wrong` are wrong at one end.
  subroutine compare_sets(n, longest, wrong, rows)
    integer, intent(in) :: n, longest
    real(dp), intent(in) :: wrong
    type(shared_rows), intent(in) :: rows
    type(fuge_info) :: info
    logical, dimension(n) :: tensile, penetrating, contact, expected
    real(dp) :: measure(n), random(4)
    logical, allocatable :: own(:)
    integer :: begin, finish, k, run, segments

    call random_number(measure)
    tensile = .false.
    penetrating = .false.
    contact = .false.
    k = 0
    do while (k < n)
      call random_number(random)
      run = min(1 + int(longest*random(1)), n - k)
      contact(k + 1:k + run) = random(2) < 0.5_dp
      if (random(3) < wrong) then
        begin = k + 1
        finish = k + run
        if (random(4) < 0.5_dp) begin = k + 1 + int(run*random(1))
        if (random(4) > 0.3_dp) finish = k + 1 + int((run - 1)*random(2))
        tensile(begin:finish) = contact(begin:finish)
        penetrating(begin:finish) = .not. contact(begin:finish)
        measure(begin:finish) = -measure(begin:finish)
      end if
      k = k + run
    end do
    segments = count(contact(2:) .and. .not. contact(:n - 1)) + merge(1, 0, contact(1))
    begin = rows%first(rows%number())
    finish = rows%first(rows%number() + 1) - 1
    call expect(count_segments(rows, contact(begin:finish)) == segments, 'the number of segments')
    expected = contact
    call exchange_extrapolated(tensile, penetrating, measure, expected)
    own = contact(begin:finish)
    call exchange_in_line(rows, tensile(begin:finish), penetrating(begin:finish), measure(begin:finish), own, info)
    call expect(.not. info%failed(), trim(info%message))
    call expect(all(own .eqv. expected(begin:finish)), 'the exchanged set')
  end subroutine compare_sets

  ! Sums, means and differences over the groups of n cells.
  subroutine compare_groups(n, rows)
    integer, intent(in) :: n
    type(shared_rows), intent(inout) :: rows
    type(shared_rows) :: coarse, alone
    type(fuge_info) :: info
    real(dp), dimension(n) :: weight, values
    real(dp), dimension((n - 1)/GROUP + 1) :: sums, means
    real(dp), allocatable :: own(:), own_sums(:), own_means(:)
    integer :: me

    coarse%point_space = rows%point_space
    call share(size(sums), coarse)
    call share(n, rows)
    me = rows%number()
    call random_number(weight)
    weight = anint(weight)
    call random_number(values)
    allocate (own_sums(coarse%first(me + 1) - coarse%first(me)), own_means(coarse%first(me + 1) - coarse%first(me)))
    associate (a => rows%first(me), b => rows%first(me + 1) - 1, c => coarse%first(me), d => coarse%first(me + 1) - 1)
      own = values(a:b)
      call sum_over_groups(alone, alone, weight, sums, info)
      call sum_over_groups(rows, coarse, weight(a:b), own_sums, info)
      call expect(all(abs(own_sums - sums(c:d)) <= 0.0_dp), 'sums over groups')
      call compute_group_means(alone, alone, weight, values, sums, means, info)
      call compute_group_means(rows, coarse, weight(a:b), own, own_sums, own_means, info)
      call expect(all(abs(own_means - means(c:d)) <= 1.0e-14_dp), 'means over groups')
      call subtract_from_groups(alone, alone, means, weight, values, info)
      call subtract_from_groups(rows, coarse, own_means, weight(a:b), own, info)
      call add_to_groups(alone, alone, 3.0_dp, means, values, info)
      call add_to_groups(rows, coarse, 3.0_dp, own_means, own, info)
      call expect(all(abs(own - values(a:b)) <= 1.0e-13_dp), 'values less those of their groups')
    end associate
    call expect(.not. info%failed(), trim(info%message))
  end subroutine compare_groups

end program exchanges
