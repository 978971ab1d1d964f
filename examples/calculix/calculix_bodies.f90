!> Two bodies of a CalculiX model in contact, by fuge: its stiffness, the two surfaces of its input file, one call.
module calculix_bodies
  use calculix_files, only: processor_time, run_job
  use fuge, only: dp => fuge_dp, fuge_bodies_contact, fuge_elastic_body, fuge_info, fuge_mesh, &
    fuge_mesh_contact_surface, fuge_mesh_degrees, fuge_pair_options, fuge_read_mesh, fuge_read_stiffness, &
    fuge_solve_bodies, fuge_surface_pair
  use fuge_sparse, only: fuge_sparse_stiffness
  implicit none
  private

  public :: solve_by_fuge

  !> The task for fuge.
  type, public :: contact_request
    !> The model; the job that writes its stiffness has the same name with _stiffness.
    character(len=16) :: model = ''
    !> The surface whose nodes become contact points, and that across from it.
    character(len=16) :: contact = '', opposite = ''
    !> A set of nodes and its displacement along z; none if blank.
    character(len=16) :: moved = ''
    real(dp) :: displacement = 0.0_dp
    !> What is read is converted: a length and a force of the files in the units of `displacement` and the result.
    real(dp) :: length = 1.0_dp, force = 1.0_dp
    type(fuge_pair_options) :: options
  end type contact_request

  type, public :: contact_result
    type(fuge_bodies_contact) :: contact
    !> CalculiX's numbers of the contact points' nodes.
    integer, allocatable :: node(:)
    integer :: degrees = 0
    !> Largest scaled violation of the contact conditions.
    real(dp) :: certificate = 0.0_dp
    !> Processor time of CalculiX, and of fuge with the reading of the files; s.
    real(dp) :: assembling = 0.0_dp, solving = 0.0_dp
  end type contact_result

contains

  !> Both bodies are in one model, so that their surfaces belong to one stiffness matrix, body 1.
  subroutine solve_by_fuge(command, request, result)
    character(len=*), intent(in) :: command
    type(contact_request), intent(in) :: request
    type(contact_result), intent(out) :: result
    type(fuge_elastic_body) :: body(1)
    type(fuge_surface_pair) :: pair(1)
    type(fuge_mesh) :: mesh
    type(fuge_sparse_stiffness) :: stiffness
    type(fuge_info) :: info
    character(len=:), allocatable :: job
    integer, allocatable :: node(:), direction(:)
    real(dp) :: start, wall

    job = trim(request%model)//'_stiffness'
    call run_job(command, job, job//'.sti', wall)
    result%assembling = processor_time(job)
    call cpu_time(start)
    call fuge_read_stiffness(job//'.sti', body(1)%column, body(1)%row, body(1)%value, node, direction, info)
    if (.not. info%failed()) call fuge_read_mesh(trim(request%model)//'.inp', mesh, info)
    if (.not. info%failed()) &
      call fuge_mesh_contact_surface(mesh, request%contact, 3, node, direction, pair(1)%contact, info)
    if (.not. info%failed()) &
      call fuge_mesh_contact_surface(mesh, request%opposite, 3, node, direction, pair(1)%opposite, info)
    if (.not. info%failed() .and. request%moved /= '') then
      call fuge_mesh_degrees(mesh, request%moved, 3, node, direction, body(1)%fixed, info)
      if (.not. info%failed()) allocate (body(1)%displacement(size(body(1)%fixed)), source=request%displacement)
    end if
    if (info%failed()) call give_up(info)
    body(1)%value = body(1)%value*(request%force/request%length)
    pair(1)%contact%node = pair(1)%contact%node*request%length
    pair(1)%opposite%node = pair(1)%opposite%node*request%length
    pair(1)%opposite_body = 1
    pair(1)%options = request%options
    call fuge_solve_bodies(stiffness, body, pair, result%contact, info)
    call cpu_time(result%solving)
    result%solving = result%solving - start
    if (info%status /= 0) call give_up(info)
    result%degrees = size(node)
    result%certificate = info%residual
    result%node = mesh%node(result%contact%pairs%node)
  end subroutine solve_by_fuge

  subroutine give_up(info)
    type(fuge_info), intent(in) :: info

    print '(a)', trim(info%message)
    error stop 'fuge did not solve the contact'
  end subroutine give_up

end module calculix_bodies
