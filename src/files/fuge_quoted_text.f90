!> Paths and words of the caller in messages.
module fuge_quoted_text
  implicit none
  private

  public :: quoted, quoted_path

  !> Characters of a path that messages show, from its end, and of a text, from its beginning.
  integer, parameter :: PATH_LENGTH = 100, QUOTE_LENGTH = 24

contains

  !> The path in quotes, only the end of a long one, control characters as ?.
  pure function quoted_path(path) result(name)
    character(len=*), intent(in) :: path
    character(len=merge(PATH_LENGTH + 4, len_trim(path) + 2, len_trim(path) > PATH_LENGTH)) :: name
    integer :: k, length

    length = len_trim(path)
    if (length > PATH_LENGTH) then
      name = '"..'//path(length - PATH_LENGTH + 1:length)//'"'
    else
      name = '"'//path(:length)//'"'
    end if
    do k = 1, len(name)
      if (iachar(name(k:k)) < 32 .or. iachar(name(k:k)) == 127) name(k:k) = '?'
    end do
  end function quoted_path

  !> The beginning of a text in quotes, unprintable characters as ?, quotes as '.
  pure function quoted(string) result(quote)
    character(len=*), intent(in) :: string
    character(len=min(len(string), QUOTE_LENGTH) + merge(4, 2, len(string) > QUOTE_LENGTH)) :: quote
    integer :: k

    quote = '"'//string(:min(len(string), QUOTE_LENGTH))
    if (len(string) > QUOTE_LENGTH) quote(QUOTE_LENGTH + 2:) = '..'
    do k = 2, len(quote) - 1
      if (iachar(quote(k:k)) < 32 .or. iachar(quote(k:k)) > 126) quote(k:k) = '?'
      if (quote(k:k) == '"') quote(k:k) = ''''
    end do
    quote(len(quote):) = '"'
  end function quoted

end module fuge_quoted_text
