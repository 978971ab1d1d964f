!> A body from matrices in files, condensed to its contact points.
module matrix_body
  use chosen_stiffness, only: stored_stiffness
  use command_line, only: arguments
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_problem, fuge_solution, FUGE_ERR_DOF
  use fuge_fe, only: fuge_body, fuge_condense, fuge_condensed
  use fuge_files, only: fuge_read_matrix, fuge_read_sparse, fuge_read_stiffness
  use matrix_files, only: read_vector, refuse_size
  use number_words, only: number_text
  use progress_log, only: progress
  implicit none
  private

  type, public :: elastic_body
    private
    type(stored_stiffness) :: stiffness
    type(fuge_body) :: body
    type(fuge_condensed), public :: condensed
    integer :: degrees = 0
  contains
    procedure, public :: read => read_body
    procedure, public :: points
    procedure, public :: pose
    procedure, public :: recover
  end type elastic_body

contains

  !> Read all files of the body and condense it.
  subroutine read_body(self, given, log, info)
    class(elastic_body), intent(inout), target :: self
    type(arguments), intent(in) :: given
    type(progress), intent(in) :: log
    type(fuge_info), intent(out) :: info
    integer, allocatable :: column(:), row(:), node(:), direction(:)
    real(dp), allocatable :: value(:)

    call fuge_read_stiffness(given%file('stiffness'), column, row, value, node, direction, info, &
                             names_path=given%file('rows'))
    if (info%failed()) return
    call log%say('stiffness matrix of '//number_text(size(column) - 1)//' rows is read')
    call self%stiffness%set_columns(column, row, value, info)
    if (info%failed()) return
    self%degrees = size(column) - 1
    self%body%floats = given%has('floats')
    call read_contact(given%file('contact'), self%degrees, self%body, info)
    if (given%has('fixed') .and. .not. info%failed()) call read_fixed(given%file('fixed'), self%body, info)
    if (given%has('external') .and. .not. info%failed()) then
      call read_vector(given%file('external'), self%degrees, self%body%load, info)
    end if
    if (info%failed()) return
    call fuge_condense(self%stiffness, self%body, self%condensed, info)
    if (.not. info%failed()) call log%say('the body is condensed to '//number_text(self%points())//' points')
  end subroutine read_body

  pure function points(self) result(n)
    class(elastic_body), intent(in) :: self
    integer :: n

    n = size(self%body%dof, 2)
  end function points

  !> From a matrix with one row for each point to the degrees of freedom of each point.
  subroutine read_contact(path, degrees, body, info)
    character(len=*), intent(in) :: path
    integer, intent(in) :: degrees
    type(fuge_body), intent(inout) :: body
    type(fuge_info), intent(out) :: info
    integer, allocatable :: column(:), row(:), used(:)
    real(dp), allocatable :: value(:)
    character(len=24) :: wanted
    integer :: j, k, n

    call fuge_read_sparse(path, n, column, row, value, info)
    if (info%failed()) return
    if (size(column) - 1 /= degrees .or. n < 1) then
      write (wanted, '(a,i0)') 'n x ', degrees
      call refuse_size(path, [n, size(column) - 1], trim(wanted)//' is needed', info)
      return
    end if
    used = [(count(row == k), k=1, n)]
    allocate (body%dof(maxval(used), n), body%normal(maxval(used), n))
    body%dof = 0
    body%normal = 0.0_dp
    used = 0
    do j = 1, degrees
      do k = column(j), column(j + 1) - 1
        used(row(k)) = used(row(k)) + 1
        body%dof(used(row(k)), row(k)) = j
        body%normal(used(row(k)), row(k)) = value(k)
      end do
    end do
  end subroutine read_contact

  !> Degrees of freedom that are held, and their displacements if there is a second column.
  subroutine read_fixed(path, body, info)
    character(len=*), intent(in) :: path
    type(fuge_body), intent(inout) :: body
    type(fuge_info), intent(out) :: info
    real(dp), allocatable :: matrix(:, :)
    integer :: k

    call fuge_read_matrix(path, matrix, info)
    if (info%failed()) return
    if (size(matrix, 2) < 1 .or. size(matrix, 2) > 2) then
      call refuse_size(path, shape(matrix), 'k x 1 or k x 2 is needed', info)
      return
    end if
    do k = 1, size(matrix, 1)
      if (abs(matrix(k, 1)) < real(huge(1), dp) .and. abs(matrix(k, 1) - anint(matrix(k, 1))) <= 0.0_dp) cycle
      info%status = FUGE_ERR_DOF
      write (info%message, '(3a,i0,a,es12.5,a)') '"', path, '": entry (', k, ', 1) = ', matrix(k, 1), &
        ' is no degree of freedom'
      return
    end do
    body%fixed = nint(matrix(:, 1))
    if (size(matrix, 2) == 2) body%displacement = matrix(:, 2)
  end subroutine read_fixed

  !> Gaps under the external load; the motions of a body that floats come before those of
  !> the counter-body.
  subroutine pose(self, problem, info)
    class(elastic_body), intent(in) :: self
    type(fuge_problem), intent(inout) :: problem
    type(fuge_info), intent(inout) :: info
    type(fuge_problem) :: counter
    integer :: m, n, own

    counter = problem
    call self%condensed%pose(counter%gap, problem, info)
    own = size(self%condensed%resultant)
    if (info%failed() .or. own == 0) return
    n = size(counter%gap)
    if (.not. allocated(counter%modes)) then
      allocate (counter%modes(n, 1))
      counter%modes = 1.0_dp
    end if
    m = size(counter%modes, 2)
    problem%modes = reshape([self%condensed%modes, counter%modes], [n, own + m])
    problem%resultant = [self%condensed%resultant, counter%resultant]
    if (.not. allocated(counter%prescribed)) return
    problem%prescribed = [spread(.false., 1, own), counter%prescribed]
    problem%motion = [spread(0.0_dp, 1, own), counter%motion]
  end subroutine pose

  !> Displacements of all degrees of freedom.
  subroutine recover(self, solution, displacement, info)
    class(elastic_body), intent(in) :: self
    type(fuge_solution), intent(in) :: solution
    real(dp), allocatable, intent(inout) :: displacement(:)
    type(fuge_info), intent(out) :: info

    allocate (displacement(self%degrees))
    call self%condensed%recover(solution, displacement, info)
  end subroutine recover

end module matrix_body
