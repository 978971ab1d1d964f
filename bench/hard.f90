!> The hard scenes of test/hard for other solvers, and the table of their answers.
!>
!>     hard DIRECTORY write     writes the scenes
!>     hard DIRECTORY           writes DIRECTORY/hard.md from the answers
program hard
  use bench_answers, only: column, FAILURE, METHOD, NAME, TOLERANCE
  use bench_problems, only: bench_problem, whole
  use bench_records, only: bench_row, write_problem
  use fuge, only: dp => fuge_dp, fuge_info, fuge_solution, FUGE_ACTIVE_SET
  use hard_run, only: force_error, solve_scene
  use hard_scenes, only: hard_scene, numbered_scene, SCENES
  use one_sided_reference, only: datum_of, deflection, violation
  implicit none

  character(len=10), parameter :: PEERS(5) = [character(len=10) :: 'daqp', 'piqp', 'proxqp', 'quadprog', 'scipy_nnls']

  !> With a residual above this an answer counts as wrong.
  real(dp), parameter :: WRONG = 1.0e-6_dp

  !> Most characters in a line of answers.csv.
  integer, parameter :: LENGTH = 400

  call run()

contains

  subroutine run()
    character(len=256) :: directory
    character(len=8) :: word
    character(len=LENGTH), allocatable :: answers(:)
    integer :: number, unit

    call get_command_argument(1, directory)
    call get_command_argument(2, word)
    if (directory == '') error stop 'usage: hard DIRECTORY [write]'
    if (word == 'write') then
      do number = 1, SCENES
        call write_scene(trim(directory), number, numbered_scene(number))
      end do
      return
    end if
    call read_answers(trim(directory), answers)
    open (newunit=unit, file=trim(directory)//'/hard.md', status='replace', action='write')
    write (unit, '(a)') '| residual, error | n | what is hard '// &
      '| fuge, active set | DAQP | PIQP | ProxQP | quadprog | scipy nnls |'
    write (unit, '(a)') '| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |'
    do number = 1, SCENES
      call write_line(unit, trim(directory), number, numbered_scene(number), answers)
    end do
    close (unit)
  end subroutine run

  !> The file name scene_NUMBER; the name of a scene may not be one.
  subroutine write_scene(directory, number, scene)
    character(len=*), intent(in) :: directory
    integer, intent(in) :: number
    type(hard_scene), intent(in) :: scene
    type(bench_problem) :: problem
    type(bench_row) :: row
    real(dp) :: nothing(size(scene%gap))

    nothing = 0.0_dp
    allocate (problem%alpha, source=scene%alpha)
    allocate (problem%gap, source=scene%gap)
    problem%load = scene%load
    row%problem = 'scene'//whole(number)
    call write_problem(directory, problem, row, nothing)
  end subroutine write_scene

  subroutine read_answers(directory, answers)
    character(len=*), intent(in) :: directory
    character(len=LENGTH), allocatable, intent(out) :: answers(:)
    character(len=LENGTH) :: line
    integer :: unit, stat

    allocate (answers(0))
    open (newunit=unit, file=directory//'/answers.csv', status='old', action='read')
    do
      read (unit, '(a)', iostat=stat) line
      if (stat /= 0) exit
      answers = [answers, line]
    end do
    close (unit)
  end subroutine read_answers

  subroutine write_line(unit, directory, number, scene, answers)
    integer, intent(in) :: unit, number
    character(len=*), intent(in) :: directory
    type(hard_scene), intent(in) :: scene
    character(len=LENGTH), intent(in) :: answers(:)
    type(fuge_solution) :: solution
    type(fuge_info) :: info
    character(len=:), allocatable :: line, stem
    real(dp) :: force(size(scene%gap))
    integer :: k, peer, forces

    stem = 'scene'//whole(number)//'_'//whole(size(scene%gap))
    call solve_scene(scene, FUGE_ACTIVE_SET, solution, info)
    line = '| '//trim(scene%name)//' | '//whole(size(scene%gap))//' | '//trim(scene%why)//' | '
    if (info%failed()) then
      line = line//whole(info%status)
    else
      line = line//judged(scene, solution%force)
    end if
    do peer = 1, size(PEERS)
      line = line//' | '
      do k = 1, size(answers)
        if (column(answers(k), NAME) /= stem .or. column(answers(k), METHOD) /= PEERS(peer)) cycle
        if (column(answers(k), FAILURE) /= '') then
          line = line//column(answers(k), FAILURE)
        else
          open (newunit=forces, file=directory//'/'//stem//'.'//trim(PEERS(peer))//column(answers(k), TOLERANCE), &
                access='stream', form='unformatted', status='old', action='read')
          read (forces) force
          close (forces)
          line = line//judged(scene, force)
        end if
      end do
    end do
    write (unit, '(a)') line//' |'
  end subroutine write_line

  !> Residual from the forces alone, and the error of the forces where they are known.
  function judged(scene, force) result(cell)
    type(hard_scene), intent(in) :: scene
    real(dp), intent(in) :: force(:)
    character(len=:), allocatable :: cell
    real(dp), dimension(size(force)) :: opening, pushing
    real(dp) :: datum, lowest, approach, residual

    datum = datum_of(scene%alpha)
    pushing = max(force, 0.0_dp)
    lowest = minval(scene%gap)
    opening = (scene%gap - lowest) + deflection(scene%alpha, datum, force)
    approach = 0.0_dp
    if (sum(pushing) > 0.0_dp) approach = sum(pushing*opening)/sum(pushing)
    opening = opening - approach
    residual = violation(scene%alpha, scene%gap, scene%load, force, opening, approach + lowest + datum*sum(force))
    cell = short(residual)
    if (allocated(scene%force)) cell = cell//', '//short(force_error(scene, scene%force, force))
    if (.not. residual <= WRONG) cell = '**'//cell//'**'
  end function judged

  !> One digit and the power of ten.
  function short(value) result(words)
    real(dp), intent(in) :: value
    character(len=:), allocatable :: words
    character(len=12) :: buffer
    integer :: power

    words = '0'
    if (.not. value > 0.0_dp) return
    write (buffer, '(es8.0e3)') value
    read (buffer(index(buffer, 'E') + 1:), *) power
    words = trim(adjustl(buffer(:index(buffer, '.') - 1)))//'e'//whole(power)
  end function short

end program hard
