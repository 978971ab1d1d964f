!> The word of a list that is meant by one with a typing error.
module similar_words
  implicit none
  private

  public :: similar_word

  !> A word may have one typing error for this many letters.
  integer, parameter :: LETTERS = 3

contains

  !> The number of the word in `words` that is nearest to `word`; 0 if none is near.
  pure function similar_word(word, words) result(nearest)
    character(len=*), intent(in) :: word, words(:)
    integer :: nearest
    integer :: errors, k, least

    nearest = 0
    least = len(word)/LETTERS + 1
    do k = 1, size(words)
      errors = edit_distance(word, trim(words(k)))
      if (errors >= least) cycle
      least = errors
      nearest = k
    end do
  end function similar_word

  !> The number of letters to insert, to leave out, to replace, or to exchange with their neighbour, that make one word
  !> of the other (Wagner and Fischer 1974, with exchanges by Lowrance and Wagner 1975, each letter edited once).
  pure function edit_distance(a, b) result(distance)
    character(len=*), intent(in) :: a, b
    integer :: distance
    ! Of the first letters of `a`, by the number of the first letters of `b`: two rows before, the row before, this one.
    integer, dimension(-1:len(b)) :: second, before, row
    integer :: i, j

    row = [(j, j=-1, len(b))]
    before = row
    do i = 1, len(a)
      second = before
      before = row
      row(0) = i
      do j = 1, len(b)
        row(j) = min(before(j) + 1, row(j - 1) + 1, before(j - 1) + merge(0, 1, a(i:i) == b(j:j)))
        if (i > 1 .and. j > 1) then
          if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) row(j) = min(row(j), second(j - 2) + 1)
        end if
      end do
    end do
    distance = row(len(b))
  end function edit_distance

end module similar_words
