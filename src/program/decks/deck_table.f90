!> The table of a structure with one-way links: a line for each link, columns for each load case, and the envelope.
module deck_table
  use contact_table, only: put_outcome
  use deck_cases, only: case_results
  use deck_model, only: structure
  use fuge_core, only: dp => fuge_dp, fuge_info, FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP, FUGE_LIMITED_LOWER, &
    FUGE_LIMITED_UPPER
  use number_words, only: number_text, short_text
  use text_table, only: table
  implicit none
  private

  public :: write_links

contains

  !> On standard output if `path` is empty. Error: FUGE_ERR_FILE.
  subroutine write_links(path, model, results, info)
    character(len=*), intent(in) :: path
    type(structure), intent(in) :: model
    type(case_results), intent(in) :: results
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=:), allocatable :: line
    integer :: k

    call csv%create(path, info)
    if (info%failed()) return
    line = 'element,node_a,node_b'
    do k = 1, size(results%report)
      call put_case(csv, model, results, k)
      line = line//',force '//number_text(k)//',gap '//number_text(k)//',state '//number_text(k)
    end do
    call csv%put(line//',smallest force,in case,largest force,in case')
    do k = 1, model%deck%link_count()
      call csv%put(link_line(model, results, k))
    end do
    call csv%finish(info)
  end subroutine write_links

  !> The comments of a case.
  subroutine put_case(csv, model, results, k)
    type(table), intent(inout) :: csv
    type(structure), intent(in) :: model
    type(case_results), intent(in) :: results
    integer, intent(in) :: k
    type(fuge_info) :: report
    real(dp) :: largest
    integer :: node

    report = results%report(k)
    call csv%put('# case '//number_text(k)//': '//trim(model%deck%cases(k)%name))
    call put_outcome(csv, report)
    if (report%failed()) return
    call find_largest(model, results%displacement(:, k), largest, node)
    call csv%put('# contacts: '//number_text(report%contacts))
    call csv%put('# largest displacement: '//short_text(largest)//' of node '//number_text(node))
  end subroutine put_case

  !> The largest displacement of a node, rotations left out, and its number.
  pure subroutine find_largest(model, displacement, largest, node)
    type(structure), intent(in) :: model
    real(dp), intent(in) :: displacement(:)
    real(dp), intent(out) :: largest
    integer, intent(out) :: node
    real(dp) :: vector(3)
    integer :: i, j

    largest = -1.0_dp
    node = 0
    do i = 1, size(displacement)
      if (model%direction(i) < 1 .or. model%direction(i) > 3) cycle
      ! The rows of a node follow each other in all formats; where they do not, the largest row counts.
      vector = 0.0_dp
      do j = max(1, i - 2), min(size(displacement), i + 2)
        if (model%node(j) /= model%node(i) .or. model%direction(j) < 1 .or. model%direction(j) > 3) cycle
        vector(model%direction(j)) = displacement(j)
      end do
      if (norm2(vector) <= largest) cycle
      largest = norm2(vector)
      node = model%node(i)
    end do
    largest = max(largest, 0.0_dp)
  end subroutine find_largest

  !> The line of link `i`.
  pure function link_line(model, results, i) result(line)
    type(structure), intent(in) :: model
    type(case_results), intent(in) :: results
    integer, intent(in) :: i
    character(len=:), allocatable :: line
    integer :: k, largest, smallest

    associate (link => model%deck%links(i))
      line = trim(link%name)//','//number_text(link%node_a)//','//number_text(link%node_b)
    end associate
    smallest = 0
    largest = 0
    do k = 1, size(results%report)
      if (results%report(k)%status < 0) then
        line = line//',,,failed'
        cycle
      end if
      line = line//','//long_text(results%force(i, k))//','//long_text(results%gap(i, k))//',' &
        //trim(state_word(results%state(i, k), model%deck%links(i)%play))
      if (smallest == 0) smallest = k
      if (largest == 0) largest = k
      if (results%force(i, k) < results%force(i, smallest)) smallest = k
      if (results%force(i, k) > results%force(i, largest)) largest = k
    end do
    if (smallest == 0) then
      line = line//',,,,'
    else
      line = line//','//long_text(results%force(i, smallest))//','//number_text(smallest)//',' &
        //long_text(results%force(i, largest))//','//number_text(largest)
    end if
  end function link_line

  !> A number with all its digits.
  pure function long_text(value) result(text)
    real(dp), intent(in) :: value
    character(len=25) :: text

    write (text, '(es25.16e3)') value
  end function long_text

  !> What a link with this play does.
  pure function state_word(state, play) result(word)
    integer, intent(in) :: state
    real(dp), intent(in) :: play
    character(len=8) :: word

    word = 'open'
    if (state == FUGE_AT_LOWER_STOP) word = 'contact'
    if (state == FUGE_AT_UPPER_STOP) word = 'upper'
    if (.not. play > 0.0_dp) word = 'held'
    if (state == FUGE_LIMITED_LOWER .or. state == FUGE_LIMITED_UPPER) word = 'limited'
  end function state_word

end module deck_table
