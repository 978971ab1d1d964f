!> CalculiX's own contact: a job with a penalty, and its answer.
module calculix_penalty
  use calculix_files, only: count_iterations, read_table, run_job
  use calculix_mesh, only: node_areas
  use fuge, only: dp => fuge_dp
  implicit none
  private

  public :: solve_by_penalty

  type, public :: penalty_answer
    !> Pressure for each length of penetration, force/length**3.
    real(dp) :: stiffness = 0.0_dp
    !> Of the whole job; time in s.
    integer :: increments = 0, iterations = 0
    real(dp) :: seconds = 0.0_dp
    !> Of each contact node: force, area on which its pressure acts, gap (penetration < 0).
    real(dp), allocatable :: force(:), area(:), gap(:)
    real(dp) :: approach = 0.0_dp
    !> Displacements of all nodes of the block: their numbers, and (3, nodes).
    integer, allocatable :: node(:)
    real(dp), allocatable :: displacement(:, :)
  end type penalty_answer

  !> Tension across wide gaps, stress: the spring of CalculiX is smooth and pulls a little.
  !> Radius of its search, in units of the square root of the area of a node.
  character(len=*), parameter :: TENSION_AND_REACH = ', 1.e-6, 1.'

contains

  !> Run `contact.inp` with a penalty. `place` (2, n): undeformed x and z of the nodes
  !> `contact`, in pairs of front and back.
  subroutine solve_by_penalty(command, stiffness, contact, place, answer)
    character(len=*), intent(in) :: command
    real(dp), intent(in) :: stiffness, place(:, :)
    integer, intent(in) :: contact(:)
    type(penalty_answer), intent(out) :: answer
    integer, allocatable :: node(:)
    real(dp), allocatable :: value(:, :)
    real(dp) :: moved(2, size(contact))
    integer :: file

    answer%stiffness = stiffness
    open (newunit=file, file='penalty.inp', status='replace', action='write')
    write (file, '(a)') '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR'
    write (file, '(es20.13,a)') stiffness, TENSION_AND_REACH
    close (file)
    call run_job(command, 'contact', 'contact.dat', answer%seconds)
    call count_iterations('contact', answer%increments, answer%iterations)

    call read_table('contact', 'displacements (vx,vy,vz) for set HANDLE', node, value)
    answer%approach = -value(3, 1)
    call read_table('contact', 'displacements (vx,vy,vz) for set BLOCK', answer%node, answer%displacement)
    call read_table('contact', 'relative contact displacement', node, value)
    answer%gap = of_nodes(contact, node, value(1, :))
    call read_table('contact', 'contact stress', node, value)
    answer%force = of_nodes(contact, node, value(1, :))
    moved(1, :) = place(1, :) + of_nodes(contact, answer%node, answer%displacement(1, :))
    moved(2, :) = place(2, :) + of_nodes(contact, answer%node, answer%displacement(3, :))
    ! CalculiX takes them from the deformed surface.
    answer%area = node_areas(moved)
    answer%force = answer%force*answer%area
  end subroutine solve_by_penalty

  !> The values of some nodes, selected from those of all.
  function of_nodes(wanted, node, value) result(values)
    integer, intent(in) :: wanted(:), node(:)
    real(dp), intent(in) :: value(:)
    real(dp) :: values(size(wanted))
    integer :: k, place

    do k = 1, size(wanted)
      place = findloc(node, wanted(k), dim=1)
      if (place == 0) error stop 'CalculiX gives no contact element for a node'
      values(k) = value(place)
    end do
  end function of_nodes

end module calculix_penalty
