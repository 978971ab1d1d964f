!> The elastic body of the contact: the influence matrix of the nodes that may touch, from
!> the stiffness that CalculiX assembles, and the same matrix by unit loads, as a check.
module calculix_elastic
  use calculix_files, only: read_table, run_job, wall_clock
  use fuge, only: dp => fuge_dp, fuge_body, fuge_condense, fuge_condensed, fuge_info, fuge_read_stiffness
  use fuge_sparse, only: fuge_sparse_stiffness
  implicit none
  private

  public :: condense_block, influence_by_unit_loads, vertical, give_up

  !> The results of the job `stiffness` and of the condensation.
  type, public :: elastic_block
    type(fuge_condensed) :: condensed
    !> Node and direction of each degree of freedom.
    integer, allocatable :: node(:), direction(:)
    !> Time of CalculiX, of reading its files, and of condensing; s.
    real(dp) :: assembling = 0.0_dp, reading = 0.0_dp, condensing = 0.0_dp
  end type elastic_block

contains

  !> `contact` lists the nodes that may touch. The body lies below its top, so that contact
  !> forces act on it along -z.
  subroutine condense_block(command, contact, block)
    character(len=*), intent(in) :: command
    integer, intent(in) :: contact(:)
    type(elastic_block), intent(inout) :: block
    type(fuge_sparse_stiffness) :: stiffness
    type(fuge_body) :: body
    type(fuge_info) :: info
    integer, allocatable :: column(:), row(:)
    real(dp), allocatable :: value(:)
    real(dp) :: start

    call run_job(command, 'stiffness', 'stiffness.sti', block%assembling)
    start = wall_clock()
    call fuge_read_stiffness('stiffness.sti', column, row, value, block%node, block%direction, info)
    if (info%failed()) call give_up(info)
    block%reading = wall_clock() - start

    start = wall_clock()
    call stiffness%set(column, row, value, info)
    if (info%failed()) call give_up(info)
    body%dof = reshape(vertical(block, contact), [1, size(contact)])
    allocate (body%normal(1, size(contact)), source=-1.0_dp)
    call fuge_condense(stiffness, body, block%condensed, info)
    if (info%status /= 0) call give_up(info)
    block%condensing = wall_clock() - start
  end subroutine condense_block

  !> Degrees of freedom along z of some nodes; 0 where CalculiX has none.
  pure function vertical(block, node) result(dof)
    type(elastic_block), intent(in) :: block
    integer, intent(in) :: node(:)
    integer :: dof(size(node))
    integer :: place(0:max(maxval(node), maxval(block%node)))
    integer :: k

    place = 0
    do k = 1, size(block%node)
      if (block%direction(k) == 3) place(block%node(k)) = k
    end do
    dof = place(node)
  end function vertical

  !> The columns of the nodes `loaded` by a linear step for each, with a unit load.
  !> CalculiX prints seven digits.
  subroutine influence_by_unit_loads(command, contact, loaded, alpha, seconds)
    character(len=*), intent(in) :: command
    integer, intent(in) :: contact(:), loaded(:)
    real(dp), intent(out) :: alpha(:, :), seconds
    integer, allocatable :: node(:)
    real(dp), allocatable :: value(:, :)
    integer :: file, k

    open (newunit=file, file='unit.inp', status='replace', action='write')
    write (file, '(a)') '*INCLUDE, INPUT=model.inp'
    do k = 1, size(loaded)
      write (file, '(a)') '*STEP', '*STATIC', '*CLOAD, OP=NEW'
      write (file, '(i0,a)') loaded(k), ', 3, -1.'
      if (k == 1) write (file, '(a)') '*NODE PRINT, NSET=CONTACT', 'U'
      write (file, '(a)') '*END STEP'
    end do
    close (file)
    call run_job(command, 'unit', 'unit.dat', seconds)
    do k = 1, size(loaded)
      call read_table('unit', 'displacements', node, value, table=k)
      if (any(node /= contact)) error stop 'the nodes of the set CONTACT are not in order'
      alpha(:, k) = -value(3, :)
    end do
  end subroutine influence_by_unit_loads

  subroutine give_up(info)
    type(fuge_info), intent(in) :: info

    print '(a)', trim(info%message)
    error stop 'fuge did not solve the contact'
  end subroutine give_up

end module calculix_elastic
