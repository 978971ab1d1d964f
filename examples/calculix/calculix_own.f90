!> CalculiX's own contact of a model, by penalties or Lagrange multipliers.
module calculix_own
  use calculix_files, only: count_iterations, processor_time, read_contact, read_total, try_job
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: find, solve_by_calculix, write_law

  !> How CalculiX treats the contact.
  type, public :: contact_law
    !> TYPE of *CONTACT PAIR, as CalculiX has it.
    character(len=18) :: type = 'SURFACE TO SURFACE'
    !> Pressure for each length of penetration, in the units of the model; 0: CalculiX's default; below 0: none, hard.
    real(dp) :: penalty = 0.0_dp
    !> The gap that CalculiX takes in place of that of the meshes (*CLEARANCE), length; 0: none.
    real(dp) :: clearance = 0.0_dp
  end type contact_law

  type, public :: own_answer
    logical :: solved = .false.
    !> Processor time, s.
    real(dp) :: seconds = 0.0_dp
    integer :: increments = 0, iterations = 0
    !> Forces of the supports of a set of nodes, their sum.
    real(dp) :: total(3) = 0.0_dp
    !> Nodes of the contact surface with their gap (penetration < 0) and pressure.
    integer, allocatable :: node(:)
    real(dp), allocatable :: gap(:), pressure(:)
  end type own_answer

contains

  !> The cards of the contact pair in a file of their own.
  subroutine write_law(path, law, contact, opposite)
    character(len=*), intent(in) :: path, contact, opposite
    type(contact_law), intent(in) :: law
    integer :: file

    open (newunit=file, file=path, status='replace', action='write')
    write (file, '(a)') '*SURFACE INTERACTION, NAME=LAW'
    if (law%penalty >= 0.0_dp) write (file, '(a)') '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR'
    if (law%penalty > 0.0_dp) write (file, '(es20.13)') law%penalty
    write (file, '(a)') '*CONTACT PAIR, INTERACTION=LAW, TYPE='//trim(law%type), contact//', '//opposite
    if (abs(law%clearance) > 0.0_dp) &
      write (file, '(a,es20.13)') '*CLEARANCE, MASTER='//opposite//', SLAVE='//contact//', VALUE=', law%clearance
    close (file)
  end subroutine write_law

  !> Run a job for at most `most` seconds. `supported`: the set of nodes whose forces are printed.
  subroutine solve_by_calculix(command, job, supported, most, answer)
    character(len=*), intent(in) :: command, job, supported
    integer, intent(in) :: most
    type(own_answer), intent(out) :: answer
    real(dp), allocatable :: value(:, :)

    call try_job(command, job, most, answer%solved)
    answer%seconds = processor_time(job)
    call count_iterations(job, answer%increments, answer%iterations)
    if (.not. answer%solved) return
    call read_total(job, supported, answer%total)
    call read_contact(job, answer%node, value)
    answer%gap = value(1, :)
    answer%pressure = value(4, :)
  end subroutine solve_by_calculix

  !> The values of the nodes `wanted`; 0 for nodes without one.
  pure function find(wanted, node, value) result(values)
    integer, intent(in) :: wanted(:), node(:)
    real(dp), intent(in) :: value(:)
    real(dp) :: values(size(wanted))
    integer :: k, place

    do k = 1, size(wanted)
      place = findloc(node, wanted(k), dim=1)
      values(k) = 0.0_dp
      if (place > 0) values(k) = value(place)
    end do
  end function find

end module calculix_own
