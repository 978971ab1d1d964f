!> Files of blocks in the formats of finite element programs.
module block_files
  use block_models, only: block
  use fuge_kinds, only: dp
  implicit none
  private

  public :: write_block, write_formats, write_loads

contains

  !> The mesh, and the stiffness as CalculiX writes it: path.inp, path.sti and path.dof.
  subroutine write_block(path, model, type_name)
    character(len=*), intent(in) :: path, type_name
    type(block), intent(in) :: model
    integer :: e, file, first

    ! Elements of both blocks have different numbers.
    first = merge(100, 0, model%is_upper)
    open (newunit=file, file=path//'.inp', status='replace', action='write')
    write (file, '(a)') '** A block of finite elements, from test/program/blocks.f90', '*NODE, NSET=ALL'
    do e = 1, size(model%number)
      write (file, '(i0,3(:,'','',f0.4))') model%number(e), model%position(:, e)
    end do
    write (file, '(2a)') '*ELEMENT, ELSET=ALL, TYPE=', type_name
    do e = 1, size(model%element, 2)
      write (file, '(i0,8(:,'','',i0))') first + e, model%number(model%element(:, e))
    end do
    call write_set('BOTTOM', model%bottom)
    call write_set('TOP', model%top)
    call write_set('LEFT', model%left)
    if (model%dimensions == 3) call write_set('FRONT', model%front)
    write (file, '(a)') '*SURFACE, NAME=FACE'
    if (model%is_upper) then
      write (file, '(i0,a)') (first + model%below(e), ', S1', e=1, size(model%below))
    else
      write (file, '(i0,a)') (first + model%above(e), merge(', S3', ', S2', model%dimensions == 2), &
                              e=1, size(model%above))
    end if
    if (model%is_upper) then
      write (file, '(a)') '*SURFACE, NAME=ABOVE'
      write (file, '(i0,a)') (first + model%above(e), merge(', S3', ', S2', model%dimensions == 2), &
                              e=1, size(model%above))
    end if
    close (file)
    call write_entries(path//'.sti')
    call write_names(path//'.dof', model)

  contains

    subroutine write_set(name, nodes)
      character(len=*), intent(in) :: name
      integer, intent(in) :: nodes(:)

      write (file, '(2a)') '*NSET, NSET=', name
      write (file, '(i0)') model%number(nodes)
    end subroutine write_set

    subroutine write_entries(name)
      character(len=*), intent(in) :: name
      integer :: i, j

      open (newunit=file, file=name, status='replace', action='write')
      do j = 1, size(model%k, 2)
        do i = 1, j
          if (abs(model%k(i, j)) > 0.0_dp) write (file, '(2(i0,1x),es24.16)') i, j, model%k(i, j)
        end do
      end do
      close (file)
    end subroutine write_entries

  end subroutine write_block

  !> A line node.direction for each row.
  subroutine write_names(path, model)
    character(len=*), intent(in) :: path
    type(block), intent(in) :: model
    integer :: axis, file, k

    open (newunit=file, file=path, status='replace', action='write')
    do k = 1, size(model%number)
      write (file, '(i0,''.'',i0)') (model%number(k), axis, axis=1, model%dimensions)
    end do
    close (file)
  end subroutine write_names

  !> The same stiffness as Abaqus and Nastran write it, and in the Matrix Market format.
  subroutine write_formats(path, model)
    character(len=*), intent(in) :: path
    type(block), intent(in) :: model
    integer :: file, i, j, n

    n = size(model%k, 1)
    open (newunit=file, file=path//'_abaqus.mtx', status='replace', action='write')
    do j = 1, n
      do i = 1, n
        if (abs(model%k(i, j)) > 0.0_dp) write (file, '(4(i0,'',''),es22.15)') label(i), label(j), model%k(i, j)
      end do
    end do
    close (file)
    open (newunit=file, file=path//'_market.mtx', status='replace', action='write')
    write (file, '(a)') '%%MatrixMarket matrix coordinate real general'
    write (file, '(i0,1x,i0,1x,i0)') n, n, count(abs(model%k) > 0.0_dp)
    do j = 1, n
      do i = 1, n
        if (abs(model%k(i, j)) > 0.0_dp) write (file, '(2(i0,1x),es24.16)') i, j, model%k(i, j)
      end do
    end do
    close (file)
    open (newunit=file, file=path//'.pch', status='replace', action='write')
    write (file, '(a,i24)') 'DMIG    KAAX           0       6       2       0        ', n
    do j = 1, n
      write (file, '(a,2i16)') 'DMIG*   KAAX            ', label(j)
      do i = 1, j
        if (abs(model%k(i, j)) > 0.0_dp) write (file, '(a,2i16,es16.9)') '*       ', label(i), model%k(i, j)
      end do
    end do
    close (file)
    open (newunit=file, file=path//'.op4', status='replace', action='write')
    write (file, '(4i8,a)') n, n, 6, 2, 'KAA     1P,3E23.16'
    do j = 1, n
      write (file, '(3i8)') j, 1, n
      write (file, '(1p,3e23.16)') model%k(:, j)
    end do
    write (file, '(3i8)') n + 1, 1, 1
    write (file, '(1p,3e23.16)') 1.0_dp
    close (file)

  contains

    !> Node and direction of a row.
    function label(i)
      integer, intent(in) :: i
      integer :: label(2)

      label = [model%number((i - 1)/model%dimensions + 1), modulo(i - 1, model%dimensions) + 1]
    end function label

  end subroutine write_formats

  !> Forces of the pressure on top, as a table.
  subroutine write_loads(path, model)
    character(len=*), intent(in) :: path
    type(block), intent(in) :: model
    real(dp) :: load(size(model%position))
    integer :: file, k

    load = model%pressure_load()
    open (newunit=file, file=path, status='replace', action='write')
    write (file, '(a)') 'node,direction,value'
    do k = 1, size(model%top)
      write (file, '(a,i0,2a,es24.16)') 'upper.', model%number(model%top(k)), ',', &
        merge('y,', 'z,', model%dimensions == 2), load(model%dimensions*model%top(k))
    end do
    close (file)
  end subroutine write_loads

end module block_files
