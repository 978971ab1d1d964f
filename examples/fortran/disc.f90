!> The paper's rubber disc: Tabelle 2, both load cases, Bild 5 and 6.
!>
!>     disc [folder with disc_pivots.csv and disc_results.csv [folder for its tables]]
!>
!> Prints the paper's numbers beside those of fuge; for the pictures it writes disc_1.dat and disc_2.dat.
program disc
  use disc_rings, only: disc_influence, ring_radius, RINGS
  use example_output, only: create_file
  use example_verdict, only: verdict
  use fuge, only: dp => fuge_dp, fuge_dense_operator, fuge_history, fuge_info, fuge_options, fuge_problem, &
    fuge_solution, fuge_solver
  implicit none

  !> Datum of the gaps: in step 13 of Tabelle 2 the last gap leaves z by this much, mm.
  real(dp), parameter :: DATUM = 40.75266_dp
  real(dp), parameter :: LINE_LOAD(2) = [0.36_dp, 0.72_dp]
  integer, parameter :: PRINTED_STEPS = 25
  !> Basis after the last pivot of load case 2 as printed.
  integer, parameter :: FINAL_BASIS_2(RINGS + 1) = [14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 26, 12, 27, 11]

  call run()

contains

  subroutine run()
    real(dp) :: printed(4, RINGS)
    type(fuge_history) :: history
    type(verdict) :: paper
    integer :: case_number

    call read_results(printed)
    do case_number = 1, 2
      print '(/,a,i0,a,f5.2,a)', 'Load case ', case_number, ': p = 0.01 N/mm2, q =', LINE_LOAD(case_number), ' N/mm'
      call solve(case_number, printed(2*case_number - 1:2*case_number, :), history)
      if (case_number == 1) call compare_with_table(history, paper)
    end do
    print '(/,a,14i4)', 'Last basis of load case 2, paper:', FINAL_BASIS_2
    print '(a,14i4)', '                            fuge:', history%basis(history%recorded() - 1)
    print '(/,a)', '* a misprint in the paper, see doc/errata.md'
    call paper%hold(all(history%basis(history%recorded() - 1) == FINAL_BASIS_2), 'the last basis of load case 2')
    call paper%give('bases of the paper''s Tabelle 2')
  end subroutine run

  subroutine solve(case_number, printed, history)
    integer, intent(in) :: case_number
    real(dp), intent(in) :: printed(:, :)
    type(fuge_history), intent(out) :: history
    real(dp), target :: alpha(RINGS, RINGS)
    real(dp) :: b(RINGS), load
    type(fuge_dense_operator) :: operator
    type(fuge_problem) :: problem
    type(fuge_solution) :: solution
    type(fuge_solver) :: solver
    type(fuge_info) :: info

    call disc_influence(LINE_LOAD(case_number), alpha, b, load)
    allocate (problem%gap, source=DATUM + b)
    allocate (problem%resultant, source=[load])
    call operator%set(alpha, info)
    if (.not. info%failed()) call solver%solve(operator, problem, solution, info, fuge_options(keep_history=.true.))
    if (info%status /= 0) error stop 'the disc was not solved'
    history = solver%history
    call show_answer(solution, printed)
    print '(a,f10.4,a,i0,a,es8.1)', 'load F_0 = ', load, ' N, pivots ', info%iterations, ', residual', info%residual
    call write_section(case_number, solution%gap, printed(2, :))
  end subroutine solve

  !> Line forces and gaps beside the printed ones; a star marks a difference of
  !> more than 0.1 % and more than the last digits: misprints, see doc/errata.md.
  subroutine show_answer(solution, printed)
    type(fuge_solution), intent(in) :: solution
    real(dp), intent(in) :: printed(:, :)
    real(dp) :: line_force
    integer :: k

    print '(a4,a11,a8,a15,a10)', 'ring', 'F [N/mm]', 'paper', 'c [mm]', 'paper'
    do k = 1, RINGS
      line_force = solution%force(k)
      ! The paper prints no force for the centre, a ring of no length.
      if (k > 1) line_force = line_force/(2.0_dp*acos(-1.0_dp)*ring_radius(k))
      print '(i4,f11.4,f8.4,a2,f13.5,f10.5,a2)', k, line_force, printed(1, k), mark(line_force, printed(1, k)), &
        solution%gap(k), printed(2, k), mark(solution%gap(k), printed(2, k))
    end do
  end subroutine show_answer

  pure function mark(value, reference)
    real(dp), intent(in) :: value, reference
    character(len=2) :: mark

    mark = merge(' *', '  ', abs(value - reference) > max(0.001_dp*abs(value), 2.0e-4_dp))
  end function mark

  !> Tabelle 2: every printed basis must be met, z to what alpha is known to.
  subroutine compare_with_table(history, paper)
    type(fuge_history), intent(in) :: history
    type(verdict), intent(inout) :: paper
    integer :: basis(RINGS + 1, PRINTED_STEPS), step, same
    real(dp) :: z(PRINTED_STEPS)

    call read_pivots(basis, z)
    print '(/,a)', 'Tabelle 2, the paper''s row above that of fuge:'
    same = 0
    do step = 1, PRINTED_STEPS
      print '(14i3,a,sp,es13.6)', basis(:, step), '  Z= ', z(step)
      print '(a)', history%line(step)
      call paper%hold(all(history%basis(step) == basis(:, step)), 'a basis of load case 1')
      if (all(history%basis(step) == basis(:, step))) same = same + 1
    end do
    print '(/,i0,a,i0,a)', same, ' of ', PRINTED_STEPS, ' bases are those of the paper'
    print '(a,es8.1)', 'largest relative difference of z in steps 1 to 14:', &
      maxval([(abs(history%z(step) - z(step))/z(step), step=1, 14)])
    print '(a,es8.1,a)', 'largest difference of z in steps 15 to 25:        ', &
      maxval([(abs(history%z(step) - z(step)), step=15, PRINTED_STEPS)]), ' mm'
    if (any([(abs(history%z(step) - z(step)) > 1.0e-6_dp*z(step), step=1, 14)])) error stop 'z differs from Tabelle 2'
    if (any([(abs(history%z(step) - z(step)) > 0.01_dp, step=15, PRINTED_STEPS)])) error stop 'z differs from Tabelle 2'
  end subroutine compare_with_table

  !> For the picture: radius, gap, and the gap that the paper prints.
  subroutine write_section(case_number, gap, printed)
    integer, intent(in) :: case_number
    real(dp), intent(in) :: gap(:), printed(:)
    integer :: file, k

    call create_file('disc_'//achar(iachar('0') + case_number)//'.dat', 2, file)
    do k = 1, RINGS
      write (file, '(f8.1,es16.7,f12.5)') ring_radius(k), gap(k), printed(k)
    end do
    close (file)
  end subroutine write_section

  subroutine read_pivots(basis, z)
    integer, intent(out) :: basis(:, :)
    real(dp), intent(out) :: z(:)
    integer :: file, step, number

    call open_table('disc_pivots.csv', file)
    do step = 1, size(z)
      read (file, *) number, basis(:, step), z(step)
    end do
    close (file)
  end subroutine read_pivots

  !> F and c of load case 1, F and c of load case 2, for each ring.
  subroutine read_results(printed)
    real(dp), intent(out) :: printed(:, :)
    integer :: file, k, number
    real(dp) :: radius

    call open_table('disc_results.csv', file)
    do k = 1, size(printed, 2)
      read (file, *) number, radius, printed(:, k)
    end do
    close (file)
  end subroutine read_results

  !> Open a table of the folder given, past its comments and its heading.
  subroutine open_table(name, file)
    character(len=*), intent(in) :: name
    integer, intent(out) :: file
    character(len=512) :: folder, line
    integer :: stat

    call get_command_argument(1, folder)
    if (folder == '') folder = 'examples/data'
    open (newunit=file, file=trim(folder)//'/'//name, status='old', action='read', iostat=stat)
    if (stat /= 0) error stop 'usage: disc FOLDER, the folder that holds disc_pivots.csv and disc_results.csv'
    do
      read (file, '(a)') line
      if (line(1:1) /= '#') exit
    end do
  end subroutine open_table

end program disc
