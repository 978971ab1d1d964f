!> Structures with one-way links: from the deck and the stiffness matrix to the table of all load cases.
module deck_problem
  use command_line, only: arguments
  use deck_cases, only: case_results, solve_cases
  use deck_fields, only: is_mesh_file, read_drawn_mesh, write_fields
  use deck_model, only: structure
  use deck_table, only: write_links
  use fuge_core, only: fuge_info, fuge_options
  use fuge_files, only: fuge_mesh
  use number_words, only: number_text
  use problem_solution, only: warn
  use progress_log, only: progress
  implicit none
  private

  public :: solve_deck

contains

  !> --deck, --links. Where cases fail the tables are written all the same, and `info` has the first failure.
  subroutine solve_deck(given, options, log, info)
    type(arguments), intent(in) :: given
    type(fuge_options), intent(in) :: options
    type(progress), intent(in) :: log
    type(fuge_info), intent(inout) :: info
    type(structure) :: model
    type(fuge_mesh) :: mesh
    type(case_results) :: results

    call model%read(given, log, info)
    if (is_mesh_file(given%file('field')) .and. .not. info%failed()) call read_drawn_mesh(given, mesh, info)
    if (.not. info%failed()) call solve_cases(model, options, results, log, info)
    if (info%failed()) return
    if (given%has('field')) call write_fields(given%file('field'), mesh, model, results, info)
    if (.not. info%failed()) call write_links(given%file('output'), model, results, info)
    if (.not. info%failed()) call report_cases(model, results, info)
  end subroutine solve_deck

  !> Warnings of cases; the first failure becomes that of the program.
  subroutine report_cases(model, results, info)
    type(structure), intent(in) :: model
    type(case_results), intent(in) :: results
    type(fuge_info), intent(inout) :: info
    type(fuge_info) :: report
    integer :: first, k

    do k = 1, size(results%report)
      report = results%report(k)
      report%message = trim(model%deck%cases(k)%name)//': '//results%report(k)%message
      call warn(report)
    end do
    first = findloc(results%report%status < 0, .true., dim=1)
    if (first == 0) return
    info%status = results%report(first)%status
    info%message = number_text(count(results%report%status < 0))//' of '//number_text(size(results%report)) &
      //' load cases failed; '//trim(model%deck%cases(first)%name)//': '//results%report(first)%message
  end subroutine report_cases

end module deck_problem
