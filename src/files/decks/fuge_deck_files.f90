!> Decks of finite element programs: what they say beside the mesh and the stiffness matrix.
module fuge_deck_files
  use fuge_deck_type, only: fuge_deck, move_deck
  use fuge_status, only: fuge_info
  use fuge_text_columns, only: after_blanks
  use fuge_text_reader, only: text_file
  implicit none
  private

  public :: fuge_read_deck

contains

  !> Read one-way links and load cases from a deck of Nastran, Abaqus or CalculiX.
  !>
  !> The format is known by the first line that is neither blank nor a comment: that of Abaqus and CalculiX begins with
  !> * and a letter. Nastran: CGAP with PGAP, CBUSH1D with PBUSH1D and TABLED1, FORCE, MOMENT, LOAD, SPC, SPC1, SPCADD,
  !> SPCD, the permanent supports of GRID, and SUBCASE, LOAD =, SPC = of the case control; without case control the only
  !> load set is the only case. Abaqus and CalculiX: GAPUNI, GAPCYL and GAPSPHER with *GAP, *BOUNDARY, *CLOAD, and each
  !> static *STEP is a case. A link without a stiffness is rigid. Linear springs belong to the stiffness matrix; one-way
  !> elements must not be in it.
  !> Errors, `deck` unchanged: FUGE_ERR_FILE with file, line, card and reason, also for contact, springs and loads that
  !> are not read; FUGE_ERR_MEMORY.
  subroutine fuge_read_deck(path, deck, info)
    use fuge_bulk_deck, only: read_bulk_deck
    use fuge_keyword_deck, only: read_keyword_deck
    character(len=*), intent(in) :: path
    type(fuge_deck), intent(inout) :: deck
    type(fuge_info), intent(out) :: info
    type(fuge_deck) :: found
    type(text_file) :: file
    logical :: has_keywords

    call file%load(path, info)
    if (info%failed()) return
    call find_keyword(file, has_keywords)
    if (has_keywords) then
      call read_keyword_deck(path, found, info)
    else
      call read_bulk_deck(path, found, info)
    end if
    if (.not. info%failed()) call move_deck(found, deck)
  end subroutine fuge_read_deck

  !> Is the first line that says something a keyword line?
  pure subroutine find_keyword(file, has_keywords)
    type(text_file), intent(inout) :: file
    logical, intent(out) :: has_keywords
    integer :: first
    logical :: exists

    has_keywords = .false.
    do
      call file%advance(exists)
      if (.not. exists) return
      associate (line => file%content(file%first:file%last))
        first = after_blanks(line, 1)
        if (first > len(line)) cycle
        if (line(first:first) == '$' .or. index(line(first:), '**') == 1) cycle
        if (first < len(line)) has_keywords = line(first:first) == '*' .and. scan(line(first + 1:first + 1), &
          'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz') > 0
        return
      end associate
    end do
  end subroutine find_keyword

end module fuge_deck_files
