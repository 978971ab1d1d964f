!> Tables of contact forces and of displacements: CSV with comments after #.
module contact_table
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_problem, fuge_proof, fuge_solution, fuge_status_text, &
    FUGE_LIMITED_LOWER, FUGE_LIMITED_UPPER
  use text_table, only: table
  implicit none
  private

  public :: put_outcome, put_status, state_word, write_contact, write_displacements

contains

  !> Forces, gaps and states, and their bounds if `proof` has any; on standard output if `path` is empty.
  subroutine write_contact(path, problem, solution, proof, info)
    character(len=*), intent(in) :: path
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_proof), intent(in) :: proof
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=320) :: line
    real(dp) :: range(2)
    logical :: has_bounds
    integer :: k

    has_bounds = allocated(proof%force_bound)
    call csv%create(path, info)
    if (info%failed()) return
    call put_status(csv, info)
    do k = 1, size(solution%motion)
      write (line, '(a,i0,2(a,es24.16e3))') '# motion ', k, ': ', solution%motion(k), ', resultant: ', &
        resultant(problem, solution%force, k)
      if (has_bounds) write (line(len_trim(line) + 1:), '(a,es24.16e3)') ', bound: ', proof%motion_bound(k)
      call csv%put(line)
    end do
    if (has_bounds) then
      range = proof%largest_force(solution)
      write (line, '(2(a,es24.16e3))') '# largest force: from ', range(1), ' to ', range(2)
      call csv%put(line)
      call csv%put('point,force,gap,state,force_bound,gap_bound,proved')
    else
      call csv%put('point,force,gap,state')
    end if
    do k = 1, size(solution%force)
      write (line, '(i0,2('','',es24.16e3),2a)') k, solution%force(k), solution%gap(k), ',', &
        state_word(k, problem, solution)
      if (has_bounds) write (line(len_trim(line) + 1:), '(2('','',es24.16e3),2a)') proof%force_bound(k), &
        proof%gap_bound(k), ',', merge('yes', 'no ', proof%state_proved(k))
      call csv%put(line)
    end do
    call csv%finish(info)
  end subroutine write_contact

  !> Status, message, residual, and the number of contacts.
  subroutine put_status(csv, info)
    type(table), intent(inout) :: csv
    type(fuge_info), intent(in) :: info
    character(len=40) :: line

    call put_outcome(csv, info)
    write (line, '(a,i0)') '# contacts: ', info%contacts
    call csv%put(line)
  end subroutine put_status

  !> Status, message, which may be a remark without a warning, and residual.
  subroutine put_outcome(csv, info)
    type(table), intent(inout) :: csv
    type(fuge_info), intent(in) :: info
    character(len=320) :: line

    write (line, '(a,i0,2a)') '# status: ', info%status, ', ', fuge_status_text(info%status)
    call csv%put(line)
    if (info%status /= 0 .or. len_trim(info%message) > 0) call csv%put('# message: '//info%message)
    write (line, '(a,es9.2e3)') '# residual: ', info%residual
    call csv%put(line)
  end subroutine put_outcome

  !> What contact point `k` does; where its force is limited, the sign of that tells the stop.
  pure function state_word(k, problem, solution) result(state)
    integer, intent(in) :: k
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    character(len=8) :: state

    state = 'open'
    if (solution%force(k) > 0.0_dp) state = 'contact'
    if (solution%force(k) < 0.0_dp) state = 'upper'
    if (allocated(problem%gap_upper)) then
      if (.not. problem%gap_upper(k) > 0.0_dp) state = 'held'
    end if
    if (solution%state(k) == FUGE_LIMITED_LOWER .or. solution%state(k) == FUGE_LIMITED_UPPER) state = 'limited'
    if (allocated(problem%excluded)) then
      if (problem%excluded(k)) state = 'excluded'
    end if
  end function state_word

  !> (R^T f)_k
  pure function resultant(problem, force, k)
    type(fuge_problem), intent(in) :: problem
    real(dp), intent(in) :: force(:)
    integer, intent(in) :: k
    real(dp) :: resultant

    if (allocated(problem%modes)) then
      resultant = dot_product(problem%modes(:, k), force)
    else
      resultant = sum(force)
    end if
  end function resultant

  !> Displacements of the whole body.
  subroutine write_displacements(path, displacement, info)
    character(len=*), intent(in) :: path
    real(dp), intent(in) :: displacement(:)
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=40) :: line
    integer :: k

    call csv%create(path, info)
    if (info%failed()) return
    call csv%put('degree of freedom,displacement')
    do k = 1, size(displacement)
      write (line, '(i0,'','',es24.16e3)') k, displacement(k)
      call csv%put(line)
    end do
    call csv%finish(info)
  end subroutine write_displacements

end module contact_table
